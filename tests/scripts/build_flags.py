#!/usr/bin/python3
"""Every configuration compiles without fused multiply-adds and with what makes loops vectorise, whatever flags the user
gives; and these are kept."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["BARCHAN_PROGRAM"]).parent
OURS = "-fno-math-errno", "-fno-trapping-math", "-ffp-contract=off"


def cached(name):
    lines = (BUILD / "CMakeCache.txt").read_text().splitlines()
    return [f"-D{name}=" + line.split("=", 1)[1] for line in lines if line.startswith(name + ":")]


def commands(folder):
    """Words of the compiler's call for each of our sources but the one that only starts another program."""
    entries = json.loads((folder / "compile_commands.json").read_text())
    return {entry["file"]: entry["command"].split() for entry in entries
            if entry["file"].startswith(str(ROOT) + "/") and "best_program" not in entry["file"]}


def check(label, folder, *others):
    """All of ours are there, nothing later undoes them; and the other words are in the calls of the program."""
    calls = {name: words for name, words in commands(folder).items() if "/src/" in name or "/tests/" in name}
    if not any(name.endswith("src/grains/grain_solver.cpp") for name in calls):
        sys.exit(f"{label}: the sources of the program are not compiled")
    for name, words in calls.items():
        contract = [word for word in words if word.startswith("-ffp-contract")]
        lost = [word for word in OURS if word not in words]
        if lost or contract[-1] != "-ffp-contract=off":
            sys.exit(f"{label}: {name} is compiled without {lost or contract}")
    words = next(words for name, words in calls.items() if name.endswith("src/grains/grain_solver.cpp"))
    missing = [word for word in others if word not in words]
    if missing or "-DNDEBUG" in words:
        sys.exit(f"{label}: {missing} are not there: {words}")
    print(f"{label}: {len(calls)} files, fine")


def configure(folder, *options):
    command = ["cmake", "-S", ROOT, "-B", folder, "-G", "Ninja", *cached("CMAKE_CXX_COMPILER"), *cached("Kokkos_DIR")]
    subprocess.run([*command, *options], check=True, stdout=subprocess.DEVNULL, stdin=subprocess.DEVNULL)


with tempfile.TemporaryDirectory() as work:
    new = pathlib.Path(work) / "build"
    configure(new, "-DCMAKE_BUILD_TYPE=RelWithDebInfo", "-DCMAKE_CXX_FLAGS=-DMINE -ffp-contract=fast")
    check("RelWithDebInfo", new, "-O2", "-g", "-DMINE")
    configure(new, "-DCMAKE_BUILD_TYPE=Release", "-DCMAKE_CXX_FLAGS=")
    check("Release", new, "-O3")
    configure(new, "-DCMAKE_CXX_FLAGS_RELEASE=-O2 -DMINE")
    check("Release with flags of the user", new, "-O2", "-DMINE")
