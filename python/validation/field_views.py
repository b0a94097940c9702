"""The cases from the literature from above, three times of the first realisation of each, cropped: the picture on the
examples page. Colours: kind or heap of a grain where there are several, else its height.
"""

from matplotlib.figure import Figure

from barchan.dune.bodies import bodies_of
from barchan.dune.shape import main_rows
from barchan.errors import MissingData
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.grain_image import top_view
from barchan.figures.topviews import FINER, frame_window, height_range
from barchan.figures.topviews_study import common_window
from barchan.io.study_folder import gap_of

# Times [s] of the views.
TIMES = {
    "turn-slow": (2.9, 5.9, 9), "turn-fast": (0.9, 2.9, 4.5), "reversal": (2.9, 6, 10),
    "two-densities": (0, 3, 6), "two-ridges": (0, 8, 16), "two-heaps": (0, 4, 8),
    "encounters-1000-in-line": (0, 4, 8), "encounters-1600-beside": (0, 4, 8),
    "barchan-meets-cylinder": (2, 5, 9), "barchan-meets-dune": (2, 9, 18), "barchan-meets-crater": (0, 3.5, 7),
    "barchan-on-shot": (0, 3.5, 7),
    "sizes-8k": (0, 3, 6), "fed-dune": (2, 4, 6),
}
COLUMNS = 3
TALLEST = 0.55  # width over length of a view
GAP, HEAD = 0.03, 0.18  # [in] between views; above a row, for its title


def rows_of(study):
    """(name, frames, window, bodies) of each case that is done."""
    for case in study.cases:
        if case.name not in TIMES or case.run is None or gap_of(case.run.path):
            continue
        known = case.run.grain_file.times
        frames = [case.run.frame(int(abs(known - time).argmin())) for time in TIMES[case.name]]
        dunes = [frame for frame in frames if len(main_rows(frame))]
        window = (common_window(dunes) if dunes and frames[0].group is None
                  else frame_window([frame for frame in frames if len(frame.d)]))
        bodies = bodies_of(case.run)
        yield case.name, frames, flat(body_pictures.in_window(window, bodies)), bodies


def flat(window):
    """The window (x0, x1, z0, z1) [m], longer where it is too wide for its length."""
    x0, x1, z0, z1 = window
    more = max(0.0, (z1 - z0) / TALLEST - (x1 - x0))
    return x0 - more / 2, x1 + more / 2, z0, z1


def draw(study):
    rows = list(rows_of(study))
    if not rows:
        raise MissingData("needs a finished run of configs/field/all.toml")
    width = (style.FULL_WIDTH - (COLUMNS - 1) * GAP) / COLUMNS
    heights = [width * (window[3] - window[2]) / (window[1] - window[0]) for _, _, window, _ in rows]
    total = sum(heights) + len(rows) * HEAD
    figure = Figure(figsize=(style.FULL_WIDTH, total), layout="none")
    top = total
    for (name, frames, window, bodies), height in zip(rows, heights):
        top -= HEAD
        figure.text(0.0, (top + 0.03) / total, name.removeprefix("encounters-"), va="bottom", weight="bold")
        for column, grains in enumerate(frames):
            left = column * (width + GAP)
            axes = figure.add_axes((left / style.FULL_WIDTH, (top - height) / total, width / style.FULL_WIDTH,
                                    height / total))
            show(axes, grains, window, height_range(frames), bodies, round(FINER * style.DPI * width))
            if column == 0:
                length = style.round_length(0.25e3 * (window[1] - window[0]))
                style.scale_bar(axes, length, 0.97 - length / (1e3 * (window[1] - window[0])), 0.08,
                                edge=style.WHITE_EDGE)
        top -= height
    return figure


def show(axes, grains, window, top, bodies, pixels):
    extent = [1e3 * window[0], 1e3 * window[1], 1e3 * window[3], 1e3 * window[2]]
    axes.imshow(top_view(grains, window, pixels, top, bodies), extent=extent, aspect="auto",
                interpolation="antialiased")
    body_pictures.draw_plan(axes, bodies, named=False)
    axes.set(xticks=[], yticks=[], xlim=extent[:2], ylim=extent[2:])
    axes.text(0.02, 0.95, f"{grains.time:.3g} s", transform=axes.transAxes, va="top", path_effects=style.WHITE_EDGE)
