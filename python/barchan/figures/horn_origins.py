"""horn_origins: which grains form the horns, and where they began (as Figs. 11, 12 of Lima et al. 2022).

(a) the grains that are in the horns at the chosen time, in red from the beginning, drawn over the
others; (b) paths of the grains that were in a horn up to then; (c), (d) where these began in the heap.
The view is from above, flow from left to right, left (z < Cz) up. What a horn is: horn_grains.py.
"""

from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure
from matplotlib.collections import LineCollection
from matplotlib.colors import ListedColormap, to_rgb
from matplotlib.ticker import MaxNLocator, PercentFormatter

from barchan.dune.horns import find_horns, follow
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.dune.sectors import SECTORS
from barchan.figures import style
from barchan.figures.result import keep
from barchan.figures.grain_image import coloured_view
from barchan.io.tables import thin

SNAPSHOTS = 5
MOST_PATHS, MOST_TIMES = 300, 120        # drawn
PHI_BIN, R_BIN = 15, 0.1                 # [degrees], [R]
PATH_MAP = ListedColormap(plt.get_cmap("plasma")(np.linspace(0, 0.9, 256)), "paths")  # without its yellow
RED, GREY = "#FF4A1C", "#CDCDCD"         # grains, before the shade
FINER = 1.5


def draw(run, ax=None, time=None):
    style.own_page(ax)
    horns, last = find_horns(run), tracks(run).index(time)
    ids = horns.ever(last)
    if len(ids) == 0:
        raise MissingData(f"needs a dune with horns: none is longer than 2.5 grain diameters up to "
                       f"t = {horns.t[last]:.3g} s")
    phi, r = (values[horns.heap.rows(ids)] for values in (horns.heap.phi, horns.heap.r))
    figure = Figure(figsize=(style.FULL_WIDTH, 5.3))
    top, bottom = figure.subfigures(2, 1, height_ratios=(1.3, 4.0))
    left, right = bottom.subfigures(1, 2, width_ratios=(4.4, 2.7))
    draw_snapshots(top, run, horns, last)
    keep(figure, "horn_paths", draw_paths(left, run, horns, ids, last), most=None)
    angles, radii = right.add_subplot(2, 1, 1, projection="polar"), right.add_subplot(2, 1, 2)
    keep(figure, "horn_origins_phi", draw_angles(angles, phi))
    keep(figure, "horn_origins_r", draw_radii(radii, r, horns.heap.r[horns.heap.own]))
    radii.set_title("(d)", loc="left", pad=3)
    angles.text(-0.42, 1.08, "(c)", transform=angles.transAxes)
    keep(figure, "horn_origins", table_of_grains(horns, ids, last), most=None)
    return figure


def table_of_grains(horns, ids, last):
    """One line per grain that was in a horn; side -1 left, +1 right, of the horn it first was in."""
    rows = horns.heap.rows(ids)
    ids = horns.heap.id[rows]
    first, latest, side = horns.visits(ids, last)
    return {
        "id": ids, "side": side, "phi_deg": horns.heap.phi[rows], "r_over_R": horns.heap.r[rows],
        "first_t": horns.t[first], "latest_t": horns.t[latest],
        "in_horn_at_end": np.isin(ids, horns.ids[last])}


def draw_snapshots(figure, run, horns, last):
    source = tracks(run)
    wanted = np.linspace(horns.t[0], horns.t[last], SNAPSHOTS)
    frames = sorted({int(np.argmin(abs(horns.t - t))) for t in wanted} | {last})
    frames = [frame for frame in frames if np.isfinite(horns.centroid[frame]).all()]
    views = []
    for frame in frames:
        grains = source.read(frame)
        grains.x = source.bed.nearest(grains.x - horns.centroid[frame] * (1, 0, 1))
        views.append(grains)
    window = common_window(views, horns.heap.R)
    panels = figure.subplots(1, len(frames), squeeze=False)[0]
    extent = [1e3 * window[i] for i in (0, 1, 3, 2)]
    for axes, grains in zip(panels, views):
        axes.imshow(picture(grains, horns.ids[last], window, style.FULL_WIDTH / len(frames)),
                    extent=extent, interpolation="antialiased")
        axes.set(xticks=[], yticks=[])
        axes.set_title(f"$t$ = {grains.time:.3g} s", pad=3)
        for side in axes.spines.values():
            side.set_visible(False)
    style.panel_label(panels[0], 0)
    length = style.round_length(0.5e3 * horns.heap.R * 2)
    style.scale_bar(panels[0], length, 0.03, 0.04)
    style.flow_arrow(panels[0], 0.03, 0.94)


