"""Outcomes of the cases from the literature: every case has a measure, and the measures find what was built."""

import argparse
import tomllib
from types import SimpleNamespace

import numpy as np
import pytest
from fake_runs import ROOT, fake
import made_up_encounters as built
from made_up_encounters import Pair

from barchan import MissingData
from barchan.dune.shape import Bed
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder
from barchan.studies.spec import read_study
from validation import field_cases, field_views

OPTIONS = argparse.Namespace(at_once=None, threads=None, out=None)


def test_every_case_of_the_sweep_has_a_measure():
    cases = {case.name for case in read_study(ROOT / "configs/field/all.toml", OPTIONS).cases}
    assert cases and all(any(name.startswith(start) for start in field_cases.KINDS) for name in cases)


def measured(rows):
    return {name: value for t, name, value in rows if t is None}


def test_ridges_across_the_seam_are_as_far_apart_as_the_shorter_way():
    """One stands at 46 mm of 48 mm, the other goes from 11 mm behind it, through the seam, to 31 mm: 17 mm the other
    way round. Towards the end one of them has a third of its grains."""
    t = np.linspace(0, 12, 121)
    apart = 0.011 + 0.002 * t
    dunes = {0: {"t": t, "Cx": 0 * t + 0.046, "n_grains": np.where(t < 9.95, 900, 300)},
             1: {"t": t[:-1], "Cx": (0.046 + apart[:-1]) % 0.048, "n_grains": 0 * t[:-1] + 800}}
    run = SimpleNamespace(config={"domain": {"size": [0.048, 0.0125, 0.01]}}, dune_columns=dunes)
    found = measured(field_cases.ridges(run, ""))
    assert found["first distance"] == pytest.approx(0.011 + 0.002 * 1.5, abs=1e-6)
    assert found["last distance"] == pytest.approx(0.048 - (0.011 + 0.002 * 9.45), abs=1e-4)
    assert found["lasts"] == pytest.approx(9.9)


def test_what_a_fed_dune_gains_counts_from_two_seconds_on():
    t = np.linspace(0, 6, 61)
    run = SimpleNamespace(main_dune_columns={"t": t, "n_grains": np.where(t < 2, 9e9, 1000 - 10 * (t - 2))})
    assert next(field_cases.fed(run, ""))[1:] == ("change from 2 s", pytest.approx(-0.04))


def test_controls_look_at_the_places_of_the_obstacles():
    def read(name):
        return tomllib.loads((ROOT / f"configs/field/{name}.toml").read_text())

    (crater,) = read("barchan-meets-crater")["initial"]["crater"]
    (cylinder,) = read("barchan-meets-cylinder-flow")["body"]
    for name, obstacle in (("barchan-on-shot", crater), ("barchan", cylinder)):
        place = field_cases.PLACES[name]
        assert {key: obstacle[key] for key in place} == place


def test_a_dune_in_a_current_that_turns(monkeypatch):
    """It loses 1 % of its first grains a second, and 10 % at once where the current turns, at 3 s; its crest is
    2 mm downstream of the centroid along the new current, of 8 mm of length."""
    t = np.linspace(0, 9, 91)
    along = []

    def seen(run, start, end, way):
        along.append((start, end, tuple(np.round(way, 3))))
        names = ("W", "L", "horn_left", "horn_right", "crest_x", "Cx")
        return {name: np.array([value]) for name, value in zip(names, (0.01, 0.008, 0.001, 0.003, 0.012, 0.010))}

    monkeypatch.setattr(field_cases.current, "seen_along", seen)
    schedule = [{"time": 0, "velocity": [0.177, 0.177]}, {"time": 3, "velocity": [0.177, -0.177], "ramp": 0.5}]
    run = SimpleNamespace(config={"fluid": {"schedule": schedule}},
                          main_dune_columns={"t": t, "n_grains": 3000 * (1 - 0.01 * t - 0.1 * (t > 3.05))})
    found = measured(field_cases.turning(run, "turn-slow"))
    assert found["loss"] == pytest.approx(0.01) and found["lasts"] == 9 and found["horn"] == 0.003
    assert found["lost"] == pytest.approx(0.01 * 8.5 + 0.1, abs=1e-3)
    assert found["crest 1"] == found["crest 2"] == pytest.approx(0.25)
    assert along == [(8.0, np.inf, (0.707, -0.707)), (2.0, 3.0, (0.707, 0.707)), (8.0, 9.0, (0.707, -0.707))]


