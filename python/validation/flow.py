"""taylor_green, convergence: the flow solver beside a spectral simulation and exact solutions."""

import numpy as np
from matplotlib.patches import Rectangle
from matplotlib.ticker import NullLocator

from barchan.figures import style
from validation import tables
from barchan.errors import MissingData

TAYLOR_GREEN = {64: style.SKY, 128: style.BLUE}  # cells per 2 pi: colour
PEAK_TOLERANCE, TIME_TOLERANCE = 0.1, 0.5        # of 128^3


def decay_rate(table):
    """-dE/dt by central differences, at the times between the first and the last."""
    t, energy = table["t"], table["E"]
    return t[1:-1], (energy[:-2] - energy[2:]) / (t[2:] - t[:-2])


def draw_taylor_green(folder):
    paths = {n: folder / f"taylor_green_3d_{n}.csv" for n in TAYLOR_GREEN}
    runs = {n: tables.read_table(path) for n, path in paths.items() if path.exists()}
    if not runs:
        raise MissingData(f"needs {paths[64]}")
    exact = tables.read_table(tables.REFERENCE / "tgv3d_re1600_spectral512.csv")
    shown = exact["t"] <= max(run["t"][-1] for run in runs.values()) + 1e-6
    every = np.flatnonzero(shown)[::6]
    figure, ((rate, energy),) = style.panels(None, 1, 2, figsize=(style.FULL_WIDTH, 2.8))
    for axes, column in ((rate, "eps"), (energy, "E")):
        axes.plot(exact["t"][every], exact[column][every], label="spectral DNS, $512^3$", zorder=3,
                  **style.reference_marks())
    peak = int(np.argmax(exact["eps"]))
    t_peak, eps_peak = exact["t"][peak], exact["eps"][peak]
    rate.add_patch(Rectangle((t_peak - TIME_TOLERANCE, (1 - PEAK_TOLERANCE) * eps_peak),
                             2 * TIME_TOLERANCE, 2 * PEAK_TOLERANCE * eps_peak, color="0.86", lw=0,
                             label="tolerance of the peak at $128^3$"))
    for n, run in runs.items():
        rate.plot(*decay_rate(run), color=TAYLOR_GREEN[n], label=f"${n}^3$")
        rate.plot(run["t"], run["resolved"], color=TAYLOR_GREEN[n], lw=0.8, ls=(0, (4, 1.5)),
                  label="resolved part $2\\nu S:S$" if n == max(runs) else None)
        energy.plot(run["t"], run["E"], color=TAYLOR_GREEN[n], label=f"${n}^3$")
    rate.set(xlim=(0, 10), ylim=(0, 0.0175), xlabel="$t\\,V_0/L$",
             ylabel="dissipation $-dE/dt\\; L/V_0^3$")
    energy.set(xlim=(0, 10), ylim=(0, 0.135), xlabel="$t\\,V_0/L$", ylabel="energy $E/V_0^2$")
    rate.legend(loc="upper left")
    energy.legend(loc="lower left")
    for index, axes in enumerate((rate, energy)):
        style.panel_label(axes, index)
    return figure


# --- order of accuracy ------------------------------------------------------------------------------

NORMS = (("u", "RMS error of $u$ (m/s)"), ("p", "RMS error of $p/\\rho$ (m$^2$/s$^2$)"),
         ("u_max", "largest error of $u$ (m/s)"),
         ("p_max", "largest error of $p/\\rho$ (m$^2$/s$^2$)"))
WALLS = {"no slip / no slip": "s", "no slip / free slip": "o", "free slip / free slip": "^"}
FRACTIONS = {"fixed fraction": style.BLUE, "moving fraction": style.VERMILLION}


def series(folder):
    """(label, colour, marker, columns by norm and 1/cells) of every case with its meshes."""
    parts = [tables.read_table(path) for path in sorted(folder.glob("manufactured_*.csv"))]
    for fraction, colour in FRACTIONS.items():
        for walls, marker in WALLS.items():
            rows = [part.where("fraction", fraction).where("walls", walls) for part in parts]
            columns = {name: np.concatenate([r[name] for r in rows])
                       for name in ("cells", *(norm for norm, _ in NORMS))} if rows else {}
            if columns and len(columns["cells"]):
                yield f"{fraction}, {walls}", colour, marker, columns
    path = folder / "taylor_green_2d.csv"
    if not path.exists():
        return
    vortex = tables.read_table(path)
    case = [f"{a:g}{b:g} {u:g} {v:g}" for a, b, u, v in
            zip(*(vortex[name] for name in ("a", "b", "mean_a", "mean_b")))]
    moving = (vortex["mean_a"] != 0) | (vortex["mean_b"] != 0)
    for name in dict.fromkeys(case):
        rows = np.array([other == name for other in case])
        carried = bool(moving[rows][0])
        yield ("Taylor-Green vortex, " + ("carried along, 2 ways" if carried else "3 planes"),
               style.GREEN if carried else style.ORANGE, "D" if carried else "v",
               {key: column[rows] for key, column in vortex.columns.items()})


def draw_convergence(folder):
    cases = list(series(folder))
    if not cases:
        raise MissingData(f"needs {folder}/manufactured_*.csv or taylor_green_2d.csv")
    figure, grid = style.panels(None, 2, 2, figsize=(style.FULL_WIDTH, 5.6), sharex=True)
    for index, (axes, (norm, label)) in enumerate(zip(grid.ravel(), NORMS)):
        seen = set()
        for name, colour, marker, columns in cases:
            order = np.argsort(columns["cells"])
            axes.plot(1 / columns["cells"][order], columns[norm][order], color=colour, marker=marker,
                      ms=3.5, lw=0.8, mfc="white", mew=0.8, label=None if name in seen else name)
            seen.add(name)
        low, high = (f(c[norm].min() if f is min else c[norm].max() for *_, c in cases)
                     for f in (min, max))
        for scale, text in ((1.6 * high, "slope 2"), (0.6 * low, None)):
            edge = 1 / 15 if text else 1 / 64
            x = np.array([1 / 64, 1 / 15])
            axes.plot(x, scale * (x / edge) ** 2, color="0.6", ls=":", lw=1.0, label=text)
        axes.set(xscale="log", yscale="log", ylabel=label)
        axes.set_xticks([1 / n for n in (15, 18, 24, 32, 48, 64)],
                        [f"1/{n}" for n in (15, 18, 24, 32, 48, 64)])
        axes.xaxis.set_minor_locator(NullLocator())
        style.panel_label(axes, index)
    for axes in grid[1]:
        axes.set_xlabel("cell size over the length of the flow")
    style.legend_outside(figure, grid[0, 0].get_legend_handles_labels()[0], -0.65, ncols=3)
    return figure
