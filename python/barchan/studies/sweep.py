"""Runs a parameter study: one run folder per case, several at a time, resumed where it was left.

    python -m barchan sweep PROGRAM STUDY.toml [--out DIR] [--only RUN ...] [--at-once N] [--threads N] [--list]

The study file is described in docs/studies.md. Exit status: 0 all cases done, 1 some failed,
2 bad input, 3 stopped on request (every case that ran has written a restart file).
"""

import argparse
import ctypes
import fcntl
import fnmatch
import math
import os
import signal
import subprocess
import sys
import time
import tomllib
from pathlib import Path

from barchan.errors import BarchanError
from barchan.io import writing
from barchan.io.run_folder import json_of, text_of, toml_of
from barchan.io.study_folder import NAME
from barchan.io.writing import appending
from barchan.studies.spec import StudyError, read_study, unknown
from barchan.studies.table import write_table

CHANGED = "# changed since: "  # as the program says it
PACKAGE = Path(__file__).resolve().parents[2]  # the folder in which the package lies


def say(text):
    print(f"sweep: {text}", flush=True)


def resolved(program, study, case):
    """The case with every default filled in, as a dictionary, and the file whose content has changed since its folder's
    results began from it, or None; StudyError with the program's sentences.
    """
    command = [program, "check", "--resolved-only", str(case.base), *case.set_options(),
               "--out", str(study.out / case.run_name)]
    checked = subprocess.run(command, capture_output=True, text=True, env=one_thread())
    if checked.returncode != 0:
        raise StudyError(f"case {case.run_name}: {why(checked.returncode, checked.stderr.strip())}")
    *_, last = checked.stdout.splitlines()
    return tomllib.loads(checked.stdout), last.removeprefix(CHANGED) if last.startswith(CHANGED) else None


def why(status, said):
    """What a program said before it failed, and the signal that has ended it, if one has."""
    try:
        end = f"ended by {signal.Signals(-status).name}"
    except ValueError:
        end = "" if said else f"ended with {status}"
    return ": ".join(filter(None, (said, end)))


def chosen_of(study, patterns):
    """The runs that are asked for: all, or those whose name fits one of the patterns (*, ?, [abc])."""
    names = [case.run_name for case in study.cases]
    for pattern in patterns or []:
        if not fnmatch.filter(names, pattern):
            raise unknown(pattern, names, "--only")
    return [case for case in study.cases
            if not patterns or any(fnmatch.fnmatchcase(case.run_name, pattern) for pattern in patterns)]


def end_with_parent():
    """A case does not outlive a sweep that is killed: it is asked to stop, with a restart file."""
    try:
        ctypes.CDLL(None).prctl(1, signal.SIGTERM)  # PR_SET_PDEATHSIG, of Linux
    except (OSError, AttributeError):
        pass


def one_thread():
    return {**os.environ, "OMP_NUM_THREADS": "1", "OMP_PROC_BIND": "false"}


def reached(folder):
    """The time that a run has come to [s]."""
    time_there = json_of(folder / "run.json").get("simulated_seconds")
    return float(time_there) if isinstance(time_there, (int, float)) and math.isfinite(time_there) else 0.0


def without_end(config):
    times = config.get("time")
    return {**config, "time": {**times, "end": 0}} if isinstance(times, dict) else config


def newest_restart(folder):
    files = sorted(folder.glob("restart_*.h5"))
    return files[-1] if files else None


def state_of(folder, config, changed=None):
    """("done", None), ("continue", restart file) or ("new", None): what is left to do for a case.

    A run counts as the same when its configuration is, the end time apart (a study may be made longer), and no file
    that it began from has `changed`.
    """
    if changed or without_end(toml_of(text_of(folder / "config.toml"))) != without_end(config):
        return "new", None
    done = json_of(folder / "run.json").get("status") == "done"
    if done and reached(folder) >= config["time"]["end"] * (1 - 1e-9):
        return "done", None
    restart = newest_restart(folder)
    return ("continue", restart) if restart else ("new", None)


class Running:
    """One case that computes; its output goes to the run folder's sweep.txt."""

    def __init__(self, program, study, case, restart, threads, overwrite):
        self.case, self.folder = case, study.out / case.run_name
        command = [program, "run", str(case.base), *case.set_options(), "--out", str(self.folder),
                   "--quiet", "--threads", str(threads)]
        if restart:
            command += ["--restart", str(restart)]
        elif overwrite:
            command.append("--overwrite")
        environment = with_threads(threads)
        with appending(self.folder / "sweep.txt") as log:
            # A group of its own: a Ctrl-C reaches it once, through us.
            self.process = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                            env=environment, start_new_session=True,
                                            preexec_fn=end_with_parent)

    def progress(self):
        return f"{self.case.run_name} {reached(self.folder):.2f} s"

    def complaint(self):
        """The last line that the program wrote, and the signal that has ended it."""
        lines = text_of(self.folder / "sweep.txt").strip().splitlines()
        return why(self.process.returncode, lines[-1] if lines else "")


