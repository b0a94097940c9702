#!/usr/bin/env python3
"""Predicts the time of a fluid step on up to 1,000 ranks, from what ranks send each other and measured rates.

usage: scaling.py [--latency S] [--bandwidth B]   the table of docs/dev/scaling.md
       scaling.py --page docs/dev/scaling.md      puts it there
       scaling.py --figure PNG                    its figure
       scaling.py --check RUN_DIR ...             the model compared with run.json of runs on several ranks

Rates of a core are those of perf/measured.csv, where perf/keep.py puts records of `./barchan bench`.

A message costs the latency and its bytes over the bandwidth of its rank. A reduction costs the latency for
each level of a tree, an all-to-all the latency for each other rank. Nothing overlaps. Every phase waits for
its busiest rank.
"""

import argparse
import csv
import json
import sys
import tomllib
from dataclasses import dataclass, replace
from functools import cache
from pathlib import Path

import numpy as np

import scaling_counts as counts

ROOT = Path(__file__).resolve().parent.parent


class Problem(Exception):
    """Something the user can put right: a sentence."""


# --- what computes and what connects ------------------------------------------------------------------

@dataclass(frozen=True)
class Network:
    latency: float = 2e-6    # [s]
    bandwidth: float = 1e10  # of a rank [bytes/s]

    def seconds(self, c, ranks):
        return (c.messages * self.latency + c.bytes / self.bandwidth
                + c.reductions * counts.levels(ranks) * self.latency
                + c.all_to_alls * (ranks - 1) * self.latency)


@dataclass(frozen=True)
class Machine:
    """Times of one rank [s]: of each step, for each grain or cell."""
    name: str
    memory: float           # of a rank [bytes]
    grain_step: tuple       # fixed, per grain
    rebuild: tuple
    exchange: float         # per grain in the pencil: gather, deposit
    flow: tuple             # a step without grains
    coupled: tuple          # the flow around grains
    among_ranks: float = 0  # more for a grain step, a message, a block of a transpose on several ranks
    message: float = 0
    block: float = 0


PAPER_GRAINS, PAPER_CELLS = 100_000, 250 * 30 * 63  # of the measured cases, too
GRAIN_STEPS = 100                                   # in a fluid step of coupled/heap_100k


@cache
def measured():
    """Case -> its line of perf/measured.csv; `seconds` of one core, as threads share the work evenly."""
    with open(ROOT / "perf/measured.csv", encoding="utf-8") as file:
        lines = list(csv.DictReader(line for line in file if not line.startswith("#")))
    return {line["case"]: line | {"seconds": 1e-3 * float(line["ms"]) * int(line["threads"])} for line in lines}


def measured_core():
    """A grain step is that of moving grains without their lists. The flow around grains is what is left of the coupled
    step, so that one rank agrees with it."""
    whole, dune, flow = (measured()[case] for case in ("coupled/heap_100k", "dem/dune_100k", "les/mesh1"))
    rebuild, gather, deposit = (measured()[f"kernel/{name}"]["seconds"] for name in ("list_build", "gather", "deposit"))
    step = dune["seconds"] - float(dune["rebuilds"]) * rebuild
    around = whole["seconds"] - GRAIN_STEPS * step - float(whole["rebuilds"]) * rebuild - gather - deposit
    return Machine("CPU", memory=8e9, grain_step=(0, step / PAPER_GRAINS), rebuild=(0, rebuild / PAPER_GRAINS),
                   exchange=(gather + deposit) / PAPER_GRAINS, flow=(0, flow["seconds"] / PAPER_CELLS),
                   coupled=(0, around / PAPER_CELLS))


CORE = measured_core()
# Nothing measured: straight lines through the estimate of docs/performance.md. On several ranks a grain step
# launches two more kernels and waits for the largest displacement; a message is packed, awaited and unpacked;
# a transpose launches a kernel for each rank that shares the axis.
H200 = Machine("H200", memory=1.2e11, grain_step=(9e-6, 2.41e-10), rebuild=(3.8e-4, 4.2e-10),
               exchange=3e-10, flow=(1.9e-4, 1.1e-10), coupled=(8e-4, 6.8e-10), among_ranks=1.6e-5,
               message=6e-6, block=4e-6)


