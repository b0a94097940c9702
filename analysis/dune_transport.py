"""Slopes, fluxes, ways of moving, avalanches and exchange of a run's main dune against time; no drawing.

Definitions: docs/conventions.md, "Slopes and transport". SI units, angles in degrees.
"""

import numpy as np

import grain_fluxes
from dune_shape import HALF_WIDTH
from horn_lengths import SECOND
from run_folder import NotInRun
from slip_face import asymmetry, slopes
from spread import spread
from tracks import tracks

DEVIATIONS = 3.0  # an interval with so much more than independent grains would give is an avalanche


def measure(run):
    """(table, profiles): columns over the frames whose main dune has sand on its centreline, and its Slopes there."""
    source, rows, profiles, last, own = tracks(run), [], [], None, None
    for index in range(len(source.times)):
        grains = source.read(index)
        dune = source.main_dune(grains)
        shape = slopes(dune, grains.d.mean()) if dune else None
        if shape is not None:
            ids = grains.id[dune.rows]
            own = ids if own is None else own
            rows.append(of_frame(grains, dune, shape) | fluxes(last, grains, source.bed)
                        | {"kept": len(np.intersect1d(own, ids, assume_unique=True)) / len(own)})
            profiles.append(shape)
        last = None if shape is None else (grains, dune, shape)
    if len(rows) < 2:
        raise NotInRun("needs two frames with a dune that has sand on its centreline")
    table = {name: np.array([row[name] for row in rows]) for name in rows[0]}
    return table | migration(run, table), profiles


def of_frame(grains, dune, shape):
    return {"t": grains.time, "stoss_angle": shape.stoss, "slip_face_angle": shape.slip_face,
            "crest_height": shape.crest_height, "crest_x": dune.crest_x, "brink_x": shape.brink_x, "L": dune.L,
            "packing": grain_fluxes.packing(grains, dune), "asymmetry": asymmetry(dune.surface, dune.centroid[2])}


def fluxes(last, grains, bed):
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


def migration(run, table):
    """The flux that moves a dune of this height without changing it, phi c H [m2/s], and L/c [s]; not numbers without
    dune.csv."""
    main = run.dunes[min(run.dunes)] if run.dunes else {"t": [0.0], "celerity": [np.nan]}
    celerity = np.interp(table["t"], main["t"], main["celerity"])
    with np.errstate(divide="ignore"):
        return {"celerity": celerity, "migration_flux": table["packing"] * celerity * table["crest_height"],
                "turnover_time": table["L"] / celerity}


def measure_shares(run):
    """{t, saltation, rolling, creep} of the frames of grains.h5; None where they lack velocities or labels."""
    source, rows = tracks(run), []
    for index in range(len(run.grain_file.frames) if run.grain_file else 0):
        grains = run.grains(index)
        dune = source.main_dune(grains) if grains.u is not None and grains.dune is not None else None
        if dune is not None:
            rows.append((grains.time, *grain_fluxes.shares(grains, dune)))
    return dict(zip(("t", *grain_fluxes.KINDS), np.array(rows).T)) if rows else None


def in_window(t, start, end):
    """Which times are meant: the second half unless others are asked for."""
    if start is None and end is None:
        start = 0.5 * (t[0] + t[-1])
    return (t >= (-np.inf if start is None else start)) & (t <= (np.inf if end is None else end))


def window(t, start, end):
    """The same, of at least two frames."""
    chosen = in_window(t, start, end)
    if np.count_nonzero(chosen) < 2:
        raise NotInRun(f"needs two frames between {t[0] if start is None else start:g} s "
                       f"and {t[-1] if end is None else end:g} s; it has t = {t[0]:g} to {t[-1]:g} s")
    return chosen


def over_the_last_second(t, values):
    """At each t the mean of the numbers among the values after t - 1 s."""
    result = np.full(len(t), np.nan)
    for row, end in enumerate(t):
        known = values[(t > end - SECOND * (1 - 1e-9)) & (t <= end)]
        if np.isfinite(known).any():
            result[row] = np.nanmean(known)
    return result


def spans_seconds(t):
    return t[-1] - t[0] >= 2 * SECOND * (1 - 1e-9)


def in_seconds(t, values):
    """Means over whole seconds, taken as independent; the values themselves where they span less than two."""
    second = np.floor((t - t[0]) / SECOND * (1 + 1e-9)) if spans_seconds(t) else np.arange(len(t))
    means = [np.mean(values[(second == s) & np.isfinite(values)]) for s in np.unique(second)
             if np.isfinite(values[second == s]).any()]
    return means or [np.nan]


def avalanches(counts):
    """Intervals with more crossings than the median of all by three of its roots: which they are, and how many runs of
    such intervals there are."""
    usual = np.nanmedian(counts) if np.isfinite(counts).any() else 0.0
    many = counts > usual + DEVIATIONS * np.sqrt(max(usual, 1.0))
    return many, int(np.count_nonzero(many[1:] & ~many[:-1]) + many[0])


def dispersion(counts):
    """Variance over mean of the crossings of an interval: 1 for grains that move independently of one another."""
    known = counts[np.isfinite(counts)]
    return float(np.var(known, ddof=1) / np.mean(known)) if len(known) > 1 and np.mean(known) > 0 else np.nan


def summary(table, shares, chosen):
    """Sentences: means over the chosen times with the 95 % interval of means over a second, or of single frames."""
    t = table["t"][chosen]

    def mean(name, factor=1.0, source=table, rows=chosen, times=t):
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
