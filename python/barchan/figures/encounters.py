"""encounters: dunes that meet: where they go, what becomes of their sand, and how each encounter ended.

Curves are dunes by name, which they keep through contact; bands along x are their extents, dots mark the first
contact. While two dunes touch, nobody can say where one ends: their curves are dotted there. The last panel has the
share of a dune's grains that is of another heap than its first ones. Writes encounters.csv besides the numbers of the
curves, and the same into run.json. Definitions: docs/dune-measures.md, "Names" and "Encounters".
"""

import numpy as np

from barchan.dune import encounters as dune_encounters
from barchan.dune.lineage import NONE
from barchan.figures import style
from barchan.figures.result import keep, publish, say

COLOURS = (style.BLUE, style.VERMILLION, style.GREEN, style.ORANGE, style.PURPLE, style.SKY)
MOST = len(COLOURS)  # dunes that are drawn in colour, in order of their largest size
SHOWN = 3            # encounters in the title
LEAST = 5            # upper end of the exchange [%]: no magnification of single grains


def draw(run, ax=None):
    lineage, found = dune_encounters.find(run)
    figure, ((paths, masses, exchange),) = style.panels(ax, 1, 3, figsize=(style.FULL_WIDTH, 2.7))
    names = chosen(lineage, found)
    for name, colour in zip(names, COLOURS):
        draw_path(paths, lineage, name, colour)
        touching = in_contact(lineage, name)
        apart_and_touching(masses, lineage.t, lineage.n_grains[:, name], touching, color=colour, label=f"dune {name}")
        apart_and_touching(exchange, lineage.t, 100 * foreign(lineage, name), touching, color=colour)
    for one in found:
        if one.t_contact == one.t_contact:
            frame = int(np.argmin(abs(lineage.t - one.t_contact)))
            x = np.nanmean(lineage.x[frame, [one.upstream, one.downstream]])
            paths.plot(1e3 * x, one.t_contact, "o", color=style.BLACK, ms=4, mfc="white")
    paths.set(xlabel="$x$ (mm)", ylabel="$t$ (s)", ylim=lineage.t[[0, -1]])
    masses.set(xlabel="$t$ (s)", ylabel="grains", ylim=(0, 1.45 * np.nanmax(lineage.n_grains[:, names])))
    masses.legend(loc="upper left", ncols=2)
    exchange.set(xlabel="$t$ (s)", ylabel="grains of other heaps (%)", ylim=(0, max(LEAST, exchange.get_ylim()[1])))
    for index, axes in enumerate((paths, masses, exchange)):
        style.panel_label(axes, index)
    if ax is None:
        figure.suptitle(title(found), fontsize=8.5)
    say(figure, dune_encounters.sentences(lineage, found))
    keep_tables(figure, lineage, found)
    return figure


def title(found):
    told = [f"dune {one.upstream} upstream of dune {one.downstream}: {one.kind}" for one in found[:SHOWN]]
    more = [f"and {len(found) - SHOWN} more"] if len(found) > SHOWN else []
    return "; ".join(told + more) or "no encounter"


def chosen(lineage, found):
    """Those that meet first, then the largest."""
    meet = [name for one in found for name in (one.upstream, one.downstream, *map(int, one.new_dunes.split()))]
    largest = np.argsort(-np.nanmax(lineage.n_grains, axis=0), kind="stable").tolist()
    able = dune_encounters.dunes_of(lineage)
    return sorted(list(dict.fromkeys(meet + [name for name in largest if name in able]))[:MOST])


def in_contact(lineage, name):
    """(F) whether it touches another dune: dunes that touch share the number of a body."""
    others = np.delete(lineage.body, name, axis=1)
    return lineage.present[:, name] & (others == lineage.body[:, [name]]).any(axis=1)


def apart_and_touching(axes, t, values, touching, color, label=None):
    """The curve, dotted while dunes touch."""
    axes.plot(t, np.where(touching, np.nan, values), color=color, label=label)
    widened = touching | np.roll(touching, 1) & (t > t[0]) | np.roll(touching, -1) & (t < t[-1])
    axes.plot(t, np.where(widened, values, np.nan), color=color, lw=0.8, ls=(0, (1, 1.5)))


def draw_path(axes, lineage, name, colour):
    x = 1e3 * lineage.x[:, name]
    axes.plot(x, lineage.t, color=colour)
    axes.fill_betweenx(lineage.t, x - 1e3 * lineage.reach["behind"][:, name],
                       x + 1e3 * lineage.reach["ahead"][:, name], color=colour, alpha=0.15, lw=0)


def foreign(lineage, name):
    """(F) share of a dune's grains that are of another heap than most of its first ones; NaN where it is not there."""
    frame, heap, dune, number = lineage.heaps.T
    own = dune == name
    first = own & (frame == frame[own].min())
    home = heap[first][np.argmax(number[first])]
    others = own & (heap != home) & (heap != NONE)
    count = np.bincount(frame[others], number[others], len(lineage.t))
    with np.errstate(invalid="ignore"):
        return count / np.where(lineage.present[:, name], lineage.n_grains[:, name], np.nan)


def keep_tables(figure, lineage, found):
    """dune_names: each dune at each time; exchange: the grains of each heap in each dune, -1: in none."""
    frame, name = np.nonzero(lineage.present)
    keep(figure, "dune_names", {
        "t": lineage.t[frame], "dune": name, "body": lineage.body[frame, name],
        **{key: getattr(lineage, key)[frame, name] for key in ("n_grains", "volume", "x", "z")}}, most=None)
    frame, heap, dune, number = lineage.heaps.T
    keep(figure, "exchange", {"t": lineage.t[frame], "heap": heap, "dune": dune, "n_grains": number,
                              "volume": lineage.heap_volumes}, most=None)
    publish(figure, "encounters", dune_encounters.table(found))
