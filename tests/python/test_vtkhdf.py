"""VTKHDF files of a run: what VTK's own reader finds in them is what the run wrote."""

import json
import os
import shutil

import h5py
import numpy as np
import pytest
from fake_runs import fake

from barchan import vtk

if "CI" in os.environ:
    import vtkmodules.vtkIOHDF  # noqa: F401  # there it may not be missing


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    folder = tmp_path_factory.mktemp("of vtk") / "run"
    shutil.copytree(fake("--average"), folder)
    assert vtk.main([str(folder)]) == 0
    return folder


def read(path):
    """The grid of a file, and its arrays by name, as VTK 9.1 and newer read them."""
    hdf = pytest.importorskip("vtkmodules.vtkIOHDF")
    from vtkmodules.util.numpy_support import vtk_to_numpy
    reader = hdf.vtkHDFReader()
    assert reader.CanReadFile(str(path))
    reader.SetFileName(str(path))
    reader.Update()
    grid = reader.GetOutputDataObject(0)
    data = [grid.GetPointData(), grid.GetCellData()]
    return grid, {part.GetArrayName(n): vtk_to_numpy(part.GetArray(n))
                  for part in data for n in range(part.GetNumberOfArrays())}


def frames_of(run, kind):
    """(name, time, path of its file) of every frame, by the series."""
    with h5py.File(run / f"{kind}.h5") as file:
        frames = [(name, float(file[name].attrs["time"])) for name in sorted(file) if name.startswith("frame_")]
    entries = json.loads((run / f"vtkhdf/{kind}.hdf.series").read_text())["files"]
    assert [entry["time"] for entry in entries] == [time for _, time in frames]
    return [(name, time, run / "vtkhdf" / entry["name"]) for (name, time), entry in zip(frames, entries)]


def test_grains_are_vertices_with_all_their_arrays(run):
    frames = frames_of(run, "grains")
    assert frames
    for name, _, path in frames:
        grid, arrays = read(path)
        with h5py.File(run / "grains.h5") as file:
            frame = {array: file[name][array][:] for array in file[name]}
        n = len(frame["id"])
        assert grid.GetNumberOfPoints() == grid.GetNumberOfCells() == n
        for g in range(0, n, 7):
            assert grid.GetCell(g).GetCellType() == 1
            assert grid.GetPoint(g) == tuple(frame["x"][g])
        assert set(arrays) == set(frame) - {"x"}
        for array, values in arrays.items():
            np.testing.assert_array_equal(values, frame[array])


def test_fields_are_hexahedra_of_the_mesh(run):
    with h5py.File(run / "fields.h5") as file:
        x, y, z = (file[f"grid/{axis}_face"][:] for axis in "xyz")
    for name, time, path in frames_of(run, "fields"):
        grid, arrays = read(path)
        with h5py.File(run / "fields.h5") as file:
            frame = {array: file[name][array][:] for array in file[name]}
        nz, ny, nx = frame["u"].shape
        assert grid.GetNumberOfCells() == nz * ny * nx
        for k, j, i in ((0, 0, 0), (nz - 1, ny - 1, nx - 1), (nz // 2, ny // 3, nx // 4)):
            cell = grid.GetCell((k * ny + j) * nx + i)
            assert cell.GetCellType() == 12
            assert cell.GetBounds() == (x[i], x[i + 1], y[j], y[j + 1], z[k], z[k + 1])
        volume = pytest.importorskip("vtkmodules.vtkFiltersVerdict").vtkCellSizeFilter()
        volume.SetInputData(grid)
        volume.Update()
        sizes = volume.GetOutput().GetCellData().GetArray("Volume")  # below 0 where corners are in another order
        sizes = np.array([sizes.GetValue(n) for n in range(sizes.GetNumberOfTuples())]).reshape(nz, ny, nx)
        np.testing.assert_allclose(sizes, np.diff(z)[:, None, None] * np.diff(y)[:, None] * np.diff(x), rtol=1e-9)
        assert set(arrays) == {*frame, "velocity"}
        for array in frame:
            np.testing.assert_array_equal(arrays[array], frame[array].reshape(-1))
        np.testing.assert_array_equal(arrays["velocity"], np.stack([frame[a].reshape(-1) for a in "uvw"], axis=1))


def test_values_are_linked_and_move_with_the_run(run, tmp_path):
    moved = tmp_path / "elsewhere"
    shutil.copytree(run, moved)
    for name, time, path in frames_of(moved, "grains"):
        with h5py.File(path) as file, h5py.File(moved / "grains.h5") as source:
            assert file["VTKHDF/FieldData/TimeValue"][0] == time
            assert file["VTKHDF"].get("Points", getlink=True).filename == "../grains.h5"
            np.testing.assert_array_equal(file["VTKHDF/Points"][:], source[name]["x"][:])


def test_written_anew_and_refused_without_frames(run, tmp_path, capsys):
    stale = run / "vtkhdf/grains_999999.hdf"
    stale.write_text("old")
    assert vtk.main([str(run)]) == 0
    assert not stale.exists()
    assert vtk.main([str(tmp_path)]) == 2
    assert vtk.main([str(tmp_path / "nowhere")]) == 2
    said = capsys.readouterr().err
    assert "needs grains.h5 or fields.h5" in said and "no such run folder" in said
