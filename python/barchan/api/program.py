"""Calls the program: check, run, sweep. The launcher is found, or named by BARCHAN."""

import os
import shutil
import subprocess
import sys
import tomllib
from collections.abc import Mapping
from pathlib import Path
from typing import Any

from barchan.errors import BadInput, BarchanError, RunFailed, RunStopped
from barchan.api.run import Run
from barchan.api.study import Study
from barchan.io.study_folder import run_name
from barchan.studies.spec import as_toml, flatten

RESOLVED = "\n# The case, every default filled in\n"  # of the output of check --resolved: the case as TOML is behind it
LAUNCHER = Path(__file__).resolve().parents[3] / "barchan"  # of the repository, where the package lies in it


def program() -> str:
    """The launcher or program that is called: of the variable BARCHAN, of this repository, or of PATH.

    Returns
    -------
    str
        Its path.

    Raises
    ------
    BarchanError
        Where there is none.
    """
    named = os.environ.get("BARCHAN")
    if named:
        return named
    if os.access(LAUNCHER, os.X_OK) and LAUNCHER.is_file():
        return str(LAUNCHER)
    found = shutil.which("barchan")
    if found is None:
        raise BarchanError("the program barchan was not found: set BARCHAN to the launcher of the repository")
    return found


def check(case: str | Path, overrides: Mapping[str, Any] | None = None, *, report: bool = False,
          **keys: Any) -> dict[str, Any]:
    """The case with every default, as the program understands it. It takes some seconds: the program times the case.

    Parameters
    ----------
    case : str or pathlib.Path
        The file of the case.
    overrides : dict, optional
        Keys in place of those of the file: `{"time.end": 2.0}` or `{"time": {"end": 2.0}}`. An entry of a list of
        sections has its number, from 1: `{"fluid.schedule.2.velocity": 0.3}` or
        `{"fluid": {"schedule": {2: {"velocity": 0.3}}}}`. A list replaces the whole: `{"body": [{"name": "pile"}]}`.
    report : bool, optional
        Whether derived numbers, cost and warnings are printed, too.
    **keys
        The same with `__` for the point: `time__end=2.0`, `fluid__schedule__2__velocity=0.3`.

    Returns
    -------
    dict
        {section: {key: value}}, in SI units.

    Raises
    ------
    BadInput
        With the message of `barchan check`, where the program refuses the case.
    BarchanError
        Where there is no program.
    """
    words = ["check", str(case), "--resolved", *_settings(overrides, keys)]
    numbers, _, resolved = _call(words).partition(RESOLVED)
    if report:
        print(numbers, end="")
    return tomllib.loads(resolved)


def resolved(case: str | Path, overrides: Mapping[str, Any] | None = None, **keys: Any) -> dict[str, Any]:
    """As `check`, at once: nothing is timed.

    Parameters
    ----------
    case : str or pathlib.Path
        The file of the case.
    overrides : dict, optional
        Keys in place of those of the file, as of `check`.
    **keys
        The same with `__` for the point.

    Returns
    -------
    dict
        {section: {key: value}}, in SI units.

    Raises
    ------
    BadInput
        Where the program refuses the case.
    """
    return tomllib.loads(_call(["check", str(case), "--resolved-only", *_settings(overrides, keys)]))


def run(case: str | Path, overrides: Mapping[str, Any] | None = None, *, out: str | Path | None = None,
        threads: int | None = None, ranks: int | None = None, restart: str | Path | None = None,
        overwrite: bool = False, quiet: bool = False, **keys: Any) -> Run:
    """Runs a case to its end; progress goes to standard error.

    Parameters
    ----------
    case : str or pathlib.Path
        The file of the case.
    overrides : dict, optional
        Keys in place of those of the file, as of `check`.
    out : str or pathlib.Path, optional
        The run folder, else runs/ and the path of the case below configs. Where it holds this run, finished, nothing
        is computed again.
    threads : int, optional
        Threads of each rank, else all cores, shared by the ranks.
    ranks : int, optional
        MPI ranks, else 1.
    restart : str or pathlib.Path, optional
        A restart file to continue from, a folder (its last one) or "latest" (of this run).
    overwrite : bool, optional
        Whether the results of another run in the folder are removed.
    quiet : bool, optional
        Whether nothing is printed (warnings are in log.txt) and no picture drawn.
    **keys
        The same with `__` for the point: `time__end=2.0`.

    Returns
    -------
    Run
        The results.

    Raises
    ------
    BadInput
        Where the program refuses the case or an option.
    RunFailed
        Where the run stops by itself.
    RunStopped
        Where it is stopped on request; it can continue.
    """
    folder = Path(out) if out is not None else Path("runs") / run_name(case)
    words = ["run", str(case), "--out", str(folder), *_settings(overrides, keys)]
    for name, value in (("--threads", threads), ("--ranks", ranks), ("--restart", restart)):
        words += [name, str(value)] if value is not None else []
    _call([*words, *["--overwrite"] * overwrite, *["--quiet"] * quiet], {"BARCHAN_PICTURES": "no"} if quiet else {})
    return Run(folder)


