"""bedload: solid fraction, velocity and flux of the grains over height, the fluctuation energy that their shear makes,
and the stress; from bedload.csv. The dashed line is the surface of the bed, where that production is largest.

Paehtz & Duran, Phys. Rev. Fluids 3, 104302 (2018); Paehtz et al., arXiv:2404.07689.
"""

import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep

MARGIN = 3.0  # diameters shown above the highest grain


def draw(run, ax=None):
    table = run.bed_load_columns
    if not table or len(table["y"]) < 2:
        raise MissingData("needs bedload.csv: statistics.bed_load = true")
    d = table["d"][0]
    height, surface = table["y"] / d, table["bed_surface"][0] / d
    curves = {"height": height, "solid_fraction": table["solid_fraction"], "velocity": table["grain_velocity"],
              "flux_density": table["flux_density"], "production": table["production"],
              "stress": table["total_stress"], "pressure": table["particle_pressure"]}
    figure, (panels,) = style.panels(ax, 1, 4, figsize=(style.FULL_WIDTH, 2.9))
    filled = curves["solid_fraction"] > 0
    panels[0].plot(curves["solid_fraction"], height, color=style.SAND_EDGE)
    panels[0].set(xlabel="solid fraction", ylabel="$y / d$", xlim=(0, None))
    panels[1].plot(curves["velocity"][filled], height[filled], color=style.BLUE, label="grains")
    panels[1].plot(curves["flux_density"][filled], height[filled], color=style.ORANGE, label="$\\phi v_x$")
    panels[1].set(xlabel="velocity (m/s)")
    panels[2].plot(curves["production"][filled], height[filled], color=style.VERMILLION)
    panels[2].set(xlabel="$P\\,dv_x/dy$ (W/m$^3$)")
    panels[3].plot(curves["stress"], height, color=style.BLACK, label="stress")
    panels[3].plot(curves["pressure"], height, color=style.GREEN, label="$P$ of the grains")
    panels[3].set(xlabel="(Pa)")
    top = min(height[-1], (height[filled][-1] if np.any(filled) else 0) + MARGIN)
    for index, axes in enumerate(panels):
        axes.set_ylim(0, top)
        if np.isfinite(surface):
            axes.axhline(surface, color="0.4", lw=0.8, ls="--")
        style.panel_label(axes, index)
    for axes in (panels[1], panels[3]):
        axes.legend(loc="upper right", fontsize=6)
    if np.isfinite(surface):
        figure.suptitle(f"Shields {table['shields'][0]:.3g}, $q^*$ {table['q_star'][0]:.3g}", fontsize=7.5, x=0.995,
                        ha="right")
    keep(figure, "bedload", curves)
    return figure
