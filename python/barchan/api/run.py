"""A run: its case, its tables, grains, fields and figures."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from barchan.errors import BarchanError, MissingData, seconds
from barchan.api import frames
from barchan.dune import encounters, obstacles
from barchan.io import horn_lengths, labelled
from barchan.io.progress import Progress
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import NAME
from barchan.io.units import About

if TYPE_CHECKING:
    from barchan.api.study import Study
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame
    from pyvista import MultiBlock
    from xarray import Dataset


class Run(RunFolder):
    """The results of a run in its folder.

    Nothing is read before it is asked for; tables are read once. A run that goes on is read as it is now; make the Run
    again to see what has come since. Everything is in SI units. At the end of a notebook's cell a Run shows its state
    and its grains.

    Attributes
    ----------
    path : pathlib.Path
        The run folder, which barchan.Run(path) takes.
    title : str
        Title of the case.
    config : dict
        The case with every default, as config.toml has it: {section: {key: value}}.
    summary : dict
        run.json: status, steps, times, largest values.
    domain : tuple of float
        Lengths of the domain (Lx, Ly, Lz) [m], None where no file tells.

    Raises
    ------
    BarchanError
        Where there is no such folder.
    MissingData
        By what asks for a file that the run has not written.
    """

    def __repr__(self) -> str:
        return f"<barchan.Run {self.path}: {self.title}, {self.summary.get('status', 'status unknown')}>"

    def _repr_html_(self) -> str:
        from barchan.report import cell

        return cell.html(self)

    # --- tables

    @cached_property
    def history(self) -> DataFrame:
        """history.csv, indexed by t [s]; attrs["units"] and attrs["long_names"] say what the columns are."""
        if self.history_columns is None:
            raise MissingData("needs history.csv with at least one line")
        return labelled.data_frame(self.history_columns, self.about("history.csv")).set_index("t")

    @cached_property
    def dunes(self) -> DataFrame:
        """dune.csv, indexed by (dune, t [s]); run.dunes.loc[0] is the main dune.

        Cx and Cz are without jumps at a periodic boundary. horn_left_2d_1s and horn_right_2d_1s are the lengths of
        the horns that the figures show: medians over a second of what is two grains high.
        """
        if self.dune_columns is None:
            raise MissingData("needs dune.csv with at least one line")
        joined = labelled.together(self.dune_columns, whole="dune")
        return labelled.data_frame(joined, self.about("dune.csv") | horn_lengths.ABOUT).set_index(["dune", "t"])

    @cached_property
    def body_forces(self) -> DataFrame:
        """bodies.csv, indexed by (body, t [s]); run.body_forces.loc[0] is the first [[body]]."""
        if self.body_columns is None:
            raise MissingData("needs bodies.csv with at least one line")
        joined = labelled.together(self.body_columns, whole="body")
        return labelled.data_frame(joined, self.about("bodies.csv")).set_index(["body", "t"])

    @cached_property
    def probes(self) -> DataFrame:
        """probes.csv, indexed by (probe, point, t [s]); run.probes.loc["wake", 0] is one point.

        x, y, z [m]; u, v, w [m/s]; p [Pa]; wall_shear_x, wall_shear_z [Pa]: the shear stress on the floor below.
        """
        if self.probe_columns is None:
            raise MissingData("needs probes.csv with at least one line: [[output.probe]]")
        tables = self.probe_columns
        joined = labelled.together(tables, whole="point")
        joined["probe"] = np.repeat(list(tables), [len(table["t"]) for table in tables.values()])
        return labelled.data_frame(joined, self.about("probes.csv")).set_index(["probe", "point", "t"]).sort_index()

    @cached_property
    def statistics(self) -> DataFrame:
        """statistics.csv, indexed by y [m]: averages over planes and time."""
        return self._read("statistics.csv", "[statistics]").set_index("y")

    @cached_property
    def bed_load(self) -> DataFrame:
        """bedload.csv, indexed by y [m]: grains in layers; surface of the bed, stress and load there in all lines."""
        return self._read("bedload.csv", "statistics.bed_load = true").set_index("y")

    @cached_property
    def heaps(self) -> DataFrame:
        """heaps.csv, indexed by (dune, heap, t [s]): which grains each dune has."""
        return self._read("heaps.csv", "[[initial.heap]]").set_index(["dune", "heap", "t"])

    @property
    def encounters(self) -> DataFrame:
        """encounters.csv, one line for each; `./barchan plot RUN encounters` writes it."""
        return self._read("encounters.csv", "./barchan plot RUN encounters", encounters.ABOUT, text=("new_dunes",))

    @property
    def obstacles(self) -> DataFrame:
        """obstacles.csv, one line for each dune and obstacle; `./barchan plot RUN obstacles` writes it."""
        return self._read("obstacles.csv", "./barchan plot RUN obstacles", obstacles.ABOUT, text=("obstacle",))

    @cached_property
    def force_map(self) -> DataFrame:
        """force_map.csv: mean force on the grains in polar bins about the dune."""
        return self._read("force_map.csv", "statistics.grain_forces = true")

    def _read(self, name: str, source: str, about: About | None = None, text: Sequence[str] = ()) -> DataFrame:
        """A table that may have words in it. Raises MissingData, with what writes the table."""
        return labelled.read_table(self.path / name, source, self.about(name) if about is None else about, text)

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
        """(n) times of the frames of grains.h5 [s]."""
        return self.need_grains().times

    @property
    def field_times(self) -> np.ndarray:
        """(n) times of the frames of fields.h5 [s]."""
        return self.need_fields().times

    def grains(self, t: float | None = None, frame: int | None = None) -> DataFrame:
        """The grains of one frame, a row for each, indexed by id.

        Parameters
        ----------
        t : float, optional
            Time [s], of which the nearest frame is taken.
        frame : int, optional
            Number of the frame, from the end if negative. Without `t` and `frame` the last is taken.

        Returns
        -------
        pandas.DataFrame
            x, y, z, d [m], u, v, w [m/s], omega_x, ... [rad/s], dune (label, -1: in none), kind (an index of
            attrs["kinds"], the names) where there are several, and forces [N] where the run has written them.
            attrs["time"] is the time of the frame [s], attrs["units"] are the units of the columns.

        Raises
        ------
        MissingData
            Where grains.h5 has no frame.
        BarchanError
            Where no frame is near `t`, there is none of that number, or both are given.
        """
        file = self.need_grains()
        return frames.grains_of(file, file.index(t, frame))

    def spheres(self, t: float | None = None, frame: int | None = None) -> DataFrame:
        """The spheres that the grains of one frame consist of: of clumps several, else the grains themselves.

        Parameters
        ----------
        t : float, optional
            Time [s], of which the nearest frame is taken.
        frame : int, optional
            Number of the frame, from the end if negative. Without `t` and `frame` the last is taken.

        Returns
        -------
        pandas.DataFrame
            x, y, z, d [m], a row for each sphere, indexed by the id of its grain; attrs as of `grains`. At a periodic
            boundary spheres stay with their grain.

        Raises
        ------
        MissingData
            Where grains.h5 has no frame.
        BarchanError
            Where no frame is near `t`, there is none of that number, or both are given.
        """
        return frames.spheres_of(self.frame(self.need_grains().index(t, frame)))

    def frames(self, progress: bool = True) -> Iterator[DataFrame]:
        """The grains of every frame in turn; only one frame is in memory.

        Parameters
        ----------
        progress : bool, optional
            Whether a line on standard error tells how far it is.

        Yields
        ------
        pandas.DataFrame
            As of `grains`.

        Raises
        ------
        MissingData
            Where grains.h5 has no frame.
        """
        file = self.need_grains()
        for index in Progress(range(len(file.frames)), "reading grains", progress):
            yield frames.grains_of(file, index)

    def track(self, ids: Sequence[int], progress: bool = True) -> DataFrame:
        """Where grains are in every frame.

        Frames are those of tracks.h5, which are close in time, else those of grains.h5. Positions at a periodic
        boundary jump by its length.

        Parameters
        ----------
        ids : sequence of int
            (n) ids of grains, such as the index of `grains`.
        progress : bool, optional
            Whether a line on standard error tells how far it is.

        Returns
        -------
        pandas.DataFrame
            A row for each grain and each frame in which it is inside: id, t [s], x, y, z [m].

        Raises
        ------
        MissingData
            Where there is no frame of grains.
        BarchanError
            Where ids are no whole numbers, or none of these grains is in any frame.
        """
        return frames.track(self.frame_file("tracks.h5", ("id", "x")) or self.need_grains(), ids, progress)

    # --- fields

    @cached_property
    def fields(self) -> Dataset:
        """The flow of every frame of fields.h5: u, v, w [m/s], p [Pa], alpha_f, nu_t [m2/s] in the cell centres.

        Dimensions are time [s], z, y, x [m]. Coordinates, units, axes and the bounds of the cells (x_bnds (x, 2), ...)
        are as CF has them, which calls the vertical axis, y, Z. A field is read where its values are used:
        run.fields.u.sel(time=0.8, z=0.02, method="nearest") reads one plane of one frame. Raises MissingData where
        fields.h5 has no frame.
        """
        return labelled.xarray_fields().dataset(self.need_fields())

    @cached_property
    def slices(self) -> dict[str, Dataset]:
        """Layers of cells by the names of [[output.slice]], each as `fields`; {} where there is none."""
        return {name: labelled.xarray_fields().dataset(file) for name, file in self.slice_files.items()}

    @cached_property
    def flow_average(self) -> Dataset:
        """flow_average.h5: means and second moments uu, vv, ... [m2/s2] over z, y, x, else as `fields`.

        attrs: time (end of the window), window_start [s], n_samples. Raises MissingData where there is no such file.
        """
        file = self.frame_file("flow_average.h5", ("u", "v", "alpha_f"))
        if file is None:
            raise MissingData("needs flow_average.h5: a run with statistics.fields = true")
        return labelled.xarray_fields().average(file)

    # --- pictures

    def figure(self, name: str, ax: Axes | np.ndarray | None = None, **options: Any) -> Figure:
        """A figure of `./barchan plot`, without a file.

        Parameters
        ----------
        name : str
            Name of the figure; `./barchan plot --help` and barchan.figures.registry.OF_RUN list them.
        ax : matplotlib Axes or array of Axes, optional
            Axes of your own, as many as the figure has panels.
        **options
            As of the command line: start, end (means from, to) and time [s].

        Returns
        -------
        matplotlib.figure.Figure
            figure.numbers has the numbers behind it, {table: {column: values}}.

        Raises
        ------
        MissingData
            Where the run has not what the figure needs.
        BarchanError
            Where there is no such figure, or it is a file, or a time is no number.
        """
        from barchan.figures import registry, style

        entry = registry.of_run(name)
        options = in_seconds(options)
        if entry.writes:
            raise BarchanError(f"{name} is a file, not a figure: ./barchan plot {self.path} {name} writes it")
        with style.look():
            return entry.draw(self, ax=ax, **options) if ax is not None else entry.draw(self, **options)

    def to_pyvista(self, t: float | None = None, frame: int | None = None) -> MultiBlock:
        """Grains and flow of one time for PyVista.

        Parameters
        ----------
        t : float, optional
            Time [s], of which the nearest frame of the grains is taken.
        frame : int, optional
            Number of that frame, from the end if negative. Without `t` and `frame` the last is taken.

        Returns
        -------
        pyvista.MultiBlock
            "grains": a PolyData of their centres (N, 3) [m], with d and all else as point data. Where the run has
            clumps, "spheres": likewise their spheres, with d and id. Where it has fields, "flow": a RectilinearGrid
            with cell data, of the frame nearest in time.

        Raises
        ------
        MissingData
            Where grains.h5 has no frame.
        BarchanError
            Where there is no such frame, or no PyVista.
        """
        from barchan.api import scene

        return scene.multi_block(self, t, frame)


def in_seconds(options: dict[str, Any]) -> dict[str, Any]:
    """Options of a figure, times among them as numbers. Raises BarchanError where one is none."""
    return {name: seconds(name, value) if name in ("start", "end", "time") and value is not None else value
            for name, value in options.items()}


def open_folder(path: str | Path) -> Run | Study:
    """The results in a folder; nothing is computed.

    Parameters
    ----------
    path : str or pathlib.Path
        The folder of a run or of a study.

    Returns
    -------
    Run or Study
        A Study where the folder has a study.json.

    Raises
    ------
    BarchanError
        Where there is no such folder, or its study.json cannot be read.
    """
    from barchan.api.study import Study

    return Study(path) if (Path(path) / NAME).exists() else Run(path)
