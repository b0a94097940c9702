"""VTKHDF files with time: read back as the reader of VTK does, by the offsets of each step."""

import shutil

import h5py
import numpy as np
import pytest
from fake_runs import fake
from test_vtkhdf import read

from barchan import vtk
from barchan.dune.bodies import bodies_of
from barchan.io.run_folder import RunFolder

CELLS = ("Vertices", "Lines", "Polygons", "Strips")


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    """With fewer grains in each frame than in the last one, and none in one of them."""
    folder = tmp_path_factory.mktemp("of vtk") / "run"
    shutil.copytree(fake("--bodies", "--frames", "5"), folder)
    with h5py.File(folder / "grains.h5", "a") as file:
        names = sorted(name for name in file if name.startswith("frame_"))
        for number, name in enumerate(names):
            keep = 0 if number == 2 else len(file[name]["id"]) - 7 * number
            for array, values in [(array, file[name][array][:keep]) for array in file[name]]:
                del file[name][array]
                file[name][array] = values
    assert vtk.main(["--temporal", str(folder)]) == 0
    return folder


def head(file):
    """The group of VTKHDF, its version and its type as a reader in C gets them."""
    top = file["VTKHDF"]
    kind = h5py.h5a.open(top.id, b"Type").get_type()
    assert not kind.is_variable_str() and kind.get_cset() == h5py.h5t.CSET_ASCII
    assert top.attrs["Version"].dtype.kind == "i" and list(top.attrs["Version"]) == [2, 0]
    assert kind.get_size() == len(top.attrs["Type"])
    return top, top.attrs["Type"].decode()


def check_types(top):
    """Numbers of points and cells are int64, places double; types of cells are bytes."""
    def look(name, dataset):
        if isinstance(dataset, h5py.Dataset) and "Data/" not in name:
            kind = {"Points": "f8", "Steps/Values": "f8", "Types": "u1"}.get(name, "i8")
            assert dataset.dtype == np.dtype(kind), name
    top.visititems(look)


def parts_of(top, step):
    steps = top["Steps"]
    part = int(steps["PartOffsets"][step])
    assert steps["NumberOfParts"][step] == 1
    return steps, part, slice(int(steps["PointOffsets"][step]),
                              int(steps["PointOffsets"][step] + top["NumberOfPoints"][part]))


def cells_of(group, part, first, first_id):
    """Corners of the cells of a part; Offsets have an entry more than cells in each part before it."""
    count, ids = int(group["NumberOfCells"][part]), int(group["NumberOfConnectivityIds"][part])
    before, start = 0, 0  # as vtkHDFReader counts them
    for earlier in group["NumberOfCells"][:part]:
        if before >= first:
            break
        before, start = before + earlier, start + 1
    offsets = group["Offsets"][first + start:first + start + count + (count > 0)]
    assert len(offsets) == count + (count > 0) and (count == 0 or (offsets[0], offsets[-1]) == (0, ids))
    return np.split(group["Connectivity"][first_id:first_id + ids], offsets[1:-1]) if count else []


def test_grains_of_every_step_are_those_of_its_frame(run):
    with h5py.File(run / "vtkhdf/grains.vtkhdf") as file, h5py.File(run / "grains.h5") as source:
        top, kind = head(file)
        assert kind == "PolyData" and set(top) == {"NumberOfPoints", "Points", "PointData", "Steps", *CELLS}
        check_types(top)
        names = [name for name in sorted(source) if name.startswith("frame_") and len(source[name]["id"])]
        assert top["Steps"].attrs["NSteps"] == len(names) == 4
        assert len({len(source[name]["id"]) for name in names}) == 4
        for step, name in enumerate(names):
            steps, part, rows = parts_of(top, step)
            assert steps["Values"][step] == source[name].attrs["time"]
            n = len(source[name]["id"])
            np.testing.assert_array_equal(top["Points"][rows], source[name]["x"])
            assert set(top["PointData"]) == set(steps["PointDataOffsets"]) == set(source[name]) - {"x"}
            for array in top["PointData"]:
                start = steps["PointDataOffsets"][array][step]
                np.testing.assert_array_equal(top["PointData"][array][start:start + n], source[name][array])
            assert steps["CellOffsets"].shape == steps["ConnectivityIdOffsets"].shape == (4, 4)
            for at, topology in enumerate(CELLS):
                cells = cells_of(top[topology], part, steps["CellOffsets"][step, at],
                                 steps["ConnectivityIdOffsets"][step, at])
                np.testing.assert_array_equal(np.reshape(cells, -1), np.arange(n) if at == 0 else [])


