"""What goes wrong, as one sentence for the user."""

import importlib
from types import ModuleType


class BarchanError(Exception):
    """A sentence for the user: a file that cannot be read, a case that is refused, a run that failed."""


class MissingData(BarchanError):
    """The run has no data for what was asked; the sentence says which file or key it needs."""


class BadInput(BarchanError):
    """The program refused a case or an option (exit code 2). The message is the program's."""


class RunFailed(BarchanError):
    """The program stopped by itself (exit code 1). The message is the program's."""


class RunStopped(BarchanError):
    """The run was stopped on request (exit code 3) and has written a restart file."""


def seconds(name: str, value: object) -> float:
    """A time as a float; else a BarchanError that says which argument is none."""
    try:
        if not isinstance(value, (str, bytes)):
            return float(value)  # type: ignore[arg-type]
    except (TypeError, ValueError):
        pass
    raise BarchanError(f"{name} must be a number, a time in seconds, and is {value!r}")


def optional(module: str, package: str) -> ModuleType:
    """The module, where it is installed; else a BarchanError with the name of what to install."""
    try:
        return importlib.import_module(module)
    except ImportError as error:
        raise BarchanError(f"needs {package}, which is not installed: apt install python3-{package}, where the system "
                           f"has it, or pip install {package}") from error
