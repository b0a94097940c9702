"""scour: depth of the deepest point of the bed around each body against time, in its diameters; the bed at the end.

The depth is below the far bed, within one diameter of the body. The map shows the height over the far bed at the last
frame, the cross the deepest point. Definitions: docs/dune-measures.md, "Scour".
"""

import numpy as np

from barchan.dune.body_forces import need_bodies
from barchan.dune.scour import COVERED, BedMap, diameter, history
from barchan.dune.shape import BIN
from barchan.dune.tracks import bed_of
from barchan.errors import MissingData
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.figures.forces_on_bodies import COLOURS
from barchan.figures.result import keep, say
from barchan.io.study_folder import plain
from barchan.io.tables import thin

MOST = 400  # frames


def draw(run, ax=None):
    bodies = tuple(body for body in need_bodies(run, "a bed in grains.h5") if body.shape != "wave")
    if not bodies:
        raise MissingData("needs a [[body]] that is no wave in the case, and a bed in grains.h5")
    file, bed = run.need_grains(), bed_of(run)
    chosen = thin(len(file.frames), MOST)
    frames = (run.frame(index) for index in chosen.tolist())
    maps = {float(grains.time): BedMap(grains, bed, bodies) for grains in frames if len(grains.d)}
    times = list(maps)
    if not maps or maps[times[0]].covered < COVERED:
        raise MissingData(f"needs a bed in grains.h5 that covers {100 * COVERED:.0f} % of the floor at first")
    histories = {body: history(maps, body) for body in bodies}
    histories = {body: found for body, found in histories.items() if found}
    if not histories:
        raise MissingData("needs a bed in grains.h5 within a diameter of a body")
    figure, ((depths, plan),) = style.panels(ax, 1, 2, figsize=(style.FULL_WIDTH, 2.6), width_ratios=(1, 1.3))
    for body, found in histories.items():
        t, share = [one.t for one in found], [one.depth / diameter(body) for one in found]
        depths.plot(t, share, color=COLOURS[body.number % len(COLOURS)], marker=style.mark_if_few(t), label=plain(body.name))
    depths.axhline(0, color=style.BLACK, lw=0.5)
    depths.set(xlabel="$t$ (s)", ylabel="scour depth $/D$")
    if len(times) > 1:
        depths.set_xlim(times[0], times[-1])
    if len(histories) > 1:
        depths.legend()
    draw_map(figure, plan, maps[times[-1]], bodies, histories)
    plan.set_title(f"$t$ = {times[-1]:.3g} s", pad=3)
    for index, axes in enumerate((depths, plan)):
        style.panel_label(axes, index)
    say(figure, sentences(histories))
    keep_table(figure, histories)
    return figure


def draw_map(figure, axes, bed, bodies, histories):
    over = 1e3 * (bed.h - bed.far)
    most = max(-float(np.nanmin(over)), 1e3 * float(bed.size.min()) / BIN)  # grains in suspension may be far higher
    edges = [1e3 * np.append(0.0, centres + 0.5 * size) for centres, size in zip((bed.x, bed.z), bed.size)]
    image = axes.pcolormesh(*edges, np.ma.masked_invalid(over).T, vmin=-most, vmax=most, cmap=style.FORCE_MAP,
                            rasterized=True)
    body_pictures.draw_plan(axes, bodies, named=True, fill=True)
    for found in histories.values():
        axes.plot(1e3 * found[-1].x, 1e3 * found[-1].z, "x", color=style.BLACK, ms=5, zorder=4)
    axes.set(aspect="equal", xlabel="$x$ (mm)", ylabel="$z$ (mm)", xlim=edges[0][[0, -1]], ylim=edges[1][[-1, 0]])
    bar = figure.colorbar(image, ax=axes, location="bottom", aspect=30, pad=0.02,
                          extend="max" if np.nanmax(over) > most else "neither")
    bar.set_label("height over the far bed (mm)")
    bar.outline.set_linewidth(0.6)


def sentences(histories):
    told = []
    for body, found in histories.items():
        last, deepest = found[-1], max(found, key=lambda one: one.depth)
        size = diameter(body)
        floor = "; the floor is bare there" if last.bare else ""
        told.append(f"{body.name}: scour depth {last.depth / size:.2f} D at the end (D = {1e3 * size:.3g} mm), at "
                    f"{last.angle:.0f} degrees (0: downstream, 90: left){floor}; deepest {deepest.depth / size:.2f} D "
                    f"at {deepest.t:.3g} s")
    return told


def keep_table(figure, histories):
    rows = [(one.t, body.number, one.depth, one.depth / diameter(body), one.far, one.x, one.z, one.angle, one.bare)
            for body, found in histories.items() for one in found]
    names = ("t", "body", "depth", "depth_over_diameter", "far_bed", "x", "z", "angle", "bare")
    keep(figure, "scour", dict(zip(names, zip(*rows))), most=None)
