#!/usr/bin/env python3
"""Makes the page of scripts/first_light.sh: first_light.md and first_light.json.

usage: first_light.py FOLDER BUILD CPU_BUILD HOW

HOW is a sentence about what kind of run it was, or empty. FOLDER/steps has the list of steps (name|title), a stamp
(status, seconds, reason) of each that was tried, and the parts of some; beside it are benchmark records, runs, and what
ncu said. The exit code is 1 if a step failed.
"""
import csv
import datetime
import json
import pathlib
import platform
import shutil
import subprocess
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parent))
import ptxas_table  # noqa: E402

# What is asked, how, and a word of the line of the answer that counts.
ASKED = (
    ("card, driver, memory", "",
     ["nvidia-smi", "--query-gpu=name,driver_version,memory.total", "--format=csv,noheader"]),
    ("nvcc", "release", ["nvcc", "--version"]),
    ("compute-sanitizer", "ersion", ["compute-sanitizer", "--version"]),
    ("ncu", "ersion", ["ncu", "--version"]),
    ("cmake", "", ["cmake", "--version"]),
    ("host compiler", "", ["c++", "--version"]),
    ("MPI", "", ["mpirun", "--version"]),
)
RUNS = ("quickstart", "whole-cpu", "dune")
RUN_KEYS = ("backend", "device", "steps", "simulated_seconds", "wall_seconds", "grain_steps_per_second",
            "cell_steps_per_second", "pressure_iterations_mean", "list_rebuilds", "grains_inside", "phases")
OCCUPANCY = {"Achieved Occupancy": "achieved_percent", "Theoretical Occupancy": "theoretical_percent",
             "Registers Per Thread": "registers"}


def answer(command, word=""):
    if not shutil.which(command[0]):
        return "not here"
    try:
        done = subprocess.run(command, capture_output=True, text=True, stdin=subprocess.DEVNULL, timeout=30)
    except subprocess.TimeoutExpired:
        return "says nothing"
    lines = [line.strip() for line in done.stdout.splitlines() if line.strip()]
    if done.returncode != 0 or not lines:
        return "says nothing"
    return next((line for line in lines if word in line), lines[0])


def cpu_name():
    with open("/proc/cpuinfo", encoding="utf-8") as file:
        return next((line.split(": ")[1].strip() for line in file if line.startswith("model name")), "unknown")


def machine(build, cpu_build):
    found = {"date": datetime.datetime.now(datetime.timezone.utc).isoformat(timespec="seconds"),
             "system": platform.platform(), "processor": cpu_name(),
             "program": answer([str(build / "barchan"), "--version"]),
             "program on the CPU": answer([str(cpu_build / "barchan"), "--version"])}
    return found | {name: answer(command, word) for name, word, command in ASKED}


