"""Reads flow_average.h5: the mean flow and its second moments in every cell (statistics.fields = true)."""

from dataclasses import dataclass

import numpy as np

from run_folder import FrameFile, NotInRun

NAME = "flow_average.h5"
MOMENTS = ("uu", "vv", "ww", "uv", "uw", "vw")
USED = ("u", "v", "uu", "vv", "uv")


@dataclass
class Columns:
    """Fields {name: (n, ny)} above n points of a vertical plane, at the heights y (ny) [m]."""

    y: np.ndarray
    fields: dict


def weights(centres, at):
    """(index, weight of the next) for linear interpolation between cell centres."""
    index = int(np.clip(np.searchsorted(centres, at) - 1, 0, len(centres) - 2))
    weight = (at - centres[index]) / (centres[index + 1] - centres[index])
    return index, float(np.clip(weight, 0.0, 1.0))


class FlowAverage:
    """start, end of the window [s]; top is the plane mean of u in the uppermost row of cells [m/s]."""

    def __init__(self, run):
        path = run.path / NAME
        if not path.exists():
            raise NotInRun(f"needs {NAME}: a run with statistics.fields = true")
        self.file = FrameFile(path, USED)
        if not self.file.frames:
            raise NotInRun(f"needs {NAME} with a complete frame")
        self.end, self.name = self.file.frames[-1]
        with self.file.open() as file:
            group = file[self.name]
            self.start = float(group.attrs.get("window_start", self.end))
            self.x, self.y, self.z = (file["grid"][axis][:] for axis in "xyz")
            self.top = float(group["u"][:, -1, :].mean())
            self.bottom = float(group["u"][:, 0, :].mean())

    def above(self, points, z):
        """Columns over each x of `points` in the plane `z` [m], linear between cell centres."""
        k, beside = weights(self.z, z)
        result = {name: [] for name in USED}
        with self.file.open() as file:
            group = file[self.name]
            for name in USED:
                planes = group[name][k:k + 2].astype(float)
                plane = (1.0 - beside) * planes[0] + beside * planes[1]
                for x in points:
                    i, next_share = weights(self.x, x)
                    result[name].append((1.0 - next_share) * plane[:, i] + next_share * plane[:, i + 1])
        return Columns(self.y, {name: np.array(values) for name, values in result.items()})


def friction_velocity(run, average):
    """u_star of the walls [m/s]: mean of history.csv over the window, else of the lowest cells."""
    history = run.history
    if history is not None and "u_star" in history:
        inside = (history["t"] >= average.start) & (history["t"] <= average.end)
        values = history["u_star"][inside & np.isfinite(history["u_star"])]
        if len(values) and values.mean() > 0.0:
            return float(values.mean())
    nu = float(run.config.get("fluid", {}).get("kinematic_viscosity", 1e-6))
    return float(np.sqrt(nu * abs(average.bottom) / average.y[0]))


def in_streamline_axes(fields, still):
    """Rotates means and moments (arrays of one shape) into the local direction of the mean flow.

    The angle is kept within a quarter turn of x, so that u is negative in reversed flow; it is zero where
    the water is slower than `still` [m/s] and so has no direction. Returns angle [rad], u along it [m/s]
    and the moments along (uu), across (vv) and of both (uv) [m^2/s^2].
    """
    u, v = fields["u"], fields["v"]
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.where(np.hypot(u, v) <= still, 0.0, np.arctan(v / u))
    c, s = np.cos(angle), np.sin(angle)
    uu, vv, uv = fields["uu"], fields["vv"], fields["uv"]
    return {"angle": angle, "u": c * u + s * v,
            "uu": c * c * uu + 2.0 * c * s * uv + s * s * vv,
            "vv": s * s * uu - 2.0 * c * s * uv + c * c * vv,
            "uv": (c * c - s * s) * uv + c * s * (vv - uu)}
