"""The report's own numbers."""
import pytest

from barchan.report import from_config, largest_speed


@pytest.mark.parametrize("fluid, speed", [
    ({}, 0.0),
    ({"mean_velocity": -0.28}, 0.28),
    ({"mean_velocity": [0.3, -0.4]}, 0.5),
    ({"mean_velocity": 0.0, "schedule": [{"velocity": 0.1}, {"velocity": [0, -0.2], "amplitude": [0.3, 0.4]}]}, 0.7),
])
def test_largest_speed_of_a_flow(fluid, speed):
    assert largest_speed(fluid) == pytest.approx(speed)


def test_a_turned_flow_has_its_reynolds_number():
    rows = dict(from_config({"domain": {"size": [0.1, 0.025, 0.04]}, "fluid": {"mean_velocity": [0.0, 0.28]}}))
    assert rows["bulk velocity U"] == "0.28 m/s"
    assert rows["Re = 2 δ U / ν"] == "14000"
