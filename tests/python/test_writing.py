"""What is written into a folder that somebody else has made stays in it: links in it lead nowhere."""

import ast
import os
import shutil

import pytest
from fake_runs import ROOT, fake

import barchan
from barchan import plot, vtk
from barchan.figures import movie, result
from barchan.io import writing
from barchan.studies import sweep

PACKAGE = ROOT / "python/barchan"
OPENING = {"write_text", "write_bytes", "mkdir", "unlink", "rmdir", "rename", "rmtree", "touch", "makedirs",
           "symlink_to", "mkstemp", "mkdtemp", "NamedTemporaryFile", "copyfile", "copytree", "move"}
PROGRAM = """#!/bin/sh
[ "$1" != check ] || { echo 'time.end = 1.0'; exit; }
echo said
"""


def calls_that_write(path):
    """Of functions that write or remove, by their names; `open` in any mode but that of reading."""
    for node in ast.walk(ast.parse(path.read_text())):
        if not isinstance(node, ast.Call):
            continue
        name = getattr(node.func, "attr", getattr(node.func, "id", ""))
        modes = [word.value for word in [*node.args[1:], *(key.value for key in node.keywords if key.arg == "mode")]
                 if isinstance(word, ast.Constant) and isinstance(word.value, str)]
        opens = name in ("open", "File") and any(set(mode) & set("wax+") for mode in modes)
        if name in OPENING or opens or ast.unparse(node.func) in ("os.replace", "os.remove"):
            yield f"{path.relative_to(PACKAGE)}:{node.lineno} {ast.unparse(node)[:60]}"


def test_one_module_writes():
    """With these exceptions: files of HDF5 go under a name that is free, and a study may have to be given a place."""
    found = [call for path in sorted(PACKAGE.rglob("*.py")) if path.name != "writing.py"
             for call in calls_that_write(path)]
    assert [call.split(":")[0] for call in found] == ["io/vtkhdf.py", "studies/sweep.py"], found
    assert "h5py.File(beside, 'x')" in found[0] and "folder.mkdir(parents=True" in found[1]


def films(run, monkeypatch):
    """As with an ffmpeg that writes its last argument."""
    program = run.path.parent / "ffmpeg"
    program.write_text('#!/bin/sh\nfor last; do :; done\ncat > /dev/null\necho film > "$last"\n')
    program.chmod(0o755)
    monkeypatch.setattr(movie.shutil, "which", lambda name: str(program))
    try:
        movie.write_files(run)
    finally:
        monkeypatch.undo()
        program.unlink()


def write_some(folder):
    """Numbered pictures and files for ParaView."""
    movie.numbered(folder / "movie", iter([movie.np.zeros((4, 4, 3), "u1")] * 2), 0)
    assert vtk.main([str(folder)]) == 0


def write_all(folder, monkeypatch):
    """Every writer once; what it says of what it refuses."""
    run = barchan.Run(folder)
    figure = run.figure("morphology")
    result.publish(figure, "obstacles", {"dune": [0], "t": [float("nan")]})
    calls = [lambda: result.write_numbers(figure, folder),
             lambda: plot.main([str(folder), "morphology", "--pdf"]),
             lambda: plot.main([str(folder), "report"]),
             lambda: films(run, monkeypatch),
             lambda: movie.numbered(folder / "movie", iter([movie.np.zeros((4, 4, 3), "u1")] * 2), 0),
             lambda: vtk.main([str(folder)])]
    said = []
    for call in calls:
        try:
            call()
        except barchan.BarchanError as reason:
            said.append(str(reason))
    return said


@pytest.fixture
def run_folder(tmp_path):
    folder = tmp_path / "home/run"
    shutil.copytree(fake("--without", "fields", "--frames", "2"), folder)
    return folder


def contents(folder):
    return {path: path.read_bytes() for path in sorted(folder.rglob("*")) if path.is_file()}


def written(folder, act):
    """The files, relative to the folder, that it makes or changes."""
    before = contents(folder)
    act()
    return {path.relative_to(folder) for path, content in contents(folder).items() if before.get(path) != content}


def plant(folder, names, victims):
    """Links to files that are precious in place of these names and of those that they could have on their way."""
    for name in names:
        for ending in ("", ".part", ".tmp"):
            link = folder / f"{name}{ending}"
            if str(name) == "run.json" and not ending:
                continue  # is read, too
            victim = victims / link.name
            victim.write_text("precious")
            link.parent.mkdir(exist_ok=True)
            link.unlink(missing_ok=True)
            link.symlink_to(victim)