def common_window(views, R):
    """(x0, x1, z0, z1) [m] about the dune's centroid, without the grains far away."""
    near = [g.x[np.hypot(g.x[:, 0], g.x[:, 2]) < 3 * R] for g in views]
    low = np.min([np.percentile(x, 0.5, axis=0) for x in near], axis=0) - 0.2 * R
    high = np.max([np.percentile(x, 99.5, axis=0) for x in near], axis=0) + 0.2 * R
    side = max(-low[2], high[2])
    return low[0], high[0], -side, side


def picture(grains, red, window, inches):
    """The grains in grey, those with the ids `red` over them as if the others were transparent."""
    chosen = np.isin(grains.id, red)
    colours = np.where(chosen[:, None], to_rgb(RED), to_rgb(GREY))
    lifted = grains.x + np.where(chosen, grains.x[:, 1].max(), 0.0)[:, None] * (0, 1, 0)
    return coloured_view(replace(grains, x=lifted), colours, window, round(FINER * style.DPI * inches))


def draw_paths(figure, run, horns, ids, last):
    shown = ids[thin(len(ids), MOST_PATHS)]
    frames = thin(last + 1, MOST_TIMES)
    paths = follow(run, shown, frames) / horns.heap.R
    moved = np.hypot(*(horns.centroid[frames] - horns.centroid[0])[:, [0, 2]].T) / horns.heap.R
    _, latest, _ = horns.visits(shown, last)
    paths[frames[:, None] > latest[None, :]] = np.nan
    axes = figure.add_subplot()
    segments = np.stack([paths[:-1, :, [0, 2]], paths[1:, :, [0, 2]]], axis=2).reshape(-1, 2, 2)
    colour = np.repeat(0.5 * (moved[1:] + moved[:-1]), len(shown))
    kept = np.isfinite(segments).all(axis=(1, 2)) & np.isfinite(colour)
    lines = LineCollection(segments[kept], array=colour[kept], cmap=PATH_MAP, linewidths=0.45, alpha=0.8,
                           capstyle="round", rasterized=True)
    lines.set_clim(0.0, np.nanmax(moved))
    axes.add_collection(lines)
    axes.add_patch(plt.Circle((0, 0), 1.0, fill=False, color=style.BLACK, lw=0.9))
    xs, zs = paths[..., 0], paths[..., 2]
    reach = 1.08 * max(1.05, np.nanpercentile(abs(zs), 99.8))
    axes.set(aspect="equal", xlim=(-1.15, max(1.15, np.nanpercentile(xs, 99.8) + 0.15)),
             ylim=(reach, -reach), xlabel="$(x - x_0)/R$", ylabel="$(z - z_0)/R$")
    bar = figure.colorbar(lines, ax=axes, location="bottom", shrink=0.8, aspect=35, pad=0.02)
    bar.solids.set_alpha(1.0)
    bar.set_label("displacement of the dune $(r_c - r_0)/R$")
    bar.outline.set_linewidth(0.6)
    style.panel_label(axes, 1)
    few = f"{len(shown)} of {len(ids)} grains" if len(shown) < len(ids) else f"{len(ids)} grains"
    axes.set_title(few, loc="right", pad=3, fontsize=7.5)
    style.flow_arrow(axes, 0.03, 0.06)
    return table_of_paths(horns.t[frames], shown, paths, moved)


