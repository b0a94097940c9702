"""What becomes of a dune that meets a body or a crater; no drawing.

The classes are those of Lima, Assis, Borges & Franklin, J. Geophys. Res. Earth Surf. 130, e2025JF008504 (2025), for
obstacles as large as a dune, and of Plácido, Borges, Assis & Franklin, Geophys. Res. Lett. 52, e2025GL120187 (2025),
for craters. The numbers that tell them apart are ours: docs/dune-measures.md, "Obstacles". SI units.
"""

from collections.abc import Callable
from dataclasses import dataclass, field, fields
from typing import Any

import numpy as np

from barchan.dune.bodies import Body, bodies_of
from barchan.dune.current import direction
from barchan.dune.shape import Bed
from barchan.dune.tracks import Tracks, tracks
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder

HALF = 0.5        # of the dune's grains: where they are, there it is
TOUCH = 0.01      # of its grains that must be within a diameter of the surface, or in the crater, for a contact
SLOW = 0.1        # of its celerity before the contact: below it a dune stands
TOGETHER = 1.5    # lengths of the dune at the start; half of its grains must fit into so much for it to be one
SECOND = 1.0      # [s] over which celerities are measured
FEWEST = 100      # grains of a dune
SPREAD = 0.8      # of the domain: a heap as long as that is a bed

# Units and meanings of the columns of obstacles.csv.
ABOUT = {
    "dune": ("1", "name of the heap, or label of the dune"),
    "obstacle": ("1", "name of the body, or number of the crater"),
    "kind": ("1", "body or crater"),
    "class": ("1", "how the dune met it"),
    "t_contact": ("s", "first frame of contact"),
    "t_end": ("s", "last frame"),
    "n_grains": ("1", "grains of the dune in the first frame"),
    **{where: ("1", f"share of them {where} at the end") for where in ("upstream", "around", "downstream")},
    "over": ("1", "share of those downstream that was on top of the obstacle"),
    "together": ("1", "largest share within 1.5 initial lengths of the dune"),
    "celerity_before": ("m s-1", "celerity of the median grain before contact"),
    "celerity_after": ("m s-1", "celerity of the median grain at the end"),
}

OVER, BYPASS, TRAPPED = "passes over", "bypass", "trapped"
BLOCKED, DESTROYED, UNDECIDED = "blocked", "destroyed", "undecided"


@dataclass(frozen=True)
class Obstacle:
    """A body or a crater with its outline `plan` (n, 2) in x and z [m]. `over`: which places x (n, 3) are above it or
    in it; `near`: which grains at x, of diameters d (n), touch it."""

    name: str
    kind: str
    plan: np.ndarray
    over: Callable[[np.ndarray], np.ndarray]
    near: Callable[[np.ndarray, np.ndarray], np.ndarray]


@dataclass
class Meeting:
    """A dune and an obstacle. Times [s], NaN for what did not happen.

    Shares of the dune's grains at the end: `upstream`, `around`, `downstream`; `over`: of those downstream the share
    that was seen on top of the obstacle, or in it; `together`: within TOGETHER times the first length. Celerities [m/s]
    over the last second before the contact, not known for one in the first second, and before the end.
    """

    dune: str
    obstacle: str
    kind: str
    outcome: str
    t_contact: float
    t_end: float
    n_grains: int
    upstream: float
    around: float
    downstream: float
    over: float
    together: float
    celerity_before: float
    celerity_after: float
    path: "Path" = field(repr=False, compare=False)


@dataclass
class Path:
    """Against t (F) [s]: s (F), the median place of the dune's grains along the current from the middle of the
    obstacle [m], and shares (F, 3) upstream, around and downstream; `ends`: of the obstacle [m]."""

    t: np.ndarray
    s: np.ndarray
    shares: np.ndarray
    ends: tuple[float, float]


def obstacles_of(run: RunFolder) -> list[Obstacle]:
    """Bodies but waves and those through the whole domain along the current, then craters."""
    found = [_body(body) for body in bodies_of(run) if body.reach[1] - body.reach[0] < body.domain[0]]
    craters = run.config.get("initial", {}).get("crater", ())
    return found + [crater(number, table) for number, table in enumerate(craters)]


def _body(body: Body) -> Obstacle:
    return Obstacle(body.name, "body", np.concatenate(body.plan()),
                    lambda x: np.isfinite(body.interval(x[:, 0], x[:, 2])[1]),
                    lambda x, d: body.touches(x, 1.5 * d))


