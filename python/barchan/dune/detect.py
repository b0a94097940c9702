"""Finds and measures dunes from the positions and diameters of grains alone, as the program does for dune.csv.

For frames without labels: of another program, or of a run without dune analytics. Definitions: docs/dune-measures.md.
Lengths in m; criteria in mean grain diameters of the frame.
"""

import numpy as np

from barchan.dune.fluxes import volumes
from barchan.dune.shape import HALF_WIDTH, Bed, Dune, Sand, centreline, find, number_of_bins
from barchan.dune.surface import Surface
from barchan.io.frames import Grains

CORE_COVER = 1.2    # summed cross-sections over the area of a bin: no single layer reaches it
RIM_COVER = 0.3
RIM_REACH = 12.0    # how far the rim goes out from a core
FEWEST = 100        # grains of a dune
HORN_HEIGHT = 2.0   # of the sand that horn_left_2d and horn_right_2d count
MEASURED = {
    "n_grains": ("1", "grains of the dune"),
    "W": ("m", "width"),
    "L": ("m", "length along the centreline"),
    "H": ("m", "height"),
    "Cx": ("m", "x of the centroid"),
    "Cy": ("m", "height of the centroid"),
    "Cz": ("m", "z of the centroid"),
    "horn_left": ("m", "length of the horn at z < Cz"),
    "horn_right": ("m", "length of the horn at z > Cz"),
    "crest_x": ("m", "crest on the centreline"),
    "volume": ("m3", "solid volume, sum of pi d^3/6"),
    "horn_left_2d": ("m", "as horn_left, of sand two grains high or more"),
    "horn_right_2d": ("m", "as horn_right, of sand two grains high or more"),
}


def labels(grains: Grains, bed: Bed) -> np.ndarray:
    """Which dune each grain of a frame is of.

    Parameters
    ----------
    grains : Grains
        The frame: x (N, 3), d (N) [m].
    bed : Bed
        What the grains lie on.

    Returns
    -------
    numpy.ndarray
        (N) int: 0 for the dune of most sand; -1 for grains in none or outside the domain.
    """
    diameter = float(grains.d.mean())
    shape = number_of_bins(bed, diameter)
    size = np.array(bed.lengths) / shape
    place = np.floor(grains.x[:, (0, 2)] / size).astype(int)
    place = np.where(bed.periodic, place % shape, place)
    inside = np.all((place >= 0) & (place < shape), axis=1)
    bins = np.ravel_multi_index(tuple(place[inside].T), tuple(shape))
    cover = np.bincount(bins, np.pi / 4 * grains.d[inside]**2, shape.prod()).reshape(shape) / size.prod()
    steps = int(np.ceil(RIM_REACH * diameter / size.max()))
    piece = components(core_and_rim(cover, steps, bed.periodic), bed.periodic).ravel()[bins]
    of_grain = np.full(len(grains.x), -1)
    of_grain[inside] = piece
    found, n = np.unique(piece[piece >= 0], return_counts=True)
    found = found[n >= FEWEST]
    sand = np.array([np.sum(grains.d[of_grain == one].astype(float)**3) for one in found])
    result = np.full(len(grains.x), -1)
    for number, one in enumerate(found[np.argsort(-sand, kind="stable")]):
        result[of_grain == one] = number
    return result


def core_and_rim(cover: np.ndarray, steps: int, periodic: tuple) -> np.ndarray:
    """Which bins (nx, nz) are of dunes: those of high cover, and those of some cover that join within `steps`."""
    marked = cover >= CORE_COVER
    for _ in range(steps):
        marked = marked | ((cover >= RIM_COVER) & (largest_around(marked.astype(int), periodic) > 0))
    return marked


def components(marked: np.ndarray, periodic: tuple) -> np.ndarray:
    """A number for each set of marked bins (nx, nz) that touch, also at a corner; -1 elsewhere."""
    number = np.where(marked, np.arange(marked.size).reshape(marked.shape), -1)
    while True:
        spread = np.where(marked, largest_around(number, periodic), -1)
        if np.array_equal(spread, number):
            return number
        number = spread


