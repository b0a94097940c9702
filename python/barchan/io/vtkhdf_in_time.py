"""Files for VTK and ParaView with all frames in one, VTKHDF 2.0 (VTK 9.3, ParaView 5.12 and newer).

Layout: https://docs.vtk.org/en/latest/vtk_file_formats/vtkhdf_file_format/vtkhdf_specifications.html#temporal-data
Arrays of all steps follow one another; offsets in `Steps` say where each step begins. Grains are poly data of
vertices. The rectilinear mesh of the flow is hexahedra, written once (rectilinear grids came with VTKHDF 2.7). Values
are not copied: virtual datasets show those of the run, whose files must stay beside.
"""

from pathlib import Path
from typing import Any

import numpy as np

from barchan.io import writing
from barchan.io.frames import FrameFile
from barchan.io.hdf5 import Root, h5py
from barchan.io.run_folder import RunFolder
from barchan.io.vtkhdf import SMALL, Surface, begun, new_file, place_of, top_group, write_mesh

VERSION = (2, 0)
CELLS = ("Vertices", "Lines", "Polygons", "Strips")  # of poly data, in the order of their offsets
NUMBERS = "numbers"  # beside VTKHDF: 0, 1, 2, ..., of which cells that are points are made


def write(run: RunFolder, bodies: Surface | None = None) -> list[Path]:
    """Writes grains.vtkhdf, spheres.vtkhdf, fields.vtkhdf and bodies.vtkhdf in RUN_DIR/vtkhdf anew.

    Frames without grains are left out: readers until VTK 9.5 do not find the cells of the frames after one.

    Parameters
    ----------
    bodies
        surfaces of the bodies of the case; None: there are none

    Returns
    -------
    list of Path
        The files.

    Raises
    ------
    MissingData
        where the run has no frames.
    """
    folder, kinds = begun(run)
    written = []
    for kind, file in kinds:
        written.append(folder / f"{kind}.vtkhdf")
        with file.open() as root, new_file(written[-1]) as out:
            (_add_fields if kind == "fields" else _add_grains)(out, root, file)
    if bodies is not None:
        written.append(folder / "bodies.vtkhdf")
        with new_file(written[-1]) as out:
            _add_bodies(out, bodies)
    writing.only(folder, "*.vtkhdf", {one.name for one in written})
    return written


def _starts(lengths: np.ndarray) -> np.ndarray:
    return np.cumsum(lengths) - lengths


def _common_arrays(root: Root, names: list[str]) -> list[str]:
    """What every frame has."""
    return [array for array in root[names[0]] if all(array in root[name] for name in names)]


def _show(group: Any, to: str, file: FrameFile, wholes: dict[str, Any]) -> None:
    """One array after the other, their first index the longest; `wholes`: by place in the file of the run."""
    first = next(iter(wholes.values()))
    ends = np.cumsum([len(whole) for whole in wholes.values()])
    layout = h5py.VirtualLayout((int(ends[-1]), *first.shape[1:]), first.dtype)
    for (place, whole), end in zip(wholes.items(), ends):
        layout[end - len(whole):end] = h5py.VirtualSource(place_of(file), place, shape=whole.shape)
    group.create_virtual_dataset(to, layout)


def _add_steps(top: Any, times: list[float], topologies: int, **starts: np.ndarray) -> Any:
    """`starts`: offsets (steps) that are not all 0; those of cells and connectivity belong to the first topology."""
    steps, count = top.create_group("Steps"), len(times)
    steps.attrs["NSteps"] = count
    steps["Values"] = np.array(times)
    steps["NumberOfParts"] = np.ones(count, int)
    for name in ("PartOffsets", "PointOffsets"):
        steps[name] = starts.get(name, np.zeros(count, int))
    for name in ("CellOffsets", "ConnectivityIdOffsets"):
        steps[name] = np.zeros((count, topologies), int)
        steps[name][:, 0] = starts.get(name, 0)
    return steps


