"""Grains of a window of a dune: depth below the neighbours, means over the span, which grains count."""

import types

import numpy as np
import pytest
from validation import dune_window, tables

from barchan import MissingData

D = 2e-4
CONFIG = {"domain": {"size": [12 * D, 7 * D, 8 * D]}, "fluid": {"density": 1000.0},
          "grains": {"density": 2500.0, "gravity": [0.0, -9.81, 0.0]}}
WEIGHT = 1500 * 9.81 * np.pi / 6 * D**3


def grains(places, forces, ids=None):
    """Grains of one size; places in diameters, forces over the submerged weight."""
    made = object.__new__(dune_window.Grains)
    made.run = types.SimpleNamespace(config=CONFIG)
    made.x, made.d = D * np.array(places, float), np.full(len(places), D)
    made.force, made.id = WEIGHT * np.array(forces, float), np.array(ids or range(1, len(places) + 1))
    return made


def test_depth_is_that_below_the_highest_grain_nearby():
    three = grains([[6, 2, 4], [6.5, 1.2, 4], [8, 0.5, 4]], np.zeros((3, 3)))
    assert three.depth().tolist() == pytest.approx([0, 0.8, 0])


def test_grains_beside_the_sides_and_those_of_one_run_alone_are_left_out():
    forces = [[0.1, 0, 0], [0.2, 0.3, 0], [0.4, 0, 0]]
    here = grains([[1, 0.5, 4], [6, 0.5, 4], [7, 0.5, 4]], forces)
    there = grains([[1, 0.5, 4], [6, 0.5, 4]], [[1, 0, 0], [0.5, 0.6, 0]])
    row, = dune_window.rows_of("crest", here, [there, there])
    assert row == "crest,2,0.000,0.2000,0.3000,0.5000,0.6000,0.5000,0.6000"


def test_the_saved_table_is_drawn_and_summed_up(tmp_path):
    with pytest.raises(MissingData, match="needs"):
        dune_window.draw(tmp_path)
    lines = [f"{place},{n},0,{n},0,{2 * n},0,{3 * n},0.5" for place in ("stoss", "crest", "horn") for n in (1, 2, 3)]
    tables.write(tmp_path / "dune_window.csv", {}, [dune_window.COLUMNS, *lines])
    assert next(dune_window.summary(tmp_path)) == (
        "stoss, exposed | 3 | 2.000, 4.000, 6.000 | 0.000, 0.000, 0.500 | 1.00, 1.00")
    assert len(dune_window.draw(tmp_path).axes) == 3
