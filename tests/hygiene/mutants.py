#!/usr/bin/env python3
"""Small errors, one at a time: which of them do the tests notice?

Takes a copy of the source in which every error of tests/hygiene/mutants.toml is compiled in beside the right text,
builds it once, and runs the unit, physics and rank tests (no nightly ones) for each error, which the environment
variable BARCHAN_MUTANT chooses by its number. Every error meets the same tests, the fast ones first, and is done with
at the first one that fails. Ends with 1 if under 95 % are noticed, with 2 if a text of the table does not occur
exactly once or a test fails without an error.

    tests/hygiene/mutants.py [--list] [--jobs N] [WORD ...]     only errors with this number, or with the WORD in their
                                                              file or description
"""
import argparse
import concurrent.futures
import json
import os
import pathlib
import re
import subprocess
import sys
import time
import tomllib

ROOT = pathlib.Path(__file__).resolve().parents[2]
TABLE = pathlib.Path(__file__).with_name("mutants.toml")
WORK = ROOT / "build/mutants"
SOURCE, BUILD = WORK / "source", WORK / "build"
ENOUGH = 0.95
RANKS = (1, 2, 3, 4)
# Unit tests of files, words and configuration, which no error of the table can reach, are not built.
LEFT_OUT = re.compile(
    r"tests/unit/(checkpoint|command_line|config_\w+|derived|foreign_files|frame_file|grain_files|hdf5_file|info|mesh|"
    r"output|parallel_files|pour|report|run_folder|seal|shipped_configs|watchdog)_test.cpp"
)
TOGETHER = 0.3  # tests that take less go into one group [s]
SPOT = re.compile(r"\{\{(.*?) => (.*?)\}\}", re.S)
TIMED = re.compile(r"^\[       OK \] ([\w/.]+)(?:,.*)? \((\d+) ms\)", re.M)
SWITCH = """#pragma once
#include <cstdlib>
#include <type_traits>
inline const int barchan_mutant_number =
    std::getenv("BARCHAN_MUTANT") ? std::atoi(std::getenv("BARCHAN_MUTANT")) : 0;
constexpr bool barchan_mutant(int number) {
  return !std::is_constant_evaluated() && barchan_mutant_number == number;
}
"""


def stop(message):
    print("mutants: " + message, file=sys.stderr)
    sys.exit(2)


def read_table():
    with TABLE.open("rb") as file:
        table = [(name, breaks, text) for name, errors in tomllib.load(file).items() for breaks, text in errors.items()]
    return [{"number": number, "file": name, "breaks": breaks, "text": text}
            for number, (name, breaks, text) in enumerate(table, 1)]


# --- the copy of the source


def text_of(mutant):
    path = ROOT / mutant["file"]
    return path.read_text() if path.is_file() else stop(f"{mutant['file']}: there is no such file")


def spots_of(text, mutant):
    """Where a mutant changes the text of its file: (begin, end, number, wrong text)."""
    right = SPOT.sub(r"\1", mutant["text"])
    count = text.count(right)
    if not SPOT.search(mutant["text"]) or count != 1:
        stop(f"{mutant['file']}: \"{mutant['breaks']}\": its text occurs {count} times, not once:\n{right}")
    begin = text.index(right)
    for spot in SPOT.finditer(mutant["text"]):
        at = begin + len(SPOT.sub(r"\1", mutant["text"][: spot.start()]))
        yield at, at + len(spot[1]), mutant["number"], spot[2]


def render(text, begin, end, spots):
    """text[begin:end] with a choice at each spot; spots may lie inside others."""
    result = ""
    spots = sorted(spots, key=lambda spot: (spot[0], -spot[1]))
    while spots:
        first, last = spots[0][:2]
        choice = render(text, first, last, [s for s in spots if s[1] <= last and s[:2] != (first, last)])
        for _, _, number, wrong in (s for s in spots if s[:2] == (first, last)):
            choice = f"(barchan_mutant({number}) ? ({wrong}) : ({choice}))"
        result += text[begin:first] + choice
        begin, spots = last, [s for s in spots if s[0] >= last]
    return result + text[begin:end]


def write_if_changed(path, content):
    if not path.is_file() or path.read_bytes() != content:
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_bytes(content)


def copy_source(mutants):
    listed = subprocess.run(["git", "ls-files", "--cached", "--others", "--exclude-standard", "-z"], cwd=ROOT,
                            capture_output=True, check=True).stdout.decode()
    names = {name for name in listed.split("\0") if name and (ROOT / name).is_file() and not LEFT_OUT.match(name)}
    for path in SOURCE.rglob("*"):
        if path.is_file() and str(path.relative_to(SOURCE)) not in names | {"kernels/math/mutant.hpp"}:
            path.unlink()
    for name in names:
        content = (ROOT / name).read_bytes()
        spots = [spot for m in mutants if m["file"] == name for spot in spots_of(content.decode(), m)]
        if spots:
            text = content.decode()
            content = ('#include "kernels/math/mutant.hpp"\n' + render(text, 0, len(text), spots)).encode()
        if name == "cmake/flags.cmake":  # a wrong text may leave a variable unused
            content = content.replace(b"-Wpedantic -Werror", b"-Wpedantic")
        if name == "tests/CMakeLists.txt":  # built faster; what counts is compiled in the library
            content = content.replace(b"unit_tests mpi_tests)", b"unit_tests mpi_tests physics_tests)")
        write_if_changed(SOURCE / name, content)
    write_if_changed(SOURCE / "kernels/math/mutant.hpp", SWITCH.encode())
    for name in {m["file"] for m in mutants} - names:
        stop(f"{name} is not there")


