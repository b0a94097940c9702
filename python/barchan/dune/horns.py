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
    """The first frame: ids (N), x (N, 3) relative to the heap's centroid [m], its radius R [m].

    R = (W + L)/4 of the main dune at that time; `own` (N): which grains belong to it and not to
    another dune. phi (N) [degrees] and r (N) [in units of R].
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
        """Where `ids` are in the heap; ids that are not there are left out."""
        at = np.minimum(np.searchsorted(self.id, ids), len(self.id) - 1)
        return at[self.id[at] == ids]


@dataclass
class Horns:
    """The horns in each of F frames.

    t (F) [s]; left, right (F): horn lengths [m]; centroid (F, 3) [m], periodic images undone, NaN
    while there is no main dune; ids, sides: lists of F arrays, the grains in the horns and which
    (-1 left, +1 right).
    """

    t: np.ndarray
    left: np.ndarray
    right: np.ndarray
    centroid: np.ndarray
    ids: list
    sides: list
    heap: Heap

    def ever(self, last: int) -> np.ndarray:
        """Ids of the grains that were in a horn at any frame up to `last`, ascending."""
        return np.unique(np.concatenate(self.ids[:last + 1]))

    def visits(self, ids: np.ndarray, last: int) -> tuple[np.ndarray, np.ndarray, np.ndarray]:
        """(first, latest, side) of each grain: frames in which it was in a horn, which one first."""
        first, latest = np.full(len(ids), -1), np.full(len(ids), -1)
        side = np.zeros(len(ids), int)
        for frame in range(last + 1):
            _, at, there = np.intersect1d(ids, self.ids[frame], assume_unique=True, return_indices=True)
            latest[at] = frame
            new = first[at] < 0
            first[at[new]], side[at[new]] = frame, self.sides[frame][there[new]]
        return first, latest, side

    def upstream(self, ids: np.ndarray) -> float:
        """Share of `ids` that came from the upstream half of the heap; NaN for none."""
        return share_upstream(self.heap.phi[self.heap.rows(ids)])


def polar_angle(x: np.ndarray) -> np.ndarray:
    """phi [degrees] in [0, 360) of positions (..., 3) relative to a centroid."""
    return np.degrees(np.arctan2(-x[..., 2], x[..., 0])) % 360.0


def share_upstream(phi: np.ndarray) -> float:
    """Share of angles [degrees] in the upstream half; NaN for none."""
    return float(np.mean((phi > 90) & (phi < 270))) if len(phi) else np.nan


def in_sectors(phi: np.ndarray, sectors: Sequence[tuple[float, float]]) -> np.ndarray:
    """Which angles lie in one of the sectors ((from, to), ...) [degrees], ends included."""
    return np.any([(phi >= low) & (phi <= high) for low, high in sectors], axis=0)


@lru_cache(maxsize=4)
def find_horns(run: RunFolder) -> Horns:
    """The horns in all frames of a run."""
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
    """Paths (len(frames), len(ids), 3) [m] of grains from the first frame on, about the heap's centroid.

    Periodic images are undone from frame to frame: a grain moves less than half a period between two
    frames that are next to each other in the file. NaN from when a grain has left.
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