def sweep(study: str | Path, out: str | Path | None = None, at_once: int | None = None,
          threads: int | None = None) -> Study:
    """Computes what a parameter study still lacks; progress goes to standard error.

    Parameters
    ----------
    study : str or pathlib.Path
        The file of the study.
    out : str or pathlib.Path, optional
        The folder of the study, else runs/STUDY.
    at_once : int, optional
        Cases side by side, else one for each core.
    threads : int, optional
        Threads of each case, else all cores, shared by the cases.

    Returns
    -------
    Study
        The results.

    Raises
    ------
    BadInput
        Where the study or one of its cases is refused.
    RunFailed
        Where a case stops by itself.
    RunStopped
        Where the study is stopped on request; it can continue.
    """
    folder = Path(out) if out is not None else Path("runs") / run_name(study)
    words = ["sweep", str(study), "--out", str(folder)]
    for name, value in (("--at-once", at_once), ("--threads", threads)):
        words += [name, str(value)] if value is not None else []
    _call(words)
    return Study(folder)


def _settings(overrides: Mapping[str, Any] | None, keys: dict[str, Any]) -> list[str]:
    """Options --set of the program, one for each value that is no dict."""
    if overrides is not None and not isinstance(overrides, Mapping):
        raise BadInput(f"overrides must be a dict of keys and values, and is {overrides!r}; name what else is meant, "
                       "as out=...")
    given: dict[str, Any] = {}
    for table in (overrides or {}, keys):
        for written, value in flatten(table).items():
            name = written.replace("__", ".")
            if name in given:
                raise BadInput(f"{name} is given twice")
            if "." not in name and not isinstance(value, (list, tuple)):
                raise BadInput(f"{name}: name a key as section.key or section__key, such as grains__restitution=0.4")
            try:
                given[name] = as_toml(value)
            except TypeError as error:
                raise BadInput(f"{name}: {error}") from error
    return [word for name, value in given.items() for word in ("--set", f"{name}={value}")]


def _call(words: list[str], environment: dict[str, str] | None = None) -> str:
    """What it prints; the messages of a run also go to standard error as they come, unless it is quiet."""
    quiet = words[0] == "check" or "--quiet" in words
    try:
        process = subprocess.Popen([program(), *words], stdin=subprocess.DEVNULL, stdout=subprocess.PIPE,
                                   stderr=subprocess.PIPE if quiet else subprocess.STDOUT, text=True, errors="replace",
                                   env={**os.environ, **(environment or {})})
    except OSError as error:
        raise BarchanError(f"cannot start {program()}: {error.strerror}") from error
    with process:  # at a Ctrl-C, which it gets too, it is waited for: it writes a restart file
        output, errors = process.communicate() if quiet else (_shown(process), "")
    if process.returncode:
        said = (errors or output).strip().splitlines()
        kind = {2: BadInput, 3: RunStopped}.get(process.returncode, RunFailed)
        raise kind("\n".join(said[-20:]) or f"barchan {words[0]} ended with {process.returncode}")
    return output


def _shown(process: "subprocess.Popen[str]") -> str:
    """Passes lines on to Python's standard error, which a notebook shows."""
    lines = []
    for line in process.stdout or ():
        lines.append(line)
        print(line, end="", file=sys.stderr)
    return "".join(lines)
