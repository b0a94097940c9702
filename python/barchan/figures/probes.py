"""probes: velocity, pressure and shear stress on the floor at the probes of a run (probes.csv), a row for each; and
maps of the velocity in its slices (slice_NAME.h5) at the end.

Of a point against time; of a line means over the second half of the run, or over the window of --from and --to, with
a band of one standard deviation, against the distance from its first point. Of an upright line the height is upwards.
"""

import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from barchan.figures.result import keep
from barchan.io.study_folder import plain
from barchan.io.tables import thin
from barchan.stats import in_window

# label, {column: legend}
PANELS = (
    ("velocity (m/s)", {"u": "$u$", "v": "$v$", "w": "$w$"}),
    ("pressure (Pa)", {"p": None}),
    ("floor shear stress (Pa)", {"wall_shear_x": "along $x$", "wall_shear_z": "along $z$"}),
)
QUANTITIES = ("u", "v", "w", "p", "wall_shear_x", "wall_shear_z")
COLOURS = (style.BLUE, style.VERMILLION, style.GREEN)


def draw(run, ax=None, start=None, end=None):
    probes, slices = run.probe_columns or {}, run.slice_files
    count = len(probes) + len(slices)
    if count == 0:
        raise MissingData("needs probes.csv or slice_NAME.h5: [[output.probe]], [[output.slice]]")
    figure, rows = style.panels(ax, count, len(PANELS), figsize=(style.FULL_WIDTH, 0.2 + 2.0 * count))
    for (name, table), row in zip(probes.items(), rows):
        if np.any(table["point"] > 0):
            draw_line(row, means_along(table, start, end))
        else:
            draw_point(row, table)
        row[1].set_title(plain(name))  # the others have legends there
    if probes:
        keep(figure, "probes", kept(probes, start, end), most=None)
    for (name, file), row in zip(slices.items(), rows[len(probes):]):
        keep(figure, f"slice_{name}", draw_slice(row, name, file))
    return figure


def kept(probes, start, end):
    """What is drawn: series of the points; means of the lines, at the time of their window's end."""
    parts = []
    for number, table in enumerate(probes.values()):
        if np.any(table["point"] > 0):
            means = means_along(table, start, end)
            parts.append({**means, "probe": np.full(len(means["point"]), number)})
        else:
            rows = thin(len(table["t"]))
            parts.append({key: values[rows] for key, values in table.items()})
    names = ["t", "probe", "point", "x", "y", "z", *QUANTITIES]
    return {name: np.concatenate([part[name] for part in parts]) for name in names}


def means_along(table, start=None, end=None):
    """{column: mean at each point (n)} over a window of time, with {column}_deviation, and the distance s [m]."""
    chosen = in_window(table["t"], start, end)
    if not chosen.any():
        raise MissingData(f"needs a time of each probe in the window; it has t = {table['t'][0]:g} to "
                          f"{table['t'][-1]:g} s")
    points = np.unique(table["point"])
    of_point = [chosen & (table["point"] == point) for point in points]
    means = {name: np.array([np.mean(table[name][rows]) for rows in of_point]) for name in ("x", "y", "z", *QUANTITIES)}
    means |= {f"{name}_deviation": np.array([np.std(table[name][rows]) for rows in of_point]) for name in QUANTITIES}
    places = np.stack([means[axis] for axis in "xyz"], axis=1)
    last = table["t"][chosen][-1]
    return {**means, "t": np.full(len(points), last), "point": points, "s": np.linalg.norm(places - places[0], axis=1)}


def draw_point(row, table):
    lines = thin(len(table["t"]))
    for axes, (label, columns) in zip(row, PANELS):
        for (name, legend), colour in zip(columns.items(), COLOURS):
            axes.plot(table["t"][lines], table[name][lines], color=colour, lw=0.9, label=legend,
                      marker=style.mark_if_few(lines), ms=3)
        axes.set(xlabel="$t$ (s)", ylabel=label)
        axes.margins(x=0.0)
        legend_of(axes, columns)


def draw_line(row, means):
    upright = np.ptp(means["x"]) == 0 and np.ptp(means["z"]) == 0
    place = 1e3 * (means["y"] if upright else means["s"])
    for axes, (label, columns) in zip(row, PANELS):
        if upright and "wall_shear_x" in columns:  # one place on the floor
            axes.set_visible(False)
            continue
        for (name, legend), colour in zip(columns.items(), COLOURS):
            mean, spread = means[name], means[f"{name}_deviation"]
            curve, band = (mean, place), (axes.fill_betweenx if upright else axes.fill_between)
            axes.plot(*(curve if upright else curve[::-1]), color=colour, label=legend,
                      marker=style.mark_if_few(mean), ms=3)
            band(place, mean - spread, mean + spread, color=colour, alpha=0.2, lw=0)
        words = (label, "height $y$ (mm)") if upright else ("distance along the line (mm)", label)
        axes.set(xlabel=words[0], ylabel=words[1])
        legend_of(axes, columns)


def draw_slice(row, name, file):
    """Maps of u, v and w in the last frame; what is drawn, a line for each cell."""
    time, group = file.frames[-1][:2]
    with file.open() as content:
        faces = {axis: content[f"grid/{axis}_face"][:] for axis in "xyz"}
        flow = {part: content[f"{group}/{part}"][:] for part in "uvw"}
    normal = min("xyz", key=lambda axis: len(faces[axis]))
    across, up = {"x": ("z", "y"), "y": ("x", "z"), "z": ("x", "y")}[normal]
    for axes, (part, values) in zip(row, flow.items()):
        plane = np.squeeze(values, axis="zyx".index(normal))  # rows are along the first of z, y, x that is left
        plane = plane if "zyx".index(up) < "zyx".index(across) else plane.T
        most = float(np.abs(plane).max()) or 1.0
        signed = plane.min() < 0
        image = axes.pcolormesh(1e3 * faces[across], 1e3 * faces[up], plane, rasterized=True, vmax=most,
                                vmin=-most if signed else 0.0, cmap="RdBu_r" if signed else "viridis")
        axes.set(aspect="equal", xlabel=f"${across}$ (mm)", ylabel=f"${up}$ (mm)")
        axes.figure.colorbar(image, ax=axes, location="bottom", label=f"${part}$ (m/s)")
    middle = float(faces[normal].mean())
    row[1].set_title(f"{plain(name)}: ${normal}$ = {1e3 * middle:.3g} mm, $t$ = {time:.3g} s")
    centres = {axis: 0.5 * (at[1:] + at[:-1]) for axis, at in faces.items()}
    z, y, x = (part.ravel() for part in np.meshgrid(centres["z"], centres["y"], centres["x"], indexing="ij"))
    return {"x": x, "y": y, "z": z, **{part: values.ravel() for part, values in flow.items()}}


def legend_of(axes, columns):
    if len(columns) > 1:
        style.legend_above(axes, axes.get_lines())
