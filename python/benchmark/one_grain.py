"""one-grain: spheres that sink, bounce and begin to roll (benchmark/one-grain/statement.md).

From the tables of the validation, resolved_spheres.csv and dem_cases.csv.
"""

import numpy as np

from benchmark.folders import Curve
from validation import resolved_spheres, tables

STUDIES = ("validation/resolved-settling-study", "validation/resolved-rebound-study", "benchmark/mfix-dem04-study")
REYNOLDS = {"E1": 1.5, "E2": 4.1, "E3": 11.6, "E4": 31.9}
OPEN_WATER = {"E1": 0.038, "E2": 0.060, "E3": 0.091, "E4": 0.128}  # ten Cate et al. (2002) [m/s]
REBOUNDS = "nu-30-smooth", "nu-20-smooth", "nu-10-smooth", "nu-5-smooth", "nu-2"  # films down to 3e-4 of the radius


def from_saved(folder):
    spheres, dry = (tables.read_saved(folder, name) for name in (resolved_spheres.NAME, "dem_cases"))
    of = spheres.where("what", "settling")
    settling = [(REYNOLDS[case], of.where("case", case)["y"].max() / OPEN_WATER[case]) for case in REYNOLDS]
    of = spheres.where("what", "rebound")
    rebound = [(of.where("case", case)["x"][0], of.where("case", case)["y"][0]) for case in REBOUNDS]
    curves = {"settling": settling, "rebound": rebound}
    curves["rolling"] = [(np.nan, float(np.mean(dry.where("what", "rolls")["y"])))]
    return {name: whole(rows) for name, rows in curves.items()}, {**spheres.notes, "minutes": "30"}


def whole(rows):
    at, value = np.array(rows, float).T
    return Curve(at, value, np.full(at.size, np.nan))
