#!/usr/bin/python3
"""No file of ours includes a header of ours of which it uses nothing: not a type, function, constant or macro that the
header declares itself. `// IWYU pragma: export` marks an include that is handed on."""
import re
import sys
import tempfile
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


def unused_includes(files, headers):
    """Pairs of a file and a header, `headers` by the names in includes."""
    declared = {}
    for path in files:
        raw = path.read_text()
        words = None
        for target, mark in INCLUDE.findall(raw):
            if "IWYU pragma: export" in mark or target not in headers:
                continue
            if target not in declared:
                declared[target] = declared_in(headers[target])
            words = words or set(WORD.findall(INCLUDE.sub("", code(path))))
            if not declared[target] & words:
                yield path, target


def check_itself():
    """A header that is used is not reported, and one that is not used is."""
    with tempfile.TemporaryDirectory() as folder:
        header, user, other = (Path(folder) / name for name in ("a.hpp", "user.cpp", "other.cpp"))
        header.write_text("struct Heap { double slope(double angle) const { return angle * scale; } };\n")
        name = "src/" + header.name
        user.write_text(f'#include "{name}"\nHeap heap;\n')
        other.write_text(f'#include "{name}"\nint scale, angle; // Heap\n')
        found = list(unused_includes([header, user, other], {name: header}))
        assert found == [(other, name)], found


def main():
    check_itself()
    files = sorted(path for folder in FOLDERS for path in (ROOT / folder).rglob("*.[ch]pp"))
    found = list(unused_includes(files, {str(path.relative_to(ROOT)): path for path in files}))
    for path, target in found:
        print(f"{path.relative_to(ROOT)}: uses nothing of {target}")
    print(f"{len(files)} files looked at")
    return len(found) > 0


if __name__ == "__main__":
    sys.exit(main())
