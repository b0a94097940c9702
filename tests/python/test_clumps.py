"""Spheres of clumps in frames, pictures, files for VTK and the report."""

import base64
import json
import shutil
from dataclasses import replace

import h5py
import numpy as np
import pytest
from fake_runs import fake
from test_vtkhdf import frames_of, read

import barchan
from barchan import vtk
from barchan.dune.tracks import tracks
from barchan.figures import grain_image, movie
from barchan.io.clumps import Shapes, rotated, spheres_of
from barchan.io.frames import Grains
from barchan.report import grains as report_grains


@pytest.fixture(scope="module")
def run():
    return barchan.Run(fake("--clumps", "--frames", "3"))


def dimer(x=(0.0, 1.0, 0.0), q=(1.0, 0.0, 0.0, 0.0), d=1.0):
    """A grain of two spheres of diameter 0.5 at -0.5 and 0.5 along its first axis."""
    shapes = Shapes(np.zeros(2, int), np.array([[-0.5, 0, 0], [0.5, 0, 0]]), np.array([0.25, 0.25]))
    return Grains(0.0, np.zeros(1, int), np.array([x]), np.array([d]), orientation=np.array([q]), shapes=shapes)


def test_a_quarter_of_a_turn():
    half = np.sqrt(0.5)
    about_y = np.array([[half, 0, half, 0]])
    assert rotated(about_y, np.array([[1.0, 0, 0]])).tolist() == [pytest.approx([0, 0, -1])]
    assert rotated(about_y, np.array([[0, 1.0, 0]])).tolist() == [pytest.approx([0, 1, 0])]
    spheres = spheres_of(dimer(q=(half, 0, half, 0), d=2.0))
    assert spheres.x == pytest.approx(np.array([[0, 1, 1], [0, 1, -1]]))
    assert spheres.d.tolist() == [1, 1] and spheres.grain.tolist() == [0, 0]


def test_spheres_of_a_frame(run):
    grains = run.frame(1)
    spheres = spheres_of(grains)
    assert len(spheres.d) == np.sum(1 + grains.kind)
    volume = np.bincount(spheres.grain, spheres.d ** 3)
    assert volume == pytest.approx(grains.d ** 3)
    for axis in range(3):
        middle = np.bincount(spheres.grain, spheres.x[:, axis]) / np.bincount(spheres.grain)
        assert middle == pytest.approx(grains.x[:, axis], abs=1e-15)
    assert np.ptp(spheres.x[spheres.grain == 5], axis=0)[1] == 0  # turned about the vertical


def test_grains_without_orientation_are_spheres_themselves():
    grains = barchan.Run(fake()).frame(0)
    spheres = spheres_of(grains)
    assert grains.orientation is None and grains.shapes is None
    assert spheres.x is grains.x and spheres.d is grains.d
    assert np.array_equal(spheres.grain, np.arange(len(grains.d)))


def test_a_table_of_spheres(run):
    table, grains, spheres = run.spheres(frame=2), run.grains(frame=2), spheres_of(run.frame(2))
    assert list(table.columns) == ["x", "y", "z", "d"] and table.index.name == "id"
    assert np.array_equal(table[["x", "y", "z"]], spheres.x) and np.array_equal(table["d"], spheres.d)
    assert np.array_equal(table.index, grains.index[spheres.grain])
    assert table.attrs["units"]["x"] == "m" and table.attrs["time"] == grains.attrs["time"]
    assert {"orientation_w", "orientation_x", "orientation_y", "orientation_z"} < set(grains.columns)


def test_pictures_show_the_spheres():
    """Seen from above two discs stand apart, with nothing where the sphere of the clump's volume would be."""
    window = (-1.0, 1.0, -1.0, 1.0)
    picture = grain_image.top_view(dimer(), window, 200, 2.0)
    drawn = picture.min(axis=2) < 0.99
    assert drawn.mean() == pytest.approx(2 * np.pi * 0.25 ** 2 / 4, rel=0.05)
    assert not drawn[:, 90:110].any()
    one = grain_image.top_view(replace(dimer(), orientation=None), window, 200, 2.0)
    assert (one.min(axis=2) < 0.99).mean() == pytest.approx(np.pi * 0.5 ** 2 / 4, rel=0.05)


