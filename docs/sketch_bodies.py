"""The shapes of [[body]] from the side and from above, with the keys that make them (sketch-bodies.svg)."""

import tempfile
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Polygon
from sketch_parts import arrow, distance, frame, s, wall

import barchan
from barchan.dune.bodies import bodies_of

DOMAIN = (10.0, 6.0, 6.0)
MIDDLE = (5.0, 3.0)
ANGLE = 0.45  # of the box
CASE = """[time]
end = 1e-3
fluid_step = 1e-3
[domain]
size = [10, 6, 6]
[fluid]
cells = [8, 8, 8]
mean_velocity = 0.1
"""
SHAPES = {
    '"cylinder"': 'shape = "cylinder"\ncentre = [5, 3]\nradius = 1\nheight = 2.4',
    '"cylinder", axis = "z"': 'shape = "cylinder"\ncentre = [5, 3]\nbase = 0.6\naxis = "z"\nradius = 0.9\nlength = 4',
    '"sphere"': 'shape = "sphere"\ncentre = [5, 3]\nbase = 0.5\nradius = 1.1',
    '"half_sphere"': 'shape = "half_sphere"\ncentre = [5, 3]\nradius = 1.6',
    '"box"': f'shape = "box"\ncentre = [5, 3]\nheight = 1.6\nsize = [4, 2]\nangle = {ANGLE}',
    '"fence"': 'shape = "fence"\ncentre = [5, 3]\nradius = 0.28\nheight = 2\nlength = 4\nspacing = 1',
    '"dune"': 'shape = "dune"\ncentre = [5.6, 3]\nheight = 1.7\nsize = [6, 4.4]\nlee = 2',
    '"wave"': 'shape = "wave"\ncentre = [2.5, 0]\nheight = 1.6\nwavelength = 5',
}
UP, ACROSS = 3.4, 6.0  # of the panels


def surveyed():
    """The shapes, as the program finds their surfaces."""
    with tempfile.TemporaryDirectory() as folder:
        case = Path(folder) / "bodies.toml"
        case.write_text(CASE + "".join(f'[[body]]\nname = "{number}"\n{keys}\n'
                                       for number, keys in enumerate(SHAPES.values())))
        return bodies_of(barchan.run(case, out=Path(folder) / "run", quiet=True))


def outline(ax, points):
    ax.add_patch(Polygon(points, closed=True, fc=s.BODY, ec=s.BODY_EDGE, lw=0.8, zorder=3))


def form_of(body):
    return body.shape if body.axis == "y" else f"{body.shape}_{body.axis}"


def key(ax, start, end, text, offset):
    distance(ax, start, end, text, offset, fontsize=6, family="monospace", zorder=9)


def draw_side(ax, body):
    form = form_of(body)
    frame(ax, (0, DOMAIN[0]), (-0.5, UP))
    wall(ax, 0, DOMAIN[0], 0, 0.35)
    for points in body.section(body.heart[1]):
        outline(ax, points)
    arrow(ax, (0.2, 2.9), (1.5, 2.9), s.BLUE, lw=1.2)
    x0, x1, _, _ = body.reach
    if body.base > 0:
        key(ax, (x1 + 0.35, 0), (x1 + 0.35, body.base), "base", (0.95, 0))
    if form in ("cylinder", "box", "fence", "dune"):
        x = x1 + 0.35
        key(ax, (x, 0), (x, body.height), "height", (1.15, 0))
    if form == "wave":
        key(ax, (5.0, 0), (5.0, body.height), "height", (0, 1.1))
        key(ax, (2.5, 2.5), (7.5, 2.5), "wavelength", (0, 0.4))
    if form in ("sphere", "half_sphere", "cylinder_z"):
        y = body.base + (0.0 if form == "half_sphere" else body.radius)
        tip = np.array((body.centre[0], y)) + body.radius * np.array((-0.77, 0.64))
        arrow(ax, (body.centre[0], y), tip, lw=0.8, mutation_scale=7)
        ax.text(tip[0] - 0.15, tip[1] + 0.2, "radius", ha="right", va="bottom", fontsize=6, family="monospace")
    if form == "dune":
        key(ax, (body.centre[0], 2.0), (x1, 2.0), "lee", (0, 0.4))


def draw_plan(ax, body):
    form = form_of(body)
    frame(ax, (0, DOMAIN[0]), (ACROSS, 0))
    ax.add_patch(Polygon([(0, 0), (10, 0), (10, 6), (0, 6)], fc="none", ec="#B5B5B5", lw=0.6))
    for points in body.plan():
        outline(ax, points)
    x, z = body.centre
    if form != "wave":
        ax.plot(x, z, "+", color=s.VERMILLION, ms=5, zorder=8)
    if form == "cylinder":
        arrow(ax, (x, z), (x - 0.71 * body.radius, z - 0.71 * body.radius), lw=0.8, mutation_scale=7)
        ax.text(x - 0.9, z - 0.9, "radius", ha="right", va="bottom", fontsize=6, family="monospace")
    if form == "cylinder_z":
        key(ax, (7.0, 1.0), (7.0, 5.0), "length", (1.15, 0))
    if form == "fence":
        key(ax, (6.0, 1.0), (6.0, 5.0), "length", (1.15, 0))
        key(ax, (4.2, 2.0), (4.2, 3.0), "spacing", (-1.35, 0))
    if form == "dune":
        key(ax, (1.6, 5.6), (7.6, 5.6), "size[0]", (2.6 - 4.35, -0.35))
        key(ax, (8.0, 0.8), (8.0, 5.2), "size[1]", (1.05, 1.7))
    if form == "box":
        along, across = (np.array((np.cos(ANGLE), np.sin(ANGLE))),
                         np.array((-np.sin(ANGLE), np.cos(ANGLE))))
        a, b = (np.array(MIDDLE) + sign * 2 * along - 1.35 * across for sign in (-1, 1))
        key(ax, a, b, "size[0]", (1.0, -0.65))
        a, b = (np.array(MIDDLE) + 2.35 * along + sign * across for sign in (-1, 1))
        key(ax, a, b, "size[1]", (1.0, 0.35))
        ax.plot([5, 8.6], [3, 3], color=s.BLACK, lw=0.5, ls=":", zorder=8)
        ax.text(8.6, 2.9, "angle", ha="right", va="bottom", fontsize=6, family="monospace", zorder=9)


def draw():
    figure = Figure(figsize=(s.FULL_WIDTH, 4.3), layout="none")
    for index, (name, body) in enumerate(zip(SHAPES, surveyed())):
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
