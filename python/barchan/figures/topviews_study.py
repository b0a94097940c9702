"""topviews of a study: snapshots from above, a row per time, a column per value of one key.

As Figs. 4 (sliding friction), 5 (restitution) and 6 (rolling friction) of Lima et al. (2022): times
from 0 to 20 s in steps of 2 s; shorter runs have shorter steps. All panels show the same window, so
that the dunes can be seen to move. Flow from left to right, z down the page.
"""

import textwrap
from dataclasses import replace

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.figure import Figure

from barchan.dune.bodies import bodies_of
from barchan.dune.shape import main_rows
from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.grain_image import top_view
from barchan.figures.result import keep_cases
from barchan.figures.topviews import FINER

END, STEP = 20.0, 2.0  # [s], of the paper
ROWS = 11              # at most
LEFT, HEAD, FOOT, GAP = 0.42, 0.46, 0.56, 0.035  # [in]: times, scale and values, colour bar, panels
LINE, LETTER, SMALLEST = 0.12, 0.62, 7.0  # a line of a label [in]; a letter in sizes of it, the smallest size [pt]
BAR, PAGE = 2.4, 9.0   # [in], length of the colour bar, most height of the figure


def row_times(last):
    """Times of the rows [s] for runs that end at `last`."""
    if last >= END:
        return np.arange(0.0, END + 0.5 * STEP, STEP)
    if last <= 0.0:
        return np.zeros(1)
    tidy = (m * 10.0**n for n in range(-6, 3) for m in (1.0, 2.0, 5.0))
    step = next(step for step in tidy if last / step <= ROWS - 1 + 1e-6)
    return step * np.arange(int(last / step + 1e-6) + 1)


def frames_of(run, times):
    """Index of the frame nearest to each time, None where none is near."""
    known = run.grain_file.times
    near = [int(np.argmin(abs(known - time))) for time in times]
    reach = 0.3 * (times[1] - times[0]) if len(times) > 1 else np.inf
    return [index if abs(known[index] - time) <= reach else None for index, time in zip(near, times)]


def common_window(frames):
    """(x0, x1, z0, z1) [m] around the main dunes of all frames; grains that are lost go out of it."""
    dunes = [grains.x[main_rows(grains)] for grains in frames]
    dunes = [x for x in dunes if len(x)] or [grains.x for grains in frames]
    boxes = [(*x.min(axis=0)[[0, 2]], *x.max(axis=0)[[0, 2]]) for x in dunes]
    low, high = np.min(boxes, axis=0)[:2], np.max(boxes, axis=0)[2:]
    margin = max(0.05 * (high[0] - low[0]), 3.0 * frames[0].d.max())
    return low[0] - margin, high[0] + 2 * margin, low[1] - margin, high[1] + margin


def times_shown(times, grid):
    """Without the rows for which no case has a frame."""
    rows = [i for i in range(len(times)) if any(column[i] is not None for column in grid)]
    return times[rows], [[column[i] for i in rows] for column in grid]


def draw(study, key, ax=None):
    style.own_page(ax)
    cases = study.series(key, lambda run: run.grain_file is not None)
    if not cases:
        raise MissingData("needs a case with grains.h5")
    times = row_times(max(case.run.grain_file.times[-1] for case in cases))
    grid = [[case.run.frame(index) if index is not None else None
             for index in frames_of(case.run, times)] for case in cases]
    grid = [[grains if grains is not None and len(grains.d) else None for grains in column]
            for column in grid]
    frames = [grains for column in grid for grains in column if grains is not None]
    if not frames:
        raise MissingData("needs a frame with grains in it")
    times, grid = times_shown(times, grid)
    figure = draw_grid(grid, common_window(frames), times,
                       [case.label_in(key) for case in cases], [bodies_of(case.run) for case in cases])
    keep_rows(figure, study, key, cases, times, grid)
    return figure


