#!/usr/bin/env python3
"""Writes a synthetic run whose dune is made of blocks of grains: W, L, H, horns and their grains are known.

    make_horn_run.py OUT_DIR [--angle DEGREES] [--seam] [--tracks] [--without table|dune] [--program-map]
                     [--until T]

A round heap moves, then is a block of 20 x 30 diameters with two arms downstream, 10 (left) and 15
(right) diameters long; in the last frame the left one has lost the row at its tip. --angle turns all
about the vertical axis, --seam lays it across the periodic boundaries in x and z, --tracks writes
tracks.h5 beside a grains.h5 with one frame. A smaller dune lies downstream. What the figures must find
is in expected.csv: from the coordinates before they are wrapped, without bins or a height map.
"""

import argparse
from pathlib import Path

import numpy as np

from make_fake_run import h5py, write_frame

D = 2e-4
SIZE = (0.06, 0.01, 0.02)
TIMES = (0.0, 1.0, 2.0, 3.0, 4.0)
START = 2.0                               # of the averages [s]; the dune is there from then on
STEP = np.array([1.1e-3, 0.0, -2.5e-4])   # the dune's way between frames [m]
MAIN, ARMS, LEFT_ARM = 2775, 375, 150     # grains
CREST = 3 * D                             # crest from the centroid, as dune.csv is to say
HIGH = np.array([0.5, 0.75])              # of the left and right horn, two grains high
HEADER = "t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost,flux,horn_left_2d,horn_right_2d"


def block(s, q, layers):
    """Grains (n, 3) on a square lattice: s downstream, q to the right [diameters], from ... to."""
    grid = np.meshgrid(np.arange(*s) + 0.5, np.arange(layers) + 0.5, np.arange(*q) + 0.5, indexing="ij")
    return np.stack([axis.ravel() for axis in grid], axis=1)


def dune_lattice():
    """Left arm, right arm, body; about the middle of the body."""
    parts = [block((20, 30), (-15, -10), 3), block((20, 35), (10, 15), 3), block((0, 20), (-15, 15), 4)]
    return np.concatenate(parts) - (10, 0, 0)


def heap_lattice():
    """A round heap, four layers, of at least as many grains as the dune."""
    stacks = block((-16, 16), (-16, 16), 4)
    return stacks[np.hypot(stacks[:, 0], stacks[:, 2]) ** 2 <= 224.0]


def polar_angle(x):
    return np.degrees(np.arctan2(-x[:, 2], x[:, 0])) % 360.0


def turn(x, degrees):
    """Adds `degrees` to the polar angle."""
    a = np.radians(degrees)
    return np.stack([x[:, 0] * np.cos(a) + x[:, 2] * np.sin(a), x[:, 1],
                     x[:, 2] * np.cos(a) - x[:, 0] * np.sin(a)], axis=1)


def order_of_heap(heap):
    """Rows of the heap so that the first 150 go to the left arm, the next 225 to the right one.

    Four of five of each come from 105-160 and 210-260 degrees, the others from downstream.
    """
    phi, taken = polar_angle(heap), []
    for low, high, n in ((106, 159, 120), (40, 70, 30), (211, 259, 180), (300, 330, 45)):
        taken.extend(np.nonzero((phi > low) & (phi < high))[0][:n])
    return np.concatenate([taken, np.setdiff1d(np.arange(len(heap)), taken)])


def make_frames(options):
    """Positions (N, 3) of each frame, not wrapped, NaN for what has left; the main dune's ids come first."""
    heap = heap_lattice()
    heap = D * turn(heap[order_of_heap(heap)], options.angle)
    dune = D * turn(dune_lattice(), options.angle)
    middle = np.array([0.0585, 0, 4e-4]) if options.seam else np.array([0.012, 0, 0.01])
    other = D * block((0, 12), (-6, 6), 4) + middle + (0.03, 0, 0)
    frames = []
    for number, _ in enumerate(TIMES):
        main = heap.copy()
        if number >= 2:
            main[:len(dune)], main[len(dune):] = dune, np.nan  # those that the dune does not need leave the domain
        if number == 4:
            tip = tip_rows()
            main[tip] = np.stack([15e-3 + 1e-3 * np.arange(len(tip)), 0 * tip + 0.5 * D, 0.0 * tip], axis=1)
        frames.append(np.concatenate([main + middle + number * STEP, other]))
    return frames, len(heap)


