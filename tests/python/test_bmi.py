"""barchan.bmi by the rules of the Basic Model Interface 2.0, with the program, on a small coupled case."""

import inspect
import os
import re
import runpy

import numpy as np
import pytest
from fake_runs import ROOT

import barchan
from barchan import bmi

FUNCTIONS = {  # of the interface, with their arguments
    **dict.fromkeys(("update", "finalize", "get_component_name", "get_input_item_count", "get_output_item_count",
                     "get_input_var_names", "get_output_var_names", "get_current_time", "get_start_time",
                     "get_end_time", "get_time_units", "get_time_step"), ()),
    "initialize": ("config_file",), "update_until": ("time",),
    **{f"get_var_{what}": ("name",) for what in ("grid", "type", "units", "itemsize", "nbytes", "location")},
    "get_value": ("name", "dest"), "get_value_ptr": ("name",), "get_value_at_indices": ("name", "dest", "inds"),
    "set_value": ("name", "src"), "set_value_at_indices": ("name", "inds", "src"),
    **{f"get_grid_{what}": ("grid",) for what in ("rank", "size", "type", "node_count", "edge_count", "face_count")},
    **{f"get_grid_{what}": ("grid", what) for what in ("shape", "spacing", "origin", "x", "y", "z", "edge_nodes",
                                                       "face_edges", "face_nodes", "nodes_per_face")}}
CASE = ROOT / "tests/support/small_dune.toml"
needs_program = pytest.mark.skipif("BARCHAN_PROGRAM" not in os.environ, reason="BARCHAN_PROGRAM has its path")


def settings(folder, case=CASE, name="bmi.toml", more=""):
    path = folder / name
    path.write_text(f'case = "{case}"\nout = "{folder / "run"}"\ninterval = 0.0025\nthreads = 1\n{more}')
    return str(path)


@pytest.fixture
def model(tmp_path, monkeypatch):
    monkeypatch.setenv("BARCHAN", os.environ.get("BARCHAN_PROGRAM", ""))
    model = bmi.BarchanBmi()
    model.initialize(settings(tmp_path))
    yield model
    model.finalize()


def value(model, name):
    dest = np.empty(model.get_grid_size(model.get_var_grid(name)), model.get_var_type(name))
    assert model.get_value(name, dest) is dest
    return dest


def test_it_has_the_functions_of_the_interface():
    assert len(FUNCTIONS) == 41
    for name, arguments in FUNCTIONS.items():
        assert tuple(inspect.signature(getattr(bmi.BarchanBmi, name)).parameters) == ("self", *arguments), name


@needs_program
def test_variables_and_grids(model):
    inputs, outputs = model.get_input_var_names(), model.get_output_var_names()
    assert inputs == ("channel_water_flow__speed",) and len(inputs) == model.get_input_item_count()
    assert len(outputs) == model.get_output_item_count() == len(set(outputs))
    for name in (*inputs, *outputs):
        found, grid = value(model, name), model.get_var_grid(name)
        assert found.dtype == model.get_var_type(name) and found.itemsize == model.get_var_itemsize(name)
        assert model.get_var_nbytes(name) == model.get_var_itemsize(name) * model.get_grid_size(grid)
        assert model.get_var_location(name) == "node" and model.get_var_units(name) in ("m", "m s-1", "1")
        last = np.array([found.size - 1])
        assert model.get_value_at_indices(name, np.empty(1, found.dtype), last) == found[last] or np.isnan(found[last])
    bed = model.get_var_grid("channel_bottom_surface__elevation")
    assert model.get_grid_type(bed) == "uniform_rectilinear" and model.get_grid_rank(bed) == 2
    rows, columns = shape = model.get_grid_shape(bed, np.empty(2, int))
    spacing, origin = model.get_grid_spacing(bed, np.empty(2)), model.get_grid_origin(bed, np.empty(2))
    assert shape.prod() == model.get_grid_size(bed) == model.get_grid_node_count(bed)
    x, y = model.get_grid_x(bed, np.empty(columns)), model.get_grid_y(bed, np.empty(rows))
    assert columns > rows and np.allclose(np.diff(x), spacing[1]) and (y[0], x[0]) == tuple(origin)
    assert 0.012 - spacing[1] < x[-1] < 0.012 + spacing[1] and 0.006 - spacing[0] < y[-1] < 0.006 + spacing[0]
    assert model.get_grid_type(model.get_var_grid("dune__width")) == "scalar"
    for name in ("face_nodes", "edge_nodes", "z"):
        with pytest.raises(NotImplementedError):
            getattr(model, f"get_grid_{name}")(bed, np.empty(1))


@needs_program
def test_the_bed_is_where_the_heap_was_poured(model):
    """Around [0.008, 0.003], as high as some grains, on bare floor."""
    bed = value(model, "channel_bottom_surface__elevation").reshape(model.get_grid_shape(1, np.empty(2, int)))
    row, column = np.unravel_index(bed.argmax(), bed.shape)
    assert abs(model.get_grid_x(1, np.empty(bed.shape[1]))[column] - 0.008) < 0.001
    assert abs(model.get_grid_y(1, np.empty(bed.shape[0]))[row] - 0.003) < 0.001
    assert 4e-4 < bed.max() < 3e-3 and (bed == 0).mean() > 0.5


