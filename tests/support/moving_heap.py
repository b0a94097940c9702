"""The heap of configs/validation/cfdem-heap.toml in motion: its shape, the share of its grains that move and their
velocity by height, every 0.05 s."""
import csv

import h5py
import numpy as np

import beside_cfdem as beside

MOVING = 5e-3  # a grain that is faster along the stream moves [m/s]
LAYERS = (0, 0.2, 0.4, 0.6, 0.8, 1.0, 1.2)  # lower ends [mm]
SINCE, UNTIL = 0.1, 0.5  # [s], of the profile; the second of the series, too
SHAPE = ("W", "L", "H", "Cx")  # columns of dune.csv


class Heap:
    """Of a finished run."""

    def __init__(self, folder):
        with open(folder / "dune.csv", encoding="utf-8") as file:
            rows = [row for row in csv.DictReader(file) if row["dune"] == "0"]
        self.shape = {float(row["t"]): {name: 1e3 * float(row[name]) for name in SHAPE} for row in rows}
        with h5py.File(folder / "grains.h5") as file:
            self.motion = {round(float(frame.attrs["time"]), 6): (frame["x"][:, 1], frame["u"][:, 0].astype(float))
                           for frame in beside.frames(file)}

    def series(self):
        """Rows of time [s], W, L, H, shift of the centroid [mm], share of moving grains."""
        start = next(iter(self.shape.values()))["Cx"]
        for (time, shape), (_, u) in zip(self.shape.items(), self.motion.values()):
            if time > UNTIL + 1e-6:
                break
            yield {"t": time, **{name: shape[name] for name in SHAPE[:3]}, "shift": shape["Cx"] - start,
                   "moving": float((u > MOVING).mean())}

    def profile(self):
        """Rows of layer [mm], grains in it, mean velocity along the stream [mm/s], over the frames of SINCE to UNTIL."""
        inside = [pair for time, pair in self.motion.items() if SINCE - 1e-6 < time < UNTIL + 1e-6]
        y, u = (np.concatenate(part) for part in zip(*inside))
        for low, count, mean, _ in beside.by_height(y, 1e3 * u, LAYERS):
            yield {"low": low, "n": count / len(inside), "u": mean}
