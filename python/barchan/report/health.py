"""Is a run healthy? Each number that can tell, its limit, and a plain verdict."""

from dataclasses import dataclass

import numpy as np

OK, LOOK, UNKNOWN = "ok", "look at this", "not recorded"

ROUND_OFF = 1e-9         # a mismatch of momentum or volume far above what rounding leaves (1e-16 to 1e-12)
LARGEST_CFL = 0.5        # docs/choosing.md, "Fluid step"
LARGEST_OVERLAP = 0.05   # docs/choosing.md, "Young's modulus"
LARGEST_DRIFT = 0.05     # of u_star between the third and the fourth quarter of the run
LARGEST_LOSS = 0.2       # of the grains


@dataclass
class Check:
    name: str
    value: str
    limit: str
    verdict: str
    about: str


def checks(run, summary):
    """All checks that the run allows; `summary` is run.json ({} when there is none)."""
    found = [status(summary)]
    flow, grains = holds(run.config)
    if flow:
        found += [cfl(run, summary), continuity(run, summary), iterations(run, summary), drift(run)]
    if flow and grains:
        found += ledger(run, summary)
    if grains:
        found += [overlap(run, summary), grain_step(run, summary), balance(summary)]
    return found


def holds(config):
    """Does the case have a flow, and grains? A configuration that names neither is not a whole one."""
    sections = [name in config for name in ("fluid", "grains")]
    return sections if any(sections) else (True, True)


def status(summary):
    state = summary.get("status")
    about = {"done": "The run reached its end.",
             "running": "The run goes on, or was killed: this page shows how far it came.",
             "stopped": "Stopped on request; it can go on from its restart file.",
             "failed": "The run stopped by itself."}.get(state, "There is no run.json.")
    message = summary.get("message")
    verdict = OK if state == "done" else LOOK if state else UNKNOWN
    return Check("status", state or "unknown", "done", verdict, f"{about} {message or ''}".strip())


def extreme(run, summary, key, column):
    """Largest value: of run.json, of history.csv for what ran before; None when nobody knows."""
    values = [summary[key] if summary[key] is not None else np.inf] if key in summary else []
    if run.history_columns is not None and column in run.history_columns:
        recorded = run.history_columns[column]
        values.append(np.inf if np.isinf(recorded).any() else np.nanmax(np.append(recorded, -np.inf)))
    values = [value for value in values if value != -np.inf]
    return max(values) if values else None


def percent(share):
    return f"{100 * share:.3g} %"


def judged(name, value, limit, about, shown="{:.3g}".format):
    """A check that is fine up to `limit`; a value that is not finite was nan or infinite in the run."""
    if value is None:
        return Check(name, "–", f"≤ {shown(limit)}", UNKNOWN, about)
    return Check(name, shown(value) if np.isfinite(value) else "not finite", f"≤ {shown(limit)}",
                 OK if value <= limit else LOOK, about)


def cfl(run, summary):
    return judged("largest CFL number", extreme(run, summary, "max_cfl", "cfl"), LARGEST_CFL,
                  "Time step against the time to cross a cell. Up to 0.5 is good; beyond 1 the run stops. "
                  "Cure: a shorter time.fluid_step.")


def continuity(run, summary):
    """The residual [1/s] relative to the rate at which water passes through a cell, CFL/dt."""
    value = extreme(run, summary, "max_continuity_residual", "continuity_residual")
    largest = extreme(run, summary, "max_cfl", "cfl")
    step = run.config.get("time", {}).get("fluid_step", 2.5e-4)
    tolerance = run.config.get("solver", {}).get("pressure_tolerance", 1e-6)
    about = (f"Volume that appears or vanishes, per volume that passes through a cell (CFL/dt). The pressure "
             f"solver leaves its tolerance, {tolerance:g}, in the mean; the limit is a hundred times that.")
    relative = value * step / largest if value is not None and largest else None
    check = judged("continuity residual, relative", relative, 100 * tolerance, about, "{:.1e}".format)
    if relative is not None:
        check.value += f" ({value:.1e} 1/s)"
    return check


