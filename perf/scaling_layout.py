"""Which rank has which grains: pieces of the Morton curve, their ghosts, their visits to the flow.

Counted on a map of columns, as the program counts them: kernels/grains/grain_owners.hpp,
src/grains/grain_partition.cpp.
"""

from dataclasses import dataclass

import numpy as np

from scaling_counts import Border

LARGEST_RADIUS, SKIN = 1.25e-4, 4e-5  # [m], Table II of the paper, grains.skin
CHUNK = 1 << 20                       # columns looked at together


@dataclass
class Columns:
    """Columns with grains, in the order of the curve."""
    place: np.ndarray   # on the curve
    ix: np.ndarray
    iz: np.ndarray
    grains: np.ndarray  # in each
    n: tuple            # columns along x, z of the domain
    size: tuple         # of the domain along x, z [m]


def spread_bits(a):
    """kernels/grains/neighbor_search.hpp."""
    a = a.astype(np.uint64)
    for shift, mask in ((8, 0x00FF00FF), (4, 0x0F0F0F0F), (2, 0x33333333), (1, 0x55555555)):
        a = (a | (a << np.uint64(shift))) & np.uint64(mask)
    return a


def place_of(ix, iz):
    """Columns::code_of()."""
    return (spread_bits(ix) << np.uint64(1)) | spread_bits(iz)


def column_counts(size):
    """column_count() of src/grains/neighbor_list.cpp along x and z."""
    cutoff = 2 * LARGEST_RADIUS + SKIN
    return tuple(int(extent / cutoff) for extent in size)


def in_order(ix, iz, grains, n, size):
    place = place_of(ix, iz)
    order = np.argsort(place)
    return Columns(place[order], ix[order], iz[order], grains[order], n, size)


