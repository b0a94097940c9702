"""The flow as xarray has it: run.fields, run.flow_average, and the files by themselves."""

import os
import shutil
import subprocess
import sys
import tomllib

import h5py
import numpy as np
import pytest
import xarray
from fake_runs import ROOT, fake

import barchan
from barchan.io import hdf5
from barchan.io.fields import Fields


@pytest.fixture(scope="module")
def run():
    return barchan.Run(fake("--average"))


@pytest.fixture
def file(run):
    with h5py.File(run.path / "fields.h5") as file:
        yield file


def frames_of(file):
    return sorted(name for name in file if name.startswith("frame"))


def test_all_frames_are_one_dataset(run, file):
    fields = run.fields
    assert fields.u.dims == ("time", "z", "y", "x")
    assert np.array_equal(fields.time, run.field_times) and len(fields.time) == len(frames_of(file)) > 1
    assert np.array_equal(fields.u, [file[name]["u"][:] for name in frames_of(file)])
    assert list(fields.data_vars) == list(file[frames_of(file)[0]])


def test_coordinates_are_those_of_cf(run, file):
    """Bounds are the faces, also of the stretched rows; every axis is named, the vertical one Z."""
    fields = run.fields
    assert fields.attrs["Conventions"] == "CF-1.10"
    assert {name: fields[name].attrs["axis"] for name in fields.dims if name != "bnds"} == {
        "time": "T", "x": "X", "y": "Z", "z": "Y"}
    assert fields.y.attrs["positive"] == "up" and fields.y.attrs["standard_name"] == "height"
    assert fields.time.attrs["standard_name"] == "time" and fields.time.attrs["units"] == "s"
    for axis in "xyz":
        assert fields[axis].attrs["bounds"] == f"{axis}_bnds"
        bounds = fields[f"{axis}_bnds"]
        assert bounds.dims == (axis, "bnds")
        assert np.array_equal(bounds[:, 0], file[f"grid/{axis}_face"][:-1])
        assert np.array_equal(bounds[:, 1], file[f"grid/{axis}_face"][1:])
    rows = np.diff(fields.y_bnds, axis=1)
    assert rows.max() > 1.5 * rows.min()
    assert np.allclose(fields.y_bnds.sel(y=2e-3, method="nearest").mean(), fields.y.sel(y=2e-3, method="nearest"))


@pytest.fixture
def values_read(monkeypatch):
    """Numbers that are read of arrays of frames, one entry for each time that the file is asked."""
    counts = []
    plain = hdf5.Array.__getitem__

    def counted(self, key):
        values = plain(self, key)
        if "frame" in self.array.name:
            counts.append(values.size)
        return values
    monkeypatch.setattr(hdf5.Array, "__getitem__", counted)
    return counts


