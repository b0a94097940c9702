"""Dunes and separation bubbles that are built so that the answers are known, found without any table of the program."""

import os
import subprocess

import numpy as np
import pytest
from fake_runs import ROOT, fake

import barchan
from barchan.dune import detect
from barchan.dune.outline import main_outline
from barchan.dune.shape import Bed
from barchan.dune.slopes import slopes
from barchan.flow.over_dune import backflow, separation_bubble
from barchan.io.flow_average import FlowAverage
from barchan.io.frames import Grains

D = 2e-4
SIZE = (0.06, 0.03)
BIN = 2.5 * D


def sand(inside, layers, origin=(0.0, 0.0)):
    """Centres (N, 3) [m] of layers of grains on a square grid of one diameter, where inside(x, z, layer) is true."""
    side = np.arange(-0.015, 0.015, D)
    x, layer, z = (each.ravel() for each in np.meshgrid(side, np.arange(layers), side, indexing="ij"))
    kept = inside(x, z, layer)
    return np.stack([origin[0] + x, (layer + 0.5) * D, origin[1] + z], axis=1)[kept]


def cone(x, z, layer):
    """Ten layers, from a radius of 5 mm down to 0.5 mm."""
    return np.hypot(x, z) < 5e-3 - 5e-4 * layer


def crescent(x, z, layer):
    """A block of 8 x 12 mm with horns of 4 mm at z < 0 and 2 mm at z > 0, three layers."""
    body = (abs(x) < 4e-3) & (abs(z) < 6e-3)
    left = (x >= 4e-3) & (x < 8e-3) & (z > -6e-3) & (z < -3e-3)
    right = (x >= 4e-3) & (x < 6e-3) & (z < 6e-3) & (z > 3e-3)
    return body | left | right


def wrapped(x):
    return np.mod(x, (SIZE[0], 1.0, SIZE[1]))


@pytest.mark.parametrize("origin", [(0.02, 0.015), (0.0, 0.0), (0.0592, 0.0296)])
def test_a_cone(origin):
    """Also across both seams. Its outline is known within a bin."""
    table, label = barchan.find_dunes(wrapped(sand(cone, 10, origin)), D, SIZE, (True, True))
    assert len(table) == 1
    dune = table.loc[0]
    assert dune.W == pytest.approx(10e-3, abs=BIN)
    assert dune.L == pytest.approx(10e-3, abs=BIN)
    assert dune.H == pytest.approx(10 * D, abs=D)
    assert dune.horn_left == dune.horn_right == 0
    for name, middle, length in (("Cx", origin[0], SIZE[0]), ("Cz", origin[1], SIZE[1]), ("crest_x", origin[0], SIZE[0])):
        assert abs((dune[name] - middle + length / 2) % length - length / 2) < 0.5 * BIN
    assert dune.n_grains == np.count_nonzero(label == 0) == pytest.approx(len(label), rel=0.02)
    assert table.attrs["units"]["W"] == "m"


def test_the_horns_of_a_crescent():
    table, _ = barchan.find_dunes(sand(crescent, 3, (0.03, 0.015)), D, SIZE)
    dune = table.loc[0]
    assert dune.horn_left == pytest.approx(4e-3, abs=D)
    assert dune.horn_right == pytest.approx(2e-3, abs=D)
    assert dune.horn_left_2d == pytest.approx(4e-3, abs=2 * BIN)
    assert (dune.W, dune.L) == (pytest.approx(12e-3, abs=D), pytest.approx(8e-3, abs=D))


def test_two_dunes_and_loose_grains():
    """The larger is the first. A dense single layer and scattered grains are no dune."""
    rng = np.random.default_rng(3)
    large, small = sand(cone, 10, (0.015, 0.015)), sand(cone, 6, (0.03, 0.015))
    layer = sand(lambda x, z, layer: np.hypot(x, z) < 4e-3, 1, (0.045, 0.015))
    loose = np.stack([rng.uniform(0.051, SIZE[0], 50), np.full(50, D / 2), rng.uniform(0, SIZE[1], 50)], axis=1)
    table, label = barchan.find_dunes(np.concatenate([small, large, layer, loose]), D, SIZE)
    assert len(table) == 2
    assert table.volume[0] > table.volume[1]
    assert table.Cx.tolist() == [pytest.approx(0.015, abs=BIN), pytest.approx(0.03, abs=BIN)]
    assert (label[-len(layer) - 50:] == -1).all()


