#!/usr/bin/env python3
"""Writes a synthetic run folder: a heap that turns into a barchan, with the flow over it.

    make_fake_run.py OUT_DIR [--without grains|fields|tables] [--cut] [--average] [--study] [--heaps] [--bodies] [--clumps]

The formats are those of a run; nothing is simulated. `--cut` leaves the folder as a killed run
would: a CSV line without its end, a frame without its arrays, no run.json. `--average` adds
flow_average.h5 of a known flow, `--study` writes a study folder with such runs as its cases, `--heaps`
gives every third grain to another heap. `--clumps` makes
grains of two kinds, single spheres and dimers. `--bodies` puts a cylinder and a fence in the way, with bodies.csv of known
forces.
"""

import argparse
import json
import os
import re
from pathlib import Path

import numpy as np

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
import h5py  # noqa: E402
from survey import survey  # noqa: E402

SIZE = (0.1, 0.025, 0.04)  # [m]
D = 2e-4                   # mean diameter [m]
END, FRAMES = 8.0, 17
U_STAR = 0.0168            # friction velocity [m/s]
CONFIG = f"""[case]
title = "synthetic barchan"
[time]
end = {END}
[domain]
size = [{SIZE[0]}, {SIZE[1]}, {SIZE[2]}]
"""


BODIES = """[[body]]
name = "pile"
shape = "cylinder"
centre = [0.06, 0.02]
radius = 0.003
height = 0.012
[[body]]
name = "fence"
shape = "fence"
centre = [0.08, 0.02]
radius = 5e-4
height = 0.002
spacing = 0.002
length = 0.012
"""
REATTACHED = 0.012       # [m]
FORCES = (2e-4, 5e-5)  # of the water along x on each body [N]


def write_forces(folder):
    """Noise about the known forces from 1 s on, no force before; grains push with a tenth of it, and lift is half."""
    random = np.random.default_rng(3)
    names = [f"{kind}{what}_{axis}" for kind in ("", "grain_") for what in ("force", "torque") for axis in "xyz"]
    rows = []
    for t in np.linspace(0, END, 161):
        for body, force in enumerate(FORCES):
            fx = force * (1 + 0.1 * random.normal()) if t >= 1 else 0.0
            one = [fx, 0.5 * fx, 0.0, 0.0, 0.0, -0.006 * fx]
            rows.append([t, body, *one, *(0.1 * value for value in one), 7])
    write_csv(folder / "bodies.csv", ",".join(["t", "body", *names, "n_contacts"]), np.array(rows).T)


def shape(t):
    """Centre and horn length at time t [m]."""
    return 0.025 + 2.5e-3 * t, 4e-3 * (1 - np.exp(-t / 3))


def surface(x, z, t):
    """Height of the dune at time t [m]."""
    centre, horn = shape(t)
    radius = 6e-3 + 1.2e-3 * (1 - np.exp(-t))
    x, z = x - centre, z - 0.5 * SIZE[2]
    r = np.hypot(x, z)
    lee = np.hypot(x - 2.2 * radius + 1.4 * horn, z) - 1.2 * radius
    return np.clip(np.minimum(0.28 * (radius - r), 0.55 * np.maximum(lee, 0)), 0, None)


def known_width(t):
    """Width of the dune in dune.csv at time t, less noise of 1e-4 [m]."""
    return 12e-3 + 2.4e-3 * (1 - np.exp(-t))


def make_grains(t, random):
    """x (N, 3), d (N) and dune (N) of grains under the surface, and of a few that have left the dune."""
    side = np.arange(0, 0.03, 0.93 * D)
    x, z = np.meshgrid(shape(t)[0] - 0.015 + side, 0.5 * SIZE[2] - 0.015 + side, indexing="ij")
    x, z = x.ravel(), z.ravel()
    layers = np.ceil(surface(x, z, t) / (0.85 * D)).astype(int)
    x, z = np.repeat(x, layers), np.repeat(z, layers)
    layer = np.arange(layers.sum()) - np.repeat(np.cumsum(layers) - layers, layers)
    stray = int(30 * t)
    x = np.append(x, shape(t)[0] + random.gamma(2.0, 8e-3, stray))
    z = np.append(z, 0.5 * SIZE[2] + random.normal(0, 5e-3, stray))
    layer = np.append(layer, np.zeros(stray, int))
    position = np.stack([x, (layer * 0.85 + 0.5) * D, z], axis=1)
    position += random.uniform(-0.15, 0.15, position.shape) * D
    dune = np.where(np.arange(len(x)) < len(x) - stray, 0, -1)
    inside = (position[:, 0] < SIZE[0]) & (abs(position[:, 2] / SIZE[2] - 0.5) < 0.5)
    position, dune = position[inside], dune[inside]
    position[:, 1] = np.maximum(position[:, 1], 0.5 * D)
    d = D * random.choice([0.75, 0.875, 1.0, 1.125, 1.25], len(position), p=[0.02, 0.14, 0.68, 0.14, 0.02])
    return position, d, dune


