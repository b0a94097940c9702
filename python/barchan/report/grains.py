"""The grains of a run, small enough to travel inside a page: positions in 16 bits, thinned evenly."""

import base64
import json

import matplotlib
import numpy as np

from barchan.dune.bodies import bodies_of
from barchan.dune.current import always_along_x
from barchan.errors import MissingData
from barchan.figures import style

MOST_FRAMES, MOST_GRAINS = 60, 10_000
MOST_SPHERES = 30_000  # of clumps, which are drawn one by one
ABSENT = 65535  # a grain that has left; positions use 0 to 65534
COLOURS = 32


def pack(run, most_frames=MOST_FRAMES, most_grains=MOST_GRAINS):
    """(facts, data): a dictionary for JSON, and the grains in base64.

    The data are unsigned 16-bit integers, little-endian: d (n), then for each frame x (n), y (n), z (n)
    of the same n grains, and with clumps x (n), y (n), z (n) of their quaternions with w >= 0; last the kind, or heap,
    of each (n) if there are several. An integer q stands for low + q (high - low)/65534 of its `bounds`, of a
    quaternion of -1 and 1, d for q d_max/65534. `spheres`: [x, y, z, radius] of those of each kind, d = 1; [] without
    clumps.
    """
    file = run.need_grains()
    chosen = evenly(len(file.frames), most_frames)
    shapes = shapes_by_kind(run.shapes)
    most_grains = min(most_grains, MOST_SPHERES // max(map(len, shapes), default=3))
    kept, largest = kept_ids(run, chosen, most_grains)
    frames, times, diameters, group, groups = [], [], np.zeros(len(kept)), np.zeros(len(kept), "<u2"), ()
    turns = []
    for index in chosen:
        grains = run.frame(index)
        x, d, found, place = rows_of(grains, kept)
        if grains.group is not None:
            group[found], groups = grains.group[place], grains.groups
        if shapes:
            turns.append(turned(grains.orientation[place], found))
        frames.append(x)
        times.append(grains.time)
        diameters = np.where(np.isfinite(d), d, diameters)
    positions = np.array(frames)
    if not np.isfinite(positions).any():
        raise MissingData("needs a frame with grains in it")
    bounds = boxes(positions, diameters, run.domain)
    facts = {
        "times": times, "n": len(kept), "bounds": bounds, "dMax": float(diameters.max()),
        "top": float(np.nanpercentile(positions[:, :, 1] + 0.5 * diameters, 99.9)),
        "window": dune_window(positions, bounds), "colours": colours(), "groups": keys_of(groups),
        "bodies": bodies(run), "spheres": shapes,
        "flow": ("fluid" in run.config or "grains" not in run.config) and always_along_x(run.config),
    }
    words = [quantise(diameters, 0.0, facts["dMax"])]
    for n, x in enumerate(positions):
        words += [quantise(x[:, axis], *bounds[axis]) for axis in range(3)]
        words += [quantise(part, -1.0, 1.0) for part in turns[n].T] if turns else []
    words += [group] if groups else []
    facts["note"] = note(len(kept), largest, -(-largest // most_grains), len(chosen), len(file.frames))
    return facts, base64.b64encode(np.concatenate(words).tobytes()).decode()


def evenly(n, most):
    """At most `most` of n indices, evenly spread, first and last included."""
    return np.unique(np.linspace(0, n - 1, min(n, most)).round().astype(int))


def kept_ids(run, chosen, most=MOST_GRAINS):
    """The ids to show, every k-th of the grains that are in any of the frames, and how many these are."""
    with run.grain_file.open() as file:
        ids = np.unique(np.concatenate([file[run.grain_file.frames[index][1]]["id"][:] for index in chosen]))
    return ids[::max(1, -(-len(ids) // most))], len(ids)


def rows_of(grains, kept):
    """x (n, 3) and d (n) [m] of the grains `kept`, nan for those that are not in the frame; which are, and where."""
    x, d = np.full((len(kept), 3), np.nan), np.full(len(kept), np.nan)
    place = np.minimum(np.searchsorted(grains.id, kept), max(len(grains.id) - 1, 0))
    found = grains.id[place] == kept if len(grains.id) else np.zeros(len(kept), bool)
    place = place[found]
    x[found], d[found] = grains.x[place], grains.d[place]
    return x, d, found, place


def shapes_by_kind(shapes):
    """[x, y, z, radius] of the spheres of each kind; [] without clumps."""
    if shapes is None:
        return []
    rows = np.column_stack([shapes.centre, shapes.radius]).round(5)
    return [rows[shapes.kind == kind].tolist() for kind in range(shapes.kind.max() + 1)]


def turned(orientation, found):
    """(n, 3) x, y, z of the quaternions, w >= 0, of the grains that are `found`; 0 of the others."""
    parts = np.zeros((len(found), 3))
    parts[found] = orientation[:, 1:] * np.where(orientation[:, :1] < 0, -1, 1)
    return parts


def boxes(positions, diameters, domain):
    """[low, high] of x, y, z [m]: the domain, or what the grains need where they are outside it."""
    low = np.minimum(np.nanmin(positions, axis=(0, 1)), 0.0)
    high = np.nanmax(positions, axis=(0, 1)) + 0.5 * diameters.max()
    if domain is not None:
        high[[0, 2]] = np.maximum(high[[0, 2]], [domain[0], domain[2]])
    return [[float(a), float(b)] for a, b in zip(low, high)]


def dune_window(positions, bounds):
    """Centre (x, z) of most grains in each frame, and one size (x, z) that holds them [m]."""
    centres, extents = [], []
    for x in positions[:, :, [0, 2]]:
        if np.isfinite(x).any():
            low, high = np.nanpercentile(x, [3.0, 97.0], axis=0)
            centres.append((0.5 * (low + high)).tolist())
            extents.append(high - low)
        else:
            centres.append(centres[-1] if centres else [bounds[0][0], bounds[2][0]])
    spans = np.array([bounds[0][1] - bounds[0][0], bounds[2][1] - bounds[2][0]])
    size = 1.5 * np.max(extents, axis=0)
    size[0] = max(size[0], size[1] / 0.7)  # no taller than a small screen
    size = np.minimum(size, spans)
    return {"centres": centres, "size": np.maximum(size, 0.02 * spans).tolist()}


def colours():
    """The map of heights of the other figures, from the floor up."""
    shades = matplotlib.colormaps[style.HEIGHT_MAP](np.linspace(0.0, 1.0, COLOURS))
    return [matplotlib.colors.to_hex(shade) for shade in shades]


def bodies(run):
    """Name, outline from above (x, z) and in the plane through the middle (x, y) of each body [m]."""
    def rounded(outlines):
        return [np.round(outline, 6).tolist() for outline in outlines]

    return [{"name": body.name, "plan": rounded(body.plan()), "section": rounded(body.section(body.heart[1])),
             "top": body.top} for body in bodies_of(run)]


def keys_of(groups):
    """Name and colour of each kind or heap."""
    return [{"name": name, "colour": style.GROUPS[n % len(style.GROUPS)]} for n, name in enumerate(groups)]


def quantise(values, low, high):
    """Integers of 16 bits; nan becomes ABSENT."""
    share = (values - low) / max(high - low, 1e-300)
    words = np.clip(np.round((ABSENT - 1) * np.nan_to_num(share)), 0, ABSENT - 1)
    return np.where(np.isfinite(values), words, ABSENT).astype("<u2")


def note(n_kept, n_grains, step, n_frames, n_stored):
    """What the reader does not see."""
    shown = (f"All {n_grains:,} grains" if n_kept == n_grains else
             f"{n_kept:,} of {n_grains:,} grains (every {ordinal(step)} by its number, at its own size)")
    times = (f"all {n_frames} times" if n_frames == n_stored else
             f"{n_frames} of {n_stored} times, evenly spread")
    return f"{shown}, {times} of grains.h5."


def ordinal(number):
    ending = "th" if number % 100 in (11, 12, 13) else {1: "st", 2: "nd", 3: "rd"}.get(number % 10, "th")
    return f"{number}{ending}"


def to_script(facts):
    """JSON that may stand inside a script element."""
    return json.dumps(facts, separators=(",", ":")).replace("<", "\\u003c")