def test_slopes_of_a_dune_that_no_table_has():
    """A layer of 0.2 mm every 0.5 mm: 21.8 degrees up and down."""
    x = sand(cone, 10, (0.02, 0.015))
    grains = Grains(0.0, np.arange(len(x)), x, np.full(len(x), D))
    found = detect.dunes(grains, Bed(SIZE, (False, True)))
    assert len(found) == 1
    sides = slopes(found[0], D)
    assert (sides.stoss, sides.slip_face) == (pytest.approx(21.8, abs=3), pytest.approx(21.8, abs=3))


def test_too_few_grains_are_no_dune():
    table, label = barchan.find_dunes(sand(cone, 10)[:60] + (0.02, 0, 0.015), D, SIZE)
    assert len(table) == 0
    assert (label == -1).all()


@pytest.mark.parametrize("x, d, size, says", [
    (np.zeros((3, 2)), D, SIZE, "N x 3"), (np.zeros((0, 3)), D, SIZE, "N x 3"),
    (np.full((3, 3), np.nan), D, SIZE, "finite"), (np.zeros((3, 3)), 0.0, SIZE, "positive"),
    (np.zeros((3, 3)), np.inf, SIZE, "positive"), (np.zeros((3, 3)), np.full(2, D), SIZE, "3 diameters"),
    (np.zeros((3, 3)), D, (1.0,), "along x and z"), (np.zeros((3, 3)), D, 0.06, "along x and z"),
    (np.zeros((3, 3)), D, (np.nan, 0.03), "lengths are positive"), ("grains.csv", D, SIZE, "x must be numbers"),
    (np.zeros((3, 3)), "0.2 mm", SIZE, "d must be numbers"), (np.zeros((3, 3)), D, "ab", "size must be numbers"),
    (np.zeros((3, 3)), 1e3 * D, SIZE, "a diameter, 0.2, is no smaller than the domain, 0.03")])
def test_wrong_arrays_are_refused(x, d, size, says):
    with pytest.raises(barchan.BadInput, match=says):
        barchan.find_dunes(x, d, size)


def test_backflow_ends_where_u_is_zero():
    x = np.linspace(0, 10, 11)
    assert backflow(x, (x - 2.5) * (x - 6.5))["length"] == pytest.approx(4.0, abs=0.2)
    found = backflow(x, np.interp(x, [0, 2, 5, 8, 10], [1, 1, -2, 1, 1]))
    assert found == {"separation": pytest.approx(3), "reattachment": pytest.approx(7), "length": pytest.approx(4)}
    assert backflow(x, np.where(x < 4, -1.0, 1.0)) == {"separation": 0.0, "reattachment": 3.5, "length": 3.5}
    assert np.isnan(backflow(x, 1 + x)["length"])


def test_the_bubble_of_a_known_flow():
    """It ends where 1.1 - 250 |x - x0| falls below (y/Ly)^(1/7) in the lowest cells, and begins behind the crest."""
    run = barchan.Run(fake("--average"))
    average, outline = FlowAverage(run), main_outline(run)
    found = separation_bubble(average, outline)
    x0 = 0.025 + 2.5e-3 * 8 + 4.4e-3
    lowest = average.y[0]
    half = (1.1 - (lowest / 0.025)**(1 / 7)) / 250
    assert found["reattachment"] == pytest.approx(x0 + half, abs=average.x[1] - average.x[0])
    assert outline.x[np.argmax(outline.h)] <= found["separation"] < x0
    assert found["length"] == pytest.approx(found["reattachment"] - found["separation"])


@pytest.mark.skipif("BARCHAN_PROGRAM" not in os.environ, reason="needs the program, whose path BARCHAN_PROGRAM has")
def test_the_program_measures_the_same(tmp_path):
    """dune.csv and the labels of its frames, to single precision of the stored positions."""
    out = tmp_path / "dune"
    case = ROOT / "tests/support/small_dune.toml"
    subprocess.run([os.environ["BARCHAN_PROGRAM"], "run", case, "--out", out], check=True, capture_output=True)
    run = barchan.Run(out)
    size = (run.domain[0], run.domain[2])
    for grains in run.frames():
        table, label = barchan.find_dunes(grains[["x", "y", "z"]], grains.d, size)
        assert (label == grains.dune).all()
        theirs = run.dunes.loc[0].loc[grains.attrs["time"]]
        for name in table.columns:
            assert table[name][0] == pytest.approx(theirs[name], rel=1e-5, abs=1e-8 * size[0]), name


def test_centres_in_millimetres_are_warned_of():
    with pytest.warns(UserWarning, match="both be in metres"):
        barchan.find_dunes(1e3 * sand(cone, 10), 1e3 * D, SIZE)
