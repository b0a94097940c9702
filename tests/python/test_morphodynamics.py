"""Slopes, fluxes, shares and avalanches of dunes that are built so that the answers are known."""

import math

import h5py
import numpy as np
import pytest
from make_fake_run import write_frame

from barchan import MissingData, Run
from barchan.dune import fluxes, slopes, transport
from barchan.dune.shape import Bed, main_dune
from barchan.dune.surface import Surface
from barchan.io.frames import Grains
from barchan.stats import over_the_last_second, window, within

D, PHI = 2e-4, 0.55
SIZE = (0.06, 0.01, 0.012)
BED = Bed((SIZE[0], SIZE[2]), (True, True))
RIDGES = [(8, 24, 0, 0.02), (12, 30, 4e-3, 0.05), (20, 20, 0, 0.02)]  # angles, length of the flat top, begin
LINES = [(0.02, 0.024), (0.056, 0.0)]  # begin of a box, line in it: the second box lies across the seam
MOVED = PHI * 2e-3 * 4e-4 * 6e-3  # volume of a box of 2 mm over 6 mm of a line: some 630 grains


@pytest.fixture
def random():
    return np.random.default_rng(7)


def ridge(random, height, length, width=8e-3, x0=0.02, z0=2e-3):
    """Grains at random under height(x) [m] for 0 < x < length, from x0 and z0 on; their centres are inside."""
    top = max(height(x) for x in np.linspace(0, length, 200))
    n = int(PHI * length * width * top / (math.pi / 6 * D**3))
    x, y, z = random.uniform(0, length, n), random.uniform(0, top, n), random.uniform(0, width, n)
    inside = y < np.array([height(each) for each in x])
    return np.stack([x0 + x, y, z0 + z], axis=1)[inside]


def frame(x, t=0.0, u=None):
    n = len(x)
    wrapped = np.mod(x, (SIZE[0], 1.0, SIZE[2]))
    return Grains(t, np.arange(n), wrapped, np.full(n, D), np.zeros(n, int), u)


def dune_of(grains, crest_x, L=0.0):
    """The dune of a frame, as a line of dune.csv with these numbers has it."""
    return main_dune(grains, BED, {name: np.array([value]) for name, value in (
        ("t", 0.0), ("W", 0.0), ("L", L), ("H", 0.0), ("crest_x", crest_x % SIZE[0]), ("horn_left", 0.0),
        ("horn_right", 0.0))})


def test_a_window_is_exact_to_the_step():
    for step in (1e-10, 1e-15, 1 / 3):
        t = np.array([float(f"{n * step:.10g}") for n in range(6)])
        assert list(np.nonzero(within(t, step, 3 * step))[0]) == [1, 2, 3], step


def triangle(stoss, slip, top, flat=0.0):
    """(height(x), length): up with an angle, along a flat top, down with another one."""
    a, b = math.tan(math.radians(stoss)), math.tan(math.radians(slip))
    brink = top / a + flat
    return lambda x: min(a * x, top, max(0.0, top - b * (x - brink))), brink + top / b


@pytest.mark.parametrize("stoss, slip, flat, x0", RIDGES)
def test_angles_brink_and_packing(random, stoss, slip, flat, x0):
    """Of a sharp crest and of a flat one; the dune may lie across the periodic seams."""
    height, length = triangle(stoss, slip, 2.4e-3, flat)
    grains = frame(ridge(random, height, length, x0=x0))
    dune = dune_of(grains, x0 + 2.4e-3 / math.tan(math.radians(stoss)) + 0.5 * flat, length)
    shape = slopes.slopes(dune, D)
    assert shape.stoss == pytest.approx(stoss, abs=1.0)
    assert shape.slip_face == pytest.approx(slip, abs=2.5)
    brink = x0 + 2.4e-3 / math.tan(math.radians(stoss)) + flat
    assert abs((shape.brink_x - brink + 0.03) % SIZE[0] - 0.03) <= 2 * 2.5 * D
    assert shape.crest_height == pytest.approx(2.4e-3 + 0.5 * D, abs=1.5 * D)
    assert fluxes.packing(grains, dune) == pytest.approx(PHI, abs=0.05 * PHI)


