"""The table of bed load in laminar flow: what is measured of a run, on built runs whose answer is known."""
import math
import pathlib
import sys
import tempfile
import types
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(ROOT / "analysis"), str(ROOT / "tests/support")]
import tables  # noqa: E402
from checks import end, expect_near, failures  # noqa: E402
from run_folder import Grains, NotInRun  # noqa: E402
from validation import bed_load, laminar_bed  # noqa: E402

warnings.simplefilter("error")


class BuiltRun:
    """Three layers of 80 grains of 1 mm over 10 x 10 mm, and a fast one above them; ten frames in the second half."""
    path = "built"
    config = {"domain": {"size": [0.01, 0.012, 0.01]}, "initial": {"realisation": 2},
              "fluid": {"density": 1000.0, "kinematic_viscosity": 2e-4, "mean_velocity": 0.02,
                        "first_cell_height": 5e-4},
              "grains": {"density": 2100.0, "gravity": [0, -9.81, 0], "sliding_friction": 0.6},
              "coupling": {"smoothing_length": 1.5e-3, "forces": ["drag", "torque"]}}
    times = np.arange(1, 21) / 2
    step = np.where(times <= 5, 50.0, 1 + 2 * (np.ceil(times) % 2))  # blocks of one second: 1 and 3 in turn
    history = {"t": times, "grain_flux": 1e-7 * step}
    speeds = np.repeat([1e-4, 4e-4, 1.6e-3, 1.0], (80, 80, 80, 1))

    def need_grains(self):
        return types.SimpleNamespace(times=self.times)

    def grains(self, index):
        count = len(self.speeds)
        x, u = np.full((count, 3), 0.005), np.zeros((count, 3))
        x[:, 1] = np.repeat([5e-4, 1.5e-3, 2.5e-3, 4e-3], (80, 80, 80, 1))
        u[:, 0] = self.speeds * self.step[index]
        return Grains(self.times[index], np.arange(count), x, np.full(count, 1e-3), u=u)


# The top layer fills 80 pi (r^2 - h^2) of the area at a distance h from its middle: 0.05 there is the bed's surface.
row = dict(zip(laminar_bed.COLUMNS.split(","), laminar_bed.measure(BuiltRun())))
solid = 241 * math.pi / 6 * 1e-9
bed = 2.5e-3 + math.sqrt(0.25e-6 - 0.05 * 1e-4 / (80 * math.pi))
fluid_flux = 0.02 * (0.012 - solid / 1e-4)
layers = 5e-4 * (1e-4 + 4e-4 + 1.6e-3)
blocks = np.array([1, 3, 1, 3, 1])
blocks = blocks if BuiltRun.step[-1] == 1 else 4 - blocks
galileo = math.sqrt(1.1 * 9.81 * 1e-9) / 2e-4
known = {"reynolds": fluid_flux / 2e-4, "row_height": 0.5, "smoothing_length": 1.5, "sliding_friction": 0.6,
         "torque": 1, "realisation": 2, "seconds": 5, "fluid_height": (0.012 - bed) / 1e-3,
         "shields": 6 * fluid_flux / 2e-4 / galileo**2 * (1e-3 / (0.012 - bed))**2,
         "velocity_flux": np.mean(blocks) * layers / fluid_flux,
         "velocity_flux_deviation": np.std(blocks) * layers / fluid_flux,
         "volume_flux": np.mean(blocks) * 1e-7 / fluid_flux,
         "volume_flux_deviation": np.std(blocks) * 1e-7 / fluid_flux}
if set(known) != set(row):
    failures.append(f"columns: {sorted(row)}")
for name, expected in known.items():
    expect_near(name, row[name], expected, 3e-3)  # the surface is known to a twentieth of a layer of d/20

# The solid fraction adds up to the volume of the grains, wherever the levels cut them.
levels = np.linspace(-1e-3, 5e-3, 14)
fraction = laminar_bed.solid_fraction(BuiltRun().grains(0), 1e-4, levels)
expect_near("solid volume", np.sum(fraction * np.diff(levels)) * 1e-4, solid, 1e-12)

