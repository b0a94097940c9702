"""clumps: slopes of heaps and solid fractions of beds by friction and shape, from the runs of clump-heap-study.toml and
clump-bed-study.toml. `--keep` takes the folder that has both, runs/validation.

Slopes (degrees) are those of the surface of a ridge on a rough plate, `slope_smooth` on a smooth one; solid fractions
are those of the middle of a bed. Means over realisations, and their standard deviations. `eccentricity`: how far the normal of a contact passes by the centre of a
grain, over d/2, in the mean over its surface (Wensrich & Katterfeld 2012). That of rolling friction is mu_r/2: its
torque has the arm mu_r R, and R of two equal spheres is d/4.
"""

from pathlib import Path

import numpy as np
from matplotlib.lines import Line2D

from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.clumps import spheres_of
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import gap_of
from validation import tables

NAME = "clumps"
COLUMNS = "what,shape,rolling_friction,sliding_friction,eccentricity,mean,sd,runs"
FLANK = (0.15, 0.85)  # of half the length of the plate: where slopes are taken
LAYER = (2.5, 3.0)    # from the floor, from the top of a bed, in diameters: where its middle ends
VOXEL = 0.05          # of a diameter
SPHERE, MU, MU_R = "sphere", (0.1, 0.3, 0.5), (0.0, 0.1, 0.3)

# Published solid fractions (sliding friction, solid fraction), and of sand from loose to dense: docs/validation.md.
PUBLISHED = {"sphere": [(0, 0.639), (0.3, 0.593)], "dimer": [(0, 0.707)]}
SAND = (0.50, 0.61)
COLOURS = dict(zip(("sphere", "dimer", "tetrahedron", "cube", "sand"), style.GROUPS))


def zhou(sliding, rolling, wall=0.5):
    """Angle of repose of spheres [degrees], of the same mu_r between grains and at the plate.

    The fit of Zhou et al., Powder Technol. 125, 45 (2002), as it is commonly quoted; not checked against the paper.

    Their rolling frictions are arms in mm, as is d: here mu_r d/4 between grains and mu_r d/2 at the plate. Of d there
    is left its power -0.02, which is left out.
    """
    return 68.61 * sliding**0.27 * wall**0.22 * (rolling / 4) ** 0.06 * (rolling / 2) ** 0.12


def surface(spheres, domain, d):
    """Places x (n) of strips a diameter wide, and the mean height of the surface there (n) [m]."""
    n = [int(round(domain[axis] / d)) for axis in (0, 2)]
    top = np.zeros(n)
    at = [np.clip((spheres.x[:, axis] / domain[axis] % 1 * count).astype(int), 0, count - 1)
          for axis, count in zip((0, 2), n)]
    np.maximum.at(top, tuple(at), spheres.x[:, 1] + spheres.d / 2)
    return (np.arange(n[0]) + 0.5) * domain[0] / n[0], top.mean(axis=1)


def slope(run):
    """Slope of a ridge on a plate [degrees], mean of both flanks, from the last frame."""
    grains = run.frame(-1)
    x, height = surface(spheres_of(grains), run.domain, grains.d.mean())
    half = run.domain[0] / 2
    angles = []
    for side in (-1, 1):
        away = side * (x - half) / half
        flank = (away > FLANK[0]) & (away < FLANK[1])
        angles.append(np.degrees(np.arctan(-np.polyfit(half * away[flank], height[flank], 1)[0])))
    return float(np.mean(angles))


def solid_fraction(run):
    """Share of the middle of a bed that is in any sphere, from the last frame; the box is periodic along x and z."""
    grains = run.frame(-1)
    spheres, d = spheres_of(grains), grains.d.mean()
    low, high = LAYER[0] * d, np.mean(surface(spheres, run.domain, d)[1]) - LAYER[1] * d
    if high - low < 2 * d:
        raise MissingData("a bed is too thin")
    return filled(spheres, (run.domain[0], run.domain[2]), low, high, VOXEL * d)


