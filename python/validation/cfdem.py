"""beside_cfdem: forces on held grains, the bed of the tutorial, a heap in flow; in CFDEM and here."""

import numpy as np

from barchan.figures import style
from validation import tables


def draw(folder):
    figure, grid = style.panels(None, 2, 3, figsize=(style.FULL_WIDTH, 4.7))
    draw_forces(grid[0, 0], folder, "bed")
    draw_forces(grid[0, 1], folder, "heap")
    draw_ergun(grid[0, 2], folder)
    draw_shape(grid[1, 0], folder)
    draw_motion(grid[1, 1], folder)
    draw_velocity(grid[1, 2], folder)
    for index, axes in enumerate(grid.ravel()):
        style.panel_label(axes, index)
    return figure


def both(folder, name):
    """CFDEM's table and ours."""
    return tables.read_table(tables.REFERENCE / f"cfdem_{name}.csv"), tables.read_saved(folder, f"beside_cfdem_{name}")


def draw_forces(axes, folder, case):
    """Mean drag by height over the submerged weight."""
    theirs = tables.read_table(tables.REFERENCE / "cfdem_held_forces.csv").where("case", case).where("part", "drag")
    ours = tables.read_saved(folder, "beside_cfdem_forces").where("case", case)
    for run, label, marks in (("interpolated", "CFDEM", {"marker": "o", "color": style.BLACK}),
                              ("cell", "CFDEM, in cell", {"marker": "^", "color": style.GREY})):
        rows = theirs.where("run", run)
        axes.plot(rows["mean"], rows["low"], ls="", mfc="none", ms=4, label=label, **marks)
    axes.plot(ours["drag"], ours["low"], color=style.BLUE, label="this code")
    axes.axvline(0, color="k", lw=0.5, ls=":")
    axes.set(xlabel="drag over submerged weight", ylabel="height of grains from (mm)", title=case)
    if case == "bed":
        axes.legend(loc="center right", bbox_to_anchor=(1, 0.35))


def draw_ergun(axes, folder):
    theirs, ours = both(folder, "ergun")
    u = np.linspace(0, 1.05 * theirs["superficial"].max(), 50)
    d, void, length, mu, rho = 1e-3, 0.451335, 0.0156, 1.5e-3, 10.0
    ergun = 150 * (1 - void)**2 / void**3 * mu * u / d**2 + 1.75 * (1 - void) / void**3 * rho * u**2 / d
    axes.plot(1e3 * u, length * ergun, color="k", lw=0.7, ls=":", label="Ergun")
    axes.plot(1e3 * theirs["superficial"], theirs["drop"], **style.reference_marks(size=4), label="CFDEM")
    axes.plot(1e3 * ours["superficial"], ours["drop"], color=style.BLUE, label="this code")
    axes.set(xlabel="superficial velocity (mm/s)", ylabel="pressure drop (Pa)", xlim=(0, None), ylim=(0, None))
    axes.legend(loc="upper left")


def draw_shape(axes, folder):
    theirs, ours = both(folder, "heap")
    for name, colour, scale in (("W", style.BLUE, 1), ("L", style.GREEN, 1), ("H", style.VERMILLION, 5)):
        axes.plot(theirs["t"], scale * theirs[name], ls="", marker="o", mfc="none", ms=3.5, color=colour)
        axes.plot(ours["t"], scale * ours[name], color=colour, label=f"${name}$" if scale == 1 else f"{scale} ${name}$")
    axes.set(xlabel="$t$ (s)", ylabel="mm", ylim=(0, None))
    axes.legend(loc="lower left", ncols=3, title="lines: this code; symbols: CFDEM", title_fontsize=7)


def draw_motion(axes, folder):
    theirs, ours = both(folder, "heap")
    for name, label, colour, scale in (("shift", "shift of the centroid (mm)", style.BLUE, 1),
                                       ("moving", "moving grains (tenths)", style.VERMILLION, 10)):
        axes.plot(theirs["t"], scale * theirs[name], ls="", marker="o", mfc="none", ms=3.5, color=colour)
        axes.plot(ours["t"], scale * ours[name], color=colour, label=label)
    axes.set(xlabel="$t$ (s)", ylim=(0, 14))
    axes.legend(loc="upper left")


def draw_velocity(axes, folder):
    theirs, ours = both(folder, "velocity")
    axes.plot(theirs["u"], theirs["low"], **style.reference_marks(size=4), label="CFDEM")
    axes.plot(ours["u"], ours["low"], color=style.BLUE, label="this code")
    axes.set(xlabel="mean velocity of grains (mm/s)", ylabel="height of grains from (mm)", xlim=(0, None))
    axes.legend(loc="best")
