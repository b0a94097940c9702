"""laws of a study: dunes against their length, height and flow, and the flux over the crest against phi c H, with fits.

Every run is a point: its main dune over the second half of its time, or from --from to --to. Crosses: means of the
cases and their 95 % intervals. Dashed: fits, with the standard error of n. Dotted: the published n, through the middle
of the fit. Definitions: docs/studies.md, "Laws". Asked for by its name it says the laws in words, too.
"""

import numpy as np
from matplotlib.ticker import LogFormatter

from barchan.dune.laws import RELATIONS, measure, need_two_cases, sentences, verdict
from barchan.figures import style
from barchan.figures.morphology_study import looks
from barchan.figures.result import keep, keep_cases, say
from barchan.stats import spread

# column: (axis, factor to its unit)
AXES = {
    "L": ("length $L$ (mm)", 1e3), "W": ("width $W$ (mm)", 1e3), "H": ("height $H$ (mm)", 1e3),
    "horn": ("horn length (mm)", 1e3), "celerity": ("celerity $c$ (mm/s)", 1e3),
    "celerity_L": ("$c\\,L$ (mm$^2$/s)", 1e6), "u_star": ("friction velocity $u_*$ (mm/s)", 1e3),
    "loss": ("loss (% of the grains / s)", 1e2), "formation_time": ("formation time (s)", 1.0),
    "crest_flux": ("flux over the crest (mm$^2$/s)", 1e6), "phi_c_H": ("$\\phi\\, c\\, H$ (mm$^2$/s)", 1e6),
}


def draw(study, ax=None, start=None, end=None):
    table = measure(study, start, end)
    need_two_cases(table)
    laws = {name: relation.fit(table) for name, relation in RELATIONS.items()}
    figure, panels = style.panels(ax, 3, 3, figsize=(style.FULL_WIDTH, 6.4))
    say(figure, sentences(table, laws))
    keep_cases(figure, "laws", {name: [list(column)] for name, column in table.items()})
    keep(figure, "laws_fits", fits(laws))
    for index, (axes, name) in enumerate(zip(panels.ravel(), RELATIONS)):
        draw_law(axes, table, RELATIONS[name], laws[name])
        style.panel_label(axes, index)
    return figure


def draw_law(axes, table, relation, law):
    (x_label, x_factor), (y_label, y_factor) = AXES[relation.x], AXES[relation.y]
    x, y = x_factor * table[relation.x], y_factor * table[relation.y]
    draw_runs(axes, table["case"], x, y)
    axes.set(xlabel=x_label, ylabel=y_label)
    if relation.kind == "power" and ((x > 0) & (y > 0)).any():
        axes.set(xscale="log", yscale="log")
        for axis in (axes.xaxis, axes.yaxis):
            axis.set_major_formatter(LogFormatter())
            axis.set_minor_formatter(LogFormatter(minor_thresholds=(2, 0.5)))
    if law is None:
        axes.text(0.5, 0.95, "no fit", transform=axes.transAxes, ha="center", va="top", color=style.GREY)
        return
    groups = np.unique(table[relation.among]) if len(law.centres) > 1 else [None]
    for index, group in enumerate(groups):
        inside = table[relation.x] if group is None else table[relation.x][table[relation.among] == group]
        line = np.linspace(0 if relation.kind == "ratio" else np.nanmin(inside), np.nanmax(inside), 50)
        draw_lines(axes, line, x_factor, y_factor, relation, law, index)
    axes.legend(loc="best")


def draw_runs(axes, names, x, y):
    """Open symbols, and the mean of each case with its interval."""
    cases = list(dict.fromkeys(names.tolist()))
    for case, (colour, marker) in zip(cases, looks(len(cases))):
        rows = (names == case) & np.isfinite(x) & np.isfinite(y)
        axes.plot(x[rows], y[rows], ls="", marker=marker, ms=3, mec=colour, mfc="white", mew=0.7)
        if np.count_nonzero(rows) > 1:
            across, up = spread(x[rows].tolist()), spread(y[rows].tolist())
            axes.errorbar(across.mean, up.mean, up.interval, across.interval, fmt="none", ecolor=colour, elinewidth=0.9,
                          capsize=2)


def draw_lines(axes, x, x_factor, y_factor, relation, law, group):
    """The fit and the published n; only the lines of the first group are named."""
    named = group == 0
    axes.plot(x_factor * x, y_factor * law(x, group=group), color=style.BLACK, lw=0.9, ls=(0, (4, 1.5)),
              label=f"n = {law.n:.2f} $\\pm$ {law.error:.2f}" if named else None)
    if relation.published:
        low, high = (y_factor * law(x, n, group) for n in relation.published)
        text = " to ".join(f"{n:g}" for n in dict.fromkeys(relation.published))
        axes.fill_between(x_factor * x, low, high, color=style.VERMILLION, alpha=0.25, lw=0)
        axes.plot(x_factor * x, low, color=style.VERMILLION, lw=0.9, ls=":",
                  label=f"published {text}" if named else None)


def fits(laws):
    """Columns of figures_data/laws_fits.csv: a line for each law."""
    rows = [(name, relation.y, relation.x, relation.kind, law.n, law.error, law.interval, law.runs,
             *(relation.published or (np.nan, np.nan)), relation.source, verdict(law, relation))
            for name, law in laws.items() if law for relation in [RELATIONS[name]]]
    names = ("law", "y", "x", "kind", "n", "standard_error", "ci95", "runs", "published_low", "published_high",
             "source", "verdict")
    return {name: [row[column] for row in rows] for column, name in enumerate(names)}
