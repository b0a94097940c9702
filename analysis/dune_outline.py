"""The main dune of a frame of grains, and its outline in the vertical plane of symmetry.

Definitions, bins and numbers of the dune analytics of a run (docs/conventions.md), so that L is that of
dune.csv; but a dune across a periodic boundary is seen as two.
"""

from dataclasses import dataclass

import numpy as np

from height_map import BIN, STRIP, HeightMap
from run_folder import Grains, NotInRun

CORE, RIM = 1.2, 0.3  # cover of a bin: grain cross-sections over its area
REACH = 12.0          # of the rim from a core, in mean diameters


@dataclass
class Outline:
    """h [m] at x [m] along the centreline z [m]; the dune reaches from x = foot to foot + length."""

    x: np.ndarray
    h: np.ndarray
    z: float
    foot: float
    length: float

    def height(self, x):
        return np.interp(x, self.x, self.h, left=0.0, right=0.0)


def grow(seed, allowed, steps=None):
    """The bins of `allowed` connected to `seed` over their eight neighbours, within `steps`."""
    while steps is None or steps > 0:
        wider = np.pad(seed, 1)
        near = seed.copy()
        for i in range(3):
            for k in range(3):
                near |= wider[i:i + seed.shape[0], k:k + seed.shape[1]] & allowed
        if (near == seed).all():
            break
        seed, steps = near, None if steps is None else steps - 1
    return seed


def bin_lengths(grains, domain):
    """Edges of the bins along x and z [m]: 2.5 mean diameters, stretched to fill the domain."""
    size = BIN * grains.d.mean()
    return tuple(length / max(1, int(length / size)) for length in (domain[0], domain[2]))


def main_dune(grains, domain):
    """The grains of the dune of most grains; domain = (Lx, Ly, Lz) [m]."""
    size = bin_lengths(grains, domain)
    i, k = (np.floor(grains.x[:, axis] / length).astype(int) for axis, length in zip((0, 2), size))
    i, k = i - i.min(), k - k.min()
    cover = np.zeros((i.max() + 1, k.max() + 1))
    np.add.at(cover, (i, k), 0.25 * np.pi * grains.d**2 / (size[0] * size[1]))
    core = cover >= CORE
    dune_bins = grow(core, cover >= RIM, int(np.ceil(REACH * grains.d.mean() / max(size))))
    best = np.zeros(len(grains.d), bool)
    while core.any():
        seed = np.zeros_like(core)
        seed[np.unravel_index(np.argmax(core), core.shape)] = True
        dune = grow(seed, dune_bins)
        core = core & ~dune
        if dune[i, k].sum() > best.sum():
            best = dune[i, k]
    if not best.any():
        raise NotInRun("needs a dune: in the last frame of grains.h5 no grains lie on others")
    return Grains(grains.time, grains.id[best], grains.x[best], grains.d[best])


def centreline(dune, domain):
    """Outline of the main dune's grains in the strip about their centroid, `domain` as above."""
    d = dune.d.mean()
    size = bin_lengths(dune, domain)[0]
    z = float(np.average(dune.x[:, 2], weights=dune.d**3))
    near = abs(dune.x[:, 2] - z) < STRIP * d
    if not near.any():
        raise NotInRun("needs a dune with grains on its centreline")
    x, radius = dune.x[near, 0], 0.5 * dune.d[near]
    column = np.floor(x / size).astype(int)
    first = last = int(np.argmax(np.bincount(column - column.min()))) + int(column.min())
    while (column == first - 1).any():
        first -= 1
    while (column == last + 1).any():
        last += 1
    inside = (column >= first) & (column <= last)  # sand between the horns is not
    foot, end = (x - radius)[inside].min(), (x + radius)[inside].max()
    margin = 4.0 * size
    window = (foot - margin, end + margin, dune.x[:, 2].min() - margin, dune.x[:, 2].max() + margin)
    surface = HeightMap(dune, window, size)
    h = surface.profile(z, STRIP * d)
    h[(surface.x_middle < foot) | (surface.x_middle > end)] = 0.0
    return Outline(surface.x_middle, h, z, float(foot), float(end - foot))
