"""A run as PyVista has it."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from barchan.errors import optional
from barchan.io.frames import FrameFile

if TYPE_CHECKING:
    from barchan.api.run import Run
    from pyvista import MultiBlock


def multi_block(run: Run, t: float | None, frame: int | None) -> MultiBlock:
    """Grains and flow of one time: Run.to_pyvista."""
    pyvista = optional("pyvista", "pyvista")
    grains = run.grains(t, frame)
    points = pyvista.PolyData(grains[["x", "y", "z"]].to_numpy())
    points.point_data["id"] = grains.index.to_numpy()
    for name in grains.columns.drop(["x", "y", "z"]):
        points.point_data[name] = grains[name].to_numpy()
    blocks = pyvista.MultiBlock({"grains": points})
    if run.shapes is not None:
        spheres = run.spheres(t, frame)
        blocks["spheres"] = pyvista.PolyData(spheres[["x", "y", "z"]].to_numpy())
        blocks["spheres"].point_data["d"] = spheres["d"].to_numpy()
        blocks["spheres"].point_data["id"] = spheres.index.to_numpy()
    if run.field_file is not None:
        blocks["flow"] = rectilinear(pyvista, run.field_file, grains.attrs["time"])
    return blocks


def rectilinear(pyvista: Any, file: FrameFile, time: float) -> Any:
    """The mesh and all fields of the frame nearest to `time` [s]."""
    _, name = file.frames[int(np.argmin(abs(file.times - time)))]
    with file.open() as content:
        grid = pyvista.RectilinearGrid(*(content["grid"][f"{axis}_face"][:] for axis in "xyz"))
        for field in content[name]:
            grid.cell_data[field] = content[name][field][:].ravel()  # x fastest, as VTK has it
    return grid