def test_tracks_lead_to_the_spheres(run, tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(run.path, folder)
    with h5py.File(run.path / "grains.h5") as source, h5py.File(folder / "tracks.h5", "w") as file:
        for number, name in enumerate(sorted(name for name in source if name.startswith("frame_")) * 2):
            group = file.create_group(f"frame_{number:06d}")
            group.attrs.update(time=float(number), step=number)
            for array in ("id", "x", "orientation"):
                group[array] = source[name][array][:].astype("i8" if array == "id" else "f4")
    copied = barchan.Run(folder)
    shown, read = movie.Frames(copied).grains(2), tracks(copied).read(2)
    for grains in (shown, read):
        order = np.argsort(grains.id)
        assert np.array_equal(grains.kind[order], run.frame(2).kind)
        spheres, wanted = spheres_of(grains), spheres_of(replace(run.frame(2), d=grains.d[order]))  # d by the id
        assert np.sort(spheres.x[:, 0]) == pytest.approx(np.sort(wanted.x[:, 0]), abs=1e-7)
        assert np.sort(spheres.d) == pytest.approx(np.sort(wanted.d))


@pytest.mark.parametrize("temporal", [False, True])
def test_files_for_vtk_have_the_spheres(run, tmp_path, temporal):
    folder = tmp_path / "run"
    shutil.copytree(run.path, folder)
    with h5py.File(folder / "grains.h5", "a") as file:  # a frame without grains
        empty = file.copy("frame_000001", "frame_000003") or file["frame_000003"]
        for array, values in [(array, empty[array][:0]) for array in empty]:
            names = dict(empty[array].attrs)
            del empty[array]
            empty[array] = values
            empty[array].attrs.update(names)
        empty.attrs["time"] = 9.0
    assert vtk.main([*(["--temporal"] if temporal else []), str(folder)]) == 0
    wanted = [(run.frame(n), spheres_of(run.frame(n))) for n in range(3)]
    if temporal:
        with h5py.File(folder / "vtkhdf/spheres.vtkhdf") as file:
            top = file["VTKHDF"]
            assert top["NumberOfPoints"][:].tolist() == [len(spheres.d) for _, spheres in wanted]
            ends = np.cumsum(top["NumberOfPoints"])
            for (_, spheres), end in zip(wanted, ends):
                np.testing.assert_array_equal(top["Points"][end - len(spheres.d):end], spheres.x)
                np.testing.assert_array_equal(top["PointData/d"][end - len(spheres.d):end], spheres.d)
        return
    shutil.copy(folder / "vtkhdf/spheres.h5", folder)
    for (grains, spheres), (_, _, path) in zip(wanted, frames_of(folder, "spheres")):
        grid, arrays = read(path)
        assert grid.GetNumberOfPoints() == grid.GetNumberOfCells() == len(spheres.d)
        assert grid.GetPoint(5) == tuple(spheres.x[5])
        np.testing.assert_array_equal(arrays["d"], spheres.d)
        np.testing.assert_array_equal(arrays["id"], grains.id[spheres.grain])
        np.testing.assert_array_equal(arrays["kind"], grains.kind[spheres.grain])
        assert "orientation" not in arrays and arrays["u"].shape == (len(spheres.d), 3)


def test_the_report_has_orientations(run):
    """The data of the page lead to the spheres: three parts of a quaternion, the fourth positive."""
    facts, data = report_grains.pack(run)
    words = np.frombuffer(base64.b64decode(data), "<u2")
    n, frames = facts["n"], len(facts["times"])
    assert len(words) == n * (1 + 6 * frames + 1)
    shown = words[n:n * (1 + 6 * frames)].reshape(frames, 6, n)[1]
    parts = shown[3:].T / 65534 * 2 - 1
    q = np.column_stack([np.sqrt(np.clip(1 - np.sum(parts**2, axis=1), 0, 1)), parts])
    grains = run.frame(1)
    ids, _ = report_grains.kept_ids(run, [0, 1, 2])
    there = shown[0] != 65535
    rows = np.searchsorted(grains.id, ids[there])
    assert np.abs(np.sum(q[there] * grains.orientation[rows], axis=1)) == pytest.approx(1, abs=1e-3)
    assert len(facts["spheres"]) == 2 and len(facts["spheres"][1]) == 2
    assert report_grains.pack(barchan.Run(fake()))[0]["spheres"] == []


def test_without_clumps_there_are_no_files_of_spheres(tmp_path):
    folder = tmp_path / "run"
    shutil.copytree(fake(), folder)
    (folder / "vtkhdf").mkdir()
    (folder / "vtkhdf/spheres.h5").write_text("of an earlier run")
    assert vtk.main([str(folder)]) == 0
    assert not list((folder / "vtkhdf").glob("spheres*"))
    names = {entry["name"] for entry in json.loads((folder / "vtkhdf/grains.hdf.series").read_text())["files"]}
    assert names < {path.name for path in (folder / "vtkhdf").iterdir()}
