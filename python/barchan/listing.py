"""Runs below a folder: barchan list [FOLDER]: status, time reached, last written, last restart file, size, title.

Exit status: 0, also where there is none; 2: no such folder.
"""

import argparse
import json
import os
import sys
import time
from collections.abc import Iterator, Sequence
from pathlib import Path
from typing import Any

HEAD = ("run", "status", "time", "of", "written", "restart at step", "size", "title")
UNITS = ((86400.0, "d"), (3600.0, "h"), (60.0, "min"))
DRAWN = (".png", ".pdf", ".svg", ".html", ".mp4")  # later than the run
NOT_ENTERED = ("figures_data", "vtkhdf", "movie")


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="list", description="Runs below a folder, the last written first.")
    parser.add_argument("folder", metavar="FOLDER", nargs="?", default="runs", help="default: runs")
    folder = Path(parser.parse_args(arguments).folder)
    if not folder.is_dir():
        print(f"list: no such folder: {folder}", file=sys.stderr)
        return 2
    found = sorted(runs_below(folder), key=lambda run: -run[1])
    if not found:
        print(f"no runs below {folder}")
        return 0
    rows = [HEAD, *(row(path, written, folder) for path, written in found)]
    widths = [max(len(line[column]) for line in rows) for column in range(len(HEAD) - 1)]
    for line in rows:
        print("  ".join([*(cell.ljust(width) for cell, width in zip(line, widths)), line[-1]]).rstrip())
    return 0


def runs_below(folder: Path) -> Iterator[tuple[Path, float]]:
    """(run folder, seconds since the epoch when it was last written); links are not followed."""
    for name, folders, files in os.walk(folder):
        folders[:] = sorted(set(folders) - set(NOT_ENTERED))
        if "run.json" in files or ("config.toml" in files and "log.txt" in files):
            path = Path(name)
            yield path, max(modified(path / file) for file in files if not file.endswith(DRAWN))


def modified(path: Path) -> float:
    try:
        return path.lstat().st_mtime
    except OSError:  # renamed meanwhile, as files of a running case are
        return 0.0


def row(path: Path, written: float, folder: Path) -> tuple[str, ...]:
    summary = summary_of(path / "run.json")
    steps = [file.stem.removeprefix("restart_").lstrip("0") or "0" for file in sorted(path.glob("restart_*.h5"))]
    relative = path.relative_to(folder)
    return (str(path if str(relative) == "." else relative), str(summary.get("status", "unknown")),
            seconds(time_reached(path, summary)), seconds(wanted_end(path)), age(time.time() - written),
            steps[-1] if steps else "-", size(path), str(summary.get("title", "")))


def summary_of(path: Path) -> dict[str, Any]:
    """run.json, {} where it is not there or not whole."""
    try:
        found = json.loads(path.read_text(encoding="utf-8"))
    except (OSError, ValueError):
        return {}
    return found if isinstance(found, dict) else {}


def time_reached(path: Path, summary: dict[str, Any]) -> float | None:
    """[s] of the last line of history.csv, which a running case also has; else of run.json."""
    try:
        with open(path / "history.csv", "rb") as file:
            file.seek(max(0, file.seek(0, os.SEEK_END) - 4096))
            return float(file.read().splitlines()[-1].split(b",")[0])
    except (OSError, ValueError, IndexError):
        known = summary.get("simulated_seconds")
        return known if isinstance(known, int | float) else None


def wanted_end(path: Path) -> float | None:
    import tomllib

    try:
        return float(tomllib.loads((path / "config.toml").read_text(encoding="utf-8"))["time"]["end"])
    except (OSError, ValueError, KeyError, TypeError):
        return None


def seconds(value: float | None) -> str:
    return "-" if value is None else f"{value:.4g} s"


def age(elapsed: float) -> str:
    for unit, name in UNITS:
        if elapsed >= unit:
            return f"{elapsed / unit:.0f} {name} ago"
    return "now" if elapsed < 5 else f"{elapsed:.0f} s ago"


def size(path: Path) -> str:
    """Of the files in the folder itself."""
    total = 0.0
    for file in path.iterdir():
        try:
            total += file.lstat().st_size if file.is_file() and not file.is_symlink() else 0
        except OSError:
            continue
    for unit in ("B", "kB", "MB"):
        if total < 1000:
            return f"{total:.3g} {unit}"
        total /= 1000
    return f"{total:.3g} GB"
