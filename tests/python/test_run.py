"""barchan.Run: tables, grains, fields and tracks with their names, units and times."""

import json
import os
import subprocess
import sys

import h5py
import numpy as np
import pytest
from fake_runs import ROOT, fake

import barchan
from barchan import vtk


@pytest.fixture(scope="module")
def run():
    return barchan.Run(fake("--average"))


def test_open_tells_runs_from_studies():
    assert isinstance(barchan.open(fake("--average")), barchan.Run)
    assert isinstance(barchan.open(fake("--study")), barchan.Study)
    with pytest.raises(barchan.BarchanError, match="no such run folder: /nowhere"):
        barchan.open("/nowhere")


def test_a_run_named_without_its_folder(tmp_path, monkeypatch):
    (tmp_path / "runs/dune").mkdir(parents=True)
    monkeypatch.chdir(tmp_path)
    with pytest.raises(barchan.BarchanError, match=r"no such run folder: dune \(did you mean runs/dune\?\)"):
        barchan.Run("dune")


@pytest.mark.parametrize("t", ["0.5", {}, [0.5, 1.0], np.array([0.5, 1.0]), slice(1)])
def test_a_time_that_is_no_number(run, t):
    for ask in run.grains, run.to_pyvista:
        with pytest.raises(barchan.BarchanError, match="t must be a number, a time in seconds, and is|needs pyvista"):
            ask(t=t)
    for name in "start", "end", "time":
        with pytest.raises(barchan.BarchanError, match=f"{name} must be a number, a time in seconds, and is"):
            run.figure("morphodynamics", **{name: t})
    assert run.grains(t=np.float32(0.5)).attrs["time"] == run.grains(t=run.fields.time[0] + 0.5).attrs["time"]


@pytest.mark.parametrize("frame", ["1", 1.5, [1]])
def test_a_frame_that_is_no_number(run, frame):
    with pytest.raises(barchan.BarchanError, match="frame must be a whole number, and is"):
        run.grains(frame=frame)


@pytest.mark.parametrize("ids, says", [([10**9], "no frame of .*grains.h5 has a grain with one of these ids"),
                                       ([1.5], "ids must be whole numbers"), ("7", "ids must be whole numbers")])
def test_tracks_of_no_grains(run, ids, says):
    with pytest.raises(barchan.BarchanError, match=says):
        run.track(ids)
    assert len(run.track([])) == 0


def test_tables_have_units(run):
    assert run.history.index.name == "t"
    assert run.history.attrs["units"]["u_star"] == "m s-1"
    assert run.history.u_star.iloc[-1] == run.history_columns["u_star"][-1]
    assert set(run.history.columns) <= set(run.history.attrs["units"])
    dunes = run.dunes
    assert dunes.index.names == ["dune", "t"]
    assert np.all(dunes.loc[0].W == run.main_dune_columns["W"])
    assert dunes.attrs["units"]["celerity"] == "m s-1"


def test_config_and_summary(run):
    assert run.config["domain"]["size"] == list(run.domain) == [0.1, 0.025, 0.04]
    assert run.title == "synthetic barchan"
    assert run.summary == json.loads((run.path / "run.json").read_text())


def test_grains_of_a_time_and_of_a_frame(run):
    grains = run.grains(t=4.1)
    assert grains.attrs["time"] == 4.0
    with h5py.File(run.path / "grains.h5") as file:
        frame = next(file[name] for name in file if file[name].attrs["time"] == 4.0)
        rows = np.argsort(frame["id"][:])
        assert np.array_equal(grains.index, frame["id"][:][rows])
        assert np.array_equal(grains[["x", "y", "z"]], frame["x"][:][rows])
    assert run.grains(frame=0).attrs["time"] == 0.0
    assert run.grains().attrs["time"] == run.grains(frame=-1).attrs["time"] == run.grain_times[-1]


@pytest.mark.parametrize("wanted, said", [
    ({"t": 1, "frame": 1}, "give t or frame, not both"), ({"t": 99}, "no frame near t = 99 s .* 0 to 8 s"),
    ({"frame": 17}, "no frame 17 .* it has 17, 0 to 16"), ({"frame": -18}, "no frame -18")])
def test_a_frame_that_is_not_there(run, wanted, said):
    with pytest.raises(barchan.BarchanError, match=said):
        run.grains(**wanted)


def test_tracks_of_a_few_grains(run):
    ids = run.grains(frame=0).index[[3, 7]]
    track = run.track(ids)
    assert list(track.columns) == ["id", "t", "x", "y", "z"]
    assert set(track.id) == set(ids)
    for number in ids:
        one = track[track.id == number]
        assert np.all(np.diff(one.t) > 0)
        assert one.x.iloc[0] == run.grains(frame=0).x[number]


