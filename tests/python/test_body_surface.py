"""Surfaces of bodies: on the surface by the formula of the distance, closed, outwards, with their volume."""

import numpy as np
import pytest
from test_bodies import ALL, DOMAIN, NAMES

from barchan.dune.bodies import Body
from barchan.dune.body_surface import surface_of


def corners(surface):
    return (surface.points[surface.triangles[:, corner]] for corner in range(3))


def volume(surface):
    """By the theorem of Gauss: positive where normals point outwards [m3]."""
    a, b, c = corners(surface)
    return np.einsum("ij,ij->", a, np.cross(b, c)) / 6


@pytest.mark.parametrize("name, body", ALL, ids=NAMES)
def test_corners_lie_on_the_body(name, body):
    surface = surface_of((body,))
    assert abs(body.distance(surface.points)).max() < 1e-10
    a, b, c = corners(surface)
    middles = (a + b + c) / 3
    middles = middles[((middles > 1e-9) & (middles < np.array(DOMAIN) - 1e-9)).all(axis=1)]  # bodies go on beyond
    assert abs(body.distance(middles)).max() < 4e-3 * max(body.tall, 0.001)  # of an angle of 2 to 4 degrees
    reach = body.reach
    low, high = surface.points.min(axis=0), surface.points.max(axis=0)
    # The outline of a wide lid may have no corner at the very end.
    np.testing.assert_allclose((low[0], high[0], low[2], high[2]), reach, rtol=0, atol=1e-3 * body.tall)
    assert (high[1], low[1]) == (pytest.approx(body.top), pytest.approx(0.0 if body.form == "dune" else body.base))


@pytest.mark.parametrize("name, body", [one for one in ALL if one[1].form != "wave"],
                         ids=[name for name, (_, body) in zip(NAMES, ALL) if body.form != "wave"])
def test_surfaces_are_closed_and_have_the_volume(name, body):
    surface = surface_of((body,))
    edges = np.concatenate([np.roll(surface.triangles, turn, axis=1)[:, :2] for turn in range(3)])
    places = np.unique(surface.points.round(15), axis=0, return_inverse=True)[1].reshape(-1)[edges]
    places = places[places[:, 0] != places[:, 1]]
    there, count = np.unique(places, axis=0, return_counts=True)
    back = np.unique(places[:, ::-1], axis=0)
    assert (count == 1).all() and np.array_equal(there, back)  # each edge once in each direction
    r, h, length = body.radius, body.height, body.length or DOMAIN[2]
    sizes = [size or side for size, side in zip(body.size, (DOMAIN[0], DOMAIN[2]))]
    exact = {"cylinder": np.pi * r**2 * h, "fence": body.posts * np.pi * r**2 * h, "sphere": 4 / 3 * np.pi * r**3,
             "half_sphere": 2 / 3 * np.pi * r**3, "box": h * sizes[0] * sizes[1],
             "dune": np.pi / 12 * h * sizes[0] * sizes[1],
             "cylinder_x": np.pi * r**2 * length, "cylinder_z": np.pi * r**2 * length}[body.form]
    assert volume(surface) == pytest.approx(exact, rel=2e-3)


def test_a_wave_looks_upwards():
    surface = surface_of(tuple(body for _, body in ALL if body.form == "wave"))
    a, b, c = corners(surface)
    assert (np.cross(b - a, c - a)[:, 1] > 0).all()


def test_images_across_a_periodic_boundary():
    """A ball at a corner of the box is there four times, one that touches a side from within once."""
    ball = Body(0, "b", "sphere", DOMAIN, (0.001, 0.079), radius=0.003)
    inside = Body(1, "i", "sphere", DOMAIN, (0.003, 0.04), radius=0.003)
    both = surface_of((ball, inside))
    for number, body, copies in ((0, ball, 4), (1, inside, 1)):
        triangles = both.triangles[both.body == number]
        assert abs(body.distance(both.points[np.unique(triangles)])).max() < 1e-10
        assert len(triangles) == copies * len(surface_of((inside,)).triangles)
    assert surface_of(()) is None
