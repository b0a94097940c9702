"""flow_around_body: mean velocity and streamlines in the vertical plane through each body, and its separation bubble.

Colour: mean streamwise velocity of the cells, of flow_average.h5, or of the frames of fields.h5 (second half of the
run, or --from, --to). Bodies are grey, cells in grains have the colour of sand. The red line is u = 0. The triangle
marks the reattachment point x_r, where u in the lowest row of water is forward again; a dot marks it at half the height
of a body with water below it.
"""

import numpy as np
from matplotlib.colors import ListedColormap

from barchan.dune.bodies import bodies_of
from barchan.dune.body_forces import need_bodies
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.result import keep, say
from barchan.flow.around_body import bubble, in_waves, mean_plane, sentence, time
from barchan.io.study_folder import plain

MOST = 4                     # bodies that are drawn
BEFORE, AFTER = 2.5, 7.0     # sizes of the body before and behind its middle
STEEPEST = 1.5               # height over length of a panel
LINES = 160                  # points of the lattice for streamlines along x


def draw(run, ax=None, start=None, end=None):
    bodies = need_bodies(run, "fields.h5 or flow_average.h5")
    planes = [mean_plane(run, body, start, end) for body in bodies]
    found = [bubble(plane) for plane in planes]
    shown = list(zip(planes, found))[:MOST]
    views = [view(plane, one) for plane, one in shown]
    ratios = [(y1 - y0) / (x1 - x0) for x0, x1, y0, y1 in views]
    figure, grid = style.panels(ax, len(shown), 1, height_ratios=ratios,
                                figsize=(style.FULL_WIDTH, 0.9 + 0.4 * len(shown) + 6.2 * sum(ratios)))
    u = np.concatenate([plane.u[plane.water] for plane, _ in shown])
    limits = min(float(u.min()), 0.0), float(u.max())
    for index, (axes, (plane, one), window) in enumerate(zip(grid[:, 0], shown, views)):
        image = draw_plane(axes, run, plane, one, window, limits)
        style.panel_label(axes, index)
        axes.set_title(title(plane, one), pad=3)
        axes.set_ylabel("$y$ (mm)")
    grid[-1, 0].set_xlabel("$x$ from the middle of the body (mm)")
    bar = figure.colorbar(image, ax=list(grid[:, 0]), location="bottom", shrink=0.45, aspect=35, pad=0.02)
    bar.set_label("mean streamwise velocity $u$ (m/s)")
    bar.outline.set_linewidth(0.6)
    say(figure, [sentence(plane, one) for plane, one in zip(planes, found)])
    keep_table(figure, planes, found)
    return figure


def title(plane, found):
    size, unit = plane.body.unit
    if plane.body.shape == "wave" and np.isfinite(found.x_r):
        return f"{plain(plane.body.name)}: {in_waves(plane, found)},  {time(plane)}"
    length = (f"bubble of {found.length / size:.2f} ${unit}$" if np.isfinite(found.length) else
              "reversed to the end" if np.isfinite(found.height) else "no reversed flow")
    return f"{plain(plane.body.name)}: {length},  {time(plane)}"


def view(plane, found):
    """(x0, x1, y0, y1) [m] about the body and its bubble."""
    size = plane.body.unit[0]
    ends = plane.body.reach[0] - plane.body.heart[0], plane.body.reach[1] - plane.body.heart[0]
    if plane.body.shape == "wave":
        ends = 0.0, plane.body.wavelength
    reached = found.x_r if np.isfinite(found.x_r) else 0.0
    x0 = max(plane.x_face[0], ends[0] - BEFORE * size)
    x1 = min(plane.x_face[-1], max(ends[1] + AFTER * size, reached + 2 * size))
    top = min(plane.y_face[-1], max(1.8 * plane.body.top, 0.16 * (x1 - x0)))
    more = max(0.0, 0.5 * (top / STEEPEST - (x1 - x0)))  # on either side of a body that is thin and tall
    return max(plane.x_face[0], x0 - more), min(plane.x_face[-1], x1 + more), 0.0, top