def box_and_steps(random):
    box = ridge(random, lambda x: 2e-3, 8e-3)
    return box, np.concatenate([ridge(random, lambda x: 0.8e-3, 8e-3, 4e-3),
                                ridge(random, lambda x: 1.6e-3, 8e-3, 4e-3, z0=6e-3)])


def test_asymmetry(random):
    """A ridge of one height is its own mirror image; 4 and 8 beside each other differ by a third."""
    box, steps = box_and_steps(random)
    surface = Surface(box[:, 0], box[:, 1] + 0.5 * D, box[:, 2], (2.5 * D, 2.5 * D))
    assert slopes.asymmetry(surface, 6e-3) == pytest.approx(0, abs=0.03)
    surface = Surface(steps[:, 0], steps[:, 1], steps[:, 2], (2.5 * D, 2.5 * D))
    assert slopes.asymmetry(surface, 6e-3) == pytest.approx(1 / 3, abs=0.04)


def volume_over(random, x0, line):
    """Of a box that moves on by 0.4 mm; the way back is the same volume."""
    box = ridge(random, lambda x: 2e-3, 8e-3, x0=x0)
    before, after = frame(box), frame(box + (4e-4, 0, 0))
    volume, _ = fluxes.crossings(before, after, BED, line, 6e-3, 3e-3)
    back, _ = fluxes.crossings(after, before, BED, line, 6e-3, 3e-3)
    assert back == pytest.approx(-volume, abs=1e-18)
    return volume


@pytest.mark.parametrize("x0, line", LINES)
def test_volume_over_a_line(random, x0, line):
    """Also over the seam. One box has 5 % of noise, the mean of 20 has 1 %."""
    assert np.mean([volume_over(random, x0, line) for _ in range(20)]) == pytest.approx(MOVED, rel=0.03, abs=0)


def test_volume_of_one_box_over_a_line(random):
    """Two boxes, drawn after all ridges of the tests above: of others one in twenty is off by more than a tenth."""
    for stoss, slip, flat, x0 in RIDGES:
        ridge(random, *triangle(stoss, slip, 2.4e-3, flat), x0=x0)
    box_and_steps(random)
    for x0, line in LINES:
        assert volume_over(random, x0, line) == pytest.approx(MOVED, abs=0.1 * MOVED)


def test_crossings_are_counted():
    """Grains that come back count twice, and for nothing; grains beyond the strip do not count."""
    few = np.array([[0.01, 0, 5e-3], [0.011, 0, 5e-3], [0.01, 0, 9e-3], [0.01, 0, 3.9e-3]])
    # Over the line at 0.0105; the last one into the strip.
    moved = few + [[1e-3, 0, 0], [-1e-3, 0, 0], [1e-3, 0, 0], [1e-3, 0, 1e-3]]
    volume, n = fluxes.crossings(frame(few), frame(moved), BED, 0.0105, 5e-3, 1e-3)
    assert volume == pytest.approx(fluxes.volumes(D), abs=1e-20)
    assert n == 3


def test_shares_of_saltation_rolling_and_creep():
    """A bed of six layers of 60 x 250 grains. The uppermost rolls, those below creep, some grains fly."""
    along, across = np.arange(250) + 0.5, np.arange(60) + 0.5
    layers = [np.stack([a.ravel() for a in np.meshgrid(along, [y + 0.5], across, indexing="ij")], axis=1)
              for y in range(6)]
    x = D * np.concatenate([*layers, layers[0][::25] + (0, 10, 0)]) * (1, 1.1, 1)  # no ties
    u = np.zeros_like(x)
    u[:75000, 0], u[75000:90000, 0], u[90000:, 0] = 0.001, 0.01, 0.15
    grains = frame(x, 0.0, u)
    parts = fluxes.shares(grains, dune_of(grains, 125 * D * 1.1))
    assert parts == pytest.approx(np.array([90, 150, 75]) / 315, abs=0.02)


