"""profiles_over_dune: time-averaged flow over a frozen dune in its vertical plane of symmetry.

As Fig. 3 of Lima et al. (2022): (a) the stations on the outline of the dune, x from its upstream foot
over its length L along the centreline; (b) to (f) mean velocities and second moments at the stations
against the displaced height y_d = y - h(x) (Eq. 14), over the channel's half height delta = L_y.

u and the moments are in streamline axes: along and across the local mean velocity in the plane. Across
it the mean velocity is zero, so (c) shows the vertical component. U_delta is the mean velocity at
y = delta, u_* the wall's friction velocity (flow_average.py). The paper's text does not give its
stations; these span the dune from its foot to its wake.
"""

import matplotlib
import numpy as np
from matplotlib.figure import Figure
from matplotlib.ticker import MaxNLocator

from barchan.dune.outline import main_outline
from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep
from barchan.io.flow_average import FlowAverage
from barchan.io.study_folder import plain
from barchan.flow.over_dune import friction_velocity, profiles_at

STATIONS = (0.0, 0.25, 0.5, 0.75, 1.15)  # x / L
LEAST = 2e-3                             # lowest y_d / delta drawn
STILL = 0.01                             # of U_delta: slower water has no direction
PANELS = (("u", "$\\overline{u} / U_\\delta$"), ("v", "$\\overline{v} / U_\\delta$"),
          ("uu", "$\\overline{u'u'} / u_*^2$"), ("vv", "$\\overline{v'v'} / u_*^2$"),
          ("uv", "$-\\overline{u'v'} / u_*^2$"))
MARKERS = "osD^v"


def draw(run, ax=None):
    style.own_page(ax)
    average = FlowAverage(run)
    run.need_grains()
    if run.domain is None:
        raise MissingData("needs config.toml with domain.size")
    outline = main_outline(run)
    scales = {"delta": run.domain[1], "U_delta": average.top, "u_star": friction_velocity(run, average)}
    if not (scales["U_delta"] > 0.0 and scales["u_star"] > 0.0):
        raise MissingData("needs a mean flow along +x")
    profiles = profiles_at(average, outline, np.array(STATIONS))
    figure = draw_figure(run, average, outline, profiles, scales)
    keep(figure, "profiles_over_dune", scaled_table(profiles, scales))
    return figure


def looks(count):
    shades = np.linspace(0.0, 0.86, count)
    return list(zip(matplotlib.colormaps["viridis"](shades), MARKERS))


def scaled(profile, name, scales):
    if name in ("u", "v"):
        return profile[name] / scales["U_delta"]
    return (-1.0 if name == "uv" else 1.0) * profile[name] / scales["u_star"]**2


def draw_figure(run, average, outline, profiles, scales):
    figure = Figure(figsize=(style.FULL_WIDTH, 4.6))
    outline_axes, *panels = figure.subplot_mosaic([["a"] * 5, list("bcdef")],
                                                  height_ratios=[0.62, 1.0]).values()
    draw_outline(outline_axes, outline, profiles, scales)
    for axes, (name, label) in zip(panels, PANELS):
        axes.axvline(0.0, color="0.75", lw=0.6)
        for profile, (colour, marker) in zip(profiles, looks(len(profiles))):
            height = profile["y_d"] / scales["delta"]
            seen = height > LEAST
            axes.plot(scaled(profile, name, scales)[seen], height[seen], color=colour, marker=marker,
                      ms=2.8, lw=0.8, mfc="white", mew=0.7,
                      label=f"$x/L$ = {profile['station']:g}")
        axes.set(yscale="log", ylim=(LEAST, 1.0), xlabel=label)
        axes.margins(x=0.08)
        axes.tick_params(labelleft=axes is panels[0])
        axes.xaxis.set_major_locator(MaxNLocator(3, steps=[1, 2, 5, 10]))
    panels[0].set_ylabel("$y_d / \\delta$")
    for index, axes in enumerate([outline_axes, *panels]):
        style.panel_label(axes, index)
    handles, _ = panels[0].get_legend_handles_labels()
    style.legend_outside(figure, handles, -0.25, ncols=len(handles))
    outline_axes.set_title(
        f"{plain(run.title)}: mean of {average.start:.3g} s to {average.end:.3g} s, $U_\\delta$ = "
        f"{scales['U_delta']:.3g} m/s, $u_*$ = {1e3 * scales['u_star']:.3g} mm/s, "
        f"$L$ = {1e3 * outline.length:.3g} mm", fontsize=7.5, pad=4)
    return figure


def draw_outline(axes, outline, profiles, scales):
    """True to scale; a vertical line per station, as high as it takes to see it."""
    x, y = (outline.x - outline.foot) / outline.length, outline.h / outline.length
    axes.fill_between(x, y, color=style.SAND, lw=0)
    axes.plot(x, y, color=style.SAND_EDGE, lw=0.9)
    top = max(1.6 * y.max(), 0.16)
    for profile, (colour, marker) in zip(profiles, looks(len(profiles))):
        axes.plot([profile["station"]] * 2, [profile["h"] / outline.length, top], color=colour, lw=1.0)
        axes.plot([profile["station"]], [top], marker=marker, color=colour, mfc="white", mew=0.9, ms=4.5)
    axes.set(aspect="equal", xlim=(-0.2, 1.35), ylim=(0, 1.25 * top), xlabel="$x/L$", ylabel="$y/L$")
    axes.locator_params(axis="y", nbins=4)
    axes.annotate("", xy=(-0.07, 0.8 * top), xytext=(-0.17, 0.8 * top),
                  arrowprops={"arrowstyle": "-|>", "color": style.BLACK, "shrinkA": 0, "shrinkB": 0})


def scaled_table(profiles, scales):
    """SI with the station; and the scaled values as drawn."""
    columns = {"x_over_L": "station", "x_m": "x", "z_m": "z", "h_m": "h", "y_d_m": "y_d",
               "angle_rad": "angle", "u_m_s": "u", "v_vertical_m_s": "v",
               "uu_m2_s2": "uu", "vv_m2_s2": "vv", "uv_m2_s2": "uv"}
    counts = [len(profile["y_d"]) for profile in profiles]
    table = {name: np.concatenate([np.broadcast_to(profile[key], count)
                                   for profile, count in zip(profiles, counts)])
             for name, key in columns.items()}
    table["y_d_over_delta"] = table["y_d_m"] / scales["delta"]
    for name, _ in PANELS:
        sign = "minus_" if name == "uv" else ""
        scale = "U_delta" if name in ("u", "v") else "u_star2"
        table[f"{sign}{name}_over_{scale}"] = np.concatenate(
            [scaled(profile, name, scales) for profile in profiles])
    return table
