"""threshold: where grains begin to move and where they stop, from the runs of configs/validation/threshold.toml.

The velocity rises or falls slowly. In windows of a quarter of a second the load that moves is set against the Shields
number; the first half second counts as the start. The threshold is where the load goes to zero. It grows in proportion
to the excess of the Shields number (Paehtz & Duran, Phys. Rev. Fluids 3, 104302, 2018). The flux does not: its grains
are faster at higher stress. So beside the zero of the load stands that of q*^(2/3), the power of Wong & Parker. The
Shields numbers at which q* passes fixed levels are found as well. Names as in bed_load.

history.csv does not count grains that move. Its flux is sum(m u) and its kinetic energy sum(m u^2)/2, both over the
area, so (sum m u)^2 / sum(m u^2) is the mass of grains that move at one velocity with the same flux and energy. It is
proportional to the share of the grains that move, as long as their velocities are distributed alike, and goes to zero
with it.

The stress is that at the surface of the bed (bed_surface.py). Of runs without bedload.csv it is the stress on all
grains, less that of the pressure that speeds up the flow.
"""

import json
from dataclasses import dataclass

import numpy as np

from barchan.figures import style
from validation import bed_load, bed_surface, tables

NAME = "threshold"
WINDOW, START = 0.25, 0.5  # [s]
LEVELS = {"creep": 1e-3, "transport": 1e-2}  # q*
FITTED = 1e-4, 1e-1  # q* of the windows that a level is read from: above the noise, below the law's bend
FEWEST = 3  # windows with q* between creep and the upper end of FITTED, to say where motion ends
COLUMNS = "rolling_friction,forces,falling,realisation,t,shields,q_star,load"
CASE = COLUMNS.split(",")[:3]
KEYS = 5  # the first columns: which window of which run a row is of
LABELS = {"load": "load = 0", "flux": "$q^{*2/3}$ = 0",
          **{name: f"$q^*$ = {level:g}" for name, level in LEVELS.items()}}

# Measured at u* d / nu of 3 to 5: Shields number and its error, where one is given.
MEASURED = {"Soulsby 1997, van Rijn 1984": (0.05, 0), "Rice 2017": (0.094, 0.043),
            "heap, arXiv 2504.10111": (0.1, 0), "laminar, Ouriemi 2007": bed_load.LAMINAR_THRESHOLD}


def measure(run):
    """A row for each window after the start.

    The flow speeds up or slows down as a whole. The pressure that does this acts on every grain of the bed by its
    volume. It is no stress on the surface, and is taken off.
    """
    config, history, scales = run.config, run.history_columns, bed_load.Scales.of(run)
    area = config["domain"]["size"][0] * config["domain"]["size"][2]
    volume = np.sum(np.pi / 6 * run.frame(0).d.astype(float)**3)
    acceleration = np.polyfit(history["t"], history["bulk_velocity"], 1)[0]
    bed = bed_surface.of(run)
    stress = (bed_surface.stress_in_time(bed, run, acceleration) if bed.known
              else history["stress_on_grains"] - bed_load.WATER * acceleration * volume / area)
    case = (config["grains"]["rolling_friction"], float(len(config["coupling"]["forces"])),
            float(acceleration < 0), config["initial"]["realisation"])
    window = np.ceil(history["t"] / WINDOW - 1e-9)  # the one that ends next
    rows = []
    for number in range(round(START / WINDOW) + 1, int(window[-1]) + 1):
        inside = window == number
        flux = np.mean(history["grain_flux"][inside])
        energy = np.mean(history["grain_kinetic_energy"][inside]) / area
        load = config["grains"]["density"] * flux * abs(flux) / (2 * energy) if energy > 0 else 0.0
        rows.append((*case, number * WINDOW, np.mean(stress[inside]) / scales.stress, flux / scales.flux,
                     load / scales.size))
    return rows


def zero(shields, values):
    """Slope k and zero s_t of values = k max(0, shields - s_t) by least squares; windows at rest count as well."""
    tried = np.arange(0, np.max(shields), 1e-4)
    excess = np.maximum(0, shields[:, None] - tried)
    slope = values @ excess / np.sum(excess**2, axis=0)
    best = np.argmin(np.sum((values[:, None] - slope * excess)**2, axis=0))
    return slope[best], tried[best]


def low_rows(table, quantity):
    """Shields numbers and the quantity below the upper end of FITTED, where the load bends upwards."""
    low = table.only(table["q_star"] <= FITTED[1])
    return low["shields"], quantity(low)


def zero_of(quantity):
    """The function that gives the zero of a quantity of the rows of one case, NaN where too little moves."""
    def found(table):
        moving = (table["q_star"] >= LEVELS["creep"]) & (table["q_star"] <= FITTED[1])
        return zero(*low_rows(table, quantity))[1] if np.sum(moving) >= FEWEST else np.nan
    return found


def passing(level):
    """The function that gives the Shields number at which a line through log q* passes the level."""
    def found(table):
        shields, q_star = table["shields"], table["q_star"]
        fitted = (q_star >= FITTED[0]) & (q_star <= FITTED[1])
        if np.unique(shields[fitted]).size < 2:
            return np.nan
        slope, offset = np.polyfit(shields[fitted], np.log(q_star[fitted]), 1)
        return (np.log(level) - offset) / slope
    return found


def load_of(table):
    return table["load"]


def flux_of(table):
    """What is linear in the excess of the Shields number if q* goes with its 3/2."""
    return np.maximum(0, table["q_star"])**(2 / 3)


