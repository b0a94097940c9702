"""Bodies in pictures: their outlines from above and in a vertical plane, in mm."""

from matplotlib.patches import Polygon

from barchan.figures import style
from barchan.io.study_folder import plain


def in_window(window, bodies):
    """(x0, x1, z0, z1) [m] that holds the bodies too, but for those through the whole domain."""
    x0, x1, z0, z1 = window
    for body in bodies:
        a, b, c, d = body.reach
        margin = 0.1 * body.unit[0]
        if b - a < body.domain[0]:
            x0, x1 = min(x0, max(0.0, a - margin)), max(x1, min(body.domain[0], b + margin))
        if d - c < body.domain[2]:
            z0, z1 = min(z0, max(0.0, c - margin)), max(z1, min(body.domain[2], d + margin))
    return x0, x1, z0, z1


def draw_plan(axes, bodies, named=False, **options):
    """Outlines from above where they are widest, with names beside them if there are several and `named`."""
    for body in bodies:
        for outline in body.plan():
            patch(axes, outline, **{"fill": False} | options)
        if named and len(bodies) > 1:
            x0, x1, z0, _ = body.reach
            x, shift, side = 0.5 * (x0 + x1), (0, 2), "center"
            if x1 > 0.9 * body.domain[0]:  # else the name would run out of the picture
                x, shift, side = x0, (-3, -8), "right"
            axes.annotate(plain(body.name), (1e3 * x, 1e3 * z0), xytext=shift, textcoords="offset points", ha=side,
                          va="bottom", fontsize=7, color=style.BODY_EDGE)


def draw_section(axes, bodies, z, shift=0.0, **options):
    """Bodies cut by the vertical plane z = `z` [m], moved along x by `shift` [m]."""
    for body in bodies:
        for outline in body.section(z):
            patch(axes, outline + (shift, 0.0), **options)


def patch(axes, outline, **options):
    """An outline (n, 2) [m]."""
    look = {"fc": style.BODY, "ec": style.BODY_EDGE, "lw": 0.7, "zorder": 2.6} | options
    axes.add_patch(Polygon(1e3 * outline, closed=True, **look))
