"""Spheres of clumps: where they are, from the orientations of the clumps and the shapes of their kinds."""

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from barchan.io.hdf5 import Group

if TYPE_CHECKING:
    from barchan.io.frames import Grains

SHAPES = "spheres"  # the group of grains.h5


@dataclass(frozen=True)
class Shapes:
    """Spheres of each kind of grains, for a grain of diameter 1, in its principal frame.

    Attributes
    ----------
    kind : numpy.ndarray
        (M) kind of the grains that have the sphere, ascending.
    centre : numpy.ndarray
        (M, 3) places.
    radius : numpy.ndarray
        (M) radii.
    """

    kind: np.ndarray
    centre: np.ndarray
    radius: np.ndarray


@dataclass(frozen=True)
class Spheres:
    """Spheres of all grains of a frame, those of one grain one after another.

    Attributes
    ----------
    x : numpy.ndarray
        (S, 3) centres [m].
    d : numpy.ndarray
        (S) diameters [m].
    grain : numpy.ndarray
        (S) place of the grain that each belongs to.
    """

    x: np.ndarray
    d: np.ndarray
    grain: np.ndarray


def shapes_of(file: Group) -> Shapes | None:
    """The shapes that an open grains.h5 has; None where all grains are spheres."""
    if SHAPES not in file:
        return None
    group = file[SHAPES]
    return Shapes(*(group[name][:] for name in ("kind", "centre", "radius")))


def rotated(q: np.ndarray, v: np.ndarray) -> np.ndarray:
    """Vectors (N, 3) turned by quaternions w, x, y, z (N, 4)."""
    w, u = q[:, :1], q[:, 1:]
    across = 2 * np.cross(u, v)
    return v + w * across + np.cross(u, across)


def spheres_of(grains: "Grains") -> Spheres:
    """The spheres that the grains of a frame consist of; a grain that is no clump is one itself.

    A sphere stands at x + d R c, with the grain's centre x, diameter d and rotation R, the sphere's place c for
    d = 1 and a radius of d times its own (docs/files.md). At a periodic boundary it stays with its grain.

    Parameters
    ----------
    grains : Grains
        With `orientation` and `shapes`; without them all grains are spheres.

    Returns
    -------
    Spheres
        Centres and diameters [m].
    """
    shapes = grains.shapes
    if shapes is None or grains.orientation is None:
        return Spheres(grains.x, grains.d, np.arange(len(grains.d)))
    kind = np.zeros(len(grains.d), int) if grains.kind is None else grains.kind
    count = np.bincount(shapes.kind, minlength=int(np.max(kind, initial=0)) + 1)
    first = np.cumsum(count) - count
    of_each = count[kind]
    grain = np.repeat(np.arange(len(kind)), of_each)
    member = np.arange(len(grain)) - np.repeat(np.cumsum(of_each) - of_each, of_each)
    sphere = first[kind][grain] + member
    d = grains.d[grain]
    x = grains.x[grain] + d[:, None] * rotated(grains.orientation[grain], shapes.centre[sphere])
    return Spheres(x, 2 * d * shapes.radius[sphere], grain)
