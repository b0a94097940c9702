"""Dunes among the grains of any program."""

from __future__ import annotations

import warnings
from collections.abc import Sequence
from typing import TYPE_CHECKING

import numpy as np

from barchan.dune import detect
from barchan.dune.shape import Bed
from barchan.errors import BadInput
from barchan.io.frames import Grains
from barchan.io.labelled import data_frame

if TYPE_CHECKING:
    from numpy.typing import ArrayLike
    from pandas import DataFrame


def find_dunes(x: ArrayLike, d: ArrayLike, size: Sequence[float],
               periodic: Sequence[bool] = (False, True)) -> tuple[DataFrame, np.ndarray]:
    """Finds and measures the dunes among grains, wherever these come from. Definitions: docs/dune-measures.md.

    Parameters
    ----------
    x : array_like
        (N, 3) centres of the grains [m]; y points upwards from the floor at y = 0.
    d : float or array_like
        (N) diameters [m], or the diameter of all.
    size : sequence of float
        (2) lengths of the domain along x and z [m]; it begins at 0.
    periodic : sequence of bool, optional
        (2) whether the domain is periodic along x and z.

    Returns
    -------
    table : pandas.DataFrame
        A row for each dune, that of most sand first, with columns of dune.csv: W, L, H, Cx, Cz, horns, crest [m],
        volume [m3].
    label : numpy.ndarray
        (N) the row of the dune that each grain belongs to, -1 for none.

    Raises
    ------
    BadInput
        For arrays of other shapes, values that are not finite, and diameters beyond `size`.

    Warns
    -----
    UserWarning
        Where most grains lie outside `size`, as centres in mm do.
    """
    centres, diameters, lengths = numbers("x", x), numbers("d", d), numbers("size", size)
    if centres.ndim != 2 or centres.shape[1] != 3 or not len(centres):
        raise BadInput(f"x must be an array of N x 3 centres, and has the shape {centres.shape}")
    if lengths.shape != (2,) or np.shape(periodic) != (2,) or not (np.isfinite(lengths) & (lengths > 0)).all():
        raise BadInput("size and periodic are those along x and z; lengths are positive")
    if diameters.shape not in ((), (len(centres),)):
        raise BadInput(f"d must be a number or {len(centres)} diameters, and has the shape {diameters.shape}")
    if not np.isfinite(centres).all() or not (np.isfinite(diameters) & (diameters > 0)).all():
        raise BadInput("centres must be finite, diameters positive and finite")
    beyond = (centres[:, [0, 2]] < 0) | (centres[:, [0, 2]] > lengths)
    if beyond.any(axis=1).mean() > 0.5:
        warnings.warn("most grains lie outside size: centres and size must both be in metres", stacklevel=2)
    elif diameters.max() >= lengths.min():
        raise BadInput(f"a diameter, {diameters.max():g}, is no smaller than the domain, {lengths.min():g}: both must "
                       "be in metres")
    grains = Grains(0.0, np.arange(len(centres)), centres, np.broadcast_to(diameters, len(centres)))
    bed = Bed((float(lengths[0]), float(lengths[1])), (bool(periodic[0]), bool(periodic[1])))
    label = detect.labels(grains, bed)
    rows = [detect.measure(grains, np.nonzero(label == number)[0], bed) for number in range(label.max() + 1)]
    return data_frame({name: np.array([row[name] for row in rows]) for name in detect.MEASURED}, detect.MEASURED), label


def numbers(name: str, values: ArrayLike) -> np.ndarray:
    """An argument as floats; else BadInput."""
    try:
        return np.asarray(values, float)
    except (TypeError, ValueError):
        raise BadInput(f"{name} must be numbers") from None
