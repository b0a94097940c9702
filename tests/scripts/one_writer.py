#!/usr/bin/python3
"""Nothing is lost by a habit: a second run in a folder, the same command again, a folder of somebody else's files, two
cases that share a start. And two runs that fight for one folder while BARCHAN_KILLS (2) of them are killed."""
import os
import random
import shutil
import signal
import subprocess
import sys
import time
from pathlib import Path

import h5py

import faults

ROOT = Path(__file__).parents[2]
LONG = {**faults.OFTEN, "time.end": 0.25}
SHARED = """
[time]
end = {end}
fluid_step = 2.5e-4
{step}[domain]
size = [0.012, 0.006, 0.006]
"""
GRAIN_STEP = "grain_step = 5e-6\n"
FLUID = """[fluid]
cells = [10, 14, 6]
first_cell_height = 2.6e-4
mean_velocity = 0.2
"""
GRAINS = """[grains]
youngs_modulus = 1.25e6
"""
POURED = """sizes = [[2e-4, 200]]
[initial.grains.pour]
centre = [0.008, 0.003]
radius = 0.0018
"""


def content(folder):
    """Every file of a folder; its bytes and when it was last written."""
    return {path.name: (path.read_bytes(), path.stat().st_mtime_ns) for path in folder.iterdir() if path.is_file()}


def wait_for_restart(folder, process):
    faults.wait_until(lambda: faults.last_restart(folder), process, folder)


def refuses_a_second_run(work):
    faults.expect(faults.run(work / "whole", LONG), 0)
    folder = work / "one"
    first = faults.start(folder, LONG)
    wait_for_restart(folder, first)
    holder = f"is in use by process {first.pid} on "
    for settings in (LONG, {**LONG, "initial.seed": 7}):
        faults.expect(faults.run(folder, settings), 2, holder, "take another --out")
    faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 2, holder)
    said = first.communicate(timeout=120)[1]
    if first.returncode != 0:
        faults.fail(f"the first run ended with {first.returncode}: {said}")
    faults.same_run(work / "whole", folder)
    if (folder / ".barchan.lock").exists():
        faults.fail("the lock is still there")


def refuses_a_sweep(work):
    """A case of a study that somebody runs by hand; and one whose folder has results of another configuration."""
    (work / "study.toml").write_text(f"""[study]
base = "{faults.CASE}"
[[case]]
name = "one"
""")
    command = [sys.executable, "-m", "barchan", "sweep", faults.PROGRAM, work / "study.toml", "--out", work / "study",
               "--no-pictures", "--threads", "1"]
    by_hand = faults.start(work / "study/one", LONG)
    wait_for_restart(work / "study/one", by_hand)
    faults.expect(sweep(command), 2, f"is in use by process {by_hand.pid}")
    if by_hand.wait() != 0:
        faults.fail(f"the run beside a sweep ended with {by_hand.returncode}: {by_hand.stderr.read()}")
    faults.same_run(work / "whole", work / "study/one")
    before = faults.last_restart(work / "study/one").read_bytes()
    changed = sweep(command)
    if changed.returncode != 1 or "of another configuration" not in changed.stdout:
        faults.fail(f"a sweep over another configuration: {changed.returncode}, {changed.stdout}")
    if faults.last_restart(work / "study/one").read_bytes() != before:
        faults.fail("the sweep removed it")
    faults.expect(sweep([*command, "--overwrite"]), 0)


def sweep(command):
    return subprocess.run(command, env=faults.ENVIRONMENT, capture_output=True, text=True)


def keeps_what_the_same_command_would_remove(work):
    folder = work / "again"
    limited = {**LONG, "time.wall_clock_limit": 0.1}
    faults.expect(faults.run(folder, limited), 3)
    before = content(folder)
    said = ("holds an unfinished run:", "--resume", "--overwrite")
    faults.expect(faults.run(folder, limited), 2, *said)
    faults.expect(faults.run(folder, faults.OFTEN), 2, "an unfinished run of another configuration")
    if content(folder) != before:
        faults.fail("a refused run changed the folder")
    faults.expect(faults.run(folder, LONG, faults.last_restart(folder)), 0)
    before = content(folder)
    done = faults.run(folder, LONG)
    faults.expect(done, 0)
    if content(folder) != before:
        faults.fail("a finished run was not left as it is")
    faults.expect(faults.run(folder, {**LONG, "initial.seed": 7}), 2, "holds a finished run of another configuration")
    faults.expect(faults.run(folder, faults.OFTEN, "--overwrite"), 0)
    faults.expect(faults.run(work / "fresh", faults.OFTEN), 0)
    faults.same_run(work / "fresh", folder)


