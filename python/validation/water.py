"""grains_and_water: settling, hindered settling, pressure drop, distribution of solid volume."""

import numpy as np

from barchan.figures import style
from validation import tables

RAMP = (style.BLUE, style.SKY, style.GREEN, style.ORANGE, style.VERMILLION)
RICHARDSON_ZAKI = 3.821568  # exponent for the mean grain of the paper's Table II


def draw(folder):
    figure, grid = style.panels(None, 2, 3, figsize=(style.FULL_WIDTH, 4.7))
    draw_grains(grid[0, 0], tables.read_saved(folder, "settling_transients"))
    draw_spheres(grid[0, 1], tables.read_saved(folder, "settling_transients"))
    draw_hindered(grid[0, 2], tables.read_saved(folder, "hindered_settling"))
    draw_bed(grid[1, 0], tables.read_saved(folder, "packed_bed"))
    draw_solid_volume(grid[1, 1], tables.read_saved(folder, "void_fraction_overlap"))
    draw_excess(grid[1, 2], tables.read_saved(folder, "settling_excess"))
    for index, axes in enumerate(grid.ravel()):
        style.panel_label(axes, index)
    return figure


def draw_transients(axes, table, spheres):
    """Velocity of each (sphere, label, colour) beside theory, labelled at its end."""
    for number, (sphere, label, colour) in enumerate(spheres):
        rows = table.where("sphere", sphere)
        axes.plot(rows["t"][::5], 1e3 * rows["theory"][::5], **style.reference_marks(size=3.2),
                  label=None if number else "theory")
        axes.plot(rows["t"], 1e3 * rows["v"], color=colour, lw=1.0,
                  label=None if number else "this code")
        axes.annotate(label, (rows["t"][-1], 1e3 * rows["v"][-1]), xytext=(4, 0), va="center",
                      textcoords="offset points", color=colour, fontsize=7)
    axes.set(xlabel="$t$ (s)", ylabel="fall velocity (mm/s)")


def draw_grains(axes, table):
    spheres = [name for name in table.values("sphere") if name.startswith("d = ")]
    labels = [f"{1e3 * float(name[4:]):g} mm" for name in spheres]
    draw_transients(axes, table, list(zip(spheres, labels, RAMP)))
    axes.set(ylim=(0, 35), xlim=(0, 0.145))
    axes.legend(loc="lower right")


def draw_spheres(axes, table):
    """Ten Cate's sphere in four oils; in the experiment its walls slow it."""
    measured = tables.read_table(tables.REFERENCE / "settling_ten_cate2002.csv")
    cases = list(zip(measured["case"], measured["Re"], measured["u_max"], RAMP))
    draw_transients(axes, table, [(case, f"Re = {re:g}", colour) for case, re, _, colour in cases])
    for case, _, peak, colour in cases:
        end = table.where("sphere", case)["t"][-1]
        axes.plot(end * np.array([0.6, 1.0]), 1e3 * np.array([peak, peak]), color=colour, lw=1.0,
                  ls=":", label="measured between walls" if case == "E1" else None)
    axes.set(ylim=(0, 195), xlim=(0, 4.1))
    axes.legend(loc="upper left")


def draw_hindered(axes, table):
    axes.axhline(1, color="k", lw=0.7, ls=":", label="Richardson-Zaki, $n$ = 3.82")
    for law, colour, marker in (("Gidaspow", style.BLUE, "s"), ("Di Felice", style.VERMILLION, "D")):
        rows = table.where("law", law)
        scale = rows["alone"] * rows["alpha"]**RICHARDSON_ZAKI
        balance = rows["force_balance"] / scale
        axes.errorbar(rows["alpha"], balance, yerr=0.02 * balance, capsize=3, ecolor="k",
                      elinewidth=0.6, **style.reference_marks(size=6),
                      label="force balance $\\pm$ 2 %" if law == "Gidaspow" else None)
        axes.plot(rows["alpha"], rows["v"] / scale, ls="", marker=marker, ms=2.8, color=colour,
                  label=f"this code, {law}")
    axes.set(xlabel="fluid fraction $\\alpha_f$", ylabel="velocity over Richardson-Zaki's",
             xlim=(0.66, 0.94), ylim=(0.7, 1.25))
    axes.legend(loc="upper left")


def draw_bed(axes, table):
    """Ergun's line goes through the saved values: dp/L = a U + b U^2."""
    smoothed = table.where("smoothing", 4e-4)
    table = table.where("smoothing", 0.0)
    for alpha, colour in zip(table.values("alpha"), (style.BLUE, style.GREEN, style.VERMILLION)):
        rows = table.where("alpha", alpha)
        u, ergun = rows["superficial"], rows["ergun"]
        a, b = np.linalg.lstsq(np.stack([1 / ergun * u, u * u / ergun], axis=1), np.ones(len(u)),
                               rcond=None)[0]
        line = np.geomspace(0.7 * u.min(), 1.4 * u.max(), 60)
        axes.plot(line, a * line + b * line**2, color="k", lw=0.7,
                  label="Ergun" if colour == style.BLUE else None)
        axes.plot(u, rows["gradient"], "o", color=colour, ms=3.5, label=f"$\\alpha_f$ = {alpha:g}")
    axes.plot(smoothed["superficial"], smoothed["gradient"], "x", color=style.BLUE, ms=5,
              label="$\\alpha_f$ = 0.4, smoothed")
    axes.set(xscale="log", yscale="log", xlabel="superficial velocity (m/s)", ylim=(0.3, 1e7),
             ylabel="pressure drop (Pa/m)")
    axes.legend(loc="lower right", labelspacing=0.3)


def draw_solid_volume(axes, table):
    ratio = table["cell_over_d"]
    slope = table["mean"][0] * ratio[0] / ratio
    axes.plot(ratio, 100 * slope, color="k", lw=0.7, ls=":", label="slope $-1$")
    draw_over_cell_size(axes, table, mean="mean", worst="worst of 2000 places")
    axes.set(ylabel="solid volume in wrong cells (%)", ylim=(0.5, 60))
    axes.legend(loc="lower left")


def draw_excess(axes, table):
    axes.axhspan(0.001, 0.5, color="0.9", lw=0, label="tolerance at 40 $d$")
    draw_over_cell_size(axes, table, excess="$d$ = 0.2 mm, coupled")
    axes.set(ylabel="excess fall velocity (%)", ylim=(0.005, 10))
    axes.legend(loc="upper right")


def draw_over_cell_size(axes, table, **labels):
    """Columns of the table, in per cent and with a label each, over the size of the cells."""
    ratio = table["cell_over_d"]
    lines = ({"marker": "o", "color": style.BLUE, "ms": 3.5, "lw": 1.0},
             {"marker": "s", "color": style.SKY, "ms": 3.2, "lw": 0.8, "ls": "--"})
    for (column, label), line in zip(labels.items(), lines):
        axes.plot(ratio, 100 * table[column], label=label, **line)
    axes.set(xscale="log", yscale="log", xlabel="cell size over grain diameter")
    axes.set_xticks(ratio, [f"{r:g}" for r in ratio])
    axes.yaxis.set_major_formatter("{x:g}")
    axes.minorticks_off()
