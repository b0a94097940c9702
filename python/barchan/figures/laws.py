"""laws of a study: celerity, width, height, horns, loss and formation time of dunes against their length, with fits.

Every run is a point: its main dune over the second half of its time, or from --from to --to. Definitions and the
errors of the fits: docs/studies.md, "Laws". Asked for by its name it says the laws in words, too.
"""

import numpy as np

from barchan.dune.laws import fit, measure, sentences
from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.morphology_study import looks
from barchan.figures.result import keep_cases, say
from barchan.stats import spread

# name: (axis, factor to its unit, law): a power of L, or linear in L.
QUANTITIES = {
    "celerity": ("celerity $c$ (mm/s)", 1e3, "power"),
    "W": ("width $W$ (mm)", 1e3, "line"),
    "H": ("height $H$ (mm)", 1e3, "line"),
    "horn": ("horn length (mm)", 1e3, "line"),
    "loss": ("loss (% of the grains / s)", 1e2, "power"),
    "formation_time": ("formation time (s)", 1.0, "power"),
}


def draw(study, ax=None, start=None, end=None):
    table = measure(study, start, end)
    if len(set(table["case"])) < 2:
        raise MissingData("needs two cases with dunes in dune.csv")
    laws = {name: fit(table["L"], table[name], kind) for name, (_, _, kind) in QUANTITIES.items()}
    figure, panels = style.panels(ax, 2, 3, figsize=(style.FULL_WIDTH, 4.4))
    say(figure, sentences(laws))
    keep_cases(figure, "laws", {name: [list(column)] for name, column in table.items()})
    for index, (axes, name) in enumerate(zip(panels.ravel(), QUANTITIES)):
        draw_quantity(axes, table, name, laws[name])
        style.panel_label(axes, index)
    return figure


def draw_quantity(axes, table, name, law):
    label, factor, kind = QUANTITIES[name]
    cases = list(dict.fromkeys(table["case"].tolist()))
    for case, (colour, marker) in zip(cases, looks(len(cases))):
        rows = table["case"] == case
        length, values = 1e3 * table["L"][rows], factor * table[name][rows]
        axes.plot(length, values, ls="", marker=marker, ms=3, mec=colour, mfc="white", mew=0.7)
        if np.count_nonzero(np.isfinite(values)) > 1:
            x, y = spread(length.tolist()), spread(values[np.isfinite(values)].tolist())
            axes.errorbar(x.mean, y.mean, y.interval, x.interval, fmt="none", ecolor=colour, elinewidth=0.9, capsize=2)
    if law:
        length = np.linspace(table["L"].min(), table["L"].max(), 50)
        text = f"$L^{{{law.n:.2f} \\pm {law.interval:.2f}}}$" if kind == "power" else \
            f"slope {law.n:.2f} $\\pm$ {law.interval:.2f}"
        axes.plot(1e3 * length, factor * law(length), color=style.BLACK, lw=0.9, ls=(0, (4, 1.5)), label=text)
        axes.legend(loc="best")
    if kind == "power" and (factor * table[name][np.isfinite(table[name])] > 0).any():
        axes.set(xscale="log", yscale="log")
    axes.set(xlabel="length $L$ (mm)", ylabel=label)
