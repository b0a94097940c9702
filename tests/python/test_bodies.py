"""Bodies at rest: distances, extents and outlines."""

import tomllib

import numpy as np
import pytest
from fake_runs import ROOT

from barchan.dune.bodies import Body, bodies_of, nearest, tops
from barchan.io.tables import read_table

REFERENCE = ROOT / "tests/reference"
DOMAIN = (0.1, 0.04, 0.08)


def bodies(name):
    return bodies_of(tomllib.loads((REFERENCE / f"{name}.toml").read_text()))


ALL = [(name, body) for name in ("bodies", "bodies-2") for body in bodies(name)]
NAMES = [body.name for _, body in ALL]


def random_places(body, n=4000, seed=1):
    x0, x1, z0, z1 = body.reach
    side = 0.003
    return np.random.default_rng(seed).uniform((x0 - side, 0, z0 - side), (x1 + side, body.top + side, z1 + side),
                                               (n, 3))


@pytest.mark.parametrize("name, body", ALL, ids=NAMES)
def test_distances_are_those_of_the_program(name, body):
    """The program's test reads the same table."""
    table = read_table(REFERENCE / "body_distances.csv").where("file", name).where("body", body.number)
    x = np.stack([table["x"], table["y"], table["z"]], axis=1)
    assert len(x) > 10
    assert np.allclose(body.distance(x), table["distance"], rtol=0, atol=1e-15)


def test_distances_that_anyone_can_see():
    cylinder = Body(0, "c", "cylinder", DOMAIN, (0.05, 0.04), radius=0.006, height=0.01)
    assert cylinder.distance((0.05, 0.02, 0.04)) == pytest.approx(0.01)
    assert cylinder.distance((0.05 + 0.009, 0.014, 0.04)) == pytest.approx(0.005)      # 3, 4, 5 from the rim
    assert cylinder.distance((0.05, 0.004, 0.04 + 0.005)) == pytest.approx(-0.001)
    sphere = Body(0, "s", "sphere", DOMAIN, (0.05, 0.04), base=0.001, radius=0.002)
    assert sphere.distance((0.05 + 0.003, 0.003 + 0.004, 0.04)) == pytest.approx(0.003)
    assert sphere.distance((0.05 + 0.1, 0.003, 0.04 - 0.08)) == pytest.approx(-0.002)  # its image
    box = Body(0, "b", "box", DOMAIN, (0.05, 0.04), height=0.01, size=(0.02, 0.01), angle=np.pi / 2)
    assert box.distance((0.05, 0.005, 0.04 + 0.013)) == pytest.approx(0.003)           # turned: long along z
    assert box.distance((0.05 + 0.008, 0.005, 0.04 + 0.014)) == pytest.approx(0.005)
    dune = Body(0, "d", "dune", DOMAIN, (0.05, 0.04), height=0.006, size=(0.03, 0.02), lee=0.01)
    assert dune.distance((0.05, 0.006, 0.04)) == pytest.approx(0, abs=1e-15)
    assert dune.distance((0.03, 0.0, 0.04)) == pytest.approx(0, abs=1e-15)
    lying = Body(0, "l", "cylinder", DOMAIN, (0.05, 0.04), base=0.002, axis="z", radius=0.004)
    assert lying.distance((0.05 + 0.006, 0.014, 0.077)) == pytest.approx(0.006)        # 6, 8, 10 from the axis


@pytest.mark.parametrize("name, body", ALL, ids=NAMES)
def test_what_is_solid_over_a_place_is_where_the_distance_is_negative(name, body):
    x = random_places(body)
    low, high = body.interval(x[:, 0], x[:, 2])
    inside = (x[:, 1] > low) & (x[:, 1] < high)
    assert np.array_equal(inside, body.distance(x) < 0)
    assert 100 < inside.sum() < len(x) - 100


@pytest.mark.parametrize("name, body", ALL, ids=NAMES)
def test_outlines_lie_on_the_surface(name, body):
    # Corners on the surface, but for ends at the walls of the domain.
    height = body.base + 0.4 * body.tall if body.base >= 0 else 0.004
    x0, x1, z0, z1 = 0.0, DOMAIN[0], 0.0, DOMAIN[2]
    outlines = body.plan(height)
    assert len(outlines) == {"fence": body.posts, "wave": 3}.get(body.form, 1)
    for outline in outlines:
        assert np.array_equal(outline[0], outline[-1]) or np.allclose(outline[0], outline[-1], rtol=0, atol=1e-15)
        x = np.stack([outline[:, 0], np.full(len(outline), height), outline[:, 1]], axis=1)
        free = (x[:, 0] > x0) & (x[:, 0] < x1) & (x[:, 2] > z0) & (x[:, 2] < z1)
        through = body.form in ("wave", "cylinder_z") or (body.form == "box" and body.size[1] == 0)
        assert free.all() == (not through)
        assert np.all(abs(body.distance(x[free])) < 1e-12)


@pytest.mark.parametrize("name, body", ALL, ids=NAMES)
def test_sections_lie_on_the_surface(name, body):
    z = body.heart[1]
    outlines = body.section(z)
    assert outlines
    for outline in outlines:
        x = np.stack([outline[:, 0], outline[:, 1], np.full(len(outline), z)], axis=1)
        on_floor = (outline[:, 1] < 1e-12) | (outline[:, 0] < 1e-12) | (outline[:, 0] > DOMAIN[0] - 1e-12)
        assert np.all(abs(body.distance(x[~on_floor])) < 1e-9)
        assert np.max(outline[:, 1]) == pytest.approx(body.top, abs=1e-5)


def test_frontal_areas():
    r = 0.006
    sphere = Body(0, "s", "sphere", DOMAIN, (0.05, 0.04), base=0.004, radius=r)
    half = Body(0, "h", "half_sphere", DOMAIN, (0.05, 0.04), radius=r)
    turned = Body(0, "b", "box", DOMAIN, (0.05, 0.04), height=0.008, size=(0.02, 0.01), angle=np.pi / 4)
    fence = bodies("bodies-2")[3]
    for body, area in ((sphere, np.pi * r**2), (half, np.pi * r**2 / 2), (turned, 0.008 * 0.03 / np.sqrt(2)),
                       (fence, 4 * 0.004 * 0.01)):
        assert body.frontal_area() == pytest.approx(area, rel=0.01)


def test_the_nearest_and_the_highest_of_several():
    low = Body(0, "a", "cylinder", DOMAIN, (0.02, 0.04), radius=0.005, height=0.004)
    tall = Body(1, "b", "cylinder", DOMAIN, (0.06, 0.04), radius=0.005, height=0.009)
    assert nearest((low, tall), (0.03, 0.003, 0.04)) == pytest.approx(0.005)
    assert nearest((), np.zeros((2, 3))).tolist() == [np.inf, np.inf]
    assert tops((low, tall), np.array([0.02, 0.06, 0.04]), 0.04).tolist()[:2] == [0.004, 0.009]
    assert np.isnan(tops((low, tall), 0.04, 0.04))


def test_bodies_of_a_case_without_any():
    assert bodies_of({}) == () and bodies_of({"domain": {"size": [1, 1, 1]}}) == ()
