#!/usr/bin/python3
"""compare_runs.py flow|grains|bits RUN OTHER: the last restart files, frames and tables of two runs agree.

flow: to 1e-10 of the largest value of each array; the sums of other orders that ranks make are not felt before.
grains: positions to 1e-10, forces, histories and tables to 1e-6, as contacts of stiff grains amplify the last bits
of positions; in whatever order their ranks keep grains and contacts. bits: restart files with the same bits.
"""
import pathlib
import sys

import h5py
import numpy as np

import same_bits

FINE, COARSE = 1e-10, 1e-6


def close(label, a, b, tolerance):
    """Ends the program unless a and b differ by less than `tolerance` of the largest of a."""
    a, b = np.asarray(a, float), np.asarray(b, float)
    if a.shape != b.shape:
        sys.exit(f"{label}: {a.shape} and {b.shape}")
    known = ~(np.isnan(a) & np.isnan(b))
    off, scale = (np.max(np.abs(x)[known], initial=0.0) for x in (a - b, a))
    if not off <= tolerance * max(scale, 1e-30):
        sys.exit(f"{label}: differs by {off:.3g} of {scale:.3g}")


def compare_tables(run, other, names, tolerance):
    for name in names:
        x, y = (np.genfromtxt(folder / name, delimiter=",", names=True) for folder in (run, other))
        if x.size == 0:
            sys.exit(f"{name} is empty")
        for column in x.dtype.names:
            if column != "continuity_residual":  # round-off itself
                close(f"{name}: {column}", np.atleast_1d(x[column]), np.atleast_1d(y[column]), tolerance)


def compare_fields(a, b):
    """All arrays of real numbers, without the ghosts of a field, which may be anything where nobody reads them."""
    ours, theirs = ({name: array for name, array in same_bits.arrays(path).items()
                     if array.dtype.kind == "f" and "@" not in name} for path in (a, b))
    if set(ours) != set(theirs) or not ours:
        sys.exit(f"{a} and {b} hold other arrays: {sorted(set(ours) ^ set(theirs))}")
    for name, x in ours.items():
        ghosts = x.ndim == 3 and name.startswith(("fluid/", "statistics/"))
        inside = (slice(1, -1),) * 3 if ghosts else ...
        close(f"{a.name}: {name}", x[inside], theirs[name][inside], FINE * (1e3 if x.dtype.itemsize == 4 else 1))


def by_id(group, names):
    """Arrays of grains, all in the order of their ids."""
    order = np.argsort(group["id"][...])
    return {name: np.moveaxis(group[name][...], -1 if group[name].ndim == 1 else -2, 0)[order] for name in names}


def contacts(file):
    """(lower id, higher id) -> displacement as the lower one sees it; one of two ranks is there twice."""
    found = {}
    group = file["contacts"]
    for a, b, xi in zip(group["first"][...], group["second"][...], group["xi_t"][...]):
        seen = xi if a < b else -xi
        if not np.allclose(found.setdefault((min(a, b), max(a, b)), seen), seen, rtol=0, atol=1e-20):
            sys.exit(f"the two sides of the contact of {a} and {b} do not agree")
    return found


def compare_grains(a, b):
    with h5py.File(a) as ours, h5py.File(b) as theirs:
        names = sorted(n for n in ours["grains"] if ours["grains"][n].ndim > 1)
        x, y = by_id(ours["grains"], names), by_id(theirs["grains"], names)
        close("positions", x["kin"][:, :3], y["kin"][:, :3], FINE)
        for name in names:
            if name != "x_reference":  # of the last list, which a restart may build anew
                close(name, x[name], y[name], COARSE)
        if not np.array_equal(np.sort(ours["grains/id"][...]), np.sort(theirs["grains/id"][...])):
            sys.exit("other grains")
        one, two = contacts(ours), contacts(theirs)
        if not one or set(one) != set(two):
            sys.exit(f"{len(one)} and {len(two)} contacts: {len(set(one) ^ set(two))} are not in both")
        close("histories", [one[k] for k in sorted(one)], [two[k] for k in sorted(one)], COARSE)


def compare_frames(a, b):
    with h5py.File(a) as ours, h5py.File(b) as theirs:
        frames = [name for name in ours if name.startswith("frame_")]
        if not frames or set(frames) != {n for n in theirs if n.startswith("frame_")}:
            sys.exit(f"{a.name}: other frames")
        for frame in frames:
            names = [name for name in ours[frame] if name != "id"]
            x, y = by_id(ours[frame], names), by_id(theirs[frame], names)
            for name in names:
                close(f"{frame}/{name}", x[name], y[name], COARSE)


def main(what, run, other):
    run, other = pathlib.Path(run), pathlib.Path(other)
    last = [max(folder.glob("restart_*.h5")) for folder in (run, other)]
    if what == "bits":
        same_bits.compare(*last)
    elif what == "flow":
        for a, b in (last, *((run / name, other / name) for name in ("fields.h5", "flow_average.h5"))):
            compare_fields(a, b)
        compare_tables(run, other, ("history.csv", "statistics.csv"), 10 * FINE)  # nine digits are written
    else:
        compare_grains(*last)
        for name in ("grains.h5", "tracks.h5"):
            compare_frames(run / name, other / name)
        some = [name for name in ("heaps.csv", "bodies.csv") if (run / name).exists()]
        compare_tables(run, other, ("dune.csv", "force_map.csv", "history.csv", *some), COARSE)
    print(f"{run} and {other} agree")


if __name__ == "__main__":
    main(*sys.argv[1:])
