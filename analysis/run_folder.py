"""Reads a run folder, finished or not, whole or in part. SI units throughout.

Formats: history.csv, dune.csv, grains.h5, fields.h5, config.toml as written by `barchan run`.
"""

import tomllib
from dataclasses import dataclass
from functools import cached_property
from pathlib import Path

import numpy as np
from hdf5_files import PlotError, open_file, patiently
from horn_lengths import medians


class NotInRun(PlotError):
    """The run has no data for this figure."""


def read_table(path):
    """Columns of a CSV by name, as float arrays; lines that are cut short are left out."""
    lines = path.read_text(errors="replace").splitlines()
    if not lines:
        return {}
    names = [name.strip() for name in lines[0].split(",")]
    rows = []
    for line in lines[1:]:
        cells = line.split(",")
        if len(cells) != len(names):
            continue
        try:
            rows.append([float(cell) if cell.strip() else np.nan for cell in cells])
        except ValueError:
            continue
    columns = np.array(rows).reshape(-1, len(names)).T
    return dict(zip(names, columns))


@dataclass
class Grains:
    """Grains of one frame: id (N), x (N, 3) [m], d (N) [m]; dune (N): its label, -1: none; u (N, 3) [m/s].

    dune and u are None where the frame has none.
    """

    time: float
    id: np.ndarray
    x: np.ndarray
    d: np.ndarray
    dune: np.ndarray | None = None
    u: np.ndarray | None = None


@dataclass
class Flow:
    """A vertical plane z = `z` of the flow, from wall to top and from end to end.

    u, v [m/s] and alpha_f, each (ny + 2, nx + 2), at x (nx + 2) and y (ny + 2) [m]: the cell centres
    and the edges of the domain, where the nearest cell's value stands, at a no-slip wall zero.
    """

    time: float
    z: float
    x: np.ndarray
    y: np.ndarray
    u: np.ndarray
    v: np.ndarray
    alpha_f: np.ndarray


class FrameFile:
    """grains.h5 or fields.h5: times and names of the frames that are complete."""

    def __init__(self, path, needed):
        self.path = path
        patiently(path, lambda: self.look(needed))

    def look(self, needed):
        with self.open() as file:
            self.config_text = file.attrs.get("config", "")
            self.title = file.attrs.get("title", "")
            self.frames = []
            for name in sorted(name for name in file if name.startswith("frame_")):
                group = file[name]
                if "time" in group.attrs and all(key in group for key in needed):
                    self.frames.append((float(group.attrs["time"]), name))

    def open(self):
        return open_file(self.path)

    @property
    def times(self):
        return np.array([time for time, _ in self.frames])

    def evenly_spaced(self, counts=(8, 6, 7, 5)):
        """Indices of frames evenly spaced in time, first and last included.

        Takes the first of `counts` for which frames lie at exactly even times; when none does, the
        frames nearest to the times of the first.
        """
        times = self.times
        chosen = []
        for count in counts + counts[:1]:
            wanted = np.linspace(times[0], times[-1], count)
            chosen = [int(np.argmin(abs(times - time))) for time in wanted]
            if np.allclose(times[chosen], wanted, atol=0.01 * (times[-1] - times[0]) / count):
                break
        return sorted(set(chosen))


