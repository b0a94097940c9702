#!/usr/bin/env python3
"""Figures of a run, or of a study: a folder with study.json and a run folder per case.

    plot.py RUN_DIR [FIGURE ...] [--pdf] [--time T] [--from T] [--to T]
    plot.py STUDY_DIR [FIGURE ...] [--pdf] [--from T] [--to T]
    plot.py validation [FIGURE ...]       figures of docs/validation.md: see validation

Without names: all figures for which the run has data. Writes RUN_DIR/<figure>.png and the numbers
behind curves to RUN_DIR/figures_data/<figure>.csv. A figure may be named by its number in the paper
(Lima et al. 2022), fig2 to fig13, then there is a PDF file as well.
Exit status: 0 done, 1 a figure failed, 2 bad input (no such folder or figure, no data for it).
"""

import argparse
import difflib
import importlib
import os
import sys

import study_figures
from messages import fail, note

# figure: (module, what it shows)
FIGURES = {
    "topviews": ("topview", "the grains from above, one row per time"),
    "height_map": ("height_map", "surface height at the start and at the end, centreline profile"),
    "morphology": ("morphology", "width, length, height, centroid, horns against time"),
    "midplane": ("midplane", "flow and grains in the vertical plane through the dune"),
    "profiles": ("profiles", "turbulence statistics over the height, beside channel DNS"),
    "history": ("history", "flow rate, shear, time step and solver against time"),
    "report": ("report", "one page about the run, with the grains as an animation: report.html"),
    "profiles_over_dune": ("profiles_over_dune", "mean flow and stresses at stations along a frozen dune"),
    "movie": ("movie", "the grains from above through the whole run"),
    "morphodynamics": ("morphodynamics", "slopes, flux over the crest, saltation and creep, avalanches (--from, --to)"),
    "horns": ("horns", "lengths of the horns, their grains and where these came from, against time"),
    "horn_origins": ("horn_origins", "grains of the horns, their paths and origins (--time)"),
    "force_map": ("force_map", "mean resultant force on the grains about the dune (--from, --to)"),
    "sectors": ("sectors", "in words: shares of horn grains by sector, signs of the force; no picture"),
}
ON_REQUEST = ("movie", "sectors")  # takes long; draws nothing
ALIASES = {
    "channel": "profiles",
    "fig2": "profiles",
    "fig3": "profiles_over_dune",
    **dict.fromkeys(("fig4", "fig5", "fig6"), "topviews"),
    **dict.fromkeys(("fig7", "fig8", "fig9"), "morphology"),
    "fig10": "movie",
    **dict.fromkeys(("fig11", "fig12"), "horn_origins"),
    "fig13": "force_map",
}


def unknown_figure(name):
    near = difflib.get_close_matches(name, [*FIGURES, *study_figures.FIGURES, *ALIASES], n=1, cutoff=0.4)
    hint = f' (did you mean "{near[0]}"?)' if near else ""
    return f'no figure "{name}"{hint}; figures: {", ".join(FIGURES)}; of the paper: {", ".join(ALIASES)}'


def parse(arguments):
    listing = "\n".join(f"  {name:<18} {about}" for name, (_, about) in FIGURES.items())
    listing += "\nof a study, over its cases:\n" + "\n".join(
        f"  {name:<18} {about}" for name, (_, about) in study_figures.FIGURES.items())
    listing += "\nnumbers in the paper:\n" + "\n".join(f"  {a:<18} {b}" for a, b in ALIASES.items())
    parser = argparse.ArgumentParser(
        prog="plot", description="Figures of a run, by default all that its files allow.",
        epilog=f"figures:\n{listing}", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_dir", metavar="RUN_DIR")
    parser.add_argument("figures", metavar="FIGURE", nargs="*")
    parser.add_argument("--pdf", action="store_true", help="write PDF files besides the PNG files")
    parser.add_argument("--time", type=float, metavar="T",
                        help="horn_origins, sectors: at T seconds, not at the end")
    parser.add_argument("--from", type=float, metavar="T", dest="start",
                        help="force_map, sectors, morphodynamics: means from T seconds on")
    parser.add_argument("--to", type=float, metavar="T", dest="end", help="... up to T seconds")
    parser.add_argument("--debug", action="store_true", help="show where an unexpected error arose")
    options = parser.parse_args(arguments)
    options.figures = [name.replace("-", "_") for name in options.figures]
    return options


class Outcome:
    """Paths written, and sentences: what the run lacks, what cannot be read, what went wrong."""

    def __init__(self):
        self.paths, self.missing, self.unreadable, self.failed = [], [], [], []


def jobs_of_run(names):
    """(file name, module, further arguments) of each figure."""
    return [(name, FIGURES[ALIASES.get(name, name)][0], ())
            for name in names or (name for name in FIGURES if name not in ON_REQUEST)]


def draw_one(folder, name, module, arguments, options):
    """Paths of what was drawn, or the name of what said its say in words. A module names the options it takes."""
    import style

    module = importlib.import_module(module)
    if hasattr(module, "write_files"):
        return module.write_files(folder)
    wanted = {key: getattr(options, key) for key in getattr(module, "OPTIONS", ())}
    figure = module.draw(folder, *arguments, **wanted)
    if figure is None:
        return []
    return style.save(figure, folder.path, name, folder.title, options.pdf or name.startswith("fig"))


def draw(folder, jobs, options):
    import style
    from run_folder import NotInRun, PlotError

    style.use()
    outcome = Outcome()
    for name, module, arguments in jobs:
        try:
            paths = draw_one(folder, name, module, arguments, options)
            for path in paths:
                print(path)
            outcome.paths += paths or [name]
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
        if name not in FIGURES and name not in ALIASES and name not in study_figures.FIGURES:
            return fail(unknown_figure(name))
    from run_folder import PlotError, RunFolder  # after the cheap checks: h5py takes a while

    try:
        if is_study(options.run_dir):
            return main_of_study(options)
        for name in options.figures:
            if name not in FIGURES and name not in ALIASES:
                return fail(f"{name} is a figure of a study, not of a run: name the folder of a study")
        run = RunFolder(options.run_dir)
    except PlotError as error:
        return fail(error)
    outcome = draw(run, jobs_of_run(options.figures), options)
    return report(outcome, options, "grains.h5, fields.h5, history.csv or dune.csv")


def is_study(path):
    return os.path.isfile(os.path.join(path, "study.json"))


def main_of_study(options):
    from study_folder import StudyFolder

    for name in options.figures:
        if not study_figures.known(name):
            return fail(f"{name} is a figure of a run, not of a study: name the folder of a case")
    study = StudyFolder(options.run_dir)
    if study.gaps:
        note(f"in this study {study.gaps}")
    outcome = draw(study, study_figures.jobs(study, options.figures), options)
    return report(outcome, options, "case with grains.h5, dune.csv or statistics.csv")


def report(outcome, options, needed):
    """Says what went wrong; the exit status."""
    wrong = outcome.failed + outcome.unreadable + (outcome.missing if options.figures else [])
    for sentence in wrong:
        fail(sentence)
    if outcome.failed:
        return 1
    if not outcome.paths and not wrong:
        return fail(f"nothing to draw in {options.run_dir}: no {needed} with data")
    return 2 if wrong else 0


if __name__ == "__main__":
    try:
        sys.exit(main(sys.argv[1:]))
    except KeyboardInterrupt:
        sys.exit(3)
