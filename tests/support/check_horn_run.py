#!/usr/bin/env python3
"""Compares the CSV files of the horn figures with what make_horn_run.py knows; a line per difference.

    check_horn_run.py RUN_DIR shape|origins|numbers|straight|force|force_100|map ...
"""

import sys
from pathlib import Path

import numpy as np

D = 2e-4
WRONG = []


def read(run, name):
    path = Path(run) / f"{name}.csv"
    if not path.exists():
        sys.exit(f"no {path}")
    return np.genfromtxt(path, delimiter=",", names=True, dtype=None, encoding=None)


def same(what, found, wanted, tolerance=0.0):
    found, wanted = np.asarray(found, float), np.asarray(wanted, float)
    if found.shape != wanted.shape:
        WRONG.append(f"{what}: {found.shape} numbers, expected {wanted.shape}")
    elif not np.all(abs(found - wanted) <= tolerance):  # NaN is a difference
        worst = np.nanargmax(abs(found - wanted)) if found.ndim else ()
        WRONG.append(f"{what}: {found[worst]}, expected {wanted[worst]}")


def origins(run):
    """Every horn grain, where it began and where its path leads, up to the time of expected.csv."""
    found, wanted = read(run, "figures_data/horn_origins"), read(run, "expected")
    same("ids of the horn grains", found["id"], wanted["id"])
    if WRONG:
        return
    for name in ("side", "first_t", "latest_t", "in_horn_at_end"):
        same(name, found[name], wanted[name])
    same("phi", found["phi_deg"], wanted["phi_deg"], 1e-2)  # tracks.h5 holds single precision
    same("r", found["r_over_R"], wanted["r_over_R"], 1e-5)
    paths = read(run, "figures_data/horn_paths")
    for number in np.unique(paths["id"]):
        path, grain = paths[paths["id"] == number], wanted[wanted["id"] == number][0]
        same(f"end of the path of {number}", [path["x_over_R"][-1], path["z_over_R"][-1]],
             [grain["x_over_R"], grain["z_over_R"]], 1e-5)
        same(f"time of that of {number}", path["t"][-1], grain["latest_t"])
    bins = read(run, "figures_data/horn_origins_phi")
    same("sum of shares", bins["share"].sum(), 1.0, 1e-7)


def numbers(run):
    """How many grains each horn holds at each time, and from which sectors all of them came."""
    wanted, horns = read(run, "expected"), read(run, "figures_data/horns")
    for side, column in ((-1, "n_left"), (1, "n_right")):
        rows = (wanted["side"] == side)
        for t, n in zip(horns["t"], horns[column]):
            if t > wanted["latest_t"].max():
                break
            there = rows & (wanted["first_t"] <= t) & (wanted["latest_t"] >= t)
            same(f"{column} at {t}", n, np.count_nonzero(there))
    phi, said = wanted["phi_deg"], values(run)
    share = np.mean(((phi >= 105) & (phi <= 160)) | ((phi >= 210) & (phi <= 260)))
    same("share in the sectors", said["share_in_sectors"], share, 1e-8)
    same("share upstream", said["share_upstream"], np.mean((phi > 90) & (phi < 270)), 1e-8)


def straight(run):
    """Known without any calculation: lengths and numbers of the blocks."""
    found, horns = read(run, "figures_data/horn_origins"), read(run, "figures_data/horns")
    same("grains in both arms", len(found), 375)
    same("left and right ones", [np.sum(found["side"] == -1), np.sum(found["side"] == 1)], [150, 225])
    same("those of the left arm are the first 150", found["id"][found["side"] == -1], 10 + 2 * np.arange(150))
    same("in the horns at the end", found["in_horn_at_end"].sum(), 360)
    same("left horn", horns["horn_left"], D * np.array([0, 0, 10, 10, 9]), 1e-9)
    same("right horn", horns["horn_right"], D * np.array([0, 0, 15, 15, 15]), 1e-9)
    same("upstream share", horns["upstream_share"][2:4], [300 / 375] * 2, 1e-9)
    said = values(run)
    same("share in the sectors", said["share_in_sectors"], 0.8, 1e-9)
    same("uniform", said["share_in_sectors_uniform"], 105 / 360, 1e-9)
    same("share upstream", said["share_upstream"], 0.8, 1e-9)


