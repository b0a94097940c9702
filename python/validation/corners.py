"""corners: heap, dune and threshold of clumps without rolling friction beside those of spheres with it, from the runs
of configs/field/corners-heap.toml, configs/field/corners.toml and configs/validation/corners-threshold.toml. `--keep`
takes the folder of one of these studies, and keeps the rows of the others.

A row is a number of a run. `heap ...`: of a heap at its end; `slope` is the mean angle of its two sides along x.
`threshold`: Shields number at which q* passes 0.01, as in threshold.py; the load says none where all grains creep, as
spheres without rolling friction do. The others are of the main dune over the second half of the run, as in laws.csv and
slopes.csv. SI units, angles in degrees.
"""

import csv

import numpy as np

from barchan.dune import laws, shape, transport
from barchan.dune.slopes import slopes
from barchan.dune.tracks import bed_of
from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.study_folder import StudyFolder, gap_of
from barchan.stats import spread
from validation import tables, threshold

NAME = "corners"
STUDIES = ("configs/field/corners-heap.toml", "configs/field/corners.toml", "configs/validation/corners-threshold.toml")
COLUMNS = "case,realisation,quantity,value"
OF_HEAP, OF_DUNE, ANGLES = ("W", "L", "H"), ("grains", "W", "L", "H", "celerity", "loss"), ("stoss_angle",
                                                                                           "slip_face_angle")
LOGARITHMIC = "celerity", "loss"
SPHERES = {f"rolling-{friction:g}": friction for friction in (0.0, 0.1, 0.3)}
PANELS = {"heap slope": ("heap: slope [$^\\circ$]", 1), "W": ("W [mm]", 1e3), "L": ("L [mm]", 1e3),
          "celerity": ("celerity [mm/s]", 1e3), "loss": ("loss [%/s]", 100),
          "slip_face_angle": ("slip face [$^\\circ$]", 1), "stoss_angle": ("stoss side [$^\\circ$]", 1),
          "threshold": ("threshold: Shields number", 1)}


def measure(run):
    """(quantity, value) of a bed, a heap in still water, or a dune."""
    if run.config["grains"]["boundary_x"] == "periodic":
        return of_bed(run)
    return of_dune(run) if "fluid" in run.config else of_heap(run)


def of_bed(run):
    shields, q_star, _ = np.transpose([row[-3:] for row in threshold.measure(run)])
    transport = threshold.passing(threshold.LEVELS["transport"])
    yield "threshold", transport({"shields": shields, "q_star": q_star})


def of_heap(run):
    dune, grains = run.main_dune_columns, run.frame(-1)
    for name in OF_HEAP:
        yield f"heap {name}", dune[name][-1]
    heap = shape.main_dune(grains, bed_of(run), run.dune_columns[shape.MAIN])
    sides = slopes(heap, grains.d.mean()) if heap else None
    yield "heap slope", np.nanmean([sides.stoss, sides.slip_face]) if sides else np.nan


def of_dune(run):
    late = laws.of_run(run)
    for name in OF_DUNE:
        yield name, late[name]
    known = transport.over_window(transport.measure(run)[0], ANGLES, None, None)
    for name in ANGLES:
        yield name, known[name]


def save(folder, out):
    study = StudyFolder(folder)
    runs = [(case, run) for case in study.cases for run in case.runs if not gap_of(run.path)]
    if not runs:
        raise MissingData(f"needs finished runs of one of the studies {', '.join(STUDIES)} in {folder}")
    found = {(case.name, str(run.config["initial"]["realisation"]), quantity): f"{value:.6g}"
             for case, run in runs for quantity, value in measure(run)}
    path = out / f"{NAME}.csv"
    rows = {**(rows_of(path) if path.exists() else {}), **found}
    return tables.keep(path, "Clumps, and spheres with rolling friction",
                       "./barchan sweep " + ", ".join(STUDIES),
                       runs[0][1].summary, [COLUMNS, *(",".join((*key, value)) for key, value in sorted(rows.items()))])


def rows_of(path):
    """{(case, realisation, quantity): value as written}."""
    lines = csv.reader(line for line in path.read_text().splitlines() if not line.startswith("#"))
    return {tuple(key): value for *key, value in list(lines)[1:]}


def read(source):
    """{case: {quantity: [value of each realisation]}}."""
    path = source / f"{NAME}.csv"
    if not path.exists():
        raise MissingData(f"needs {path}")
    found = {}
    for (case, _, quantity), value in rows_of(path).items():
        found.setdefault(case, {}).setdefault(quantity, []).append(float(value))
    return found


def mean_of(found, case, quantity):
    values = np.array(found.get(case, {}).get(quantity, [np.nan]))
    return values[np.isfinite(values)].mean() if np.isfinite(values).any() else np.nan


def equivalent(found, case, quantity):
    """Rolling friction that gives spheres the mean of a quantity of a clump, between the nearest of SPHERES; nan beyond
    them, and where spheres do not change in one direction with their rolling friction."""
    means = np.array([mean_of(found, name, quantity) for name in SPHERES])
    rises = np.sign(means[-1] - means[0])
    if not np.all(rises * np.diff(means) > 0):
        return np.nan
    return float(np.interp(rises * mean_of(found, case, quantity), rises * means, list(SPHERES.values()),
                           left=np.nan, right=np.nan))


def summary(source):
    """A line for each quantity of each case: its mean and standard deviation; of clumps the rolling friction of spheres
    with the same mean."""
    found = read(source)
    for case, quantities in found.items():
        for name, values in quantities.items():
            known = [value for value in values if np.isfinite(value)]
            if not known:
                continue
            of_runs, alike = spread(known), "" if case in SPHERES else f", as mu_r {equivalent(found, case, name):.2f}"
            yield f"{case}: {name} {of_runs.mean:.4g} +- {of_runs.deviation:.2g} ({len(known)} runs){alike}"


def draw(source):
    found = read(source)
    figure, axes = style.panels(None, 2, 4, figsize=(style.FULL_WIDTH, 4.6))
    for ax, (name, (label, factor)) in zip(np.ravel(axes), PANELS.items()):
        for place, (case, quantities) in enumerate(found.items()):
            values = factor * np.array(quantities.get(name, [np.nan]))
            colour = style.BLUE if case.startswith("rolling") else style.VERMILLION
            ax.plot(np.full(len(values), place), values, "o", color=colour)
            ax.plot(place, factor * mean_of(found, case, name), "_", ms=18, color=colour)
        ax.set_xticks(range(len(found)), [case.replace("rolling-", "$\\mu_r$ = ") for case in found], rotation=30)
        ax.set(ylabel=label, xlim=(-0.5, len(found) - 0.5), yscale="log" if name in LOGARITHMIC else "linear")
    return figure
