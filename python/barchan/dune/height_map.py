"""Height of the bed surface h(x, z): the highest top of a grain (y + d/2) in square bins."""

from collections.abc import Sequence

import numpy as np

from barchan.io.frames import Grains


class HeightMap:
    """h (nx, nz) [m] on bins with edges x (nx + 1), z (nz + 1) [m]; zero where no grain is."""

    def __init__(self, grains: Grains, window: Sequence[float], size: float) -> None:
        nx, nz = (max(3, int(np.ceil((window[i + 1] - window[i]) / size))) for i in (0, 2))
        self.x = window[0] + size * np.arange(nx + 1)
        self.z = window[2] + size * np.arange(nz + 1)
        i = np.floor((grains.x[:, 0] - window[0]) / size).astype(int)
        k = np.floor((grains.x[:, 2] - window[2]) / size).astype(int)
        inside = (i >= 0) & (i < nx) & (k >= 0) & (k < nz)
        self.h = np.zeros((nx, nz))
        top = grains.x[:, 1] + 0.5 * grains.d
        np.maximum.at(self.h, (i[inside], k[inside]), top[inside])

    @property
    def smooth(self) -> np.ndarray:
        padded = np.pad(self.h, 1, mode="edge")
        nx, nz = self.h.shape
        return np.add.reduce([padded[i:i + nx, k:k + nz] for i in range(3) for k in range(3)]) / 9.0

    def profile(self, z: float, half_width: float) -> np.ndarray:
        """Mean h along x in the strip around `z`."""
        middle = 0.5 * (self.z[1:] + self.z[:-1])
        near = abs(middle - z) < half_width
        near[np.argmin(abs(middle - z))] = True
        return self.smooth[:, near].mean(axis=1)

    @property
    def x_middle(self) -> np.ndarray:
        return 0.5 * (self.x[1:] + self.x[:-1])

    @property
    def z_middle(self) -> np.ndarray:
        return 0.5 * (self.z[1:] + self.z[:-1])


def common_window(frames: Sequence[Grains], size: float) -> tuple[float, float, float, float]:
    low = np.min([np.percentile(g.x, 0.2, axis=0) for g in frames], axis=0) - 4 * size
    high = np.max([np.percentile(g.x, 98.5, axis=0) for g in frames], axis=0) + 8 * size
    side = np.max([np.percentile(g.x[:, 2], 99.8) for g in frames]) + 4 * size
    return low[0], high[0], low[2], side


def centre_z(grains: Grains) -> float:
    """z of the centroid of the grains' volume [m]."""
    return float(np.average(grains.x[:, 2], weights=grains.d**3))
