"""The table of bed load: what is measured of a run, and the fits, on numbers whose answer is known."""

import math

import numpy as np
import pytest
from made_up_beds import SCALE, MadeUpRun
from validation import bed_load, tables


def test_a_run_is_measured():
    row = dict(zip(bed_load.COLUMNS.split(","), bed_load.measure(MadeUpRun)))
    stress = 20 * (0.0137 - 1000 * math.pi / 6 * 8e-12 / (0.58 * 0.016 * 0.006))
    known = {"seconds": 6, "stress": stress, "shields": stress / (1500 * 9.81 * 2e-4), "flux": 2e-7,
             "q_star": 2e-7 / SCALE, "grain_reynolds": math.sqrt(stress / 1000) * 2e-4 / 1e-6,
             "q_star_deviation": 1e-7 / SCALE}
    for name, expected in known.items():
        assert row[name] == pytest.approx(expected, rel=5e-3), name
    assert (row["realisation"], row["mean_velocity"], row["rolling_friction"]) == (2, 0.3, 0.1)


def test_wong_and_parker_comes_back():
    """Points at rest do not count; scatter gives an error that holds the truth."""
    shields = np.repeat([0.03, 0.08, 0.12, 0.16, 0.2], 3)
    exact = bed_load.wong_parker(shields)
    assert bed_load.fit(shields, exact) == pytest.approx((3.97, 0.0495), rel=1e-9)
    scattered = exact * np.exp(0.2 * np.random.default_rng(3).standard_normal(shields.size))
    (slope, begin), (slope_error, begin_error) = bed_load.fit_with_errors(shields, scattered)
    assert 0 < slope_error < slope and 0 < begin_error < 0.02
    assert abs(slope - 3.97) <= 3 * slope_error and abs(begin - 0.0495) <= 3 * begin_error
    assert math.isnan(bed_load.fit(shields, 0 * shields)[0]), "a bed at rest has a slope"


def test_published_laws_at_one_point():
    """By hand: T = 0.1/0.04874 - 1 for van Rijn."""
    expected = 0.053 * (0.1 / 0.04874 - 1)**2.1 / 4.9**0.3
    assert float(bed_load.van_rijn(0.1)) == pytest.approx(expected, rel=1e-3)
    assert float(bed_load.wong_parker(0.0995)) == pytest.approx(3.97 * 0.05**1.5, rel=1e-12, abs=0)


ROWS = [f"{friction},3e-4,{0.2 + s},{n + 1},10,0,{s},3,0,{float(bed_load.wong_parker(s)) * (1 + 0.1 * n)},0"
        for friction in (0.1, 0) for s in (0.03, 0.08, 0.12, 0.2) for n in range(3)]


def test_the_figure_says_the_threshold(tmp_path):
    """And a study that has one run is drawn as well."""
    for lines in ROWS[:1], ROWS:
        tables.write(tmp_path / "bed_load.csv", {"title": "made up"}, [bed_load.COLUMNS, *lines])
        labels = bed_load.draw(tmp_path).axes[0].get_legend_handles_labels()[1]
    assert any(label.startswith("$\\mu_r$ = 0.1, threshold 0.0") for label in labels)


def test_a_table_grows_from_several_machines(tmp_path):
    """A run done again replaces its row, the others stay, the notes name all."""
    path = tmp_path / "bed_load.csv"
    tables.write(path, {"title": "t", "commit": "aaa", "machine": "one", "date": "d"}, [bed_load.COLUMNS, *ROWS[:5]])
    again = ROWS[4].replace(",10,", ",11,")
    said, merged = bed_load.with_earlier(path, {"commit": "bbb", "machine": "one", "date": "e"}, [again, ROWS[5]])
    assert said == {"commit": "aaa and bbb", "machine": "one", "date": "d and e"}
    assert [row.split(",")[4] for row in merged] == ["10", "10", "10", "10", "11", "10"]