def make_flow(t, x, y, z):
    """A logarithmic profile lifted by the dune, with reversed flow behind the crest."""
    u_star, centre = U_STAR, shape(t)[0]
    z3, y3, x3 = np.meshgrid(z, y, x, indexing="ij")
    h = surface(x3, z3, t)
    above = np.maximum(y3 - h, 0)
    u = u_star / 0.41 * np.log(1 + 9 * 0.41 * above * u_star / 1e-6)
    wake = np.exp(-((x3 - centre - 9e-3) / 6e-3)**2 - ((z3 - 0.02) / 5e-3)**2 - (y3 / 1.6e-3)**2)
    u = u * (1 + 0.3 * h / 2e-3 * np.exp(-above / 2e-3)) - 0.16 * wake * (1 - np.exp(-t))
    slope = (surface(x3 + 5e-4, z3, t) - surface(x3 - 5e-4, z3, t)) / 1e-3
    v = u * slope * np.exp(-above / 3e-3)
    alpha_f = np.where(y3 < h, 0.4, 1.0)
    return {"u": u * alpha_f, "v": v * alpha_f, "w": 0 * u, "p": 0 * u, "alpha_f": alpha_f,
            "nu_t": 1e-7 + 0 * u}


def open_file(path):
    file = h5py.File(path, "w")
    file.attrs.update(config=CONFIG, version="0.0", git_hash="none", backend="none",
                      title="synthetic barchan")
    return file


def write_frame(file, index, t, arrays):
    group = file.create_group(f"frame_{index:06d}")
    group.attrs.update(time=t, step=int(t / 2.5e-4))
    for name, values in arrays.items():
        group.create_dataset(name, data=values).attrs["units"] = "SI"


# Spheres of grains of diameter 1, by kind: one; two that touch, along the first axis.
SPHERES = {"kind": [0, 1, 1], "centre": [[0, 0, 0], [-(0.5 ** (4 / 3)), 0, 0], [0.5 ** (4 / 3), 0, 0]],
           "radius": [0.5, 0.5 ** (4 / 3), 0.5 ** (4 / 3)]}


