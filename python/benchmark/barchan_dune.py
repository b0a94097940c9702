"""barchan: a heap of 10,000 grains that becomes a dune (benchmark/barchan/statement.md).

Means over the second half of a run; the loss is that of the dune's grains in a second, over their number at its begin.
"""

import numpy as np

from barchan.errors import MissingData

STUDIES = ("benchmark/barchan",)


def measure_run(run):
    """Quantity -> (at, value) of one run."""
    dune = run.main_dune_columns
    late = dune["t"] >= run.summary["simulated_seconds"] / 2 - 1e-9
    if np.sum(late) < 2:
        raise MissingData(f"needs two lines of dune.csv in the second half of {run.path}")
    t, grains = dune["t"][late], dune["n_grains"][late]
    means = {name: float(np.mean(dune[name][late])) for name in ("W", "L", "H")}
    found = {"width_over_length": means["W"] / means["L"], "height_over_width": means["H"] / means["W"],
             "width": 1e3 * means["W"], "length": 1e3 * means["L"], "height": 1e3 * means["H"],
             "celerity": 1e3 * np.polyfit(t, dune["Cx"][late], 1)[0],
             "loss": -100 * np.polyfit(t, grains, 1)[0] / grains[0]}
    return {name: ([np.nan], [value]) for name, value in found.items()}
