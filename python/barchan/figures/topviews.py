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


def frame_window(frames):
    """(x0, x1, z0, z1) [m] around the grains of all frames, without the few far away."""
    low = np.min([np.percentile(g.x, 0.5, axis=0) for g in frames], axis=0)
    high = np.max([np.percentile(g.x, 98.0, axis=0) for g in frames], axis=0)
    side = np.max([np.percentile(g.x[:, 2], 99.5) for g in frames])
    margin = max(0.07 * (high[0] - low[0]), 3.0 * frames[0].d.max())
    return low[0] - margin, high[0] + 2 * margin, low[2] - margin, side + margin


def draw(run, ax=None):
    """`ax`: one for each time, in their order."""
    file = run.need_grains()
    counts = () if ax is None else ((np.size(ax),),)
    frames = [g for g in map(run.frame, file.evenly_spaced(*counts)) if len(g.d)]
    if not frames:
        raise MissingData("needs a frame with grains in it")
    bodies = bodies_of(run.config)
    window = body_pictures.in_window(frame_window(frames), run.config)
    top = max(np.percentile(g.x[:, 1] + 0.5 * g.d, 99.9) for g in frames)
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    columns = 2 if ax is None and len(frames) > 3 and len(frames) * ratio > 2.2 else 1
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
    colour_key(figure, grid, top, named.groups, named.kinds)
    return figure


def flow_arrow(axes):
    axes.annotate("", xy=(0.985, 0.9), xytext=(0.885, 0.9), xycoords="axes fraction",
                  arrowprops={"arrowstyle": "-|>", "color": style.BLACK, "lw": 1.0,
                              "shrinkA": 0, "shrinkB": 0, "path_effects": style.WHITE_EDGE})
    axes.text(0.87, 0.9, "flow", transform=axes.transAxes, ha="right", va="center", path_effects=style.WHITE_EDGE)


def colour_key(figure, grid, top, groups=(), kinds=()):
    """What the colours of `top_view` mean: kinds or heaps of these names, or heights up to `top` [m]."""
    if groups:
        colours = ListedColormap([style.GROUPS[n % len(style.GROUPS)] for n in range(len(groups))])
        scale = plt.cm.ScalarMappable(plt.Normalize(-0.5, len(groups) - 0.5), colours)
    else:
        scale = plt.cm.ScalarMappable(plt.Normalize(0, 1e3 * top), style.HEIGHT_MAP)
    bar = figure.colorbar(scale, ax=grid, location="bottom", shrink=0.5, aspect=35, pad=0.02)
    name = "kind of the grain" if kinds else "heap that a grain came from"
    bar.set_label(name if groups else "height above the wall (mm)")
    if groups:
        bar.set_ticks(range(len(groups)), labels=[plain(group) for group in groups])
        bar.ax.tick_params(length=0)
    bar.outline.set_linewidth(0.6)
