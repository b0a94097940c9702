"""Tables in CSV: those of a run, and those with comments that hold references and saved results."""

from dataclasses import dataclass
from pathlib import Path

import numpy as np

DATA = Path(__file__).resolve().parents[1] / "data"


@dataclass
class Table:
    """Columns by name, numbers or else strings; notes are comment lines "# name: text"."""

    notes: dict[str, str]
    columns: dict[str, np.ndarray]

    def __getitem__(self, name: str) -> np.ndarray:
        return self.columns[name]

    def where(self, name: str, value: object) -> "Table":
        """The rows whose `name` is `value`."""
        return self.only(self.columns[name] == value)

    def only(self, rows: np.ndarray) -> "Table":
        """These rows, a boolean for each."""
        return Table(self.notes, {key: column[rows] for key, column in self.columns.items()})

    def values(self, name: str) -> list:
        """The different values of a column in their order of appearance."""
        return list(dict.fromkeys(self.columns[name].tolist()))


def read_table(path: Path) -> Table:
    """A CSV with comments. Columns are floats where every cell is a number, else strings."""
    lines = path.read_text().splitlines()
    notes: dict[str, str] = {}
    for line in lines:
        name, colon, text = line.lstrip("# ").partition(": ")
        if line.startswith("#") and colon:
            notes.setdefault(name, text)
    rows = [line.split(",") for line in lines if line and not line.startswith("#")]
    columns = {name: _numbers(cells) for name, *cells in zip(*rows)}
    return Table(notes, columns)


def _numbers(cells: list[str]) -> np.ndarray:
    try:
        return np.array(cells, float)
    except ValueError:
        return np.array(cells)


def read_columns(path: Path) -> dict[str, np.ndarray]:
    """Columns of a run's CSV by name, as floats; lines that are cut short are left out. {} for no file or no line."""
    lines = path.read_text(errors="replace").splitlines() if path.is_file() else []
    if not lines:
        return {}
    names = [name.strip() for name in lines[0].split(",")]
    rows = []
    for line in lines[1:]:
        cells = line.split(",")
        if len(cells) != len(names):
            continue
        try:
            rows.append([float(cell) if cell.strip() else np.nan for cell in cells])
        except ValueError:
            continue
    columns = np.array(rows).reshape(-1, len(names)).T
    return dict(zip(names, columns))


def thin(n: int, most: int = 2000) -> np.ndarray:
    """Indices of at most `most` of n lines, first and last included."""
    if n <= most:
        return np.arange(n)
    return np.unique(np.linspace(0, n - 1, most).round().astype(int))
