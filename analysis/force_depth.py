"""force_depth of a study of held heaps: the force of the water along the stream on their grains, by depth.

The force is drag, pressure gradient and stress over the grain's weight in water, each grain's mean from --from to --to
(default: the last two thirds of the run). The depth of a grain counts from the top of the highest grain
within one mean diameter along the floor to its own top. Parts of the heap: upstream of its centroid by more than a
fifth of its radius, downstream by as much, and the crest between.
"""

import matplotlib.pyplot as plt
import numpy as np

import style
from run_folder import NotInRun
from spread import spread

OPTIONS = ("start", "end")
FORCES = ("force_drag", "force_pressure_gradient", "force_stress")
PARTS = ("upstream", "crest", "downstream")
EDGES = np.array([0, 0.25, 0.5, 0.75, 1, 1.5, 2, 3, 5])  # of depth, in mean diameters


def draw(study, start=None, end=None):
    """One panel for each part of the heap; the curves are means over the realisations."""
    found = {case.name: [of_run(run, start, end) for run in case.runs] for case in study.cases if case.runs}
    if not found:
        raise NotInRun("needs a case with grains.h5")
    figure, panels = plt.subplots(1, 3, figsize=(style.FULL_WIDTH, 2.8), sharey=True)
    middle = 0.5 * (EDGES[1:] + EDGES[:-1])
    rows = []
    for name, runs in found.items():
        total = spread([run["total"] for run in runs])
        print(f"{name}: force on the heap over its weight {total.mean:.3f} +- {total.deviation:.3f} ({total.count})")
        for part, axes in zip(PARTS, panels):
            means, fluctuations = (np.nanmean([run[part][which] for run in runs], axis=0) for which in (0, 1))
            axes.plot(middle, means, marker="o", ms=2.5, label=name)
            rows += [(name, part, *line) for line in zip(EDGES[:-1], EDGES[1:], means, fluctuations)]
    for index, (part, axes) in enumerate(zip(PARTS, panels)):
        axes.axhline(0, color=style.GREY, lw=0.6)
        axes.set(title=part, xlabel="depth (d)", xlim=(0, EDGES[-1]))
        style.panel_label(axes, index)
    panels[0].set_ylabel("force along the stream / weight")
    panels[-1].legend(loc="upper right")
    study.write_rows("force_depth", dict(zip(("case", "part", "depth_from", "depth_to", "mean", "rms"),
                                             ([list(column)] for column in zip(*rows)))))
    return figure


def of_run(run, start, end):
    """{part: (mean, RMS in time) by depth} of F_x over the weight; "total" of the whole heap."""
    file = run._frame_file("grains.h5", ("id", "x", "d", *FORCES))
    if file is None:
        raise NotInRun("needs grains.h5 with forces (output.grain_forces = true)")
    last = file.times[-1]
    start, end = last / 3 if start is None else start, last if end is None else end
    inside = [name for time, name in file.frames if start - 1e-9 <= time <= end + 1e-9]
    if not inside:
        raise NotInRun(f"needs a frame with forces between t = {start:g} s and {end:g} s")
    with file.open() as content:
        samples = [read_frame(content[name]) for name in inside]
    x, d, _ = samples[-1]
    force = np.array([sample[2] for sample in samples])
    grains, water = run.config.get("grains", {}), run.config.get("fluid", {}).get("density", 1000.0)
    gravity = np.linalg.norm(grains.get("gravity", [0, -9.81, 0]))
    weight = (grains.get("density", 2500.0) - water) * gravity * np.pi / 6 * d**3
    return by_depth(x, d, force.mean(axis=0) / weight, np.sqrt((force**2).mean(axis=0)) / weight, weight)


def read_frame(group):
    """x (n, 3) [m], d (n) [m], force along x (n) [N], by id."""
    order = np.argsort(group["id"][:])
    force = sum(group[name][:, 0] for name in FORCES)
    return group["x"][:][order], group["d"][:][order].astype(float), force[order].astype(float)


def by_depth(x, d, mean, rms, weight):
    depths = depth_of(x, d) / d.mean()
    from_centre = x[:, 0] - x[:, 0].mean()
    edge = 0.2 * np.percentile(np.hypot(from_centre, x[:, 2] - x[:, 2].mean()), 99)
    part_of = np.where(from_centre < -edge, 0, np.where(from_centre > edge, 2, 1))
    layer = np.digitize(depths, EDGES) - 1
    result = {"total": float(np.sum(mean * weight) / np.sum(weight))}
    for index, part in enumerate(PARTS):
        inside = [(part_of == index) & (layer == n) for n in range(len(EDGES) - 1)]
        result[part] = tuple(np.array([values[here].mean() if here.any() else np.nan for here in inside])
                             for values in (mean, rms))
    return result


def depth_of(x, d):
    """From the highest grain's top within a mean diameter along the floor [m]."""
    from scipy.spatial import cKDTree

    top = x[:, 1] + d / 2
    near = cKDTree(x[:, [0, 2]]).query_ball_point(x[:, [0, 2]], d.mean())
    return np.array([top[neighbours].max() for neighbours in near]) - top
