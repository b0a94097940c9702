"""Reads flow_average.h5: the mean flow and its second moments in every cell (statistics.fields = true)."""

from dataclasses import dataclass

import numpy as np

from barchan.errors import MissingData
from barchan.io.frames import FrameFile
from barchan.io.run_folder import RunFolder

NAME = "flow_average.h5"
USED = ("u", "v", "uu", "vv", "uv")


@dataclass
class Columns:
    """Fields {name: (n, ny)} above n points of a vertical plane, at the heights y (ny) [m]."""

    y: np.ndarray
    fields: dict


def weights(centres: np.ndarray, at: float) -> tuple[int, float]:
    """(index, weight of the next) for linear interpolation between cell centres."""
    index = int(np.clip(np.searchsorted(centres, at) - 1, 0, len(centres) - 2))
    weight = (at - centres[index]) / (centres[index + 1] - centres[index])
    return index, float(np.clip(weight, 0.0, 1.0))


class FlowAverage:
    """The mean flow and its second moments: flow_average.h5.

    Parameters
    ----------
    run : Run
        The run.

    Attributes
    ----------
    start, end : float
        The window of time [s].
    x, y, z : numpy.ndarray
        Centres of the cells [m].
    top, bottom : float
        Mean of u over the plane of the uppermost and of the lowest cells [m/s].

    Raises
    ------
    MissingData
        Where there is no such file, or no complete frame in it.
    """

    def __init__(self, run: RunFolder) -> None:
        path = run.path / NAME
        if not path.exists():
            raise MissingData(f"needs {NAME}: a run with statistics.fields = true")
        self.file = FrameFile(path, USED)
        if not self.file.frames:
            raise MissingData(f"needs {NAME} with a complete frame")
        self.end, self.name = self.file.frames[-1]
        with self.file.open() as file:
            group = file[self.name]
            self.start = float(group.attrs.get("window_start", self.end))
            self.x, self.y, self.z = (file["grid"][axis][:] for axis in "xyz")
            self.top = float(group["u"][:, -1, :].mean())
            self.bottom = float(group["u"][:, 0, :].mean())

    def above(self, points: np.ndarray, z: float) -> Columns:
        """The flow over points of a plane along x, linear between cell centres.

        Parameters
        ----------
        points : numpy.ndarray
            (n) places along x [m].
        z : float
            Place of the plane across the flow [m].

        Returns
        -------
        Columns
            y (ny) [m] and fields u, v [m/s], uu, vv, uv [m2/s2], each (n, ny).
        """
        k, beside = weights(self.z, z)
        result: dict[str, list[np.ndarray]] = {name: [] for name in USED}
        with self.file.open() as file:
            group = file[self.name]
            for name in USED:
                planes = group[name][k:k + 2].astype(float)
                plane = (1.0 - beside) * planes[0] + beside * planes[1]
                for x in points:
                    i, next_share = weights(self.x, x)
                    result[name].append((1.0 - next_share) * plane[:, i] + next_share * plane[:, i + 1])
        return Columns(self.y, {name: np.array(values) for name, values in result.items()})
