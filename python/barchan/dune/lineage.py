"""Dunes by name through contact: who is where, what it consists of, and whose grains went to whom; no drawing.

A dune of a frame is a set of grains that touch on the map. Its name follows from the grains that it shares with the
frame before, so that two dunes in contact, which are one on the map, keep their names, and their grains too.
Definitions: docs/dune-measures.md, "Names". SI units.
"""

from collections.abc import Callable, Iterable
from dataclasses import dataclass, field

import numpy as np

from barchan.dune.fluxes import volumes
from barchan.dune.shape import Bed, in_one_piece
from barchan.io.frames import Grains

HALF = 0.5        # of the grains of a dune: where they are, there it is
NONE = -1         # no dune, no name, no heap
SIDES = ("ahead", "behind", "right", "left")


@dataclass
class Birth:
    """When a name began: in which frame, out of which dune (NONE: of loose grains), and who was part of that then."""

    frame: int
    parent: int
    family: tuple[int, ...]


@dataclass
class Lineage:
    """F frames, M names.

    t (F) [s]. (F, M), NaN or NONE where a dune is not there: `body`, a number that names in contact share; n_grains;
    volume [m3]; x, z [m] of the centroid, periodic images undone; ahead, behind, right, left: how far its grains reach
    from there along +x, -x, +z, -z [m]. `births`: M. Rows of integers: `heaps` (frame, heap, name, grains, and
    heap_volumes [m3]), which of each frame hold all its grains; `moves` (frame, from name, to name, grains).
    """

    t: np.ndarray
    body: np.ndarray
    n_grains: np.ndarray
    volume: np.ndarray
    x: np.ndarray
    z: np.ndarray
    reach: dict[str, np.ndarray]
    births: list[Birth]
    heaps: np.ndarray
    heap_volumes: np.ndarray
    moves: np.ndarray

    @property
    def present(self) -> np.ndarray:
        """(F, M) whether each is there."""
        return self.body != NONE