def table_of_paths(t, ids, paths, moved):
    known = np.isfinite(paths).all(axis=2).T
    grain, time = np.nonzero(known)
    place = paths[time, grain]
    return {"id": ids[grain], "t": t[time], "x_over_R": place[:, 0], "z_over_R": place[:, 2],
            "dune_displacement_over_R": moved[time]}


def draw_angles(axes, phi):
    edges = np.arange(0, 360 + PHI_BIN, PHI_BIN)
    share = np.histogram(phi, edges)[0] / len(phi)
    middle = np.radians(edges[:-1] + 0.5 * PHI_BIN)
    top = 1.15 * share.max()
    for low, high in SECTORS:
        axes.bar(np.radians(0.5 * (low + high)), top, np.radians(high - low), color="0.86", lw=0)
    axes.bar(middle, share, np.radians(PHI_BIN), color=style.BLUE, ec="white", lw=0.4)
    axes.plot(np.linspace(0, 2 * np.pi, 200), np.full(200, PHI_BIN / 360), color=style.VERMILLION,
              lw=0.9, ls=(0, (4, 1.5)))
    axes.set_ylim(0, top)
    axes.set_xticks(np.radians(np.arange(0, 360, 30)))
    axes.set_rlabel_position(345)
    axes.yaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10], prune="lower"))
    axes.yaxis.set_major_formatter(PercentFormatter(1.0, decimals=0, symbol=" %"))
    axes.tick_params(labelsize=7, pad=-1)
    axes.grid(lw=0.4, color="0.75")
    axes.set_axisbelow(True)
    axes.legend(loc="upper left", bbox_to_anchor=(-0.48, -0.02), fontsize=7, handles=[
        plt.Line2D([], [], color=style.VERMILLION, lw=0.9, ls=(0, (4, 1.5)), label="uniform")])
    style.flow_arrow(axes, -0.42, 0.02)
    return {"phi_min_deg": edges[:-1], "phi_max_deg": edges[1:], "share": share,
                                          "uniform": np.full(len(share), PHI_BIN / 360)}


def smooth_density(r, at):
    """Probability density of r >= 0 at `at` (evenly spaced from 0): Gaussian kernels, reflected at 0."""
    step = at[1] - at[0]
    width = max(1.06 * r.std() * len(r) ** -0.2, step)
    counts = np.bincount(np.round(r / step).astype(int), minlength=len(at))[:len(at)] / len(r) / step
    kernel = sum(np.exp(-0.5 * ((at[:, None] + image * at) / width) ** 2) for image in (-1, 1))
    return kernel @ counts * step / (width * np.sqrt(2 * np.pi))


def draw_radii(axes, r, heap):
    edges = np.arange(0, max(1.2, np.percentile(r, 99.5)) + R_BIN, R_BIN)
    count = np.histogram(r, edges)[0]
    axes.bar(edges[:-1], count, R_BIN, align="edge", color=style.SKY, ec="white", lw=0.4, alpha=0.6)
    axes.set(xlabel="initial $r/R$", ylabel="number of grains", xlim=(0, edges[-1]))
    density = axes.twinx()
    at = np.linspace(0, edges[-1], 241)
    ours, all_grains = smooth_density(r, at), smooth_density(heap, at)
    density.plot(at, ours, color=style.BLUE, label="to the horns")
    density.plot(at, all_grains, color=style.BLACK, lw=0.9, ls=(0, (4, 1.5)), label="whole heap")
    top = 1.5 * max(ours.max(), all_grains.max(), count.max() / (len(r) * R_BIN))
    density.set(ylim=(0, top), ylabel="PDF")
    axes.set_ylim(0, top * len(r) * R_BIN)  # the bars are the same density on the other scale
    axes.tick_params(right=False)
    density.legend(loc="upper left", handlelength=1.8)
    return {"r_min_over_R": edges[:-1], "r_max_over_R": edges[1:], "n": count,
                                        "pdf": count / (len(r) * R_BIN)}
