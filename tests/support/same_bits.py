#!/usr/bin/python3
"""same_bits.py FILE OTHER: two HDF5 files hold the same arrays, with the same bits and attributes. Attributes of
the files themselves, which say who wrote them and when, may differ."""
import sys

import h5py
import numpy as np


def arrays(path):
    """Name -> array of an HDF5 file, and name@key -> attribute of what is in it."""
    found = {}

    def take(name, item):
        if isinstance(item, h5py.Dataset):
            found[name] = np.asarray(item)
        found.update((f"{name}@{key}", np.asarray(value)) for key, value in item.attrs.items())
    with h5py.File(path) as file:
        file.visititems(take)
    return found


def compare(one, other):
    first, second = ({name: (a.dtype.str, a.shape, a.tobytes()) for name, a in arrays(path).items()}
                     for path in (one, other))
    differing = sorted(name for name in first.keys() | second.keys() if first.get(name) != second.get(name))
    if differing or not first:
        sys.exit(f"FAILED: {one} and {other} differ in {differing[:5]} ({len(differing)} of {len(first)})")
    return f"{len(first)} arrays: the same bits"


if __name__ == "__main__":
    print(compare(*sys.argv[1:]))
