"""What is compared with CFDEM (docs/validation.md), from runs of our program; tests/reference/cfdem_*.csv
hold what CFDEM gave from the same states."""
import csv
import os
import pathlib
import re
import subprocess
from dataclasses import dataclass

import h5py
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
CASES = ROOT / "configs/validation"
PROGRAM = os.environ.get("BARCHAN_PROGRAM", str(ROOT / "build/release/barchan"))
ENVIRONMENT = {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}
SUBMERGED = 1500 * 9.81  # weight of a grain in water per volume [N/m3]
SAME_PLACE = 1e-6  # [m]
SAME_FLOW = 1e-3  # of the fastest
# name: (case, lower ends of the classes of height [mm])
HELD = {"bed": (CASES / "cfdem-bed.toml", (0, 0.15, 0.25, 0.35, 0.45)),
        "heap": (CASES / "cfdem-held-heap.toml", (0, 0.15, 0.35, 0.55, 0.75, 0.95, 1.15))}


def run(case, folder, **keys):
    """The folder of our program's run of a case, with keys changed: section__key=value. A finished run is taken."""
    if (folder / "run.json").exists() and '"status": "done"' in (folder / "run.json").read_text():
        return folder
    words = [PROGRAM, "run", str(case), "--quiet", "--threads", "1", "--out", str(folder)]
    for key, value in keys.items():
        words += ["--set", f"{key.replace('__', '.')}={value}"]
    done = subprocess.run(words, env=ENVIRONMENT, capture_output=True, text=True)
    if done.returncode:
        raise RuntimeError(f"{' '.join(words)} ended with {done.returncode}:\n{done.stderr}")
    return folder


def frames(file):
    return [file[name] for name in sorted(file) if name.startswith("frame")]


def grains_of(frame):
    """Arrays of a frame in the order of the grains' ids."""
    order = np.argsort(frame["id"][:])
    return {name: frame[name][:][order].astype(float) for name in frame}


def smoothed(case, folder):
    """A copy of a case, and of the flow over grains that it starts from, with the exchange that is near CFDEM's."""
    def start(found):
        file = case.parent / found[2]
        if found[1] == "fluid" and "[grains]" in file.read_text():
            file = smoothed(file, folder)
        return f'{found[1]} = "{file}"'

    text = re.sub(r'^(fluid|grains) = "(.*\.toml)"', start, case.read_text(), flags=re.M)
    copy = folder.with_name(f"{folder.name}-cases") / case.name
    copy.parent.mkdir(parents=True, exist_ok=True)
    if 'scheme = "smoothed"' not in text:
        text = re.sub(r"^\[coupling\]$", '[coupling]\nscheme = "smoothed"', text, flags=re.M)
    assert 'scheme = "smoothed"' in text, case
    copy.write_text(text)
    return copy


def run_held(name, folder, **keys):
    """The grains of a case held in the flow that it starts from, for two steps so short that it does not change."""
    instant = "1e-7"
    return run(smoothed(HELD[name][0], folder), folder, grains__frozen="true", time__fluid_step=instant,
               time__grain_step=instant, time__end="2e-7", output__grain_forces="true", output__grains_interval=instant,
               output__fields_interval=instant, **keys)


@dataclass
class HeldState:
    """Held grains in a flow, forces along the stream over the submerged weight."""

    ids: np.ndarray
    x: np.ndarray  # [m]
    drag: np.ndarray
    rest: np.ndarray  # pressure gradient and stress
    water: np.ndarray  # velocity along the stream in the grain's cell [m/s]
    drag_of_cell: np.ndarray  # by water and fluid fraction of the grain's cell: CFDEM with `interpolation false`


def held_state(folder):
    """The forces are those of the first step, which the first flow gave."""
    with h5py.File(folder / "grains.h5") as file:
        now, later = (grains_of(frame) for frame in frames(file)[:2])
    with h5py.File(folder / "fields.h5") as file:
        *water, alpha = (in_cell(file["grid"], frames(file)[0][name], now["x"]) for name in ("u", "v", "w", "alpha_f"))
    weight = SUBMERGED * np.pi / 6 * now["d"]**3
    rest = later["force_pressure_gradient"] + later["force_stress"]
    of_cell = gidaspow(alpha, now["d"], np.linalg.norm(water, axis=0)) * water[0]
    return HeldState(now["id"], now["x"], later["force_drag"][:, 0] / weight, rest[:, 0] / weight, water[0],
                     of_cell / weight)


def in_cell(grid, field, x):
    """Values of the cells, in order z, y, x, that hold the points; periodic along x and z."""
    faces = [grid[f"{axis}_face"][:] for axis in "xyz"]
    inside = x - np.floor(x / [faces[0][-1], np.inf, faces[2][-1]]) * [faces[0][-1], 0, faces[2][-1]]
    i, j, k = (np.clip(np.searchsorted(face, inside[:, a]) - 1, 0, len(face) - 2) for a, face in enumerate(faces))
    return field[:].astype(float)[k, j, i]


def gidaspow(alpha, d, slip):
    """Drag coefficient of a grain in water [kg/s] (docs/theory-coupling.md)."""
    mu, rho = 1e-3, 1000.0
    wen_yu = 3 * np.pi * mu * d * (1 + 0.15 * (rho * alpha * d * slip / mu)**0.687) * alpha**-2.65
    ergun = np.pi / 6 * d**3 * (150 * (1 - alpha) * mu / (alpha * d**2) + 1.75 * rho * slip / d)
    return np.where(alpha > 0.8, wen_yu, ergun)


def by_height(y, values, ends):
    """(lower end [mm], number of grains, mean, standard deviation) of each class of height y [m]."""
    bounds = [*ends, np.inf]
    for low, high in zip(bounds, bounds[1:]):
        inside = values[(1e3 * y >= low) & (1e3 * y < high)]
        if len(inside):
            yield low, len(inside), inside.mean(), inside.std()


def read(name):
    """Rows of tests/reference/cfdem_<name>.csv, numbers where they are some."""
    def value(text):
        try:
            return float(text)
        except ValueError:
            return text
    lines = (ROOT / f"tests/reference/cfdem_{name}.csv").read_text().splitlines()
    rows = csv.DictReader(line for line in lines if not line.startswith("#"))
    return [{key: value(text) for key, text in row.items()} for row in rows]


def mean_of(name, part):
    """Mean of "drag" or "rest" over all held grains of a case in CFDEM as it interpolates."""
    rows = [row for row in read("held_forces") if (row["case"], row["run"], row["part"]) == (name, "interpolated", part)]
    return sum(row["n"] * row["mean"] for row in rows) / sum(row["n"] for row in rows)


def index_of(state, rows):
    """Where the grains of these rows are in the state; None if they lie elsewhere, or in another flow."""
    index = np.searchsorted(state.ids, [row["id"] for row in rows])
    if index.max() >= len(state.ids):
        return None
    there = np.array([[row["x"], row["y"], row["z"]] for row in rows]) * 1e-3
    water = np.array([row["water"] for row in rows])
    same_flow = np.abs(state.water[index] - water).max() < SAME_FLOW * np.abs(water).max()
    return index if np.abs(state.x[index] - there).max() < SAME_PLACE and same_flow else None
