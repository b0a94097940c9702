"""Force on a held heap by depth: a built heap of three layers whose forces are known."""
import pathlib
import sys
import tempfile

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import force_depth  # noqa: E402
from run_folder import NotInRun, RunFolder  # noqa: E402

D = 2e-4
WEIGHT = 1500 * 9.81 * np.pi / 6 * D**3
FACTORS = np.array([2.0, 0.5, -0.25])  # of the weight, by layer from the top; half of it downstream
failures = []


def built_heap():
    """Columns 1.5 d apart, three grains high; x (n, 3), layer from the top (n), factor of the weight (n)."""
    i, j, layer = (a.ravel() for a in np.meshgrid(np.arange(21), np.arange(21), np.arange(3), indexing="ij"))
    x = np.column_stack([1.5 * D * i + 0.01, (2.5 - layer) * D, 1.5 * D * j])
    return x, layer, FACTORS[layer] * np.where(x[:, 0] > x[:, 0].mean() + D, 0.5, 1.0)


def write_run(folder, forces=force_depth.FORCES):
    """Frames at 0, 1, 2, 3 s, the grains in another order in each; the force swings by its own half about its mean."""
    x, _, factor = built_heap()
    (folder / "config.toml").write_text("[grains]\ndensity = 2500.0\n")
    with h5py.File(folder / "grains.h5", "w") as file:
        for frame in range(4):
            order = np.random.default_rng(frame).permutation(len(x))
            group = file.create_group(f"frame_{frame:06d}")
            group.attrs["time"] = float(frame)
            swing = 99 if frame == 0 else (1.5, 0.5, 1.0)[frame - 1]  # the start does not count
            group["id"], group["x"], group["d"] = order, x[order], np.full(len(x), D)
            for share, name in zip((0.7, 0.2, 0.1), forces):
                group[name] = np.outer(share * swing * WEIGHT * factor[order], [1, 0, 0])


def expect(what, value, expected):
    if not np.isclose(value, expected, rtol=1e-6):
        failures.append(f"{what}: {value:.6g}, not {expected:.6g}")


with tempfile.TemporaryDirectory() as folder:
    write_run(pathlib.Path(folder))
    found = force_depth.of_run(RunFolder(folder), None, None)
    rms = np.sqrt((1.5**2 + 0.5**2 + 1) / 3)
    for part, share in (("upstream", 1.0), ("downstream", 0.5)):
        for layer, depth in enumerate((0.0, 1.0, 2.0)):
            at = int(np.digitize(depth + 1e-6, force_depth.EDGES)) - 1
            expect(f"{part}, layer {layer}", found[part][0][at], share * FACTORS[layer])
            expect(f"{part}, layer {layer}, RMS", found[part][1][at], rms * share * abs(FACTORS[layer]))
        if not np.isnan(found[part][0][1]):
            failures.append(f"{part}: a force where no grain lies")
    expect("whole heap", found["total"], built_heap()[2].mean())
    expect("one frame", force_depth.of_run(RunFolder(folder), 0.9, 1.1)["total"], 1.5 * built_heap()[2].mean())
    try:
        force_depth.of_run(RunFolder(folder), 5.0, 6.0)
        failures.append("a window without frames was taken")
    except NotInRun:
        pass

with tempfile.TemporaryDirectory() as folder:
    write_run(pathlib.Path(folder), forces=("a", "b", "c"))
    try:
        force_depth.of_run(RunFolder(folder), None, None)
        failures.append("a run without forces was taken")
    except NotInRun:
        pass

for failure in failures:
    print(failure)
sys.exit(1 if failures else 0)