class RunFolder:
    def __init__(self, path):
        self.path = Path(path)
        if not self.path.exists():
            raise PlotError(f"no such run folder: {path}")
        if not self.path.is_dir():
            raise PlotError(f"not a run folder but a file: {path}")

    def _frame_file(self, name, needed):
        path = self.path / name
        if not path.exists():
            return None
        file = FrameFile(path, needed)
        return file if file.frames else None

    @cached_property
    def grain_file(self):
        return self._frame_file("grains.h5", ("id", "x", "d"))

    @cached_property
    def field_file(self):
        return self._frame_file("fields.h5", ("u", "v", "alpha_f"))

    def need_grains(self):
        if self.grain_file is None:
            raise NotInRun("needs grains.h5 with at least one frame")
        return self.grain_file

    def need_fields(self):
        if self.field_file is None:
            raise NotInRun("needs fields.h5 with at least one frame")
        return self.field_file

    def _table(self, name):
        path = self.path / name
        table = read_table(path) if path.exists() else {}
        return table if table and len(table.get("t", ())) else None

    @cached_property
    def history(self):
        return self._table("history.csv")

    @cached_property
    def dunes(self):
        """dune.csv as {label: columns}; Cz without the jumps at a periodic boundary; medians of horns."""
        table = self._table("dune.csv")
        if table is None:
            return None
        result = {}
        for label in np.unique(table["dune"]).astype(int):
            rows = table["dune"] == label
            dune = {name: column[rows] for name, column in table.items()}
            if self.domain is not None:
                dune["Cx"] = np.unwrap(dune["Cx"], period=self.domain[0])
                dune["Cz"] = np.unwrap(dune["Cz"], period=self.domain[2])
            dune |= {name: np.array(values) for name, values in medians(dune).items()}
            result[label] = dune
        return result

    @cached_property
    def config(self):
        path = self.path / "config.toml"
        text = path.read_text(errors="replace") if path.exists() else ""
        for file in (self.grain_file, self.field_file):
            text = text or (file.config_text if file else "")
        try:
            return tomllib.loads(text)
        except tomllib.TOMLDecodeError:
            return {}

    @cached_property
    def domain(self):
        """(Lx, Ly, Lz) [m], None when no file tells."""
        size = self.config.get("domain", {}).get("size")
        if isinstance(size, list) and len(size) == 3:
            return tuple(float(length) for length in size)
        return None

    @cached_property
    def title(self):
        return self.config.get("case", {}).get("title") or self.path.resolve().name

    def grains(self, index):
        """The grains of frame `index` (negative: from the end), ordered by id."""
        time, name = self.need_grains().frames[index]
        with self.grain_file.open() as file:
            group = file[name]
            order = np.argsort(group["id"][:])
            columns = (group[key][:][order] if key in group else None for key in ("id", "x", "d", "dune", "u"))
            return Grains(time, *columns)

    def flow_plane(self, index, z):
        """The cells nearest to the plane z = `z` [m] in frame `index`."""
        time, name = self.need_fields().frames[index]
        with self.field_file.open() as file:
            grid = {key: file["grid"][key][:] for key in ("x", "y", "z", "x_face", "y_face")}
            k = int(np.argmin(abs(grid["z"] - z)))
            group = file[name]
            u, v, alpha_f = (np.pad(group[key][k, :, :], 1, mode="edge")
                             for key in ("u", "v", "alpha_f"))
        walls = self.config.get("fluid", {})
        for row, wall, usual in ((0, "bottom", "no_slip"), (-1, "top", "free_slip")):
            v[row] = 0.0
            if walls.get(wall, usual) == "no_slip":
                u[row] = 0.0
        x, y = (np.concatenate([grid[f"{a}_face"][:1], grid[a], grid[f"{a}_face"][-1:]])
                for a in ("x", "y"))
        return Flow(time, float(grid["z"][k]), x, y, u, v, alpha_f)

    def write_curves(self, figure, columns, most=2000):
        """The numbers behind a figure: figures_data/`figure`.csv, at most `most` lines."""
        folder = self.path / "figures_data"
        folder.mkdir(exist_ok=True)
        names = list(columns)
        rows = np.column_stack([columns[name] for name in names])
        rows = rows[thin(len(rows), most)]
        np.savetxt(folder / f"{figure}.csv", rows, delimiter=",", fmt="%.9g",
                   header=",".join(names), comments="")


def thin(n, most=2000):
    """Indices of at most `most` of n lines, first and last included."""
    if n <= most:
        return np.arange(n)
    return np.unique(np.linspace(0, n - 1, most).round().astype(int))