class Sweep:
    """Computes the runs `chosen` of a study; its tables list all of them."""

    def __init__(self, program, study, chosen, draw, overwrite):
        self.program, self.study, self.chosen, self.draw = program, study, chosen, draw
        self.overwrite = overwrite
        self.running, self.failed, self.stopping = [], {}, False
        self.finished, self.started = 0, time.monotonic()
        found = {case.run_name: resolved(program, study, case) for case in study.cases}
        self.configs = {name: config for name, (config, _) in found.items()}
        self.changed = {name: file for name, (_, file) in found.items()}  # until it has run again
        self.said = time.monotonic()
        self.began = time.time()

    def stop(self, *_):
        if not self.stopping:
            say("stopping: every case that runs writes a restart file")
        self.stopping = True
        for one in self.running:
            one.process.send_signal(signal.SIGTERM)

    def run(self):
        waiting = []
        for case in self.chosen:
            what, _ = self.state(case)
            changed = self.changed[case.run_name]
            say(f"{case.run_name}: {dict(done='done before', new='to be run').get(what, 'to be continued')}"
                + f", {changed} has changed" * bool(changed))
            if what != "done":
                waiting.append(case)
        self.tabulate()
        while (waiting or self.running) and not (self.stopping and not self.running):
            while waiting and len(self.running) < self.study.at_once and not self.stopping:
                case = waiting.pop(0)
                try:
                    self.start(case)
                except (BarchanError, OSError) as error:
                    self.fails(case, error)
            self.watch()
            time.sleep(0.2)
        self.tabulate()
        if self.draw and not self.stopping:
            draw_figures(self.study.out)
        return self.verdict()

    def state(self, case):
        return state_of(self.study.out / case.run_name, self.configs[case.run_name], self.changed[case.run_name])

    def verdict(self):
        if self.stopping:
            say(f"stopped; the same command goes on: {len(self.chosen)} cases in {self.study.out}")
            return 3
        for name, reason in self.failed.items():
            say(f"failed: {name}: {reason}")
        left_out = len(self.study.cases) - len(self.chosen)
        others = f"{left_out} others not asked for, " * bool(left_out)
        say(f"{len(self.chosen) - len(self.failed)} of {len(self.chosen)} cases done{self.rate()}, {others}"
            f"{self.study.out / 'study.csv'}")
        return 1 if self.failed else 0

    def rate(self):
        """How many runs an hour were computed, precursor cases included; nothing before the first has ended."""
        return f", {3600 * self.finished / (time.monotonic() - self.started):.3g} runs an hour" * bool(self.finished)

    def fails(self, case, reason):
        self.failed[case.run_name] = reason
        say(f"{case.run_name}: failed: {reason}")

    def start(self, case):
        """First what the case starts from, alone: two cases must not compute the same start."""
        folder = writing.folder(self.study.out / case.run_name)
        _, restart = self.state(case)
        if restart is None:
            command = [self.program, "run", str(case.base), *case.set_options(), "--out", str(folder),
                       "--quiet", "--starts-only"]
            threads = self.study.threads * (self.study.at_once - len(self.running))  # those of no case
            with appending(folder / "sweep.txt") as log:
                starts = subprocess.Popen(command, stdin=subprocess.DEVNULL, stdout=log, stderr=log,
                                          env=with_threads(threads),
                                          start_new_session=True, preexec_fn=end_with_parent)
            while starts.poll() is None:
                if self.stopping:
                    starts.send_signal(signal.SIGTERM)
                self.watch()
                time.sleep(0.2)
            if self.stopping:
                return
            if starts.returncode != 0:
                self.fails(case, why(starts.returncode, f"what it starts from, see {folder / 'sweep.txt'}"))
                return
        self.running.append(Running(self.program, self.study, case, restart, self.study.threads, self.overwrite))
        say(f"{case.run_name}: {'goes on from ' + restart.name if restart else 'started'}")

    def watch(self):
        """Takes note of what has ended; a line of progress every half minute."""
        for one in [one for one in self.running if one.process.poll() is not None]:
            self.running.remove(one)
            status = one.process.returncode
            if status in (0, 3):
                self.changed[one.case.run_name] = None
            if status == 0:
                self.finished += 1
                say(f"{one.case.run_name}: done")
                if self.draw:
                    draw_figures(one.folder)
            elif status != 3:
                self.fails(one.case, one.complaint())
            self.tabulate()
        if self.running and time.monotonic() - self.said > 30:
            self.said = time.monotonic()
            say(", ".join(one.progress() for one in self.running) + self.remaining() + self.rate())

    def remaining(self):
        """The time left, from what the cases have come forward since the start."""
        names = [case.run_name for case in self.chosen]
        ends = [self.configs[name]["time"]["end"] for name in names]
        come = sum(min(reached(self.study.out / name), end) for name, end in zip(names, ends))
        if not hasattr(self, "come_first"):
            self.come_first, self.began = come, time.time()
            return ""
        done = come - self.come_first
        if done <= 0:
            return ""
        seconds = (sum(ends) - come) * (time.time() - self.began) / done
        return f"; {come:.1f} of {sum(ends):g} s in all, about {seconds / 60:.0f} min left"

    def tabulate(self):
        write_table(self.study, self.failed, {case.run_name: self.status(case) for case in self.study.cases})

    def status(self, case):
        if case.run_name in self.failed:
            return "failed"
        if any(one.case is case for one in self.running):
            return "running"
        what, _ = self.state(case)
        return {"done": "done", "continue": "unfinished", "new": "waiting"}[what]


