#!/usr/bin/python3
"""A run that is asked to stop (SIGTERM, SIGINT, SIGHUP, several signals at once, the wall-clock limit) writes a restart
file, ends with exit code 3 and says how to go on; going on gives the bits of the run that nobody stopped, also in the
middle of a ramp of the flow. A run whose output nobody reads ends as any other."""
import signal
import subprocess

import faults

LONG = {**faults.OFTEN, "time.end": 0.25, "restart.interval": 0}


def wait_for_steps(folder, process):
    """Until the run is under way."""
    table = folder / "history.csv"
    faults.wait_until(lambda: table.exists() and table.read_text().count("\n") > 4, process, folder)


def check_stopped(folder, status, said):
    summary = faults.summary(folder)
    last = faults.last_restart(folder)
    if status != 3 or summary["status"] != "stopped" or not summary["message"] or last is None:
        faults.fail(f"{folder}: exit code {status}, {summary['status']}, {last}: {said}")


def stop(folder, signals):
    """Stops a run by these signals, one right after the other, and goes on with it."""
    process = faults.start(folder, LONG)
    wait_for_steps(folder, process)
    for which in signals:
        process.send_signal(which)
    said = process.communicate(timeout=60)[1]
    check_stopped(folder, process.returncode, said)
    faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 0)
    faults.same_run(folder.parent / "whole", folder)


def ignores_a_hangup_under_nohup(folder):
    process = subprocess.Popen(["nohup", *faults.command(folder, LONG)], env=faults.ENVIRONMENT,
                               stdout=subprocess.DEVNULL, stderr=subprocess.PIPE, text=True)
    wait_for_steps(folder, process)
    process.send_signal(signal.SIGHUP)
    said = process.communicate(timeout=60)[1]
    if process.returncode != 0:
        faults.fail(f"nohup: exit code {process.returncode}: {said}")


def runs_without_readers(work):
    """Standard streams that are closed, and a reader of the output that goes away (`| head`)."""
    command = faults.command(work / "closed", LONG)
    closed = subprocess.run(["sh", "-c", 'exec "$0" "$@" <&- >&- 2>&-', *command], env=faults.ENVIRONMENT)
    spoken = [word for word in faults.command(work / "unread", LONG) if word != "--quiet"]
    unread = subprocess.Popen(spoken, env=faults.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    unread.stdout.close()
    for folder, status in ((work / "closed", closed.returncode), (work / "unread", unread.wait())):
        if status != 0:
            faults.fail(f"{folder}: exit code {status}")
        faults.same_run(work / "whole", folder)


def goes_on_within_a_ramp(work):
    """The flow turns from x to z, and swings meanwhile; the run ends in the middle and goes on."""
    turning = {**faults.OFTEN, "fluid.mean_velocity": 0, "fluid.schedule":
               "[{time = 0, velocity = 0.2}, {time = 0.005, velocity = [0, 0.2], ramp = 0.03, "
               "amplitude = [0.05, 0.02], period = 0.02}]"}
    faults.expect(faults.run(work / "turned", turning), 0)
    faults.expect(faults.run(work / "halves", {**turning, "time.end": 0.02}), 0)
    faults.expect(faults.run(work / "halves", turning, faults.last_restart(work / "halves")), 0)
    faults.same_run(work / "turned", work / "halves")


def main(work):
    goes_on_within_a_ramp(work)
    faults.expect(faults.run(work / "whole", LONG), 0)
    for which in (signal.SIGTERM, signal.SIGINT, signal.SIGHUP):
        stop(work / which.name, [which])
    stop(work / "several", [signal.SIGTERM, signal.SIGTERM, signal.SIGINT])
    ignores_a_hangup_under_nohup(work / "nohup")
    runs_without_readers(work)
    folder = work / "limit"
    limit = {**LONG, "time.wall_clock_limit": 0.05}  # some steps of a thousand
    pieces = 6
    for _ in range(pieces):
        done = faults.run(folder, limit, faults.last_restart(folder))
        check_stopped(folder, done.returncode, done.stderr)
    faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 0)
    faults.same_run(work / "whole", folder)
    print(f"signals, several at once and {pieces} stops by the wall-clock limit: exit code 3, same bits in the end")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
