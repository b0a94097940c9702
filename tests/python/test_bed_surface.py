"""Stress at the surface of a bed by bedload.csv, in the tables of the validation and as a figure."""

import math

import numpy as np
import pytest
from made_up_beds import MadeUpRun, RisingRun
from validation import bed_load, bed_surface, laminar_bed, threshold

import barchan

NUMBERS = {"bed_surface": 1.5e-3, "bed_stress": 0.3, "shields": 0.1, "load": 0.05, "load_velocity": 0.02,
           "q_star": 0.02}


def table(**more):
    y = 5e-5 * (np.arange(40) + 0.5)
    return {"y": y, **{name: np.full(40, value) for name, value in {**NUMBERS, **more}.items()}}


class WithTable(MadeUpRun):
    bed_load_columns = table()


def test_the_bed_of_a_run():
    bed = bed_surface.of(WithTable)
    assert bed.known and (bed.surface, bed.stress, bed.shields, bed.load, bed.q_star) == (1.5e-3, 0.3, 0.1, 0.05, 0.02)
    assert not bed_surface.of(MadeUpRun).known


def test_at_rest_there_is_no_surface():
    class AtRest(MadeUpRun):
        bed_load_columns = table(bed_surface=math.nan, bed_stress=math.nan, shields=math.nan)

    assert not bed_surface.of(AtRest).known
    assert bed_load.measure(AtRest)[5:7] == bed_load.measure(MadeUpRun)[5:7], "the earlier rule"


def test_bed_load_takes_its_stress():
    row = dict(zip(bed_load.COLUMNS.split(","), bed_load.measure(WithTable)))
    assert (row["stress"], row["shields"], row["bed_surface"]) == (0.3, 0.1, 1.5e-3)
    assert math.isnan(bed_load.measure(MadeUpRun)[-1])


def test_stress_of_a_flow_that_speeds_up():
    """A flow of water alone that the pressure speeds up has none; what is beyond it is the stress at the surface."""
    class Rising(RisingRun):
        bed_load_columns = table()
        config = {**RisingRun.config, "domain": {"size": [0.016, 0.0125, 0.006]}}
        water = 0.011 - 0.05 / 2500
        history_columns = {**RisingRun.history_columns,
                           "pressure_gradient": (0.2 + 80 * water) / 0.011 + 0 * RisingRun.t}

    rows = dict(zip(threshold.COLUMNS.split(","), np.array(threshold.measure(Rising)).T))
    assert rows["shields"] == pytest.approx(np.full(len(rows["t"]), 0.2 / (1500 * 9.81 * 2e-4)), rel=1e-6)


def test_an_earlier_table_gets_the_new_columns(tmp_path):
    from validation import tables

    tables.write(tmp_path / "old.csv", {"title": "old", "rule": "earlier"}, ["a,b,c", "1,2,3"])
    said, rows = bed_load.with_earlier(tmp_path / "old.csv", {"commit": "", "machine": "", "date": ""}, ["2,2,3,4"], 1)
    assert rows == ["1,2,3,nan", "2,2,3,4"] and said["rule"] == "earlier"
    assert laminar_bed.COLUMNS.endswith("bed_surface,bed_shields,q_star")


def test_the_figure_marks_the_surface(tmp_path):
    y = 5e-5 * (np.arange(40) + 0.5)
    profiles = {"y": y, "solid_fraction": np.where(y < 1.6e-3, 0.6, 0), "grain_velocity": np.exp(y / 3e-4),
                "flux_density": np.exp(y / 3e-4), "particle_pressure": 1.6e-3 - y, "shear_rate": y,
                "production": y, "total_stress": 2e-3 - y, **NUMBERS, "d": 2e-4}
    lines = np.array([np.broadcast_to(column, 40) for column in profiles.values()]).T
    text = "\n".join([",".join(profiles), *(",".join(map(str, line)) for line in lines)])
    (tmp_path / "bedload.csv").write_text(text + "\n")
    (tmp_path / "config.toml").write_text("[case]\ntitle = \"made up\"\n")
    figure = barchan.Run(tmp_path).figure("bedload")
    for axes in figure.axes:
        assert [7.5] * 2 in [list(line.get_ydata()) for line in axes.get_lines()]
    assert figure.axes[0].get_ylim()[1] == pytest.approx(9.875), "the middle of the highest layer"
    (tmp_path / "bedload.csv").unlink()
    with pytest.raises(barchan.MissingData, match="statistics.bed_load"):
        barchan.Run(tmp_path).figure("bedload")
