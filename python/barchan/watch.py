"""The report page beside a running case: barchan watch RUN_DIR writes report.html anew while the run goes on.

The page loads itself again, also where it was opened as a file. Exit status: 0 when the run has ended; 2: no such run;
3: stopped with Ctrl-C, which does not touch the run.
"""

import argparse
import sys
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

from barchan.errors import BarchanError
from barchan.listing import summary_of, time_reached, wanted_end

SILENCE = 600.0  # [s] after which a run that says "running" may have been killed
SHARE = 5.0  # pages are so many times as far apart as one takes to write
WATCHED = ("run.json", "history.csv", "dune.csv", "grains.h5")


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="watch", description="Keeps report.html of a running case up to date.")
    parser.add_argument("run", metavar="RUN_DIR", help="a run folder, or the case that runs")
    parser.add_argument("--every", type=float, default=5.0, metavar="S", help="seconds between pages (default: 5)")
    options = parser.parse_args(arguments)
    folder = folder_of(Path(options.run))
    if not (folder / "run.json").is_file():
        print(f"watch: {folder} is no run folder: it has no run.json", file=sys.stderr)
        return 2
    try:
        return watch(folder, max(1.0, options.every))
    except BarchanError as error:
        print(f"watch: {error}", file=sys.stderr)
        return 2


def folder_of(run: Path) -> Path:
    from barchan.io.study_folder import run_name

    return Path("runs") / run_name(run) if run.suffix == ".toml" and not run.is_dir() else run


def watch(folder: Path, every: float) -> int:
    print(f"open {folder / 'report.html'}; it loads itself again while the run goes on", flush=True)
    seen: Any = None
    began, reached = time.monotonic(), time_reached(folder, {}) or 0.0
    wait, changed = every, began
    while True:
        running, now = summary_of(folder / "run.json").get("status") == "running", state_of(folder)
        if not running or now != seen:
            seen, changed = now, time.monotonic()
            wait = max(every, SHARE * write_page(folder, wait if running else None))
            print(line(folder, time.monotonic() - began, reached), flush=True)
        if not running:
            return 0
        if time.monotonic() - changed > SILENCE:
            print(f"watch: nothing was written for {SILENCE:.0f} s: the run may have been killed", file=sys.stderr)
            changed = time.monotonic()
        time.sleep(wait)


def state_of(folder: Path) -> list[tuple[str, int, int]]:
    """What changes when the run writes."""
    found = [folder / name for name in WATCHED if (folder / name).exists()]
    return [(path.name, path.stat().st_size, path.stat().st_mtime_ns) for path in found]


def write_page(folder: Path, reload: float | None) -> float:
    """The seconds that it took."""
    from barchan import report
    from barchan.io.run_folder import RunFolder

    began = time.monotonic()
    report.write_files(RunFolder(folder), reload)
    return time.monotonic() - began


def line(folder: Path, elapsed: float, from_time: float) -> str:
    """How far the run is: status, time, and how long it takes at the speed of since the watch began."""
    from barchan.report import duration

    summary = summary_of(folder / "run.json")
    reached, end = time_reached(folder, summary), wanted_end(folder)
    text = str(summary.get("status", "unknown"))
    if reached is None or end is None:
        return text
    text += f"  {100 * reached / end:.0f} %  t {reached:.4g} of {end:.4g} s"
    if text.startswith("running") and reached > from_time and elapsed > 0:
        text += f"  left {duration(elapsed * (end - reached) / (reached - from_time))}"
    return text
