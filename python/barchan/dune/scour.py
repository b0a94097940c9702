"""Scour: how deep the bed is around a body below the bed far from it; no drawing.

Definitions: docs/dune-measures.md, "Scour". Lengths in m, angles about the body from +x towards -z, in degrees.
"""

from dataclasses import dataclass
from functools import cached_property, lru_cache

import numpy as np

from barchan.dune.bodies import Body
from barchan.dune.shape import BIN, Bed
from barchan.io.frames import Grains

NEAR = 1.0     # diameters from the surface within which the deepest point is looked for
FAR = 2.0      # diameters from every body beyond which the bed is far
FEWEST = 0.1   # least share of the bed that must be far
COVERED = 0.6  # least share of the floor, without the bodies, that a bed covers


@dataclass
class Scour:
    """At t [s]: `depth` [m] of the deepest point below the far bed, `far` [m], its height above the floor; place (x, z)
    [m] and angle of the deepest point; `bare`: the floor is seen there."""

    t: float
    depth: float
    far: float
    x: float
    z: float
    angle: float
    bare: bool


class BedMap:
    """Heights of a bed of square bins of about BIN mean diameters, medians of 3 x 3, between bodies.

    x (nx), z (nz): centres [m]; h (nx, nz) [m], NaN in bodies.
    """

    def __init__(self, grains: Grains, bed: Bed, bodies: tuple[Body, ...]) -> None:
        self.bed, self.bodies = bed, bodies
        shape = [max(3, int(length / (BIN * float(grains.d.mean())))) for length in bed.lengths]
        self.size = np.array(bed.lengths) / shape
        self.x, self.z = (size * (np.arange(n) + 0.5) for size, n in zip(self.size, shape))
        place = np.floor(grains.x[:, (0, 2)] / self.size).astype(int)
        place = np.where(bed.periodic, place % shape, place)
        inside = np.all((place >= 0) & (place < shape), axis=1)
        top = np.zeros(shape)
        np.maximum.at(top, tuple(place[inside].T), (grains.x[:, 1] + 0.5 * grains.d)[inside])
        self.level = float(np.median(top))
        places = np.stack(np.broadcast_arrays(self.x[:, None], self.level, self.z), axis=-1)
        solid = np.any([body.holds(places) for body in bodies], axis=0)
        self.covered = float(np.mean(top[~solid] > 0)) if not solid.all() else 0.0
        self.h = np.where(solid, np.nan, self._median(np.where(solid, np.nan, top)))

    def to_body(self, body: Body) -> np.ndarray:
        """(nx, nz) from the centres of the bins to its outline from above [m]."""
        return beside(body, tuple(self.x), tuple(self.z))

    def _median(self, top: np.ndarray) -> np.ndarray:
        """Of 3 x 3 bins (nx, nz) without NaN; 0 where all are NaN."""
        for axis in (0, 1):
            edge = [(1, 1) if axis == each else (0, 0) for each in (0, 1)]
            top = np.pad(top, edge, mode="wrap" if self.bed.periodic[axis] else "edge")
        nx, nz = len(self.x), len(self.z)
        views = np.stack([top[i:i + nx, k:k + nz] for i in range(3) for k in range(3)])
        held = np.isfinite(views).any(axis=0)
        return np.nanmedian(np.where(held, views, 0.0), axis=0)

    @cached_property
    def far(self) -> float:
        """Median height of the bed that is far from all bodies, or as far as FEWEST of it is [m]."""
        size = max(diameter(body) for body in self.bodies)
        away = np.min([self.to_body(body) for body in self.bodies], axis=0)
        free = np.isfinite(self.h)
        limit = min(FAR * size, float(np.quantile(away[free], 1 - FEWEST)))
        return float(np.median(self.h[free & (away >= limit)]))

    def scour(self, body: Body, t: float) -> Scour | None:
        """None where the bed shows no bin within NEAR of the body."""
        near = (self.to_body(body) <= NEAR * diameter(body)) & np.isfinite(self.h)
        if not near.any():
            return None
        i, k = np.unravel_index(int(np.argmin(np.where(near, self.h, np.inf))), self.h.shape)
        away = self.bed.nearest(np.array([self.x[i] - body.heart[0], 0.0, self.z[k] - body.heart[1]]))
        angle = float(np.degrees(np.arctan2(-away[2], away[0])) % 360)
        return Scour(t, self.far - float(self.h[i, k]), self.far, float(self.x[i]), float(self.z[k]), angle,
                     bool(self.h[i, k] <= 0))


@lru_cache(maxsize=16)
def beside(body: Body, x: tuple[float, ...], z: tuple[float, ...]) -> np.ndarray:
    """(nx, nz) from places to its outline from above [m]: of all frames of a run the same."""
    return body.beside(*np.meshgrid(x, z, indexing="ij"))


def diameter(body: Body) -> float:
    """D [m]: of what is round the diameter, else the width along z, or the height if the body has no ends there."""
    if body.radius > 0:
        return 2 * body.radius
    return body.size[1] if body.size[1] > 0 else body.height


def history(maps: dict[float, BedMap], body: Body) -> list[Scour]:
    """`maps`: the bed by time [s]."""
    return [found for found in (bed.scour(body, t) for t, bed in maps.items()) if found is not None]
