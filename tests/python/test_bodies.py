"""Bodies as the program has surveyed them: heights, outlines, sections and distances against closed forms."""

import tempfile
from pathlib import Path

import numpy as np
import pytest
from fake_runs import ROOT
from survey import survey

from barchan.dune.bodies import bodies_of, tops
from barchan.io.run_folder import RunFolder

DOMAIN = (0.1, 0.04, 0.08)
SIZE = "[domain]\nsize = [0.1, 0.04, 0.08]\n"
HALF_DEGREE = 1.5e-4  # of a radius: a circle of the lattice is a polygon with corners every degree or two


def surveyed(text):
    """The bodies of a case."""
    with tempfile.TemporaryDirectory() as folder:
        (Path(folder) / "config.toml").write_text(text)
        survey(Path(folder))
        return bodies_of(RunFolder(folder))


ALL = [body for name in ("bodies", "bodies-2")
       for body in surveyed((ROOT / f"tests/reference/{name}.toml").read_text())]
NAMES = [body.name for body in ALL]
EACH = pytest.mark.parametrize("body", ALL, ids=NAMES)
ANGLES = {"turned box": 0.5, "three posts": 0.3}


def body(name):
    return ALL[NAMES.index(name)]


def exact_interval(body, x, z):
    """(bottom, top) above the floor, from the keys."""
    c, s = np.cos(ANGLES.get(body.name, 0)), np.sin(ANGLES.get(body.name, 0))
    dx, dz = x - body.centre[0], z - body.centre[1]
    p, q = c * dx + s * dz, c * dz - s * dx
    r, low, high = body.radius, 0.0 * p, body.height + 0.0 * p
    if body.shape == "cylinder" and body.axis == "y":
        inside = np.hypot(p, q) < r
    elif body.shape == "fence":
        posts = {"three posts": (-6e-3, 0.0, 6e-3), "four posts": (-9e-3, -3e-3, 3e-3, 9e-3)}[body.name]
        inside = np.min([np.hypot(p, q - post) for post in posts], axis=0) < r
    elif body.shape == "box":
        inside = (abs(p) < 0.5 * body.size[0]) & ((abs(q) < 0.5 * body.size[1]) | (body.size[1] == 0))
    elif body.shape == "dune":
        inside, low = True, low - 1.0
        high = body.height * (1 - np.hypot(p / np.where(p < 0, 0.02, 0.01), q / 0.01))
    elif body.shape == "wave":
        inside, low = True, low - 1.0
        high = 0.5 * body.height * (1 + np.cos(2 * np.pi * p / body.wavelength))
    else:
        from_axis = {"x": abs(q), "z": abs(p)}.get(body.axis if body.shape == "cylinder" else "", np.hypot(p, q))
        inside = (from_axis < r) & ((body.axis != "x") | (body.length == 0) | (abs(p) < 0.5 * body.length))
        half = np.sqrt(np.maximum(0, r**2 - from_axis**2))
        middle = 0.0 if body.shape == "half_sphere" else r
        low, high = np.maximum(middle - half, 0.0), middle + half
    inside = inside & (body.base + high > 0)
    return np.where(inside, np.maximum(body.base + low, 0.0), np.nan), np.where(inside, body.base + high, np.nan)


@EACH
def test_heights(body):
    """Within the resolution of the lattice: a steep rim lies as far off as an outline of straight pieces."""
    x0, x1, z0, z1 = body.reach
    x, z = np.random.default_rng(1).uniform((x0 - 0.003, z0 - 0.003), (x1 + 0.003, z1 + 0.003), (4000, 2)).T
    x, z = x % DOMAIN[0], z % DOMAIN[2]
    found, exact = body.interval(x, z), exact_interval(body, x, z)
    there = np.isfinite(exact[0])
    assert np.mean(np.isfinite(found[0]) != there) < 1e-3 and 100 < there.sum()
    both = there & np.isfinite(found[0])
    size = body.top - body.base
    flat = body.shape in ("box", "fence") or (body.shape, body.axis) == ("cylinder", "y")
    for one, other in zip(found, exact):
        error = abs(one - other)[both] / size
        assert error.max() < (1e-12 if flat else 6e-3) and error.mean() < (1e-12 if flat else 3e-4)


@EACH
def test_what_holds_a_place(body):
    x0, x1, z0, z1 = body.reach
    x = np.random.default_rng(2).uniform((x0 - 0.003, 0, z0 - 0.003), (x1 + 0.003, body.top + 0.003, z1 + 0.003),
                                         (4000, 3))
    x[:, 0], x[:, 2] = x[:, 0] % DOMAIN[0], x[:, 2] % DOMAIN[2]
    low, high = exact_interval(body, x[:, 0], x[:, 2])
    inside = (x[:, 1] > low) & (x[:, 1] < high)
    assert np.mean(inside != body.holds(x)) < 1e-3
    assert 100 < inside.sum() < len(x) - 100


