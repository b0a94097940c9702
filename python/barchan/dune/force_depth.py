"""The force of the water along the stream on the grains of a held heap, by depth below the heap's surface.

The force is drag, pressure gradient and stress over the grain's weight in water, each grain's mean over a window of
time. The depth of a grain counts from the top of the highest grain within one mean diameter along the floor to its own
top. Parts of the heap: upstream of its centroid by more than a fifth of its radius, downstream by as much, and the
crest between.
"""

from collections.abc import Mapping
from typing import Any

import numpy as np

from barchan.errors import MissingData
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
        samples = [read_frame(content[name]) for name in inside]
    x, d, _ = samples[-1]
    force = np.array([sample[2] for sample in samples])
    weight = submerged_weight(run.config, d)
    return by_depth(x, d, force.mean(axis=0) / weight, np.sqrt((force**2).mean(axis=0)) / weight, weight)


def submerged_weight(config: Mapping[str, Any], d: Any) -> Any:
    """Of grains of diameter d [m] in the water of a case [N]."""
    grains, water = config.get("grains", {}), config.get("fluid", {}).get("density", 1000.0)
    gravity = np.linalg.norm(grains.get("gravity", [0, -9.81, 0]))
    return (grains.get("density", 2500.0) - water) * gravity * np.pi / 6 * d**3


def read_frame(group: Any) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
    """x (n, 3) [m], d (n) [m], force along x (n) [N], by id."""
    order = np.argsort(group["id"][:])
    force = sum(group[name][:, 0] for name in FORCES)
    return group["x"][:][order], group["d"][:][order].astype(float), force[order].astype(float)


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
