"""Watches a run: barchan watch RUN_DIR, or CASE.toml for runs/CASE. Its report.html is written again as the run goes.

The page reloads itself until the run ends; the last one does not. The run is only read, never touched.
Exit status: 0 the run has ended and the page is written, 2 no such run, 3 stopped by Ctrl-C (the run goes on).
"""

import argparse
import os
import re
import socket
import sys
import time
from collections.abc import Sequence
from pathlib import Path

from barchan import listing
from barchan.errors import BarchanError
from barchan.io.study_folder import run_name

EVERY = 5.0  # [s] between two looks at the run
SHARE = 5.0  # pages are so many times as far apart as one takes to write
AFTER = 2.0  # [s] from the end of a run to the last page: the launcher looks for pictures before it draws its own
LOOKED_AT = ("run.json", "history.csv", "dune.csv", "grains.h5")
pause = time.sleep


def fail(sentence: object) -> int:
    print(f"watch: {sentence}", file=sys.stderr)
    return 2


def folder_of(name: str) -> Path:
    """The folder of a run; of a case the one that it runs in by default."""
    path = Path(name)
    return Path("runs") / run_name(path) if path.suffix == ".toml" and not path.is_dir() else path


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="watch", description="Keeps report.html of a running case up to date; "
                                     "the page reloads itself until the run ends.")
    parser.add_argument("run", metavar="RUN_DIR|CASE.toml")
    folder = folder_of(parser.parse_args(arguments).run)
    from barchan.io.run_folder import RunFolder  # h5py takes a while

    try:
        RunFolder(folder)
        if not any((folder / name).exists() for name in ("run.json", "config.toml")):
            raise BarchanError(f"no run in {folder}: it has no run.json")
        return watch(folder)
    except BarchanError as error:
        return fail(error)
    except OSError as error:
        return fail(f"cannot write {error.filename or folder}: {error.strerror or error}")


def is_running(folder: Path) -> bool:
    """Whether a process holds the folder, as its lock file says; of another machine the file is believed."""
    try:
        holder = (folder / ".barchan.lock").read_text(errors="replace")
    except OSError:
        return False
    found = re.match(r"process (\d+) on (\S+)", holder)
    if found is None or found[2] != socket.gethostname():
        return True
    try:
        os.kill(int(found[1]), 0)
    except ProcessLookupError:
        return False
    except PermissionError:
        pass
    return True


def state_of(folder: Path) -> list[float]:
    return [listing.modified(folder / name) for name in LOOKED_AT]


def watch(folder: Path) -> int:
    """A page and a line each time the run has written something."""
    seen: list[float] = []
    began: tuple[float, float] | None = None  # wall clock and time of the run at the first look
    try:
        while is_running(folder):
            now = state_of(folder)
            wait = EVERY
            if now != seen:
                wait = max(EVERY, SHARE * write_page(folder, reload=True))
                if not seen:
                    print(f"open {folder / 'report.html'} in a browser: it reloads itself; Ctrl-C ends watching, "
                          "not the run", flush=True)
                seen = now
                began = tell(folder, began)
            pause(wait)
        if seen:
            pause(AFTER)
    except KeyboardInterrupt:
        write_page(folder, reload=False)
        print("\nno longer watched; the run goes on", file=sys.stderr)
        return 3
    write_page(folder, reload=False)
    summary = listing.summary_of(folder / "run.json")
    status = str(summary.get("status", "unknown"))
    if status == "running":
        status = "ended without a word (killed?)"
    print(f"{status}, t = {reached(folder)}: {folder / 'report.html'}", flush=True)
    return 0


def write_page(folder: Path, reload: bool) -> float:
    """The seconds it took. A page that cannot be written from what is there now is left as it was: the next may be."""
    from barchan import report
    from barchan.errors import MissingData
    from barchan.io.run_folder import RunFolder

    began = time.monotonic()
    try:
        report.write_files(RunFolder(folder), EVERY if reload else None)
    except MissingData:
        if not reload:
            raise
    return time.monotonic() - began


def reached(folder: Path) -> str:
    time_now = listing.time_reached(folder, listing.summary_of(folder / "run.json"))
    return f"{listing.seconds(time_now)} of {listing.seconds(listing.wanted_end(folder))}"


def tell(folder: Path, began: tuple[float, float] | None) -> tuple[float, float] | None:
    """Time reached, and what is left at the pace since the first look, which is returned."""
    now, end = listing.time_reached(folder, listing.summary_of(folder / "run.json")), listing.wanted_end(folder)
    left = ""
    if now is not None and began is not None and end is not None and now > began[1]:
        seconds = (end - now) * (time.monotonic() - began[0]) / (now - began[1])
        left = f", about {seconds / 60:.0f} min left" if seconds > 120 else f", about {max(seconds, 0):.0f} s left"
    share = f", {100 * now / end:.0f} %" if now is not None and end else ""
    print(f"t = {reached(folder)}{share}{left}", flush=True)
    return began or (None if now is None else (time.monotonic(), now))
