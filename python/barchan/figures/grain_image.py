"""Pictures of grains seen from above, true to scale, drawn by a depth buffer in numpy.

100,000 grains take about a second, where a circle each in matplotlib would take a minute, and the
picture stays the same size.
"""

from functools import lru_cache

import matplotlib
import numpy as np
from matplotlib.colors import to_rgb

from barchan.dune.bodies import tops
from barchan.figures.style import BODY, GROUPS, HEIGHT_MAP
from barchan.io.clumps import spheres_of

MOST_ROWS = 4000  # of a picture; one of a domain that is much wider than long is coarser
DEEP, DEEP_CLUMPS = 1.5, 3.0  # diameters below all around that hide a grain; between clumps there are larger gaps
LIGHT = np.array([-0.45, 0.78, -0.45])  # towards the light: x, y, z; upstream, above, left


def hidden(x, d, deep=DEEP):
    """Grains that cannot be seen from above: all around them others rise `deep` diameters higher."""
    cell = np.median(d)
    i = np.floor((x[:, 0] - x[:, 0].min()) / cell).astype(int) + 1
    k = np.floor((x[:, 2] - x[:, 2].min()) / cell).astype(int) + 1
    top = np.zeros((i.max() + 2, k.max() + 2))
    np.maximum.at(top, (i, k), x[:, 1] + 0.5 * d)
    lowest = top.copy()
    for axis in (0, 1):
        lowest = np.minimum(np.minimum(np.roll(lowest, 1, axis), np.roll(lowest, -1, axis)), lowest)
    return x[:, 1] + 0.5 * d < lowest[i, k] - deep * d


def depth_buffer(x, d, window, pixel):
    """Which grain is seen in each pixel (-1: none), and the surface height there [m].

    window = (x0, x1, z0, z1) [m]; rows run in z, columns in x.
    """
    columns = max(1, round((window[1] - window[0]) / pixel))
    rows = max(1, round((window[3] - window[2]) / pixel))
    height = np.zeros(rows * columns, np.float32)
    grain = np.full(rows * columns, -1, np.int32)
    order = np.argsort(x[:, 1])  # of two grains in a pixel the later, higher one is kept
    centre_i, centre_k = (x[order, 0] - window[0]) / pixel, (x[order, 2] - window[2]) / pixel
    y, radius = x[order, 1], 0.5 * d[order]
    reach = int(np.ceil(radius.max() / pixel)) if len(d) else 0
    first_i, first_k = np.floor(centre_i).astype(int), np.floor(centre_k).astype(int)
    for dk in range(-reach, reach + 1):
        for di in range(-reach, reach + 1):
            i, k = first_i + di, first_k + dk
            dome2 = radius**2 - ((i + 0.5 - centre_i)**2 + (k + 0.5 - centre_k)**2) * pixel**2
            seen = (dome2 > 0) & (i >= 0) & (i < columns) & (k >= 0) & (k < rows)
            place = k[seen] * columns + i[seen]
            surface = (y[seen] + np.sqrt(dome2[seen])).astype(np.float32)
            higher = surface > height[place]
            height[place[higher]] = surface[higher]
            grain[place[higher]] = order[seen][higher]
    return grain.reshape(rows, columns), height.reshape(rows, columns)


def by_height(x, d, top):
    """Colours (N, 3) of the grains from 0 to `top` [m] in the height map of the style."""
    return matplotlib.colormaps[HEIGHT_MAP](np.clip((x[:, 1] + 0.5 * d) / top, 0, 1))[:, :3]


def by_group(group):
    """Colours (N, 3) of grains by their kind, or by the heap that they came from."""
    return np.array([to_rgb(colour) for colour in GROUPS])[group % len(GROUPS)]


def top_view(grains, window, width, top, bodies=()):
    """RGB picture (rows, columns, 3), at most `width` columns, of the window = (x0, x1, z0, z1) [m].

    Coloured by kind or heap if there are several, else by height: colours run from 0 to `top` [m]. The first row is z0.
    Clumps are drawn as their spheres. Bodies are seen where no grain lies on them.
    """
    colours = by_height(grains.x, grains.d, top) if grains.group is None else by_group(grains.group)
    return coloured_view(grains, colours, window, width, bodies)


