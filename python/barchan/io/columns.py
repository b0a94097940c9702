"""Unit and meaning of what a run writes: the tables of docs/files.md, for readers of Python.

Each is {name: (unit, long name)}. Units are SI, written as CF has them; "1" has no dimension.
"""

HISTORY = {
    "t": ("s", "time"),
    "step": ("1", "fluid step"),
    "u_star": ("m s-1", "friction velocity of the walls"),
    "bulk_velocity": ("m s-1", "bulk velocity of the water"),
    "pressure_gradient": ("Pa m-1", "driving pressure gradient"),
    "fluid_kinetic_energy": ("J", "kinetic energy of the water"),
    "grain_kinetic_energy": ("J", "kinetic energy of the grains"),
    "cfl": ("1", "largest CFL number of the interval"),
    "continuity_residual": ("s-1", "largest continuity residual of the interval"),
    "pressure_iterations": ("1", "mean number of pressure iterations of the interval"),
    "n_grains": ("1", "grains inside"),
    "n_contacts": ("1", "grain-grain pairs that touch"),
    "max_overlap": ("1", "largest overlap of a pair over the sum of its radii"),
    "grain_flux": ("m2 s-1", "volume flux of all grains over the floor's area"),
    "stress_on_grains": ("Pa", "force of the flow on the grains over the floor's area"),
    "grain_step_over_stable": ("1", "grain step over the longest stable one"),
    "bulk_velocity_z": ("m s-1", "bulk velocity of the water along z"),
    "wanted_velocity_x": ("m s-1", "wanted bulk velocity along x"),
    "wanted_velocity_z": ("m s-1", "wanted bulk velocity along z"),
    "pressure_gradient_z": ("Pa m-1", "driving pressure gradient along z"),
    "grain_flux_z": ("m2 s-1", "volume flux of all grains along z over the floor's area"),
    "stress_on_grains_z": ("Pa", "force of the flow along z on the grains over the floor's area"),
    "n_fed": ("1", "grains that have come in"),
}
DUNES = {
    "t": ("s", "time"),
    "dune": ("1", "label of the dune"),
    "n_grains": ("1", "grains of the dune"),
    "W": ("m", "width"),
    "L": ("m", "length along the centreline"),
    "H": ("m", "height"),
    "Cx": ("m", "centroid along the flow"),
    "Cy": ("m", "height of the centroid"),
    "Cz": ("m", "centroid across the flow"),
    "horn_left": ("m", "length of the left horn"),
    "horn_right": ("m", "length of the right horn"),
    "crest_x": ("m", "crest on the centreline"),
    "volume": ("m3", "solid volume"),
    "celerity": ("m s-1", "celerity over the last second"),
    "n_lost": ("1", "grains that have left the domain"),
    "flux": ("m2 s-1", "volume flux of the dune's grains over the area of its bins"),
    "horn_left_2d": ("m", "length of the left horn, of what is two grains high"),
    "horn_right_2d": ("m", "length of the right horn, of what is two grains high"),
    "horn_left_2d_1s": ("m", "median of horn_left_2d over the last second"),
    "horn_right_2d_1s": ("m", "median of horn_right_2d over the last second"),
}
FORCE = "force on the grain: "
GRAINS = {
    "id": ("1", "number of the grain, never reused"),
    "x": ("m", "position of the grain"),
    "d": ("m", "diameter"),
    "u": ("m s-1", "velocity of the grain"),
    "omega": ("rad s-1", "angular velocity of the grain"),
    "dune": ("1", "label of the dune, -1: in none"),
    "heap": ("1", "number of the heap that the grain came from"),
    "kind": ("1", "number of the kind of the grain"),
    **{f"force_{name}": ("N", FORCE + name.replace("_", " ")) for name in (
        "drag", "pressure_gradient", "stress", "added_mass", "lift", "contact_normal", "contact_tangential", "total")},
}
FIELDS = {
    "u": ("m s-1", "velocity of the water along the flow"),
    "v": ("m s-1", "velocity of the water upwards"),
    "w": ("m s-1", "velocity of the water across the flow"),
    "p": ("Pa", "pressure of the water"),
    "alpha_f": ("1", "void fraction"),
    "nu_t": ("m2 s-1", "eddy viscosity"),
    **{pair: ("m2 s-2", f"covariance of {pair[0]} and {pair[1]}") for pair in ("uu", "vv", "ww", "uv", "uw", "vw")},
}
AXES = {
    "x": ("m", "along the flow"),
    "y": ("m", "upwards from the floor"),
    "z": ("m", "across the flow"),
}
BODIES = {
    "t": ("s", "time"),
    "body": ("1", "number of the body"),
    "force_x": ("N", "force of the water along x"),
    "force_y": ("N", "force of the water upwards"),
    "force_z": ("N", "force of the water along z"),
    "torque_x": ("N m", "torque of the water about x"),
    "torque_y": ("N m", "torque of the water about y"),
    "torque_z": ("N m", "torque of the water about z"),
    "grain_force_x": ("N", "force of the grains along x"),
    "grain_force_y": ("N", "force of the grains upwards"),
    "grain_force_z": ("N", "force of the grains along z"),
    "grain_torque_x": ("N m", "torque of the grains about x"),
    "grain_torque_y": ("N m", "torque of the grains about y"),
    "grain_torque_z": ("N m", "torque of the grains about z"),
    "n_contacts": ("1", "grains that touch the body"),
}
