"""The outline of a run's main dune in its vertical plane of symmetry."""

from dataclasses import dataclass

import numpy as np

from barchan.dune.height_map import HeightMap
from barchan.dune.shape import BIN, HALF_WIDTH
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder


@dataclass
class Outline:
    """The outline of a dune in its vertical plane of symmetry.

    Attributes
    ----------
    x : numpy.ndarray
        (n) places along the flow, ascending [m].
    h : numpy.ndarray
        (n) heights [m].
    z : float
        Place of the plane across the flow [m].
    foot : float
        Place of the toe along the flow [m].
    length : float
        Length of the dune [m].
    """

    x: np.ndarray
    h: np.ndarray
    z: float
    foot: float
    length: float

    def height(self, x: float) -> float:
        """Height at a place, linear between those of the outline.

        Parameters
        ----------
        x : float
            Place along the flow [m].

        Returns
        -------
        float
            Height [m], zero beyond the outline.
        """
        return float(np.interp(x, self.x, self.h, left=0.0, right=0.0))


def main_outline(run: RunFolder) -> Outline:
    """The outline of the main dune in the last frame of grains.h5. Sand between the horns is not of it.

    Parameters
    ----------
    run : Run
        The run.

    Returns
    -------
    Outline
        The outline.

    Raises
    ------
    MissingData
        Where that frame has no dune with grains on its centreline.
    """
    grains, bed = run.frame(-1), tracks(run).bed
    dune = tracks(run).main_dune(grains)
    if dune is None or not np.isfinite(dune.lee_foot):
        raise MissingData("needs a dune with grains on its centreline in the last frame of grains.h5")
    rows = dune.rows
    foot, end, z = dune.toe, dune.lee_foot, float(dune.centroid[2])
    mean = grains.d.mean()
    margin = 4.0 * BIN * mean
    window = (foot - margin, end + margin, dune.z.min() - margin, dune.z.max() + margin)
    x = np.stack([dune.x, grains.x[rows, 1], dune.z], axis=1)  # periodic images undone
    surface = HeightMap(Grains(grains.time, grains.id[rows], x, grains.d[rows]), window, BIN * mean)
    h = surface.profile(z, HALF_WIDTH * mean)
    h[(surface.x_middle < foot) | (surface.x_middle > end)] = 0.0
    plane = z % bed.lengths[1] if bed.periodic[1] else z
    return Outline(surface.x_middle, h, plane, float(foot), float(end - foot))