# --- cases ---------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Case:
    """Channels of the paper side by side (0.4 x 0.1 m, 250 x 63 columns of 30 cells), a dune in each."""
    name: str
    tiles: tuple
    has_grains: bool = True
    grain_steps: int = GRAIN_STEPS
    iterations: float = float(measured()["coupled/heap_100k"]["pressure_iterations"])
    rebuilds: float = float(measured()["coupled/heap_100k"]["rebuilds"])

    @property
    def columns(self):
        return 250 * self.tiles[0], 63 * self.tiles[1]

    @property
    def cells(self):
        return 30 * self.columns[0] * self.columns[1]

    @property
    def grains(self):
        return 1e5 * self.tiles[0] * self.tiles[1] if self.has_grains else 0


PAPER = Case("1e5 grains", (1, 1))
DUNES = Case("1e7 grains", (10, 10))
FLOW = Case("1e9 cells", (46, 46), has_grains=False)
CASES = (PAPER, DUNES, FLOW)
RANKS = (1, 2, 4, 8, 16, 32, 64, 128, 256, 500, 1000)
IN_TABLE = (1, 2, 8, 32, 64, 128, 500, 1000)


@cache
def grains_of(case):
    return counts.columns_of_dunes(case.tiles)


@cache
def layout_of(case, shape):
    return counts.layout(grains_of(case), shape, case.columns)


# --- the time of a step ----------------------------------------------------------------------------------

PARTS = ("grain steps", "flow", "uneven", "ghosts", "reductions", "all-to-alls", "halos", "transposes",
         "to fluid ranks")


def blocks(p):
    """Kernels that pack and unpack the transposes of one solve."""
    return 2 * (4 * p.px * (p.px > 1) + 2 * p.pz * (p.pz > 1))


def flow_compute(case, machine, cells):
    """Without the fixed part."""
    return cells * (machine.coupled if case.has_grains else machine.flow)[1]


def flow_messages(case, p):
    """Fills (and what travels like them) and transposes of a step, apart."""
    solves = case.iterations + counts.SMOOTHINGS if case.has_grains else 1
    transposes = solves * counts.fft_solve(p)
    whole = (counts.flow_step_around_grains(p, case.iterations) + counts.exchange(p) if case.has_grains
             else counts.flow_step(p))
    return whole + (-1) * transposes, transposes, solves


def step_time(case, machine, network, ranks):
    """Seconds of a fluid step by PARTS, or None if the pencils do not fit."""
    shape = counts.best_shape(ranks, *case.columns)
    if shape is None:
        return None
    p = counts.Pencil(case.columns[0], 30, case.columns[1], *shape)
    fills, transposes, solves = flow_messages(case, p)
    t = dict.fromkeys(PARTS, 0.0)
    t["flow"] = (machine.coupled if case.has_grains else machine.flow)[0]
    t["flow"] += flow_compute(case, machine, case.cells / ranks)
    t["uneven"] = flow_compute(case, machine, p.cells - case.cells / ranks)
    if ranks > 1:
        t["halos"] = network.seconds(replace(fills, reductions=0), ranks) + machine.message * fills.messages
        t["transposes"] = network.seconds(transposes, ranks) + machine.block * solves * blocks(p)
        t["reductions"] = network.seconds(counts.Counts(reductions=fills.reductions), ranks)
    if case.has_grains:
        add_grains(t, case, machine, network, shape)
    return t


def add_grains(t, case, machine, network, shape):
    ranks, n, rebuilds = shape[0] * shape[1], case.grain_steps, case.rebuilds
    where = layout_of(case, shape)
    mean, most, b = case.grains / ranks, where.grains.max(), where.worst()
    t["grain steps"] = n * (machine.grain_step[0] + machine.grain_step[1] * mean)
    t["grain steps"] += rebuilds * (machine.rebuild[0] + machine.rebuild[1] * mean)
    t["flow"] += machine.exchange * mean
    t["uneven"] += (n * machine.grain_step[1] + rebuilds * machine.rebuild[1]) * max(most - mean, 0)
    t["uneven"] += machine.exchange * max(where.in_pencil.max() - mean, 0)
    if ranks == 1:
        return
    ghosts = ((n - rebuilds) * counts.grain_step(b)
              + rebuilds * (counts.rebuild(b) + counts.Counts(reductions=1)))
    t["ghosts"] = network.seconds(replace(ghosts, reductions=0, all_to_alls=0), ranks)
    t["ghosts"] += rebuilds * machine.rebuild[1] * b.ghosts + n * machine.among_ranks
    t["reductions"] += network.seconds(counts.Counts(reductions=ghosts.reductions + 4), ranks)
    copies = counts.to_fluid_and_back(b)
    t["to fluid ranks"] = network.seconds(replace(copies, all_to_alls=0), ranks)
    calls = ghosts.all_to_alls + copies.all_to_alls
    t["all-to-alls"] = network.seconds(counts.Counts(all_to_alls=calls), ranks)


