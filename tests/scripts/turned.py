#!/usr/bin/python3
"""Nothing knows x from z: a coupled case whose flow goes along z is the same case along x with x and z exchanged, from
the turbulent start to each grain and each column of history.csv."""
import pathlib
import subprocess

import faults
import h5py
import numpy as np

CASE = """
[time]
end = 0.01
fluid_step = 2.5e-4
grain_step = 5e-6
[domain]
size = [0.012, 0.006, 0.012]
[fluid]
cells = [12, 14, 12]
first_cell_height = 2.6e-4
mean_velocity = {velocity}
[grains]
youngs_modulus = 1.25e6
boundary_x = "periodic"
[coupling]
scheme = "smoothed"
smoothed.void_fraction = "centre"  # the 29 points of "divided" lie otherwise along z than along x
[initial]
fluid = "turbulent"
grains = "{grains}"
[output]
history_interval = 2.5e-3
[restart]
wall_interval = 0
[solver]
pressure_tolerance = 1e-12
"""
PAIRS = (("bulk_velocity", "bulk_velocity_z"), ("wanted_velocity_x", "wanted_velocity_z"),
         ("pressure_gradient", "pressure_gradient_z"), ("grain_flux", "grain_flux_z"),
         ("stress_on_grains", "stress_on_grains_z"))
ALIKE = ("u_star", "fluid_kinetic_energy", "grain_kinetic_energy", "cfl", "n_grains", "n_contacts", "max_overlap")
LARGEST_DIFFERENCE = 1e-10  # round-off, which grows


def heap():
    """Centres of grains of 0.2 mm in three loose layers [m]."""
    random = np.random.default_rng(3)
    x, y, z = np.meshgrid(np.arange(9), np.arange(3), np.arange(7), indexing="ij")
    centres = np.stack([4.6e-3 + 2.6e-4 * x, 1.1e-4 + 2.1e-4 * y, 5.1e-3 + 2.6e-4 * z], axis=-1).reshape(-1, 3)
    return centres + random.uniform(-2e-5, 2e-5, centres.shape) * [1, 0, 1]


def run(work, name, velocity, centres):
    """Last positions by number, and history.csv."""
    rows = [f"{n},2e-4,{x:.17g},{y:.17g},{z:.17g}" for n, (x, y, z) in enumerate(centres)]
    (work / f"{name}.csv").write_text("id,diameter,x,y,z\n" + "\n".join(rows) + "\n")
    (work / f"{name}.toml").write_text(CASE.format(velocity=velocity, grains=f"{name}.csv"))
    words = [faults.PROGRAM, "run", str(work / f"{name}.toml"), "--quiet", "--out", str(work / name)]
    faults.expect(subprocess.run(words, env=faults.ENVIRONMENT, capture_output=True, text=True, timeout=300), 0)
    with h5py.File(faults.last_restart(work / name)) as file:
        order = np.argsort(file["grains/id"][...])
        positions = file["grains/kin"][...].reshape(len(order), -1)[order, :3]
    return positions, np.genfromtxt(work / name / "history.csv", delimiter=",", names=True)


def compare(what, one, other):
    size = np.max(np.abs(one))
    difference = np.max(np.abs(one - other)) / size if size > 0 else np.max(np.abs(other))
    if not difference <= LARGEST_DIFFERENCE:
        faults.fail(f"{what}: {difference:.2g} of its largest value, more than {LARGEST_DIFFERENCE}")
    return difference


def main(work: pathlib.Path):
    centres = heap()
    positions, along = run(work, "along", [0.2, 0.03], centres)
    turned, across = run(work, "across", [0.03, 0.2], centres[:, ::-1])
    moved = np.max(np.abs(positions - centres)[:, 0])
    if moved < 1e-5:
        faults.fail(f"the grains have moved by {moved} m only")
    worst = compare("positions", positions, turned[:, ::-1])
    for x, z in PAIRS:
        worst = max(worst, compare(x, along[x], across[z]), compare(z, along[z], across[x]))
    worst = max(worst, *(compare(name, along[name], across[name]) for name in ALIKE))
    print(f"along z as along x: largest difference {worst:.2g}, while grains moved by up to {1e6 * moved:.0f} um")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
