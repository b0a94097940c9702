#!/usr/bin/python3
"""Grains that move in a resolved flow, with the whole program: experiment E4 of ten Cate et al. (2002); the same bits
over threads and a restart; what is refused."""
import csv
import pathlib

import h5py
import numpy as np

import faults

ROOT = pathlib.Path(__file__).resolve().parents[2]
faults.CASE = ROOT / "configs/validation/resolved-settling.toml"
# Little more than six cells a diameter, a cluster of grains that touch as they sink.
SMALL = {"fluid.cells": "[42, 67, 42]", "grains.sizes": "[[0.015, 5]]", "time.fluid_step": 4e-3, "time.end": 0.16,
         "restart.interval": 0.08, "output.fields_interval": 0.08, "output.grains_interval": 0.04,
         "output.tracks_interval": 0.04}


def run(folder, settings, threads=1, restart=None):
    words = [*faults.command(folder, settings, restart), "--threads", str(threads)]
    return faults.subprocess.run(words, env={**faults.ENVIRONMENT, "OMP_NUM_THREADS": str(threads)},
                                 capture_output=True, text=True, timeout=900)


def measured(case):
    lines = (ROOT / "tests/reference/settling_ten_cate2002.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return next(float(row["u_max"]) for row in rows if row["case"] == case)


def largest_speed(folder):
    with h5py.File(folder / "grains.h5") as frames:
        return max(abs(np.asarray(frames[frame]["u"])[:, 1]).max() for frame in frames if "u" in frames[frame])


def test(work):
    whole = work / "whole"
    faults.expect(run(whole, SMALL), 0)
    faults.expect(run(work / "threads", SMALL, threads=2), 0)
    faults.same_run(whole, work / "threads")
    print("1 and 2 threads: the same bits")
    broken = work / "broken"
    faults.expect(run(broken, {**SMALL, "time.end": 0.08}), 0)
    faults.expect(run(broken, SMALL, restart="latest"), 0)
    faults.same_run(whole, broken)
    print("a run that went on: the same bits")
    for key, value, word in (("grains.boundary_x", '"wall"', "boundary_x"), ("fluid.cells", "[30, 48, 30]", "6 cells"),
                             ("fluid.first_cell_height", 1e-3, "rows of different heights"),
                             ("fluid.cells", "[40, 90, 40]", "within 10 %")):
        faults.expect(run(work / "refused", {**SMALL, key: value}), 2, word)
    film = {**SMALL, "grains.contact_model": '"hertz_lubricated"', "time.end": 0.008, "time.grain_step": '"auto"'}
    faults.expect(run(work / "film", film), 0)
    faults.expect(run(work / "long", {**film, "time.grain_step": 4e-3}), 2, "a thin film stops two grains")
    narrow = {**film, "domain.size": "[0.056, 0.16, 0.056]", "fluid.cells": "[24, 69, 24]",
              "grains.sizes": "[[0.015, 1]]", "initial.grains.pour.centre": "[0.028, 0.028]"}
    faults.expect(run(work / "narrow", narrow), 2, "its own image")
    faults.expect(run(work / "no_film", {**narrow, "grains.contact_model": '"hertz_mindlin"'}), 0)
    faults.expect(run(work / "e4", {}, threads=2), 0)
    speed, of = largest_speed(work / "e4"), measured("E4")
    print(f"ten Cate E4: {speed:.4f} m/s, {100 * (speed / of - 1):+.2f} % of the measured")
    if not abs(speed / of - 1) < 0.02:
        faults.fail("that is more than 2 % off")


if __name__ == "__main__":
    faults.in_a_new_folder(test)
