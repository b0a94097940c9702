#!/usr/bin/python3
"""Kills (SIGKILL) a run whose tracks.h5 holds 2,050 frames and more, BARCHAN_KILLS (50) times while it writes more of
them. After each kill h5py and the program read every frame, and the run goes on; it ends with the bits of one that
nobody killed."""
import os
import random
import shutil
import signal
import subprocess
import time

import faults
import h5py
import same_bits

FRAMES, MORE = 2050, 450  # frames before, and those of the run that is killed
STEP = 2.5e-4
CASE = """[time]
fluid_step = 2.5e-4
grain_step = 5e-6
[domain]
size = [0.012, 0.006, 0.006]
[grains]
youngs_modulus = 1.25e6
sizes = [[2e-4, 6]]
[grains.ambient]
[initial.grains.pour]
centre = [0.006, 0.003]
radius = 0.0018
[output]
grains_interval = 0
dune_interval = 0
history_interval = 0.05
tracks_interval = 2.5e-4
[restart]
wall_interval = 0
interval = 0.0025
"""


def command(work, folder, frames, restart=None):
    words = [faults.PROGRAM, "run", work / "case.toml", "--threads", "1", "--quiet", "--out", folder,
             "--set", f"time.end={(frames - 1) * STEP}"]
    return words + (["--restart", restart] if restart else [])


def run(*arguments):
    faults.expect(subprocess.run(command(*arguments), env=faults.ENVIRONMENT, capture_output=True, text=True), 0)


def times(path):
    """Of all frames that h5py finds, in order."""
    with h5py.File(path) as file:
        groups = [file, *(file[name] for name in file if name.startswith("frame_group_"))]
        return sorted(float(group[name].attrs["time"]) for group in groups for name in group
                      if name.startswith("frame_0"))


def bits(path):
    """Of all arrays, which h5py reads, and when they are of."""
    return {name: values.tobytes() for name, values in same_bits.arrays(path).items()}


def kill(work, folder, number):
    """Goes on and kills that. Returns how many frames were there then; None if the run had ended before."""
    tracks, last = folder / "tracks.h5", faults.last_restart(folder)
    process = subprocess.Popen(command(work, folder, FRAMES + MORE, last), env=faults.ENVIRONMENT,
                               stderr=subprocess.DEVNULL)
    size, inode = tracks.stat().st_size, tracks.stat().st_ino
    while process.poll() is None and (tracks.stat().st_size <= size or tracks.stat().st_ino != inode):
        if tracks.stat().st_ino != inode:  # frames after the restart were dropped
            size, inode = tracks.stat().st_size, tracks.stat().st_ino
        time.sleep(0.001)
    time.sleep(random.uniform(0, 0.1))
    process.send_signal(signal.SIGKILL)
    if process.wait() != -signal.SIGKILL:
        return None
    there = times(tracks)
    least = int(last.stem.removeprefix("restart_")) + 1
    if len(there) < least or any(abs(t - k * STEP) > 1e-9 for k, t in enumerate(there)):
        faults.fail(f"kill {number}: {len(there)} frames, expected at least {least}, one a step")
    said = subprocess.run([faults.PROGRAM, "info", tracks], env=faults.ENVIRONMENT, capture_output=True, text=True)
    faults.expect(said, 0)
    if f"frames   {len(there)}:" not in said.stdout:
        faults.fail(f"kill {number}: info sees other frames: {said.stdout}")
    print(f"kill {number}: {len(there)} frames", flush=True)
    return len(there)


def main(work):
    kills = int(os.environ.get("BARCHAN_KILLS", "50"))
    random.seed(3)
    (work / "case.toml").write_text(CASE)
    run(work, work / "before", FRAMES)
    shutil.copytree(work / "before", work / "whole")
    run(work, work / "whole", FRAMES + MORE, faults.last_restart(work / "whole"))
    whole, seen = bits(work / "whole/tracks.h5"), []
    while len(seen) < kills:
        folder = work / f"killed_{len(seen)}"
        shutil.copytree(work / "before", folder)
        while len(seen) < kills and (there := kill(work, folder, len(seen) + 1)):
            seen.append(there)
        run(work, folder, FRAMES + MORE, faults.last_restart(folder))
        same_bits.compare(faults.last_restart(work / "whole"), faults.last_restart(folder))
        if bits(folder / "tracks.h5") != whole:
            faults.fail("other frames in the end")
    print(f"{len(seen)} kills of a run with {min(seen)} to {max(seen)} frames, {len(set(seen))} different numbers: all "
          "frames readable, nothing lost, the same bits in the end")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