def largest_around(values: np.ndarray, periodic: tuple) -> np.ndarray:
    """The largest of each bin (nx, nz) and its eight neighbours, also across periodic edges."""
    for axis in (0, 1):
        edge = [(1, 1) if axis == each else (0, 0) for each in (0, 1)]
        padded = np.pad(values, edge, mode="wrap" if periodic[axis] else "edge")
        views = [np.take(padded, np.arange(values.shape[axis]) + shift, axis) for shift in (0, 1, 2)]
        values = np.maximum.reduce(views)
    return values


def measure(grains: Grains, rows: np.ndarray, bed: Bed) -> dict[str, float]:
    """Size, centroid, crest and horns of one dune.

    Cx, Cz and crest_x lie in the domain, also of a dune across a periodic seam.

    Parameters
    ----------
    grains : Grains
        The frame: x (N, 3), d (N) [m].
    rows : numpy.ndarray
        (n) places of the dune's grains in the frame.
    bed : Bed
        What the grains lie on.

    Returns
    -------
    dict of str to float
        By the names of dune.csv [m; volume: m3].
    """
    sand, mean = Sand.of(grains, rows, bed), float(grains.d.mean())
    x, z, radius, surface, c = sand.x, sand.z, sand.radius, sand.surface, sand.centroid.copy()
    crest = crest_x(surface, c, mean)
    line, left, right = foot_and_horns(sand, np.full(len(rows), True), crest, mean)
    high = surface.in_bins(surface.h >= HORN_HEIGHT * mean, x, z)
    _, left_2d, right_2d = foot_and_horns(sand, high, crest, mean)
    L, W = line[1] - line[0], np.max(z + radius) - np.min(z - radius)
    if bed.periodic[0]:
        L = min(L, bed.lengths[0])
        c[0], crest = c[0] % bed.lengths[0], crest % bed.lengths[0]
    if bed.periodic[1]:
        W, c[2] = min(W, bed.lengths[1]), c[2] % bed.lengths[1]
    volume = volumes(2 * radius).sum()
    values = (len(rows), W, L, surface.h.max(), *c, left, right, crest, volume, left_2d, right_2d)
    return dict(zip(MEASURED, map(float, values)))


def crest_x(surface: Surface, centroid: np.ndarray, mean: float) -> float:
    """Mean x [m] of the bins of the strip that are near its highest one, weighted by height; Cx without any."""
    strip = abs(surface.z - centroid[2]) < HALF_WIDTH * mean
    if not strip.any():
        return float(centroid[0])
    top = surface.h[strip].max()
    weight = np.maximum(0.0, surface.h[strip] - (top - max(0.05 * top, 0.5 * mean)))
    return float(np.average(surface.x[strip], weights=weight))


def foot_and_horns(sand: Sand, chosen: np.ndarray, crest: float,
                   mean: float) -> tuple[tuple[float, float], float, float]:
    """((toe, lee foot), left horn, right horn) [m] of the chosen (n) grains; the whole extent without a centreline."""
    x, z, radius, z0 = sand.x[chosen], sand.z[chosen], sand.radius[chosen], sand.centroid[2]
    strip = abs(z - z0) < HALF_WIDTH * mean
    line = centreline(x[strip], radius[strip], sand.surface.bins[0], crest)
    if line is None:
        return ((np.min(x - radius), np.max(x + radius)) if len(x) else (0.0, 0.0)), 0.0, 0.0
    left, right = (float(max(0.0, np.max((x + radius)[side & ~strip], initial=-np.inf) - line[1]))
                   for side in (z < z0, z > z0))
    return line, left, right


def dunes(grains: Grains, bed: Bed) -> list[Dune]:
    """The dunes of a frame, for slopes, fluxes and forces of grains without dune.csv.

    Parameters
    ----------
    grains : Grains
        The frame: x (N, 3), d (N) [m].
    bed : Bed
        What the grains lie on.

    Returns
    -------
    list of Dune
        That of most sand first.
    """
    label = labels(grains, bed)
    each = [np.nonzero(label == number)[0] for number in range(label.max(initial=-1) + 1)]
    return [find(grains, rows, bed, measure(grains, rows, bed)) for rows in each]
