"""Grains of all frames of a run, in the order of their ids."""

import numpy as np


def motion(file):
    """Places, velocities, spins (frames, grains, 3) and diameters (grains) of grains.h5, whose grains stay the same."""
    rows = []
    with file.open() as content:
        for _, name in file.frames:
            order = np.argsort(content[name]["id"][:])
            rows.append([content[name][what][:][order] for what in ("x", "u", "omega")])
        d = content[name]["d"][:][order]
    return (*np.moveaxis(np.array(rows, float), 1, 0), d)
