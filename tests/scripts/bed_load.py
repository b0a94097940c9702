"""The tables of bed load and of the threshold of motion: what is measured of a run, and the fits, on numbers whose
answer is known."""
import math
import pathlib
import sys
import tempfile
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import tables  # noqa: E402
from run_folder import Grains  # noqa: E402
from validation import bed_load, threshold  # noqa: E402

warnings.simplefilter("error")

failures = []


def expect_near(what, value, expected, tolerance):
    if not abs(value - expected) <= tolerance * abs(expected):
        failures.append(f"{what}: {value:.6g}, not {expected:.6g}")


class MadeUpRun:
    """1,000 grains of 0.2 mm over 16 x 6 mm: 2e-7 m2/s under 20 Pa/m from 2 s on, something else before."""
    config = {"domain": {"size": [0.016, 0.0137, 0.006]}, "grains": {"density": 2500.0, "rolling_friction": 0.1},
              "coupling": {"smoothing_length": 3e-4}, "fluid": {"mean_velocity": 0.3}, "initial": {"realisation": 2}}
    t = np.arange(1, 801) / 100
    second = np.floor(t - 0.005) % 2  # blocks of one second: 1e-7 and 3e-7 in turn
    history = {"t": t, "grain_flux": np.where(t > 2, 1e-7 + 2e-7 * second, 1.0),
               "pressure_gradient": np.where(t > 2, 20.0, 90.0)}

    @staticmethod
    def grains(index):
        return Grains(0.0, np.arange(1000), np.zeros((1000, 3)), np.full(1000, 2e-4, np.float32))


row = dict(zip(bed_load.COLUMNS.split(","), bed_load.measure(MadeUpRun)))
stress = 20 * (0.0137 - 1000 * math.pi / 6 * 8e-12 / (0.58 * 0.016 * 0.006))
scale = math.sqrt(1.5 * 9.81 * 8e-12)
known = {"seconds": 6, "stress": stress, "shields": stress / (1500 * 9.81 * 2e-4), "flux": 2e-7, "q_star": 2e-7 / scale,
         "grain_reynolds": math.sqrt(stress / 1000) * 2e-4 / 1e-6, "q_star_deviation": 1e-7 / scale}
for name, expected in known.items():
    expect_near(name, row[name], expected, 5e-3)
if (row["realisation"], row["mean_velocity"], row["rolling_friction"]) != (2, 0.3, 0.1):
    failures.append(f"the run is not named: {row}")

# Wong & Parker's law comes back; points at rest do not count; scatter gives an error that holds the truth.
shields = np.repeat([0.03, 0.08, 0.12, 0.16, 0.2], 3)
exact = bed_load.wong_parker(shields)
for number, value, expected in zip(("slope", "threshold"), bed_load.fit(shields, exact), (3.97, 0.0495)):
    expect_near(number, value, expected, 1e-9)
scattered = exact * np.exp(0.2 * np.random.default_rng(3).standard_normal(shields.size))
(slope, begin), (slope_error, begin_error) = bed_load.fit_with_errors(shields, scattered)
if not (0 < slope_error < slope and 0 < begin_error < 0.02):
    failures.append(f"errors of the fit: {slope_error:.3g}, {begin_error:.3g}")
if abs(slope - 3.97) > 3 * slope_error or abs(begin - 0.0495) > 3 * begin_error:
    failures.append(f"the truth lies outside the errors: {slope:.3g}, {begin:.3g}")
if not math.isnan(bed_load.fit(shields, 0 * shields)[0]):
    failures.append("a bed at rest has a slope")

# The published laws at one point each, by hand: T = 0.1/0.04874 - 1 for van Rijn.
expect_near("van Rijn at 0.1", float(bed_load.van_rijn(0.1)), 0.053 * (0.1 / 0.04874 - 1)**2.1 / 4.9**0.3, 1e-3)
expect_near("Wong & Parker at 0.0995", float(bed_load.wong_parker(0.0995)), 3.97 * 0.05**1.5, 1e-12)

