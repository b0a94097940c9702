"""A study: the runs of its cases and one table of all."""

from __future__ import annotations

from typing import TYPE_CHECKING, Any

import numpy as np

from barchan.errors import optional
from barchan.io.study_folder import StudyFolder
from barchan.api.run import Run, in_seconds

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure
    from pandas import DataFrame


class Study(StudyFolder):
    """The runs of a parameter study, as `./barchan sweep` leaves them; cases may be absent or unfinished.

    study["base"] is the first run of a case, study["base-r2"] its second realisation; KeyError where it is not there.

    Attributes
    ----------
    path : pathlib.Path
        The folder of the study, which barchan.Study(path) takes.
    only : list of str
        The cases whose names fit one of these patterns (*, ?, [abc]), which Study(path, only) takes; empty: all.
    title : str
        Title of the study.
    cases : list of Case
        Each with name, values {key: value}, runs (a Run for each realisation that is there) and gap (why it is not
        whole, None when it is).
    keys : list of str
        The keys that are varied.
    gaps : str
        A sentence on what is missing, empty when nothing is.

    Raises
    ------
    BarchanError
        Where study.json is not there or cannot be read.
    """

    run_class = Run

    def __repr__(self) -> str:
        return f"<barchan.Study {self.path}: {self.title}, {len(self.cases)} cases>"

    def __getitem__(self, name: str) -> Run:
        case, _, number = name.rpartition("-r")
        for one in self.cases:
            if one.name == name and one.run:
                return one.run
            if one.name == case:
                for run in one.others:
                    if run.path.name == name:
                        return run
        raise KeyError(f"no run {name} in {self.path}; it has "
                       + ", ".join(run.path.name for one in self.cases for run in one.runs))

    def table(self) -> DataFrame:
        """One table of all runs that have dunes.

        Returns
        -------
        pandas.DataFrame
            A row for each time of each dune of each run: case, realisation, status, every key that differs between the
            cases, then the columns of dune.csv, of which attrs["units"] has the units.

        Raises
        ------
        BarchanError
            Where a file cannot be read.
        """
        pandas = optional("pandas", "pandas")
        parts = []
        differing = self._differing()
        for case in self.cases:
            for number, run in enumerate(case.runs, 1):
                if run.dune_columns is None:
                    continue
                part = run.dunes.reset_index()
                front = {"case": case.name, "realisation": number, "status": run.summary.get("status", "unknown"),
                         **{key: str(case.values[key]) if isinstance(case.values[key], list) else case.values[key]
                            for key in differing if key in case.values}}
                for place, (name, value) in enumerate(front.items()):
                    part.insert(place, name, value)
                parts.append(part)
        table = pandas.concat(parts, ignore_index=True) if parts else pandas.DataFrame()
        table.attrs = {what: {name: words for part in parts for name, words in part.attrs[what].items()}
                       for what in ("units", "long_names")}
        return table

    def _differing(self) -> list[str]:
        keys = dict.fromkeys(key for case in self.cases for key in case.values if key != "case")
        return [key for key in keys if len({str(case.values.get(key)) for case in self.cases}) > 1]

    def figure(self, name: str, ax: Axes | np.ndarray | None = None, key: str | None = None, **options: Any) -> Figure:
        """A figure over the cases.

        Parameters
        ----------
        name : str
            Name of the figure; `./barchan plot --help` and barchan.figures.registry.OF_STUDY list them. fig4 to fig9
            are names, too.
        ax : matplotlib Axes or array of Axes, optional
            Axes of your own, as many as the figure has panels.
        key : str, optional
            Which varied key, where the study varies several; else the first.
        **options
            As of the command line: start, end (means from, to) [s].

        Returns
        -------
        matplotlib.figure.Figure
            figure.numbers has the numbers behind it, {table: {column: values}}.

        Raises
        ------
        MissingData
            Where the study has not what the figure needs.
        BarchanError
            Where there is no such figure, or a time is no number.
        """
        from barchan.figures import registry, style

        entry, of_paper = registry.of_study(name)
        options = in_seconds(options)
        if entry.by_key:
            options["key"] = key or of_paper or self.keys[0]
        if ax is not None:
            options["ax"] = ax
        with style.look():
            return entry.draw(self, **options)
