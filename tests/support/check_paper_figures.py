#!/usr/bin/env python3
"""Compares the numbers behind the figures of a synthetic run or study with what make_fake_run put in.

    check_paper_figures.py profiles|topviews|morphology|movie|tracks FOLDER
    check_paper_figures.py add_tracks FOLDER      tracks.h5 with 7 frames, its rows in another order
"""

import sys
from pathlib import Path

import numpy as np

from make_fake_run import (D, END, SIZE, STUDY, U_STAR, h5py, known_flow, known_width, open_file, shape,
                           surface, write_frame)

DX = SIZE[0] / 100


def read(folder, name):
    return np.genfromtxt(folder / "figures_data" / f"{name}.csv", delimiter=",", names=True,
                         deletechars="")


def near(found, expected, tolerance, what):
    worst = np.max(np.abs(np.asarray(found) - expected))
    if not worst <= tolerance:
        sys.exit(f"{what}: off by {worst:.3g}, more than {tolerance:.3g}")


def check_profiles(folder):
    """At each station the known flow, in axes along it; h and L of the known surface."""
    table = read(folder, "profiles_over_dune")
    stations = np.unique(table["x_over_L"])
    if len(stations) != 5:
        sys.exit(f"{len(stations)} stations, not 5")
    middle = 0.5 * SIZE[2]
    near(table["z_m"], middle, 0.5 * D, "plane of symmetry")
    x = np.linspace(0, SIZE[0], 20001)
    sand = x[surface(x, middle + 0 * x, END) > 0]
    length = np.polyfit(table["x_over_L"], table["x_m"], 1)
    near(length[1], sand[0], 2 * D, "foot of the dune")  # a bin is 2.5 d
    near(length[0], sand[-1] - sand[0], 4 * D, "L")
    near(table["h_m"], surface(table["x_m"], table["z_m"], END), 2 * D, "h")  # mean over 3 bins
    y = table["y_d_m"] + table["h_m"]
    angle, speed, along, across, mixed = known_flow(table["x_m"], y, table["z_m"])
    # Linear interpolation between columns dx apart is off by dx^2/8 times the second derivative, of q cos a
    # and q sin a with q' = 75 /s, a' = 8 rad/m, a and q below 0.1 rad and 1 m/s.
    error = DX**2 / 8 * (2 * 75 * 8 * 0.1 + 64) + 1e-6
    error_v = DX**2 / 8 * (2 * 75 * 8 + 64 * 0.1) + 1e-6
    near(table["u_m_s"], speed, error, "u along the flow")
    near(table["v_vertical_m_s"], speed * np.sin(angle), error_v, "v")
    if not (speed < 0).any():
        sys.exit("no reversed flow in the profiles")
    moving = abs(speed) > 0.03  # the direction of still water is not known
    near(table["angle_rad"][moving], angle[moving], 1e-3, "direction of the flow")
    for name, known in (("uu", along), ("vv", across), ("uv", mixed)):
        near((table[f"{name}_m2_s2"] - known)[moving], 0.0, 2e-3 * along.max(), name)
    near(table["minus_uv_over_u_star2"][moving], -mixed[moving] / U_STAR**2, 0.02, "-uv/u_star2")
    z, x = np.meshgrid((np.arange(40) + 0.5) * SIZE[2] / 40, (np.arange(100) + 0.5) * DX)
    faces = SIZE[1] * np.expm1(2.5 * np.array([29, 30]) / 30) / np.expm1(2.5)
    angle, speed = known_flow(x, faces.mean(), z)[:2]
    near(table["u_over_U_delta"], table["u_m_s"] / np.mean(speed * np.cos(angle)), 1e-5, "u/U_delta")


def check_morphology(folder):
    """W of each case, within six times its noise; the base case is in both series."""
    for key, position in (("sliding_friction", 0), ("restitution", 1)):
        table = read(folder, f"morphology_{key}")
        expected = {values[position]: wider for _, varied, values, wider, _ in STUDY
                    if wider and varied in (None, f"grains.{key}")}
        column = table[f"grains.{key}"]
        if list(dict.fromkeys(column)) != sorted(expected):
            sys.exit(f"values of {key}: {list(dict.fromkeys(column))}, not {sorted(expected)}")
        for value, wider in expected.items():
            rows = table[column == value]
            near(rows["W_m"], wider * known_width(rows["t_s"]), 6e-4, f"W at {key} = {value}")
            near(rows["L_m"], wider * known_width(rows["t_s"]) - shape(rows["t_s"])[1], 6e-4, "L")
            near(rows["Cx_from_start_m"], shape(rows["t_s"])[0] - shape(0)[0], 3e-4, "C_x - C_x(0)")
            near(rows["Cz_from_middle_m"], 0.0, 3e-4, "C_z")


def check_topviews(folder):
    table = read(folder, "topviews_sliding_friction")
    if list(np.unique(table["grains.sliding_friction"])) != [0.2, 0.6] or len(table) != 6:
        sys.exit("topviews are not of two values at three times")
    near(table["t_frame_s"], table["t_row_s"], 1e-9, "time of a row")
    near(table["z_mean_m"], 0.5 * SIZE[2], 2 * D, "z of the grains")


def check_cases(folder):
    """The curves of each case under its name: those of check_morphology, height and grains as in dune.csv."""
    with open(folder / "figures_data" / "morphology_case.csv", encoding="utf-8") as file:
        rows = [line.rstrip("\n").split(",") for line in file]
    header, rows = rows[0], rows[1:]
    for name, _, _, wider, _ in STUDY:
        if not wider:
            continue
        mine = np.array([row[1:] for row in rows if row[0] == name], float)
        dune = np.genfromtxt(folder / name / "dune.csv", delimiter=",", names=True)
        dune = dune[dune["dune"] == 0]
        for column, known in (("H_m", dune["H"]), ("n_grains", dune["n_grains"])):
            near(mine[:, header.index(column) - 1], known, 1e-8 * known.max(), f"{column} of {name}")
        near(mine[:, header.index("W_m") - 1], wider * known_width(dune["t"]), 6e-4, f"W of {name}")


def check_movie(folder):
    table = read(folder, "movie")
    near(table["t_s"], np.linspace(0, END, 4), 1e-6, "times of the movie")


def add_tracks(folder):
    with h5py.File(folder / "grains.h5") as grains, open_file(folder / "tracks.h5") as file:
        for index in range(7):
            frame = grains[f"frame_{index // 2:06d}"]
            write_frame(file, index, index * END / 6, {"id": frame["id"][:][::-1],
                                                       "x": frame["x"][:][::-1].astype("f4")})


def check_tracks(folder):
    table = read(folder, "movie")
    near(table["t_s"], np.linspace(0, END, 7), 1e-6, "times of the movie of tracks.h5")
    with h5py.File(folder / "grains.h5") as grains:
        known = set(grains["frame_000000/id"][:]) | set(grains["frame_000003/id"][:])
        shown = len(known & set(grains["frame_000001/id"][:]))
    near(table["n_grains"][2], shown, 0, "grains with a known diameter")


if __name__ == "__main__":
    {"profiles": check_profiles, "topviews": check_topviews, "morphology": check_morphology,
     "cases": check_cases, "movie": check_movie, "tracks": check_tracks,
     "add_tracks": add_tracks}[sys.argv[1]](Path(sys.argv[2]))
