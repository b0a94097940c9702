#!/usr/bin/python3
"""scripts/first_light_judge.py on a run and copies of it in which one thing is changed: by less than what is allowed,
by more, to not-a-number, or by one bit."""
import os
import pathlib
import shutil
import subprocess
import sys

import h5py
import numpy as np

os.environ.setdefault("OMP_PROC_BIND", "false")
import faults  # noqa: E402

ROOT = pathlib.Path(__file__).resolve().parents[3]
# Kind, dataset, entry, factor of a change, is it allowed.
CHANGES = [
    ("step", "fluid/u_x", (3, 3, 3), 1 + 1e-13, True), ("step", "fluid/u_x", (3, 3, 3), 1 + 1e-9, False),
    ("step", "fluid/p", (3, 3, 3), np.nan, False), ("step", "fluid/u_x", (0, 0, 0), np.nan, True),  # a ghost
    ("step", "grains/kin", (5, 0), 1 + 1e-13, True), ("step", "grains/kin", (5, 0), 1 + 1e-11, False),
    ("step", "grains/contact_force", (slice(None), 1), 1 + 1e-10, True),
    ("step", "grains/contact_force", (slice(None), 1), 1 + 1e-8, False),
    ("bits", "fluid/u_x", (3, 3, 3), 1, True), ("bits", "grains/kin", (5, 0), 1 + 2.3e-16, False),
]


def judge(kind, run, other):
    words = [sys.executable, ROOT / "scripts/first_light_judge.py", kind, run, other]
    done = subprocess.run(words, capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def expect(what, said, allowed):
    if said[0] != (0 if allowed else 1) or not said[1].strip() or "Traceback" in said[1]:
        sys.exit(f"FAILED: {what}: exit code {said[0]}: {said[1]}")


def change(folder, name, entry, factor):
    with h5py.File(faults.last_restart(folder), "r+") as file:
        values = file[name][...]
        values[entry] *= factor
        file[name][...] = values


def means(folder, table, column, factor):
    """The table with one column times a factor in the second half."""
    path = folder / table
    head, *lines = path.read_text().splitlines()
    place = head.split(",").index(column)
    rows = [line.split(",") for line in lines]
    for row in rows[len(rows) // 2:]:
        row[place] = repr(float(row[place]) * factor)
    path.write_text("\n".join([head, *(",".join(row) for row in rows)]) + "\n")


def main(work):
    run = work / "run"
    faults.expect(faults.run(run, {"time.end": 0.005, "output.history_interval": 2.5e-4,
                                   "output.dune_interval": 2.5e-4}), 0)
    other = work / "other"

    def with_change(kind, what, allowed, changed, *arguments):
        shutil.copytree(run, other)
        changed(other, *arguments)
        expect(f"{kind}, {what} {arguments}", judge(kind, run, other), allowed)
        shutil.rmtree(other)

    for kind, name, entry, factor, allowed in CHANGES:
        with_change(kind, name, allowed, change, name, entry, factor)
    for column, table in (("u_star", "history.csv"), ("W", "dune.csv")):
        with_change("statistics", column, True, means, table, column, 1.02)
        with_change("statistics", column, False, means, table, column, 1.2)
        with_change("statistics", column, False, means, table, column, np.nan)
        with_change("bits", column, False, means, table, column, 1.02)
    for kind in ("bits", "step", "statistics"):
        expect(f"{kind} of nothing", judge(kind, run, work / "nothing"), False)
    print(f"{len(CHANGES) + 11} comparisons of runs judged as they should be")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
