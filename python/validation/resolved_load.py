"""resolved_load: bed load with every grain resolved, and the same beds with the layered exchange.

`--keep` takes the folder of the runs of configs/validation/resolved-load-study.toml and resolved-laminar*.toml,
runs/validation. A row is the second half of a run. Shields number and q* are those of bedload.csv (bed_surface.py). Of
runs without it the Shields number is that of the force of the water on all grains under a lid, else that of
laminar_bed; q* = q / sqrt((s - 1) g d^3), with the volume flux q less what the lowest layer carries, which slides on
the smooth floor. q_v/q_f is that of laminar_bed. A grain moves when it is faster than MOVES sqrt((s - 1) g d).
"""

from pathlib import Path

import numpy as np

from barchan import Run
from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.study_folder import gap_of
from validation import bed_load, bed_surface, laminar_bed, tables

NAME = "resolved_load"
COLUMNS = "case,seconds,shields,q_star,deviation,moving,speed,ratio"
MOVES = 0.1
LAMINAR = {"resolved-laminar": "A9", "resolved-laminar-slow": "A1", "resolved-laminar-layered": "layered-A9",
           "resolved-laminar-slow-layered": "layered-A1"}
SCHEMES = {"resolved": ("o", style.BLUE), "layered": ("^", style.VERMILLION)}


class Scales:
    """What makes the numbers of a run dimensionless: d, sqrt((s - 1) g d), stress."""

    def __init__(self, config, diameters):
        self.d, fluid = np.mean(diameters), config["fluid"]["density"]
        excess = config["grains"]["density"] / fluid - 1
        self.speed = np.sqrt(excess * np.linalg.norm(config["grains"]["gravity"]) * self.d)
        self.stress = fluid * self.speed**2
        self.area = config["domain"]["size"][0] * config["domain"]["size"][2]


def flux(x, u, d, scales):
    """q* of grains at x with velocities u, without that of a bed which slides as a whole."""
    sliding = np.mean(u[x[:, 1] < d, 0])
    return np.sum(np.pi / 6 * d**3 * (u[:, 0] - sliding)) / scales.area / (scales.speed * scales.d)


def movers(u, scales):
    """Grains that move, on d^2 of the floor, and their mean speed over sqrt((s - 1) g d)."""
    fast = u[:, 0][u[:, 0] > MOVES * scales.speed] / scales.speed
    return len(fast) * scales.d**2 / scales.area, np.mean(fast) if len(fast) else 0.0


def measure(run):
    file = run.need_grains()
    frames = [run.frame(frame) for frame, t in enumerate(file.times) if t > file.times[-1] / 2]
    if len(frames) < laminar_bed.BLOCKS:
        raise MissingData(f"needs {laminar_bed.BLOCKS} frames of grains in the second half of {run.path}")
    scales, of_bed = Scales(run.config, frames[0].d), laminar_bed.Scales.of(run)
    late = run.history_columns["t"] > file.times[-1] / 2
    bulk, stress = (np.mean(run.history_columns[name][late]) for name in ("bulk_velocity", "stress_on_grains"))
    resolved = run.config["coupling"]["scheme"] == "resolved"  # its box has water and grains
    water = bulk * of_bed.height if resolved else of_bed.fluid_flux(bulk)
    bed = laminar_bed.surface_of(frames, of_bed)
    shields = stress / scales.stress if run.config["fluid"].get("top_velocity") else of_bed.shields(
        water / of_bed.viscosity, of_bed.height - bed)
    by_rule = bed_surface.of(run)
    carried = [flux(*(np.asarray(part, float) for part in (one.x, one.u, one.d)), scales) for one in frames]
    moving, speed = np.mean([movers(one.u, scales) for one in frames], axis=0)
    by_velocity = np.mean([laminar_bed.velocity_flux(one, bed, scales.d / 2) for one in frames])
    q_star, deviation = laminar_bed.mean_and_deviation(carried)
    if by_rule.known:
        shields, q_star = by_rule.shields, by_rule.q_star
    return (file.times[-1] / 2, shields, q_star, deviation, moving, speed, by_velocity / water)


def finished(runs):
    """Name and run of each that is done."""
    lid = sorted(runs.glob("resolved-load-study/*/"))
    for path, name in [(path, path.name) for path in lid] + [(runs / folder, name) for folder, name in LAMINAR.items()]:
        if gap_of(path) is None:
            yield name, Run(path)


def save(runs, folder):
    """Keeps a row for each finished run as resolved_load.csv; its path."""
    found = list(finished(Path(runs)))
    if not found:
        raise MissingData(f"needs a finished run of resolved-load-study or resolved-laminar in {runs}")
    return tables.keep(folder / f"{NAME}.csv", "Bed load with every grain resolved",
                       "./barchan sweep configs/validation/resolved-load-study.toml (and the cases resolved-laminar*)",
                       found[-1][1].summary,
                       [COLUMNS, *(f"{name},{bed_load.as_row(measure(run))}" for name, run in found)])


def of_scheme(table, scheme):
    """The rows of a scheme by Shields number, of grains under a lid: their names are numbers."""
    rows = table.only([name.removeprefix("layered-").replace(".", "").isdigit()
                       and name.startswith("layered-") == (scheme == "layered") for name in table["case"]])
    return rows.only(np.argsort(rows["shields"])) if len(rows["case"]) else rows


def summary(folder):
    """Lines `case | seconds | Shields | q* +- deviation | moving grains on d^2 | their speed | q_v/q_f`."""
    table = tables.read_saved(folder, NAME)
    for row in zip(*(table[name] for name in COLUMNS.split(","))):
        yield "{} | {:.2g} | {:.3f} | {:.2g} +- {:.1g} | {:.3f} | {:.2f} | {:.2g}".format(*row)


def draw(folder):
    table = tables.read_saved(folder, NAME)
    figure, (panels,) = style.panels(None, 1, 3, figsize=(style.FULL_WIDTH, 2.5))
    for scheme, (marker, colour) in SCHEMES.items():
        rows = of_scheme(table, scheme)
        look = {"marker": marker, "ms": 4, "color": colour, "lw": 0.8, "label": scheme}
        panels[0].errorbar(rows["shields"], rows["q_star"], yerr=rows["deviation"], capsize=2, **look)
        panels[1].plot(rows["shields"], rows["moving"], **look)
        panels[2].plot(rows["shields"], rows["speed"], **look)
    panels[0].set(yscale="log", ylim=(3e-4, 1), ylabel="$q*$")
    panels[1].set(ylabel="moving grains on $d^2$")
    panels[2].set(ylabel=r"speed over $\sqrt{(s-1) g d}$", ylim=(0, None))
    panels[0].axvspan(*(bed_load.LAMINAR_THRESHOLD[0] + sign * bed_load.LAMINAR_THRESHOLD[1] for sign in (-1, 1)),
                      color="0.9")
    panels[0].legend(fontsize=6)
    for index, axes in enumerate(panels):
        axes.set(xlabel="Shields number", xlim=(0, None))
        style.panel_label(axes, index)
    return figure
