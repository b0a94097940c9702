"""Laws over the size of a dune, and the table of means: studies whose laws are known, exact and with scatter."""

import json

import numpy as np
import pytest
from fake_runs import ROOT

from barchan import MissingData, Study, plot, stats
from barchan.dune import fits, laws
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


def write_run(folder, length, scatter=lambda: 1.0, velocity=0.28):
    """c = 2e-5/L at 0.28 m/s, and as the cube of the velocity; W = 2 mm + 0.9 L, H = 0.3 mm + 0.08 L, a loss of
    1e-6/L^2 a second; horns of 0.3 L from t = 200 L. u_star is a twentieth of the velocity, a number or [x, z]."""
    t, speed = np.arange(121) / 10, np.hypot(*np.append(velocity, 0.0)[:2])
    c, w, h, loss = (scatter() * value for value in (2e-5 / length * (speed / 0.28)**3, 2e-3 + 0.9 * length,
                                                     3e-4 + 0.08 * length, 1e-6 / length**2))
    n = 3e4 * np.exp(-loss * t)
    horns = np.where(t >= 200 * length - 1e-9, 0.3 * length, 0)
    columns = [t, 0 * t, n, w + 0 * t, length + 0 * t, h + 0 * t, 0.01 + c * t, 0 * t, horns, horns, c + 0 * t,
               n * np.pi / 6 * D**3, horns, horns]
    folder.mkdir()
    np.savetxt(folder / "dune.csv", np.transpose(columns), delimiter=",", header=COLUMNS, comments="", fmt="%.12g")
    (folder / "run.json").write_text('{"status": "done"}')
    (folder / "config.toml").write_text(f"[fluid]\nmean_velocity = {velocity}\n")
    (folder / "history.csv").write_text("t,u_star\n" + "".join(f"{time},{0.05 * speed}\n" for time in t))


def write_study(folder, noise):
    """Three realisations of four sizes."""
    random, cases = np.random.default_rng(11), []
    for name, length in SIZES.items():
        for r in (1, 2, 3):
            run = name if r == 1 else f"{name}-r{r}"
            write_run(folder / run, length, lambda: float(np.exp(noise * random.standard_normal())))
            cases.append({"name": run, "case": name, "folder": run, "realisation": r, "varied": None, "values": {}})
    return study_of(folder, cases)


def study_of(folder, cases):
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
    law, n = laws.RELATIONS[name].fit(table), KNOWN[name]
    exact = 0.06 if name in ("loss", "formation_time") else 1e-6
    assert law.n == pytest.approx(n, abs=exact + (2 * law.interval if noise else 0))
    if noise and name in ("celerity", "W", "H", "loss"):
        assert 0.005 * abs(n) < law.interval < abs(n)


@pytest.mark.parametrize("noise", [0], ids=["exact"], indirect=True)
def test_the_laws_pass_through_the_values(table, noise):
    assert laws.RELATIONS["celerity"].fit(table)(0.02) == pytest.approx(1e-3, abs=1e-9)
    height = laws.RELATIONS["H"].fit(table)
    assert height(0.02) == pytest.approx(1.9e-3, abs=1e-9)
    assert height.a == pytest.approx(3e-4, abs=1e-9)
    lengths = np.array(list(SIZES.values()))
    assert max(abs(table["formation_time"][::3] - 200 * lengths)) <= 0.11


def test_the_figure_has_a_line_for_each_run(study, tmp_path):
    figure = laws_figure.draw(study)
    numbers = figure.numbers["laws"]
    assert list(numbers)[:7] == ["case", "realisation", "grains", "L", "W", "H", "celerity"]
    assert {len(column) for column in numbers.values()} == {12}
    assert figure.sentences[0].startswith("celerity ~ L^n, n = -1")
    assert figure.sentences[0].endswith("; published -1 (Hersen 2005): within")
    assert any("cases that differ in fluid.mean_velocity" in said for said in figure.sentences)
    assert figure.numbers["laws_fits"]["law"] == ["celerity", "celerity_by_height", *list(KNOWN)[1:]]
    figure.savefig(tmp_path / "laws.png")


@pytest.fixture(scope="module")
def sweep(tmp_path_factory):
    """Sizes and velocities: the faster ones of larger dunes, which also get longer. One flow of 0.35 m/s is oblique."""
    folder, cases = tmp_path_factory.mktemp("sweep"), []
    for velocity, names in ((0.22, ("3k", "10k")), ([0.28, 0.21], ("3k", "10k")), (0.35, ("30k",)),
                            (0.45, ("10k", "30k", "100k"))):
        for name in names:
            speed = np.hypot(*np.append(velocity, 0)[:2])
            run = f"{name}-{np.round(speed, 9):g}"
            write_run(folder / run, SIZES[name] * (speed / 0.35)**0.5, velocity=velocity)
            values = {"fluid.mean_velocity": velocity, "initial.fluid": f"channel-{velocity}.toml", "heap": name}
            cases.append({"name": run, "case": run, "folder": run, "values": values})
    return study_of(folder, cases)


def test_a_sweep_of_velocities(sweep):
    """The cube of u_*, and at the same time the inverse of L, which no common line through all runs would have."""
    table = laws.measure(sweep)
    assert sorted(set(table["mean_velocity"])) == pytest.approx([0.22, 0.35, 0.45], abs=1e-12)
    found = {name: laws.RELATIONS[name].fit(table) for name in ("celerity", "celerity_by_flow", "W")}
    assert found["celerity"].n == pytest.approx(-1, abs=1e-6)
    assert found["celerity_by_flow"].n == pytest.approx(3, abs=1e-6)
    assert found["W"].n == pytest.approx(0.9, abs=1e-6)
    assert abs(fits.fit(table["L"], table["celerity"], "power").n + 1) > 0.2


