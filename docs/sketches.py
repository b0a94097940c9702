#!/usr/bin/python3
"""Draws the sketches of the pages: sketch-domain, -dune, -exchange, -forces, -bodies (.svg in docs/).

Nothing here is a result: shapes are made up. In the sketch of the exchange the shares and the lengths of the arrows
follow from the formulas of docs/theory-coupling.md. usage: python3 docs/sketches.py [NAME ...]
"""

import sys
from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from matplotlib.patches import Arc, Circle, Polygon, Rectangle

import sketch_bodies
import sketch_parts as part
from sketch_parts import arrow, bezier, distance, force, frame, note, s, sphere, turn, wall

WATER, PALE, LINE = s.BLUE, "#DCEBF5", "#B5B5B5"


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
    for face in (front, back):
        ax.add_patch(Polygon(face, fill=False, ec=s.BLACK, lw=0.9, zorder=5))
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
    note(ax, "floor: no slip for the water,\nsmooth or glued spheres for the grains", (9.6, -0.9), (9.0, 0.3))
    note(ax, "heap of grains", (7.1, 0.62), (5.15, 0.55), s.SAND_EDGE)
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
    for text, tip in (("$x$", (0.8, 0)), ("$y$", (0, 0.8)), ("$z$", (-0.45, -0.33))):
        arrow(ax, (-2.3, 3.3), np.add((-2.3, 3.3), tip), lw=1, mutation_scale=7)
        ax.text(*np.add((-2.3, 3.3), 1.25 * np.array(tip)), text, ha="center", va="center")
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

TOE, BRINK, FOOT = 0.0, 4.2, 5.0
TIP_LEFT, TIP_RIGHT = (8.0, 3.0), (7.0, -2.7)  # the picture's vertical is -z
WIDE = 3.6


def outline():
    """The dune from above, in the order toe, left tip, lee foot, right tip, toe."""
    return np.concatenate([
        bezier((TOE, 0), (TOE, 2.2), (2.0, WIDE + 0.1), (4.6, WIDE)),
        bezier((4.6, WIDE), (6.2, 3.55), (7.4, 3.3), TIP_LEFT),
        bezier(TIP_LEFT, (6.4, 2.7), (FOOT, 1.8), (FOOT, 0)), bezier((FOOT, 0), (FOOT, -1.8), (5.9, -2.5), TIP_RIGHT),
        bezier(TIP_RIGHT, (6.4, -3.1), (5.6, -3.4), (4.4, -3.4)),
        bezier((4.4, -3.4), (2.0, -3.5), (TOE, -2.2), (TOE, 0))])


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
    part.directions(ax, (11.0, 0.0), 0.9)
    ax.text(-3.4, 2.9, "(b) along the centreline, heights stretched", va="bottom")


def draw_dune():
    figure = Figure(figsize=(s.FULL_WIDTH, 6.9), layout="none")
    draw_plan(figure.add_axes((0.0, 0.33, 1, 0.66)))
    draw_profile(figure.add_axes((0.0, 0.01, 1, 0.29)))
    return figure


# --- (c) exchange of momentum -----------------------------------------------------------------------------------------

ROW, ROWS = 0.7, 8              # height of a row in diameters; rows shown
RISE = np.sqrt(3) / 2           # from layer to layer
GRAIN = (0.0, 0.5 + 2 * RISE)   # centre of the grain that is looked at
SMOOTHING = 3.0                 # diameters
FORCE = 8.0                     # length of an arrow over the impulse, in both panels
MIDDLES = (np.arange(ROWS) + 0.5) * ROW
FAST = 2.2                      # above this height the water is open and sheared


def water(y):
    """Velocity of the water: sheared above the bed, a small part of that within it."""
    return np.where(y > FAST, 0.2 + 0.36 * (y - FAST), 0.2 * np.exp(np.minimum(0, y - FAST) / 0.2))


