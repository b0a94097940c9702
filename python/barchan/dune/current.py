"""The direction of the current in time, and how long a dune takes to turn round after it.

Definitions: docs/dune-measures.md, "Formation and reversal". SI units.
"""

from collections.abc import Iterator, Mapping
from typing import Any

import numpy as np

from barchan.dune import detect
from barchan.dune.laws import formation_time
from barchan.dune.shape import Bed, Sand, main_rows
from barchan.dune.tracks import tracks
from barchan.io.frames import Grains
from barchan.io.horn_lengths import medians
from barchan.io.run_folder import RunFolder

ALONG_X = (1.0, 0.0)


def currents(config: Mapping[str, Any]) -> list[tuple[float, np.ndarray]]:
    """[(t [s], unit vector (2) along x and z), ...]: from when on the current of a case goes where, first from 0 on.

    Water that is asked to stand still, or driven by a pressure gradient, has the direction of before, at first +x.
    """
    fluid = config.get("fluid", {})
    targets = [(0.0, fluid.get("mean_velocity", 0.0))]
    targets += sorted((one["time"], one["velocity"]) for one in fluid.get("schedule", ()))
    found = [(0.0, np.array(ALONG_X))]
    for time, velocity in targets:
        along = np.array(velocity if isinstance(velocity, list) else [velocity, 0.0], float)
        if np.any(along != 0):
            unit = along / np.hypot(*along)
            if time <= 0:
                found = [(0.0, unit)]
            elif not np.allclose(unit, found[-1][1]):
                found.append((float(time), unit))
    return found


def direction(config: Mapping[str, Any], t: float) -> np.ndarray:
    """Unit vector (2) of the current at t [s]."""
    return [unit for time, unit in currents(config) if time <= t or time == 0][-1]


def always_along_x(config: Mapping[str, Any]) -> bool:
    """Whether the current goes along +x all the time."""
    turns = currents(config)
    return len(turns) == 1 and bool(np.allclose(turns[0][1], ALONG_X))


def turned(grains: Grains, centroid: np.ndarray, bed: Bed, along: np.ndarray) -> Grains:
    """The grains about a centroid (3) [m], seen with the unit vector `along` as x; periodic images undone."""
    x, y, z = bed.nearest(grains.x - centroid).T
    place = np.stack([along[0] * x + along[1] * z, y + centroid[1], along[0] * z - along[1] * x], axis=1)
    return Grains(grains.time, grains.id, place, grains.d, grains.dune)


def reversal_times(run: RunFolder) -> list[tuple[float, float]]:
    """[(time of the turn, time until both horns of the main dune point down the new current for good), ...] [s].

    Horns count as in `formation_time`; not a number where they do not until the current turns again or the run ends.
    """
    turns = currents(run.config)
    ends = [time for time, _ in turns[1:]] + [np.inf]
    return [(start, _until_horns(run, start, end, along))
            for (start, along), end in zip(turns[1:], ends[1:])]


def sentences(run: RunFolder) -> Iterator[str]:
    """The formation time of the main dune, and its reversal time after each turn of the current."""
    def said(time: float) -> str:
        return "not known" if np.isnan(time) else f"{time:.3g} s"

    if run.dune_columns and "volume" in run.main_dune_columns:
        yield f"formation time {said(formation_time(run.main_dune_columns))}"
    for start, time in reversal_times(run):
        yield f"the current turns at {start:.3g} s: reversal time {said(time)}"


def seen_along(run: RunFolder, start: float, end: float, along: np.ndarray) -> dict[str, np.ndarray]:
    """The measures of dune.csv of the main dune, with the unit vector `along` as x, in the frames from start to before
    end [s]. {} without any."""
    source, rows = tracks(run), []
    for index in np.nonzero((source.times >= start) & (source.times < end))[0]:
        grains = source.read(int(index))
        chosen = main_rows(grains)
        if len(chosen):
            sand = Sand.of(grains, chosen, source.bed)
            flat = Bed(source.bed.lengths, (False, False))
            seen = detect.measure(turned(grains, sand.centroid, source.bed, along), chosen, flat)
            rows.append({"t": grains.time, **seen})
    return {name: np.array([row[name] for row in rows]) for name in (rows[0] if rows else ())}


def _until_horns(run: RunFolder, start: float, end: float, along: np.ndarray) -> float:
    dune = seen_along(run, start, end, along)
    if not dune:
        return np.nan
    dune |= {name: np.array(values) for name, values in medians(dune).items()}
    return formation_time(dune, start)
