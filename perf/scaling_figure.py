"""Strong and weak scaling as curves, and what takes the time of the paper's case."""

import sys
from pathlib import Path

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "analysis"))

import numpy as np  # noqa: E402  (after the path of the look of figures)

import scaling as model  # noqa: E402
import style  # noqa: E402
from style import plt  # noqa: E402

LOOK = {model.PAPER: (style.BLUE, "o", "paper, 10$^5$ grains"),
        model.DUNES: (style.VERMILLION, "s", "10$^7$ grains"),
        model.FLOW: (style.GREEN, "^", "10$^9$ cells, no grains")}
MACHINES = ((model.CORE, 8e9, "-"), (model.H200, 1.2e11, (0, (4, 1.5))))
STACK = (("sub-steps", "grains", style.BLUE), ("flow", "flow", style.SKY),
         ("uneven", "uneven shares", style.GREY), ("ghosts", "ghosts", style.ORANGE),
         ("reductions", "reductions", style.VERMILLION), ("all-to-alls", "all-to-alls", style.PURPLE),
         ("flow messages", "halos, transposes, visits", style.GREEN))


def strong_curve(case, machine, network, per_rank):
    points = []
    for ranks in model.RANKS:
        t = model.fits_in_memory(case, ranks, per_rank) and model.step_time(case, machine, network, ranks)
        if t:
            points.append((ranks, model.total(t)))
    return np.array(points).T


def draw_strong(axes, network):
    for machine, per_rank, dashes in MACHINES:
        for case, (colour, marker, label) in LOOK.items():
            ranks, seconds = strong_curve(case, machine, network, per_rank)
            alone = model.ideal(case, machine, 1)
            axes.plot(ranks, 1e3 * alone / ranks, color=style.GREY, lw=0.6, zorder=1)
            axes.plot(ranks, 1e3 * seconds, color=colour, ls=dashes, marker=marker, ms=3,
                      label=label if machine is model.CORE else None)
    axes.plot([], [], color=style.BLACK, ls=MACHINES[1][2], label="H200 (estimates)")
    axes.plot([], [], color=style.GREY, lw=0.6, label="no waiting")
    axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel="ms a fluid step")
    axes.set_ylim(1, 1e9)
    axes.legend(loc="upper right", fontsize=6.2)


def stacked(t):
    t = dict(t, **{"flow messages": t["halos"] + t["transposes"] + t["visits"]})
    return [t[part] / model.total({p: t[p] for p in model.PARTS}) for part, _, _ in STACK]


def draw_shares(axes, network):
    ranks = [n for n in model.RANKS if model.step_time(model.PAPER, model.CORE, network, n)]
    parts = np.array([stacked(model.step_time(model.PAPER, model.CORE, network, n)) for n in ranks]).T
    bottom = np.zeros(len(ranks))
    for share, (_, label, colour) in zip(parts, STACK):
        axes.bar(range(len(ranks)), share, 0.85, bottom=bottom, color=colour, label=label)
        bottom += share
    axes.set_xticks(range(len(ranks)), [str(n) for n in ranks], rotation=60)
    axes.tick_params(axis="x", which="both", length=0)
    axes.set(xlabel="ranks (cores)", ylabel="share of a step, paper's case", ylim=(0, 1.95),
             yticks=np.arange(0, 1.01, 0.2))
    axes.legend(loc="upper left", fontsize=6.2)


def draw_weak(axes, network):
    for (machine, _, dashes), side, colour in zip(MACHINES, (1, 3), (style.BLUE, style.VERMILLION)):
        times = [(ranks, model.total(model.step_time(case, machine, network, ranks)))
                 for ranks, case in model.weak_cases(side)]
        ranks, seconds = np.array(times).T
        axes.plot(ranks, seconds[0] / seconds, color=colour, ls=dashes, marker="o", ms=3,
                  label=f"{side**2} dune{'s' if side > 1 else ''} a rank, {machine.name}")
    axes.set(xscale="log", xlabel="ranks", ylabel="efficiency, weak scaling", ylim=(0, 1.05))
    axes.legend(loc="lower left", fontsize=6.2)


def draw(path, network):
    style.use()
    figure, panels = plt.subplots(1, 3, figsize=(style.FULL_WIDTH, 3.3))
    for index, (axes, panel) in enumerate(zip(panels, (draw_strong, draw_shares, draw_weak))):
        panel(axes, network)
        style.panel_label(axes, index)
    style.save(figure, path.parent, path.stem, "scaling")
