#!/usr/bin/env python3
"""Sets two sets of benchmark records side by side, or Barchan and its peers run in turn.

usage: compare.py A.jsonl[@WORD] B.jsonl[@WORD] [--across]
       compare.py --peers DIR [options]

Records are those of `./barchan bench`. Of each case the last record counts, together with all others
in the file that were made alike. WORD picks records by the start of their commit or by their build
(native, generic), so runs/bench.jsonl@native can be set beside runs/bench.jsonl@generic.
Ratios are A's time over B's: above 1, B is faster. The range is from the least to the most
favourable pair of repeats. Devices and thread counts must agree, unless --across.

--peers runs our cases and the peers' scripts of DIR (run_liggghts.sh, ...) in turn, so that both meet
the same machine, and prints the median of the rounds' ratios, which a machine whose speed drifts between
rounds does not change: above 1, Barchan is faster.
"""

import argparse
import json
import os
import re
import statistics
import subprocess
import sys
import tempfile
from pathlib import Path

ROOT = Path(__file__).resolve().parent.parent
# What makes two records alike: same program, same machine, same way of running.
ALIKE = ("git_hash", "build", "build_type", "backend", "device", "threads", "ranks", "sizes", "tiny")
DEVICE = ("backend", "device", "threads", "ranks")
NOT_COUNTED = ("deep_copies_per_step",)  # shown in the records, not a difference worth a line


class Problem(Exception):
    """Something the user can put right: a sentence."""


# --- records -----------------------------------------------------------------------------------------

def read_records(argument):
    """Case -> its records, oldest first, of FILE[@WORD]."""
    name, _, word = argument.partition("@")
    try:
        lines = Path(name).read_text(encoding="utf-8").splitlines()
    except OSError as error:
        raise Problem(f"cannot read {name}: {error.strerror}") from error
    cases = {}
    for number, line in enumerate(lines, 1):
        try:
            record = json.loads(line)
            known = record["seconds_per_step"]["median"] > 0
        except (ValueError, KeyError, TypeError) as error:
            raise Problem(f"{name}:{number}: not a benchmark record") from error
        if known and (not word or record["git_hash"].startswith(word) or record["build"] == word):
            cases.setdefault(record["case"], []).append(record)
    if not cases:
        raise Problem(f"no records in {argument}")
    return cases


def pool(records):
    """The last record, its times those of all records made like it."""
    last = dict(records[-1])
    alike = [r for r in records if all(r.get(k) == last.get(k) for k in ALIKE)]
    times = [r["seconds_per_step"] for r in alike]
    last["seconds_per_step"] = {"median": statistics.median(t["median"] for t in times),
                                "min": min(t["min"] for t in times),
                                "max": max(t["max"] for t in times)}
    return last


def check_comparable(case, a, b, across):
    """Refuses records that say nothing about each other."""
    if a["sizes"] != b["sizes"]:
        raise Problem(f"{case}: the sizes differ: {a['sizes']} and {b['sizes']}")
    for key in DEVICE:
        if a[key] != b[key] and not across:
            raise Problem(f"{case}: {key} differs: {a[key]} and {b[key]} (--across compares all the same)")


def milliseconds(times):
    return f"{1e3 * times['median']:.4g} ({1e3 * times['min']:.4g} .. {1e3 * times['max']:.4g})"


def changed_counts(a, b):
    """Counts that differ by more than 1 %."""
    changes = []
    for name in sorted(set(a["counts"]) & set(b["counts"])):
        x, y = a["counts"][name], b["counts"][name]
        if name not in NOT_COUNTED and abs(x - y) > 0.01 * max(abs(x), abs(y)):
            changes.append(f"{name} {x:.4g} -> {y:.4g}")
    return "; ".join(changes)


def compare_files(first, second, across):
    """Prints the table of two record files."""
    a_cases, b_cases = read_records(first), read_records(second)
    shared = [case for case in a_cases if case in b_cases]
    if not shared:
        raise Problem(f"{first} and {second} have no case in common")
    rows = [("case", "A ms per step", "B ms per step", "A/B", "range", "counts that changed")]
    for case in shared:
        a, b = pool(a_cases[case]), pool(b_cases[case])
        check_comparable(case, a, b, across)
        x, y = a["seconds_per_step"], b["seconds_per_step"]
        rows.append((case, milliseconds(x), milliseconds(y), f"{x['median'] / y['median']:.2f}",
                     f"{x['min'] / y['max']:.2f} .. {x['max'] / y['min']:.2f}", changed_counts(a, b)))
    print_table(rows)
    for case in sorted(set(a_cases) ^ set(b_cases)):
        print(f"only in {'A' if case in a_cases else 'B'}: {case}")


