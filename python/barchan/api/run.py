"""A run: its case, its tables, grains, fields and figures."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import Any

import numpy as np

from barchan.errors import BarchanError, MissingData, optional
from barchan.io import columns, labelled
from barchan.io.frames import FrameFile, names_of
from barchan.io.progress import Progress
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import NAME

FIELDS_NEEDED = ("u", "v", "alpha_f")


class Run(RunFolder):
    """The results of a run in its folder. Nothing is read before it is asked for; tables are read once.

    A run that goes on is read as it is now; make the Run again to see what has come since. Everything is in SI units.

    config: dict of dict -- the case with every default, as config.toml has it.
    summary: dict -- run.json: status, steps, times, largest values.
    title: str; path: pathlib.Path; domain: (Lx, Ly, Lz) [m].

    Raises BarchanError where there is no such folder. What asks for a file that the run has not written raises
    MissingData.
    """

    def __repr__(self) -> str:
        return f"<barchan.Run {self.path}: {self.title}, {self.summary.get('status', 'status unknown')}>"

    # --- tables

    @cached_property
    def history(self) -> Any:
        """pandas.DataFrame of history.csv, indexed by t [s]; attrs["units"], attrs["long_names"]."""
        if self.history_columns is None:
            raise MissingData("needs history.csv with at least one line")
        return labelled.data_frame(self.history_columns, columns.HISTORY).set_index("t")

    @cached_property
    def dunes(self) -> Any:
        """pandas.DataFrame of dune.csv, indexed by (dune, t [s]); run.dunes.loc[0] is the main dune.

        Cx and Cz are without jumps at a periodic boundary. horn_left_2d_1s and horn_right_2d_1s are the lengths of
        the horns that the figures show: medians over a second of what is two grains high.
        """
        if self.dune_columns is None:
            raise MissingData("needs dune.csv with at least one line")
        tables = list(self.dune_columns.values())
        joined = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
        joined["dune"] = joined["dune"].astype(int)
        return labelled.data_frame(joined, columns.DUNES).set_index(["dune", "t"])

    @cached_property
    def body_forces(self) -> Any:
        """pandas.DataFrame of bodies.csv, indexed by (body, t [s]); run.body_forces.loc[0] is the first [[body]]."""
        if self.body_columns is None:
            raise MissingData("needs bodies.csv with at least one line")
        tables = list(self.body_columns.values())
        joined = {name: np.concatenate([table[name] for table in tables]) for name in tables[0]}
        joined["body"] = joined["body"].astype(int)
        return labelled.data_frame(joined, columns.BODIES).set_index(["body", "t"])

    @cached_property
    def probes(self) -> Any:
        """pandas.DataFrame of probes.csv, indexed by (probe, point, t [s]); run.probes.loc["wake", 0] is one point.

        x, y, z [m]; u, v, w [m/s]; p [Pa]; wall_shear_x, wall_shear_z [Pa]: the shear stress on the floor below.
        """
        if self.probe_columns is None:
            raise MissingData("needs probes.csv with at least one line: [[output.probe]]")
        tables = self.probe_columns
        joined = {key: np.concatenate([table[key] for table in tables.values()]) for key in columns.PROBES}
        joined["point"] = joined["point"].astype(int)
        joined["probe"] = np.repeat(list(tables), [len(table["t"]) for table in tables.values()])
        return labelled.data_frame(joined, columns.PROBES).set_index(["probe", "point", "t"]).sort_index()

    @cached_property
    def statistics(self) -> Any:
        """pandas.DataFrame of statistics.csv, indexed by y [m]: averages over planes and time."""
        return self._read("statistics.csv", columns.STATISTICS, "[statistics]").set_index("y")

    @cached_property
    def heaps(self) -> Any:
        """pandas.DataFrame of heaps.csv, indexed by (dune, heap, t [s]): which grains each dune has."""
        return self._read("heaps.csv", columns.HEAPS, "[[initial.heap]]").set_index(["dune", "heap", "t"])

    @property
    def encounters(self) -> Any:
        """pandas.DataFrame of encounters.csv, one line for each; `./barchan plot RUN encounters` writes it."""
        return self._read("encounters.csv", columns.ENCOUNTERS, "./barchan plot RUN encounters", text=("new_dunes",))

    @property
    def obstacles(self) -> Any:
        """pandas.DataFrame of obstacles.csv, one line for each dune and obstacle; `./barchan plot RUN obstacles` writes
        it."""
        return self._read("obstacles.csv", columns.OBSTACLES, "./barchan plot RUN obstacles", text=("obstacle",))

    @cached_property
    def force_map(self) -> Any:
        """pandas.DataFrame of force_map.csv: mean force on the grains in polar bins about the dune."""
        return self._read("force_map.csv", columns.FORCE_MAP, "statistics.grain_forces = true")

    def _read(self, name: str, about: dict[str, tuple[str, str]], source: str, text: Sequence[str] = ()) -> Any:
        """A table that may have words in it. Raises MissingData, with what writes the table."""
        pandas = optional("pandas", "pandas")
        path = self.path / name
        if not path.is_file():
            raise MissingData(f"needs {name}: {source}")
        try:
            table = pandas.read_csv(path, dtype=dict.fromkeys(text, str), keep_default_na=False, na_values=["nan"])
        except ValueError as problem:
            raise BarchanError(f"{path} cannot be read: {problem}") from None
        return labelled.data_frame({key: table[key].to_numpy() for key in table}, about)

    @property
    def restarts(self) -> dict[int, Path]:
        """{fluid step: restart file}, in order of the steps."""
        return {int(path.stem.removeprefix("restart_")): path for path in sorted(self.path.glob("restart_*.h5"))
                if path.stem.removeprefix("restart_").isdigit()}

    @property
    def log(self) -> str:
        """What log.txt says, empty where there is none."""
        path = self.path / "log.txt"
        return path.read_text(errors="replace") if path.is_file() else ""

    def __dir__(self) -> list[str]:
        """What is for users; figures and reports take more from a run."""
        own = [name for name in vars(Run) if not name.startswith("_")]
        return sorted([*own, "config", "domain", "path", "summary", "title"])

    # --- grains

    @property
    def grain_times(self) -> np.ndarray:
        """Times of the frames of grains.h5 (n) [s]."""
        return self.need_grains().times

    @property
    def field_times(self) -> np.ndarray:
        """Times of the frames of fields.h5 (n) [s]."""
        return self.need_fields().times

    def grains(self, t: float | None = None, frame: int | None = None) -> Any:
        """pandas.DataFrame of the grains at the frame nearest to t [s], or of number `frame`; the last by default.

        One row for each grain, indexed by id: x, y, z, d [m], u, v, w [m/s], omega_x, ... [rad/s], dune (label, -1: in
        none), kind (an index of attrs["kinds"], the names) where there are several, and forces [N] where the run has
        written them. Its time [s] is attrs["time"], units are attrs["units"].
        """
        file = self.need_grains()
        return self._grains_of(file, file.index(t, frame))

    def frames(self, progress: bool = True) -> Iterator[Any]:
        """The same for every frame in turn; only one is in memory. A line of progress on standard error."""
        file = self.need_grains()
        for index in Progress(range(len(file.frames)), "reading grains", progress):
            yield self._grains_of(file, index)

    @staticmethod
    def _grains_of(file: FrameFile, index: int) -> Any:
        time, name = file.frames[index]
        with file.open() as content:
            group = content[name]
            order = np.argsort(group["id"][:])
            found = {key: group[key][:][order] for key in group}
            kinds = names_of(group, "kind")
        grains = labelled.grains_frame(time, found)
        grains.attrs["kinds"] = kinds
        return grains

    def track(self, ids: Sequence[int], progress: bool = True) -> Any:
        """pandas.DataFrame of where grains are in every frame: id, t [s], x, y, z [m], one row for each that is inside.

        Frames are those of tracks.h5, which are close in time, else those of grains.h5. Positions at a periodic
        boundary jump by its length.
        """
        file = self.frame_file("tracks.h5", ("id", "x")) or self.need_grains()
        wanted = np.unique(np.asarray(ids, dtype=np.int64))
        parts: list[dict[str, np.ndarray]] = []
        with file.open() as content:
            for time, name in Progress(file.frames, "following grains", progress):
                number = content[name]["id"][:]
                rows = np.nonzero(np.isin(number, wanted))[0]
                x = content[name]["x"][:][rows].astype(float)
                parts.append({"id": number[rows], "t": np.full(len(rows), time), **dict(zip("xyz", x.T))})
        joined = {name: np.concatenate([part[name] for part in parts]) for name in parts[0]}
        order = np.lexsort((joined["t"], joined["id"]))
        about = {"id": columns.GRAINS["id"], "t": ("s", "time"), **columns.AXES}
        return labelled.data_frame({name: values[order] for name, values in joined.items()}, about)

    # --- fields

    def fields(self, t: float | None = None, frame: int | None = None) -> Any:
        """xarray.Dataset of the flow at the frame nearest to t [s], or of number `frame`; the last by default.

        u, v, w [m/s], p [Pa], alpha_f, nu_t [m2/s] in the cell centres, dimensions (z, y, x), coordinates in metres,
        units and long names as CF has them. A field is read where its values are used: run.fields().u.sel(z=0.02,
        method="nearest") reads one plane.
        """
        file = self.need_fields()
        return labelled.dataset(file, file.index(t, frame))

    @cached_property
    def flow_average(self) -> Any:
        """xarray.Dataset of flow_average.h5: means and second moments uu, vv, ... [m2/s2], as `fields`.

        attrs: time (end of the window), window_start [s], n_samples.
        """
        file = self.frame_file("flow_average.h5", FIELDS_NEEDED)
        if file is None:
            raise MissingData("needs flow_average.h5: a run with statistics.fields = true")
        return labelled.dataset(file, len(file.frames) - 1)

    # --- pictures

    def figure(self, name: str, ax: Any = None, **options: Any) -> Any:
        """The matplotlib Figure of that name (`./barchan plot --help` lists them; barchan.figures.registry.OF_RUN).

        ax: an array of as many axes of your own as the figure has panels. Options as of the command line: start, end
        (means from, to) and time [s]. figure.numbers has the numbers behind it, {table: {column: values}}.
        """
        from barchan.figures import registry, style

        entry = registry.of_run(name)
        if entry.writes:
            raise BarchanError(f"{name} is a file, not a figure: ./barchan plot {self.path} {name} writes it")
        with style.look():
            return entry.draw(self, ax=ax, **options) if ax is not None else entry.draw(self, **options)

    def to_pyvista(self, t: float | None = None, frame: int | None = None) -> Any:
        """pyvista.MultiBlock for the time t [s] or number `frame` of the grains: "grains" (a PolyData of their centres,
        with d and all else as point data) and, where the run has fields, "flow" (a RectilinearGrid with cell data, of
        the frame nearest in time).
        """
        pyvista = optional("pyvista", "pyvista")
        grains = self.grains(t, frame)
        points = pyvista.PolyData(grains[["x", "y", "z"]].to_numpy())
        points.point_data["id"] = grains.index.to_numpy()
        for name in grains.columns.drop(["x", "y", "z"]):
            points.point_data[name] = grains[name].to_numpy()
        blocks = pyvista.MultiBlock({"grains": points})
        if self.field_file is not None:
            blocks["flow"] = self._rectilinear(pyvista, self.field_file, grains.attrs["time"])
        return blocks

    @staticmethod
    def _rectilinear(pyvista: Any, file: FrameFile, time: float) -> Any:
        _, name = file.frames[int(np.argmin(abs(file.times - time)))]
        with file.open() as content:
            grid = pyvista.RectilinearGrid(*(content["grid"][f"{axis}_face"][:] for axis in "xyz"))
            for field in content[name]:
                grid.cell_data[field] = content[name][field][:].ravel()  # x fastest, as VTK has it
        return grid


def open_folder(path: str | Path) -> Any:
    """A Run, or a Study where the folder has a study.json. Raises BarchanError where there is no such folder."""
    from barchan.api.study import Study

    return Study(path) if (Path(path) / NAME).exists() else Run(path)
