"""Reads a study file (docs/studies.md)."""

import datetime
import difflib
import itertools
import json
import math
import os
import re
import tomllib
from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from pathlib import Path

from barchan.errors import BarchanError
from barchan.io.study_folder import run_name

SECTIONS = ("study", "set", "vary", "grid", "case", "cases", "ensemble")
STUDY_KEYS = ("title", "base", "of", "at_once", "threads")
CASE_KEYS = ("name", "like", "set")
ENSEMBLE_KEYS = ("realisations", "cases")
REALISATION = "initial.realisation"


class StudyError(BarchanError):
    """A sentence for the user."""


LONGEST_NAME = 200  # letters of a run's name: files of it and of its pictures have longer ones
MOST_CASES = 10_000  # each is checked before the first one runs
MOST_REALISATIONS = 100


@dataclass
class Case:
    """`base`: the file of the case that is varied. `values`: keys and their values here, the common ones included.

    `varied`: the one key in which the case differs from the base case; None for the base and for grids.
    `realisation`: which member of its ensemble this run is; the first is the case as it stands.
    """

    name: str
    base: Path
    values: dict
    varied: str | None = None
    realisation: int = 1

    @property
    def run_name(self):
        """Name of the run folder: a study made into an ensemble keeps the runs that it has."""
        return self.name if self.realisation == 1 else f"{self.name}-r{self.realisation}"

    def set_options(self):
        values = self.values if self.realisation == 1 else {**self.values, REALISATION: self.realisation}
        options = []
        for key, value in values.items():
            options += ["--set", f"{key}={as_toml(value)}"]
        return options


@dataclass
class Study:
    title: str
    out: Path
    at_once: int
    threads: int
    cases: list  # every realisation of every case
    realisations: int = 1
    keys: list = field(default_factory=list)  # that differ between cases


def as_toml(value):
    """On one line. TypeError for what TOML does not have."""
    if hasattr(value, "tolist"):  # of numpy
        value = value.tolist()
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, (str, Path)):  # the escapes of JSON are among those of TOML
        return json.dumps(str(value), ensure_ascii=False).replace("\x7f", "\\u007f")
    if isinstance(value, (datetime.date, datetime.time)):
        return value.isoformat()
    if isinstance(value, (list, tuple)):
        return "[" + ", ".join(map(as_toml, value)) + "]"
    if isinstance(value, dict):
        return "{" + ", ".join(f"{as_toml(str(key))} = {as_toml(one)}" for key, one in value.items()) + "}"
    if isinstance(value, (int, float)):
        return repr(value)
    raise TypeError(f"a case cannot have a value of type {type(value).__name__}")


def flatten(table, above=""):
    """{"grains": {"restitution": [..]}} and {"grains.restitution": [..]} alike."""
    flat = {}
    for key, value in table.items():
        name = f"{above}{key}"
        if isinstance(value, Mapping):
            flat.update(flatten(value, name + "."))
        else:
            flat[name] = value
    return flat


def lookup(config, key):
    """The value of a key; entries of lists have numbers, from 1. None where there is none."""
    for part in key.split("."):
        if isinstance(config, list):
            config = {str(number): entry for number, entry in enumerate(config, 1)}
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
    if path.exists() and not path.is_file():  # a pipe would be waited for
        raise StudyError(f"cannot read {path}: it is not a file")
    try:
        return tomllib.loads(path.read_text(encoding="utf-8-sig"))
    except OSError as error:
        raise StudyError(f"cannot read {path}: {error.strerror}") from error
    except UnicodeDecodeError as error:
        raise StudyError(f"{path}: it is not UTF-8 text (byte {error.start})") from error
    except tomllib.TOMLDecodeError as error:
        raise StudyError(f"{path}: not TOML: {error}") from error
    except RecursionError as error:
        raise StudyError(f"{path}: not TOML: nested too deep") from error


def merge(under, over):
    """The entries of `over` in place of those of `under`; tables are merged."""
    merged = dict(under)
    for key, value in over.items():
        both = isinstance(value, dict) and isinstance(merged.get(key), dict)
        merged[key] = merge(merged[key], value) if both else value
    return merged


def load_case(path, chain=()):
    """A case over those that it is based on. What is wrong with it the program says when it checks the cases."""
    own = load(path)
    names = own.get("case", {}).get("base", [])
    without = own.get("case", {}).get("without", [])
    config = {}
    for name in [names] if isinstance(names, str) else names:
        base = (path.parent / name).resolve()
        if base not in chain and base.is_file():
            config = merge(config, load_case(base, (*chain, base)))
    for name in [without] if isinstance(without, str) else without:
        *sections, key = name.split(".")
        table = lookup(config, ".".join(sections)) if sections else config
        if isinstance(table, dict):
            table.pop(key, None)
    return merge(config, own)


