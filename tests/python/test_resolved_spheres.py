"""Spheres in a resolved flow: speeds, rebounds and tilts of tracks whose answer is known."""

import types

import numpy as np
import pytest
from matplotlib.figure import Figure
from validation import resolved_spheres, tables

from barchan import MissingData

D, G = 1e-3, 9.81


def built(x, u, **more):
    """Tracks of spheres in a box of 6 x 24 x 6 d of water; x in d."""
    fluid = {"density": 1000.0, "kinematic_viscosity": 1e-6, "top_velocity": 0.06}
    grains = {"density": 2000.0, "restitution": 0.9}
    return types.SimpleNamespace(t=np.arange(len(x)), x=D * np.array(x), u=np.array(u), d=D, gravity=G, grains=grains,
                                 size=[6 * D, 24 * D, 6 * D], fluid=fluid, **more)


def of_height(heights, speeds):
    return built([[[3, y, 3]] for y in heights], [[[0, v, 0]] for v in speeds])


def test_speed_is_over_that_of_the_weight():
    (what, _, speed), = resolved_spheres.sinking(of_height([9, 8], [0, -np.sqrt(G * D)]))
    assert what == "sinking"
    assert speed.tolist() == pytest.approx([0, 1])


def test_rebound_is_that_at_its_gap():
    tracks = of_height([1, 0.65, 0.5, 0.55, 0.65, 0.7], [-0.1, -0.1, 0.09, 0.08, 0.06, 0])
    (_, stokes, ratio), = resolved_spheres.rebound(tracks)
    assert ratio.tolist() == pytest.approx([0.7 / 0.9])
    assert stokes.tolist() == pytest.approx([2 * 0.1 * D / 1e-6 / 9])


def test_a_sphere_that_stays_has_no_rebound():
    (_, _, ratio), = resolved_spheres.rebound(of_height([1, 0.5, 0.52, 0.51], [-0.1, 0.01, 0, 0]))
    assert ratio.tolist() == [0]


def test_distance_and_tilt_are_those_of_the_nearest_image():
    pair = built([[[0.5, 10, 3], [5.5, 11, 3]]], np.zeros((1, 2, 3)))
    (_, _, distance), (_, _, tilt) = resolved_spheres.tumbling(pair)
    assert distance[0] == pytest.approx(np.sqrt(2))
    assert tilt[0] == pytest.approx(45)


def test_drift_and_spin_count_from_the_middle_and_by_the_rate():
    tracks = built([[[3, 18, 3]]], np.zeros((1, 1, 3)), omega=np.array([[[0, 0, -1.25]]]))
    assert next(resolved_spheres.migration(tracks))[2].tolist() == pytest.approx([0.5])
    assert next(resolved_spheres.shear(tracks))[2].tolist() == pytest.approx([0.5])


def test_the_saved_table_is_drawn_and_summed_up(tmp_path):
    with pytest.raises(MissingData, match="finished run"):
        resolved_spheres.save(tmp_path, tmp_path)
    lines = [f"{what},{case},{x},{0.1 * x}" for what, case in
             (("sinking", "Ga144"), ("rebound", "nu-2"), ("distance", "resolved-tumbling")) for x in (1, 2)]
    tables.write(tmp_path / "resolved_spheres.csv", {}, [resolved_spheres.COLUMNS, *lines])
    assert next(resolved_spheres.summary(tmp_path)) == "sinking, Ga144 | x 2 | 0.2 | 0.2"
    assert len(resolved_spheres.draw(tmp_path).axes) == 5


def test_two_spheres_are_drawn_with_the_flow_around_them(monkeypatch):
    monkeypatch.setattr(resolved_spheres, "Tracks", lambda _: built([[[2, 10, 3], [4, 11, 3]]], np.zeros((1, 2, 3))))
    at = np.linspace(0, 1, 9)
    flow = types.SimpleNamespace(x=6 * D * at, y=24 * D * at, u=np.ones((9, 9)), v=np.ones((9, 9)))
    file = types.SimpleNamespace(times=np.array([0.0]))
    run = types.SimpleNamespace(need_fields=lambda: file, field_file=file, flow_plane=lambda frame, z: flow)
    figure = resolved_spheres.draw_pair(run, Figure())
    assert len(figure.axes) == 5
    assert len(figure.axes[0].patches) >= 2
