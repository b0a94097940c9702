"""laws of a study: celerity, width, height, horns, loss and formation time of dunes against their length, with fits.

Every run is a point: its main dune over the second half of its time, or from --from to --to. Definitions and the
errors of the fits: docs/conventions.md, "Laws". Asked for by its name it says the laws in words, too.
"""

from dataclasses import dataclass

import matplotlib.pyplot as plt
import numpy as np

import horn_lengths
import style
from dune_shape import BIN
from dune_transport import in_window
from morphology_study import looks
from run_folder import NotInRun
from spread import spread

OPTIONS = ("start", "end", "figures")
FEWEST = 3    # runs that make a law
# name: (axis, factor to its unit, law): a power of L, or linear in L.
QUANTITIES = {
    "celerity": ("celerity $c$ (mm/s)", 1e3, "power"),
    "W": ("width $W$ (mm)", 1e3, "line"),
    "H": ("height $H$ (mm)", 1e3, "line"),
    "horn": ("horn length (mm)", 1e3, "line"),
    "loss": ("loss (% of the grains / s)", 1e2, "power"),
    "formation_time": ("formation time (s)", 1.0, "power"),
}


@dataclass
class Law:
    """y = a L^n (power) or y = a + n L (line), and half the width of the 95 % interval of n."""

    kind: str
    a: float
    n: float
    interval: float
    runs: int

    def __call__(self, length):
        return self.a * length**self.n if self.kind == "power" else self.a + self.n * length


def draw(study, start=None, end=None, figures=("laws",)):
    table = measure(study, start, end)
    if len(set(table["case"])) < 2:
        raise NotInRun("needs two cases with dunes in dune.csv")
    laws = {name: fit(table["L"], table[name], kind) for name, (_, _, kind) in QUANTITIES.items()}
    for sentence in sentences(laws) if figures else ():
        print(sentence)
    study.write_rows("laws", {name: [list(column)] for name, column in table.items()})
    figure, panels = plt.subplots(2, 3, figsize=(style.FULL_WIDTH, 4.4))
    for index, (axes, name) in enumerate(zip(panels.ravel(), QUANTITIES)):
        draw_quantity(axes, table, name, laws[name])
        style.panel_label(axes, index)
    return figure


def measure(study, start, end):
    """Columns of all runs of the study whose main dune has four times in the window."""
    rows = [{"case": case.name, "realisation": number, **of_run(run, start, end)}
            for case in study.cases for number, run in enumerate(case.runs, 1)
            if run.dunes is not None and of_run(run, start, end)]
    return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else {"case": 0})}


def of_run(run, start, end):
    """Means and slopes of the main dune over the window; nothing where it has too few times."""
    dune = run.dunes[min(run.dunes)]
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


def formation_time(dune):
    """When both horns have become longer than a bin for good [s]; not a number before that. A median over the last
    second follows half a second later."""
    grain = (6 / np.pi * dune["volume"] / dune["n_grains"])**(1 / 3)
    horns = np.min([dune[column] for column in horn_lengths.best_known(dune).values()], axis=0)
    short = np.nonzero(horns < BIN * grain)[0]
    first = short[-1] + 1 if len(short) else 0
    lag = 0.5 * horn_lengths.SECOND if horn_lengths.name("left") in dune else 0.0
    return dune["t"][first] - lag if 0 < first < len(dune["t"]) else np.nan


def fit(length, values, kind):
    """Least squares over all runs, of the logarithms for a power; None for fewer than three runs or one length."""
    known = np.isfinite(values) & ((values > 0) | (kind == "line"))
    x, y = length[known], values[known]
    if len(x) < FEWEST or np.ptp(x) == 0:
        return None
    if kind == "power":
        x, y = np.log(x), np.log(y)
    from scipy import stats  # takes half a second: only where a law is asked for

    line = stats.linregress(x, y)
    a = np.exp(line.intercept) if kind == "power" else line.intercept
    return Law(kind, float(a), float(line.slope), float(stats.t.ppf(0.975, len(x) - 2) * line.stderr), len(x))


def sentences(laws):
    for name, law in laws.items():
        if law is None:
            yield f"{name}: fewer than {FEWEST} runs to fit"
        elif law.kind == "power":
            yield f"{name} ~ L^n, n = {law.n:.3g} +- {law.interval:.2g} (95 %, {law.runs} runs)"
        else:
            yield (f"{name} = a + n L, a = {1e3 * law.a:.3g} mm, n = {law.n:.3g} +- {law.interval:.2g} "
                   f"(95 %, {law.runs} runs)")


def draw_quantity(axes, table, name, law):
    label, factor, kind = QUANTITIES[name]
    cases = list(dict.fromkeys(table["case"].tolist()))
    for case, (colour, marker) in zip(cases, looks(len(cases))):
        rows = table["case"] == case
        length, values = 1e3 * table["L"][rows], factor * table[name][rows]
        axes.plot(length, values, ls="", marker=marker, ms=3, mec=colour, mfc="white", mew=0.7)
        if np.count_nonzero(np.isfinite(values)) > 1:
            x, y = spread(length.tolist()), spread(values[np.isfinite(values)].tolist())
            axes.errorbar(x.mean, y.mean, y.interval, x.interval, fmt="none", ecolor=colour, elinewidth=0.9, capsize=2)
    if law:
        length = np.linspace(table["L"].min(), table["L"].max(), 50)
        text = f"$L^{{{law.n:.2f} \\pm {law.interval:.2f}}}$" if kind == "power" else \
            f"slope {law.n:.2f} $\\pm$ {law.interval:.2f}"
        axes.plot(1e3 * length, factor * law(length), color=style.BLACK, lw=0.9, ls=(0, (4, 1.5)), label=text)
        axes.legend(loc="best")
    if kind == "power" and (factor * table[name][np.isfinite(table[name])] > 0).any():
        axes.set(xscale="log", yscale="log")
    axes.set(xlabel="length $L$ (mm)", ylabel=label)
