"""horns: lengths of the two horns, number of grains in them, and how many of these came from upstream."""

import numpy as np
from matplotlib.ticker import AutoLocator, MaxNLocator

from barchan.dune.horns import LEFT, RIGHT, find_horns, share_upstream
from barchan.figures import style
from barchan.figures.result import keep
from barchan.io import horn_lengths

FEWEST = 20  # grains of which a share is formed


def draw(run, ax=None):
    horns = find_horns(run)
    n_left, n_right = (np.array([np.count_nonzero(side == which) for side in horns.sides])
                       for which in (LEFT, RIGHT))
    share = np.array([horns.upstream(ids) if len(ids) >= FEWEST else np.nan for ids in horns.ids])
    figure, ((lengths, numbers, origins),) = style.panels(ax, 1, 3, sharex=True, figsize=(style.FULL_WIDTH, 2.4))
    draw_pair(lengths, *length_curves(run, horns), "horn length (mm)")
    draw_pair(numbers, horns.t, n_left, n_right, "grains in the horns")
    draw_share(origins, horns, share)
    for index, axes in enumerate((lengths, numbers, origins)):
        axes.set_xlabel("$t$ (s)")
        style.panel_label(axes, index)
    keep(figure, "horns", {
        "t": horns.t, "horn_left": horns.left, "horn_right": horns.right, "n_left": n_left,
        "n_right": n_right, "upstream_share": share}, most=None)
    return figure


def length_curves(run, horns):
    """t [s], left, right [mm]: of dune.csv, by height and whose times are closer, else of the frames."""
    if run.dune_columns is None:
        return horns.t, 1e3 * horns.left, 1e3 * horns.right
    main = run.main_dune_columns
    columns = horn_lengths.best_known(main)
    return main["t"], 1e3 * main[columns["left"]], 1e3 * main[columns["right"]]


def draw_pair(axes, t, left, right, label):
    marker = style.mark_if_few(t)
    axes.plot(t, left, color=style.BLUE, marker=marker, ms=3, label="left ($z < C_z$)")
    axes.plot(t, right, color=style.VERMILLION, ls=(0, (4, 1.2)), marker=marker, ms=3,
              label="right ($z > C_z$)")
    top = np.nanmax(np.concatenate([left, right]), initial=0.0)
    axes.set(ylabel=label, ylim=(0, 1.3 * top or 1.0))  # room for the legend
    axes.yaxis.set_major_locator(MaxNLocator(6, integer=True) if top > 6 else AutoLocator())
    axes.legend(loc="upper left")


def draw_share(axes, horns, share):
    whole = share_upstream(horns.heap.phi[horns.heap.own])
    axes.plot(horns.t, 100 * share, "o-", color=style.BLUE, ms=2.5, lw=0.8, label="grains in the horns")
    axes.axhline(100 * whole, color=style.GREY, lw=0.9, ls=(0, (4, 1.5)), label="whole heap")
    axes.set(ylim=(0, 100), ylabel="from upstream half (%)")
    axes.legend(loc="lower right")