def lists_of(table, path, section):
    lists = flatten(table)
    for key, values in lists.items():
        if not isinstance(values, list) or not values:
            raise StudyError(f"{path}: [{section}] {key} must be a list of values")
    return lists


def one_at_a_time(lists, base, base_config, common, path):
    """The base case, then for each key its other values."""
    fixed = {key: common.get(key, lookup(base_config, key)) for key in lists}
    for key, value in fixed.items():
        if value is None:  # the program's default is not known here, and a guess would be wrong
            raise StudyError(f"{path}: [vary] {key} has no value in the base case: give it there or in [set]")
    cases = [Case("base", base, {**common, **fixed})]
    for key, values in lists.items():
        cases += [Case(label(key, value), base, {**common, **fixed, key: value}, key)
                  for value in values if value != fixed[key]]
    return cases


def all_combinations(lists, base, common, path):
    if not lists:
        return []
    count = math.prod(len(values) for values in lists.values())
    if count > MOST_CASES:
        raise StudyError(f"{path}: [grid] makes {count} cases, of at most {MOST_CASES}: give fewer keys or values")
    return [Case("_".join(label(key, value) for key, value in zip(lists, values)), base,
                 {**common, **dict(zip(lists, values))})
            for values in itertools.product(*lists.values())]


def tables_of(table):
    """The sections [[case]], then the lines of [cases] as such sections."""
    return [*table.get("case", []), *({"name": name, "like": keys.get("like", []),
                                       "set": {key: value for key, value in keys.items() if key != "like"}}
                                      for name, keys in table.get("cases", {}).items())]


def named_cases(tables, base, common, path):
    cases, own = [], {}  # own: the values of each case without the common ones
    for table in tables:
        for key in table:
            if key not in CASE_KEYS:
                raise unknown(key, CASE_KEYS, f"{path}: [[case]]")
        values, like = {}, table.get("like", [])
        for other in [like] if isinstance(like, str) else like:
            if other not in own:
                raise StudyError(f'{path}: like "{other}": no case before it has this name')
            values |= own[other]
        values |= flatten(table.get("set", {}))
        name = table.get("name") or "_".join(label(key, value) for key, value in values.items())
        if not name or not re.fullmatch(r"[A-Za-z0-9_.+-]+", name) or name.startswith("."):
            raise StudyError(f'{path}: [[case]] name "{name}" must be of letters, digits and _ . + -')
        own[name] = values
        cases.append(Case(name, base, {**common, **values}))
    return cases


def cases_of_files(files, common, path):
    """(cases that other files are, runs of other files that are studies)"""
    cases, runs = [], []
    for name in files:
        file = (path.parent / name).resolve()
        table = load(file)
        if "study" not in table:
            cases.append(Case(file.stem, file, common))
        elif "of" in check_sections(table, file):
            raise StudyError(f'{path}: [study] of: {name} has an "of" itself; name its files here')
        else:
            runs += [replace(case, name=f"{file.stem}-{case.name}", values={**case.values, **common})
                     for case in runs_of(table, file)]
    return cases, runs


def ensemble_of(cases, table, path):
    """Every case, or those that [ensemble] names, as often as it asks for, all first realisations first."""
    for key in table:
        if key not in ENSEMBLE_KEYS:
            raise unknown(key, ENSEMBLE_KEYS, f"{path}: [ensemble]")
    count = table.get("realisations", 1)
    if not (type(count) is int and 1 <= count <= MOST_REALISATIONS):
        raise StudyError(f"{path}: [ensemble] realisations must be a number from 1 to {MOST_REALISATIONS}")
    names = [case.name for case in cases]
    chosen = table.get("cases", names)
    if not isinstance(chosen, list) or not chosen and "cases" in table:
        raise StudyError(f"{path}: [ensemble] cases must be a list of names of cases")
    for name in chosen:
        if name not in names:
            raise unknown(str(name), names, f"{path}: [ensemble] cases")
    return [replace(case, realisation=which) for which in range(1, count + 1) for case in cases
            if which == 1 or case.name in chosen]


