"""encounter_forces: what the water does to two dunes that meet, and whose grains lie in whose dune.

(a) to (d) from above, moving with the centroid of both dunes: the water's force along the current on grains at the
surface, over the submerged weight of a grain of mean diameter. Lines: outlines of what is of each dune, dots: its
centroid. Below against time: the same force as mean over each dune by name, and over its upstream end; the share of
each one's first grains that is in the other by name, and that lies amid more grains of the other. Grey: they touch.
Definitions: docs/dune-measures.md, "Encounters".
"""

import numpy as np
from contourpy import contour_generator
from matplotlib.figure import Figure

from barchan.dune import encounter_forces
from barchan.dune.current import always_along_x
from barchan.dune.detect import RIM_COVER, components
from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.encounters import COLOURS
from barchan.figures.result import keep, say
from barchan.stats import spread

FEWEST = 6         # grains of a bin that is drawn
FEWEST_POINTS = 9  # of an outline: less is one bin or two
CURVES = 2.9       # [in]
MARGIN = 1.0e-3    # [m] around the outlines
CLUMP = 16         # bins of what is always seen


def draw(run, ax=None):
    style.own_page(ax)
    found = encounter_forces.of_run(run)
    pair = found.encounter.upstream, found.encounter.downstream
    colours = [COLOURS[name % len(COLOURS)] for name in pair]
    window = window_of(found.maps)
    width = 0.5 * style.FULL_WIDTH - 0.4
    height = width * (window[3] - window[2]) / (window[1] - window[0])
    rows = -(-len(found.maps) // 2)
    tall = rows * (height + 0.25) + 0.4 * (1 + len(found.maps) % 2) + 0.6  # titles; labels of x; colour bar
    figure = Figure(figsize=(style.FULL_WIDTH, tall + CURVES), layout="constrained")
    above, below = figure.subfigures(2, 1, height_ratios=(tall, CURVES))
    maps = above.subplots(rows, 2, sharex=True, sharey=True, squeeze=False)
    draw_maps(above, maps, found.maps, window, colours)
    if always_along_x(run.config):
        style.flow_arrow(maps[0, 0], 0.02, 0.93)
    draw_curves(below.subplots(2, 1, sharex=True), found, pair, colours, len(found.maps))
    say(figure, sentences(found, pair))
    keep_tables(figure, found)
    return figure


def window_of(maps):
    """(x0, x1, z0, z1) [m] around both dunes in all maps, without clumps of a few bins."""
    ends = []
    for one in maps:
        piece = components(one.cover.sum(axis=0) >= RIM_COVER, (False, False))
        numbers, bins = np.unique(piece[piece >= 0], return_counts=True)
        if not len(bins):
            continue
        held = np.nonzero(np.isin(piece, numbers[bins >= min(CLUMP, bins.max())]))
        ends += [(edges[rows.min()], edges[rows.max() + 1]) for edges, rows in zip(one.edges, held)]
    if not ends:
        raise MissingData(f"needs dunes whose grains cover {RIM_COVER:g} of a bin of the map")
    x, z = np.array(ends[::2]), np.array(ends[1::2])
    return x[:, 0].min() - MARGIN, x[:, 1].max() + MARGIN, z[:, 0].min() - MARGIN, z[:, 1].max() + MARGIN


def draw_maps(figure, panels, maps, window, colours):
    shown = [np.ma.masked_where(one.n < FEWEST, one.force) for one in maps]
    known = np.concatenate([one.compressed() for one in shown])
    if not len(known):
        raise MissingData(f"needs {FEWEST} grains at the surface in a bin of the map")
    limit = max(np.percentile(abs(known), 98), 1e-12)
    for index, (axes, one, values) in enumerate(zip(panels.flat, maps, shown)):
        x, z = (1e3 * edges for edges in one.edges)
        image = axes.pcolormesh(x, z, values.T, vmin=-limit, vmax=limit, cmap=style.FORCE_MAP, rasterized=True)
        middles = [0.5 * (edges[1:] + edges[:-1]) for edges in (x, z)]
        for cover, centroid, colour in zip(one.cover, 1e3 * one.centroids, colours):
            lines = contour_generator(*middles, cover.T).lines(RIM_COVER)
            for line in (line for line in lines if len(line) >= FEWEST_POINTS):
                axes.plot(*line.T, color=colour, lw=1.2)
            axes.plot(*centroid, "o", mfc=colour, mec="white", mew=0.8, ms=5)
        style.panel_label(axes, index)
        axes.set_title(f"{one.moment}, $t$ = {one.start:.2f} to {one.end:.2f} s", pad=3)
        axes.set(aspect="equal", xlim=1e3 * np.array(window[:2]), ylim=1e3 * np.array(window[:1:-1]))
    for axes in panels.flat[len(maps):]:
        axes.set_visible(False)
    for axes in panels.flat[max(0, len(maps) - 2):len(maps)]:
        axes.tick_params(labelbottom=True)
        axes.set_xlabel("$x$ from the centroid of both (mm)")
    for axes in panels[:, 0]:
        axes.set_ylabel("$z$ (mm)")
    bar = figure.colorbar(image, ax=panels, location="bottom", shrink=0.5, aspect=35, pad=0.02, extend="both")
    bar.set_label("force of the water along the current / submerged weight")
    bar.outline.set_linewidth(0.6)


def draw_curves(panels, found, pair, colours, first):
    forces, shares = panels
    curves = [(force, colour, "-", f"dune {name}, {role}")
              for force, colour, name, role in zip(found.force, colours, pair, ("upstream", "downstream"))]
    curves += [(force, colour, "--", f"upstream end of dune {name}")
               for force, colour, name in zip(found.end, colours, pair)]
    lowest, highest = 0.0, 0.0
    for force, colour, dashes, label in curves:
        t, mean, interval = found.means(force)
        if np.isfinite(mean).any():
            forces.plot(t, mean, color=colour, ls=dashes, label=label, marker="o", ms=2)
            lowest, highest = min(lowest, np.nanmin(mean - interval)), max(highest, np.nanmax(mean + interval))
        forces.fill_between(t, mean - interval, mean + interval, color=colour, alpha=0.15, lw=0)
    for values, dashes, where in ((found.foreign, "-", "in"), (found.amid, "--", "amid grains of")):
        for share, colour, name, other in zip(values, colours, pair, pair[::-1]):
            shares.plot(found.t, 100 * share, color=colour, ls=dashes, label=f"of dune {name} {where} dune {other}")
    for force, name, colour in zip(found.force, pair, colours):
        last = np.nonzero(np.isfinite(force))[0][-1:]
        if len(last) and found.t[last[0]] < found.t[-1]:
            forces.annotate(f" no dune {name} from here on", (found.t[last[0]], 0.03), color=colour, fontsize=7.5,
                            xycoords=("data", "axes fraction"))
            forces.axvline(found.t[last[0]], color=colour, lw=0.8, ls=(0, (1, 1.5)))
    for index, axes in enumerate(panels):
        axes.fill_between(found.t, 0, 1, where=found.touching, transform=axes.get_xaxis_transform(), color="0.9", lw=0,
                          zorder=0)
        axes.legend(loc="upper left", ncols=2)
        style.panel_label(axes, first + index)
    forces.set_ylabel("force /\nsubmerged weight")
    if highest > lowest:
        forces.set_ylim(lowest, highest + 0.6 * (highest - lowest))  # room for the legend
    shares.set(xlabel="$t$ (s)", ylabel="grains (%)", xlim=found.t[[0, -1]], ylim=(0, 1.6 * shares.get_ylim()[1]))


def sentences(found, pair):
    told = []
    for one in found.maps:
        chosen = (found.t >= one.start) & (found.t <= one.end)
        up, down, *ends = (mean_of(values[chosen]) for values in (*found.force, *found.end))
        told.append(f"{one.moment}, {one.start:.3g} to {one.end:.3g} s: force of the water on surface grains, over the "
                    f"submerged weight of a grain of mean diameter, {up} on dune {pair[0]}, {down} on dune {pair[1]} "
                    f"downstream; at the upstream end {ends[0]} and {ends[1]}")
    for name, foreign, amid in zip(pair, found.foreign, found.amid):
        told.append(f"dune {name}: {100 * foreign[-1]:.1f} % of its first grains are in the other dune by name at the "
                    f"end, {100 * amid[-1]:.1f} % lie amid more grains of the other")
    return told


def mean_of(values):
    """With its 95 % interval."""
    known = values[np.isfinite(values)]
    if len(known) < 2:
        return "not known"
    found = spread(known.tolist())
    return f"{found.mean:.3f} +- {found.interval:.3f}"


def keep_tables(figure, found):
    sides = "upstream", "downstream"
    keep(figure, "encounter_forces", {
        "t": found.t, "touching": found.touching,
        **{f"force_{side}": values for side, values in zip(sides, found.force)},
        **{f"foreign_{side}": values for side, values in zip(sides, found.foreign)},
        **{f"amid_{side}": values for side, values in zip(sides, found.amid)},
        **{f"force_end_{side}": values for side, values in zip(sides, found.end)}}, most=None)
    rows = []
    for number, one in enumerate(found.maps):
        x, z = (0.5 * (edges[1:] + edges[:-1]) for edges in one.edges)
        for i, k in np.argwhere(one.n > 0):
            rows.append((number, one.start, one.end, x[i], z[k], one.n[i, k], one.force[i, k], *one.cover[:, i, k]))
    names = "map", "t_start", "t_end", "x", "z", "n", "force", "cover_upstream", "cover_downstream"
    keep(figure, "encounter_force_maps", dict(zip(names, zip(*rows))), most=None)
