"""The longest stable grain step of a packing, from the largest eigenvalue of all its contacts together.

    exact_stable_step.py RUN_DIR     of the last frame of grains.h5, beside what the run wrote into history.csv

The grain steps take positions of now and velocities half a step old. Small motions q about a packing then grow where the
largest eigenvalue of M^-1 (K dt^2 + 2 C dt) is above 4, with the matrices of inertia, stiffness and damping. K and C are
sums over contacts: a spring and a dashpot along the normal and along two tangents, by the stiffness of Hertz-Mindlin
(1.5 times its secant along the normal) and its damping. Sliding and rolling springs are left out.
"""

import sys
import tomllib
from pathlib import Path

import h5py
import numpy as np
from scipy.optimize import brentq
from scipy.sparse import csr_matrix
from scipy.sparse.linalg import eigsh
from scipy.spatial import cKDTree


def last_frame(run):
    with h5py.File(run / "grains.h5") as file:
        frame = file[sorted(file.keys())[-1]]
        return frame["x"][()], frame["d"][()] / 2


class Contact:
    """Stiffness [N/m] and damping [kg/s] of contacts: normal, tangential."""

    def __init__(self, grains, r_eff, m_eff, overlap):
        s, e, modulus = (grains[key] for key in ("poisson_ratio", "restitution", "youngs_modulus"))
        damping = -np.log(e) / np.hypot(np.log(e), np.pi)
        e_eff, g_eff = modulus / (2 * (1 - s**2)), modulus / (4 * (2 - s) * (1 + s))
        a = np.sqrt(r_eff * overlap)
        self.k = 1.5 * 4 / 3 * e_eff * a, 8 * g_eff * a
        self.gamma = [2 * np.sqrt(5 / 6) * damping * np.sqrt(modulus * m_eff * a) for modulus in (2 * e_eff, 8 * g_eff)]
        self.gamma[1] *= grains.get("tangential_damping", 1)


def pairs_of(x, r, periods):
    """Touching pairs (i, j) and the vectors from j to i, in a domain with these periods (0: none)."""
    reach = 2 * r.max()
    copies, index = [x], [np.arange(len(x))]
    for axis, period in enumerate(periods):
        if not period:
            continue
        for shift, near in ((period, x[:, axis] < reach), (-period, x[:, axis] > period - reach)):
            moved = x[near].copy()
            moved[:, axis] += shift
            copies.append(moved)
            index.append(np.nonzero(near)[0])
    # Copies across an edge of two periods are missing: a few pairs of thousands.
    x_all, index = np.concatenate(copies), np.concatenate(index)
    i, j = cKDTree(x_all).query_pairs(reach, output_type="ndarray").T
    keep = (i < len(x)) & ((j < len(x)) | (index[j] > i))
    i, j = i[keep], j[keep]
    separation = x_all[i] - x_all[j]
    j = index[j]
    touch = np.linalg.norm(separation, axis=1) < r[i] + r[j]
    return i[touch], j[touch], separation[touch]


def rows_of(bodies, normal, arms, m, inertia):
    """For each contact and direction the row B with slip = B q, over the roots of the inertia; sign +1, -1."""
    other = np.where(np.abs(normal[:, [0]]) < 0.9, [[1.0, 0, 0]], [[0, 1.0, 0]])
    first = np.cross(normal, other)
    first /= np.linalg.norm(first, axis=1)[:, None]
    for kind, along in ((0, normal), (1, first), (1, np.cross(normal, first))):
        columns, values = [], []
        for body, arm, sign in zip(bodies, arms, (1, -1)):
            columns += [6 * body[:, None] + np.arange(3)]
            values += [sign * along / np.sqrt(m[body])[:, None]]
            columns += [6 * body[:, None] + 3 + np.arange(3)]
            values += [-np.cross(normal, along) * kind * (arm / np.sqrt(inertia[body]))[:, None]]
        yield kind, np.hstack(columns), np.hstack(values)


def exact_stable_step(x, r, config):
    grains = config["grains"]
    m = grains["density"] * 4 / 3 * np.pi * r**3
    inertia = 0.4 * m * r**2
    periodic = [grains["boundary_x"] == "periodic", False, grains["boundary_z"] == "periodic"]
    i, j, s = pairs_of(x, r, np.where(periodic, config["domain"]["size"], 0))
    distance = np.linalg.norm(s, axis=1)
    pair = Contact(grains, r[i] * r[j] / (r[i] + r[j]), m[i] * m[j] / (m[i] + m[j]), r[i] + r[j] - distance)
    floor = np.nonzero(x[:, 1] < r)[0]
    wall = Contact(grains, r[floor], m[floor], r[floor] - x[floor, 1])
    up = np.tile([0.0, 1.0, 0.0], (len(floor), 1))
    groups = [(pair, (i, j), s / distance[:, None], (r[i], r[j])), (wall, (floor,), up, (r[floor],))]

    def largest(dt):
        rows, columns, values, n = [], [], [], 0
        for contact, bodies, normal, arms in groups:
            for kind, column, value in rows_of(bodies, normal, arms, m, inertia):
                weight = np.sqrt(contact.k[kind] * dt**2 + 2 * contact.gamma[kind] * dt)
                rows.append(np.repeat(n + np.arange(len(column)), column.shape[1]))
                columns.append(column.ravel())
                values.append((value * weight[:, None]).ravel())
                n += len(column)
        b = csr_matrix((np.concatenate(values), (np.concatenate(rows), np.concatenate(columns))), (n, 6 * len(x)))
        return eigsh(b.T @ b, k=1, tol=1e-4, return_eigenvectors=False)[0]

    return brentq(lambda dt: largest(dt) - 4, 1e-8, 1e-3, rtol=1e-3)


def compare(run):
    """Exact stable step [s], and that of the run's history.csv at its end."""
    config = tomllib.loads((run / "config.toml").read_text())
    exact = exact_stable_step(*last_frame(run), config)
    history = np.genfromtxt(run / "history.csv", delimiter=",", names=True)
    time = config["time"]
    grain_step = time["fluid_step"] / np.ceil(time["fluid_step"] / time["grain_step"] - 1e-9)
    return exact, grain_step / np.atleast_1d(history["grain_step_over_stable"])[-1]


if __name__ == "__main__":
    exact, written = compare(Path(sys.argv[1]))
    print(f"longest stable grain step: {exact:.3g} s of all contacts together, {written:.3g} s by the run, "
          f"{written / exact:.3f} of it")
