"""Figures: each is a matplotlib Figure with its numbers; none writes; axes of the caller's own."""

from functools import lru_cache

import matplotlib.pyplot as plt
import numpy as np
import pytest
from fake_runs import fake
from matplotlib.figure import Figure

import barchan
from barchan.figures import registry, result, style

PANELS = {"topviews": 8, "height_map": 3, "morphology": 6, "midplane": 1, "profiles": 2, "history": 8,
          "morphodynamics": 6, "horns": 3}
OWN_PAGE = ("horn_origins", "profiles_over_dune")


@pytest.fixture(scope="module")
def run():
    return barchan.Run(fake("--average"))


@pytest.fixture(scope="module")
def drawn(run):
    """Figures of the run, each drawn once."""
    return lru_cache(run.figure)


@pytest.fixture(scope="module")
def study():
    return barchan.Study(fake("--study"))


def files(folder):
    return sorted(path.relative_to(folder) for path in folder.rglob("*"))


@pytest.mark.parametrize("name", [name for name, entry in registry.OF_RUN.items() if not entry.writes])
def test_a_figure_of_a_run(run, drawn, name):
    """It is drawn, or says which of its files the run lacks; the folder stays as it is."""
    before = files(run.path)
    try:
        figure = drawn(name)
    except barchan.MissingData as reason:
        needs = registry.of_run(name).needs
        assert any(file in str(reason) for need in needs for file in need.split("|")), reason
        return
    assert files(run.path) == before
    assert isinstance(figure, Figure | result.Told)
    assert name in PANELS or name in OWN_PAGE or isinstance(figure, result.Told)
    assert not plt.get_fignums(), "pyplot keeps the figure"


@pytest.mark.parametrize("name", PANELS)
def test_a_figure_in_axes_of_ones_own(run, drawn, name):
    """The same curves as in a new figure, and no other axes but colour bars."""
    with style.look():
        mine = Figure()
        axes = mine.subplots(1, PANELS[name], squeeze=False)[0]
    alone = drawn(name)
    assert run.figure(name, ax=axes) is mine
    for ours, theirs in zip(axes, alone.axes):
        assert len(ours.lines) == len(theirs.lines)
        for one, other in zip(ours.lines, theirs.lines):
            assert np.array_equal(one.get_ydata(), other.get_ydata(), equal_nan=True)
    if name != "topviews":  # which has as many times as it gets axes
        with pytest.raises(barchan.BarchanError, match=f"has {PANELS[name]} panels"):
            run.figure(name, ax=[axes[0]] * (PANELS[name] + 1))


@pytest.mark.parametrize("name", OWN_PAGE)
def test_a_page_takes_no_axes(run, name):
    with pytest.raises(barchan.BarchanError, match="takes no ax"):
        run.figure(name, ax=Figure().subplots())


def test_numbers_are_those_of_the_run(run, drawn):
    numbers = drawn("morphology").numbers["morphology"]
    assert numbers["W"] == run.main_dune_columns["W"].tolist()


def test_a_style_stays_with_its_figure(run):
    before = dict(plt.rcParams)
    run.figure("morphology")
    assert dict(plt.rcParams) == before


def test_numbers_are_written_as_tables(run, drawn, tmp_path):
    result.write_numbers(drawn("morphology"), tmp_path)
    lines = (tmp_path / "figures_data/morphology.csv").read_text().splitlines()
    assert lines[0].startswith("t,W,L,H,Cx,Cz,")
    assert len(lines) == 1 + len(run.main_dune_columns["t"])
    assert float(lines[-1].split(",")[1]) == pytest.approx(run.main_dune_columns["W"][-1], rel=1e-8)


def test_text_in_a_table_has_no_comma(tmp_path):
    told = result.Told([], {"t": {"key": [[1, 2.5], "a,b"], "n": [np.int64(3), np.float32(0.5)]}})
    result.write_numbers(told, tmp_path)
    assert (tmp_path / "figures_data/t.csv").read_text() == "key,n\n1 x 2.5,3\na;b,0.5\n"


@pytest.mark.parametrize("name", [name for name, entry in registry.OF_STUDY.items() if not entry.on_request])
def test_a_figure_of_a_study(study, name):
    before = files(study.path)
    assert isinstance(study.figure(name), Figure)
    assert files(study.path) == before


def test_numbers_of_the_paper_are_names(study):
    key = "grains.sliding_friction"
    assert key in study.keys
    assert study.figure("fig7").numbers.keys() == study.figure("morphology", key=key).numbers.keys()


@pytest.mark.parametrize("name", ["report", "movie"])
def test_what_is_a_file_is_no_figure(run, name):
    with pytest.raises(barchan.BarchanError, match="is a file, not a figure"):
        run.figure(name)


def test_a_figure_that_is_not_there(run, study):
    with pytest.raises(barchan.BarchanError, match='no figure "zzz" of a run; there are topviews'):
        run.figure("zzz")
    with pytest.raises(barchan.BarchanError, match='no figure "horns" of a study; there are topviews'):
        study.figure("horns")


def test_a_short_run_has_no_means_over_a_second(run, monkeypatch):
    from barchan.figures import morphodynamics

    monkeypatch.setattr(morphodynamics, "LEAST", 1e3)
    with pytest.raises(barchan.MissingData, match="followed for 1000 s or more"):
        run.figure("morphodynamics")


def test_top_views_fill_their_grid_and_colours_show_the_dune(run, drawn):
    from barchan.figures import topviews

    figure = drawn("topviews")
    views = [axes for axes in figure.axes if axes.images]
    assert len(views) in topviews.FULL_GRIDS and all(axes.get_visible() for axes in figure.axes)
    frames = topviews.frames_at(run, tuple(topviews.FULL_GRIDS))
    later = max(np.percentile(g.x[:, 1] + 0.5 * g.d, topviews.HEIGHT_PERCENTILE) for g in frames[1:])
    bar = next(axes for axes in figure.axes if hasattr(axes, "_colorbar"))
    assert bar._colorbar.vmax == pytest.approx(1e3 * later)
    highest = max((g.x[:, 1] + 0.5 * g.d).max() for g in frames)
    assert (bar._colorbar.extend == "max") == (highest > later)


def test_colours_of_the_flow_are_those_of_what_is_seen(drawn):
    figure = drawn("midplane")
    image = figure.axes[0].collections[0]
    assert image.norm.vmax < np.nanmax(image.get_array())  # the flow is faster above the dune, out of sight


def test_curves_that_do_not_vary_are_left_out():
    from barchan.stats import varies

    steps = np.arange(100.0)
    columns = {"rate": np.full(100, 0.25), "started": np.where(steps == 0, 9.0, 2.0), "varies": 1 + 1e-2 * steps}
    assert [name for name in columns if varies(columns[name])] == ["varies"]
