"""Files for VTK and ParaView beside grains.h5 and fields.h5: VTKHDF 1.0, one file a frame.

VTKHDF 1.0 (VTK 9.1 and newer, https://docs.vtk.org/en/latest/design_documents/VTKFileFormats.html#hdf-file-formats)
knows images and unstructured grids, and no time. Grains are vertices; the rectilinear mesh of the flow, which images
cannot describe, is hexahedra; bodies are triangles. Values are not copied: they are links to the files of the run,
which must stay beside. The spheres of clumps, of which the run has only what they follow from, are written to
spheres.h5, frames as those of grains.h5. vtkhdf_in_time.py writes the same in files with time.
"""

import json
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any, Protocol

import numpy as np

from barchan.errors import MissingData
from barchan.io import writing
from barchan.io.clumps import spheres_of
from barchan.io.frames import FrameFile
from barchan.io.hdf5 import Group, h5py
from barchan.io.run_folder import RunFolder

FOLDER = "vtkhdf"
VERTEX, TRIANGLE, HEXAHEDRON = 1, 5, 12  # types of cells of VTK
SMALL = {"compression": "gzip", "shuffle": True}


class Surface(Protocol):
    """Triangles, as barchan.dune.body_surface.Surface."""

    @property
    def points(self) -> np.ndarray: ...  # (n, 3) [m]
    @property
    def triangles(self) -> np.ndarray: ...  # (m, 3), numbers of points
    @property
    def body(self) -> np.ndarray: ...  # (m), the number of the body


def write(run: RunFolder, bodies: Surface | None = None) -> list[Path]:
    """Writes RUN_DIR/vtkhdf anew for all frames there are.

    Parameters
    ----------
    bodies
        surfaces of the bodies of the case; None: there are none

    Returns
    -------
    list of Path
        The series of files, one for each kind, and the file of the bodies.

    Raises
    ------
    MissingData
        where the run has no frames.
    """
    folder, kinds = begun(run)
    written = [_write_series(folder, kind, file) for kind, file in kinds]
    named = {entry["name"] for one in written for entry in json.loads(one.read_text())["files"]}
    if bodies is not None:
        written.append(_write_bodies(folder / "bodies.hdf", bodies))
    writing.only(folder, "*.hdf*", named | {one.name for one in written})
    return written


def begun(run: RunFolder) -> tuple[Path, list[tuple[str, FrameFile]]]:
    """RUN_DIR/vtkhdf, and ("grains", "spheres" of clumps or "fields", its file) of what the run has frames of.

    Raises MissingData where it has none.
    """
    kinds = [(kind, file) for kind, file in (("grains", run.grain_file), ("fields", run.field_file)) if file]
    if not kinds:
        raise MissingData("needs grains.h5 or fields.h5 with at least one frame")
    folder = writing.folder(run.path / FOLDER)
    spheres = folder / "spheres.h5"
    if run.grain_file and run.shapes:
        kinds.insert(1, ("spheres", _write_spheres(spheres, run)))
    else:
        writing.only(folder, spheres.name, set())
    return folder, kinds


def _write_spheres(path: Path, run: RunFolder) -> FrameFile:
    """The spheres of all clumps in frames as those of grains.h5: x and d are theirs, all else is the clump's."""
    file = run.need_grains()
    with file.open() as source, new_file(path) as out:
        for number, (time, name) in enumerate(file.frames):
            frame = source[name]
            order = np.argsort(frame["id"][:])  # of the grains that the run folder reads
            spheres = spheres_of(run.frame(number))
            group = out.create_group(name)
            group.attrs["time"] = time
            for array, values in (("x", spheres.x), ("d", spheres.d)):
                group.create_dataset(array, data=values, **SMALL)
            for array in frame:
                if array not in group and array != "orientation":
                    group.create_dataset(array, data=frame[array][:][order][spheres.grain], **SMALL)
    return FrameFile(path, ("id", "x", "d"))


def _write_series(folder: Path, kind: str, file: FrameFile) -> Path:
    """All frames of a file, and the list of them with their times."""
    mesh = folder / "fields_mesh.h5"
    entries = []
    with file.open() as root:
        if kind == "fields":
            _write_mesh(mesh, root["grid"])
        for time, name in file.frames:
            path = folder / f"{kind}_{name.rpartition('frame_')[2]}.hdf"
            with new_file(path) as out:
                top = top_group(out, (1, 0), "UnstructuredGrid")
                top["FieldData/TimeValue"] = np.array([time])
                source = place_of(file)
                if kind == "fields":
                    _add_fields(top, root[name], source, name, mesh.name)
                else:
                    _add_grains(top, root[name], source, name)
            entries.append({"name": path.name, "time": time})
    series = folder / f"{kind}.hdf.series"
    writing.write(series, json.dumps({"file-series-version": "1.0", "files": entries}, indent=1) + "\n")
    return series


