"""Figures of a run, or of a study: a folder with study.json and a run folder per case.

    barchan plot RUN_DIR [FIGURE ...] [--pdf] [--svg] [--time T] [--from T] [--to T]
    barchan plot STUDY_DIR [FIGURE ...] [--pdf] [--svg] [--from T] [--to T] [--only CASE]

Without names: all figures for which the run has data. Writes RUN_DIR/<figure>.png and the numbers
behind curves to RUN_DIR/figures_data/<figure>.csv. A figure may be named by its number in the paper
(Lima et al. 2022), fig2 to fig13, then there is a PDF file as well.
Exit status: 0 done, 1 a figure failed, 2 bad input (no such folder or figure, no data for it).
"""

import argparse
import difflib
import os
import sys
from collections.abc import Iterable, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

from barchan.errors import BarchanError, MissingData
from barchan.figures import registry
from barchan.figures.registry import ALIASES, OF_RUN, OF_STUDY, Job


def fail(sentence: object) -> int:
    """One line on standard error; returns the exit status of bad input."""
    print(f"plot: {sentence}", file=sys.stderr)
    return 2


def parse(arguments: Sequence[str]) -> argparse.Namespace:
    def listed(entries: Iterable[registry.Entry]) -> str:
        return "\n".join(f"  {entry.name:<18} {entry.about}" for entry in entries)

    listing = (listed(OF_RUN.values()) + "\nof a study, over its cases:\n" + listed(OF_STUDY.values())
               + "\nnumbers in the paper:\n" + "\n".join(f"  {a:<18} {b}" for a, b in ALIASES.items()))
    parser = argparse.ArgumentParser(
        prog="plot", description="Figures of a run, by default all that its files allow.",
        epilog=f"figures:\n{listing}", formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("run_dir", metavar="RUN_DIR")
    parser.add_argument("figures", metavar="FIGURE", nargs="*")
    parser.add_argument("--pdf", action="store_true", help="write PDF files besides the PNG files")
    parser.add_argument("--svg", action="store_true",
                        help="write SVG files besides the PNG files; they suit light and dark pages")
    parser.add_argument("--time", type=float, metavar="T",
                        help="horn_origins, sectors: at T seconds, not at the end")
    parser.add_argument("--from", type=float, metavar="T", dest="start",
                        help="force_map, sectors, morphodynamics, flow_around_body, forces_on_bodies, laws, means, "
                             "force_depth, probes: means from T seconds on")
    parser.add_argument("--to", type=float, metavar="T", dest="end", help="... up to T seconds")
    parser.add_argument("--only", action="append", metavar="CASE", default=[],
                        help="of a study: these cases of it; a pattern with * is taken; may be repeated")
    parser.add_argument("--debug", action="store_true", help="show where an unexpected error arose")
    options = parser.parse_args(arguments)
    options.figures = [name.replace("-", "_") for name in options.figures]
    return options


@dataclass
class Outcome:
    """Paths written, and sentences: what the run lacks, what cannot be read, what went wrong."""

    paths: list[str] = field(default_factory=list)
    missing: list[str] = field(default_factory=list)
    unreadable: list[str] = field(default_factory=list)
    failed: list[str] = field(default_factory=list)


def draw_one(folder: Any, job: Job, options: argparse.Namespace) -> list[Path]:
    """Paths of what was drawn; none for what says its say in words."""
    if job.entry.writes:
        return job.entry.write_files(folder)
    from barchan.figures import result, style

    wanted = {name: getattr(options, name) for name in job.entry.options()}
    drawn = job.entry.draw(folder, **job.arguments(), **wanted)
    for sentence in getattr(drawn, "sentences", ()) if options.figures else ():
        print(sentence)
    result.write_numbers(drawn, folder.path)
    if isinstance(drawn, result.Told):
        return []
    asked = {"png": True, "pdf": options.pdf or job.file.startswith("fig"), "svg": options.svg}
    return style.save(drawn, folder.path, job.file, folder.title, [kind for kind, yes in asked.items() if yes])


def draw(folder: Any, jobs: list[Job], options: argparse.Namespace) -> Outcome:
    import matplotlib

    matplotlib.use("Agg")
    from barchan.figures import style

    outcome = Outcome()
    with style.look():
        for job in jobs:
            try:
                paths = draw_one(folder, job, options)
                for path in paths:
                    print(path)
                outcome.paths += list(map(str, paths)) or [job.file]
            except MissingData as reason:
                outcome.missing.append(f"{job.file} {reason}")
            except BarchanError as reason:
                if str(reason) not in outcome.unreadable:
                    outcome.unreadable.append(str(reason))
            except Exception as error:  # a picture must not stop the others, nor show a traceback
                if options.debug:
                    raise
                outcome.failed.append(f"cannot draw {job.file}: {error or type(error).__name__}")
    return outcome


def misnamed(names: list[str], study: bool) -> str | None:
    """Why one of the names is no figure of this folder, None when all are."""
    for name in names:
        if name in OF_RUN or name in ALIASES:
            if study and not registry.in_study(name):
                return f"{name} is a figure of a run, not of a study: name the folder of a case"
        elif not study:
            return f"{name} is a figure of a study, not of a run: name the folder of a study"
    return None


def unknown_figure(name: str) -> str:
    near = difflib.get_close_matches(name, [*OF_RUN, *OF_STUDY, *ALIASES], n=1, cutoff=0.4)
    hint = f' (did you mean "{near[0]}"?)' if near else ""
    return f'no figure "{name}"{hint}; figures: {", ".join(OF_RUN)}; of the paper: {", ".join(ALIASES)}'


def main(arguments: Sequence[str]) -> int:
    options = parse(arguments)
    for name in options.figures:
        if name not in OF_RUN and name not in ALIASES and name not in OF_STUDY:
            return fail(unknown_figure(name))
    from barchan.io.run_folder import RunFolder  # after the cheap checks: h5py takes a while
    from barchan.io.study_folder import StudyFolder

    is_study = os.path.isfile(os.path.join(options.run_dir, "study.json"))
    try:
        wrong = misnamed(options.figures, is_study)
        if wrong and (is_study or os.path.isdir(options.run_dir)):
            return fail(wrong)
        if options.only and not is_study:
            return fail("--only chooses cases of a study; this is no folder of a study")
        folder = StudyFolder(options.run_dir, options.only) if is_study else RunFolder(options.run_dir)
    except BarchanError as error:
        return fail(error)
    if isinstance(folder, StudyFolder):
        if folder.gaps:
            fail(f"in this study {folder.gaps}")
        jobs = registry.jobs_of_study(folder, options.figures)
        needed = "case with grains.h5, dune.csv or statistics.csv"
    else:
        jobs, needed = registry.jobs_of_run(options.figures), "grains.h5, fields.h5, history.csv or dune.csv"
    return report(draw(folder, jobs, options), options, needed)


def report(outcome: Outcome, options: argparse.Namespace, needed: str) -> int:
    """Says what went wrong; the exit status."""
    wrong = outcome.failed + outcome.unreadable + (outcome.missing if options.figures else [])
    for sentence in wrong:
        fail(sentence)
    if outcome.failed:
        return 1
    if not outcome.paths and not wrong:
        return fail(f"nothing to draw in {options.run_dir}: no {needed} with data")
    return 2 if wrong else 0


def command() -> int:
    """barchan-plot of an installed package."""
    return main(sys.argv[1:])
