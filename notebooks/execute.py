#!/usr/bin/python3
"""Executes notebooks in place, so that they show their results: python3 notebooks/execute.py [NAME.ipynb ...]

Runs are read from and written to runs/ (or BARCHAN_RUNS). Without names: all. What changes with every execution, such
as times of the clock, is not kept.
"""
import os
import sys
from pathlib import Path

import nbformat
from nbclient import NotebookClient

HERE = Path(__file__).resolve().parent


def execute(path):
    notebook = nbformat.read(path, as_version=4)
    NotebookClient(notebook, timeout=None, kernel_name="python3", resources={"metadata": {"path": str(HERE)}}).execute()
    for number, cell in enumerate(notebook.cells):
        cell.metadata.pop("execution", None)
        cell.id = f"cell-{number}"
    notebook.metadata["language_info"] = {"name": "python"}
    nbformat.write(notebook, path)


def main(names):
    os.environ["PYDEVD_DISABLE_FILE_VALIDATION"] = "1"  # says nothing about it
    os.environ["PYTHONPATH"] = os.pathsep.join([str(HERE.parent / "python"), os.environ.get("PYTHONPATH", "")])
    for path in [HERE / name for name in names] or sorted(HERE.glob("*.ipynb")):
        execute(path)
        print(path.name, path.stat().st_size // 1000, "kB")


if __name__ == "__main__":
    main(sys.argv[1:])
