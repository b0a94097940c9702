"""The tables of bed load and of the threshold of motion: what is measured of a run, and the fits, on numbers whose
answer is known."""
import json
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
from run_folder import Grains  # noqa: E402
from validation import bed_load, threshold  # noqa: E402

warnings.simplefilter("error")


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


# All versions that computed a table are named, each once.
with tempfile.TemporaryDirectory() as folder:
    runs = [types.SimpleNamespace(path=pathlib.Path(folder) / name) for name in ("rising", "falling", "rising-r2")]
    for run, version in zip(runs, ("aaa", "bbb", "aaa")):
        run.path.mkdir()
        (run.path / "run.json").write_text(json.dumps({"git_hash": version}))
    path = pathlib.Path(folder) / "threshold.csv"
    tables.write(path, {"commit": "aaa", "machine": "one", "date": "d"}, ["falling,realisation", "0,1"])
    said, _ = bed_load.with_earlier(path, {"commit": threshold.versions(runs), "machine": "one", "date": "d"}, [], 2)
    if threshold.versions(runs) != "aaa and bbb" or said["commit"] != "aaa and bbb":
        failures.append(f"versions of a table: {threshold.versions(runs)}, {said}")


# Threshold of motion: windows of a run, where the load goes to zero, and a table with both.
class RisingRun(MadeUpRun):
    """The stress rises by 0.1 Pa a window; of all grains a tenth move, tenfold as fast from the fourth window on.

    The flow gains 0.08 m/s in a second. That pushes the grains by 80 Pa/m times their volume, not the bed's surface.
    """
    config = {**MadeUpRun.config, "coupling": {"forces": ["drag", "torque"]}}
    t = np.arange(1, 201) / 100
    window = np.ceil(t / 0.25 - 1e-9)
    solid = 1000 * math.pi / 6 * 8e-12 / (0.016 * 0.006)  # [m3/m2]
    flux = 1e-5 * scale * 10.0**np.maximum(0, window - 3)
    history = {"t": t, "bulk_velocity": 0.3 + 0.08 * t,
               "stress_on_grains": 0.1 * window + 80 * solid, "grain_flux": flux,
               "grain_kinetic_energy": 0.016 * 0.006 * 2500 * flux**2 / (2 * 0.1 * solid)}


rising = dict(zip(threshold.COLUMNS.split(","), np.array(threshold.measure(RisingRun)).T))
expect_near("Shields number of the fifth window", rising["shields"][2], 0.5 / (1500 * 9.81 * 2e-4), 1e-6)
expect_near("q* of the fifth window", rising["q_star"][2], 1e-3, 1e-6)
for load in rising["load"]:
    expect_near("load of a tenth of the grains", load, 0.1 * RisingRun.solid / 2e-4, 1e-6)
if [rising[name][0] for name in threshold.CASE] != [0.1, 1, 0] or rising["realisation"][0] != 2:
    failures.append(f"the case is not named: {rising}")
expect_near("half way between two windows", threshold.passing(10**-2.5)(tables.Table({}, rising)),
            0.55 / (1500 * 9.81 * 2e-4), 1e-6)


def rows_of(begin, number, *, case="0,0,0", scatter=0.0, top=0.2):
    """A run whose load and flux begin at a known Shields number: windows at rest, then M = (s - begin)/2."""
    s = np.linspace(0.05, top, 16)
    noise = 1 + scatter * np.random.default_rng(number).standard_normal(s.size)
    excess = np.maximum(0, s - begin)
    return [f"{case},{number},{0.5 + 0.25 * n},{s[n]},{2 * excess[n]**1.5 * noise[n]},{0.5 * excess[n] * noise[n]}"
            for n in range(s.size)]


def found_in(folder, *runs):
    tables.write(pathlib.Path(folder) / "threshold.csv", {"title": "made up"}, [threshold.COLUMNS, *sum(runs, [])])
    cases = threshold.cases_of(tables.read_saved(pathlib.Path(folder), "threshold"))
    return [{kind: threshold.with_error(case.rows, found) for kind, found in threshold.FOUND.items()} for case in cases]


with tempfile.TemporaryDirectory() as folder:
    # Without scatter both lines give the truth, to the step of 1e-4 in which it is sought.
    for begin in (0.0653, 0.1217):
        single, = found_in(folder, rows_of(begin, 1))
        for kind in ("load", "flux"):
            expect_near(f"zero of the {kind}", single[kind][0], begin, 1.1e-4 / begin)
            if not math.isnan(single[kind][1]):
                failures.append("one run has an error")
    # A threshold is no level: where the flux begins at 0.1217, q* = 0.01 comes (0.005)^(2/3) later.
    levels = threshold.passing(1e-2)(tables.read_saved(pathlib.Path(folder), "threshold"))
    if not 0.1217 + 0.01 < levels < 0.1217 + 0.05:
        failures.append(f"q* = 0.01 is passed at {levels:.3g}")
    # Windows above q* = 0.1, where the load bends upwards, do not count.
    bent = [f"0,0,0,1,9,{s},{2 * (s - 0.1)**1.5},{4 * (s - 0.1)}" for s in (0.3, 0.35)]
    expect_near("zero beside a bent load", found_in(folder, rows_of(0.1, 1) + bent)[0]["load"][0], 0.1, 2e-3)
    # A fifth of scatter: the truth lies within three standard errors of four realisations, and they are not wide.
    value, error = found_in(folder, *(rows_of(0.1, n, scatter=0.2) for n in (1, 2, 3, 4)))[0]["load"]
    if not (0 < error < 0.01 and abs(value - 0.1) < 3 * error):
        failures.append(f"scattered: {value:.4f} +- {error:.4f}, not 0.1")
    # Two realisations that begin 0.02 apart: half of it is the error of their mean.
    two, = found_in(folder, rows_of(0.09, 1), rows_of(0.11, 2))
    expect_near("error of two realisations", two["load"][1], 0.01, 0.02)
    # A bed at rest has no threshold; rising and falling runs are told apart, and drawn with one run and with several.
    rest, = found_in(folder, rows_of(0.3, 1))
    if not all(math.isnan(value) for value, _ in rest.values()):
        failures.append(f"a bed at rest has a threshold: {rest}")
    threshold.draw(pathlib.Path(folder))
    found_in(folder, rows_of(0.12, 1), rows_of(0.12, 2), rows_of(0.08, 1, case="0.1,1,1"))
    threshold.draw(pathlib.Path(folder))
    lines = list(threshold.summary(pathlib.Path(folder)))
    if not (lines[0].startswith("rising, mu_r = 0 | 2 | 0.120 +- 0.000 | 0.120 +- 0.000 | ")
            and lines[1].startswith("falling, mu_r = 0.1, torque | 1 | 0.080 | 0.080 | ")):
        failures.append(f"thresholds: {lines}")

end("bed_load", "a run measured, the law fitted, the threshold found")
