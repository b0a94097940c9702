#!/usr/bin/python3
"""What texts name is there: the tests of docs/checks.csv (Suite.Name, script.name); in all documents, Python files
and comments the files (src/base/words.cpp), headings of pages and, but in comments of C++, members (Halo::fill)."""
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
DECLARED = re.compile(r"^TEST(?:_F|_P)?\((\w+),\s*(\w+)\)", re.M)
CHECKS = "docs/checks.csv"
FOLDERS = "cmake", "configs", "docs", "kernels", "packaging", "perf", "python", "scripts", "src", "tests"
FILE = re.compile(rf"(?<![\w/.$}}-])((?:{'|'.join(FOLDERS)})/[\w./-]+\.(?:cpp|hpp|py|sh|cmake|md|toml|csv|js))\b")
MEMBER = re.compile(r"\b([A-Z]\w+)::(\w+)")
FOREIGN = {"Kokkos", "Eigen", "MPI"}  # namespaces
WRITTEN = {"kernels/math/mutant.hpp"}  # by tests/hygiene/mutants.py


def gone_tests():
    """Names of tests in the table of all checks, and "it names ..." for each that is not there."""
    tests = {f"script.{path.stem}" for path in ROOT.glob("tests/scripts/*.[ps][yh]")}
    tests |= {"script.parallel_files", "script.bad_input", "mpi.full_disk"}
    tests |= {f"script.nightly.{path.stem}" for path in ROOT.glob("tests/scripts/nightly/*")}
    for source in ROOT.glob("tests/*/*.cpp"):
        tests |= {".".join(found) for found in DECLARED.findall(source.read_text())}
    with open(ROOT / CHECKS, encoding="utf-8") as file:
        named = {name for row in csv.DictReader(file) for name in row["tests"].split()}

    def is_there(name):
        return any(test == name or (name[-1] in "*." and test.startswith(name.rstrip("*."))) for test in tests)

    return named, [f"{CHECKS} names {name}" for name in sorted(named) if not is_there(name)]


def sources(*ends):
    return [path for folder in FOLDERS for end in ends for path in sorted((ROOT / folder).rglob("*" + end))]


def comments(path):
    """What a file says in words."""
    text = path.read_text()
    if path.suffix in (".hpp", ".cpp"):
        return "\n".join(re.findall(r"//.*", text))
    return text if path.suffix in (".py", ".md") else "\n".join(re.findall(r"#.*", text))


def gone_names():
    """Number of names of files and members, and "file names it" for each that is not there."""
    cpp = sources(".hpp", ".cpp")
    code = "\n".join(re.sub(r"//.*", "", path.read_text()) for path in cpp)
    words = set(re.findall(r"\w+", code))
    types = set(re.findall(r"\b(?:struct|class|namespace|using|union)\s+(?:alignas\(\w+\)\s+)?(\w+)", code))
    texts = [*sources(".py", ".sh", ".md", ".cmake", "CMakeLists.txt"), *ROOT.glob("*.md"), ROOT / "CMakeLists.txt",
             ROOT / "barchan"]
    n, gone = 0, []
    for path in [*texts, *cpp]:
        said = comments(path)
        there = {name: (ROOT / name).exists() for name in set(FILE.findall(said)) - WRITTEN}
        if path in texts:
            there |= {f"{a}::{b}": a in types and b in words for a, b in MEMBER.findall(said) if a not in FOREIGN}
        n += len(there)
        gone += [f"{path.relative_to(ROOT)} names {name}" for name, is_there in there.items() if not is_there]
    return n, gone


def gone_headings():
    """Number of headings of pages that texts name, FILE.md, "Heading", and "file names it" for each that is gone."""
    n, gone = 0, []
    for path in sources(".hpp", ".cpp", ".py", ".sh"):
        text = re.sub(r"\s*\n\s*(?://+|#)?\s*", " ", path.read_text())
        for page, heading in re.findall(r'(docs/[\w/-]+\.md), "([^"]{1,60})"', text):
            n += 1
            there = (ROOT / page).read_text() if (ROOT / page).exists() else ""
            if not re.search(rf"^#+ {re.escape(heading)}$", there, re.M):
                gone.append(f'{path.relative_to(ROOT)} names {page}, "{heading}"')
    return n, gone


def main():
    named, gone = gone_tests()
    n, names = gone_names()
    n_headings, headings = gone_headings()
    for what in [*gone, *names, *headings]:
        print(f"{what}, and there is no such thing")
    print(f"claims: {len(named)} names of tests in {CHECKS}, {n} of files and members, {n_headings} of headings")
    return 1 if gone or names or headings or n_headings < 20 or len(named) < 200 or n < 100 else 0


sys.exit(main())
