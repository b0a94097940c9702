"""barchan.check, run and sweep: words for the launcher, and exceptions that carry what the program says."""

import os
import stat
import subprocess
import tomllib
from pathlib import Path

import numpy as np
import pytest
from fake_runs import ROOT

import barchan
from barchan.api import program
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
    for overrides in {"end": 2.0}, {"end": "late"}:
        with pytest.raises(barchan.BadInput, match="section__key"):
            barchan.check("case.toml", **overrides)
        with pytest.raises(barchan.BadInput, match="end: name a key as section.key"):
            barchan.check("case.toml", overrides)


def test_values_are_written_as_toml(launcher):
    barchan.check("case.toml", grains__feed__rate=50, fluid__cells=np.array([4, 5, 6]), case__notes="two\nlines",
                  initial__fluid=Path("a.h5"), body=[{"name": "pile", "centre": (0.1, 0.2)}])
    assert launcher.words()[4::2] == ["grains.feed.rate=50", "fluid.cells=[4, 5, 6]", 'case.notes="two\\nlines"',
                                      'initial.fluid="a.h5"', 'body=[{"name" = "pile", "centre" = [0.1, 0.2]}]']
    with pytest.raises(barchan.BadInput, match="time.end: a case cannot have a value of type NoneType"):
        barchan.check("case.toml", time__end=None)


@pytest.mark.parametrize("overrides, keys", [
    ({"fluid.schedule.2.velocity": 0.3, "grains.restitution": 0.5}, {}),
    ({"fluid": {"schedule": {2: {"velocity": 0.3}}}, "grains": {"restitution": 0.5}}, {}),
    ({"fluid.schedule": {"2": {"velocity": 0.3}}}, {"grains__restitution": 0.5}),
    (None, {"fluid__schedule__2__velocity": 0.3, "grains": {"restitution": 0.5}})])
def test_overrides_are_dotted_or_nested(launcher, overrides, keys):
    for call in barchan.check, barchan.run:
        Path("runs/case").mkdir(parents=True, exist_ok=True)
        call("case.toml", overrides, **keys)
        assert launcher.words()[-4:] == ["--set", "fluid.schedule.2.velocity=0.3", "--set", "grains.restitution=0.5"]


def test_overrides_that_cannot_be_meant(launcher):
    with pytest.raises(barchan.BadInput, match="time.end is given twice"):
        barchan.check("case.toml", {"time": {"end": 1.0}}, time__end=2.0)
    with pytest.raises(barchan.BadInput, match="overrides must be a dict of keys and values, and is 'runs/dune'"):
        barchan.run("case.toml", "runs/dune")


NESTED = [
    ("field/reversal.toml", {"fluid.schedule.2.velocity": -0.2}, {}),
    ("field/two-heaps-settle.toml", {"initial": {"heap": {1: {"radius": 0.0045}, 2: {"seed": 7}}}}, {}),
    ("field/two-heaps-settle.toml", {"initial.heap.2": {"centre": [0.045, 0.012], "radius": 0.0045}},
     {"time__end": 0.5}),
    ("field/two-densities-settle.toml", {"grains": {"kind": {"2": {"density": 3100.0}}}}, {}),
    ("heap-3k.toml", {"initial.grains.pour.radius": 0.0042}, {"initial__grains__pour__seed": 3})]


def leaves(value, name=""):
    """{"fluid.schedule.2.velocity": 0.3} of a case; entries of lists have their numbers."""
    if isinstance(value, list):
        value = dict(enumerate(value, 1))
    if not isinstance(value, dict):
        return {name: value}
    return {key: leaf for part, inner in value.items() for key, leaf in leaves(inner, f"{name}.{part}".strip(".")).items()}


@pytest.mark.skipif("BARCHAN_PROGRAM" not in os.environ, reason="needs the program, whose path BARCHAN_PROGRAM has")
@pytest.mark.parametrize("case, overrides, keys", NESTED)
def test_the_program_takes_nested_overrides(case, overrides, keys):
    """As the case with every default shows; what is not meant stays as it was."""
    def resolved(*options):
        done = subprocess.run([os.environ["BARCHAN_PROGRAM"], "check", ROOT / "configs" / case, "--resolved-only",
                               *options], capture_output=True, text=True)
        assert done.returncode == 0, done.stderr
        return leaves(tomllib.loads(done.stdout))

    before, after = resolved(), resolved(*program._settings(overrides, keys))
    wanted = leaves(overrides) | {name.replace("__", "."): value for name, value in keys.items()}
    changed = {key: value for key, value in after.items() if before.get(key) != value}
    assert changed == {key: value for key, value in wanted.items() if before.get(key) != value}
    assert len(changed) >= len(keys) + 1 and before.keys() <= after.keys()


@pytest.mark.skipif("BARCHAN_PROGRAM" not in os.environ, reason="needs the program, whose path BARCHAN_PROGRAM has")
def test_an_entry_that_is_not_there(monkeypatch):
    monkeypatch.setenv("BARCHAN", os.environ["BARCHAN_PROGRAM"])
    with pytest.raises(barchan.BadInput, match='"initial.heap" has no entry 3: its entries have the numbers 1 to 2'):
        barchan.check(ROOT / "configs/field/two-heaps-settle.toml", {"initial.heap.3.radius": 0.004})


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
