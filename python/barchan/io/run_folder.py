"""Reads a run folder, finished or not, whole or in part, into numpy arrays. SI units throughout.

Formats: docs/files.md. For work in a notebook see barchan.Run.
"""

import json
import tomllib
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from barchan.errors import BarchanError, MissingData
from barchan.io.clumps import Shapes, shapes_of
from barchan.io.frames import Flow, FrameFile, Grains, names_of, with_fed
from barchan.io.hdf5 import open_file
from barchan.io.horn_lengths import medians
from barchan.io.tables import read_columns
from barchan.io.units import About, of_columns


def text_of(path: Path) -> str:
    """A text file of a run; "" where there is no file that can be read."""
    try:
        return path.read_text(encoding="utf-8", errors="replace") if path.is_file() else ""
    except OSError:
        return ""


def json_of(path: Path) -> dict[str, Any]:
    """The object that a file holds; {} where it holds none."""
    try:
        found = json.loads(text_of(path))
    except (ValueError, RecursionError):
        return {}
    return found if isinstance(found, dict) else {}


def toml_of(text: str) -> dict[str, Any]:
    """{} for what is not TOML."""
    try:
        return tomllib.loads(text)
    except (tomllib.TOMLDecodeError, RecursionError):
        return {}


class RunFolder:
    """The files of a run; each is read when it is first asked for."""

    def __init__(self, path: str | Path) -> None:
        self.path = Path(path)
        if not self.path.exists():
            runs = Path("runs")
            meant = [other for other in (runs / path, *sorted(runs.glob(f"*/{self.path.name}"))) if other.is_dir()]
            hint = f" (did you mean {meant[0]}?)" if meant else ""
            raise BarchanError(f"no such run folder: {path}{hint}")
        if not self.path.is_dir():
            raise BarchanError(f"not a run folder but a file: {path}")

    def frame_file(self, name: str, needed: tuple[str, ...]) -> FrameFile | None:
        """The file of that name, None where it is absent or no frame of it has all arrays `needed`."""
        path = self.path / name
        if not path.exists():
            return None
        file = FrameFile(path, needed)
        return file if file.frames else None

    @cached_property
    def grain_file(self) -> FrameFile | None:
        return self.frame_file("grains.h5", ("id", "x", "d"))

    @cached_property
    def field_file(self) -> FrameFile | None:
        return self.frame_file("fields.h5", ("u", "v", "alpha_f"))

    @cached_property
    def slice_files(self) -> dict[str, FrameFile]:
        """{name: file} of the layers of cells, slice_NAME.h5, that have a frame."""
        files = {path.stem.removeprefix("slice_"): self.frame_file(path.name, ("u", "v", "alpha_f"))
                 for path in sorted(self.path.glob("slice_*.h5"))}
        return {name: file for name, file in files.items() if file is not None}

    def need_grains(self) -> FrameFile:
        if self.grain_file is None:
            raise MissingData("needs grains.h5 with at least one frame")
        return self.grain_file

    def need_fields(self) -> FrameFile:
        if self.field_file is None:
            raise MissingData("needs fields.h5 with at least one frame")
        return self.field_file

    @cached_property
    def _columns(self) -> dict[str, Any]:
        return json_of(self.path / "columns.json")

    def about(self, table: str) -> About:
        """Units and meanings of the columns of a table, {} where no file tells."""
        return of_columns(self._columns.get(table))

    def _table(self, name: str) -> dict[str, np.ndarray] | None:
        table = read_columns(self.path / name)
        return table if len(table.get("t", ())) else None

    @cached_property
    def history_columns(self) -> dict[str, np.ndarray] | None:
        """history.csv as {column: values (n)}, None where there is none."""
        return self._table("history.csv")

    @cached_property
    def statistics_columns(self) -> dict[str, np.ndarray]:
        """statistics.csv as {column: values (n)}, {} where there is none."""
        return read_columns(self.path / "statistics.csv")

    @cached_property
    def bed_load_columns(self) -> dict[str, np.ndarray]:
        """bedload.csv as {column: values (n)}, {} where there is none."""
        return read_columns(self.path / "bedload.csv")

    @cached_property
    def dune_columns(self) -> dict[int, dict[str, np.ndarray]] | None:
        """dune.csv as {label: {column: values (n)}}, None where there is none.

        Cx and Cz are without the jumps at a periodic boundary. Medians of horn lengths are added (horn_lengths.py).
        """
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
            result[int(label)] = dune
        return result

    @cached_property
    def body_columns(self) -> dict[int, dict[str, np.ndarray]] | None:
        """bodies.csv as {number: {column: values (n)}}, None where there is none."""
        table = self._table("bodies.csv")
        if table is None:
            return None
        numbers = np.unique(table["body"]).astype(int)
        return {int(number): {name: column[table["body"] == number] for name, column in table.items()}
                for number in numbers}

    @cached_property
    def body_lattices(self) -> list[dict[str, np.ndarray]] | None:
        """bodies.h5 as {name: values} of each body, None where there is none."""
        if not (self.path / "bodies.h5").exists():
            return None
        with open_file(self.path / "bodies.h5") as file:
            groups = [file[name] for name in sorted(file)]
            return [{name: group[name][:] for name in group} for group in groups]

    @cached_property
    def probe_columns(self) -> dict[str, dict[str, np.ndarray]] | None:
        """probes.csv as {name of the probe: {column: values (n)}}, None where there is none."""
        table = self._table("probes.csv")
        if table is None:
            return None
        output = self.config.get("output", {})
        known = output.get("probe", []) if isinstance(output, dict) else []
        numbers = np.unique(table["probe"]).astype(int)
        names = [str(known[n].get("name", n)) if n < len(known) else f"probe {n}" for n in numbers]
        return {name: {key: column[table["probe"] == number] for key, column in table.items()}
                for number, name in zip(numbers, names)}

    @property
    def main_dune_columns(self) -> dict[str, np.ndarray]:
        """Columns of the dune with the smallest label: the largest of the first time."""
        if self.dune_columns is None:
            raise MissingData("needs dune.csv with at least one line")
        return self.dune_columns[min(self.dune_columns)]

    @cached_property
    def config(self) -> dict[str, Any]:
        """The resolved case, {section: {key: value}}; {} where no file has it."""
        text = text_of(self.path / "config.toml")
        for file in () if text else (self.grain_file, self.field_file):
            text = text or (file.config_text if file else "")
        return toml_of(text)

    @cached_property
    def summary(self) -> dict[str, Any]:
        """run.json: status, times, rates, largest values; {} where there is none."""
        return json_of(self.path / "run.json")

    @cached_property
    def domain(self) -> tuple[float, float, float] | None:
        """(Lx, Ly, Lz) [m], None when no file tells."""
        size = self.config.get("domain", {}).get("size")
        if isinstance(size, list) and len(size) == 3:
            return float(size[0]), float(size[1]), float(size[2])
        return None

    @cached_property
    def mean_velocity(self) -> float | None:
        """Magnitude of the mean velocity that is held, `[x, z]` or along x alone [m/s]; None where none is."""
        velocity = self.config.get("fluid", {}).get("mean_velocity")
        return None if velocity is None else float(np.linalg.norm(velocity))

    @cached_property
    def title(self) -> str:
        return self.config.get("case", {}).get("title") or self.path.resolve().name

    @cached_property
    def shapes(self) -> Shapes | None:
        """Spheres of the clumps of each kind; None where all grains are spheres."""
        with self.need_grains().open() as content:
            return shapes_of(content)

    def frame(self, index: int) -> Grains:
        """The grains of frame `index` (negative: from the end), ordered by id."""
        file = self.need_grains()
        time, name = file.frames[index]
        with file.open() as content:
            group = content[name]
            order = np.argsort(group["id"][:])
            number, x, d = (group[key][:][order] for key in ("id", "x", "d"))
            dune, u, heap, kind, orientation = (group[key][:][order] if key in group else None
                                                for key in ("dune", "u", "heap", "kind", "orientation"))
            heap, heaps = with_fed(heap, names_of(group, "heap"))
            return Grains(time, number, x, d, dune, u, heap, heaps, kind, names_of(group, "kind"), orientation,
                          self.shapes)

    def flow_plane(self, index: int, z: float) -> Flow:
        """The cells nearest to the plane z = `z` [m] in frame `index`."""
        file = self.need_fields()
        time, name = file.frames[index]
        with file.open() as content:
            grid = {key: content["grid"][key][:] for key in ("x", "y", "z", "x_face", "y_face")}
            k = int(np.argmin(abs(grid["z"] - z)))
            group = content[name]
            u, v, alpha_f = (np.pad(group[key][k, :, :], 1, mode="edge")
                             for key in ("u", "v", "alpha_f"))
        walls = self.config.get("fluid", {})
        for row, wall, usual, speed in ((0, "bottom", "no_slip", 0.0),
                                        (-1, "top", "free_slip", walls.get("top_velocity", 0.0))):
            v[row] = 0.0
            if walls.get(wall, usual) == "no_slip":
                u[row] = speed
        x, y = (np.concatenate([grid[f"{a}_face"][:1], grid[a], grid[f"{a}_face"][-1:]])
                for a in ("x", "y"))
        return Flow(time, float(grid["z"][k]), x, y, u, v, alpha_f)
