"""One dune among the grains of a frame: which they are, where its lee foot is and which of them are horns.

Its size, crest and horns are those that the program has written to dune.csv (definitions in docs/dune-measures.md).
What dune.csv lacks is found here with the same centreline, so that grains that lie in a horn are those that make its
length. Lengths in m, angles from +x. Criteria are in mean grain diameters.
"""

from dataclasses import dataclass

import numpy as np

from barchan.dune.surface import Surface
from barchan.errors import MissingData
from barchan.io.frames import Grains

BIN = 2.5          # side of a bin
HALF_WIDTH = 3.0   # of the centreline's strip
MAIN = 0           # label of the first dune of a run, the largest one then


@dataclass
class Bed:
    """What a dune lies on.

    Attributes
    ----------
    lengths : tuple of float
        Lengths of the domain (Lx, Lz) [m].
    periodic : tuple of bool
        Whether it is periodic along x and z.
    """

    lengths: tuple
    periodic: tuple

    def nearest(self, difference: np.ndarray) -> np.ndarray:
        """Differences of places, to the nearest periodic image.

        Parameters
        ----------
        difference : numpy.ndarray
            (..., 3) differences [m].

        Returns
        -------
        numpy.ndarray
            (..., 3) the shortest ones [m].
        """
        result = np.array(difference, float)
        for axis, length, periodic in zip((0, 2), self.lengths, self.periodic):
            if periodic:
                result[..., axis] -= length * np.round(result[..., axis] / length)
        return result


@dataclass
class Dune:
    """One dune among the grains of a frame.

    Attributes
    ----------
    rows : numpy.ndarray
        (n) places of its grains in the frame.
    x, z : numpy.ndarray
        (n) places of its grains, periodic images undone [m].
    centroid : numpy.ndarray
        (3) centroid [m].
    W, L, H, crest_x : float
        Width, length, height and place of the crest, of dune.csv [m].
    toe, lee_foot : float
        Ends of the centreline, up and down the stream, infinite where no sand lies there [m].
    horn_left, horn_right : float
        Lengths of the horns, of dune.csv [m].
    side : numpy.ndarray
        (n) -1 for a grain in the left horn, +1 in the right, 0 in none.
    surface : Surface
        Surface of its grains.
    """

    rows: np.ndarray
    x: np.ndarray
    z: np.ndarray
    centroid: np.ndarray
    W: float
    L: float
    H: float
    crest_x: float
    toe: float
    lee_foot: float
    horn_left: float
    horn_right: float
    side: np.ndarray
    surface: Surface


def main_rows(grains: Grains) -> np.ndarray:
    """Rows of the main dune's grains in a frame."""
    if grains.dune is None:
        raise MissingData("needs frames that say which dune each grain is of (output.dune_interval > 0); runs of "
                       "an earlier version have none")
    return np.nonzero(grains.dune == MAIN)[0]


def main_dune(grains: Grains, bed: Bed, table: dict[str, np.ndarray]) -> Dune | None:
    """The main dune of a frame, None while there is none. `table`: its columns of dune.csv, of which the line nearest
    in time counts."""
    rows = main_rows(grains)
    if not len(rows):
        return None
    line = int(np.argmin(abs(table["t"] - grains.time)))
    return find(grains, rows, bed, {name: float(column[line]) for name, column in table.items()})


def in_one_piece(x: np.ndarray, length: float) -> np.ndarray:
    """Positions (n) with periodic images undone: the widest gap between them is outside."""
    x = x % length
    ordered = np.sort(x)
    gaps = np.diff(ordered, append=ordered[0] + length)
    widest = int(np.argmax(gaps))
    return x if widest == len(x) - 1 else np.where(x > ordered[widest], x - length, x)


def number_of_bins(bed: Bed, diameter: float) -> np.ndarray:
    """(2) along x and z. Stored diameters are rounded: a domain that holds a whole number of bins keeps it."""
    return np.maximum(1, np.floor(np.array(bed.lengths) / (BIN * diameter) * (1 + 1e-6))).astype(int)


@dataclass
class Sand:
    """Grains (n) of one dune: x, z, radius [m], with periodic images undone; their centroid (3) [m] and surface."""

    x: np.ndarray
    z: np.ndarray
    radius: np.ndarray
    centroid: np.ndarray
    surface: Surface

    @classmethod
    def of(cls, grains: Grains, rows: np.ndarray, bed: Bed) -> "Sand":
        x, z = (in_one_piece(grains.x[rows, axis], length) if periodic else grains.x[rows, axis]
                for axis, length, periodic in zip((0, 2), bed.lengths, bed.periodic))
        y, radius = grains.x[rows, 1], 0.5 * grains.d[rows].astype(float)
        bins = bed.lengths / number_of_bins(bed, float(grains.d.mean()))
        return cls(x, z, radius, np.average([x, y, z], axis=1, weights=radius**3), Surface(x, y + radius, z, bins))


def find(grains: Grains, rows: np.ndarray, bed: Bed, size: dict[str, float]) -> Dune:
    """The dune of these rows, `size` its line of dune.csv."""
    sand = Sand.of(grains, rows, bed)
    x, z, radius, centroid = sand.x, sand.z, sand.radius, sand.centroid
    crest_x = centroid[0] + bed.nearest(np.array([size["crest_x"] - centroid[0], 0.0, 0.0]))[0]
    strip = abs(z - centroid[2]) < HALF_WIDTH * float(grains.d.mean())
    line = centreline(x[strip], radius[strip], sand.surface.bins[0], crest_x)
    toe, foot = line or (-np.inf, np.inf)
    side = np.where(strip | (x + radius <= foot), 0, np.where(z < centroid[2], -1, 1))
    return Dune(rows, x, z, centroid, size["W"], size["L"], size["H"], float(crest_x), toe, foot,
                size["horn_left"], size["horn_right"], side, sand.surface)


def centreline(x: np.ndarray, radius: np.ndarray, bin_x: float, crest_x: float) -> tuple[float, float] | None:
    """(toe, lee foot) [m]: around the crest the columns of bins that hold sand without a gap."""
    if len(x) == 0:
        return None
    column = np.floor(x / bin_x).astype(int)
    held = np.unique(column)
    piece = np.cumsum(np.concatenate([[0], np.diff(held) > 1]))
    nearest = piece[np.argmin(abs(held + 0.5 - crest_x / bin_x))]
    kept = np.isin(column, held[piece == nearest])
    return np.min((x - radius)[kept]), np.max((x + radius)[kept])