def shares_of_layers():
    """Share w_j of the volume of a grain in each row, and its mean height there."""
    s = np.clip((np.arange(ROWS + 1) * ROW - GRAIN[1]) / 0.5, -1, 1)
    share = np.diff((2 + 3 * s - s**3) / 4)
    moment = np.diff(-3 / 16 * (1 - s**2)**2)
    return share, GRAIN[1] + 0.5 * moment / np.maximum(share, 1e-9)


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


def draw_layered(ax):
    bed(ax)
    w, at = shares_of_layers()
    for j, colour in zip(np.flatnonzero(w), (s.PURPLE, s.SKY)):
        piece = Rectangle((-4, j * ROW), 8, ROW, fc=colour, ec="none", alpha=0.8, zorder=3.5)
        ax.add_patch(piece)
        piece.set_clip_path(Circle(GRAIN, 0.5, transform=ax.transData))
        ax.add_patch(Rectangle((-4, j * ROW), 8, ROW, fc=colour, ec="none", alpha=0.18, zorder=1.2))
        if water(at[j]) > 0.05:
            arrow(ax, (-0.06 - 4 * water(at[j]), at[j]), (-0.06, at[j]), WATER, lw=1.5, mutation_scale=8)
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
    arrow(ax, (-0.06 - 4 * seen, GRAIN[1]), (-0.06, GRAIN[1]), WATER, lw=1.5, mutation_scale=8)
    ax.plot(*GRAIN, "o", color=s.BLACK, ms=2.6, zorder=7)
    return ("the grain feels the water at its centre, and all rows around\n"
            "lose it: slow water in the bed is driven backwards")


def draw_exchange():
    figure = Figure(figsize=(s.FULL_WIDTH, 3.5), layout="none")
    for left, draw, title in ((0.01, draw_layered, "(a) layered"), (0.51, draw_smoothed, "(b) smoothed over 3 $d$")):
        ax = figure.add_axes((left, 0.13, 0.48, 0.8))
        frame(ax, (-4.1, 4.1), (-0.3, ROWS * ROW + 0.5))
        ax.text(0, -0.45, draw(ax), ha="center", va="top", fontsize=7.5)
        ax.set_title(title, loc="left")
    return figure


# --- (d) forces on a grain --------------------------------------------------------------------------------------------

def draw_grain(ax):
    """A grain at the surface of a bed that rises downstream: what acts on it."""
    frame(ax, (-3.4, 3.9), (-2.5, 3.1))
    up, r = np.radians(10), 0.8
    along, normal = np.array([np.cos(up), np.sin(up)]), np.array([-np.sin(up), np.cos(up)])
    for row, columns in ((1, (-1.5, -0.5, 0.5, 1.5)), (2, (-1, 0, 1))):
        for k in columns:
            sphere(ax, 2 * r * k * along - 1.73 * r * row * normal, r, "#F3EBD8", ec="#B8A98A", zorder=1)
    sphere(ax, (0, 0), r, lw=1)
    for y, length in ((0.9, 0.5), (1.5, 0.8), (2.1, 1.05)):
        arrow(ax, (-3.3, y), (-3.3 + length, y), WATER, lw=1.1)
    ax.text(-3.3, 2.5, "flow", color=WATER)
    ax.plot(0, 0, "o", color=s.BLACK, ms=3, zorder=8)
    force(ax, (0, 0), (0, -1.75), r"$m_p\mathbf{g}$", shift=(0.12, -0.05))
    force(ax, (0, 0), (0, 1.2), r"$-\rho_f V_p\mathbf{g}$", WATER, (-0.14, 0.05))
    force(ax, (0, 0), 1.9 * along, r"$\mathbf{F}_d$", WATER)
    force(ax, (0.1, 0.32), 1.15 * along, r"$\mathbf{F}_p + \mathbf{F}_\tau$", WATER, (0.1, 0.12))
    force(ax, (0, 0), 1.25 * np.array([-0.94, 0.35]), r"$\mathbf{F}_m$", WATER, (-0.08, 0.1))
    force(ax, (0.3, 0.78), (0.12, 0.95), r"$\mathbf{F}_l$ (optional)", WATER, (0.12, 0.1), ls="--")
    for side in (-1, 1):
        out = side * 0.5 * along - 0.866 * normal
        force(ax, 1.75 * r * out, -0.75 * r * out, r"", s.VERMILLION)
        back = side * np.array([out[1], -out[0]])
        force(ax, r * out, 0.62 * (back if back @ along < 0 else -back), "", s.VERMILLION)
    ax.text(1.0, -1.05, r"$\mathbf{F}_c$", color=s.VERMILLION, fontsize=9, zorder=8)
    turn(ax, (0, 0), 1.02, 150, 205, s.VERMILLION)
    ax.text(-1.12, -0.1, r"$\mathbf{T}_c$", color=s.VERMILLION, ha="right", fontsize=9)
    ax.text(-3.4, 3.1, "(a) forces on a grain", va="top")


