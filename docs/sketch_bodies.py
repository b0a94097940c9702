"""The shapes of [[body]] from the side and from above, with the keys that make them (sketch-bodies.svg)."""

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from sketch_parts import arrow, distance, frame, s, wall

from barchan.dune.bodies import Body

DOMAIN = (10.0, 6.0, 6.0)
MIDDLE = (5.0, 3.0)
SHAPES = (
    ('"cylinder"', Body(0, "", "cylinder", DOMAIN, MIDDLE, radius=1.0, height=2.4)),
    ('"cylinder", axis = "z"', Body(0, "", "cylinder", DOMAIN, MIDDLE, base=0.6, axis="z", radius=0.9, length=4.0)),
    ('"sphere"', Body(0, "", "sphere", DOMAIN, MIDDLE, base=0.5, radius=1.1)),
    ('"half_sphere"', Body(0, "", "half_sphere", DOMAIN, MIDDLE, radius=1.6)),
    ('"box"', Body(0, "", "box", DOMAIN, MIDDLE, height=1.6, size=(4.0, 2.0), angle=0.45)),
    ('"fence"', Body(0, "", "fence", DOMAIN, MIDDLE, radius=0.28, height=2.0, length=4.0, spacing=1.0)),
    ('"dune"', Body(0, "", "dune", DOMAIN, (5.6, 3.0), height=1.7, size=(6.0, 4.4), lee=2.0)),
    ('"wave"', Body(0, "", "wave", DOMAIN, (2.5, 0.0), height=1.6, wavelength=5.0)),
)
UP, ACROSS = 3.4, 6.0  # of the panels


def outline(ax, points):
    ax.add_patch(Polygon(points, closed=True, fc=s.BODY, ec=s.BODY_EDGE, lw=0.8, zorder=3))


def key(ax, start, end, text, offset):
    distance(ax, start, end, text, offset, fontsize=6, family="monospace", zorder=9)


def draw_side(ax, body):
    frame(ax, (0, DOMAIN[0]), (-0.5, UP))
    wall(ax, 0, DOMAIN[0], 0, 0.35)
    for points in body.section(body.heart[1]):
        outline(ax, points)
    arrow(ax, (0.2, 2.9), (1.5, 2.9), s.BLUE, lw=1.2)
    x0, x1, _, _ = body.reach
    if body.base > 0:
        key(ax, (x1 + 0.35, 0), (x1 + 0.35, body.base), "base", (0.95, 0))
    if body.form in ("cylinder", "box", "fence", "dune"):
        x = x1 + 0.35
        key(ax, (x, 0), (x, body.height), "height", (1.15, 0))
    if body.form == "wave":
        key(ax, (5.0, 0), (5.0, body.height), "height", (0, 1.1))
        key(ax, (2.5, 2.5), (7.5, 2.5), "wavelength", (0, 0.4))
    if body.form in ("sphere", "half_sphere", "cylinder_z"):
        y = body.base + (0.0 if body.form == "half_sphere" else body.radius)
        tip = np.array((body.centre[0], y)) + body.radius * np.array((-0.77, 0.64))
        arrow(ax, (body.centre[0], y), tip, lw=0.8, mutation_scale=7)
        ax.text(tip[0] - 0.15, tip[1] + 0.2, "radius", ha="right", va="bottom", fontsize=6, family="monospace")
    if body.form == "dune":
        key(ax, (body.centre[0], 2.0), (x1, 2.0), "lee", (0, 0.4))


def draw_plan(ax, body):
    frame(ax, (0, DOMAIN[0]), (ACROSS, 0))
    ax.add_patch(Polygon([(0, 0), (10, 0), (10, 6), (0, 6)], fc="none", ec="#B5B5B5", lw=0.6))
    for points in body.plan(0.5 * body.height if body.form == "wave" else None):
        outline(ax, points)
    x, z = body.centre
    if body.form != "wave":
        ax.plot(x, z, "+", color=s.VERMILLION, ms=5, zorder=8)
    if body.form == "cylinder":
        arrow(ax, (x, z), (x - 0.71 * body.radius, z - 0.71 * body.radius), lw=0.8, mutation_scale=7)
        ax.text(x - 0.9, z - 0.9, "radius", ha="right", va="bottom", fontsize=6, family="monospace")
    if body.form == "cylinder_z":
        key(ax, (7.0, 1.0), (7.0, 5.0), "length", (1.15, 0))
    if body.form == "fence":
        key(ax, (6.0, 1.0), (6.0, 5.0), "length", (1.15, 0))
        key(ax, (4.2, 2.0), (4.2, 3.0), "spacing", (-1.35, 0))
    if body.form == "dune":
        key(ax, (1.6, 5.6), (7.6, 5.6), "size[0]", (2.6 - 4.35, -0.35))
        key(ax, (8.0, 0.8), (8.0, 5.2), "size[1]", (1.05, 1.7))
    if body.form == "box":
        along, across = (np.array((np.cos(body.angle), np.sin(body.angle))),
                         np.array((-np.sin(body.angle), np.cos(body.angle))))
        a, b = (np.array(MIDDLE) + sign * 2 * along - 1.35 * across for sign in (-1, 1))
        key(ax, a, b, "size[0]", (1.0, -0.65))
        a, b = (np.array(MIDDLE) + 2.35 * along + sign * across for sign in (-1, 1))
        key(ax, a, b, "size[1]", (1.0, 0.35))
        ax.plot([5, 8.6], [3, 3], color=s.BLACK, lw=0.5, ls=":", zorder=8)
        ax.text(8.6, 2.9, "angle", ha="right", va="bottom", fontsize=6, family="monospace", zorder=9)


def draw():
    figure = Figure(figsize=(s.FULL_WIDTH, 4.3), layout="none")
    for index, (name, body) in enumerate(SHAPES):
        left, low = 0.005 + 0.2485 * (index % 4), 0.51 - 0.5 * (index // 4)
        side, plan = figure.add_axes((left, low + 0.28, 0.24, 0.165)), figure.add_axes((left, low + 0.005, 0.24, 0.265))
        draw_side(side, body)
        draw_plan(plan, body)
        side.set_title(name, fontsize=6.5, family="monospace", pad=2)
        if index == 0:
            side.text(9.9, 3.3, "from the side", ha="right", va="top", fontsize=6)
            plan.text(9.9, 5.9, "from above", ha="right", va="bottom", fontsize=6)
            plan.annotate("centre", MIDDLE, xytext=(6.4, 4.4), fontsize=6, family="monospace", color=s.VERMILLION,
                          arrowprops={"arrowstyle": "-", "lw": 0.5, "color": s.VERMILLION})
    return figure
