"""field_cases: outcomes of the cases from the literature, from the runs of configs/field/all.toml. `--keep` takes the
folder of the study, runs/field/all, and draws its runs from above, field_views.png.

A row is a number of a run: of the whole run, or at a time t, every half second. Quantities:
- `class` of an encounter or obstacle (docs/dune-measures.md), with columns of encounters.csv, where `to_upstream` and
  `to_downstream` are parts of the lighter dune's grains, or of obstacles.csv, with `moved`, the way of the median grain
  [m], also of controls without the obstacle; `upstream lost`, `downstream lost`: parts of the dunes' first grains, less
  what they got;
- `grains`, `W`, `L`, `horn`, `crest`, `lost`: of the main dune, at its end means of the last second, along the last
  current (in turn-fast along the mean of both); the longer horn; how far the crest is downstream of the centroid, over
  L, so that it is positive for a slip face that faces down the current; `lost`: the part of its first grains;
- `crest 1` ...: the same at the end of each direction; `loss`: of the dune's first grains a second, from a second after
  each turn to the next; `lasts`: until when there is a main dune;
- `turned_after`: from the turn until the crest is on the other side for good; `static`: the part of the dune's grains
  that moves by less than a diameter in this time; `change from 2 s`: of its grains, to the end, over those at 2 s;
- `first at REGION`, `first in horns`: share of the first kind there less its share of the dune, second half of the run;
- `segregation`: the first kind's share at the surface of the downstream third less that of the upstream third;
- `distance` of two ridges, the shorter way round, while both have half of their first grains; `first`: from 1 to 2 s,
  `last`: of the last second; `grains of up/downstream`: of the named dunes;
- the columns of laws.csv.
"""

import csv

import numpy as np

from barchan.dune import composition, current, encounters, laws, obstacles, shape
from barchan.dune.tracks import bed_of, tracks
from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.study_folder import StudyFolder, gap_of
from barchan.stats import spread
from validation import field_views, tables

NAME = "field_cases"
COLUMNS = "case,realisation,t,quantity,value"
EVERY = 0.5  # [s] between the times of curves
CLASS = "class"
PLACES = {  # [m]: where controls lack an obstacle
    "barchan": {"centre": [0.024, 0.010], "radius": 0.0015},          # cylinder of barchan-meets-cylinder
    "barchan-on-shot": {"centre": [0.021, 0.007], "radius": 0.003},   # crater of barchan-meets-crater
}
SLOW = 0.0, 3.0, 6.0  # [s]: turns of turn-slow, whose spans turn-never is measured over


def main_dune(run, along=None):
    """Numbers of the main dune at the end."""
    dune = run.main_dune_columns
    end = dune["t"][-1]
    seen = current.seen_along(run, end - 1.0, np.inf, current.direction(run.config, end) if along is None else along)
    yield None, "horn", np.maximum(seen["horn_left"], seen["horn_right"]).mean()
    yield None, "crest", crest_ahead(seen).mean()
    for name in ("W", "L"):
        yield None, name, seen[name].mean()
    yield None, "lost", 1 - dune["n_grains"][dune["t"] >= end - 1.0].mean() / dune["n_grains"][0]


def crest_ahead(dune):
    return (dune["crest_x"] - dune["Cx"]) / dune["L"]


def curve(name, t, values):
    for time in np.arange(0, t[-1] + 1e-9, EVERY):
        yield time, name, values[np.argmin(abs(t - time))]


def turning(run, name):
    """A dune in a current that turns: fast turns leave it no direction but their mean."""
    yield from main_dune(run, np.array(current.ALONG_X) if name == "turn-fast" else None)
    dune, turns = run.main_dune_columns, current.currents(run.config)
    if name == "turn-never":
        turns = [(start, turns[0][1]) for start in SLOW]
    t, n = dune["t"], dune["n_grains"] / dune["n_grains"][0]
    yield None, "lasts", t[-1]
    yield from curve("grains", t, dune["n_grains"])
    ends = [min(start, t[-1]) for start, _ in turns[1:]] + [t[-1]]
    spans = [(turn, end) for turn, end in zip(turns, ends) if turn[0] < end]
    for number, ((_, along), end) in enumerate(spans if name == "turn-slow" else (), 1):
        yield None, f"crest {number}", crest_ahead(current.seen_along(run, end - 1.0, end, along)).mean()
    calm = [(start + 1.0, end) for (start, _), end in spans if end > start + 1.5]
    if calm:
        lost = sum(np.interp(start, t, n) - np.interp(end, t, n) for start, end in calm)
        yield None, "loss", lost / sum(end - start for start, end in calm)


