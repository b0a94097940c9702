"""Cases of other programs: closed forms whose ends are known, and measures of made-up tracks."""

import types

import numpy as np
import pytest
from validation import dem_cases, tables

from barchan import MissingData

G = 9.81


def built(x, u, t=None, omega=None, **grains):
    x, u = np.array(x, float), np.array(u, float)
    density = grains.setdefault("density", 2000.0)
    d = np.full(x.shape[1], grains.pop("d", 1e-3))
    return types.SimpleNamespace(t=np.arange(len(x)) if t is None else np.array(t, float), x=x, u=u, d=d, gravity=G,
                                 omega=np.zeros_like(x) if omega is None else np.array(omega),
                                 size=[0.01, 1.8e-3, 0.01],
                                 grains={"restitution": 1.0, **grains}, mass=density * np.pi / 6 * d ** 3)


def test_an_oscillator_swings_and_dies_down():
    spring = np.array([[0.0, 1.0], [-4.0, 0.0]])
    x = dem_cases.oscillate(spring, np.array([1.0, 0]), np.array([2.0, 0]), [0, np.pi / 2])
    assert x[:2, 0].tolist() == pytest.approx([2, 0])
    ratio = dem_cases.damping(0.5)
    damped = dem_cases.oscillate(np.array([[0.0, 1.0], [-1.0, -2 * ratio]]), np.zeros(2), np.array([0, 1.0]),
                                 [np.pi / np.sqrt(1 - ratio ** 2)])
    assert damped[0].tolist() == pytest.approx([0, -0.5])


def test_a_fall_ends_at_the_wall_and_turns_back():
    t = [0, 0.1, 0.2, 0.5]
    (_, _, _, exact), = dem_cases.falling(built([[[0, 0.5, 0]]] * 4, [[[0, 0, 0]]] * 4, t, d=0.2, density=2600.0,
                                                linear_stiffness=1e8, restitution=0.5))
    touch, speed = np.sqrt(0.8 / G), np.sqrt(0.8 * G)
    later = 0.5 - touch
    assert exact.tolist() == pytest.approx([0.5, 0.5 - G / 200, 0.5 - G / 50,
                                            0.1 + speed / 2 * later - G * later ** 2 / 2], rel=0.02)


def test_tops_of_bounces_come_from_the_energy_in_flight():
    tracks = built([[[0, y, 0]] for y in (0.5, 0.1, 0.2, 0.25, 0.12, 0.15)],
                   [[[0, v, 0]] for v in (0, -2.0, 1.0, -0.5, 1.5, -0.1)], d=0.2)
    (_, number, top, hard), = dem_cases.bouncing(tracks)
    assert number.tolist() == [1, 2]
    assert top.tolist() == pytest.approx([0.25 + 0.25 / 2 / G, 0.15 + 0.01 / 2 / G])
    assert hard.tolist() == pytest.approx([0.5, 0.5])


def test_squeezed_spheres_at_their_rest_stay_there():
    k = 1e3
    tracks = built(np.zeros((2, 2, 3)), np.zeros((2, 2, 3)), linear_stiffness=k)
    sink = tracks.mass[0] * G / k  # the springs carry both weights
    tracks.x[:, :, 1] = 1.3e-3 / 3 - sink, 4.1e-3 / 3 - sink
    (_, _, _, low), (_, _, _, high) = dem_cases.squeezed(tracks)
    assert low.tolist() == pytest.approx([1.3e-3 / 3 - sink] * 2)
    assert high.tolist() == pytest.approx([4.1e-3 / 3 - sink] * 2)


def test_a_sphere_slips_at_the_friction_and_then_rolls():
    t = np.linspace(0, 0.02, 401)
    speed = np.maximum(0.1 - 0.2 * G * t, 0.1 * 5 / 7)
    (_, mu, until, _), (_, _, rolls, _) = dem_cases.slipping(
        built(np.zeros((401, 1, 3)), np.stack([speed, 0 * t, 0 * t], 1)[:, None], t, sliding_friction=0.2))
    assert (mu[0], until[0], rolls[0]) == pytest.approx((0.2, 2 / 7, 5 / 7))


def test_oblique_impacts_are_compared_at_the_angles_of_the_table():
    before = [[[np.sin(np.radians(a)), -np.cos(np.radians(a)), 0] for a in (0, 30, 60)]]
    tracks = built(np.zeros((2, 3, 3)), np.concatenate([before, -np.array(before)]))
    (_, angle, back, theirs), _ = dem_cases.oblique(tracks)
    assert angle[-1] == pytest.approx(60)
    assert theirs[-1] == pytest.approx(57.1386)
    assert back[-1] == pytest.approx(-60)


def test_a_small_sphere_sinks_at_the_speed_of_stokes():
    air = {"density": 1.0, "kinematic_viscosity": 1e-2}
    tracks = built(np.zeros((2, 1, 3)), np.zeros((2, 1, 3)), [0, 1.0], ambient=air)
    (_, _, _, exact), = dem_cases.sinking(tracks)
    assert exact[1] - dem_cases.GAS == pytest.approx(-1999 * G * 1e-6 / (18 * 1e-2), rel=0.1)


def test_the_saved_table_is_drawn_and_summed_up(tmp_path):
    with pytest.raises(MissingData, match="finished run"):
        dem_cases.save(tmp_path, tmp_path)
    lines = [f"{what},{case},{x},{0.1 * x},{0.1 * x}" for what, case in
             (("bouncing", "mfix-dem02"), ("rebound", "mfix-dem05"), ("impact", "penetration-25k"), ("chute", "chute"))
             for x in (1, 2)]
    tables.write(tmp_path / "dem_cases.csv", {}, [dem_cases.COLUMNS, *lines])
    assert "last 0.2 of 0.2" in next(dem_cases.summary(tmp_path))
    assert len(dem_cases.draw(tmp_path).axes) == 4