def crater(number: int, table: dict[str, Any]) -> Obstacle:
    """The crater of a table [[initial.crater]]."""
    (x0, z0), radius = table["centre"], table["radius"]
    angle = np.linspace(0, 2 * np.pi, 91)

    def inside(x: np.ndarray) -> np.ndarray:
        return np.hypot(x[:, 0] - x0, x[:, 2] - z0) < radius

    return Obstacle(f"crater {number + 1}", "crater",
                    np.stack([x0 + radius * np.cos(angle), z0 + radius * np.sin(angle)], axis=1), inside,
                    lambda x, d: inside(x))


def find(run: RunFolder, obstacles: list[Obstacle] | None = None) -> list[Meeting]:
    """Each dune with each obstacle that lies in its way, of the case or, for a control, of these. Raises MissingData
    where there is nothing to tell."""
    obstacles = obstacles_of(run) if obstacles is None else obstacles
    if not obstacles:
        raise MissingData("needs a [[body]] or an [[initial.crater]] in the case, and tracks.h5 or grains.h5")
    source = tracks(run)
    if len(source.times) < 2:
        raise MissingData("needs at least two frames of tracks.h5 or grains.h5")
    first = source.read(0)
    way = direction(run.config, float(source.times[0]))
    dunes = dunes_of(source, first)
    pairs = [(name, ids, one) for name, ids in dunes.items() for one in obstacles
             if _in_the_way(first, ids, one, source.bed, way)]
    if not pairs:
        raise MissingData("needs a dune upstream of a body or a crater in the first frame of tracks.h5 or grains.h5")
    followed = [_Followed(name, ids, one, source.bed, way) for name, ids, one in pairs]
    for index in range(len(source.times)):
        grains = source.read(index)
        for one in followed:
            one.see(grains)
    return [one.tell() for one in followed]


def dunes_of(source: Tracks, first: Grains) -> dict[str, np.ndarray]:
    """{name: ids (n)}: heaps that are no beds where there are several, else the dunes of the first frame."""
    ids, heap = source.heaps
    if heap is not None and len(np.unique(heap)) > 1:
        of_grain = heap[np.minimum(np.searchsorted(ids, first.id), len(ids) - 1)]
        names = source.known.heaps
        found = {names[number] if number < len(names) else f"heap {number + 1}": first.id[of_grain == number]
                 for number in np.unique(of_grain) if number >= 0}
        covered = {name: _covers(first, own, source.bed) for name, own in found.items()}
        return {name: own for name, own in found.items() if len(own) >= FEWEST and covered[name] < SPREAD}
    if first.dune is None:
        raise MissingData("needs frames of tracks.h5 or grains.h5 that say which dune each grain is of "
                          "(output.dune_interval > 0)")
    found = {f"dune {label}": first.id[first.dune == label] for label in np.unique(first.dune) if label >= 0}
    return {name: own for name, own in found.items() if len(own) >= FEWEST}


def _covers(grains: Grains, ids: np.ndarray, bed: Bed) -> float:
    """The share of the domain along x with grains of these ids, in fiftieths."""
    x = grains.x[np.isin(grains.id, ids), 0]
    return len(np.unique(np.floor(50 * x / bed.lengths[0]))) / 50


def _in_the_way(first: Grains, ids: np.ndarray, obstacle: Obstacle, bed: Bed, way: np.ndarray) -> bool:
    """Whether most of the dune is upstream, and the outlines overlap across the current."""
    x = first.x[np.isin(first.id, ids)]
    middle = obstacle.plan.mean(axis=0)
    apart = bed.nearest(x - np.array([middle[0], 0.0, middle[1]]))
    across = np.array((-way[1], way[0]))
    s, q = (apart[:, (0, 2)] @ axis for axis in (way, across))
    ends, sides = ((obstacle.plan - middle) @ axis for axis in (way, across))
    overlap = np.quantile(q, 0.98) > sides.min() and np.quantile(q, 0.02) < sides.max()
    return bool(np.median(s) < ends.min() and overlap)


