"""A dune that meets a body or a crater: built sequences of each class, and scour around a body in a built bed."""

import json
import re

import made_up_encounters as built
import numpy as np
import pytest
from made_up_encounters import D, SMALL, TIMES, Pair, after, line, write_run

import barchan
from barchan import plot
from barchan.dune import obstacles
from barchan.dune.shape import Bed
from barchan.io.frames import Grains
from barchan.io.tables import read_table

WIDE = """[[body]]
name = "hill"
shape = "dune"
centre = [0.03, 0.015]
height = 0.002
size = [0.008, 0.012]
lee = 0.003
"""
NARROW = """[[body]]
name = "pile"
shape = "cylinder"
centre = [0.03, 0.015]
radius = 0.0015
height = 0.004
"""
CRATER = """[[initial.crater]]
centre = [0.03, 0.015]
radius = 0.004
depth = 0.0002
"""
SPEED = 3e-3  # [m/s]: from 12 to 42 mm in 10 s


def through():
    return [(SMALL, 0, line(built.X0, SPEED))]


def around():
    """Two halves that go apart before the obstacle."""
    def path(sign):
        return lambda t: np.array((built.X0 + SPEED * t, 0.015 + sign * min(4e-3, 1.5e-3 * t)))
    left = SMALL[:, 2] < 0
    return [(SMALL[left], 0, path(-1)), (SMALL[~left], 0, path(1))]


def until(x):
    """It stands from when its middle is at x."""
    stop = (x - built.X0) / SPEED
    return [(SMALL, 0, after(stop, line(built.X0, SPEED), lambda t: np.array((x, 0.015))))]


def torn():
    """From the middle of the obstacle on its grains go at all speeds from 0 to 4 mm/s."""
    parts = np.array_split(np.random.default_rng(3).permutation(len(SMALL)), 12)
    own = line(built.X0, SPEED)
    return [(SMALL[rows], 0, after(6, own, lambda t, speed=speed: own(6) + np.array((speed * (t - 6), 0.0))))
            for rows, speed in zip(parts, np.linspace(0, 5e-3, len(parts)))]


def told(parts, obstacle, folder, times=TIMES[::2], periodic=(False, True), origin=(0.0, 0.0)):
    pair = Pair(parts, periodic=periodic, origin=origin)
    frames = pair.frames(times)
    for grains in frames:
        inside = grains.x[:, 0] < pair.bed.lengths[0]
        for name in ("id", "x", "d", "dune"):
            setattr(grains, name, getattr(grains, name)[inside])
    return write_run(folder / "run", frames, pair.bed, schedule=obstacle)


CASES = [
    (through, WIDE, "passes over"), (around, NARROW, "bypass"), (lambda: until(0.0253), WIDE, "trapped"),
    (lambda: until(0.020), WIDE, "undecided"), (lambda: [(SMALL, 0, line(built.X0, 1.3e-3))], WIDE, "undecided"),
    (through, CRATER, "passes over"), (lambda: until(0.0295), CRATER, "blocked"), (torn, CRATER, "destroyed"),
    (lambda: [(SMALL, 0, line(built.X0, 1.6e-3))], CRATER, "undecided")]


@pytest.mark.parametrize("parts, obstacle, kind", CASES, ids=[f"{n} {case[2]}" for n, case in enumerate(CASES)])
def test_classes_of_built_sequences(parts, obstacle, kind, tmp_path):
    one, = obstacles.find(barchan.open(told(parts(), obstacle, tmp_path)))
    assert one.outcome == kind
    assert one.upstream + one.around + one.downstream == pytest.approx(1)
    assert one.n_grains == pytest.approx(len(SMALL), rel=0.01)


