"""means of a study: what each of its dunes is and does, mean and spread over the realisations, as a table in words.

Of the second half of each run, or from --from to --to. Definitions: docs/dune-measures.md, and for
laws docs/studies.md. A run says what its files allow. The numbers are in figures_data/means.csv.
"""

import math

import numpy as np

from barchan.dune import fluxes as grain_fluxes
from barchan.dune.means import of_run
from barchan.errors import MissingData
from barchan.figures.result import Told
from barchan.stats import spread

# name: (what the table calls it, factor to its unit)
QUANTITIES = {
    "grains": ("grains of the dune", 1),
    "W": ("W (mm)", 1e3), "L": ("L (mm)", 1e3), "H": ("H (mm)", 1e3), "horn": ("horn (mm)", 1e3),
    "celerity": ("celerity (mm/s)", 1e3), "loss": ("loss (%/s)", 1e2),
    "formation_time": ("formation time (s)", 1),
    "stoss_angle": ("stoss side (degrees)", 1), "slip_face_angle": ("slip face (degrees)", 1),
    "asymmetry": ("asymmetry (%)", 1e2), "packing": ("packing", 1),
    "crest_flux": ("flux over the crest (mm2/s)", 1e6), "migration_flux": ("phi c H (mm2/s)", 1e6),
    "turnover_time": ("L/c (s)", 1), "dispersion": ("slip face: variance over mean", 1),
    **{kind: (f"{kind} (% of the flux)", 1e2) for kind in grain_fluxes.KINDS},
    "share_in_sectors": ("horn grains from 105-160, 210-260 degrees (%)", 1e2),
    "share_upstream": ("horn grains from upstream (%)", 1e2), "share_outer_half": ("horn grains from r > R/2 (%)", 1e2),
    "F_x_upstream": ("F_x upstream of the crest (nN)", 1e9), "F_x_crest": ("F_x on the crest (nN)", 1e9),
    "F_x_between_horns": ("F_x between the horns (nN)", 1e9),
    "F_z_outward_upstream": ("outward F_z upstream (nN)", 1e9),
    "F_z_outward_downstream": ("outward F_z downstream (nN)", 1e9),
}


def draw(study, start=None, end=None):
    """The table in words and its numbers; no picture."""
    cases = {case.name: [of_run(run, start, end) for run in case.runs] for case in study.cases if case.runs}
    cases = {name: [run for run in runs if run] for name, runs in cases.items()}
    cases = {name: runs for name, runs in cases.items() if runs}
    if not cases:
        raise MissingData("needs a case with a dune in dune.csv")
    heads = " | ".join(f"{name} ({len(runs)})" for name, runs in cases.items())
    lines = [f"| mean +- standard deviation | {heads} |", "|---|" + "---|" * len(cases)]
    rows = []
    for quantity, (label, factor) in QUANTITIES.items():
        spreads = {name: spread_of(runs, quantity, factor) for name, runs in cases.items()}
        if all(one is None for one in spreads.values()):
            continue
        lines.append(f"| {label} | " + " | ".join(say(one) for one in spreads.values()) + " |")
        rows += [(label, name, one.count, one.mean, one.deviation, one.interval)
                 for name, one in spreads.items() if one]
    names = ("quantity", "case", "runs", "mean", "sd", "ci95")
    return Told(lines, {"means": {name: list(column) for name, column in zip(names, zip(*rows))}})


def spread_of(runs, quantity, factor):
    values = [factor * run[quantity] for run in runs if np.isfinite(run.get(quantity, np.nan))]
    return spread(values) if values else None


def say(one):
    if one is None:
        return ""
    if not one.deviation > 0:
        return f"{one.mean:.4g}"
    decimals = max(0, 1 - math.floor(math.log10(one.deviation)))  # two figures of the spread
    return f"{one.mean:.{decimals}f} +- {one.deviation:.{decimals}f}"
