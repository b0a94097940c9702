"""Slopes of a dune along its centreline: the stoss side, the slip face, the brink; and how symmetric the dune is.

The centreline is the strip of dune.csv, abs(z - Cz) < 3 d, the height the 3 x 3 median of bins (surface.py). Angles
are those of least-squares lines. Definitions: docs/dune-measures.md, "Slopes and transport".
"""

from dataclasses import dataclass

import numpy as np

from barchan.dune.shape import HALF_WIDTH, Dune
from barchan.dune.surface import Surface


LOW, HIGH = 0.2, 0.8  # of the crest's height: between them a side is fitted
WINDOW = 5            # columns of bins over which a local slope is fitted
FEWEST = 3            # columns that make a line


@dataclass
class Slopes:
    """Slopes of a dune along its centreline.

    Attributes
    ----------
    x, h : numpy.ndarray
        (n) the centreline [m].
    crest_height : float
        Its highest point [m].
    stoss, slip_face : float
        Angles of the upstream and of the downstream side [degrees], NaN where a side has too few columns.
    brink_x : float
        Where the slip face begins [m].
    faces : list
        Of the stoss side and of the slip face (x, h) of the two ends of the fitted line, (2) each [m].
    """

    x: np.ndarray
    h: np.ndarray
    crest_height: float
    stoss: float
    slip_face: float
    brink_x: float
    faces: list


def slopes(dune: Dune, diameter: float) -> Slopes | None:
    """Slopes of a dune.

    Parameters
    ----------
    dune : Dune
        The dune.
    diameter : float
        Mean diameter of the grains [m].

    Returns
    -------
    Slopes or None
        None for a dune without sand on its centreline.
    """
    if not np.isfinite(dune.lee_foot):
        return None
    x, h = dune.surface.profile(dune.centroid[2], HALF_WIDTH * diameter)
    inside = (x > dune.toe) & (x < dune.lee_foot)
    return of_profile(x[inside], h[inside], dune.crest_x) if inside.any() else None


def of_profile(x: np.ndarray, h: np.ndarray, crest_x: float) -> Slopes:
    """Slopes of a profile of heights.

    Parameters
    ----------
    x : numpy.ndarray
        (n) places along the flow, ascending [m].
    h : numpy.ndarray
        (n) heights [m].
    crest_x : float
        Place of the crest [m].

    Returns
    -------
    Slopes
        Of lines through the heights between 0.2 and 0.8 of the highest, and from the brink down to 0.2 of it.
    """
    top = h.max()
    rising = (x < crest_x) & (h >= LOW * top) & (h <= HIGH * top)
    brink = find_brink(x, h, crest_x)
    falling = (x >= brink) & (h >= LOW * top)
    faces = [line(x[side], h[side]) for side in (rising, falling)]
    stoss, slip = (np.degrees(np.arctan2(face[1][1] - face[1][0], face[0][1] - face[0][0])) for face in faces)
    return Slopes(x, h, float(top), float(stoss), -float(slip), brink, faces)


def line(x: np.ndarray, h: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """(x, h) of the two ends of the least-squares line, not numbers for too few points."""
    if len(x) < FEWEST:
        return np.full(2, np.nan), np.full(2, np.nan)
    slope, offset = np.polyfit(x, h, 1)
    ends = x[[0, -1]]
    return ends, slope * ends + offset


def find_brink(x: np.ndarray, h: np.ndarray, crest_x: float) -> float:
    """From the crest downstream the first column whose local slope is half of the steepest one [m]."""
    half = WINDOW // 2
    lee = np.nonzero(x >= crest_x)[0]
    lee = lee[(lee >= half) & (lee + half < len(x))]
    if len(lee) == 0:
        return np.nan
    near = [slice(i - half, i + half + 1) for i in lee]
    fall = np.array([-np.polyfit(x[columns], h[columns], 1)[0] for columns in near])
    return float(x[lee[np.argmax(fall >= 0.5 * fall.max())]])


def asymmetry(surface: Surface, z: float) -> float:
    """How far a dune is from being its own mirror image about a plane along the flow.

    Parameters
    ----------
    surface : Surface
        Surface of the dune.
    z : float
        Place of the plane across the flow [m].

    Returns
    -------
    float
        Mean difference of the heights at equal distances left and right of the plane over their mean sum: 0 for a dune
        that is its own mirror image, 1 for one that lies on one side.
    """
    mirrored = surface.at(surface.x, 2 * z - surface.z)
    whole = surface.h + mirrored
    return float(np.sum(abs(surface.h - mirrored)) / np.sum(whole)) if whole.any() else np.nan
