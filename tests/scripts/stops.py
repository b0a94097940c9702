#!/usr/bin/python3
"""A run that is asked to stop (SIGTERM, SIGINT, SIGHUP, several signals at once, the wall-clock limit) writes a restart
file, ends with exit code 3 and says how to go on; going on gives the bits of the run that nobody stopped, also in the
middle of a ramp of the flow. So does one that is asked while it sets up its case after a precursor case, or while it
waits for one that another process computes. A run whose output nobody reads ends as any other."""
import fcntl
import json
import signal
import subprocess
import time

import faults
import same_bits

LONG = {**faults.OFTEN, "time.end": 0.25, "restart.interval": 0}


def lines_of(folder):
    table = folder / "history.csv"
    return table.read_text().count("\n") if table.exists() else 1


def wait_for_steps(folder, process, before=1):
    """Until the run is under way, and its history has some lines more than `before`."""
    faults.wait_until(lambda: lines_of(folder) > before + 3, process, folder)


def check_stopped(folder, status, said):
    summary = faults.summary(folder)
    last = faults.last_restart(folder)
    if status != 3 or summary["status"] != "stopped" or not summary["message"] or last is None:
        faults.fail(f"{folder}: exit code {status}, {summary['status']}, {last}: {said}")


def stops_and_goes_on(folder, *stops):
    """A run is stopped again and again, each time by some signals right after one another, and goes on."""
    for signals in stops:
        before, last = lines_of(folder), faults.last_restart(folder)
        process = faults.start(folder, LONG, last)
        wait_for_steps(folder, process, before)
        for which in signals:
            process.send_signal(which)
        said = process.communicate(timeout=60)[1]
        check_stopped(folder, process.returncode, said)
        if faults.last_restart(folder) == last:
            faults.fail(f"{signals} left no restart file")
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
    faults.expect(faults.run(work / "short", faults.OFTEN), 0)
    command = faults.command(work / "closed", faults.OFTEN)
    closed = subprocess.run(["sh", "-c", 'exec "$0" "$@" <&- >&- 2>&-', *command], env=faults.ENVIRONMENT)
    spoken = [word for word in faults.command(work / "unread", faults.OFTEN) if word != "--quiet"]
    unread = subprocess.Popen(spoken, env=faults.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.DEVNULL)
    unread.stdout.close()
    for folder, status in ((work / "closed", closed.returncode), (work / "unread", unread.wait())):
        if status != 0:
            faults.fail(f"{folder}: exit code {status}")
        faults.same_run(work / "short", folder)


def goes_on_within_a_ramp(work):
    """The flow turns from x to z, and swings meanwhile; the run ends in the middle and goes on."""
    turning = {**faults.OFTEN, "fluid.mean_velocity": 0, "fluid.schedule":
               "[{time = 0, velocity = 0.2}, {time = 0.005, velocity = [0, 0.2], ramp = 0.03, "
               "amplitude = [0.05, 0.02], period = 0.02}]"}
    faults.expect(faults.run(work / "turned", turning), 0)
    faults.expect(faults.run(work / "halves", {**turning, "time.end": 0.02}), 0)
    faults.expect(faults.run(work / "halves", turning, faults.last_restart(work / "halves")), 0)
    faults.same_run(work / "turned", work / "halves")


FALL = """[time]
end = {end}
fluid_step = {step}
grain_step = 5e-6
[domain]
size = [0.012, 0.006, 0.006]
[grains]
youngs_modulus = 1.25e6
"""
POURED = FALL.format(end=0.005, step=2.5e-4) + """sizes = [[2e-4, 200]]
[initial.grains.pour]
centre = [0.008, 0.003]
radius = 0.0018
"""
FLUID = """[fluid]
cells = [60, 40, 24]
first_cell_height = 0
mean_velocity = 0.2
"""
FLOW = """[time]
end = 0.001
fluid_step = 2.5e-4
[domain]
size = [0.012, 0.006, 0.006]
""" + FLUID.replace("[60, 40, 24]", "[10, 14, 6]")
FINE = FALL.format(end=1e-3, step=2e-5) + FLUID + """[initial]
grains = "heap.toml"
fluid = """


def is_done(folder):
    """The run there has written its last restart file."""
    try:
        return faults.summary(folder)["status"] == "done"
    except (OSError, json.JSONDecodeError):
        return False


def command(work, name, *words):
    return [faults.PROGRAM, "run", work / f"{name}.toml", "--threads", "1", "--out", work / name, *words]


def start(work, name):
    """What it says goes to NAME.txt."""
    with open(work / f"{name}.txt", "w") as said:
        return subprocess.Popen(command(work, name), env=faults.ENVIRONMENT, stdout=said, stderr=subprocess.STDOUT)


def stops_during_a_set_up(work, delay):
    """The signal comes some seconds after the precursor case, before the first steps of the case."""
    work.mkdir()
    (work / "heap.toml").write_text(POURED)
    (work / "fine.toml").write_text(FINE + '"turbulent"\n')
    process = start(work, "fine")
    faults.wait_until(lambda: is_done(work / "heap"), process, work)
    time.sleep(delay)
    process.send_signal(signal.SIGTERM)
    code, said = process.wait(timeout=60), (work / "fine.txt").read_text()
    last = faults.last_restart(work / "fine")
    if code != 3 or "stopped on request" not in said:
        faults.fail(f"a signal {delay} s after the precursor case: exit code {code}: {said}")
    if last:  # there was a state already
        check_stopped(work / "fine", code, said)
    faults.expect(subprocess.run(command(work, "fine", *(["--restart", last] if last else [])), env=faults.ENVIRONMENT,
                                 capture_output=True, text=True), 0)
    return faults.last_restart(work / "fine")


def stops_while_it_waits(work, which, other):
    """For a precursor case that another process computes: this one, which holds the lock."""
    (work / other).mkdir(parents=True)
    (work / "heap.toml").write_text(POURED)
    (work / "flow.toml").write_text(FLOW)
    (work / "both.toml").write_text(FINE.replace("[60, 40, 24]", "[10, 14, 6]") + '"flow.toml"\n')
    with open(work / other / ".barchan.lock", "w") as lock:
        fcntl.flock(lock, fcntl.LOCK_EX)
        process = start(work, "both")
        said = work / "both.txt"
        faults.wait_until(lambda: "; waiting" in said.read_text(), process, work)
        process.send_signal(which)
        try:
            code = process.wait(timeout=20)
        except subprocess.TimeoutExpired:
            process.kill()
            code = "it goes on waiting"
    if code != 3 or "stopped on request" not in said.read_text() or (work / "both").exists():
        faults.fail(f"{which.name} while waiting for {other}: {code}: {said.read_text()}")


def main(work):
    ends = [stops_during_a_set_up(work / f"set_up_{delay}", delay) for delay in (0, 0.1, 0.3)]
    for other in ends[1:]:
        same_bits.compare(ends[0], other)
    stops_while_it_waits(work / "waits", signal.SIGINT, "heap")  # after its own flow.toml
    stops_while_it_waits(work / "waits_at_once", signal.SIGTERM, "flow")
    goes_on_within_a_ramp(work)
    faults.expect(faults.run(work / "whole", LONG), 0)
    stops_and_goes_on(work / "stopped", [signal.SIGTERM], [signal.SIGINT], [signal.SIGHUP],
                      [signal.SIGTERM, signal.SIGTERM, signal.SIGINT])
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
