"""flat-bed: where grains of a flat bed begin to move, and how many (benchmark/flat-bed/statement.md).

From the tables of the validation, threshold.csv and laminar_bed.csv: all forces, no rolling friction.
"""

import numpy as np

from benchmark.folders import Curve, find
from validation import tables, threshold

STUDIES = ("validation/threshold", "validation/laminar-bed-study")
ALL = 9.0  # forces
WITHIN = 0.02  # of a Shields number, windows count for it


def from_saved(folder):
    turbulent, laminar = tables.read_saved(folder, threshold.NAME), tables.read_saved(folder, "laminar_bed")
    known = find("flat-bed").reference
    of = turbulent.where("rolling_friction", 0.0).where("forces", ALL)
    found = {}
    for name, falling in (("threshold_start", 0.0), ("threshold_stop", 1.0)):
        rows = of.where("falling", falling)
        found[name] = [(np.nan, threshold.zero_of(threshold.load_of)(rows), np.nan)]
    found["turbulent_flux"] = [row for row in (flux_at(of, at) for at in known["turbulent_flux"].at) if row]
    found["laminar_flux"] = [row for row in (laminar_at(laminar, at) for at in known["laminar_flux"].at) if row]
    curves = {name: Curve(*np.array(rows, float).T) for name, rows in found.items()}
    return curves, {**turbulent.notes, "minutes": "180"}


def flux_at(table, shields):
    """log10 q* about a Shields number: mean over the windows of all runs, and their standard deviation."""
    some = table.only((abs(table["shields"] - shields) < WITHIN) & (table["q_star"] > 0))
    if some["q_star"].size < 2:
        return None
    return shields, np.log10(np.mean(some["q_star"])), np.std(np.log10(some["q_star"]), ddof=1)


def laminar_at(table, reynolds):
    """Velocity flux over that of the liquid at a Reynolds number q_f/nu, with all forces; None where it did not run."""
    near = np.isclose(table["reynolds"], reynolds, rtol=0.02) & (table["forces"] == ALL)
    near &= np.isclose(table["sliding_friction"], 0.15) & np.isclose(table["row_height"], 0.5)
    some = table.only(near & np.isclose(table["smoothing_length"], 1.5))
    if some["reynolds"].size == 0:
        return None
    flux = some["velocity_flux"]
    return reynolds, np.mean(flux), np.std(flux, ddof=1) if flux.size > 1 else some["velocity_flux_deviation"][0]