@pytest.mark.parametrize("ask, file", [
    (lambda run: run.history, "history.csv"), (lambda run: run.dunes, "dune.csv"),
    (lambda run: run.grains(), "grains.h5"), (lambda run: run.fields, "fields.h5"),
    (lambda run: run.track([1]), "grains.h5")])
def test_what_is_missing_is_named(tmp_path, ask, file):
    with pytest.raises(barchan.MissingData, match=f"needs {file}"):
        ask(barchan.Run(tmp_path))


def test_a_package_that_is_missing_is_named(run, monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with pytest.raises(barchan.BarchanError, match="needs pandas, which is not installed: apt install python3-pandas"):
        run.grains()


class Points:
    """Stands in for pyvista's meshes: keeps what it is given."""

    def __init__(self, *arrays):
        self.arrays, self.point_data, self.cell_data = arrays, {}, {}


def test_pyvista_gets_spheres_and_a_grid(run, monkeypatch):
    """With a stand-in for pyvista, which Debian 12 does not have."""
    stand_in = type(sys)("pyvista")
    stand_in.PolyData = stand_in.RectilinearGrid = Points
    stand_in.MultiBlock = dict
    monkeypatch.setitem(sys.modules, "pyvista", stand_in)
    blocks = run.to_pyvista(t=3.0)
    grains, grid = blocks["grains"], blocks["flow"]
    assert np.array_equal(grains.arrays[0], run.grains(t=3.0)[["x", "y", "z"]])
    assert {"id", "d", "dune"} <= set(grains.point_data)
    assert [len(faces) - 1 for faces in grid.arrays] == list(run.fields.u.shape[:0:-1])
    u = run.fields.u.sel(time=3.0, method="nearest").values
    assert np.array_equal(grid.cell_data["u"].reshape(u.shape), u)


READ_ALL = """
import resource, sys
import barchan
run = barchan.Run(sys.argv[1])
run.grains(frame=0)
one = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss
for grains in run.frames(progress=False):
    last = grains.attrs["time"]
print(one, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, last)
"""


def test_frames_in_groups_come_after_those_in_the_root(tmp_path):
    """As the program writes more than 250 frames; a link to another file among them is not followed."""
    paths = [f"frame_{index:06d}" if index < 250 else f"frame_group_{index // 250:03d}/frame_{index:06d}"
             for index in range(750)]
    with h5py.File(tmp_path / "grains.h5", "w") as file:
        for index in reversed(range(750)):
            group = file.create_group(paths[index])
            group.attrs["time"] = 0.5 * index
            group["id"], group["x"], group["d"] = [3], [[1.0 * index, 0, 0]], [2e-4]
    run = barchan.Run(tmp_path)
    assert run.grain_file.frames == [(0.5 * index, path) for index, path in enumerate(paths)]
    assert run.grains(frame=749)["x"].item() == 749 and run.grains(t=150)["x"].item() == 300
    assert vtk.main([str(tmp_path)]) == 0
    with h5py.File(tmp_path / "vtkhdf/grains_000700.hdf") as file:
        assert file["VTKHDF/Points"][0, 0] == 700
    with h5py.File(tmp_path / "grains.h5", "a") as file:
        file["frame_group_003"] = h5py.ExternalLink("other.h5", "/")
    with pytest.raises(barchan.BarchanError, match="frame_group_003 in it is a link"):
        barchan.Run(tmp_path).grains()


def test_many_frames_take_the_memory_of_one(tmp_path):
    """40 frames of 50,000 grains, 6 MB each as a table: reading all takes no more than two of them beside the first."""
    n = 50_000
    random = np.random.default_rng(3)
    with h5py.File(tmp_path / "grains.h5", "w") as file:
        for index in range(40):
            group = file.create_group(f"frame_{index:06d}")
            group.attrs["time"] = 0.1 * index
            for name, values in (("id", random.permutation(n)), ("x", random.random((n, 3))), ("d", random.random(n)),
                                 ("u", random.random((n, 3))), ("omega", random.random((n, 3)))):
                group[name] = values
    done = subprocess.run([sys.executable, "-c", READ_ALL, tmp_path], capture_output=True, text=True, check=True,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")})
    one, all_of_them, last = map(float, done.stdout.split())
    assert last == pytest.approx(3.9)
    assert all_of_them - one < 2 * 6000, f"{all_of_them - one:.0f} kB more than for one frame"
