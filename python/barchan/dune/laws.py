"""Laws over the size of dunes: celerity, width, height, horns, loss and formation time against length.

Every run is a point: its main dune over the second half of its time, or over another window. Definitions and the
errors of the fits: docs/studies.md, "Laws". SI units.
"""

from collections.abc import Iterator
from dataclasses import dataclass
from typing import Any

import numpy as np

from barchan.dune.shape import BIN
from barchan.io import horn_lengths
from barchan.stats import in_window, student_t

FEWEST = 3    # runs that make a law
KINDS = {"celerity": "power", "W": "line", "H": "line", "horn": "line", "loss": "power", "formation_time": "power"}


@dataclass
class Law:
    """y = a L^n (power) or y = a + n L (line), and half the width of the 95 % interval of n."""

    kind: str
    a: float
    n: float
    interval: float
    runs: int

    def __call__(self, length: np.ndarray) -> np.ndarray:
        return self.a * length**self.n if self.kind == "power" else self.a + self.n * length


def measure(study: Any, start: float | None = None, end: float | None = None) -> dict[str, np.ndarray]:
    """Columns of all runs of the study whose main dune has four times in the window."""
    rows = [{"case": case.name, "realisation": number, **of_run(run, start, end)}
            for case in study.cases for number, run in enumerate(case.runs, 1)
            if run.dune_columns is not None and of_run(run, start, end)]
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


def formation_time(dune: dict[str, np.ndarray], since: float = 0.0) -> float:
    """How long after `since` both horns have become longer than a bin for good [s]; not a number before that, nor for
    horns that are there from the first time on. A median over the last second follows half a second later."""
    grain = (6 / np.pi * dune["volume"] / dune["n_grains"])**(1 / 3)
    horns = np.min([dune[column] for column in horn_lengths.best_known(dune).values()], axis=0)
    short = np.nonzero(horns < BIN * grain)[0]
    first = short[-1] + 1 if len(short) else 0
    lag = 0.5 * horn_lengths.SECOND if horn_lengths.name("left") in dune else 0.0
    return dune["t"][first] - lag - since if 0 < first < len(dune["t"]) else np.nan


def fit(length: np.ndarray, values: np.ndarray, kind: str) -> Law | None:
    """Least squares over all runs, of the logarithms for a power; None for fewer than three runs or one length."""
    known = np.isfinite(values) & ((values > 0) | (kind == "line"))
    x, y = length[known], values[known]
    if len(x) < FEWEST or np.ptp(x) == 0:
        return None
    if kind == "power":
        x, y = np.log(x), np.log(y)
    from_mean = x - x.mean()
    slope = from_mean @ y / (from_mean @ from_mean)
    intercept = y.mean() - slope * x.mean()
    residual = y - intercept - slope * x
    error = np.sqrt(residual @ residual / (len(x) - 2) / (from_mean @ from_mean))
    a = np.exp(intercept) if kind == "power" else intercept
    return Law(kind, float(a), float(slope), float(student_t(0.975, len(x) - 2) * error), len(x))


def sentences(laws: dict[str, Law | None]) -> Iterator[str]:
    for name, law in laws.items():
        if law is None:
            yield f"{name}: fewer than {FEWEST} runs to fit"
        elif law.kind == "power":
            yield f"{name} ~ L^n, n = {law.n:.3g} +- {law.interval:.2g} (95 %, {law.runs} runs)"
        else:
            yield (f"{name} = a + n L, a = {1e3 * law.a:.3g} mm, n = {law.n:.3g} +- {law.interval:.2g} "
                   f"(95 %, {law.runs} runs)")
