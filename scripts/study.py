"""Reads a study file (docs/conventions.md, "Studies")."""

import difflib
import itertools
import os
import re
import tomllib
from dataclasses import dataclass, field
from pathlib import Path

SECTIONS = ("study", "set", "vary", "grid", "case")
STUDY_KEYS = ("title", "base", "at_once", "threads")


class StudyError(Exception):
    """A sentence for the user."""


@dataclass
class Case:
    """`values`: keys of the configuration and their values here, the study's common ones included.

    `varied`: the one key in which the case differs from the base case; None for the base and for grids.
    """

    name: str
    values: dict
    varied: str | None = None

    def set_options(self):
        options = []
        for key, value in self.values.items():
            options += ["--set", f"{key}={as_toml(value)}"]
        return options


@dataclass
class Study:
    title: str
    base: Path
    out: Path
    at_once: int
    threads: int
    cases: list
    keys: list = field(default_factory=list)  # that differ between cases


def as_toml(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return '"' + value.replace("\\", "\\\\").replace('"', '\\"') + '"'
    if isinstance(value, list):
        return "[" + ", ".join(as_toml(one) for one in value) + "]"
    return repr(value)


def flatten(table, above=""):
    """{"grains": {"restitution": [..]}} and {"grains.restitution": [..]} alike."""
    flat = {}
    for key, value in table.items():
        name = f"{above}{key}"
        if isinstance(value, dict):
            flat.update(flatten(value, name + "."))
        else:
            flat[name] = value
    return flat


def lookup(config, key):
    for part in key.split("."):
        config = config.get(part) if isinstance(config, dict) else None
    return config


def label(key, value):
    text = f"{value:g}" if isinstance(value, float) else str(value)
    return re.sub(r"[^A-Za-z0-9_.+-]+", "_", f"{key.rpartition('.')[2]}-{text}").strip("_")


def unknown(name, known, where):
    near = difflib.get_close_matches(name, known, n=1)
    hint = f' (did you mean "{near[0]}"?)' if near else ""
    return StudyError(f'{where}: unknown name "{name}"{hint}; there are {", ".join(known)}')


def load(path):
    try:
        return tomllib.loads(path.read_text())
    except OSError as error:
        raise StudyError(f"cannot read {path}: {error.strerror}") from error
    except (tomllib.TOMLDecodeError, UnicodeDecodeError) as error:
        raise StudyError(f"{path}: {error}") from error


def lists_of(table, path, section):
    lists = flatten(table)
    for key, values in lists.items():
        if not isinstance(values, list) or not values:
            raise StudyError(f"{path}: [{section}] {key} must be a list of values")
    return lists


def one_at_a_time(lists, base_config, common, path):
    """The base case, then for each key its other values."""
    fixed = {key: common.get(key, lookup(base_config, key)) for key in lists}
    for key, value in fixed.items():
        if value is None:  # the program's default is not known here, and a guess would be wrong
            raise StudyError(f"{path}: [vary] {key} has no value in the base case: give it there or in [set]")
    cases = [Case("base", {**common, **fixed})]
    for key, values in lists.items():
        cases += [Case(label(key, value), {**common, **fixed, key: value}, key)
                  for value in values if value != fixed[key]]
    return cases


def all_combinations(lists, common):
    if not lists:
        return []
    return [Case("_".join(label(key, value) for key, value in zip(lists, values)),
                 {**common, **dict(zip(lists, values))})
            for values in itertools.product(*lists.values())]


def named_cases(tables, common, path):
    cases = []
    for table in tables:
        for key in table:
            if key not in ("name", "set"):
                raise unknown(key, ("name", "set"), f"{path}: [[case]]")
        values = flatten(table.get("set", {}))
        name = table.get("name") or "_".join(label(key, value) for key, value in values.items())
        if not name or not re.fullmatch(r"[A-Za-z0-9_.+-]+", name) or name.startswith("."):
            raise StudyError(f'{path}: [[case]] name "{name}" must be of letters, digits and _ . + -')
        cases.append(Case(name, {**common, **values}))
    return cases


def check_sections(table, path):
    for section in table:
        if section not in SECTIONS:
            raise unknown(section, SECTIONS, path)
    head = table.get("study", {})
    for key in head:
        if key not in STUDY_KEYS:
            raise unknown(key, STUDY_KEYS, f"{path}: [study]")
    if not isinstance(head.get("base"), str):
        raise StudyError(f"{path}: [study] base must name the case that is varied")
    for key in ("at_once", "threads"):
        if key in head and not (isinstance(head[key], int) and head[key] >= 1):
            raise StudyError(f"{path}: [study] {key} must be a number of at least 1")
    return head


def read_study(path, options):
    table = load(path)
    head = check_sections(table, path)
    base = (path.parent / head["base"]).resolve()
    base_config = load(base)
    common = flatten(table.get("set", {}))
    cases = []
    if "vary" in table:
        cases += one_at_a_time(lists_of(table["vary"], path, "vary"), base_config, common, path)
    cases += all_combinations(lists_of(table.get("grid", {}), path, "grid"), common)
    cases += named_cases(table.get("case", []), common, path)
    if not cases:
        raise StudyError(f"{path}: no cases: give [vary], [grid] or [[case]]")
    names = [case.name for case in cases]
    for name in names:
        if names.count(name) > 1:
            raise StudyError(f'{path}: two cases are named "{name}"')
    at_once = options.at_once or head.get("at_once", 1)
    cores = len(os.sched_getaffinity(0))
    threads = options.threads or head.get("threads", max(1, cores // at_once))
    if at_once < 1 or threads < 1:
        raise StudyError("--at-once and --threads must be at least 1")
    keys = list(dict.fromkeys(key for case in cases for key in case.values
                              if any(other.values.get(key) != case.values[key] for other in cases)))
    return Study(title=head.get("title", path.stem), base=base, at_once=at_once, threads=threads,
                 out=Path(options.out or Path("runs") / path.stem), cases=cases, keys=keys)
