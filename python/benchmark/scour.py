"""scour: holes under a pipe and around an upright cylinder (benchmark/scour/statement.md).

The depth under a pipe is that of the packed bed below its axis, from its level far upstream at the start, over the pipe's
diameter D. Times are over T = D^2/sqrt((s - 1) g d^3) theta^(-5/3)/50 (Fredsoe, Sumer & Arnskov 1992), theta being the
Shields number of the flow without the pipe, by Dean's law of friction.
"""

import numpy as np

STUDIES = ("benchmark/scour",)
RUNS = "benchmark/scour"
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


def measure_run(run):
    """Quantity -> (at, value) of one run."""
    pipe, times = Pipe(run), run.need_grains().times
    depth = np.array([pipe.depth(run.frame(number)) for number in range(times.size)])
    return {"pipe_depth": (times / pipe.time, depth / pipe.diameter)}
