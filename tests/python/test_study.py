"""barchan.Study: its runs by name, and one table of all."""

import numpy as np
import pytest
from fake_runs import fake

import barchan


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
