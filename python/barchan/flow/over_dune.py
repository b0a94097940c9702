"""The mean flow over a frozen dune in its vertical plane of symmetry."""

from typing import Any

import numpy as np

from barchan.dune.outline import Outline
from barchan.io.flow_average import FlowAverage
from barchan.io.run_folder import RunFolder

STILL = 0.01  # of U_delta: slower water has no direction


def friction_velocity(run: RunFolder, average: FlowAverage) -> float:
    """Friction velocity of the walls during a time average.

    Parameters
    ----------
    run : Run
        The run.
    average : FlowAverage
        Its mean flow.

    Returns
    -------
    float
        u_star [m/s]: the mean of history.csv over the window, else that of the mean flow in the lowest cells.
    """
    history = run.history_columns
    if history is not None and "u_star" in history:
        inside = (history["t"] >= average.start) & (history["t"] <= average.end)
        values = history["u_star"][inside & np.isfinite(history["u_star"])]
        if len(values) and values.mean() > 0.0:
            return float(values.mean())
    nu = float(run.config.get("fluid", {}).get("kinematic_viscosity", 1e-6))
    return float(np.sqrt(nu * abs(average.bottom) / average.y[0]))


def in_streamline_axes(fields: dict[str, np.ndarray], still: float) -> dict[str, np.ndarray]:
    """Rotates means and second moments into the local direction of the mean flow.

    The angle is kept within a quarter turn of x, so that u is negative in reversed flow; it is zero where the water has
    no
    direction.

    Parameters
    ----------
    fields : dict of str to numpy.ndarray
        u, v [m/s], uu, vv, uv [m2/s2], arrays of one shape.
    still : float
        Speed below which water has no direction [m/s].

    Returns
    -------
    dict of str to numpy.ndarray
        Of the same shape: angle [rad], u along it [m/s], moments along (uu), across (vv) and of both (uv) [m2/s2].
    """
    u, v = fields["u"], fields["v"]
    with np.errstate(divide="ignore", invalid="ignore"):
        angle = np.where(np.hypot(u, v) <= still, 0.0, np.arctan(v / u))
    c, s = np.cos(angle), np.sin(angle)
    uu, vv, uv = fields["uu"], fields["vv"], fields["uv"]
    return {"angle": angle, "u": c * u + s * v,
            "uu": c * c * uu + 2.0 * c * s * uv + s * s * vv,
            "vv": s * s * uu - 2.0 * c * s * uv + c * c * vv,
            "uv": (c * c - s * s) * uv + c * s * (vv - uu)}


def profiles_at(average: FlowAverage, outline: Outline, stations: np.ndarray) -> list[dict[str, Any]]:
    """Profiles of the mean flow above the surface of a dune.

    Parameters
    ----------
    average : FlowAverage
        The mean flow.
    outline : Outline
        Outline of the dune.
    stations : numpy.ndarray
        (n) places along the dune, in units of its length from its toe.

    Returns
    -------
    list of dict
        (n) of station [1], x, z and height h of the surface [m], and, from the lowest cell up, arrays (m): distance y_d
        from the surface [m], v [m/s] and what `in_streamline_axes` returns.
    """
    points = outline.foot + stations * outline.length
    columns = average.above(points, outline.z)
    rotated = in_streamline_axes(columns.fields, STILL * average.top)
    result = []
    for n, (station, x) in enumerate(zip(stations, points)):
        h = float(outline.height(x))
        above = columns.y > h
        fields = {name: values[n][above] for name, values in rotated.items()}
        fields["v"] = columns.fields["v"][n][above]
        result.append({"station": station, "x": x, "z": outline.z, "h": h,
                       "y_d": columns.y[above] - h, **fields})
    return result


def separation_bubble(average: FlowAverage, outline: Outline, behind: float = 2.0) -> dict[str, float]:
    """Where the mean flow in the lowest cells above the surface runs backwards behind the crest.

    It is looked for in the plane of the outline, from its highest point. It is known within a cell along the flow, and
    its
    ends within the height of the lowest cell.

    Parameters
    ----------
    average : FlowAverage
        The mean flow.
    outline : Outline
        Outline of the dune.
    behind : float, optional
        How far behind the lee foot it is looked for, in lengths of the dune.

    Returns
    -------
    dict of str to float
        separation, reattachment (x) and length [m]; NaN where no water runs backwards.
    """
    crest = float(outline.x[np.argmax(outline.h)])
    end = min(outline.foot + (1.0 + behind) * outline.length, float(average.x[-1]))
    x = np.linspace(crest, end, max(3, int(4 * (end - crest) / (average.x[1] - average.x[0]))))
    columns = average.above(x, outline.z)
    h = np.array([outline.height(each) for each in x])
    lowest = np.argmax(columns.y[None, :] > h[:, None], axis=1)
    return backflow(x, columns.fields["u"][np.arange(len(x)), lowest])


def backflow(x: np.ndarray, u: np.ndarray) -> dict[str, float]:
    """The longest stretch of reversed flow along a line.

    Its ends are where u is zero on straight lines between the points; a stretch that reaches an end of the line is cut
    there.

    Parameters
    ----------
    x : numpy.ndarray
        (n) places, ascending [m].
    u : numpy.ndarray
        (n) velocity along the line [m/s].

    Returns
    -------
    dict of str to float
        separation, reattachment (x) and length [m]; NaN where u is nowhere negative.
    """
    back = np.concatenate([[False], u < 0, [False]])
    first, after = (np.nonzero(np.diff(back.astype(int)) == way)[0] for way in (1, -1))
    if not len(first):
        return dict.fromkeys(("separation", "reattachment", "length"), float("nan"))

    def zero(i: int) -> float:
        """Between the points i - 1 and i."""
        if i in (0, len(x)):
            return float(x[min(i, len(x) - 1)])
        return float(x[i - 1] - u[i - 1] * (x[i] - x[i - 1]) / (u[i] - u[i - 1]))

    stretches = [(zero(a), zero(b)) for a, b in zip(first, after)]
    begin, end = max(stretches, key=lambda each: each[1] - each[0])
    return {"separation": begin, "reattachment": end, "length": end - begin}
