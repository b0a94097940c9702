#!/usr/bin/python3
"""Runs whose disk, a small file system, fills up: while results are written, while a restart file is, and before
the first one. Each ends with exit code 1 and one message, keeps the last
good restart file and no half of another, and goes on from it, once there is room, as if nothing had been."""
import pathlib
import re
import shutil
import subprocess
import sys

import faults

NO_SPACE = "No space left on device"


def fill(disk, leave):
    """A file that leaves so many bytes."""
    filler = disk / "filler"
    with open(filler, "wb", buffering=0) as file:
        while shutil.disk_usage(disk).free > leave + 65536:
            file.write(bytes(32768))
    return filler


def last_whole_restart(folder):
    """The last restart file; the program itself finds all of them whole."""
    for path in folder.glob("restart_*.h5"):
        told = subprocess.run([faults.PROGRAM, "info", path], capture_output=True, text=True)
        if told.returncode != 0:
            faults.fail(f"{path}: {told.stderr}")
    return faults.last_restart(folder)


def broken(disk, work, name, settings, leave, words):
    """A run on a disk with so much room left; then, with more room, the same to its end."""
    folder = disk / name
    whole = work / f"whole_{name}"
    faults.expect(faults.run(whole, settings), 0)
    filler = fill(disk, leave)
    done = faults.run(folder, settings)
    faults.expect(done, 1, NO_SPACE, *words)
    if done.stderr.count("error:") != 1:
        faults.fail(f"{name}: more than one message:\n{done.stderr}")
    left = list(folder.glob("*.tmp"))
    if left:
        faults.fail(f"{name}: half-written {left}")
    last = last_whole_restart(folder)
    said = re.search(r"last good restart is (\S+)", done.stderr)
    if (last is None) != (said is None) or (said and pathlib.Path(said[1]) != last):
        faults.fail(f"{name}: {last} is there, it said:\n{done.stderr}")
    filler.unlink()
    if last:  # the results so far and those to come need more than the small disk: elsewhere
        shutil.copytree(folder, work / name)
        folder = work / name
        faults.expect(faults.run(folder, settings, faults.last_restart(folder)), 0)
        faults.same_run(whole, folder)
    shutil.rmtree(disk / name)
    print(f"{name}: {done.stderr.strip().splitlines()[-1]}")
    return last


def main(folder):
    disk, work = folder / "disk", folder / "elsewhere"
    disk.mkdir()
    work.mkdir()
    mount = ["mount", "-t", "tmpfs", "-o", "size=4m", "tmpfs", str(disk)]
    if subprocess.run(mount, capture_output=True).returncode != 0:
        print("cannot mount a small tmpfs here")
        sys.exit(77)
    try:
        fill_disks(disk, work)
    finally:
        subprocess.run(["umount", str(disk)], check=False)


def fill_disks(disk, work):
    case = {**faults.OFTEN, "time.end": 0.02}
    # About 500 kB go into restart files, 20 kB into each frame.
    results = {**case, "output.grains_interval": 2.5e-4, "output.grain_forces": "true", "restart.interval": 2.5e-3}
    if not broken(disk, work, "while_results_are_written", results, 1_300_000, []):
        faults.fail("no restart file came before the disk was full")
    restarts = {**case, "restart.keep": 1000, "output.grains_interval": 0.02,
                "output.tracks_interval": 0.02, "output.fields_interval": 0.02}
    if not broken(disk, work, "while_a_restart_is_written", restarts, 1_500_000, ["restart_"]):
        faults.fail("no restart file came before the disk was full")
    broken(disk, work, "before_the_first_restart", case, 200_000, [])
    lost_output_is_told()


def lost_output_is_told():
    for words in (["keys"], ["check", "--resolved-only", str(faults.CASE)]):
        with open("/dev/full", "w") as full:
            done = subprocess.run([faults.PROGRAM, *words], stdout=full, stderr=subprocess.PIPE, text=True)
        faults.expect(done, 1, "cannot write to the terminal or where it leads")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
