"""Laws over the size of a dune, and the table of means: studies whose laws are known, exact and with scatter."""

import json

import numpy as np
import pytest

from barchan import MissingData, Study, stats
from barchan.dune import laws
from barchan.figures import laws as laws_figure
from barchan.figures import means

def test_student_t_is_that_of_the_closed_forms_and_of_scipy():
    p = 0.975
    assert stats.student_t(p, 1) == pytest.approx(np.tan(np.pi * (p - 0.5)), rel=1e-12)
    assert stats.student_t(p, 2) == pytest.approx((2 * p - 1) / np.sqrt(2 * p * (1 - p)), rel=1e-12)
    scipy = pytest.importorskip("scipy.stats")
    for freedom in (3, 7, 30, 400):
        assert scipy.t.cdf(stats.student_t(p, freedom), freedom) == pytest.approx(p, rel=1e-12)


SIZES = {"3k": 8e-3, "10k": 12e-3, "30k": 18e-3, "100k": 27e-3}  # L [m]
D = 2e-4
COLUMNS = "t,dune,n_grains,W,L,H,Cx,Cz,horn_left,horn_right,celerity,volume,horn_left_2d,horn_right_2d"
KNOWN = {"celerity": -1, "W": 0.9, "H": 0.08, "horn": 0.3, "loss": -2, "formation_time": 1}


def write_run(folder, length, scatter):
    """c = 2e-5/L, W = 2 mm + 0.9 L, H = 0.3 mm + 0.08 L, a loss of 1e-6/L^2 a second; horns of 0.3 L from t = 200 L."""
    t = np.arange(121) / 10
    c, w, h, loss = (scatter() * value for value in (2e-5 / length, 2e-3 + 0.9 * length, 3e-4 + 0.08 * length,
                                                     1e-6 / length**2))
    n = 3e4 * np.exp(-loss * t)
    horns = np.where(t >= 200 * length - 1e-9, 0.3 * length, 0)
    columns = [t, 0 * t, n, w + 0 * t, length + 0 * t, h + 0 * t, 0.01 + c * t, 0 * t, horns, horns, c + 0 * t,
               n * np.pi / 6 * D**3, horns, horns]
    folder.mkdir()
    np.savetxt(folder / "dune.csv", np.transpose(columns), delimiter=",", header=COLUMNS, comments="", fmt="%.12g")
    (folder / "run.json").write_text('{"status": "done"}')


def write_study(folder, noise):
    """Three realisations of four sizes."""
    random, cases = np.random.default_rng(11), []
    for name, length in SIZES.items():
        for r in (1, 2, 3):
            run = name if r == 1 else f"{name}-r{r}"
            write_run(folder / run, length, lambda: float(np.exp(noise * random.standard_normal())))
            cases.append({"name": run, "case": name, "folder": run, "realisation": r, "varied": None, "values": {}})
    (folder / "study.json").write_text(json.dumps({"title": "sizes", "cases": cases}))
    return Study(folder)


@pytest.fixture(scope="module", params=[0, 0.1], ids=["exact", "scattered"])
def noise(request):
    return request.param


@pytest.fixture(scope="module")
def study(noise, tmp_path_factory):
    return write_study(tmp_path_factory.mktemp("study"), noise)


@pytest.fixture(scope="module")
def table(study):
    return laws.measure(study)


def test_every_run_is_a_point(table):
    assert len(table["L"]) == 12
    assert sorted(set(table["realisation"])) == [1, 2, 3]


@pytest.mark.parametrize("name", KNOWN)
def test_the_exponents_come_back(table, noise, name):
    """A decay is a straight line over six seconds to 1 % of its slope, horns appear at a time of the table."""
    law, n = laws.fit(table["L"], table[name], laws.KINDS[name]), KNOWN[name]
    exact = 0.06 if name in ("loss", "formation_time") else 1e-6
    assert law.n == pytest.approx(n, abs=exact + (2 * law.interval if noise else 0))
    if noise and name in ("celerity", "W", "H", "loss"):
        assert 0.005 * abs(n) < law.interval < abs(n)


@pytest.mark.parametrize("noise", [0], ids=["exact"], indirect=True)
def test_the_laws_pass_through_the_values(table, noise):
    assert laws.fit(table["L"], table["celerity"], "power")(0.02) == pytest.approx(1e-3, abs=1e-9)
    assert laws.fit(table["L"], table["H"], "line")(0.02) == pytest.approx(1.9e-3, abs=1e-9)
    lengths = np.array(list(SIZES.values()))
    assert max(abs(table["formation_time"][::3] - 200 * lengths)) <= 0.11


def test_the_figure_has_a_line_for_each_run(study):
    figure = laws_figure.draw(study)
    numbers = figure.numbers["laws"]
    assert list(numbers)[:7] == ["case", "realisation", "grains", "L", "W", "H", "celerity"]
    assert {len(column) for column in numbers.values()} == {12}
    assert figure.sentences[0].startswith("celerity ~ L^n, n = ")


def test_the_means_in_words(study, noise):
    told = means.draw(study)
    table = dict(line.strip("| ").split(" | ", 1) for line in told.sentences if " | " in line)
    assert table["mean +- standard deviation"] == "3k (3) | 10k (3) | 30k (3) | 100k (3)"
    if noise:
        assert table["W (mm)"].count(" +- ") == 4
    else:
        assert table["W (mm)"] == "9.2 | 12.8 | 18.2 | 26.3"


def test_a_window_without_times(study):
    assert len(laws.measure(study, 11.85)["case"]) == 0, "a window of two times counts"
    with pytest.raises(MissingData, match="needs two cases with dunes"):
        laws_figure.draw(study, start=100)


def test_one_length_makes_no_law():
    assert laws.fit(np.array([1e-2, 1e-2, 1e-2]), np.array([1.0, 2.0, 3.0]), "line") is None
