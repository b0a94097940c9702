"""Curves of a run as SVG that a page can hold and a script can read back. SI data, mm in axes."""

import math
from html import escape

from barchan.io import horn_lengths
import numpy as np

from barchan.io.tables import thin
from barchan.stats import varies

WIDTH, HEIGHT = 360, 190
LEFT, RIGHT, TOP, BOTTOM = 52, 350, 8, 158
MOST_POINTS = 400

# title, unit, factor, scale ("count": from zero), {column: legend}
MORPHOLOGY = (
    ("width W", "mm", 1e3, "linear", {"W": ""}),
    ("length L", "mm", 1e3, "linear", {"L": ""}),
    ("height H", "mm", 1e3, "linear", {"H": ""}),
    ("centroid C_x", "mm", 1e3, "linear", {"Cx": ""}),
    ("centroid C_z", "mm", 1e3, "linear", {"Cz": ""}),
    ("horns", "mm", 1e3, "linear", {"horn_left": "left", "horn_right": "right"}),
    ("horns two grains high, median of 1 s", "mm", 1e3, "linear",
     {horn_lengths.name("left"): "left", horn_lengths.name("right"): "right"}),
    ("celerity", "mm/s", 1e3, "linear", {"celerity": ""}),
    ("grain flux over the dune", "mm²/s", 1e6, "linear", {"flux": ""}),
    ("grains lost", "", 1.0, "count", {"n_lost": ""}),
)
HISTORY = (
    ("wall friction velocity u*", "mm/s", 1e3, "linear", {"u_star": ""}),
    ("bulk velocity", "m/s", 1.0, "linear", {"bulk_velocity": "", "bulk_velocity_z": "along z"}),
    ("driving gradient", "Pa/m", 1.0, "linear", {"pressure_gradient": "", "pressure_gradient_z": "along z"}),
    ("kinetic energy", "J", 1.0, "log", {"fluid_kinetic_energy": "water",
                                         "grain_kinetic_energy": "grains"}),
    ("CFL number", "", 1.0, "linear", {"cfl": ""}),
    ("continuity residual", "1/s", 1.0, "log", {"continuity_residual": ""}),
    ("pressure iterations", "", 1.0, "count", {"pressure_iterations": ""}),
    ("largest overlap", "%", 100.0, "linear", {"max_overlap": ""}),
    ("grains and contacts", "", 1.0, "count", {"n_grains": "grains", "n_contacts": "contacts"}),
)
OF_INTERVAL = ("cfl", "continuity_residual", "pressure_iterations")


def figures(table, panels):
    """HTML of the panels for which the table (columns by name, with `t` [s]) has values that vary."""
    return "\n".join(filter(None, (figure(table, *panel) for panel in panels)))


def figure(table, title, unit, factor, scale, columns):
    t = table["t"]
    series = {legend: factor * known(table, name) for name, legend in columns.items()
              if name in table and np.any(np.isfinite(table[name]) & (table[name] != 0.0))}
    if scale == "log":
        series = {legend: np.where(y > 0.0, y, np.nan) for legend, y in series.items()}
    series = {legend: y for legend, y in series.items() if np.isfinite(y).any()}
    if not series or (len(t) > 1 and not any(varies(y) for y in series.values())):
        return ""
    axes = Axes(t, np.concatenate(list(series.values())), scale)
    lines = "".join(f'<path class="curve s{i}" d="{axes.path(t, y)}"/><circle class="dot s{i}" r="3.5"/>'
                    for i, y in enumerate(series.values()))
    legend = "".join(f'<span class="key s{i}">{escape(text)}</span>'
                     for i, text in enumerate(series) if text)
    return (f'<figure class="plot"><figcaption><b>{marked(title)}</b>{f" ({unit})" if unit else ""}'
            f'{legend}<output></output></figcaption>'
            f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" aria-label="{escape(title)} against time" '
            f'{axes.attributes()}>{axes.drawn()}<line class="now" y1="{TOP}" y2="{BOTTOM}"/>{lines}</svg>'
            "</figure>")


def known(table, name):
    """A column; what is counted over an interval has no value yet in the first line."""
    values = table[name].copy()
    if name in OF_INTERVAL and values[0] == 0.0:
        values[0] = np.nan
    return values


def marked(title):
    """Subscripts of symbols: C_x."""
    head, under, tail = escape(title).partition("_")
    return f"{head}<sub>{tail}</sub>" if under else head


