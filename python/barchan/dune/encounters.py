"""Encounters of two dunes: how they went, and how many grains changed sides; no drawing.

The five patterns are those of Assis & Franklin, "A comprehensive picture for binary interactions of subaqueous
barchans", Geophys. Res. Lett. 47, e2020GL089464 (2020). What counts as one in numbers: docs/dune-measures.md,
"Encounters". SI units.
"""

from collections.abc import Callable
from dataclasses import dataclass, fields
from functools import lru_cache
from itertools import combinations
from typing import Any

import numpy as np

from barchan.dune.current import direction
from barchan.dune.lineage import HALF, NONE, Lineage, follow
from barchan.dune.shape import BIN, Bed
from barchan.dune.tracks import Tracks, tracks
from barchan.errors import MissingData
from barchan.io.run_folder import RunFolder

WAKE = 3.0        # lengths of the upstream dune over which the one behind it feels its wake
LASTS = 1.0       # [s] for which a new dune must be there to count, and two be one to have merged
PART = 0.1        # of the lighter dune's grains: the least part that counts as a new dune
EXCHANGED = 0.05  # of the lighter dune's grains: the least exchange of two that touch and part

# Units and meanings of the columns of encounters.csv.
ABOUT = {
    "upstream": ("1", "name of the upstream dune"),
    "downstream": ("1", "name of the downstream dune"),
    "class": ("1", "how the encounter ended"),
    "t_start": ("s", "first frame"),
    "t_end": ("s", "last frame"),
    "t_split": ("s", "split of the downstream dune before contact"),
    "t_contact": ("s", "first frame of contact"),
    "t_apart": ("s", "first frame after the last contact"),
    "upstream_over_downstream": ("1", "ratio of their grains at the start"),
    "offset": ("m", "offset across the current at the start"),
    **{f"distance_{when}": ("m", f"distance along the current: {when}") for when in ("start", "least", "end")},
    "to_downstream": ("1", "grains that changed to the downstream side"),
    "to_upstream": ("1", "grains that changed to the upstream side"),
    "new_dunes": ("1", "names of the new dunes"),
}

CHASING, MERGING, EXCHANGE = "chasing", "merging", "exchange"
FRAGMENTATION_CHASING, FRAGMENTATION_EXCHANGE = "fragmentation-chasing", "fragmentation-exchange"
DISPERSED = "dispersed"
UNDECIDED = "undecided"


@dataclass
class Encounter:
    """Names and class; times [s], not a number for what did not happen; numbers of grains; distances of the centroids
    along the current [m]. `upstream_over_downstream`: grains at the start; `offset`: across the current there.

    `to_downstream`, `to_upstream`: grains that changed sides until the end. `new_dunes`: names, as "2 3".
    """

    upstream: int
    downstream: int
    kind: str
    t_start: float
    t_end: float
    t_split: float
    t_contact: float
    t_apart: float
    upstream_over_downstream: float
    offset: float
    distance_start: float
    distance_least: float
    distance_end: float
    to_downstream: int
    to_upstream: int
    new_dunes: str


Along = Callable[[float], np.ndarray]


def find(run: RunFolder) -> tuple[Lineage, list[Encounter]]:
    """All encounters of a run, in order of their start. Raises MissingData where there is nothing to tell."""
    lineage = lineage_of(run)
    if len(lineage.t) < 2:
        raise MissingData("needs at least two frames of tracks.h5 or grains.h5")
    count = len(dunes_of(lineage))
    if count < 2:
        there = "one dune" if count else "no dune"
        raise MissingData(f"needs two dunes that last: the frames of tracks.h5 or grains.h5 have {there}")
    return lineage, encounters(lineage, tracks(run).bed, lambda t: direction(run.config, t))


@lru_cache(maxsize=4)
def lineage_of(run: RunFolder) -> Lineage:
    if run.dune_columns is not None and len(run.dune_columns) < 2:
        raise MissingData("needs two dunes in tracks.h5 or grains.h5: dune.csv has one")
    source = tracks(run)
    if source.read(0).dune is None:
        raise MissingData("needs frames of tracks.h5 or grains.h5 that say which dune each grain is of "
                          "(output.dune_interval > 0)")
    return follow((source.read(index) for index in range(len(source.times))), source.bed, _first_heaps(source))


def _first_heaps(source: Tracks) -> np.ndarray | None:
    """The heap of each grain of the first frame, None where the run has no heaps."""
    ids, heap = source.heaps
    if heap is None:
        return None
    first = source.read(0).id
    at = np.minimum(np.searchsorted(ids, first), len(ids) - 1)
    return np.where(ids[at] == first, heap[at], NONE)


