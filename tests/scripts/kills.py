#!/usr/bin/python3
"""Kills BARCHAN_KILLS (6) runs at random moments, half of them while a restart file is being written, and resumes
each to its end, often after one or two more kills. The results must be those of the run that nothing broke, bit
for bit."""
import collections
import os
import random
import signal
import time

import faults

BEING_WRITTEN = "restart_*.h5.tmp"


def wait_until_writing(process, folder, deadline):
    """Until a restart file is being written, at a random one of those to come."""
    for _ in range(random.randint(1, 30)):
        while process.poll() is None and time.monotonic() < deadline and not any(folder.glob(BEING_WRITTEN)):
            pass
        while process.poll() is None and time.monotonic() < deadline and any(folder.glob(BEING_WRITTEN)):
            if random.random() < 0.02:
                return


def kill_once(folder, restart, duration, while_writing):
    """Starts or resumes the run and kills it. Returns what it was doing, or None if it had ended by itself."""
    process = faults.start(folder, faults.OFTEN, restart)
    begin = time.monotonic()
    if while_writing:
        wait_until_writing(process, folder, begin + duration)
    else:
        time.sleep(random.uniform(0, duration))
    process.send_signal(signal.SIGKILL)
    process.wait()
    process.stderr.close()
    if process.returncode != -signal.SIGKILL:
        return None
    if any(folder.glob(BEING_WRITTEN)):
        return "writing a restart file"
    return "running" if faults.last_restart(folder) else "before the first restart file"


def main(work):
    n = int(os.environ.get("BARCHAN_KILLS", "6"))
    random.seed(1)
    begin = time.monotonic()
    faults.expect(faults.run(work / "whole", faults.OFTEN), 0)
    duration = time.monotonic() - begin
    survived = collections.Counter()
    while sum(survived.values()) < n:
        folder = work / f"killed_{sum(survived.values())}"
        again = 0
        while True:
            doing = kill_once(folder, faults.last_restart(folder), duration, random.random() < 0.5)
            if doing:
                survived[doing] += 1
                again += 1
            if doing is None or again == 3 or random.random() < 0.6:
                break
        if not faults.last_restart(folder) or doing:
            faults.expect(faults.run(folder, faults.OFTEN, faults.last_restart(folder)), 0)
        faults.same_run(work / "whole", folder)
    print(f"{sum(survived.values())} kills survived, results equal to the bit:",
          ", ".join(f"{count} {doing}" for doing, count in survived.items()))


if __name__ == "__main__":
    faults.in_a_new_folder(main)
