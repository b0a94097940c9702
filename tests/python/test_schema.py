"""barchan keys --schema: JSON Schema of a case, which takes every case here and refuses mistakes."""

import argparse
import copy
import json
import os
import re
import subprocess
import tomllib

import jsonschema
import pytest
from fake_runs import ROOT

from barchan.studies.spec import load_case, merge, read_study

PROGRAM = os.environ.get("BARCHAN_PROGRAM", "")
pytestmark = pytest.mark.skipif(not PROGRAM, reason="needs the program, whose path BARCHAN_PROGRAM has")
FILES = sorted((ROOT / "configs").rglob("*.toml"))
STUDIES = [path for path in FILES if "[study]" in path.read_text()]
CASES = [path for path in FILES if path not in STUDIES]


def named(paths):
    return {"argvalues": paths, "ids": [str(path.relative_to(ROOT / "configs")) for path in paths]}


@pytest.fixture(scope="module")
def schema():
    said = subprocess.run([PROGRAM, "keys", "--schema"], check=True, capture_output=True, text=True).stdout
    schema = json.loads(said)
    jsonschema.Draft4Validator.check_schema(schema)
    assert schema["$schema"] == "http://json-schema.org/draft-04/schema#"
    return schema


@pytest.fixture
def valid(schema):
    return jsonschema.Draft4Validator(schema).is_valid


def load(path):
    return tomllib.loads(path.read_text())


def changed(dotted, value):
    """The case of a dune with a key that has this value, or without the key: None."""
    name = "channel-small" if value is None else "quickstart"  # the second is based on the first, and may lack keys
    case = copy.deepcopy(load(ROOT / f"configs/{name}.toml"))
    *outer, name = dotted.split(".")
    section = case
    for part in outer:
        section = section.setdefault(part, {})
    if value is None:
        del section[name]
    else:
        section[name] = value
    return case


@pytest.mark.parametrize("path", **named(CASES))
def test_every_case_here_is_valid(valid, path):
    assert valid(load(path))


@pytest.mark.parametrize("path", **named(STUDIES))
def test_every_case_of_a_study_here_is_valid(valid, path):
    study = read_study(path, argparse.Namespace(at_once=None, threads=None, out=None))
    assert study.cases
    for case in study.cases:
        values = tomllib.loads("\n".join(case.set_options()[1::2]))
        assert valid(merge(load_case(case.base), values)), (case.name, values)


def test_cases_that_tests_run_are_valid(valid):
    for name in ("tests/support/small_dune.toml", "tests/reference/bodies.toml", "tests/reference/bodies-2.toml"):
        assert valid(load(ROOT / name)), name


@pytest.mark.parametrize("key, value", [
    ("grains.sliding_fricton", 0.5), ("grain", {}), ("fluid.cels", [1, 2, 3]),                     # names
    ("time.end", "2 s"), ("fluid.cells", [44, 36, 20.5]), ("fluid.cells", [44, 36]), ("grains.frozen", "yes"),
    ("grains.sizes", [[2e-4, 1.5]]), ("grains.sizes", [2e-4, 100]), ("case.title", 3), ("domain", 3),  # types
    ("grains.restitution", 1.5), ("grains.restitution", 0), ("time.end", 0), ("grains.feed.seed", -1),
    ("fluid.cells", [0, 36, 20]), ("case.title", 201 * "a"), ("solver.pressure_tolerance", 1),      # ranges
    ("coupling.drag", "gidaspo"), ("coupling.forces", ["drag", "weight"]),                          # choices
    ("fluid.schedule", [{"velocity": 0.2}]), ("body", [{"name": "b"}]), ("body", {"name": "b", "shape": "box"}),
    ("time.end", None), ("domain.size", None), ("fluid.cells", None),                               # required
    ("domain.size", ["10 km", 0.02, 0.02]), ("domain.size", ["d", 0.02, 0.02]), ("time.grain_step", "automatic")])
def test_mistakes_are_refused(valid, key, value):
    assert valid(changed("case.title", "as it was")) and not valid(changed(key, value))


@pytest.mark.parametrize("key, value", [
    ("domain.size", ["8 cm", 0.02, "100 d"]), ("grains.skin", "0.2 mm"), ("time.fluid_step", "auto"),
    ("time.grain_step", "auto"), ("fluid.mean_velocity", [0.2, -0.1]), ("fluid.mean_velocity", 1),
    ("body", [{"name": "b", "shape": "cylinder", "centre": ["2 cm", 0.01], "radius": "3 d"}]),
    ("coupling.forces", []), ("initial.grains", {"pour": {"radius": 0.01}}), ("initial.grains", "grains.csv")])
def test_other_ways_to_write_a_value(valid, key, value):
    assert valid(changed(key, value))


def test_what_a_case_takes_over_it_need_not_say(valid):
    assert not valid({"grains": {}})
    assert valid({"case": {"base": "other.toml"}, "grains": {}, "fluid": {"bottom": "no_slip"}})
    assert valid({"case": {"base": ["a.toml", "b.toml"], "without": ["grains.feed"]}})
    assert not valid({"case": {"base": 3}})


def test_words_and_defaults_are_those_of_the_keys(schema):
    pages = subprocess.run([PROGRAM, "keys"], check=True, capture_output=True, text=True).stdout
    end = schema["properties"]["time"]["properties"]["end"]
    assert end["description"] == "time at which the run ends [s]" and "default" not in end
    keys = schema["properties"]["grains"]["properties"]
    assert f"| `restitution` | number, above 0 and at most 1 | `{keys['restitution']['default']}`" in pages
    assert keys["wall"]["properties"]["restitution"]["description"].endswith("default as in `[grains]`")
    rows = re.findall(r"^\| `(\w+)` \|", pages, re.M)

    def names_in(part):
        inner = part.get("properties", {})
        parts = [part.get("items"), *part.get("anyOf", ()), *inner.values()]
        return [*inner, *(name for one in parts if isinstance(one, dict) for name in names_in(one))]

    names = names_in({"properties": schema["properties"]})
    assert len(rows) > 100 and all(names.count(name) >= rows.count(name) for name in rows)