def with_threads(count):
    """The environment of a program with so many threads, which may run beside others."""
    return {**os.environ, "OMP_NUM_THREADS": str(count), "OMP_PROC_BIND": "false"}


def draw_figures(folder):
    """Pictures are no reason to fail."""
    path = os.pathsep.join([str(PACKAGE), *filter(None, [os.environ.get("PYTHONPATH")])])
    drawn = subprocess.run([sys.executable, "-m", "barchan", "plot", "--", str(folder)], capture_output=True, text=True,
                           env={**os.environ, "PYTHONPATH": path})
    if drawn.returncode != 0:
        say(f"some pictures of {folder} could not be drawn: {drawn.stderr.strip().splitlines()[-1:]}")


def parse(arguments):
    parser = argparse.ArgumentParser(prog="barchan sweep", description="Runs a parameter study.")
    parser.add_argument("program", help=argparse.SUPPRESS)
    parser.add_argument("study", metavar="STUDY.toml")
    parser.add_argument("--out", metavar="DIR", help="folder of the study (default: runs/ and the path below configs)")
    parser.add_argument("--only", metavar="RUN", nargs="+", help="these runs of it; patterns with * are taken")
    parser.add_argument("--at-once", type=int, metavar="N", help="cases side by side")
    parser.add_argument("--threads", type=int, metavar="N", help="threads of each (default: cores shared out)")
    parser.add_argument("--overwrite", action="store_true",
                        help="begin cases again whose folder has results of another configuration")
    parser.add_argument("--list", action="store_true", help="show the cases, run nothing")
    parser.add_argument("--no-pictures", action="store_true")
    return parser.parse_args(arguments)


def check_earlier_place(study):
    """Earlier versions called the folder of a study by the last part of its name: StudyError if its results are there."""
    earlier = Path("runs") / study.out.name
    there = json_of(earlier / NAME)
    if not study.out.exists() and (there.get("title"), there.get("base")) == (study.title, str(study.cases[0].base)):
        raise StudyError("results of an earlier version have another folder now; move them, or compute them again with "
                         f"--overwrite:\n  mkdir -p {study.out.parent}; mv {earlier} {study.out}")


def lock(folder):
    """Two sweeps in one folder would overwrite each other's runs."""
    try:
        folder.mkdir(parents=True, exist_ok=True)
        handle = appending(folder / ".lock")
    except OSError as error:
        raise StudyError(f"cannot write to {folder}: {error.strerror}; take another --out") from error
    except BarchanError as error:
        raise StudyError(f"{error}; take another --out") from error
    try:
        fcntl.flock(handle, fcntl.LOCK_EX | fcntl.LOCK_NB)
    except OSError as error:
        raise StudyError(f"another sweep is at work in {folder}") from error
    return handle


def check_nobody_runs(folders):
    """A case that somebody runs by hand must not be run beside it: StudyError with who does."""
    for folder in folders:
        try:
            # A pipe of that name is not waited for.
            with open(os.open(folder / ".barchan.lock", os.O_RDONLY | os.O_NONBLOCK | os.O_NOFOLLOW)) as handle:
                holder = handle.readline().strip() or "another process"
                fcntl.flock(handle, fcntl.LOCK_SH | fcntl.LOCK_NB)
        except FileNotFoundError:
            continue
        except BlockingIOError as error:
            raise StudyError(f"{folder} is in use by {holder}: wait for it, or take another --out") from error
        except OSError:
            continue  # a file system without locks: the program says so


def main(arguments):
    options = parse(arguments)
    try:
        study = read_study(Path(options.study), options)
        chosen = chosen_of(study, options.only)
        sweep = Sweep(options.program, study, chosen, not options.no_pictures, options.overwrite)
        if options.list:
            for case in chosen:
                print(case.run_name, *case.set_options()[1::2])
            return 0
        if not options.out and not options.overwrite:
            check_earlier_place(study)
        held = lock(study.out)
        check_nobody_runs(study.out / case.run_name for case in chosen)
    except BarchanError as error:
        print(error, file=sys.stderr)
        return 2
    for number in (signal.SIGINT, signal.SIGTERM, signal.SIGHUP):
        signal.signal(number, sweep.stop)
    try:
        with held:
            return sweep.run()
    except OSError as error:
        print(f"cannot write {error.filename or study.out}: {error.strerror}", file=sys.stderr)
        return 1

