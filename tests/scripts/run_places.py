#!/usr/bin/python3
"""Where results go: cases of one name in two folders below configs do not meet, and share the case that both start
from, also on two ranks and with --out beside; results in the folder of an earlier version are not computed again."""
import os
import subprocess
import sys
import tempfile
from pathlib import Path

CONFIGS = "configs"
DUNE_A, DUNE_B, DUNE_C = (f"{CONFIGS}/{folder}/dune.toml" for folder in "abc")
PROGRAM = os.environ["BARCHAN_PROGRAM"]
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
HEAP = """[case]
title = "few grains"
[time]
end = 0.01
fluid_step = 1e-3
grain_step = 1e-5
[domain]
size = [0.02, 0.02, 0.02]
[grains]
youngs_modulus = 3e5
sizes = [[2e-4, 50]]
[initial]
grains = { pour = { centre = [0.01, 0.01], radius = 0.003 } }
"""
DUNE = "".join(line + "\n" for line in HEAP.splitlines() if not line.startswith(("sizes", "grains =")))
STUDY = '[study]\ntitle = "{0}"\nbase = "dune.toml"\n[[case]]\nname = "one"\nset = {{ grains.restitution = 0.2 }}\n'
ONE_RANK = [PROGRAM]
TWO_RANKS = ["mpirun", "--quiet", "--allow-run-as-root", "--oversubscribe", "-np", "2", PROGRAM]


def call(work, status, *words):
    """What a command says that is to end with `status`."""
    done = subprocess.run(words, cwd=work, env=ENVIRONMENT, capture_output=True, text=True)
    said = done.stdout + done.stderr
    if done.returncode != status:
        sys.exit(f"FAILED: {' '.join(map(str, words))} ended with {done.returncode}, not {status}: {said}")
    return said


def check(what, right):
    if not right:
        sys.exit(f"FAILED: {what}")


def runs_in(work):
    return {str(path.parent.relative_to(work)) for path in work.rglob("run.json")}


def write_cases(work):
    for folder, title in (("a", "small"), ("b", "large")):
        (work / "configs" / folder).mkdir(parents=True)
        (work / f"configs/{folder}/dune.toml").write_text(DUNE + 'grains = "../c/heap.toml"\n')
        (work / f"configs/{folder}/sizes.toml").write_text(STUDY.format(title))
    (work / "configs/c").mkdir()
    (work / "configs/c" / "heap.toml").write_text(HEAP)
    (work / DUNE_C).write_text(DUNE + 'grains = "heap.toml"\n')


def one_start_for_both(work):
    call(work, 0, *ONE_RANK, "run", DUNE_A)
    first = (work / "runs/c/heap/run.json").stat().st_mtime_ns
    call(work, 0, *TWO_RANKS, "run", DUNE_B)
    call(work / "configs", 0, *ONE_RANK, "run", "b/dune.toml", "--out", "../runs/b/again")  # beside: the same place
    check(f"run folders: {runs_in(work)}",
          runs_in(work) == {"runs/a/dune", "runs/b/dune", "runs/b/again", "runs/c/heap"})
    check("the shared start was computed twice", (work / "runs/c/heap/run.json").stat().st_mtime_ns == first)
    call(work, 0, *ONE_RANK, "run", DUNE_A, "--out", "elsewhere/x/")
    check(f"with --out: {runs_in(work / 'elsewhere')}", runs_in(work / "elsewhere") == {"x", "c/heap"})
    said = call(work, 0, sys.executable, "-m", "barchan", "list")
    check(f"list: {said}", all(f"\n{name} " in said for name in ("a/dune", "b/dune", "c/heap")))
    said = call(work, 2, *ONE_RANK, "run", DUNE_C, "--out", "runs/c/heap", "--overwrite")
    check(f"a run over its own start: {said}", "the results of that case go to the folder of this one" in said)


def results_of_an_earlier_version(work):
    (work / "runs/a/dune").rename(work / "runs/dune")
    for start in (ONE_RANK, TWO_RANKS):
        said = call(work, 2, *start, "run", DUNE_A)
        check(f"it says: {said}", "mkdir -p runs/a; mv runs/dune runs/a/dune\n" in said)
        check("something was made", not (work / "runs/a/dune").exists())
    call(work, 0, *ONE_RANK, "run", DUNE_A, "--set", "grains.restitution=0.3")  # another case: not there
    call(work, 0, "rm", "-r", "runs/a/dune")
    call(work, 0, "mv", "runs/dune", "runs/a/dune")
    said = call(work, 0, *ONE_RANK, "run", DUNE_A)
    check(f"the moved run: {said}", "already holds this run" in said)
    (work / "runs/c/heap").rename(work / "runs/heap")
    said = call(work, 0, *ONE_RANK, "run", DUNE_A)  # done: nothing needs its start
    said = call(work, 2, *ONE_RANK, "run", DUNE_A, "--out", "runs/a/new")
    check(f"of a start it says: {said}", "mv runs/heap runs/c/heap\n" in said)
    call(work, 0, *ONE_RANK, "run", DUNE_A, "--out", "runs/a/new", "--overwrite")
    check("with --overwrite the start was not computed", (work / "runs/c/heap/run.json").exists())


def studies(work):
    sweep = [sys.executable, "-m", "barchan", "sweep", PROGRAM]
    for folder in ("a", "b"):
        call(work, 0, *sweep, f"configs/{folder}/sizes.toml", "--no-pictures")
        check(f"the study of {folder}", (work / f"runs/{folder}/sizes/one/run.json").exists())
    (work / "runs/a/sizes").rename(work / "runs/sizes")
    said = call(work, 2, *sweep, f"{CONFIGS}/a/sizes.toml", "--no-pictures")
    check(f"of a study it says: {said}", "mkdir -p runs/a; mv runs/sizes runs/a/sizes\n" in said)
    (work / "runs/b/sizes").rename(work / "runs/kept")
    call(work, 0, *sweep, f"{CONFIGS}/b/sizes.toml", "--no-pictures")  # runs/sizes is of another study


def without_a_place_for_others(work):
    """One process leaves nothing where MPI keeps its files, so runs that start together cannot meet there."""
    (work / "there").mkdir()
    for place in ("there", "gone"):
        with_place = {**ENVIRONMENT, "TMPDIR": str(work / place)}
        done = subprocess.run([PROGRAM, "check", DUNE_C], cwd=work, env=with_place, capture_output=True, text=True)
        check(f"with TMPDIR {place}: {done.stderr}", done.returncode == 0)
    check("MPI's folder is not empty", not any((work / "there").iterdir()))


with tempfile.TemporaryDirectory() as name:
    folder = Path(name).resolve()
    write_cases(folder)
    one_start_for_both(folder)
    results_of_an_earlier_version(folder)
    studies(folder)
    without_a_place_for_others(folder)
print("run places: fine")
