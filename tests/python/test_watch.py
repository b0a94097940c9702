"""barchan watch: a page that loads itself again while a run goes on, and no more when it has ended."""

import json
import os
import shutil
import subprocess
import sys
import time

import pytest
from fake_runs import fake

from barchan import watch

RELOADS = '<meta http-equiv="refresh"'


@pytest.fixture
def folder(tmp_path):
    path = tmp_path / "runs" / "dune"
    shutil.copytree(fake("--without", "fields"), path)
    return path


def say(folder, **changes):
    """Changes run.json as a run does."""
    summary = json.loads((folder / "run.json").read_text())
    (folder / "new").write_text(json.dumps({**summary, **changes}))
    os.replace(folder / "new", folder / "run.json")


def page(folder):
    return (folder / "report.html").read_text(encoding="utf-8")


def wait_for(what, process):
    end = time.monotonic() + 60
    while not what():
        assert process.poll() is None and time.monotonic() < end, process.communicate()
        time.sleep(0.05)


def test_a_page_follows_its_run_to_the_end(folder):
    say(folder, status="running")
    before = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    with subprocess.Popen([sys.executable, "-m", "barchan", "watch", str(folder), "--every", "1"], text=True,
                          stdout=subprocess.PIPE, stderr=subprocess.STDOUT) as process:
        wait_for(lambda: (folder / "report.html").exists() and RELOADS in page(folder), process)
        first = (folder / "report.html").stat().st_mtime_ns
        say(folder, message="still")
        wait_for(lambda: (folder / "report.html").stat().st_mtime_ns > first, process)
        assert RELOADS in page(folder)
        say(folder, status="done")
        said = process.communicate(timeout=60)[0].splitlines()
    assert process.returncode == 0
    assert RELOADS not in page(folder)
    assert "report.html" in said[0] and said[1].startswith("running") and said[-1].startswith("done")
    now = {path.name: path.stat().st_mtime_ns for path in folder.iterdir()}
    del now["report.html"], now["run.json"], before["run.json"]
    assert {name: now[name] for name in before} == before, "what the run writes was touched"


def test_a_run_that_has_ended_gets_its_page_once(folder, capsys):
    say(folder, status="done")
    assert watch.main([str(folder)]) == 0
    assert RELOADS not in page(folder)
    assert len(capsys.readouterr().out.splitlines()) == 2


def test_a_case_stands_for_its_run(folder, monkeypatch, capsys):
    monkeypatch.chdir(folder.parent.parent)
    assert watch.main(["dune.toml"]) == 0
    assert watch.main(["other.toml"]) == 2
    assert "runs/other is no run folder" in capsys.readouterr().err


def test_how_far_a_run_is_and_how_long_it_takes(folder):
    say(folder, status="running")
    text = (folder / "config.toml").read_text()
    reached = watch.time_reached(folder, {})
    assert f"t {reached:.4g} of" in watch.line(folder, 10.0, 0.0) and "[time]" in text
    assert "left" not in watch.line(folder, 10.0, reached), "no speed is known yet"
