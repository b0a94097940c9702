"""The table of the threshold of motion: windows of a run, where the load goes to zero, and a table with both."""

import json
import math
import types

import numpy as np
import pytest
from made_up_beds import RisingRun
from validation import bed_load, tables, threshold


@pytest.fixture(scope="module")
def rising():
    return dict(zip(threshold.COLUMNS.split(","), np.array(threshold.measure(RisingRun)).T))


def test_windows_of_a_run(rising):
    assert rising["shields"][2] == pytest.approx(0.5 / (1500 * 9.81 * 2e-4), rel=1e-6)  # the fifth window
    assert rising["q_star"][2] == pytest.approx(1e-3, rel=1e-6)
    assert rising["load"] == pytest.approx(np.full(len(rising["load"]), 0.1 * RisingRun.solid / 2e-4), rel=1e-6)
    assert [rising[name][0] for name in threshold.CASE] == [0.1, 2, 0]
    assert rising["realisation"][0] == 2


def test_half_way_between_two_windows(rising):
    expected = 0.55 / (1500 * 9.81 * 2e-4)
    assert threshold.passing(10**-2.5)(tables.Table({}, rising)) == pytest.approx(expected, rel=1e-6)


def rows_of(begin, number, *, case="0,5,0", scatter=0.0, top=0.2):
    """A run whose load and flux begin at a known Shields number: windows at rest, then M = (s - begin)/2."""
    s = np.linspace(0.05, top, 16)
    noise = 1 + scatter * np.random.default_rng(number).standard_normal(s.size)
    excess = np.maximum(0, s - begin)
    return [f"{case},{number},{0.5 + 0.25 * n},{s[n]},{2 * excess[n]**1.5 * noise[n]},{0.5 * excess[n] * noise[n]}"
            for n in range(s.size)]


def found_in(folder, *runs):
    tables.write(folder / "threshold.csv", {"title": "made up"}, [threshold.COLUMNS, *sum(runs, [])])
    cases = threshold.cases_of(tables.read_saved(folder, "threshold"))
    return [{kind: threshold.with_error(case.rows, found) for kind, found in threshold.FOUND.items()} for case in cases]


@pytest.mark.parametrize("begin", [0.0653, 0.1217])
def test_both_lines_give_the_truth(tmp_path, begin):
    """Without scatter, to the step of 1e-4 in which it is sought; one run has no error."""
    single, = found_in(tmp_path, rows_of(begin, 1))
    for kind in ("load", "flux"):
        assert single[kind][0] == pytest.approx(begin, rel=1.1e-4 / begin)
        assert math.isnan(single[kind][1])


def test_a_threshold_is_no_level(tmp_path):
    """Where the flux begins at 0.1217, q* = 0.01 comes (0.005)^(2/3) later."""
    found_in(tmp_path, rows_of(0.1217, 1))
    levels = threshold.passing(1e-2)(tables.read_saved(tmp_path, "threshold"))
    assert 0.1217 + 0.01 < levels < 0.1217 + 0.05


def test_a_bent_load_does_not_count(tmp_path):
    """Windows above q* = 0.1, where the load bends upwards."""
    bent = [f"0,5,0,1,9,{s},{2 * (s - 0.1)**1.5},{4 * (s - 0.1)}" for s in (0.3, 0.35)]
    assert found_in(tmp_path, rows_of(0.1, 1) + bent)[0]["load"][0] == pytest.approx(0.1, rel=2e-3)


def test_scatter_gives_an_error_that_holds_the_truth(tmp_path):
    """A fifth of scatter, four realisations: within three standard errors, and these are not wide."""
    value, error = found_in(tmp_path, *(rows_of(0.1, n, scatter=0.2) for n in (1, 2, 3, 4)))[0]["load"]
    assert 0 < error < 0.01
    assert abs(value - 0.1) < 3 * error


def test_two_realisations_that_begin_apart(tmp_path):
    """By 0.02: half of it is the error of their mean."""
    two, = found_in(tmp_path, rows_of(0.09, 1), rows_of(0.11, 2))
    assert two["load"][1] == pytest.approx(0.01, rel=0.02)


def test_a_bed_at_rest_has_no_threshold(tmp_path):
    rest, = found_in(tmp_path, rows_of(0.3, 1))
    assert all(math.isnan(value) for value, _ in rest.values())
    threshold.draw(tmp_path)


def test_rising_and_falling_runs_are_told_apart(tmp_path):
    found_in(tmp_path, rows_of(0.12, 1), rows_of(0.12, 2), rows_of(0.08, 1, case="0.1,9,1"))
    threshold.draw(tmp_path)
    lines = list(threshold.summary(tmp_path))
    assert lines[0].startswith("rising, mu_r = 0, forces of the paper | 2 | 0.120 +- 0.000 | 0.120 +- 0.000 | ")
    assert lines[1].startswith("falling, mu_r = 0.1, all forces | 1 | 0.080 | 0.080 | ")


def test_all_versions_are_named_once(tmp_path):
    runs = [types.SimpleNamespace(path=tmp_path / name) for name in ("rising", "falling", "rising-r2")]
    for run, version in zip(runs, ("aaa", "bbb", "aaa")):
        run.path.mkdir()
        (run.path / "run.json").write_text(json.dumps({"git_hash": version}))
    path = tmp_path / "threshold.csv"
    tables.write(path, {"commit": "aaa", "machine": "one", "date": "d"}, ["falling,realisation", "0,1"])
    said, _ = bed_load.with_earlier(path, {"commit": threshold.versions(runs), "machine": "one", "date": "d"}, [], 2)
    assert threshold.versions(runs) == said["commit"] == "aaa and bbb"
