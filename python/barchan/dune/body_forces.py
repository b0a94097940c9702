"""Forces on bodies, from bodies.csv: means and spreads after the transient, and drag coefficients; no drawing."""

from dataclasses import dataclass

import numpy as np

from barchan.dune.bodies import NO_FILE, Body, bodies_of
from barchan.errors import MissingData
from barchan.io.run_folder import RunFolder
from barchan.stats import window

OF_WATER, OF_GRAINS = "water", "grains"


@dataclass
class MeanForce:
    """Mean and standard deviation of one component [N] over the lines of a window of time; `of`: water or grains."""

    body: Body
    of: str
    axis: str
    mean: float
    deviation: float


def need_bodies(run: RunFolder, files: str) -> tuple[Body, ...]:
    """The bodies of a run; MissingData, with the files that a figure also needs, where it has none."""
    if not run.config.get("body"):
        raise MissingData(f"needs a [[body]] in the case, and {files}")
    if run.body_lattices is None:
        raise MissingData(f"needs {NO_FILE}")
    return bodies_of(run)


def column(of: str, axis: str) -> str:
    """Its name in bodies.csv."""
    return f"{'grain_' if of == OF_GRAINS else ''}force_{axis}"


def mean_forces(run: RunFolder, start: float | None = None, end: float | None = None) -> list[MeanForce]:
    """Along x and y; of the second half of the run unless other times [s] are given."""
    bodies, tables = need_bodies(run, "bodies.csv"), run.body_columns
    if tables is None:
        raise MissingData("needs bodies.csv with at least one line")
    found = []
    for body in bodies:
        table = tables.get(body.number)
        if table is None:
            continue
        chosen = window(table["t"], start, end)
        for of in (OF_WATER, OF_GRAINS):
            for axis in "xy":
                values = table[column(of, axis)][chosen]
                values = values[np.isfinite(values)]
                mean, deviation = (np.mean(values), np.std(values)) if len(values) else (np.nan, np.nan)
                found.append(MeanForce(body, of, axis, float(mean), float(deviation)))
    return found


def drag_coefficient(run: RunFolder, force: MeanForce) -> float:
    """F over rho U^2 A/2 with the bulk velocity U that is held and the area A of the body seen along x; else NaN."""
    fluid = run.config.get("fluid", {})
    speed, density = run.mean_velocity, fluid.get("density", 1000.0)
    if not speed or force.axis != "x" or force.of != OF_WATER or force.body.shape == "wave":
        return np.nan
    return float(force.mean / (0.5 * density * speed**2 * force.body.frontal_area()))


def sentences(run: RunFolder, found: list[MeanForce]) -> list[str]:
    """One for each body."""
    told = []
    for body in dict.fromkeys(force.body for force in found):
        own = {(force.of, force.axis): force for force in found if force.body == body}
        parts = [f"{of}: {own[of, 'x'].mean:.3g} N along x (spread {own[of, 'x'].deviation:.2g}), "
                 f"{own[of, 'y'].mean:.3g} N upwards (spread {own[of, 'y'].deviation:.2g})"
                 for of in (OF_WATER, OF_GRAINS)]
        coefficient = drag_coefficient(run, own[OF_WATER, "x"])
        if np.isfinite(coefficient):
            parts.append(f"drag coefficient {coefficient:.3g} with U = {run.mean_velocity:g} m/s and "
                         f"{1e6 * body.frontal_area():.3g} mm2")
        told.append(f"{body.name}: " + "; ".join(parts))
    return told
