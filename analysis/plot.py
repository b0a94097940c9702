#!/usr/bin/env python3
"""Figures of a run.

    plot.py RUN_DIR [FIGURE ...] [--pdf] [--time T] [--from T] [--to T]
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
    "horns": ("horns", "lengths of the horns, their grains and where these came from, against time"),
    "horn_origins": ("horn_origins", "fig11, fig12: grains of the horns, their paths and origins (--time)"),
    "force_map": ("force_map", "fig13: mean resultant force on the grains about the dune (--from, --to)"),
    "sectors": ("sectors", "in words: shares of horn grains by sector, signs of the force; no picture"),
}
ALIASES = {"fig11": "horn_origins", "fig12": "horn_origins", "fig13": "force_map"}
OF_PAPER = set(ALIASES.values())  # these are written as PDF, too
NOT_BY_ITSELF = {"sectors"}       # only when asked for


def figure_name(name):
    """As in FIGURES: hyphens are as good as underscores, the numbers of the paper as good as names."""
    plain = name.replace("-", "_")
    return ALIASES.get(plain.replace("_", ""), plain)


def unknown_figure(name):
    near = difflib.get_close_matches(name, FIGURES, n=1, cutoff=0.4)
    hint = f' (did you mean "{near[0]}"?)' if near else ""
    return f'no figure "{name}"{hint}; figures: {", ".join(FIGURES)}'


def parse(arguments):
    listing = "\n".join(f"  {name:<12} {about}" for name, (_, about) in FIGURES.items())
    parser = argparse.ArgumentParser(
        prog="plot", description="Figures of a run, by default all that its files allow.",
        epilog=f"figures:\n{listing}", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_dir", metavar="RUN_DIR")
    parser.add_argument("figures", metavar="FIGURE", nargs="*")
    parser.add_argument("--pdf", action="store_true", help="write PDF files besides the PNG files")
    parser.add_argument("--time", type=float, metavar="T",
                        help="horn_origins, sectors: at T seconds, not at the end")
    parser.add_argument("--from", type=float, metavar="T", dest="start",
                        help="force_map, sectors: mean over the frames of grains.h5 from T seconds on")
    parser.add_argument("--to", type=float, metavar="T", dest="end", help="... up to T seconds")
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
            module = importlib.import_module(FIGURES[name][0])
            wanted = {key: getattr(options, key) for key in getattr(module, "OPTIONS", ())}
            figure = module.draw(run, **wanted)
            if figure is None:  # it has said what it has to say
                outcome.paths.append(name)
                continue
            for path in style.save(figure, run.path, name, run.title, options.pdf or name in OF_PAPER):
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
    names = list(dict.fromkeys(map(figure_name, options.figures)))
    for name, given in zip(map(figure_name, options.figures), options.figures):
        if name not in FIGURES:
            return fail(unknown_figure(given))
    from run_folder import PlotError, RunFolder  # after the cheap checks: h5py takes a while

    try:
        run = RunFolder(options.run_dir)
    except PlotError as error:
        return fail(error)
    outcome = draw(run, names or [name for name in FIGURES if name not in NOT_BY_ITSELF], options)
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
