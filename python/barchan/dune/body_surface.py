"""Surfaces of bodies as triangles, for programs that draw in three dimensions; no drawing. Lengths in m, y upwards."""

from dataclasses import dataclass

import numpy as np

from barchan.dune.bodies import Body


@dataclass(frozen=True)
class Surface:
    """points (n, 3) [m]; triangles (m, 3): the numbers of their corners; body (m): that of the body of each."""

    points: np.ndarray
    triangles: np.ndarray
    body: np.ndarray


def surface_of(bodies: tuple[Body, ...]) -> Surface | None:
    """All bodies, above the floor.

    What goes through the whole domain is its upper side alone. Normals point outwards.

    Parameters
    ----------
    bodies
        of a run, as of `barchan.dune.bodies.bodies_of`

    Returns
    -------
    Surface or None
        None where there are no bodies.
    """
    points, triangles, number = [np.empty((0, 3))], [np.empty((0, 3), int)], [np.empty(0, int)]
    start = 0
    for body in bodies:
        places, corners = _part(body)
        for x, z in body.lattice["copies"]:
            points.append(places + (x, 0.0, z))
            triangles.append(corners + start)
            number.append(np.full(len(corners), body.number))
            start += len(places)
    return Surface(*map(np.concatenate, (points, triangles, number))) if start else None


def _part(body: Body) -> tuple[np.ndarray, np.ndarray]:
    """(points, triangles) of the lattice: its upper side, and the lower side with what is between their edges."""
    flat = np.ptp(body.lattice["top"]) + np.ptp(body.lattice["bottom"]) < 1e-9 * body.top
    taken = slice(None, None, body.lattice["x"].shape[1] - 1) if flat else slice(None)  # of what is flat the ends alone
    upper, lower = (np.stack([body.lattice[name][:, taken] for name in ("x", side, "z")], axis=-1)
                    for side in ("top", "bottom"))
    lines = upper if body.across else np.concatenate([upper, lower[:, ::-1]], axis=1)
    number = np.arange(lines.shape[0] * lines.shape[1]).reshape(lines.shape[:2])
    number = number[::-1] if body.across else np.concatenate([number, number[:1]])
    a, b, c, d = (each.ravel() for each in (number[:-1, :-1], number[1:, :-1], number[:-1, 1:], number[1:, 1:]))
    corners, points = np.concatenate([np.stack([a, b, c], axis=1), np.stack([c, b, d], axis=1)]), lines.reshape(-1, 3)
    sides = points[corners] - points[np.roll(corners, 1, axis=1)]
    return points, corners[(sides != 0).any(axis=2).all(axis=1)]  # in the middle all lines have one place