def force(run, factor):
    """Force from the frames: of one sign up and down the stream, left and right."""
    bins = read(run, "figures_data/force_map")
    phi = 0.5 * (bins["phi_min"] + bins["phi_max"])
    upstream = (phi > 90) & (phi < 270)
    F_x, F_z = factor * np.where(upstream, 2e-7, -1e-7), factor * np.where(phi < 180, -3e-8, 3e-8)
    same("F_x", bins["F_x"], F_x, 1e-6 * factor * 2e-7)
    same("F_z", bins["F_z"], F_z, 1e-6 * factor * 2e-7)


def program_map(run):
    """The program's own map is shown as it is; the means over the regions are those put in."""
    drawn, given = read(run, "figures_data/force_map"), read(run, "force_map")
    for name in drawn.dtype.names:
        same(name, drawn[name], given[name], 1e-9 * abs(given[name]).max())
    said = values(run)
    for name, wanted in (("F_x_upstream", 3e-7), ("F_x_crest", -2e-7), ("F_x_between_horns", -1e-7),
                         ("F_z_outward_upstream", 4e-8), ("F_z_outward_downstream", -5e-8)):
        same(name, said[name], wanted, 1e-15)


def shape(run):
    """The grains found in the horns, turned and across the seams, reach as far from the lee foot that is found as
    dune.csv says, which make_horn_run.py wrote from the blocks alone; and the curves of the morphology figure."""
    from barchan.io.run_folder import RunFolder
    from barchan.dune.tracks import Tracks

    table, tracks = read(run, "dune"), Tracks(RunFolder(run))
    for index, row in enumerate(table[table["dune"] == 0]):
        dune = tracks.main_dune(tracks.read(index))
        for name in ("W", "L", "H", "horn_left", "horn_right"):
            same(f"{name} at {row['t']} s", getattr(dune, name), row[name], 0)
        for side, name in ((-1, "horn_left"), (1, "horn_right")):
            tip = np.max(dune.x[dune.side == side] + 0.5 * D, initial=dune.lee_foot)
            same(f"reach of {name} at {row['t']} s", tip - dune.lee_foot, row[name], 1e-8)  # single precision
        for axis, name in enumerate(("Cx", "Cy", "Cz")):
            difference = tracks.bed.nearest(dune.centroid - [row["Cx"], row["Cy"], row["Cz"]])[axis]
            same(f"{name} at {row['t']} s", difference, 0.0, 1e-8)
    curves = read(run, "figures_data/morphology")
    for name in ("W", "L", "H", "horn_left", "horn_right"):
        same(f"{name} of the figure", curves[name], table[table["dune"] == 0][name], 1e-10)  # nine digits
    for name in ("horn_left_2d", "horn_right_2d"):  # frames are a second apart: medians of two
        high = table[table["dune"] == 0][name]
        same(f"{name}_1s", curves[name + "_1s"], [high[0], *0.5 * (high[1:] + high[:-1])], 1e-10)
        if not high.any():
            raise SystemExit(f"{name} is nowhere: the check is empty")


def values(run):
    table = read(run, "figures_data/sectors")
    return dict(zip(table["quantity"], table["value"]))


CHECKS = {"shape": shape, "origins": origins, "numbers": numbers, "straight": straight, "map": program_map,
          "force": lambda run: force(run, 1.0), "force_100": lambda run: force(run, 100.0)}


def main(run, *names):
    for name in names:
        CHECKS[name](run)
    for line in WRONG[:5]:
        print(line)
    return bool(WRONG)


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