@EACH
def test_outlines(body):
    """Corners are on the edge: heights end between a little within and a little beyond, but for walls of the domain."""
    outlines = body.plan()
    assert len(outlines) == {"fence": 3 + (body.name == "four posts"), "wave": 3}.get(body.shape, 1)
    for outline in outlines:
        assert np.allclose(outline[0], outline[-1], rtol=0, atol=1e-15)
        if body.shape == "wave":  # half its height is a quarter of a wavelength from the crest
            edges = np.unique(outline[:, 0])
            away = (edges - body.centre[0] + body.wavelength / 2) % body.wavelength - body.wavelength / 2
            at_end = (edges == 0) | (edges == DOMAIN[0])
            assert abs(away[~at_end]) == pytest.approx(body.wavelength / 4, rel=1e-4)
            continue
        middle = outline.mean(axis=0)
        spans = (outline[:, 1] < 1e-6) | (outline[:, 1] > DOMAIN[2] - 1e-6)
        for share, solid in ((1 - 1e-6, True), (1 + 1e-6, False)):
            places = (middle + share * (outline - middle))[~spans]
            assert np.all(np.isfinite(exact_interval(body, *places.T)[1]) == solid)


@EACH
def test_sections(body):
    """Their corners are the heights in that plane."""
    z = body.heart[1]
    outlines = body.section(z)
    assert outlines
    for outline in outlines:
        low, high = exact_interval(body, outline[:, 0], np.full(len(outline), z))
        off = np.nanmin([abs(outline[:, 1] - low), abs(outline[:, 1] - high)], axis=0)
        assert off.max() < 6e-3 * (body.top - body.base)
        assert np.max(outline[:, 1]) == pytest.approx(body.top, abs=1e-5)


@pytest.mark.parametrize("name, area", [
    ("sphere", np.pi * 0.006**2), ("half sphere", np.pi * 0.006**2 / 2),
    ("turned box", 0.008 * (0.02 * np.sin(0.5) + 0.01 * np.cos(0.5))), ("four posts", 4 * 0.004 * 0.01)])
def test_frontal_areas(name, area):
    assert body(name).frontal_area() == pytest.approx(area, rel=0.01)


def test_distances_from_outlines():
    box = body("turned box")
    along, across = np.array((np.cos(0.5), np.sin(0.5))), np.array((-np.sin(0.5), np.cos(0.5)))
    corner = np.array(box.centre) + 0.01 * along + 0.005 * across
    for place, distance in ((corner + 0.003 * along, 0.003), (corner + 0.003 * along + 0.004 * across, 0.005),
                            (corner - 0.001 * across, 0.0), (corner - 0.002 * along + (0.1, -0.08), 0.0)):
        assert box.beside(*place) == pytest.approx(distance, abs=1e-11)
    post = body("four posts")  # the outermost one, and between two
    assert post.beside(0.05, 0.04 + 0.009 + 0.005) == pytest.approx(0.003, abs=0.002 * HALF_DEGREE)
    assert post.beside(0.05, 0.04) == pytest.approx(0.001, abs=0.002 * HALF_DEGREE)


def test_what_touches():
    """Sides, top and lower side of a sphere from 4 to 16 mm with a radius of 6 mm."""
    sphere, reach = body("sphere"), 2e-4
    x = np.array([(0.06, 0.016 + reach * share, 0.05) for share in (0.9, 1.1)]
                 + [(0.066 + reach * share, 0.01, 0.05) for share in (0.9, 1.1)]
                 + [(0.06, 0.004 - reach * share, 0.05) for share in (0.9, 1.1)])
    assert sphere.touches(x, np.full(6, reach)).tolist() == [True, False] * 3


def test_the_highest_of_several():
    low, tall = surveyed(SIZE + "".join(
        f'[[body]]\nname = "{name}"\nshape = "cylinder"\ncentre = [{x}, 0.04]\nradius = 0.005\nheight = {height}\n'
        for name, x, height in (("a", 0.02, 0.004), ("b", 0.06, 0.009))))
    assert (low.number, tall.number) == (0, 1)
    assert tops((low, tall), np.array([0.02, 0.06]), 0.04) == pytest.approx([0.004, 0.009], abs=1e-15)
    assert np.isnan(tops((low, tall), 0.04, 0.04))


def test_a_run_without_bodies(tmp_path):
    assert bodies_of(RunFolder(tmp_path)) == ()
