"""Writes into the folder of a run or a study, which somebody else may have made: nothing in it leads elsewhere.

A link under the name of a file is replaced, not followed; one under the name of a folder or of a log is refused.
"""

import os
import stat
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import TextIO

from barchan.errors import BarchanError


@contextmanager
def replacing(path: Path) -> Iterator[Path]:
    """A name beside `path` that is free: what is made there takes its place, unless something goes wrong."""
    beside = path.with_name(path.name + ".part")
    beside.unlink(missing_ok=True)
    try:
        yield beside
        os.replace(beside, path)
    except BaseException:
        beside.unlink(missing_ok=True)
        raise


def write(path: Path, content: str | bytes, date: float | None = None) -> None:
    """The whole of a file: a reader, or a kill at any moment, sees the old content or the new one.

    date: of the file, seconds since the epoch; without it that of now.
    """
    with replacing(path) as beside:
        with open(os.open(beside, os.O_WRONLY | os.O_CREAT | os.O_EXCL, 0o666), "wb") as file:
            file.write(content.encode(errors="replace") if isinstance(content, str) else content)
        if date is not None:
            os.utime(beside, (date, date))


def appending(path: Path) -> TextIO:
    """A file at whose end is written, made where there is none. BarchanError where it is a link, or no file."""
    try:
        file = open(os.open(path, os.O_WRONLY | os.O_CREAT | os.O_APPEND | os.O_NOFOLLOW | os.O_NONBLOCK, 0o666), "a")
    except OSError as error:
        why = "it is a link" if path.is_symlink() else error.strerror
        raise BarchanError(f"cannot write to {path}: {why}") from error
    if not stat.S_ISREG(os.fstat(file.fileno()).st_mode):
        file.close()
        raise BarchanError(f"cannot write to {path}: it is not a file")
    return file


def folder(path: Path) -> Path:
    """A folder within that of a run or a study, made where there is none. BarchanError where it cannot be."""
    if path.is_symlink():
        raise BarchanError(f"cannot write to {path}: it is a link")
    try:
        path.mkdir(exist_ok=True)
    except FileExistsError as error:
        raise BarchanError(f"cannot write to {path}: it is a file") from error
    except OSError as error:
        raise BarchanError(f"cannot write to {path}: {error.strerror}") from error
    return path


def only(path: Path, pattern: str, names: set[str]) -> None:
    """Removes from a folder the files that fit the pattern and have none of these names: what an earlier call left."""
    for old in path.glob(pattern):
        if old.name not in names:
            old.unlink()