def test_files_of_a_run_are_not_written_through_links(run_folder, tmp_path, monkeypatch):
    names = written(run_folder, lambda: write_all(run_folder, monkeypatch))
    assert {str(name) for name in names} > {
        "run.json", "morphology.png", "morphology.pdf", "report.html", "obstacles.csv", "movie.mp4", "movie/0001.png",
        "figures_data/morphology.csv", "vtkhdf/grains_000001.hdf", "vtkhdf/grains.hdf.series"}
    victims = tmp_path / "victims"
    victims.mkdir()
    plant(run_folder, names, victims)
    assert not write_all(run_folder, monkeypatch)
    assert {path.read_text() for path in victims.iterdir()} == {"precious"}
    assert not any((run_folder / name).is_symlink() for name in names)
    assert not list(run_folder.rglob("*.part"))


def test_folders_of_a_run_are_not_links(run_folder, tmp_path, monkeypatch, capsys):
    victims = tmp_path / "victims"
    victims.mkdir()
    for name in ("morphology.csv", "0001.png", "0009.png", "grains_000001.hdf", "mine.hdf"):
        (victims / name).write_text("precious")
    for name in ("figures_data", "movie", "vtkhdf"):
        (run_folder / name).symlink_to(victims)
    said = "\n".join(write_all(run_folder, monkeypatch)) + capsys.readouterr().err
    for name in ("figures_data", "movie", "vtkhdf"):
        assert f"cannot write to {run_folder / name}: it is a link" in said
    assert len(list(victims.iterdir())) == 5 and {path.read_text() for path in victims.iterdir()} == {"precious"}


def test_what_was_there_stays_until_the_new_is_whole(run_folder, monkeypatch):
    """Files for ParaView and numbered pictures: old ones go only when all new ones are there."""
    def fails(*_):
        raise OSError("No space left on device")

    write_some(run_folder)
    (run_folder / "movie/0009.png").write_text("of a longer run")
    (run_folder / "vtkhdf/grains_000009.hdf").write_text("of a longer run")
    before = contents(run_folder)
    monkeypatch.setattr(writing.os, "replace", fails)
    assert vtk.main([str(run_folder)]) == 1
    with pytest.raises(OSError):
        movie.numbered(run_folder / "movie", iter([movie.np.zeros((4, 4, 3), "u1")]), 0)
    assert contents(run_folder) == before
    monkeypatch.undo()
    write_some(run_folder)
    left = contents(run_folder)
    assert run_folder / "movie/0001.png" in left and run_folder / "movie/0009.png" not in left
    assert run_folder / "vtkhdf/grains_000001.hdf" in left and run_folder / "vtkhdf/grains_000009.hdf" not in left


def study(tmp_path):
    program = tmp_path / "program"
    program.write_text(PROGRAM)
    program.chmod(0o755)
    (tmp_path / "case.toml").write_text("[time]\nend = 1.0\n")
    (tmp_path / "study.toml").write_text(
        '[study]\nbase = "case.toml"\n[ensemble]\nrealisations = 2\n[[case]]\nname = "one"\n')
    return [str(program), str(tmp_path / "study.toml"), "--out", str(tmp_path / "home/out"), "--no-pictures"]


def test_files_of_a_study_are_not_written_through_links(tmp_path, capsys, monkeypatch):
    monkeypatch.setattr(sweep.signal, "signal", lambda *_: None)  # a Ctrl-C is for pytest
    monkeypatch.setattr(sweep.time, "sleep", lambda _, sleep=sweep.time.sleep: sleep(0.01))
    words, folder, victims = study(tmp_path), tmp_path / "home/out", tmp_path / "victims"
    folder.mkdir(parents=True)
    victims.mkdir()
    tables = {"study.json", "study.csv", "ensemble.csv"}
    assert {str(name) for name in written(folder, lambda: sweep.main(words))} == \
        tables | {".lock", "one/sweep.txt", "one-r2/sweep.txt"}
    plant(folder, tables, victims)
    sweep.main(words)
    assert {path.read_text() for path in victims.iterdir()} == {"precious"}
    assert not any((folder / name).is_symlink() for name in tables)
    capsys.readouterr()

    plant(folder, ["one/sweep.txt"], victims)
    assert sweep.main(words) == 1
    assert f"one: failed: cannot write to {folder}/one/sweep.txt: it is a link" in capsys.readouterr().out
    shutil.rmtree(folder / "one")
    (folder / "one").symlink_to(victims)
    assert sweep.main(words) == 1
    assert f"one: failed: cannot write to {folder}/one: it is a link" in capsys.readouterr().out
    plant(folder, [".lock"], victims)
    assert sweep.main(words) == 2
    assert f"cannot write to {folder}/.lock: it is a link; take another --out" in capsys.readouterr().err
    assert {path.read_text() for path in victims.iterdir()} == {"precious"}


def test_a_pipe_is_no_log(tmp_path):
    """Opening it would wait for a reader for ever."""
    os.mkfifo(tmp_path / "pipe")
    with pytest.raises(barchan.BarchanError, match="pipe: "):
        writing.appending(tmp_path / "pipe")
