"""dem_cases: grains alone beside closed forms and other programs, from the runs of configs/benchmark. `--keep` takes
the folder of these runs, runs/benchmark.

Of MFiX's six verifications: heights of DEM01 to DEM03 (m) over time (s), in DEM02 over the number of the bounce; of
DEM04 the time until it rolls, mu g t/u0, and its last speed over the first, over mu; of DEM05 rebound angles
(degrees) and spins (rad/s) over the angle of impact; of DEM06 the speed in the duct (m/s). Then the centre of the
ball of penetration-* above the floor (m), over the time since it was at the published start, and the mean velocity of
the layers of chute along it, over their height.
"""

from pathlib import Path

import numpy as np

from barchan.errors import MissingData
from barchan.figures import style
from barchan.io.run_folder import RunFolder
from barchan.io.study_folder import gap_of
from barchan.io.tables import thin
from validation import by_id, tables

NAME = "dem_cases"
COLUMNS = "what,case,x,y,expected"
GAS = 0.4  # speed of the air of DEM06 [m/s]
LAYER = 2.0  # height of the layers of the chute, in diameters
MEAN_OVER = 5  # frames at the end over which their velocity is taken


class Tracks:
    """Times (n) and the places, velocities and spins (n, grains, 3) of the grains of a run, by id."""

    def __init__(self, run):
        file = run.need_grains()
        self.x, self.u, self.omega, self.d = by_id.motion(file)
        self.t, self.size, self.grains = file.times, run.config["domain"]["size"], run.config["grains"]
        self.gravity = -self.grains["gravity"][1]
        kinds = self.grains.get("kind") or [self.grains]
        self.mass = np.array([kind["density"] for kind in kinds])[:len(self.d)] * np.pi / 6 * self.d ** 3


def damping(restitution):
    """Part of the critical damping that gives a linear spring its restitution."""
    log_e = np.log(restitution)
    return -log_e / np.hypot(log_e, np.pi)


def oscillate(matrix, rest, start, times):
    """State at each time of a linear system that would come to rest in `rest`."""
    values, vectors = np.linalg.eig(matrix)
    shares = np.linalg.solve(vectors, (start - rest).astype(complex))
    return rest + np.real((np.exp(np.outer(times, values)) * shares) @ vectors.T)


def falling(tracks):
    """The heights of DEM01: fall, contact until the overlap is gone, flight."""
    radius, mass, g, start = tracks.d[0] / 2, tracks.mass[0], tracks.gravity, tracks.x[0, 0, 1]
    k, ratio = tracks.grains["linear_stiffness"], damping(tracks.grains["restitution"])
    omega = np.sqrt(k / mass)
    matrix = np.array([[0.0, 1.0], [-omega ** 2, -2 * ratio * omega]])
    touch = np.sqrt(2 * (start - radius) / g)
    fine = np.linspace(0, 2 * np.pi / omega, 200001)
    contact = oscillate(matrix, np.array([radius - mass * g / k, 0]), np.array([radius, -g * touch]), fine)
    end = 1 + int(np.argmax(contact[1:, 0] >= radius))
    after = tracks.t - touch - fine[end]
    flight = radius + contact[end, 1] * after - g * after ** 2 / 2
    inside = np.interp(tracks.t - touch, fine, contact[:, 0])
    exact = np.where(tracks.t < touch, start - g * tracks.t ** 2 / 2, np.where(after < 0, inside, flight))
    yield "falling", tracks.t, tracks.x[:, 0, 1], exact


def bouncing(tracks):
    """The tops of the bounces of DEM02, from the energy of the fastest frame in flight, beside hard spheres."""
    radius, height, speed = tracks.d[0] / 2, tracks.x[:, 0, 1], tracks.u[:, 0, 1]
    top = height + speed ** 2 / (2 * tracks.gravity)
    turns = np.flatnonzero((speed[:-1] > 0) & (speed[1:] <= 0) & (height[:-1] > radius)) + 1
    number = np.arange(1, len(turns) + 1)
    hard = radius + (height[0] - radius) * tracks.grains["restitution"] ** (2 * number)
    yield "bouncing", number, top[turns], hard


