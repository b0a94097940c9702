#!/usr/bin/env python3
"""Figures of a run.

    plot.py RUN_DIR [FIGURE ...] [--pdf]
    plot.py validation [FIGURE ...]       figures of docs/validation.md: see validation.py

Without names: all figures for which the run has data. Writes RUN_DIR/<figure>.png and the numbers
behind curves to RUN_DIR/figures_data/<figure>.csv.
Exit status: 0 done, 1 a figure failed, 2 bad input (no such folder or figure, no data for it).
"""

import argparse
import difflib
import importlib
import sys

from messages import fail

# figure: (module, what it shows)
FIGURES = {
    "topviews": ("topview", "the grains from above, one row per time"),
    "height_map": ("height_map", "surface height at the start and at the end, centreline profile"),
    "morphology": ("morphology", "width, length, height, centroid, horns against time"),
    "midplane": ("midplane", "flow and grains in the vertical plane through the dune"),
    "profiles": ("profiles", "turbulence statistics over the height, beside channel DNS"),
    "history": ("history", "flow rate, shear, time step and solver against time"),
}


def unknown_figure(name):
    near = difflib.get_close_matches(name, FIGURES, n=1, cutoff=0.4)
    hint = f' (did you mean "{near[0]}"?)' if near else ""
    return f'no figure "{name}"{hint}; figures: {", ".join(FIGURES)}'


def parse(arguments):
    listing = "\n".join(f"  {name:<11} {about}" for name, (_, about) in FIGURES.items())
    parser = argparse.ArgumentParser(
        prog="plot", description="Figures of a run, by default all that its files allow.",
        epilog=f"figures:\n{listing}", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_dir", metavar="RUN_DIR")
    parser.add_argument("figures", metavar="FIGURE", nargs="*")
    parser.add_argument("--pdf", action="store_true", help="write PDF files besides the PNG files")
    parser.add_argument("--debug", action="store_true", help="show where an unexpected error arose")
    return parser.parse_args(arguments)


class Outcome:
    """Paths written, and sentences: what the run lacks, what cannot be read, what went wrong."""

    def __init__(self):
        self.paths, self.missing, self.unreadable, self.failed = [], [], [], []


def draw(run, names, options):
    import style
    from run_folder import NotInRun, PlotError

    style.use()
    outcome = Outcome()
    for name in names:
        try:
            figure = importlib.import_module(FIGURES[name][0]).draw(run)
            for path in style.save(figure, run.path, name, run.title, options.pdf):
                print(path)
                outcome.paths.append(path)
        except NotInRun as reason:
            outcome.missing.append(f"{name} {reason}")
        except PlotError as reason:
            if str(reason) not in outcome.unreadable:
                outcome.unreadable.append(str(reason))
        except Exception as error:  # a picture must not stop the others, nor show a traceback
            if options.debug:
                raise
            outcome.failed.append(f"cannot draw {name}: {error or type(error).__name__}")
    return outcome


def main(arguments):
    if arguments[:1] == ["validation"]:  # a run folder of that name is ./validation
        import validation

        return validation.main(arguments[1:])
    options = parse(arguments)
    for name in options.figures:
        if name not in FIGURES:
            return fail(unknown_figure(name))
    from run_folder import PlotError, RunFolder  # after the cheap checks: h5py takes a while

    try:
        run = RunFolder(options.run_dir)
    except PlotError as error:
        return fail(error)
    outcome = draw(run, options.figures or FIGURES, options)
    wrong = outcome.failed + outcome.unreadable + (outcome.missing if options.figures else [])
    for sentence in wrong:
        fail(sentence)
    if outcome.failed:
        return 1
    if not outcome.paths and not wrong:
        return fail(f"nothing to draw in {options.run_dir}: no grains.h5, fields.h5, history.csv "
                    "or dune.csv with data")
    return 2 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(3)