def reversal(run, _):
    (turn, _), *_ = current.reversal_times(run)
    dune = run.main_dune_columns
    ahead = np.flatnonzero(crest_ahead(dune) > 0)[-1]
    turned = dune["t"][ahead] if ahead + 1 < len(dune["t"]) else np.nan
    yield None, "turned_after", turned - turn
    source = tracks(run)
    first, last = (source.read(source.index(time)) for time in (turn, turned if np.isfinite(turned) else None))
    of_dune = first.id[shape.main_rows(first)]
    _, before, after = np.intersect1d(first.id, last.id, return_indices=True)
    moved = np.linalg.norm(source.bed.nearest(last.x[after] - first.x[before]), axis=1)
    still = np.isin(first.id[before], of_dune) & (moved < first.d.mean())
    yield None, "static", np.count_nonzero(still) / len(of_dune)
    yield from main_dune(run)


def mixture(run, _):
    found = composition.composition(run)
    late = found.t >= 0.5 * found.t[-1]
    for region in composition.REGIONS[1:]:
        excess = found.share(region)[:, 0] - found.share("dune")[:, 0]
        yield None, f"first {'in' if region == 'horns' else 'at'} {region}", np.nanmean(excess[late])
    t = run.need_grains().times
    apart = np.array([segregation(run, index) for index in range(len(t))])
    yield None, "segregation at 2 s", np.nanmean(apart[abs(t - 2) < 0.5])
    yield None, "segregation at the end", np.nanmean(apart[t > t[-1] - 1])
    yield from main_dune(run)


def segregation(run, index):
    """Share of the first kind at the surface of the downstream third of the dune less that of the upstream third."""
    grains = run.frame(index)
    dune = shape.main_dune(grains, bed_of(run), run.dune_columns[shape.MAIN])
    if dune is None:
        return np.nan
    rows = composition.regions(grains, dune)["surface"]
    x = dune.x[np.searchsorted(dune.rows, rows)]
    low, high = np.quantile(x, (1 / 3, 2 / 3))
    first = grains.kind[rows] == 0
    return first[x > high].mean() - first[x < low].mean()


def ridges(run, _):
    length = run.config["domain"]["size"][0]
    first, second = (run.dune_columns.get(label) for label in (0, 1))
    t, rows, others = np.intersect1d(first["t"], second["t"], return_indices=True)
    parts = [dune["n_grains"][at] / dune["n_grains"][0] for dune, at in ((first, rows), (second, others))]
    whole = np.min(parts, axis=0)
    t = t[:np.argmax(np.append(whole < 0.5, True))]
    apart = (second["Cx"][others] - first["Cx"][rows])[:len(t)] % length
    shorter = np.minimum(apart, length - apart)
    yield None, "first distance", shorter[(t > 1) & (t < 2)].mean()
    yield None, "last distance", shorter[t > t[-1] - 1].mean()
    yield None, "lasts", t[-1]
    yield from curve("distance", t, shorter)


def meeting(run, name):
    """Two dunes: how it went, and of two that stay apart their grains in time."""
    try:
        lineage, found = encounters.find(run)
    except MissingData:
        found = []
    yield None, CLASS, found[0].kind if found else "none"
    for column in ("upstream_over_downstream", "offset", "t_contact", "t_end", "distance_start", "distance_end"):
        yield None, column, getattr(found[0], column) if found else np.nan
    if not found:
        return
    one = found[0]
    for side, dune in (("upstream", one.upstream), ("downstream", one.downstream)):
        n = lineage.n_grains[:, dune]
        there = np.flatnonzero(np.isfinite(n))
        yield None, f"{side} lost", 1 - n[there[-1]] / n[0]
        yield None, f"to_{side}", getattr(one, f"to_{side}") / min(lineage.n_grains[0, [one.upstream, one.downstream]])
        if name == "two-heaps":
            yield from curve(f"grains of {side}", lineage.t[there], n[there])


def obstacle(run, _):
    (one, *_) = obstacles.find(run)
    yield None, CLASS, one.outcome
    yield from met(one)


def met(one):
    """How it went on both sides of the obstacle, or of its place."""
    yield None, "moved", one.path.s[-1] - one.path.s[0]
    for name in ("t_contact", "upstream", "around", "downstream", "over", "together", "celerity_before",
                 "celerity_after"):
        yield None, name, getattr(one, name)


def control(run, name):
    """A dune without an obstacle, against the place of one."""
    (one, *_) = obstacles.find(run, [obstacles.crater(0, PLACES[name])])
    yield from met(one)


def size(run, _):
    for name, value in laws.of_run(run).items():
        yield None, name, value


def fed(run, _):
    """What it gains from 2 s on."""
    dune = run.main_dune_columns
    late = dune["n_grains"][dune["t"] >= 2]
    yield None, "change from 2 s", late[-1] / late[0] - 1
    yield from main_dune(run)


KINDS = {"encounters-": meeting, "two-heaps": meeting, "turn-": turning, "reversal": reversal, "two-densities": mixture,
         "two-ridges": ridges, "barchan-meets-": obstacle, "barchan": control,
         "sizes-": size, "fed-": fed, "unfed-": fed}


