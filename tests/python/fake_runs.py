"""Run and study folders that nobody has computed, made once a session by make_fake_run.py."""

import json
import re
import subprocess
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MAKER = ROOT / "tests/support/make_fake_run.py"
FOLDER = tempfile.TemporaryDirectory()


@lru_cache
def columns_of_the_page():
    """columns.json, from the tables of docs/files.md: a test of the program compares these with what it writes."""
    columns = {}
    for part in (ROOT / "docs/files.md").read_text().split("\n## ")[1:]:
        rows = re.findall(r"^\| `(\w+)` \| ([^|]+) \| ([^|]+) \|$", part, re.M)
        columns[part.split("\n")[0]] = {name: {"unit": unit.replace("-", "1"), "meaning": meaning}
                                       for name, unit, meaning in rows}
    return json.dumps(columns)


@lru_cache
def fake(*options):
    """The folder of a run made with these options; tests may read it and leave it as it is."""
    folder = Path(FOLDER.name) / ("run" + "_".join(options))
    subprocess.run([sys.executable, MAKER, folder, *options], check=True)
    for table in folder.rglob("history.csv"):
        (table.parent / "columns.json").write_text(columns_of_the_page())
    return folder
