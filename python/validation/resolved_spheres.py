"""resolved_spheres: spheres that move in a resolved flow, beside measurements and other simulations, from the runs of
configs/validation/resolved-*.toml. `--keep` takes the folder of these runs, runs/validation.

Lengths are in diameters. A rebound is the speed upwards at a gap of 0.1 d over the largest one downwards, and over the
restitution without water; 0: the sphere does not come so high.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import gap_of
from barchan.io.tables import thin
from validation import by_id, planes, tables

NAME = "resolved_spheres"
COLUMNS = "what,case,x,y"
PICTURES = 16, 22, 28, 34  # times of the pictures of two spheres, over sqrt(d/g)
GAP = 0.1  # at which a rebound is measured
SETTLING = 0.0360, 0.0572, 0.0873, 0.1222  # ten Cate et al. (2002) [m/s]
SINKING = {"Ga144": 1.285, "Re100": 1.108, "Re50": 0.920, "Re10": 0.560}  # Uhlmann & Dusek (2014), Clift et al. (1978)
KISS, LEVEL = (18.0, 18.3), 32.9  # FeatFloWer: the spheres touch; one is beside the other
SMALL = 0.6  # distance of small spheres from the middle of a channel, Ho & Leal (1974)


class Tracks:
    """Times (n) and the places, velocities and spins (n, grains, 3) of the grains of a run, by id."""

    def __init__(self, run):
        file = run.need_grains()
        self.x, self.u, self.omega, _ = by_id.motion(file)
        self.t, self.size = file.times, run.config["domain"]["size"]
        self.grains, self.fluid = run.config["grains"], run.config["fluid"]
        self.d = self.grains["sizes"][0][0] if self.grains.get("sizes") else run.frame(0).d[0]
        self.gravity = abs(self.grains["gravity"][1])


def settling(tracks):
    yield "settling", tracks.t, -tracks.u[:, 0, 1]


def sinking(tracks):
    unit = np.sqrt((tracks.grains["density"] / tracks.fluid["density"] - 1) * tracks.gravity * tracks.d)
    yield "sinking", tracks.t * unit / tracks.d, -tracks.u[:, 0, 1] / unit


def rebound(tracks):
    speed, gap = tracks.u[:, 0, 1], tracks.x[:, 0, 1] / tracks.d - 0.5
    lowest = int(np.argmin(gap[:np.argmin(speed) + np.argmax(speed[np.argmin(speed):]) + 1]))
    rise = slice(lowest, lowest + int(np.argmax(gap[lowest:])) + 1)
    after = np.interp(GAP, gap[rise], speed[rise]) if gap[rise][-1] > GAP else 0.0
    stokes = tracks.grains["density"] * tracks.d * -speed.min() / (9 * tracks.fluid["density"] *
                                                               tracks.fluid["kinematic_viscosity"])
    yield "rebound", np.array([stokes]), np.array([-after / speed.min() / tracks.grains["restitution"]])


def tumbling(tracks):
    apart, unit = tracks.x[:, 1] - tracks.x[:, 0], np.sqrt(tracks.d / tracks.gravity)
    for axis in (0, 2):
        apart[:, axis] -= tracks.size[axis] * np.round(apart[:, axis] / tracks.size[axis])
    distance = np.linalg.norm(apart, axis=1)
    yield "distance", tracks.t / unit, distance / tracks.d
    yield "tilt", tracks.t / unit, np.degrees(np.arccos(apart[:, 1] / distance))


def migration(tracks):
    half = tracks.size[1] / 2
    yield "migration", tracks.t, abs(tracks.x[:, 0, 1] - half) / half


def shear(tracks):
    rate = tracks.fluid["top_velocity"] / tracks.size[1]
    yield "shear", tracks.t * rate, -tracks.omega[:, 0, 2] / rate


MEASURED = {"settling-study": settling, "sinking-study": sinking, "rebound-study": rebound, "tumbling": tumbling,
            "migration-study": migration, "shear-study": shear}


def save(runs, folder):
    """Keeps the curves of the finished runs as resolved_spheres.csv; its path. Draws the two spheres, tumbling.png."""
    lines = []
    for name, measure in MEASURED.items():
        for file in sorted(Path(runs).glob(f"resolved-{name}/**/grains.h5")):
            if gap_of(file.parent):
                continue
            run = RunFolder(file.parent)
            for what, x, y in measure(Tracks(run)):
                lines += [f"{what},{file.parent.name},{x[n]:.5g},{y[n]:.5g}" for n in thin(len(x), 60)]
    if not lines:
        raise MissingData(f"needs a finished run of a study resolved-* in {runs}")
    pair = Path(runs) / "resolved-tumbling"
    if (pair / "fields.h5").exists():
        figure = draw_pair(RunFolder(pair), Figure(figsize=(style.FULL_WIDTH, 2.9), layout="constrained"))
        style.save(figure, folder, "tumbling", "Barchan, validation")
    return tables.keep(folder / f"{NAME}.csv", "Spheres in a resolved flow",
                       "./barchan sweep (the studies resolved-*)", run.summary, [COLUMNS, *lines])


def draw_pair(run, figure):
    """The flow around two spheres in the plane through both at four times: speed over sqrt(g d) and streamlines."""
    tracks, panels = Tracks(run), figure.subplots(1, len(PICTURES))
    unit = np.sqrt(tracks.gravity * tracks.d)
    for axes, wanted in zip(panels, PICTURES):
        frame = int(np.argmin(abs(run.need_fields().times * unit / tracks.d - wanted)))
        time = run.field_file.times[frame]
        x = tracks.x[np.argmin(abs(tracks.t - time))]
        flow, middle = run.flow_plane(frame, x[:, 2].mean()), x[:, 1].mean() / tracks.d
        seen = abs(flow.y / tracks.d - middle - 1.5) < 5
        u, v = flow.u[seen] / unit, flow.v[seen] / unit
        across, up = flow.x / tracks.d, flow.y[seen] / tracks.d
        image = planes.draw(axes, across, up, u, v, density=0.9, largest=0.55)
        for place, colour in zip(x / tracks.d, (style.VERMILLION, style.ORANGE)):
            axes.add_patch(Circle(place[:2], 0.5, fc=colour, ec="k", lw=0.6, zorder=5))
        axes.set_title(rf"$t$ = {time * unit / tracks.d:.1f} $\sqrt{{d/g}}$", pad=3)
    panels[0].set_ylabel("$y/d$")
    figure.colorbar(image, ax=panels, shrink=0.7, pad=0.02).set_label(r"speed over $\sqrt{g d}$")
    return figure


def summary(folder):
    """Lines `what, case | largest value | last value`."""
    table = tables.read_saved(folder, NAME)
    for what in table.values("what"):
        for case in table.where("what", what).values("case"):
            curve = table.where("what", what).where("case", case)
            yield f"{what}, {case} | x {curve['x'][-1]:.4g} | {curve['y'].max():.4g} | {curve['y'][-1]:.4g}"


def draw(folder):
    table = tables.read_saved(folder, NAME)
    figure, (panels,) = style.panels(None, 1, 4, figsize=(style.FULL_WIDTH, 2.1))
    sinks, bounces, kisses, drifts = panels
    for case, expected in SINKING.items():
        curve = table.where("what", "sinking").where("case", case)
        line, = sinks.plot(curve["x"], curve["y"], lw=0.9, label=case)
        sinks.plot(20.5, expected, marker="o", ms=4, mfc="none", color=line.get_color())
    sinks.set(xlabel=r"$t\,u_g/d$", ylabel=r"$v/u_g$", ylim=(0, 1.4))
    sinks.legend(fontsize=6, loc="lower right")
    for case, marker in (("", "o"), ("-fine", "s"), ("-light", "^"), ("-no-film", "x"), ("-smooth", "v")):
        points = table.where("what", "rebound")
        points = points.only([(name.endswith(case) if case else name.count("-") == 1) for name in points["case"]])
        bounces.plot(points["x"], points["y"], ls="", marker=marker, ms=4, label=case.strip("-") or "film")
    stokes = np.geomspace(5, 1000, 100)
    bounces.plot(stokes, np.exp(-35 / stokes), color="k", lw=0.9, label="measured, fit")
    bounces.set(xscale="log", xlabel="St", ylabel="rebound over dry", ylim=(0, 1))
    bounces.legend(fontsize=5, loc="upper left", borderpad=0.2)
    for what, axes, colour in (("distance", kisses, style.BLUE), ("tilt", kisses.twinx(), style.VERMILLION)):
        curve = table.where("what", what).where("case", "resolved-tumbling")
        axes.plot(curve["x"], curve["y"], lw=0.9, color=colour)
        axes.set_ylabel({"distance": "distance ($d$)", "tilt": "tilt (degrees)"}[what], color=colour)
    kisses.axvspan(*KISS, color="0.85")
    kisses.axvline(LEVEL, color="0.85")
    kisses.set(xlabel=r"$t/\sqrt{d/g}$")
    for case in ("inner", "outer"):
        curve = table.where("what", "migration").where("case", case)
        drifts.plot(curve["x"], curve["y"], lw=0.9, label=case)
    drifts.axhline(SMALL, color="k", lw=0.7, ls=":")
    drifts.set(xlabel="$t$ (s)", ylabel="from the middle", ylim=(0, 1))
    for index, axes in enumerate(panels):
        style.panel_label(axes, index)
    return figure
