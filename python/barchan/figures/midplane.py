"""midplane: the flow in the vertical plane through the dune and its wake, and the grains cut by it.

The plane is that of the cells nearest to the dune's centroid (dune.csv, else the grains, else the
middle of the channel). Grains are those with centres within a diameter of it, drawn to scale.
Colour: streamwise velocity of the cell-centred fields; arrows: velocity in the plane; the line is
u = 0, the edge of the reversed flow behind the crest.
"""

import numpy as np
from matplotlib.collections import EllipseCollection
from matplotlib.lines import Line2D

from barchan.dune.bodies import bodies_of
from barchan.figures import bodies as body_pictures
from barchan.figures import style
from barchan.io.clumps import spheres_of

DARK = 0.5   # of the largest u: below it the colour is dark and arrows are white
CLEAR = 0.9  # void fraction above which the flow counts as water beside the bed


def draw(run, ax=None):
    frame = len(run.need_fields().frames) - 1
    time = run.field_file.frames[frame][0]
    grains = nearest_grains(run, time)
    if grains is not None and len(grains.d) == 0:
        grains = None
    flow = run.flow_plane(frame, plane_z(run, grains, time))
    view = (flow.x[0], flow.x[-1], flow.y[0], flow.y[-1]) if grains is None else dune_view(flow, grains)
    figure, ((axes,),) = style.panels(
        ax, figsize=(style.FULL_WIDTH, 0.9 + 6.4 * (view[3] - view[2]) / (view[1] - view[0])))
    axes.set(xlim=1e3 * np.array(view[:2]), ylim=1e3 * np.array(view[2:]))
    image = draw_flow(axes, flow, *velocity_range(flow, view))
    body_pictures.draw_section(axes, bodies_of(run), flow.z)
    if grains is not None:
        draw_grains(axes, grains, flow.z)
    axes.set(aspect="equal", xlabel="$x$ (mm)", ylabel="$y$ (mm)")
    axes.set_title(f"$t$ = {flow.time:.3g} s,  $z$ = {1e3 * flow.z:.3g} mm", pad=3)
    if has_reversed_flow(flow):
        style.legend_above(axes, [Line2D([], [], color=style.VERMILLION, lw=1.0, label="$u$ = 0")])
    bar = figure.colorbar(image, ax=axes, location="bottom", shrink=0.45, aspect=35, pad=0.02)
    bar.set_label("streamwise velocity $u$ (m/s)")
    bar.outline.set_linewidth(0.6)
    return figure


def velocity_range(flow, view):
    """Least (or zero) and largest u that is seen."""
    seen = flow.u[np.ix_(flow.y <= view[3], (flow.x >= view[0]) & (flow.x <= view[1]))]
    return min(0.0, float(np.nanmin(seen))), float(np.nanmax(seen))


def nearest_grains(run, time):
    if run.grain_file is None:
        return None
    return run.frame(int(np.argmin(abs(run.grain_file.times - time))))


def plane_z(run, grains, time):
    if run.dune_columns is not None:
        dune = run.main_dune_columns
        if abs(dune["t"] - time).min() < 1.0:
            z = dune["Cz"][np.argmin(abs(dune["t"] - time))]
            return z % run.domain[2] if run.domain else z
    if grains is not None and len(grains.d):
        return float(np.average(grains.x[:, 2], weights=grains.d**3))
    with run.field_file.open() as file:
        return float(file["grid/z_face"][:].mean())


def dune_view(flow, grains):
    """(x0, x1, y0, y1) [m]: the dune and its wake."""
    upstream, downstream = np.percentile(grains.x[:, 0], [0.5, 97.0])
    length = downstream - upstream
    height = np.percentile(grains.x[:, 1] + 0.5 * grains.d, 99.8)
    x0 = max(flow.x[0], upstream - 0.25 * length)
    x1 = min(flow.x[-1], downstream + 0.6 * length)
    return x0, x1, 0.0, min(flow.y[-1], max(2.2 * height, 0.16 * (x1 - x0)))


def draw_flow(axes, flow, bottom, top):
    image = axes.pcolormesh(1e3 * flow.x, 1e3 * flow.y, flow.u, vmin=bottom, vmax=top,
                            cmap=style.VELOCITY_MAP, shading="gouraud", rasterized=True)
    if has_reversed_flow(flow):
        axes.contour(1e3 * flow.x, 1e3 * flow.y[1:], water(flow), [0.0], colors=style.VERMILLION,
                     linewidths=1.0)
    x0, x1 = axes.get_xlim()
    y0, y1 = axes.get_ylim()
    across, up = 26, max(4, int(round(26 * (y1 - y0) / (x1 - x0))))
    x = 1e-3 * (x0 + (x1 - x0) * (np.arange(across) + 0.5) / across)
    y = 1e-3 * (y0 + (y1 - y0) * (np.arange(up) + 0.5) / up)
    u, v = (resample(flow, field, x, y) for field in (flow.u, flow.v))
    color = np.where(u < DARK * top, "white", "black").ravel()
    axes.quiver(1e3 * x, 1e3 * y, u, v, color=color, width=0.0013, headwidth=4,
                headlength=4.5, headaxislength=4, scale=across * 1.15 * top, scale_units="width",
                minlength=0.3)
    return image


def water(flow):
    """u beside the bed, less the row on the wall."""
    return np.ma.masked_where(flow.alpha_f < CLEAR, flow.u)[1:]


def has_reversed_flow(flow):
    u = water(flow)
    return bool(u.min() < 0.0 < u.max())


def resample(flow, field, x, y):
    """Linear interpolation of a plane (ny, nx) to the lattice x, y [m]; (len(y), len(x))."""
    along = np.array([np.interp(x, flow.x, row) for row in field])
    return np.array([np.interp(y, flow.y, column) for column in along.T]).T


def draw_grains(axes, grains, z):
    spheres = spheres_of(grains)
    distance = abs(spheres.x[:, 2] - z)
    near = np.argsort(-distance)  # the nearest on top
    near = near[distance[near] < spheres.d[near]]
    size = 1e3 * spheres.d[near]
    axes.add_collection(EllipseCollection(
        size, size, np.zeros(size.size), units="xy", offsets=1e3 * spheres.x[near, :2],
        offset_transform=axes.transData, facecolor=style.SAND, edgecolor=style.SAND_EDGE,
        linewidth=0.25), autolim=False)
