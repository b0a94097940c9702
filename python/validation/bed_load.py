"""bed_load: flux over a flat bed against the shear stress, from the runs of configs/validation/flat-bed-study.toml.

Laws beside it, with the Shields number s = stress / ((rho_s - rho_f) g d) and q* = q / sqrt((rho_s/rho_f - 1) g d^3):
Wong & Parker, J. Hydraul. Eng. 132, 1159 (2006), fitted to rough beds; van Rijn, J. Hydraul. Eng. 110, 1431 (1984),
to sand of 0.2 to 2 mm, with the threshold of Soulsby & Whitehouse (1997). In laminar flow grains begin to move at
s = 0.12 +- 0.03: Ouriemi et al., Phys. Fluids 19, 061706 (2007).

The stress is that at the surface of the bed (bed_surface.py). Of runs without bedload.csv it is the driving gradient
times the height of the water above a bed packed to PACKED.
"""

import json
from dataclasses import dataclass

import numpy as np

from barchan.figures import style
from validation import bed_surface, tables
from barchan.errors import MissingData
from barchan.stats import spread
from barchan.io.study_folder import StudyFolder, gap_of

NAME = "bed_load"
SMOOTHING_ITSELF = 2.0  # [s]; from then on the bed is measured
PACKED = 0.58  # solid fraction of a loose bed: gives the height of its surface
GRAVITY, VISCOSITY, WATER = 9.81, 1e-6, 1000.0
LAMINAR_THRESHOLD = 0.12, 0.03
FORCES = {9: "all forces", 8: "without mixture viscosity", 5: "forces of the paper"}  # by their number
MOVES = 1e-4  # q* below it counts as rest
KEYS = 4  # the first columns: which run a row is of
COLUMNS = ("rolling_friction,smoothing_length,mean_velocity,realisation,seconds,stress,shields,grain_reynolds,flux,"
           "q_star,q_star_deviation,bed_surface")


def wong_parker(shields):
    return 3.97 * np.maximum(0, shields - 0.0495)**1.5


def van_rijn(shields, size=4.90):
    """`size`: D* = d ((rho_s/rho_f - 1) g / nu^2)^(1/3); threshold of Soulsby & Whitehouse."""
    threshold = 0.30 / (1 + 1.2 * size) + 0.055 * (1 - np.exp(-0.020 * size))
    return 0.053 * np.maximum(0, shields / threshold - 1)**2.1 / size**0.3


@dataclass
class Scales:
    """Of the grains of a run, by their median diameter: what makes stress and flux dimensionless."""

    size: float  # [m]
    stress: float  # [Pa]
    flux: float  # [m2/s]

    @classmethod
    def of(cls, run):
        size = np.median(run.frame(0).d.astype(float))
        excess = run.config["grains"]["density"] / WATER - 1
        return cls(size, excess * WATER * GRAVITY * size, np.sqrt(excess * GRAVITY * size**3))


def measure(run):
    """The row of a run; its flux in blocks of one second gives the deviation."""
    config, history, scales = run.config, run.history_columns, Scales.of(run)
    area = config["domain"]["size"][0] * config["domain"]["size"][2]
    volume = np.sum(np.pi / 6 * run.frame(0).d.astype(float)**3)
    water_above = config["domain"]["size"][1] - volume / (PACKED * area)
    late = history["t"] > SMOOTHING_ITSELF
    t, flux = history["t"][late], history["grain_flux"][late]
    bed = bed_surface.of(run)
    stress = bed.stress if bed.known else np.mean(history["pressure_gradient"][late]) * water_above
    shields = bed.shields if bed.known else stress / scales.stress
    blocks = [np.mean(block) / scales.flux for block in np.array_split(flux, max(1, round(t[-1] - SMOOTHING_ITSELF)))]
    return (config["grains"]["rolling_friction"], config["coupling"]["smoothing_length"],
            config["fluid"]["mean_velocity"], config["initial"]["realisation"], t[-1] - SMOOTHING_ITSELF, stress,
            shields, np.sqrt(stress / WATER) * scales.size / VISCOSITY,
            np.mean(flux), np.mean(flux) / scales.flux, np.std(blocks), bed.surface)


def finished(study_path):
    """A study, and each of its cases with each of its finished runs."""
    study = StudyFolder(study_path)
    runs = [(case, run) for case in study.cases for run in case.runs if gap_of(run.path) is None]
    if not runs:
        raise MissingData(f"needs a finished run in {study_path}")
    return study, runs


def notes(study, config, run):
    """What a table of the runs of a study says of itself."""
    identity = json.loads((run.path / "run.json").read_text())
    return tables.about(study.title, f"./barchan sweep {config}", identity)


def as_row(values):
    return ",".join(f"{value:.6g}" for value in values)


def key_of(row, keys=KEYS):
    return tuple(map(float, row.split(",")[:keys]))


