"""encounter: two barchans of which one reaches the other (benchmark/encounter/statement.md)."""

import numpy as np

from barchan.dune.encounters import MERGING, find
from barchan.errors import MissingData

STUDIES = ("benchmark/encounter",)


def measure_run(run):
    """Quantity -> (at, value) of one run: whether it is a merging, and the grains that changed sides (%)."""
    met = find(run)[1]
    if not met:
        raise MissingData(f"needs an encounter in {run.path}")
    first = met[0]
    moved = 100 * (first.to_downstream + first.to_upstream) / run.frame(0).id.size
    return {"merging_share": ([np.nan], [float(first.kind == MERGING)]), "exchanged": ([np.nan], [moved])}
