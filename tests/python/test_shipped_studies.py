"""Every case of every shipped study loads in the program."""

import argparse
import os
import subprocess

import pytest
from fake_runs import ROOT

from barchan.studies.spec import read_study

OPTIONS = argparse.Namespace(at_once=None, threads=None, out=None)
STUDIES = [path for path in sorted((ROOT / "configs").rglob("*.toml")) if "[study]" in path.read_text().splitlines()]


@pytest.mark.skipif("BARCHAN_PROGRAM" not in os.environ, reason="needs the program, whose path BARCHAN_PROGRAM has")
@pytest.mark.parametrize("path", STUDIES, ids=lambda path: str(path.relative_to(ROOT / "configs")))
def test_cases_load(path):
    """One realisation of each: the others differ in their seeds."""
    cases = {case.name: case for case in read_study(path, OPTIONS).cases}
    assert cases
    for case in cases.values():
        command = [os.environ["BARCHAN_PROGRAM"], "check", case.base, *case.set_options(), "--resolved-only"]
        done = subprocess.run(command, capture_output=True, text=True, check=False)
        assert done.returncode == 0, f"{case.name}: {done.stdout}{done.stderr}"