def clumps(number):
    """Kinds and orientations of grains: every third one is a dimer, turned about the vertical by its number."""
    half = 0.05 * number
    return {"kind": number % 3 // 2, "orientation": np.stack([np.cos(half), 0 * half, np.sin(half), 0 * half], axis=1)}


def write_grains(folder, cut, frames=FRAMES, heaps=False, with_clumps=False):
    random = np.random.default_rng(1)
    with open_file(folder / "grains.h5") as file:
        if with_clumps:
            for name, values in SPHERES.items():
                file[f"spheres/{name}"] = np.array(values)
        for index, t in enumerate(np.linspace(0, END, frames)):
            x, d, dune = make_grains(t, random)
            number = random.permutation(len(d))
            write_frame(file, index, t, {"id": number, "x": x, "d": d, "u": 0 * x, "omega": 0 * x, "dune": dune,
                                         **({"heap": number % 3 // 2} if heaps else {}),
                                         **(clumps(number) if with_clumps else {})})
            if with_clumps:
                file[f"frame_{index:06d}/kind"].attrs["names"] = "ball\npair\n"
            if heaps:
                file[f"frame_{index:06d}/heap"].attrs["names"] = "first\n<second>\n"
        if cut:
            write_frame(file, frames, END + 0.5, {"id": np.arange(3)})


def write_grid(file):
    """Centres of the cells along x, y, z."""
    x_face, z_face = np.linspace(0, SIZE[0], 101), np.linspace(0, SIZE[2], 41)
    y_face = SIZE[1] * np.expm1(2.5 * np.linspace(0, 1, 31)) / np.expm1(2.5)
    for name, face in (("x", x_face), ("y", y_face), ("z", z_face)):
        file[f"grid/{name}_face"] = face
        file[f"grid/{name}"] = 0.5 * (face[1:] + face[:-1])
    return [file[f"grid/{name}"][:] for name in ("x", "y", "z")]


def write_fields(folder, bodies=False):
    with open_file(folder / "fields.h5") as file:
        centres = write_grid(file)
        for index, t in enumerate((0.0, END)):
            flow = make_flow(t, *centres)
            if bodies:
                add_wake(flow["u"], *centres)
            write_frame(file, index, t, flow)


def add_wake(u, x, y, z):
    """Behind the pile u grows linearly along x, through zero REATTACHED behind its axis."""
    i, j, k = (abs(x - 0.0695) < 6.5e-3), y < 0.01, abs(z - 0.02) < 4e-3
    u[np.ix_(k, j, i)] = 10 * (x[i] - 0.06 - REATTACHED)



def known_flow(x, y, z):
    """Mean flow that turns and slows down along x until it is reversed: angle to x [rad], speed along it
    [m/s], and the second moments along, across and mixed [m^2/s^2] in axes turned by that angle."""
    angle = 8.0 * (x - 0.045)
    slower = np.maximum(-2.4, 1.1 - 250.0 * abs(x - shape(END)[0] - 4.4e-3))  # linear over the dune
    speed = 0.3 * ((y / SIZE[1]) ** (1 / 7) - slower) * (1 + 50.0 * (z - 0.5 * SIZE[2]))
    stress = U_STAR**2 * (1 - y / SIZE[1])
    return angle, speed, 9.0 * stress, stress, -stress


def write_average(folder):
    with open_file(folder / "flow_average.h5") as file:
        z, y, x = np.meshgrid(*write_grid(file)[::-1], indexing="ij")
        angle, speed, along, across, mixed = known_flow(x, y, z)
        c, s, zero = np.cos(angle), np.sin(angle), 0.0 * speed
        write_frame(file, 0, END, {
            "u": c * speed, "v": s * speed, "w": zero, "p": zero, "alpha_f": zero + 1, "nu_t": zero,
            "uu": c * c * along - 2 * c * s * mixed + s * s * across,
            "vv": s * s * along + 2 * c * s * mixed + c * c * across, "ww": across,
            "uv": (c * c - s * s) * mixed + c * s * (along - across), "uw": zero, "vw": zero})
        file["frame_000000"].attrs.update(window_start=0.5 * END, n_samples=400)


def write_csv(path, header, columns):
    np.savetxt(path, np.stack(columns, axis=1), delimiter=",", fmt="%.9g", header=header, comments="")


def columns_of_the_page():
    """columns.json, from the tables of docs/files.md: a test of the program compares these with what it writes."""
    columns = {}
    page = Path(__file__).resolve().parents[2] / "docs/files.md"
    for part in page.read_text().split("\n## ")[1:]:
        rows = re.findall(r"^\| `(\w+)` \| ([^|]+) \| ([^|]+) \|$", part, re.M)
        columns[part.split("\n")[0]] = {name: {"unit": unit.replace("-", "1"), "meaning": meaning}
                                       for name, unit, meaning in rows}
    return columns


def write_tables(folder, cut, wider=1.0):
    random = np.random.default_rng(2)
    t = np.linspace(0, END, 400)
    noise = random.normal(size=(12, len(t)))
    u_star = U_STAR + 3e-4 * noise[0]
    history = [t, t / 2.5e-4, u_star, 0.28 + 1e-5 * noise[1], -11 + 0.3 * noise[2],
               4e-3 + 1e-5 * noise[3], 3e-9 * (1 + np.exp(-t) + 0.1 * noise[4]),
               0.05 + 2e-3 * noise[5], 10 ** (-9 + 0.2 * noise[6]), 3 + (noise[7] > 0.5),
               8000 - 20 * t, 15000 + 50 * noise[8], 4e-3 + 2e-4 * noise[9]]
    header = ("t,step,u_star,bulk_velocity,pressure_gradient,fluid_kinetic_energy,"
              "grain_kinetic_energy,cfl,continuity_residual,pressure_iterations,n_grains,"
              "n_contacts,max_overlap")
    write_csv(folder / "history.csv", header, history)
    lines = ["t,dune,n_grains,W,L,H,Cx,Cy,Cz,horn_left,horn_right,crest_x,volume,celerity,n_lost"]
    for i, time in enumerate(np.linspace(0, END, 161)):
        wiggle = 1e-4 * random.normal(size=7)
        centre, horn = shape(time)
        width = wider * known_width(time)
        row = [time, 0, 8000 - int(20 * time), width + wiggle[0], width - horn + wiggle[1],
               2.0e-3 - 4e-4 * (1 - np.exp(-time)) + 0.2 * wiggle[2], centre + 0.2 * wiggle[3],
               6e-4, 0.02 + 0.5 * wiggle[4], max(0, horn + wiggle[5]), max(0, horn + wiggle[6]),
               centre + 1e-3, 3.4e-8, 2.5e-3 if i else np.nan, int(20 * time)]
        lines.append(",".join(f"{value:.9g}" for value in row))
    text = "\n".join(lines) + "\n"
    (folder / "dune.csv").write_text(text[:-20] if cut else text)
    (folder / "columns.json").write_text(json.dumps(columns_of_the_page()))


def write_statistics(folder):
    """A channel at Re_tau = 400: log law over a viscous sublayer, stresses of the right shape."""
    u_star, height, nu = 0.016, SIZE[1], 1e-6
    y = height * np.expm1(2.5 * (np.arange(30) + 0.5) / 30) / np.expm1(2.5)
    y_plus = y * u_star / nu
    u_plus = np.minimum(y_plus, np.log(y_plus) / 0.41 + 5.2)
    wall = 1 - np.exp(-y_plus / 10)
    total = u_star**2 * (1 - y / height)
    uu, vv, ww = 8 * total * wall * np.exp(-y_plus / 400), total * wall**2, 1.7 * total * wall
    uv = -total * wall**2
    columns = [y, y_plus, u_plus * u_star, u_plus, uu, vv, ww, uv, (uu + vv + ww) / 2,
               0.9 * (total + uv), 0.1 * (total + uv), total, 0 * y, nu * wall, 480 + 0 * y]
    header = ("y,y_plus,U,U_plus,uu,vv,ww,uv,k,viscous_stress,subgrid_stress,total_stress,p,nu_t,"
              "n_samples")
    write_csv(folder / "statistics.csv", header, columns)


# name, varied key, values of friction and restitution, width over that of the base, what is there
STUDY = (("base", None, (0.6, 0.1), 1.0, "done"),
         ("sliding_friction-0.2", "grains.sliding_friction", (0.2, 0.1), 1.2, "done"),
         ("sliding_friction-0.4", "grains.sliding_friction", (0.4, 0.1), None, None),
         ("restitution-0.5", "grains.restitution", (0.6, 0.5), None, "failed"),
         ("restitution-0.9", "grains.restitution", (0.6, 0.9), 0.9, "running"))


def write_study(folder):
    """Two keys of two values with results each, one case that is not there and one that failed."""
    keys = ("grains.sliding_friction", "grains.restitution")
    cases = [{"name": name, "folder": name, "varied": varied, "values": dict(zip(keys, values))}
             for name, varied, values, _, _ in STUDY]
    (folder / "study.json").write_text(json.dumps(
        {"title": "synthetic study", "base": "base.toml", "cases": cases}))
    for name, _, _, wider, status in STUDY:
        if status is None:
            continue
        run = folder / name
        run.mkdir(exist_ok=True)
        (run / "run.json").write_text(json.dumps({"status": status}))
        (run / "config.toml").write_text(CONFIG)
        if wider:
            write_grains(run, False, frames=3)
            write_tables(run, False, wider)
    write_statistics(folder / "base")


def main():
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("out", type=Path)
    parser.add_argument("--without", action="append", default=[],
                        choices=("grains", "fields", "tables"))
    parser.add_argument("--cut", action="store_true", help="as a killed run leaves it")
    parser.add_argument("--frames", type=int, default=FRAMES, help=f"of grains.h5 ({FRAMES})")
    parser.add_argument("--average", action="store_true", help="with flow_average.h5")
    parser.add_argument("--study", action="store_true", help="a study folder instead of a run folder")
    parser.add_argument("--heaps", action="store_true", help="grains of two heaps")
    parser.add_argument("--bodies", action="store_true", help="with two bodies and bodies.csv")
    parser.add_argument("--clumps", action="store_true", help="grains of two kinds, one of clumps")
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    if options.study:
        return write_study(options.out)
    if "grains" not in options.without:
        write_grains(options.out, options.cut, options.frames, options.heaps, options.clumps)
    if "fields" not in options.without:
        write_fields(options.out, options.bodies)
    if "tables" not in options.without:
        write_tables(options.out, options.cut)
        write_statistics(options.out)
    if options.average:
        write_average(options.out)
    if options.bodies:
        write_forces(options.out)
    if not options.cut:
        (options.out / "config.toml").write_text(CONFIG + (BODIES if options.bodies else ""))
        if options.bodies:
            survey(options.out)
        (options.out / "run.json").write_text('{"status": "done", "title": "synthetic barchan"}\n')


if __name__ == "__main__":
    main()