@needs_program
def test_time_goes_on_and_a_pointer_follows(model):
    bed = model.get_value_ptr("channel_bottom_surface__elevation")
    first = bed.copy()
    assert (model.get_start_time(), model.get_current_time(), model.get_end_time()) == (0, 0, 0.01)
    assert (model.get_time_units(), model.get_time_step()) == ("s", 0.0025)
    model.update()
    assert model.get_current_time() == pytest.approx(0.0025) and (bed != first).any()
    model.update_until(0.0036)  # no multiple of the fluid step: the next one
    assert model.get_current_time() == pytest.approx(0.00375)
    assert (bed == value(model, "channel_bottom_surface__elevation")).all()
    model.update_until(0.00375)
    with pytest.raises(barchan.BadInput, match="is at 0.00375 s and cannot go to 0.002 s"):
        model.update_until(0.002)
    for name in ("dune__width", "dune__height", "channel_bottom_water_flow__shear_speed"):
        assert 1e-4 < value(model, name)[0] < 1e-1, name
    assert value(model, "sediment_grain__count") == 200


@needs_program
def test_it_gives_the_bits_of_an_unbroken_run(model, tmp_path):
    model.update_until(0.005)
    model.update_until(0.01)
    whole = barchan.run(CASE, out=tmp_path / "whole", threads=1, quiet=True)
    parts = barchan.open(tmp_path / "run")
    for name in ("x", "u"):
        assert (whole.grains()[name].to_numpy() == parts.grains()[name].to_numpy()).all()


@needs_program
def test_a_speed_that_is_set_drives_the_flow(model, tmp_path):
    pointer = model.get_value_ptr("channel_water_flow__speed")
    model.update()
    model.set_value("channel_water_flow__speed", np.array([0.3]))
    assert pointer[0] == 0.3
    model.update()
    history = barchan.open(tmp_path / "run").history.bulk_velocity
    assert history.loc[0.0025] == pytest.approx(0.2, rel=0.02) and history.loc[0.005] == pytest.approx(0.3, rel=0.02)
    for wrong in ([np.nan], [0.1, 0.2]):
        with pytest.raises(barchan.BadInput, match="must be 1 finite number"):
            model.set_value("channel_water_flow__speed", np.array(wrong))
    with pytest.raises(barchan.BadInput, match="dune__width is computed and cannot be set"):
        model.set_value("dune__width", np.array([1.0]))
    model.set_value("channel_water_flow__speed", np.array([1e9]))
    with pytest.raises(barchan.BadInput, match="mean_velocity"):
        model.update()
    assert model.get_current_time() == pytest.approx(0.005)


@needs_program
def test_the_loop_of_the_page(tmp_path, monkeypatch, capsys):
    """As printed, for two updates of the small case."""
    monkeypatch.setenv("BARCHAN", os.environ["BARCHAN_PROGRAM"])
    monkeypatch.chdir(tmp_path)
    blocks = re.findall(r"^```python\n(.*?)^```", (ROOT / "docs/results.md").read_text(), re.S | re.M)
    loop = next(block for block in blocks if "BarchanBmi" in block)
    settings(tmp_path, name="coupled.toml")
    (tmp_path / "loop.py").write_text(loop.replace("< 0.6", "< 0.004").replace("< 0.01:", "< 1:"))
    runpy.run_path("loop.py")
    said = capsys.readouterr().out.splitlines()
    assert len(said) == 2 and ": 0.20 m/s, dune at " in said[0] and ": 0.22 m/s, dune at " in said[1]


@needs_program
def test_refusals(tmp_path, monkeypatch):
    monkeypatch.setenv("BARCHAN", os.environ["BARCHAN_PROGRAM"])
    model = bmi.BarchanBmi()
    with pytest.raises(barchan.BadInput, match="call initialize first"):
        model.update()
    for text, said in (("spacng = 1", 'unknown name "spacng" .did you mean "spacing"'),
                       ("spacing = -1", "spacing must be a number above 0"),
                       ("set = { grains.density = -1 }", "grains.density")):
        with pytest.raises(barchan.BarchanError, match=said):
            model.initialize(settings(tmp_path, more=text))
    assert not (tmp_path / "run").exists()
    model.initialize(settings(tmp_path))
    with pytest.raises(barchan.BarchanError, match='unknown name "dune__widht" .did you mean "dune__width"'):
        model.get_var_units("dune__widht")
    model.update()
    model.finalize()
    model.finalize()
    with pytest.raises(barchan.BadInput, match="--overwrite"):  # results of the first time are not lost
        model.initialize(settings(tmp_path))
    model.initialize(settings(tmp_path, more="overwrite = true"))
    assert model.get_current_time() == 0
