#!/usr/bin/env python3
"""Takes the records of `./barchan bench` over into the table that docs/performance.md and scaling.py rest on.

usage: keep.py RECORDS.jsonl[@WORD] [TABLE.csv]   (perf/measured.csv; WORD as of compare.py)

All records must be of one program on one machine. The table is written anew.
"""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent))
import compare  # noqa: E402

TABLE = Path(__file__).resolve().parent / "measured.csv"
ONE = ("git_hash", "device", "backend", "threads", "ranks", "build")
COLUMNS = ("case", "threads", "ms", "ms_least", "ms_most", "pressure_iterations", "rebuilds")


def row_of(record):
    times, counts = record["seconds_per_step"], record["counts"]
    numbers = [1e3 * times[name] for name in ("median", "min", "max")]
    numbers += [counts.get(name, "") for name in ("pressure_iterations", "rebuilds_per_step")]
    return [record["case"], str(record["threads"]),
            *(number if number == "" else f"{number:.3g}" for number in numbers)]


def keep(records, path):
    for key in ONE:
        if len({record[key] for record in records}) > 1:
            raise compare.Problem(f"the records differ in {key}; RECORDS@WORD takes a part of them")
    one = records[0]
    triads = [record["bandwidth"] for record in records if "bandwidth" in record]
    lines = ["# Time of a step: median, least and most of the repeats. A kernel: its part of a step.",
             "# command: ./barchan bench, then perf/keep.py", f"# commit: {one['git_hash']}",
             f"# machine: {one['device']}; {one['backend']}, {one['threads']} threads; "
             f"triad {max(triads, default=0) / 1e9:.0f} GB/s", f"# date: {one['date'][:10]}", ",".join(COLUMNS)]
    path.write_text("\n".join([*lines, *(",".join(row_of(record)) for record in records)]) + "\n", encoding="utf-8")


def main():
    try:
        if len(sys.argv) not in (2, 3):
            raise compare.Problem(__doc__.split("\n\n")[1])
        cases = compare.read_records(sys.argv[1])
        keep([compare.pool(found) for found in cases.values()], Path(sys.argv[2]) if len(sys.argv) == 3 else TABLE)
    except compare.Problem as problem:
        print(f"keep.py: {problem}", file=sys.stderr)
        sys.exit(2)


if __name__ == "__main__":
    main()
