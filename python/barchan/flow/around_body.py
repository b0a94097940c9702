"""Mean flow in the vertical plane through a body along the stream, and the separation bubble behind it; no drawing.

Definitions: docs/dune-measures.md, "Flow around a body". SI units.
"""

from dataclasses import dataclass

import numpy as np

from barchan.dune.bodies import Body, bodies_of
from barchan.errors import MissingData
from barchan.io.flow_average import NAME
from barchan.io.frames import FrameFile
from barchan.io.run_folder import RunFolder
from barchan.stats import in_window

UPSTREAM = 0.3  # of the domain that is shown before the body: the flow is periodic
CLEAR = 0.9     # void fraction above which a cell is water beside a bed
BEHIND = 3.0    # sizes of the body within which reversed flow must begin to be its bubble


@dataclass
class Plane:
    """Means from `start` to `end` [s] over so many `frames`, or samples, in the cells nearest to the plane z [m], or
    over the width as well if all bodies span it.

    x (nx) from the middle of the body, y (ny), centres of cells; x_face, y_face; u, v (ny, nx) [m/s]; `solid` and
    `bed` (ny, nx): cells in a body, cells in grains.
    """

    body: Body
    z: float
    start: float
    end: float
    frames: int
    x: np.ndarray
    y: np.ndarray
    x_face: np.ndarray
    y_face: np.ndarray
    u: np.ndarray
    v: np.ndarray
    solid: np.ndarray
    bed: np.ndarray

    @property
    def water(self) -> np.ndarray:
        return ~(self.solid | self.bed)


@dataclass
class Bubble:
    """The region of reversed mean flow behind a body. Lengths in m: x_lee, where the body ends downstream, x_s, where
    the flow becomes reversed, and x_r, where it is forward again, all from its middle; `height`, of reversed flow above
    the floor; `row`: "floor", or "middle" for a body with water below it. NaN: there is none, or it does not end within
    the domain."""

    x_lee: float
    x_s: float
    x_r: float
    height: float
    row: str

    @property
    def length(self) -> float:
        return self.x_r - self.x_lee


def mean_plane(run: RunFolder, body: Body, start: float | None = None, end: float | None = None) -> Plane:
    """From flow_average.h5 if the run has it and no times [s] are given; else means over frames of fields.h5, of the
    second half of the run unless other times are given."""
    file, chosen, window = _source(run, start, end)
    x, z = body.heart
    with file.open() as content:
        grid = {key: content["grid"][key][:] for key in ("x", "y", "z", "x_face", "y_face")}
        k = int(np.argmin(abs(grid["z"] - z)))
        across = slice(None) if all(each.spans for each in bodies_of(run)) else slice(k, k + 1)
        planes = [[content[file.frames[index][1]][name][across].astype(float).mean(axis=0)
                   for name in ("u", "v", "alpha_f")] for index in chosen]
        samples = int(content[file.frames[chosen[-1]][1]].attrs.get("n_samples", len(chosen)))
    u, v, alpha_f = np.mean(planes, axis=0)
    shift = int(np.floor((x - grid["x_face"][0]) / np.diff(grid["x_face"])[0])) - int(UPSTREAM * len(grid["x"]))
    first = shift % len(grid["x"])
    length = grid["x_face"][-1] - grid["x_face"][0]
    along = np.concatenate([grid["x"][first:], grid["x"][:first] + length])
    face = np.concatenate([grid["x_face"][first:-1], grid["x_face"][:first + 1] + length])
    origin = x + length * np.round((along[int(UPSTREAM * len(along))] - x) / length)
    places = np.stack(np.broadcast_arrays(along[None, :], grid["y"][:, None], z), axis=-1)
    solid = np.any([each.holds(places) for each in bodies_of(run)], axis=0)
    u, v, alpha_f = (np.roll(each, -first, axis=1) for each in (u, v, alpha_f))
    return Plane(body, z, *window, samples, along - origin, grid["y"], face - origin,
                 grid["y_face"], u, v, solid, (alpha_f < CLEAR) & ~solid)