@dataclass
class _Follower:
    """The memory from frame to frame: the name of each grain by its id, and the dunes when they were last there."""

    bed: Bed
    home: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    heap: np.ndarray = field(default_factory=lambda: np.zeros(0, int))
    last: dict[int, dict[str, float]] = field(default_factory=dict)
    bodies: list[dict[int, int]] = field(default_factory=list)
    sizes: list[dict[int, dict[str, float]]] = field(default_factory=list)
    births: list[Birth] = field(default_factory=list)
    heaps: list[np.ndarray] = field(default_factory=list)
    heap_volumes: list[np.ndarray] = field(default_factory=list)
    moves: list[np.ndarray] = field(default_factory=list)
    names: np.ndarray = field(default_factory=lambda: np.zeros(0, int))  # of the grains of the last frame

    def see(self, grains: Grains, heap: np.ndarray | None) -> None:
        """The next frame; `heap`: of each of its grains."""
        assert grains.dune is not None
        self.home, self.heap = (_enlarged(each, grains.id) for each in (self.home, self.heap))
        before = self.home[grains.id]
        labels, n = np.unique(grains.dune[grains.dune != NONE], return_counts=True)
        order = labels[np.argsort(-n, kind="stable")]
        places = [np.nonzero(grains.dune == label)[0] for label in order]
        counts = np.array([np.bincount(before[rows] + 1, minlength=len(self.births) + 1)[1:] for rows in places])
        members = self._members(counts.reshape(len(places), len(self.births)), [len(rows) for rows in places])
        for rows, names in zip(places, members):
            kept = np.isin(before[rows], names)
            self.home[grains.id[rows[~kept]]] = names[0]
        if not self.bodies:
            first = self.home[grains.id] if heap is None else heap
            self.heap[grains.id] = first
        self._keep(grains, before, places, members)

    def _members(self, counts: np.ndarray, totals: list[int]) -> list[list[int]]:
        """The names of each place, the one of most grains there first; those without one get a new one. `counts`
        (places, names): grains that bore each name."""
        members: list[list[int]] = [[] for _ in totals]
        for name in range(counts.shape[1]):
            linked = counts[:, name] >= HALF * np.array(totals)
            if self.bodies and name in self.bodies[-1]:
                linked |= counts[:, name] >= HALF * self.last[name]["n_grains"]
            if linked.any():
                members[int(np.argmax(np.where(linked, counts[:, name], -1)))].append(name)
        for place, names in enumerate(members):
            names.sort(key=lambda name: -counts[place, name])
        for place, names in enumerate(members):
            if not names:
                names.append(len(self.births))
                self.births.append(self._birth(counts[place], totals[place]))
        return members

    def _birth(self, counts: np.ndarray, total: int) -> Birth:
        parent = int(np.argmax(counts)) if len(counts) and counts.max() >= HALF * total else NONE
        together = self.bodies[-1] if self.bodies else {}
        family = tuple(name for name in together if parent in together and together[name] == together[parent])
        return Birth(len(self.bodies), parent, family)

    def _keep(self, grains: Grains, before: np.ndarray, places: list[np.ndarray], members: list[list[int]]) -> None:
        frame = len(self.bodies)
        bodies, sizes, name_of = {}, {}, np.full(len(grains.id), NONE)
        for place, (rows, names) in enumerate(zip(places, members)):
            name_of[rows] = self.home[grains.id[rows]]
            for name in names:
                bodies[name] = place
                sizes[name] = self._measured(grains, rows[name_of[rows] == name], self.last.get(name))
        self.names = name_of
        self.last |= sizes
        self.bodies.append(bodies)
        self.sizes.append(sizes)
        pairs, which = np.unique(np.stack([self.heap[grains.id], name_of], axis=1), axis=0, return_inverse=True)
        which = which.ravel()
        number = np.bincount(which, minlength=len(pairs))
        self.heaps.append(np.column_stack([np.full(len(pairs), frame), pairs, number]))
        self.heap_volumes.append(np.bincount(which, volumes(grains.d), len(pairs)))
        now = self.home[grains.id]
        moved = (before != now) & (before != NONE)
        routes, number = np.unique(np.stack([before[moved], now[moved]], axis=1), axis=0, return_counts=True)
        self.moves.append(np.column_stack([np.full(len(routes), frame), routes, number]))

    def _measured(self, grains: Grains, rows: np.ndarray, last: dict[str, float] | None) -> dict[str, float]:
        """Of these grains of one dune; the centroid is that image which is nearest to the last one."""
        x, z = (in_one_piece(grains.x[rows, axis], length) if periodic else grains.x[rows, axis]
                for axis, length, periodic in zip((0, 2), self.bed.lengths, self.bed.periodic))
        size, radius = volumes(grains.d[rows]), 0.5 * grains.d[rows]
        centre = np.array([np.average(x, weights=size), 0.0, np.average(z, weights=size)])
        reach = (np.max(x + radius) - centre[0], centre[0] - np.min(x - radius),
                 np.max(z + radius) - centre[2], centre[2] - np.min(z - radius))
        if last is not None:
            there = np.array([last["x"], 0.0, last["z"]])
            centre = there + self.bed.nearest(centre - there)
        return {"n_grains": float(len(rows)), "volume": float(size.sum()), "x": centre[0], "z": centre[2],
                **dict(zip(SIDES, reach))}


def _enlarged(values: np.ndarray, ids: np.ndarray) -> np.ndarray:
    """Room for these ids, NONE where it is new."""
    missing = int(ids.max(initial=-1)) + 1 - len(values)
    return np.concatenate([values, np.full(missing, NONE)]) if missing > 0 else values


def follow(frames: Iterable[Grains], bed: Bed, heap: np.ndarray | None = None,
           seen: Callable[[Grains, np.ndarray], None] | None = None) -> Lineage:
    """Frames with labels `dune`, in order of time. `heap` (N): of the grains of the first one; else each dune there is
    a heap. Grains that come later are of no heap. `seen` gets each frame and the names (N) of its grains, NONE: in no
    dune."""
    memory, t = _Follower(bed), []
    for grains in frames:
        memory.see(grains, heap)
        t.append(grains.time)
        if seen is not None:
            seen(grains, memory.names)
    shape = len(t), len(memory.births)
    body = np.full(shape, NONE)
    columns = {name: np.full(shape, np.nan) for name in ("n_grains", "volume", "x", "z", *SIDES)}
    for frame, (bodies, sizes) in enumerate(zip(memory.bodies, memory.sizes)):
        for name in bodies:
            body[frame, name] = bodies[name]
            for key, column in columns.items():
                column[frame, name] = sizes[name][key]
    reach = {side: columns.pop(side) for side in SIDES}
    return Lineage(np.array(t), body, **columns, reach=reach, births=memory.births, heaps=_rows(memory.heaps),
                   heap_volumes=np.concatenate([*memory.heap_volumes, np.zeros(0)]), moves=_rows(memory.moves))


def _rows(parts: list[np.ndarray]) -> np.ndarray:
    return np.concatenate([*parts, np.zeros((0, 4))]).astype(int)