def squeezed(tracks):
    """The heights of both spheres of DEM03 beside two coupled oscillators."""
    k, ratio, (m1, m2), d = (tracks.grains["linear_stiffness"], damping(tracks.grains["restitution"]), tracks.mass,
                             tracks.d[0])
    pair, wall = 2 * ratio * np.sqrt(k * m1 * m2 / (m1 + m2)), 2 * ratio * np.sqrt(k * tracks.mass)
    springs = np.array([[-2 * k, k], [k, -2 * k]]) / tracks.mass[:, None]
    dashpots = np.array([[-pair - wall[0], pair], [pair, -pair - wall[1]]]) / tracks.mass[:, None]
    push = k * np.array([d / 2 - d, d + tracks.size[1] - d / 2]) / tracks.mass - tracks.gravity
    rest = np.append(np.linalg.solve(springs, -push), [0, 0])
    matrix = np.block([[np.zeros((2, 2)), np.eye(2)], [springs, dashpots]])
    exact = oscillate(matrix, rest, np.append(tracks.x[0, :, 1], [0, 0]), tracks.t)
    for grain in (0, 1):
        yield f"squeezed {grain + 1}", tracks.t, tracks.x[:, grain, 1], exact[:, grain]


def slipping(tracks):
    """When the sphere of DEM04 rolls, by the line through its speed while it slips, and how fast it is at the end."""
    mu, speed = tracks.grains["sliding_friction"], tracks.u[:, 0, 0]
    slips = speed > 0.8 * speed[0]
    slope, first = np.polyfit(tracks.t[slips], speed[slips], 1)
    last = speed[-len(speed) // 5:].mean()
    yield "until it rolls", np.array([mu]), np.array([mu * tracks.gravity * (last - first) / slope / speed[0]]), \
        np.array([2 / 7])
    yield "rolls", np.array([mu]), np.array([last / speed[0]]), np.array([5 / 7])


def oblique(tracks):
    """Angles and spins after the impacts of DEM05 beside those that MFiX gives for the same law."""
    before, after = tracks.u[0], tracks.u[-1]
    angle = np.degrees(np.arctan2(before[:, 0], -before[:, 1]))
    given = tables.read_table(tables.REFERENCE / "dem_programs.csv")
    for what, result in (("rebound", np.degrees(np.arctan2(after[:, 0], after[:, 1]))),
                         ("spin", -tracks.omega[-1, :, 2])):
        theirs = of_case(given, what, "MFiX")
        same = [int(np.argmin(abs(angle - x))) for x in theirs["x"]]
        yield what, angle[same], result[same], theirs["y"]


def sinking(tracks):
    """The speed of DEM06 in its duct beside that of a fine Runge-Kutta solution."""
    d, air = tracks.d[0], tracks.grains["ambient"]
    heavy = tracks.grains["density"] / air["density"]

    def rate(speed):
        reynolds = abs(speed) * d / air["kinematic_viscosity"]
        drag = 18 * air["kinematic_viscosity"] / (heavy * d ** 2) * (1 + 0.15 * reynolds ** 0.687)
        return -tracks.gravity * (1 - 1 / heavy) - drag * speed

    steps = 200
    speed, exact = tracks.u[0, 0, 1], [tracks.u[0, 0, 1]]
    for h in np.diff(tracks.t) / steps:
        for _ in range(steps):
            one = rate(speed)
            two = rate(speed + h / 2 * one)
            three = rate(speed + h / 2 * two)
            speed += h / 6 * (one + 2 * two + 2 * three + rate(speed + h * three))
        exact.append(speed)
    yield "sinking", tracks.t, tracks.u[:, 0, 1] + GAS, np.array(exact) + GAS


def impact(run):
    """The height of the ball: the largest grain."""
    file, heights = run.need_grains(), []
    with file.open() as content:
        for _, name in file.frames:
            heights.append(content[name]["x"][int(np.argmax(content[name]["d"][:])), 1])
    yield "impact", file.times - file.times[0], np.array(heights), np.full(len(heights), np.nan)


def chute(run):
    """The mean velocity along the chute of layers of equal height, over the last frames."""
    file, height, speed = run.need_grains(), [], []
    with file.open() as content:
        for _, name in file.frames[-MEAN_OVER:]:
            height.append(content[name]["x"][:, 1])
            speed.append(content[name]["u"][:, 0])
    layer = (np.concatenate(height) / LAYER).astype(int)
    count, total = np.bincount(layer), np.bincount(layer, np.concatenate(speed))
    some = count > 100
    yield "chute", LAYER * (np.flatnonzero(some) + 0.5), total[some] / count[some], np.full(some.sum(), np.nan)


def by_tracks(measure):
    return lambda run: measure(Tracks(run))


MEASURED = {"mfix-dem01": by_tracks(falling), "mfix-dem02": by_tracks(bouncing), "mfix-dem03": by_tracks(squeezed),
            "mfix-dem04": by_tracks(slipping), "mfix-dem05": by_tracks(oblique), "mfix-dem06": by_tracks(sinking),
            "penetration-25k": impact, "chute": chute}


def of_case(table, what, case):
    rows = table.where("what", what)
    return {column: rows[column][rows["case"] == case] for column in ("x", "y")}


def save(runs, folder):
    """Keeps the curves of the finished runs as dem_cases.csv; its path."""
    lines, run = [], None
    for name, measure in MEASURED.items():
        for file in [Path(runs) / name / "grains.h5", *sorted(Path(runs).glob(f"{name}-study/*/grains.h5"))]:
            if gap_of(file.parent):
                continue
            run = RunFolder(file.parent)
            case = name if file.parent.name == name else f"{name} {file.parent.name}"
            for what, x, y, exact in measure(run):
                lines += [f"{what},{case},{x[n]:.6g},{y[n]:.7g},{exact[n]:.7g}" for n in thin(len(x), 41)]
    if not lines:
        raise MissingData(f"needs a finished run of a case of configs/benchmark in {runs}")
    return tables.keep(folder / f"{NAME}.csv", "Cases of other programs", "./barchan run, sweep (configs/benchmark)",
                       run.summary, [COLUMNS, *lines])


def summary(folder):
    """For each curve its last value, and how far at most it is from what is expected, over the largest of that."""
    table = tables.read_saved(folder, NAME)
    for what, case in dict.fromkeys(zip(table["what"], table["case"])):
        rows = (table["what"] == what) & (table["case"] == case)
        y, exact = table["y"][rows], table["expected"][rows]
        line = f"{what}, {case} | last {y[-1]:.5g}"
        if np.isfinite(exact).all():
            line += f" of {exact[-1]:.5g} | off by at most {100 * np.max(abs(y - exact)) / np.max(abs(exact)):.2g} %"
        yield line


def draw(folder):
    """Bounces of DEM02, rebounds of DEM05, the ball of the penetration and the chute, beside the other programs."""
    table, given = tables.read_saved(folder, NAME), tables.read_table(tables.REFERENCE / "dem_programs.csv")
    figure, panels = style.panels(None, 1, 4, figsize=(style.FULL_WIDTH, 2.5))
    for index, (axes, (what, cases)) in enumerate(zip(panels.ravel(), PANELS.items())):
        for place, case in enumerate(cases):
            ours = of_case(table, what, case)
            turned = what == "chute"
            axes.plot(*(ours["y"], ours["x"]) if turned else (ours["x"], ours["y"]), lw=1.0, color=style.GROUPS[place],
                      label=cases[case])
        for place, program in enumerate(dict.fromkeys(given["case"][given["what"] == what])):
            theirs = of_case(given, what, program)
            axes.plot(*(theirs["y"], theirs["x"]) if what == "chute" else (theirs["x"], theirs["y"]),
                      **style.reference_marks(style.GROUPS[place]), label=program)
        axes.set(xlabel=LABELS[what][0], ylabel=LABELS[what][1])
        axes.legend(loc="best")
        style.panel_label(axes, index)
    return figure


PANELS = {"bouncing": {"mfix-dem02": "e = 0.9"}, "rebound": {"mfix-dem05": "this code"},
          "impact": {"penetration-25k": "25,000"}, "chute": {"chute": "this code"}}
LABELS = {"bouncing": ("bounce", "height (m)"), "rebound": ("impact (°)", "rebound (°)"),
          "impact": ("time (s)", "ball above the floor (m)"), "chute": ("velocity (√(g d))", "height (d)")}
