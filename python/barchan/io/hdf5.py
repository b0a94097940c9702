"""Opens HDF5 files that somebody else may have made, or that a run may be writing."""

import os
import time
from collections.abc import Callable, Iterator
from pathlib import Path
from typing import Any, TypeVar

import numpy as np

from barchan.errors import BarchanError

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")  # the run may still hold the file
import h5py  # noqa: E402

PATIENCE = 1.0  # [s] with a file that a run may be writing
Anything = TypeVar("Anything")


def patiently(path: Path, read: Callable[[], Anything]) -> Anything:
    """read(), again for a second where it fails and `path` changed a moment ago: a run may be writing it."""
    end = time.monotonic() + PATIENCE
    while True:
        try:
            return read()
        except (OSError, KeyError, RuntimeError, ValueError) as error:
            if time.monotonic() > end or not has_just_changed(path):
                raise BarchanError(f"cannot read {path}: {reason(error)}") from error
        time.sleep(0.02)


def has_just_changed(path: Path) -> bool:
    return path.exists() and time.time() - path.stat().st_mtime < 2.0


def reason(error: Exception) -> str:
    if "truncated file" in str(error):
        return "it is cut short (an incomplete copy, or a run that was killed or is writing it)"
    return str(error)


def open_file(path: Path) -> "Root":
    """The root of a file, for a with statement. Throws BarchanError."""
    return patiently(path, lambda: Root(path, h5py.File(path, "r")))


class Group:
    """As a group of h5py, but what it leads to is in this file, and is what was written."""

    def __init__(self, path: Path, group: Any) -> None:
        self.path, self.group = path, group
        self.attrs = group.attrs

    def __iter__(self) -> Iterator[str]:
        return iter(self.group)

    def __contains__(self, name: str) -> bool:
        return self.group.id.links.exists(name.encode())

    def __getitem__(self, name: str) -> Any:
        item = self.group
        for part in name.split("/"):
            if item.id.links.get_info(part.encode()).type != h5py.h5l.TYPE_HARD:
                raise BarchanError(f"cannot read {self.path}: {name} in it is a link, perhaps to another file")
            item = item[part]
        return Group(self.path, item) if isinstance(item, h5py.Group) else Array(self.path, item)


class Root(Group):
    def __enter__(self) -> "Root":
        return self

    def __exit__(self, *_: object) -> None:
        self.group.close()


class Array:
    """As a dataset of h5py; where the whole is read, its checksum is looked at."""

    def __init__(self, path: Path, array: Any) -> None:
        self.path, self.array = path, array
        self.attrs = array.attrs
        if array.external or array.is_virtual:
            raise BarchanError(f"cannot read {path}: the values of {array.name} lie elsewhere, in other arrays "
                               "or files")

    def __len__(self) -> int:
        return len(self.array)

    def __getitem__(self, key: Any) -> np.ndarray:
        values = self.array[key]
        if isinstance(key, slice) and key == slice(None) and "checksum" in self.attrs:
            if int(self.attrs["checksum"]) % 2**64 != checksum(values):
                raise BarchanError(f"cannot read {self.path}: {self.array.name} is damaged: its checksum is not that "
                                   "of what was written")
        return values


def checksum(values: np.ndarray) -> int:
    """The sum of src/io/checksum.hpp."""
    bits = np.ascontiguousarray(values).reshape(-1).view(f"u{values.dtype.itemsize}").astype(np.uint64)
    s = bits + np.arange(1, bits.size + 1, dtype=np.uint64) * np.uint64(0x9E3779B97F4A7C15)
    s ^= s >> np.uint64(32)
    s *= np.uint64(0xD6E8FEB86659FD93)
    s ^= s >> np.uint64(32)
    return int(s.sum(dtype=np.uint64))
