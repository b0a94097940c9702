"""Turbulence statistics of a channel in wall units, and DNS of one.

DNS: Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau = 392 and 178.
"""

import numpy as np

from barchan.io.tables import DATA, read_table

STRESSES = ("uu", "vv", "ww", "uv")
DNS_RE_TAU = 392.24




def read_dns(name: str = "chan395") -> dict[str, np.ndarray]:
    """The DNS above the wall, with the columns of in_wall_units."""
    dns = read_table(DATA / f"dns_channel_mkm1999_{name}.csv")
    names = {"y": "y", "y_plus": "yplus", "U_plus": "U", "uu": "uu", "vv": "vv", "ww": "ww",
             "uv": "uv", "total": "tot"}
    return {name: dns[column][1:] for name, column in names.items()}


def friction_velocity(table: dict[str, np.ndarray]) -> float:
    """u_star with which statistics.csv was scaled [m/s]."""
    return float(np.median(table["U"] / table["U_plus"]))


def in_wall_units(table: dict[str, np.ndarray], height: float) -> dict[str, np.ndarray]:
    """Columns of statistics.csv over u_star and u_star^2, y over the height of the channel."""
    u_star2 = friction_velocity(table) ** 2
    return {"y": table["y"] / height, "y_plus": table["y_plus"], "U_plus": table["U_plus"],
            **{name: table[name] / u_star2 for name in STRESSES},
            "total": table["total_stress"] / u_star2}