def test_times_shares_and_celerities(tmp_path):
    """The front, 3 mm ahead of the middle, reaches the foot of the hill at 25 mm after 3.3 s."""
    one, = obstacles.find(barchan.open(told(through(), WIDE, tmp_path)))
    assert one.t_contact == pytest.approx((0.025 - 0.003 - built.X0) / SPEED, abs=0.5)
    assert one.celerity_before == pytest.approx(SPEED, rel=0.02)
    assert one.celerity_after == pytest.approx(SPEED, rel=0.02)
    assert one.downstream > 0.97 and one.over > 0.97 and one.together > 0.97


def test_whether_a_dune_stands_is_not_known_after_a_contact_in_the_first_second(tmp_path):
    """It goes from 21 mm, where it all but touches the hill, to 25.3 mm in 1.4 s, and stays."""
    stays = [(SMALL, 0, after(1.4, line(0.021, SPEED), lambda t: np.array((0.0253, 0.015))))]
    one, = obstacles.find(barchan.open(told(stays, WIDE, tmp_path)))
    assert one.t_contact < 1 and np.isnan(one.celerity_before) and one.outcome == "undecided"


def test_half_of_a_dune_on_the_way(tmp_path):
    """Of a dune that stands on the hill parts are before, on and behind it, as its grains lie."""
    one, = obstacles.find(barchan.open(told(until(0.034), WIDE, tmp_path)))
    s = SMALL[:, 0] + 0.034
    assert (one.upstream, one.around, one.downstream) == pytest.approx(
        (np.mean(s < 0.025), np.mean((s >= 0.025) & (s <= 0.033)), np.mean(s > 0.033)), abs=0.03)


def test_grains_that_have_left_are_downstream(tmp_path):
    parts = [(SMALL, 0, line(built.X0, 9e-3))]
    one, = obstacles.find(barchan.open(told(parts, WIDE, tmp_path)))
    assert one.outcome == "passes over" and one.downstream > 0.97


def test_a_domain_without_ends(tmp_path):
    """It starts across the seam, passes, and comes again to the obstacle from upstream: it has passed."""
    parts = [(SMALL, 0, line(-0.002, 9e-3))]
    one, = obstacles.find(barchan.open(told(parts, WIDE, tmp_path, periodic=(True, True))))
    assert one.outcome == "passes over" and one.downstream > 0.97
    assert one.celerity_after == pytest.approx(9e-3, rel=0.02)


def test_a_control_without_a_crater_is_told_against_its_place(tmp_path):
    """As the same grains with it."""
    (tmp_path / "control").mkdir()
    with_it = obstacles.find(barchan.open(told(through(), CRATER, tmp_path)))
    place = obstacles.crater(0, {"centre": [0.03, 0.015], "radius": 0.004})
    assert obstacles.find(barchan.open(told(through(), "", tmp_path / "control")), [place]) == with_it


def test_of_heaps_on_a_bed_those_that_are_no_bed_are_followed(tmp_path):
    """The dune is heap 0; heap 1 lies still under it from end to end, so that the labels of a frame tell nothing."""
    x, z = (each.ravel() for each in np.meshgrid(np.arange(0, 0.08, 2 * D), np.arange(0, 0.03, 2 * D)))
    still = np.stack([x, np.full_like(x, 0.5 * D), z], axis=1)
    pair = Pair([(SMALL + (0, D, 0), 0, line(built.X0, SPEED)), (still, 1, lambda t: np.zeros(2))])
    frames = pair.frames(TIMES[::8])
    for grains in frames:
        grains.x[:, 0] = np.clip(grains.x[:, 0], 0, 0.0799)
        grains.dune = np.zeros(len(grains.id), int)
    one, = obstacles.find(barchan.open(write_run(tmp_path / "run", frames, pair.bed, pair.heap, schedule=CRATER)))
    assert (one.dune, one.obstacle, one.outcome) == ("heap 1", "crater 1", "passes over")
    assert one.n_grains == len(SMALL)


