"""Slopes, fluxes, shares and avalanches of dunes that are built so that the answers are known."""
import math
import pathlib
import sys
import tempfile
import warnings

import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "analysis"))
import dune_transport  # noqa: E402
import grain_fluxes  # noqa: E402
import morphodynamics  # noqa: E402
import slip_face  # noqa: E402
import style  # noqa: E402
from dune_shape import Bed, main_dune  # noqa: E402
from make_fake_run import h5py, write_frame  # noqa: E402
from run_folder import Grains, NotInRun, RunFolder  # noqa: E402
from surface import Surface  # noqa: E402

warnings.simplefilter("error")
style.use()

D, PHI = 2e-4, 0.55
SIZE = (0.06, 0.01, 0.012)
BED = Bed((SIZE[0], SIZE[2]), (True, True))
random = np.random.default_rng(7)
failures = []


def expect_near(what, value, expected, tolerance):
    if not abs(value - expected) <= tolerance:
        failures.append(f"{what}: {value:.6g}, not {expected:.6g} +- {tolerance:.2g}")


def ridge(height, length, width=8e-3, x0=0.02, z0=2e-3):
    """Grains at random under height(x) [m] for 0 < x < length, from x0 and z0 on; their centres are inside."""
    top = max(height(x) for x in np.linspace(0, length, 200))
    n = int(PHI * length * width * top / (math.pi / 6 * D**3))
    x, y, z = random.uniform(0, length, n), random.uniform(0, top, n), random.uniform(0, width, n)
    inside = y < np.array([height(each) for each in x])
    return np.stack([x0 + x, y, z0 + z], axis=1)[inside]


def frame(x, t=0.0, u=None):
    n = len(x)
    wrapped = np.mod(x, (SIZE[0], 1.0, SIZE[2]))
    return Grains(t, np.arange(n), wrapped, np.full(n, D), np.zeros(n, int), u)


def dune_of(grains, crest_x, L=0.0):
    """The dune of a frame, as a line of dune.csv with these numbers has it."""
    return main_dune(grains, BED, {name: np.array([value]) for name, value in (
        ("t", 0.0), ("W", 0.0), ("L", L), ("H", 0.0), ("crest_x", crest_x % SIZE[0]), ("horn_left", 0.0),
        ("horn_right", 0.0))})


def triangle(stoss, slip, top, flat=0.0):
    """(height(x), length): up with an angle, along a flat top, down with another one."""
    a, b = math.tan(math.radians(stoss)), math.tan(math.radians(slip))
    crest, brink = top / a, top / a + flat
    return lambda x: min(a * x, top, max(0.0, top - b * (x - brink))), brink + top / b


# Angles and the brink, of a sharp crest and of a flat one; the dune may lie across the periodic seams.
for stoss, slip, flat, x0 in ((8, 24, 0, 0.02), (12, 30, 4e-3, 0.05), (20, 20, 0, 0.02)):
    height, length = triangle(stoss, slip, 2.4e-3, flat)
    grains = frame(ridge(height, length, x0=x0))
    dune = dune_of(grains, x0 + 2.4e-3 / math.tan(math.radians(stoss)) + 0.5 * flat, length)
    shape = slip_face.slopes(dune, D)
    name = f"ridge of {stoss} and {slip} degrees"
    expect_near(f"stoss side, {name}", shape.stoss, stoss, 1.0)
    expect_near(f"slip face, {name}", shape.slip_face, slip, 2.5)
    brink = x0 + 2.4e-3 / math.tan(math.radians(stoss)) + flat
    expect_near(f"brink, {name}", (shape.brink_x - brink + 0.03) % SIZE[0] - 0.03, 0, 2 * 2.5 * D)
    expect_near(f"crest, {name}", shape.crest_height, 2.4e-3 + 0.5 * D, 1.5 * D)
    expect_near(f"packing, {name}", grain_fluxes.packing(grains, dune), PHI, 0.05 * PHI)

# Symmetry: a ridge of one height is its own mirror image; 4 and 8 beside each other differ by a third.
box = ridge(lambda x: 2e-3, 8e-3)
surface = Surface(box[:, 0], box[:, 1] + 0.5 * D, box[:, 2], (2.5 * D, 2.5 * D))
expect_near("asymmetry of a box", slip_face.asymmetry(surface, 6e-3), 0, 0.03)
steps = np.concatenate([ridge(lambda x: 0.8e-3, 8e-3, 4e-3), ridge(lambda x: 1.6e-3, 8e-3, 4e-3, z0=6e-3)])
surface = Surface(steps[:, 0], steps[:, 1], steps[:, 2], (2.5 * D, 2.5 * D))
expect_near("asymmetry of a step", slip_face.asymmetry(surface, 6e-3), 1 / 3, 0.04)

# What passes a line: a box that moves on by 0.4 mm, also over the seam; grains that come back count twice, and for
# nothing; grains beyond the strip do not count.
for x0, line in ((0.02, 0.024), (0.056, 0.0)):
    box = ridge(lambda x: 2e-3, 8e-3, x0=x0)
    before, after = frame(box), frame(box + (4e-4, 0, 0))
    volume, _ = grain_fluxes.crossings(before, after, BED, line, 6e-3, 3e-3)
    expected = PHI * 2e-3 * 4e-4 * 6e-3  # of some 630 grains
    expect_near(f"volume over the line {line}", volume, expected, 0.1 * expected)
    back, n = grain_fluxes.crossings(after, before, BED, line, 6e-3, 3e-3)
    expect_near(f"volume back over the line {line}", back, -volume, 1e-18)
