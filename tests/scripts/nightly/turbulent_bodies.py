#!/usr/bin/python3
"""Turbulent flow over a wavy wall and around a cube against published results (docs/validation.md, "Bodies in
the flow"). BARCHAN_BODY_RUNS names a folder for the runs, which are used again."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

import barchan
from ranges import measured, status

ROOT = pathlib.Path(__file__).resolve().parents[3]


def bubble_of(case, runs):
    """The line of the figure flow_around_body about the only body of a case."""
    folder, program = runs / case, os.environ["BARCHAN_PROGRAM"]
    record = folder / "run.json"
    if not record.is_file() or json.loads(record.read_text())["status"] != "done":
        subprocess.run([program, "run", ROOT / f"configs/validation/{case}.toml", "--out", folder], check=True,
                       stdout=subprocess.DEVNULL)
    numbers = barchan.Run(folder).figure("flow_around_body").numbers["flow_around_body"]
    return {key: values[0] for key, values in numbers.items()}


def main(runs):
    wave = bubble_of("wavy-wall", runs)  # in wavelengths from the crest
    measured("wavy wall: where the flow separates (published 0.14 to 0.22)", wave["x_s"] / 0.02, 0.11, 0.25)
    measured("wavy wall: where it attaches again (published 0.58 to 0.60)", wave["x_r"] / 0.02, 0.55, 0.63)
    cube = bubble_of("cube", runs)
    measured("cube: length of the bubble behind it over its height", cube["length_over_size"], 1.4, 1.7)
    return status("turbulent bodies")


kept = os.environ.get("BARCHAN_BODY_RUNS")
with tempfile.TemporaryDirectory() as folder:
    sys.exit(main(pathlib.Path(kept or folder)))