def leaves_files_of_others(work):
    folder = work / "desk"
    folder.mkdir()
    for name in ("log.txt", "notes.tmp", "statistics.csv", "tracks.h5", "thesis.txt"):
        (folder / name).write_text("mine\n")
    before = content(folder)
    faults.expect(faults.run(folder, {}), 2, "in it is not of a run", "take another --out")
    if content(folder) != before:
        faults.fail("a refused run touched files of others")
    for name in ("log.txt", "statistics.csv", "tracks.h5"):
        (folder / name).unlink()
    faults.expect(faults.run(folder, {}), 0)
    if any((folder / name).read_text() != "mine\n" for name in ("notes.tmp", "thesis.txt")):
        faults.fail("a run removed files of others")


def write_cases(work, names):
    """Cases that start from one flow and one heap."""
    work.mkdir()
    (work / "chan.toml").write_text(SHARED.format(end=0.3, step="") + FLUID + '[initial]\nfluid = "turbulent"\n')
    (work / "heap.toml").write_text(SHARED.format(end=0.01, step=GRAIN_STEP) + GRAINS + POURED)
    for name in names:
        starts = '[initial]\nfluid = "chan.toml"\ngrains = "heap.toml"\n'
        (work / f"{name}.toml").write_text(SHARED.format(end=0.002, step=GRAIN_STEP) + FLUID + GRAINS + starts)


def start_case(work, name):
    return subprocess.Popen([faults.PROGRAM, "run", work / f"{name}.toml", "--out", work / "runs" / name],
                            env=faults.ENVIRONMENT, stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True)


def ended(process):
    said = process.communicate(timeout=120)[0]
    if process.returncode != 0:
        faults.fail(f"a case ended with {process.returncode}: {said}")
    return said


def shares_starts(work):
    """Cases begun together: whoever comes second waits, then uses what the first has made."""
    names = ("x", "y", "z")
    write_cases(work / "shared", names)
    said = [ended(process) for process in [start_case(work / "shared", name) for name in names]]
    if not any("is being computed by process" in words for words in said):
        faults.fail("no case waited: " + "\n".join(said))
    made = [words.count("first the case it starts from") for words in said]
    if sum(made) != 2:
        faults.fail(f"two starts were made {made} times")
    for name in names[1:]:
        same = [faults.last_restart(work / "shared/runs" / one) for one in (names[0], name)]
        faults.same_bits.compare(*same)


def keeps_the_older_start(work):
    """A start whose case has changed is made again beside the old one; a damaged one in its place."""
    folder = work / "changed"
    write_cases(folder, ("x",))
    ended(start_case(folder, "x"))
    old = content(folder / "runs/heap")
    heap = folder / "heap.toml"
    heap.write_text(heap.read_text().replace("1.25e6", "1.3e6"))
    shutil.rmtree(folder / "runs/x")
    said = ended(start_case(folder, "x"))
    if "they are now in" not in said or content(folder / "runs/heap.old1") != old:
        faults.fail(f"the older start is gone: {said}")
    faults.last_restart(folder / "runs/heap").unlink()  # "done", but nothing to start from
    shutil.rmtree(folder / "runs/x")
    if "first the case it starts from" not in ended(start_case(folder, "x")):
        faults.fail("a start without its last state was taken for one that is done")


def run_here(folder, name, *options):
    return subprocess.run([faults.PROGRAM, "run", folder / f"{name}.toml", "--out", folder / "runs" / name, *options],
                          env=faults.ENVIRONMENT, capture_output=True, text=True, timeout=120)


def takes_for_done(folder, name):
    done = run_here(folder, name)
    if done.returncode != 0 or "finished; --overwrite" not in done.stdout + done.stderr:
        faults.fail(f"{name} was not taken for done: {done.stdout}{done.stderr}")


def grains_at(folder, name):
    with h5py.File(faults.last_restart(folder / "runs" / name)) as file:
        return file["grains/kin"][:]


