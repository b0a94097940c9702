"""Slopes, solid fractions and eccentricities of made-up grains whose answers are known."""

import types

import numpy as np
import pytest
from validation import clumps, tables

from barchan import MissingData
from barchan.io.clumps import Shapes, Spheres
from barchan.io.frames import Grains


def spheres(x, d):
    return Spheres(np.array(x, float), np.full(len(x), d), np.arange(len(x)))


def run_of(x, d, domain):
    grains = Grains(0.0, np.arange(len(x)), np.array(x, float), np.full(len(x), d))
    return types.SimpleNamespace(frame=lambda _: grains, domain=domain)


def test_the_slope_of_a_ridge():
    x, z = np.meshgrid(np.arange(0.25, 40, 0.5), np.arange(0.25, 5, 0.5), indexing="ij")
    height = 0.5 * (20 - abs(x - 20)) - 0.5
    run = run_of(np.stack([x.ravel(), height.ravel(), z.ravel()], axis=1), 1.0, (40.0, 30.0, 5.0))
    assert clumps.slope(run) == pytest.approx(np.degrees(np.arctan(0.5)), abs=0.2)


def test_what_is_filled_counts_overlaps_once_and_goes_round_the_period():
    one = 4 / 3 * np.pi * 0.5**3
    box = {"period": (2.0, 2.0), "low": 0.0, "high": 2.0, "size": 0.02}
    assert clumps.filled(spheres([[1, 1, 1]], 1.0), **box) == pytest.approx(one / 8, rel=0.01)
    assert clumps.filled(spheres([[1, 1, 1], [1, 1, 1]], 1.0), **box) == pytest.approx(one / 8, rel=0.01)
    assert clumps.filled(spheres([[1.9, 1, -0.1]], 1.0), **box) == pytest.approx(one / 8, rel=0.01)
    assert clumps.filled(spheres([[1, 2, 1]], 1.0), **box) == pytest.approx(one / 16, rel=0.01)  # half above


def test_a_lattice_has_its_solid_fraction():
    x, y, z = np.meshgrid(*[np.arange(0.5, n) for n in (5, 12, 5)], indexing="ij")
    run = run_of(np.stack([x.ravel(), y.ravel(), z.ravel()], axis=1), 1.0, (5.0, 20.0, 5.0))
    low, high = clumps.LAYER[0], 12 - clumps.LAYER[1]  # whole and half layers: the mean is that of the lattice
    assert (low, high) == (2.5, 9.0)
    assert clumps.solid_fraction(run) == pytest.approx(np.pi / 6, rel=0.05)
    with pytest.raises(MissingData, match="too thin"):
        clumps.solid_fraction(run_of([[0.5, 0.5, 0.5]], 1.0, (1.0, 9.0, 1.0)))


def test_eccentricity_of_two_spheres_that_touch():
    """Over the whole surface the mean of |c x n| is c pi/4."""
    assert clumps.eccentricity(None) == 0
    touching = Shapes(np.zeros(2, int), np.array([[-0.4, 0, 0], [0.4, 0, 0]]), np.array([0.4, 0.4]))
    assert clumps.eccentricity(touching) == pytest.approx(0.4 * np.pi / 4 / 0.5, rel=1e-3)


def test_the_rolling_friction_that_is_alike(tmp_path):
    with pytest.raises(MissingData, match="finished runs"):
        clumps.save(tmp_path, tmp_path)
    rows = [f"slope,sphere,{rolling},0.3,0,{20 + 100 * rolling},1,2" for rolling in clumps.MU_R]
    rows += ["slope,cube,0,0.3,0.4,35,1,2", "slope,sand,0,0.3,0.2,60,1,2", "fraction,sphere,0,0.3,0,0.6,0.01,2"]
    tables.write(tmp_path / "clumps.csv", {}, [clumps.COLUMNS, *rows])
    table = tables.read_saved(tmp_path, "clumps")
    assert clumps.equivalent(table, "cube", 0.3) == pytest.approx(0.15)
    assert np.isnan(clumps.equivalent(table, "sand", 0.3))
    assert "cube | eccentricity 0.400, as mu_r 0.150" in list(clumps.summary(tmp_path))
    assert len(clumps.draw(tmp_path).axes) == 4


def test_zhou_grows_with_either_friction():
    assert clumps.zhou(0.5, 0.1) > clumps.zhou(0.3, 0.1) > clumps.zhou(0.3, 0.05)
