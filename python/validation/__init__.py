"""Figures of the pages docs/validation*.md and docs/threshold.md, from saved results.

    ./barchan plot validation [FIGURE ...] [--from DIR] [--out DIR] [--keep NAME=DIR]

Writes <figure>.svg and .pdf, and channel_summary.csv. The results are tables that the tests write
when BARCHAN_RESULTS names a folder, and statistics of channel runs and of the studies of bed load
taken over with --keep. Each says in its first lines which command, commit and machine made it, and when.
Without names every figure is drawn whose results are saved. Exit status as of plot.py.
"""

import argparse

from pathlib import Path

import matplotlib

from barchan.figures import style
from validation import tables
from validation import bed_load
from validation import cfdem
from validation import channel
from validation import clumps
from validation import contacts
from validation import corners
from validation import dem_cases
from validation import dune_window
from validation import field_cases
from validation import flow
from validation import laminar_bed
from validation import resolved_bed
from validation import resolved_load
from validation import resolved_spheres
from validation import threshold
from validation import water
from barchan.plot import fail
from barchan.errors import BarchanError, MissingData

SAVED = tables.ROOT / "docs/validation"
FIGURES = {
    "channel": channel.draw,
    "channel_resolved": channel.draw_resolved,
    "taylor_green": flow.draw_taylor_green,
    "contacts": contacts.draw,
    "grains_and_water": water.draw,
    "convergence": flow.draw_convergence,
    "beside_cfdem": cfdem.draw,
    bed_load.NAME: bed_load.draw,
    threshold.NAME: threshold.draw,
    laminar_bed.NAME: laminar_bed.draw,
    resolved_bed.NAME: resolved_bed.draw,
    resolved_load.NAME: resolved_load.draw,
    resolved_spheres.NAME: resolved_spheres.draw,
    dune_window.NAME: dune_window.draw,
    dem_cases.NAME: dem_cases.draw,
    clumps.NAME: clumps.draw,
    field_cases.NAME: field_cases.draw,
    corners.NAME: corners.draw,
}
STUDIES = {module.NAME: module
           for module in (bed_load, threshold, laminar_bed, resolved_bed, resolved_load, resolved_spheres, dune_window,
                          dem_cases, clumps, field_cases, corners)}


def parse(arguments):
    parser = argparse.ArgumentParser(prog="plot validation",
                                     description="Figures of the validation pages from saved results.")
    parser.add_argument("figures", metavar="FIGURE", nargs="*", help=", ".join(FIGURES))
    parser.add_argument("--from", dest="source", type=Path, default=SAVED, metavar="DIR",
                        help="folder of the saved results (docs/validation)")
    parser.add_argument("--out", type=Path, default=SAVED, metavar="DIR",
                        help="folder for the pictures (docs/validation)")
    parser.add_argument("--keep", action="append", default=[], metavar="NAME=DIR",
                        help=f"first save the statistics of a channel run ({', '.join(channel.SAVED)}) or of a "
                             f"study ({', '.join(STUDIES)})")
    parser.add_argument("--debug", action="store_true", help="show where an unexpected error arose")
    return parser.parse_args(arguments)


def draw(name, options):
    figure = FIGURES[name](options.source)
    paths = style.save(figure, options.out, name, "Barchan, validation", ("pdf", "svg"))
    if name == "channel":
        paths.append(channel.write_summary(options.source, options.out))
    if hasattr(STUDIES.get(name), "summary"):
        print("\n".join(STUDIES[name].summary(options.source)))
    for path in paths:
        print(path)


def main(arguments):
    matplotlib.use("Agg")
    with style.look():
        return draw_all(parse(arguments))


def draw_all(options):
    for name in options.figures:
        if name not in FIGURES:
            return fail(f'no figure "{name}"; figures: {", ".join(FIGURES)}')
    unreadable, failed = 0, 0
    try:
        options.out.mkdir(parents=True, exist_ok=True)
        for name, _, kept in (text.partition("=") for text in options.keep):
            print(STUDIES[name].save(kept, options.source) if name in STUDIES
                  else channel.save(name, kept, options.source))
    except (OSError, BarchanError) as error:
        return fail(error)
    for name in options.figures or FIGURES:
        try:
            draw(name, options)
        except BarchanError as reason:
            if isinstance(reason, MissingData) and not options.figures:
                print(f"{name} left out: {reason}")
                continue
            unreadable += 1
            fail(f"{name} {reason}")
        except Exception as error:  # as in plot.py: the others are still drawn
            if options.debug:
                raise
            failed += 1
            fail(f"cannot draw {name}: {error or type(error).__name__}")
    return 1 if failed else 2 if unreadable else 0

