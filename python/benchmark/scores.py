"""Scores: how far results are from a reference, in errors of the reference."""

from dataclasses import dataclass

import numpy as np


END = 0.01  # of the range of the reference by which a curve may end before a point of it
ROUNDING = 1e-9


@dataclass
class Score:
    """Of one quantity: mean distance and mean signed distance in errors of the reference; points reached, of all;
    whether the results have it."""

    distance: float
    bias: float
    reached: int
    points: int
    given: bool = True

    @property
    def word(self):
        """How far off it is."""
        if not self.reached:
            return "not given" if not self.given else "not reached"
        return "within" if self.distance < 1 + ROUNDING else "near" if self.distance < 2 + ROUNDING else "missed"


def at_points(reference, result):
    """The result at the points of the reference (n): a line through its values, NaN beyond its ends by END."""
    if np.isnan(reference.at).all():
        return np.full(reference.value.shape, np.mean(result.value))
    values = np.interp(reference.at, result.at, result.value)
    slack = END * np.ptp(reference.at)
    return np.where((reference.at < result.at[0] - slack) | (reference.at > result.at[-1] + slack), np.nan, values)


def score(reference, result):
    """The Score of a result (Curve) against a reference (Curve); distance NaN where no point is reached."""
    off = (at_points(reference, result) - reference.value) / reference.error
    reached = np.isfinite(off)
    if not reached.any():
        return Score(np.nan, np.nan, 0, off.size)
    return Score(float(np.mean(abs(off[reached]))), float(np.mean(off[reached])), int(reached.sum()), off.size)


def scores(references, results):
    """Name -> Score of each quantity that has a reference."""
    return {name: score(reference, results[name]) if name in results else
            Score(np.nan, np.nan, 0, reference.value.size, given=False)
            for name, reference in references.items() if np.isfinite(reference.value).any()}


def share(of):
    """Of a case: how much of the reference its score is made of, in words."""
    given = sum(one.reached > 0 for one in of.values())
    reached, points = (sum(getattr(one, name) for one in of.values()) for name in ("reached", "points"))
    return f"{given} of {len(of)} quantities, {reached} of {points} points"


def total(of):
    """Of a case: the mean of its quantities' distances."""
    distances = [one.distance for one in of.values() if np.isfinite(one.distance)]
    return float(np.mean(distances)) if distances else np.nan
