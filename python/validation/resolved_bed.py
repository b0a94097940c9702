"""resolved_bed: what each grain at the surface of a frozen bed feels, with the flow resolved around it and with the
layered exchange, from the runs of configs/validation/resolved-bed-study.toml.

Forces are over tau d^2, torques over tau d^3; d is the mean diameter, tau the force along x on all grains over the area
of the bed. The depth of a grain counts from the highest top within d along the floor to its own. A grain begins to
move where the moments of force, torque and weight about an axis through two of its contacts balance, if no other
contact holds it; force and torque go with the Shields number.
"""

from itertools import combinations

import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from validation import bed_load, tables

NAME = "resolved_bed"
KEYS = 5  # the first columns: which grain of which bed, in which exchange
QUANTITIES = "drag", "lift", "torque", "threshold"
COLUMNS = ",".join(["top_velocity,realisation,row_height,smoothing_length,id,depth",
                    *QUANTITIES, *(f"resolved_{name}" for name in QUANTITIES), "threshold_by_drag"])
SURFACE = 0.75  # of depth, in d
CLASSES = {"exposed": (-1, 0.02), "sheltered": (0.02, 0.25), "beside": (0.25, SURFACE)}
TOUCHES = 1.03  # of the sum of the radii
OF_WATER = "force_flow", "force_drag", "force_pressure_gradient", "force_stress", "force_lift"
QUANTILES = 0.05, 0.1, 0.25, 0.5


class Bed:
    """Grains of the last frame of a run, by id; the box is periodic along x and z."""

    def __init__(self, run):
        config, names = run.config, ("id", "x", "d", "torque_flow", *OF_WATER)
        file = run.frame_file("grains.h5", ("id", "x", "d", "torque_flow"))
        if file is None:
            raise MissingData(f"needs grains.h5 with forces and torques in {run.path}")
        with file.open() as content:
            group = content[file.frames[-1][1]]
            order = np.argsort(group["id"][:])
            values = {name: group[name][:][order].astype(float) for name in names if name in group}
        length, _, width = config["domain"]["size"]
        self.id, self.x, self.d = values["id"].astype(int), values["x"], values["d"]
        self.force, self.torque = sum(values[name] for name in OF_WATER if name in values), values["torque_flow"]
        self.period = np.array([length, np.inf, width])
        fluid, grains = config["fluid"], config["grains"]
        self.excess = (grains["density"] - fluid["density"]) * np.linalg.norm(grains["gravity"])
        self.size, self.stress = np.mean(self.d), np.sum(self.force[:, 0]) / (length * width)

    def between(self, g):
        """From grain g to all, the nearest image [m]."""
        offset = self.x - self.x[g]
        return offset - np.where(np.isinf(self.period), 0, self.period) * np.round(offset / self.period)

    def depth(self):
        """[m]"""
        top = self.x[:, 1] + self.d / 2
        near = [np.hypot(*self.between(g)[:, [0, 2]].T) < self.size for g in range(len(top))]
        return np.array([top[around].max() for around in near]) - top

    def threshold(self, g, torque):
        """Shields number at which force and torque turn grain g downstream over two of its contacts; nan: none."""
        offset = self.between(g)
        distance = np.linalg.norm(offset, axis=1)
        near = np.flatnonzero((distance < TOUCHES * (self.d + self.d[g]) / 2) & (distance > 0))
        normal, radius = offset[near] / distance[near, None], self.d[g] / 2
        weight = np.array([0, -self.excess * np.pi / 6 * self.d[g]**3, 0])
        found = []
        for first, second in combinations(range(len(near)), 2):
            axis, arm = normal[second] - normal[first], -radius * normal[first]
            axis /= np.linalg.norm(axis)
            driving, holding = axis @ (np.cross(arm, self.force[g]) + torque), axis @ np.cross(arm, weight)
            motion = np.sign(driving) * np.cross(axis, arm)
            opens = np.delete(normal, [first, second], axis=0) @ motion <= 1e-3 * radius
            if driving * holding < 0 and motion[0] > 0 and np.all(opens):
                found.append(-holding / driving)
        return min(found, default=np.nan) * self.stress / (self.excess * self.size)

    def quantities(self, g):
        over = self.stress * self.size**2
        return (self.force[g, 0] / over, self.force[g, 1] / over, -self.torque[g, 2] / (over * self.size),
                self.threshold(g, self.torque[g]))


def rows_of(layered, resolved):
    """A row for each surface grain."""
    here, there, config = Bed(layered), Bed(resolved), layered.config
    if not np.array_equal(here.x, there.x):
        raise MissingData(f"needs the same grains in {layered.path} and {resolved.path}")
    depth = here.depth() / here.size
    setting = (config["fluid"]["top_velocity"], config["initial"]["realisation"],
               config["domain"]["size"][1] / config["fluid"]["cells"][1] / here.size,
               config["coupling"]["smoothing_length"] / here.size)
    for g in np.flatnonzero(depth < SURFACE):
        yield (*setting, here.id[g], depth[g], *here.quantities(g), *there.quantities(g),
               here.threshold(g, np.zeros(3)))


