"""What a rank sends in a fluid step.

The formulas are those of tests/mpi/message_counts_test.cpp, which compares them with what the program
counts.
"""

import math
from dataclasses import dataclass, fields

WORD = 8                    # bytes of a number
GHOST, GHOST_MOTION = 13, 9  # words of a new ghost, and in a sub-step: src/grains/ghost_grains.cpp
GATHER = (21, 17)           # words a grain takes to the flow and home: gather_needs, gather_gives,
DEPOSIT = (26, 3)           # deposit_needs, carry_gives of src/coupling/coupled_step.cpp
SWEEPS = 2                  # src/fluid/local_correction.cpp


@dataclass(frozen=True)
class Counts:
    """Of one rank, as src/parallel/messages.hpp has them."""
    messages: float = 0
    bytes: float = 0
    reductions: float = 0
    all_to_alls: float = 0

    def __add__(self, other):
        return Counts(*(getattr(self, f.name) + getattr(other, f.name) for f in fields(self)))

    def __rmul__(self, n):
        return Counts(*(n * getattr(self, f.name) for f in fields(self)))


def sent(messages, numbers):
    return Counts(messages=messages, bytes=WORD * numbers)


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
    """Cost::of() in src/parallel/decomposition.cpp."""
    cells = nx * nz / (px * pz)
    transposes = sum(0 if parts == 1 else 6 * numbers * cells + 400 * times * (parts - 1)
                     for parts, numbers, times in ((px, 3, 4), (pz, 2, 2)))
    rims = sum(0 if parts == 1 else 2 * Split(n, others).count(0)
               for parts, n, others in ((px, nz, pz), (pz, nx, px)))
    return transposes + 40 * rims


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
        """ColumnPlaces::colours() in kernels/fluid/column_relaxation.hpp."""
        return 2 if self.nx_all % 2 == 0 and self.nz_all % 2 == 0 else 3


# --- the flow ----------------------------------------------------------------------------------------

def fill(p, ny=None):
    """Halo::fill(): a rim to each side of every cut."""
    rows = (p.ny if ny is None else ny) + 2
    cut_x, cut_z = p.px > 1, p.pz > 1
    return sent(2 * cut_x + 2 * cut_z, 2 * cut_x * rows * p.nz + 2 * cut_z * rows * (p.nx + 2))


def there_and_back(shared, split, others, width):
    """Transpose::join() and cut() on the first rank of a line, for whose ranks both splits have parts."""
    ways = ((shared, split), (split, shared))
    messages = sum(min(to.parts, to.n) - 1 for _, to in ways)
    numbers = sum(here.count(0) * (to.n - to.count(0)) for here, to in ways)
    return sent(messages, numbers * others * width)


def fft_solve(p):
    """PoissonFft::solve(): lines of x, lines of z and rows made whole, and back (src/fluid/fft.cpp)."""
    cells_x, cells_z = Split(p.nx_all, p.px), Split(p.nz_all, p.pz)
    rows, planes, modes = Split(p.ny, p.px), Split(p.nz_all, p.px), Split(p.nx_all // 2 + 1, p.pz)
    return (there_and_back(cells_x, rows, p.nz, 1) + there_and_back(cells_z, modes, rows.count(0), 2)
            + there_and_back(rows, planes, modes.count(0), 2))


def flow_step(p):
    """FluidSolver::advance() without grains: halo fills, transposes, reductions."""
    return 11 * fill(p) + fft_solve(p) + Counts(reductions=3)


def fills_per_iteration(p):
    """The direction; inside LocalCorrection::apply() one, and one for each colour, sweep and way."""
    return 2 + 2 * SWEEPS * p.colours


def pressure_iteration(p):
    """The loop of PressureSolver::solve()."""
    return fills_per_iteration(p) * fill(p) + fft_solve(p) + Counts(reductions=3)


def pressure_solve(p):
    """What PressureSolver::solve() does around the loop, and LocalCorrection::update()."""
    return 2 * fill(p) + 2 * fill(p, ny=1) + Counts(reductions=4)


def flow_step_around_grains(p, iterations):
    """FluidSolver::advance() with an exchange."""
    return (18 * fill(p) + pressure_solve(p) + iterations * pressure_iteration(p)
            + Counts(reductions=6))


def deposit_rims(p):
    """DepositRims::add(): five integers a cell."""
    cut_x, cut_z = p.px > 1, p.pz > 1
    return sent(2 * cut_x + 2 * cut_z, 5 * p.ny * (2 * cut_x * (p.nz + 2) + 2 * cut_z * p.nx))


SMOOTHINGS, EXCHANGE_FILLS = 8, 14


def exchange(p):
    """Coupling::gather(), deposit(), carry(), with smoothing."""
    return (EXCHANGE_FILLS * fill(p) + SMOOTHINGS * fft_solve(p) + deposit_rims(p)
            + Counts(reductions=14))


# --- the grains --------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Border:
    """Records of one rank: ghosts it sends and to how many ranks; its grains in other pencils, and those of
    others in its own."""
    ghosts: float = 0
    ghost_ranks: float = 0
    away: float = 0
    away_ranks: float = 0
    visitors: float = 0
    visitor_ranks: float = 0


def visits(b):
    """GrainVisits twice a step: announced, brought, taken home."""
    needs, gives = GATHER[0] + DEPOSIT[0], GATHER[1] + DEPOSIT[1]
    return (sent(2 * b.away_ranks, needs * b.away) + sent(2 * b.visitor_ranks, gives * b.visitors)
            + Counts(all_to_alls=2))


def sub_step(b):
    """GrainSolver::bring_together(): the largest way, then the ghosts' motion."""
    return sent(b.ghost_ranks, GHOST_MOTION * b.ghosts) + Counts(reductions=1)


def rebuild(b):
    """NeighborList::rebuild() where nobody moves house: balance(), three announce(), GhostGrains::find()."""
    return sent(b.ghost_ranks, GHOST * b.ghosts) + Counts(reductions=2, all_to_alls=3)


def coupled_step(p, b, iterations, sub_steps, rebuilds):
    """CoupledStep::advance_coupled() and the count of grains; a rebuild takes the place of an update."""
    updates = sub_steps - rebuilds
    return (flow_step_around_grains(p, iterations) + exchange(p) + visits(b)
            + updates * sub_step(b) + rebuilds * (rebuild(b) + Counts(reductions=1))
            + Counts(reductions=4))  # Ledger::close_step(), remove_left(), Simulation::count_grains(), StateChecks


def levels(ranks):
    """Steps of a tree over so many ranks."""
    return math.ceil(math.log2(ranks)) if ranks > 1 else 0
