"""Mean, spread and confidence interval over the realisations of a case."""

import math
import statistics
from dataclasses import dataclass


@dataclass
class Spread:
    """`count` values: their mean, standard deviation and half the width of the mean's 95 % interval.

    One value has neither a spread nor an interval: both are NaN.
    """

    count: int
    mean: float
    deviation: float
    interval: float


def spread(values):
    """Of a sequence of numbers, as independent samples of a normal distribution."""
    count, mean = len(values), statistics.fmean(values)
    if count < 2:
        return Spread(count, mean, math.nan, math.nan)
    from scipy import stats  # takes half a second: only where an interval is asked for

    deviation = statistics.stdev(values)
    return Spread(count, mean, deviation, stats.t.ppf(0.975, count - 1) * deviation / math.sqrt(count))
