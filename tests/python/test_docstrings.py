"""What the page of the API shows says what each function takes and returns, in the form of numpydoc."""

import dataclasses
import importlib
import inspect
import re

import pytest
from fake_runs import ROOT

import barchan

PAGE = (ROOT / "docs/site/api.md").read_text()
SHOWN = {name: re.split(r",\s*", members) if members else None for name, members in
         re.findall(r"^::: ([\w.]+)\n(?:    options:\n      members: \[(.*)\]\n)?", PAGE, re.M)
         if name != "barchan.bmi.BarchanBmi"}  # of which the Basic Model Interface says what each function takes
SECTION = re.compile(r"^(\w[\w ]*)\n-{3,}\n(.*?)(?=^\w[\w ]*\n-{3,}\n|\Z)", re.M | re.S)
KNOWN = ("Parameters", "Attributes", "Returns", "Yields", "Raises", "Warns")


def sections(thing):
    """{heading: {name: its lines}} of a docstring; a result without a name has its type for one."""
    return {heading: {name.lstrip("*"): about for names, about in
                      re.findall(r"^(\S[^:\n]*?)(?: : [^\n]+)?\n((?:^ +[^\n]*\n?|\n)*)", text, re.M)
                      for name in names.split(", ")}
            for heading, text in SECTION.findall(inspect.getdoc(thing) or "")}


def members(thing, name, chosen=None):
    """(name, thing) of a module or class and what is in it, down to the methods of the classes of a module."""
    yield name, thing
    for key, inner in vars(thing).items():
        inner = inspect.unwrap(inner)
        shown = not key.startswith("_") if chosen is None else key in chosen
        own = inspect.isclass(thing) or getattr(inner, "__module__", None) == thing.__name__
        if shown and own and inspect.isclass(inner):
            yield from members(inner, f"{name}.{key}")
        elif shown and own and inspect.isfunction(inner):
            yield f"{name}.{key}", inner


def public(name):
    """The same of what a line of the page shows."""
    thing = vars(barchan).get(name.removeprefix("barchan."))
    if thing is None or inspect.ismodule(thing):
        thing = importlib.import_module(name)
    if inspect.isfunction(thing):
        yield name, thing
    else:
        yield from members(thing, name, SHOWN[name])


THINGS = [(name, thing) for shown in SHOWN for name, thing in public(shown)]
FUNCTIONS = [pytest.param(thing, id=name) for name, thing in THINGS if inspect.isfunction(thing)]
CLASSES = [pytest.param(thing, id=name) for name, thing in THINGS
           if inspect.isclass(thing) and not issubclass(thing, Exception)]


def test_the_page_shows_the_package():
    assert {f"barchan.{name}" for name in barchan.__all__} <= set(SHOWN)
    assert PAGE.count("members:") == sum(chosen is not None for chosen in SHOWN.values())
    for name, chosen in SHOWN.items():
        assert chosen is None or {f"{name}.{one}" for one in chosen} <= {thing for thing, _ in THINGS}
    assert len(FUNCTIONS) > 50 and len(CLASSES) >= 6


@pytest.mark.parametrize("function", FUNCTIONS)
def test_a_function_says_what_it_takes_and_returns(function):
    found, signature = sections(function), inspect.signature(function)
    assert set(found) <= set(KNOWN)
    taken = [name for name in signature.parameters if name != "self"]
    assert list(found.get("Parameters", ())) == taken
    returned = found.get("Returns") or found.get("Yields")
    assert (signature.return_annotation in (None, "None")) != bool(returned)
    for section in found.values():
        assert all(about.strip() for about in section.values()), section


@pytest.mark.parametrize("cls", CLASSES)
def test_a_class_says_what_it_is_made_of(cls):
    found = sections(cls)
    taken = [field.name for field in dataclasses.fields(cls)] if dataclasses.is_dataclass(cls) else \
        [name for name in inspect.signature(cls).parameters]
    described = list(found.get("Parameters", ())) + list(found.get("Attributes", ()))
    assert described[:len(taken)] == taken


@pytest.mark.parametrize("broken, says", [
    ("Parameters\n----------\nt : float\n    Time.\n", ["t"]), ("t: float", []),
    ("Parameters\n----------\nx, y : float\n    Places.\n**options\n    Others.\n\nReturns\n-------\nfloat\n    One.\n",
     ["x", "y", "options"])])
def test_sections_are_read(broken, says):
    def function():
        pass
    function.__doc__ = f"What it does.\n\n{broken}"
    assert list(sections(function).get("Parameters", ())) == says
