#!/usr/bin/env python3
"""Checks the records of the performance suite: all there, whole, and with the counts they must have.

usage: check_bench_records.py RECORDS.jsonl NAMES
"""

import json
import sys

TEXTS = ("case", "backend", "device", "cpu", "git_hash", "version", "compiler", "build", "build_type", "date")
POSITIVE = ("threads", "ranks", "repeats", "steps", "bytes_per_unit", "bandwidth", "bandwidth_fraction",
            "peak_memory_bytes")
BYTES_PER_GRAIN, BYTES_PER_CELL = 1100, 360  # at most; cells with their ghosts, pairs as in a heap
MOST_ITERATIONS = 12  # of the pressure, to 1e-6 with a heap; 4 are usual
problems = []


def expect(case, holds, what):
    if not holds:
        problems.append(f"{case}: {what}")


def check_whole(record):
    """Everything a reader of the record needs is there."""
    case = record.get("case", "?")
    for key in TEXTS:
        expect(case, isinstance(record.get(key), str) and record[key], f"no {key}")
    for key in POSITIVE:
        expect(case, record.get(key, 0) > 0, f"{key} is {record.get(key)}")
    times = record["seconds_per_step"]
    expect(case, 0 < times["min"] <= times["median"] <= times["max"], f"times out of order: {times}")
    expect(case, record["rates"] and all(rate > 0 for rate in record["rates"].values()), "no rates")
    expect(case, record["sizes"], "no sizes")


def check_counts(record):
    """What does not depend on the machine."""
    case, counts = record["case"], record["counts"]
    has_grains = "grains" in record["sizes"]
    if has_grains and case != "kernel/integration":
        least = 0 if "dune" in case else 0.5  # the dune of the test has 200 grains, most of them fly
        expect(case, counts["contacts"] > least * record["sizes"]["grains"], f"{counts['contacts']} contacts")
        expect(case, counts["pairs"] >= counts["contacts"], "fewer pairs than contacts")
    if case == "kernel/integration":
        expect(case, counts["pairs"] == 0, f"{counts['pairs']} pairs among loose grains")
    if case.startswith("kernel/"):
        return
    expect(case, counts["allocations_per_step"] == 0, f"allocates: {record['notes'].get('allocated')}")
    expect(case, counts["host_copies_per_step"] == 0, f"copies: {record['notes'].get('copied')}")
    check_memory(record)
    if "cells" in record["sizes"]:
        most = MOST_ITERATIONS if has_grains else 1
        expect(case, 1 <= counts["pressure_iterations"] <= most,
               f"{counts['pressure_iterations']} pressure iterations")
    if case == "dem/heap_100k_rebuild_100":
        expect(case, counts["rebuilds_per_step"] >= 0.01, f"{counts['rebuilds_per_step']} rebuilds a step")


def check_memory(record):
    """No array more than there was: what a step keeps per grain and per cell."""
    sizes, most = record["sizes"], 1e5
    most += BYTES_PER_GRAIN * sizes.get("grains", 0)
    if "cells" in sizes:
        nx, ny, nz = sizes["cells"]
        most += BYTES_PER_CELL * (nx + 2) * (ny + 2) * (nz + 2)
    used = record["counts"]["array_bytes"]
    expect(record["case"], 0 < used <= most, f"{used:g} bytes of arrays, at most {most:g} expected")


def main():
    with open(sys.argv[1], encoding="utf-8") as file:
        records = [json.loads(line) for line in file]
    with open(sys.argv[2], encoding="utf-8") as file:
        names = file.read().split()
    found = [record["case"] for record in records]
    expect("suite", len(names) >= 21, f"only {len(names)} benchmarks")
    expect("suite", sorted(found) == sorted(names), f"records of {found}, not of {names}")
    for record in records:
        check_whole(record)
        check_counts(record)
    for problem in problems:
        print("FAILED:", problem)
    sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