class _Followed:
    """The grains of one dune, in frame after frame."""

    def __init__(self, name: str, ids: np.ndarray, obstacle: Obstacle, bed: Bed, way: np.ndarray) -> None:
        self.name, self.ids, self.obstacle, self.bed, self.way = name, np.sort(ids), obstacle, bed, way
        self.middle = obstacle.plan.mean(axis=0)
        along = (obstacle.plan - self.middle) @ way
        self.ends = float(along.min()), float(along.max())
        self.last = np.full((len(ids), 3), np.nan)  # where each was, periodic images undone
        self.on = np.zeros(len(ids), bool)
        self.t: list[float] = []
        self.s: list[np.ndarray] = []
        self.touched: list[float] = []

    def see(self, grains: Grains) -> None:
        """The next frame."""
        place = np.minimum(np.searchsorted(self.ids, grains.id), len(self.ids) - 1)
        own = self.ids[place] == grains.id
        place, x = place[own], grains.x[own]
        origin = np.where(np.isfinite(self.last[place]), self.last[place],
                          np.array([self.middle[0], 0.0, self.middle[1]]))
        at = np.full_like(self.last, np.nan)
        at[place] = origin + self.bed.nearest(x - origin)
        self.last = np.where(np.isfinite(at), at, self.last)
        self.on[place] |= self.obstacle.over(x)
        self.touched.append(np.count_nonzero(self.obstacle.near(x, grains.d[own])) / len(self.ids))
        self.t.append(float(grains.time))
        self.s.append((at[:, (0, 2)] - self.middle) @ self.way)  # NaN: it has left

    def tell(self) -> Meeting:
        """From all frames that it has seen."""
        t, s = np.array(self.t), np.array(self.s)
        gone = ~np.isfinite(s)
        shares = np.stack([np.mean(~gone & (s < self.ends[0]), axis=1),
                           np.mean(~gone & (s >= self.ends[0]) & (s <= self.ends[1]), axis=1),
                           np.mean(gone | (s > self.ends[1]), axis=1)], axis=1)
        contact = np.flatnonzero(np.array(self.touched) >= TOUCH)
        median = np.array([np.nanmedian(row) if np.isfinite(row).any() else np.nan for row in s])
        before = t[contact[0]] if len(contact) else t[-1]
        free = before - t[0] >= SECOND * (1 - 1e-9)
        speeds = _slope(t, median, before) if free else np.nan, _slope(t, median, t[-1])
        passed = gone[-1] | (s[-1] > self.ends[1])
        over = float(np.mean(self.on[passed])) if passed.any() else np.nan
        together = _together(s[-1], TOGETHER * (np.nanquantile(s[0], 0.975) - np.nanquantile(s[0], 0.025)))
        outcome = _outcome(self.obstacle.kind, shares[-1], over, together, speeds, bool(len(contact)))
        upstream, around, downstream = map(float, shares[-1])
        return Meeting(self.name, self.obstacle.name, self.obstacle.kind, outcome,
                       float(before) if len(contact) else np.nan, float(t[-1]), len(self.ids), upstream, around,
                       downstream, over, together, *speeds, Path(t, median, shares, self.ends))


def _slope(t: np.ndarray, s: np.ndarray, end: float) -> float:
    """Least-squares slope over the second before `end`; NaN with less than two times."""
    chosen = (t > end - SECOND * (1 + 1e-9)) & (t <= end) & np.isfinite(s)
    return float(np.polyfit(t[chosen], s[chosen], 1)[0]) if np.count_nonzero(chosen) > 1 else np.nan


def _together(s: np.ndarray, length: float) -> float:
    """The largest share of all grains, also those that have left, within any window of this length."""
    there = np.sort(s[np.isfinite(s)])
    held = np.searchsorted(there, there + length, side="right") - np.arange(len(there))
    return float(held.max() / len(s)) if len(there) else 0.0


def _outcome(kind: str, shares: np.ndarray, over: float, together: float, speeds: tuple[float, float],
             met: bool) -> str:
    """The class, from shares (3) upstream, around, downstream and speeds [m/s] before the contact and at the end."""
    downstream, stands = shares[2] >= HALF, speeds[1] < SLOW * speeds[0]
    if kind == "body":
        if downstream:
            return OVER if over >= HALF else BYPASS
        return TRAPPED if met and stands else UNDECIDED
    if not met:
        return UNDECIDED
    if together < HALF:
        return DESTROYED
    if downstream:
        return OVER
    return BLOCKED if stands else UNDECIDED


def table(found: list[Meeting]) -> dict[str, list[Any]]:
    """Columns of obstacles.csv, where `outcome` is called class."""
    return {{"outcome": "class"}.get(column.name, column.name): [getattr(one, column.name) for one in found]
            for column in fields(Meeting) if column.name != "path"}


def sentences(found: list[Meeting]) -> list[str]:
    """One for each meeting."""
    told = []
    for one in found:
        contact = "no contact" if np.isnan(one.t_contact) else f"contact at {one.t_contact:.4g} s"
        told.append(f"{one.dune} and {one.obstacle}: {one.outcome} ({contact}; at {one.t_end:.4g} s "
                    f"{100 * one.upstream:.0f} % of its {one.n_grains} grains are upstream, {100 * one.around:.0f} % "
                    f"around it, {100 * one.downstream:.0f} % downstream)")
    return told
