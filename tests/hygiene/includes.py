#!/usr/bin/python3
"""No file of ours includes a header of ours of which it uses nothing: not a type, function, constant or macro that the
header declares itself. `// IWYU pragma: export` marks an include that is handed on."""
import re
import sys
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
FOLDERS = ("kernels", "src", "perf", "tests")
INCLUDE = re.compile(r'^#include "((?:%s)/[^"]+)"(.*)$' % "|".join(FOLDERS), re.M)
NOISE = re.compile(r'//[^\n]*|/\*.*?\*/|"(?:\\.|[^"\\\n])*"', re.S)
WORD = re.compile(r"\w+|[-+*/%&|^<>=!]+")
DECLARED = (
    re.compile(r"\b(?:struct|class|union|concept|enum(?: class)?|using)\s+([A-Za-z_]\w*)"),
    re.compile(r"^\s*#\s*define\s+(\w+)", re.M),
    re.compile(r"\boperator\s*([-+*/%&|^<>=!]+)"),
    re.compile(r"\b([A-Za-z_]\w*)\s*[(=;{,\[:]"),  # values, functions, members, enumerators
)
# Words that stand in any header, and so do not tell that one is used.
COMMON = set("""barchan std Kokkos operator requires static_cast decltype sizeof alignas noexcept else default public private
x y z n f d r m i j k""".split())


def code(path):
    return NOISE.sub(" ", path.read_text())


def without_bodies(text):
    """A header without what stands in parentheses, and in functions."""
    kept, depth, skipped = [], 0, 0
    for word in re.findall(r"\s+|\w+|.", text):
        if word == "{" and not skipped and re.search(r"(\)|\bconst|\bnoexcept|\boverride)\s*$", "".join(kept[-8:])):
            skipped = 1
            kept.append(";")
        elif skipped:
            skipped += (word == "{") - (word == "}")
        else:
            depth -= word == ")"
            if depth == 0 or (depth == 1 and word == "("):
                kept.append(word)
            depth += word == "("
    return "".join(kept)


def declared_in(path):
    text = without_bodies(INCLUDE.sub("", code(path)))
    return {name for pattern in DECLARED for name in pattern.findall(text)} - COMMON


def unused_includes(files):
    declared = {}
    for path in files:
        raw = path.read_text()
        words = None
        for target, mark in INCLUDE.findall(raw):
            header = ROOT / target
            if "IWYU pragma: export" in mark or not header.exists():
                continue
            if target not in declared:
                declared[target] = declared_in(header)
            words = words or set(WORD.findall(INCLUDE.sub("", code(path))))
            if not declared[target] & words:
                yield path.relative_to(ROOT), target


def main():
    files = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.[ch]pp"))
    found = list(unused_includes(files))
    for path, target in found:
        print(f"{path}: uses nothing of {target}")
    print(f"{len(files)} files looked at")
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())