def columns_of_grains(x, z, size):
    n = column_counts(size)
    ix = np.clip((x * n[0] / size[0]).astype(np.int64), 0, n[0] - 1)
    iz = np.clip((z * n[1] / size[1]).astype(np.int64), 0, n[1] - 1)
    index, grains = np.unique(ix * n[1] + iz, return_counts=True)
    return in_order(index // n[1], index % n[1], grains.astype(float), n, size)


def columns_of_dunes(tiles, tile=(0.4, 0.1), grains=1e5, radius=0.013):
    """A heap of the paper in each tile, somewhere: a cone, as heaps settle (1e5 grains: 13 mm)."""
    size = (tiles[0] * tile[0], tiles[1] * tile[1])
    n = column_counts(size)
    width = (size[0] / n[0], size[1] / n[1])
    reach = [int(radius / w) + 1 for w in width]
    dx, dz = np.meshgrid(*(np.arange(-r, r + 1) for r in reach), indexing="ij")
    height = 1 - np.hypot(dx * width[0], dz * width[1]) / radius
    inside = height > 0
    shape = grains * height[inside] / height[inside].sum()
    random = np.random.default_rng(1)
    corner = np.stack(np.meshgrid(*(np.arange(t) for t in tiles), indexing="ij"), -1).reshape(-1, 2)
    margin = np.array([reach[a] * width[a] / tile[a] for a in (0, 1)])
    where = (corner + margin + random.random(corner.shape) * (1 - 2 * margin)) * np.array(tile)
    centre = (where / np.array(width)).astype(np.int64)
    ix = (centre[:, :1] + dx[inside]).ravel()
    iz = (centre[:, 1:] + dz[inside]).ravel()
    return in_order(ix, iz, np.tile(shape, len(centre)), n, size)


def cuts(columns, ranks):
    """Where equal pieces of the grains begin: equal_pieces()."""
    work = np.cumsum(columns.grains)
    last = np.searchsorted(work, work[-1] * np.arange(1, ranks) / ranks - 1e-9)
    return np.concatenate([[np.uint64(0)], columns.place[last] + np.uint64(1)])


def owner_of(start, place):
    """GrainOwners::of_place()."""
    return np.searchsorted(start, place, side="right") - 1


def may_be_at_border(columns, start):
    """Not within a square of 32 x 32 columns that one rank has: squares are pieces of the curve."""
    square, side = np.uint64(10), 32
    begin = (columns.place >> square) << square
    end = begin + np.uint64(side * side - 1)
    inside = owner_of(start, begin) == owner_of(start, end)
    for index in (columns.ix, columns.iz):
        inside &= (index % side > 0) & (index % side < side - 1)
    return np.flatnonzero(~inside)


def onlookers(columns, start, part):
    """(column of `part`, rank) of all ranks that need a copy of its grains, each once: Onlookers."""
    ix, iz = columns.ix[part], columns.iz[part]
    me = owner_of(start, columns.place[part])
    pairs = []
    for dx in (-1, 0, 1):
        for dz in (-1, 0, 1):
            there = (ix + dx >= 0) & (ix + dx < columns.n[0])
            place = place_of(np.clip(ix + dx, 0, None), (iz + dz) % columns.n[1])
            other = owner_of(start, place)
            at = np.flatnonzero(there & (other != me))
            pairs.append(np.stack([at, other[at]], 1))
    found = np.unique(np.concatenate(pairs), axis=0)
    return me, found[:, 0], found[:, 1]


def distinct(pairs_from, pairs_to, ranks):
    """How many ranks each rank has records for."""
    keys = np.unique(pairs_from.astype(np.int64) * ranks + pairs_to)
    return np.bincount(keys // ranks, minlength=ranks)


def pencil_of(columns, shape, cells):
    """PencilOwners."""
    part = []
    for index, n_columns, n, parts in zip((columns.ix, columns.iz), columns.n, cells, shape):
        cell = ((index + 0.5) / n_columns * n).astype(np.int64)
        size, longer = divmod(n, parts)
        edge = longer * (size + 1)
        part.append(np.where(cell < edge, cell // (size + 1), longer + (cell - edge) // max(size, 1)))
    return part[0] + shape[0] * part[1]


@dataclass
class Layout:
    """Of every rank: arrays by rank."""
    grains: np.ndarray
    in_pencil: np.ndarray  # grains in its pencil, whoever owns them
    ghosts: np.ndarray     # sent
    ghost_ranks: np.ndarray
    away: np.ndarray
    away_ranks: np.ndarray
    visitors: np.ndarray
    visitor_ranks: np.ndarray

    def border(self, rank):
        return Border(self.ghosts[rank], self.ghost_ranks[rank], self.away[rank], self.away_ranks[rank],
                      self.visitors[rank], self.visitor_ranks[rank])

    def worst(self):
        """The largest of each, though not of the same rank: all wait for it in its turn."""
        return Border(*(float(a.max()) for a in (self.ghosts, self.ghost_ranks, self.away, self.away_ranks,
                                                 self.visitors, self.visitor_ranks)))


def layout(columns, shape, cells):
    ranks = shape[0] * shape[1]
    start = cuts(columns, ranks)
    home = owner_of(start, columns.place)

    def by_rank(rank, grains):
        return np.bincount(rank, weights=grains, minlength=ranks)

    ghosts, pairs = np.zeros(ranks), []
    border = may_be_at_border(columns, start)
    for begin in range(0, len(border), CHUNK):
        part = border[begin:begin + CHUNK]
        me, at, other = onlookers(columns, start, part)
        ghosts += by_rank(me[at], columns.grains[part][at])
        pairs.append(np.unique(me[at] * ranks + other))
    pairs = np.concatenate(pairs) if pairs else np.zeros(0, np.int64)
    pencil = pencil_of(columns, shape, cells)
    off = home != pencil
    return Layout(grains=by_rank(home, columns.grains), in_pencil=by_rank(pencil, columns.grains),
                  ghosts=ghosts, ghost_ranks=distinct(pairs // ranks, pairs % ranks, ranks),
                  away=by_rank(home[off], columns.grains[off]),
                  away_ranks=distinct(home[off], pencil[off], ranks),
                  visitors=by_rank(pencil[off], columns.grains[off]),
                  visitor_ranks=distinct(pencil[off], home[off], ranks))
