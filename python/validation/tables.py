"""Tables that the validation reads and saves: references of tests/reference, results of docs/validation."""

import datetime
import platform
from pathlib import Path

from barchan.errors import MissingData
from barchan.io.tables import Table, read_table

__all__ = ["REFERENCE", "ROOT", "Table", "about", "keep", "machine", "read_saved", "read_table", "write"]

ROOT = Path(__file__).resolve().parents[2]
REFERENCE = ROOT / "tests/reference"


def read_saved(folder, name):
    path = folder / f"{name}.csv"
    if not path.exists():
        raise MissingData(f"needs {path}")
    return read_table(path)


def write(path, notes, lines):
    """`lines` begin with the column names."""
    comments = [f"# {name}: {text}" for name, text in notes.items()]
    path.write_text("\n".join(comments + lines) + "\n")


def about(title, command, identity):
    """What a table says of itself; `identity`: the run.json of a run that it was made from."""
    return {"title": title, "command": command, "commit": identity["git_hash"],
            "machine": f'{machine()}; {identity["device"]}', "date": datetime.date.today().isoformat()}


def keep(path, title, command, identity, lines):
    """Writes the table that `about` describes; its path."""
    write(path, about(title, command, identity), lines)
    return path


def machine():
    """Name of the processor."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        text = ""
    names = [line.partition(":")[2].strip() for line in text.splitlines()
             if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"
