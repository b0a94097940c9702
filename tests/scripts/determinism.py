#!/usr/bin/python3
"""Equal runs give equal bits, at another place in memory, with memory that held something
else before, and while other processes compete; with another number of threads they differ by round-off,
which is reported."""
import pathlib
import subprocess

import h5py
import numpy as np

import faults

CASE = {**faults.OFTEN, "time.end": 0.005, "output.grain_forces": "true"}
# Round-off after twenty fluid steps, the motion of the grains amplifies it from then on (docs/theory-grains.md).
LARGEST_DIFFERENCE = 1e-9


def run(folder, threads, before=(), **variables):
    environment = {**faults.ENVIRONMENT, "OMP_NUM_THREADS": str(threads), **variables}
    words = [*before, *faults.command(folder, CASE), "--threads", str(threads)]
    done = subprocess.run(words, env=environment, capture_output=True, text=True, timeout=300)
    faults.expect(done, 0)
    return folder


def all_at_once(folders, threads):
    for process in [faults.start(folder, CASE, threads=threads) for folder in folders]:
        said = process.communicate(timeout=300)[1]
        if process.returncode != 0:
            faults.fail(said)


def largest_difference(one, other):
    """Over all arrays of real numbers of the last restart files, each relative to its largest value."""
    worst = (0.0, "nothing")
    with h5py.File(faults.last_restart(one)) as a, h5py.File(faults.last_restart(other)) as b:
        if not np.array_equal(a["grains/id"][...], b["grains/id"][...]):
            faults.fail("the grains are in another order")
        for name in ("grains/kin", "grains/contact_force", "fluid/u_x", "fluid/p", "fluid/alpha_f"):
            x, y = a[name][...], b[name][...]
            if name.startswith("fluid/"):
                x, y = (field[1:-1, 1:-1, 1:-1] for field in (x, y))
            worst = max(worst, (np.max(np.abs(x - y)) / np.max(np.abs(x)), name))
    return worst


def main(work):
    randomised = pathlib.Path("/proc/sys/kernel/randomize_va_space").read_text().strip()
    firsts = []
    for threads in (1, 2):
        first = run(work / f"first_{threads}", threads)
        others = [run(work / f"again_{threads}", threads),
                  run(work / f"dirty_{threads}", threads, MALLOC_PERTURB_="165")]
        fixed = subprocess.run(["setarch", "-R", "true"], capture_output=True)
        if fixed.returncode == 0:
            others.append(run(work / f"fixed_{threads}", threads, before=["setarch", "-R"]))
        competing = [work / f"competing_{threads}_{n}" for n in range(2)]
        all_at_once(competing, threads)
        for other in others + competing:
            faults.same_run(first, other)
        firsts.append(first)
        print(f"{threads} thread(s): {len(others) + len(competing) + 1} runs with the same bits "
              f"(address-space randomisation {randomised})")
    difference, where = largest_difference(*firsts)
    print(f"1 and 2 threads: {difference:.2g} of the largest value, in {where}")
    if not difference <= LARGEST_DIFFERENCE:
        faults.fail(f"that is more than {LARGEST_DIFFERENCE}")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
