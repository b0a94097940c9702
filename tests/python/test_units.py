"""Units and meanings are those that the files of a run say, in every table and array; files without them open."""

import json
import os
import shutil
import subprocess

import h5py
import pytest
from fake_runs import ROOT, fake

import barchan
from barchan.dune import detect
from barchan.io import units

PROGRAM = os.environ.get("BARCHAN_PROGRAM", "")


@pytest.mark.parametrize("unit, expected", [
    ("m/s", "m s-1"), ("m2/s", "m2 s-1"), ("m^2/s", "m2 s-1"), ("m^2/s^2", "m2 s-2"), ("1/s", "s-1"), ("Pa/m", "Pa m-1"),
    ("kg/m^3", "kg m-3"), ("rad/s", "rad s-1"), ("N m", "N m"), ("-", "1"), ("1", "1"), ("degree", "degree")])
def test_units_are_written_as_cf_does(unit, expected):
    assert units.cf(unit) == expected


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """A run with a probe, forces and averages."""
    if not PROGRAM:
        pytest.skip("needs the program, whose path BARCHAN_PROGRAM has")
    folder = tmp_path_factory.mktemp("units")
    case = (ROOT / "tests/support/small_dune.toml").read_text()
    (folder / "case.toml").write_text(case + """
[[output.probe]]
name = "wake"
at = [0.006, 0.003, 0.003]
interval = 0.001
""")
    done = subprocess.run([PROGRAM, "run", folder / "case.toml", "--out", folder / "run", "--quiet", "--set",
                           "time.end=0.004", "--set", "output.grain_forces=true", "--set", "output.history_interval=0.001",
                           "--set", "output.dune_interval=0.002", "--set", "output.grains_interval=0.002", "--set",
                           "output.tracks_interval=0.002", "--set", "output.fields_interval=0.002", "--set",
                           "statistics.start=0", "--set", "statistics.fields=true", "--set",
                           "statistics.interval=0.001", "--set", "statistics.grain_forces=true"],
                          capture_output=True, text=True, env={**os.environ, "OMP_NUM_THREADS": "1"})
    assert done.returncode == 0, done.stderr
    return barchan.Run(folder / "run")


def test_every_column_of_a_run_has_a_unit_and_a_meaning(run):
    said = json.loads((run.path / "columns.json").read_text())
    for name in "history", "dunes", "probes", "statistics", "force_map":
        table = getattr(run, name).reset_index().drop(columns="index", errors="ignore")
        file = {"dunes": "dune"}.get(name, name) + ".csv"
        assert len(table) > 0 and set(table.attrs["units"]) == set(table.attrs["long_names"]) == set(table.columns)
        for column, one in said[file].items():
            assert table.attrs["units"][column] == units.cf(one["unit"])
            assert table.attrs["long_names"][column] == one["meaning"] != ""
    assert run.history.attrs["units"]["stress_on_grains"] == "Pa"


def test_every_array_of_a_run_has_a_unit_and_a_meaning(run):
    grains = run.grains()
    assert {"force_drag_x", "force_total_z", "omega_y"} <= set(grains.columns)
    assert set(grains.attrs["units"]) == set(grains.attrs["long_names"]) == {"id", *grains.columns}
    assert grains.attrs["units"]["omega_y"] == "rad s-1" and grains.attrs["units"]["force_drag_x"] == "N"
    track = run.track(grains.index[:2])
    assert track.attrs["units"] == {"id": "1", "t": "s", "x": "m", "y": "m", "z": "m"}
    for fields in run.fields, run.flow_average:
        for array in (*fields.data_vars.values(), fields.x, fields.y, fields.z):
            assert array.attrs["units"] and array.attrs["long_name"]
    assert run.fields.u.attrs == {"units": "m s-1", "long_name": "velocity along x"}
    assert run.flow_average.uv.attrs == {"units": "m2 s-2", "long_name": "mean of u'v'"}


def test_dunes_of_other_programs_are_measured_in_the_same_words(run):
    """MEASURED is for grains without a run; its words are those of the program."""
    said = units.of_columns(json.loads((run.path / "columns.json").read_text())["dune.csv"])
    assert {name: (unit, words.replace("`", "")) for name, (unit, words) in said.items()
            if name in detect.MEASURED} == detect.MEASURED


@pytest.mark.parametrize("columns", [None, "", "[]", '{"history.csv": 3}', '{"history.csv": {"t": 1, "u_star": {}}}'])
def test_a_run_of_an_earlier_version_has_no_units_and_opens(tmp_path, columns):
    folder = shutil.copytree(fake("--average"), tmp_path / "run")
    (folder / "columns.json").unlink()
    if columns is not None:
        (folder / "columns.json").write_text(columns)
    for name in "grains.h5", "fields.h5":
        with h5py.File(folder / name, "a") as file:
            file.visititems(lambda _, item: item.attrs.__delitem__("units") if "units" in item.attrs else None)
    run = barchan.Run(folder)
    assert run.history.attrs["units"] == {} and len(run.history) > 1
    assert set(run.dunes.attrs["units"]) <= {"horn_left_2d_1s", "horn_right_2d_1s"} and len(run.dunes) > 1
    assert run.grains().attrs["units"] == {} and len(run.track(run.grains().index[:1])) > 1
    assert "units" not in run.fields.u.attrs and "units" not in run.fields.x.attrs
