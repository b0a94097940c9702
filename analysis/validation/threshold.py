"""threshold: where grains begin to move, force by force, from the runs of configs/validation/threshold.toml.

The velocity rises slowly. In windows of a quarter of a second the flux is set against the stress on the bed. The first
half second counts as the start. The flux grows exponentially with the stress, so a line through log q* of all windows
gives the Shields number at which q* passes a level; leaving out each realisation in turn, its standard error (names as
in bed_load).
"""

import matplotlib.pyplot as plt
import numpy as np

import style
import tables
from validation import bed_load

NAME = "threshold"
WINDOW, START = 0.25, 0.5  # [s]
LEVELS = {"creep": 1e-3, "transport": 1e-2}  # q*
FITTED = 1e-4, 1e-1  # q* of the windows that the line goes through: above the noise, below the law's bend
COLUMNS = "forces,realisation,shields,q_star"
SHOWN = ("as_in_the_paper", "lift", "all", "smoothed_exchange")


def measure(run):
    """Shields number and q* in each window after the start."""
    history = run.history
    scales = bed_load.Scales.of(run)
    window = np.ceil(history["t"] / WINDOW - 1e-9)  # the one that ends next
    return [(np.mean(history["stress_on_grains"][window == n]) / scales.stress,
             np.mean(history["grain_flux"][window == n]) / scales.flux)
            for n in range(round(START / WINDOW) + 1, int(window[-1]) + 1)]


def passing(shields, q_star, level):
    """Shields number at which a line through log q* passes the level."""
    fitted = (q_star >= FITTED[0]) & (q_star <= FITTED[1])
    if np.unique(shields[fitted]).size < 2:
        return np.nan
    slope, offset = np.polyfit(shields[fitted], np.log(q_star[fitted]), 1)
    return (np.log(level) - offset) / slope


def passing_with_error(table, level):
    """Of the rows of one case; without a second realisation there is no error."""
    whole = passing(table["shields"], table["q_star"], level)
    rest = [passing(table["shields"][kept], table["q_star"][kept], level)
            for kept in (table["realisation"] != number for number in table.values("realisation")) if kept.any()]
    count = len(rest)
    return whole, np.sqrt((count - 1) / count * np.sum((rest - np.mean(rest))**2)) if count > 1 else np.nan


def save(study_path, folder):
    """Keeps the windows of each finished run of the study as threshold.csv; returns the path."""
    study, cases = bed_load.finished(study_path)
    rows = [f"{case.name},{run.config['initial']['realisation']},{shields:.6g},{q_star:.6g}"
            for case, run in cases for shields, q_star in measure(run)]
    path = folder / f"{NAME}.csv"
    tables.write(path, bed_load.notes(study, "configs/validation/threshold.toml", cases[0][1]), [COLUMNS, *rows])
    return path


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
        found = np.array([passing_with_error(table.where("forces", name), level) for name in names])
        right.errorbar(found[:, 0], range(len(names)), xerr=np.nan_to_num(found[:, 1]), ls="", marker=marker, ms=4,
                       capsize=2, color=style.BLUE, label=f"{kind}: $q^*$ = {level:g}")
    right.set(yticks=range(len(names)), yticklabels=[name.replace("_", " ") for name in names], xlabel="Shields number")
    right.set_ylim(len(names) + 0.7, -0.6)
    right.legend(loc="lower right", ncols=2, fontsize=6)
    for index, axes in enumerate((left, right)):
        style.panel_label(axes, index)
    return figure


def summary(folder):
    """Lines `forces | creep | transport`: Shields number +- standard error."""
    table = tables.read_saved(folder, NAME)
    for name in table.values("forces"):
        found = [passing_with_error(table.where("forces", name), level) for level in LEVELS.values()]
        yield " | ".join([name] + [f"{value:.3f} +- {error:.3f}" for value, error in found])