def bed_of(run):
    """Flow and packing, which the schemes share."""
    return run.config["fluid"]["top_velocity"], run.config["initial"]["realisation"]


def save(study_path, folder):
    """Keeps a row for each surface grain of the finished runs as resolved_bed.csv; its path."""
    study, runs = bed_load.finished(study_path)
    is_resolved = [run.config["coupling"]["scheme"] == "resolved" for _, run in runs]
    resolved = {bed_of(run): run for (_, run), yes in zip(runs, is_resolved) if yes}
    pairs = [(run, resolved[bed_of(run)]) for (_, run), yes in zip(runs, is_resolved)
             if not yes and bed_of(run) in resolved]
    if not pairs:
        raise MissingData(f"needs a bed in {study_path} that is resolved and under another exchange")
    path = folder / f"{NAME}.csv"
    said, rows = bed_load.with_earlier(
        path, bed_load.notes(study, "configs/validation/resolved-bed-study.toml", runs[0][1]),
        [bed_load.as_row(row) for pair in pairs for row in rows_of(*pair)], KEYS)
    tables.write(path, said, [COLUMNS, *sorted(rows, key=lambda row: bed_load.key_of(row, KEYS))])
    return path


def settings(table):
    """Each flow and exchange of a table, (top velocity, row height, smoothing length), with its rows."""
    columns = [np.round(table[name], 2) for name in ("top_velocity", "row_height", "smoothing_length")]
    for values in sorted(set(zip(*(column.tolist() for column in columns)))):
        yield values, table.only(np.all([column == value for column, value in zip(columns, values)], axis=0))


def beside(resolved, layered):
    """Both means, and how the grains of both go together."""
    spreads = np.std(resolved), np.std(layered)
    together = np.cov(resolved, layered, bias=True)[0, 1] / np.prod(spreads) if all(spreads) else np.nan
    return f"{np.mean(resolved):.2f}, {np.mean(layered):.2f}, {together:.2f}"


def summary(folder):
    """Lines `top velocity, row height, smoothing | class | grains | drag, torque, lift: resolved, layered, correlation`,
    and the quantiles of the thresholds of grains that can turn: resolved, layered, by drag and lift alone."""
    table = tables.read_saved(folder, NAME)
    for values, rows in settings(table):
        setting = ", ".join(f"{value:g}" for value in values)
        for name, (above, below) in CLASSES.items():
            of_class = rows.only((rows["depth"] >= above) & (rows["depth"] < below))
            if not len(of_class["id"]):
                continue
            parts = [beside(of_class[f"resolved_{what}"], of_class[what]) for what in ("drag", "torque", "lift")]
            yield " | ".join([setting, name, str(len(of_class["id"])), *parts])
        for what in ("resolved_threshold", "threshold", "threshold_by_drag"):
            turns = np.isfinite(rows[what])
            found = ", ".join(f"{value:.3f}" for value in np.quantile(rows[what][turns], QUANTILES))
            yield f"{setting} | {what} | {np.sum(turns)} | {found}"


def draw(folder):
    table = tables.read_saved(folder, NAME)
    usual = table.where("row_height", table["row_height"].max()).where("smoothing_length", table["smoothing_length"][0])
    figure, (panels,) = style.panels(None, 1, 4, figsize=(style.FULL_WIDTH, 2.1))
    for axes, (what, label) in zip(panels, (("drag", r"$F_x/(\tau d^2)$"), ("torque", r"$T_z/(\tau d^3)$"),
                                            ("lift", r"$F_y/(\tau d^2)$"))):
        for (name, (above, below)), colour in zip(CLASSES.items(), (style.VERMILLION, style.BLUE, style.GREEN)):
            inside = (usual["depth"] >= above) & (usual["depth"] < below)
            axes.plot(usual[f"resolved_{what}"][inside], usual[what][inside], ls="", marker=".", ms=2.5, mew=0,
                      color=colour, label=name, rasterized=True)
        ends = np.array([min(usual[what].min(), 0), usual[f"resolved_{what}"].max()])
        axes.plot(ends, ends, color="k", lw=0.7)
        axes.set(xlabel=f"{label}, resolved")
    panels[0].set_ylabel("layered")
    panels[0].legend(fontsize=6, markerscale=2)
    part = np.linspace(0, 1, 200)[1:-1]
    for what, label, dashes in (("resolved_threshold", "resolved", "-"), ("threshold", "layered", "--"),
                                ("threshold_by_drag", "without torque", ":")):
        panels[3].plot(np.nanquantile(usual[what], part), part, color="k", lw=0.9, ls=dashes, label=label)
    panels[3].set(xscale="log", xlim=(0.02, 2), xlabel="threshold of a grain", ylabel="part of the grains")
    panels[3].yaxis.tick_right()
    panels[3].yaxis.set_label_position("right")
    panels[3].legend(fontsize=6, loc="lower right")
    for index, axes in enumerate(panels):
        style.panel_label(axes, index)
    return figure
