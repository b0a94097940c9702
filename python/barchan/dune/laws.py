"""Laws of an ensemble: what dunes are and do against their size and the flow, beside what is published.

Every run is a point: its main dune over the second half of its time, or over another window. Definitions and the
errors of the fits: docs/studies.md, "Laws". SI units.
"""

import json
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np

from barchan.dune import transport
from barchan.dune.fits import Law, fit
from barchan.dune.shape import BIN
from barchan.errors import MissingData
from barchan.io import horn_lengths
from barchan.io.study_folder import BY_NAME, Case
from barchan.stats import in_window

IN_WORDS = {"celerity_L": "celerity L", "crest_flux": "flux over the crest", "phi_c_H": "phi c H"}
MANY = 100  # standard errors: beyond that they are not counted
OF_THE_FLOW = ("fluid.", "initial.fluid")  # keys that differ between cases of one size and several velocities


@dataclass(frozen=True)
class Relation:
    """The column y of `measure` against x: a power y = a x^n, a line y = a + n x or a ratio y = n x.

    among: runs that are alike in this column share an a. published: lowest and highest n of the source; None where we
    know of none to compare with. The sources in full: docs/glossary.md.
    """

    y: str
    x: str
    kind: str
    published: tuple[float, float] | None = None
    source: str = ""
    among: str = "mean_velocity"

    @property
    def formula(self) -> str:
        x, y = (IN_WORDS.get(name, name) for name in (self.x, self.y))
        return {"power": f"{y} ~ {x}^n", "line": f"{y} = a + n {x}", "ratio": f"{y} = n {x}"}[self.kind]

    def fit(self, table: dict[str, np.ndarray]) -> Law | None:
        groups = table[self.among] if self.kind != "ratio" else None
        return fit(table[self.x], table[self.y], self.kind, table["case"], groups)


# Andreotti et al.: c = Q/(H + H0) has the exponent -1/(1 + H0/H): -1 for large dunes, -1/2 for one as high as H0.
RELATIONS = {
    "celerity": Relation("celerity", "L", "power", (-1, -1), "Hersen 2005"),
    "celerity_by_height": Relation("celerity", "H", "power", (-1, -0.5), "Andreotti et al. 2002"),
    "celerity_by_flow": Relation("celerity_L", "u_star", "power", (3, 3), "Hersen 2005", among="size"),
    "W": Relation("W", "L", "line", (1, 1), "Hersen et al. 2002"),
    "H": Relation("H", "L", "line", (0.1, 0.1), "Hersen et al. 2002"),
    "horn": Relation("horn", "L", "line"),
    "loss": Relation("loss", "L", "power"),
    "formation_time": Relation("formation_time", "L", "power"),
    "flux": Relation("crest_flux", "phi_c_H", "ratio", (1, 1), "Bagnold 1941"),
}


def measure(study: Any, start: float | None = None, end: float | None = None) -> dict[str, np.ndarray]:
    """Columns of all runs of the study whose main dune has four times in the window.

    The values of `of_run`; celerity_L = celerity L [m2/s]; u_star [m/s], crest_flux and phi_c_H [m2/s], not numbers
    where the run lacks the files; mean_velocity [m/s], 0 where none is held; size, a label that is the same for cases
    that differ in the flow alone.
    """
    rows = []
    for case in study.cases:
        for number, run in enumerate(case.runs, 1):
            values = of_run(run, start, end) if run.dune_columns is not None else {}
            if values:
                rows.append({"case": case.name, "realisation": number, **values,
                             "celerity_L": values["celerity"] * values["L"], **of_flow(run, start, end),
                             **over_crest(run, values["celerity"], start, end), "size": size_of(case)})
    return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else {"case": 0})}


def of_run(run: Any, start: float | None = None, end: float | None = None) -> dict[str, float]:
    """Means and slopes of the main dune over the window; nothing where it has too few times."""
    dune = run.main_dune_columns
    t = dune["t"]
    rows = in_window(t, start, end)
    if np.count_nonzero(rows) < 4:
        return {}
    grains = dune["n_grains"][rows].mean()
    horns = np.mean([dune[column] for column in horn_lengths.best_known(dune).values()], axis=0)
    slope = {name: np.polyfit(t[rows], dune[name][rows], 1)[0] for name in ("Cx", "n_grains")}
    return {"grains": grains, **{name: dune[name][rows].mean() for name in ("L", "W", "H")},
            "celerity": slope["Cx"], "horn": horns[rows].mean(), "loss": -slope["n_grains"] / grains,
            "formation_time": formation_time(dune)}


