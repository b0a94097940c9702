"""Forces on the surface grains of a bed: thresholds by moments and the table, on a built bed whose answer is known."""

import contextlib
import math
import types

import numpy as np
import pytest
from validation import resolved_bed, tables

from barchan import MissingData

D, EXCESS = 2e-4, 1500 * 9.81
ROOT = math.sqrt(2) / 2
LAYER = np.array([[i + 0.5, 0.5, k + 0.5] for i in range(4) for k in range(4)]) * D
PERCHED = D * np.array([2.0, 0.5 + ROOT, 2.0])  # in the pocket between four of them
FORCE, LIFT, TORQUE = 3e-9, 1e-9, -2e-13  # of the perched grain


class BuiltRun:
    """A square layer of 16 grains in a box of 4 x 4 d, and one in a pocket of it."""

    path = "built"

    def __init__(self, scheme="layered", **forces):
        self.config = {"domain": {"size": [4 * D, 8 * D, 4 * D]}, "initial": {"realisation": 2},
                       "fluid": {"density": 1000.0, "top_velocity": 0.37, "cells": [2, 16, 2]},
                       "grains": {"density": 2500.0, "gravity": [0, -9.81, 0]},
                       "coupling": {"smoothing_length": 3e-4, "scheme": scheme}}
        count = len(LAYER) + 1
        force, torque = np.zeros((count, 3)), np.zeros((count, 3))
        force[-1], torque[-1, 2] = [FORCE, LIFT, 0], TORQUE
        drag = "force_flow" if scheme == "resolved" else "force_drag"
        order = np.arange(count)[::-1]  # in the file by place
        self.frame = {"id": order, "x": np.vstack([LAYER, PERCHED])[order], "d": np.full(count, D),
                      drag: force[order], "torque_flow": torque[order], **forces}

    def frame_file(self, name, needed):
        if any(one not in self.frame for one in needed):
            return None
        opened = contextlib.nullcontext({"frame_000003": self.frame})
        return types.SimpleNamespace(frames=[(1.0, "frame_000003")], open=lambda: opened)


def pocket_threshold(torque):
    """About the line through two contacts, r/2 downstream of the centre and r/sqrt 2 below it."""
    weight = EXCESS * math.pi / 6 * D**3
    shields = FORCE / (16 * D**2) / (EXCESS * D)
    return shields * weight / 2 / (FORCE * ROOT - torque / (D / 2) + LIFT / 2)


def test_threshold_is_that_of_the_pocket():
    bed = resolved_bed.Bed(BuiltRun())
    assert bed.threshold(16, bed.torque[16]) == pytest.approx(pocket_threshold(TORQUE), rel=1e-9)
    assert bed.threshold(16, np.zeros(3)) == pytest.approx(pocket_threshold(0), rel=1e-9)


def test_a_grain_that_others_hold_has_none():
    bed = resolved_bed.Bed(BuiltRun())
    bed.force[5] = [FORCE, 0, 0]  # under the perched one
    assert math.isnan(bed.threshold(5, np.zeros(3)))
    bed.force[16, 0] *= -1  # pushed upstream
    assert math.isnan(bed.threshold(16, np.zeros(3)))


def test_depth_counts_over_the_ends_of_the_box():
    depth = resolved_bed.Bed(BuiltRun()).depth() / D
    below = np.hypot(*(LAYER[:, [0, 2]] - PERCHED[[0, 2]]).T) < D
    assert np.allclose(depth[:16], np.where(below, ROOT, 0)) and depth[16] == 0 and below.sum() == 4


def test_rows_hold_both_schemes():
    rows = list(resolved_bed.rows_of(BuiltRun(), BuiltRun("resolved")))
    assert len(rows) == 17
    row = dict(zip(resolved_bed.COLUMNS.split(","), rows[-1]))
    stress = FORCE / (16 * D**2)
    assert (row["top_velocity"], row["realisation"], row["id"]) == (0.37, 2, 16)
    assert row["row_height"] == pytest.approx(0.5) and row["smoothing_length"] == pytest.approx(1.5)
    for name, value in (("drag", FORCE / (stress * D**2)), ("lift", LIFT / (stress * D**2)),
                        ("torque", -TORQUE / (stress * D**3)), ("threshold", pocket_threshold(TORQUE))):
        assert row[name] == pytest.approx(value) and row[f"resolved_{name}"] == pytest.approx(value)
    assert row["threshold_by_drag"] == pytest.approx(pocket_threshold(0))


def test_other_grains_are_refused():
    moved = BuiltRun("resolved")
    moved.frame["x"] = moved.frame["x"] + 1e-6
    with pytest.raises(MissingData, match="the same grains"):
        list(resolved_bed.rows_of(BuiltRun(), moved))


def test_a_run_without_torques_is_refused():
    run = BuiltRun()
    del run.frame["torque_flow"]
    with pytest.raises(MissingData, match="torques"):
        resolved_bed.Bed(run)


def test_the_table_is_summed_up_and_drawn(tmp_path):
    rows = [",".join(f"{value:.6g}" for value in (*row[:4], copy, *row[5:]))
            for copy in range(3) for row in resolved_bed.rows_of(BuiltRun(), BuiltRun("resolved"))]
    tables.write(tmp_path / "resolved_bed.csv", {"title": "built"}, [resolved_bed.COLUMNS, *rows])
    lines = list(resolved_bed.summary(tmp_path))
    assert any("threshold_by_drag | 3 |" in line for line in lines)
    assert len(resolved_bed.draw(tmp_path).axes) == 4