class Axes:
    """Where values stand: time from LEFT to RIGHT, values (or their logarithm) from BOTTOM to TOP."""

    def __init__(self, t, values, scale):
        self.log = scale == "log"
        self.t0, self.t1 = float(t[0]), float(t[-1] if t[-1] > t[0] else t[0] + 1.0)
        values = values[np.isfinite(values)]
        values = np.log10(values) if self.log else values
        self.y0, self.y1 = self.limits(values.min(), values.max(), scale)

    @staticmethod
    def limits(low, high, scale):
        """No magnification of noise: whole decades, or at least 4 % of the value."""
        if scale == "log":
            low, high = math.floor(low + 1e-9), math.ceil(high - 1e-9)
            return low, max(high, low + 1)
        if scale == "count":
            return 0.0, 1.1 * max(high, 1e-12)
        missing = max(0.0, 0.04 * max(abs(low), abs(high)) - (high - low), 1e-12 - (high - low))
        margin = 0.06 * (high - low) + 0.5 * missing
        return low - margin, high + margin

    def x(self, t):
        return LEFT + (t - self.t0) / (self.t1 - self.t0) * (RIGHT - LEFT)

    def y(self, value):
        value = np.log10(value) if self.log else value
        return BOTTOM - (value - self.y0) / (self.y1 - self.y0) * (BOTTOM - TOP)

    def attributes(self):
        return (f'data-t0="{self.t0:.9g}" data-t1="{self.t1:.9g}" data-y0="{self.y0:.9g}" '
                f'data-y1="{self.y1:.9g}"{" data-log" if self.log else ""}')

    def path(self, t, values):
        """SVG path with a gap where a value is missing."""
        kept = thin(len(t), MOST_POINTS)
        words, pen = [], "M"
        for x, y in zip(self.x(t[kept]), self.y(values[kept])):
            if np.isfinite(y):
                words.append(f"{pen}{x:.1f} {y:.2f}")
            pen = "L" if np.isfinite(y) else "M"
        return "".join(words)

    def drawn(self):
        """Frame, grid lines and numbers."""
        parts = [f'<rect class="frame" x="{LEFT}" y="{TOP}" width="{RIGHT - LEFT}" height="{BOTTOM - TOP}"/>']
        for value in ticks(self.t0, self.t1, 5):
            x = self.x(value)
            parts.append(f'<path class="grid" d="M{x:.1f} {TOP}V{BOTTOM}"/>'
                         f'<text x="{x:.1f}" y="{BOTTOM + 14}" text-anchor="middle">{number(value)}</text>')
        for value in decades(self.y0, self.y1) if self.log else ticks(self.y0, self.y1, 5):
            y = self.y(10.0 ** value if self.log else value)
            text = (f'10<tspan dy="-4" font-size="8">{signed(value)}</tspan>' if self.log else number(value))
            parts.append(f'<path class="grid" d="M{LEFT} {y:.1f}H{RIGHT}"/>'
                         f'<text x="{LEFT - 5}" y="{y + 3.5:.1f}" text-anchor="end">{text}</text>')
        middle = 0.5 * (LEFT + RIGHT)
        return "".join(parts) + f'<text x="{middle}" y="{HEIGHT - 4}" text-anchor="middle">t (s)</text>'


def ticks(low, high, about):
    """Multiples of 1, 2 or 5 x 10^n inside [low, high], roughly `about` of them."""
    rough = (high - low) / about
    power = 10.0 ** math.floor(math.log10(rough))
    step = next(m * power for m in (1.0, 2.0, 5.0, 10.0) if m * power >= 0.999 * rough)
    first, last = math.ceil(low / step - 1e-9), math.floor(high / step + 1e-9)
    return [round(i * step, 12) for i in range(first, last + 1)]


def decades(low, high):
    step = max(1, math.ceil((high - low) / 5))
    return range(int(low), int(high) + 1, step)


def number(value):
    if value != 0.0 and (abs(value) >= 1e5 or abs(value) < 1e-4):
        mantissa, _, power = f"{value:.2e}".partition("e")
        return f"{float(mantissa):g}×10<tspan dy=\"-4\" font-size=\"8\">{signed(int(power))}</tspan>"
    return f"{value:.6g}".replace("-", "−")


def signed(value):
    return str(value).replace("-", "−")