def print_table(rows):
    widths = [max(len(row[n]) for row in rows) for n in range(len(rows[0]))]
    for row in rows:
        print("  ".join(cell.ljust(width) for cell, width in zip(row, widths)).rstrip())


# --- peers -------------------------------------------------------------------------------------------

# Script -> (start of its row's label, our case). The same physics, steps and tolerances.
PEER_ROWS = {
    "run_liggghts.sh": [("liggghts heap100k roll=off rebuild=0 ", "dem/heap_100k"),
                        ("liggghts heap100k roll=off rebuild=100 ", "dem/heap_100k_rebuild_100"),
                        ("liggghts heap100k roll=epsd2 rebuild=0 ", "dem/heap_100k_epsd2")],
    "run_lammps.sh": [("lammps heap100k rebuild=0 ", "dem/heap_100k"),
                      ("lammps heap100k rebuild=100 ", "dem/heap_100k_rebuild_100")],
    "run_openfoam.sh": [("pisoFoam GAMG corr=2 ", "les/mesh1")],
    "run_dpmfoam.sh": [("DPMFoam heap_10k ", "coupled/heap_10k"),
                       ("DPMFoam heap_100k ", "coupled/heap_100k")],
}
# A coupled step of CFDEM is at least a hundred grain steps and a flow step, without the coupling.
PARTS = (("liggghts heap100k roll=off rebuild=100 ", 100), ("pisoFoam GAMG corr=2 ", 1))
PARTS_LABEL, PARTS_CASE = "100 LIGGGHTS steps + 1 pisoFoam step", "coupled/heap_100k"
ROW = re.compile(r"^ROW (.+?) +(ms|s)/(?:CFD )?step min (\S+) median (\S+) max (\S+)")


def peer_rows(text, n_ranks):
    """Label -> seconds per step, of the ROW lines with this number of ranks."""
    rows = {}
    for line in text.splitlines():
        match = ROW.match(line)
        if match and re.search(rf"\branks={n_ranks}$", match[1].strip()):
            rows[match[1].strip()] = float(match[4]) / (1000 if match[2] == "ms" else 1)
    return rows


