"""What a figure has besides its picture: the numbers behind it, and what it says in words."""

import json
import math
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from barchan.io import writing
from barchan.io.run_folder import json_of
from barchan.io.study_folder import shown
from barchan.io.tables import thin

MOST = 2000          # lines of a table
MOST_OF_A_CASE = 500  # of a table over the cases of a study


@dataclass
class Told:
    """In place of a picture: sentences, and numbers {table: {column: values}}."""

    sentences: list[str]
    numbers: dict[str, dict[str, Sequence]] = field(default_factory=dict)


def keep(figure: Any, table: str, columns: Mapping[str, Sequence], most: int | None = MOST) -> None:
    """Adds a table of {column: values (n)} to figure.numbers, at most `most` lines of it (None: all)."""
    count = len(next(iter(columns.values())))
    rows = thin(count, most or count)
    numbers = figure.__dict__.setdefault("numbers", {})
    numbers[table] = {name: [values[row] for row in rows] for name, values in columns.items()}


def keep_cases(figure: Any, table: str, columns: Mapping[str, Sequence[Sequence]]) -> None:
    """The same of {column: one sequence for each case}, at most 500 lines a case."""
    chosen = [thin(len(part), MOST_OF_A_CASE) for part in next(iter(columns.values()))]
    flat = {name: [part[row] for part, rows in zip(parts, chosen) for row in rows] for name, parts in columns.items()}
    figure.__dict__.setdefault("numbers", {})[table] = flat


def say(figure: Any, sentences: Iterable[str]) -> None:
    """What the figure says in words: figure.sentences."""
    figure.sentences = list(sentences)


def publish(figure: Any, table: str, columns: Mapping[str, Sequence]) -> None:
    """The same for a table that is a result of the run: figure.results."""
    figure.__dict__.setdefault("results", {})[table] = dict(columns)


def write_numbers(result: Any, folder: Path) -> None:
    """Each table of a figure as folder/figures_data/TABLE.csv; results as folder/TABLE.csv, and in run.json by name."""
    tables = getattr(result, "numbers", {})
    for name, columns in tables.items():
        writing.write(writing.folder(folder / "figures_data") / f"{name}.csv", csv_text(columns))
    for name, columns in getattr(result, "results", {}).items():
        writing.write(folder / f"{name}.csv", csv_text(columns))
        add_to_summary(folder / "run.json", name, [dict(zip(columns, row)) for row in zip(*columns.values())])


def csv_text(columns: Mapping[str, Sequence]) -> str:
    lines = [",".join(columns)]
    lines += [",".join(map(cell, row)) for row in zip(*columns.values())]
    return "\n".join(lines) + "\n"


def add_to_summary(path: Path, name: str, rows: list[dict[str, Any]]) -> None:
    """An entry of run.json, in which numbers that are not finite are null. A run that goes on keeps its own."""
    summary = json_of(path)
    if not summary or summary.get("status") == "running":
        return
    known = [{key: None if isinstance(value, float) and not math.isfinite(value) else value
              for key, value in row.items()} for row in rows]
    writing.write(path, json.dumps(summary | {name: known}, indent=2, ensure_ascii=False) + "\n")


def cell(value: Any) -> str:
    if isinstance(value, (float, np.floating, int, np.integer, np.bool_)):
        return f"{float(value):.9g}"
    return shown(value).replace(",", ";")
