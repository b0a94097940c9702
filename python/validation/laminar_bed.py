"""laminar_bed: flux of grains in laminar flow, from the runs of configs/validation/laminar-bed-study.toml.

Beside experiment and resolved simulations (tests/reference/laminar_bed.csv), by their definitions: the bed ends where
the solid fraction falls below 0.05. Above it the liquid is h_f high. Re = q_f/nu, with the flux of liquid q_f, and the
Shields number is that of Poiseuille flow between this height and the lid, 6 Re/Ga^2 (d/h_f)^2. q_v is the integral over
height of the mean velocity of the grains in layers of d/2. It is not a flux of volume: a lone grain counts as much as a
full layer. The flux of volume, sum of V_p u_x over the area, stands beside it. So do height, Shields number and q* by
the rule for all beds here (bed_surface.py), which the papers do not have.
"""

from dataclasses import dataclass

import numpy as np

from barchan.figures import style
from validation import bed_surface, tables
from barchan.errors import MissingData
from barchan.stats import spread
from validation import bed_load

NAME = "laminar_bed"
CLEAR = 0.05  # solid fraction below which liquid counts as clear
BLOCKS = 5  # of the second half of a run, which is measured
LEVELS = 20  # of the solid fraction, per diameter
KEYS = 6  # the first columns: which run a row is of
COLUMNS = ("reynolds,row_height,smoothing_length,sliding_friction,forces,realisation,seconds,fluid_height,shields,"
           "velocity_flux,velocity_flux_deviation,volume_flux,volume_flux_deviation,bed_surface,bed_shields,q_star")
SETTING = COLUMNS.split(",")[1:5]
CASES = "laminar_bed.csv"


@dataclass
class Scales:
    """Numbers of a case that its result is made dimensionless with."""

    size: float  # mean diameter [m]
    height: float  # of the box [m]
    area: float  # [m2]
    solid: float  # volume of all grains [m3]
    viscosity: float  # [m2/s]
    galileo: float

    @classmethod
    def of(cls, run):
        config, d = run.config, run.frame(-1).d.astype(float)
        size, (length, height, width) = np.mean(d), config["domain"]["size"]
        fluid, viscosity = config["fluid"], config["fluid"]["kinematic_viscosity"]
        excess = config["grains"]["density"] / fluid["density"] - 1
        gravity = np.linalg.norm(config["grains"]["gravity"])
        return cls(size, height, length * width, np.sum(np.pi / 6 * d**3), viscosity,
                   np.sqrt(excess * gravity * size**3) / viscosity)

    def fluid_flux(self, bulk_velocity):
        """[m2/s], of the liquid alone; the bulk velocity is the mean over its volume."""
        return bulk_velocity * (self.height - self.solid / self.area)

    def shields(self, reynolds, fluid_height):
        return 6 * reynolds / self.galileo**2 * (self.size / fluid_height)**2


def solid_fraction(grains, area, levels):
    """Between each two levels [m], with the exact volume of each slice of a sphere."""
    radius = grains.d.astype(float) / 2
    depth = np.clip(levels[:, None] - (grains.x[:, 1] - radius), 0, 2 * radius)
    below = np.sum(np.pi * depth**2 * (radius - depth / 3), axis=1)
    return np.diff(below) / (area * np.diff(levels))


def surface(fraction, levels):
    """Height [m] at which the fraction falls below CLEAR, from above, linear between the middles of the levels."""
    middles = (levels[1:] + levels[:-1]) / 2
    top = np.flatnonzero(fraction >= CLEAR)[-1]
    if top + 1 == len(fraction):
        raise MissingData("needs clear liquid above the grains")
    rest = (fraction[top] - CLEAR) / (fraction[top] - fraction[top + 1])
    return middles[top] + rest * (middles[top + 1] - middles[top])


def surface_of(frames, scales):
    """Height [m] of this surface, of the mean fraction over frames."""
    levels = np.arange(0, scales.height + scales.size / LEVELS, scales.size / LEVELS)
    return surface(np.mean([solid_fraction(grains, scales.area, levels) for grains in frames], axis=0), levels)


def velocity_flux(grains, bed, thickness):
    """Integral of the mean velocity along x [m2/s] over layers of `thickness`, counted down from the bed's surface."""
    layer = np.floor((bed - grains.x[:, 1]) / thickness).astype(int)
    inside = layer >= 0
    count = np.bincount(layer[inside])
    total = np.bincount(layer[inside], weights=grains.u[inside, 0])
    return thickness * np.sum(total[count > 0] / count[count > 0])


def mean_and_deviation(values):
    """Of a series: its mean, and the standard deviation of the means of its blocks."""
    return np.mean(values), np.std([np.mean(block) for block in np.array_split(values, BLOCKS)])


def measure(run):
    """The row of a run: its second half."""
    config, scales, history = run.config, Scales.of(run), run.history_columns
    end = history["t"][-1]
    frames = [run.frame(index) for index in np.flatnonzero(run.need_grains().times > end / 2)]
    if len(frames) < BLOCKS or frames[0].u is None:
        raise MissingData(f"needs {BLOCKS} frames of grains with velocities in the second half of {run.path}")
    bed = surface_of(frames, scales)
    late = history["t"] > end / 2
    fluid_flux = scales.fluid_flux(config["fluid"]["mean_velocity"])
    reynolds, fluid_height = fluid_flux / scales.viscosity, scales.height - bed
    by_velocity = mean_and_deviation([velocity_flux(grains, bed, scales.size / 2) for grains in frames])
    by_volume = mean_and_deviation(history["grain_flux"][late])
    by_rule = bed_surface.of(run)
    return (reynolds, config["fluid"]["first_cell_height"] / scales.size,
            config["coupling"]["smoothing_length"] / scales.size, config["grains"]["sliding_friction"],
            float(len(config["coupling"]["forces"])), config["initial"]["realisation"], end / 2,
            fluid_height / scales.size, scales.shields(reynolds, fluid_height),
            *(value / fluid_flux for value in (*by_velocity, *by_volume)),
            by_rule.surface, by_rule.shields, by_rule.q_star)