def draw_grid(grid, window, times, labels, bodies):
    """A page in inches: all panels are pictures in one frameless axes, as 99 axes would take minutes."""
    top = max(np.percentile(g.x[:, 1] + 0.5 * g.d, 99.9) for column in grid for g in column if g)
    ratio = (window[3] - window[2]) / (window[1] - window[0])
    column = (style.FULL_WIDTH - LEFT) / len(grid)
    labels = [broken(label, column) for label in labels]
    head = HEAD + LINE * (max(label.count("\n") for label in labels))
    width = min(column - GAP, 3.2, ((PAGE - head - FOOT) / len(times) - GAP) / ratio)
    height = width * ratio
    size = (max(LEFT + len(grid) * (width + GAP), 2.6), head + len(times) * (height + GAP) + FOOT)
    figure = Figure(figsize=size, layout="none")
    page = figure.add_axes([0, 0, 1, 1], xlim=(0, size[0]), ylim=(size[1], 0))
    page.set_axis_off()
    for i, time in enumerate(times):
        page.text(LEFT - 0.06, head + i * (height + GAP) + 0.5 * height, f"{time:.3g} s", ha="right",
                  va="center")
    longest = max(len(line) for label in labels for line in label.split("\n"))
    label_size = min(plt.rcParams["font.size"], 72 * (width + GAP) / (LETTER * longest))
    for j, column in enumerate(grid):
        x = LEFT + j * (width + GAP)
        page.text(x + 0.5 * width, head - 0.06, labels[j], ha="center", va="bottom", fontsize=label_size)
        for i, grains in enumerate(column):
            if grains is not None:  # else the case has not come so far
                picture = top_view(replace(grains, heap=None, kind=None), window, round(FINER * style.DPI * width), top,
                                   bodies[j])
                draw_panel(page, picture, x, head + i * (height + GAP), width, height)
    draw_scale(page, window, width)
    bar = figure.add_axes([0.5 - 0.5 * BAR / size[0], 0.36 / size[1], BAR / size[0], 0.08 / size[1]])
    scale = plt.cm.ScalarMappable(plt.Normalize(0, 1e3 * top), style.HEIGHT_MAP)
    figure.colorbar(scale, cax=bar, orientation="horizontal").outline.set_linewidth(0.6)
    bar.set_xlabel("height above the wall (mm)")
    return figure


def broken(label, width):
    """The label in lines that fit into so many inches in the smallest letters, broken at hyphens and spaces."""
    return "\n".join(textwrap.wrap(label, max(1, int(72 * width / (LETTER * SMALLEST))), break_long_words=False))


def draw_panel(page, picture, x, y, width, height):
    page.imshow(picture, extent=(x, x + width, y + height, y), aspect="auto",
                interpolation="antialiased")
    page.add_patch(plt.Rectangle((x, y), width, height, fill=False, lw=0.5, clip_on=False))


def draw_scale(page, window, width):
    """Over the first column: a bar of so many mm, and the direction of the flow."""
    page.set(xlim=(0, page.figure.get_figwidth()), ylim=(page.figure.get_figheight(), 0))
    length = style.round_length(0.4e3 * (window[1] - window[0]))
    share = 1e-3 * length / (window[1] - window[0])
    y = 0.20
    page.plot([LEFT, LEFT + share * width], [y, y], color=style.BLACK, lw=2, solid_capstyle="butt")
    page.text(LEFT, y - 0.05, f"{length:g} mm", fontsize=7.5)
    page.annotate("", xy=(LEFT + 1.2, y), xytext=(LEFT + 0.85, y), arrowprops={
        "arrowstyle": "-|>", "color": style.BLACK, "shrinkA": 0, "shrinkB": 0})
    page.text(LEFT + 0.85, y - 0.05, "flow", fontsize=7.5)


def keep_rows(figure, study, key, cases, times, grid):
    """A line per panel: the frame shown, its grains and the centroid of their volume [m]."""
    names = (key, "t_row_s", "t_frame_s", "n_grains", "x_mean_m", "z_mean_m")
    columns = {name: [[] for _ in cases] for name in names}
    for j, case in enumerate(cases):
        for time, grains in zip(times, grid[j]):
            if grains is None:
                continue
            x, _, z = np.average(grains.x, weights=grains.d**3, axis=0)
            values = (case.values[key], time, grains.time, len(grains.d), x, z)
            for name, value in zip(names, values):
                columns[name][j].append(value)
    keep_cases(figure, f"topviews_{study.short(key)}", columns)
