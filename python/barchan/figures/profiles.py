"""profiles: turbulence statistics over the height, in wall units, beside DNS of a channel.

DNS: Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau = 392, drawn for runs within a fifth of it.
"""

import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep
from barchan.flow.wall_units import DNS_RE_TAU, in_wall_units, read_dns

STRESSES = (("uu", "$\\langle u'u' \\rangle$", style.BLUE), ("vv", "$\\langle v'v' \\rangle$", style.ORANGE),
            ("ww", "$\\langle w'w' \\rangle$", style.GREEN),
            ("uv", "$-\\langle u'v' \\rangle$", style.VERMILLION))


def draw(run, ax=None):
    table = run.statistics_columns
    if not table or len(table["y"]) < 2:
        raise MissingData("needs statistics.csv: a run with a [statistics] section")
    if not np.all(table["U_plus"] > 0):
        raise MissingData("needs a statistics.csv of a flow over a wall")
    height = run.domain[1] if run.domain else table["y"][-1]
    curves = in_wall_units(table, height)
    re_tau = height * float(table["y_plus"][0] / table["y"][0])
    dns = read_dns() if abs(re_tau / DNS_RE_TAU - 1.0) < 0.2 else None

    figure, ((mean, stress),) = style.panels(ax, 1, 2, figsize=(style.FULL_WIDTH, 2.7))
    draw_mean(mean, curves, dns)
    draw_stresses(stress, curves, dns)
    for index, axes in enumerate((mean, stress)):
        style.panel_label(axes, index)
    del curves["y"]
    keep(figure, "profiles", curves)
    return figure


def draw_law_of_the_wall(axes):
    sublayer, log_layer = np.geomspace(0.5, 11.0, 50), np.geomspace(11.0, 500.0, 50)
    axes.plot(sublayer, sublayer, color="0.6", lw=0.7, ls=":")
    axes.plot(log_layer, np.log(log_layer) / 0.41 + 5.2, color="0.6", lw=0.7, ls=":",
              label="$y^+$; $\\ln y^+/0.41 + 5.2$")
    axes.set(xscale="log", xlim=(0.5, 500), ylim=(0, 22), xlabel="$y^+$", ylabel="$U^+$")


def draw_mean(axes, curves, dns):
    draw_law_of_the_wall(axes)
    if dns:
        axes.plot(dns["y_plus"], dns["U_plus"], color="k", lw=0.8, label="DNS, $Re_\\tau$ = 392")
    axes.plot(curves["y_plus"], curves["U_plus"], "o", color=style.BLUE, ms=3, label="this run")
    axes.legend(loc="upper left")


def draw_stresses(axes, curves, dns):
    for name, label, colour in STRESSES:
        sign = -1.0 if name == "uv" else 1.0
        axes.plot(curves["y"], sign * curves[name], "o", color=colour, ms=2.5, label=label)
        if dns:
            axes.plot(dns["y"], sign * dns[name], color=colour, lw=0.8)
    axes.plot(curves["y"], curves["total"], "x", color="k", ms=3, label="total stress")
    axes.plot([0, 1], [1, 0], color="0.6", lw=0.7, ls=":", label="$1 - y / L_y$")
    if dns:
        axes.plot([], [], color="k", lw=0.8, label="lines: DNS")
    axes.set(xlim=(0, 1), ylim=(0, None), xlabel="$y / L_y$", ylabel="stress / $u_*^2$")
    axes.legend(loc="upper right")
