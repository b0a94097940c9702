"""contacts: particle impacts of Chung & Ooi, Granular Matter 13, 643 (2011), tests 1 to 4 and 8."""

import numpy as np
from matplotlib.lines import Line2D
from matplotlib.patches import Patch

from barchan.figures import style
from validation import tables

BAND = {"color": "0.86", "lw": 0}
EXACT = {"ls": "", "marker": "x", "color": "0.35", "ms": 3.2, "mew": 0.7}
MATERIALS = {"Al oxide": (style.BLUE, "-", ""),
             "Al alloy": (style.VERMILLION, (0, (4, 1.2)), "_alloy")}
TARGETS = {"case A": (style.BLUE, "tan_rec_A", "o"), "case B": (style.GREEN, "tan_rec_B", "s"),
           "plane": (style.VERMILLION, "tan_rec_plane", "^")}


def draw(folder):
    figure, grid = style.panels(None, 2, 3, figsize=(style.FULL_WIDTH, 4.9))
    draw_loading(grid[0, 0], tables.read_saved(folder, "chung_ooi_1_2"))
    draw_restitution(grid[0, 1], tables.read_saved(folder, "chung_ooi_3"))
    oblique = tables.read_saved(folder, "chung_ooi_4")
    draw_oblique(grid[0, 2], oblique, "et")
    draw_oblique(grid[1, 0], oblique, "omega")
    draw_oblique(grid[1, 1], oblique, "patch_deg")
    draw_spinning(grid[1, 2], tables.read_saved(folder, "chung_ooi_8"))
    for index, axes in enumerate(grid.ravel()):
        style.panel_label(axes, index)
    shared = [Line2D([], [], **style.reference_marks(), label="Chung & Ooi, digitised"),
              Line2D([], [], color="k", lw=1.0, label="this code"), Patch(**BAND, label="tolerance"),
              Line2D([], [], **EXACT, label="full sliding, exact")]
    style.legend_outside(figure, shared, 0.25, ncols=len(shared))
    return figure


def draw_loading(axes, table):
    digitised = tables.read_table(tables.REFERENCE / "dem_chung_ooi2011_test1_test2_force_overlap.csv")
    for test, material, colour in ((1.0, "test 1, glass pair", style.BLUE),
                                   (2.0, "test 2, Al alloy on a plane", style.VERMILLION)):
        rows, paper = table.where("test", test), digitised.where("test", test)
        allowed = 0.02e-3 * rows["force"].max()
        axes.fill_between(paper["delta_um"], paper["F_kN"] - allowed, paper["F_kN"] + allowed, **BAND)
        axes.plot(paper["delta_um"], paper["F_kN"], **style.reference_marks(colour))
        axes.plot(1e6 * rows["overlap"], 1e-3 * rows["force"], color=colour, lw=1.0, label=material)
    axes.set(xlim=(0, 290), ylim=(0, 16), xlabel="overlap (µm)", ylabel="force (kN)")
    axes.legend(loc="upper left")


def draw_restitution(axes, table):
    axes.axhspan(-1, 1, **BAND)
    axes.axhline(0, color="k", lw=0.7, ls=":")
    for material, colour, marker in (("Al oxide", style.BLUE, "o"),
                                     ("cast iron", style.VERMILLION, "s")):
        rows = table.where("material", material)
        axes.plot(rows["e"], 1e3 * (rows["measured"] - rows["e"]), ls="", marker=marker, ms=3.4,
                  color=colour, mfc="none" if marker == "s" else colour, label=f"test 3, {material}")
    axes.set(xlim=(0.1, 1.1), ylim=(-1.5, 2.2), xlabel="restitution, input",
             ylabel="measured less input ($10^{-3}$)")
    axes.legend(loc="upper left")


# column of ours: label, sign, digitising error (none: no tolerance of its own), range
OBLIQUE = {"et": ("tangential restitution $e_t$", 1.0, 0.005, (0.55, 1.05)),
           "omega": ("spin $-\\omega$ (rad/s)", -1.0, 2.0, (0, 740)),
           "patch_deg": ("rebound angle of the patch (°)", 1.0, None, (-12, 92))}


def draw_oblique(axes, table, column):
    label, sign, digitising, limits = OBLIQUE[column]
    paper = tables.read_table(tables.REFERENCE / "dem_chung_ooi2011_test4_oblique.csv")
    theta = paper["theta_deg"]
    if digitising:
        values = sign * paper[f"co_{column}"]
        allowed = 0.05 * abs(values) + digitising
        axes.fill_between(theta, values - allowed, values + allowed, **BAND)
    for material, (colour, dashes, suffix) in MATERIALS.items():
        rows = table.where("material", material)
        if f"co_{column}{suffix}" in paper.columns:
            axes.plot(theta, sign * paper[f"co_{column}{suffix}"], **style.reference_marks(colour))
        axes.plot(rows["theta_deg"], sign * rows[column], color=colour, ls=dashes, lw=1.0,
                  label=f"test 4, {material}")
    if f"slide_{column}" in paper.columns:
        axes.plot(theta, sign * paper[f"slide_{column}"], **EXACT)
    axes.set(xlim=(0, 90), ylim=limits, xlabel="angle of incidence (°)", ylabel=label)
    axes.set_xticks(range(0, 91, 15))
    axes.legend(loc={"et": "lower right", "omega": "lower center"}.get(column, "upper left"))


def draw_spinning(axes, table):
    """Friction limited by the elastic part of the normal force, and for case A by all of it."""
    paper = tables.read_table(tables.REFERENCE / "dem_chung_ooi2011_test7_8.csv")
    x = paper["tan_inc"]
    middle = x < 3
    axes.fill_between(x[middle], paper["tan_rec_A"][middle] - 0.1, paper["tan_rec_A"][middle] + 0.1,
                      **BAND)
    elastic, total = table.where("limit", "elastic"), table.where("limit", "total")
    for target, (colour, column, marker) in TARGETS.items():
        rows = elastic.where("target", target)
        axes.plot(x, paper[column], **style.reference_marks(colour, marker))
        axes.plot(rows["tan_inc"], rows["tan_rec"], color=colour, lw=1.0, label=f"test 8, {target}")
    rows = total.where("target", "case A")
    axes.plot(rows["tan_inc"], rows["tan_rec"], color=style.BLUE, lw=0.9, ls=(0, (4, 1.2)),
              label="case A, limit $\\mu |F_n|$")
    sliding = np.linspace(2.4, 3.9, 6)
    axes.plot(sliding, (sliding - 2.1) / 0.5, **EXACT)
    axes.set(xlim=(0, 4), ylim=(-0.7, 4), xlabel="tangent of incident angle",
             ylabel="tangent of rebound angle")
    axes.legend(loc="upper left")
