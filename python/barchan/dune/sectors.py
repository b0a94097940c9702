"""The paper's statements on horn grains and on the force on grains, judged by a run (Lima et al. 2022, Figs. 11, 13).

Angles in degrees: 0 downstream, 90 left (z < Cz), 270 right. Forces in N.
"""

from typing import Any

import numpy as np

from barchan.dune import forces as force_average
from barchan.dune.horns import find_horns, in_sectors
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.stats import within

SECTORS = ((105, 160), (210, 260))         # of the paper's text on its Fig. 11
STRONG_SECTORS = ((100, 160), (210, 260))  # where the paper sees the strongest F_x
CREST = 0.1                                # half width of "on the crest", in L
INNER = 0.25                               # half width of crest and of what is between the horns, in W


def judge_origins(run: Any, time: float | None = None) -> tuple[str, dict[str, float]]:
    horns, last = find_horns(run), tracks(run).index(time)
    rows = horns.heap.rows(horns.ever(last))
    if len(rows) == 0:
        raise MissingData(f"needs a dune with horns up to t = {horns.t[last]:.3g} s")
    phi = horns.heap.phi[rows]
    share, uniform = sector_share(phi)
    heap, _ = sector_share(horns.heap.phi[horns.heap.own])
    heap_outer = float(np.mean(horns.heap.r[horns.heap.own] > 0.5))
    upstream, outer = horns.upstream(horns.heap.id[rows]), float(np.mean(horns.heap.r[rows] > 0.5))
    names = " and ".join(f"{low}-{high}" for low, high in SECTORS)
    sentence = (f"horn grains up to t = {horns.t[last]:.3g} s: {len(rows)}, {100 * share:.1f} % from {names} "
                f"degrees (uniform {100 * uniform:.1f} %, heap {100 * heap:.1f} %), "
                f"{100 * upstream:.1f} % from the upstream half, {100 * outer:.1f} % from r > R/2 "
                f"(heap {100 * heap_outer:.1f} %)")
    return sentence, {"t": horns.t[last], "n_horn_grains": len(rows), "share_in_sectors": share,
                      "share_in_sectors_uniform": uniform, "share_in_sectors_heap": heap,
                      "share_upstream": upstream, "share_outer_half": outer}


def judge_forces(run: Any, start: float | None = None,
                 end: float | None = None) -> tuple[str, dict[str, float]]:
    forces = force_average.read(run, start, end)
    x, z = forces.place
    crest, W, L = dune_shape(run, forces)
    bins, inner = forces.bins, abs(z) < INNER * W
    phi = 0.5 * (bins["phi_min"] + bins["phi_max"])
    strong = np.any([(phi >= low) & (phi <= high) for low, high in STRONG_SECTORS], axis=0)
    outward = {**bins, "out": bins["F_z"] * np.sign(z), "size": abs(bins["F_x"])}
    values = {
        "F_x_upstream": mean(bins, "F_x", x < crest - CREST * L),
        "F_x_crest": mean(bins, "F_x", (abs(x - crest) <= CREST * L) & inner),
        "F_x_between_horns": mean(bins, "F_x", (x > crest + CREST * L) & inner),
        "F_z_outward_upstream": mean(outward, "out", (x < crest) & ~inner),
        "F_z_outward_downstream": mean(outward, "out", (x >= crest) & ~inner),
        "F_x_size_in_sectors": mean(outward, "size", strong),
        "F_x_size_elsewhere": mean(outward, "size", ~strong),
    }
    sentence = (
        f"force ({forces.caption.replace('$', '').replace('≤', '<=')}): "
        f"F_x {say(values['F_x_upstream'])} upstream of the crest (paper +), "
        f"{say(values['F_x_crest'])} on the crest (-), "
        f"{say(values['F_x_between_horns'])} between the horns (-); "
        f"outward F_z {say(values['F_z_outward_upstream'])} upstream (+), "
        f"{say(values['F_z_outward_downstream'])} downstream (-); mean |F_x| "
        f"{values['F_x_size_in_sectors']:.2g} N in 100-160 and 210-260 degrees, "
        f"{values['F_x_size_elsewhere']:.2g} N elsewhere (paper: stronger in them)")
    return sentence, values


def say(force: float) -> str:
    return f"{force:+.2g} N"


def mean(bins: dict[str, np.ndarray], name: str, chosen: np.ndarray) -> float:
    """Mean per grain over some of the bins; NaN for none."""
    number = bins["n"][chosen]
    return float(np.sum(number * bins[name][chosen]) / number.sum()) if number.sum() else np.nan


def dune_shape(run: Any, forces: force_average.ForceMap) -> tuple[float, float, float]:
    """Means over the window: crest from the centroid along x, W and L [m]."""
    main = run.main_dune_columns
    inside = np.ones(len(main["t"]), bool)
    if forces.start is not None and forces.end is not None:
        inside = within(main["t"], forces.start, forces.end)
    if not inside.any():
        raise MissingData(f"needs dune.csv between t = {forces.start:g} s and {forces.end:g} s")
    crest = main["crest_x"][inside] - main["Cx"][inside]
    if run.domain is not None:  # across a periodic boundary
        crest -= run.domain[0] * np.round(crest / run.domain[0])
    return float(np.mean(crest)), float(np.mean(main["W"][inside])), float(np.mean(main["L"][inside]))


def sector_share(phi: np.ndarray) -> tuple[float, float]:
    """(share of the angles inside the paper's sectors, what a uniform distribution gives)."""
    return float(np.mean(in_sectors(phi, SECTORS))), sum(high - low for low, high in SECTORS) / 360
