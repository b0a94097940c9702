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


def of_files(folder, of, more=""):
    (folder / "case.toml").write_text("[time]\nend = 1.0\n")
    (folder / "deep").mkdir(exist_ok=True)
    (folder / "deep" / "other.toml").write_text("[time]\nend = 2.0\n")
    (folder / "deep" / "sizes.toml").write_text('ensemble.realisations = 2\n[study]\nbase = "../case.toml"\n[set]\n'
                                                "time.end = 5.0\n[cases]\nsmall.grains.skin = 1e-5\nlarge = {}\n")
    (folder / "odd.toml").write_text("study = 3\n")
    (folder / "all.toml").write_text(f"{more}\n[study]\nof = {of}\n")
    return read_study(folder / "all.toml", OPTIONS)


def test_a_study_of_other_files_has_their_cases(tmp_path):
    """A case as often as the study says; of another study what that one says, named after it."""
    study = of_files(tmp_path, '["deep/other.toml", "case.toml", "deep/sizes.toml"]',
                     "ensemble.realisations = 3\nset.output.dune_interval = 1.0")
    base, sizes, common = tmp_path / "case.toml", {"time.end": 5.0}, {"output.dune_interval": 1.0}
    firsts = [("other", tmp_path / "deep/other.toml", common), ("case", base, common),
              ("sizes-small", base, {**sizes, "grains.skin": 1e-5, **common}),
              ("sizes-large", base, {**sizes, **common})]
    assert [(case.name, case.base, case.values) for case in study.cases if case.realisation == 1] == firsts
    assert [case.run_name for case in study.cases[len(firsts):]] == [
        "other-r2", "case-r2", "sizes-small-r2", "sizes-large-r2", "other-r3", "case-r3"]
    assert study.realisations == 3


def test_a_study_of_other_files_may_have_cases_of_its_own(tmp_path):
    study = of_files(tmp_path, '["deep/other.toml"]\nbase = "case.toml"', "[cases]\nslow.time.end = 9.0")
    assert [(case.name, case.values) for case in study.cases] == [("slow", {"time.end": 9.0}), ("other", {})]


def test_some_cases_of_other_files_are_repeated(tmp_path):
    study = of_files(tmp_path, '["deep/other.toml", "case.toml"]', 'ensemble = { realisations = 2, cases = ["case"] }')
    assert [case.run_name for case in study.cases] == ["other", "case", "case-r2"]


@pytest.mark.parametrize("of, more, said", [
    ('["odd.toml"]', "", r"odd.toml: study must be a section, \[study\]"),
    ('["case.toml"]\nbase = "gone.toml"', "", "cannot read .*gone.toml"),
    ('["case.toml"]', 'ensemble.cases = ["cse"]', r'unknown name "cse" \(did you mean "case"'),
    ('["no.toml"]', "", "cannot read .*no.toml: No such file"),
    ('"case.toml"', "", r"\[study\] of must be a list of files, cases or studies"),
    ("[3]", "", r"\[study\] of must be a list of files"),
    ("[]", "", r"\[study\] base must name the case"),
    ('["case.toml"]', "[cases]\na = {}", r"\[study\] base must name the case"),
    ('["all.toml"]', "", 'all.toml has an "of" itself; name its files here'),
    ('["case.toml", "case.toml"]', "", 'two cases are named "case"'),
])
def test_a_study_of_other_files_says_what_is_wrong(tmp_path, of, more, said):
    with pytest.raises(StudyError, match=said):
        of_files(tmp_path, of, more)
