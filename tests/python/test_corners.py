"""The table of clumps and spheres: three studies in one file, and the rolling friction that is alike."""

import tomllib

import numpy as np
import pytest
from fake_runs import ROOT
from validation import corners, tables

from barchan import BarchanError, MissingData


def write(folder, rows):
    tables.write(folder / "corners.csv", {}, [corners.COLUMNS, *(f"{case},{run},{name},{value}"
                                                                for case, run, name, value in rows)])


def test_the_rolling_friction_that_is_alike(tmp_path):
    write(tmp_path, [(case, run, name, zero + sign * (10 + 100 * friction + run))
                     for case, friction in corners.SPHERES.items() for run in (0, 2)
                     for name, zero, sign in (("heap slope", 0, 1), ("loss", 100, -1))]
          + [("rolling-0", 0, "W", 1), ("rolling-0.1", 0, "W", 3), ("rolling-0.3", 0, "W", 2), ("sand", 0, "W", 2),
             ("sand", 0, "heap slope", 30), ("sand", 1, "heap slope", 32), ("sand", 0, "loss", 85),
             ("sand", 0, "L", 1), ("tetrahedron", 0, "loss", 1)])
    found = corners.read(tmp_path)
    assert corners.equivalent(found, "sand", "heap slope") == pytest.approx(0.2)
    assert corners.equivalent(found, "sand", "loss") == pytest.approx(0.04)
    assert np.isnan(corners.equivalent(found, "tetrahedron", "loss")), "beyond all spheres"
    assert np.isnan(corners.equivalent(found, "sand", "W")), "spheres go up and down"
    assert np.isnan(corners.equivalent(found, "sand", "L")), "not known of spheres"
    lines = list(corners.summary(tmp_path))
    assert "sand: heap slope 31 +- 1.4 (2 runs), as mu_r 0.20" in lines
    assert "rolling-0: heap slope 11 +- 1.4 (2 runs)" in lines
    assert len(corners.draw(tmp_path).axes) == len(corners.PANELS)


def test_a_folder_without_runs_is_refused(tmp_path):
    with pytest.raises(BarchanError, match="study.json"):
        corners.save(tmp_path, tmp_path)
    with pytest.raises(MissingData, match="corners.csv"):
        corners.read(tmp_path)


def test_the_studies_have_the_same_cases():
    first, *others = [set(tomllib.loads((ROOT / study).read_text())["cases"]) for study in corners.STUDIES]
    assert first > set(corners.SPHERES) and all(other == first for other in others)
