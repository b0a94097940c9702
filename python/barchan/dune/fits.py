"""Straight lines through the runs of an ensemble, with errors that hold the spread between its realisations.

The numbers of a run scatter along both axes. So the line goes through the means of the cases, in which the scatter
along x is averaged out and does not flatten it; its error is that of all runs about it. Docs: docs/studies.md, "Laws".
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from barchan.stats import student_t

Labels = Sequence | np.ndarray
SMALL = 1e-12  # of the values: nearer to each other the cases lie at one place


@dataclass
class Law:
    """A power y = a x^n, a line y = a + n x or a ratio y = n x, fitted to `runs` of `known` runs.

    error: the standard error of n, interval: half the width of its 95 % interval. Groups of runs share n, and have an
    a each: `centres` (groups, 2) are points of their lines, of a power in logarithms. deviation: of the runs from them.
    """

    kind: str
    n: float
    error: float
    interval: float
    runs: int
    known: int
    centres: np.ndarray
    deviation: float

    def __call__(self, x: np.ndarray | float, n: float | None = None, group: int = 0) -> np.ndarray:
        """y at x; with another n the line through the same centre."""
        n, (x0, y0) = self.n if n is None else n, self.centres[group]
        return np.exp(y0 + n * (np.log(x) - x0)) if self.kind == "power" else y0 + n * (np.asarray(x) - x0)

    @property
    def a(self) -> float:
        """Of the first group."""
        return float(self(1.0 if self.kind == "power" else 0.0))

    @property
    def zero(self) -> tuple[float, float]:
        """x at which a line of one group is 0, and its standard error, by propagation of those of the centre and of n,
        which are independent; not numbers for a level line."""
        if not self.n:
            return np.nan, np.nan
        x0, y0 = self.centres[0]
        centre = self.deviation / np.sqrt(self.runs)
        return float(x0 - y0 / self.n), float(np.hypot(centre, y0 / self.n * self.error) / abs(self.n))

    def holds(self, n: float) -> bool:
        """Whether n lies in the 95 % interval."""
        return abs(self.n - n) <= self.interval + SMALL * abs(n)


def fit(x: np.ndarray, y: np.ndarray, kind: str, cases: Labels | None = None,
        groups: Labels | None = None) -> Law | None:
    """Least squares of the means of the cases, each counted with its runs; of the logarithms for a power.

    x, y (n): of each run; what is no number, and of a power what is not positive, is left out. cases (n): labels, None:
    each run is one. groups (n): runs with the same label have a line of their own, of the common slope. None for too
    few runs, and for cases at one x.
    """
    finite = np.isfinite(x) & np.isfinite(y)
    used = finite & (x > 0) & (y > 0) if kind == "power" else finite
    x, y = (np.log(values[used]) if kind == "power" else values[used] for values in (x, y))
    case = indices(np.arange(len(used)) if cases is None else cases, used)
    group = indices(np.zeros(len(used)) if groups is None else groups, used)
    size = np.sqrt(x @ x)
    if kind == "ratio":
        weight, centres = np.ones(len(x)), np.zeros((1, 2))
        freedom = len(x) - 1
    else:
        centres = np.array([[values[group == g].mean() for values in (x, y)] for g in np.unique(group)])
        x_mean, y_mean = centres[group].T if len(x) else (x, y)
        weight = means(x, case) - x_mean
        x, y, freedom = x - x_mean, y - y_mean, len(x) - 1 - len(centres)
    along = weight @ x
    if freedom < 1 or abs(along) <= SMALL * np.sqrt(weight @ weight) * size:
        return None
    n = weight @ y / along
    residual = y - n * x
    deviation = np.sqrt(residual @ residual / freedom)
    error = deviation * np.sqrt(weight @ weight) / abs(along)
    return Law(kind, float(n), float(error), float(student_t(0.975, freedom) * error), len(x),
               int(np.count_nonzero(finite)), centres, float(deviation))


def indices(labels: Labels, used: np.ndarray) -> np.ndarray:
    """(m) 0, 1, ... of the labels of the runs that are used, in the order of the sorted labels."""
    return np.unique(np.asarray(labels)[used], return_inverse=True)[1]


def means(values: np.ndarray, index: np.ndarray) -> np.ndarray:
    """(n) for each value the mean of those of the same index."""
    return (np.bincount(index, values) / np.maximum(np.bincount(index), 1))[index] if len(values) else values
