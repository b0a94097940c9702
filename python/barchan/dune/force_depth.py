"""The force of the water along the stream on the grains of a held heap, by depth below the heap's surface.

The force is drag, pressure gradient and stress over the grain's weight in water, each grain's mean over a window of
time. The depth of a grain counts from the top of the highest grain within one mean diameter along the floor to its own
top. Parts of the heap: upstream of its centroid by more than a fifth of its radius, downstream by as much, and the
crest between.
"""

from collections.abc import Mapping, Sequence
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from barchan.dune.current import ALONG_X
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.stats import within

FORCES = ("force_drag", "force_pressure_gradient", "force_stress")
PARTS = ("upstream", "crest", "downstream")
EDGES = np.array([0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5])  # of depth, in mean diameters


def of_run(run: Any, start: float | None = None, end: float | None = None) -> dict[str, Any]:
    """{part: (mean, RMS in time) by depth} of F_x over the weight; "total" of the whole heap."""
    file = run.frame_file("grains.h5", ("id", "x", "d", *FORCES))
    if file is None:
        raise MissingData("needs grains.h5 with forces (output.grain_forces = true)")
    last = file.times[-1]
    start, end = last / 3 if start is None else start, last if end is None else end
    inside = [name for time, name in file.frames if within(time, start, end)]
    if not inside:
        raise MissingData(f"needs a frame with forces between t = {start:g} s and {end:g} s")
    with file.open() as content:
        samples = [read_frame(content[name], FORCES) for name in inside]
    grains = samples[-1][0]
    force = np.array([along for _, along in samples])
    weight = submerged_weight(run.config, grains.d, grains.kind)
    return by_depth(grains.x, grains.d, force.mean(axis=0) / weight, np.sqrt((force**2).mean(axis=0)) / weight, weight)


def submerged_weight(config: Mapping[str, Any], d: Any, kind: np.ndarray | None) -> Any:
    """Of grains of diameter d [m] in the water of a case [N]. kind (n): of each, needed where there are several."""
    grains, water = config.get("grains", {}), config.get("fluid", {}).get("density", 1000.0)
    gravity = np.linalg.norm(grains.get("gravity", [0, -9.81, 0]))
    density = grains.get("density", 2500.0)
    kinds = np.array([one.get("density", density) for one in grains.get("kind", ())] or [density])
    if len(kinds) > 1 and kind is None:
        raise MissingData("needs grains.h5 with the kind of each grain: kinds may differ in density")
    return ((kinds[0] if len(kinds) == 1 else kinds[kind]) - water) * gravity * np.pi / 6 * d**3


def read_frame(group: Any, names: Sequence[str], way: ArrayLike = ALONG_X) -> tuple[Grains, np.ndarray]:
    """The grains of a frame by id, and the sum of these forces on each along a unit vector (2) [N]."""
    order = np.argsort(group["id"][:])
    number, x, d = (group[name][:][order] for name in ("id", "x", "d"))
    dune, kind = (group[name][:][order] if name in group else None for name in ("dune", "kind"))
    force = np.sum([group[name][:][order].astype(float) for name in names], axis=0)
    grains = Grains(float(group.attrs["time"]), number, x, d.astype(float), dune, kind=kind)
    return grains, force[:, (0, 2)] @ np.asarray(way)


def by_depth(x: np.ndarray, d: np.ndarray, mean: np.ndarray, rms: np.ndarray, weight: np.ndarray) -> dict[str, Any]:
    depths = depth_of(x, d) / d.mean()
    from_centre = x[:, 0] - x[:, 0].mean()
    edge = 0.2 * np.percentile(np.hypot(from_centre, x[:, 2] - x[:, 2].mean()), 99)
    part_of = np.where(from_centre < -edge, 0, np.where(from_centre > edge, 2, 1))
    layer = np.digitize(depths, EDGES) - 1
    result: dict[str, Any] = {"total": float(np.sum(mean * weight) / np.sum(weight))}
    for index, part in enumerate(PARTS):
        inside = [(part_of == index) & (layer == n) for n in range(len(EDGES) - 1)]
        result[part] = tuple(np.array([values[here].mean() if here.any() else np.nan for here in inside])
                             for values in (mean, rms))
    return result


def depth_of(x: np.ndarray, d: np.ndarray) -> np.ndarray:
    """From the highest grain's top within a mean diameter along the floor [m]."""
    from scipy.spatial import cKDTree

    top = x[:, 1] + d / 2
    near = cKDTree(x[:, [0, 2]]).query_ball_point(x[:, [0, 2]], d.mean())
    return np.array([top[neighbours].max() for neighbours in near]) - top