def notices_what_it_came_from(work):
    """Results of an edited table, of an edited start, and of a start that starts from one, are not those of now."""
    folder = work / "inputs"
    folder.mkdir()
    shared = SHARED.format(end=0.002, step=GRAIN_STEP) + GRAINS
    (folder / "heap.toml").write_text(shared + POURED)
    for name, start in dict(table="grains.csv", dune="heap.toml", third="dune.toml").items():
        (folder / f"{name}.toml").write_text(shared + f'[initial]\ngrains = "{start}"\n')
    table, heap = folder / "grains.csv", folder / "heap.toml"
    table.write_text("id,diameter,x,y,z\n1,2e-4,0.006,0.001,0.003\n")
    for name in ("table", "third"):
        faults.expect(run_here(folder, name), 0)
        before = content(folder / "runs" / name)
        takes_for_done(folder, name)
        if content(folder / "runs" / name) != before:
            faults.fail(f"the finished run {name} was not left as it is")
    old = {name: grains_at(folder, name) for name in ("table", "third")}

    table.write_text(table.read_text().replace("0.001", "0.002"))
    faults.expect(run_here(folder, "table"), 2, f"holds a finished run from another content of {table}: go on with",
                  "begin again with --overwrite")
    last = faults.last_restart(folder / "runs/table")
    longer = ("--set", "time.end=0.003", "--restart", last)
    goes_on = run_here(folder, "table", *longer)
    faults.expect(goes_on, 0)
    if f"{table} has changed" not in goes_on.stdout + goes_on.stderr:
        faults.fail(f"a restart did not tell of the table: {goes_on.stdout}{goes_on.stderr}")
    faults.expect(run_here(folder, "table", *longer[:2]), 2, f"from another content of {table}")
    faults.expect(run_here(folder, "table", "--overwrite"), 0)
    if abs(grains_at(folder, "table")[0, 1] - old["table"][0, 1] - 0.001) > 1e-9:
        faults.fail("the run did not begin from the edited table")

    heap.write_text(heap.read_text().replace("200", "150"))
    faults.expect(run_here(folder, "third"), 2, f"holds a finished run from another content of {heap}")
    done = run_here(folder, "third", "--overwrite")
    faults.expect(done, 0)
    if len(grains_at(folder, "third")) != 150 or not (folder / "runs/heap.old1").is_dir():
        faults.fail(f"the edited heap did not reach the third case: {done.stdout}")
    (folder / "runs/third/config.inputs.json").unlink()  # as of an earlier version: nothing is known
    heap.write_text(heap.read_text().replace("150", "200"))
    takes_for_done(folder, "third")


def survives_a_fight(work):
    """Two at once want a folder, one of them is killed, and again, until one says that it is done."""
    n, killed, refused = int(os.environ.get("BARCHAN_KILLS", "2")), 0, 0
    random.seed(2)
    faults.expect(faults.run(work / "unbroken", faults.OFTEN), 0)
    for fight in range(1000):
        folder = work / f"fight_{fight}"
        while True:
            pair = [faults.start(folder, faults.OFTEN, faults.last_restart(folder)) for _ in range(2)]
            time.sleep(random.uniform(0, 1.2))
            for process in pair:
                if killed < n and random.random() < 0.7:
                    process.send_signal(signal.SIGKILL)
            codes = [process.wait() for process in pair]
            for process in pair:
                said = process.stderr.read()
                process.stderr.close()
                if process.returncode not in (0, 2, -signal.SIGKILL):
                    faults.fail(f"a run ended with {process.returncode}: {said}")
            killed += codes.count(-signal.SIGKILL)
            refused += codes.count(2)
            if 0 in codes:
                break
        faults.same_run(work / "unbroken", folder)
        if killed >= n:
            break
    print(f"{killed} kills in {fight + 1} fights, {refused} refused, results equal to the bit")


def main(work):
    refuses_a_second_run(work)
    refuses_a_sweep(work)
    keeps_what_the_same_command_would_remove(work)
    leaves_files_of_others(work)
    shares_starts(work)
    keeps_the_older_start(work)
    notices_what_it_came_from(work)
    survives_a_fight(work)


if __name__ == "__main__":
    faults.in_a_new_folder(main)