def encounters(lineage: Lineage, bed: Bed, along: Along = lambda t: np.array((1.0, 0.0))) -> list[Encounter]:
    """`along`: the unit vector of the current at a time. A dune that two others make between them belongs to their
    encounter, and is none of its own with them."""
    starts = [(_start(lineage, bed, a, b, along), a, b) for a, b in combinations(dunes_of(lineage), 2)]
    told: list[Encounter] = []
    parties: list[set[int]] = []
    for start, a, b in sorted((start, a, b) for start, a, b in starts if start is not None):
        if any({a, b} <= party for party in parties):
            continue
        ordered = _in_order(lineage, bed, a, b, start, along)
        encounter, party = _Pair(lineage, bed, *ordered, start, along(float(lineage.t[start]))).tell()
        told.append(encounter)
        parties.append(party)
    return told


def dunes_of(lineage: Lineage) -> list[int]:
    """Names of the dunes that can meet: those of the first frame, and new ones that last."""
    return [name for name, birth in enumerate(lineage.births) if birth.frame == 0 or lasting(lineage, name)]


def lasting(lineage: Lineage, name: int) -> bool:
    """Whether a dune was by itself for LASTS from its birth on."""
    first = lineage.births[name].frame
    late = lineage.t >= lineage.t[first] + LASTS * (1 - 1e-9)
    rows = slice(first, int(np.argmax(late)) + 1)
    own = lineage.body[rows, name]
    alone = np.count_nonzero(lineage.body[rows] == own[:, None], axis=1) == 1
    return bool(late.any() and np.all(alone & (own != NONE)))


def _related(lineage: Lineage, a: int, b: int) -> bool:
    """Whether one was born of the other, or of what it was part of then."""
    return a in lineage.births[b].family or b in lineage.births[a].family


def separation(lineage: Lineage, bed: Bed, a: int, b: int) -> np.ndarray:
    """(F, 3) from a to b, to the nearest image at first and then without jumps [m]; NaN where one is not there."""
    apart = np.zeros((len(lineage.t), 3))
    apart[:, 0], apart[:, 2] = lineage.x[:, b] - lineage.x[:, a], lineage.z[:, b] - lineage.z[:, a]
    both = np.nonzero(np.isfinite(apart[:, 0]))[0]
    if len(both):
        apart += bed.nearest(apart[both[0]]) - apart[both[0]]
    return apart


def _start(lineage: Lineage, bed: Bed, a: int, b: int, along: Along) -> int | None:
    """The first frame in which they touch, or one is in the wake of the other: but not of the dune it was born of."""
    both = np.nonzero(lineage.present[:, a] & lineage.present[:, b])[0]
    if not len(both):
        return None
    apart = bed.nearest(separation(lineage, bed, a, b))
    for frame in both:
        if lineage.body[frame, a] == lineage.body[frame, b]:
            return int(frame)
        if _related(lineage, a, b):
            continue
        way = along(lineage.t[frame])
        distance = _project(apart[frame], way)
        first, second = (a, b) if distance > 0 else (b, a)
        length, width = (_extent(lineage, frame, first, axis) for axis in (way, _across(way)))
        gap = abs(distance) - 0.5 * (length + _extent(lineage, frame, second, way))
        aside = abs(_project(apart[frame], _across(way)))
        if gap <= WAKE * length and aside <= 0.5 * (width + _extent(lineage, frame, second, _across(way))):
            return int(frame)
    return None


def _project(apart: np.ndarray, way: np.ndarray) -> np.ndarray:
    """The part of distances (..., 3) [m] along a unit vector (2) of the plane of the bed."""
    return apart[..., 0] * way[0] + apart[..., 2] * way[1]


def _across(way: np.ndarray) -> np.ndarray:
    return np.array((-way[1], way[0]))


def _extent(lineage: Lineage, frame: int, name: int, axis: np.ndarray) -> float:
    """Of a dune's box along a unit vector (2) [m]."""
    reach = {side: values[frame, name] for side, values in lineage.reach.items()}
    return float(abs(axis[0]) * (reach["ahead"] + reach["behind"]) + abs(axis[1]) * (reach["left"] + reach["right"]))


def _in_order(lineage: Lineage, bed: Bed, a: int, b: int, start: int, along: Along) -> tuple[int, int]:
    """(upstream, downstream)"""
    apart, way = bed.nearest(separation(lineage, bed, a, b)[start]), along(lineage.t[start])
    return (a, b) if _project(apart, way) > 0 else (b, a)