def test_only_what_is_used_is_read(values_read, file):
    fields = barchan.Run(fake("--average")).fields
    assert repr(fields) and fields.nbytes and values_read == []
    last = file[frames_of(file)[-1]]["u"][:]
    nz, ny, nx = last.shape
    for asked, expected, read in (
            (fields.u.sel(time=7.9, method="nearest"), last, [last.size]),
            (fields.u.sel(time=7.9, z=0.02, method="nearest"), last[np.argmin(abs(file["grid/z"][:] - 0.02))], [ny * nx]),
            (fields.u.isel(time=-1)[3, ::2, 5], last[3, ::2, 5], [ny // 2]),
            (fields.u.isel(time=-1, y=[7, 0, 2]), last[:, [7, 0, 2]], [3 * nz * nx]),
            (fields.u.isel(time=-1, x=slice(None, None, -1)), last[:, :, ::-1], [last.size]),
            (fields.u.isel(time=[0, -1], z=0).isel(time=1), last[0], [ny * nx])):
        del values_read[:]
        assert np.array_equal(asked.values, expected)
        assert values_read == read
    assert fields.u.isel(time=slice(0, 0), z=0).values.shape == (0, ny, nx)
    del values_read[:]
    assert fields.u.isel(time=slice(0, 2), y=0).mean().values == pytest.approx(
        np.mean([file[name]["u"][:, 0] for name in frames_of(file)[:2]]))
    assert values_read == [nz * nx] * 2


def test_frames_between_are_not_read(run, tmp_path, values_read):
    shutil.copy(run.path / "fields.h5", tmp_path)
    with h5py.File(tmp_path / "fields.h5", "a") as file:
        for number in 2, 3:
            file.copy("frame_000001", f"frame_00000{number}")
            file[f"frame_00000{number}"].attrs["time"] = 8.0 + number
            file[f"frame_00000{number}/u"][:] *= number
        first, last = (file[f"frame_00000{number}/u"][5] for number in (0, 3))
    u = barchan.Run(tmp_path).fields.u
    assert np.array_equal(u.isel(time=[3, 0], z=5).values, [last, first])
    assert values_read == [last.size] * 2


def test_a_plane_of_a_damaged_field_is_read_and_the_whole_is_not(run, tmp_path):
    """The checksum is of the whole array."""
    shutil.copy(run.path / "fields.h5", tmp_path)
    with h5py.File(tmp_path / "fields.h5", "a") as file:
        file[frames_of(file)[-1]]["u"].attrs["checksum"] = np.int64(1)
    u = barchan.Run(tmp_path).fields.u
    assert u.isel(time=-1, z=0).values.shape == u.shape[2:]
    assert np.isfinite(u.isel(time=0).values).all()
    with pytest.raises(barchan.BarchanError, match="its checksum is not that of what was written"):
        u.isel(time=-1).values


def test_a_frame_without_a_field_is_named(run, tmp_path):
    shutil.copy(run.path / "fields.h5", tmp_path)
    with h5py.File(tmp_path / "fields.h5", "a") as file:
        del file[frames_of(file)[1]]["p"]
    os.utime(tmp_path / "fields.h5", (1e9, 1e9))  # nobody is writing it
    fields = barchan.Run(tmp_path).fields
    assert np.isfinite(fields.p.isel(time=0).values).all()
    with pytest.raises(barchan.BarchanError, match="cannot read .*fields.h5"):
        fields.p.isel(time=1).values


def test_flow_average(run):
    average = run.flow_average
    assert average.uv.dims == ("z", "y", "x")
    assert {"time", "window_start"} <= set(average.attrs) and "y_bnds" in average
    with pytest.raises(barchan.MissingData, match="flow_average.h5"):
        barchan.Run(fake("--without", "fields")).flow_average


def test_a_package_that_is_missing_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "xarray", None)
    with pytest.raises(barchan.BarchanError, match="needs xarray, which is not installed"):
        barchan.Run(fake("--average")).fields


def test_the_engine_of_xarray(run, values_read):
    path = run.path / "fields.h5"
    with xarray.open_dataset(path, engine=Fields) as fields:
        assert values_read == []
        assert fields.identical(run.fields)
    assert "p" not in xarray.open_dataset(str(path), engine=Fields, drop_variables="p")
    assert xarray.open_dataset(run.path / "flow_average.h5", engine=Fields).uv.dims == ("time", "z", "y", "x")
    with pytest.raises(barchan.BarchanError, match="grains.h5 has no frame with the fields u, v, alpha_f"):
        xarray.open_dataset(run.path / "grains.h5", engine=Fields)


def test_the_engine_knows_its_files(run, tmp_path):
    knows = Fields().guess_can_open
    assert knows(run.path / "fields.h5") and knows(str(run.path / "flow_average.h5"))
    (tmp_path / "text.h5").write_text("no HDF5")
    for other in run.path / "grains.h5", run.path / "history.csv", tmp_path / "text.h5", tmp_path / "none.h5", b"", None:
        assert not knows(other)


def test_the_engine_by_its_name(run, tmp_path):
    """As pip leaves it: metadata with the entry point of pyproject.toml beside the package."""
    package = tomllib.loads((ROOT / "python/pyproject.toml").read_text())["project"]
    (group, entries), = package["entry-points"].items()
    lines = [f"[{group}]", *(f"{name} = {target}" for name, target in entries.items()), ""]
    metadata = tmp_path / "barchan-0.dist-info"
    metadata.mkdir()
    (metadata / "METADATA").write_text("Metadata-Version: 2.1\nName: barchan\nVersion: 0\n")
    (metadata / "entry_points.txt").write_text("\n".join(lines))
    text = "import sys, xarray; print(xarray.open_dataset(sys.argv[1], engine='barchan').sizes['time'])"
    done = subprocess.run([sys.executable, "-W", "error", "-c", text, run.path / "fields.h5"], capture_output=True,
                          text=True, env={**os.environ, "PYTHONPATH": f"{tmp_path}:{ROOT / 'python'}"})
    assert done.stdout.strip() == str(len(run.field_times)), done.stderr
    installed = (ROOT / "cmake/install.cmake").read_text()
    assert all(line in installed for line in lines)


def test_a_netcdf_file_has_it_all(run, tmp_path):
    """With the engine that Debian's scipy gives; others write CF attributes alike."""
    run.fields.isel(time=slice(0, 2), z=slice(0, 3)).to_netcdf(tmp_path / "part.nc", engine="scipy")
    again = xarray.open_dataset(tmp_path / "part.nc", decode_coords="all")
    assert {"x_bnds", "y_bnds", "z_bnds"} <= set(again.coords)
    assert np.array_equal(again.time, run.field_times[:2]) and again.y.attrs["axis"] == "Z"
    assert np.array_equal(again.u, run.fields.u[:2, :3])


def test_a_plane_ends_with_the_speed_of_floor_and_lid(run, tmp_path):
    shutil.copy(run.path / "fields.h5", tmp_path)
    config = (run.path / "config.toml").read_text()
    for top, speed in (("\"free_slip\"", None), ("\"no_slip\"", 0.0), ("\"no_slip\"\ntop_velocity = 0.3", 0.3)):
        (tmp_path / "config.toml").write_text(config + f"[fluid]\ntop = {top}\n")
        flow = barchan.Run(tmp_path).flow_plane(0, 0.0)
        assert np.all(flow.u[0] == 0) and np.all(flow.v[[0, -1]] == 0)
        assert np.all(flow.u[-1] == (flow.u[-2] if speed is None else speed))