def _source(run: RunFolder, start: float | None, end: float | None) -> tuple[FrameFile, list[int],
                                                                             tuple[float, float]]:
    """The file, its frames, and the time that they stand for [s]."""
    if start is None and end is None and (run.path / NAME).exists():
        average = FrameFile(run.path / NAME, ("u", "v", "alpha_f"))
        if average.frames:
            last, name = average.frames[-1]
            with average.open() as content:
                first = float(content[name].attrs.get("window_start", last))
            return average, [len(average.frames) - 1], (first, last)
    file = run.need_fields()
    chosen = np.flatnonzero(in_window(file.times, start, end)).tolist()
    if not chosen:
        raise MissingData(f"needs a frame of fields.h5 in that time; it has t = {file.times[0]:g} to "
                          f"{file.times[-1]:g} s")
    return file, chosen, (float(file.times[chosen[0]]), float(file.times[chosen[-1]]))


def bubble(plane: Plane) -> Bubble:
    """Where u changes sign behind the body: in the lowest row of water, or at half its height if water flows below."""
    body = plane.body
    x_lee, gap = _lee(plane)
    if gap:
        near = plane.u[int(np.argmin(abs(plane.y - (body.middle))))].copy()
    else:
        lowest = np.argmax(plane.water, axis=0)
        near = plane.u[lowest, np.arange(len(plane.x))]
    row = "middle" if gap else "floor"
    behind = np.flatnonzero(plane.x > x_lee)
    back = behind[near[behind] < 0]
    if not len(back) or plane.x[back[0]] > x_lee + BEHIND * body.unit[0]:
        return Bubble(x_lee, np.nan, np.nan, np.nan, row)
    x_s = _turns(plane.x, near, back[0] - 1) if back[0] > behind[0] else x_lee
    ahead = behind[(behind > back[0]) & (near[behind] >= 0)]
    if not len(ahead):
        return Bubble(x_lee, x_s, np.nan, _height(plane, x_lee, plane.x[-1]), row)
    x_r = _turns(plane.x, near, ahead[0] - 1)
    return Bubble(x_lee, x_s, x_r, _height(plane, x_lee, x_r), row)


def _turns(x: np.ndarray, u: np.ndarray, i: int) -> float:
    """Where u is zero between places i and i + 1 [m], linearly."""
    return float(x[i] - u[i] * (x[i + 1] - x[i]) / (u[i + 1] - u[i]))


def _lee(plane: Plane) -> tuple[float, bool]:
    """(where the body ends downstream of its middle [m], whether water flows below it)."""
    body = plane.body
    if body.shape == "wave":
        return 0.0, False
    x, z = body.heart
    low = float(body.interval(np.array(x), np.array(z))[0])
    outlines = body.section(z)
    own = next((one for one in outlines if one[:, 0].min() <= x <= one[:, 0].max()), outlines[0])
    under = plane.y < low
    gap = bool(under.any() and plane.water[under][:, abs(plane.x) < 0.5 * body.unit[0]].any())
    return float(own[:, 0].max() - x), gap


def _height(plane: Plane, x0: float, x1: float) -> float:
    """Top of the cells of reversed flow between x0 and x1 that hang together from the lowest row up [m]."""
    inside = (plane.x > x0) & (plane.x < x1)
    back = (plane.u < 0) & plane.water & inside
    tops = plane.y_face[1:][back.any(axis=1)]
    return float(tops.max()) if len(tops) else np.nan


def time(plane: Plane) -> str:
    """When the means are of, in words."""
    return f"t = {plane.start:.3g} s" if plane.start == plane.end else f"t = {plane.start:.3g} to {plane.end:.3g} s"


def in_waves(plane: Plane, found: Bubble) -> str:
    """Where the flow behind the crest of a wave is reversed, in words."""
    x_s, x_r = (place / plane.body.wavelength for place in (found.x_s, found.x_r))
    return f"reversed flow from {x_s:.3f} to {x_r:.3f} wavelengths"


def sentence(plane: Plane, found: Bubble) -> str:
    """What became of the bubble, in words."""
    size, unit = plane.body.unit
    seen = f"{plane.frames} samples, {time(plane)}" if plane.frames > 1 else time(plane)
    if np.isfinite(found.length):
        where = "in the lowest row of water" if found.row == "floor" else "at half its height"
        if plane.body.shape == "wave":
            return f"{plane.body.name}: {in_waves(plane, found)} behind the crest ({where}; {seen})"
        return (f"{plane.body.name}: separation bubble of {found.length / size:.3g} {unit} behind it (x_r = "
                f"{1e3 * found.x_r:.3g} mm from its middle, {where}; {seen})")
    if np.isfinite(found.height):
        return f"{plane.body.name}: the flow behind it is reversed to the end of the domain ({seen})"
    return f"{plane.body.name}: no reversed flow behind it ({seen})"