def test_the_figure_of_a_sweep(sweep, tmp_path):
    """A line for each velocity; and it says that no case was repeated."""
    figure = laws_figure.draw(sweep)
    assert "celerity L ~ u_star^n, n = 3 " in figure.sentences[2]
    assert figure.sentences[2].endswith("published 3 (Hersen 2005): within")
    assert "do not know the spread of any case: one realisation each" in figure.sentences[-1]
    dashed = [line for line in figure.axes[0].lines if line.get_linestyle() == "--"]
    assert len(dashed) == 3
    figure.savefig(tmp_path / "laws.png")


def law_of(n, error, relation):
    return laws.verdict(fits.Law(relation.kind, n, error, 2.2 * error, 12, 12, np.zeros((1, 2)), 0.0), relation)


def test_the_verdicts():
    celerity, height = laws.RELATIONS["celerity"], laws.RELATIONS["celerity_by_height"]
    assert law_of(-1.1, 0.05, celerity) == "within"
    assert law_of(-1.2, 0.05, celerity) == "below by 4 standard errors"
    assert law_of(-0.8, 0.05, celerity) == "above by 4 standard errors"
    assert law_of(-0.7, 0.05, height) == "within"
    assert law_of(-0.35, 0.05, height) == "above by 3 standard errors"
    assert law_of(-0.9, 1.0, celerity) == "within, but so is 0: too few runs, or too much alike"
    assert law_of(-2.0, 0.0, celerity) == "below by over 100 standard errors"
    assert law_of(0.3, 0.01, laws.RELATIONS["horn"]) == ""


def test_what_is_published_stands_in_the_documents():
    """Each law with its exponent and source in docs/studies.md, each source in the bibliography."""
    rows = [line for line in (ROOT / "docs/studies.md").read_text().splitlines() if line.startswith("| `")]
    sources = (ROOT / "docs/glossary.md").read_text()
    for name, relation in laws.RELATIONS.items():
        row, = (line for line in rows if line.startswith(f"| `{name}` |"))
        said = "none" if relation.published is None else \
            " to ".join(f"{n:g}" for n in dict.fromkeys(relation.published)) + f" ({relation.source})"
        assert f"| {said} |" in row, name
        for year in relation.source.split()[-1:]:
            names = relation.source.replace(" et al.", "").rsplit(" ", 1)[0]
            assert any(names in line and f"({year})" in line for line in joined(sources)), relation.source


def joined(text):
    """The entries of a list, each as one line."""
    return " ".join(text.splitlines()).split(" - ")


def test_one_realisation_is_said(tmp_path):
    for name in ("3k", "10k", "30k"):
        write_run(tmp_path / name, SIZES[name])
    write_run(tmp_path / "3k-r2", SIZES["3k"])
    cases = [{"name": name, "case": name, "folder": name, "values": {}} for name in ("3k", "10k", "30k")]
    study = study_of(tmp_path, [*cases, {"name": "3k-r2", "case": "3k", "folder": "3k-r2", "realisation": 2}])
    said = laws_figure.draw(study).sentences[-1]
    assert said.startswith("errors do not know the spread of 10k, 30k: one realisation each")


def test_two_runs_make_no_law(tmp_path):
    """The figure has their points, and the words say why there is no more."""
    for name in ("3k", "10k"):
        write_run(tmp_path / name, SIZES[name])
    cases = [{"name": name, "folder": name, "values": {}} for name in ("3k", "10k")]
    figure = laws_figure.draw(study_of(tmp_path, cases))
    assert figure.sentences[0] == "celerity ~ L^n: too few runs to fit, or cases alike in L"
    assert len(figure.numbers["laws"]["L"]) == 2
    assert figure.numbers["laws_fits"]["law"] == []
    figure.savefig(tmp_path / "laws.png")


def test_one_case_is_refused(tmp_path):
    write_run(tmp_path / "3k", SIZES["3k"])
    study = study_of(tmp_path, [{"name": "3k", "folder": "3k", "values": {}}])
    with pytest.raises(MissingData, match='needs two cases with dunes .* in other flows, .*: only "3k" has one'):
        laws_figure.draw(study)


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


def test_cases_of_two_files_are_of_two_sizes(tmp_path):
    """Their values are alike; c L follows the flow in each, and the a of both differ by a factor of 8."""
    cases = []
    for base, factor in (("a.toml", 1), ("b.toml", 8)):
        for velocity in (0.2, 0.28, 0.4):
            name = f"{base[0]}{velocity}"
            write_run(tmp_path / name, 8e-3 * factor, velocity=velocity)
            cases.append({"name": name, "case": name, "folder": name, "realisation": 1, "varied": None,
                          "base": base, "values": {"fluid.mean_velocity": velocity}})
    table = laws.measure(study_of(tmp_path, cases))
    assert len(set(table["size"])) == 2


def test_a_part_of_a_study_is_drawn(tmp_path, capsys):
    folder = tmp_path / "study"
    folder.mkdir()
    write_study(folder, 0.0)
    assert plot.main([str(folder), "laws", "--only", "3k", "--only", "10*"]) == 0
    rows = (folder / "figures_data/laws.csv").read_text().splitlines()[1:]
    assert {row.split(",")[0] for row in rows} == {"3k", "10k", "100k"}
    assert [case.name for case in Study(folder, only="3k").cases] == ["3k"]
    capsys.readouterr()
    assert plot.main([str(folder), "laws", "--only", "5k"]) == 2
    assert 'no case "5k"' in capsys.readouterr().err
    assert plot.main([str(folder / "3k"), "--only", "3k"]) == 2
    assert "--only chooses cases of a study" in capsys.readouterr().err
