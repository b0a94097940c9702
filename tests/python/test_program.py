"""barchan.check, run and sweep: words for the launcher, and exceptions that carry what the program says."""

import os
import stat
from pathlib import Path

import numpy as np
import pytest
from fake_runs import ROOT

import barchan
from barchan.io.tables import read_table

LAUNCHER = """#!/bin/sh
printf '%s\\n' "$@" > "$0.words"
cat "$0.says" >&2 2> /dev/null
cat "$0.prints" 2> /dev/null
exit "$(cat "$0.status" 2> /dev/null || echo 0)"
"""


@pytest.fixture
def launcher(tmp_path, monkeypatch):
    """A stand-in for the launcher; returns a function that tells it what to say, print and end with."""
    path = tmp_path / "barchan"
    path.write_text(LAUNCHER)
    path.chmod(path.stat().st_mode | stat.S_IXUSR)
    monkeypatch.setenv("BARCHAN", str(path))
    monkeypatch.chdir(tmp_path)

    def answers(status=0, says="", prints=""):
        for name, text in (("status", str(status)), ("says", says), ("prints", prints)):
            (tmp_path / f"barchan.{name}").write_text(text)
    answers()
    answers.words = lambda: (tmp_path / "barchan.words").read_text().splitlines()
    return answers


def test_run_hands_over_its_arguments(launcher, tmp_path, capfd):
    (tmp_path / "runs/dune").mkdir(parents=True)
    launcher(says="step 1\n")
    run = barchan.run("cases/dune.toml", threads=2, grains__sliding_friction=0.4, initial__fluid="a.h5",
                      fluid__cells=(4, 5, 6), output__grain_forces=True)
    assert launcher.words() == ["run", "cases/dune.toml", "--out", "runs/dune", "--set",
                                "grains.sliding_friction=0.4", "--set", 'initial.fluid="a.h5"', "--set",
                                "fluid.cells=[4, 5, 6]", "--set", "output.grain_forces=true", "--threads", "2"]
    assert isinstance(run, barchan.Run) and os.fspath(run.path) == "runs/dune"
    assert "step 1" in capfd.readouterr().err


def test_sweep_returns_the_study(launcher, tmp_path):
    (tmp_path / "out").mkdir()
    (tmp_path / "out/study.json").write_text('{"title": "t", "cases": []}')
    assert barchan.sweep("study.toml", out="out", at_once=2).title == "t"
    assert launcher.words() == ["sweep", "study.toml", "--out", "out", "--at-once", "2"]


def test_check_returns_the_case(launcher, capsys):
    """As `barchan check` does without options: it refuses what that refuses."""
    launcher(prints="  memory  about 3 MB\n\nwarning: thick rows\n\n# The case, every default filled in\n\n"
             "[time]\nend = 2.0\n")
    assert barchan.check("case.toml", time__end=2.0) == {"time": {"end": 2.0}}
    assert launcher.words() == ["check", "case.toml", "--resolved", "--set", "time.end=2.0"]
    assert capsys.readouterr().out == ""
    barchan.check("case.toml", report=True)
    shown = capsys.readouterr().out
    assert "about 3 MB" in shown and "thick rows" in shown and "end = 2.0" not in shown


@pytest.mark.parametrize("status, kind", [(1, barchan.RunFailed), (2, barchan.BadInput), (3, barchan.RunStopped)])
def test_exceptions_say_what_the_program_says(launcher, status, kind):
    launcher(status, 'case.toml:3: [time] endd: unknown key (did you mean "end"?)\n1 problem; nothing was run.\n')
    for call in (barchan.check, barchan.run, barchan.sweep):
        with pytest.raises(kind, match="did you mean \"end\""):
            call("case.toml")


def test_an_override_needs_its_section(launcher):
    with pytest.raises(barchan.BadInput, match="section__key"):
        barchan.check("case.toml", end=2.0)


def test_overrides_reach_every_key(launcher):
    barchan.check("case.toml", grains__feed__rate=50, fluid__cells=np.array([4, 5, 6]), case__notes="two\nlines",
                  initial__fluid=Path("a.h5"), body=[{"name": "pile", "centre": (0.1, 0.2)}])
    assert launcher.words()[4::2] == ["grains.feed.rate=50", "fluid.cells=[4, 5, 6]", 'case.notes="two\\nlines"',
                                      'initial.fluid="a.h5"', 'body=[{"name" = "pile", "centre" = [0.1, 0.2]}]']
    with pytest.raises(barchan.BadInput, match="time__end: a case cannot have a value of type NoneType"):
        barchan.check("case.toml", time__end=None)


def test_a_program_that_is_not_there(monkeypatch):
    monkeypatch.setenv("BARCHAN", "/nowhere/barchan")
    with pytest.raises(barchan.BarchanError, match="cannot start /nowhere/barchan"):
        barchan.check("case.toml")


def test_folders_are_called_as_those_of_the_program(launcher, tmp_path):
    table = read_table(ROOT / "tests/reference/run_names.csv")
    rows = list(zip(*table.columns.values())) + [tuple(table.columns)]
    assert len(rows) > 10
    for file, name in rows:
        (tmp_path / "runs" / name).mkdir(parents=True, exist_ok=True)
        assert barchan.run(tmp_path / file).path == Path("runs") / name
        assert launcher.words()[2:4] == ["--out", f"runs/{name}"]
