"""A study over folders that hold anything, and programs that end by a signal: sentences, and the other cases go on."""

import datetime
import os
import tomllib
from pathlib import Path
from types import SimpleNamespace

import numpy as np
import pytest

from barchan.errors import BarchanError
from barchan.studies import sweep
from barchan.studies.spec import StudyError, as_toml, read_study

# Does as it is told by files beside it; a run leaves a folder as a run does.
PROGRAM = """#!/bin/sh
here=$(dirname "$0")
[ ! -e "$here/$1-is-killed" ] || kill -KILL $$
[ "$1" != check ] || { echo '[time]'; echo 'end = 1.0'; exit; }
case "$* " in *--starts-only*) exit ;; esac
[ ! -e "$here/case-is-killed" ] || { echo half a line; kill -KILL $$; }
while [ "$1" != --out ]; do shift; done
printf '[time]\\nend = 1.0\\n' > "$2/config.toml"
echo '{"status": "done", "simulated_seconds": 1.0}' > "$2/run.json"
"""


@pytest.fixture
def study(tmp_path, monkeypatch):
    """main() of a study of the cases `one` and `two` in the folder out."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.setattr(sweep.signal, "signal", lambda *_: None)  # a Ctrl-C is for pytest
    monkeypatch.setattr(sweep.time, "sleep", lambda _, sleep=sweep.time.sleep: sleep(0.01))
    program = tmp_path / "program"
    program.write_text(PROGRAM)
    program.chmod(0o755)
    (tmp_path / "case.toml").write_text("[time]\nend = 1.0\n")

    def main(*names, more=""):
        cases = "".join(f'[[case]]\nname = "{name}"\n' for name in names or ("one", "two"))
        (tmp_path / "study.toml").write_text(f'[study]\nbase = "case.toml"\n{more}\n{cases}')
        return sweep.main([str(program), "study.toml", "--out", "out", "--no-pictures"])
    return main


def status_of(folder, name):
    lines = (folder / "out/study.csv").read_text().splitlines()
    return next(line.split(",")[1] for line in lines if line.startswith(f"{name},"))


def test_cases_that_are_done_are_not_run_again(study, capsys):
    assert study() == 0
    assert "2 of 2 cases done" in capsys.readouterr().out
    assert study() == 0
    assert capsys.readouterr().out.count("done before") == 2


@pytest.mark.parametrize("file, text", [
    ("config.toml", "[fluid]\ncells = [1, 1, 1]\n"), ("config.toml", "time = 3\n"), ("config.toml", "\udcff"),
    ("config.toml", "a = " + 5000 * "["), ("run.json", "[1]"), ("run.json", "null"), ("run.json", 5000 * "["),
    ("run.json", '{"status": ["done"], "simulated_seconds": "1"}'), ("run.json", '{"simulated_seconds": NaN}'),
    ("dune.csv", "t,dune\n1,0,3\n")])
def test_folders_with_anything_in_them(study, tmp_path, file, text, capsys):
    folder = tmp_path / "out/one"
    folder.mkdir(parents=True)
    if file != "config.toml":
        (folder / "config.toml").write_text("[time]\nend = 1.0\n")
    (folder / file).write_text(text, errors="surrogateescape")
    assert study() == 0
    assert "one: to be run" in capsys.readouterr().out
    assert status_of(tmp_path, "one") == "done"


def test_what_a_case_starts_from_leaves_the_threads_of_running_cases_alone(study, tmp_path):
    """The first case runs until the second one's start has begun: that has half of the threads."""
    waits = '[ "$(wc -l < "$here/starts")" = 2 ] || sleep 0.01; [ "$(wc -l < "$here/starts")" = 2 ]'
    says = '*--starts-only*) echo "$OMP_NUM_THREADS $OMP_PROC_BIND" >> "$here/starts"; exit ;;'
    (tmp_path / "program").write_text(PROGRAM.replace("*--starts-only*) exit ;;", says).replace(
        "while [", f"until {waits}; do :; done\nwhile [", 1))
    assert study(more="at_once = 2\nthreads = 3") == 0
    assert (tmp_path / "starts").read_text().splitlines() == ["6 false", "3 false"]


def test_a_name_that_no_folder_can_have(study, tmp_path, capsys):
    assert study("one", 300 * "x") == 2
    assert f"a case has a name of 300 letters, of at most 200 ({30 * 'x'}...): give" in capsys.readouterr().err
    assert study("one", more=f'[grid]\ncase.title = ["{250 * "y"}"]') == 2
    assert not (tmp_path / "out").exists()
    assert study(200 * "x") == 0


def test_a_folder_that_cannot_be_made_is_of_its_case_alone(study, tmp_path, capsys):
    (tmp_path / "out").mkdir()
    (tmp_path / "out/one").write_text("a file")
    assert study() == 1
    assert "failed: one: cannot write to out/one: it is a file" in capsys.readouterr().out
    assert (status_of(tmp_path, "one"), status_of(tmp_path, "two")) == ("failed", "done")


