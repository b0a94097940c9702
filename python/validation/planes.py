"""Planes of a flow: its speed, and streamlines over it."""

import numpy as np

from barchan.figures import style


def draw(axes, x, y, u, v, points=(61, 101), **options):
    """The speed on axes x and y (u, v of shape (y, x)), and streamlines on so many points along each; the image."""
    image = axes.pcolormesh(x, y, np.hypot(u, v), cmap=style.VELOCITY_MAP, shading="gouraud", rasterized=True,
                            vmin=0, vmax=options.pop("largest", None))
    even = [np.linspace(known[0], known[-1], n) for known, n in zip((x, y), points)]
    at = np.ix_(*(np.searchsorted(known, line).clip(0, len(known) - 1) for known, line in zip((y, x), even[::-1])))
    axes.streamplot(*even, u[at], v[at], color="w", linewidth=0.4, arrowsize=0.5, **options)
    axes.set(aspect="equal", xlim=(0, x[-1]), ylim=(y[0], y[-1]), xlabel="$x/d$")
    return image
