"""Sequences of grains in which two dunes meet in a known way."""

import numpy as np

from make_fake_run import open_file, write_frame
from survey import survey

from barchan.dune.detect import labels
from barchan.dune.shape import Bed
from barchan.io.frames import Grains

D = 2e-4
TIMES = np.arange(0, 10.01, 0.25)
LOOSE = 60


def disc(radius, layers=6):
    """Centres (N, 3) [m] of layers of grains on a square grid, about the origin."""
    side = np.arange(-radius, radius + 0.5 * D, D)
    x, layer, z = (each.ravel() for each in np.meshgrid(side, np.arange(layers), side, indexing="ij"))
    return np.stack([x, (layer + 0.5) * D, z], axis=1)[np.hypot(x, z) <= radius]


class Pair:
    """Heap 0 upstream, smaller, and heap 1 downstream, on a bed of 80 x 30 mm.

    `parts`: a list of (grains (n, 3) about their centre, heap, path), path(t) the place (x, z) of the centre [m].
    """

    def __init__(self, parts, origin=(0.0, 0.0), periodic=(False, True), seed=5):
        self.bed = Bed((0.08, 0.03), periodic)
        self.parts, self.origin = parts, np.array([origin[0], 0.0, origin[1]])
        self.random = np.random.default_rng(seed)
        self.n = sum(len(grains) for grains, _, _ in parts) + LOOSE
        self.heap = np.concatenate([np.full(len(grains), heap) for grains, heap, _ in parts] + [np.full(LOOSE, 1)])

    def frame(self, t):
        """Noise of a tenth of a diameter, and loose grains all over; in an order that changes."""
        x = np.concatenate([grains + np.insert(path(t), 1, 0.0) for grains, _, path in self.parts])
        loose = self.random.uniform((0, 0.5 * D, 0), (0.08, 0.5 * D, 0.03), (LOOSE, 3)) - self.origin
        x = np.concatenate([x, loose]) + self.origin + self.random.normal(0, 0.1 * D, (self.n, 3))
        for axis, length, periodic in zip((0, 2), self.bed.lengths, self.bed.periodic):
            if periodic:
                x[:, axis] %= length
        order = self.random.permutation(self.n)
        grains = Grains(float(t), order, x[order], np.full(self.n, D))
        grains.dune = labels(grains, self.bed)
        return grains

    def frames(self, times=TIMES):
        return [self.frame(t) for t in times]


def line(x, speed, z=0.015):
    return lambda t: np.array((x + speed * t, z))


def after(t0, before, then):
    """A path that changes at t0."""
    return lambda t: before(t) if t < t0 else then(t)


SMALL, LARGE = disc(3e-3), disc(4.5e-3)
FRONT = LARGE[:, 0] > 1.8e-3                      # the downstream part of the large one
LEFT = LARGE[:, 2] < 0
X0, X1 = 0.012, 0.024                             # centres at the start [m]


def chasing():
    return [(SMALL, 0, line(X0, 0.5e-3)), (LARGE, 1, line(X1, 1e-3))]


def undecided():
    return [(SMALL, 0, line(X0, 0.6e-3)), (LARGE, 1, line(X1, 0.5e-3))]


def merging():
    """It runs into the large one and stays."""
    own = line(X0, 1.5e-3)
    return [(SMALL, 0, after(5, own, lambda t: own(5))), (LARGE, 1, line(X1, 0.0))]


def exchange():
    """The same, then the front of the large one leaves."""
    leaves = after(6, line(X1, 0.0), lambda t: np.array((X1 + 2e-3 + 2e-3 * (t - 6), 0.015)))
    small, (large, _, path) = merging()
    return [small, (large[~FRONT], 1, path), (large[FRONT], 1, leaves)]


def passing():
    """They touch, and part with some grains of the large one on the small one."""
    taken = np.arange(len(LARGE)) % 8 == 0
    back = after(6, line(X0, 1.5e-3), lambda t: np.array((X0 + 9e-3 - 2e-3 * (t - 6), 0.015)))
    with_small = after(6, line(X1, 0.0), lambda t: back(t))
    return [(SMALL, 0, back), (LARGE[~taken], 1, line(X1, 0.0)), (0.5 * LARGE[taken] + (0, 6 * D, 0), 1, with_small)]


def touching():
    """They touch and part, each with its own grains."""
    back = after(4.5, line(X0, 1.2e-3), lambda t: np.array((X0 + 5.4e-3 - 2e-3 * (t - 4.5), 0.015)))
    return [(SMALL, 0, back), (LARGE, 1, line(X1, 0.0))]


def _halves(speed):
    """The large one from 2 s on, in two that go apart across the current."""
    def path(sign):
        return after(2, line(X1, speed), lambda t: np.array((X1 + speed * t, 0.015 + sign * min(5e-3, 2e-3 * (t - 1)))))
    return [(LARGE[LEFT], 1, path(-1)), (LARGE[~LEFT], 1, path(1))]


def fragmentation_chasing():
    return [(SMALL, 0, line(X0, 0.5e-3)), *_halves(1e-3)]


def fragmentation_exchange():
    """It reaches one half."""
    aside = after(3, line(X0, 0.5e-3), lambda t: np.array((X0 + 0.5e-3 * 3 + 1.5e-3 * (t - 3), 0.015 + 1e-3 * (t - 3))))
    return [(SMALL, 0, after(7, aside, lambda t: aside(7))), *_halves(0.0)]


def ejecting_two():
    """After the collision the large one leaves in two pieces."""
    def leaves(sign):
        return after(6, line(X1, 0.0), lambda t: np.array((X1 + 3e-3 * (t - 6), 0.015 + sign * 2e-3 * (t - 6))))
    small, (large, _, path) = merging()
    return [small, (large[~FRONT], 1, path), *((large[FRONT & side], 1, leaves(sign))
                                               for side, sign in ((LEFT, -1), (~LEFT, 1)))]


def write_run(folder, frames, bed, heap=None, schedule="", more=lambda frame: {}):
    """A run folder with these frames in grains.h5; heap (N): of each grain by its id; more(frame): other arrays."""
    folder.mkdir()
    config = (f"[domain]\nsize = [{bed.lengths[0]}, 0.02, {bed.lengths[1]}]\n[grains]\nboundary_x = "
              f"\"{'periodic' if bed.periodic[0] else 'exit'}\"\n{schedule}")
    (folder / "config.toml").write_text(config)
    if "[[body]]" in schedule:
        survey(folder)
    (folder / "run.json").write_text('{"status": "done", "steps": 3}\n')
    with open_file(folder / "grains.h5") as file:
        for number, frame in enumerate(frames):
            arrays = {"id": frame.id, "x": frame.x, "d": frame.d, "dune": frame.dune} | more(frame)
            write_frame(file, number, frame.time, arrays if heap is None else arrays | {"heap": heap[frame.id]})
    return folder