def run_peer(script, options):
    """One repeat of a peer's script."""
    with tempfile.TemporaryDirectory(prefix="peers.") as scratch:
        environment = os.environ | {"REPEATS": "1", "RANKS": str(options.ranks), "SCRATCH": scratch}
        done = subprocess.run(["bash", str(script)], env=environment, text=True, check=False,
                              stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
    rows = peer_rows(done.stdout, options.ranks)
    if done.returncode != 0 or not rows:
        tail = "\n".join(done.stdout.splitlines()[-5:])
        raise Problem(f"{script} ended with {done.returncode} and {len(rows)} rows:\n{tail}")
    return rows


def run_ours(cases, options):
    """Case -> seconds per step, of one run of our suite."""
    with tempfile.TemporaryDirectory(prefix="bench.") as scratch:
        records = Path(scratch) / "records.jsonl"
        command = [str(options.bench.resolve()), f"--benchmark_filter=^({'|'.join(cases)})/", f"--records={records}",
                   f"--heaps={options.heaps or options.peers}", "--benchmark_repetitions=1"]
        environment = os.environ | {"OMP_NUM_THREADS": str(options.ranks), "OMP_PROC_BIND": "true"}
        command += options.bench_option or ["--benchmark_min_time=10"]
        done = subprocess.run(command, env=environment, text=True, check=False, stdout=subprocess.PIPE,
                              stderr=subprocess.STDOUT)
        if done.returncode != 0:
            raise Problem(f"{options.bench} ended with {done.returncode}:\n{done.stdout[-500:]}")
        return {case: pool(found)["seconds_per_step"]["median"]
                for case, found in read_records(str(records)).items()}


def add_parts(rows):
    """The sum of the parts of a coupled step, where both were run."""
    total = 0
    for start, times in PARTS:
        seconds = [value for label, value in rows.items() if label.startswith(start)]
        if not seconds:
            return
        total += times * seconds[0]
    rows[PARTS_LABEL] = total


def case_of(label, scripts):
    if label == PARTS_LABEL:
        return PARTS_CASE
    for script in scripts:
        for start, case in PEER_ROWS[script.name]:
            if label.startswith(start):
                return case
    return None


def peer_scripts(options):
    scripts = [options.peers / name for name in options.scripts]
    for script in scripts:
        if script.name not in PEER_ROWS:
            raise Problem(f"no peer script {script.name}; known: {', '.join(PEER_ROWS)}")
        if not script.exists():
            raise Problem(f"there is no {script}")
    if not options.bench.exists():
        raise Problem(f"there is no {options.bench}; ./barchan build barchan_bench makes it")
    return scripts


def compare_with_peers(options):
    """Runs ours and theirs in turn, A B A B, and prints the table."""
    scripts = peer_scripts(options)
    wanted = {case for script in scripts for _, case in PEER_ROWS[script.name]}
    if {"run_liggghts.sh", "run_openfoam.sh"} <= {script.name for script in scripts}:
        wanted.add(PARTS_CASE)
    pairs = {}  # (label, case) -> (theirs, ours) of each round
    for turn in range(options.rounds):
        print(f"round {turn + 1} of {options.rounds}", file=sys.stderr)
        ours = run_ours(sorted(wanted), options)
        rows = {}
        for script in scripts:
            rows |= run_peer(script, options)
        add_parts(rows)
        for label, seconds in rows.items():
            case = case_of(label, scripts)
            if case in ours:
                pairs.setdefault((label, case), []).append((seconds, ours[case]))
    print_peers(pairs, options)


def print_peers(pairs, options):
    rows = [("peer", "ms per step", "our case", "ms per step", "ratio", "of the rounds")]
    for (label, case), rounds in pairs.items():
        theirs = [pair[0] for pair in rounds]
        ours = [pair[1] for pair in rounds]
        each = [peer / own for peer, own in rounds]
        ratio = statistics.median(each)
        rows.append((label, f"{1e3 * statistics.median(theirs):.4g}", case,
                     f"{1e3 * statistics.median(ours):.4g}", f"{ratio:.2f}",
                     f"{min(each):.2f} .. {max(each):.2f}"))
        if options.out:
            with open(options.out, "a", encoding="utf-8") as file:
                result = {"peer": label, "case": case, "threads": options.ranks, "ratio": ratio,
                          "peer_seconds": theirs, "our_seconds": ours}
                print(json.dumps(result), file=file)
    print_table(rows)


def parse_arguments():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawTextHelpFormatter,
                                     usage=argparse.SUPPRESS)
    parser.add_argument("records", nargs="*", metavar="RECORDS")
    parser.add_argument("--across", action="store_true", help="compare different devices, too")
    parser.add_argument("--peers", type=Path, help="folder of the peers' scripts and heaps")
    parser.add_argument("--scripts", nargs="+", default=["run_liggghts.sh", "run_lammps.sh"])
    parser.add_argument("--rounds", type=int, default=3, help="how often each side runs")
    parser.add_argument("--ranks", type=int, default=2, help="their ranks, our threads")
    parser.add_argument("--bench", type=Path, default=ROOT / "build/release/barchan_bench")
    parser.add_argument("--heaps", type=Path, help="settled heaps, if not in the peers' folder")
    parser.add_argument("--bench-option", action="append", default=[], metavar="OPTION",
                        help="for barchan_bench (repeatable); default --benchmark_min_time=10")
    parser.add_argument("--out", type=Path, help="add the results to this file, a JSON line each")
    return parser.parse_args()


def main():
    options = parse_arguments()
    try:
        if options.peers and not options.records:
            compare_with_peers(options)
        elif len(options.records) == 2 and not options.peers:
            compare_files(*options.records, options.across)
        else:
            raise Problem("two record files, or --peers DIR; --help says more")
    except Problem as problem:
        print(f"compare.py: {problem}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
