"""forces_on_bodies: force of the water and of the grains on each body, along x and upwards, against time.

Lines are means over output.history_interval (bodies.csv). The legend has mean and standard deviation of the second half
of the run, or of the window of --from and --to; the sentences have the drag coefficient with the bulk velocity and the
area that a body shows to the stream.
"""

import numpy as np

from barchan.dune import body_forces
from barchan.dune.body_forces import OF_GRAINS, OF_WATER
from barchan.figures import style
from barchan.figures.result import keep, say
from barchan.io.study_folder import plain
from barchan.io.tables import thin
from barchan.stats import in_window

COLOURS = (style.BLUE, style.VERMILLION, style.GREEN, style.ORANGE, style.PURPLE, style.SKY, style.BLACK, style.GREY)
LABELS = {"x": "force along $x$", "y": "force upwards, $y$"}


def draw(run, ax=None, start=None, end=None):
    found = body_forces.mean_forces(run, start, end)
    bodies = list(dict.fromkeys(force.body for force in found))
    scale, unit = unit_of(found)
    figure, (panels,) = style.panels(ax, 1, 2, figsize=(style.FULL_WIDTH, 2.6 + 0.28 * len(bodies)))
    t = run.body_columns[bodies[0].number]["t"]
    chosen = t[in_window(t, start, end)]
    for index, (axes, axis) in enumerate(zip(panels, "xy")):
        for force in found:
            if force.axis == axis:
                draw_force(axes, run, force, scale, unit, len(bodies) > 1)
        axes.axvspan(chosen[0], chosen[-1], color=style.GREY, alpha=0.12, lw=0)
        axes.axhline(0, color=style.BLACK, lw=0.5)
        axes.set(xlabel="$t$ (s)", ylabel=f"{LABELS[axis]} ({unit})", xlim=(t[0], t[-1]))
        axes.legend(loc="lower left", bbox_to_anchor=(0.07, 1.0), borderaxespad=0.1)
        style.panel_label(axes, index)
    say(figure, body_forces.sentences(run, found))
    keep_tables(figure, run, found)
    return figure


def unit_of(found):
    """(factor, name) that make the largest force a readable number."""
    largest = max((abs(force.mean) + force.deviation for force in found if np.isfinite(force.mean)), default=0.0)
    return next(((1 / size, name) for size, name in ((1.0, "N"), (1e-3, "mN"), (1e-6, "µN")) if largest >= size),
                (1e6, "µN"))


def draw_force(axes, run, force, scale, unit, several):
    table = run.body_columns[force.body.number]
    rows = thin(len(table["t"]))
    name = f"{plain(force.body.name)}, {force.of}" if several else force.of
    colour = COLOURS[force.body.number % len(COLOURS)]
    axes.plot(table["t"][rows], scale * table[body_forces.column(force.of, force.axis)][rows], color=colour,
              ls="-" if force.of == OF_WATER else (0, (4, 1.5)), lw=1.0, alpha=1.0 if force.of == OF_WATER else 0.7,
              label=f"{name}: {scale * force.mean:.3g} ± {scale * force.deviation:.2g} {unit}")


def keep_tables(figure, run, found):
    """mean_forces_on_bodies: a line for each body; forces_on_bodies: what is drawn."""
    bodies = list(dict.fromkeys(force.body for force in found))
    of = {(force.body, force.of, force.axis): force for force in found}
    means = {"body": [body.number for body in bodies], "name": [body.name for body in bodies]}
    for kind in (OF_WATER, OF_GRAINS):
        for axis in "xy":
            name = body_forces.column(kind, axis)
            means[name] = [of[body, kind, axis].mean for body in bodies]
            means[f"{name}_deviation"] = [of[body, kind, axis].deviation for body in bodies]
    means["drag_coefficient"] = [body_forces.drag_coefficient(run, of[body, OF_WATER, "x"]) for body in bodies]
    keep(figure, "mean_forces_on_bodies", means)
    names = ["t", "body"] + [body_forces.column(kind, axis) for kind in (OF_WATER, OF_GRAINS) for axis in "xy"]
    keep(figure, "forces_on_bodies", {name: np.concatenate([run.body_columns[body.number][name] for body in bodies])
                                      for name in names}, most=None)
