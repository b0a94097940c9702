"""channel of a study: turbulence statistics of all cases beside DNS (as Fig. 2 of Lima et al. 2022).

The cases are those with statistics.csv, such as the channel on several meshes.
"""

from dataclasses import dataclass
from functools import cached_property
from typing import Any

import numpy as np

from barchan.errors import MissingData
from barchan.figures import profiles, style
from barchan.figures.result import keep_cases
from barchan.flow import wall_units
from barchan.io.study_folder import plain
from barchan.io.tables import Table

TOLERANCE = 0.05   # of u_star, and so of U^+
STRESSES = {"uu": "$\\langle u'u' \\rangle$", "vv": "$\\langle v'v' \\rangle$",
            "ww": "$\\langle w'w' \\rangle$", "uv": "$-\\langle u'v' \\rangle$"}
LOOKS = ((style.BLUE, "-"), (style.VERMILLION, (0, (5, 1.2))), (style.GREEN, (0, (3, 1, 1, 1))),
         (style.ORANGE, (0, (1, 1))), (style.PURPLE, "-"), (style.SKY, (0, (5, 1.2))))
COLUMNS = ("y", "y_plus", "U_plus", "uu", "vv", "ww", "uv", "total")


def read_channels(study):
    """One channel per case that has plane statistics over a wall."""
    channels = []
    for case in study.cases:
        table = case.run.statistics_columns if case.run else {}
        if len(table.get("y", ())) < 2 or not (table["U_plus"] > 0).all():
            continue
        height = case.run.domain[1] if case.run.domain else table["y"][-1]
        colour, dashes = LOOKS[len(channels) % len(LOOKS)]
        channels.append(Channel(
            case.name, label(case), colour, dashes, Table({"height": f"{height} m"}, table)))
    if not channels:
        raise MissingData("needs a case with statistics.csv: a [statistics] section in the base case")
    return channels


def label(case):
    cells = case.run.config.get("fluid", {}).get("cells")
    if case.varied in (None, "fluid.cells") and cells:
        return plain(" x ".join(map(str, cells))) + " cells"
    return case.label


def read_dns(name="chan395"):
    """Of wall_units, uv with its sign turned as in Channel.curves."""
    dns = wall_units.read_dns(name)
    return {**dns, "uv": -dns["uv"]}


def draw(study, ax=None):
    channels = read_channels(study)
    figure = draw_channels(channels, read_dns(), ax)
    keep_curves(figure, channels)
    return figure


def keep_curves(figure, channels):
    """In wall units, lengths over the height of the channel; uv is -<u'v'>."""
    columns = {"case": [[channel.name] * len(channel.curves["y"]) for channel in channels]}
    for name in COLUMNS:
        columns[name] = [channel.curves[name] for channel in channels]
    keep_cases(figure, "channel", columns)


@dataclass
class Channel:
    name: str
    label: str
    colour: str
    dashes: Any
    table: Table

    @property
    def height(self):
        return float(self.table.notes["height"].split()[0])

    @cached_property
    def curves(self):
        """In wall units, uv with its sign turned, so that all peaks are maxima."""
        curves = wall_units.in_wall_units(self.table, self.height)
        return {**curves, "uv": -curves["uv"]}


def sparse(x, count=28):
    """Indices at which curves of the reference are marked, even on the logarithmic axis."""
    wanted = np.geomspace(0.5, x[-1], count)
    return np.unique([int(np.argmin(abs(np.log(x / at)))) for at in wanted])


def draw_channels(channels, dns, ax=None):
    """Panels of mean velocity, stresses and total stress; `dns` as of read_dns."""
    figure, grid = style.panels(ax, 2, 3, figsize=(style.FULL_WIDTH, 4.6))
    mean, total, panels = grid[0, 0], grid[1, 2], [*grid[0, 1:], *grid[1, :2]]
    marks = sparse(dns["y_plus"])
    profiles.draw_law_of_the_wall(mean)
    low, high = ((1 + sign * TOLERANCE) * dns["U_plus"] for sign in (-1, 1))
    mean.fill_between(dns["y_plus"], low, high, color="0.88", lw=0, label="DNS $\\pm$ 5 %")
    mean.set_ylim(0, 23)
    for axes, (name, label) in zip(panels, STRESSES.items()):
        axes.set(xscale="log", xlim=(0.9, 420), xlabel="$y^+$", ylabel=label + "$ / u_*^2$")
    total.plot([0, 1], [1, 0], color="k", lw=0.7, ls=":", label="$1 - y/h$")
    total.set(xlim=(0, 1), ylim=(0, 1.1), xlabel="$y / h$", ylabel="total stress$ / u_*^2$")

    for axes, name in zip([mean, *panels], ["U_plus", *STRESSES]):
        axes.plot(dns["y_plus"][marks], dns[name][marks], label="DNS", zorder=1,
                  **style.reference_marks())
        for channel in channels:
            axes.plot(channel.curves["y_plus"], channel.curves[name], color=channel.colour,
                      ls=channel.dashes, lw=1.0, label=channel.label)
        if name != "U_plus":
            axes.set_ylim(0, None)
    for channel in channels:
        total.plot(channel.curves["y"], channel.curves["total"], color=channel.colour,
                   ls=channel.dashes, lw=1.0)
    handles, labels = mean.get_legend_handles_labels()
    mean.legend(handles[:2], labels[:2], loc="upper left")
    total.legend(loc="upper right")
    handles, _ = panels[0].get_legend_handles_labels()
    style.legend_outside(figure, handles, 0.25, ncols=len(handles))
    for index, axes in enumerate(grid.ravel()):
        style.panel_label(axes, index)
    return figure