def build():
    # The Kokkos of another build serves here, too.
    cache = ROOT / "build/release/CMakeCache.txt"
    found = re.search(r"^Kokkos_DIR:PATH=(.*)$", cache.read_text(), re.M) if cache.is_file() else None
    # Outside git's reach: a new commit is not a new program.
    environment = os.environ | {"GIT_CEILING_DIRECTORIES": str(WORK)}
    with (WORK / "build.log").open("w") as log:
        for command in (
            ["cmake", "-S", SOURCE, "-B", BUILD, "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release", "-DBARCHAN_ENABLE_BENCHMARKS=OFF",
             "-DBARCHAN_ENABLE_UNITY=ON"]
            + ([f"-DKokkos_DIR={found[1]}"] if found else []),
            ["cmake", "--build", BUILD, "--target", "unit_tests", "physics_tests", "mpi_tests"],
        ):
            if subprocess.run(command, stdout=log, stderr=subprocess.STDOUT, env=environment).returncode != 0:
                stop(f"the copy does not build, see {WORK / 'build.log'}")


# --- the tests


def run(command, mutant, limit=None):
    """Exit status (None: it hangs), output, seconds."""
    environment = os.environ | {"BARCHAN_MUTANT": str(mutant), "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
    begin = time.monotonic()
    try:
        done = subprocess.run(command, env=environment, timeout=limit, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT, cwd=BUILD)
        return done.returncode, done.stdout.decode(errors="replace"), time.monotonic() - begin
    except subprocess.TimeoutExpired as expired:
        return None, (expired.stdout or b"").decode(errors="replace"), time.monotonic() - begin


def noticed_by(output):
    """The test that failed, or the one that was running."""
    failed = re.search(r"^\[  FAILED  \] (\w\S*)", output, re.M)
    begun = re.findall(r"^\[ RUN      \] (\S+)", output, re.M)
    return failed[1].rstrip(",") if failed else begun[-1] if begun else "the start"


def passed(name, program, command, times):
    """What `times` makes of the output and seconds of a command that passes without an error; remembered until its
    program is built again."""
    record = WORK / f"{name}.passed.json"
    if not record.is_file() or record.stat().st_mtime < (BUILD / program).stat().st_mtime:
        status, output, seconds = run(command, 0)
        if status != 0:
            stop(f"fails without an error: {noticed_by(output)}\n{output[-3000:]}")
        record.write_text(json.dumps(times(output, seconds)))
    return json.loads(record.read_text())


def groups_of_tests():
    """Commands and what they take without an error [s]: the many fast tests first."""
    groups = []
    for name in ("unit_tests", "physics_tests"):
        took = passed(name, name, [BUILD / name, "--gtest_filter=-*Nightly*"],
                      lambda output, _: {test: int(ms) / 1000 for test, ms in TIMED.findall(output)})
        fast = [test for test, seconds in took.items() if seconds < TOGETHER]
        for tests in [fast] + [[test] for test in took if test not in fast]:
            command = [BUILD / name, "--gtest_fail_fast", "--gtest_filter=" + ":".join(tests)]
            groups.append((len(tests) == 1, sum(took[test] for test in tests), command))
    for ranks in RANKS:  # one rank that stops at its first failure would leave the others waiting
        command = ["mpirun", "--oversubscribe", "--allow-run-as-root", "-np", str(ranks), BUILD / "mpi_tests",
                   "--gtest_color=no"]
        groups.append((True, passed(f"ranks_{ranks}", "mpi_tests", command, lambda _, seconds: seconds), command))
    return [(command, seconds) for _, seconds, command in sorted(groups, key=lambda group: group[:2])]


def judge(mutant, groups):
    """How the tests noticed, or None."""
    for command, seconds in groups:
        status, output, _ = run(command, mutant["number"], 60 + 10 * seconds)
        if status != 0:
            return noticed_by(output) + (" (hangs)" if status is None and "FAILED" not in output else "")
    return None


def is_meant(mutant, word):
    return word == str(mutant["number"]) if word.isdigit() else word in mutant["file"] + mutant["breaks"]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("words", nargs="*", metavar="WORD")
    parser.add_argument("--list", action="store_true", help="print the errors, check their texts, run nothing")
    parser.add_argument("--jobs", type=int, default=1, help="errors tried side by side")
    arguments = parser.parse_args()
    table = read_table()
    chosen = [m for m in table if not arguments.words or any(is_meant(m, word) for word in arguments.words)]
    if arguments.list:
        for m in table:
            list(spots_of(text_of(m), m))
        for m in chosen:
            print(f"{m['number']:3d}  {m['file']}: {m['breaks']}")
        return 0
    copy_source(table)
    build()
    groups = groups_of_tests()
    seconds = sum(s for _, s in groups)
    print(f"mutants: without an error {len(groups)} groups of tests pass in {seconds:.0f} s", flush=True)
    survived = 0
    with concurrent.futures.ThreadPoolExecutor(arguments.jobs) as pool:
        tried = {pool.submit(judge, m, groups): m for m in chosen}
        for done in concurrent.futures.as_completed(tried):
            m, found = tried[done], done.result()
            survived += found is None
            print(f"{m['number']:3d} {'SURVIVED' if found is None else 'killed  '} {m['file']}: {m['breaks']}"
                  + (f" [{found}]" if found else ""), flush=True)
    share = 1 - survived / max(len(chosen), 1)
    print(f"mutants: {len(chosen) - survived} of {len(chosen)} errors noticed, {100 * share:.0f} %")
    return 0 if share >= ENOUGH else 1


sys.exit(main())
