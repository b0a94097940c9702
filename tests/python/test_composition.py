"""Which kinds of grains lie where: a made-up dune with one kind on its surface, one in its horns."""

import shutil

import h5py
import numpy as np
import pytest
from fake_runs import fake
from matplotlib.figure import Figure

import barchan
from barchan.dune.composition import REGIONS, composition, regions
from barchan.dune.shape import main_dune
from barchan.dune.tracks import bed_of
from barchan.figures.grain_image import by_group
from barchan.io.run_folder import RunFolder

NAMES = ("glass", "zirconium")


def with_kinds(folder, kind_of):
    """The made-up run with the kind of each grain that kind_of(run, index) says."""
    shutil.copytree(fake(), folder)
    run = RunFolder(folder)
    kinds = [kind_of(run, index) for index in range(len(run.need_grains().frames))]
    with h5py.File(folder / "grains.h5", "r+") as file:
        for (_, name), kind in zip(run.need_grains().frames, kinds):
            order = np.argsort(file[name]["id"][:])
            stored = np.empty(len(order), np.int32)
            stored[order] = kind
            file[name].create_dataset("kind", data=stored).attrs["names"] = "\n".join(NAMES) + "\n"
    return folder


def at_surface(run, index):
    grains = run.frame(index)
    dune = main_dune(grains, bed_of(run), run.dune_columns[0])
    kind = np.zeros(len(grains.id), int)
    kind[regions(grains, dune)["surface"]] = 1
    return kind


@pytest.fixture(scope="module")
def run(tmp_path_factory):
    return barchan.Run(with_kinds(tmp_path_factory.mktemp("kinds") / "run", at_surface))


def test_shares_are_of_the_region(run):
    found = composition(run)
    assert found.kinds == NAMES
    assert np.all(found.share("surface")[:, 1] == 1)
    assert np.all(found.share("crest")[:, 1] == 1)
    assert np.all(found.share("dune").sum(axis=1) == pytest.approx(1))
    assert np.all(found.share("dune")[:, 1] < 1)


def test_the_surface_is_about_a_layer(run):
    """As many grains as cover the dune's area once, to a factor that a layer of loose grains may have."""
    grains = run.frame(-1)
    dune = main_dune(grains, bed_of(run), run.dune_columns[0])
    d, found = grains.d.mean(), regions(grains, dune)
    cover = len(found["surface"]) * np.pi / 4 * d**2 / (len(dune.surface.h) * dune.surface.bins.prod())
    assert 0.6 < cover < 1.8
    top = grains.x[:, 1] + grains.d / 2
    assert top[found["crest"]].mean() > top[found["surface"]].mean()
    assert set(found["crest"]) <= set(found["surface"]) <= set(found["dune"])


def test_few_grains_have_no_share(tmp_path):
    run = RunFolder(with_kinds(tmp_path / "run", at_surface))
    found = composition(run)
    found.count["horns"][:] = (10, 9)
    assert np.all(np.isnan(found.share("horns")))


def test_the_figure_and_its_numbers(run):
    figure = run.figure("composition")
    assert isinstance(figure, Figure)
    numbers = figure.numbers["composition"]
    assert set(numbers) == {"t", *(f"{region}_{name}" for region in REGIONS for name in NAMES)}
    assert sum(numbers["surface_glass"]) == 0 < min(numbers["surface_zirconium"])
    assert "At the end the surface is 0.0 % glass, 100.0 % zirconium." in figure.sentences


def test_one_kind_has_no_composition():
    with pytest.raises(barchan.MissingData, match="several kinds"):
        barchan.Run(fake()).figure("composition")


def test_readers_know_kinds(run):
    grains = run.grains()
    assert grains.attrs["kinds"] == NAMES
    assert set(grains["kind"]) == {0, 1}
    assert run.frame(0).groups == NAMES
    assert barchan.Run(fake()).frame(0).group is None


def test_pictures_show_kinds(run):
    """From above almost all is the kind of the surface: its colour, in light and shade."""
    picture = run.figure("topviews").axes[0].images[0].get_array()
    sand = picture[picture.sum(axis=2) < 2.4]
    glass, zirconium = by_group(np.array([0, 1]))
    nearer = [np.mean(sand @ colour / np.linalg.norm(sand, axis=1) / np.linalg.norm(colour))
              for colour in (glass, zirconium)]
    assert nearer[1] > nearer[0]
    assert run.figure("topviews").axes[-1].get_xlabel() == "kind of the grain"