def test_a_dune_that_ends_before_a_turn_has_no_crest_after_it(monkeypatch):
    """It ends at 2.8 s of 6, and loses a tenth of its first grains a second until then."""
    seen = {name: np.array([1e-3]) for name in ("W", "L", "horn_left", "horn_right", "crest_x", "Cx")}
    monkeypatch.setattr(field_cases.current, "seen_along", lambda run, start, end, way: seen if start < 2.8 else {})
    t = np.linspace(0, 2.8, 29)
    schedule = [{"time": 3.0 * n, "velocity": [0.2, 0.2 - 0.4 * (n % 2)]} for n in (0, 1)]
    run = SimpleNamespace(config={"fluid": {"schedule": schedule}},
                          main_dune_columns={"t": t, "n_grains": 1000 - 100 * t})
    found = measured(field_cases.turning(run, "turn-slow"))
    assert found["loss"] == pytest.approx(0.1) and found["lasts"] == 2.8
    assert "crest 1" in found and "crest 2" not in found


@pytest.mark.parametrize("turns", [True, False])
def test_a_current_that_turns_round_leaves_some_grains_where_they_were(monkeypatch, turns):
    """It turns at 3 s. The crest is on the other side from 4 s on, or never; until then three of four grains move by
    two diameters, one of these across the side, afterwards all."""
    d, t = 2e-4, np.linspace(0, 6, 61)
    bed = Bed((0.04, 0.02), (False, True))
    x = np.array([[0.01, d, 0.001], [0.01, d, 0.01], [0.02, d, 0.01], [0.03, d, 0.01]])

    def frame(time):
        moved = x + np.where(time > 3.05, 2 * d, 0) * np.array([[0, 0, -6], [1, 0, 0], [1, 0, 0], [0, 0, 0]])
        moved = moved + (time > 5) * 3 * d
        moved[:, 2] %= 0.02
        return Grains(time, np.arange(4), moved, np.full(4, d), np.zeros(4, int))

    times = np.arange(0, 6.01, 0.1)
    source = SimpleNamespace(bed=bed, times=times, read=lambda index: frame(times[index]),
                             index=lambda time: len(times) - 1 if time is None else int(round(time / 0.1)))
    monkeypatch.setattr(field_cases, "tracks", lambda run: source)
    monkeypatch.setattr(field_cases.current, "reversal_times", lambda run: [(3.0, np.nan)])
    monkeypatch.setattr(field_cases, "main_dune", lambda run: iter(()))
    ahead = np.where((t > 3.95) & turns, -1e-3, 1e-3)
    run = SimpleNamespace(main_dune_columns={"t": t, "crest_x": 0.01 + ahead, "Cx": 0 * t + 0.01, "L": 0 * t + 0.01})
    found = measured(field_cases.reversal(run, ""))
    assert found["turned_after"] == pytest.approx(0.9) if turns else np.isnan(found["turned_after"])
    assert found["static"] == (0.25 if turns else 0)


def test_kinds_that_part_along_the_current(monkeypatch):
    """A third of the surface at each end is of one kind."""
    x = np.linspace(0, 0.01, 91)
    dune = SimpleNamespace(rows=np.arange(5, 96), x=x)
    kind = np.r_[np.zeros(5, int), np.where(x > 0.0075, 0, 1)]
    monkeypatch.setattr(field_cases.shape, "main_dune", lambda *_: dune)
    monkeypatch.setattr(field_cases, "bed_of", lambda run: None)
    monkeypatch.setattr(field_cases.composition, "regions", lambda *_: {"surface": dune.rows})
    run = SimpleNamespace(frame=lambda index: SimpleNamespace(kind=kind), dune_columns={0: {}})
    assert field_cases.segregation(run, 0) == pytest.approx(0.75, abs=0.03)
    monkeypatch.setattr(field_cases.shape, "main_dune", lambda *_: None)
    assert np.isnan(field_cases.segregation(run, 0))