def iterations(run, summary):
    most = run.config.get("solver", {}).get("max_iterations", 200)
    value = extreme(run, summary, "pressure_iterations_max", "pressure_iterations")
    check = judged("pressure iterations", value, most - 1,
                   "With local_fft about 4 over a heap and 0 without grains. At solver.max_iterations the "
                   "solve ends before its tolerance.", "{:.0f}".format)
    mean = summary.get("pressure_iterations_mean")
    check.value += f" (mean {mean:.1f})" if mean is not None and value is not None else ""
    return check


def drift(run):
    """Change of the mean u_star from the third to the fourth quarter of the recorded time."""
    about = ("Friction velocity of the walls: change of its mean from the third to the last quarter of the "
             "run. A flow that still develops drifts.")
    history, value = run.history_columns, None
    if history is not None and "u_star" in history and len(history["t"]) >= 16:
        late = history["t"] - history["t"][0] >= 0.5 * np.ptp(history["t"])
        third, fourth = np.array_split(history["u_star"][late], 2)
        value = abs(np.mean(fourth) / np.mean(third) - 1.0) if np.mean(third) else None
        value = np.inf if value is not None and np.isnan(value) else value
    return judged("drift of u*", value, LARGEST_DRIFT, about, percent)


def ledger(run, summary):
    entries = summary.get("ledger") or {}
    about = {"volume": "Solid volume given to the mesh against that of the grains.",
             "exchange": "Momentum that the grains got against what the water lost."}
    coupling = run.config.get("coupling", {})
    # The second is how runs of version 0.3 and earlier say it.
    if coupling.get("scheme") == "cfdem" or coupling.get("void_fraction") == "cfdem_faithful":
        about["volume"] += " coupling.scheme = cfdem drops volume: expected above it."
    result = []
    for name, text in about.items():
        key = f"largest_{name}_mismatch"
        value = (np.inf if entries[key] is None else abs(entries[key])) if key in entries else None
        result.append(judged(f"ledger: {name} mismatch", value, ROUND_OFF,
                             f"{text} Round-off, 1e-16 to 1e-12; more in a step whose sum nearly cancels.",
                             "{:.1e}".format))
    return result


def overlap(run, summary):
    return judged("largest overlap", extreme(run, summary, "max_overlap", "max_overlap"), LARGEST_OVERLAP,
                  "Of a touching pair, over the sum of its radii. More: grains too soft, or a grain step too "
                  "long.",
                  percent)


def grain_step(run, summary):
    name = "grain_step_over_stable"
    return judged("grain step over stable step", extreme(run, summary, name, name), 1.1,
                  "The longest step for which the contacts are stable follows from the stiffness and damping of "
                  "all contacts of a grain. Beyond it grains that lie still shake by themselves. Cure: a shorter "
                  "time.grain_step.")


def balance(summary):
    keys = ("grains_initial", "grains_inside", "grains_left")
    if any(summary.get(key) is None for key in keys):
        return Check("grains", "–", "inside + left = initial", UNKNOWN, "No count in run.json.")
    initial, inside, left = (summary[key] for key in keys)
    fed = summary.get("grains_fed", 0)
    lost = max(left - fed, 0) / initial if initial else 0.0  # and not made up for
    good = inside + left == initial + fed and lost <= LARGEST_LOSS
    about = ("No grain may vanish; those beyond the outlet have left. "
             f"Above {percent(LARGEST_LOSS)} lost, the dune is no longer the one that started.")
    if not fed:
        return Check("grains", f"{inside:,} inside + {left:,} left ({percent(lost)}) of {initial:,}",
                     f"sum = initial; left ≤ {percent(LARGEST_LOSS)}", OK if good else LOOK, about)
    return Check("grains", f"{inside:,} inside + {left:,} left of {initial:,} initial + {fed:,} fed",
                 f"sum = initial + fed; lost and not fed ≤ {percent(LARGEST_LOSS)}", OK if good else LOOK, about)
