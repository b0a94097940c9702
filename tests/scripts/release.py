#!/usr/bin/python3
"""A release speaks with one voice: every file that repeats the version says that of CMakeLists.txt, CHANGELOG.md is in
the form of Keep a Changelog with a section for it, the citation files can be read and lack nothing, and the paper
points to what is there."""
import datetime
import json
import os
import pathlib
import re
import subprocess
import sys

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]
N = r"(\d+\.\d+\.\d+)"
# Files that repeat the version, and the text around it there. The first must be there and say it; of the second those
# that are there must; the third may.
ALWAYS = {
    "README.md": rf"(?:[Vv]ersion |version = {{){N}",
    "CITATION.cff": rf"^version: {N}$",
    "codemeta.json": rf'^  "version": "{N}",$',
    "tests/install/CMakeLists.txt": rf"^find_package\(Barchan {N} ",
    "python/barchan/__init__.py": rf'^__version__ = "{N}"$',
}
IF_THERE = {"debian/changelog": rf"\A[\w-]+ \((?:\d+:)?{N}[-~+)]"}
MAY = {
    "packaging/**/package.py": rf'\A(?:.|\n)*?^    version\("{N}"',  # the newest that Spack knows
    "*.md": rf"\bbarchan[_-]v?{N}",
    "docs/*.md": rf"\bbarchan[_-]v?{N}",
}
CITATION = "cff-version", "message", "type", "title", "abstract", "authors", "version", "date-released", "license"
CODEMETA = "@context", "@type", "name", "description", "version", "datePublished", "license", "author"
KINDS = ["Added", "Changed", "Deprecated", "Removed", "Fixed", "Security"]


def other_versions(version):
    for table, must in ((ALWAYS, True), (IF_THERE, True), (MAY, False)):
        for names, around in table.items():
            paths = sorted(ROOT.glob(names))
            if not paths and table is ALWAYS:
                yield f"{names} is not there"
            for path in paths:
                said = re.findall(around, path.read_text(), re.M)
                if must and not said:
                    yield f"{path.relative_to(ROOT)} does not say the version where it is looked for"
                yield from (f"{path.relative_to(ROOT)} says version {one}" for one in said if one != version)
    if (program := os.environ.get("BARCHAN_PROGRAM")):
        said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
        if re.findall(N, said)[:1] != [version]:
            yield f"the program says {said.strip()}: build it again"


def bad_changelog(version, date):
    """Sections [Unreleased] and [x.y.z] - date, newest first; in them the known kinds of changes, each once."""
    text = (ROOT / "CHANGELOG.md").read_text()
    sections = re.split(r"^## ", text, flags=re.M)[1:]
    heads = [section.splitlines()[0] for section in sections]
    releases = [re.fullmatch(rf"\[{N}\] - (\d{{4}}-\d\d-\d\d)", head) for head in heads[1:]]
    if heads[0] != "[Unreleased]" or not all(releases):
        yield f"CHANGELOG.md has the sections {heads}, not [Unreleased] and [number] - date"
        return
    if (releases[0][1], releases[0][2]) != (version, date):
        yield f"CHANGELOG.md has {releases[0][0]} on top, not [{version}] - {date}, the date of CITATION.cff"
    order = [([int(part) for part in one[1].split(".")], datetime.date.fromisoformat(one[2])) for one in releases]
    if order != sorted(order, reverse=True):
        yield "CHANGELOG.md: the newest version must come first"
    for head, section in zip(heads, sections):
        kinds = re.findall(r"^### (.*)", section, re.M)
        if set(kinds) - set(KINDS) or len(kinds) != len(set(kinds)):
            yield f"CHANGELOG.md, {head}: {kinds}; there are {KINDS}"
    if len(sections[1]) < 200:
        yield f"CHANGELOG.md says nothing of {version}"


def bad_paper():
    """The paper cites what paper.bib holds, all of it, and the pages that it points to are there."""
    text, sources = ((ROOT / f"paper/paper.{end}").read_text() for end in ("md", "bib"))
    cited, held = set(re.findall(r"@([A-Z]\w+\d{4})", text)), set(re.findall(r"^@\w+{(\w+),", sources, re.M))
    yield from (f"paper/: {key} is not in both" for key in sorted(cited ^ held))
    files = re.findall(r"\b(?:docs|configs)/[\w/-]+\.\w+", text)
    yield from (f"paper/paper.md points to {name}" for name in files if not (ROOT / name).exists())
    if (words := len(text.split("---", 2)[2].split())) > 1000:
        yield f"paper/paper.md has {words} words"


def incomplete(name, held, wanted):
    yield from (f"{name} has no {key}" for key in wanted if not held.get(key))


def main():
    version = re.search(rf"^project\(barchan VERSION {N} ", (ROOT / "CMakeLists.txt").read_text(), re.M)[1]
    citation = yaml.safe_load((ROOT / "CITATION.cff").read_text())
    codemeta = json.loads((ROOT / "codemeta.json").read_text())
    date = str(citation.get("date-released"))
    found = [*other_versions(version), *bad_changelog(version, date), *bad_paper(),
             *incomplete("CITATION.cff", citation, CITATION), *incomplete("codemeta.json", codemeta, CODEMETA)]
    for paper in citation.get("references", []):
        found += incomplete("CITATION.cff, a reference", paper, ("type", "title", "authors", "year", "doi"))
    if codemeta.get("datePublished") != date:
        found.append(f"codemeta.json is of {codemeta.get('datePublished')}, CITATION.cff of {date}")
    print(*found, f"release {version}: {len(found)} problems", sep="\n")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
