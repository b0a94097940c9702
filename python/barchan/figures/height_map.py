"""height_map: height of the bed surface h(x, z) at the start and at the end, and along the centreline.

h is the highest top of a grain (y + d/2) in bins of 2.5 mean diameters, as in the dune analytics of
the run; the contours and the profile show its mean over 3 x 3 bins. The profile is that of a strip
of 3 mean diameters to each side of the dashed line.
"""

import numpy as np
from matplotlib.ticker import MaxNLocator

from barchan.dune.bodies import bodies_of
from barchan.dune.height_map import HeightMap, centre_z, common_window
from barchan.dune.shape import BIN, HALF_WIDTH
from barchan.errors import MissingData
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.result import keep

CONTOURS = 6
PROFILE = 0.22     # height over width of the profile's panel


def draw(run, ax=None):
    file = run.need_grains()
    indices = [0] if len(file.frames) == 1 else [0, len(file.frames) - 1]
    frames = [g for g in map(run.frame, indices) if len(g.d)]
    if not frames:
        raise MissingData("needs a frame with grains in it")
    diameter = frames[0].d.mean()
    window = common_window(frames, BIN * diameter)
    maps = [HeightMap(g, window, BIN * diameter) for g in frames]
    top = 1e3 * max(m.smooth.max() for m in maps)
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    figure, grid = style.panels(
        ax, len(maps) + 1, sharex=True, layout="compressed",
        height_ratios=[ratio] * len(maps) + [PROFILE],
        figsize=(5.6, 4.6 * (ratio * len(maps) + PROFILE) + 0.5 + 0.2 * len(maps)))
    panels = grid[:, 0]
    step = style.round_length(1.5 * top / CONTOURS)
    for index, (axes, surface, grains) in enumerate(zip(panels, maps, frames)):
        image, lines = draw_map(axes, surface, top, step)
        body_pictures.draw_plan(axes, bodies_of(run), fill=True)
        style.panel_label(axes, index)
        axes.set_title(f"$t$ = {grains.time:.3g} s", pad=3)
        centreline = axes.axhline(1e3 * centre_z(grains), color=style.GREY, lw=0.9, ls=(0, (6, 4)),
                                  label="centreline")
    style.legend_above(panels[0], [centreline], handlelength=2.4)
    bar = figure.colorbar(image, ax=list(panels[:-1]), aspect=18 * len(maps), pad=0.015)
    bar.add_lines(lines)
    bar.set_label(f"surface height $h$ (mm)\ncontours every {step:g} mm")
    bar.outline.set_linewidth(0.6)
    keep(figure, "height_map", draw_profiles(panels[-1], maps, frames, diameter))
    panels[-1].set_box_aspect(PROFILE)
    style.panel_label(panels[-1], len(maps))
    return figure


def draw_map(axes, surface, top, step):
    image = axes.pcolormesh(1e3 * surface.x, 1e3 * surface.z,
                            np.ma.masked_equal(1e3 * surface.h, 0).T, vmin=0, vmax=top,
                            cmap=style.HEIGHT_MAP, rasterized=True)
    lines = axes.contour(1e3 * surface.x_middle, 1e3 * surface.z_middle, 1e3 * surface.smooth.T,
                         np.arange(step, top, step), colors="white", linewidths=0.7)
    axes.set(aspect="equal", ylabel="$z$ (mm)",
             xlim=1e3 * surface.x[[0, -1]], ylim=1e3 * surface.z[[-1, 0]])
    axes.yaxis.set_major_locator(MaxNLocator(5, steps=[1, 2, 5, 10]))
    return image, lines


def draw_profiles(axes, maps, frames, diameter):
    """Returns what it draws."""
    columns = {}
    for surface, grains, colour in zip(maps, frames, (style.GREY, style.BLUE)):
        h = surface.profile(centre_z(grains), HALF_WIDTH * diameter)
        bare = h == 0.0
        bare[1:-1] &= bare[:-2] & bare[2:]  # the curve starts and ends at the wall
        axes.plot(1e3 * surface.x_middle, np.where(bare, np.nan, 1e3 * h), color=colour,
                  label=f"centreline, $t$ = {grains.time:.3g} s")
        columns["x_m"] = surface.x_middle
        columns[f"h_m_at_{grains.time:.6g}_s"] = h
    axes.set(xlabel="$x$ (mm)", ylabel="$h$ (mm)")
    axes.set_ylim(0, 1.1 * axes.get_ylim()[1])
    style.legend_above(axes, axes.get_lines())
    return columns
