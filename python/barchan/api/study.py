"""A study: the runs of its cases and one table of all."""

from typing import Any

from barchan.errors import optional
from barchan.io import columns
from barchan.io.study_folder import StudyFolder
from barchan.api.run import Run


class Study(StudyFolder):
    """The runs of a parameter study, as `./barchan sweep` leaves them; cases may be absent or unfinished.

    cases: list of Case -- name, values {key: value}, runs (one Run for each realisation that is there), gap (why it is
    not whole, None when it is).
    keys: the keys that are varied. gaps: a sentence on what is missing, empty when nothing is.
    """

    run_class = Run

    def __repr__(self) -> str:
        return f"<barchan.Study {self.path}: {self.title}, {len(self.cases)} cases>"

    def __getitem__(self, name: str) -> Run:
        """The first realisation of a case; study["base-r2"] is the second one. KeyError where it is not there."""
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

    def table(self) -> Any:
        """pandas.DataFrame with one line for each time of each dune of each run.

        Columns: case, realisation, status, every key that differs between the cases, then those of dune.csv;
        attrs["units"] are of the latter. Runs without dunes have no line.
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
        table.attrs = {"units": {name: unit for name, (unit, _) in columns.DUNES.items() if name in table},
                       "long_names": {name: about for name, (_, about) in columns.DUNES.items() if name in table}}
        return table

    def _differing(self) -> list[str]:
        keys = dict.fromkeys(key for case in self.cases for key in case.values if key != "case")
        return [key for key in keys if len({str(case.values.get(key)) for case in self.cases}) > 1]

    def figure(self, name: str, ax: Any = None, key: str | None = None, **options: Any) -> Any:
        """The matplotlib Figure of that name over the cases (barchan.figures.registry.OF_STUDY; or fig4 to fig9).

        key: which varied key, where the study varies several. ax, options and figure.numbers as of Run.figure.
        """
        from barchan.figures import registry, style

        entry, of_paper = registry.of_study(name)
        if entry.by_key:
            options["key"] = key or of_paper or self.keys[0]
        if ax is not None:
            options["ax"] = ax
        with style.look():
            return entry.draw(self, **options)
