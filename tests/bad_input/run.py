#!/usr/bin/env python3
"""Bad input: tries every entry of the tables in a folder of its own and checks how it ends.

    run.py [PROGRAM] [--only TEXT] [--show]

An entry is fine when the exit code is the expected one, the message holds the expected words and tells of as many
problems as there are, nothing else is said (no signal, abort, stack trace, words of a library), nothing is written,
and all that within 20 s. Exit status: 0 all fine, 1 not.
"""

import argparse
import collections
import concurrent.futures
import contextlib
import hashlib
import os
import re
import shlex
import shutil
import signal
import stat
import subprocess
import sys
import tempfile
from pathlib import Path

import case_files
import data_files
import surroundings
from entry import DRY, DUNE, ROOT, WET

ENTRIES = {**case_files.ENTRIES, **data_files.ENTRIES, **surroundings.ENTRIES}
LIMIT = 20  # seconds
# What a crash, a library or a runtime says, and we never.
NOISE = re.compile(
    r"terminate|what\(\)|\bstd::|Traceback|HDF5-DIAG|\bH5[A-Z]\w+\(|MPI_ABORT|MPI_ERR|Segmentation|SIG[A-Z]{3}|core dumped|"
    r"[Aa]ssert|Kokkos::|backtrace|AddressSanitizer|runtime error:|bad_alloc|vector::|basic_string|filesystem error|"
    r"stoi|stod|[\x00-\x08\x0b-\x1f\x7f]")
# argparse, CLI11 and a count of lines put words of their own around a message; a warning is none of a problem.
AROUND = re.compile(r"^(usage: .*\n( .*\n)*|(Run with --help|warning: |libgomp: |libgcov profiling error:).*\n)", re.M)


def environment_of(temporary):
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("OMP_", "BARCHAN_"))}
    return {**kept, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false", "LC_ALL": "C.UTF-8", "TMPDIR": str(temporary),
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def make_good_runs(program, folder):
    """What entries start from: short runs that went well."""
    for name, text in (("good", DUNE), ("dry", DRY), ("wet", WET)):
        (folder / f"{name}.toml").write_text(text)
        command = [program, "run", f"{name}.toml", "--out", name, "--quiet", "--set", "time.end=0.001", "--set",
                   "restart.interval=5e-4"]
        subprocess.run(command, cwd=folder, env=environment_of(folder), check=True, stderr=subprocess.DEVNULL)


def snapshot(folder):
    """Every path below `folder` with what it holds; folders count."""
    found = {}
    for path in folder.rglob("*"):
        info = path.lstat()
        ordinary = stat.S_ISREG(info.st_mode)
        found[path] = (info.st_mode, ordinary and (hashlib.md5(path.read_bytes()).digest(), info.st_mtime_ns))
    return found


def lay_out(entry, folder, good):
    (folder / "case.toml").write_bytes(entry.config())
    for name in entry.given:
        source, _, target = name.partition(" as ")
        (shutil.copytree if (good / source).is_dir() else shutil.copy2)(good / source, folder / target)
    for name, content in entry.files.items():
        path = folder / name
        path.parent.mkdir(exist_ok=True)
        if callable(content):
            if name == "case.toml":
                path.unlink()
            content(path)
        else:
            path.write_bytes(content if isinstance(content, bytes) else content.encode())
    if entry.under == "nobody":  # root may write everywhere; for others these are locked
        for path in folder.rglob("locked"):
            path.chmod(0o555)
        for path in folder.rglob("secret*"):
            path.chmod(0o000)


@contextlib.contextmanager
def conditions(entry, folder):
    """Words before the command that set its limits; None where this machine does not allow that."""
    kind, _, size = entry.under.partition(" ")
    if kind == "tmpfs":
        done = subprocess.run(["mount", "-t", "tmpfs", "-o", f"size={size}", "tmpfs", str(folder)], capture_output=True)
        yield [] if done.returncode == 0 else None
        if done.returncode == 0:
            subprocess.run(["umount", str(folder)], check=False)
    elif kind == "nobody" and os.geteuid() == 0:
        yield ["setpriv", "--reuid=65534", "--regid=65534", "--clear-groups"] if shutil.which("setpriv") else None
    else:
        yield ["prlimit", f"--{kind}={size}"] if kind in ("fsize", "as") else []


def command_of(entry, program):
    first, *words = shlex.split(entry.command)
    scripts = {"sweep": [sys.executable, "-m", "barchan", "sweep", program],
               "plot": [sys.executable, "-m", "barchan", "plot"]}
    ranks = ["mpirun", "--quiet", "--bind-to", "none", "-np", str(entry.ranks)] if entry.ranks > 1 else []
    return [*scripts.get(first, [*ranks, program, first]), *words]


def execute(command, folder, environment):
    """(exit code or None for a hang, output, error)"""
    process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, text=True, errors="replace", start_new_session=True)
    try:
        out, err = process.communicate(timeout=LIMIT)
        return process.returncode, out, err
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        return None, *process.communicate()


