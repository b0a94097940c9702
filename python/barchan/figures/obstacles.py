"""obstacles: a dune that meets a body or a crater: its path, where its grains are, and how it ended.

Left: the median place of the dune's grains along the current, from the middle of the obstacle, which is the grey band;
the dot marks the first contact. Right: shares of the grains upstream, around and downstream. Writes obstacles.csv and
the same into run.json. Definitions: docs/dune-measures.md, "Obstacles".
"""

import numpy as np

from barchan.dune import obstacles as dune_obstacles
from barchan.figures import style
from barchan.figures.result import keep, publish, say
from barchan.io.study_folder import plain

MOST = 4
PLACES = (("upstream", style.BLUE), ("around", style.ORANGE), ("downstream", style.GREEN))


def draw(run, ax=None):
    found = dune_obstacles.find(run)
    shown = found[:MOST]
    figure, grid = style.panels(ax, len(shown), 2, sharex=True, figsize=(style.FULL_WIDTH, 0.7 + 2.0 * len(shown)))
    for row, (one, (places, shares)) in enumerate(zip(shown, grid)):
        path = one.path
        places.axhspan(*(1e3 * end for end in path.ends), color=style.BODY, lw=0)
        places.plot(path.t, 1e3 * path.s, color=style.BLUE)
        if np.isfinite(one.t_contact):
            at = int(np.argmin(abs(path.t - one.t_contact)))
            places.plot(path.t[at], 1e3 * path.s[at], "o", color=style.BLACK, mfc="white", ms=4)
        for (name, colour), values in zip(PLACES, path.shares.T):
            shares.plot(path.t, 100 * values, color=colour, label=name)
        places.set(ylabel="$s$ from the obstacle (mm)", xlim=(path.t[0], path.t[-1]))
        shares.set(ylabel="grains (%)", ylim=(-3, 103), xlim=(path.t[0], path.t[-1]))
        shares.legend(loc="center left")
        places.set_title(plain(f"{one.dune}, {one.obstacle}: {one.outcome}"), pad=3)
        for column, axes in enumerate((places, shares)):
            style.panel_label(axes, 2 * row + column)
    for axes in grid[-1]:
        axes.set_xlabel("$t$ (s)")
    say(figure, dune_obstacles.sentences(found))
    keep_tables(figure, found)
    return figure


def keep_tables(figure, found):
    """obstacle_paths: place and shares of each dune at each time."""
    columns = {"dune": [], "obstacle": [], "t": [], "s": [], "upstream": [], "around": [], "downstream": []}
    for one in found:
        for t, s, shares in zip(one.path.t, one.path.s, one.path.shares):
            for name, value in zip(columns, (one.dune, one.obstacle, t, s, *shares)):
                columns[name].append(value)
    keep(figure, "obstacle_paths", columns, most=None)
    publish(figure, "obstacles", dune_obstacles.table(found))
