"""corners: heap and dune of clumps without rolling friction beside those of spheres with it, from the runs of
configs/field/corners.toml. `--keep` takes the folder of the study, runs/field/corners.

A row is a number of a run. `heap ...`: of the heap at the start; `slope` is the mean angle of its two sides along the
stream. The others are of the main dune over the second half of the run, as in laws.csv and slopes.csv. SI units, angles
in degrees.
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
from validation import tables

NAME = "corners"
COLUMNS = "case,realisation,quantity,value"
OF_HEAP, OF_DUNE, ANGLES = ("W", "L", "H"), ("grains", "W", "L", "H", "celerity", "loss"), ("stoss_angle",
                                                                                           "slip_face_angle")
PANELS = {"heap slope": ("heap: slope [$^\\circ$]", 1), "W": ("W [mm]", 1e3), "L": ("L [mm]", 1e3),
          "celerity": ("celerity [mm/s]", 1e3), "loss": ("loss [%/s]", 100),
          "slip_face_angle": ("slip face [$^\\circ$]", 1)}


def measure(run):
    """(quantity, value) of heap and dune."""
    dune, grains = run.main_dune_columns, run.frame(0)
    for name in OF_HEAP:
        yield f"heap {name}", dune[name][0]
    heap = shape.main_dune(grains, bed_of(run), run.dune_columns[shape.MAIN])
    sides = slopes(heap, grains.d.mean()) if heap else None
    yield "heap slope", np.nanmean([sides.stoss, sides.slip_face]) if sides else np.nan
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
        raise MissingData(f"needs finished runs of configs/field/corners.toml in {folder}")
    rows = [f"{case.name},{run.config['initial']['realisation']},{quantity},{value:.6g}"
            for case, run in runs for quantity, value in measure(run)]
    return tables.keep(out / f"{NAME}.csv", "Clumps, and spheres with rolling friction",
                       "./barchan sweep configs/field/corners.toml", runs[0][1].summary, [COLUMNS, *rows])


def read(source):
    """{case: {quantity: [value of each realisation]}}."""
    path = source / f"{NAME}.csv"
    if not path.exists():
        raise MissingData(f"needs {path}")
    found = {}
    for row in csv.DictReader(line for line in path.read_text().splitlines() if not line.startswith("#")):
        found.setdefault(row["case"], {}).setdefault(row["quantity"], []).append(float(row["value"]))
    return found


def summary(source):
    """A line for each quantity of each case: its mean and standard deviation."""
    for case, quantities in read(source).items():
        for name, values in quantities.items():
            found = spread([value for value in values if np.isfinite(value)])
            yield f"{case}: {name} {found.mean:.4g} +- {found.deviation:.2g} ({len(values)} runs)"


def draw(source):
    found = read(source)
    figure, axes = style.panels(None, 2, 3, figsize=(style.FULL_WIDTH, 4.6))
    for ax, (name, (label, factor)) in zip(np.ravel(axes), PANELS.items()):
        for place, (case, quantities) in enumerate(found.items()):
            values = factor * np.array(quantities[name])
            colour = style.BLUE if case.startswith("rolling") else style.VERMILLION
            ax.plot(np.full(len(values), place), values, "o", color=colour)
            ax.plot(place, np.nanmean(values), "_", ms=18, color=colour)
        ax.set_xticks(range(len(found)), [case.replace("rolling-", "$\\mu_r$ = ") for case in found], rotation=30)
        ax.set(ylabel=label)
    return figure