def rows_of(path, names):
    """Lines of words between tabs as dictionaries; none if there is no such file."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    return [dict(zip(names, line.split("\t"))) for line in lines]


def read_steps(folder):
    for line in (folder / "list").read_text(encoding="utf-8").splitlines():
        name, title = line.split("|")
        stamps = rows_of(folder / f"{name}.stamp", ("status", "seconds", "reason"))
        parts = rows_of(folder / f"{name}.done", ("status", "name", "seconds"))
        stamp = stamps[0] if stamps else {"status": "open", "seconds": "0", "reason": "not yet"}
        yield {"name": name, "title": title, "status": stamp["status"], "seconds": int(stamp["seconds"]),
               "reason": stamp["reason"].strip(), "parts": parts}


def read_benchmarks(path):
    """The last record of each case."""
    lines = path.read_text(encoding="utf-8").splitlines() if path.exists() else []
    records = [json.loads(line) for line in lines]
    for record in records:
        if "bytes_per_second" in record:
            record["bytes_per_step"] = record["bytes_per_second"] * record["seconds_per_step"]["median"]
    return list({record["case"]: record for record in records}.values())


def read_occupancy(path):
    """Kernel -> means over its launches of what ncu measured."""
    if not path.exists():
        return {}
    lines = path.read_text(encoding="utf-8", errors="replace").splitlines()
    table = csv.DictReader(line for line in lines if line.startswith('"'))  # the program speaks in between
    found = {}
    for row in table:
        name = ptxas_table.kernel_name(row["Kernel Name"]) or row["Kernel Name"]
        if row["Metric Name"] in OCCUPANCY:
            value = float(row["Metric Value"].replace(",", ""))
            found.setdefault(name, {}).setdefault(OCCUPANCY[row["Metric Name"]], []).append(value)
    return {name: {"launches": max(map(len, values.values())), **{key: sum(all_) / len(all_)
                                                                   for key, all_ in values.items()}}
            for name, values in sorted(found.items())}


def read_runs(folder):
    for name in RUNS:
        path = folder / name / "run.json"
        if path.exists():
            said = json.loads(path.read_text(encoding="utf-8"))
            yield name, {key: said[key] for key in RUN_KEYS if key in said}


def verdict(steps):
    """In a word, and a sentence."""
    count = {status: sum(step["status"] == status for step in steps)
             for status in ("passed", "failed", "not run here", "open")}
    word = "failed" if count["failed"] else "open" if count["open"] else "passed"
    return word, ", ".join(f"{n} {status}" for status, n in count.items() if n)


def table(heads, rows):
    yield f"| {' | '.join(heads)} |"
    yield "|" + "---|" * len(heads)
    for row in rows:
        yield "| " + " | ".join(str(cell).replace("|", "/") for cell in row) + " |"
    yield ""


def number(value, scale=1.0):
    return "-" if value is None else f"{value * scale:.4g}" if isinstance(value, float) else value


def benchmark_row(record):
    time = record["seconds_per_step"]
    return (record["case"], number(time["median"], 1e3), f"{number(time['min'], 1e3)} to {number(time['max'], 1e3)}",
            number(record.get("bytes_per_step"), 1e-6), number(record.get("bytes_per_second"), 1e-9),
            number(record.get("bandwidth_fraction"), 100),
            ", ".join(f"{rate:.3g} {unit}" for unit, rate in record.get("rates", {}).items()))


def page(found):
    yield from ("# First light", "", f"**{found['verdict']}**: {found['counts']}.", "", found["how"], "")
    yield from ("## Steps", "")
    yield from table(("step", "result", "s", "what it found"),
                     [(s["title"], s["status"], s["seconds"], s["reason"]) for s in found["steps"]])
    yield from ("## Machine", "")
    yield from table(("what", "which"), found["machine"].items())
    if found["benchmarks"]:
        one = found["benchmarks"][0]
        triad = max(record.get("bandwidth", 0) for record in found["benchmarks"])
        yield from ("## Benchmarks", "")
        yield f"On {one['device']} with {one['backend']}, Kokkos {one['kokkos']}. Triad: {triad / 1e9:.4g} GB/s."
        yield from ("Bytes are computed: every array that a step needs once.", "")
        yield from table(("case", "ms a step", "least to most", "MB", "GB/s", "% of the triad", "rates"),
                         map(benchmark_row, found["benchmarks"]))
    if found["runs"]:
        yield from ("## Runs", "")
        phases = sorted({phase for run in found["runs"].values() for phase in run["phases"]})
        names = [key for key in RUN_KEYS if key != "phases"]
        yield from table(("", *found["runs"]),
                         [(name.replace("_", " "), *(number(run.get(name)) for run in found["runs"].values()))
                          for name in names] +
                         [(f"{phase}, ms a step", *(number(run["phases"].get(phase), 1e3)
                                                    for run in found["runs"].values())) for phase in phases])
    if found["occupancy"]:
        yield from ("## Occupancy", "")
        yield from table(("kernel", "launches", *OCCUPANCY),
                         [(name, values["launches"], *(number(values.get(key)) for key in OCCUPANCY.values()))
                          for name, values in found["occupancy"].items()])


def main(folder, build, cpu_build, how):
    folder = pathlib.Path(folder)
    steps = list(read_steps(folder / "steps"))
    word, counts = verdict(steps)
    found = {"verdict": word, "counts": counts, "how": how, "steps": steps,
             "machine": machine(pathlib.Path(build), pathlib.Path(cpu_build)),
             "benchmarks": read_benchmarks(folder / "bench.jsonl"), "runs": dict(read_runs(folder / "runs")),
             "occupancy": read_occupancy(folder / "ncu.csv")}
    (folder / "first_light.json").write_text(json.dumps(found, indent=2) + "\n", encoding="utf-8")
    (folder / "first_light.md").write_text("\n".join(page(found)) + "\n", encoding="utf-8")
    print(f"first_light: {word}: {counts}; see {folder / 'first_light.md'}", file=sys.stderr)
    return 1 if word == "failed" else 0


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
