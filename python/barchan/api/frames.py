"""Grains of frames as tables: what Run gives."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from barchan.errors import BarchanError
from barchan.io import clumps, labelled
from barchan.io.frames import FrameFile, Grains, names_of
from barchan.io.progress import Progress
from barchan.io.units import of_arrays

if TYPE_CHECKING:
    from pandas import DataFrame


def grains_of(file: FrameFile, index: int) -> DataFrame:
    """The grains of frame `index`: Run.grains."""
    time, name = file.frames[index]
    with file.open() as content:
        group = content[name]
        order = np.argsort(group["id"][:])
        found = {key: group[key][:][order] for key in group}
        kinds = names_of(group, "kind")
        about = of_arrays(group, list(found))
    grains = labelled.grains_frame(time, found, about)
    grains.attrs["kinds"] = kinds
    return grains


def spheres_of(grains: Grains) -> DataFrame:
    """The spheres of the grains: Run.spheres."""
    spheres = clumps.spheres_of(grains)
    columns = {"id": grains.id[spheres.grain], "x": spheres.x, "d": spheres.d}
    about = {"id": ("1", "number of the grain"), "x": ("m", "position of the centre"), "d": ("m", "diameter")}
    return labelled.grains_frame(grains.time, columns, about)


def track(file: FrameFile, ids: Sequence[int], progress: bool) -> DataFrame:
    """Where grains are in every frame of a file: Run.track."""
    wanted = np.unique(np.asarray(ids))
    if wanted.size and wanted.dtype.kind not in "iu":
        raise BarchanError("ids must be whole numbers, such as run.grains().index")
    parts: list[dict[str, np.ndarray]] = []
    with file.open() as content:
        for time, name in Progress(file.frames, "following grains", progress):
            number = content[name]["id"][:]
            rows = np.nonzero(np.isin(number, wanted))[0]
            x = content[name]["x"][:][rows].astype(float)
            parts.append({"id": number[rows], "t": np.full(len(rows), time), **dict(zip("xyz", x.T))})
        arrays = of_arrays(content[file.frames[-1][1]], ["id", "x"])
    joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
    if wanted.size and not len(joined["id"]):
        raise BarchanError(f"no frame of {file.path} has a grain with one of these ids")
    order = np.lexsort((joined["t"], joined["id"]))
    about = {"t": ("s", "time")} | arrays | ({axis: arrays["x"] for axis in "xyz"} if "x" in arrays else {})
    return labelled.data_frame({name: values[order] for name, values in joined.items()}, about)