def coloured_view(grains, colours, window, width, bodies=()):
    """The same with a colour for each grain: colours (N, 3)."""
    x, d = grains.x, grains.d
    inside = ((x[:, 0] > window[0]) & (x[:, 0] < window[1]) & (x[:, 2] > window[2])
              & (x[:, 2] < window[3]))
    pixel = max((window[1] - window[0]) / width, (window[3] - window[2]) / MOST_ROWS)
    if not inside.any():
        picture = np.ones([max(1, round((high - low) / pixel)) for low, high in (window[2:], window[:2])] + [3])
        return with_bodies(picture, 0.0, bodies, window, 1)
    visible = inside.copy()
    visible[inside] = ~hidden(x[inside], d[inside], DEEP if grains.orientation is None else DEEP_CLUMPS)
    spheres = spheres_of(grains)
    drawn = visible[spheres.grain]
    x, d, colours = spheres.x[drawn], spheres.d[drawn], colours[spheres.grain[drawn]]
    # Finer than the grains, then averaged: smooth edges, at a bounded size.
    finer = int(np.clip(np.ceil(6 * pixel / np.median(d)), 2, 6))
    grain, height = depth_buffer(x, d, window, pixel / finer)
    picture = np.ones(grain.shape + (3,), np.float32)
    covered = grain >= 0
    picture[covered] = colours[grain[covered]] * shade(grain, height, x, d, window,
                                                       pixel / finer)[:, None]
    return block_mean(with_bodies(picture, height, bodies, window, finer), finer)


def with_bodies(picture, height, bodies, window, finer):
    """The picture (rows, columns, 3), with bodies where they are higher than `height` [m] (rows, columns)."""
    if not bodies:
        return picture
    rows, columns = picture.shape[:2]
    colour, top = seen_bodies(tuple(bodies), tuple(map(float, window)), -(-rows // finer), -(-columns // finer))
    colour, top = (np.repeat(np.repeat(each, finer, 0), finer, 1)[:rows, :columns] for each in (colour, top))
    return np.where((top > height)[..., None], colour, picture)


@lru_cache(maxsize=4)
def seen_bodies(bodies, window, rows, columns):
    """(colours (rows, columns, 3), heights (rows, columns) [m], 0 where no body is) of bodies from above."""
    x = window[0] + (window[1] - window[0]) * (np.arange(columns) + 0.5) / columns
    z = window[2] + (window[3] - window[2]) * (np.arange(rows) + 0.5) / rows
    top = tops(bodies, *np.meshgrid(x, z))
    slopes = [np.nan_to_num(each) for each in np.gradient(top, z, x)] if min(top.shape) > 1 else [0 * top, 0 * top]
    normal = np.stack([-slopes[1], np.ones_like(top), -slopes[0]], axis=-1)
    light = np.clip(normal @ (LIGHT / np.linalg.norm(LIGHT)) / np.linalg.norm(normal, axis=-1), 0, 1)
    return np.array(to_rgb(BODY)) * (0.6 + 0.5 * light[..., None]).clip(0, 1), np.nan_to_num(top)


def block_mean(picture, n):
    rows, columns = (n * (size // n) for size in picture.shape[:2])
    parts = [picture[k:rows:n, i:columns:n] for k in range(n) for i in range(n)]
    return sum(parts) / n**2


def shade(grain, height, x, d, window, pixel):
    """Diffuse light on the spheres, for the covered pixels in row order."""
    k, i = np.nonzero(grain >= 0)
    g = grain[k, i]
    radius = 0.5 * d[g]
    normal = np.stack([(window[0] + (i + 0.5) * pixel - x[g, 0]) / radius,
                       (height[k, i] - x[g, 1]) / radius,
                       (window[2] + (k + 0.5) * pixel - x[g, 2]) / radius], axis=1)
    return 0.5 + 0.5 * np.clip(normal @ (LIGHT / np.linalg.norm(LIGHT)), 0, 1)
