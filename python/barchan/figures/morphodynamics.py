"""morphodynamics: slopes, flux over the crest, ways of moving, avalanches and exchange of the dune against time.

Dots are single frames, the line through them their mean over the last second. Dashed in the profiles: lines
fitted to the stoss side and the slip face; dashed in the fluxes: phi c H, that of a dune of unchanged shape.
Asked for by its name it also says the means in words, of the second half of the run or from --from to --to.
Definitions: docs/dune-measures.md, "Slopes and transport".
"""

import numpy as np

from barchan.dune import current as dune_current
from barchan.dune import fluxes as grain_fluxes
from barchan.dune import transport as dune_transport
from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep, say
from barchan.stats import over_the_last_second, window

DASHED = (0, (4, 1.5))
LEAST = 3.0  # [s] of a run: lines are means over one second
LEGEND = {"ncols": 2, "columnspacing": 1.0, "handlelength": 1.4}


def draw(run, ax=None, start=None, end=None):
    """The means are also said in words."""
    table, profiles = dune_transport.measure(run)
    if table["t"][-1] - table["t"][0] < LEAST * (1 - 1e-9):
        raise MissingData(f"needs a dune that is followed for {LEAST:g} s or more")
    shares = dune_transport.measure_shares(run)
    chosen = window(table["t"], start, end)
    figure, panels = style.panels(ax, 3, 2, figsize=(style.FULL_WIDTH, 6.2))
    say(figure, [*dune_transport.summary(table, shares, chosen), *dune_current.sentences(run)])
    keep(figure, "morphodynamics", table, most=None)
    if shares:
        keep(figure, "transport_shares", shares, most=None)
    draw_profiles(panels[0, 0], table["t"], profiles)
    draw_angles(panels[0, 1], table)
    draw_fluxes(panels[1, 0], table)
    draw_shares(panels[1, 1], shares)
    draw_slip_face(panels[2, 0], table, chosen)
    draw_exchange(panels[2, 1], table)
    for index, axes in enumerate(panels.ravel()):
        style.panel_label(axes, index)
        if index > 0:
            axes.set(xlabel="$t$ (s)", xlim=table["t"][[0, -1]])
    return figure


def draw_profiles(axes, t, profiles):
    """The centreline at the start, half way and at the end, there with its fitted lines; heights are drawn larger."""
    for row, colour in ((0, style.GREY), (len(t) // 2, style.SKY), (len(t) - 1, style.BLUE)):
        axes.plot(1e3 * profiles[row].x, 1e3 * profiles[row].h, color=colour, label=f"{t[row]:.3g} s")
    for index, (x, h) in enumerate(profiles[-1].faces):
        axes.plot(1e3 * x, 1e3 * h, color=style.VERMILLION, lw=0.9, ls=DASHED,
                  label=None if index else "fitted lines")
    axes.axvline(1e3 * profiles[-1].brink_x, color=style.VERMILLION, lw=0.8, ls=":", ymax=0.5, label="brink")
    axes.set(xlabel="$x$ (mm)", ylabel="$h$ (mm)", ylim=(0, 1.6 * axes.get_ylim()[1]))
    axes.legend(loc="upper right", **LEGEND)


def draw_angles(axes, table):
    explain_dots(axes)
    for name, label, colour in (("slip_face_angle", "slip face", style.VERMILLION),
                                ("stoss_angle", "stoss side", style.BLUE)):
        points_and_mean(axes, table["t"], table[name], colour, label)
    axes.set(ylabel="angle (degrees)", ylim=(0, 1.35 * axes.get_ylim()[1]))
    axes.legend(loc="upper right", **LEGEND)


def draw_fluxes(axes, table):
    explain_dots(axes)
    points_and_mean(axes, table["t"], 1e6 * table["crest_flux"], style.BLUE, "over the crest")
    if np.isfinite(table["migration_flux"]).any():
        axes.plot(table["t"], 1e6 * table["migration_flux"], color=style.VERMILLION, ls=DASHED,
                  label="$\\phi\\, c\\, H$ (migration)")
    top = np.nanpercentile(1e6 * table["crest_flux"], 98)
    axes.set(ylabel="flux (mm$^2$/s)", ylim=(0, 1.5 * top if top > 0 else None))
    axes.legend(loc="upper right")


def draw_shares(axes, shares):
    axes.set(ylabel="share of the flux (%)", ylim=(0, 100))
    if not shares:
        axes.text(0.5, 0.5, "no velocities in grains.h5", transform=axes.transAxes, ha="center", color=style.GREY)
        return
    for kind, colour in zip(grain_fluxes.KINDS, (style.ORANGE, style.BLUE, style.GREEN)):
        marker = style.mark_if_few(shares["t"])
        axes.plot(shares["t"], 100 * shares[kind], color=colour, marker=marker, ms=3, label=kind)
    axes.legend(loc="best")


def draw_slip_face(axes, table, chosen):
    t, counts = table["t"], table["slip_face_grains"]
    axes.step(t, counts, where="pre", color=style.BLUE, lw=0.7)
    events = np.nonzero(chosen)[0][dune_transport.avalanches(counts[chosen])[0]]
    axes.plot(t[events], counts[events], "v", color=style.VERMILLION, ms=4, label="avalanche")
    axes.set(ylabel="grains down the slip face", ylim=(0, 1.4 * max(1.0, np.nanmax(counts[chosen], initial=0.0))))
    if len(events):
        axes.legend(loc="upper right")


def draw_exchange(axes, table):
    axes.plot(table["t"], 100 * table["kept"], color=style.BLUE, label="first grains kept")
    axes.plot(table["t"], 100 * table["asymmetry"], color=style.PURPLE, label="asymmetry")
    axes.set(ylabel="share, asymmetry (%)", ylim=(0, 105))
    axes.legend(loc="center right")


def explain_dots(axes):
    """A line of the legend."""
    axes.plot([], [], ".", color=style.GREY, ms=4, mew=0, label="single frames")


def points_and_mean(axes, t, values, colour, label):
    """Single frames, and their mean over the last second."""
    axes.plot(t, values, ".", color=colour, ms=2.5, alpha=0.6, mew=0)
    axes.plot(t, over_the_last_second(t, values), color=colour, label=f"{label}, 1 s mean")
