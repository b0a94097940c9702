#!/usr/bin/env python3
"""Turns Google Benchmark's JSON file into records, one JSON object a line on stdout.

usage: bench_records.py RESULT.json

A record says what was measured (name, time, every counter) and on what (device, backend, threads,
ranks, commit), so that two records can be compared without knowing how either was made.
"""

import json
import sys

# Of Google Benchmark's context: what decides whether two records may be compared.
CONTEXT_KEYS = ("date", "host_name", "num_cpus", "mhz_per_cpu", "version", "git_hash", "backend",
                "device", "kokkos_threads", "ranks")
# Bookkeeping of Google Benchmark that says nothing about the measurement.
DROPPED_KEYS = ("run_name", "family_index", "per_family_instance_index", "repetition_index")


def records(result):
    """Yields one flat dictionary for each benchmark in a parsed result file."""
    context = {key: result["context"][key] for key in CONTEXT_KEYS if key in result["context"]}
    for benchmark in result["benchmarks"]:
        yield context | {k: v for k, v in benchmark.items() if k not in DROPPED_KEYS}


def main():
    if len(sys.argv) != 2:
        sys.exit(__doc__.split("\n\n")[1])
    with open(sys.argv[1], encoding="utf-8") as file:
        result = json.load(file)
    for record in records(result):
        print(json.dumps(record, sort_keys=True))


if __name__ == "__main__":
    main()
