#!/usr/bin/python3
"""Restart files of version 0.1.0 (tests/reference/restart-0.1.0): a flow alone and grains alone go on as they did in
that version; grains in a flow, whose exchange of momentum is another one today, are refused in a sentence with both
versions, and nothing is written."""
import csv
import gzip
import os
import pathlib
import re
import subprocess
import sys
import tempfile

import h5py
import numpy

ROOT = pathlib.Path(__file__).resolve().parents[2]
OLD = ROOT / "tests/reference/restart-0.1.0"
PROGRAM = os.environ["BARCHAN_PROGRAM"]
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1"}
FLOW = """[fluid]
cells = [4, 6, 4]
first_cell_height = 3e-4
mean_velocity = 0.2
"""
GRAINS = """[grains]
youngs_modulus = 1.25e6
rolling_friction = 0.05
sizes = [[1.5e-4, 5], [2e-4, 20]]
[initial.grains.pour]
centre = [0.002, 0.0015]
radius = 0.0003
"""
CASE = """[time]
end = 0.04
fluid_step = 2.5e-4
{step}
[domain]
size = [0.004, 0.003, 0.003]
[restart]
interval = 0.02
wall_interval = 0
{initial}
"""
TURBULENT = '[initial]\nfluid = "turbulent"\n'
STEP = "grain_step = 5e-6"
CASES = {"flow": CASE.format(step="", initial=TURBULENT + FLOW), "grains": CASE.format(step=STEP, initial=GRAINS),
         "coupled": CASE.format(step=STEP, initial=TURBULENT + FLOW + GRAINS)}
DIAMETER = 2e-4  # m
# After 80 fluid steps the flow has the bits of 0.1.0, and the grains are where they were but for 4e-12 of a diameter,
# as sums are in another order. If the contacts of the file began anew, it would be 0.03 of it.
TOLERANCE = 1e-9


def go_on(name, work):
    """The exit code and message of a run from the file, and its folder."""
    case, start, out = (work / (name + end) for end in (".toml", ".h5", ""))
    case.write_text(CASES[name])
    start.write_bytes(gzip.decompress((OLD / f"{name}.h5.gz").read_bytes()))
    command = [PROGRAM, "run", case, "--out", out, "--quiet", "--restart", start]
    done = subprocess.run(command, capture_output=True, text=True, timeout=120, env=ENVIRONMENT)
    return done.returncode, done.stderr, out


def reference(what):
    with open(OLD / "after.csv", encoding="utf-8") as file:
        rows = [row for row in csv.DictReader(line for line in file if line[0] != "#") if row["of"] == what]
    return {int(row["number"]): [float(row[axis]) for axis in "xyz"] for row in rows}


def velocity(file):
    parts = [file[f"fluid/u_{axis}"][1:-1, 1:-1, 1:-1].ravel() for axis in "xyz"]  # without the cells around
    return dict(enumerate(zip(*parts)))


def places(file):
    return dict(zip(file["grains/id"][...].tolist(), file["grains/kin"][:, :3].tolist()))


def check_goes_on(name, what, read, scale, work):
    code, said, out = go_on(name, work)
    if code != 0:
        sys.exit(f"{name} of 0.1.0 does not go on: code {code}, {said}")
    with h5py.File(out / "restart_0000000160.h5") as file:
        now, then = read(file), reference(what)
    if now.keys() != then.keys() or len(then) < 20:
        sys.exit(f"{name}: {len(now)} of them, there were {len(then)}")
    off = max(numpy.max(numpy.abs(numpy.subtract(now[key], then[key]))) for key in then) / scale
    print(f"{name}: off by {off:.1e} of {scale:g}")
    if not off < TOLERANCE:
        sys.exit(f"{name} of 0.1.0 goes on otherwise than in that version")


def check_refused(work):
    code, said, out = go_on("coupled", work)
    told = subprocess.run([PROGRAM, "--version"], capture_output=True, text=True, env=ENVIRONMENT).stdout
    version = re.search(r"\d+\.\d+\.\d+", told)[0]
    wanted = "coupled.h5: it holds no", "version 0.1.0 wrote it", f"this is version {version}", "start anew"
    missing = [words for words in wanted if words not in said]
    if code != 2 or missing or out.exists():
        sys.exit(f"coupled: code {code}, without {missing}, {out.exists()}: {said}")
    print(said.splitlines()[-1])


def main():
    with tempfile.TemporaryDirectory() as name:
        work = pathlib.Path(name)
        check_goes_on("flow", "flow", velocity, 0.2, work)  # of the mean velocity, m/s
        check_goes_on("grains", "grain", places, DIAMETER, work)
        check_refused(work)


main()
