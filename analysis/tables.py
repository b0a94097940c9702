"""Tables with comments: references of tests/reference, saved results of docs/validation."""

import platform
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from run_folder import NotInRun

ROOT = Path(__file__).parents[1]
REFERENCE = ROOT / "tests/reference"


@dataclass
class Table:
    """Columns by name, numbers or else strings; notes are comment lines "# name: text"."""

    notes: dict
    columns: dict

    def __getitem__(self, name):
        return self.columns[name]

    def where(self, name, value):
        """The rows whose `name` is `value`."""
        return self.only(self.columns[name] == value)

    def only(self, rows):
        """These rows, a boolean for each."""
        return Table(self.notes, {key: column[rows] for key, column in self.columns.items()})

    def values(self, name):
        """The different values of a column in their order of appearance."""
        return list(dict.fromkeys(self.columns[name].tolist()))


def read_saved(folder, name):
    path = folder / f"{name}.csv"
    if not path.exists():
        raise NotInRun(f"needs {path}")
    return read(path)


def read(path):
    lines = path.read_text().splitlines()
    notes = {}
    for line in lines:
        name, colon, text = line.lstrip("# ").partition(": ")
        if line.startswith("#") and colon:
            notes.setdefault(name, text)
    rows = [line.split(",") for line in lines if line and not line.startswith("#")]
    columns = {name: _numbers(cells) for name, *cells in zip(*rows)}
    return Table(notes, columns)


def _numbers(cells):
    try:
        return np.array(cells, float)
    except ValueError:
        return np.array(cells)


def write(path, notes, lines):
    """`lines` begin with the column names."""
    comments = [f"# {name}: {text}" for name, text in notes.items()]
    path.write_text("\n".join(comments + lines) + "\n")


def machine():
    """Name of the processor."""
    try:
        text = Path("/proc/cpuinfo").read_text()
    except OSError:
        text = ""
    names = [line.partition(":")[2].strip() for line in text.splitlines()
             if line.startswith("model name")]
    return names[0] if names else platform.processor() or "unknown processor"
