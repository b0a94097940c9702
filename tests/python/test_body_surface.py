"""Surfaces of bodies: at the heights of closed forms, closed, outwards, with their volume."""

import numpy as np
import pytest
from test_bodies import ALL, DOMAIN, EACH, NAMES, exact_interval

from barchan.dune.body_surface import surface_of


def corners(surface):
    return (surface.points[surface.triangles[:, corner]] for corner in range(3))


def volume(surface):
    """By the theorem of Gauss: positive where normals point outwards [m3]."""
    a, b, c = corners(surface)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@EACH
def test_the_surface_is_that_of_the_body(body):
    """Its middles of triangles, too, but those of sides that stand upright; a body ends on the floor."""
    surface = surface_of((body,))
    a, b, c = corners(surface)
    middles = (a + b + c) / 3
    normal = np.cross(b - a, c - a)
    up = abs(normal[:, 1]) / np.linalg.norm(normal, axis=1)
    heights = np.stack(exact_interval(body, *middles[:, (0, 2)].T))
    held = np.isfinite(heights[0]) & (up > 1e-3)
    assert held.sum() > 0.98 * np.count_nonzero(up > 1e-3)
    off = abs(heights - middles[:, 1]).min(axis=0) * up
    assert off[held].max() < 4e-3 * (body.top - body.base)
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    np.testing.assert_allclose((low[0], high[0], low[2], high[2]), body.reach, rtol=0, atol=1e-3 * body.top)
    assert (high[1], low[1]) == (pytest.approx(body.top),
                                 pytest.approx(0.0 if body.shape == "dune" else max(body.base, 0.0), abs=1e-11))


@pytest.mark.parametrize("body", [one for one in ALL if one.shape != "wave"],
                         ids=[name for name, one in zip(NAMES, ALL) if one.shape != "wave"])
def test_surfaces_are_closed_and_have_the_volume(body):
    surface = surface_of((body,))
    edges = np.concatenate([np.roll(surface.triangles, turn, axis=1)[:, :2] for turn in range(3)])
    places = np.unique(surface.points.round(15), axis=0, return_inverse=True)[1].reshape(-1)[edges]
    places = places[places[:, 0] != places[:, 1]]
    there, count = np.unique(places, axis=0, return_counts=True)
    back = np.unique(places[:, ::-1], axis=0)
    assert (count == 1).all() and np.array_equal(there, back)  # each edge once in each direction
    r, h, length = body.radius, min(body.height, body.top), body.length or DOMAIN[2]
    sizes = [size or side for size, side in zip(body.size, (DOMAIN[0], DOMAIN[2]))]
    posts = len(body.lattice["copies"])
    exact = {"cylinder": np.pi * r**2 * (h if body.axis == "y" else length), "fence": posts * np.pi * r**2 * h,
             "sphere": 4 / 3 * np.pi * r**3, "half_sphere": 2 / 3 * np.pi * r**3, "box": h * sizes[0] * sizes[1],
             "dune": np.pi / 12 * h * sizes[0] * sizes[1]}[body.shape]
    assert volume(surface) == pytest.approx(exact, rel=2e-3)


def test_a_wave_looks_upwards():
    surface = surface_of(tuple(body for body in ALL if body.shape == "wave"))
    a, b, c = corners(surface)
    assert (np.cross(b - a, c - a)[:, 1] > 0).all()


def test_of_no_bodies_there_is_none():
    assert surface_of(()) is None