def of_flow(run: Any, start: float | None, end: float | None) -> dict[str, float]:
    history = run.history_columns
    u_star = history["u_star"][in_window(history["t"], start, end)] if history else np.empty(0)
    return {"u_star": u_star.mean() if len(u_star) else np.nan, "mean_velocity": round(run.mean_velocity or 0.0, 9)}


def over_crest(run: Any, celerity: float, start: float | None, end: float | None) -> dict[str, float]:
    """Flux over the crest and phi c H [m2/s], both of the window: docs/dune-measures.md, "Slopes and transport"."""
    names = ("crest_flux", "solid_height")
    try:
        known = transport.over_window(transport.measure(run)[0], names, start, end)
    except MissingData:
        known = {}
    flux, height = (known.get(name, np.nan) for name in names)
    return {"crest_flux": flux, "phi_c_H": celerity * height}


def size_of(case: Case) -> str:
    values = {key: value for key, value in case.values.items() if key != BY_NAME and not key.startswith(OF_THE_FLOW)}
    return json.dumps([case.base, values], sort_keys=True)


def formation_time(dune: dict[str, np.ndarray], since: float = 0.0) -> float:
    """How long after `since` both horns have become longer than a bin for good [s]; not a number before that, nor for
    horns that are there from the first time on. A median over the last second follows half a second later."""
    grain = (6 / np.pi * dune["volume"] / dune["n_grains"])**(1 / 3)
    horns = np.min([dune[column] for column in horn_lengths.best_known(dune).values()], axis=0)
    short = np.nonzero(horns < BIN * grain)[0]
    first = short[-1] + 1 if len(short) else 0
    lag = 0.5 * horn_lengths.SECOND if horn_lengths.name("left") in dune else 0.0
    return dune["t"][first] - lag - since if 0 < first < len(dune["t"]) else np.nan


def need_two_cases(table: dict[str, np.ndarray]) -> None:
    """MissingData where a law would have a single point."""
    cases = list(dict.fromkeys(table["case"].tolist()))
    if len(cases) < 2:
        found = f'only "{cases[0]}" has one' if cases else "no case has one"
        raise MissingData("needs two cases with dunes in dune.csv, of other sizes or in other flows, with four times "
                          f"in the window: {found}")


def verdict(law: Law, relation: Relation) -> str:
    """How n stands to what is published: within its 95 % interval, or how far out."""
    if relation.published is None:
        return ""
    nearest = float(np.clip(law.n, *relation.published))
    if law.holds(nearest):
        return "within, but so is 0: too few runs, or too much alike" if law.holds(0.0) else "within"
    side, off = "above" if law.n > nearest else "below", abs(law.n - nearest)
    return f"{side} by " + (f"{off / law.error:.2g}" if off < MANY * law.error else f"over {MANY}") + " standard errors"


def sentences(table: dict[str, np.ndarray], laws: dict[str, Law | None]) -> Iterator[str]:
    for name, law in laws.items():
        relation = RELATIONS[name]
        yield f"{relation.formula}" + (without_fit(table, relation) if law is None else with_fit(law, relation))
    yield from on_realisations(table["case"].tolist())


def with_fit(law: Law, relation: Relation) -> str:
    a = ""
    if relation.kind == "line" and len(law.centres) == 1:
        zero, error = law.zero
        a = f", a = {1e3 * law.a:.3g} mm, 0 at L = {1e3 * zero:.3g} +- {1e3 * error:.2g} mm"
    runs = f"{law.runs} runs" if law.runs == law.known else f"{law.runs} of {law.known} runs, the others not positive"
    said = f"{a}, n = {law.n:.3g} +- {law.error:.2g} (standard error; 95 %: +- {law.interval:.2g}; {runs})"
    if relation.published is None:
        return said
    low, high = relation.published
    return (f"{said}; published {low:g}{f' to {high:g}' if high > low else ''} ({relation.source}): "
            f"{verdict(law, relation)}")


def without_fit(table: dict[str, np.ndarray], relation: Relation) -> str:
    """Why there is no law."""
    known = np.isfinite(table[relation.x]) & np.isfinite(table[relation.y])
    if relation.among == "size" and len(set(table["mean_velocity"])) < 2:
        return ": needs cases that differ in fluid.mean_velocity"
    if not known.any():
        return ": not known in any run" + (" (needs tracks.h5 or grains.h5)" if relation.y == "crest_flux" else "")
    return f": too few runs to fit, or cases alike in {relation.x}"


def on_realisations(names: Sequence[str]) -> Iterator[str]:
    """Which cases are single runs, whose spread is not known."""
    single = [name for name in dict.fromkeys(names) if names.count(name) == 1]
    if single:
        which = "any case" if len(single) == len(set(names)) else ", ".join(single)
        yield (f"errors do not know the spread of {which}: one realisation each; give the study [ensemble] "
               "realisations = 3 or more")
