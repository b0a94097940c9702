#!/usr/bin/python3
"""Draws the sketches of the theory pages: sketch-domain, sketch-dune, sketch-exchange, sketch-forces (.png in docs/).

Nothing here is a result: shapes are made up. In the sketch of the exchange the shares and the lengths of the arrows
follow from the formulas of docs/theory-coupling.md. usage: python3 docs/sketches.py [NAME ...]
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, FancyArrowPatch, Polygon, Rectangle

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parent / "python"))
from barchan.figures import style as s  # noqa: E402  (found by the line above)

WATER, PALE, LINE = s.BLUE, "#DCEBF5", "#B5B5B5"
LARGEST = 150_000  # [bytes] of a picture


# --- what all sketches draw -------------------------------------------------------------------------------------------

def arrow(ax, start, end, colour=s.BLACK, **options):
    """An arrow from start to end in the units of the axes."""
    look = {"arrowstyle": "-|>", "mutation_scale": 9, "lw": 1.3, "shrinkA": 0, "shrinkB": 0, "zorder": 6} | options
    ax.add_patch(FancyArrowPatch(start, end, color=colour, **look))


def distance(ax, start, end, text, offset=(0, 0), colour=s.BLACK, **options):
    """A dimension line with arrows at both ends and its name at the middle, moved by `offset`."""
    arrow(ax, start, end, colour, arrowstyle="<|-|>", lw=0.8, mutation_scale=7)
    middle = [(a + b) / 2 + shift for a, b, shift in zip(start, end, offset)]
    ax.text(*middle, text, color=colour, **({"ha": "center", "va": "center"} | options))


def note(ax, text, at, to, colour=s.BLACK, **options):
    """A text with a thin line to what it names."""
    look = {"ha": "center", "va": "center", "fontsize": 7.5} | options
    line = {"arrowstyle": "-", "lw": 0.6, "color": colour, "shrinkA": 1, "shrinkB": 0}
    ax.annotate(text, xy=to, xytext=at, color=colour, arrowprops=line, zorder=8, **look)


def sphere(ax, centre, radius, face=s.SAND, **options):
    ax.add_patch(Circle(centre, radius, **({"fc": face, "ec": s.SAND_EDGE, "lw": 0.6, "zorder": 3} | options)))


def wall(ax, left, right, y, thickness):
    """A solid wall below y."""
    ax.add_patch(Rectangle((left, y - thickness), right - left, thickness, fc="#E4E4E4", ec="none", zorder=1))
    ax.plot([left, right], [y, y], color=s.BLACK, lw=1.4, zorder=5)


def frame(ax, x, y):
    """Axes of equal scale without ticks or frame."""
    ax.set(xlim=x, ylim=y, aspect="equal")
    ax.axis("off")


def directions(ax, corner, length, upwards="y", outwards="z"):
    """The axes in the plane of the picture, and the one that points out of it."""
    x, y = corner
    arrow(ax, corner, (x + length, y), lw=1, mutation_scale=7)
    arrow(ax, corner, (x, y + length), lw=1, mutation_scale=7)
    ax.text(x + 1.12 * length, y, "$x$", ha="left", va="center")
    ax.text(x, y + 1.1 * length, f"${upwards}$", ha="center", va="bottom")
    ax.plot(x, y, "o", mfc="white", mec=s.BLACK, ms=6, mew=0.8, zorder=7)
    ax.plot(x, y, "o", color=s.BLACK, ms=1.8, zorder=8)
    ax.text(x - 0.18 * length, y - 0.12 * length, f"${outwards}$", ha="right", va="top")


# --- (a) the domain ---------------------------------------------------------------------------------------------------

LENGTH, HEIGHT, CREST = 10.0, 2.6, 0.62
DEPTH = np.array([1.5, 1.1])  # of the box, as drawn


def heap_height(x):
    """Profile of the heap in the side view."""
    toe, crest, foot = 2.4, 4.3, 5.3
    rise = np.clip((x - toe) / (crest - toe), 0, 1)
    fall = np.clip((foot - x) / (foot - crest), 0, 1)
    return CREST * np.where(x < crest, np.sin(np.pi * rise / 2)**1.5, fall)


def row_faces(first, rows, uniform_to, top):
    """Heights of the faces of rows as `fluid.first_cell_height` and `fluid.uniform_height` make them."""
    equal = int(np.ceil(uniform_to / first - 1e-9))
    low, high = 1.0, 3.0
    for _ in range(60):
        q = (low + high) / 2
        sizes = first * q**np.maximum(0, np.arange(rows) - equal + 1)
        low, high = (q, high) if sizes.sum() < top else (low, q)
    return np.concatenate([[0], np.cumsum(sizes)])


def box(ax):
    """The domain as a box, seen from the side and a little from above."""
    front = np.array([(0, 0), (LENGTH, 0), (LENGTH, HEIGHT), (0, HEIGHT)])
    back = front + DEPTH
    ax.add_patch(Polygon([front[0], front[1], back[1], back[0]], fc="#EFEFEF", ec="none", zorder=0))
    ax.add_patch(Polygon([front[3], front[2], back[2], back[3]], fc=PALE, ec="none", alpha=0.6, zorder=0))
    for face, look in ((front, "-"), (back, "-")):
        ax.add_patch(Polygon(face, fill=False, ec=s.BLACK, lw=0.9, ls=look, zorder=5))
    for a, b in zip(front, back):
        ax.plot(*zip(a, b), color=s.BLACK, lw=0.9, zorder=5)
    for look in ({"fc": s.SAND_EDGE, "ec": s.SAND_EDGE, "lw": 1.6}, {"fc": s.SAND, "ec": "none"}):
        for level in np.linspace(0, 1, 40):
            ax.add_patch(Polygon(contour(level), zorder=3, **look))
    for level in (0.25, 0.5, 0.75):
        ax.add_patch(Polygon(contour(level), fill=False, ec=s.SAND_EDGE, lw=0.4, zorder=4))


def contour(level):
    """A round heap at a level from 0 (its foot) to 1 (its top)."""
    angle, wide = np.linspace(0, 2 * np.pi, 60), np.sqrt(1 - level)
    middle = np.array([3.6, 0.75 * level]) + DEPTH / 2
    return middle + wide * (np.outer(np.cos(angle), (1.3, 0)) + np.outer(np.sin(angle), 0.32 * DEPTH))


def label_box(ax):
    note(ax, "lid: free slip", (7.3, 4.25), (7.6, HEIGHT + 0.6), WATER)
    note(ax, "floor: no slip for the water,\nsmooth or glued spheres for the grains", (9.6, -0.9), (8.1, 0.45))
    note(ax, "heap of grains", (6.6, 1.2), (4.9, 0.75), s.SAND_EDGE)
    ax.text(-0.35, 1.2, "water: periodic in $x$\n(enters as it leaves)", ha="right", va="center", fontsize=7.5,
            color=WATER)
    ax.text(LENGTH + DEPTH[0] + 0.3, 1.75, "grains: outlet,\nor periodic,\nor wall", ha="left", va="center",
            fontsize=7.5, color=s.VERMILLION)
    ax.text(LENGTH + DEPTH[0] + 0.3, 3.1, "front and back, $z$:\nperiodic (grains:\nor walls)", ha="left", va="center",
            fontsize=7.5)
    for y, length in ((0.45, 0.6), (1.1, 0.9), (1.75, 1.0), (2.4, 1.05)):
        arrow(ax, (0.15, y), (0.15 + length, y), WATER, lw=1.1)
    arrow(ax, (5.0, 2.1), (6.3, 2.1), WATER, lw=2.2, mutation_scale=13)
    ax.text(6.45, 2.1, "drive $f$", color=WATER, va="center", fontsize=8.5)
    arrow(ax, (8.9, 2.3), (8.9, 1.3))
    ax.text(9.05, 1.8, r"$\mathbf{g}$", va="center", fontsize=10)
    distance(ax, (0, -0.3), (LENGTH, -0.3), "$L_x$", (0, -0.28))
    distance(ax, (LENGTH + 0.18, -0.08), (LENGTH + DEPTH[0] + 0.18, DEPTH[1] - 0.08), "$L_z$", (0.32, -0.12))
    distance(ax, (-0.18, 0), (-0.18, HEIGHT), "")
    ax.text(-0.35, 2.3, "$L_y$", ha="right", va="center")


def draw_domain():
    figure = Figure(figsize=(s.FULL_WIDTH, 4.9), layout="none")
    ax, side = figure.add_axes((0.0, 0.43, 1, 0.55)), figure.add_axes((0.02, 0.02, 0.96, 0.4))
    frame(ax, (-3.7, 14.6), (-1.3, 4.6))
    box(ax)
    label_box(ax)
    arrow(ax, (-2.3, 3.3), (-1.5, 3.3), lw=1, mutation_scale=7)
    arrow(ax, (-2.3, 3.3), (-2.3, 4.1), lw=1, mutation_scale=7)
    arrow(ax, (-2.3, 3.3), (-2.3 - 0.45, 3.3 - 0.33), lw=1, mutation_scale=7)
    for text, at in (("$x$", (-1.35, 3.3)), ("$y$", (-2.3, 4.28)), ("$z$", (-2.9, 2.85))):
        ax.text(*at, text, ha="center", va="center")
    ax.text(-3.6, 4.6, "(a)", va="top")
    draw_cells(side)
    return figure


def draw_cells(ax):
    """Side view of the cells over the heap."""
    left, right = 1.4, 6.9
    frame(ax, (-0.1, 8.9), (-0.28, HEIGHT + 0.12))
    wall(ax, left, right, 0, 0.12)
    for y in row_faces(0.065, 28, CREST + 0.06, HEIGHT):
        ax.plot([left, right], [y, y], color=LINE, lw=0.5, zorder=1)
    for x in np.arange(left, right + 0.01, 0.5):
        ax.plot([x, x], [0, HEIGHT], color=LINE, lw=0.5, zorder=1)
    ax.plot([left, right], [HEIGHT, HEIGHT], color=WATER, lw=1.2, ls="--", zorder=5)
    grain, rise = 0.1, 0.1 * np.sqrt(3) / 2
    for layer in range(8):
        for x in np.arange(left, right, grain) + (layer % 2) * grain / 2:
            if heap_height(x) > (layer + 0.6) * rise:
                sphere(ax, (x, grain / 2 + layer * rise), grain / 2, lw=0.35)
    note(ax, "rows of 0.7 $d$ or less\nup to the crest", (7.9, 0.35), (right, 0.35))
    note(ax, "above it rows grow\nby a constant ratio", (7.9, 1.5), (right, 1.5))
    note(ax, "cells of 5 $d$\nalong $x$ and $z$", (0.6, 1.6), (1.65, 1.85))
    note(ax, "lid", (7.9, 2.45), (right, HEIGHT), WATER)
    distance(ax, (left - 0.12, 0), (left - 0.12, CREST + 0.065), "")
    ax.text(left - 0.2, 0.36, "uniform_height", ha="right", va="center", fontsize=7, family="monospace")
    ax.text(-0.05, HEIGHT + 0.1, "(b)", va="top")


# --- (b) what is measured of a dune -----------------------------------------------------------------------------------

def bezier(*points):
    """A curve through the first and the last of four points."""
    t = np.linspace(0, 1, 40)[:, None]
    a, b, c, d = (np.array(p) for p in points)
    return (1 - t)**3 * a + 3 * t * (1 - t)**2 * b + 3 * t**2 * (1 - t) * c + t**3 * d


TOE, BRINK, FOOT = 0.0, 4.2, 5.0
TIP_LEFT, TIP_RIGHT = (8.0, 3.0), (7.0, -2.7)  # the picture's vertical is -z
WIDE = 3.6


def outline():
    """The dune from above, in the order toe, left tip, lee foot, right tip, toe."""
    return np.concatenate([
        bezier((TOE, 0), (TOE, 2.2), (2.0, WIDE + 0.1), (4.6, WIDE)), bezier((4.6, WIDE), (6.2, 3.55), (7.4, 3.3), TIP_LEFT),
        bezier(TIP_LEFT, (6.4, 2.7), (FOOT, 1.8), (FOOT, 0)), bezier((FOOT, 0), (FOOT, -1.8), (5.9, -2.5), TIP_RIGHT),
        bezier(TIP_RIGHT, (6.4, -3.1), (5.6, -3.4), (4.4, -3.4)), bezier((4.4, -3.4), (2.0, -3.5), (TOE, -2.2), (TOE, 0))])


def slip_face():
    return np.concatenate([bezier(TIP_LEFT, (6.0, 3.1), (BRINK, 1.9), (BRINK, 0)),
                           bezier((BRINK, 0), (BRINK, -1.9), (5.5, -2.8), TIP_RIGHT),
                           bezier(TIP_RIGHT, (5.9, -2.5), (FOOT, -1.8), (FOOT, 0)),
                           bezier((FOOT, 0), (FOOT, 1.8), (6.4, 2.7), TIP_LEFT)])


def draw_plan(ax):
    frame(ax, (-3.4, 12.6), (-5.2, 5.2))
    ax.add_patch(Rectangle((-0.9, -0.55), 10.2, 1.1, fc=s.SKY, alpha=0.3, ec="none", zorder=4))
    ax.add_patch(Polygon(outline(), fc=s.SAND, ec=s.SAND_EDGE, lw=1, zorder=2))
    ax.add_patch(Polygon(slip_face(), fc="#C9B183", ec=s.SAND_EDGE, lw=0.7, zorder=3))
    ax.plot([-0.9, 9.3], [0, 0], color=s.BLACK, lw=0.7, ls="-.", zorder=5)
    ax.plot(3.75, 0, "+", color=s.BLACK, ms=9, mew=1.3, zorder=6)
    note(ax, "centroid C", (1.6, 1.3), (3.7, 0.05))
    note(ax, "strip, $|z - C_z| < 3 d$", (10.9, 0), (9.3, 0), WATER)
    note(ax, "brink", (2.3, -1.75), (BRINK + 0.14, -1.0))
    note(ax, "slip face\n(lee face)", (10.6, 1.9), (5.05, 1.35))
    note(ax, "lee foot", (10.6, -1.6), (FOOT, 0))
    note(ax, "left horn ($z < C_z$)", (10.4, 3.9), (7.3, 3.15))
    note(ax, "right horn ($z > C_z$)", (10.4, -3.6), (6.5, -2.8))
    arrow(ax, (-3.2, 2.6), (-1.4, 2.6), WATER, lw=2, mutation_scale=12)
    ax.text(-2.3, 2.95, "flow", color=WATER, ha="center")
    for at, y in ((WIDE, WIDE), (-3.42, -3.42)):
        ax.plot([-1.0, 4.5], [y, y], color=s.BLACK, lw=0.5, ls=":", zorder=1)
    distance(ax, (-1.0, -3.42), (-1.0, WIDE), "$W$", (-0.4, -1.6))
    distance(ax, (FOOT, 4.5), (TIP_LEFT[0], 4.5), "horn_left", (0, 0.4), family="monospace", fontsize=7.5)
    distance(ax, (FOOT, -4.3), (TIP_RIGHT[0], -4.3), "horn_right", (0, -0.45), family="monospace", fontsize=7.5)
    distance(ax, (TOE, -4.3), (FOOT, -4.3), "$L$", (0, -0.45))
    for x, y in ((TOE, -0.1), (FOOT, 0)):
        ax.plot([x, x], [y, -4.5], color=s.BLACK, lw=0.5, ls=":", zorder=5)
    ax.plot([FOOT, FOOT], [0, 4.7], color=s.BLACK, lw=0.5, ls=":", zorder=5)
    for x, y in (TIP_LEFT, TIP_RIGHT):
        ax.plot([x, x], [y, np.sign(y) * 4.6], color=s.BLACK, lw=0.5, ls=":", zorder=5)
    arrow(ax, (-2.9, -3.9), (-2.0, -3.9), lw=1, mutation_scale=7)
    arrow(ax, (-2.9, -3.9), (-2.9, -4.8), lw=1, mutation_scale=7)
    ax.text(-1.8, -3.9, "$x$", va="center")
    ax.text(-2.65, -4.8, "$z$", va="center")
    ax.text(-3.4, 5.2, "(a) from above", va="top")


def draw_profile(ax):
    """Along the centreline; heights are drawn larger."""
    height, crest = 2.0, 3.8
    frame(ax, (-3.4, 12.6), (-1.3, 3.3))
    wall(ax, -0.9, 9.3, 0, 0.2)
    horn = np.array([(3.0, 1.3), (5.2, 0.95), (6.6, 0.5), (TIP_LEFT[0], 0), (3.0, 0)])
    ax.add_patch(Polygon(horn, fc="#F3EBD8", ec=s.SAND_EDGE, lw=0.7, ls="--", zorder=1.5))
    stoss = bezier((TOE, 0), (1.2, 0.25), (2.4, height), (crest, height))
    top = bezier((crest, height), (crest + 0.15, height), (BRINK - 0.1, height - 0.05), (BRINK, height - 0.12))
    ax.add_patch(Polygon(np.concatenate([stoss, top, [(FOOT, 0)]]), fc=s.SAND, ec=s.SAND_EDGE, lw=1, zorder=2))
    between = stoss[(stoss[:, 1] > 0.2 * height) & (stoss[:, 1] < 0.8 * height)]
    slope, at_0 = np.polyfit(*between.T, 1)
    start, end = -at_0 / slope, (0.95 * height - at_0) / slope
    ax.plot([start, end], [0, 0.95 * height], color=s.VERMILLION, lw=1, zorder=5)
    ax.add_patch(Arc((start, 0), 2.2, 2.2, theta1=0, theta2=np.degrees(np.arctan(slope)), color=s.VERMILLION, lw=0.9,
                     zorder=5))
    ax.text(start + 1.25, 0.3, "stoss angle", color=s.VERMILLION, fontsize=7, zorder=6)
    ax.add_patch(Arc((FOOT, 0), 1.3, 1.3, theta1=113, theta2=180, color=s.VERMILLION, lw=0.9, zorder=5))
    note(ax, "slip face angle", (3.1, -0.75), (4.45, 0.3), s.VERMILLION)
    distance(ax, (-1.0, 0), (-1.0, height), "$H$", (-0.4, 0))
    ax.plot([-1.2, crest], [height, height], color=s.BLACK, lw=0.5, ls=":", zorder=1)
    note(ax, "crest_x", (3.3, 2.65), (crest, height), family="monospace")
    note(ax, "brink", (5.2, 2.5), (BRINK, height - 0.1))
    note(ax, "toe", (-0.4, -0.75), (TOE, 0))
    note(ax, "lee foot", (5.6, -0.75), (FOOT, 0))
    note(ax, "left horn, behind", (9.2, 1.2), (6.6, 0.45))
    directions(ax, (11.0, 0.0), 0.9)
    ax.text(-3.4, 2.9, "(b) along the centreline, heights stretched", va="bottom")


def draw_dune():
    figure = Figure(figsize=(s.FULL_WIDTH, 6.9), layout="none")
    draw_plan(figure.add_axes((0.0, 0.33, 1, 0.66)))
    draw_profile(figure.add_axes((0.0, 0.01, 1, 0.29)))
    return figure


# --- (c) exchange of momentum -----------------------------------------------------------------------------------------

ROW, ROWS = 0.65, 9             # height of a row in diameters; rows shown
RISE = np.sqrt(3) / 2           # from layer to layer
GRAIN = (0.0, 0.5 + 2 * RISE)   # centre of the grain that is looked at
SMOOTHING = 3.0                 # diameters
FORCE = 16.0                    # length of an arrow over the impulse, in both panels
MIDDLES = (np.arange(ROWS) + 0.5) * ROW
FAST = 2.2                      # above this height the water is open and sheared


def water(y):
    """Velocity of the water: sheared above the bed, a small part of that within it."""
    return np.where(y > FAST, 0.2 + 0.36 * (y - FAST), 0.2 * np.exp(np.minimum(0, y - FAST) / 0.2))


def shares_by_row():
    """Share w_j of the 29 points of `void_fraction = "divided"` in each row, and their mean height there."""
    shells = [np.zeros(1)] + [np.array([e, -e, 0, 0, 0, 0] + 4 * [e / 2, -e / 2]) for e in (0.6276, 0.9085)]
    y = GRAIN[1] + 0.5 * np.concatenate(shells)
    row = np.floor(y / ROW).astype(int)
    n = np.bincount(row, minlength=ROWS)
    return n / len(y), np.bincount(row, y, minlength=ROWS) / np.maximum(1, n)


def bed(ax):
    """Rows of cells, three layers of grains on the floor, and the water in each row."""
    for j in range(ROWS + 1):
        ax.plot([-4, 4], [j * ROW, j * ROW], color=LINE, lw=0.6, zorder=1)
    wall(ax, -4, 4, 0, 0.2)
    for layer in range(3):
        for x in np.arange(-2, 3 - layer % 2) + 0.5 * (layer % 2):
            if layer < 2 or x != 0:
                sphere(ax, (x, 0.5 + layer * RISE), 0.5, "#F3EBD8", ec="#B8A98A", zorder=2)
    sphere(ax, GRAIN, 0.5, "white", ec=s.BLACK, lw=1.1, zorder=3)
    sphere(ax, GRAIN, 0.5, "none", ec=s.BLACK, lw=1.1, zorder=6)
    ax.plot([-3.8, -3.8], [0, ROWS * ROW], color=WATER, lw=0.8, zorder=4)
    for y in MIDDLES:
        if water(y) > 0.1:
            arrow(ax, (-3.8, y), (-3.8 + water(y), y), WATER, lw=1, mutation_scale=7)
        else:
            ax.plot(-3.8, y, "o", color=WATER, ms=2.2, zorder=5)
    for x, text, colour, side in ((-3.9, "velocity of the water", WATER, "left"),
                                  (3.9, "taken from the water", s.VERMILLION, "right")):
        ax.text(x, ROWS * ROW + 0.1, text, color=colour, fontsize=7.5, ha=side, va="bottom")


def taken(ax, j, impulse):
    """What the water of row j loses, an arrow against the flow."""
    size, y = FORCE * impulse, MIDDLES[j]
    if size > 0.05:
        arrow(ax, (3.85, y), (3.85 - size, y), s.VERMILLION, lw=1.6, mutation_scale=min(9, 4 + 10 * size))


def draw_by_row(ax):
    bed(ax)
    w, at = shares_by_row()
    for j, colour in zip(np.flatnonzero(w), (s.PURPLE, s.SKY, s.GREEN)):
        part = Rectangle((-4, j * ROW), 8, ROW, fc=colour, ec="none", alpha=0.8, zorder=3.5)
        ax.add_patch(part)
        part.set_clip_path(Circle(GRAIN, 0.5, transform=ax.transData))
        ax.add_patch(Rectangle((-4, j * ROW), 8, ROW, fc=colour, ec="none", alpha=0.18, zorder=1.2))
        if water(at[j]) > 0.1:
            arrow(ax, (-0.06 - 2 * water(at[j]), at[j]), (-0.06, at[j]), WATER, lw=1.5, mutation_scale=8)
        ax.plot(0, at[j], "o", color=s.BLACK, ms=2.6, zorder=7)
        ax.text(0.6, at[j], f"$w_j$ = {w[j]:.2f}", fontsize=7, va="center", zorder=7,
                bbox={"fc": "white", "ec": "none", "alpha": 0.75, "pad": 0.8})
        taken(ax, j, w[j] * water(at[j]))
    return "each part of the grain feels the water of its row,\nand this row loses what it gave"


def draw_smoothed(ax):
    bed(ax)
    seen = np.interp(GRAIN[1], MIDDLES, water(MIDDLES))
    kernel = np.exp(-abs(MIDDLES - GRAIN[1]) / SMOOTHING) + np.exp(-(MIDDLES + GRAIN[1]) / SMOOTHING)
    for j, share in enumerate(kernel * ROW / (2 * SMOOTHING)):
        ax.add_patch(Rectangle((-4, j * ROW), 8, ROW, fc=s.ORANGE, ec="none", alpha=1.6 * share, zorder=1.2))
        taken(ax, j, share * seen)
    arrow(ax, (-0.06 - 2 * seen, GRAIN[1]), (-0.06, GRAIN[1]), WATER, lw=1.5, mutation_scale=8)
    ax.plot(*GRAIN, "o", color=s.BLACK, ms=2.6, zorder=7)
    return "the grain feels the water at its centre, and all rows around lose it:\nslow water in the bed is driven backwards"


def draw_exchange():
    figure = Figure(figsize=(s.FULL_WIDTH, 3.5), layout="none")
    for left, draw, title in ((0.01, draw_by_row, "(a) layer-wise"), (0.51, draw_smoothed, "(b) smoothed over 3 $d$")):
        ax = figure.add_axes((left, 0.13, 0.48, 0.8))
        frame(ax, (-4.1, 4.1), (-0.3, ROWS * ROW + 0.5))
        ax.text(0, -0.45, draw(ax), ha="center", va="top", fontsize=7.5)
        ax.set_title(title, loc="left")
    return figure


# --- (d) forces on a grain --------------------------------------------------------------------------------------------

def curl(ax, centre, radius, colour, first=210, last=330):
    """A curved arrow around a centre, clockwise from `last` to `first` degrees."""
    angle = np.radians(np.linspace(last, first, 30))
    path = np.array(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    ax.plot(*path[:-2].T, color=colour, lw=1.2, zorder=6)
    arrow(ax, path[-4], path[-1], colour, lw=1.2)


def force(ax, start, step, text, colour=s.BLACK, shift=(0.12, 0), **options):
    """An arrow of a force with its name beyond the tip."""
    end = np.add(start, step)
    arrow(ax, start, end, colour, lw=1.7, mutation_scale=11, **options)
    side = "left" if shift[0] > 0 else "right" if shift[0] < 0 else "center"
    ax.text(*np.add(end, shift), text, color=colour, ha=side, va="center", fontsize=9, zorder=8)


def draw_grain(ax):
    """A grain at the surface of a bed that rises downstream."""
    frame(ax, (-3.6, 3.6), (-2.7, 3.0))
    up = np.radians(12)
    along, normal = np.array([np.cos(up), np.sin(up)]), np.array([-np.sin(up), np.cos(up)])
    for k in range(-2, 3):
        for row in range(2):
            sphere(ax, (1.5 * (k + 0.5 * (1 - row)) * along - (1.3 * (1 + row)) * normal), 0.75, "#F3EBD8", ec="#B8A98A",
                   zorder=1)
    sphere(ax, (0, 0), 0.75, zorder=3)
    for y, length in ((1.0, 0.55), (1.6, 0.85), (2.2, 1.1)):
        arrow(ax, (-3.4, y), (-3.4 + length, y), WATER, lw=1.1)
    ax.text(-3.4, 2.6, "flow", color=WATER)
    for side in (-1, 1):
        at = 0.75 * (side * 0.5 * along - 0.866 * normal)
        inwards = -at / 0.75
        turned = np.array([inwards[1], -inwards[0]])
        force(ax, at, 1.0 * inwards * 0.55, "", s.SAND_EDGE)
        force(ax, at, -0.62 * turned * (1 if side > 0 else -1) * side, "", s.SAND_EDGE)
    return


def draw_forces():
    figure = Figure(figsize=(s.FULL_WIDTH, 3.6), layout="none")
    draw_grain(figure.add_axes((0.0, 0.0, 0.5, 1)))
    return figure


DRAWINGS = {"sketch-domain": draw_domain, "sketch-dune": draw_dune, "sketch-exchange": draw_exchange,
            "sketch-forces": draw_forces}


def main(names):
    with s.look():
        for name in names or DRAWINGS:
            s.save(DRAWINGS[name](), HERE, name, name, largest=LARGEST)


if __name__ == "__main__":
    main(sys.argv[1:])
