"""barchan list: what runs there are below a folder."""
import json
import os
import subprocess
import sys
import time
from pathlib import Path

import pytest

from barchan import listing

ROOT = Path(__file__).resolve().parents[2]


def a_run(folder, status="done", restarts=(), age=0.0, end=2.0, lines="t,step\n0,0\n0.5,10\n"):
    folder.mkdir(parents=True)
    (folder / "run.json").write_text(json.dumps({"status": status, "title": f"of {folder.name}", "simulated_seconds": 1}))
    (folder / "config.toml").write_text(f"[time]\nend = {end}\n")
    (folder / "history.csv").write_text(lines)
    for step in restarts:
        (folder / f"restart_{step:010}.h5").write_bytes(bytes(1500))
    for path in folder.iterdir():
        os.utime(path, (time.time() - age,) * 2)
    return folder


def lines_of(capsys):
    return [line.split() for line in capsys.readouterr().out.splitlines()]


def test_last_written_come_first_with_time_and_restart(tmp_path, capsys):
    a_run(tmp_path / "old", age=7200, restarts=(8, 1200))
    a_run(tmp_path / "study/new", "running", age=30)
    (tmp_path / "old/topviews.png").write_bytes(b"drawn today")
    assert listing.main([str(tmp_path)]) == 0
    head, new, old = lines_of(capsys)
    assert head[:2] == ["run", "status"]
    assert new == ["study/new", "running", "0.5", "s", "2", "s", *new[6:9], "-", *new[10:12], "of", "new"]
    assert new[6:9] == ["30", "s", "ago"] or new[6:9] == ["31", "s", "ago"]
    whole = sum(path.stat().st_size for path in (tmp_path / "old").iterdir())
    assert old[:3] == ["old", "done", "0.5"] and old[6:10] == ["2", "h", "ago", "1200"]
    assert old[10:12] == [f"{whole / 1000:.3g}", "kB"]


def test_what_is_not_whole_is_shown_all_the_same(tmp_path, capsys):
    broken = a_run(tmp_path / "broken", lines="")
    (broken / "run.json").write_text('{"status": "run')
    (broken / "config.toml").write_text("not TOML")
    assert listing.main([str(tmp_path)]) == 0
    assert lines_of(capsys)[1][:4] == ["broken", "unknown", "-", "-"]


def test_links_are_not_followed(tmp_path, capsys):
    a_run(tmp_path / "elsewhere")
    (tmp_path / "runs").mkdir()
    (tmp_path / "runs/link").symlink_to(tmp_path / "elsewhere")
    assert listing.main([str(tmp_path / "runs")]) == 0
    assert capsys.readouterr().out == f"no runs below {tmp_path}/runs\n"


def test_no_folder_is_told(tmp_path, capsys):
    assert listing.main([str(tmp_path / "nothing")]) == 2
    assert "no such folder" in capsys.readouterr().err


def test_a_reader_may_stop_early(tmp_path):
    """As `./barchan list | head` does."""
    for number in range(2000):
        (tmp_path / f"{number}").mkdir()
        (tmp_path / f"{number}/run.json").write_text('{"status": "done", "title": "' + 60 * "x" + '"}')
    with subprocess.Popen([sys.executable, "-m", "barchan", "list", tmp_path], stdout=subprocess.PIPE,
                          stderr=subprocess.PIPE, text=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")}) as listed:
        listed.stdout.readline()
        listed.stdout.close()
        said = listed.stderr.read()
    assert (said, listed.returncode) == ("", 0)


@pytest.mark.parametrize(("elapsed", "said"), [(1, "now"), (59, "59 s ago"), (90, "2 min ago"), (3 * 86400, "3 d ago")])
def test_ages(elapsed, said):
    assert listing.age(elapsed) == said
