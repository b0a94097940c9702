"""The table of bed load in laminar flow: what is measured of a run, on built runs whose answer is known."""

import math
import types

import numpy as np
import pytest
from validation import bed_load, laminar_bed, tables

from barchan import MissingData
from barchan.io.frames import Grains


class BuiltRun:
    """Three layers of 80 grains of 1 mm over 10 x 10 mm, and a fast one above them; ten frames in the second half."""

    path = "built"
    config = {"domain": {"size": [0.01, 0.012, 0.01]}, "initial": {"realisation": 2},
              "fluid": {"density": 1000.0, "kinematic_viscosity": 2e-4, "mean_velocity": 0.02,
                        "first_cell_height": 5e-4},
              "grains": {"density": 2100.0, "gravity": [0, -9.81, 0], "sliding_friction": 0.6},
              "coupling": {"smoothing_length": 1.5e-3, "forces": ["drag", "torque"]}}
    times = np.arange(1, 21) / 2
    step = np.where(times <= 5, 50.0, 1 + 2 * (np.ceil(times) % 2))  # blocks of one second: 1 and 3 in turn
    history_columns = {"t": times, "grain_flux": 1e-7 * step}
    speeds = np.repeat([1e-4, 4e-4, 1.6e-3, 1.0], (80, 80, 80, 1))

    bed_load_columns = {}

    def need_grains(self):
        return types.SimpleNamespace(times=self.times)

    def frame(self, index):
        count = len(self.speeds)
        x, u = np.full((count, 3), 0.005), np.zeros((count, 3))
        x[:, 1] = np.repeat([5e-4, 1.5e-3, 2.5e-3, 4e-3], (80, 80, 80, 1))
        u[:, 0] = self.speeds * self.step[index]
        return Grains(self.times[index], np.arange(count), x, np.full(count, 1e-3), u=u)


class FullRun(BuiltRun):
    """Grains up to the lid."""

    config = {**BuiltRun.config, "domain": {"size": [0.01, 0.003, 0.01]}}


class ShortRun(BuiltRun):
    times = BuiltRun.times[-4:]


SOLID = 241 * math.pi / 6 * 1e-9
CASES = {case["case"]: case for case in laminar_bed.references()}


def test_a_run_is_measured():
    """The top layer fills 80 pi (r^2 - h^2) of the area at a distance h from its middle: 0.05 there is the surface,
    which is known to a twentieth of a layer of d/20."""
    row = dict(zip(laminar_bed.COLUMNS.split(","), laminar_bed.measure(BuiltRun())))
    bed = 2.5e-3 + math.sqrt(0.25e-6 - 0.05 * 1e-4 / (80 * math.pi))
    fluid_flux = 0.02 * (0.012 - SOLID / 1e-4)
    layers = 5e-4 * (1e-4 + 4e-4 + 1.6e-3)
    blocks = np.array([1, 3, 1, 3, 1])
    blocks = blocks if BuiltRun.step[-1] == 1 else 4 - blocks
    galileo = math.sqrt(1.1 * 9.81 * 1e-9) / 2e-4
    known = {"reynolds": fluid_flux / 2e-4, "row_height": 0.5, "smoothing_length": 1.5, "sliding_friction": 0.6,
             "forces": 2, "realisation": 2, "seconds": 5, "fluid_height": (0.012 - bed) / 1e-3,
             "shields": 6 * fluid_flux / 2e-4 / galileo**2 * (1e-3 / (0.012 - bed))**2,
             "velocity_flux": np.mean(blocks) * layers / fluid_flux,
             "velocity_flux_deviation": np.std(blocks) * layers / fluid_flux,
             "volume_flux": np.mean(blocks) * 1e-7 / fluid_flux,
             "volume_flux_deviation": np.std(blocks) * 1e-7 / fluid_flux,
             "bed_surface": math.nan, "bed_shields": math.nan, "q_star": math.nan}
    assert set(known) == set(row)
    for name, expected in known.items():
        assert row[name] == pytest.approx(expected, rel=3e-3, nan_ok=True), name


