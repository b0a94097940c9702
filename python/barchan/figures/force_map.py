"""force_map: mean resultant force on the grains about the dune's centroid (as Fig. 13 of Lima et al. 2022).

(a) along the flow, (b) across it, positive to the right; seen from above, flow from left to right.
Grey is zero. White is no data, or too few samples: a bin with fewer samples per area than FEWEST of the densest bin's
is not drawn, since only single grains pass there (the numbers keep it). The line is where the dune lies half of the
time.
"""

import numpy as np
from contourpy import contour_generator
from matplotlib.patheffects import withStroke

from barchan.dune import forces as force_average
from barchan.errors import BarchanError
from barchan.figures import style
from barchan.figures.result import keep

FINEST = 2.5  # [degrees] of the quadrilaterals that make up a bin, so that its arcs are round
FEWEST = 0.02  # share of the most samples per area of a bin, below which a bin is not drawn


def draw(run, ax=None, start=None, end=None):
    """`ax`: two polar axes."""
    forces = force_average.read(run, start, end)
    shape = find_outline(run, forces)
    shown = well_sampled(forces.bins)
    figure, ((*panels,),) = style.panels(ax, 1, 2, figsize=(style.FULL_WIDTH, 3.6),
                                         subplot_kw={"projection": "polar"})
    for index, (axes, name, label) in enumerate(zip(panels, ("F_x", "F_z"), ("$F_x$ (N)", "$F_z$ (N)"))):
        image = draw_component(axes, shown, name)
        if shape is not None:
            draw_outline(axes, *shape)
        bar = figure.colorbar(image, ax=axes, location="bottom", shrink=0.75, aspect=25, pad=0.06,
                              extend="both")
        bar.set_label(label)
        bar.formatter.set_powerlimits((0, 0))
        bar.outline.set_linewidth(0.6)
        axes.text(-0.12, 1.08, f"({chr(ord('a') + index)})", transform=axes.transAxes)
    style.flow_arrow(panels[0], -0.12, 0.96)
    figure.suptitle(forces.caption, fontsize=7.5, x=0.995, ha="right")
    keep(figure, "force_map", forces.bins, most=None)
    return figure


def find_outline(run, forces):
    """As force_average.outline; a run without grain frames has none."""
    try:
        return force_average.outline(run, forces.start, forces.end)
    except BarchanError:
        return None


def well_sampled(bins):
    """The bins with enough samples to be drawn."""
    area = (bins["r_max"]**2 - bins["r_min"]**2) * (bins["phi_max"] - bins["phi_min"])
    density = bins["n"] / area
    enough = density >= FEWEST * density.max()
    return {name: values[enough] for name, values in bins.items()}


def grid(bins, name):
    """phi (p + 1) [radians], r (r + 1) [mm], values (r, p) of a column, masked where no bin is."""
    r, phi = (np.unique(np.concatenate([bins[f"{key}_min"], bins[f"{key}_max"]])) for key in ("r", "phi"))
    parts = max(1, round(np.diff(phi).max() / FINEST))
    values = np.full((len(r) - 1, len(phi) - 1), np.nan)
    rows = [[np.searchsorted(edges, bins[f"{key}_{end}"]) for end in ("min", "max")]
            for key, edges in (("r", r), ("phi", phi))]
    for (r0, r1, p0, p1), value in zip(np.transpose([*rows[0], *rows[1]]), bins[name]):
        values[r0:r1, p0:p1] = value
    finer = np.concatenate([low + (high - low) * np.arange(parts) / parts
                            for low, high in zip(phi, phi[1:])] + [phi[-1:]])
    return np.radians(finer), 1e3 * r, np.ma.masked_invalid(np.repeat(values, parts, axis=1))


def strongest(bins, name):
    """The end of the colour scale [N]: 98 % of the samples are within it."""
    order = np.argsort(abs(bins[name]))
    samples = np.cumsum(bins["n"][order])
    limit = abs(bins[name][order][np.searchsorted(samples, 0.98 * samples[-1])])
    return limit or 1e-12


def draw_component(axes, bins, name):
    phi, r, values = grid(bins, name)
    limit = strongest(bins, name)
    image = axes.pcolormesh(phi, r, values, cmap=style.FORCE_MAP, vmin=-limit, vmax=limit, rasterized=True)
    axes.set_xticks(np.radians(np.arange(0, 360, 30)))
    axes.set_rlabel_position(225)
    axes.set_yticks(style.round_length(r[-1] / 2) * np.arange(1, 10), minor=False)
    axes.set_ylim(0, r[-1])
    axes.set_yticklabels([f"{tick:g} mm" if tick < r[-1] else "" for tick in axes.get_yticks()])
    for text in axes.get_yticklabels():
        text.set(ha="center", va="center", path_effects=[withStroke(linewidth=2.0, foreground="white")])
    axes.tick_params(labelsize=7.5, pad=0)
    axes.grid(lw=0.4, color="0.35", alpha=0.35)
    return image


def draw_outline(axes, x, z, share):
    for points in contour_generator(x, z, share.T).lines(0.5):
        axes.plot(np.arctan2(-points[:, 1], points[:, 0]), 1e3 * np.hypot(*points.T),
                  color=style.BLACK, lw=0.9)
