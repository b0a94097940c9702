"""threshold: where grains begin to move, force by force, from the runs of configs/validation/threshold.toml.

The velocity rises slowly. In windows of a quarter of a second the flux is set against the stress on the bed. The first
half second counts as the start. Grains begin to move at the Shields number at which q* first passes a level (names as
in bed_load).
"""

import matplotlib.pyplot as plt
import numpy as np

import style
import tables
from spread import spread
from validation import bed_load

NAME = "threshold"
WINDOW, START = 0.25, 0.5  # [s]
LEVELS = {"creep": 1e-3, "transport": 1e-2}  # q*
COLUMNS = "forces,realisation,shields,q_star"
BASE, SHOWN = "as_in_the_paper", ("as_in_the_paper", "lift", "all", "smoothed_exchange")


def measure(run):
    """Shields number and q* in each window after the start."""
    history = run.history
    scales = bed_load.Scales.of(run)
    window = np.ceil(history["t"] / WINDOW - 1e-9)  # the one that ends next
    return [(np.mean(history["stress_on_grains"][window == n]) / scales.stress,
             np.mean(history["grain_flux"][window == n]) / scales.flux)
            for n in range(round(START / WINDOW) + 1, int(window[-1]) + 1)]


def passing(shields, q_star, level):
    """Shields number between the two windows where q* first passes the level, by the logarithm of q*."""
    above = np.flatnonzero(q_star >= level)
    if above.size == 0 or above[0] == 0:
        return np.nan
    n = above[0]
    below = max(q_star[n - 1], 1e-6)
    share = np.log(level / below) / np.log(q_star[n] / below)
    return shields[n - 1] + share * (shields[n] - shields[n - 1])


def save(study_path, folder):
    """Keeps the windows of each finished run of the study as threshold.csv; returns the path."""
    study, cases = bed_load.finished(study_path)
    rows = [f"{case.name},{run.config['initial']['realisation']},{shields:.6g},{q_star:.6g}"
            for case, run in cases for shields, q_star in measure(run)]
    path = folder / f"{NAME}.csv"
    tables.write(path, bed_load.notes(study, "configs/validation/threshold.toml", cases[0][1]), [COLUMNS, *rows])
    return path


def thresholds(table, level):
    """Of each realisation of the rows of one case."""
    found = [passing(one["shields"], one["q_star"], level)
             for one in (table.where("realisation", number) for number in table.values("realisation"))]
    return [value for value in found if np.isfinite(value)]


def draw(folder):
    table = tables.read_saved(folder, NAME)
    figure, (left, right) = plt.subplots(1, 2, figsize=(style.FULL_WIDTH, 3.2), layout="constrained")
    shields = np.linspace(0.02, 0.5, 300)
    left.plot(shields, bed_load.wong_parker(shields), color="k", lw=0.7, ls=":", label="Wong & Parker, rough")
    colours = (style.BLUE, style.GREEN, style.VERMILLION, style.ORANGE)
    for name, colour in zip(SHOWN, colours):
        points = table.where("forces", name)
        if len(points["shields"]):
            left.plot(points["shields"], np.maximum(points["q_star"], 1e-5), ls="", marker="o", ms=2.5, color=colour,
                      label=name.replace("_", " "))
    left.set(yscale="log", ylim=(1e-5, 1), xlim=(0, 0.5), xlabel="Shields number", ylabel="$q^*$")
    left.legend(loc="lower right", fontsize=6)
    names = table.values("forces")
    for (kind, level), marker in zip(LEVELS.items(), ("o", "s")):
        found = [thresholds(table.where("forces", name), level) for name in names]
        for place, values in enumerate(found):
            right.plot(values, [place] * len(values), ls="", marker=".", ms=3, color="0.6")
        means = [spread(values).mean if values else np.nan for values in found]
        right.plot(means, range(len(names)), ls="", marker=marker, ms=4, color=style.BLUE,
                   label=f"{kind}: $q^*$ = {level:g}")
    right.set(yticks=range(len(names)), yticklabels=[name.replace("_", " ") for name in names], xlabel="Shields number")
    right.invert_yaxis()
    right.legend(loc="lower left", fontsize=6)
    for index, axes in enumerate((left, right)):
        style.panel_label(axes, index)
    return figure


def summary(folder):
    """Lines `forces, creep, transport`: mean +- standard deviation of the realisations."""
    table = tables.read_saved(folder, NAME)
    for name in table.values("forces"):
        found = [thresholds(table.where("forces", name), level) for level in LEVELS.values()]
        yield ", ".join([name] + [f"{spread(v).mean:.3f} +- {spread(v).deviation:.3f} ({len(v)})" if v else "none"
                                  for v in found])
