"""The package: which module may know which, what is written once, and what installs."""

import ast
import subprocess
import sys

import pytest
from fake_runs import ROOT

from barchan.figures import registry

PACKAGE = ROOT / "python/barchan"
# Each may import itself and those before it.
ORDER = ("errors", "stats", "io", "dune", "flow", "figures", "report", "plot", "vtk", "listing", "watch", "studies",
         "api", "bmi", "__init__", "__main__")
ONLY = {"matplotlib": ("figures", "report", "plot"), "h5py": ("io",), "pandas": (), "xarray": ("io",),
        "subprocess": ("figures", "studies", "api")}


def imports_of(path):
    """What it imports when it runs; what only annotations name is another matter."""
    tree = ast.parse(path.read_text())
    for node in ast.walk(tree):
        if isinstance(node, ast.If) and ast.unparse(node.test) == "TYPE_CHECKING":
            node.body = []
    for node in ast.walk(tree):
        if isinstance(node, ast.Import):
            yield from (name.name for name in node.names)
        elif isinstance(node, ast.ImportFrom):
            yield node.module or ""
            if node.module == "barchan":
                yield from (f"barchan.{name.name}" for name in node.names)


def modules():
    for path in sorted(PACKAGE.rglob("*.py")):
        room = path.relative_to(PACKAGE).parts[0].removesuffix(".py")
        if room not in ("paraview", "data"):
            yield room, path


def test_modules_know_those_below_them():
    wrong = []
    for room, path in modules():
        for name in imports_of(path):
            parts = name.split(".")
            if parts[0] == "barchan" and len(parts) > 1 and ORDER.index(parts[1]) > ORDER.index(room):
                wrong.append(f"{path.relative_to(PACKAGE)} imports {name}")
            if parts[0] in ONLY and room not in ONLY[parts[0]]:
                wrong.append(f"{path.relative_to(PACKAGE)} imports {parts[0]}")
    assert not wrong


@pytest.mark.nightly
def test_mypy_is_content():
    done = subprocess.run([sys.executable, "-m", "mypy", "--config-file", "pyproject.toml", "--cache-dir=/dev/null"],
                          cwd=ROOT / "python", capture_output=True, text=True)
    assert done.returncode == 0, done.stdout + done.stderr


def test_the_page_lists_every_figure():
    page = (ROOT / "docs/results.md").read_text()
    for entries in registry.OF_RUN, registry.OF_STUDY:
        rows = [f"| `{entry.name}` | {', '.join(entry.needs).replace('|', ' or ') or 'any file'} | {entry.about} |"
                for entry in entries.values()]
        assert "\n".join(rows) in page


def test_every_figure_says_what_it_needs():
    """Of a run without any file each figure names one of the files that the registry lists, or is the report."""
    for entry in (*registry.OF_RUN.values(), *registry.OF_STUDY.values()):
        assert entry.about and (callable(entry.write_files) if entry.writes else callable(entry.draw))
        assert entry.needs or entry.name == "report"
    for of_run, of_study in registry.PAPER.values():
        assert of_run in registry.OF_RUN and (of_study is None or of_study[0] in registry.OF_STUDY)
