"""encounter: two barchans of which one reaches the other (benchmark/encounter/statement.md)."""

import numpy as np

from barchan.dune.encounters import MERGING, find

STUDIES = ("benchmark/encounter",)


def measure_run(run):
    """Quantity -> (at, value) of one run: whether it is a merging, and the grains that changed sides (%)."""
    first = find(run)[1][0]
    moved = 100 * (first.to_downstream + first.to_upstream) / run.frame(0).id.size
    return {"merging_share": ([np.nan], [float(first.kind == MERGING)]), "exchanged": ([np.nan], [moved])}
