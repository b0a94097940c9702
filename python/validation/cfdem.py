"""beside_cfdem: forces on frozen grains, the bed of the tutorial, a heap in flow; in CFDEM and here."""

import numpy as np

from barchan.figures import style
from validation import tables


def draw(folder):
    figure, grid = style.panels(None, 2, 3, figsize=(style.FULL_WIDTH, 4.7), layout="constrained")
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


def draw_series(axes, folder, name, colour, scale=1):
    """Symbols: CFDEM. Line: this code, its handle."""
    theirs, ours = both(folder, "heap")
    axes.plot(theirs["t"], scale * theirs[name], ls="", marker="o", mfc="none", ms=3.5, color=colour)
    return axes.plot(ours["t"], scale * ours[name], color=colour)[0]


def right_axis(axes, label, top):
    """A second ordinate in the colour of what it is for."""
    right = axes.twinx()
    right.set_ylabel(label, color=style.VERMILLION)
    right.tick_params(axis="y", labelcolor=style.VERMILLION)
    right.set_ylim(0, top)
    return right


def draw_shape(axes, folder):
    lines = [draw_series(axes, folder, name, colour) for name, colour in (("W", style.BLUE), ("L", style.GREEN))]
    axes.set(xlabel="$t$ (s)", ylabel="$W$, $L$ (mm)", ylim=(0, 18))
    lines.append(draw_series(right_axis(axes, "$H$ (mm)", 3.6), folder, "H", style.VERMILLION))
    axes.legend(lines, ["$W$", "$L$", "$H$"], loc="lower left", ncols=3, columnspacing=1, handlelength=1.2)


def draw_motion(axes, folder):
    lines = [draw_series(axes, folder, "shift", style.BLUE)]
    axes.set(xlabel="$t$ (s)", ylabel="shift of the centroid (mm)", ylim=(0, 12))
    lines.append(draw_series(right_axis(axes, "moving grains (%)", 150), folder, "moving", style.VERMILLION, 100))
    axes.legend(lines, ["shift", "moving grains"], loc="upper left")


def draw_velocity(axes, folder):
    theirs, ours = both(folder, "velocity")
    axes.plot(theirs["u"], theirs["low"], **style.reference_marks(size=4), label="CFDEM")
    axes.plot(ours["u"], ours["low"], color=style.BLUE, label="this code")
    axes.set(xlabel="velocity of grains (mm/s)", ylabel="height of grains from (mm)", xlim=(0, None))
    axes.legend(loc="best")