def filled(spheres, period, low, high, size):
    """Share of the points of a lattice, `size` apart between the heights low and high [m], that are in a sphere."""
    n = [int(round(length / size)) for length in (period[0], high - low, period[1])]
    step = [length / count for length, count in zip((period[0], high - low, period[1]), n)]
    inside = np.zeros(n, bool)
    for x, radius in zip(spheres.x - (0, low, 0), spheres.d / 2):
        if not -radius < x[1] < high - low + radius:
            continue
        own = [np.arange(int(np.ceil((x[axis] - radius) / step[axis] - 0.5)),
                         int(np.floor((x[axis] + radius) / step[axis] - 0.5)) + 1) for axis in range(3)]
        own[1] = own[1][(own[1] >= 0) & (own[1] < n[1])]
        away = [((own[axis] + 0.5) * step[axis] - x[axis]) ** 2 for axis in range(3)]
        hit = away[0][:, None, None] + away[1][:, None] + away[2] < radius**2
        inside[np.ix_(own[0] % n[0], own[1], own[2] % n[2])] |= hit
    return float(inside.mean())


def eccentricity(shapes, points=4000):
    """Mean distance of the normals of the surface of a clump from its centre, over d/2; (M, 3) places, (M) radii."""
    if shapes is None:
        return 0.0
    number = np.arange(points) + 0.5
    y, turn = 1 - 2 * number / points, np.pi * (1 + np.sqrt(5)) * number  # a Fibonacci lattice
    normal = np.column_stack([np.sqrt(1 - y**2) * np.cos(turn), y, np.sqrt(1 - y**2) * np.sin(turn)])
    weight, total = 0.0, 0.0
    for own, (centre, radius) in enumerate(zip(shapes.centre, shapes.radius)):
        place = centre + radius * normal
        apart = np.linalg.norm(place[:, None] - shapes.centre, axis=2) - shapes.radius
        apart[:, own] = 0
        outside = np.all(apart > -1e-12, axis=1)
        arm = np.linalg.norm(np.cross(centre, normal[outside]), axis=1)
        weight, total = weight + radius**2 * outside.sum(), total + radius**2 * arm.sum()
    return float(total / weight / 0.5)


def kind_of(run):
    """(shape, rolling friction, sliding friction, eccentricity) of the grains of a run."""
    grains = run.config["grains"]
    shape = grains["clump"] if grains["shape"] == "clump" else SPHERE
    return shape, grains["rolling_friction"], grains["sliding_friction"], eccentricity(run.shapes)


def save(runs, folder):
    """Keeps means and standard deviations of the finished runs of both studies as clumps.csv; its path."""
    found, run = {}, None
    for what, study, measure in (("slope", "clump-heap-study", slope), ("fraction", "clump-bed-study", solid_fraction)):
        for file in sorted((Path(runs) / study).glob("*/grains.h5")):
            if gap_of(file.parent):
                continue
            run = RunFolder(file.parent)
            smooth = what == "slope" and run.config["grains"]["floor"] == "smooth"
            found.setdefault((what + "_smooth" * smooth, *kind_of(run)), []).append(measure(run))
    if run is None:
        raise MissingData(f"needs finished runs of clump-heap-study.toml or clump-bed-study.toml in {runs}")
    lines = [f"{what},{shape},{rolling:g},{sliding:g},{off:.4f},{np.mean(values):.5g},"
             f"{np.std(values, ddof=1) if len(values) > 1 else np.nan:.2g},{len(values)}"
             for (what, shape, rolling, sliding, off), values in found.items()]
    return tables.keep(folder / f"{NAME}.csv", "Heaps and beds of clumps",
                       "./barchan sweep configs/validation/clump-heap-study.toml, clump-bed-study.toml", run.summary,
                       [COLUMNS, *lines])


def rows_of(table, what, shape, rolling=0.0):
    """Columns of one shape and rolling friction, by sliding friction."""
    rows = (table["what"] == what) & (table["shape"] == shape) & (table["rolling_friction"] == rolling)
    order = np.argsort(table["sliding_friction"][rows])
    return {name: table[name][rows][order] for name in table.columns}


def equivalent(table, shape, sliding):
    """Rolling friction that gives spheres the slope of a clump, between the nearest of MU_R; nan beyond them."""
    spheres = [rows_of(table, "slope", SPHERE, rolling) for rolling in MU_R]
    angles = [float(rows["mean"][rows["sliding_friction"] == sliding][0]) for rows in spheres]
    own = rows_of(table, "slope", shape)
    wanted = float(own["mean"][own["sliding_friction"] == sliding][0])
    return float(np.interp(wanted, angles, MU_R, left=np.nan, right=np.nan))


