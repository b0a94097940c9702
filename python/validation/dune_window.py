"""dune_window: what grains of a dune feel, resolved and not, in windows cut out of it.

The runs are those of resolved-window-study.toml: places of a dune, resolved, and the same windows with the layered
exchange, with the forces of the paper and with all. `--keep` takes their folder.

Forces of the water along x and upwards, means over SPAN, are over the submerged weight of the mean grain. Grains nearer
than two diameters to the sides of the window, which do not match, are left out. The depth of a grain counts from the
highest top within d along the floor to its own.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Circle

from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import gap_of
from validation import planes, tables

NAME = "dune_window"
COLUMNS = "place,id,depth,resolved_x,resolved_y,paper_x,paper_y,complete_x,complete_y"
PLACES = "stoss", "crest", "horn", "fine"
SPAN = 0.002, 0.005  # [s]; before, the flow finds its way between the grains
MARGIN = 2  # diameters from the sides
CLASSES = {"exposed": (-1, 0.1), "sheltered": (0.1, 0.5), "deeper": (0.5, 9)}
OF_WATER = "force_flow", "force_drag", "force_pressure_gradient", "force_stress", "force_added_mass", "force_lift"


class Grains:
    """Grains of a run by id: places and diameters at the start of SPAN, mean force of the water over it [N]."""

    def __init__(self, path):
        self.run, forces = RunFolder(path), []
        file = self.run.need_grains()
        with file.open() as content:
            for time, name in file.frames:
                if not SPAN[0] - 1e-9 < time < SPAN[1] + 1e-9:
                    continue
                group = content[name]
                order = np.argsort(group["id"][:])
                if not forces:
                    self.id, self.x, self.d = (group[what][:][order] for what in ("id", "x", "d"))
                parts = [group[what][:][order].astype(float) for what in OF_WATER if what in group]
                forces.append(dict(zip(group["id"][:][order].tolist(), sum(parts))))
        if not forces:
            raise MissingData(f"needs frames of grains between {SPAN[0]} and {SPAN[1]} s in {path}")
        kept = [n for n, i in enumerate(self.id.tolist()) if all(i in one for one in forces)]
        self.id, self.x, self.d = self.id[kept], self.x[kept], self.d[kept]
        self.force = np.array([np.mean([one[i] for one in forces], axis=0) for i in self.id.tolist()])

    def inside(self):
        length, _, width = self.run.config["domain"]["size"]
        margin = MARGIN * np.mean(self.d)
        x, z = self.x[:, 0], self.x[:, 2]
        return (x > margin) & (x < length - margin) & (z > margin) & (z < width - margin)

    def depth(self):
        """Over the mean diameter."""
        top, d = self.x[:, 1] + self.d / 2, np.mean(self.d)
        apart = np.hypot(*(self.x[:, None, axis] - self.x[None, :, axis] for axis in (0, 2)))
        return (np.where(apart < d, top[None, :], 0).max(axis=1) - top) / d


def rows_of(place, resolved, others):
    config = resolved.run.config
    excess = (config["grains"]["density"] - config["fluid"]["density"]) * np.linalg.norm(config["grains"]["gravity"])
    weight, depth = excess * np.pi / 6 * np.mean(resolved.d)**3, resolved.depth()
    known = [dict(zip(other.id.tolist(), other.force / weight)) for other in others]
    for n in np.flatnonzero(resolved.inside()):
        i = int(resolved.id[n])
        if all(i in one for one in known):
            forces = [resolved.force[n] / weight, *(one[i] for one in known)]
            yield ",".join([place, str(i), f"{depth[n]:.3f}", *(f"{f[axis]:.4f}" for f in forces for axis in (0, 1))])


def save(study_path, folder):
    """Keeps a row for each grain as dune_window.csv; its path. Draws the flow at the crest, dune_window_crest.png."""
    study, lines = Path(study_path), []
    for place in PLACES:
        layered = [study / f"{'crest' if place == 'fine' else place}-{kind}" for kind in ("paper", "complete")]
        if any(gap_of(path) for path in (study / place, *layered)):
            continue
        resolved = Grains(study / place)
        lines += rows_of(place, resolved, [Grains(path) for path in layered])
        if place == "crest":
            style.save(draw_flow(resolved), folder, "dune_window_crest", "Barchan, validation")
    if not lines:
        raise MissingData(f"needs a window in {study} that is resolved and under both kinds of forces")
    return tables.keep(folder / f"{NAME}.csv", "Forces on the grains of a dune",
                       "./barchan sweep configs/validation/resolved-window-study.toml", resolved.run.summary,
                       [COLUMNS, *lines])


def draw_flow(grains):
    """Speed and streamlines in the plane along the middle of a window, at the end of SPAN."""
    run, d = grains.run, np.mean(grains.d)
    frame = int(np.argmin(abs(run.need_fields().times - SPAN[1])))
    middle = run.config["domain"]["size"][2] / 2
    flow = run.flow_plane(frame, middle)
    figure = Figure(figsize=(style.FULL_WIDTH, 3.6), layout="constrained")
    axes = figure.subplots()
    image = planes.draw(axes, flow.x / d, flow.y / d, 1e3 * flow.u, 1e3 * flow.v, points=(161, 91), density=2.2)
    off = grains.x[:, 2] - flow.z
    for n in np.flatnonzero(abs(off) < grains.d / 2):
        axes.add_patch(Circle(grains.x[n, :2] / d, np.sqrt(grains.d[n]**2 / 4 - off[n]**2) / d, fc=style.ORANGE, ec="k",
                              lw=0.5, zorder=5))
    axes.set_ylabel("$y/d$")
    figure.colorbar(image, ax=axes, pad=0.01).set_label("speed (mm/s)")
    return figure


def classes_of(rows):
    for name, (above, below) in CLASSES.items():
        of_class = rows.only((rows["depth"] >= above) & (rows["depth"] < below))
        if len(of_class["id"]):
            yield name, of_class


def summary(folder):
    """Lines `place, class | grains | F_x: resolved, paper, complete | F_y: the same | correlations of F_x`."""
    table = tables.read_saved(folder, NAME)
    for place in (place for place in PLACES if place in table.values("place")):
        for name, rows in classes_of(table.where("place", place)):
            means = [", ".join(f"{np.mean(rows[f'{kind}_{axis}']):.3f}" for kind in ("resolved", "paper", "complete"))
                     for axis in "xy"]
            alike = ", ".join(f"{np.corrcoef(rows['resolved_x'], rows[f'{kind}_x'])[0, 1]:.2f}"
                              for kind in ("paper", "complete")) if len(rows["id"]) > 2 else "-"
            yield " | ".join([f"{place}, {name}", str(len(rows["id"])), *means, alike])


def draw(folder):
    table = tables.read_saved(folder, NAME)
    figure, (panels,) = style.panels(None, 1, 3, figsize=(style.FULL_WIDTH, 2.6))
    for axes, place in zip(panels, PLACES):
        rows = table.where("place", place)
        ends = np.array([min(rows["resolved_x"].min(), 0), rows["resolved_x"].max()])
        for kind, marker, colour in (("paper", "o", style.BLUE), ("complete", ".", style.VERMILLION)):
            axes.plot(rows["resolved_x"], rows[f"{kind}_x"], ls="", marker=marker, ms=3, mew=0.6, mfc="none",
                      color=colour, label=f"{kind} forces")
        axes.plot(ends, ends, color="k", lw=0.7)
        axes.set(xlabel=f"resolved, {place}")
    panels[0].set_ylabel("force along $x$ over weight, layered")
    panels[0].legend(fontsize=6)
    for index, axes in enumerate(panels):
        style.panel_label(axes, index)
    return figure
