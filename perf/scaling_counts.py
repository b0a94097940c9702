"""What each rank sends in a fluid step, and which rank has which grains.

The first part models the counts that a run writes to run.json; scaling.py --check compares them. The second part
divides a map of columns with grains among the ranks, as src/grains/grain_partition.cpp does.
"""

import math
from dataclasses import dataclass, fields

import numpy as np

BYTES = 8                    # of a number
GHOST, GHOST_MOTION = 13, 9  # numbers of a new ghost, and of a ghost in a grain step
GATHER = (15, 21)            # numbers of a grain to the fluid ranks and back, before the grain steps
DEPOSIT = 20                 # to the fluid ranks after them
SWEEPS = 5                   # src/fluid/pressure_solver.cpp
SMOOTHINGS, EXCHANGE_FILLS = 3, 16
LARGEST_RADIUS, SKIN = 1.25e-4, 4e-5  # [m], Table II of the paper, grains.skin
CHUNK = 1 << 20                       # columns looked at together


@dataclass(frozen=True)
class Counts:
    """What one rank sends, as src/parallel/exchange.hpp counts it."""
    messages: float = 0
    bytes: float = 0
    reductions: float = 0
    all_to_alls: float = 0

    def __add__(self, other):
        return Counts(*(getattr(self, f.name) + getattr(other, f.name) for f in fields(self)))

    def __rmul__(self, n):
        return Counts(*(n * getattr(self, f.name) for f in fields(self)))


def sent(messages, numbers):
    return Counts(messages=messages, bytes=BYTES * numbers)


# --- pencils -----------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Split:
    """[0, n) in consecutive parts, the longer ones first: src/parallel/decomposition.hpp."""
    n: int
    parts: int

    def count(self, part):
        return self.n // self.parts + (1 if part < self.n % self.parts else 0)


def fits(n, parts):
    """Decomposition::kThinnest cells across a pencil."""
    return parts == 1 or n // parts >= 2


def cost(nx, nz, px, pz):
    """cost_of() in src/parallel/decomposition.cpp."""
    cells = nx * nz / (px * pz)
    transposes = sum(0 if parts == 1 else 6 * numbers * cells + 400 * times * (parts - 1)
                     for parts, numbers, times in ((px, 3, 4), (pz, 2, 2)))
    halos = sum(0 if parts == 1 else 2 * Split(n, others).count(0)
                for parts, n, others in ((px, nz, pz), (pz, nx, px)))
    return transposes + 40 * halos


