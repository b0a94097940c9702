"""Encounters of run folders: the picture, encounters.csv, run.json, and words where there is nothing to tell."""

import json

import h5py
import made_up_encounters as built
import numpy as np
import pytest
from made_up_encounters import LARGE, SMALL, TIMES, Pair, write_run

import barchan
from barchan import plot
from barchan.dune.current import currents, direction, reversal_times, sentences
from barchan.dune.detect import labels
from barchan.dune.lineage import follow
from barchan.dune.shape import Bed
from barchan.figures.encounters import foreign
from barchan.io.frames import Grains
from barchan.io.tables import read_table


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    pair = Pair(built.exchange())
    return write_run(tmp_path_factory.mktemp("runs") / "exchange", pair.frames(), pair.bed, pair.heap)


def test_the_command_writes_picture_table_and_entry(run, capsys):
    assert plot.main([str(run), "encounters"]) == 0
    said = capsys.readouterr().out
    assert "dune 1 behind dune 0: exchange (contact at" in said
    assert (run / "encounters.png").stat().st_size > 10_000
    table = read_table(run / "encounters.csv")
    assert table["class"].tolist() == ["exchange"]
    assert table["upstream"].tolist() == [1]
    summary = json.loads((run / "run.json").read_text())
    assert summary["status"] == "done" and summary["steps"] == 3
    one, = summary["encounters"]
    assert (one["class"], one["upstream"], one["downstream"], one["new_dunes"]) == ("exchange", 1, 0, "2")
    assert one["t_apart"] is None and one["t_contact"] == table["t_contact"][0]


def test_the_numbers_behind_it(run):
    numbers = barchan.open(run).figure("encounters").numbers
    last = np.array(numbers["exchange"]["t"]) == TIMES[-1]
    grains = {(heap, dune): n for heap, dune, n in zip(*(np.array(numbers["exchange"][name])[last]
                                                         for name in ("heap", "dune", "n_grains")))}
    assert sum(grains.values()) == len(SMALL) + len(LARGE) + built.LOOSE
    assert grains[0, 1] == pytest.approx(len(SMALL), rel=0.02)
    assert grains[1, 2] == pytest.approx(np.count_nonzero(built.FRONT), rel=0.05)
    names = numbers["dune_names"]
    assert set(names["dune"]) == {0, 1, 2}
    touching = {(t, body) for t, dune, body in zip(names["t"], names["dune"], names["body"]) if dune == 0}
    assert touching & {(t, body) for t, dune, body in zip(names["t"], names["dune"], names["body"]) if dune == 1}


def test_the_share_of_other_heaps():
    """An eighth of the large one ends on the small one; grains that were loose at first are of no heap."""
    pair = Pair(built.passing())
    lineage = follow(pair.frames(TIMES[::4]), pair.bed)
    taken = np.count_nonzero(np.arange(len(LARGE)) % 8 == 0)
    share = foreign(lineage, 1)
    assert share[0] == 0
    assert share[-1] == pytest.approx(taken / (len(SMALL) + taken), rel=0.05)


def test_a_run_that_goes_on_keeps_its_summary(run, tmp_path):
    frames = Pair(built.chasing()).frames(TIMES[:6])
    folder = write_run(tmp_path / "goes_on", frames, Pair(built.chasing()).bed)
    (folder / "run.json").write_text('{"status": "running"}')
    assert plot.main([str(folder), "encounters"]) == 0
    assert (folder / "run.json").read_text() == '{"status": "running"}'
    assert read_table(folder / "encounters.csv")["class"].tolist() == ["chasing"]


def alone(grains):
    return [(grains, 0, built.line(built.X0, 1e-3))]


@pytest.mark.parametrize("parts, times, says", [
    (alone(SMALL[:50]), TIMES[:4], "have no dune"), (alone(SMALL), TIMES[:4], "have one dune"),
    (built.chasing(), TIMES[:1], "needs at least two frames")], ids=["no dune", "one dune", "one frame"])
