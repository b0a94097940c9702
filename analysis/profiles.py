"""profiles: turbulence statistics over the height, in wall units, beside DNS of a channel.

DNS: Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau = 392, drawn for runs within a fifth of it.
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np

import style
from run_folder import NotInRun, read_table

DNS = Path(__file__).parents[1] / "tests/reference/dns_channel_mkm1999_chan395.csv"
DNS_RE_TAU = 392.24
STRESSES = (("uu", "$\\langle u'u' \\rangle$", style.BLUE), ("ww", "$\\langle w'w' \\rangle$", style.GREEN),
            ("vv", "$\\langle v'v' \\rangle$", style.ORANGE),
            ("uv", "$-\\langle u'v' \\rangle$", style.VERMILLION))


def read_dns():
    lines = [line for line in DNS.read_text().splitlines() if not line.startswith("#")]
    values = np.array([line.split(",") for line in lines[1:]], float).T
    return dict(zip(lines[0].split(","), values))


def draw(run):
    path = run.path / "statistics.csv"
    table = read_table(path) if path.exists() else {}
    if not table or len(table["y"]) < 2:
        raise NotInRun("needs statistics.csv: a run with a [statistics] section")
    y_plus, u_plus = table["y_plus"], table["U_plus"]
    if not np.all(u_plus > 0):
        raise NotInRun("needs a statistics.csv of a flow over a wall")
    u_star2 = float(np.median(table["U"] / u_plus)) ** 2
    height = run.domain[1] if run.domain else table["y"][-1]
    re_tau = height * float(y_plus[0] / table["y"][0])
    dns = read_dns() if abs(re_tau / DNS_RE_TAU - 1.0) < 0.2 else None

    figure, (mean, stress) = plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 2.7))
    draw_mean(mean, y_plus, u_plus, dns)
    draw_stresses(stress, table, u_star2, dns, table["y"] / height)
    for index, axes in enumerate((mean, stress)):
        style.panel_label(axes, index)
    run.write_curves("profiles", {"y_plus": y_plus, "U_plus": u_plus,
                                  **{name: table[name] / u_star2 for name, _, _ in STRESSES},
                                  "total": table["total_stress"] / u_star2})
    return figure


def draw_mean(axes, y_plus, u_plus, dns):
    sublayer, log_layer = np.geomspace(0.5, 11.0, 50), np.geomspace(11.0, 500.0, 50)
    axes.plot(sublayer, sublayer, color="0.6", lw=0.7, ls=":")
    axes.plot(log_layer, np.log(log_layer) / 0.41 + 5.2, color="0.6", lw=0.7, ls=":",
              label="$y^+$; $\\ln y^+/0.41 + 5.2$")
    if dns:
        axes.plot(dns["yplus"][1:], dns["U"][1:], color="k", lw=0.8, label="DNS, $Re_\\tau$ = 392")
    axes.plot(y_plus, u_plus, "o", color=style.BLUE, ms=3, label="this run")
    axes.set(xscale="log", xlim=(0.5, 500), ylim=(0, 22), xlabel="$y^+$", ylabel="$U^+$")
    axes.legend(loc="upper left")


def draw_stresses(axes, table, u_star2, dns, y):
    for name, label, colour in STRESSES:
        sign = -1.0 if name == "uv" else 1.0
        axes.plot(y, sign * table[name] / u_star2, "o", color=colour, ms=2.5, label=label)
        if dns:
            axes.plot(dns["y"], sign * dns[name], color=colour, lw=0.8)
    axes.plot(y, table["total_stress"] / u_star2, "x", color="k", ms=3, label="total stress")
    axes.plot([0, 1], [1, 0], color="0.6", lw=0.7, ls=":")
    axes.set(xlim=(0, 1), ylim=(0, None), xlabel="$y / L_y$", ylabel="stress / $u_*^2$")
    axes.legend(loc="upper right")
