"""What the main dune of a run is and does, as one number each: means over a window of time. SI units, degrees.

Definitions: docs/dune-measures.md, and for laws docs/studies.md.
"""

from typing import Any

import numpy as np

from barchan.dune import fluxes, laws, sectors, transport
from barchan.errors import MissingData
from barchan.stats import window

OF_FRAMES = ("stoss_angle", "slip_face_angle", "asymmetry", "packing", "crest_flux", "migration_flux", "turnover_time")


def of_run(run: Any, start: float | None = None, end: float | None = None) -> dict[str, float]:
    """{quantity: value in SI}; empty for a run without a dune in the window."""
    if run.dune_columns is None:
        return {}
    values = laws.of_run(run, start, end)
    for more in (of_frames, of_origins, of_forces) if values else ():
        try:
            values |= more(run, start, end)
        except MissingData:
            continue
    return values


def of_frames(run: Any, start: float | None, end: float | None) -> dict[str, float]:
    table, _ = transport.measure(run)
    shares = transport.measure_shares(run)
    chosen = window(table["t"], start, end)
    values = transport.over_window(table, OF_FRAMES, start, end)
    values["dispersion"] = transport.dispersion(table["slip_face_grains"][chosen])
    t, first, last = (shares or {}).get("t", np.empty(0)), table["t"][chosen][0], table["t"][chosen][-1]
    for kind, column in (shares or {}).items():
        inside = (first <= t) & (t <= last)
        if kind in fluxes.KINDS and np.isfinite(column[inside]).any():
            values[kind] = float(np.nanmean(column[inside]))
    return values


def of_origins(run: Any, _: float | None, end: float | None) -> dict[str, float]:
    return sectors.judge_origins(run, end)[1]


def of_forces(run: Any, start: float | None, end: float | None) -> dict[str, float]:
    return sectors.judge_forces(run, start, end)[1]
