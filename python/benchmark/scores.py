"""Scores: how far results are from a reference, in errors of the reference."""

from dataclasses import dataclass

import numpy as np


@dataclass
class Score:
    """Of one quantity: mean distance and mean signed distance in errors of the reference; points reached, of all."""

    distance: float
    bias: float
    reached: int
    points: int

    @property
    def word(self):
        return "within" if self.distance <= 1 else "near" if self.distance <= 2 else "missed"


def at_points(reference, result):
    """The result at the points of the reference (n): a line through its values, NaN beyond its ends."""
    if np.isnan(reference.at).all():
        return np.full(reference.value.shape, np.mean(result.value))
    values = np.interp(reference.at, result.at, result.value)
    slack = 1e-9 * np.ptp(reference.at)
    return np.where((reference.at < result.at[0] - slack) | (reference.at > result.at[-1] + slack), np.nan, values)


def score(reference, result):
    """The Score of a result (Curve) against a reference (Curve); distance NaN where no point is reached."""
    off = (at_points(reference, result) - reference.value) / reference.error
    reached = np.isfinite(off)
    if not reached.any():
        return Score(np.nan, np.nan, 0, off.size)
    return Score(float(np.mean(abs(off[reached]))), float(np.mean(off[reached])), int(reached.sum()), off.size)


def scores(references, results):
    """Name -> Score of each quantity that has a reference and results."""
    return {name: score(reference, results[name]) for name, reference in references.items()
            if name in results and np.isfinite(reference.value).any()}


def total(of):
    """Of a case: the mean of its quantities' distances."""
    distances = [one.distance for one in of.values() if np.isfinite(one.distance)]
    return float(np.mean(distances)) if distances else np.nan