# The figure says the threshold that it fits, and draws a study that has one run as well.
with tempfile.TemporaryDirectory() as folder:
    rows = [f"{friction},3e-4,{0.2 + s},{n + 1},10,0,{s},3,0,{float(bed_load.wong_parker(s)) * (1 + 0.1 * n)},0"
            for friction in (0.1, 0) for s in (0.03, 0.08, 0.12, 0.2) for n in range(3)]
    for lines in rows[:1], rows:
        tables.write(pathlib.Path(folder) / "bed_load.csv", {"title": "made up"}, [bed_load.COLUMNS, *lines])
        labels = bed_load.draw(pathlib.Path(folder)).axes[0].get_legend_handles_labels()[1]
    if not any(label.startswith("$\\mu_r$ = 0.1, threshold 0.0") for label in labels):
        failures.append(f"the legend has no threshold: {labels}")


# A table grows from several machines: a run done again replaces its row, the others stay, the notes name all.
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder) / "bed_load.csv"
    tables.write(path, {"title": "t", "commit": "aaa", "machine": "one", "date": "d"}, [bed_load.COLUMNS, *rows[:5]])
    again = rows[4].replace(",10,", ",11,")
    said, merged = bed_load.with_earlier(path, {"commit": "bbb", "machine": "one", "date": "e"}, [again, rows[5]])
    if said != {"commit": "aaa and bbb", "machine": "one", "date": "d and e"}:
        failures.append(f"notes of two tables: {said}")
    seconds = [row.split(",")[4] for row in merged]
    if seconds != ["10", "10", "10", "10", "11", "10"]:
        failures.append(f"rows of two tables: {merged}")


# Threshold of motion: windows of a run, the stress at which the flux passes a level, and a table with both.
class RisingRun(MadeUpRun):
    """The stress rises by 0.1 Pa a window, the flux tenfold from the fourth window on."""
    t = np.arange(1, 201) / 100
    window = np.ceil(t / 0.25 - 1e-9)
    history = {"t": t, "stress_on_grains": 0.1 * window, "grain_flux": 1e-5 * scale * 10.0**np.maximum(0, window - 3)}


rising = np.array(threshold.measure(RisingRun))
expect_near("Shields number of the fifth window", rising[2, 0], 0.5 / (1500 * 9.81 * 2e-4), 1e-6)
expect_near("q* of the fifth window", rising[2, 1], 1e-3, 1e-6)
expect_near("half way between two windows", threshold.passing(*rising.T, 10**-2.5), 0.55 / (1500 * 9.81 * 2e-4), 1e-6)
if not math.isnan(threshold.passing(np.array([0.1, 0.2]), np.array([0.0, 1e-5]), 1e-3)):
    failures.append("a bed at rest has a threshold")
with tempfile.TemporaryDirectory() as folder:
    rows = [f"{forces},{n + 1},{s + shift * (n - 1)},{10**(20 * s - 6)}" for n in range(3)
            for forces, shift in (("as_in_the_paper", 0), ("lift", 0.01)) for s in (0.1, 0.15, 0.2)]
    for kept in rows[:3], rows:
        tables.write(pathlib.Path(folder) / "threshold.csv", {"title": "made up"}, [threshold.COLUMNS, *kept])
        threshold.draw(pathlib.Path(folder))
    lines = list(threshold.summary(pathlib.Path(folder)))
# Three realisations shifted by one standard deviation of 0.01: the error of their mean is 0.01/sqrt(3).
if lines[0] != "as_in_the_paper | 0.150 +- 0.000 | 0.200 +- 0.000" or not lines[1].endswith("+- 0.006"):
    failures.append(f"thresholds: {lines}")

for failure in failures:
    print(f"bed_load: {failure}", file=sys.stderr)
print("bed_load: a run measured, the law fitted, the threshold found")
sys.exit(bool(failures))
