#!/usr/bin/python3
"""Kills studies BARCHAN_KILLS (50) times at random moments: the study and its cases, or the study, or one case alone.
The same command then goes on to the end. Every case, and the table, must be those of the study that nothing broke."""
import collections
import os
import pathlib
import random
import signal
import subprocess
import sys
import time

import faults
import same_bits

CASES = ("base", "sliding_friction-0.6", "restitution-0.5", "rolling_friction-0.1")
STUDY = f"""[study]
title = "a small dune, rubbed"
base = "{faults.CASE}"
at_once = 2
threads = 1
[set]
restart.interval = 1e-3
grains.sliding_friction = 0.5
grains.restitution = 0.1
[vary]
grains.sliding_friction = [0.5, 0.6]
grains.restitution = [0.1, 0.5]
grains.rolling_friction = [0.05, 0.1]
"""


def start(work, folder):
    return subprocess.Popen([sys.executable, "-m", "barchan", "sweep", faults.PROGRAM, str(work / "study.toml"),
                             "--no-pictures", "--out", str(folder)], env=faults.ENVIRONMENT, start_new_session=True,
                            stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def finish(work, folder):
    """Calls the command until no case is still held by a program that outlived its study."""
    for _ in range(20):
        study = start(work, folder)
        said, _ = study.communicate(timeout=300)
        if study.returncode == 0:
            return
        time.sleep(1)
    faults.fail(f"{folder}: the study does not go on: {said}")


def cases_of(study):
    found = pathlib.Path(f"/proc/{study.pid}/task/{study.pid}/children").read_text().split()
    return [int(pid) for pid in found]


def kill_once(work, folder, duration):
    """Starts the study or goes on with it, and kills; returns what was killed, or None if all was done before."""
    study = start(work, folder)
    time.sleep(random.uniform(0, duration))
    what = random.choice(("all", "study", "case"))
    if study.poll() is not None:
        study.communicate()
        return None
    if what == "case":
        cases = cases_of(study)
        if cases:
            os.kill(random.choice(cases), signal.SIGKILL)
        study.communicate(timeout=300)
        return what if cases else None
    (os.killpg if what == "all" else os.kill)(study.pid, signal.SIGKILL)
    study.communicate()
    return what


def table(folder):
    """The table of the study without times of the machine."""
    return [line.split(",")[:4] for line in (folder / "study.csv").read_text().splitlines()]


def main(work):
    n = int(os.environ.get("BARCHAN_KILLS", "50"))
    random.seed(1)
    (work / "study.toml").write_text(STUDY)
    begin = time.monotonic()
    finish(work, work / "whole")
    duration = time.monotonic() - begin
    survived = collections.Counter()
    while sum(survived.values()) < n:
        folder = work / f"killed_{sum(survived.values())}"
        for _ in range(random.randint(2, 6)):
            what = kill_once(work, folder, duration)
            if what is None:
                break
            survived[what] += 1
        finish(work, folder)
        for case in CASES:
            one, other = work / "whole" / case, folder / case
            for name in (faults.last_restart(one).name, "grains.h5", "fields.h5"):
                same_bits.compare(one / name, other / name)
            for name in ("history.csv", "dune.csv"):
                if (one / name).read_bytes() != (other / name).read_bytes():
                    faults.fail(f"{name} of {one} and {other} differ")
        if table(folder) != table(work / "whole"):
            faults.fail(f"{folder}/study.csv differs")
    print(f"{sum(survived.values())} kills survived, cases equal to the bit:",
          ", ".join(f"{count} of {what}" for what, count in survived.items()))


if __name__ == "__main__":
    faults.in_a_new_folder(main)
