"""Adds to the folder of a made run the bodies.h5 that the program would have written there."""

import os
import re
import subprocess
import tempfile
import tomllib
from pathlib import Path

CASE = """[time]
end = 1e-6
fluid_step = 1e-6
[domain]
size = {}
[fluid]
cells = [8, 8, 8]
mean_velocity = 0.1
"""


def survey(folder):
    """Of the bodies in its config.toml: by a step of a coarse flow around them."""
    text = (folder / "config.toml").read_text()
    bodies = re.findall(r"^\[\[body\]\]\n(?:[^\[\n].*\n|\n)*", text, re.MULTILINE)
    with tempfile.TemporaryDirectory() as place:
        case = Path(place) / "bodies.toml"
        case.write_text(CASE.format(tomllib.loads(text)["domain"]["size"]) + "".join(bodies))
        program = [os.environ["BARCHAN_PROGRAM"], "run", case, "--out", case.parent / "run"]
        ended = subprocess.run(program, capture_output=True, text=True, env=os.environ | {"OMP_NUM_THREADS": "1"})
        assert ended.returncode == 0, ended.stdout + ended.stderr
        (folder / "bodies.h5").write_bytes((case.parent / "run/bodies.h5").read_bytes())
