"""Which grains form the horns of the main dune, and where they came from; no drawing.

A grain is in a horn when it belongs to the dune, lies beside the strip along its centreline and
reaches downstream of the lee foot, so that the horn lengths of dune.csv are how far these grains
reach. A horn shorter than a bin is none: below that the outline of a heap is not known (2.5 mean
diameters; docs/dune-measures.md). Lengths in m, polar angle phi in degrees: 0 downstream, 90 left
(z < Cz), 270 right.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from functools import lru_cache

import numpy as np

from barchan.dune.shape import BIN, Bed, Dune
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder

LEFT, RIGHT = -1, 1


@dataclass
class Heap:
    """The heap that a run starts from.

    Attributes
    ----------
    id : numpy.ndarray
        (N) ids of the grains of the first frame, ascending.
    x : numpy.ndarray
        (N, 3) places relative to the heap's centroid [m].
    R : float
        Radius of the heap: (W + L)/4 of the main dune at that time [m].
    own : numpy.ndarray
        (N) bool: which grains belong to it and not to another dune.
    phi : numpy.ndarray
        (N) polar angles [degrees].
    r : numpy.ndarray
        (N) distances from the centroid [R].
    """

    id: np.ndarray
    x: np.ndarray
    R: float
    own: np.ndarray

    @property
    def phi(self) -> np.ndarray:
        return polar_angle(self.x)

    @property
    def r(self) -> np.ndarray:
        return np.hypot(self.x[:, 0], self.x[:, 2]) / self.R

    def rows(self, ids: np.ndarray) -> np.ndarray:
        """Where grains are in the arrays of the heap.

        Parameters
        ----------
        ids : numpy.ndarray
            Ids of grains.

        Returns
        -------
        numpy.ndarray
            Their places; ids that are not in the heap are left out.
        """
        at = np.minimum(np.searchsorted(self.id, ids), len(self.id) - 1)
        return at[self.id[at] == ids]


@dataclass
class Horns:
    """The horns in each of F frames.

    Attributes
    ----------
    t : numpy.ndarray
        (F) times [s].
    left, right : numpy.ndarray
        (F) lengths of the horns [m].
    centroid : numpy.ndarray
        (F, 3) centroid of the main dune, periodic images undone; NaN while there is none [m].
    ids : list of numpy.ndarray
        (F) ids of the grains in the horns.
    sides : list of numpy.ndarray
        (F) which horn each of them is in: -1 left, +1 right.
    heap : Heap
        The heap of the first frame.
    """

    t: np.ndarray
    left: np.ndarray
    right: np.ndarray
    centroid: np.ndarray
    ids: list
    sides: list
    heap: Heap

    def ever(self, last: int) -> np.ndarray:
        """Grains that were in a horn.

        Parameters
        ----------
        last : int
            Number of the last frame that counts.

        Returns
        -------
        numpy.ndarray
            Their ids, ascending.
        """
        return np.unique(np.concatenate(self.ids[:last + 1]))

    def visits(self, ids: np.ndarray, last: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """When grains were in a horn.

        Parameters
        ----------
        ids : numpy.ndarray
            (n) ids of grains.
        last : int
            Number of the last frame that counts.

        Returns
        -------
        first : numpy.ndarray
            (n) number of the first frame in which each was in a horn, -1 for none.
        latest : numpy.ndarray
            (n) number of the last one, -1 for none.
        side : numpy.ndarray
            (n) the horn it was in first: -1 left, +1 right, 0 none.
        """
        first, latest = np.full(len(ids), -1), np.full(len(ids), -1)
        side = np.zeros(len(ids), int)
        for frame in range(last + 1):
            _, at, there = np.intersect1d(ids, self.ids[frame], assume_unique=True, return_indices=True)
            latest[at] = frame
            new = first[at] < 0
            first[at[new]], side[at[new]] = frame, self.sides[frame][there[new]]
        return first, latest, side

    def upstream(self, ids: np.ndarray) -> float:
        """Share of grains that came from the upstream half of the heap.

        Parameters
        ----------
        ids : numpy.ndarray
            Ids of grains.

        Returns
        -------
        float
            The share; NaN for none.
        """
        return share_upstream(self.heap.phi[self.heap.rows(ids)])


def polar_angle(x: np.ndarray) -> np.ndarray:
    """Polar angles of places: 0 downstream, 90 left (z < 0), 270 right.

    Parameters
    ----------
    x : numpy.ndarray
        (..., 3) places relative to a centroid [m].

    Returns
    -------
    numpy.ndarray
        (...) angles in [0, 360) [degrees].
    """
    return np.degrees(np.arctan2(-x[..., 2], x[..., 0])) % 360.0


def share_upstream(phi: np.ndarray) -> float:
    """Share of angles in the upstream half.

    Parameters
    ----------
    phi : numpy.ndarray
        (n) polar angles [degrees].

    Returns
    -------
    float
        The share; NaN for none.
    """
    return float(np.mean((phi > 90) & (phi < 270))) if len(phi) else np.nan


def in_sectors(phi: np.ndarray, sectors: Sequence[tuple[float, float]]) -> np.ndarray:
    """Which angles lie in sectors.

    Parameters
    ----------
    phi : numpy.ndarray
        (n) polar angles [degrees].
    sectors : sequence of tuple of float
        ((from, to), ...), ends included [degrees].

    Returns
    -------
    numpy.ndarray
        (n) bool: in one of them.
    """
    return np.any([(phi >= low) & (phi <= high) for low, high in sectors], axis=0)


@lru_cache(maxsize=4)
def find_horns(run: RunFolder) -> Horns:
    """The horns in all frames of a run.

    Parameters
    ----------
    run : Run
        The run.

    Returns
    -------
    Horns
        Of the frames of tracks.h5, else of those of grains.h5.

    Raises
    ------
    MissingData
        Where there are no such frames, no dune.csv, or no heap of at least 100 grains in the first frame.
    """
    source = tracks(run)
    heap, lengths, centroids, ids, sides = None, [], [], [], []
    centroid = None
    for index in range(len(source.times)):
        grains = source.read(index)
        dune = source.main_dune(grains)
        heap = heap or first_heap(grains, dune, source.bed)
        if dune is not None:
            here = dune.centroid
            centroid = here if centroid is None else centroid + source.bed.nearest(here - centroid)
        number, side = members(grains, dune)
        ids.append(number)
        sides.append(side)
        centroids.append(np.full(3, np.nan) if dune is None else centroid)
        lengths.append((np.nan, np.nan) if dune is None else (dune.horn_left, dune.horn_right))
    left, right = np.array(lengths).T
    assert heap is not None  # first_heap raises where there is none
    return Horns(source.times, left, right, np.array(centroids), ids, sides, heap)


def first_heap(grains: Grains, dune: Dune | None, bed: Bed) -> Heap:
    if dune is None:
        raise MissingData("needs a heap of at least 100 grains in its first frame")
    own = np.zeros(len(grains.id), bool)
    own[dune.rows] = True
    return Heap(grains.id, bed.nearest(grains.x - dune.centroid), 0.25 * (dune.W + dune.L), own)


def members(grains: Grains, dune: Dune | None) -> tuple[np.ndarray, np.ndarray]:
    """(ids, sides) of the grains in horns that are at least one bin long, ids ascending."""
    if dune is None:
        return np.zeros(0, np.int64), np.zeros(0, int)
    least = BIN * grains.d.mean()
    counted = [side for side, length in ((LEFT, dune.horn_left), (RIGHT, dune.horn_right))
               if length >= least]
    chosen = np.isin(dune.side, counted)
    order = np.argsort(grains.id[dune.rows[chosen]])
    return grains.id[dune.rows[chosen]][order], dune.side[chosen][order]


def follow(run: RunFolder, ids: np.ndarray, frames: np.ndarray) -> np.ndarray:
    """Paths of grains from the first frame on, about the centroid of the heap.

    Periodic images are undone from frame to frame: a grain moves less than half a period between two frames that are
    next
    to each other in the file.

    Parameters
    ----------
    run : Run
        The run.
    ids : numpy.ndarray
        (n) ids of grains.
    frames : numpy.ndarray
        (F) numbers of frames.

    Returns
    -------
    numpy.ndarray
        (F, n, 3) places [m]; NaN from when a grain has left.
    """
    source, heap = tracks(run), find_horns(run).heap
    frames = np.asarray(frames)
    paths = np.full((len(frames), len(ids), 3), np.nan)
    place = np.full((len(ids), 3), np.nan)
    known = np.isin(ids, heap.id)
    place[known] = heap.x[heap.rows(ids)]
    previous = None
    for index in range(frames.max() + 1):
        x = positions(source.read(index), ids)
        if previous is not None:
            place = place + source.bed.nearest(x - previous)
        previous = x
        paths[frames == index] = place
    return paths


def positions(grains: Grains, ids: np.ndarray) -> np.ndarray:
    """x (len(ids), 3) [m] of the grains with these ids, NaN where there is none."""
    at = np.minimum(np.searchsorted(grains.id, ids), len(grains.id) - 1)
    return np.where((grains.id[at] == ids)[:, None], grains.x[at], np.nan)