def total(t):
    return sum(t.values())

def ideal(case, machine, ranks):
    """What one rank needs, divided by the number of ranks."""
    return total(step_time(case, machine, Network(), 1)) / ranks


def fits_in_memory(case, machine, ranks):
    """392 bytes a cell (225 of the flow alone) and 690 a grain: docs/performance.md, "Memory"."""
    return ((392 if case.has_grains else 225) * case.cells + 690 * case.grains) / ranks < machine.memory


def strong_time(case, machine, network, ranks):
    """As step_time(), None also where the memory is too small."""
    return step_time(case, machine, network, ranks) if fits_in_memory(case, machine, ranks) else None


def weak_cases(side):
    """As many dunes for each rank, channels four times as long as wide; up to 1e8 grains."""
    for ranks in (1, 4, 16, 64, 256, 1024):
        if ranks * side**2 > 1100:
            return
        n = round(ranks**0.5)
        yield ranks, Case(f"{ranks}", (side * n, side * n))


# --- table ---------------------------------------------------------------------------------------------

def row(*cells):
    return "| " + " | ".join(str(c) for c in cells) + " |"


def head(*cells):
    return [row(*cells), "|" + "---|" * len(cells)]


def strong_cell(case, machine, network, ranks):
    t = strong_time(case, machine, network, ranks)
    if t is None:
        return "-"
    ms = 1e3 * total(t)
    digits = f"{float(f'{ms:.3g}'):,.0f}" if ms >= 100 else f"{ms:.3g}"
    return f"{digits} ({100 * ideal(case, machine, ranks) / total(t):.0f} %)"


def table(network):
    columns = [(case, machine) for machine in (CORE, H200) for case in CASES]
    return [*head("ranks", *(f"{machine.name}: {case.name}" for case, machine in columns)),
            *(row(ranks, *(strong_cell(case, machine, network, ranks) for case, machine in columns))
              for ranks in IN_TABLE)]


def write_table(page, network):
    """In place of the table of the page that begins with the same word."""
    lines = page.read_text(encoding="utf-8").splitlines()
    first = next(n for n, line in enumerate(lines) if line.startswith("| ranks |"))
    last = next(n for n in range(first, len(lines)) if not lines[n].startswith("|"))
    page.write_text("\n".join([*lines[:first], *table(network), *lines[last:]]) + "\n", encoding="utf-8")


# --- compared with runs --------------------------------------------------------------------------------------------

def read_run(folder):
    try:
        run = json.loads((folder / "run.json").read_text(encoding="utf-8"))
        config = tomllib.loads((folder / "config.toml").read_text(encoding="utf-8"))
        with open(config["initial"]["grains"], encoding="utf-8") as file:
            lines = list(csv.DictReader(file))
    except OSError as error:
        raise Problem(f"{error.filename}: {error.strerror}") from error
    if "all_to_alls" not in run.get("communication", {}):
        raise Problem(f"{folder}: nothing is counted: it ran on one rank, or an earlier version")
    x, z = (np.array([float(line[axis]) for line in lines]) for axis in "xz")
    return run, config, x, z % config["domain"]["size"][2]  # files may lie across a periodic side


def model_of_run(run, config, x, z):
    """Counts a step of rank 0, where nobody migrates and the heap stays as it was."""
    cells, size = config["fluid"]["cells"], config["domain"]["size"]
    shape = counts.best_shape(run["ranks"], cells[0], cells[2])
    p = counts.Pencil(*cells, *shape)
    where = counts.layout(counts.columns_of_grains(x, z, (size[0], size[2])), shape, (cells[0], cells[2]))
    grain_steps = round(config["time"]["fluid_step"] / config["time"]["grain_step"])
    rebuilds = run["list_rebuilds"] - 1 / run["steps"]  # the first was before the first step
    return counts.coupled_step(p, where.border(0), run["pressure_iterations_mean"], grain_steps, rebuilds)


def check(folders):
    print("\n".join(head("run", "ranks", "messages: model / counted", "megabytes", "reductions", "all-to-alls")))
    for folder in map(Path, folders):
        run, config, x, z = read_run(folder)
        model, said = model_of_run(run, config, x, z), run["communication"]
        pairs = ((model.messages, said["messages"]), (1e-6 * model.bytes, said["megabytes"]),
                 (model.reductions, said["reductions"]), (model.all_to_alls, said["all_to_alls"]))
        print(row(folder.name, run["ranks"], *(f"{a:.1f} / {b:.1f} = {a / b:.3f}" for a, b in pairs)))


