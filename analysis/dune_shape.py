"""The shape of one dune, measured as the program does for dune.csv, from the grains that it labels so.

The same centreline and crest as src/diagnostics/dune_shape.cpp (definitions in docs/conventions.md), so
that what is said about single grains, e.g. that one lies in a horn, agrees with the lengths in dune.csv.
Lengths in m, angles from +x. Criteria are in mean grain diameters.
"""

from dataclasses import dataclass

import numpy as np

from run_folder import NotInRun
from surface import Surface

BIN = 2.5          # side of a bin
HALF_WIDTH = 3.0   # of the centreline's strip
MAIN = 0           # label of the first dune of a run, the largest one then


@dataclass
class Bed:
    """What a dune lies on: lengths (Lx, Lz) [m] and whether x and z are periodic."""

    lengths: tuple
    periodic: tuple

    def nearest(self, difference):
        """Differences of positions, (..., 3) [m], to the nearest periodic image."""
        result = np.array(difference, float)
        for axis, length, periodic in zip((0, 2), self.lengths, self.periodic):
            if periodic:
                result[..., axis] -= length * np.round(result[..., axis] / length)
        return result


@dataclass
class Dune:
    """One dune: `rows` (n) of its grains in the frame, their x, z (n) [m] with periodic images undone.

    centroid (3), size, crest and horns as in dune.csv [m]. `lee_foot` is the downstream end of the
    centreline, +infinity when no sand lies there. `side` (n): -1 in the left horn, +1 in the right, 0.
    `surface` is that of its grains.
    """

    rows: np.ndarray
    x: np.ndarray
    z: np.ndarray
    centroid: np.ndarray
    W: float
    L: float
    H: float
    crest_x: float
    lee_foot: float
    horn_left: float
    horn_right: float
    side: np.ndarray
    surface: Surface


def main_rows(grains):
    """Rows of the main dune's grains in a frame."""
    if grains.dune is None:
        raise NotInRun("needs frames that say which dune each grain is of (output.dune_interval > 0); runs of "
                       "an earlier version have none")
    return np.nonzero(grains.dune == MAIN)[0]


def main_dune(grains, bed):
    """The main dune of a frame, None while there is none."""
    rows = main_rows(grains)
    return measure(grains, rows, bed) if len(rows) else None


def in_one_piece(x, length):
    """Positions (n) with periodic images undone: the widest gap between them is outside."""
    x = x % length
    ordered = np.sort(x)
    gaps = np.diff(ordered, append=ordered[0] + length)
    widest = int(np.argmax(gaps))
    return x if widest == len(x) - 1 else np.where(x > ordered[widest], x - length, x)


def measure(grains, rows, bed):
    x, z = (in_one_piece(grains.x[rows, axis], length) if periodic else grains.x[rows, axis]
            for axis, length, periodic in zip((0, 2), bed.lengths, bed.periodic))
    diameter = float(grains.d.mean())
    bins = [length / max(1, int(length / (BIN * diameter))) for length in bed.lengths]
    radius = 0.5 * grains.d[rows]
    centroid = np.average([x, grains.x[rows, 1], z], axis=1, weights=radius**3)
    half_width = HALF_WIDTH * diameter
    surface = Surface(x, grains.x[rows, 1] + radius, z, bins)
    H, crest_x = find_crest(surface, centroid, half_width)
    strip = abs(z - centroid[2]) < half_width
    line = centreline(x[strip], radius[strip], bins[0], crest_x)
    L = (line if line else (np.min(x - radius), np.max(x + radius)))
    foot = line[1] if line else np.inf
    side = np.where(strip | (x + radius <= foot), 0, np.where(z < centroid[2], -1, 1))
    left, right = (np.max((x + radius)[side == s], initial=foot) - foot if line else 0.0 for s in (-1, 1))
    W, L = np.max(z + radius) - np.min(z - radius), L[1] - L[0]
    W, L = (min(size, length) if periodic else size
            for size, length, periodic in zip((W, L), bed.lengths[::-1], bed.periodic[::-1]))
    return Dune(rows, x, z, centroid, W, L, H, crest_x, foot, left, right, side, surface)


def find_crest(surface, centroid, half_width):
    """H, and crest_x on the centreline [m]."""
    strip = abs(surface.z - centroid[2]) < half_width
    crest = np.max(surface.h[strip], initial=0.0)
    band = max(0.05 * crest, 0.5 * half_width / HALF_WIDTH)
    weight = np.where(strip, surface.h - (crest - band), 0.0).clip(0)
    return surface.h.max(), float(np.average(surface.x, weights=weight)) if weight.any() else centroid[0]


def centreline(x, radius, bin_x, crest_x):
    """(toe, lee foot) [m]: around the crest the columns of bins that hold sand without a gap."""
    if len(x) == 0:
        return None
    column = np.floor(x / bin_x).astype(int)
    held = np.unique(column)
    piece = np.cumsum(np.concatenate([[0], np.diff(held) > 1]))
    nearest = piece[np.argmin(abs(held + 0.5 - crest_x / bin_x))]
    kept = np.isin(column, held[piece == nearest])
    return np.min((x - radius)[kept]), np.max((x + radius)[kept])