# A fraction that falls linearly from 0.6 to 0 over a metre is 0.05 after 11/12 m; a gap below does not count.
levels = np.linspace(0, 1.1, 45)
falling = np.maximum(0, 0.6 * (1 - (levels[1:] + levels[:-1]) / 2))
falling[4] = 0
expect_near("surface", laminar_bed.surface(falling, levels), 11 / 12, 1e-9)


class FullRun(BuiltRun):
    """Grains up to the lid."""
    config = {**BuiltRun.config, "domain": {"size": [0.01, 0.003, 0.01]}}


class ShortRun(BuiltRun):
    times = BuiltRun.times[-4:]


for run, lack in (FullRun(), "clear liquid"), (ShortRun(), "5 frames"):
    try:
        laminar_bed.measure(run)
        failures.append(f"measured without {lack}")
    except NotInRun as reason:
        if lack not in str(reason):
            failures.append(f"without {lack}: {reason}")


def line(case, rows, realisation, flux):
    return f"{case['reynolds']},{rows},1.5,0.6,0,{realisation},4,{case['height_resolved']},0.3,{flux},1e-4,1e-3,1e-4"


# Table, figure and summary: two runs of A9 with d/2, one with thick rows, one run of A1. One run draws, too.
cases = {case["case"]: case for case in laminar_bed.references()}
lines = [line(cases["A9"], 0.5, 1, 7e-3), line(cases["A9"], 0.5, 2, 8e-3), line(cases["A9"], 1.3, 1, 1e-3),
         line(cases["A1"], 0.5, 1, 6e-3)]
with tempfile.TemporaryDirectory() as name:
    folder = pathlib.Path(name)
    tables.write(folder / "laminar_bed.csv", {"title": "built"}, [laminar_bed.COLUMNS, *lines])
    figure = laminar_bed.draw(folder)
    tables.write(folder / "laminar_bed.csv", {"title": "one run"}, [laminar_bed.COLUMNS, lines[-1]])
    laminar_bed.draw(folder)
    tables.write(folder / "laminar_bed.csv", {"title": "built"}, [laminar_bed.COLUMNS, *lines])
    said = list(laminar_bed.summary(folder))
    _, merged = bed_load.with_earlier(folder / "laminar_bed.csv", {"commit": "b", "machine": "m", "date": "d"},
                                      [line(cases["A9"], 0.5, 2, 9e-3)], laminar_bed.KEYS)
if len(merged) != 4 or sum(",0.009," in text for text in merged) != 1:
    failures.append(f"a run done again does not replace its row: {merged}")
expected = ["A1 | 0.5, 1.5, 0.6, 0 | 1 | 7.15 | 0.300 | 6.00e-3 +- 0.10e-3 | 6.71e-3 | 12.00e-3 | 1.00e-3",
            "A9 | 0.5, 1.5, 0.6, 0 | 2 | 10.33 | 0.300 | 7.50e-3 +- 0.71e-3 | 7.61e-3 | 8.20e-3 | 1.00e-3",
            "A9 | 1.3, 1.5, 0.6, 0 | 1 | 10.33 | 0.300 | 1.00e-3 +- 0.10e-3 | 7.61e-3 | 8.20e-3 | 1.00e-3"]
if said != expected:
    failures.append(f"summary: {said}")
labels = figure.axes[0].get_legend_handles_labels()[1] + figure.axes[1].get_legend_handles_labels()[1]
if "Barchan, rows of 0.5 $d$" not in labels or "A9" not in labels or "A1" in labels:
    failures.append(f"legends: {labels}")

# The papers' own numbers agree with the definition of the Shields number: Ga = 0.397.
for case in cases.values():
    shields = 6 * case["reynolds"] / 0.397**2 / case["height_resolved"]**2
    expect_near(f"Shields number of {case['case']}", shields, case["shields_resolved"], 1e-2)  # three figures

end("laminar_bed", "surface, fluxes and Shields number of a built run; table and figure")
