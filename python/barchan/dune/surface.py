"""The surface of a bed or a dune: the 3 x 3 median of the height over bins, as in the dune analytics of the program."""

from collections.abc import Sequence

import numpy as np


class Surface:
    """Heights of a bed over bins, with the median of each bin and its eight neighbours.

    The height of a bin is the highest top of its grains, zero where it has none, so that a grain in flight does not
    show in the median.

    Parameters
    ----------
    x : numpy.ndarray
        (N) places of the grains along the flow [m].
    top : numpy.ndarray
        (N) heights of their tops [m].
    z : numpy.ndarray
        (N) places across the flow [m].
    bins : sequence of float
        (2) sides of a bin along x and z [m].

    Attributes
    ----------
    x, z : numpy.ndarray
        (n) middles of the bins that hold grains [m].
    h : numpy.ndarray
        (n) the median there [m].
    lowest : numpy.ndarray
        (n) the least h of a bin and its eight neighbours [m].
    """

    def __init__(self, x: np.ndarray, top: np.ndarray, z: np.ndarray, bins: Sequence[float]) -> None:
        column, row = (np.floor(position / size).astype(int) for position, size in zip((x, z), bins))
        self.bins = np.array(bins)
        self.first = np.array([column.min(), row.min()])
        i, k = column - self.first[0] + 1, row - self.first[1] + 1  # with an edge of zeros
        height = np.zeros((i.max() + 2, k.max() + 2))
        np.maximum.at(height, (i, k), top)
        held = np.argwhere(height > 0)
        self.h = np.median(around(height, held), axis=0)
        self.x, self.z = ((held - 0.5 + self.first) * self.bins).T
        self.map = np.zeros_like(height)
        self.map[tuple(held.T)] = self.h
        self.lowest = np.min(around(self.map, held), axis=0)

    def at(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Heights at points, linear between the middles of bins.

        Parameters
        ----------
        x, z : numpy.ndarray
            (m) places of the points [m].

        Returns
        -------
        numpy.ndarray
            (m) heights [m], zero where there is no sand.
        """
        place = np.stack([x, z], axis=1) / self.bins - self.first + 0.5
        i, k = np.clip(np.floor(place).astype(int), 0, np.array(self.map.shape) - 2).T
        a, b = np.clip(place.T - (i, k), 0, 1)
        return ((1 - a) * ((1 - b) * self.map[i, k] + b * self.map[i, k + 1])
                + a * ((1 - b) * self.map[i + 1, k] + b * self.map[i + 1, k + 1]))

    def in_bins(self, chosen: np.ndarray, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        """Which points lie in some of the bins.

        Parameters
        ----------
        chosen : numpy.ndarray
            (n) bool: which of the bins.
        x, z : numpy.ndarray
            (m) places of the points, each in a bin that holds grains or beside one [m].

        Returns
        -------
        numpy.ndarray
            (m) bool.
        """
        marked = np.zeros(self.map.shape, bool)
        marked[tuple(self._bin(self.x[chosen], self.z[chosen]))] = True
        return marked[tuple(self._bin(x, z))]

    def _bin(self, x: np.ndarray, z: np.ndarray) -> np.ndarray:
        return (np.floor(np.stack([x, z], axis=1) / self.bins).astype(int) - self.first + 1).T

    def profile(self, z: float, half_width: float) -> tuple[np.ndarray, np.ndarray]:
        """Heights along the flow: the mean over a strip of bins.

        Parameters
        ----------
        z : float
            Middle of the strip [m].
        half_width : float
            Half its width [m].

        Returns
        -------
        x : numpy.ndarray
            (m) middles of the columns of bins that hold sand in the strip [m].
        h : numpy.ndarray
            (m) mean height of each column [m].
        """
        near = abs(self.z - z) < half_width
        x, column = np.unique(self.x[near], return_inverse=True)
        return x, np.bincount(column, self.h[near]) / np.bincount(column) if len(x) else x


def around(map_of: np.ndarray, held: np.ndarray) -> list[np.ndarray]:
    """Values (9, n) of a map at the places held (n, 2) and their neighbours."""
    return [map_of[tuple((held + (di, dk)).T)] for di in (-1, 0, 1) for dk in (-1, 0, 1)]
