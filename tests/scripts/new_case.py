#!/usr/bin/python3
"""barchan new: a case whose mesh and steps follow from grains and velocity, checked, run on one and two ranks, and
gone on with; and a case over grains in a file, whose lengths are in their diameters."""
import pathlib
import subprocess
import sys
import tomllib

import faults

ENVIRONMENT = {**faults.ENVIRONMENT, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
SMALL = ("--grains", "150", "--diameter", "0.3mm")
SETTINGS = {f"output.{name}_interval": 0.01 for name in ("grains", "dune", "tracks", "fields")} | {
    "statistics.start": 0, "statistics.grain_forces": "true"}
SHORT = [word for key, value in SETTINGS.items() for word in ("--set", f"{key}={value}")]


def barchan(folder, *words, ranks=1):
    launcher = ["mpirun", "--quiet", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    return subprocess.run([*launcher, faults.PROGRAM, *map(str, words)], cwd=folder, env=ENVIRONMENT,
                          capture_output=True, text=True, timeout=300)


def run(folder, name, end, *words, ranks=1):
    faults.expect(barchan(folder, "run", "own.toml", "--quiet", "--out", f"runs/{name}", "--set", f"time.end={end}",
                          *SHORT, *words, ranks=ranks), 0)
    return folder / "runs" / name


def resolved(folder, case):
    done = barchan(folder, "check", "--resolved-only", case)
    faults.expect(done, 0)
    return done.stdout


def writes_a_case(work):
    done = barchan(work, "new", "own", *SMALL)
    faults.expect(done, 0)
    if "barchan run own.toml" not in done.stdout:
        faults.fail(f"new does not say how to go on: {done.stdout}")
    written = {path.name: path.read_bytes() for path in work.glob("*.toml")}
    if sorted(written) != ["own-flow.toml", "own-heap.toml", "own.toml"]:
        faults.fail(f"new wrote {sorted(written)}")
    faults.expect(barchan(work, "new", "own.toml"), 2, "is there already")
    faults.expect(barchan(work, "new", "based", "--from", "own.toml"), 0)
    if resolved(work, "based.toml").replace('"based"', '"own"') != resolved(work, "own.toml"):
        faults.fail("a case from another one is another case")
    (work / "based.toml").unlink()
    for words, told in ((("--diameter", "3d"), "a length from 1 um"), (("--grains", "3"), "--grains"),
                        (("--from", "own.toml", "--velocity", "1"), "excludes")):
        faults.expect(barchan(work, "new", "wrong", *words), 2, told)
    faults.expect(barchan(work, "new", "nowhere/own"), 2, "cannot write")
    if {path.name: path.read_bytes() for path in work.glob("*.toml")} != written:
        faults.fail("a refused case left or changed a file")


def runs_everywhere(work):
    whole = run(work, "whole", 0.04)
    numbers, case = faults.summary(whole), tomllib.loads(resolved(work, "own.toml"))
    if numbers["fluid_step"] != case["time"]["fluid_step"] or numbers["grain_step"] > case["time"]["grain_step"]:
        faults.fail(f"run.json has other steps, {numbers}, than the case, {case['time']}")
    if not numbers["grain_step_over_stable"] < 1.1 or not numbers["max_cfl"] < 0.7:
        faults.fail(f"the chosen steps are too long: {numbers['grain_step_over_stable']}, {numbers['max_cfl']}")
    parted = run(work, "parted", 0.02)
    run(work, "parted", 0.04, "--resume")
    faults.same_bits.compare(faults.last_restart(whole), faults.last_restart(parted))
    compare = pathlib.Path(__file__).parent.parent / "support" / "compare_runs.py"
    short = [run(work, f"ranks-{ranks}", 0.01, ranks=ranks) for ranks in (1, 2)]  # later contacts amplify the last bits
    subprocess.run([sys.executable, compare, "grains", *short], check=True)


def reads_diameters_in_a_file(work):
    (work / "grains.csv").write_text("id,diameter,x,y,z\n1,1e-3,0.01,0.001,0.01\n2,1e-3,0.02,0.001,0.01\n")
    (work / "table.toml").write_text(
        '[time]\nend = 1\n[domain]\nsize = ["60 d", "40 d", "40 d"]\n[fluid]\ncells = [12, 30, 8]\n'
        'first_cell_height = "0.65 d"\nmean_velocity = 0.5\n[grains]\n[initial]\ngrains = "grains.csv"\n')
    text = resolved(work, "table.toml")
    for line in ("smoothing_length = 0.003", "skin = 0.0002", "size = [0.06, 0.04, 0.04]"):
        if line not in text:
            faults.fail(f"the case does not have {line}:\n{text}")


def test(work):
    writes_a_case(work)
    runs_everywhere(work)
    reads_diameters_in_a_file(work)


if __name__ == "__main__":
    faults.in_a_new_folder(test)
    print("new cases are written, run and go on")