def check_kind(value, section, path):
    """[[case]] is a list of sections, the others are sections; those in [cases] are tables."""
    if section != "case":
        if not isinstance(value, dict):
            raise StudyError(f"{path}: {section} must be a section, [{section}]")
        if section == "cases" and not all(isinstance(one, dict) for one in value.values()):
            raise StudyError(f"{path}: [cases] must have a line NAME = {{ key = value }} for each")
        named = value.items() if section == "cases" else ()
        cut = [f"{name}.{key}" for name, keys in named for key in keys if key.isdigit()]
        if cut:
            raise StudyError(f'{path}: [cases] a name with a dot stands in quotes: "{cut[0]}"')
    elif not isinstance(value, list) or not all(isinstance(one, dict) for one in value):
        raise StudyError(f"{path}: case must be given as sections [[case]], one for each")
    else:
        for one in value:
            if not isinstance(one.get("name", ""), str) or not isinstance(one.get("set", {}), dict):
                raise StudyError(f'{path}: [[case]] must have a name = "..." and a set = {{ key = value }}')
    for one in value if section == "case" else value.values() if section == "cases" else ():
        like = one.get("like", [])
        if not isinstance(like, str) and not (isinstance(like, list) and all(isinstance(name, str) for name in like)):
            raise StudyError(f"{path}: like must be the name of a case before it, or a list of them")


def check_sections(table, path):
    if "study" not in table and ("time" in table or "domain" in table):
        raise StudyError(f"{path}: this is a case, not a study: ./barchan run {path}")
    for section in table:
        if section not in SECTIONS:
            raise unknown(section, SECTIONS, path)
        check_kind(table[section], section, path)
    head = table.get("study", {})
    for key in head:
        if key not in STUDY_KEYS:
            raise unknown(key, STUDY_KEYS, f"{path}: [study]")
    files = head.get("of", [])
    if not isinstance(files, list) or not all(isinstance(name, str) for name in files):
        raise StudyError(f"{path}: [study] of must be a list of files, cases or studies")
    varied = any(section in table for section in ("vary", "grid", "case", "cases"))
    if not isinstance(head.get("base", "" if files and not varied else None), str):
        raise StudyError(f"{path}: [study] base must name the case that is varied")
    if not isinstance(head.get("title", ""), str):
        raise StudyError(f"{path}: [study] title must be text")
    for key in ("at_once", "threads"):
        # True is an int to Python.
        if key in head and not (type(head[key]) is int and head[key] >= 1):
            raise StudyError(f"{path}: [study] {key} must be a number of at least 1")
    return head


def runs_of(table, path):
    """Every realisation of every case, all first ones first."""
    head = check_sections(table, path)
    common = flatten(table.get("set", {}))
    cases, runs = cases_of_files(head.get("of", []), common, path)
    if "base" in head:
        base = (path.parent / head["base"]).resolve()
        lists, config = lists_of(table.get("vary", {}), path, "vary"), load_case(base)
        own = one_at_a_time(lists, base, config, common, path) if "vary" in table else []
        own += all_combinations(lists_of(table.get("grid", {}), path, "grid"), base, common, path)
        cases = own + named_cases(tables_of(table), base, common, path) + cases
    runs = ensemble_of(cases, table.get("ensemble", {}), path) + runs
    if not runs:
        raise StudyError(f"{path}: no cases: give [vary], [grid] or [cases]")
    if any(REALISATION in case.values for case in runs if case.realisation > 1):
        raise StudyError(f"{path}: [ensemble] sets {REALISATION} itself: do not give it as well")
    return sorted(runs, key=lambda case: case.realisation)


def read_study(path, options):
    table = load(path)
    cases = runs_of(table, path)
    head = table["study"]
    names = [case.run_name for case in cases]
    for name in names:
        if len(name) > LONGEST_NAME:
            raise StudyError(f"{path}: a case has a name of {len(name)} letters, of at most {LONGEST_NAME} "
                             f'({name[:30]}...): give it a shorter one, [[case]] name = "..."')
        if names.count(name) > 1:
            raise StudyError(f'{path}: two cases are named "{name}"')
    for name, given in (("--at-once", options.at_once), ("--threads", options.threads)):
        if given is not None and given < 1:
            raise StudyError(f"{name} must be at least 1, not {given}")
    cores = len(os.sched_getaffinity(0))
    asked = options.threads or head.get("threads")
    # Runs of one thread each are more in an hour than the same runs one by one on all cores.
    at_once = options.at_once or head.get("at_once", min(len(cases), max(1, cores // (asked or 1))))
    threads = asked or max(1, cores // at_once)
    keys = list(dict.fromkeys(key for case in cases for key in case.values
                              if any(other.values.get(key) != case.values[key] for other in cases)))
    return Study(title=head.get("title", path.stem), at_once=at_once, threads=threads,
                 out=Path(options.out or Path("runs") / run_name(path)), cases=cases,
                 realisations=max(case.realisation for case in cases), keys=keys)
