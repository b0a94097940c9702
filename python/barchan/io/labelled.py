"""Results with their names, units and coordinates: pandas for tables and grains, xarray for fields.

Both packages are imported where they are first needed: figures do without them.
"""

from typing import Any

import numpy as np

from barchan.errors import optional
from barchan.io.columns import AXES, FIELDS, GRAINS
from barchan.io.frames import FrameFile

VECTOR_PARTS = {"x": "xyz", "u": "uvw"}  # of others the axis follows the name: omega_x


def data_frame(columns: dict[str, np.ndarray], about: dict[str, tuple[str, str]]) -> Any:
    """A pandas.DataFrame; attrs["units"] and attrs["long_names"] say what its columns are."""
    frame = optional("pandas", "pandas").DataFrame(columns)
    frame.attrs["units"] = {name: about[name][0] for name in columns if name in about}
    frame.attrs["long_names"] = {name: about[name][1] for name in columns if name in about}
    return frame


def grains_frame(time: float, columns: dict[str, np.ndarray]) -> Any:
    """Grains of a frame as a pandas.DataFrame, one column for each part of a vector; attrs["time"] [s]."""
    flat: dict[str, np.ndarray] = {}
    about: dict[str, tuple[str, str]] = {}
    for name, values in columns.items():
        if values.ndim == 1:
            parts = {name: values}
        else:
            parts = {VECTOR_PARTS[name][axis] if name in VECTOR_PARTS else f"{name}_{'xyz'[axis]}": values[:, axis]
                     for axis in range(3)}
        flat |= parts
        about |= {part: GRAINS[name] for part in parts if name in GRAINS}
    frame = data_frame(flat, about).set_index("id")
    frame.attrs["time"] = time
    return frame


def dataset(file: FrameFile, index: int) -> Any:
    """Fields of a frame as an xarray.Dataset over z, y, x [m]; a field is read where its values are used."""
    xarray = optional("xarray", "xarray")
    time, name = file.frames[index]
    with file.open() as content:
        centres = {axis: content["grid"][axis][:] for axis in "xyz"}
        shapes = {key: (content[name][key].array.shape, content[name][key].array.dtype) for key in content[name]}
        notes = {key: value.item() if hasattr(value, "item") else value for key, value in content[name].attrs.items()}
    coordinates: dict[str, tuple] = {"time": ((), time, {"units": "s", "long_name": "time"})}
    coordinates |= {axis: ((axis,), values, attributes(AXES[axis])) for axis, values in centres.items()}
    fields = {key: (("z", "y", "x"), lazy(file, f"{name}/{key}", *shapes[key]), attributes(FIELDS.get(key)))
              for key in shapes}
    return xarray.Dataset({key: xarray.Variable(*value) for key, value in fields.items()}, coordinates,
                          {"title": file.title, "source": "Barchan", "Conventions": "CF-1.10", **notes})


def attributes(about: tuple[str, str] | None) -> dict[str, str]:
    return {"units": about[0], "long_name": about[1]} if about else {}


def lazy(file: FrameFile, name: str, shape: tuple, dtype: np.dtype) -> Any:
    """An array of the file that xarray reads part by part."""
    from xarray.backends import BackendArray
    from xarray.core import indexing

    class OnDisk(BackendArray):
        def __init__(self) -> None:
            self.shape, self.dtype = shape, dtype

        def __getitem__(self, key: Any) -> Any:
            return indexing.explicit_indexing_adapter(key, shape, indexing.IndexingSupport.BASIC, self.read)

        def read(self, key: tuple) -> np.ndarray:
            whole = all(part == slice(None) or part == slice(0, length, 1) for part, length in zip(key, shape))
            with file.open() as content:
                return content[name][:] if whole else content[name][key]  # of the whole the checksum is looked at

    return indexing.LazilyIndexedArray(OnDisk())
