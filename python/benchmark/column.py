"""column: a granular column that collapses in a viscous liquid (benchmark/column/statement.md).

Front and heights are over those of the column at the start, pressures over the weight of its grains under water on the
base, times over H/V: H is its height, V = (rho_s - rho_f) g d^2/(18 mu). The front is where the bed, seen from the
wall, becomes thinner than a grain. The excess pressure is the mean over the probes at the base less that far away, in
bins of `BIN` of the time.
"""

import numpy as np

from barchan.errors import MissingData

STUDIES = ("benchmark/column",)
LENGTH = 40  # of the column, in diameters
PACKED = 0.6  # solid fraction that makes depths of volumes
BIN = 0.04
CELLS = 2.0  # diameters along x in which a height is measured
PROFILE_TIMES = {"loose": 0.283, "dense": 0.969}  # 4 and 12 s of the experiment


class Scales:
    def __init__(self, run):
        start, config = run.frame(0), run.config
        self.d, wall = float(np.mean(start.d)), config["body"][0]
        self.wall, self.width = wall["centre"][0] + wall["size"][0] / 2, config["domain"]["size"][2]
        self.length = LENGTH * self.d
        fluid, gravity = config["fluid"], -config["grains"]["gravity"][1]
        heavier = config["grains"]["density"] - fluid["density"]
        self.weight = heavier * gravity * np.sum(np.pi / 6 * start.d.astype(float)**3) / (self.length * self.width)
        self.height = float(np.mean(heights(start, self, LENGTH)[1][2:-2]))
        fall = heavier * gravity * self.d**2 / (18 * fluid["density"] * fluid["kinematic_viscosity"])
        self.time = self.height / fall


def heights(grains, scales, reach):
    """Places from the wall [m] and heights [m]: the mean of the highest grains of squares of CELLS across the slice."""
    cell = CELLS * scales.d
    shape = round(reach / CELLS), max(1, round(scales.width / cell))
    along = np.floor((np.asarray(grains.x[:, 0], float) - scales.wall) / cell).astype(int)
    across = np.floor(np.asarray(grains.x[:, 2], float) / scales.width * shape[1]).astype(int) % shape[1]
    seen, top = (along >= 0) & (along < shape[0]), np.zeros(shape)
    np.maximum.at(top, (along[seen], across[seen]), np.asarray(grains.x[seen, 1] + grains.d[seen] / 2, float))
    return (np.arange(shape[0]) + 0.5) * cell, top.mean(axis=1)


def front(grains, scales):
    """Distance of the front from the wall [m]: where a line through the depths of the bins falls below a grain."""
    volume = np.pi / 6 * np.asarray(grains.d, float)**3
    place = np.asarray(grains.x[:, 0], float) - scales.wall
    bins = np.floor(place / (CELLS * scales.d)).astype(int)
    inside = bins >= 0
    depth = np.bincount(bins[inside], volume[inside]) / (PACKED * CELLS * scales.d * scales.width)
    depth = np.append(depth, 0.0)
    thin = int(np.flatnonzero(depth < scales.d)[0])
    before = depth[thin - 1] if thin > 0 else scales.d
    share = (before - scales.d) / (before - depth[thin]) if before > depth[thin] else 0.0
    return (thin - 0.5 + share) * CELLS * scales.d


def excess(run):
    """Times (n) and excess pressure [Pa] at the base."""
    if run.probe_columns is None:
        raise MissingData(f"needs probes.csv in {run.path}")
    base, far = (run.probe_columns[name] for name in ("base", "far"))
    times, at = np.unique(base["t"], return_inverse=True)
    count = np.bincount(at)
    whole = times[(count == count.max()) & np.isin(times, far["t"])]
    mean = np.bincount(at, base["p"]) / count
    return whole, mean[np.isin(times, whole)] - far["p"][np.isin(far["t"], whole)]


def measure_run(run):
    """Quantity -> (at, value) of one run."""
    scales, name = Scales(run), run.path.name.split("-")[0]
    times = run.need_grains().times
    place = np.array([front(run.frame(number), scales) for number in range(times.size)])
    t, pressure = excess(run)
    bins = np.floor(t / scales.time / BIN).astype(int)
    middle = np.array([np.mean(t[bins == n]) for n in np.unique(bins)]) / scales.time
    mean = np.array([np.mean(pressure[bins == n]) for n in np.unique(bins)]) / scales.weight
    found = {f"{name}_front": (times / scales.time, place / scales.length), f"{name}_pressure": (middle, mean)}
    late = PROFILE_TIMES[name]
    if times[-1] >= late * scales.time:
        frame = run.frame(int(np.argmin(abs(times - late * scales.time))))
        along, high = heights(frame, scales, 4 * LENGTH)
        found[f"{name}_profile"] = along / scales.length, high / scales.height
    return found
