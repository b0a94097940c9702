"""Every notebook runs from its first to its last cell, on small runs."""

import os
import re
import subprocess
import sys

import nbformat
import pytest
from fake_runs import ROOT, fake
from test_laws import write_study

NOTEBOOKS = sorted((ROOT / "notebooks").glob("*.ipynb"))
COMPUTES = ("first_dune", "calibration")
# Runs the cells as a notebook does; what it shows goes to the output.
RUN = """
import sys
import nbformat
from IPython.core.interactiveshell import InteractiveShell
InteractiveShell.enable_gui = lambda *_: None
shell = InteractiveShell.instance()
for cell in nbformat.read(sys.argv[1], 4).cells:
    if cell.cell_type == "code":
        shell.run_cell(cell.source).raise_error()
"""


@pytest.fixture(scope="module")
def runs(tmp_path_factory):
    """Folders with the names that the notebooks open: made-up runs and studies."""
    folder = tmp_path_factory.mktemp("runs")
    (folder / "quickstart").symlink_to(fake("--average"))
    (folder / "small").mkdir()
    (folder / "small/friction-3k").symlink_to(fake("--study"))
    horns = folder / "horns"
    subprocess.run([sys.executable, ROOT / "tests/support/make_horn_run.py", horns / "base"], check=True)
    (folder / "field/sizes").mkdir(parents=True)
    write_study(folder / "field/sizes", 0.1)
    return folder


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_runs(path, runs, tmp_path):
    if path.stem in COMPUTES and "BARCHAN_PROGRAM" not in os.environ:
        pytest.skip("needs the program, whose path BARCHAN_PROGRAM has")
    if path.stem == "horn_grains":
        (tmp_path / "small").mkdir()
        (tmp_path / "small/friction-3k").symlink_to(runs / "horns")
    where = tmp_path if path.stem in (*COMPUTES, "horn_grains") else runs
    environment = {**os.environ, "BARCHAN_RUNS": str(where), "BARCHAN_QUICK": "1", "PYTHONPATH": str(ROOT / "python"),
                   "BARCHAN_CASE": str(ROOT / "tests/support/small_dune.toml"),
                   "BARCHAN": os.environ.get("BARCHAN_PROGRAM", ""), "IPYTHONDIR": str(tmp_path)}
    done = subprocess.run([sys.executable, "-c", RUN, path], cwd=path.parent, env=environment, capture_output=True,
                          text=True)
    assert done.returncode == 0, done.stdout[-3000:] + done.stderr[-1000:]
    assert "<Figure" in done.stdout or path.stem == "calibration"


@pytest.mark.parametrize("path", NOTEBOOKS, ids=lambda path: path.stem)
def test_it_shows_its_results(path):
    """Each is stored as executed from its first to its last cell (notebooks/execute.py), small, without errors, and
    says nothing of the machine."""
    cells = [cell for cell in nbformat.read(path, 4).cells if cell.cell_type == "code"]
    assert [cell.execution_count for cell in cells] == list(range(1, len(cells) + 1))
    outputs = [output for cell in cells for output in cell.outputs]
    assert outputs and not any(output.output_type == "error" for output in outputs)
    assert path.stat().st_size < 500_000
    assert not re.search(r"/(home|root|tmp|work|usr)/", path.read_text())
    assert not any(cell.metadata.get("execution") for cell in cells)


def test_there_are_six():
    assert len(NOTEBOOKS) == 6
