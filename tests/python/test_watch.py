"""barchan watch: the page of a run that goes on reloads itself, that of one that has ended does not."""

import json
import os
import re
import shutil
import signal
import socket
import subprocess
import sys
import time

import pytest
from fake_runs import ROOT, fake

from barchan import report, watch


@pytest.fixture
def folder(tmp_path):
    """A run at 2 s of 8 s, of this process."""
    path = tmp_path / "run"
    shutil.copytree(fake("--without", "fields"), path)
    (path / "config.toml").write_text(re.sub(r"(?m)^end = .*", "end = 8.0", (path / "config.toml").read_text()))
    go_on(path, 2.0)
    (path / ".barchan.lock").write_text(f"process {os.getpid()} on {socket.gethostname()} since 2026-01-01 00:00:00\n")
    return path


def go_on(path, t, status="running"):
    summary = json.loads((path / "run.json").read_text())
    (path / "run.json").write_text(json.dumps(summary | {"status": status, "simulated_seconds": t}))
    head = (path / "history.csv").read_text().splitlines()[0]
    (path / "history.csv").write_text(f"{head}\n{t}" + ",0" * head.count(",") + "\n")


def page_of(path):
    return (path / "report.html").read_text()


def test_a_run_is_followed_to_its_end(folder, monkeypatch, capsys):
    pages = []

    def sleep(seconds):  # what happens meanwhile
        pages.append(page_of(folder))
        if len(pages) == 1:
            go_on(folder, 4.0)
        elif len(pages) == 3:  # nothing new at the second
            go_on(folder, 8.0, "done")
            (folder / ".barchan.lock").unlink()

    monkeypatch.setattr(watch, "pause", sleep)
    assert watch.main([str(folder)]) == 0
    assert all('data-reload="5"' in page and "location.reload" in page for page in pages[:3])
    assert "2 s of 8 s" in pages[0] and "4 s of 8 s" in pages[1] and pages[1] == pages[2]
    assert "data-reload" not in page_of(folder) and "location.reload" not in page_of(folder)
    assert "8 s of 8 s" in page_of(folder)
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].startswith(f"open {folder}/report.html in a browser")
    assert [line.split(",")[:2] for line in lines[1:3]] == [["t = 2 s of 8 s", " 25 %"], ["t = 4 s of 8 s", " 50 %"]]
    assert "left" not in lines[1] and re.search(r"about \d+ s left", lines[2])
    assert lines[3:] == [f"done, t = 8 s of 8 s: {folder}/report.html"]


def test_a_page_is_no_newer_than_what_it_shows(folder, monkeypatch):
    """The launcher draws no pictures of a run with a report that is newer than its last word."""
    pack, dates = report.packed_grains, []

    def packed_grains(run):
        time.sleep(0.05)
        (folder / "run.json").touch()  # written while the page is
        return pack(run)

    def sleep(seconds):
        dates.append([(folder / name).stat().st_mtime for name in ("report.html", "run.json")])
        (folder / ".barchan.lock").unlink(missing_ok=True)

    monkeypatch.setattr(report, "packed_grains", packed_grains)
    monkeypatch.setattr(watch, "pause", sleep)
    watch.main([str(folder)])
    assert dates[0][0] < dates[0][1]
    assert (folder / "report.html").stat().st_mtime > (folder / "run.json").stat().st_mtime


def test_a_run_that_has_ended_gets_its_page_at_once(folder, monkeypatch, capsys):
    (folder / ".barchan.lock").unlink()
    go_on(folder, 8.0, "done")
    monkeypatch.setattr(watch, "pause", lambda seconds: pytest.fail("waits for nothing"))
    assert watch.main([str(folder)]) == 0
    assert "data-reload" not in page_of(folder)
    assert capsys.readouterr().out == f"done, t = 8 s of 8 s: {folder}/report.html\n"


def test_a_run_that_was_killed_is_not_waited_for(folder, capsys):
    with subprocess.Popen([sys.executable, "-c", ""]) as gone:
        gone.wait()
    (folder / ".barchan.lock").write_text(f"process {gone.pid} on {socket.gethostname()} since 2026-01-01 00:00:00\n")
    assert watch.main([str(folder)]) == 0
    assert capsys.readouterr().out.startswith("ended without a word (killed?), t = 2 s")


def test_a_run_of_another_machine_is_believed(folder):
    (folder / ".barchan.lock").write_text("process 1 on elsewhere since 2026-01-01 00:00:00\n")
    assert watch.is_running(folder)


@pytest.mark.parametrize("name, says", [("nothing", "no such run folder: nothing"), ("runs/a.csv", "not a run folder"),
                                        ("empty", "no run in empty: it has no run.json"),
                                        ("cases/mine.toml", "no such run folder: runs/mine")])
def test_what_is_no_run_is_told(tmp_path, monkeypatch, capsys, name, says):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "empty").mkdir()
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs/a.csv").write_text("")
    assert watch.main([name]) == 2
    assert capsys.readouterr().err.startswith(f"watch: {says}")
    assert not list(tmp_path.rglob("report.html"))


def test_ctrl_c_ends_watching_and_leaves_a_page_that_stays(folder):
    with subprocess.Popen([sys.executable, "-m", "barchan", "watch", folder], stdout=subprocess.PIPE, text=True,
                          stderr=subprocess.PIPE, env={**os.environ, "PYTHONPATH": str(ROOT / "python")}) as watching:
        lines = [watching.stdout.readline(), watching.stdout.readline()]
        assert lines[1].startswith("t = 2 s of 8 s") and "data-reload" in page_of(folder)
        watching.send_signal(signal.SIGINT)
        out, err = watching.communicate(timeout=60)
    assert (watching.returncode, out, err) == (3, "", "\nno longer watched; the run goes on\n")
    assert "data-reload" not in page_of(folder)
