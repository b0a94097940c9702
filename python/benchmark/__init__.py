"""The benchmark of benchmark/: runs our cases, measures and scores them, and scores the results of other programs.

    ./barchan benchmark                       the cases and their scores
    ./barchan benchmark NAME ...              run what is missing, measure, score, draw
    ./barchan benchmark NAME --no-runs        measure the runs that are there
    ./barchan benchmark NAME --score FILE     score the results of another program
    ./barchan benchmark [NAME ...] --keep     keep the results in benchmark/NAME/results, and make the page again
"""

import argparse
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np

from barchan.errors import BarchanError, MissingData
from benchmark import cases, folders, page, scores
from validation import SAVED, tables

RUNS = Path("runs")
OUT = RUNS / "benchmark"


def parse(arguments):
    parser = argparse.ArgumentParser(prog="./barchan benchmark",
                                     description="Runs, measures and scores the cases of benchmark/.")
    parser.add_argument("names", metavar="NAME", nargs="*", help=", ".join(folders.names()))
    parser.add_argument("--no-runs", action="store_true", help="measure the finished runs that are there")
    parser.add_argument("--runs", type=Path, default=RUNS, metavar="DIR",
                        help="measure the finished runs of this folder (default: run into and measure runs)")
    parser.add_argument("--score", type=Path, metavar="FILE", help="score this table of results; runs nothing")
    parser.add_argument("--keep", action="store_true", help="keep the results in benchmark/NAME/results; make the page")
    options = parser.parse_args(arguments)
    if options.score and len(options.names) != 1:
        parser.error("--score needs one case, e.g. column --score results.csv")
    if options.score and options.keep:
        parser.error("--keep keeps our own results; put those of another program into benchmark/NAME/results")
    return options


def table_of(case, program, found):
    """Lines that say how far each quantity of a program is from the reference."""
    yield f"{program}: {case.title}"
    yield f"  {'quantity':<20} {'distance':>8} {'bias':>7} {'points':>8}"
    for name, one in found.items():
        far = f"{one.distance:8.2f} {one.bias:+7.2f}" if one.reached else f"{'-':>8} {'-':>7}"
        yield f"  {name:<20} {far} {one.reached:3d} of {one.points:<3d} {one.word}"
    if np.isfinite(scores.total(found)):
        yield (f"  {'score':<20} {scores.total(found):8.2f}   in errors of the reference; from "
               f"{scores.share(found)}")
    else:
        yield "  no score: no point of the reference is reached"


def run_studies(name):
    """The sweeps of a case; True if all are done. Ctrl-C stops them, and us."""
    for study in cases.MEASURES[name].STUDIES:
        handler = signal.signal(signal.SIGINT, signal.SIG_IGN)  # the sweep stops its runs with grace
        try:
            status = subprocess.run([folders.ROOT / "barchan", "sweep", folders.ROOT / f"configs/{study}.toml"],
                                    check=False, preexec_fn=lambda: signal.signal(signal.SIGINT, signal.SIG_DFL))
        finally:
            signal.signal(signal.SIGINT, handler)
        if status.returncode != 0:
            return False
    return True


def handle(name, options):
    """Measures and scores one case; its lines are printed."""
    case = folders.find(name)
    if options.score:
        results = {options.score.stem: folders.read_results(options.score, case)}
    else:
        saved = cases.from_validation(name)
        if saved:
            print(f"{name}: from the tables that ./barchan plot validation --keep makes of {', '.join(saved)}")
        elif not options.no_runs and options.runs == RUNS and not run_studies(name):
            raise BarchanError(f"{name}: not all runs are done; the same command goes on")
        results = {}
        for program, (curves, notes) in cases.measure(name, options.runs, SAVED).items():
            file = case.result_file(program) if options.keep else OUT / name / f"{program}.csv"
            file.parent.mkdir(parents=True, exist_ok=True)
            tables.write(file, notes, cases.lines(curves))
            results[program] = curves
            print(f"{name}: results in {file}")
        if not options.keep:
            page.draw(case, results, OUT / name / f"{name}.svg")
            print(f"{name}: picture in {OUT / name / name}.svg")
    for program, curves in results.items():
        print("\n".join(table_of(case, program, scores.scores(case.reference, curves))))


def main(arguments):
    options = parse(arguments)
    try:
        if not options.names and not options.keep:
            for case in map(folders.find, folders.names()):
                for program in case.programs or ["-"]:
                    total = "     -" if program == "-" else f"{page.total_of(case, program):6.2f}"
                    print(f"{case.name:<10} {program:<16} {total}   {case.title}")
            print("score: mean distance in errors of the reference; ./barchan benchmark NAME runs a case")
            return 0
        for name in options.names:
            handle(name, options)
        if options.keep:
            print(f"page: {page.write()}")
    except MissingData as problem:
        print(f"benchmark: {problem}", file=sys.stderr)
        return 1
    except BarchanError as problem:
        print(f"benchmark: error: {problem}", file=sys.stderr)
        return 2
    return 0
