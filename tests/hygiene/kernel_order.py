#!/usr/bin/python3
"""Kernels do not depend on the order of their items. A short run in each order (as written, from the last item to the
first, shuffled and by threads as they are free) and with 1, 2 and 7 threads: grains alone give the same bits in all
of them, a coupled run with the same number of threads; with another one it differs by round-off.

usage: tests/hygiene/kernel_order.py    needs the program of the preset rehearsal (./barchan build)
"""
import os
import pathlib
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
os.environ.setdefault("BARCHAN_PROGRAM", str(ROOT / "build/rehearsal/barchan"))
sys.path += [str(ROOT / "tests/support"), str(ROOT / "tests/scripts")]

import determinism  # noqa: E402
import faults  # noqa: E402
import same_bits  # noqa: E402

ORDERS, THREADS = ("", "reversed", "shuffled"), (1, 2, 7)
DRY = """
[case]
title = "Grains that fall"
[time]
end = 0.002
grain_step = 2e-6
[domain]
size = [0.006, 0.006, 0.006]
[grains]
youngs_modulus = 1.25e6
rolling_friction = 0.05
sizes = [[1.5e-4, 100], [2e-4, 800], [2.5e-4, 100]]
[initial.grains.pour]
centre = [0.003, 0.003]
radius = 0.0018
[restart]
wall_interval = 0
"""


def run(words, folder, order, threads):
    environment = {**faults.ENVIRONMENT, "OMP_NUM_THREADS": str(threads), "BARCHAN_ORDER": order}
    done = subprocess.run([*words, "--threads", str(threads)], env=environment, capture_output=True, text=True,
                          timeout=900)
    faults.expect(done, 0)
    print(f"{folder.name}: done", flush=True)
    return folder


def same_restart(one, other):
    same_bits.compare(*map(faults.last_restart, (one, other)))


def in_all_orders(work, name, command):
    """Threads -> folders of runs in all orders."""
    runs = {}
    for threads in THREADS:
        for order in ORDERS:
            folder = work / f"{name}-{threads}-{order or 'as-written'}"
            runs.setdefault(threads, []).append(run(command(folder), folder, order, threads))
    return runs


def probe():
    """A program that depends on the order must say something else in each."""
    words = [ROOT / "build/rehearsal/sanitizer_probe", "depends_on_order"]
    said = {subprocess.run(words, env={**faults.ENVIRONMENT, "BARCHAN_ORDER": order}, capture_output=True, text=True,
                           check=True).stdout for order in ORDERS}
    if len(said) != len(ORDERS):
        faults.fail(f"orders make no difference where they must: {said}")


def main(work):
    if not pathlib.Path(os.environ["BARCHAN_PROGRAM"]).exists():
        faults.fail("no program of the preset rehearsal: BARCHAN_PRESET=rehearsal ./barchan build")
    probe()
    case = work / "dry.toml"
    case.write_text(DRY)
    dry = in_all_orders(work, "dry", lambda folder: [os.environ["BARCHAN_PROGRAM"], "run", str(case), "--quiet",
                                                     "--out", str(folder)])
    first, *others = [folder for runs in dry.values() for folder in runs]
    for other in others:
        same_restart(first, other)
    print(f"grains alone: {len(others) + 1} runs with the same bits")

    coupled = in_all_orders(work, "coupled", lambda folder: faults.command(folder, determinism.CASE))
    for first, *others in coupled.values():
        for other in others:
            same_restart(first, other)
    worst = max(determinism.largest_difference(coupled[1][0], coupled[threads][0]) for threads in THREADS[1:])
    print(f"coupled: the same bits in {len(ORDERS)} orders each; numbers of threads differ by {worst[0]:.2g} of the "
          f"largest value, in {worst[1]}")
    if not worst[0] <= determinism.LARGEST_DIFFERENCE:
        faults.fail(f"that is more than {determinism.LARGEST_DIFFERENCE}")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
