"""The dunes of one frame, found and measured as the program does for dune.csv.

The same bins, thresholds and centreline as src/diagnostics/dune_map.cpp and src/diagnostics/dune_shape.cpp (definitions in
docs/conventions.md), so that what is said about single grains, e.g. that one lies in a horn, agrees
with the lengths in dune.csv. Lengths in m, angles from +x. Criteria are in mean grain diameters.
"""

from dataclasses import dataclass

import numpy as np

BIN = 2.5          # side of a bin
CORE_COVER = 1.2   # summed cross-sections over area: no single layer reaches this
RIM_COVER = 0.3
RIM_REACH = 12.0   # how far the rim goes out from a core
MIN_GRAINS = 100
HALF_WIDTH = 3.0   # of the centreline's strip
OFFSETS = [(i, k) for k in (-1, 0, 1) for i in (-1, 0, 1) if (i, k) != (0, 0)]


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
    """

    rows: np.ndarray
    x: np.ndarray
    z: np.ndarray
    centroid: np.ndarray
    volume: float
    W: float
    L: float
    H: float
    crest_x: float
    lee_foot: float
    horn_left: float
    horn_right: float
    side: np.ndarray


class Bins:
    """The bins that hold grains: ix, iz, cover, top [m] (n_bins each); of_grain (N) points into them.

    near (n_bins, 8): the neighbours, -1 where no grain is. region (n_bins): -1 outside dunes.
    ux, uz: ix, iz with periodic images undone, so that a region is in one piece.
    """

    def __init__(self, grains, bed):
        self.diameter = float(grains.d.mean())
        n = [max(1, int(length / (BIN * self.diameter))) for length in bed.lengths]
        self.size = np.array([length / count for length, count in zip(bed.lengths, n)])
        self.periods = [count if periodic else 0 for count, periodic in zip(n, bed.periodic)]
        place = np.floor(grains.x[:, [0, 2]] / self.size).astype(np.int64)
        self.of_grain = self._collect(self._wrap(place))
        n_bins = len(self.ix)
        area = 0.25 * np.pi * grains.d**2
        self.cover = np.bincount(self.of_grain, area, n_bins) / np.prod(self.size)
        self.top = np.zeros(n_bins)
        np.maximum.at(self.top, self.of_grain, grains.x[:, 1] + 0.5 * grains.d)
        self.inside = grains.x[:, [0, 2]] - place * self.size  # of each grain, from its bin's corner
        self._label(self._mark())

    def _wrap(self, place):
        for axis, period in enumerate(self.periods):
            if period:
                place[:, axis] %= period
        return place

    def _collect(self, place):
        low, span = place.min(axis=0) - 1, np.ptp(place, axis=0) + 3

        def find(ix, iz):
            key = (ix - low[0]) * span[1] + iz - low[1]
            at = np.minimum(np.searchsorted(keys, key), len(keys) - 1)
            outside = (ix < low[0]) | (ix >= low[0] + span[0]) | (iz < low[1]) | (iz >= low[1] + span[1])
            return np.where((keys[at] == key) & ~outside, at, -1)

        keys, of_grain = np.unique((place[:, 0] - low[0]) * span[1] + place[:, 1] - low[1],
                                   return_inverse=True)
        self.ix, self.iz = keys // span[1] + low[0], keys % span[1] + low[1]
        near = [find(*self._wrap(np.stack([self.ix + i, self.iz + k], axis=1)).T) for i, k in OFFSETS]
        self.near = np.stack(near, axis=1)
        return of_grain.ravel()

    def _mark(self):
        """Core bins, and the rim grown from them one bin per step, up to the reach."""
        marked = self.cover >= CORE_COVER
        for _ in range(int(np.ceil(RIM_REACH * self.diameter / self.size.max()))):
            reached = (marked[self.near] & (self.near >= 0)).any(axis=1)
            marked = marked | (reached & (self.cover >= RIM_COVER))
        return marked

    def _label(self, marked):
        """Connected bins, front by front; a bin takes its unwrapped place from where it was reached."""
        self.region = np.full(len(self.ix), -1)
        self.ux, self.uz = self.ix.copy(), self.iz.copy()
        self.n_regions = 0
        for seed in np.nonzero(marked)[0]:
            if self.region[seed] >= 0:
                continue
            front = np.array([seed])
            self.region[seed] = self.n_regions
            while len(front):
                front = self._spread(front, marked)
            self.n_regions += 1

    def _spread(self, front, marked):
        reached = []
        for (i, k), target in zip(OFFSETS, self.near[front].T):
            new = (target >= 0) & marked[target] & (self.region[target] < 0)
            self.region[target[new]] = self.n_regions
            self.ux[target[new]], self.uz[target[new]] = self.ux[front[new]] + i, self.uz[front[new]] + k
            reached.append(target[new])
        return np.concatenate(reached)

    def surface(self, bins):
        """3 x 3 median of the height [m] of `bins`, what is outside their region counting as zero."""
        near = self.near[bins]
        same = (near >= 0) & (self.region[near] == self.region[bins, None])
        heights = np.column_stack([self.top[bins], np.where(same, self.top[near], 0.0)])
        return np.median(heights, axis=1)


def find_dunes(grains, bed):
    """The dunes of a frame, the largest first; grains have x (N, 3), d (N) [m]."""
    if len(grains.d) == 0:
        return []
    bins = Bins(grains, bed)
    region_of_grain = bins.region[bins.of_grain]
    order = np.argsort(region_of_grain, kind="stable")
    starts = np.searchsorted(region_of_grain[order], np.arange(bins.n_regions + 1))
    dunes = [measure(grains, bins, order[first:last], bed)
             for first, last in zip(starts, starts[1:]) if last - first >= MIN_GRAINS]
    return sorted(dunes, key=lambda dune: -dune.volume)


def measure(grains, bins, rows, bed):
    at = bins.of_grain[rows]
    x, z = (np.stack([bins.ux[at], bins.uz[at]]) * bins.size[:, None] + bins.inside[rows].T)
    radius = 0.5 * grains.d[rows]
    volume = np.pi / 6.0 * grains.d[rows]**3
    centroid = np.array([np.average(values, weights=volume) for values in (x, grains.x[rows, 1], z)])
    H, crest_x = find_crest(bins, np.unique(at), centroid)
    strip = abs(z - centroid[2]) < HALF_WIDTH * bins.diameter
    line = centreline(x[strip], radius[strip], bins.ux[at][strip], crest_x / bins.size[0])
    L = (line if line else (np.min(x - radius), np.max(x + radius)))
    foot = line[1] if line else np.inf
    side = np.where(strip | (x + radius <= foot), 0, np.where(z < centroid[2], -1, 1))
    left, right = (np.max((x + radius)[side == s], initial=foot) - foot if line else 0.0 for s in (-1, 1))
    W, L = np.max(z + radius) - np.min(z - radius), L[1] - L[0]
    W, L = (min(size, length) if periodic else size
            for size, length, periodic in zip((W, L), bed.lengths[::-1], bed.periodic[::-1]))
    return Dune(rows, x, z, centroid, volume.sum(), W, L, H, crest_x, foot, left, right, side)


def find_crest(bins, region, centroid):
    """H over the bins of the region, crest_x on its centreline [m]."""
    surface = bins.surface(region)
    x, z = (bins.ux[region] + 0.5) * bins.size[0], (bins.uz[region] + 0.5) * bins.size[1]
    strip = abs(z - centroid[2]) < HALF_WIDTH * bins.diameter
    crest = np.max(surface[strip], initial=0.0)
    weight = np.where(strip, surface - (crest - max(0.05 * crest, 0.5 * bins.diameter)), 0.0).clip(0)
    return surface.max(), float(np.average(x, weights=weight)) if weight.any() else centroid[0]


def centreline(x, radius, column, crest):
    """(toe, lee foot) [m]: around the crest the columns of bins that hold sand without a gap."""
    if len(x) == 0:
        return None
    held = np.unique(column)
    piece = np.cumsum(np.concatenate([[0], np.diff(held) > 1]))
    nearest = piece[np.argmin(abs(held + 0.5 - crest))]
    kept = np.isin(column, held[piece == nearest])
    return np.min((x - radius)[kept]), np.max((x + radius)[kept])
