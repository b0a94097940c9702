"""barchan.Study: its runs by name, and one table of all."""

import os
from types import SimpleNamespace

import numpy as np
import pytest
from fake_runs import fake

import barchan
from barchan.studies.spec import StudyError, load_case, read_study

OPTIONS = SimpleNamespace(at_once=None, threads=None, out=None)


@pytest.fixture(scope="module")
def study():
    return barchan.Study(fake("--study"))


def test_runs_by_name(study):
    for case in study.cases:
        for run in case.runs:
            assert study[run.path.name] is run
            assert isinstance(run, barchan.Run)
    with pytest.raises(KeyError, match="no run nobody"):
        study["nobody"]


def test_one_tidy_table(study):
    table = study.table()
    runs = [(case, number, run) for case in study.cases for number, run in enumerate(case.runs, 1)
            if run.dune_columns is not None]
    assert len(table) == sum(len(run.dunes) for _, _, run in runs)
    assert table.attrs["units"]["W"] == "m"
    for case, number, run in runs:
        rows = table[(table.case == case.name) & (table.realisation == number) & (table.dune == 0)]
        assert np.array_equal(rows.W, run.main_dune_columns["W"])
        for key in study.keys:
            assert set(rows[key]) == {case.values[key]}


def test_a_study_without_dunes_has_an_empty_table(tmp_path):
    (tmp_path / "study.json").write_text('{"cases": [{"name": "a", "folder": "a"}]}')
    assert len(barchan.Study(tmp_path).table()) == 0


def test_a_folder_that_is_no_study(tmp_path):
    (tmp_path / "study.json").write_text('{"cases": 3}')
    with pytest.raises(barchan.BarchanError, match="does not list its cases"):
        barchan.Study(tmp_path)


@pytest.mark.parametrize(("cores", "head", "asked", "expected"), [
    (8, "", {}, (3, 2)),                       # three cases only
    (2, "", {}, (2, 1)),
    (8, "threads = 4", {}, (2, 4)),
    (8, "at_once = 1", {}, (1, 8)),
    (8, "at_once = 1", {"at_once": 4}, (4, 2)),
    (2, "threads = 4", {}, (1, 4)),
    (8, "", {"threads": 8}, (1, 8)),
])
def test_a_study_fills_the_cores_unless_told_otherwise(tmp_path, monkeypatch, cores, head, asked, expected):
    monkeypatch.setattr(os, "sched_getaffinity", lambda _: set(range(cores)))
    (tmp_path / "case.toml").write_text("[grains]\nrestitution = 0.1\n")
    grid = "[grid]\ngrains.restitution = [0.1, 0.2, 0.3]\n"
    (tmp_path / "study.toml").write_text(f"[study]\nbase = 'case.toml'\n{head}\n{grid}")
    options = SimpleNamespace(**{"at_once": None, "threads": None, "out": None, **asked})
    study = read_study(tmp_path / "study.toml", options)
    assert (study.at_once, study.threads) == expected


def test_a_case_is_no_study(tmp_path):
    (tmp_path / "case.toml").write_text("[case]\ntitle = 'a'\n[time]\nend = 1\n")
    with pytest.raises(StudyError, match="this is a case, not a study: ./barchan run"):
        read_study(tmp_path / "case.toml", OPTIONS)


def test_values_of_the_base_case_may_stand_in_its_own_base(tmp_path):
    (tmp_path / "deep").mkdir()
    (tmp_path / "deep" / "root.toml").write_text("[grains]\nsliding_friction = 0.6\nrolling_friction = 0.1\n")
    (tmp_path / "first.toml").write_text('[case]\nbase = "deep/root.toml"\nwithout = "grains.rolling_friction"\n')
    (tmp_path / "case.toml").write_text('[case]\nbase = ["first.toml"]\n[grains]\nrestitution = 0.2\n')
    assert load_case(tmp_path / "case.toml")["grains"] == {"sliding_friction": 0.6, "restitution": 0.2}
    (tmp_path / "study.toml").write_text('[study]\nbase = "case.toml"\n[vary]\ngrains.sliding_friction = [0.6, 0.3]\n')
    study = read_study(tmp_path / "study.toml", OPTIONS)
    assert [case.name for case in study.cases] == ["base", "sliding_friction-0.3"]
    (tmp_path / "deep" / "root.toml").write_text('[case]\nbase = "../case.toml"\n')
    assert load_case(tmp_path / "case.toml")["grains"] == {"restitution": 0.2}, "a circle ends"