def _add_poly_cells(top: Any, kind: str, lengths: np.ndarray, corners: int, ids: Any = None) -> Any:
    """Numbers of the cells of one kind in each part; `ids`: what they join, none where there are no cells."""
    cells = top.create_group(kind)
    cells["NumberOfCells"] = lengths
    cells["NumberOfConnectivityIds"] = corners * lengths
    if ids is None:
        cells["Connectivity"] = np.empty(0, int)
        cells["Offsets"] = np.zeros(len(lengths), int)
    return cells


def _add_grains(out: Any, root: Root, file: FrameFile) -> None:
    top = top_group(out, VERSION, "PolyData")
    frames = [(time, name, len(root[name]["id"])) for time, name in file.frames]
    frames = [frame for frame in frames if frame[2] > 0] or frames[:1]
    names = [name for _, name, _ in frames]
    lengths = np.array([length for _, _, length in frames])
    starts = _starts(lengths)
    top["NumberOfPoints"] = lengths
    for array in _common_arrays(root, names):
        place = "Points" if array == "x" else f"PointData/{array}"
        _show(top, place, file, {f"/{name}/{array}": root[name][array].array for name in names})
    _add_vertices(out, top, lengths)
    for kind in CELLS[1:]:
        _add_poly_cells(top, kind, 0 * lengths, 1)
    steps = _add_steps(top, [time for time, _, _ in frames], len(CELLS), PartOffsets=np.arange(len(frames)),
                       PointOffsets=starts, CellOffsets=starts, ConnectivityIdOffsets=starts)
    for array in top["PointData"]:
        steps[f"PointDataOffsets/{array}"] = starts


def _add_vertices(out: Any, top: Any, lengths: np.ndarray) -> None:
    """One for each grain. All steps show the beginning of the same numbers."""
    most = int(lengths.max(initial=0)) + 1
    out.create_dataset(NUMBERS, data=np.arange(most), **SMALL)
    cells = _add_poly_cells(top, CELLS[0], lengths, 1, ids=NUMBERS)
    for name, extra in (("Connectivity", 0), ("Offsets", 1)):
        layout = h5py.VirtualLayout((int((lengths + extra).sum()),), np.int64)
        for start, length in zip(_starts(lengths + extra), lengths + extra):
            if length > 0:
                layout[start:start + length] = h5py.VirtualSource(".", NUMBERS, shape=(most,))[:length]
        cells.create_virtual_dataset(name, layout)


def _add_fields(out: Any, root: Root, file: FrameFile) -> None:
    top = top_group(out, VERSION, "UnstructuredGrid")
    count = write_mesh(top, root["grid"])
    names = [name for _, name in file.frames]
    cells = top.create_group("CellData")

    def show(to: str, arrays: tuple[str, ...]) -> None:
        shape = root[names[0]][arrays[0]].array.shape
        kind = root[names[0]][arrays[0]].array.dtype
        vector = (3,) if len(arrays) > 1 else ()
        layout = h5py.VirtualLayout((len(names) * count, *vector), kind)
        for step, name in enumerate(names):
            for axis, array in enumerate(arrays):
                rows = slice(step * count, (step + 1) * count)
                source = h5py.VirtualSource(place_of(file), f"/{name}/{array}", shape=shape)
                layout[(rows, axis) if vector else rows] = source  # of three dimensions: flat, x fastest
        cells.create_virtual_dataset(to, layout)

    for array in _common_arrays(root, names):
        show(array, (array,))
    show("velocity", ("u", "v", "w"))
    steps = _add_steps(top, [time for time, _ in file.frames], 1)
    for array in cells:
        steps[f"CellDataOffsets/{array}"] = count * np.arange(len(names))


def _add_bodies(out: Any, bodies: Surface) -> None:
    """At rest: without steps, the same at all times."""
    top = top_group(out, VERSION, "PolyData")
    top["NumberOfPoints"] = np.array([len(bodies.points)])
    top.create_dataset("Points", data=bodies.points, **SMALL)
    for kind in CELLS:
        some = bodies.triangles if kind == "Polygons" else None
        cells = _add_poly_cells(top, kind, np.array([0 if some is None else len(some)]), 3, some)
        if some is not None:
            cells.create_dataset("Connectivity", data=some.reshape(-1), **SMALL)
            cells.create_dataset("Offsets", data=3 * np.arange(len(some) + 1), **SMALL)
    top["CellData/body"] = bodies.body
