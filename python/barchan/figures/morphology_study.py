"""morphology of a study: W, L, C_x, C_z of the main dune against time, a curve per value of one key.

As Figs. 7 (sliding friction), 8 (restitution) and 9 (rolling friction) of Lima et al. (2022). C_x is
drawn from its first value, C_z from the middle of the channel. A study that varies no single key has
two panels more: the height, and how many grains the dune holds. With several realisations of a case the
curve is their mean, the band their standard deviation, and the bars are the mean's 95 % interval.
"""

import matplotlib
import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.morphology import widen
from barchan.figures.result import keep_cases
from barchan.io.study_folder import BY_NAME
from barchan.stats import spread

PANELS = (("W", "width $W$ (mm)"), ("L", "length $L$ (mm)"),
          ("Cx", "centroid $C_x - C_x(0)$ (mm)"), ("Cz", "centroid $C_z - L_z/2$ (mm)"))
MORE_PANELS = (("H", "height $H$ (mm)"), ("n_grains", "grains of the dune"))
MARKERS = "osD^v<>ph"
MARKS = 10  # on the longest curve


def looks(count):
    """(colour, marker) of each curve: darker to lighter as the value grows, lightest still legible."""
    shades = np.linspace(0.0, 0.86, count) if count > 1 else [0.3]
    return [(matplotlib.colormaps["viridis"](shade), MARKERS[i % len(MARKERS)])
            for i, shade in enumerate(shades)]


def main_dune(run):
    """Columns of dune.csv of the first main dune, Cx and Cz as they are drawn."""
    dune = dict(run.main_dune_columns)
    dune["Cx"] = dune["Cx"] - dune["Cx"][0]
    dune["Cz"] = dune["Cz"] - (0.5 * run.domain[2] if run.domain else dune["Cz"][0])
    return dune


def mean_dune(case):
    """Columns of the mean over the realisations at the times that all have, each with its `_sd` and `_ci`."""
    dunes = [main_dune(run) for run in case.runs if run.dune_columns is not None]
    times = [np.round(dune["t"], 9) for dune in dunes]
    common = set.intersection(*(set(t) for t in times))
    rows = [np.isin(t, list(common)) for t in times]
    mean = {"t": dunes[0]["t"][rows[0]], "realisations": len(dunes)}
    for name in [name for name, _ in PANELS + MORE_PANELS]:
        values = np.array([dune[name][row] for dune, row in zip(dunes, rows)])
        spreads = [spread(list(column)) for column in values.T]
        for part, take in (("", "mean"), ("_sd", "deviation"), ("_ci", "interval")):
            mean[name + part] = np.array([getattr(one, take) for one in spreads])
    return mean


def draw(study, key, ax=None):
    cases = study.series(key, lambda run: run.dune_columns is not None)
    if not cases:
        raise MissingData("needs a case with dune.csv")
    dunes = [mean_dune(case) for case in cases]
    panels = PANELS + MORE_PANELS * (key == BY_NAME)
    figure, grid = style.panels(ax, len(panels) // 2, 2, sharex=True,
                                figsize=(style.FULL_WIDTH, 1.0 + 1.95 * (len(panels) // 2)))
    step = max(dune["t"][-1] - dune["t"][0] for dune in dunes) / MARKS
    for index, (axes, (name, label)) in enumerate(zip(grid.ravel(), panels)):
        for order, (dune, (colour, marker)) in enumerate(zip(dunes, looks(len(cases)))):
            scale = 1 if name == "n_grains" else 1e3
            every = marks(dune["t"], step, order / len(cases))
            axes.plot(dune["t"], scale * dune[name], color=colour, marker=marker, ms=4, lw=0.9,
                      mec=colour, mfc="white", mew=0.9, markevery=every, label=cases[order].label_in(key))
            if dune["realisations"] > 1:
                draw_spread(axes, dune["t"], *(scale * dune[name + part] for part in ("", "_sd", "_ci")),
                            colour, every)
        axes.set_ylabel(label)
        axes.margins(x=0.02)
        style.panel_label(axes, index)
        widen(axes, 0.4 if name == "Cz" else 0.0)
    for axes in grid[-1]:
        axes.set_xlabel("$t$ (s)")
    handles, _ = grid[0, 0].get_legend_handles_labels()
    columns = min(5, len(handles))
    style.legend_outside(figure, handles, 0.1 + 0.18 * -(-len(handles) // columns), ncols=columns)
    keep_curves(figure, study, key, cases, dunes)
    return figure


def draw_spread(axes, t, mean, deviation, interval, colour, every):
    axes.fill_between(t, mean - deviation, mean + deviation, color=colour, alpha=0.18, lw=0)
    at = slice(None) if every is None else every
    axes.errorbar(t[at], mean[at], interval[at], fmt="none", ecolor=colour, elinewidth=0.7, capsize=1.5)


def marks(t, step, share):
    """Indices of marks every `step` [s]; those of one curve lie between those of the others."""
    if len(t) <= MARKS + 2:
        return None
    wanted = np.arange(t[0] + (share + 0.1) * step, t[-1], step)
    return np.unique([int(np.argmin(abs(t - time))) for time in wanted]).astype(int).tolist()


def keep_curves(figure, study, key, cases, dunes):
    columns = {key: [[case.values[key]] * len(dune["t"]) for case, dune in zip(cases, dunes)]}
    for name, column in (("t", "t_s"), ("W", "W_m"), ("L", "L_m"), ("Cx", "Cx_from_start_m"),
                         ("Cz", "Cz_from_middle_m"), ("H", "H_m"), ("n_grains", "n_grains")):
        columns[column] = [dune[name] for dune in dunes]
        if name != "t" and any(dune["realisations"] > 1 for dune in dunes):
            columns[column + "_sd"] = [dune[name + "_sd"] for dune in dunes]
            columns[column + "_ci95"] = [dune[name + "_ci"] for dune in dunes]
    keep_cases(figure, f"morphology_{study.short(key)}", columns)
