"""column: a granular column that collapses in a viscous liquid (benchmark/column/statement.md).

Front and heights are over those of the column at the start, pressures over the weight of its grains under water on the
base, times over H/V: H is its height, V = (rho_s - rho_f) g d^2/(18 mu). The front is where the bed, seen from the
wall, becomes thinner than a grain. The excess pressure is the mean over the probes at the base less that far away, in
bins of `BIN` of the time.
"""

import numpy as np

from barchan.errors import MissingData
from benchmark.folders import OWN

STUDIES = ("benchmark/column",)
LENGTH = 40  # of the column, in diameters
PACKED = 0.6  # solid fraction that makes heights of volumes
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
    """Places from the wall [m] and heights of the surface [m]: that of the highest grains, over bins of CELLS."""
    edges = np.arange(0, reach + CELLS / 2, CELLS) * scales.d
    place = np.asarray(grains.x[:, 0], float) - scales.wall
    top = np.asarray(grains.x[:, 1] + grains.d / 2, float)
    bins = np.floor(place / (CELLS * scales.d)).astype(int)
    found = [np.percentile(top[bins == number], 95) if np.sum(bins == number) > 3 else 0.0
             for number in range(len(edges) - 1)]
    return (edges[1:] + edges[:-1]) / 2, np.array(found)


def front(grains, scales):
    """Distance of the front from the wall [m]."""
    volume = np.pi / 6 * np.asarray(grains.d, float)**3
    place = np.asarray(grains.x[:, 0], float) - scales.wall
    bins = np.floor(place / (CELLS * scales.d)).astype(int)
    inside = bins >= 0
    depth = np.bincount(bins[inside], volume[inside]) / (PACKED * CELLS * scales.d * scales.width)
    thin = np.flatnonzero(depth < scales.d)
    return (thin[0] if thin.size else depth.size) * CELLS * scales.d


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


def variant_of(run):
    """The name of the results of a run: our own, or those of a more viscous liquid."""
    return f"{OWN}-viscous" if "viscous" in run.path.name else OWN


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
