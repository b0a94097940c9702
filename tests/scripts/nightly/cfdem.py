#!/usr/bin/python3
"""Comparison with CFDEM (docs/validation.md): our side again, from the same cases, against what CFDEM gave from
the same states (tests/reference/cfdem_*.csv). Some ten minutes on one core. BARCHAN_CFDEM_RUNS names a folder for the
runs, which are used again; with BARCHAN_RESULTS the tables for the figure are written there."""
import os
import pathlib
import sys
import tempfile

import numpy as np

import beside_cfdem as beside
import ergun_bed
import moving_heap
import saved_tables
from ranges import measured, status


def held(name, runs):
    """Forces on the grains of a bed or a heap that are held in one flow."""
    state = beside.held_state(beside.run_held(name, runs / f"held-{name}"))
    rows = [row for row in beside.read("held_grains") if row["case"] == name]
    index = beside.index_of(state, rows)
    reference = {part: beside.mean_of(name, part) for part in ("drag", "rest")}
    if index is None:  # starts are chaotic: another compiler may pack another bed, another order of sums stir the flow
        print(f"{name}: the starts give another state here: means alone, of another bed and another flow")
        measured(f"{name}: mean of our drag over CFDEM's", state.drag.mean() / reference["drag"], 0.2, 1)
        return state
    theirs = {way: np.array([row[way] for row in rows]) for way in ("interpolated", "cell")}
    # By the fields of its cell: solid fraction, smoothing and drag law are CFDEM's (its file has five digits).
    measured(f"{name}: largest difference of a grain's drag, read in the cell, over the largest",
             np.abs(state.drag_of_cell[index] - theirs["cell"]).max() / np.abs(theirs["cell"]).max(), 0, 1e-3)
    # Read as CFDEM interpolates; it takes alpha_f from other tetrahedra, worth up to 1.7 % of the sum.
    faithful = beside.held_state(beside.run_held(name, runs / f"held-{name}-faithful", coupling__scheme="cfdem",
                                               coupling__cfdem__smooth_exchange="true"))
    measured(f"{name}: mean drag of the scheme cfdem over its", faithful.drag.mean() / reference["drag"], 0.97, 1.03)
    measured(f"{name}: its correlation grain by grain",
             np.corrcoef(faithful.drag[index], theirs["interpolated"])[0, 1], 0.999, 1)
    # Our own reading, between the faces, gives less where the velocity rises steeply: 15 % about what was found.
    ours = {"bed": 0.585, "heap": 0.385}[name]
    measured(f"{name}: mean of our drag over CFDEM's", state.drag.mean() / reference["drag"], 0.85 * ours, 1.15 * ours)
    measured(f"{name}: its correlation grain by grain", np.corrcoef(state.drag[index], theirs["interpolated"])[0, 1],
             {"bed": 0.9, "heap": 0.75}[name], 1)
    measured(f"{name}: mean of pressure gradient and stress over CFDEM's", state.rest.mean() / reference["rest"], 0.9, 1.15)
    return state


def ergun(runs):
    """Pressure drop of the tutorial's bed over velocity, below 11 mm/s: above it the tutorial's loose bed begins to lift
    off. It settles first and loosens later, by 3 % of the drop; 5 % with that of PackedBed."""
    drops = []
    for row in beside.read("ergun"):
        if row["superficial"] > 0.011:
            break
        folder = runs / f"ergun-{row['superficial']:g}"
        case = folder / "ergun.toml" if folder.exists() else ergun_bed.write_case(folder, row["superficial"])
        drop = ergun_bed.drop(beside.run(case, folder / "run"))
        measured(f"Ergun's bed at {row['superficial']:g} m/s: drop over CFDEM's", drop / row["drop"], 0.95, 1.05)
        drops.append((row["superficial"], drop))
    return drops


def heap(runs):
    """The heap of 10,000 grains in flow. It spreads alike and is driven half as far: CFDEM's grains get 1.7 times what
    its water loses. Of CFDEM's at 0.3 s, realisations gave H 1.58 to 1.83, shift 0.44 to 0.60, moving 0.49 to 0.82: these
    bounds hold them and not 1. At 0.5 s shift was 0.52 and 0.69, moving 0.50 and 0.57, and H 1.54 and 1.08: no longer
    apart. W and L are held to 10 and 20 %."""
    run = beside.run(beside.CASES / "cfdem-heap.toml", runs / "cfdem-heap")
    moving = moving_heap.Heap(run)
    foot = [("W", 0.9, 1.1), ("L", 0.8, 1.2)]
    bounds = {0.3: [*foot, ("H", 1.2, 2.2), ("shift", 0.33, 0.65), ("moving", 0.4, 0.9)],
              0.5: [*foot, ("shift", 0.4, 0.85), ("moving", 0.4, 0.9)]}
    for time, row in bounds.items():
        ours, theirs = (next(r for r in rows if abs(r["t"] - time) < 1e-6)
                        for rows in (moving.series(), beside.read("heap")))
        for name, low, high in row:
            measured(f"heap in flow at {time:g} s: {name} over CFDEM's", ours[name] / theirs[name], low, high)
    return run, moving


def main():
    with tempfile.TemporaryDirectory() as folder:
        runs = pathlib.Path(os.environ.get("BARCHAN_CFDEM_RUNS", folder))
        states = {name: held(name, runs) for name in beside.HELD}
        drops, moving = ergun(runs), heap(runs)
        if "BARCHAN_RESULTS" in os.environ:
            saved_tables.write(pathlib.Path(os.environ["BARCHAN_RESULTS"]), states, drops, *moving)
    return status("beside CFDEM")


sys.exit(main())