def tip_rows():
    return np.nonzero((dune_lattice()[:, 0] > 19) & (dune_lattice()[:, 2] < 0))[0]


def measure(x):
    """centroid, W, L, H, left, right horn, side (n) of the main dune, by its definitions alone."""
    centroid, edge = x.mean(axis=0), x[:, 0] + 0.5 * D
    strip = abs(x[:, 2] - centroid[2]) < 3 * D
    foot = edge[strip].max()
    side = np.where(strip | (edge <= foot), 0, np.where(x[:, 2] < centroid[2], -1, 1))
    horns = [edge[side == s].max(initial=foot) - foot for s in (-1, 1)]
    for s, length in zip((-1, 1), horns):
        if length < 2.5 * D:
            side[side == s] = 0
    return centroid, np.ptp(x[:, 2]) + D, foot - x[strip, 0].min() + 0.5 * D, 4 * D, *horns, side


def force(x, centroid, t):
    """Upstream of the centroid forward, downstream of it backward, across it outward; first much larger."""
    factor = 1.0 if t >= 2 else 100.0
    return factor * np.stack([np.where(x[:, 0] < centroid[0], 2e-7, -1e-7), 0 * x[:, 0],
                              3e-8 * np.sign(x[:, 2] - centroid[2])], axis=1)


def write_h5(folder, options, frames, measured, n_heap):
    random = np.random.default_rng(5)
    with h5py.File(folder / "grains.h5", "w") as grains, h5py.File(folder / "tracks.h5", "w") as tracks:
        for number, (t, x) in enumerate(zip(TIMES, frames)):
            ids = random.permutation(np.nonzero(np.isfinite(x[:, 0]))[0])
            wrapped = x[ids] % (SIZE[0], 1.0, SIZE[2])
            label = np.where(ids < n_heap, 0, 1)
            label[~np.isin(ids, main_rows(x, number, n_heap)) & (ids < n_heap)] = -1
            arrays = {"id": 10 + 2 * ids} | ({} if "dune" in options.without else {"dune": label})
            write_frame(tracks, number, t, arrays | {"x": wrapped.astype(np.float32)})
            if not (number and options.tracks):
                total = force(x[ids], measured[number][0], t).astype(np.float32)
                write_frame(grains, number, t,
                            arrays | {"x": wrapped, "d": np.full(len(ids), D), "force_total": total})
    if not options.tracks:
        (folder / "tracks.h5").unlink()


def write_table(folder, measured):
    lines = [HEADER]
    for t, (centroid, W, L, H, left, right, _) in zip(TIMES, measured):
        C = centroid % (SIZE[0], 1.0, SIZE[2])
        crest = (C[0] + CREST) % SIZE[0]
        lines.append(",".join(f"{v:.12g}" for v in (t, 0, MAIN, W, L, H, *C, left, right, crest, 1e-8,
                                                    1e-3, 0, 0, *HIGH * [left, right])))
        lines.append(f"{t},1,576,{12 * D},{12 * D},{4 * D},{(C[0] + 0.03) % SIZE[0]},0,{C[2]},0,0,0,2e-9,0,0,0,0,0")
    (folder / "dune.csv").write_text("\n".join(lines) + "\n")