def test_the_solid_fraction_adds_up():
    """To the volume of the grains, wherever the levels cut them."""
    levels = np.linspace(-1e-3, 5e-3, 14)
    fraction = laminar_bed.solid_fraction(BuiltRun().frame(0), 1e-4, levels)
    assert np.sum(fraction * np.diff(levels)) * 1e-4 == pytest.approx(SOLID, rel=1e-12, abs=0)


def test_the_surface_of_a_fraction_that_falls_linearly():
    """From 0.6 to 0 over a metre: it is 0.05 after 11/12 m; a gap below does not count."""
    levels = np.linspace(0, 1.1, 45)
    falling = np.maximum(0, 0.6 * (1 - (levels[1:] + levels[:-1]) / 2))
    falling[4] = 0
    assert laminar_bed.surface(falling, levels) == pytest.approx(11 / 12, rel=1e-9)


@pytest.mark.parametrize("run, lack", [(FullRun(), "clear liquid"), (ShortRun(), "5 frames")])
def test_what_it_needs(run, lack):
    with pytest.raises(MissingData, match=lack):
        laminar_bed.measure(run)


def line(case, rows, realisation, flux):
    height = case["height_resolved"]
    return f"{case['reynolds']},{rows},1.5,0.6,5,{realisation},4,{height},0.3,{flux},1e-4,1e-3,1e-4,nan,nan,nan"


# Two runs of A9 with d/2, one with thick rows, one run of A1.
LINES = [line(CASES["A9"], 0.5, 1, 7e-3), line(CASES["A9"], 0.5, 2, 8e-3), line(CASES["A9"], 1.3, 1, 1e-3),
         line(CASES["A1"], 0.5, 1, 6e-3)]


@pytest.fixture
def folder(tmp_path):
    tables.write(tmp_path / "laminar_bed.csv", {"title": "built"}, [laminar_bed.COLUMNS, *LINES])
    return tmp_path


def test_the_summary(folder):
    assert list(laminar_bed.summary(folder)) == [
        "A1 | 0.5, 1.5, 0.6, 5 | 1 | 7.15 | 0.300 | 6.00e-3 +- 0.10e-3 | 6.71e-3 | 12.00e-3 | 1.00e-3",
        "A9 | 0.5, 1.5, 0.6, 5 | 2 | 10.33 | 0.300 | 7.50e-3 +- 0.71e-3 | 7.61e-3 | 8.20e-3 | 1.00e-3",
        "A9 | 1.3, 1.5, 0.6, 5 | 1 | 10.33 | 0.300 | 1.00e-3 +- 0.10e-3 | 7.61e-3 | 8.20e-3 | 1.00e-3"]


def test_the_figure(folder):
    """One run is drawn, too."""
    figure = laminar_bed.draw(folder)
    labels = sum((axes.get_legend_handles_labels()[1] for axes in figure.axes[:2]), [])
    assert "Barchan, forces of the paper" in labels and "A9" in labels and "A1" not in labels
    tables.write(folder / "laminar_bed.csv", {"title": "one run"}, [laminar_bed.COLUMNS, LINES[-1]])
    laminar_bed.draw(folder)


def test_a_run_done_again_replaces_its_row(folder):
    _, merged = bed_load.with_earlier(folder / "laminar_bed.csv", {"commit": "b", "machine": "m", "date": "d"},
                                      [line(CASES["A9"], 0.5, 2, 9e-3)], laminar_bed.KEYS)
    assert len(merged) == 4
    assert sum(",0.009," in text for text in merged) == 1


@pytest.mark.parametrize("case", CASES.values(), ids=CASES)
def test_the_papers_agree_with_the_shields_number(case):
    """Their own numbers, of three figures: Ga = 0.397."""
    shields = 6 * case["reynolds"] / 0.397**2 / case["height_resolved"]**2
    assert shields == pytest.approx(case["shields_resolved"], rel=1e-2)