def test_nothing_to_tell_is_told(parts, times, says, tmp_path, capsys):
    pair = Pair(parts)
    folder = write_run(tmp_path / "run", pair.frames(times), pair.bed)
    assert plot.main([str(folder), "encounters"]) == 2
    assert says in capsys.readouterr().err
    assert not (folder / "encounters.csv").exists()


def test_frames_must_say_which_dune(tmp_path, capsys):
    pair = Pair(built.chasing())
    frames = pair.frames(TIMES[:2])
    folder = write_run(tmp_path / "run", frames, pair.bed)
    with h5py.File(folder / "grains.h5", "r+") as file:
        for name in file:
            del file[name]["dune"]
    assert plot.main([str(folder), "encounters"]) == 2
    assert "which dune each grain is of (output.dune_interval > 0)" in capsys.readouterr().err


def test_currents_of_a_case():
    schedule = [{"time": 0.0, "velocity": 0.3}, {"time": 3.0, "velocity": 0.0}, {"time": 5.0, "velocity": [-0.2, 0.0]},
                {"time": 6.0, "velocity": -0.3}, {"time": 8.0, "velocity": [0.0, 0.1]}]
    found = currents({"fluid": {"schedule": schedule}})
    assert [time for time, _ in found] == [0.0, 5.0, 8.0]
    assert [unit.tolist() for _, unit in found] == [[1, 0], [-1, 0], [0, 1]]
    assert direction({"fluid": {"schedule": schedule}}, 7.0).tolist() == [-1, 0]
    assert direction({"fluid": {"mean_velocity": -0.2}}, 0.0).tolist() == [-1, 0]
    assert direction({}, 9.0).tolist() == [1, 0]


def crescent(horn):
    """A block of 4 x 8 mm with two horns [m], along +x, or along -x where the length is negative; four layers."""
    side = np.arange(-0.012, 0.012, built.D)
    x, layer, z = (each.ravel() for each in np.meshgrid(side, np.arange(4), side, indexing="ij"))
    beside = (abs(z) > 2e-3) & (x * np.sign(horn) > 0) & (abs(x) < 2e-3 + abs(horn))
    kept = (abs(z) < 4e-3) & ((abs(x) < 2e-3) | beside)
    return np.stack([x, (layer + 0.5) * built.D, z], axis=1)[kept]


@pytest.mark.parametrize("turn", [(-1.0, 0.0), (0.0, 1.0)], ids=["reversed", "across"])
def test_reversal_time(turn, tmp_path):
    """Horns along +x until 4 s, none until 6 s, then down the current that comes at 2.1 s."""
    bed = Bed((0.08, 0.03), (False, True))
    way = np.array(turn)
    frames = []
    for t in np.arange(0, 10.01, 0.1):
        x = crescent(3e-3 if t < 4 - 1e-9 else 1e-9 if t < 6 - 1e-9 else 3e-3)
        if t >= 6 - 1e-9:
            x = np.stack([way[0] * x[:, 0] - way[1] * x[:, 2], x[:, 1], way[1] * x[:, 0] + way[0] * x[:, 2]], axis=1)
        grains = Grains(float(t), np.arange(len(x)), x + (0.04, 0, 0.001), np.full(len(x), built.D))
        grains.x[:, 2] %= 0.03
        grains.dune = labels(grains, bed)
        frames.append(grains)
    schedule = (f"[fluid]\n[[fluid.schedule]]\ntime = 0.0\nvelocity = 0.3\n[[fluid.schedule]]\ntime = 2.1\n"
                f"velocity = [{0.3 * way[0]}, {0.3 * way[1]}]\n")
    folder = write_run(tmp_path / "run", frames, bed, schedule=schedule)
    (start, time), = reversal_times(barchan.open(folder))
    assert start == 2.1
    told, = sentences(barchan.open(folder))
    assert told == f"the current turns at 2.1 s: reversal time {time:.3g} s"
    assert time == pytest.approx(6 - 2.1, abs=0.11)
