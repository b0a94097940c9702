"""Force on a held heap by depth: a built heap of three layers whose forces are known."""

import h5py
import numpy as np
import pytest

from barchan import MissingData, Run
from barchan.dune import force_depth

D = 2e-4
WEIGHT = 1500 * 9.81 * np.pi / 6 * D**3
FACTORS = np.array([2.0, 0.5, -0.25])  # of the weight, by layer from the top; half of it downstream


def built_heap():
    """Columns 1.5 d apart, three grains high; x (n, 3), layer from the top (n), factor of the weight (n)."""
    i, j, layer = (a.ravel() for a in np.meshgrid(np.arange(21), np.arange(21), np.arange(3), indexing="ij"))
    x = np.column_stack([1.5 * D * i + 0.01, (2.5 - layer) * D, 1.5 * D * j])
    return x, layer, FACTORS[layer] * np.where(x[:, 0] > x[:, 0].mean() + D, 0.5, 1.0)


def write_run(folder, forces=force_depth.FORCES, kinds="", kind=None):
    """Frames at 0, 1, 2, 3 s, the grains in another order in each; the force swings by its own half about its mean."""
    x, _, factor = built_heap()
    (folder / "config.toml").write_text("[grains]\ndensity = 2500.0\n" + kinds)
    with h5py.File(folder / "grains.h5", "w") as file:
        for frame in range(4):
            order = np.random.default_rng(frame).permutation(len(x))
            group = file.create_group(f"frame_{frame:06d}")
            group.attrs["time"] = float(frame)
            swing = 99 if frame == 0 else (1.5, 0.5, 1.0)[frame - 1]  # the start does not count
            group["id"], group["x"], group["d"] = order, x[order], np.full(len(x), D)
            for share, name in zip((0.7, 0.2, 0.1), forces):
                group[name] = np.outer(share * swing * WEIGHT * factor[order], [1, 0, 0])
            if kind is not None:
                group["kind"] = kind[order]
    return Run(folder)


@pytest.mark.parametrize("part, share", [("upstream", 1.0), ("downstream", 0.5)])
def test_mean_and_fluctuation_of_each_layer(tmp_path, part, share):
    means, fluctuations = force_depth.of_run(write_run(tmp_path))[part]
    rms = np.sqrt((1.5**2 + 0.5**2 + 1) / 3)
    for layer, depth in enumerate((0.0, 1.0, 2.0)):
        at = int(np.digitize(depth + 1e-6, force_depth.EDGES)) - 1
        assert means[at] == pytest.approx(share * FACTORS[layer], rel=1e-6)
        assert fluctuations[at] == pytest.approx(rms * share * abs(FACTORS[layer]), rel=1e-6)
    assert np.isnan(means[1]), "a force where no grain lies"


def test_the_whole_heap_and_a_single_frame(tmp_path):
    run, mean = write_run(tmp_path), built_heap()[2].mean()
    assert force_depth.of_run(run)["total"] == pytest.approx(mean, rel=1e-6)
    assert force_depth.of_run(run, 0.9, 1.1)["total"] == pytest.approx(1.5 * mean, rel=1e-6)


def test_the_weight_is_that_of_each_kind(tmp_path):
    """The upper layer is of grains whose weight in water is twice that of the others."""
    _, layer, factor = built_heap()
    kinds = "[[grains.kind]]\nname = \"light\"\n[[grains.kind]]\nname = \"heavy\"\ndensity = 4000\n"
    found = force_depth.of_run(write_run(tmp_path, kinds=kinds, kind=(layer == 0).astype(int)))
    means = found["upstream"][0]
    at = [int(np.digitize(depth + 1e-6, force_depth.EDGES)) - 1 for depth in (0.0, 1.0, 2.0)]
    assert means[at] == pytest.approx(FACTORS / (2, 1, 1), rel=1e-6)
    assert found["total"] == pytest.approx(factor.mean() * 3 / 4, rel=1e-6)
    of_one = {"grains": {"kind": [{"name": "heavy", "density": 4000.0}]}}
    assert force_depth.submerged_weight(of_one, D, None) == pytest.approx(2 * WEIGHT)
    (tmp_path / "bare").mkdir()
    with pytest.raises(MissingData, match="with the kind of each grain"):
        force_depth.of_run(write_run(tmp_path / "bare", kinds=kinds))


def test_what_it_needs(tmp_path):
    (tmp_path / "a").mkdir()
    (tmp_path / "b").mkdir()
    with pytest.raises(MissingData, match="needs a frame with forces between t = 5 s and 6 s"):
        force_depth.of_run(write_run(tmp_path / "a"), 5.0, 6.0)
    with pytest.raises(MissingData, match="output.grain_forces = true"):
        force_depth.of_run(write_run(tmp_path / "b", forces=("a", "b", "c")))
