"""Which measurement belongs to which case, and the rows that it makes of our runs."""

import json
from pathlib import Path

import numpy as np

from barchan import Run
from barchan.errors import MissingData
from barchan.io.study_folder import NAME as STUDY
from barchan.io.study_folder import StudyFolder, gap_of
from benchmark import barchan_dune, column, encounter, flat_bed, one_grain, scour
from benchmark.folders import OWN, RESULT_COLUMNS, Curve
from validation import tables

MEASURES = {"one-grain": one_grain, "flat-bed": flat_bed, "column": column, "barchan": barchan_dune,
            "encounter": encounter, "scour": scour}


def finished(folder):
    """The finished runs of the cases of a study; none where there is no such folder."""
    if not (Path(folder) / STUDY).exists():
        return []
    runs = [run for case in StudyFolder(folder).cases for run in case.runs]
    return [Run(run.path) for run in runs if gap_of(run.path) is None]


def from_validation(name):
    """The studies of a case that is measured from the tables of the validation; none of another case."""
    module = MEASURES[name]
    return module.STUDIES if hasattr(module, "from_saved") else ()


def together(found):
    """Quantity -> Curve of the mean over runs and its standard deviation, from the (at, value) of each run."""
    curves = {}
    for name in dict.fromkeys(name for one in found for name in one):
        of = [one[name] for one in found if name in one]
        at = np.asarray(of[0][0], float)
        if np.isnan(at).any():
            values = np.array([np.mean(value) for _, value in of])[:, None]
        else:
            at = at[at <= min(np.max(other) for other, _ in of) * (1 + 1e-9)]
            values = np.array([np.interp(at, other, value) for other, value in of])
        spread = values.std(axis=0, ddof=1) if len(of) > 1 else np.full(at.size, np.nan)
        curves[name] = Curve(at, values.mean(axis=0), spread)
    return curves


def measure(name, runs, saved):
    """Name of the results -> (curves, notes) of a case; `runs`: folder of runs, `saved`: of the validation's tables.

    Our results are those called as OWN; variants of a case, such as a finer mesh, have results of their own.
    """
    module = MEASURES[name]
    if hasattr(module, "from_saved"):
        return {OWN: module.from_saved(saved)}
    found = [run for study in module.STUDIES for run in finished(Path(runs) / study)]
    if not found:
        raise MissingData(f"needs a finished run in {Path(runs) / module.STUDIES[0]}: ./barchan benchmark {name}")
    variant_of = getattr(module, "variant_of", lambda run: OWN)
    variants = {}
    for run in found:
        variants.setdefault(variant_of(run), []).append(run)
    return {variant: (together([module.measure_run(run) for run in of]), notes(name, module, of))
            for variant, of in sorted(variants.items())}


def notes(name, module, runs):
    """What the table of the results of these runs says of itself."""
    about = tables.about(module.__doc__.split("\n")[0], f"./barchan benchmark {name}",
                         json.loads((runs[0].path / "run.json").read_text(encoding="utf-8")))
    seconds = sum(run.summary["wall_seconds"] * run.summary["threads"] * run.summary["ranks"] for run in runs)
    return {**about, "runs": ", ".join(run.path.name for run in runs), "minutes": f"{seconds / 60:.0f}"}


def lines(curves):
    """Rows of a table of results."""
    shown = lambda number: "" if np.isnan(number) else f"{number:.4g}"  # noqa: E731
    return [RESULT_COLUMNS, *(f"{name},{shown(at)},{shown(value)},{shown(spread)}" for name, curve in curves.items()
                              for at, value, spread in zip(curve.at, curve.value, curve.error))]
