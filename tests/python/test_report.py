"""The report's own numbers."""

import json
import re
import shlex
import shutil
from html import unescape
from types import SimpleNamespace

import pytest
from fake_runs import fake

import barchan
from barchan import report
from barchan.report import from_config, largest_speed
from barchan.report.health import ledger


@pytest.mark.parametrize("fluid, speed", [
    ({}, 0.0),
    ({"mean_velocity": -0.28}, 0.28),
    ({"mean_velocity": [0.3, -0.4]}, 0.5),
    ({"mean_velocity": 0.0, "schedule": [{"velocity": 0.1}, {"velocity": [0, -0.2], "amplitude": [0.3, 0.4]}]}, 0.7),
])
def test_largest_speed_of_a_flow(fluid, speed):
    assert largest_speed(fluid) == pytest.approx(speed)


def test_a_turned_flow_has_its_reynolds_number():
    rows = dict(from_config({"domain": {"size": [0.1, 0.025, 0.04]}, "fluid": {"mean_velocity": [0.0, 0.28]}}))
    assert rows["bulk velocity U"] == "0.28 m/s"
    assert rows["Re = 2 δ U / ν"] == "14000"


@pytest.mark.parametrize("coupling, drops", [
    ({"scheme": "cfdem"}, True),
    ({"void_fraction": "cfdem_faithful"}, True),  # as earlier versions wrote it
    ({"scheme": "layered"}, False),
])
def test_a_scheme_that_drops_volume_is_said_to(coupling, drops):
    volume = ledger(SimpleNamespace(config={"coupling": coupling}), {})[0]
    assert ("drops volume" in volume.about) == drops


@pytest.fixture
def folder(tmp_path):
    """Of a run that somebody else may have had."""
    path = tmp_path / "evil"
    shutil.copytree(fake("--without", "grains", "--without", "fields"), path)
    return path


def page_of(folder):
    page, = report.write_files(barchan.Run(folder))
    return page.read_text()


def test_links_are_listed_not_followed(folder):
    (folder / "dangling").symlink_to("/mnt/nowhere")
    (folder / "loop").symlink_to("loop")
    (folder / "elsewhere").symlink_to(folder.parent)
    page = page_of(folder)
    for name in ("dangling", "loop", "elsewhere"):
        assert re.search(f"<th>{name}</th><td>link</td><td>20..-", page), name


def test_a_file_may_go_while_the_page_is_written(folder, monkeypatch):
    def gone(path):
        raise FileNotFoundError(path)

    monkeypatch.setattr(report, "size", gone)
    assert '<table class="files"></table>' in page_of(folder)


@pytest.mark.parametrize("threads", ["1; rm -rf ~", [1], {"a": 1}, True, -1, 1.5, None])
def test_what_is_to_be_typed_has_only_numbers_and_quoted_words(folder, threads):
    (folder / "run.json").write_text(json.dumps({"status": "done", "threads": threads, "git_hash": "1234567; rm"}))
    typed = re.search(r"<pre>(\./barchan run [^<]*)</pre>", page_of(folder))[1]
    name = shlex.quote(str(folder))
    assert unescape(typed).splitlines() == [f"./barchan run {name}/config.toml --out {name}-again",
                                            f"./barchan plot {name}", f"./barchan plot {name} report"]


def test_a_folder_may_be_called_as_an_option(folder, monkeypatch):
    monkeypatch.chdir(folder.parent)
    folder.rename(folder.parent / "-x $(id)")
    typed = unescape(re.search(r"<pre>(\./barchan run [^<]*)</pre>", page_of("-x $(id)"))[1])
    assert shlex.split(typed.splitlines()[0]) == ["./barchan", "run", "./-x $(id)/config.toml", "--out",
                                                  "./-x $(id)-again"]


KEYS = ("status", "title", "message", "version", "git_hash", "threads", "simulated_seconds", "wall_seconds", "steps",
        "phases", "ledger", "max_cfl", "grains_initial", "grains_inside", "grains_left")


@pytest.mark.parametrize("text", ["[1]", "null", "{", '{"a": ' * 100_000, json.dumps(dict.fromkeys(KEYS, ["\ud800"]))],
                         ids=["list", "null", "cut", "deep", "wrong kinds"])
def test_a_summary_of_anything_still_gives_a_page(folder, text):
    (folder / "run.json").write_text(text)
    assert "To repeat it" in page_of(folder)