def problems_told(text):
    """Number of problems in a message, or a sentence about its form."""
    lines = [line for line in AROUND.sub("", text).splitlines() if line.strip()]
    if lines and (count := re.fullmatch(r"(\d+) problems?; nothing was run\.", lines[-1])):
        more = re.fullmatch(r"  \.\.\. and (\d+) more", lines[-2])
        told = sum(not line.startswith("  ") for line in lines[:-1]) + (int(more[1]) if more else 0)
        return told if told == int(count[1]) else f"counts {count[1]} problems but names {told}"
    # Lines that are set in belong to the one above; what follows a list of them concludes it.
    return sum(not line.startswith("  ") and not before.startswith("  ") for before, line in zip(["", *lines], lines))


def attempt(entry, program, good, scratch, number):
    """What is wrong with how an entry ends, and what it said; None, None if it cannot be tried here."""
    folder, temporary = scratch / f"{number:03d}", scratch / f"{number:03d}.tmp"
    folder.mkdir()
    temporary.mkdir()
    temporary.chmod(0o777)  # MPI keeps its own things here: runs at the same time would meet
    with conditions(entry, folder) as prefix:
        if prefix is None:
            return None, None
        lay_out(entry, folder, good)
        before = snapshot(folder)
        environment = {**environment_of(temporary), **entry.env}
        if entry.under:  # a program that counts its lines cannot write them everywhere, nor as anyone
            environment["GCOV_PREFIX"] = str(temporary)
        code, out, err = execute([*prefix, *command_of(entry, program)], folder, environment)
        after = snapshot(folder)
    wrong = [] if code == entry.code else [f"exit code {code}, not {entry.code}"]
    if noise := NOISE.search(err + out):
        wrong.append(f"says {noise[0]!r}")
    wrong += [f"does not say {words!r}" for words in entry.expected() if words not in (err if entry.code else err + out)]
    if entry.code and (told := problems_told(err)) != entry.problems:
        wrong.append(told if isinstance(told, str) else f"{told} problems told, not {entry.problems}")
    if entry.code == 2:
        wrong += [f"wrote or removed {path.relative_to(folder)}" for path in before.keys() | after.keys()
                  if before.get(path) != after.get(path)]
    shutil.rmtree(folder, ignore_errors=True)
    shutil.rmtree(temporary, ignore_errors=True)
    return wrong, err


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path, nargs="?",
                        default=os.environ.get("BARCHAN_PROGRAM", ROOT / "build/release/barchan"))
    parser.add_argument("--only", default="", help="a kind, or entries with this text in their name")
    parser.add_argument("--show", action="store_true", help="print every message")
    options = parser.parse_args()
    program = str(options.program.resolve())
    chosen = [(kind, entry) for kind, entries in ENTRIES.items() for entry in entries
              if options.only == kind or (options.only not in ENTRIES and options.only in entry.name)]
    counts = collections.defaultdict(collections.Counter)
    # Where anyone may look in: some entries run as another user.
    with tempfile.TemporaryDirectory(prefix="bad_input_") as name:
        scratch = Path(name)
        scratch.chmod(0o755)
        good = scratch / "good_runs"
        good.mkdir()
        make_good_runs(program, good)
        with concurrent.futures.ThreadPoolExecutor(2) as pool:
            jobs = [pool.submit(attempt, entry, program, good, scratch, n) for n, (_, entry) in enumerate(chosen)]
            for (kind, entry), job in zip(chosen, jobs):
                wrong, said = job.result()
                ended = "skipped" if wrong is None else "wrong" if wrong else f"exit code {entry.code}"
                counts[kind][ended] += 1
                if wrong or options.show:
                    print(f"{kind}: {entry.name}: {ended}", *(f"    ! {text}" for text in wrong or []), sep="\n")
                    print("".join(f"    | {line[:400]!a}\n" for line in (said or "").splitlines()[:12]), end="")
    for kind, how in counts.items():
        print(f"{kind:<16} {sum(how.values()):>4} inputs: " + ", ".join(f"{n} {ended}" for ended, n in sorted(how.items())))
    return 1 if any(how["wrong"] for how in counts.values()) else 0


if __name__ == "__main__":
    sys.exit(main())
