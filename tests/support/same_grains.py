#!/usr/bin/python3
"""same_grains.py RUN OTHER [bits]: two runs with grains agree in the last restart files, the frames of grains and
forces, and in the tables, whatever order their ranks keep grains and contacts in. With "bits" the
restart files hold the same bits, in the same order."""
import pathlib
import sys

import h5py
import numpy as np

POSITION, REST = 1e-10, 1e-6  # relative; contacts of stiff grains amplify the last bits of positions


def last_restart(folder):
    return max(pathlib.Path(folder).glob("restart_*.h5"))


def close(label, a, b, tolerance):
    """Ends the program unless a and b differ by less than `tolerance` of the largest of a."""
    if a.shape != b.shape:
        sys.exit(f"{label}: {a.shape} and {b.shape}")
    known = ~(np.isnan(a) & np.isnan(b))
    off = np.max(np.abs(a - b)[known], initial=0.0)
    scale = max(np.max(np.abs(a)[known], initial=0.0), 1e-30)
    if not off <= tolerance * scale:
        sys.exit(f"{label}: differs by {off:.3g} of {scale:.3g}")


def by_id(group, names):
    """Columns of grains, all in the order of their ids."""
    order = np.argsort(group["id"][...])
    return {name: np.moveaxis(group[name][...], -1 if group[name].ndim == 1 else -2, 0)[order]
            for name in names}


def contacts(file):
    """(lower id, higher id) -> displacement as the lower one sees it; one of two ranks is there twice."""
    found = {}
    group = file["contacts"]
    for a, b, xi in zip(group["first"][...], group["second"][...], group["xi_t"][...]):
        seen = xi if a < b else -xi
        if not np.allclose(found.setdefault((min(a, b), max(a, b)), seen), seen, rtol=0, atol=1e-20):
            sys.exit(f"the two sides of the contact of {a} and {b} do not agree")
    return found


def compare_restarts(a, b):
    with h5py.File(a) as ours, h5py.File(b) as theirs:
        names = sorted(n for n in ours["grains"] if ours["grains"][n].ndim > 1)
        x, y = by_id(ours["grains"], names), by_id(theirs["grains"], names)
        close("positions", x["kin"][:, :3], y["kin"][:, :3], POSITION)
        for name in names:
            if name != "x_reference":  # of the last list, which a restart may build anew
                close(name, x[name], y[name], REST)
        if not np.array_equal(np.sort(ours["grains/id"][...]), np.sort(theirs["grains/id"][...])):
            sys.exit("other grains")
        one, two = contacts(ours), contacts(theirs)
        if not one or set(one) != set(two):
            sys.exit(f"{len(one)} and {len(two)} contacts: {len(set(one) ^ set(two))} are not in both")
        keys = sorted(one)
        close("histories", np.array([one[k] for k in keys]), np.array([two[k] for k in keys]), REST)


def compare_frames(a, b):
    with h5py.File(a) as ours, h5py.File(b) as theirs:
        frames = [name for name in ours if name.startswith("frame_")]
        if not frames or set(frames) != {n for n in theirs if n.startswith("frame_")}:
            sys.exit(f"{a.name}: other frames")
        for frame in frames:
            names = [name for name in ours[frame] if name != "id"]
            x, y = by_id(ours[frame], names), by_id(theirs[frame], names)
            for name in names:
                close(f"{frame}/{name}", x[name], y[name], REST)


def compare_tables(run, other):
    for name in ("dune.csv", "force_map.csv", "history.csv"):
        x, y = (np.genfromtxt(folder / name, delimiter=",", names=True) for folder in (run, other))
        if x.size == 0:
            sys.exit(f"{name} is empty")
        for column in x.dtype.names:
            if column != "continuity_residual":  # round-off itself
                close(f"{name}: {column}", np.atleast_1d(x[column]), np.atleast_1d(y[column]), REST)


def same_bits(a, b):
    with h5py.File(a) as ours, h5py.File(b) as theirs:
        def check(name, item):
            if isinstance(item, h5py.Dataset) and item[...].tobytes() != theirs[name][...].tobytes():
                sys.exit(f"{name} has other bits")
        ours.visititems(check)


def main(run, other, bits=""):
    run, other = pathlib.Path(run), pathlib.Path(other)
    if bits:
        same_bits(last_restart(run), last_restart(other))
    else:
        compare_restarts(last_restart(run), last_restart(other))
        compare_frames(run / "grains.h5", other / "grains.h5")
        compare_frames(run / "tracks.h5", other / "tracks.h5")
        compare_tables(run, other)
    print(f"{run} and {other} agree")


if __name__ == "__main__":
    main(*sys.argv[1:])
