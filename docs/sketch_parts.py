"""Arrows, dimension lines, walls and springs: what the sketches of docs/sketches.py are made of."""

import sys
from pathlib import Path

import numpy as np
from matplotlib.patches import Circle, FancyArrowPatch, Rectangle

sys.path.insert(0, str(Path(__file__).resolve().parent.parent / "python"))
from barchan.figures import style as s  # noqa: E402  (found by the line above)


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


def force(ax, start, step, text, colour=s.BLACK, shift=(0.12, 0), **options):
    """An arrow of a force with its name beyond the tip."""
    end = np.add(start, step)
    arrow(ax, start, end, colour, **({"lw": 1.7, "mutation_scale": 11} | options))
    side = "left" if shift[0] > 0 else "right" if shift[0] < 0 else "center"
    ax.text(*np.add(end, shift), text, color=colour, ha=side, va="center", fontsize=9, zorder=8)


def turn(ax, centre, radius, first, last, colour=s.BLACK, **options):
    """A curved arrow about a centre from the angle `first` to `last` [degrees]."""
    angle = np.radians(np.linspace(first, last, 40))
    path = np.array(centre) + radius * np.column_stack([np.cos(angle), np.sin(angle)])
    ax.plot(*path[:-3].T, color=colour, **({"lw": 1.4, "zorder": 6} | options))
    arrow(ax, path[-5], path[-1], colour, lw=1.4)


def spring(ax, start, end, y):
    """A spring between two places at the same height."""
    x = np.linspace(start, end, 15)
    ax.plot(x, y + 0.13 * np.array([0, 0, 0, 1, -1, 1, -1, 1, -1, 1, -1, 1, 0, 0, 0]), color=s.BLACK, lw=1.1)


def dashpot(ax, start, end, y):
    """A dashpot between two places at the same height."""
    a, b = start + 0.38 * (end - start), start + 0.62 * (end - start)
    ax.plot([start, a, a, b], [y, y, y + 0.14, y + 0.14], color=s.BLACK, lw=1.1)
    ax.plot([a, a, b], [y, y - 0.14, y - 0.14], color=s.BLACK, lw=1.1)
    ax.plot([b - 0.1, b - 0.1], [y - 0.1, y + 0.1], color=s.BLACK, lw=1.6)
    ax.plot([b - 0.1, end], [y, y], color=s.BLACK, lw=1.1)


def slider(ax, start, end, y):
    """A slider, which gives way at the limit of friction."""
    middle = (start + end) / 2
    for x, height in (((start, middle + 0.25), y), ((middle - 0.25, end), y + 0.12)):
        ax.plot(x, [height, height], color=s.BLACK, lw=1.3)


def spring_and_dashpot(ax, y, name, stiffness, damping):
    """A spring and a dashpot side by side."""
    ax.text(-1.5, y, name, ha="right", va="center", fontsize=8)
    spring(ax, -0.9, 0.9, y + 0.25)
    dashpot(ax, -0.9, 0.9, y - 0.25)
    for x, outwards in ((-0.9, -0.3), (0.9, 0.3)):
        ax.plot([x, x], [y - 0.25, y + 0.25], color=s.BLACK, lw=1.1)
        ax.plot([x, x + outwards], [y, y], color=s.BLACK, lw=1.1)
    ax.text(0, y + 0.4, stiffness, ha="center", va="bottom", fontsize=8)
    ax.text(0.35, y - 0.3, damping, ha="left", va="top", fontsize=8)


def bezier(*points):
    """A curve through the first and the last of four points."""
    t = np.linspace(0, 1, 40)[:, None]
    a, b, c, d = (np.array(p) for p in points)
    return (1 - t)**3 * a + 3 * t * (1 - t)**2 * b + 3 * t**2 * (1 - t) * c + t**3 * d
