"""Mean resultant force on the grains in polar bins about the centroid of the main dune; no drawing.

From force_map.csv, which the program averages during the run, else (or for another window of time)
from the frames of grains.h5 that hold force_total. Angles in degrees: 0 downstream, 90 left (z < Cz),
270 right. Forces in N, lengths in m.
"""

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np

from barchan.dune.horns import polar_angle
from barchan.dune.shape import BIN
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.io.frames import FrameFile, Grains
from barchan.io.run_folder import RunFolder
from barchan.io.tables import read_columns
from barchan.stats import within

COLUMNS = ("r_min", "r_max", "phi_min", "phi_max", "n", "F_x", "F_y", "F_z")
PHI_BIN = 10.0
Sample = tuple[np.ndarray, np.ndarray, float, float]  # x, force, mean diameter, reach of a frame
REACH = 1.25  # of the largest distance of a dune's grain from its centroid, 99 % of them


@dataclass
class ForceMap:
    """`bins`: the columns of force_map.csv; `start`, `end` [s] of the mean, None if not known."""

    bins: dict
    start: float | None
    end: float | None
    source: str

    @property
    def caption(self) -> str:
        if self.start is None:
            return self.source
        return f"{self.source}, {self.start:.3g} s ≤ $t$ ≤ {self.end:.3g} s"

    @property
    def place(self) -> tuple[np.ndarray, np.ndarray]:
        """x, z (bins) [m] of the middle of each bin from the centroid."""
        r = 0.5 * (self.bins["r_min"] + self.bins["r_max"])
        phi = np.radians(0.5 * (self.bins["phi_min"] + self.bins["phi_max"]))
        return r * np.cos(phi), -r * np.sin(phi)


def read(run: RunFolder, start: float | None = None, end: float | None = None) -> ForceMap:
    """The program's own mean unless a window is asked for."""
    path = run.path / "force_map.csv"
    bins = read_columns(path) if start is None and end is None else {}
    if all(name in bins for name in COLUMNS) and len(bins["n"]):
        began, ended = (float(bins[name][0]) if name in bins else None for name in ("t_start", "t_end"))
        return ForceMap({name: bins[name] for name in COLUMNS}, began, ended, "mean over the run")
    return over_frames(run, start, end)


def over_frames(run: RunFolder, start: float | None, end: float | None) -> ForceMap:
    file = run.frame_file("grains.h5", ("id", "x", "d", "force_total"))
    if file is None:
        raise MissingData("needs force_map.csv, or grains.h5 with force_total (output.grain_forces = true)")
    first, last = file.times[[0, -1]]
    start = 0.5 * (first + last) if start is None else start
    end = last if end is None else end
    inside = [name for time, name in file.frames if within(time, start, end)]
    if not inside:
        raise MissingData(f"needs a frame with forces between t = {start:g} s and {end:g} s")
    samples = [sample for sample in (read_sample(run, file, name) for name in inside) if sample]
    if not samples:
        raise MissingData(f"needs a dune between t = {start:g} s and {end:g} s")
    return ForceMap(average(samples), float(start), float(end),
                    f"mean over {len(samples)} frames of grains.h5")


def read_sample(run: RunFolder, file: FrameFile, name: str) -> Sample | None:
    """(x (n, 3) [m] about the dune's centroid, force (n, 3) [N], diameter, reach [m]) of a frame, or None."""
    source = tracks(run)
    with file.open() as content:
        group = content[name]
        number, x, d, force = (group[key][:] for key in ("id", "x", "d", "force_total"))
        known = np.isfinite(x).all(axis=1) & np.isfinite(force).all(axis=1)
        dune = group["dune"][:][known] if "dune" in group else None
        grains = Grains(float(group.attrs["time"]), number[known], x[known], d[known], dune)
    dune = source.main_dune(grains)
    if dune is None:
        return None
    force = force[known].astype(float)
    reach = np.percentile(np.hypot(dune.x - dune.centroid[0], dune.z - dune.centroid[2]), 99)
    return source.bed.nearest(grains.x - dune.centroid), force, grains.d.mean(), reach


def average(samples: Sequence[Sample]) -> dict[str, np.ndarray]:
    """The columns of force_map.csv; bins without grains are left out."""
    size = BIN * samples[0][2]
    n_r = int(np.ceil(REACH * max(reach for *_, reach in samples) / size))
    n_phi = int(360 / PHI_BIN)
    number, force = np.zeros(n_r * n_phi), np.zeros((3, n_r * n_phi))
    for x, f, *_ in samples:
        ring = (np.hypot(x[:, 0], x[:, 2]) / size).astype(int)
        sector = np.minimum((polar_angle(x) / PHI_BIN).astype(int), n_phi - 1)
        near = ring < n_r
        at = (ring * n_phi + sector)[near]
        number += np.bincount(at, minlength=len(number))
        force += [np.bincount(at, f[near, axis], len(number)) for axis in range(3)]
    held = np.nonzero(number)[0]
    ring, sector = held // n_phi, held % n_phi
    values = [ring * size, (ring + 1) * size, sector * PHI_BIN, (sector + 1) * PHI_BIN, number[held],
              *(force[:, held] / number[held])]
    return dict(zip(COLUMNS, values))


def outline(run: RunFolder, start: float | None, end: float | None,
            most: int = 40) -> tuple[np.ndarray, np.ndarray, np.ndarray] | None:
    """Share of frames in which the main dune covers a place: x, z (n) [m] from its centroid, share (n, n).

    None when no frame is in the window. Cells are one bin of the dune analytics wide.
    """
    source = tracks(run)
    frames = [i for i, t in enumerate(source.times)
              if start is None or end is None or within(t, start, end)]
    frames = frames[::-(-len(frames) // most) or 1]
    maps: list[np.ndarray] = []
    edges = np.empty(0)
    for index in frames:
        grains = source.read(index)
        dune = source.main_dune(grains)
        if dune is None:
            continue
        x, z = dune.x - dune.centroid[0], dune.z - dune.centroid[2]
        if not len(edges):
            size = BIN * grains.d.mean()
            half = int(np.ceil(2.0 * np.hypot(x, z).max() / size)) + 0.5
            edges = size * np.arange(-half, half + 1)
        maps.append(np.histogram2d(x, z, (edges, edges))[0] > 0)  # type: ignore[arg-type]
    if not maps:
        return None
    middle = 0.5 * (edges[1:] + edges[:-1])
    return middle, middle, np.mean(maps, axis=0)
