"""The bed of CFDEM's tutorial ErgunTestMPI for our program: its diameter, void fraction, fluid and drag law, as a lattice
held in a periodic box (in the tutorial 10,000 loose grains in a cylinder)."""
import csv

import numpy as np

DIAMETER, VOID, LENGTH = 1e-3, 0.451335, 0.0156  # [m], [-], [m]: as the tutorial's own evaluation has them
LATTICES = 8  # body-centred cubes along each side, two to a cell
CASE = """[case]
title = "Bed of CFDEM's tutorial ErgunTestMPI"
[time]
end = 0.004
fluid_step = 1e-4
grain_step = 1e-5
[domain]
size = [{side:.9g}, {side:.9g}, {side:.9g}]
[fluid]
cells = [{cells}, {cells}, {cells}]
density = 10
kinematic_viscosity = 1.5e-4
mean_velocity = {velocity:.9g}
turbulence = "none"
bottom = "free_slip"
[grains]
density = 2000
youngs_modulus = 5e6
frozen = true
boundary_x = "periodic"
[coupling]
drag = "koch_hill"
smoothing_length = 0
[initial]
grains = "bed.csv"
[output]
history_interval = 1e-4
dune_interval = 0
grains_interval = 0
fields_interval = 0
"""


def write_case(folder, superficial):
    """ergun.toml for a superficial velocity [m/s]."""
    spacing = (2 * np.pi / 6 * DIAMETER**3 / (1 - VOID))**(1 / 3)
    corners = np.stack(np.meshgrid(*[np.arange(LATTICES)] * 3), axis=-1).reshape(-1, 3)
    places = spacing * np.concatenate([corners + 0.25, corners + 0.75])
    rows = [f"{i},{DIAMETER:g},{x:.9g},{y:.9g},{z:.9g}" for i, (x, y, z) in enumerate(places)]
    folder.mkdir(parents=True)
    (folder / "bed.csv").write_text("\n".join(["id,diameter,x,y,z", *rows]) + "\n")
    case = folder / "ergun.toml"
    case.write_text(CASE.format(side=LATTICES * spacing, cells=LATTICES // 2, velocity=superficial / VOID))
    return case


def drop(run):
    """Pressure drop over the tutorial's bed at the end of a run [Pa]."""
    with open(run / "history.csv", encoding="utf-8") as file:
        *_, last = csv.DictReader(file)
    return LENGTH * float(last["pressure_gradient"])
