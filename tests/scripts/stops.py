#!/usr/bin/python3
"""A run that is asked to stop (SIGTERM, SIGINT, the wall-clock limit) writes a restart file,
ends with exit code 3 and says how to go on; going on gives the bits of the run that nobody stopped."""
import signal
import time

import faults

LONG = {**faults.OFTEN, "time.end": 0.25, "restart.interval": 0}


def wait_for_steps(folder, process):
    """Until the run is under way."""
    for _ in range(1000):
        table = folder / "history.csv"
        if table.exists() and table.read_text().count("\n") > 4:
            return
        if process.poll() is not None:
            break
        time.sleep(0.01)
    process.kill()
    faults.fail(f"{folder}: the run is not there: {process.stderr.read()}")


def check_stopped(folder, status, said):
    summary = faults.summary(folder)
    last = faults.last_restart(folder)
    if status != 3 or summary["status"] != "stopped" or not summary["message"] or last is None:
        faults.fail(f"{folder}: exit code {status}, {summary['status']}, {last}: {said}")


def main(work):
    faults.expect(faults.run(work / "whole", LONG), 0)
    for which in (signal.SIGTERM, signal.SIGINT):
        folder = work / which.name
        process = faults.start(folder, LONG)
        wait_for_steps(folder, process)
        process.send_signal(which)
        said = process.communicate(timeout=60)[1]
        check_stopped(folder, process.returncode, said)
        faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 0)
        faults.same_run(work / "whole", folder)
    folder = work / "limit"
    limit = {**LONG, "time.wall_clock_limit": 0.05}  # some steps of a thousand
    pieces = 6
    for _ in range(pieces):
        done = faults.run(folder, limit, faults.last_restart(folder))
        check_stopped(folder, done.returncode, done.stderr)
    faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 0)
    faults.same_run(work / "whole", folder)
    print(f"SIGTERM, SIGINT and {pieces} stops by the wall-clock limit: exit code 3, same bits in the end")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