# --- figure ----------------------------------------------------------------------------------------------

def legend_below(axes):
    axes.legend(loc="upper left", bbox_to_anchor=(-0.05, -0.25), fontsize=6.2)


def draw_strong(axes, network, style):
    look = {PAPER: (style.BLUE, "o", "paper, 10$^5$ grains"), DUNES: (style.VERMILLION, "s", "10$^7$ grains"),
            FLOW: (style.GREEN, "^", "10$^9$ cells, no grains")}
    for machine, dashes in ((CORE, "-"), (H200, (0, (4, 1.5)))):
        for case, (colour, marker, label) in look.items():
            times = [(n, t) for n in RANKS if (t := strong_time(case, machine, network, n))]
            ranks = np.array([n for n, _ in times])
            axes.plot(ranks, 1e3 * ideal(case, machine, ranks), color=style.GREY, lw=0.6, zorder=1)
            axes.plot(ranks, [1e3 * total(t) for _, t in times], color=colour, ls=dashes, marker=marker, ms=3,
                      label=label if machine is CORE else None)
    axes.plot([], [], color=style.BLACK, ls=(0, (4, 1.5)), label="H200 (estimates)")
    axes.plot([], [], color=style.GREY, lw=0.6, label="no waiting")
    axes.set(xscale="log", yscale="log", xlabel="ranks", ylabel="ms a fluid step")
    axes.set_ylim(3, 3e4)
    legend_below(axes)


def draw_shares(axes, network, style):
    stack = ((("grain steps",), style.BLUE), (("flow",), style.SKY), (("uneven",), style.GREY),
             (("ghosts",), style.ORANGE), (("reductions",), style.VERMILLION),
             (("all-to-alls",), style.PURPLE), (("halos", "transposes", "to fluid ranks"), style.GREEN))
    times = [t for n in RANKS if (t := step_time(PAPER, CORE, network, n))]
    bottom = np.zeros(len(times))
    for parts, colour in stack:
        share = np.array([sum(t[part] for part in parts) / total(t) for t in times])
        axes.bar(range(len(times)), share, 0.85, bottom=bottom, color=colour, label=", ".join(parts))
        bottom += share
    axes.set_xticks(range(len(times)), [str(n) for n in RANKS[:len(times)]], rotation=60)
    axes.tick_params(axis="x", which="both", length=0)
    axes.set(xlabel="ranks (cores)", ylabel="share of a step, paper's case", ylim=(0, 1))
    legend_below(axes)


def draw_weak(axes, network, style):
    for machine, side, colour, dashes in ((CORE, 1, style.BLUE, "-"), (H200, 3, style.VERMILLION, "--")):
        times = [(ranks, total(step_time(case, machine, network, ranks)))
                 for ranks, case in weak_cases(side)]
        ranks, seconds = np.array(times).T
        axes.plot(ranks, seconds[0] / seconds, color=colour, ls=dashes, marker="o", ms=3,
                  label=f"{side**2} dune{'s' if side > 1 else ''} a rank, {machine.name}")
    axes.set(xscale="log", xlabel="ranks", ylabel="efficiency, weak scaling", ylim=(0, 1.05))
    legend_below(axes)


def draw(path, network):
    sys.path.insert(0, str(ROOT / "python"))
    from barchan.figures import style

    with style.look():
        figure, (panels,) = style.panels(None, 1, 3, figsize=(style.FULL_WIDTH, 3.6))
        for index, (axes, panel) in enumerate(zip(panels, (draw_strong, draw_shares, draw_weak))):
            panel(axes, network, style)
            style.panel_label(axes, index)
        style.save(figure, path.parent, path.stem, "scaling")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--latency", type=float, default=Network.latency, help="of a message [s]")
    parser.add_argument("--bandwidth", type=float, default=Network.bandwidth, help="of a rank [bytes/s]")
    parser.add_argument("--figure", type=Path, help="draws strong and weak scaling into this PNG file")
    parser.add_argument("--page", type=Path, help="puts the table into this page, in place of the one there")
    parser.add_argument("--check", nargs="+", metavar="RUN_DIR", help="runs of grains from a CSV file")
    options = parser.parse_args()
    network = Network(options.latency, options.bandwidth)
    try:
        if options.check:
            check(options.check)
        elif options.figure:
            draw(options.figure, network)
        elif options.page:
            write_table(options.page, network)
        else:
            print("\n".join(table(network)))
    except Problem as problem:
        print(f"scaling: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