def test_avalanches(random):
    """Two in grains that move independently otherwise, one of them of two intervals; hardly any without."""
    counts = random.poisson(20.0, 400).astype(float)
    assert transport.dispersion(counts) == pytest.approx(1.0, abs=0.2)
    assert transport.avalanches(counts)[1] <= 4
    quiet = np.full(100, 20.0)
    quiet[[0, 30, 31, 99]] = [np.nan, 80, 60, 34]
    many, n = transport.avalanches(quiet)
    assert n == 2
    assert list(np.nonzero(many)[0]) == [30, 31, 99]


def test_mean_of_a_second():
    assert over_the_last_second(np.arange(30) / 10, np.arange(30.0))[25] == pytest.approx(20.5, abs=1e-9)


C, LENGTH = 1e-2, triangle(10, 25, 2.4e-3, 4e-3)[1]


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A dune that moves on unchanged by C [m/s]."""
    path = tmp_path_factory.mktemp("run")
    height, length = triangle(10, 25, 2.4e-3, 4e-3)
    start = ridge(np.random.default_rng(7), height, length, width=10e-3, z0=1e-3)
    times = np.arange(31) / 10
    (path / "config.toml").write_text(
        f'[case]\ntitle = "a dune"\n[domain]\nsize = {list(SIZE)}\n[grains]\nboundary_x = "periodic"\n')
    crest_x = 0.02 + 2.4e-3 / math.tan(math.radians(10)) + 2e-3
    (path / "dune.csv").write_text("t,dune,Cx,Cz,celerity,W,L,H,crest_x,horn_left,horn_right\n" + "".join(
        f"{t},0,{C * t},0,{C},0.01,{length},2.4e-3,{(crest_x + C * t) % SIZE[0]},0,0\n" for t in times))
    with h5py.File(path / "grains.h5", "w") as file:
        for index, t in enumerate(times):
            g = frame(start + (C * t, 0, 0))
            write_frame(file, index, t, {"id": g.id, "x": g.x, "d": g.d, "dune": g.dune, "u": 0 * g.x + (C, 0, 0)})
    return Run(path)


def test_the_flux_over_the_crest_moves_the_dune(run):
    """It is phi c H, and nothing is lost. The same 370 grains go over the crest from frame to frame: 5 % of noise."""
    table, _ = transport.measure(run)
    crest, moving = (np.nanmean(table[name]) for name in ("crest_flux", "migration_flux"))
    assert crest == pytest.approx(PHI * C * 2.4e-3, abs=0.12 * crest)
    assert moving == pytest.approx(PHI * C * 2.4e-3, abs=0.08 * crest)
    assert np.nanmean(table["slip_face_flux"]) == pytest.approx(0.5 * PHI * C * 2.4e-3, abs=0.15 * crest)
    assert table["kept"][-1] == 1
    assert np.mean(table["turnover_time"]) == pytest.approx(LENGTH / C, abs=0.05 * LENGTH / C)
    lines = list(transport.summary(table, transport.measure_shares(run), window(table["t"], 1.0, 3.0)))
    assert lines[0].startswith("mean of t = 1 to 3 s")
    assert f"flux over the crest {crest:.3g}"[:-4] in lines[2]


def test_the_figure_has_every_frame(run):
    numbers = run.figure("morphodynamics", start=1.0).numbers
    for name in ("morphodynamics", "transport_shares"):
        assert {len(column) for column in numbers[name].values()} == {31}


def test_a_window_after_the_end(run):
    reason = "needs two frames between 5 s and 3 s"
    with pytest.raises(MissingData, match=reason):
        window(np.arange(31) / 10, 5.0, None)
    with pytest.raises(MissingData, match=reason):
        run.figure("morphodynamics", start=5.0)
