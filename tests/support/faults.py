"""What the scripts that break runs share: the small coupled case, its unbroken run, and what a run that was
broken and resumed must have in common with it: every bit of the state, every line and every frame."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

import same_bits

CASE = pathlib.Path(__file__).parent / "small_dune.toml"
PROGRAM = os.environ["BARCHAN_PROGRAM"]
# A restart file every second step, so that a good part of the time goes into writing them.
OFTEN = {"time.end": 0.04, "restart.interval": 5e-4, "output.grains_interval": 1e-3,
         "output.fields_interval": 2.5e-3, "output.history_interval": 7.5e-4, "output.tracks_interval": 1e-3}
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}


def command(folder, settings, restart=None):
    words = [PROGRAM, "run", str(CASE), "--quiet", "--out", str(folder)]
    for key, value in settings.items():
        words += ["--set", f"{key}={value}"]
    if restart == "--overwrite":
        return [*words, restart]
    return words + (["--restart", str(restart)] if restart else [])


def run(folder, settings, restart=None, **options):
    return subprocess.run(command(folder, settings, restart), env=ENVIRONMENT, capture_output=True, text=True,
                          timeout=300, **options)


def start(folder, settings, restart=None, threads=1):
    environment = {**ENVIRONMENT, "OMP_NUM_THREADS": str(threads), "OMP_WAIT_POLICY": "passive"}
    return subprocess.Popen(command(folder, settings, restart), env=environment, stdout=subprocess.DEVNULL,
                            stderr=subprocess.PIPE, text=True)


def wait_until(happened, process, folder):
    """Until happened() is true; fails if the run ends before that, or in half a minute."""
    end = time.monotonic() + 30
    while not happened():
        if process.poll() is not None or time.monotonic() > end:
            process.kill()
            fail(f"{folder}: the run did not come so far: {process.stderr.read()}")
        time.sleep(0.005)


def summary(folder):
    """What run.json says."""
    return json.loads((pathlib.Path(folder) / "run.json").read_text())


def in_a_new_folder(test):
    """Calls test(folder); the folder goes with it."""
    with tempfile.TemporaryDirectory() as name:
        test(pathlib.Path(name))


def last_restart(folder):
    return max(pathlib.Path(folder).glob("restart_*.h5"), default=None)


def fail(message):
    sys.exit(f"FAILED: {message}")


def expect(done, status, *words):
    """The program ended with this status and said these words, in one message."""
    if done.returncode != status or any(word not in done.stderr for word in words):
        fail(f"exit code {done.returncode}, expected {status} and {words}; it said:\n{done.stderr}")


def same_run(one, other):
    """The last restart files, all frames and all tables of two finished runs hold the same bits."""
    one, other = pathlib.Path(one), pathlib.Path(other)
    if last_restart(one).name != last_restart(other).name:
        fail(f"{one} and {other} ended at other steps")
    for name in (last_restart(one).name, "grains.h5", "fields.h5", "tracks.h5"):
        same_bits.compare(one / name, other / name)
    for name in ("history.csv", "dune.csv", *(path.name for path in one.glob("heaps.csv"))):
        if (one / name).read_bytes() != (other / name).read_bytes():
            fail(f"{name} of {one} and {other} differ")
    left = [path.name for path in other.glob("*.tmp")]
    if left:
        fail(f"{other} still has {left}")
