"""Dunes among the grains of any program."""

import warnings
from collections.abc import Sequence
from typing import Any

import numpy as np

from barchan.dune import detect
from barchan.dune.shape import Bed
from barchan.errors import BadInput
from barchan.io.columns import DUNES
from barchan.io.frames import Grains
from barchan.io.labelled import data_frame


def find_dunes(x: Any, d: Any, size: Sequence[float],
               periodic: Sequence[bool] = (False, True)) -> tuple[Any, np.ndarray]:
    """Finds and measures the dunes among grains, wherever these come from.

    x (N, 3): centres [m], y upward from the floor at y = 0; d (N) or a number: diameters [m]; size: lengths of the
    domain along x and z [m], which begins at 0; periodic: whether x and z are. Returns a DataFrame with a row for each
    dune, that of most sand first (columns as in dune.csv: W, L, H, Cx, Cz, horns, crest; m, m3), and (N) the row that a
    grain belongs to, -1 for none. Definitions: docs/dune-measures.md.
    Warns if most grains lie outside `size`. Raises BadInput for arrays of other shapes or values that are not finite.
    """
    centres, diameters = np.asarray(x, float), np.asarray(d, float)
    if centres.ndim != 2 or centres.shape[1] != 3 or not len(centres):
        raise BadInput(f"x must be an array of N x 3 centres, and has the shape {centres.shape}")
    if len(size) != 2 or len(periodic) != 2 or min(size) <= 0:
        raise BadInput("size and periodic are those along x and z; lengths are positive")
    if diameters.shape not in ((), (len(centres),)):
        raise BadInput(f"d must be a number or {len(centres)} diameters, and has the shape {diameters.shape}")
    if not np.isfinite(centres).all() or not (np.isfinite(diameters) & (diameters > 0)).all():
        raise BadInput("centres must be finite, diameters positive and finite")
    beyond = (centres[:, [0, 2]] < 0) | (centres[:, [0, 2]] > np.asarray(size, float))
    if beyond.any(axis=1).mean() > 0.5:
        warnings.warn("most grains lie outside size: centres and size must both be in metres", stacklevel=2)
    grains = Grains(0.0, np.arange(len(centres)), centres, np.broadcast_to(diameters, len(centres)))
    bed = Bed(tuple(size), tuple(periodic))
    label = detect.labels(grains, bed)
    rows = [detect.measure(grains, np.nonzero(label == number)[0], bed) for number in range(label.max() + 1)]
    return data_frame({name: np.array([row[name] for row in rows]) for name in detect.MEASURED}, DUNES), label