def draw_contact(ax):
    """Two grains that touch, and the springs, dashpots and slider of the contact."""
    frame(ax, (-3.6, 3.7), (-2.5, 3.1))
    r, half = 1.1, 0.98
    for x, name, face in ((-half, "$j$", "#F3EBD8"), (half, "$i$", s.SAND)):
        sphere(ax, (x, 1.2), r, face, alpha=0.75, lw=1)
        ax.plot(x, 1.2, "o", color=s.BLACK, ms=2.6, zorder=7)
        ax.text(x + 0.1 * np.sign(x), 1.32, name, ha="center", va="bottom")
    arrow(ax, (0, 1.2), (0.62, 1.2), lw=1.5)
    ax.text(0.4, 1.02, r"$\mathbf{n}$", ha="center", va="top")
    for x in (half - r, r - half):
        ax.plot([x, x], [1.2, 2.55], color=s.BLACK, lw=0.5, ls=":", zorder=5)
    distance(ax, (-0.5, 2.45), (half - r, 2.45), "")
    distance(ax, (0.5, 2.45), (r - half, 2.45), "$\\delta_n$", (-0.32, 0.24))
    arrow(ax, (0, 1.2), (0, 0.35), s.VERMILLION, lw=1.7)
    ax.text(-0.1, 0.42, r"$\mathbf{F}_t$", color=s.VERMILLION, ha="right")
    arrow(ax, (half, 1.2), (half, 2.0), WATER, lw=1.5)
    ax.text(half + 0.1, 1.85, r"$\mathbf{v}_t$", color=WATER)
    arrow(ax, (2.3, 1.2), (3.1, 1.2), s.VERMILLION, lw=1.7)
    ax.text(2.75, 1.32, r"$F_n\mathbf{n}$", color=s.VERMILLION, ha="center", va="bottom")
    turn(ax, (half, 1.2), 0.75, -150, -75, WATER)
    ax.text(half + 0.28, 0.3, r"$\omega_i$", color=WATER, ha="left", va="bottom")
    part.spring_and_dashpot(ax, -0.6, r"normal", "$k_n$", r"$\gamma_n$")
    part.spring_and_dashpot(ax, -1.85, r"tangential", "$k_t$", r"$\gamma_t$")
    part.slider(ax, 1.2, 2.4, -1.85)
    ax.text(1.8, -1.68, "$\\mu$", ha="center", va="bottom")
    ax.text(-3.5, 3.1, "(b) a contact", va="top")


def draw_forces():
    figure = Figure(figsize=(s.FULL_WIDTH, 2.85), layout="none")
    draw_grain(figure.add_axes((0.01, 0.01, 0.5, 0.98)))
    draw_contact(figure.add_axes((0.51, 0.01, 0.48, 0.98)))
    return figure


DRAWINGS = {"sketch-domain": draw_domain, "sketch-dune": draw_dune, "sketch-exchange": draw_exchange,
            "sketch-forces": draw_forces, "sketch-bodies": sketch_bodies.draw}


def main(names):
    with s.look():
        for name in names or DRAWINGS:
            s.save(DRAWINGS[name](), Path(__file__).resolve().parent, name, name, ("svg",))


if __name__ == "__main__":
    main(sys.argv[1:])