def test_two_dunes_that_merge_and_one_alone(tmp_path):
    pair = Pair(built.merging())
    frames = pair.frames()
    merging = RunFolder(built.write_run(tmp_path / "pair", frames, pair.bed))
    found = measured(field_cases.meeting(merging, "encounters-a"))
    assert found["class"] == "merging" and found["t_contact"] == pytest.approx(3.0, abs=0.5)
    assert found["downstream lost"] == pytest.approx(0, abs=0.02)
    for frame in frames:
        frame.dune[frame.dune > 0] = -1
    alone = RunFolder(built.write_run(tmp_path / "alone", frames[:4], pair.bed))
    found = measured(field_cases.meeting(alone, "encounters-a"))
    assert found.pop("class") == "none" and len(found) == 6 and np.all(np.isnan(list(found.values())))


def test_saved_outcomes_are_counted_and_averaged(tmp_path):
    (tmp_path / "field_cases.csv").write_text(
        "# title: x\ncase,realisation,t,quantity,value\n"
        "encounters-a,1,,class,merging\nencounters-a,2,,class,chasing\nencounters-a,3,,class,merging\n"
        "encounters-a,1,,offset,0\nencounters-a,2,,offset,1e-3\nencounters-a,3,,offset,0\n"
        "encounters-a,1,,upstream_over_downstream,0.3\nencounters-a,2,,upstream_over_downstream,0.3\n"
        "encounters-a,3,,upstream_over_downstream,0.3\n"
        "encounters-b,1,,class,none\nencounters-b,1,,offset,nan\nencounters-b,1,,upstream_over_downstream,nan\n"
        "reversal,1,,reversal_time,2\nreversal,2,,reversal_time,4\nreversal,3,,reversal_time,nan\n"
        "two-ridges,1,0.5,distance,0.013\ntwo-ridges,1,1,distance,0.014\n")
    lines = list(field_cases.summary(tmp_path))
    assert "encounters-a: 2 x merging, 1 x chasing" in lines
    assert "reversal: reversal_time 3 +- 1.4 (2 runs, not known in 1)" in lines
    assert field_cases.read(tmp_path)[1]["two-ridges"]["distance"]["1"] == [(0.5, 0.013), (1.0, 0.014)]
    encounters, *_, ridges, _ = field_cases.draw(tmp_path).axes
    assert [text.get_text() for text in encounters.get_legend().get_texts()] == ["merging", "chasing"]
    assert len(ridges.lines) == 1


def test_runs_are_drawn_at_three_times_to_one_scale(monkeypatch):
    """A row for each case that has finished; all views of a row show the same place, uncropped in one direction."""
    run = RunFolder(fake())
    times = run.grain_file.times
    monkeypatch.setattr(field_views, "TIMES", {"a": (times[0], times[1], times[-1]), "b": (0, 0, 0), "c": (0, 0, 0)})
    cases = [SimpleNamespace(name=name, run=found) for name, found in (("a", run), ("b", None), ("d", run))]
    views = field_views.draw(SimpleNamespace(cases=cases)).axes
    assert len(views) == 3 and len({view.get_xlim() + view.get_ylim() for view in views}) == 1
    assert [view.texts[0].get_text() for view in views] == [f"{t:.3g} s" for t in (times[0], times[1], times[-1])]
    box, (x0, x1, z1, z0) = views[0].get_position(), views[0].get_xlim() + views[0].get_ylim()
    figure = views[0].figure
    shown = box.height * figure.get_figheight() / (box.width * figure.get_figwidth())
    assert shown == pytest.approx((z1 - z0) / (x1 - x0), rel=1e-6)
    with pytest.raises(MissingData, match="needs a finished run"):
        field_views.draw(SimpleNamespace(cases=cases[1:]))