def save(study_path, folder):
    """Keeps one row for each finished run of the study as laminar_bed.csv, beside those kept before; its path."""
    study, runs = bed_load.finished(study_path)
    path = folder / f"{NAME}.csv"
    said, rows = bed_load.with_earlier(path, bed_load.notes(study, "configs/validation/laminar-bed-study.toml",
                                                            runs[0][1]),
                                       [bed_load.as_row(measure(run)) for _, run in runs], KEYS)
    tables.write(path, said, [COLUMNS, *sorted(rows, key=lambda row: bed_load.key_of(row, KEYS))])
    return path


def references():
    """A dictionary for each case of the papers."""
    columns = tables.read_table(tables.REFERENCE / CASES).columns
    return [dict(zip(columns, row)) for row in zip(*columns.values())]


def beside(table, reference):
    """The rows of a case of the papers: those of its Reynolds number, within 2 %."""
    return table.only(abs(table["reynolds"] / reference["reynolds"] - 1) < 0.02)


def settings(table):
    """Each combination of SETTING in a table, with its rows."""
    for values in dict.fromkeys(zip(*(np.round(table[name], 2).tolist() for name in SETTING))):
        rows = np.all([np.round(table[name], 2) == value for name, value in zip(SETTING, values)], axis=0)
        yield values, table.only(rows)


def most_used(table):
    """The setting that most cases of the papers were run with."""
    count = {}
    for reference in references():
        for values, _ in settings(beside(table, reference)):
            count[values] = count.get(values, 0) + 1
    if not count:
        raise MissingData("needs a run at a Reynolds number of the papers")
    return max(count, key=count.get)


def said_of(rows):
    """Mean over the realisations and its error: their standard deviation, of one run that of its blocks."""
    found = spread(rows["velocity_flux"].tolist())
    return found.mean, found.deviation if found.count > 1 else rows["velocity_flux_deviation"][0]


def by_height(table, usual):
    """Of each case of the papers with several heights of rows: its reference, and (height, flux, error) of each."""
    for one in references():
        points = sorted((values[0], *said_of(rows)) for values, rows in settings(beside(table, one))
                        if values[1:] == usual[1:])
        if len(points) > 1:
            yield one, np.array(points).T


def draw(folder):
    table = tables.read_saved(folder, NAME)
    usual = most_used(table)
    heights = list(by_height(table, usual))
    figure, (panels,) = style.panels(None, 1, 1 + bool(heights), figsize=(style.FULL_WIDTH, 2.9))
    draw_cases(panels[0], table, usual)
    for (one, (height, flux, error)), colour in zip(heights, (style.BLUE, style.GREEN, style.VERMILLION, style.PURPLE)):
        panels[1].errorbar(height, flux, yerr=error, marker="o", ms=4, capsize=2, color=colour, label=one["case"])
        panels[1].axhline(one["resolved"], color=colour, lw=0.7, ls=":")
    if heights:
        panels[1].set(xlabel="height of rows over $d$", ylim=(0, None))
        panels[1].legend(fontsize=6)
    for index, axes in enumerate(panels):
        axes.set(ylabel="$q_v/q_f$")
        if heights:
            style.panel_label(axes, index)
    return figure


def draw_cases(axes, table, usual):
    """Each case of the papers: experiment, resolved, and each set of forces."""
    known = references()
    measured = np.array([(one["measured"], one["measured"] - one["low"], one["high"] - one["measured"])
                         for one in known]).T
    places = np.arange(len(known))
    axes.errorbar(places - 0.15, measured[0], yerr=measured[1:], ls="", marker="s", ms=4, capsize=2, color="k",
                  label="Aussillous et al., experiment")
    axes.plot(places, [one["resolved"] for one in known], ls="", marker="D", ms=4, color=style.ORANGE,
              label="Biegert et al., resolved")
    for (forces, name), shift, colour in zip(bed_load.FORCES.items(), (0.12, 0.24, 0.36),
                                             (style.VERMILLION, style.BLUE, style.GREEN)):
        shown = [(place + shift, *said_of(rows)) for place, one in zip(places, known)
                 for values, rows in settings(beside(table, one)) if values == (*usual[:-1], forces)]
        if shown:
            place, flux, error = np.array(shown).T
            axes.errorbar(place, flux, yerr=error, ls="", marker="o", ms=4, capsize=2, color=colour,
                          label=f"Barchan, {name}")
    axes.set(xticks=places, ylim=(0, 1.4 * max(one["high"] for one in known)),
             xticklabels=[f"{one['case']}\nSh {one['shields_measured']}" for one in known])
    axes.legend(fontsize=6)


def summary(folder):
    """Lines `case | SETTING | runs | h_f/d | Shields | q_v/q_f | resolved | measured | flux of volume`, in d."""
    table = tables.read_saved(folder, NAME)
    for one in references():
        for values, rows in settings(beside(table, one)):
            flux, error = said_of(rows)
            yield " | ".join([one["case"], ", ".join(f"{value:g}" for value in values), str(len(rows["seconds"])),
                              f"{np.mean(rows['fluid_height']):.2f}", f"{np.mean(rows['shields']):.3f}",
                              f"{1e3 * flux:.2f}e-3 +- {1e3 * error:.2f}e-3", f"{1e3 * one['resolved']:.2f}e-3",
                              f"{1e3 * one['measured']:.2f}e-3", f"{1e3 * np.mean(rows['volume_flux']):.2f}e-3"])
