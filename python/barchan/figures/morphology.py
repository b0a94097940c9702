"""morphology: the size, place and horns of the dune against time (as Fig. 7 of Lima et al. 2022)."""

import numpy as np

from barchan.figures import style
from barchan.figures.result import keep
from barchan.io import horn_lengths

PANELS = (("W", "width $W$ (mm)"), ("L", "length $L$ (mm)"), ("H", "height $H$ (mm)"),
          ("Cx", "centroid $C_x$ (mm)"), ("Cz", "centroid $C_z$ (mm)"), (None, "horn length (mm)"))


def draw(run, ax=None):
    main = run.main_dune_columns
    figure, panels = style.panels(ax, 2, 3, sharex=True, figsize=(style.FULL_WIDTH, 4.2))
    for index, (axes, (name, label)) in enumerate(zip(panels.ravel(), PANELS)):
        if name is None:
            draw_horns(axes, main)
        else:
            draw_quantity(axes, run.dune_columns, name)
        axes.set_ylabel(label)
        style.panel_label(axes, index)
        widen(axes, 0.4 if name == "Cz" else 0.0)
    for axes in panels[1]:
        axes.set_xlabel("$t$ (s)")
    note_celerity(panels[1, 0], main)
    horns = sorted({"horn_left", "horn_right", *horn_lengths.best_known(main).values()})
    keep(figure, "morphology", {name: main[name] for name in (
        "t", "W", "L", "H", "Cx", "Cz", *horns, "celerity", "n_grains")})
    return figure


def draw_quantity(axes, dunes, name):
    labels = sorted(dunes)
    for label in labels[1:]:  # dunes that split off
        axes.plot(dunes[label]["t"], 1e3 * dunes[label][name], ".", color=style.GREY, ms=1.5,
                  alpha=0.5, mew=0)
    main = dunes[labels[0]]
    axes.plot(main["t"], 1e3 * main[name], color=style.BLUE, marker=style.mark_if_few(main["t"]), ms=3)


def draw_horns(axes, main):
    """By height, and thin up to the farthest grains."""
    columns = horn_lengths.best_known(main)
    marker = style.mark_if_few(main["t"])
    for side, sign, colour in (("left", "<", style.BLUE), ("right", ">", style.VERMILLION)):
        axes.plot(main["t"], 1e3 * main[columns[side]], color=colour, marker=marker, ms=3,
                  label=f"{side} ($z {sign} C_z$)")
        if columns[side] != f"horn_{side}":
            axes.plot(main["t"], 1e3 * main[f"horn_{side}"], color=colour, lw=0.7, alpha=0.8, ls=(0, (1, 1)))
    if columns["left"] != "horn_left":
        axes.plot([], [], color=style.GREY, lw=0.7, ls=(0, (1, 1)), label="to the last grain")
    axes.legend(loc="best")


def widen(axes, least_mm):
    """A little air, and no magnification of noise: at least `least_mm` from bottom to top."""
    low, high = axes.get_ylim()
    missing = max(0.0, least_mm - (high - low))
    axes.set_ylim(low - 0.5 * missing - 0.04 * (high - low),
                  high + 0.5 * missing + 0.04 * (high - low))


def note_celerity(axes, main):
    known = np.isfinite(main["celerity"])
    if known.any():
        speed = 1e3 * main["celerity"][known][-1]
        axes.text(0.96, 0.06, f"{speed:.3g} mm/s at the end", transform=axes.transAxes, ha="right",
                  fontsize=7.5, color=style.BLUE)
