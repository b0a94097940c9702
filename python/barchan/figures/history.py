"""history: flow rate, wall shear, time step, solver and energies against time.

The largest overlap of two grains is in per cent of their diameter.
"""

import numpy as np
from matplotlib.ticker import MaxNLocator

from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep
from barchan.stats import varies

# label, scale ("count": linear from zero), {column: legend}; a panel without data is left out
PANELS = (
    ("bulk velocity (m/s)", "linear", {"bulk_velocity": "along x", "bulk_velocity_z": "along z"}),
    ("$u_*$ (mm/s)", "linear", {"u_star": None}),
    ("kinetic energy (J)", "log", {"fluid_kinetic_energy": "fluid",
                                   "grain_kinetic_energy": "grains"}),
    ("CFL number", "linear", {"cfl": None}),
    ("continuity residual (1/s)", "log", {"continuity_residual": None}),
    ("pressure iterations", "count", {"pressure_iterations": None}),
    ("number", "linear", {"n_grains": "grains", "n_contacts": "contacts"}),
    ("largest overlap (%)", "linear", {"max_overlap": None}),
)
FACTORS = {"u_star": 1e3, "max_overlap": 100.0}


def has_data(history, column):
    values = history.get(column)
    return values is not None and bool(np.any(np.isfinite(values) & (values != 0.0)))


def draw(run, ax=None):
    history = run.history_columns
    if history is None:
        raise MissingData("needs history.csv with at least one line")
    panels = [(label, scale, {c: text for c, text in columns.items() if has_data(history, c)})
              for label, scale, columns in PANELS]
    panels = [panel for panel in panels if panel[2]]
    if not panels:
        raise MissingData("needs a history.csv whose values are not all zero")
    panels = [panel for panel in panels if any(varies(history[column]) for column in panel[2])] or panels
    columns = 3 if len(panels) % 3 == 0 else min(2, len(panels))
    rows = -(-len(panels) // columns)
    figure, grid = style.panels(ax, rows, columns, sharex=True,
                                figsize=(style.FULL_WIDTH, 0.3 + 1.75 * rows))
    for index, axes in enumerate(grid.ravel()):
        if index >= len(panels):
            axes.set_visible(False)
            continue
        draw_panel(axes, history, *panels[index])
        style.panel_label(axes, index)
        if index + columns >= len(panels):
            axes.set_xlabel("$t$ (s)")
            axes.tick_params(labelbottom=True)
    keep(figure, "history", {"t": history["t"], **{c: history[c] for _, _, used in panels for c in used}})
    return figure


def draw_panel(axes, history, label, scale, columns):
    for (column, text), colour, dashes in zip(columns.items(), (style.BLUE, style.VERMILLION),
                                              ("-", (0, (4, 1.2)))):
        values = FACTORS.get(column, 1.0) * history[column]
        if scale == "log":
            values = np.where(values > 0.0, values, np.nan)
        axes.plot(history["t"], values, color=colour, ls=dashes, lw=0.9, label=text,
                  marker=style.mark_if_few(values), ms=3)
    axes.set_yscale("log" if scale == "log" else "linear")
    axes.set_ylabel(label)
    axes.margins(x=0.0, y=0.12)
    widen(axes, scale)
    if len(columns) > 1:
        axes.legend(loc="best")


def widen(axes, scale):
    """No magnification of noise: whole decades, or at least 4 % of the value."""
    low, high = axes.get_ylim()
    if scale == "log":
        axes.set_ylim(10.0 ** np.floor(np.log10(low)), 10.0 ** np.ceil(np.log10(high)))
        return
    if scale == "count":
        axes.set_ylim(0.0, 1.1 * high)
        axes.yaxis.set_major_locator(MaxNLocator(5, integer=True))
        return
    missing = max(0.0, 0.04 * max(abs(low), abs(high)) - (high - low))
    low, high = low - 0.5 * missing, high + 0.5 * missing
    axes.set_ylim(max(0.0, low) if axes.dataLim.y0 >= 0.0 else low, high)
