"""Run and study folders that nobody has computed, made once a session by make_fake_run.py."""

import subprocess
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
MAKER = ROOT / "tests/support/make_fake_run.py"
FOLDER = tempfile.TemporaryDirectory()


@lru_cache
def fake(*options):
    """The folder of a run made with these options; tests may read it and leave it as it is."""
    folder = Path(FOLDER.name) / ("run" + "_".join(options))
    subprocess.run([sys.executable, MAKER, folder, *options], check=True)
    return folder
