"""Reads a study folder: study.json and the run folders of its cases, as `barchan sweep` leaves them.

Cases may be absent, unfinished or failed: what they have is used, `gaps` says what they lack.
"""

import fnmatch
import json
import os
from collections.abc import Callable, Iterable
from dataclasses import dataclass, field
from functools import cached_property
from pathlib import Path
from typing import Any

from barchan.errors import BarchanError, MissingData
from barchan.io.run_folder import RunFolder

NAME = "study.json"
SYMBOLS = {"grains.sliding_friction": "$\\mu$", "grains.restitution": "$e$",
           "grains.rolling_friction": "$\\mu_r$"}
BY_NAME = "case"  # what differs between the cases of a study that varies no single key


@dataclass
class Case:
    """`varied` is the key it changes, None for the base case; `values` of all keys studied. `base`: the file that is
    varied; empty in studies of earlier versions.

    `run` is its first realisation, `others` are further ones that are there.
    """

    name: str
    varied: str | None
    values: dict[str, Any]
    run: Any
    gap: str | None
    base: str = ""
    others: list = field(default_factory=list)

    @property
    def runs(self) -> list:
        return [self.run] * bool(self.run) + self.others

    @property
    def label(self) -> str:
        """What distinguishes it, for a legend."""
        return plain(self.name) if self.varied is None else self.label_in(self.varied)

    def label_in(self, key: str) -> str:
        """The same in the series of a key."""
        return plain(self.name) if key == BY_NAME else f"{symbol(key)} = {plain(shown(self.values.get(key)))}"


def symbol(key: str) -> str:
    """The name of a configuration key in a figure."""
    return SYMBOLS.get(key) or plain(key.rpartition(".")[2].replace("_", " "))


def run_name(file: str | Path) -> str:
    """What a case or a study is called by its file, and so its folder in runs/: as case_name of src/base/words.hpp."""
    *folders, name = Path(os.path.abspath(file)).parts
    above = len(folders) - folders[::-1].index("configs") if "configs" in folders else len(folders)
    stem = name[:dot] if (dot := name.rfind(".")) > 0 else name
    return "/".join([*folders[above:], name if stem in (".", "..") else stem])


def plain(text: str) -> str:
    """The user's words, for matplotlib: dollars in them begin no formula, and a legend leaves nothing out."""
    return "\u200b" * text.startswith("_") + text.replace("$", "\\$")


def shown(value: object) -> str:
    if isinstance(value, list):
        return " x ".join(map(shown, value))
    return f"{value:g}" if isinstance(value, (int, float)) else str(value)


def gap_of(path: Path) -> str | None:
    """Why a case is not whole: a few words, None when it is done."""
    if not path.is_dir():
        return "is not there"
    status = RunFolder(path).summary.get("status")
    if status is None:
        return "has no readable run.json"
    return None if status == "done" else {"failed": "failed"}.get(status, "is unfinished")


class StudyFolder:
    """The cases of a study."""

    run_class: type[RunFolder] = RunFolder

    def __init__(self, path: str | Path, only: Iterable[str] = ()) -> None:
        """`only`: the cases whose names fit one of these patterns (*, ?, [abc]); all by default."""
        self.path = Path(path)
        self.only = [only] if isinstance(only, str) else list(only)
        try:
            study = json.loads((self.path / NAME).read_text())
            self.title = study.get("title") or self.path.resolve().name
            self.cases = [self._case(entry) for entry in study["cases"] if entry.get("realisation", 1) == 1]
            self._add_realisations(entry for entry in study["cases"] if entry.get("realisation", 1) > 1)
        except (OSError, ValueError, RecursionError) as error:
            raise BarchanError(f"cannot read {self.path / NAME}: {error}") from error
        except (KeyError, TypeError, AttributeError) as error:
            raise BarchanError(f"{self.path / NAME} does not list its cases as a study does") from error
        for pattern in self.only:
            if not fnmatch.filter([case.name for case in self.cases], pattern):
                raise BarchanError(f'no case "{pattern}" in {self.path}; it has '
                                   + ", ".join(case.name for case in self.cases))
        self.cases = [case for case in self.cases
                      if not self.only or any(fnmatch.fnmatchcase(case.name, pattern) for pattern in self.only)]

    def _case(self, entry: dict[str, Any]) -> Case:
        path = self.path / entry["folder"]
        run = self.run_class(path) if path.is_dir() else None
        values = {**entry.get("values", {}), BY_NAME: str(entry["name"])}
        return Case(str(entry["name"]), entry.get("varied"), values, run, gap_of(path),
                    entry.get("base", ""))

    def _add_realisations(self, entries: Iterable[dict[str, Any]]) -> None:
        cases = {case.name: case for case in self.cases}
        for entry in entries:
            path, case = self.path / entry["folder"], cases[entry["case"]]
            if path.is_dir():
                case.others.append(self.run_class(path))
            gap = gap_of(path)
            if gap:
                said = f"in realisation {entry['realisation']} {gap}"
                case.gap = f"{case.gap}, {said}" if case.gap else said

    @property
    def gaps(self) -> str:
        """One sentence on the cases that are not whole; empty when all are."""
        return ", ".join(f"{case.name} {case.gap}" for case in self.cases if case.gap)

    @cached_property
    def keys(self) -> list[str]:
        """The keys that are varied one at a time, in order of appearance; else BY_NAME."""
        varied = list(dict.fromkeys(case.varied for case in self.cases if case.varied))
        return varied or [BY_NAME] * bool(self.cases)

    def short(self, key: str) -> str:
        """The last part of a key, for the names of files; all of it where two keys end alike."""
        last = key.rpartition(".")[2]
        alike = [other for other in self.keys if other.rpartition(".")[2] == last]
        return last if len(alike) < 2 else key.replace(".", "_")

    def series(self, key: str, usable: Callable[[Any], bool] = lambda run: True) -> list[Case]:
        """Cases that differ in `key` alone, by its value; those that are there and `usable`.

        The base case belongs to every series; of two cases of one base and value the first is kept.
        """
        if key not in self.keys:
            raise MissingData(f"needs a study of {key}")
        chosen: dict[str, Case] = {}
        for case in self.cases:
            if case.varied in (None, key) and key in case.values and case.run and usable(case.run):
                chosen.setdefault(json.dumps([case.base, case.values[key]]), case)
        cases = list(chosen.values())
        if all(isinstance(case.values[key], (int, float)) for case in cases):
            cases.sort(key=lambda case: case.values[key])
        return cases