def test_the_command_writes_picture_table_and_entry(tmp_path, capsys):
    folder = told(until(0.0253), WIDE, tmp_path)
    assert plot.main([str(folder), "obstacles"]) == 0
    assert "dune 0 and hill: trapped (contact at" in capsys.readouterr().out
    assert (folder / "obstacles.png").stat().st_size > 10_000
    assert read_table(folder / "obstacles.csv")["class"].tolist() == ["trapped"]
    one, = json.loads((folder / "run.json").read_text())["obstacles"]
    assert (one["dune"], one["obstacle"], one["class"]) == ("dune 0", "hill", "trapped")


@pytest.mark.parametrize("parts, obstacle, says", [
    (through(), "", "needs a [[body]] or an [[initial.crater]]"),
    ([(SMALL, 0, line(0.05, 0.0))], WIDE, "needs a dune upstream of a body")], ids=["no obstacle", "downstream"])
def test_nothing_to_tell_is_told(parts, obstacle, says, tmp_path, capsys):
    assert plot.main([str(told(parts, obstacle, tmp_path, TIMES[:3])), "obstacles"]) == 2
    assert says in capsys.readouterr().err


# --- scour

RADIUS, LAYERS = 10 * D, 12
BED = Bed((0.03, 0.02), (True, True))
PILE = f"""[[body]]
name = "pile"
shape = "cylinder"
centre = [0.012, 0.01]
radius = {RADIUS}
height = 0.015
"""


def bed_with_hole(depth, angle):
    """A lattice around the pile; a hole of parabolic cross-section, one radius wide, deepest upstream of it."""
    x, layer, z = (each.ravel() for each in np.meshgrid(np.arange(0, 0.03, D) + D / 2, np.arange(LAYERS),
                                                        np.arange(0, 0.02, D) + D / 2, indexing="ij"))
    place = np.stack([x, (layer + 0.5) * D, z], axis=1)
    hole = np.array([0.012 + 1.6 * RADIUS * np.cos(angle), 0.01 - 1.6 * RADIUS * np.sin(angle)])
    r = np.hypot(x - hole[0], z - hole[1]) / RADIUS
    kept = place[:, 1] + 0.5 * D <= LAYERS * D - depth * np.clip(1 - r**2, 0, 1) + 1e-12
    kept &= np.hypot(x - 0.012, z - 0.01) > RADIUS + 0.5 * D
    place = place[kept]
    return Grains(0.0, np.arange(len(place)), place, np.full(len(place), D), np.zeros(len(place), int))


def test_scour_of_a_built_bed(tmp_path, capsys):
    """Holes of known depth, at 180 degrees upstream and then at the left; heights are known to a grain."""
    depths, angles, frames = (0.0, 0.0008, 0.0016), (np.pi, np.pi, np.pi / 2), []
    for number, (depth, angle) in enumerate(zip(depths, angles)):
        frames.append(bed_with_hole(depth, angle))
        frames[-1].time = float(number)
    folder = write_run(tmp_path / "run", frames, BED, schedule=PILE)
    assert plot.main([str(folder), "scour"]) == 0
    said = re.search(r"pile: scour depth (0\.\d+) D at the end \(D = 4 mm\), at (\d+) degrees", capsys.readouterr().out)
    assert float(said[1]) == pytest.approx(0.4, abs=0.051) and int(said[2]) == pytest.approx(90, abs=15)
    table = read_table(folder / "figures_data/scour.csv")
    assert table["depth"] == pytest.approx(depths, abs=1.001 * D)
    assert table["depth_over_diameter"] == pytest.approx(np.array(depths) / (2 * RADIUS), abs=0.051)
    assert table["far_bed"] == pytest.approx(np.full(3, LAYERS * D), abs=1e-9)
    assert table["angle"][1:] == pytest.approx((180, 90), abs=15)
    assert not table["bare"].any()


def test_scour_needs_a_bed(tmp_path, capsys):
    folder = told(through(), NARROW, tmp_path, TIMES[:3])
    assert plot.main([str(folder), "scour"]) == 2
    assert "needs a bed in grains.h5 that covers 60 % of the floor" in capsys.readouterr().err