def best_shape(ranks, nx, nz):
    """Ranks along x and z, or None if so many pencils do not fit: best_count_along_x()."""
    shapes = [(px, ranks // px) for px in range(1, ranks + 1)
              if ranks % px == 0 and fits(nx, px) and fits(nz, ranks // px)]
    return min(shapes, key=lambda shape: cost(nx, nz, *shape), default=None)


@dataclass(frozen=True)
class Pencil:
    """The cells of one rank: that of rank 0 is never smaller than another."""
    nx_all: int
    ny: int
    nz_all: int
    px: int = 1
    pz: int = 1

    @property
    def nx(self):
        return Split(self.nx_all, self.px).count(0)

    @property
    def nz(self):
        return Split(self.nz_all, self.pz).count(0)

    @property
    def cells(self):
        return self.nx * self.ny * self.nz

    @property
    def colours(self):
        """ColumnNeighbors::colours() in kernels/fluid/column_relaxation.hpp."""
        return 2 if self.nx_all % 2 == 0 and self.nz_all % 2 == 0 else 3


# --- the flow ----------------------------------------------------------------------------------------

def fill(p, ny=None):
    """Halo::fill(): one layer of cells to each side of every cut."""
    rows = (p.ny if ny is None else ny) + 2
    cut_x, cut_z = p.px > 1, p.pz > 1
    return sent(2 * cut_x + 2 * cut_z, 2 * cut_x * rows * p.nz + 2 * cut_z * rows * (p.nx + 2))


def there_and_back(shared, split, others, width):
    """Transpose::join() and cut() on the first of the ranks that share an axis."""
    both = ((shared, split), (split, shared))
    messages = sum(min(to.parts, to.n) - 1 for _, to in both)
    numbers = sum(here.count(0) * (to.n - to.count(0)) for here, to in both)
    return sent(messages, numbers * others * width)


def fft_solve(p):
    """PoissonFft::solve(): lines of x, lines of z and rows made whole, and back (src/fluid/fft.cpp)."""
    cells_x, cells_z = Split(p.nx_all, p.px), Split(p.nz_all, p.pz)
    rows, planes, modes = Split(p.ny, p.px), Split(p.nz_all, p.px), Split(p.nx_all // 2 + 1, p.pz)
    return (there_and_back(cells_x, rows, p.nz, 1) + there_and_back(cells_z, modes, rows.count(0), 2)
            + there_and_back(rows, planes, modes.count(0), 2))


def flow_step(p):
    """FluidSolver::advance() without grains: halo fills, transposes, reductions."""
    return 8 * fill(p) + fft_solve(p) + Counts(reductions=3)


def fill_between_ranks(p):
    """Halo::fill_between_ranks() at most: less where the grains do not reach through the box."""
    cut_x, cut_z = p.px > 1, p.pz > 1
    return sent(2 * cut_x + 2 * cut_z, 2 * p.ny * (cut_x * p.nz + cut_z * p.nx))


def relaxation(p):
    """LocalCorrection::relax() there and back, for each colour and sweep."""
    return 2 * SWEEPS * p.colours * fill_between_ranks(p)


def pressure_iteration(p):
    """The loop of PressureSolver::solve(): the direction, and in LocalCorrection::apply() one more."""
    return 2 * fill(p) + relaxation(p) + fft_solve(p) + Counts(reductions=3)


def pressure_solve(p, iterations):
    """PressureSolver::solve() and LocalCorrection::update(); the first iteration is start()."""
    return (5 * fill(p) + relaxation(p) + fft_solve(p) + 2 * fill(p, ny=1) + Counts(reductions=2)
            + (iterations - 1) * pressure_iteration(p))


def flow_step_around_grains(p, iterations):
    """FluidSolver::advance() with an exchange."""
    return 18 * fill(p) + pressure_solve(p, iterations) + Counts(reductions=3)


def deposit_halo(p):
    """Sums of deposits in the ghost cells, to the cells they belong to: six integers a cell."""
    cut_x, cut_z = p.px > 1, p.pz > 1
    return sent(2 * cut_x + 2 * cut_z, 6 * p.ny * (2 * cut_x * (p.nz + 2) + 2 * cut_z * p.nx))


def exchange(p):
    """Gather and Deposit, with smoothing: here of all columns, as where x is cut."""
    return (EXCHANGE_FILLS * fill(p) + SMOOTHINGS * fft_solve(p) + deposit_halo(p)
            + Counts(reductions=9))


# --- the grains --------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Border:
    """Of one rank: ghosts it sends, its grains in pencils of other ranks, copies of grains of others in its
    own pencil; each with the number of ranks concerned."""
    ghosts: float = 0
    ghost_ranks: float = 0
    away: float = 0
    away_ranks: float = 0
    copies: float = 0
    copies_ranks: float = 0


def to_fluid_and_back(b):
    """FluidSideGrains: copies to the ranks of the flow twice a step, and once what is found there back."""
    return (sent(2 * b.away_ranks, (GATHER[0] + DEPOSIT) * b.away) + sent(b.copies_ranks, GATHER[1] * b.copies)
            + Counts(all_to_alls=2))


def grain_step(b):
    """GrainSolver: the largest displacement, then the motion of the ghosts."""
    return sent(b.ghost_ranks, GHOST_MOTION * b.ghosts) + Counts(reductions=1)


def rebuild(b):
    """NeighborList::rebuild() where no grain changes its rank: balance, speeds, three counts, the ghosts."""
    return sent(b.ghost_ranks, GHOST * b.ghosts) + Counts(reductions=4, all_to_alls=3)


def coupled_step(p, b, iterations, grain_steps, rebuilds):
    """CoupledStep::advance() and the count of grains; a rebuild takes the place of an update."""
    updates = grain_steps - rebuilds
    return (flow_step_around_grains(p, iterations) + exchange(p) + to_fluid_and_back(b)
            + updates * grain_step(b) + rebuilds * (rebuild(b) + Counts(reductions=1))
            + Counts(reductions=4))  # the ledger, grains past the outlet, number of grains, state checks


def levels(ranks):
    """Steps of a tree over so many ranks."""
    return math.ceil(math.log2(ranks)) if ranks > 1 else 0


# --- which rank has which grains ------------------------------------------------------------------------
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
    """SearchColumns::code_of()."""
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
    """GrainOwners::of_code()."""
    return np.searchsorted(start, place, side="right") - 1


def near_other_ranks(columns, start):
    """Not within a square of 32 x 32 columns that one rank has: squares are pieces of the curve."""
    square, side = np.uint64(10), 32
    begin = (columns.place >> square) << square
    end = begin + np.uint64(side * side - 1)
    inside = owner_of(start, begin) == owner_of(start, end)
    for index in (columns.ix, columns.iz):
        inside &= (index % side > 0) & (index % side < side - 1)
    return np.flatnonzero(~inside)


def ghost_destinations(columns, start, part):
    """(column of `part`, rank) of all ranks that need a copy of its grains, each once: GhostDestinations."""
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
    """To how many ranks each rank sends grains."""
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
    """Arrays by rank: its grains, grains in its pencil (of any rank), and what Border holds."""
    grains: np.ndarray
    in_pencil: np.ndarray
    border_by_rank: tuple

    def border(self, rank):
        return Border(*(a[rank] for a in self.border_by_rank))

    def worst(self):
        """The largest of each, though not of the same rank: all wait for it in its turn."""
        return Border(*(float(a.max()) for a in self.border_by_rank))


def layout(columns, shape, cells):
    ranks = shape[0] * shape[1]
    start = cuts(columns, ranks)
    owner = owner_of(start, columns.place)

    def by_rank(rank, grains):
        return np.bincount(rank, weights=grains, minlength=ranks)

    ghosts, pairs = np.zeros(ranks), [np.zeros(0, np.int64)]
    near = near_other_ranks(columns, start)
    for begin in range(0, len(near), CHUNK):
        part = near[begin:begin + CHUNK]
        me, at, other = ghost_destinations(columns, start, part)
        ghosts += by_rank(me[at], columns.grains[part][at])
        pairs.append(np.unique(me[at] * ranks + other))
    pairs = np.concatenate(pairs)
    pencil = pencil_of(columns, shape, cells)
    off = owner != pencil
    border = (ghosts, distinct(pairs // ranks, pairs % ranks, ranks),
              by_rank(owner[off], columns.grains[off]), distinct(owner[off], pencil[off], ranks),
              by_rank(pencil[off], columns.grains[off]), distinct(pencil[off], owner[off], ranks))
    return Layout(by_rank(owner, columns.grains), by_rank(pencil, columns.grains), border)