def place_of(file: FrameFile) -> str:
    """The path of a file as links of files in FOLDER have it."""
    return file.path.name if file.path.parent.name == FOLDER else f"../{file.path.name}"


@contextmanager
def new_file(path: Path) -> Iterator[Any]:
    with writing.replacing(path) as beside, h5py.File(beside, "x") as out:
        yield out


def top_group(out: Any, version: tuple[int, int], kind: str) -> Any:
    """The group of a file that readers of VTKHDF look at."""
    top = out.create_group("VTKHDF")
    top.attrs["Version"], top.attrs["Type"] = version, np.bytes_(kind)
    return top


def _write_bodies(path: Path, bodies: Surface) -> Path:
    with new_file(path) as out:
        top = top_group(out, (1, 0), "UnstructuredGrid")
        top.create_dataset("Points", data=bodies.points, **SMALL)
        _write_cells(top, len(bodies.points), bodies.triangles, TRIANGLE)
        top["CellData/body"] = bodies.body
    return path


def _write_cells(group: Any, n_points: int, corners: np.ndarray, kind: int) -> None:
    """Cells by their corners (cells, corners each), all of one type of VTK."""
    count, each = corners.shape
    numbers = {"NumberOfPoints": n_points, "NumberOfCells": count, "NumberOfConnectivityIds": corners.size}
    for name, number in numbers.items():
        group[name] = np.array([number])
    group.create_dataset("Connectivity", data=corners.reshape(-1), **SMALL)
    group.create_dataset("Offsets", data=each * np.arange(count + 1), **SMALL)
    group.create_dataset("Types", data=np.full(count, kind, "u1"), **SMALL)


def _add_grains(top: Any, frame: Group, source: str, name: str) -> None:
    n = len(frame["id"])
    _write_cells(top, n, np.arange(n)[:, None], VERTEX)
    top["Points"] = h5py.ExternalLink(source, f"/{name}/x")
    for array in frame:
        if array != "x":
            top[f"PointData/{array}"] = h5py.ExternalLink(source, f"/{name}/{array}")


def _write_mesh(path: Path, grid: Group) -> None:
    """One file for all frames."""
    with new_file(path) as out:
        write_mesh(out, grid)


def write_mesh(group: Any, grid: Group) -> int:
    """Points and hexahedra, x fastest; returns the number of these."""
    x, y, z = (grid[f"{axis}_face"][:] for axis in "xyz")
    points = np.stack(np.meshgrid(z, y, x, indexing="ij")[::-1], axis=-1).reshape(-1, 3)
    number = np.arange(len(points)).reshape(len(z), len(y), len(x))
    corners = [number[k:k - 1 or None, j:j - 1 or None, i:i - 1 or None].reshape(-1)
               for k in (0, 1) for j, i in ((0, 0), (0, 1), (1, 1), (1, 0))]
    group.create_dataset("Points", data=points, **SMALL)
    _write_cells(group, len(points), np.stack(corners, axis=1), HEXAHEDRON)
    return len(corners[0])


def _add_fields(top: Any, frame: Group, source: str, name: str, mesh: str) -> None:
    for part in ("Points", "Connectivity", "Offsets", "Types", "NumberOfPoints", "NumberOfCells",
                 "NumberOfConnectivityIds"):
        top[part] = h5py.ExternalLink(mesh, f"/{part}")
    cells = top.create_group("CellData")

    def values(array: str) -> Any:
        return h5py.VirtualSource(source, f"/{name}/{array}", shape=frame[array].array.shape)

    for array in frame:
        whole = frame[array].array
        layout = h5py.VirtualLayout((whole.size,), whole.dtype)  # of three dimensions: flat, x fastest
        layout[:] = values(array)
        cells.create_virtual_dataset(array, layout)
    velocity = h5py.VirtualLayout((frame["u"].array.size, 3), frame["u"].array.dtype)
    for axis, array in enumerate("uvw"):
        velocity[:, axis] = values(array)
    cells.create_virtual_dataset("velocity", velocity)