few = np.array([[0.01, 0, 5e-3], [0.011, 0, 5e-3], [0.01, 0, 9e-3], [0.01, 0, 3.9e-3]])
moved = few + [[1e-3, 0, 0], [-1e-3, 0, 0], [1e-3, 0, 0], [1e-3, 0, 1e-3]]  # over 0.0105; the last one into the strip
volume, n = grain_fluxes.crossings(frame(few), frame(moved), BED, 0.0105, 5e-3, 1e-3)
expect_near("one forth, one back, one beside, one into the strip", volume, grain_fluxes.volumes(D), 1e-20)
expect_near("crossings", n, 3, 0)

# Ways of moving: a bed of six layers of 60 x 250 grains. The uppermost rolls, those below creep, some grains fly.
along, across = np.arange(250) + 0.5, np.arange(60) + 0.5
layers = [np.stack([a.ravel() for a in np.meshgrid(along, [y + 0.5], across, indexing="ij")], axis=1) for y in range(6)]
x = D * np.concatenate([*layers, layers[0][::25] + (0, 10, 0)]) * (1, 1.1, 1)  # no ties
u = np.zeros_like(x)
u[:75000, 0], u[75000:90000, 0], u[90000:, 0] = 0.001, 0.01, 0.15
grains = frame(x, 0.0, u)
parts = grain_fluxes.shares(grains, dune_of(grains, 125 * D * 1.1))
for kind, value, expected in zip(grain_fluxes.KINDS, parts, np.array([90, 150, 75]) / 315):
    expect_near(kind, value, expected, 0.02)

# Avalanches: two in grains that move independently otherwise, one of them of two intervals; none without.
counts = random.poisson(20.0, 400).astype(float)
expect_near("variance over mean of independent grains", dune_transport.dispersion(counts), 1.0, 0.2)
alone = dune_transport.avalanches(counts)[1]
if alone > 4:
    failures.append(f"{alone} avalanches in 400 intervals of independent grains")
quiet = np.full(100, 20.0)
quiet[[0, 30, 31, 99]] = [np.nan, 80, 60, 34]
many, n = dune_transport.avalanches(quiet)
if n != 2 or list(np.nonzero(many)[0]) != [30, 31, 99]:
    failures.append(f"avalanches: {n} in {np.nonzero(many)[0]}")
seconds = dune_transport.over_the_last_second(np.arange(30) / 10, np.arange(30.0))
expect_near("mean of a second", seconds[25], 20.5, 1e-9)

# A run: a dune that moves on unchanged. The flux over its crest is phi c H, nothing is lost. (The same 370 grains of
# the dune go over its crest from frame to frame: 5 % of noise.)
with tempfile.TemporaryDirectory() as folder:
    path = pathlib.Path(folder)
    height, length = triangle(10, 25, 2.4e-3, 4e-3)
    start = ridge(height, length, width=10e-3, z0=1e-3)
    times, c = np.arange(31) / 10, 1e-2
    (path / "config.toml").write_text(
        f'[case]\ntitle = "a dune"\n[domain]\nsize = {list(SIZE)}\n[grains]\nboundary_x = "periodic"\n')
    crest_x = 0.02 + 2.4e-3 / math.tan(math.radians(10)) + 2e-3
    (path / "dune.csv").write_text("t,dune,Cx,Cz,celerity,W,L,H,crest_x,horn_left,horn_right\n" + "".join(
        f"{t},0,{c * t},0,{c},0.01,{length},2.4e-3,{(crest_x + c * t) % SIZE[0]},0,0\n" for t in times))
    with h5py.File(path / "grains.h5", "w") as file:
        for index, t in enumerate(times):
            g = frame(start + (c * t, 0, 0))
            write_frame(file, index, t, {"id": g.id, "x": g.x, "d": g.d, "dune": g.dune, "u": 0 * g.x + (c, 0, 0)})
    run = RunFolder(path)
    table, _ = dune_transport.measure(run)
    crest, moving = (np.nanmean(table[name]) for name in ("crest_flux", "migration_flux"))
    expect_near("flux over the crest", crest, PHI * c * 2.4e-3, 0.12 * crest)
    expect_near("phi c H", moving, PHI * c * 2.4e-3, 0.08 * crest)
    expect_near("flux down the slip face", np.nanmean(table["slip_face_flux"]), 0.5 * PHI * c * 2.4e-3, 0.15 * crest)
    expect_near("grains kept", table["kept"][-1], 1, 0)
    expect_near("turnover time", np.mean(table["turnover_time"]), length / c, 0.05 * length / c)
    lines = list(dune_transport.summary(table, dune_transport.measure_shares(run),
                                        dune_transport.window(table["t"], 1.0, 3.0)))
    if not lines[0].startswith("mean of t = 1 to 3 s") or f"flux over the crest {crest:.3g}"[:-4] not in lines[2]:
        failures.append(f"summary: {lines}")
    morphodynamics.draw(run, 1.0, None)
    for name, n_lines in (("morphodynamics", 32), ("transport_shares", 32)):
        if len((path / f"figures_data/{name}.csv").read_text().splitlines()) != n_lines:
            failures.append(f"figures_data/{name}.csv has not {n_lines} lines")
    try:
        dune_transport.window(table["t"], 5.0, None)
        failures.append("a window after the end is taken")
    except NotInRun as reason:
        if "needs two frames between 5 s and 3 s" not in str(reason):
            failures.append(f"a window after the end: {reason}")

for failure in failures:
    print(f"morphodynamics: {failure}", file=sys.stderr)
print("morphodynamics: slopes, fluxes, shares and avalanches as built")
sys.exit(bool(failures))