class _Pair:
    """One encounter, from the frame `start` to the `end`, the last one in which both sides are there. A side is a dune
    and those that were born of it since."""

    def __init__(self, lineage: Lineage, bed: Bed, up: int, down: int, start: int, way: np.ndarray) -> None:
        self.lineage, self.start = lineage, start
        self.sides = self._side(up), self._side(down)
        self.up, self.down = up, down
        present = [lineage.present[:, sorted(side)].any(axis=1) for side in self.sides]
        self.end = int(np.nonzero(present[0] & present[1])[0][-1])
        apart = separation(lineage, bed, up, down)
        distance = _project(apart, way)[start:self.end + 1]
        self.distance = distance[np.isfinite(distance)]
        self.aside = float(_project(apart[start], _across(way)))
        self.lighter = float(np.min(lineage.n_grains[start, [up, down]]))
        touching = [frame for frame in range(start, self.end + 1) if self._touch(frame)]
        self.contact = touching[0] if touching else None
        self.apart = touching[-1] + 1 if touching and touching[-1] < self.end else None
        self.survivor = self._survivor()
        self.last = self.end if self.survivor is None else self.survivor[0]

    def _side(self, name: int) -> set[int]:
        side = {name}
        for other, birth in enumerate(self.lineage.births):  # parents come before their children
            if birth.frame > self.start and birth.parent in side:
                side.add(other)
        return side

    def _touch(self, frame: int) -> bool:
        bodies = [{self.lineage.body[frame, name] for name in side} - {NONE} for side in self.sides]
        return bool(bodies[0] & bodies[1])

    def _survivor(self) -> tuple[int, int] | None:
        """Where one of two that touch is no longer found: (last frame of the other, grains that this one took up)."""
        frame, old, new, number = self.lineage.moves.T
        for gone, other in (self.sides, self.sides[::-1]) if self._touch(self.end) else ():
            there = np.nonzero(self.lineage.present[:, sorted(other)].any(axis=1))[0][-1]
            if there > self.end:
                joined = (frame > self.end) & np.isin(old, list(gone)) & np.isin(new, list(other))
                return int(there), int(number[joined].sum())
        return None

    def _kept(self) -> float:
        """The part of the lighter dune's grains at the contact that it has in the last frame of both, or that the other
        has taken up since."""
        n = self.lineage.n_grains
        side = sorted(self.sides[int(n[self.start, self.down] < n[self.start, self.up])])
        left = np.nansum(n[self.end, side]) if self.survivor is None else self.survivor[1]
        return float(left / np.nansum(n[self.contact, side]))

    def _counts(self, name: int) -> bool:
        """Whether a new dune is large enough and lasts."""
        enough = self.lineage.n_grains[self.lineage.births[name].frame, name] >= PART * self.lighter
        return bool(enough and lasting(self.lineage, name))

    def _changed(self, source: set[int], target: set[int], first: int) -> int:
        frame, old, new, number = self.lineage.moves.T
        chosen = (frame >= first) & (frame <= self.last) & np.isin(old, list(source)) & np.isin(new, list(target))
        return int(number[chosen].sum())

    def _kind(self, splits: list[int], ejected: list[int]) -> str:
        t = self.lineage.t
        if self.contact is None:
            if splits:
                return FRAGMENTATION_CHASING
            n, volume = (values[self.start, [self.up, self.down]].sum() for values in (self.lineage.n_grains,
                                                                                      self.lineage.volume))
            near = BIN * (6 / np.pi * volume / n)**(1 / 3)
            return CHASING if self.distance[-1] > self.distance[0] - near else UNDECIDED
        if splits or len(ejected) > 1:
            return FRAGMENTATION_EXCHANGE
        if ejected:
            return EXCHANGE
        if self.apart is not None:
            changed = sum(self._changed(*order, self.contact) for order in (self.sides, self.sides[::-1]))
            return EXCHANGE if changed >= EXCHANGED * self.lighter else CHASING
        if self._kept() < HALF:
            return DISPERSED
        return MERGING if t[self.last] - t[self.contact] >= LASTS * (1 - 1e-9) else UNDECIDED

    def tell(self) -> tuple[Encounter, set[int]]:
        """The encounter, and all that took part in it."""
        lineage, births = self.lineage, self.lineage.births
        new = sorted(name for name in set.union(*self.sides) - {self.up, self.down} if self._counts(name))
        limit = len(lineage.t) if self.contact is None else self.contact
        splits = [name for name in new if name in self.sides[1] and births[name].frame < limit]
        ejected = [name for name in new if births[name].frame >= limit]
        distance = self.distance
        up, down = lineage.n_grains[self.start, [self.up, self.down]]
        return Encounter(
            self.up, self.down, self._kind(splits, ejected), lineage.t[self.start], lineage.t[self.last],
            self._time(births[splits[0]].frame if splits else None), self._time(self.contact), self._time(self.apart),
            float(up / down), self.aside, float(distance[0]), float(distance.min()), float(distance[-1]),
            self._changed(*self.sides, self.start), self._changed(*self.sides[::-1], self.start),
            " ".join(map(str, new))), set.union(*self.sides)

    def _time(self, frame: int | None) -> float:
        return np.nan if frame is None else float(self.lineage.t[frame])


def table(found: list[Encounter]) -> dict[str, list[Any]]:
    """Columns of encounters.csv, where `kind` is called class."""
    return {{"kind": "class"}.get(column.name, column.name): [getattr(one, column.name) for one in found]
            for column in fields(Encounter)}


def sentences(lineage: Lineage, found: list[Encounter]) -> list[str]:
    told = [f"{len(lineage.births)} dunes by name, {len(found)} encounters"]
    for one in found:
        contact = "no contact" if np.isnan(one.t_contact) else f"contact at {one.t_contact:.4g} s"
        told.append(f"dune {one.upstream} behind dune {one.downstream}: {one.kind} ({contact}; grains that changed "
                    f"sides: {one.to_downstream} downstream, {one.to_upstream} upstream)")
    return told
