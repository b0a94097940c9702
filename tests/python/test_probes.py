"""Probes of a run: their table and their figure."""

import json

import numpy as np
import pytest
from fake_runs import fake

import barchan
from barchan.figures.probes import means_along

CASE = """
[output]
[[output.probe]]
name = "wake"
at = [0.06, 0.004, 0.02]
[[output.probe]]
name = "profile"
from = [0.03, 0.0, 0.02]
to = [0.03, 0.02, 0.02]
points = 5
[[output.probe]]
name = "along"
from = [0.0, 0.01, 0.0]
to = [0.03, 0.01, 0.04]
points = 3
"""
HEIGHTS = np.linspace(0.0, 0.02, 5)


@pytest.fixture
def run(tmp_path):
    """u = 3 t at the point, 10 y (1 + noise of -0.1 and 0.1 in turn) on the upright line, 0.2 on the other."""
    (tmp_path / "config.toml").write_text((fake() / "config.toml").read_text() + CASE)
    rows = []
    for step, t in enumerate(np.linspace(0.0, 2.0, 21)):
        rows.append([t, 0, 0, 0.06, 0.004, 0.02, 3 * t, 0.1, -0.2, 5.0, 0.01, 0.0])
        sign = 1.1 if step % 2 else 0.9
        rows += [[t, 1, n, 0.03, y, 0.02, 10 * y * sign, 0, 0, -y, 0.02, 0.0] for n, y in enumerate(HEIGHTS)]
        rows += [[t, 2, n, 0.015 * n, 0.01, 0.02 * n, 0.2, 0, 0, 1.0, 0.03, 0.0] for n in range(3)]
    header = json.loads((fake() / "columns.json").read_text())["probes.csv"]
    lines = [",".join(header)] + [",".join(f"{value:.9g}" for value in row) for row in rows]
    (tmp_path / "probes.csv").write_text("\n".join(lines) + "\n")
    (tmp_path / "columns.json").write_text((fake() / "columns.json").read_text())
    return barchan.open(tmp_path)


def test_the_table_has_names_and_units(run):
    table = run.probes
    assert table.index.names == ["probe", "point", "t"]
    assert list(table.index.levels[0]) == ["along", "profile", "wake"]
    assert table.loc["wake", 0].u.loc[2.0] == pytest.approx(6.0)
    assert table.loc["profile", 4].y.iloc[0] == 0.02 and len(table.loc["profile"]) == 5 * 21
    assert table.attrs["units"]["wall_shear_x"] == "Pa" and table.attrs["units"]["u"] == "m s-1"


def test_a_probe_without_a_name_is_numbered(run):
    (run.path / "config.toml").write_text("[output]\n")
    assert list(barchan.open(run.path).probe_columns) == ["probe 0", "probe 1", "probe 2"]


def test_means_along_a_line(run):
    means = means_along(run.probe_columns["profile"], start=0.1)  # as many of one sign as of the other
    assert means["u"] == pytest.approx(10 * HEIGHTS)
    assert means["u_deviation"] == pytest.approx(HEIGHTS)
    assert means["s"] == pytest.approx(HEIGHTS)
    assert means_along(run.probe_columns["along"])["s"] == pytest.approx([0.0, 0.025, 0.05])
    assert means_along(run.probe_columns["profile"], start=0.05, end=0.15)["u"] == pytest.approx(11 * HEIGHTS)
    with pytest.raises(barchan.MissingData, match="t = 0 to 2 s"):
        means_along(run.probe_columns["along"], start=3.0)


def test_the_figure_has_a_row_for_each_and_its_numbers(run):
    figure = run.figure("probes")
    shown = [axes for axes in figure.axes if axes.get_visible()]
    assert len(shown) == 8 and [axes.get_title() for axes in figure.axes[1::3]] == ["wake", "profile", "along"]
    velocity, _, shear = figure.axes[:3]
    assert velocity.get_lines()[0].get_ydata()[-1] == pytest.approx(6.0) and velocity.get_xlabel() == "$t$ (s)"
    assert "Pa" in shear.get_ylabel()
    upright = figure.axes[3].get_lines()[0]
    assert upright.get_ydata() == pytest.approx(1e3 * HEIGHTS)
    assert figure.axes[6].get_lines()[0].get_xdata() == pytest.approx([0.0, 25.0, 50.0])
    numbers = figure.numbers["probes"]
    assert len(numbers["t"]) == 21 + 5 + 3 and list(numbers["probe"]).count(1) == 5


def test_a_run_without_probes_says_so():
    for ask in (lambda run: run.probes, lambda run: run.figure("probes")):
        with pytest.raises(barchan.MissingData, match=r"needs probes.csv .*\[\[output.probe\]\]"):
            ask(barchan.open(fake()))
