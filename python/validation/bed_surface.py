"""Surface of a bed, and stress and load there: the one rule by which runs with bedload.csv get their Shields numbers.

docs/files.md#bedloadcsv has the rule: the surface is where the production of fluctuation energy by the grains' shear is
largest (Paehtz & Duran, Phys. Rev. Fluids 3, 104302, 2018; Paehtz et al., arXiv:2404.07689). Runs that were done before
`statistics.bed_load` have no such table. Each measure has its earlier rule for them.
"""

from dataclasses import dataclass

import numpy as np


@dataclass
class Bed:
    """Numbers of a bed, NaN where they are not known."""

    surface: float = np.nan  # height [m]
    stress: float = np.nan  # [Pa]
    shields: float = np.nan
    load: float = np.nan  # mass of the grains above the surface [kg/m2]
    q_star: float = np.nan

    @property
    def known(self):
        return bool(np.isfinite(self.shields))


def of(run):
    """The bed of a run, by its bedload.csv."""
    table = run.bed_load_columns
    if not table or not len(table["y"]):
        return Bed()
    return Bed(*(float(table[name][0]) for name in ("bed_surface", "bed_stress", "shields", "load", "q_star")))


def stress_in_time(bed, run, acceleration):
    """Total stress [Pa] at the surface, for each row of history.csv, below a free top in a flow that speeds up.

    The momentum of all that is above it: G (H - surface) less what accelerates the water there. Grains are few.
    """
    config = run.config
    height = config["domain"]["size"][1] - bed.surface
    water = height - bed.load / config["grains"]["density"]
    density = config["fluid"].get("density", 1000.0)
    return run.history_columns["pressure_gradient"] * height - density * acceleration * water
