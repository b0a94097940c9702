#!/usr/bin/python3
"""same_results.py RUN OTHER: the last restart files, field averages and tables of two runs of a flow agree to
1e-10 of the largest value of each array; the sums of other orders that ranks make are not felt before."""
import pathlib
import sys

import h5py
import numpy as np

TOLERANCE = 1e-10


def arrays(path):
    """Name -> array of real numbers of an HDF5 file."""
    found = {}
    with h5py.File(path) as file:
        file.visititems(lambda name, item: found.__setitem__(name, np.asarray(item))
                        if isinstance(item, h5py.Dataset) and item.dtype.kind == "f" else None)
    return found


def inside(name, array):
    """Without the ghosts of a field, which may be anything where nobody reads them."""
    ghosts = array.ndim == 3 and name.startswith(("fluid/", "statistics/"))
    return array[1:-1, 1:-1, 1:-1] if ghosts else array


def compare(label, a, b, scale):
    if a.shape != b.shape:
        sys.exit(f"{label}: {a.shape} and {b.shape}")
    off = np.max(np.abs(a - b), initial=0.0)
    if not off <= TOLERANCE * scale:
        sys.exit(f"{label}: differs by {off:.3g} of {scale:.3g}")


def compare_files(a, b):
    ours, theirs = arrays(a), arrays(b)
    if set(ours) != set(theirs) or not ours:
        sys.exit(f"{a} and {b} hold other arrays: {sorted(set(ours) ^ set(theirs))}")
    for name in ours:
        x, y = inside(name, ours[name]), inside(name, theirs[name])
        single = ours[name].dtype.itemsize == 4
        scale = max(np.max(np.abs(x), initial=0.0), 1e-30) * (1e3 if single else 1)
        compare(f"{a.name}: {name}", x.astype(float), y.astype(float), scale)


def main(run, other):
    run, other = pathlib.Path(run), pathlib.Path(other)
    last = max(run.glob("restart_*.h5")).name
    for name in (last, "fields.h5", "flow_average.h5"):
        compare_files(run / name, other / name)
    for name in ("history.csv", "statistics.csv"):
        x, y = (np.genfromtxt(folder / name, delimiter=",", names=True) for folder in (run, other))
        for column in x.dtype.names:
            if column in ("continuity_residual",):  # round-off itself
                continue
            scale = max(np.max(np.abs(x[column])), 1e-30) * 10  # nine digits are written
            compare(f"{name}: {column}", x[column], y[column], scale)
    print(f"{run} and {other} agree")


if __name__ == "__main__":
    main(*sys.argv[1:])
