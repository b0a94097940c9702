"""Calls the program: check, run, sweep. The launcher is found, or named by BARCHAN."""

import os
import shutil
import subprocess
import sys
import tomllib
from pathlib import Path
from typing import Any

from barchan.errors import BadInput, BarchanError, RunFailed, RunStopped
from barchan.api.run import Run
from barchan.api.study import Study
from barchan.io.study_folder import run_name
from barchan.studies.spec import as_toml

RESOLVED = "\n# The case, every default filled in\n"  # of the output of check --resolved: the case as TOML is behind it
LAUNCHER = Path(__file__).resolve().parents[3] / "barchan"  # of the repository, where the package lies in it


def program() -> str:
    """The launcher or program that is called: of the variable BARCHAN, of this repository, or of PATH.

    Raises BarchanError where there is none.
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


def check(case: str | Path, report: bool = False, **overrides: Any) -> dict[str, Any]:
    """The case with every default, {section: {key: value}}. report: also prints derived numbers, cost and warnings.

    overrides: section__key=value, such as grains__sliding_friction=0.4 or grains__feed__rate=50; lists of sections as
    a whole, body=[{"name": "pile", ...}]. Raises BadInput with the message of `barchan check`, which takes some
    seconds: it times the case.
    """
    numbers, _, resolved = _call(["check", str(case), "--resolved", *_settings(overrides)]).partition(RESOLVED)
    if report:
        print(numbers, end="")
    return tomllib.loads(resolved)


def resolved(case: str | Path, **overrides: Any) -> dict[str, Any]:
    """As `check`, at once: nothing is timed."""
    return tomllib.loads(_call(["check", str(case), "--resolved-only", *_settings(overrides)]))


def run(case: str | Path, out: str | Path | None = None, threads: int | None = None, ranks: int | None = None,
        restart: str | Path | None = None, overwrite: bool = False, quiet: bool = False, **overrides: Any) -> Run:
    """Runs a case to its end and returns its Run; progress goes to standard error.

    out: the run folder (default: runs/ and the path of the case below configs); where it holds this run, finished,
    nothing is computed again. quiet: prints nothing (warnings are in log.txt) and draws no pictures.
    overrides: section__key=value, such as time__end=2.0. Raises BadInput (refused), RunFailed or RunStopped with the
    program's message.
    """
    folder = Path(out) if out is not None else Path("runs") / run_name(case)
    words = ["run", str(case), "--out", str(folder), *_settings(overrides)]
    for name, value in (("--threads", threads), ("--ranks", ranks), ("--restart", restart)):
        words += [name, str(value)] if value is not None else []
    _call([*words, *["--overwrite"] * overwrite, *["--quiet"] * quiet], {"BARCHAN_PICTURES": "no"} if quiet else {})
    return Run(folder)


def sweep(study: str | Path, out: str | Path | None = None, at_once: int | None = None,
          threads: int | None = None) -> Study:
    """Computes what a study still lacks and returns its Study. Raises as `run`."""
    folder = Path(out) if out is not None else Path("runs") / run_name(study)
    words = ["sweep", str(study), "--out", str(folder)]
    for name, value in (("--at-once", at_once), ("--threads", threads)):
        words += [name, str(value)] if value is not None else []
    _call(words)
    return Study(folder)


def _settings(overrides: dict[str, Any]) -> list[str]:
    words = []
    for name, value in overrides.items():
        if "__" not in name and not isinstance(value, (list, dict)):
            raise BadInput(f"{name}: name a key as section__key, such as grains__sliding_friction=0.4")
        try:
            words += ["--set", f"{name.replace('__', '.')}={as_toml(value)}"]
        except TypeError as error:
            raise BadInput(f"{name}: {error}") from error
    return words


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
