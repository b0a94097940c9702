"""Names that users give are shown as they are: no dollar in them begins a formula of a figure."""

import json
import re
import shutil

import h5py
import pytest
from fake_runs import fake
from matplotlib.text import Text

import barchan
from barchan.figures import registry, result, scour

# Two dollars make a formula, which mathtext cannot read or reads; a legend leaves out what begins with _.
HOSTILE = "_N$d_{$"
TITLE = "cost $5_{ and 10$"


def spoiled(folder):
    """Names of bodies, heaps and kinds, and the title; the kinds are every second grain."""
    text = (folder / "config.toml").read_text()
    text = re.sub(r'name = "(\w+)"', lambda match: f'name = "{HOSTILE}{match[1]}"', text)
    (folder / "config.toml").write_text(text.replace("synthetic barchan", TITLE))
    with h5py.File(folder / "grains.h5", "r+") as file:
        for name, frame in file.items():
            if name.startswith("frame_"):
                frame["heap"].attrs["names"] = f"{HOSTILE}1\n{HOSTILE}2\n"
                frame["kind"] = frame["id"][:] % 2
                frame["kind"].attrs["names"] = f"{HOSTILE}a\n{HOSTILE}b\n"
    return barchan.Run(folder)


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("names") / "run"
    shutil.copytree(fake("--average", "--bodies", "--heaps", "--frames", "5"), folder)
    return spoiled(folder)


@pytest.fixture(scope="module")
def heaps(tmp_path_factory):
    """The same without kinds, so that pictures show heaps."""
    folder = tmp_path_factory.mktemp("heaps") / "run"
    shutil.copytree(fake("--average", "--bodies", "--heaps", "--frames", "5"), folder)
    spoiled(folder)
    with h5py.File(folder / "grains.h5", "r+") as file:
        for name, frame in file.items():
            if name.startswith("frame_"):
                del frame["kind"]
    return barchan.Run(folder)


@pytest.fixture(scope="module")
def study(tmp_path_factory):
    folder = tmp_path_factory.mktemp("names") / "study"
    shutil.copytree(fake("--study"), folder)
    content = json.loads((folder / "study.json").read_text())
    for case in content["cases"]:
        case["name"] = HOSTILE + case["name"]
        case["values"]["x.$d_{$"] = HOSTILE
        if case["varied"] == "grains.restitution":
            case["varied"] = "x.$d_{$"
            case["values"]["x.$d_{$"] += case["name"]
    (folder / "study.json").write_text(json.dumps(content))
    return barchan.Study(folder)


def texts(figure):
    """As they stand on the page: those that are seen, no formula made of what the user wrote."""
    figure.draw_without_rendering()
    for text in figure.findobj(Text):
        said = text.get_text()
        if HOSTILE[1:] in said.replace("\\", "") or "cost" in said:
            assert not re.search(r"(?<!\\)\$(5|d)", said), f"{said!r} has a formula"
            yield said.replace("\\", "")


# How many texts with names each shows, of 2 bodies, 2 heaps or 2 kinds.
SHOWN = {"topviews": 4, "height_map": 0, "morphology": 0, "midplane": 0, "profiles": 0, "bedload": 0, "history": 0,
         "encounters": 0, "encounter_forces": 0,
         "profiles_over_dune": 1, "morphodynamics": 0, "horns": 0, "composition": 2, "horn_origins": 0, "force_map": 0,
         "sectors": 0, "forces_on_bodies": 8, "flow_around_body": 2, "obstacles": 4, "scour": 2,
         "probes": 0}


@pytest.mark.parametrize("name", [name for name, entry in registry.OF_RUN.items() if not entry.writes])
def test_figures_of_a_run(run, name, monkeypatch):
    monkeypatch.setattr(scour, "COVERED", 0.0)  # the dune serves as a bed
    try:
        figure = run.figure(name)
    except barchan.MissingData as reason:
        assert SHOWN[name] == 0, reason
        return
    assert isinstance(figure, result.Told) or len(set(texts(figure))) == SHOWN[name]


def test_heaps_of_a_figure(heaps):
    assert {f"\u200b{HOSTILE}1", f"\u200b{HOSTILE}2"} < set(texts(heaps.figure("topviews")))


@pytest.mark.filterwarnings("ignore:divide by zero")  # laws: lengths of horns that do not differ, on a logarithmic axis
@pytest.mark.parametrize("name", registry.OF_STUDY)
def test_figures_of_a_study(study, name):
    entry = registry.OF_STUDY[name]
    for key in study.keys if entry.by_key else (None,):
        try:
            figure = study.figure(name, **{"key": key} if key else {})
        except barchan.MissingData as reason:
            assert name in ("laws", "means", "force_depth"), reason
            return
        if not isinstance(figure, result.Told):
            list(texts(figure))


@pytest.mark.parametrize("name", ["report", "movie"])
def test_files_of_a_run(run, name):
    for path in registry.OF_RUN[name].write_files(run):
        assert path.exists()