def with_earlier(path, said, rows, keys=KEYS):
    """Notes and rows with those of an earlier table: a run that was done again replaces its row.

    A study of many hours is so gathered from several machines; the notes name every commit, machine and day. Columns
    that the earlier table did not have are added at the end; its rows have no number there.
    """
    if not path.exists():
        return said, rows
    earlier = tables.read_table(path)
    for name in ("commit", "machine", "date"):
        before = earlier.notes.get(name, "").split(" and ")
        said[name] = " and ".join(dict.fromkeys([*filter(None, before), *said[name].split(" and ")]))
    new = max((row.count(",") + 1 for row in rows), default=0)
    lacking = ",nan" * max(0, new - len(earlier.columns))
    said |= {name: text for name, text in earlier.notes.items() if name == "rule"}
    kept = {key_of(row, keys): row + lacking for row in map(as_row, zip(*earlier.columns.values()))}
    return said, list((kept | {key_of(row, keys): row for row in rows}).values())


def save(study_path, folder):
    """Keeps one row for each finished run of the study as bed_load.csv, beside those kept before; returns the path."""
    study, runs = finished(study_path)
    path = folder / f"{NAME}.csv"
    said, rows = with_earlier(path, notes(study, "configs/validation/flat-bed-study.toml", runs[0][1]),
                              [as_row(measure(run)) for _, run in runs])
    tables.write(path, said, [COLUMNS, *sorted(rows, key=key_of)])
    return path


def fit(shields, q_star):
    """Slope a and threshold s_c of q* = a (s - s_c)^1.5, by least squares of q*^(2/3) where grains move."""
    moving = q_star > MOVES
    if np.unique(np.round(shields[moving], 2)).size < 2:
        return np.nan, np.nan
    slope, offset = np.polyfit(shields[moving], q_star[moving]**(2 / 3), 1)
    return slope**1.5, -offset / slope


def fit_with_errors(shields, q_star, draws=500):
    """The fit and the standard errors of both numbers: runs drawn again, with replacement."""
    generator = np.random.default_rng(1)
    again = np.array([fit(shields[rows], q_star[rows])
                      for rows in generator.integers(0, shields.size, (draws, shields.size))])
    found = again[np.isfinite(again[:, 0])]
    return fit(shields, q_star), np.std(found, axis=0) if len(found) > 1 else np.full(2, np.nan)


def means(table):
    """Of the realisations of each case: Shields number, q* and half its 95 % interval."""
    points = [table.where("mean_velocity", velocity) for velocity in table.values("mean_velocity")]
    return np.array([(np.mean(p["shields"]), spread(p["q_star"].tolist()).mean, spread(p["q_star"].tolist()).interval)
                     for p in points]).T


def draw(folder):
    table = tables.read_saved(folder, NAME)
    figure, ((left, right),) = style.panels(None, 1, 2, figsize=(style.FULL_WIDTH, 3.2))
    shields = np.linspace(0.02, 0.3, 300)
    for axes in (left, right):
        for law, label, dashes in ((wong_parker, "Wong & Parker, rough", ":"), (van_rijn, "van Rijn, fine sand", "--")):
            axes.plot(shields, law(shields), color="k", lw=0.7, ls=dashes, label=label)
        centre, width = LAMINAR_THRESHOLD
        axes.axvspan(centre - width, centre + width, color="0.9", lw=0, label="threshold, laminar")
        axes.set(yscale="log", ylim=(1e-6, 2), xlim=(0, 0.3), xlabel="Shields number", ylabel="$q^*$")
    middle = table.where("smoothing_length", 3e-4)
    for friction, colour in zip(middle.values("rolling_friction"), (style.BLUE, style.VERMILLION)):
        points = middle.where("rolling_friction", friction)
        draw_points(left, points, colour, f"$\\mu_r$ = {friction:g}{threshold_of(points)}")
    rolls = table.where("rolling_friction", 0.1)
    for length, colour in zip(sorted(rolls.values("smoothing_length")), (style.GREEN, style.BLUE, style.ORANGE)):
        draw_points(right, rolls.where("smoothing_length", length), colour, f"smoothed over {length / 2e-4:g} $d$")
    for index, axes in enumerate((left, right)):
        axes.legend(loc="lower right", fontsize=6)
        style.panel_label(axes, index)
    return figure


def threshold_of(table):
    (_, threshold), (_, error) = fit_with_errors(table["shields"], table["q_star"])
    return f", threshold {threshold:.3f} $\\pm$ {error:.3f}" if np.isfinite(threshold + error) else ""


def draw_points(axes, table, colour, label):
    shields, q_star, interval = means(table)
    axes.errorbar(shields, np.maximum(q_star, 1e-6), yerr=np.nan_to_num(interval), ls="", marker="o", ms=3.5, capsize=2,
                  color=colour, label=label)