def test_the_mesh_of_the_flow_is_there_once(run):
    with h5py.File(run / "vtkhdf/fields.vtkhdf") as file, h5py.File(run / "fields.h5") as source:
        top, kind = head(file)
        assert kind == "UnstructuredGrid"
        check_types(top)
        names = sorted(name for name in source if name.startswith("frame_"))
        nz, ny, nx = source[names[0]]["u"].shape
        count = nx * ny * nz
        assert len(top["Points"]) == top["NumberOfPoints"][0] == (nx + 1) * (ny + 1) * (nz + 1)
        assert list(top["NumberOfCells"]) == [count] and len(top["Types"]) == count
        steps = top["Steps"]
        assert steps.attrs["NSteps"] == len(names) == 2
        for name in ("PartOffsets", "PointOffsets", "CellOffsets", "ConnectivityIdOffsets"):
            assert not steps[name][:].any() and len(steps[name]) == 2
        for step, name in enumerate(names):
            assert steps["Values"][step] == source[name].attrs["time"]
            frame = {array: source[name][array][:].reshape(-1) for array in source[name]}
            frame["velocity"] = np.stack([frame[axis] for axis in "uvw"], axis=1)
            assert set(top["CellData"]) == set(frame)
            for array, values in frame.items():
                start = steps["CellDataOffsets"][array][step]
                np.testing.assert_array_equal(top["CellData"][array][start:start + count], values)
        corners = cells_of(top, 0, 0, 0)
        x, y, z = (source[f"grid/{axis}_face"][:] for axis in "xyz")
        for k, j, i in ((0, 0, 0), (nz - 1, ny - 1, nx - 1), (nz // 2, ny // 3, nx // 4)):
            places = top["Points"][:][corners[(k * ny + j) * nx + i]]
            np.testing.assert_array_equal(places.min(axis=0), (x[i], y[j], z[k]))
            np.testing.assert_array_equal(places.max(axis=0), (x[i + 1], y[j + 1], z[k + 1]))


def test_bodies_are_in_both_kinds_of_files(run):
    bodies = bodies_of(RunFolder(run))
    assert len(bodies) == 2
    with h5py.File(run / "vtkhdf/bodies.vtkhdf") as file:
        top, kind = head(file)
        assert kind == "PolyData" and "Steps" not in top
        check_types(top)
        points, number = top["Points"][:], top["CellData/body"][:]
        triangles = np.array(cells_of(top["Polygons"], 0, 0, 0))
        assert triangles.shape == (len(number), 3) and set(number) == {0, 1}
        assert not any(cells_of(top[kind], 0, 0, 0) for kind in CELLS if kind != "Polygons")
    for body in bodies:  # upright cylinders: their points are on a side or on a lid
        own = points[np.unique(triangles[number == body.number])]
        middles = body.centre + body.lattice["copies"]
        sides = np.min([np.hypot(*(own[:, (0, 2)] - middle).T) for middle in middles], axis=0) - body.radius
        lids = abs(own[:, 1] - 0.5 * body.height) - 0.5 * body.height
        assert abs(np.maximum(sides, lids)).max() < 1e-10
    assert vtk.main([str(run)]) == 0
    grid, arrays = read(run / "vtkhdf/bodies.hdf")
    assert grid.GetNumberOfCells() == len(triangles) and grid.GetCell(0).GetCellType() == 5
    assert grid.GetBounds() == (*points[:, 0][[points[:, 0].argmin(), points[:, 0].argmax()]], points[:, 1].min(),
                                points[:, 1].max(), points[:, 2].min(), points[:, 2].max())
    np.testing.assert_array_equal(arrays["body"], number)
    assert (run / "vtkhdf/grains.vtkhdf").exists()  # neither kind removes the other


def test_written_anew_and_refused_without_frames(run, tmp_path, capsys):
    stale = run / "vtkhdf/heaps.vtkhdf"
    stale.write_text("old")
    assert vtk.main(["--temporal", str(run)]) == 0
    assert not stale.exists()
    printed = capsys.readouterr().out.splitlines()
    assert printed == [str(run / f"vtkhdf/{kind}.vtkhdf") for kind in ("grains", "fields", "bodies")]
    assert vtk.main(["--temporal", str(tmp_path)]) == 2
    assert "needs grains.h5 or fields.h5" in capsys.readouterr().err
