#!/usr/bin/python3
"""Every test that docs/validation.md names exists: `Suite.Name` (or `Suite.Begin*`) and `script.name`."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECLARED = re.compile(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", re.M)
NAMED = re.compile(r"`([A-Z]\w+\.\w*(?:\*|\.\.\.)?|script(?:\.nightly)?\.\w+)`")


def main():
    tests = {f"script.{path.stem}" for path in ROOT.glob("tests/scripts/*.[ps][yh]")} | {"script.parallel_files", "script.bad_input"}
    tests |= {f"script.nightly.{path.stem}" for path in ROOT.glob("tests/scripts/nightly/*")}
    for source in ROOT.glob("tests/*/*.cpp"):
        tests |= {".".join(found) for found in DECLARED.findall(source.read_text())}
    text = (ROOT / "docs/validation.md").read_text()
    named = {name for name in NAMED.findall(text) if not name.endswith((".md", ".csv", ".toml"))}
    gone = [name for name in sorted(named)
            if not any(test == name or (name[-1] in "*." and test.startswith(name.rstrip("*."))) for test in tests)]
    for name in gone:
        print(f"docs/validation.md names {name}, and there is no such test")
    print(f"claims: {len(named)} names of tests in docs/validation.md")
    return 1 if gone or len(named) < 50 else 0


sys.exit(main())
