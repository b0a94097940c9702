"""Laws over the size of a dune: studies whose laws are known, exact and with scatter."""
import contextlib
import io
import json
import pathlib
import sys
import tempfile
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import laws  # noqa: E402
import means_study  # noqa: E402
import style  # noqa: E402
from run_folder import NotInRun  # noqa: E402
from study_folder import StudyFolder  # noqa: E402

warnings.simplefilter("error")
style.use()
random = np.random.default_rng(11)
failures = []
SIZES = {"3k": 8e-3, "10k": 12e-3, "30k": 18e-3, "100k": 27e-3}  # L [m]
D = 2e-4
COLUMNS = "t,dune,n_grains,W,L,H,Cx,Cz,horn_left,horn_right,celerity,volume,horn_left_2d,horn_right_2d"


def expect_near(what, value, expected, tolerance):
    if not abs(value - expected) <= tolerance:
        failures.append(f"{what}: {value:.6g}, not {expected:.6g} +- {tolerance:.2g}")


def write_run(folder, length, scatter):
    """c = 2e-5/L, W = 2 mm + 0.9 L, H = 0.3 mm + 0.08 L, a loss of 1e-6/L^2 a second; horns of 0.3 L from t = 200 L."""
    t = np.arange(121) / 10
    c, w, h, loss = (scatter() * value for value in (2e-5 / length, 2e-3 + 0.9 * length, 3e-4 + 0.08 * length,
                                                     1e-6 / length**2))
    n = 3e4 * np.exp(-loss * t)
    horns = np.where(t >= 200 * length - 1e-9, 0.3 * length, 0)
    columns = [t, 0 * t, n, w + 0 * t, length + 0 * t, h + 0 * t, 0.01 + c * t, 0 * t, horns, horns, c + 0 * t,
               n * np.pi / 6 * D**3, horns, horns]
    folder.mkdir()
    np.savetxt(folder / "dune.csv", np.transpose(columns), delimiter=",", header=COLUMNS, comments="", fmt="%.12g")
    (folder / "run.json").write_text('{"status": "done"}')


def write_study(folder, noise):
    """Three realisations of four sizes."""
    cases = []
    for name, length in SIZES.items():
        for r in (1, 2, 3):
            run = name if r == 1 else f"{name}-r{r}"
            write_run(folder / run, length, lambda: float(np.exp(noise * random.standard_normal())))
            cases.append({"name": run, "case": name, "folder": run, "realisation": r, "varied": None, "values": {}})
    (folder / "study.json").write_text(json.dumps({"title": "sizes", "cases": cases}))
    return StudyFolder(folder)


KNOWN = {"celerity": -1, "W": 0.9, "H": 0.08, "horn": 0.3, "loss": -2, "formation_time": 1}
for noise in (0, 0.1):
    with tempfile.TemporaryDirectory() as folder:
        study = write_study(pathlib.Path(folder), noise)
        table = laws.measure(study, None, None)
        if len(table["L"]) != 12 or sorted(set(table["realisation"])) != [1, 2, 3]:
            failures.append(f"{len(table['L'])} runs, not 12")
        for name, n in KNOWN.items():
            law = laws.fit(table["L"], table[name], laws.QUANTITIES[name][2])
            # A decay is a straight line over six seconds to 1 % of its slope, horns appear at a time of the table.
            exact = 0.06 if name in ("loss", "formation_time") else 1e-6
            expect_near(f"{name}, scatter {noise}", law.n, n, exact + (2 * law.interval if noise else 0))
            if noise and name in ("celerity", "W", "H", "loss") and not 0.005 * abs(n) < law.interval < abs(n):
                failures.append(f"{name}: the interval is {law.interval:.3g}")
        lengths = np.array(list(SIZES.values()))
        if not noise:
            expect_near("celerity at 20 mm", laws.fit(table["L"], table["celerity"], "power")(0.02), 1e-3, 1e-9)
            expect_near("height at 20 mm", laws.fit(table["L"], table["H"], "line")(0.02), 1.9e-3, 1e-9)
            expect_near("formation times", max(abs(table["formation_time"][::3] - 200 * lengths)), 0, 0.11)
        laws.draw(study)
        lines = (study.path / "figures_data/laws.csv").read_text().splitlines()
        if len(lines) != 13 or not lines[0].startswith("case,realisation,grains,L,W,H,celerity"):
            failures.append(f"laws.csv: {lines[:1]}, {len(lines)} lines")
        said = io.StringIO()
        with contextlib.redirect_stdout(said):
            means_study.draw(study)
        table = dict(line.strip("| ").split(" | ", 1) for line in said.getvalue().splitlines() if " | " in line)
        if table["mean +- standard deviation"] != "3k (3) | 10k (3) | 30k (3) | 100k (3)":
            failures.append(f"means: {table}")
        if not noise and table["W (mm)"] != "9.2 | 12.8 | 18.2 | 26.3" or noise and table["W (mm)"].count(" +- ") != 4:
            failures.append(f"W: {table['W (mm)']}")
        late = laws.measure(study, 11.85, None)
        if len(late["case"]) != 0:
            failures.append("a window of two times counts")
        try:
            laws.draw(study, 100, None)
            failures.append("laws of no runs")
        except NotInRun:
            pass
if laws.fit(np.array([1e-2, 1e-2, 1e-2]), np.array([1.0, 2.0, 3.0]), "line") is not None:
    failures.append("a law of one length")

for failure in failures:
    print(f"laws: {failure}", file=sys.stderr)
print("laws: the exponents come back, with intervals that hold them")
sys.exit(bool(failures))
