"""topviews: the grains seen from above at several times (as Figs. 4 to 6 of Lima et al. 2022).

The flow goes from left to right. The view is from above (y towards the reader), so z points down
the page and the left horn, at z < Cz, is the upper one.
"""

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.colors import ListedColormap

from barchan.dune.bodies import bodies_of
from barchan.dune.current import always_along_x
from barchan.errors import MissingData
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.grain_image import top_view
from barchan.io.study_folder import plain

FINER = 1.5  # pixels of the picture per pixel of the PNG, for the PDF
FULL_GRIDS = {8: 2, 6: 2, 9: 3, 4: 2}  # views: columns, none left empty
TALL = 1.5  # height over width of all views below each other: above it they are put in a grid
HEIGHT_PERCENTILE = 98.0  # of the grains ends the range of colours: neither suspended ones do, nor the first heap's tip


def frame_window(frames):
    """(x0, x1, z0, z1) [m] around the grains of all frames, without the few far away."""
    low = np.min([np.percentile(g.x, 0.5, axis=0) for g in frames], axis=0)
    high = np.max([np.percentile(g.x, 98.0, axis=0) for g in frames], axis=0)
    side = np.max([np.percentile(g.x[:, 2], 99.5) for g in frames])
    margin = max(0.07 * (high[0] - low[0]), 3.0 * frames[0].d.max())
    return low[0] - margin, high[0] + 2 * margin, low[2] - margin, side + margin


def frames_at(run, *counts):
    """Frames at even times, without those that have no grain."""
    frames = [g for g in map(run.frame, run.need_grains().evenly_spaced(*counts)) if len(g.d)]
    if not frames:
        raise MissingData("needs a frame with grains in it")
    return frames


def height_range(frames):
    """Height [m] at which the colours end."""
    later = frames[1:] or frames
    return max(np.percentile(g.x[:, 1] + 0.5 * g.d, HEIGHT_PERCENTILE) for g in later)


def shape_of(window):
    """Width over length of (x0, x1, z0, z1)."""
    return (window[3] - window[2]) / (window[1] - window[0])


def draw(run, ax=None):
    """`ax`: one for each time, in their order."""
    frames = frames_at(run, *(() if ax is None else ((np.size(ax),),)))
    columns = 1
    if ax is None and len(frames) > 3 and len(frames) * shape_of(frame_window(frames)) > TALL:
        frames = frames_at(run, tuple(FULL_GRIDS))
        columns = FULL_GRIDS.get(len(frames), 2)
    bodies = bodies_of(run)
    window = body_pictures.in_window(frame_window(frames), bodies)
    top, ratio = height_range(frames), shape_of(window)
    rows = np.size(ax) if ax is not None else -(-len(frames) // columns)
    panel_width = style.FULL_WIDTH / columns if columns > 1 else 5.2
    figure, grid = style.panels(
        ax, rows, columns, sharex=True, sharey=True, layout="compressed",
        figsize=(panel_width * columns, rows * (panel_width * ratio + 0.06) + 0.65))
    if ax is None:
        figure.get_layout_engine().set(w_pad=0.03, h_pad=0.02, hspace=0.01, wspace=0.01)
    panels = list(grid.ravel())  # time goes along the rows
    extent = [1e3 * window[0], 1e3 * window[1], 1e3 * window[3], 1e3 * window[2]]
    for axes, grains in zip(panels, frames):
        picture = top_view(grains, window, round(FINER * style.DPI * panel_width), top, bodies)
        axes.imshow(picture, extent=extent, aspect="equal", interpolation="antialiased")
        body_pictures.draw_plan(axes, bodies, named=grains is frames[0])
        axes.set(xticks=[], yticks=[], xlim=extent[:2], ylim=extent[2:])
        axes.text(0.012, 0.95, f"$t$ = {grains.time:.3g} s", transform=axes.transAxes, va="top",
                  path_effects=style.WHITE_EDGE)
    for axes in panels[len(frames):]:
        axes.set_visible(False)
    length = style.round_length(0.25e3 * (window[1] - window[0]))
    share = length / (1e3 * (window[1] - window[0]))
    style.scale_bar(panels[0], length, 0.985 - share, 0.06, edge=style.WHITE_EDGE)
    if always_along_x(run.config):
        flow_arrow(panels[0])
    named = max(frames, key=lambda grains: len(grains.groups))
    higher = any((g.x[:, 1] + 0.5 * g.d).max() > top for g in frames)
    colour_key(figure, grid, top, named.groups, named.kinds, "max" if higher else "neither")
    return figure


def flow_arrow(axes):
    axes.annotate("", xy=(0.985, 0.9), xytext=(0.885, 0.9), xycoords="axes fraction",
                  arrowprops={"arrowstyle": "-|>", "color": style.BLACK, "lw": 1.0,
                              "shrinkA": 0, "shrinkB": 0, "path_effects": style.WHITE_EDGE})
    axes.text(0.87, 0.9, "flow", transform=axes.transAxes, ha="right", va="center", path_effects=style.WHITE_EDGE)


def colour_key(figure, grid, top, groups=(), kinds=(), extend="neither"):
    """What the colours of `top_view` mean: kinds or heaps of these names, or heights up to `top` [m]; `extend`: "max"
    where grains are higher."""
    if groups:
        colours = ListedColormap([style.GROUPS[n % len(style.GROUPS)] for n in range(len(groups))])
        scale = plt.cm.ScalarMappable(plt.Normalize(-0.5, len(groups) - 0.5), colours)
    else:
        scale = plt.cm.ScalarMappable(plt.Normalize(0, 1e3 * top), style.HEIGHT_MAP)
    bar = figure.colorbar(scale, ax=grid, location="bottom", shrink=0.5, aspect=35, pad=0.02,
                          extend="neither" if groups else extend)
    name = "kind of the grain" if kinds else "heap that a grain came from"
    bar.set_label(name if groups else "height above the wall (mm)")
    if groups:
        bar.set_ticks(range(len(groups)), labels=[plain(group) for group in groups])
        bar.ax.tick_params(length=0)
    bar.outline.set_linewidth(0.6)
