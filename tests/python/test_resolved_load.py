"""Bed load of resolved grains: flux and moving grains of beds whose answer is known."""

import types

import numpy as np
import pytest
from validation import resolved_load, tables

from barchan import MissingData

D = 2e-4
CONFIG = {"fluid": {"density": 1000.0, "kinematic_viscosity": 1e-6, "top_velocity": 0.3},
          "coupling": {"scheme": "resolved"},
          "grains": {"density": 2500.0, "gravity": [0, -9.81, 0]}, "domain": {"size": [10 * D, 10 * D, 4 * D]}}


def bed(fastest):
    """Forty grains on the floor that slide with 1 mm/s, and one above them."""
    floor = [[i + 0.5, 0.5, k + 0.5] for i in range(10) for k in range(4)]
    u = np.full((41, 3), [1e-3, 0, 0])
    u[-1, 0] = fastest
    return types.SimpleNamespace(x=D * np.array([*floor, [5, 1.4, 2]]), u=u, d=np.full(41, D))


def scales():
    return resolved_load.Scales(CONFIG, bed(0).d)


def test_flux_is_that_of_the_grains_that_leave_the_sliding_bed_behind():
    one, by = bed(0.0551), scales()
    expected = np.pi / 6 * D**3 * 0.0541 / (40 * D**2) / (by.speed * D)
    assert resolved_load.flux(one.x, one.u, one.d, by) == pytest.approx(expected)
    assert by.speed == pytest.approx(np.sqrt(1.5 * 9.81 * D))


def test_movers_are_those_faster_than_a_tenth_of_the_scale():
    by = scales()
    assert resolved_load.movers(bed(by.speed).u, by) == pytest.approx((1 / 40, 1))
    assert resolved_load.movers(bed(0).u, by) == (0, 0)


def test_rows_are_the_second_half_of_a_run():
    times = np.arange(20.0)
    speeds = np.where(times > 9.5, 0.0551, 0)
    run = types.SimpleNamespace(
        config=CONFIG, path="run", bed_load_columns={}, grain_file=types.SimpleNamespace(times=times),
        need_grains=lambda: run.grain_file, frame=lambda n: bed(speeds[n]),
        history_columns={"t": times, "stress_on_grains": np.where(times > 9.5, 0.5886, 9),
                         "bulk_velocity": np.full(20, 0.1)})
    seconds, shields, q_star, deviation, moving, speed, ratio = resolved_load.measure(run)
    assert (seconds, moving) == pytest.approx((9.5, 1 / 40))
    assert (shields, deviation) == pytest.approx((0.2, 0), abs=1e-12)
    assert q_star == pytest.approx(resolved_load.flux(*vars(bed(0.0551)).values(), scales()))
    assert ratio == pytest.approx(D / 2 * 1e-3 / (0.1 * 10 * D))  # the lone grain lies above the bed's surface
    config = CONFIG | {"fluid": CONFIG["fluid"] | {"top_velocity": 0.0}}
    of_channel = types.SimpleNamespace(**{**vars(run), "config": config})
    bed_top, reynolds = 9.02 * D, 0.1 * 10 * D / 1e-6  # clear water from half a level above the layer on
    expected = 6 * reynolds / (1.5 * 9.81 * D**3 / 1e-12) * (D / bed_top)**2
    assert resolved_load.measure(of_channel)[1] == pytest.approx(expected, rel=0.01)
    table = {name: np.array([value]) for name, value in
             zip(("y", "bed_surface", "bed_stress", "shields", "load", "load_velocity", "q_star"),
                  (0, D, 1, 0.3, 1, 1, 0.7))}
    by_rule = types.SimpleNamespace(**{**vars(run), "bed_load_columns": table})
    assert resolved_load.measure(by_rule)[1:3] == (0.3, 0.7)
    run.grain_file.times = times[:6]
    with pytest.raises(MissingData, match="second half"):
        resolved_load.measure(run)


def test_the_saved_table_is_drawn_and_summed_up(tmp_path):
    with pytest.raises(MissingData, match="finished run"):
        resolved_load.save(tmp_path, tmp_path)
    rows = [f"{case},0.2,{shields},0.1,0.01,0.05,0.4,0.01" for case, shields in
            (("0.20", 0.22), ("0.08", 0.09), ("layered-0.08", 0.08), ("A9", 0.36))]
    tables.write(tmp_path / "resolved_load.csv", {}, [resolved_load.COLUMNS, *rows])
    assert list(resolved_load.summary(tmp_path))[0] == "0.20 | 0.2 | 0.220 | 0.1 +- 0.01 | 0.050 | 0.40 | 0.01"
    figure = resolved_load.draw(tmp_path)
    points = figure.axes[1].get_lines()
    assert [line.get_xdata().tolist() for line in points] == [[0.09, 0.22], [0.08]]
