"""scour: holes under a pipe and around an upright cylinder (benchmark/scour/statement.md).

The depth under a pipe is that of the packed bed below its axis, from its level far upstream at the start, over the
diameter D of the pipe. Times are over T = D^2/sqrt((s - 1) g d^3) theta^(-5/3)/50 (Fredsoe, Sumer & Arnskov 1992).
theta is the Shields number of the flow without the pipe, by Dean's law of friction. Around a cylinder:
docs/dune-measures.md.
"""

import numpy as np

from barchan.dune.bodies import bodies_of
from barchan.dune.scour import BedMap, diameter, history
from barchan.dune.tracks import bed_of
from benchmark.folders import OWN

STUDIES = "benchmark/scour", "benchmark/scour-cylinder"
WIDTH = 0.15  # half that of the strip below the axis, in D
PACKED = 0.3  # solid fraction above which it is bed
LAYER = 0.5  # height of the layers, in d


def level(grains, within, area, d):
    """Height of the bed [m] of the grains `within` an area [m2]: from the floor up, the first layer that is loose."""
    layer = LAYER * d
    volume = np.pi / 6 * np.asarray(grains.d[within], float)**3
    rows = (np.asarray(grains.x[within, 1], float) / layer).astype(int)
    fraction = np.bincount(rows, volume, minlength=4) / (area * layer)
    smooth = np.convolve(np.append(fraction, [0, 0]), np.ones(3) / 3, "same")
    smooth[0] = PACKED + smooth[0]  # grains on the floor have no volume below their lowest point
    loose = np.flatnonzero(smooth < PACKED)
    return (loose[0] if loose.size else smooth.size) * layer


class Pipe:
    def __init__(self, run):
        config = run.config
        body, fluid, grains = config["body"][0], config["fluid"], config["grains"]
        self.x, self.diameter = body["centre"][0], 2 * body["radius"]
        self.size, start = config["domain"]["size"], run.frame(0)
        self.d = float(np.mean(start.d))
        far = np.asarray(start.x[:, 0], float) < self.x - 1.5 * self.diameter
        self.bed = level(start, far, (self.x - 1.5 * self.diameter) * self.size[2], self.d)
        water, speed = self.size[1] - self.bed, fluid["mean_velocity"]
        friction = 0.073 * (2 * water * speed / fluid["kinematic_viscosity"])**-0.25
        stress = friction / 2 * fluid["density"] * speed**2
        heavier = (grains["density"] / fluid["density"] - 1) * -grains["gravity"][1]
        self.shields = stress / (fluid["density"] * heavier * self.d)
        self.time = self.diameter**2 / np.sqrt(heavier * self.d**3) * self.shields**(-5 / 3) / 50

    def depth(self, grains):
        """[m]"""
        within = abs(np.asarray(grains.x[:, 0], float) - self.x) < WIDTH * self.diameter
        return self.bed - level(grains, within, 2 * WIDTH * self.diameter * self.size[2], self.d)


def variant_of(run):
    """The name of the results of a run: our own, or that of a variant of the pipe."""
    return OWN if run.path.name == "base" else f"{OWN}-{run.path.name}"


def around_cylinder(run):
    """Depth of the hole over D and angle of its deepest point (degrees), means over the last third of a run."""
    bodies, times = bodies_of(run), run.need_grains().times
    frames = [run.frame(int(number)) for number in np.flatnonzero(times >= times[-1] * 2 / 3)]
    late = history({one.time: BedMap(one, bed_of(run), bodies) for one in frames}, bodies[0])
    return {"cylinder_depth": ([np.nan], [np.mean([one.depth for one in late]) / diameter(bodies[0])]),
            "cylinder_angle": ([np.nan], [mean_angle([one.angle for one in late])])}


def mean_angle(angles):
    """The direction of the mean of unit vectors, all in degrees, 0 to 360."""
    mean = np.mean(np.exp(1j * np.radians(angles)))
    return float(np.degrees(np.angle(mean)) % 360)


def measure_run(run):
    """Quantity -> (at, value) of one run."""
    if run.config["body"][0].get("axis", "y") == "y":
        return around_cylinder(run)
    pipe, times = Pipe(run), run.need_grains().times
    depth = np.array([pipe.depth(run.frame(number)) for number in range(times.size)])
    return {"pipe_depth": (times / pipe.time, depth / pipe.diameter)}
