#!/usr/bin/python3
"""same_bits.py FILE OTHER: two restart files hold the same arrays with the same bits. Attributes, which say who
wrote a file and when, may differ."""
import sys

import h5py
import numpy as np


def arrays(path):
    """Name -> array of an HDF5 file."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.__setitem__(name, np.asarray(item))
                        if isinstance(item, h5py.Dataset) else None)
    return found


def compare(one, other):
    first, second = arrays(one), arrays(other)
    if first.keys() != second.keys():
        sys.exit(f"different arrays: {sorted(first.keys() ^ second.keys())}")
    for name, a in first.items():
        b = second[name]
        if (a.dtype, a.shape) != (b.dtype, b.shape):
            sys.exit(f"{name}: {a.dtype} {a.shape} and {b.dtype} {b.shape}")
        if a.tobytes() != b.tobytes():
            sys.exit(f"{name}: other bits, by up to {np.max(np.abs(a - b), initial=0)}")
    print(f"{len(first)} arrays, {sum(a.nbytes for a in first.values())} bytes: the same bits")


if __name__ == "__main__":
    compare(*sys.argv[1:])