def test_a_pipe_in_place_of_a_lock_is_not_waited_for(study, tmp_path):
    (tmp_path / "out/one").mkdir(parents=True)
    os.mkfifo(tmp_path / "out/one/.barchan.lock")
    os.mkfifo(tmp_path / "out/one/run.json")
    (tmp_path / "out/one/config.toml").write_text("[time]\nend = 1.0\n")
    program = (tmp_path / "program").read_text()
    (tmp_path / "program").write_text(program.replace("echo '{", "rm -f \"$2/run.json\"; echo '{"))
    assert study() == 0


@pytest.mark.parametrize("what, status, words", [
    ("check", 2, "case one: ended by SIGKILL\n"),
    ("run", 1, "one: what it starts from, see out/one/sweep.txt: ended by "),
    ("case", 1, "failed: one: half a line: ended by SIGKILL\n")])
def test_a_signal_has_a_name(study, tmp_path, what, status, words, capsys):
    (tmp_path / f"{what}-is-killed").touch()
    assert study() == status
    said = capsys.readouterr()
    assert words in said.err + said.out


@pytest.mark.parametrize("value", [
    'two\nlines, a "quote", a \\, \x7f and \x00', [1, 2.5, True], {"a b": [{"c": "d"}], "e": 1e-300},
    datetime.date(2026, 1, 31)])
def test_values_are_written_on_one_line_and_read_again(value):
    line = f"value = {as_toml(value)}"
    assert "\n" not in line and tomllib.loads(line) == {"value": value}


def test_values_of_other_kinds_are_those_of_toml():
    assert as_toml(np.array([[1, 2], [3, 4]])) == "[[1, 2], [3, 4]]"
    assert as_toml((np.float32(0.5), np.int64(3), np.bool_(True))) == "[0.5, 3, true]"
    assert as_toml(Path("a/b.toml")) == '"a/b.toml"'
    for value in (None, object(), {1, 2}, 1j):
        with pytest.raises(TypeError, match="a case cannot have a value of type"):
            as_toml(value)


def test_an_entry_of_a_list_is_varied(tmp_path):
    """By its number, from 1, as --set has it; the base case gives its value."""
    (tmp_path / "case.toml").write_text("[[fluid.schedule]]\nvelocity = 0.1\n[[fluid.schedule]]\nvelocity = 0.2\n")
    text = '[study]\nbase = "case.toml"\n[vary]\n"fluid.schedule.{}.velocity" = [0.2, 0.3]\n'
    (tmp_path / "study.toml").write_text(text.format(2))
    options = SimpleNamespace(out=None, at_once=None, threads=None)
    cases = {case.name: case.set_options() for case in read_study(tmp_path / "study.toml", options).cases}
    assert cases == {"base": ["--set", "fluid.schedule.2.velocity=0.2"],
                     "velocity-0.3": ["--set", "fluid.schedule.2.velocity=0.3"]}
    (tmp_path / "study.toml").write_text(text.format(3))
    with pytest.raises(BarchanError, match=r"\[vary\] fluid.schedule.3.velocity has no value in the base case"):
        read_study(tmp_path / "study.toml", options)


def read(folder, text):
    (folder / "case.toml").write_text("[time]\nend = 1.0\n")
    (folder / "study.toml").write_text(f'{text}\n[study]\nbase = "case.toml"\n')
    return read_study(folder / "study.toml", SimpleNamespace(at_once=None, threads=None, out=None)).cases


def test_cases_are_like_others(tmp_path):
    cases = read(tmp_path, """
set.time.end = 2.0
[cases]
plain = {}
slow.fluid = { mean_velocity = 0.2, ramp_time = 1.0 }
"rough-0.9" = { like = "slow", grains.sliding_friction = 0.9, fluid.ramp_time = 3.0 }
both.like = ["rough-0.9", "slow"]
""")
    common, slow = {"time.end": 2.0}, {"fluid.mean_velocity": 0.2, "fluid.ramp_time": 1.0}
    rough = {**slow, "grains.sliding_friction": 0.9, "fluid.ramp_time": 3.0}
    assert {case.name: case.values for case in cases} == {
        "plain": common, "slow": common | slow, "rough-0.9": common | rough, "both": common | rough | slow}


def test_cases_as_sections_are_the_same(tmp_path):
    sections = read(tmp_path, '[[case]]\nname = "a"\nset = { time.end = 3.0 }\n[[case]]\nname = "b"\nlike = ["a"]\n')
    assert sections == read(tmp_path, "[cases]\na.time.end = 3.0\nb.like = 'a'\n")


@pytest.mark.parametrize("text, says", [
    ('a.like = "b"\nb = {}', 'like "b": no case before it has this name'), ("a.like = 3", "like must be the name"),
    ("a.like = [3]", "like must be the name"), ("a = 3", "must have a line NAME"),
    ('"a/b" = {}', "must be of letters")])
def test_cases_that_cannot_be(tmp_path, text, says):
    with pytest.raises(StudyError, match=says):
        read(tmp_path, f"[cases]\n{text}\n")