FOUND = {"load": zero_of(load_of), "flux": zero_of(flux_of),
         **{name: passing(level) for name, level in LEVELS.items()}}


def with_error(table, found):
    """Of the rows of one case, with the standard error by leaving out each realisation; one run has no error."""
    numbers = table.values("realisation")
    count = len(numbers)
    rest = [found(table.only(table["realisation"] != number)) for number in numbers] if count > 1 else [np.nan]
    return found(table), np.sqrt((count - 1) / count * np.sum((rest - np.mean(rest))**2)) if count > 1 else np.nan


@dataclass
class Case:
    rolling_friction: float
    forces: float  # their number
    falling: bool
    rows: tables.Table

    @property
    def name(self):
        way = "falling" if self.falling else "rising"
        return f"{way}, $\\mu_r$ = {self.rolling_friction:g}, {bed_load.FORCES[self.forces]}"


def cases_of(table):
    """By rolling friction, the forces of the paper first, rising first."""
    different = sorted(set(zip(*(table[name].tolist() for name in CASE))))
    return [Case(friction, forces, bool(falling),
                 table.where(CASE[0], friction).where(CASE[1], forces).where(CASE[2], falling))
            for friction, forces, falling in different]


def versions(runs):
    """All that computed the runs: a rise of one version beside a fall of another is no comparison."""
    return " and ".join(dict.fromkeys(json.loads((run.path / "run.json").read_text())["git_hash"] for run in runs))


def save(study_path, folder):
    """Keeps the windows of each finished run as threshold.csv, beside those kept before; returns the path."""
    study, cases = bed_load.finished(study_path)
    runs = [run for _, run in cases]
    path = folder / f"{NAME}.csv"
    said = {**bed_load.notes(study, "configs/validation/threshold.toml", runs[0]), "commit": versions(runs)}
    said, rows = bed_load.with_earlier(path, said, [bed_load.as_row(row) for run in runs for row in measure(run)], KEYS)
    tables.write(path, said, [COLUMNS, *sorted(rows, key=lambda row: bed_load.key_of(row, KEYS))])
    return path


def draw(folder):
    cases = cases_of(tables.read_saved(folder, NAME))
    figure, ((left, right),) = style.panels(None, 1, 2, figsize=(style.FULL_WIDTH, 3.6), layout="constrained")
    frictions = list(dict.fromkeys(case.rolling_friction for case in cases))
    colours = dict(zip(frictions, (style.BLUE, style.GREEN, style.VERMILLION, style.ORANGE)))
    for case in cases:
        draw_load(left, case, colours[case.rolling_friction])
    left.set(xlim=(0, 0.35), ylim=(-0.002, 0.12), xlabel="Shields number", ylabel="moving load over $\\rho_p d$")
    left.legend(loc="upper left", fontsize=6)
    names = [case.name for case in cases] + list(MEASURED)
    lowest, highest = (side([value + sign * error for value, error in MEASURED.values()])
                       for side, sign in ((min, -1), (max, 1)))
    right.axvspan(lowest, highest, color="0.92", lw=0)
    for kind, marker in zip(FOUND, ("o", "s", "|", "x")):
        found = [(row, *with_error(case.rows, FOUND[kind])) for row, case in enumerate(cases)]
        found = np.array([one for one in found if np.isfinite(one[1])]).reshape(-1, 3)
        right.errorbar(found[:, 1], found[:, 0], xerr=np.nan_to_num(found[:, 2]), ls="", marker=marker, ms=4,
                       capsize=2, color=style.BLUE if marker == "o" else style.GREY, label=LABELS[kind])
    for row, (value, error) in enumerate(MEASURED.values(), len(cases)):
        right.errorbar(value, row, xerr=error, marker="D", ms=3.5, capsize=2, color=style.BLACK)
    right.set(yticks=range(len(names)), yticklabels=names, xlabel="Shields number", xlim=(0, 0.3))
    right.tick_params(axis="y", labelsize=6)
    right.set_ylim(len(names) - 0.4, -0.6)
    right.legend(loc="lower right", fontsize=6)
    for index, axes in enumerate((left, right)):
        style.panel_label(axes, index)
    return figure


def draw_load(axes, case, colour):
    """The windows, and the line whose zero is the threshold; with more than the forces of the paper in a lighter shade."""
    rows, shade = case.rows, 0.4 if case.forces > min(bed_load.FORCES) else 1
    axes.plot(rows["shields"], rows["load"], ls="", marker="v" if case.falling else "^", ms=3, color=colour,
              alpha=shade, mfc="none" if case.falling else colour, label=case.name)
    if np.isfinite(FOUND["load"](rows)):
        slope, start = zero(*low_rows(rows, load_of))
        axes.plot([start, start + 0.1], [0, 0.1 * slope], color=colour, alpha=shade, lw=0.7,
                  ls="--" if case.falling else "-")


def summary(folder):
    """Lines `case | runs | load | flux | creep | transport`: Shields numbers, +- standard error of several runs."""
    for case in cases_of(tables.read_saved(folder, NAME)):
        found = [with_error(case.rows, function) for function in FOUND.values()]
        yield " | ".join([case.name.replace("$\\mu_r$", "mu_r"), str(len(case.rows.values("realisation"))),
                          *(f"{value:.3f}" + (f" +- {error:.3f}" if np.isfinite(error) else "")
                            for value, error in found)])