def rows_of(study):
    for case in study.cases:
        measure = next((measure for start, measure in KINDS.items() if case.name.startswith(start)), None)
        for run in case.runs:
            if measure is None or gap_of(run.path):
                continue
            number = run.config["initial"]["realisation"]
            for t, quantity, value in measure(run, case.name):
                shown = value if isinstance(value, str) else f"{value:.6g}"
                yield f"{case.name},{number},{'' if t is None else f'{t:g}'},{quantity},{shown}"


def save(folder, out):
    study = StudyFolder(folder)
    rows = list(rows_of(study))
    if not rows:
        raise MissingData(f"needs finished runs of configs/field/all.toml in {folder}")
    run = next(run for case in study.cases for run in case.runs if not gap_of(run.path))
    style.save(field_views.draw(study), out, "field_views", "Barchan, cases from the literature", ("png",))
    return tables.keep(out / f"{NAME}.csv", "Cases from the literature: their outcomes",
                       "./barchan sweep configs/field/all.toml", run.summary, [COLUMNS, *rows])


def read(source):
    """{case: {quantity: [value of each realisation]}} and the same for curves, [(t, value)]."""
    path = source / f"{NAME}.csv"
    if not path.exists():
        raise MissingData(f"needs {path}")
    whole, curves = {}, {}
    lines = [line for line in path.read_text().splitlines() if not line.startswith("#")]
    for row in csv.DictReader(lines):
        value = row["value"] if row["quantity"] == CLASS else float(row["value"])
        if row["t"]:
            series = curves.setdefault(row["case"], {}).setdefault(row["quantity"], {})
            series.setdefault(row["realisation"], []).append((float(row["t"]), value))
        else:
            whole.setdefault(row["case"], {}).setdefault(row["quantity"], []).append(value)
    return whole, curves


def summary(source):
    """A line for each quantity of each case: its mean and standard deviation, or its classes."""
    for case, quantities in read(source)[0].items():
        for name, values in quantities.items():
            if name == CLASS:
                yield f"{case}: " + ", ".join(f"{values.count(kind)} x {kind}" for kind in dict.fromkeys(values))
                continue
            known = [value for value in values if np.isfinite(value)]
            if known:
                found = spread(known)
                spreads = f" +- {found.deviation:.2g}" * (len(known) > 1)
                lacks = f", not known in {len(values) - len(known)}" * (len(known) < len(values))
                yield f"{case}: {name} {found.mean:.4g}{spreads} ({len(known)} runs{lacks})"


MARKS = {encounters.MERGING: ("o", style.BLUE), encounters.EXCHANGE: ("s", style.VERMILLION),
         encounters.CHASING: (">", style.GREEN), encounters.FRAGMENTATION_CHASING: ("^", style.ORANGE),
         encounters.FRAGMENTATION_EXCHANGE: ("v", style.PURPLE), encounters.DISPERSED: ("*", style.SKY),
         encounters.UNDECIDED: ("x", style.GREY)}


def draw_map(ax, whole):
    """Classes over the ratio of grains and the offset; realisations side by side."""
    seen = {}
    for case, found in whole.items():
        if not case.startswith("encounters-") or "offset" not in found:
            continue
        for number, (kind, ratio, offset) in enumerate(zip(found[CLASS], found["upstream_over_downstream"],
                                                           found["offset"])):
            if kind not in MARKS:
                continue
            mark, colour = MARKS[kind]
            seen[kind], = ax.plot(ratio * (1 + 0.04 * number), 1e3 * abs(offset), mark, color=colour, ls="none")
    ax.legend(seen.values(), seen.keys(), loc="center right")
    ax.set(xlabel="grains of the upstream dune / downstream", ylabel="offset [mm]", title="encounters")


def draw_curves(ax, curves, cases, quantity, factor=1.0, relative=False):
    for (case, label), colour in zip(cases.items(), (style.BLUE, style.VERMILLION, style.GREEN)):
        for number, series in enumerate(curves.get(case, {}).get(quantity, {}).values()):
            t, values = np.transpose(series)
            ax.plot(t, factor * values / (values[0] if relative else 1), color=colour, label=label * (number == 0))
    ax.set(xlabel="$t$ [s]")


def draw(source):
    whole, curves = read(source)
    figure, ((encounter, turns), (apart, pair)) = style.panels(None, 2, 2, figsize=(style.FULL_WIDTH, 5.0))
    draw_map(encounter, whole)
    draw_curves(turns, curves, {"turn-never": "never", "turn-slow": "slowly", "turn-fast": "fast"}, "grains",
                100, relative=True)
    turns.set(ylabel="grains of the dune [%]", title="a current that turns")
    turns.legend()
    draw_curves(apart, curves, {"two-ridges": ""}, "distance", 1e3)
    apart.set(ylabel="distance [mm]", title="two ridges")
    for side, colour in (("upstream", style.BLUE), ("downstream", style.VERMILLION)):
        for number, series in enumerate(curves.get("two-heaps", {}).get(f"grains of {side}", {}).values()):
            pair.plot(*np.transpose(series), color=colour, label=side * (number == 0))
    pair.set(xlabel="$t$ [s]", ylabel="grains", title="two barchans in line")
    pair.legend()
    return figure
