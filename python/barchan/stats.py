"""Mean, spread and confidence interval over realisations; means and windows of a series in time."""

import math
import statistics
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from barchan.errors import MissingData

SECOND = 1.0  # [s] over which a dune's quantities are averaged


@dataclass
class Spread:
    """Mean and spread of some values. One value has neither a deviation nor an interval: both are NaN.

    Attributes
    ----------
    count : int
        How many values.
    mean : float
        Their mean.
    deviation : float
        Their standard deviation.
    interval : float
        Half the width of the 95 % confidence interval of the mean.
    """

    count: int
    mean: float
    deviation: float
    interval: float


def spread(values: Sequence[float]) -> Spread:
    """Mean and spread of independent samples of a normal distribution.

    Parameters
    ----------
    values : sequence of float
        (n) the samples, at least one.

    Returns
    -------
    Spread
        In the unit of the values.
    """
    count, mean = len(values), statistics.fmean(values)
    if count < 2:
        return Spread(count, mean, math.nan, math.nan)
    deviation = statistics.stdev(values)
    return Spread(count, mean, deviation, student_t(0.975, count - 1) * deviation / math.sqrt(count))


def student_t(p: float, freedom: int) -> float:
    """A quantile of Student's t distribution.

    With t = sqrt(freedom) tan(a) the distribution is 1/2 + C times the integral of cos^(freedom - 1) from 0 to a. It
    is concave in a, so that Newton's method from 0 never goes beyond the root.

    Parameters
    ----------
    p : float
        Probability, at least 1/2.
    freedom : int
        Degrees of freedom.

    Returns
    -------
    float
        The quantile.
    """
    factor = math.exp(math.lgamma((freedom + 1) / 2) - math.lgamma(freedom / 2)) / math.sqrt(math.pi)
    x, weight = np.polynomial.legendre.leggauss(64)
    angle = 0.0
    for _ in range(100):
        integral = 0.5 * angle * float(weight @ np.cos(0.5 * angle * (x + 1))**(freedom - 1))
        step = ((p - 0.5) / factor - integral) / math.cos(angle)**(freedom - 1)
        angle += step
        if abs(step) <= 1e-15 * angle:
            break
    return math.sqrt(freedom) * math.tan(angle)


def within(t: Any, start: float, end: float) -> Any:
    """Which times are from start to end, however their ten digits were rounded.

    Parameters
    ----------
    t : float or numpy.ndarray
        (n) times [s].
    start, end : float
        Ends of the window [s].

    Returns
    -------
    bool or numpy.ndarray
        (n) bool.
    """
    return (t >= start * (1 - 1e-9)) & (t <= end * (1 + 1e-9))


def in_window(t: np.ndarray, start: float | None, end: float | None) -> np.ndarray:
    """Which times are meant: the second half unless others are asked for.

    Parameters
    ----------
    t : numpy.ndarray
        (n) times, ascending [s].
    start, end : float or None
        Ends of the window [s]; None where it is open.

    Returns
    -------
    numpy.ndarray
        (n) bool.
    """
    if start is None and end is None:
        start = 0.5 * (t[0] + t[-1])
    return (t >= (-np.inf if start is None else start)) & (t <= (np.inf if end is None else end))


def window(t: np.ndarray, start: float | None, end: float | None) -> np.ndarray:
    """Which times are meant, of at least two frames: as `in_window`.

    Parameters
    ----------
    t : numpy.ndarray
        (n) times, ascending [s].
    start, end : float or None
        Ends of the window [s]; None where it is open.

    Returns
    -------
    numpy.ndarray
        (n) bool.

    Raises
    ------
    MissingData
        Where fewer than two times are meant.
    """
    chosen = in_window(t, start, end)
    if np.count_nonzero(chosen) < 2:
        raise MissingData(f"needs two frames between {t[0] if start is None else start:g} s "
                          f"and {t[-1] if end is None else end:g} s; it has t = {t[0]:g} to {t[-1]:g} s")
    return chosen


def over_the_last_second(t: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Means over the last second, at each time.

    Parameters
    ----------
    t : numpy.ndarray
        (n) times, ascending [s].
    values : numpy.ndarray
        (n) values; those that are no numbers do not count.

    Returns
    -------
    numpy.ndarray
        (n) mean of the values after t - 1 s, NaN where there is none.
    """
    result = np.full(len(t), np.nan)
    for row, end in enumerate(t):
        known = values[(t > end - SECOND * (1 - 1e-9)) & (t <= end)]
        if np.isfinite(known).any():
            result[row] = np.nanmean(known)
    return result


def spans_seconds(t: np.ndarray) -> bool:
    """Whether times span at least two seconds.

    Parameters
    ----------
    t : numpy.ndarray
        (n) times, ascending [s].

    Returns
    -------
    bool
        Whether they do.
    """
    return bool(t[-1] - t[0] >= 2 * SECOND * (1 - 1e-9))


def in_seconds(t: np.ndarray, values: np.ndarray) -> list[float]:
    """Means over whole seconds, taken as independent; the values themselves where they span less than two.

    Parameters
    ----------
    t : numpy.ndarray
        (n) times, ascending [s].
    values : numpy.ndarray
        (n) values; those that are not finite do not count.

    Returns
    -------
    list of float
        The means, [NaN] where no value is finite.
    """
    second = np.floor((t - t[0]) / SECOND * (1 + 1e-9)) if spans_seconds(t) else np.arange(len(t))
    means = [np.mean(values[(second == s) & np.isfinite(values)]) for s in np.unique(second)
             if np.isfinite(values[second == s]).any()]
    return means or [np.nan]


def varies(values: ArrayLike) -> bool:
    """Whether values differ by more than a thousandth, but for one in fifty. A constant flow rate does not.

    Parameters
    ----------
    values : numpy.ndarray
        (n) values; those that are not finite do not count.

    Returns
    -------
    bool
        Whether they do; not where none is finite.
    """
    known = np.asarray(values, float)
    known = known[np.isfinite(known)]
    if not known.size:
        return False
    low, high = np.percentile(known, [2, 98])
    return bool(high - low > 1e-3 * abs(known).max())