def summary(folder):
    """Means of each shape; for clumps the rolling friction of spheres with the same slope, over the eccentricity."""
    table = tables.read_saved(folder, NAME)
    shapes = list(dict.fromkeys(table["shape"]))
    for what in ("slope_smooth", "slope", "fraction"):
        for shape in shapes:
            for rolling in MU_R if shape == SPHERE else MU_R[:1]:
                rows = rows_of(table, what, shape, rolling)
                if len(rows["mean"]):
                    values = ", ".join(f"{m:.4g} +- {sd:.2g}" for m, sd in zip(rows["mean"], rows["sd"]))
                    yield f"{what}, {shape}, mu_r {rolling:g} | {values}"
    for shape in (shape for shape in shapes if shape != SPHERE):
        rows = rows_of(table, "slope", shape)
        if len(rows["mean"]):
            off = rows["eccentricity"][0]
            alike = [equivalent(table, shape, sliding) for sliding in rows["sliding_friction"]]
            yield f"{shape} | eccentricity {off:.3f}, as mu_r " + ", ".join(f"{value:.3f}" for value in alike)


def draw(folder):
    """Slopes of (a) spheres on a smooth plate, beside Zhou et al., (b) clumps, (c) by rolling friction or eccentricity;
    (d) solid fractions."""
    table = tables.read_saved(folder, NAME)
    figure, panels = style.panels(None, 1, 4, figsize=(style.FULL_WIDTH, 2.6))
    spheres, clumps, both, beds = panels.ravel()
    fine = np.linspace(0.08, 0.55, 50)
    for rolling, colour in zip(MU_R[1:], style.GROUPS):
        errorbar(spheres, rows_of(table, "slope_smooth", SPHERE, rolling), colour, f"$\\mu_r$ = {rolling:g}")
        spheres.plot(fine, zhou(fine, rolling), color=colour, ls=(0, (4, 1.5)), lw=0.8)
    for shape, colour in COLOURS.items():
        errorbar(clumps, rows_of(table, "slope", shape), colour, shape)
        errorbar(beds, rows_of(table, "fraction", shape), colour, shape)
        for sliding, fraction in PUBLISHED.get(shape, ()):
            beds.plot(sliding, fraction, **style.reference_marks(colour))
    beds.axhspan(*SAND, color=COLOURS["sand"], alpha=0.25, lw=0)
    for marker, sliding in zip("os^", MU):
        draw_alike(both, table, sliding, marker)
    for axes in (spheres, clumps):
        axes.set(xlabel="sliding friction", ylabel="slope (°)", ylim=(0, 45), xlim=(0, 0.6))
    both.set(xlabel="$\\mu_r/2$; eccentricity", ylabel="slope (°)", ylim=(0, 45))
    beds.set(xlabel="sliding friction", ylabel="solid fraction", xlim=(-0.04, 0.6))
    spheres.legend(handles=[*spheres.get_legend_handles_labels()[0],
                            Line2D([], [], color="0.3", ls=(0, (4, 1.5)), lw=0.8, label="Zhou et al.")],
                   loc="lower right")
    clumps.legend(loc="lower right", fontsize="small", labelspacing=0.2)
    both.legend(loc="lower right")
    for index, axes in enumerate(panels.ravel()):
        style.panel_label(axes, index)
    return figure


def errorbar(axes, rows, colour, label):
    axes.errorbar(rows["sliding_friction"], rows["mean"], np.nan_to_num(rows["sd"]), color=colour, lw=1.0, marker="o",
                  ms=3, capsize=1.5, label=label)


def draw_alike(axes, table, sliding, marker):
    """Slopes at one sliding friction: of spheres a line by rolling friction, of clumps marks by eccentricity."""
    spheres = [rows_of(table, "slope", SPHERE, rolling) for rolling in MU_R]
    angles = [rows["mean"][rows["sliding_friction"] == sliding] for rows in spheres]
    if all(len(angle) for angle in angles):
        axes.plot(np.divide(MU_R, 2), np.concatenate(angles), color="0.5", lw=0.8, marker=marker, ms=3.5)
    axes.plot([], [], color="0.5", lw=0.8, marker=marker, ms=3.5, label=f"$\\mu$ = {sliding:g}")
    for shape, colour in list(COLOURS.items())[1:]:
        rows = rows_of(table, "slope", shape)
        one = rows["sliding_friction"] == sliding
        axes.plot(rows["eccentricity"][one], rows["mean"][one], ls="", marker=marker, ms=3.5, color=colour)
