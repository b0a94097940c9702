#!/usr/bin/env python3
"""What `barchan check` says a case will take, over what it takes.

usage: perf/estimates.py [CASE.toml ...] [--seconds S] [--threads N] [--state NAME=FILE ...] [--out DIR]

Each case (default: all that ship) is checked, then run to its end, or for S seconds (30) and counted on by its steps.
What it starts from is run as briefly, and only for that; or --state has its result in a .csv or .h5. A line a case:
name, seconds estimated, seconds it takes, their ratio, steps run of all. At the end the ratios between 0.67 and 1.5
are counted. --table perf/estimates.csv puts the lines into this table, in place of those of the same cases. Leave the
machine alone meanwhile: the two are measured one after the other.
"""

import argparse
import json
import os
import pathlib
import re
import subprocess
import sys
import tomllib

ROOT = pathlib.Path(__file__).resolve().parent.parent
UNITS = {"s": 1, "min": 60, "h": 3600, "d": 86400}


def is_case(path):
    return "study" not in tomllib.loads(path.read_text(encoding="utf-8"))


def shipped():
    return [path for path in sorted((ROOT / "configs").rglob("*.toml")) if is_case(path)]


def seconds_in(text):
    """Of "2 h 07 min" and the like."""
    return sum(float(number) * UNITS[unit] for number, unit in re.findall(r"([\d.]+) (s|min|h|d)\b", text))


def put(table, name, estimate, takes, summary, options):
    """The line of a case into the table."""
    said = table.read_text(encoding="utf-8").splitlines()
    lines = [line for line in said if not line.startswith(name + ",")]
    machine = re.search(r"model name\s*: ([^,\n]*)", pathlib.Path("/proc/cpuinfo").read_text(encoding="utf-8"))
    lines.append(f"{name},{estimate:.4g},{takes:.4g},{estimate / takes:.2f},{summary['steps']},{summary['all_steps']},"
                 f"{summary['git_hash'][:7]},{machine[1] if machine else ''},{options.seconds:g},")
    table.write_text("\n".join(lines) + "\n", encoding="utf-8")


class Measurement:
    def __init__(self, options):
        self.options = options
        self.program = ROOT / "build" / os.environ.get("BARCHAN_PRESET", "release") / "barchan"
        self.states = dict(state.split("=", 1) for state in options.state)
        self.done = {}  # of each case that was run: its summary and last restart file

    def call(self, command, case, *arguments):
        result = subprocess.run([self.program, command, case, "--threads", str(self.options.threads), *arguments],
                                capture_output=True, text=True, check=False,
                                env=os.environ | {"OMP_PROC_BIND": "false"})
        if result.returncode not in (0, 3):
            sys.exit(f"{case}: {result.stderr}")
        return result.stdout

    def estimate(self, case):
        """Seconds of the case itself, without starts."""
        text = self.call("check", case, "--out", self.options.out / "none" / case.stem)
        return seconds_in(re.search(r"^  wall time +about (.*?) on ", text, re.MULTILINE).group(1))

    def run(self, case):
        """Summary and last restart file of the case, or of its first part."""
        if case in self.done:
            return self.done[case]
        table = tomllib.loads(self.call("check", case, "--resolved-only"))
        starts = []
        for key, start in table["initial"].items():
            if isinstance(start, str) and start.endswith(".toml"):
                path = (case.parent / start).resolve()
                state = self.states.get(path.stem) or self.run(path)[1]
                starts += ["--set", f'initial.{key}="{state}"']
        folder = self.options.out / case.relative_to(ROOT / "configs").with_suffix("")
        self.call("run", case, "--quiet", "--out", folder, "--set",
                  f"time.wall_clock_limit={self.options.seconds}", *starts)
        summary = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        time = tomllib.loads((folder / "config.toml").read_text(encoding="utf-8"))["time"]
        summary["all_steps"] = round(time["end"] / time["fluid_step"])
        self.done[case] = summary, max(folder.glob("restart_*.h5")).resolve()
        return self.done[case]


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("cases", nargs="*", type=pathlib.Path)
    parser.add_argument("--seconds", type=float, default=30)
    parser.add_argument("--threads", type=int, default=os.cpu_count())
    parser.add_argument("--state", action="append", default=[], metavar="NAME=FILE")
    parser.add_argument("--out", type=pathlib.Path, default=ROOT / "runs" / "estimates")
    parser.add_argument("--table", type=pathlib.Path)
    options = parser.parse_args()
    options.out = options.out.resolve()
    measurement = Measurement(options)
    ratios = []
    for case in [path.resolve() for path in options.cases] or shipped():
        summary, _ = measurement.run(case)
        estimate = measurement.estimate(case)
        takes = summary["wall_seconds"] * summary["all_steps"] / summary["steps"]
        ratios.append(estimate / takes)
        name = str(case.relative_to(ROOT / "configs").with_suffix(""))
        if options.table:
            put(options.table, name, estimate, takes, summary, options)
        print(f"{name:30} {estimate:10.4g} {takes:10.4g} "
              f"{ratios[-1]:6.2f}  {summary['steps']} of {summary['all_steps']}", flush=True)
    good = sum(0.67 <= ratio <= 1.5 for ratio in ratios)
    print(f"{good} of {len(ratios)} within a factor 1.5; {min(ratios):.2f} to {max(ratios):.2f}")
    return 0 if good == len(ratios) else 1


if __name__ == "__main__":
    sys.exit(main())
