#!/usr/bin/env python3
"""Bad input: tries every entry of the corpus in a folder of its own and checks how it ends.

    run.py PROGRAM [--only TEXT] [--show] [--wrong-only] [--at-once N]

An entry is fine when the exit code is the expected one, the message holds the expected words and tells of as many
problems as there are, nothing else is said (no signal, abort, stack trace, dump of a library's errors), nothing is
written, and all that within its time limit. Exit status: 0 all fine, 1 not, 77 the program is not there.
"""

import argparse
import collections
import concurrent.futures
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
import time
from pathlib import Path

import corpus
import places
from entry import DRY, DUNE, ROOT

# What a crash, a library or a runtime says, and we never.
NOISE = re.compile(
    r"terminate|what\(\)|\bstd::|Traceback|HDF5-DIAG|\bH5[A-Z]\w+\(|MPI_ABORT|MPI_ERR|Segmentation|SIG[A-Z]{3}|core dumped|"
    r"[Aa]ssert|Kokkos::|backtrace|AddressSanitizer|runtime error:|bad_alloc|vector::|basic_string|filesystem error|"
    r"stoi|stod|[\x00-\x08\x0b-\x1f\x7f]")
PYTHON = sys.executable


def base_environment(scratch, ranks=1):
    kept = {k: v for k, v in os.environ.items() if not k.startswith(("OMP_", "BARCHAN_"))}
    # A single rank needs no daemon and no network: half a second less at every start.
    alone = {"OMPI_MCA_ess_singleton_isolated": "1", "OMPI_MCA_pml": "ob1", "OMPI_MCA_btl": "self", "OMPI_MCA_osc": "^ucx"}
    return {**kept, **(alone if ranks == 1 else {}), "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false", "LC_ALL": "C.UTF-8", "TMPDIR": str(scratch),
            "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1",
            "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def environment_of(entry, temporary):
    environment = {**base_environment(temporary, entry.ranks), **entry.env}
    if entry.place:  # a program that counts its lines cannot write them everywhere, nor as anyone
        environment["GCOV_PREFIX"] = str(temporary)
    return environment


def make_good_runs(program, folder):
    """What entries start from: runs that went well. Short ones, so that copies are quick."""
    wet = DUNE[: DUNE.index("[grains]")] + '[initial]\nfluid = "turbulent"\n'
    short = ["--quiet", "--set", "time.end=0.001", "--set", "restart.interval=5e-4"]
    for name, text in (("good", DUNE), ("dry", DRY), ("wet", wet)):
        (folder / f"{name}.toml").write_text(text)
        done = subprocess.run([program, "run", f"{name}.toml", "--out", name, *short], cwd=folder, env=base_environment(folder),
                              capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"a good case ended with {done.returncode}: {done.stdout}{done.stderr}")


def snapshot(folder):
    """Every path below `folder` with what it holds; folders count."""
    found = {}
    for path in sorted(folder.rglob("*")):
        kind = path.lstat().st_mode
        if stat.S_ISREG(kind):
            found[str(path.relative_to(folder))] = (hashlib.md5(path.read_bytes()).hexdigest(), path.stat().st_mtime_ns)
        else:
            found[str(path.relative_to(folder))] = stat.S_IFMT(kind)
    return found


def lay_out(entry, folder, good):
    text = entry.config()
    if text is not None and "case.toml" not in entry.files:
        (folder / "case.toml").write_bytes(text)
    for name in entry.given:
        source, _, target = name.partition(" as ")
        target = folder / (target or source)
        target.parent.mkdir(parents=True, exist_ok=True)
        (shutil.copytree if (good / source).is_dir() else shutil.copy2)(good / source, target)
    for name, content in entry.files.items():
        path = folder / name
        path.parent.mkdir(parents=True, exist_ok=True)
        if callable(content):
            content(path)
        else:
            path.write_bytes(content if isinstance(content, bytes) else content.encode())


def command_of(entry, program):
    words = shlex.split(entry.command)
    if words[0] == "./barchan":
        return [str(ROOT / "barchan"), *words[1:]]
    if words[0] == "sweep":
        return [PYTHON, str(ROOT / "scripts/sweep.py"), program, *words[1:]]
    if words[0] == "plot":
        return [PYTHON, str(ROOT / "analysis/plot.py"), *words[1:]]
    command = [program, *words]
    if entry.ranks > 1:
        command = ["mpirun", "--quiet", "--bind-to", "none", "-np", str(entry.ranks), *command]
    return command


class Ended:
    def __init__(self, code, out, err, seconds):
        self.code, self.out, self.err, self.seconds = code, out, err, seconds
        self.wrong, self.skipped = [], None

    def how(self):
        if self.code is None:
            return "hung"
        return f"signal {-self.code}" if self.code < 0 else f"exit code {self.code}"


def execute(command, folder, environment, limit):
    began = time.monotonic()
    process = subprocess.Popen(command, cwd=folder, env=environment, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                               stderr=subprocess.PIPE, start_new_session=True)
    try:
        out, err = process.communicate(timeout=limit)
        code = process.returncode
    except subprocess.TimeoutExpired:
        os.killpg(process.pid, signal.SIGKILL)
        out, err = process.communicate()
        code = None
    return Ended(code, out.decode(errors="replace"), err.decode(errors="replace"), time.monotonic() - began)


def problems_told(entry, text):
    """Number of problems in a message, or a sentence about its form."""
    lines = [line for line in without_words_of_others(text).splitlines() if line.strip()]
    if lines and (count := re.fullmatch(r"(\d+) problems?; nothing was run\.", lines[-1])):
        told = sum(not line.startswith("  ") for line in lines[:-1])
        more = re.fullmatch(r"  \.\.\. and (\d+) more", lines[-2])
        told += int(more[1]) if more else 0
        return told if told == int(count[1]) else f"counts {count[1]} problems but names {told}"
    # Lines that are set in belong to the one above; what follows a list of them concludes it.
    loose = [n for n, line in enumerate(lines) if not line.startswith("  ") and not (n > 0 and lines[n - 1].startswith("  "))]
    return len(loose)


def without_words_of_others(text):
    """argparse, CLI11 and a count of lines put words of their own around a message; a warning is none of a problem."""
    text = re.sub(r"^usage: .*\n( .*\n)*", "", text, flags=re.M)
    return re.sub(r"^(Run with --help|warning: |libgomp: |libgcov profiling error:).*\n", "", text, flags=re.M)


def check_message(entry, ended):
    message = ended.err + ended.out
    # A terminal must not get control characters, a reader no library's words.
    if noise := NOISE.search(message):
        ended.wrong.append(f"says {noise[0]!r}")
    if entry.code == 0:
        ended.wrong += [f"does not say {word!r}" for word in entry.words() if word not in message]
        return
    ended.wrong += [f"does not say {word!r}" for word in entry.words() if word not in ended.err]
    told = problems_told(entry, ended.err)
    if told != entry.problems:
        ended.wrong.append(told if isinstance(told, str) else f"{told} problems told, not {entry.problems}")


def check_files(entry, before, after, ended):
    if entry.code == 0 or entry.writes:
        return
    for path in sorted(before.keys() | after.keys()):
        if before.get(path) != after.get(path):
            ended.wrong.append(f"{'changed' if path in before and path in after else 'left' if path in after else 'removed'} {path}")


def attempt(entry, program, good, scratch, number):
    folder, temporary = scratch / f"{number:03d}", scratch / f"{number:03d}.tmp"
    folder.mkdir()
    temporary.mkdir()
    temporary.chmod(0o777)  # MPI keeps its own things here: runs at the same time would meet
    with places.prepared(entry, folder) as (place, prefix, problem):
        if problem:
            ended = Ended(None, "", "", 0)
            ended.skipped = problem
            return ended
        lay_out(entry, place, good)
        before = snapshot(place)
        with places.as_wanted(entry, place):
            ended = execute([*prefix, *command_of(entry, program)], place, environment_of(entry, temporary), entry.limit)
        if ended.code != entry.code:
            ended.wrong.append(f"{ended.how()}, not {entry.code}")
        check_message(entry, ended)
        check_files(entry, before, snapshot(place), ended)
    for done in (folder, temporary):
        shutil.rmtree(done, ignore_errors=True)
    return ended


def show(entry, kind, ended, verbose):
    if ended.skipped:
        print(f"{kind:<16} {entry.name:<52} skipped: {ended.skipped}")
        return
    verdict = "ok" if not ended.wrong else "WRONG"
    print(f"{kind:<16} {entry.name:<52} {ended.how():<12} {ended.seconds:5.2f} s  {verdict}")
    if ended.wrong:
        print("".join(f"    ! {wrong}\n" for wrong in ended.wrong), end="")
    if ended.wrong or verbose:
        text = ended.err
        print("".join(f"    | {line[:400]!a}\n"[:420] for line in text.splitlines()[:12]), end="")


def table(results):
    """How each kind ended."""
    ways = ["exit code 0", "exit code 1", "exit code 2", "hung", "other", "skipped", "wrong"]
    counts = collections.defaultdict(collections.Counter)
    for kind, _, ended in results:
        if ended.skipped:
            counts[kind]["skipped"] += 1
            continue
        counts[kind][ended.how() if ended.how() in ways else "other"] += 1
        counts[kind]["wrong"] += bool(ended.wrong)
    print(f"\n{'kind':<16} {'inputs':>6} " + " ".join(f"{way:>11}" for way in ways))
    for kind in dict.fromkeys(kind for kind, _, _ in results):
        row = counts[kind]
        print(f"{kind:<16} {sum(k == kind for k, _, _ in results):>6} " + " ".join(f"{row[way]:>11}" for way in ways))
    total = sum(counts.values(), collections.Counter())
    print(f"{'all':<16} {len(results):>6} " + " ".join(f"{total[way]:>11}" for way in ways))
    return total["wrong"]


def is_slow(entry):
    return entry.ranks > 1 or entry.command.startswith("plot ")


def parse(arguments):
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("program", type=Path)
    parser.add_argument("--only", default="", help="entries with this text in their name or kind")
    parser.add_argument("--show", action="store_true", help="print every message")
    parser.add_argument("--wrong-only", action="store_true", help="print no line for what ends as it should")
    parser.add_argument("--short", action="store_true",
                        help="of what takes longest, several ranks and pictures, every third")
    parser.add_argument("--at-once", type=int, default=2)
    return parser.parse_args(arguments)


def main(arguments):
    options = parse(arguments)
    if not options.program.exists():
        print(f"no program at {options.program}")
        return 77
    program = str(options.program.resolve())
    entries = [(kind, entry) for kind, entry in corpus.entries()
               if options.only == kind or (options.only not in corpus.KINDS and options.only in entry.name)]
    if options.short:
        slow = [entry for _, entry in entries if is_slow(entry)]
        entries = [(kind, entry) for kind, entry in entries if not is_slow(entry) or slow.index(entry) % 3 == 0]
    began = time.monotonic()
    # Where anyone may look in: some entries run as another user.
    with tempfile.TemporaryDirectory(prefix="bad_input_") as name:
        scratch = Path(name)
        scratch.chmod(0o755)
        good = scratch / "good_runs"
        good.mkdir()
        make_good_runs(program, good)
        with concurrent.futures.ThreadPoolExecutor(options.at_once) as pool:
            jobs = [pool.submit(attempt, entry, program, good, scratch, number)
                    for number, (_, entry) in enumerate(entries)]
            results = []
            for (kind, entry), job in zip(entries, jobs):
                ended = job.result()
                if ended.wrong or not options.wrong_only:
                    show(entry, kind, ended, options.show)
                results.append((kind, entry, ended))
    wrong = table(results)
    print(f"\n{len(results)} inputs in {time.monotonic() - began:.0f} s: {wrong} ended otherwise than they should")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
