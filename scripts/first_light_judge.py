#!/usr/bin/env python3
"""Compares two run folders, and prints one line with how far they are apart and what was allowed.

usage: first_light_judge.py bits|step|statistics RUN OTHER

bits: all tables and result files have the same bits.
step: after the same steps from the same state on another processor. Flow and positions agree to STEP of the largest
value of each. Forces of contacts, and velocities, which follow from them, agree to FORCES: an overlap is some 1e-5 of a
position, so that the last bit of a position is that much larger in a force. Random last bits of the whole state gave
2e-13 and 5e-11 in the quickstart.
statistics: means over the second half of the time. By then round-off has grown to other eddies and other paths of
grains, so that only means are alike. They agree to the share in MEANS.
"""
import csv
import math
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "tests/support"))
import same_bits  # noqa: E402

STEP, FORCES = 1e-12, 1e-9
# Columns of the matrix grains/kin (kernels/grains/grain.hpp).
PARTS = {"positions": slice(0, 3), "velocities": slice(4, 7), "spins": slice(8, 11)}
COARSE = ("velocities", "spins", "grains/contact_force", "grains/contact_torque", "grains/impulse",
          "contacts/xi_t", "grains/wall_xi_t")
# Table, column and largest difference of the means; of dune.csv the largest dune. One and two threads of a processor
# differ by half as much at most.
MEANS = (("history.csv", "u_star", 0.05), ("history.csv", "bulk_velocity", 0.001), ("dune.csv", "W", 0.05),
         ("dune.csv", "L", 0.05), ("dune.csv", "H", 0.05), ("dune.csv", "Cx", 0.02), ("dune.csv", "volume", 0.02))


class Different(Exception):
    """How two runs differ."""


def last_restart(run):
    found = max(run.glob("restart_*.h5"), default=None)
    if found is None:
        raise Different(f"{run} has no restart file")
    return found


def compare_bits(run, other):
    names = sorted(path.name for path in run.iterdir() if path.suffix in (".h5", ".csv"))
    if not any(name.startswith("restart_") for name in names):
        raise Different(f"{run} has no restart file")
    for name in names:
        if not (other / name).exists():
            raise Different(f"{other} has no {name}")
        if name.endswith(".csv") and (run / name).read_bytes() != (other / name).read_bytes():
            raise Different(f"{name} differs")
        if name.endswith(".h5"):
            try:
                same_bits.compare(run / name, other / name)
            except SystemExit as differing:
                raise Different(f"{name} differs: {str(differing.code).partition(' differ in ')[2]}") from None
    return f"{len(names)} files with the same bits"


def by_id(arrays):
    """Arrays of one value, vector or row a grain, in the order of the ids, and the three parts of kin; nothing else."""
    order = np.argsort(arrays["grains/id"])
    for name in [name for name in arrays if name.startswith("grains/") and arrays[name].dtype.kind == "f"]:
        axis = max(arrays[name].ndim - 2, 0)
        arrays[name] = np.take(arrays[name], order, axis)
    kin = arrays.pop("grains/kin")
    arrays.update((name, kin[:, columns]) for name, columns in PARTS.items())


def compared(path):
    """The arrays of a restart file that two processors must agree on."""
    arrays = {name: array for name, array in same_bits.arrays(path).items()
              if "@" not in name and name.startswith(("fluid/", "grains/", "contacts/"))}
    if "grains/id" in arrays:
        by_id(arrays)
    for name, array in arrays.items():
        if name.startswith("fluid/") and array.ndim == 3:
            arrays[name] = array[1:-1, 1:-1, 1:-1]  # ghosts are anything where nobody reads them
    return arrays


def compare_step(run, other):
    ours, theirs = compared(last_restart(run)), compared(last_restart(other))
    if last_restart(run).name != last_restart(other).name or ours.keys() != theirs.keys():
        raise Different("they ended at other steps, or hold other arrays")
    worst = {STEP: (0.0, "nothing"), FORCES: (0.0, "nothing")}
    for name, x in ours.items():
        y = theirs[name]
        if x.shape != y.shape or x.dtype.kind != "f" and not np.array_equal(x, y):
            raise Different(f"{name} differs: other grains or contacts")
        if x.dtype.kind == "f":
            scale = np.max(np.abs(x), initial=0.0)
            off = np.max(np.abs(x - y), initial=0.0) / (scale or 1.0)
            bound = FORCES if name in COARSE else STEP
            worst[bound] = max(worst[bound], (math.inf if math.isnan(off) else off, name))
    text = "; ".join(f"{what} {off:.2g} (in {name}, allowed {bound:g})" for what, bound, (off, name) in
                     (("flow and positions", STEP, worst[STEP]), ("forces and velocities", FORCES, worst[FORCES])))
    if any(off > bound for bound, (off, _) in worst.items()):
        raise Different(text)
    return text


def mean_of(path, column):
    """Over the second half of the time."""
    with open(path, encoding="utf-8") as file:
        lines = [line for line in csv.DictReader(file) if line.get("dune", "0") == "0"]
    values = [(float(line["t"]), float(line[column])) for line in lines]
    late = [value for t, value in values if t >= values[-1][0] / 2]
    return sum(late) / len(late)


def compare_statistics(run, other):
    parts, wrong = [], False
    for name, column, bound in MEANS:
        if (run / name).exists():
            ours, theirs = mean_of(run / name, column), mean_of(other / name, column)
            off = abs(ours - theirs) / abs(theirs)
            wrong = wrong or not off <= bound
            parts.append(f"{column} {off:.2g} ({bound:g})")
    text = "differences of means, allowed in brackets: " + ", ".join(parts)
    if wrong or not parts:
        raise Different(text)
    return text


COMPARE = {"bits": compare_bits, "step": compare_step, "statistics": compare_statistics}

if __name__ == "__main__":
    if len(sys.argv) != 4 or sys.argv[1] not in COMPARE:
        sys.exit(__doc__)
    try:
        print(COMPARE[sys.argv[1]](*map(pathlib.Path, sys.argv[2:])))
    except (Different, OSError, KeyError, IndexError, ValueError) as problem:
        sys.exit(f"{type(problem).__name__}: {problem}" if not isinstance(problem, Different) else str(problem))
