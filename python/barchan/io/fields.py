"""Fields of the flow for xarray: fields.h5 and flow_average.h5 as one Dataset over time, z, y and x.

Coordinates are those of the CF conventions: axes, units and the bounds of the cells. xarray finds the class `Fields` as
its engine "barchan" where the package is installed.
"""

from pathlib import Path
from typing import Any

import numpy as np
import xarray
from xarray.backends import BackendArray, BackendEntrypoint
from xarray.core import indexing

from barchan.errors import BarchanError
from barchan.io.frames import FrameFile
from barchan.io.hdf5 import patiently
from barchan.io.units import About, of_arrays

NEEDED = ("u", "v", "alpha_f")
DIMENSIONS = ("time", "z", "y", "x")
# CF calls the vertical axis Z, whatever the name of the coordinate.
CF = {"x": {"axis": "X"}, "y": {"axis": "Z", "positive": "up", "standard_name": "height"}, "z": {"axis": "Y"}}
TIME = {"axis": "T", "standard_name": "time", "units": "s", "long_name": "time"}


class FrameArray(BackendArray):
    """An array of every frame, (time, z, y, x); what is asked for is read, frame by frame."""

    def __init__(self, file: FrameFile, name: str, shape: tuple[int, ...], dtype: np.dtype) -> None:
        self.file, self.name = file, name
        self.shape, self.dtype = (len(file.frames), *shape), dtype

    def __getitem__(self, key: Any) -> Any:
        return indexing.explicit_indexing_adapter(key, self.shape, indexing.IndexingSupport.OUTER_1VECTOR, self._read)

    def _read(self, key: tuple) -> np.ndarray:
        frames, part = np.arange(self.shape[0])[key[0]], key[1:]
        if frames.ndim == 0:
            return patiently(self.file.path, lambda: self._of_frames([int(frames)], part)[0])
        if frames.size == 0:
            return np.empty((0, *np.broadcast_to(0, self.shape[1:])[part].shape), self.dtype)
        return patiently(self.file.path, lambda: np.stack(self._of_frames(frames.tolist(), part)))

    def _of_frames(self, frames: list[int], part: tuple) -> list[np.ndarray]:
        """Of each frame a part (z, y, x) of the array; where it is the whole, its checksum is looked at."""
        whole = all(isinstance(along, slice) and along.indices(length) == (0, length, 1)
                    for along, length in zip(part, self.shape[1:]))
        with self.file.open() as content:
            return [content[f"{self.file.frames[frame][1]}/{self.name}"][slice(None) if whole else part]
                    for frame in frames]


class Fields(BackendEntrypoint):
    """xarray's engine "barchan": xarray.open_dataset("runs/quickstart/fields.h5", engine="barchan")."""

    description = "Fields of the flow of Barchan: fields.h5, flow_average.h5"
    open_dataset_parameters = ("filename_or_obj", "drop_variables")

    def open_dataset(self, filename_or_obj: Any, drop_variables: Any = None) -> Any:  # type: ignore[override]
        file = FrameFile(Path(filename_or_obj), NEEDED)
        if not file.frames:
            raise BarchanError(f"{file.path} has no frame with the fields {', '.join(NEEDED)}")
        left_out = [drop_variables] if isinstance(drop_variables, str) else list(drop_variables or ())
        return dataset(file).drop_vars(left_out, errors="ignore")

    def guess_can_open(self, filename_or_obj: Any) -> bool:
        """Whether it is a file of frames with a mesh, for xarray.open_dataset without an engine."""
        try:
            path = Path(filename_or_obj)
            return path.suffix == ".h5" and path.is_file() and bool(FrameFile(path, NEEDED).frames)
        except (TypeError, BarchanError):
            return False


def dataset(file: FrameFile) -> Any:
    """All frames of a file; a field is read where its values are used."""
    with file.open() as content:
        grid, first = content["grid"], content[file.frames[0][1]]
        axes = {axis: (grid[axis][:], grid[f"{axis}_face"][:]) for axis in "xyz"}
        about, about_axes = of_arrays(first, list(first)), of_arrays(grid, list("xyz"))
        arrays = {name: FrameArray(file, name, first[name].array.shape, first[name].array.dtype) for name in first}
    coordinates: dict[str, tuple] = {"time": (("time",), file.times, TIME)}
    for axis, (centres, faces) in axes.items():
        bounds = f"{axis}_bnds"
        coordinates[axis] = ((axis,), centres, {**CF[axis], **attributes(axis, about_axes), "bounds": bounds})
        coordinates[bounds] = ((axis, "bnds"), np.stack([faces[:-1], faces[1:]], axis=1))
    fields = {name: xarray.Variable(DIMENSIONS, indexing.LazilyIndexedArray(array), attributes(name, about),
                                    {"preferred_chunks": dict(zip(DIMENSIONS, (1, *array.shape[1:])))})
              for name, array in arrays.items()}
    return xarray.Dataset(fields, coordinates, {"title": file.title, "source": "Barchan", "Conventions": "CF-1.10"})


def average(file: FrameFile) -> Any:
    """The one frame of flow_average.h5; attrs have its window of time."""
    with file.open() as content:
        notes = {name: value.item() for name, value in content[file.frames[-1][1]].attrs.items()}
    return dataset(file).isel(time=-1).assign_attrs(notes)


def attributes(name: str, about: About) -> dict[str, str]:
    return dict(zip(("units", "long_name"), about[name])) if name in about else {}
