#!/usr/bin/env python3
"""Predicts the time of a fluid step on up to 1,000 ranks, from what ranks send each other and measured rates.

usage: scaling.py [--latency S] [--bandwidth B]   tables in markdown: docs/performance.md
       scaling.py --figure PNG                    the same as curves
       scaling.py --check RUN_DIR ...             the model beside run.json of runs on several ranks

A message costs the latency and its bytes over the bandwidth of its rank, a reduction the latency for each
level of a tree, an all-to-all the latency for each other rank. Nothing overlaps. Phases wait for their
busiest rank.
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
import scaling_layout as layouts

ROOT = Path(__file__).resolve().parent.parent


class Problem(Exception):
    """Something the user can put right: a sentence."""


# --- what computes and what connects ------------------------------------------------------------------

@dataclass(frozen=True)
class Network:
    latency: float = 2e-6     # [s]
    bandwidth: float = 1e10  # of a rank [bytes/s]

    def seconds(self, c, ranks):
        return (c.messages * self.latency + c.bytes / self.bandwidth
                + c.reductions * counts.levels(ranks) * self.latency
                + c.all_to_alls * (ranks - 1) * self.latency)


@dataclass(frozen=True)
class Machine:
    """Times of one rank [s]: of each step, for each grain or cell."""
    name: str
    substep: tuple          # fixed, per grain
    rebuild: tuple
    exchange: float         # per grain in the pencil: gather, deposit, carry
    flow: tuple             # a step without grains
    coupled: tuple          # a step around grains without its iterations and smoothings
    iteration: float        # per cell
    smoothing: float
    beside: float = 0       # more for a sub-step, a message, a block of a transpose among ranks
    message: float = 0
    block: float = 0


# docs/performance.md, "Results" and "Kernels", two threads: twice their times, quiet minutes. A sub-step
# in water, and what is left of coupled/heap_100k (1.08 s, 5 iterations, 0.7 rebuilds) for the rest.
CORE = Machine("core", substep=(0, 1.45e-7), rebuild=(0, 8.2e-7), exchange=7e-7, flow=(0, 9.9e-8),
               coupled=(0, 6.2e-7), iteration=7e-8, smoothing=2.7e-8)
# docs/performance.md, "GPU: compiled, not run; estimate": straight lines through its columns. Among ranks
# a sub-step launches two more kernels and waits for the largest way; a message is packed, awaited and
# unpacked; src/parallel/transpose.cpp launches a kernel for each rank of a line.
H200 = Machine("H200 (estimate)", substep=(9e-6, 2.41e-10), rebuild=(3.8e-4, 4.2e-10), exchange=3e-10,
               flow=(1.9e-4, 1.1e-10), coupled=(2.4e-3, 3.5e-10), iteration=5.5e-11, smoothing=2.8e-11,
               beside=1.6e-5, message=6e-6, block=4e-6)


# --- cases ---------------------------------------------------------------------------------------------

@dataclass(frozen=True)
class Case:
    """Channels of the paper side by side (0.4 x 0.1 m, 250 x 63 columns of 30 cells), a dune in each."""
    name: str
    tiles: tuple
    has_grains: bool = True
    sub_steps: int = 100
    iterations: int = 5
    rebuilds: float = 0.7

    @property
    def columns(self):
        return 250 * self.tiles[0], 63 * self.tiles[1]

    @property
    def cells(self):
        return 30 * self.columns[0] * self.columns[1]

    @property
    def grains(self):
        return 1e5 * self.tiles[0] * self.tiles[1] if self.has_grains else 0


PAPER = Case("paper: 1e5 grains", (1, 1))
DUNES = Case("100 dunes: 1e7 grains", (10, 10))
FLOW = Case("1e9 cells, no grains", (46, 46), has_grains=False)
CASES = (PAPER, DUNES, FLOW)
RANKS = (1, 2, 4, 8, 16, 32, 64, 128, 256, 500, 1000)


@cache
def grains_of(case):
    return layouts.columns_of_dunes(case.tiles)


@cache
def layout_of(case, shape):
    return layouts.layout(grains_of(case), shape, case.columns)


# --- the time of a step ----------------------------------------------------------------------------------

PARTS = ("sub-steps", "flow", "uneven", "ghosts", "reductions", "all-to-alls", "halos", "transposes",
         "visits")


def blocks(p):
    """Kernels that pack and unpack the transposes of one solve."""
    return 2 * (4 * p.px * (p.px > 1) + 2 * p.pz * (p.pz > 1))


def flow_compute(case, machine, cells):
    """Without the fixed part."""
    if not case.has_grains:
        return machine.flow[1] * cells
    return cells * (machine.coupled[1] + case.iterations * machine.iteration
                    + counts.SMOOTHINGS * machine.smoothing)


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
    ranks, n, rebuilds = shape[0] * shape[1], case.sub_steps, case.rebuilds
    where = layout_of(case, shape)
    mean, most, b = case.grains / ranks, where.grains.max(), where.worst()
    t["sub-steps"] = n * (machine.substep[0] + machine.substep[1] * mean)
    t["sub-steps"] += rebuilds * (machine.rebuild[0] + machine.rebuild[1] * mean)
    t["flow"] += machine.exchange * mean
    t["uneven"] += (n * machine.substep[1] + rebuilds * machine.rebuild[1]) * max(most - mean, 0)
    t["uneven"] += machine.exchange * max(where.in_pencil.max() - mean, 0)
    if ranks == 1:
        return
    ghosts = ((n - rebuilds) * counts.sub_step(b)
              + rebuilds * (counts.rebuild(b) + counts.Counts(reductions=1)))
    t["ghosts"] = network.seconds(replace(ghosts, reductions=0, all_to_alls=0), ranks)
    t["ghosts"] += rebuilds * machine.rebuild[1] * b.ghosts + n * machine.beside
    t["reductions"] += network.seconds(counts.Counts(reductions=ghosts.reductions + 4), ranks)
    visits = counts.visits(b)
    t["visits"] = network.seconds(replace(visits, all_to_alls=0), ranks)
    calls = ghosts.all_to_alls + visits.all_to_alls
    t["all-to-alls"] = network.seconds(counts.Counts(all_to_alls=calls), ranks)


def total(t):
    return sum(t.values())


# --- tables ------------------------------------------------------------------------------------------------

def row(*cells):
    print("| " + " | ".join(str(c) for c in cells) + " |")


def head(*cells):
    row(*cells)
    print("|" + "---|" * len(cells))


def show(seconds):
    return f"{1e3 * seconds:.3g}"


def fits_in_memory(case, ranks, per_rank):
    """384 bytes a cell (225 of the flow alone) and 704 a grain: docs/performance.md, "Memory"."""
    return ((384 if case.has_grains else 225) * case.cells + 704 * case.grains) / ranks < per_rank


def strong(machine, network, per_rank):
    print(f"\nStrong scaling, a rank a {machine.name}: ms a fluid step, in brackets the efficiency.\n")
    head("ranks", *(c.name for c in CASES))
    for ranks in RANKS:
        row(ranks, *(strong_cell(case, machine, network, ranks, per_rank) for case in CASES))


def ideal(case, machine, ranks):
    """What one rank needs, shared out."""
    return total(step_time(case, machine, Network(), 1)) / ranks


def strong_cell(case, machine, network, ranks, per_rank):
    t = step_time(case, machine, network, ranks) if fits_in_memory(case, ranks, per_rank) else None
    if t is None:
        return "-"
    return f"{show(total(t))} ({100 * ideal(case, machine, ranks) / total(t):.0f} %)"


def shares(case, machine, network, ranks):
    print(f"\n{case.name}, a rank a {machine.name}: ms of a fluid step by what takes them.\n")
    head("ranks", *PARTS, "all")
    for n in ranks:
        t = step_time(case, machine, network, n)
        row(n, *(show(t[part]) for part in PARTS), show(total(t)))


def weak_cases(side):
    """As many dunes for each rank, channels four times as long as wide; up to 1e8 grains."""
    for ranks in (1, 4, 16, 64, 256, 1024):
        if ranks * side**2 > 1100:
            return
        n = round(ranks**0.5)
        yield ranks, Case(f"{ranks}", (side * n, side * n))


def weak(machine, network, side):
    print(f"\nWeak scaling, {side * side} dune(s) of 1e5 grains and as many tiles of cells a rank, a rank a "
          f"{machine.name}.\n")
    head("ranks", "grains", "cells", "ms a fluid step", "efficiency", *PARTS[2:])
    first = None
    for ranks, case in weak_cases(side):
        t = step_time(case, machine, network, ranks)
        first = first or total(t)
        row(ranks, f"{case.grains:.2g}", f"{case.cells:.2g}", show(total(t)),
            f"{100 * first / total(t):.0f} %", *(show(t[part]) for part in PARTS[2:]))


def per_rank_counts(case, ranks):
    print(f"\n{case.name}: what the busiest rank sends in a fluid step.\n")
    head("ranks", "pencils", "messages", "megabytes", "reductions", "all-to-alls", "grains", "ghosts",
         "visitors")
    for n in ranks:
        shape = counts.best_shape(n, *case.columns)
        p = counts.Pencil(case.columns[0], 30, case.columns[1], *shape)
        where = layout_of(case, shape)
        c = counts.coupled_step(p, where.worst(), case.iterations, case.sub_steps, case.rebuilds)
        row(n, f"{shape[0]} x {shape[1]}", f"{c.messages:.0f}", f"{1e-6 * c.bytes:.2f}",
            f"{c.reductions:.0f}", f"{c.all_to_alls:.1f}", f"{where.grains.max():.0f}",
            f"{where.ghosts.max():.0f}", f"{where.visitors.max():.0f}")


# --- beside runs --------------------------------------------------------------------------------------------

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
    where = layouts.layout(layouts.columns_of_grains(x, z, (size[0], size[2])), shape, (cells[0], cells[2]))
    sub_steps = round(config["time"]["fluid_step"] / config["time"]["grain_step"])
    rebuilds = run["communication"]["list_rebuilds"] - 1 / run["steps"]  # the first was before the first step
    return counts.coupled_step(p, where.border(0), run["pressure_iterations_mean"], sub_steps, rebuilds)


def check(folders):
    head("run", "ranks", "messages: model / counted", "megabytes", "reductions", "all-to-alls")
    for folder in map(Path, folders):
        run, config, x, z = read_run(folder)
        model, said = model_of_run(run, config, x, z), run["communication"]
        pairs = ((model.messages, said["messages"]), (1e-6 * model.bytes, said["megabytes"]),
                 (model.reductions, said["reductions"]), (model.all_to_alls, said["all_to_alls"]))
        row(folder.name, run["ranks"], *(f"{a:.1f} / {b:.1f} = {a / b:.3f}" for a, b in pairs))


def tables(network):
    print(f"Network: {1e6 * network.latency:g} us, {1e-9 * network.bandwidth:g} GB/s a rank.")
    for case in (PAPER, DUNES):
        per_rank_counts(case, (2, 8, 64, 500))
    for machine, per_rank, side in ((CORE, 8e9, 1), (H200, 1.2e11, 3)):
        strong(machine, network, per_rank)
        shares(PAPER, machine, network, (1, 8, 64, 500))
        shares(DUNES, machine, network, (1, 64, 1000))
        shares(FLOW, machine, network, (64, 1000))
        weak(machine, network, side)


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("--latency", type=float, default=Network.latency, help="of a message [s]")
    parser.add_argument("--bandwidth", type=float, default=Network.bandwidth, help="of a rank [bytes/s]")
    parser.add_argument("--figure", type=Path, help="draws strong and weak scaling into this PNG file")
    parser.add_argument("--check", nargs="+", metavar="RUN_DIR", help="runs of grains from a CSV file")
    options = parser.parse_args()
    network = Network(options.latency, options.bandwidth)
    try:
        if options.check:
            check(options.check)
        elif options.figure:
            import scaling_figure
            scaling_figure.draw(options.figure, network)
        else:
            tables(network)
    except Problem as problem:
        print(f"scaling: {problem}", file=sys.stderr)
        return 2
    return 0


if __name__ == "__main__":
    sys.exit(main())