def write_expected(folder, frames, measured, n_heap, until):
    """One line per grain that is ever in a horn: where it began, when it was there, its last place there."""
    start, R = frames[0] - measured[0][0], 0.25 * (measured[0][1] + measured[0][2])
    phi, r = polar_angle(start), np.hypot(start[:, 0], start[:, 2]) / R
    measured = [one for one, t in zip(measured, TIMES) if t <= until]
    sides = np.zeros((len(measured), n_heap), int)
    for number, one in enumerate(measured):
        sides[number, main_rows(frames[number], number, n_heap)] = one[-1]
    lines = ["id,side,phi_deg,r_over_R,first_t,latest_t,in_horn_at_end,x_over_R,z_over_R"]
    for row in np.nonzero(sides.any(axis=0))[0]:
        there = np.nonzero(sides[:, row])[0]
        place = (frames[there[-1]][row] - measured[0][0]) / R
        lines.append(f"{10 + 2 * row},{sides[there[0], row]},{phi[row]:.9g},{r[row]:.9g},{TIMES[there[0]]},"
                     f"{TIMES[there[-1]]},{int(sides[-1, row] != 0)},{place[0]:.9g},{place[2]:.9g}")
    (folder / "expected.csv").write_text("\n".join(lines) + "\n")


def main_rows(x, number, n_heap):
    """The grains of the main dune: without the other dune, those that left and the tip that came off."""
    rows = np.nonzero(np.isfinite(x[:n_heap, 0]))[0]
    return np.setdiff1d(rows, tip_rows()) if number == 4 else rows


def write_program_map(folder, measured):
    """A force_map.csv that is constant in the regions about which the paper speaks."""
    lines = ["r_min,r_max,phi_min,phi_max,n,F_x,F_y,F_z,t_start,t_end"]
    W, L = (np.mean([one[i] for one, t in zip(measured, TIMES) if t >= START]) for i in (1, 2))
    for ring in range(10):
        for phi in range(0, 360, 15):
            if ring == 9 and phi >= 90:
                continue  # empty bins are left out
            r = (ring + 0.5) * 2 * D
            x, z = r * np.cos(np.radians(phi + 7.5)), -r * np.sin(np.radians(phi + 7.5))
            inner = abs(z) < W / 4
            F_x = 3e-7 if x < CREST - L / 10 else 0.0
            if inner and F_x == 0.0:
                F_x = -2e-7 if x <= CREST + L / 10 else -1e-7
            F_z = np.sign(z) * (4e-8 if x < CREST else -5e-8)
            lines.append(f"{2 * D * ring:.9g},{2 * D * (ring + 1):.9g},{phi},{phi + 15},{1 + ring},"
                         f"{F_x:.9g},0,{F_z:.9g},{START},{TIMES[-1]}")
    (folder / "force_map.csv").write_text("\n".join(lines) + "\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--angle", type=float, default=0.0)
    parser.add_argument("--seam", action="store_true")
    parser.add_argument("--tracks", action="store_true")
    parser.add_argument("--without", action="append", default=[], choices=("table", "dune"))
    parser.add_argument("--program-map", action="store_true", help="with a force_map.csv")
    parser.add_argument("--until", type=float, default=TIMES[-1], help="time of expected.csv")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    frames, n_heap = make_frames(options)
    measured = [measure(x[main_rows(x, number, n_heap)]) for number, x in enumerate(frames)]
    write_h5(options.out, options, frames, measured, n_heap)
    if "table" not in options.without:
        write_table(options.out, measured)
    if options.program_map:
        write_program_map(options.out, measured)
    write_expected(options.out, frames, measured, n_heap, options.until)
    boundary = "periodic" if options.seam else "exit"
    (options.out / "config.toml").write_text(
        f'[case]\ntitle = "dune of blocks"\n[domain]\nsize = [{SIZE[0]}, {SIZE[1]}, {SIZE[2]}]\n'
        f'[grains]\nboundary_x = "{boundary}"\n[statistics]\nstart = {START}\n')


if __name__ == "__main__":
    main()
