"""profiles: turbulence statistics over the height, in wall units, beside DNS of a channel.

DNS: Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau = 392, drawn for runs within a fifth of it.
"""

import matplotlib.pyplot as plt
import numpy as np

import style
import tables
from run_folder import NotInRun, read_table

DNS_RE_TAU = 392.24
STRESSES = (("uu", "$\\langle u'u' \\rangle$", style.BLUE), ("ww", "$\\langle w'w' \\rangle$", style.GREEN),
            ("vv", "$\\langle v'v' \\rangle$", style.ORANGE),
            ("uv", "$-\\langle u'v' \\rangle$", style.VERMILLION))


def read_dns(name="chan395"):
    """The DNS above the wall, with the columns of in_wall_units."""
    dns = tables.read(tables.REFERENCE / f"dns_channel_mkm1999_{name}.csv")
    names = {"y": "y", "y_plus": "yplus", "U_plus": "U", "uu": "uu", "vv": "vv", "ww": "ww",
             "uv": "uv", "total": "tot"}
    return {name: dns[column][1:] for name, column in names.items()}


def friction_velocity(table):
    """u_star with which statistics.csv was scaled [m/s]."""
    return float(np.median(table["U"] / table["U_plus"]))


def in_wall_units(table, height):
    """Columns of statistics.csv over u_star and u_star^2, y over the height of the channel."""
    u_star2 = friction_velocity(table) ** 2
    return {"y": table["y"] / height, "y_plus": table["y_plus"], "U_plus": table["U_plus"],
            **{name: table[name] / u_star2 for name, _, _ in STRESSES},
            "total": table["total_stress"] / u_star2}


def draw(run):
    path = run.path / "statistics.csv"
    table = read_table(path) if path.exists() else {}
    if not table or len(table["y"]) < 2:
        raise NotInRun("needs statistics.csv: a run with a [statistics] section")
    if not np.all(table["U_plus"] > 0):
        raise NotInRun("needs a statistics.csv of a flow over a wall")
    height = run.domain[1] if run.domain else table["y"][-1]
    curves = in_wall_units(table, height)
    re_tau = height * float(table["y_plus"][0] / table["y"][0])
    dns = read_dns() if abs(re_tau / DNS_RE_TAU - 1.0) < 0.2 else None

    figure, (mean, stress) = plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 2.7))
    draw_mean(mean, curves, dns)
    draw_stresses(stress, curves, dns)
    for index, axes in enumerate((mean, stress)):
        style.panel_label(axes, index)
    del curves["y"]
    run.write_curves("profiles", curves)
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
    axes.plot([0, 1], [1, 0], color="0.6", lw=0.7, ls=":")
    axes.set(xlim=(0, 1), ylim=(0, None), xlabel="$y / L_y$", ylabel="stress / $u_*^2$")
    axes.legend(loc="upper right")
