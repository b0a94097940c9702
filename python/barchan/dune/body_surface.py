"""Surfaces of bodies as triangles, for programs that draw in three dimensions; no drawing. Lengths in m, y upwards."""

from dataclasses import dataclass

import numpy as np

from barchan.dune.bodies import POINTS, Body

LEVELS = 46  # outlines of what is round: every 4 degrees of a circle seen from the side


@dataclass(frozen=True)
class Surface:
    """points (n, 3) [m]; triangles (m, 3): the numbers of their corners; body (m): that of the body of each."""

    points: np.ndarray
    triangles: np.ndarray
    body: np.ndarray


def surface_of(bodies: tuple[Body, ...]) -> Surface | None:
    """All bodies, with the images of those that reach across a periodic boundary.

    A body goes on below the floor, where the case has it buried; a dune ends on the floor, and a wave is its upper
    side alone. Normals point outwards.

    Parameters
    ----------
    bodies
        of a case, as of `barchan.dune.bodies.bodies_of`

    Returns
    -------
    Surface or None
        None where there are no bodies.
    """
    points, triangles, number = [np.empty((0, 3))], [np.empty((0, 3), int)], [np.empty(0, int)]
    start = 0
    for body in bodies:
        for part in (_wave(body) if body.form == "wave" else _between_outlines(body)):
            for image in _images(part[0], body):
                points.append(image)
                triangles.append(part[1] + start)
                number.append(np.full(len(part[1]), body.number))
                start += len(image)
    return Surface(*map(np.concatenate, (points, triangles, number))) if start else None


def _heights(body: Body) -> np.ndarray:
    """Where outlines are taken, above the floor, from below to above [m]."""
    if body.form in ("sphere", "cylinder_x", "cylinder_z"):
        return body.base + body.radius * (1 - np.cos(np.linspace(0, np.pi, 2 * LEVELS - 1)))
    if body.form == "half_sphere":
        return body.base + body.radius * np.sin(np.linspace(0, 0.5 * np.pi, LEVELS))
    return np.array([0.0 if body.form == "dune" else body.base, body.top])


def _between_outlines(body: Body) -> list[tuple[np.ndarray, np.ndarray]]:
    """(points, triangles) of each part: of a fence one for each post."""
    heights = _heights(body)
    inside = heights.copy()
    inside[[0, -1]] += 1e-9 * body.tall * np.array([1, -1])  # at their very ends some have no outline, or no width
    levels = [body.plan(y) for y in inside]
    return [_lofted([outlines[part][:-1] for outlines in levels], heights) for part in range(len(levels[0]))]


def _lofted(outlines: list[np.ndarray], heights: np.ndarray) -> tuple[np.ndarray, np.ndarray]:
    """Between outlines (k, 2), all of one number of points, with a lid at both ends."""
    count = len(outlines[0])
    points = np.concatenate([np.insert(outline, 1, y, axis=1) for outline, y in zip(outlines, heights)])
    here = np.arange(count)
    beside = np.roll(here, -1)
    sides = [level * count + corners for level in range(len(heights) - 1)
             for corners in (np.stack([here, here + count, beside], axis=1),
                             np.stack([beside, here + count, beside + count], axis=1))]
    fan = np.stack([np.zeros(count - 2, int), here[1:-1], here[2:]], axis=1)
    return points, np.concatenate([*sides, fan, fan[:, ::-1] + (len(heights) - 1) * count])


def _wave(body: Body) -> list[tuple[np.ndarray, np.ndarray]]:
    """From end to end of the domain; flat where it would lie below the floor."""
    count = 1 + round(body.domain[0] / body.wavelength * (POINTS - 1) / 2)
    x = np.linspace(0, body.domain[0], count)
    y = np.nan_to_num(body.interval(x, np.zeros_like(x))[1])
    points = np.concatenate([np.stack([x, y, np.full_like(x, z)], axis=1) for z in (0.0, body.domain[2])])
    here = np.arange(count - 1)
    triangles = np.concatenate([np.stack([here, here + count, here + 1], axis=1),
                                np.stack([here + 1, here + count, here + count + 1], axis=1)])
    return [(points, triangles)]


def _images(points: np.ndarray, body: Body) -> list[np.ndarray]:
    """The part itself and its copies a domain further along x and z, those of them that lie in the domain."""
    length = np.array([body.domain[0], np.inf, body.domain[2]])
    tiny = 1e-9 * body.domain[0]
    moved = [points + (i * body.domain[0], 0.0, k * body.domain[2]) for i in (-1, 0, 1) for k in (-1, 0, 1)]
    return [part for part in moved
            if np.all(part.max(axis=0)[[0, 2]] > tiny) and np.all(part.min(axis=0) < length - tiny)]
