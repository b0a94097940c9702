"""Folders of benchmark/: what is to be reported, the reference, and the results that are kept."""

import json
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from barchan.errors import BarchanError, MissingData
from barchan.io.tables import read_table

ROOT = Path(__file__).resolve().parents[2]
FOLDER = ROOT / "benchmark"
RESULT_COLUMNS = "quantity,at,value,spread"
OWN = "barchan"


class BenchmarkError(BarchanError):
    """A sentence for the user."""


@dataclass
class Curve:
    """Values of a quantity at `at` (n), NaN for a single number; errors or spreads (n); `against`: what `at` is."""

    at: np.ndarray
    value: np.ndarray
    error: np.ndarray
    unit: str = ""
    source: str = ""
    against: str = ""


@dataclass
class Case:
    """One folder of benchmark/: `title` is the first heading of its statement."""

    name: str

    @property
    def path(self):
        return FOLDER / self.name

    @property
    def title(self):
        return (self.path / "statement.md").read_text(encoding="utf-8").splitlines()[0].removeprefix("# ")

    @property
    def reference(self):
        """Name -> Curve, in the order of reference.csv."""
        return read_curves(self.path / "reference.csv", "error")

    def result_file(self, program=OWN):
        return self.path / "results" / f"{program}.csv"

    @property
    def programs(self):
        """Those whose results are kept, ours first."""
        names = sorted(file.stem for file in (self.path / "results").glob("*.csv"))
        return sorted(names, key=lambda name: name != OWN)

    def result(self, program=OWN):
        """Notes and name -> Curve of the results of a program."""
        file = self.result_file(program)
        if not file.exists():
            raise MissingData(f"needs {file.relative_to(ROOT)}")
        return read_table(file).notes, read_results(file, self)


def names():
    """All cases, in the order of benchmark/cases.json."""
    return json.loads((FOLDER / "cases.json").read_text(encoding="utf-8"))


def find(name):
    if name not in names():
        raise BenchmarkError(f"there is no benchmark case '{name}'; there are {', '.join(names())}")
    return Case(name)


def number(text, file, line):
    """A number, NaN for an empty field."""
    try:
        return float(text) if text.strip() else np.nan
    except ValueError:
        raise BenchmarkError(f"{file}:{line}: '{text}' is not a number") from None


def read_curves(file, error):
    """Name -> Curve of a table with the columns quantity, at, value and `error`; lines with # are notes.

    A reference without a value is a quantity to report that nobody has measured.
    """
    rows, header = {}, None
    try:
        lines = Path(file).read_text(encoding="utf-8-sig").splitlines()
    except OSError as problem:
        raise BenchmarkError(f"cannot read {file}: {problem.strerror}") from None
    except UnicodeDecodeError:
        raise BenchmarkError(f"cannot read {file}: it is not UTF-8") from None
    for at, line in enumerate(lines, 1):
        fields = [field.strip() for field in line.split(",")]
        if not line.strip() or line.startswith("#"):
            continue
        if header is None:
            header = fields
            missing = [name for name in ("quantity", "at", "value", error) if name not in header]
            if missing:
                raise BenchmarkError(f"{file}:{at}: needs the columns {', '.join(missing)}")
            continue
        if len(fields) != len(header):
            raise BenchmarkError(f"{file}:{at}: has {len(fields)} fields, not {len(header)}")
        row = dict(zip(header, fields))
        numbers = [number(row[name], file, at) for name in ("at", "value", error)]
        if not np.isfinite(numbers[1]) and error == "spread":
            raise BenchmarkError(f"{file}:{at}: needs a value")
        words = [row.get(name, "") for name in ("unit", "source", "against")]
        rows.setdefault(row["quantity"], []).append((*numbers, *words))
    if not rows:
        raise BenchmarkError(f"{file}: has no values")
    return {name: curve(of) for name, of in rows.items()}


def curve(rows):
    """Of rows (at, value, error, unit, source, against), in order of `at`."""
    rows = sorted(rows, key=lambda row: row[0])
    at, value, error = np.array([row[:3] for row in rows], float).T
    return Curve(at, value, error, *rows[0][3:])


def read_results(file, case):
    """Results of a program for a case: quantities of the reference only."""
    found, known = read_curves(file, "spread"), case.reference
    for name in found:
        if name not in known:
            raise BenchmarkError(f"{file}: '{name}' is not a quantity of {case.name}; there are {', '.join(known)}")
        check(file, name, found[name], known[name])
    return found


def check(file, name, one, reference):
    """Refuses a curve without places, two values at one place, and a negative spread."""
    single = np.isnan(reference.at).all()
    if single and one.value.size > 1:
        raise BenchmarkError(f"{file}: {name} is one number, not {one.value.size}")
    if not single and np.isnan(one.at).any():
        raise BenchmarkError(f"{file}: {name} needs `at` in each line: {reference.against}")
    if np.unique(one.at).size < one.at.size:
        raise BenchmarkError(f"{file}: {name} has two values at one place")
    if (one.error < 0).any():
        raise BenchmarkError(f"{file}: {name} has a negative spread")
