"""Slopes, fluxes, ways of moving, avalanches and exchange of a run's main dune against time; no drawing.

Definitions: docs/dune-measures.md, "Slopes and transport". SI units, angles in degrees.
"""

from collections.abc import Iterator

import numpy as np

from barchan.dune import fluxes as grain_fluxes
from barchan.dune.shape import HALF_WIDTH, Bed, Dune
from barchan.dune.slopes import Slopes, asymmetry, slopes
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder
from barchan.stats import in_seconds, spans_seconds, spread, window

DEVIATIONS = 3.0  # an interval with so much more than independent grains would give is an avalanche


def measure(run: RunFolder) -> tuple[dict[str, np.ndarray], list[Slopes]]:
    """(table, profiles): columns over the frames whose main dune has sand on its centreline, and its Slopes there."""
    source = tracks(run)
    rows: list[dict[str, float]] = []
    profiles: list[Slopes] = []
    last, own = None, None
    for index in range(len(source.times)):
        grains = source.read(index)
        dune = source.main_dune(grains)
        shape = slopes(dune, grains.d.mean()) if dune else None
        if dune is not None and shape is not None:
            ids = grains.id[dune.rows]
            own = ids if own is None else own
            rows.append(of_frame(grains, dune, shape) | fluxes(last, grains, source.bed)
                        | {"kept": len(np.intersect1d(own, ids, assume_unique=True)) / len(own)})
            profiles.append(shape)
            last = grains, dune, shape
        else:
            last = None
    if len(rows) < 2:
        raise MissingData("needs two frames with a dune that has sand on its centreline")
    table = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    return table | migration(run, table), profiles


def of_frame(grains: Grains, dune: Dune, shape: Slopes) -> dict[str, float]:
    return {"t": grains.time, "stoss_angle": shape.stoss, "slip_face_angle": shape.slip_face,
            "crest_height": shape.crest_height, "crest_x": dune.crest_x, "brink_x": shape.brink_x, "L": dune.L,
            "packing": grain_fluxes.packing(grains, dune), "solid_height": grain_fluxes.solid_height(grains, dune),
            "asymmetry": asymmetry(dune.surface, dune.centroid[2])}


def fluxes(last: tuple[Grains, Dune, Slopes] | None, grains: Grains, bed: Bed) -> dict[str, float]:
    """What went over the crest and over the middle of the slip face since the frame before, where these were then."""
    names = ("crest_flux", "slip_face_flux", "slip_face_grains")
    if last is None:
        return dict.fromkeys(names, np.nan)
    before, dune, shape = last
    half_width = HALF_WIDTH * before.d.mean()
    per = 2 * half_width * (grains.time - before.time)
    lines = dune.crest_x, 0.5 * (shape.brink_x + dune.lee_foot)
    (crest, _), (slip, n) = (grain_fluxes.crossings(before, grains, bed, x, dune.centroid[2], half_width)
                             for x in lines)
    return dict(zip(names, (crest / per, slip / per, n)))


def migration(run: RunFolder, table: dict[str, np.ndarray]) -> dict[str, np.ndarray]:
    """The flux that moves a dune of this height without changing it, phi c H [m2/s], and L/c [s]; not numbers without
    dune.csv."""
    unknown = {"t": np.zeros(1), "celerity": np.full(1, np.nan)}
    main = run.main_dune_columns if run.dune_columns else unknown
    celerity = np.interp(table["t"], main["t"], main["celerity"])
    with np.errstate(divide="ignore"):
        return {"celerity": celerity, "migration_flux": table["packing"] * celerity * table["crest_height"],
                "turnover_time": table["L"] / celerity}


def over_window(table: dict[str, np.ndarray], names: tuple[str, ...], start: float | None,
                end: float | None) -> dict[str, float]:
    """Means of the numbers in these columns over the window; without those that have none there."""
    chosen = window(table["t"], start, end)
    return {name: float(np.nanmean(table[name][chosen])) for name in names if np.isfinite(table[name][chosen]).any()}


def measure_shares(run: RunFolder) -> dict[str, np.ndarray] | None:
    """{t, saltation, rolling, creep} of the frames of grains.h5; None where they lack velocities or labels."""
    source, rows = tracks(run), []
    for index in range(len(run.grain_file.frames) if run.grain_file else 0):
        grains = run.frame(index)
        dune = source.main_dune(grains) if grains.u is not None and grains.dune is not None else None
        if dune is not None:
            rows.append((grains.time, *grain_fluxes.shares(grains, dune)))
    return dict(zip(("t", *grain_fluxes.KINDS), np.array(rows).T)) if rows else None


def avalanches(counts: np.ndarray) -> tuple[np.ndarray, int]:
    """Intervals with more crossings than the median of all by three of its roots: which they are, and how many runs of
    such intervals there are."""
    usual = np.nanmedian(counts) if np.isfinite(counts).any() else 0.0
    many = counts > usual + DEVIATIONS * np.sqrt(max(usual, 1.0))
    return many, int(np.count_nonzero(many[1:] & ~many[:-1]) + many[0])


def dispersion(counts: np.ndarray) -> float:
    """Variance over mean of the crossings of an interval: 1 for grains that move independently of one another."""
    known = counts[np.isfinite(counts)]
    return float(np.var(known, ddof=1) / np.mean(known)) if len(known) > 1 and np.mean(known) > 0 else np.nan


def summary(table: dict[str, np.ndarray], shares: dict[str, np.ndarray] | None, chosen: np.ndarray) -> Iterator[str]:
    """Sentences: means over the chosen times with the 95 % interval of means over a second, or of single frames."""
    t = table["t"][chosen]

    def mean(name: str, factor: float = 1.0, source: dict[str, np.ndarray] = table, rows: np.ndarray = chosen,
             times: np.ndarray = t) -> str:
        values = spread(in_seconds(times, factor * source[name][rows]))
        if np.isnan(values.mean):
            return "not known"
        return f"{values.mean:.3g}" + ("" if np.isnan(values.interval) else f" +- {values.interval:.2g}")

    yield (f"mean of t = {t[0]:.3g} to {t[-1]:.3g} s with its 95 % interval, from "
           f"{'means over a second' if spans_seconds(t) else 'single frames'}:")
    yield (f"stoss side {mean('stoss_angle')} degrees, slip face {mean('slip_face_angle')} degrees, "
           f"asymmetry {mean('asymmetry')}")
    yield (f"flux over the crest {mean('crest_flux')} m2/s, phi c H {mean('migration_flux')} m2/s (phi "
           f"{mean('packing')}, c {mean('celerity', 1e3)} mm/s, H {mean('crest_height', 1e3)} mm on the centreline)")
    if shares:
        rows = (shares["t"] >= t[0]) & (shares["t"] <= t[-1])
        if rows.any():
            parts = (f"{kind} {mean(kind, 100, source=shares, rows=rows, times=shares['t'][rows])} %"
                     for kind in grain_fluxes.KINDS)
            yield "of the dune's flux " + ", ".join(parts)
    counts = table["slip_face_grains"][chosen]
    yield (f"slip face: flux at its middle {mean('slip_face_flux')} m2/s, variance over mean of the crossings of a "
           f"frame {dispersion(counts):.3g}, {avalanches(counts)[1]} avalanches")
    yield (f"turnover time L/c {mean('turnover_time')} s; {100 * table['kept'][-1]:.3g} % of the grains of the first "
           "frame are in the dune at the end")