def draw_plane(axes, run, plane, found, window, limits):
    axes.set(xlim=1e3 * np.array(window[:2]), ylim=1e3 * np.array(window[2:]), aspect="equal")
    u = np.where(plane.solid, np.nan, plane.u)
    image = axes.pcolormesh(1e3 * plane.x_face, 1e3 * plane.y_face, u, vmin=limits[0], vmax=limits[1],
                            cmap=style.VELOCITY_MAP, rasterized=True)
    draw_streamlines(axes, plane, window)
    if plane.bed.any():
        bed = np.ma.masked_where(~plane.bed, np.ones_like(plane.u))
        axes.pcolormesh(1e3 * plane.x_face, 1e3 * plane.y_face, bed, cmap=ListedColormap([style.SAND]),
                        rasterized=True, zorder=2.4)
    seen = np.ma.masked_where(~plane.water, plane.u)
    if np.isfinite(found.height):
        axes.contour(1e3 * plane.x, 1e3 * plane.y, seen, [0.0], colors=style.VERMILLION, linewidths=1.2, zorder=2.5)
    body_pictures.draw_section(axes, bodies_of(run), plane.z, shift=-plane.body.heart[0])
    if np.isfinite(found.x_r):
        mark_reattachment(axes, plane, found)
    return image


def mark_reattachment(axes, plane, found):
    y, mark = plane.body.middle, "o"
    if found.row == "floor":
        at = int(np.argmin(abs(plane.x - found.x_r)))
        y, mark = plane.y_face[np.argmax(plane.water[:, at])], "^"
    axes.plot(1e3 * found.x_r, 1e3 * y, mark, color=style.VERMILLION, mec=style.BLACK, mew=0.5, ms=7, clip_on=False,
              zorder=5)
    axes.annotate("$x_r$", (1e3 * found.x_r, 1e3 * y), xytext=(6, 6), textcoords="offset points", color="white",
                  zorder=5)


def draw_streamlines(axes, plane, window):
    """On an even lattice; none in bodies and grains."""
    x = np.linspace(window[0], window[1], LINES)
    y = np.linspace(0, window[3], int(np.clip(LINES * window[3] / (window[1] - window[0]), 24, 5 * LINES)))
    rows = np.clip(np.searchsorted(plane.y_face, y) - 1, 0, len(plane.y) - 1)
    columns = np.clip(np.searchsorted(plane.x_face, x) - 1, 0, len(plane.x) - 1)
    blocked = ~plane.water[np.ix_(rows, columns)]
    u, v = (np.ma.masked_where(blocked, interpolated(plane, values, x, y)) for values in (plane.u, plane.v))
    axes.streamplot(1e3 * x, 1e3 * y, u, v, color="white", density=(1.6, 0.9), linewidth=0.5, arrowsize=0.6)
    axes.set(xlim=1e3 * np.array(window[:2]), ylim=1e3 * np.array(window[2:]))


def interpolated(plane, values, x, y):
    """Values (ny, nx) of the cells at the places x (m), y (n): (n, m), linearly."""
    along = np.array([np.interp(x, plane.x, row) for row in values])
    return np.array([np.interp(y, plane.y, column) for column in along.T]).T


def keep_table(figure, planes, found):
    """flow_around_body: a line for each body, lengths from its middle [m]."""
    keep(figure, "flow_around_body", {
        "body": [plane.body.number for plane in planes], "name": [plane.body.name for plane in planes],
        "z": [plane.z for plane in planes], "t_start": [plane.start for plane in planes],
        "t_end": [plane.end for plane in planes], "samples": [plane.frames for plane in planes],
        "row": [one.row for one in found], "x_lee": [one.x_lee for one in found], "x_s": [one.x_s for one in found],
        "x_r": [one.x_r for one in found],
        "bubble_height": [one.height for one in found], "size": [plane.body.unit[0] for plane in planes],
        "length_over_size": [one.length / plane.body.unit[0] for plane, one in zip(planes, found)]})
