"""How much sand goes over a line across the flow, and how grains that move do so.

Definitions: docs/dune-measures.md, "Slopes and transport". SI units.
"""

import numpy as np

from barchan.dune.shape import BIN, HALF_WIDTH, Bed, Dune
from barchan.errors import MissingData
from barchan.io.frames import Grains

KINDS = ("saltation", "rolling", "creep")
SLAB = (2.0, 4.0)  # heights between which the packing is measured, in mean diameters
DEEP = 6.0         # ... in bins that are at least so high, and their neighbours


def volumes(d: np.ndarray) -> np.ndarray:
    """Volumes of spheres.

    Parameters
    ----------
    d : numpy.ndarray
        Diameters [m].

    Returns
    -------
    numpy.ndarray
        Volumes [m3], of the same shape.
    """
    return np.pi / 6 * d**3


def crossings(before: Grains, after: Grains, bed: Bed, x: float, z: float,
              half_width: float) -> tuple[float, int]:
    """Sand that crossed a line across the flow between two frames.

    Parameters
    ----------
    before, after : Grains
        The two frames: id (N), x (N, 3), d (N) [m]; a grain moves less than half a period between them.
    bed : Bed
        What the grains lie on.
    x : float
        Place of the line along the flow [m].
    z : float
        Its middle across the flow [m].
    half_width : float
        Half its length [m].

    Returns
    -------
    volume : float
        Net solid volume that crossed it downstream [m3]. It does not depend on the ways between the frames.
    number : int
        Crossings, back and forth; grains that left the domain between the frames count as none.
    """
    ids, a, b = np.intersect1d(before.id, after.id, assume_unique=True, return_indices=True)
    start = bed.nearest(before.x[a] - (x, 0, z))
    way = bed.nearest(after.x[b] - before.x[a])
    end = start + way
    direction = (end[:, 0] >= 0).astype(int) - (start[:, 0] >= 0)
    at = np.nonzero(direction)[0]
    place = start[at, 2] - way[at, 2] * start[at, 0] / way[at, 0]
    at = at[abs(place) < half_width]
    return float(np.sum(direction[at] * volumes(before.d[a][at]))), len(at)


def packing(grains: Grains, dune: Dune) -> float:
    """Packing fraction inside a dune, two to four mean diameters above the floor.

    Parameters
    ----------
    grains : Grains
        The frame: x (N, 3), d (N) [m].
    dune : Dune
        The dune.

    Returns
    -------
    float
        Solid volume over volume; NaN in a dune too low.
    """
    rows, surface = dune.rows, dune.surface
    low, high = (level * grains.d.mean() for level in SLAB)
    deep = surface.lowest >= DEEP * grains.d.mean()
    area = np.count_nonzero(deep) * np.prod(surface.bins)
    if area == 0:
        return np.nan
    inside = surface.in_bins(deep, dune.x, dune.z)
    y, r = grains.x[rows, 1][inside], 0.5 * grains.d[rows][inside]
    return float(np.sum(slice_volumes(low - y, high - y, r)) / (area * (high - low)))


def solid_height(grains: Grains, dune: Dune) -> float:
    """Packing fraction times height, phi H, at the crest of a dune of any height.

    Parameters
    ----------
    grains : Grains
        The frame: d (N) [m].
    dune : Dune
        The dune.

    Returns
    -------
    float
        Solid volume over floor area of a bin to each side of the crest [m].
    """
    d = grains.d.mean()
    near = (abs(dune.x - dune.crest_x) < BIN * d) & (abs(dune.z - dune.centroid[2]) < HALF_WIDTH * d)
    return float(np.sum(volumes(grains.d[dune.rows][near])) / (4 * BIN * HALF_WIDTH * d**2))


def slice_volumes(low: np.ndarray, high: np.ndarray, r: np.ndarray) -> np.ndarray:
    """Volume of spheres of radius r between the heights low and high above their centres [m3]."""
    def below(height: np.ndarray) -> np.ndarray:
        height = np.clip(height, -r, r)
        return np.pi * (r**2 * height - height**3 / 3 + 2 * r**3 / 3)
    return below(high) - below(low)


def shares(grains: Grains, dune: Dune) -> tuple[float, ...]:
    """How the grains of a dune move: shares of its streamwise volume flux.

    Parameters
    ----------
    grains : Grains
        The frame: x (N, 3), d (N) [m], u (N, 3) [m/s].
    dune : Dune
        The dune.

    Returns
    -------
    tuple of float
        (3) of saltation (grains whose lower edge is above the surface), rolling (whose upper edge is less than a mean
        diameter below it) and creep (deeper); NaN where the flux is zero.

    Raises
    ------
    MissingData
        Where the frame has no velocities.
    """
    if grains.u is None:
        raise MissingData("needs frames with the velocities of the grains")
    rows = dune.rows
    r = 0.5 * grains.d[rows]
    above = grains.x[rows, 1] - dune.surface.at(dune.x, dune.z)
    flux = volumes(grains.d[rows]) * grains.u[rows, 0]
    flying, deep = above - r > 0, above + r < -grains.d.mean()
    total = flux.sum()
    if total == 0:
        return (np.nan,) * 3
    return tuple(float(flux[kind].sum() / total) for kind in (flying, ~flying & ~deep, deep))
