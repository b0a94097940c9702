"""sectors: the paper's statements on horn grains and on the force on grains, judged by a run; no picture.

One line on where horn grains began (text on Fig. 11 of Lima et al. 2022), one on the signs of the
mean force (text on Fig. 13). The numbers are in figures_data/sectors.csv.
"""

import numpy as np

import force_average
from horn_grains import find_horns
from horn_origins import SECTORS, sector_share
from run_folder import NotInRun
from tracks import tracks

OPTIONS = ("time", "start", "end")
STRONG_SECTORS = ((100, 160), (210, 260))  # [degrees] where the paper sees the strongest F_x
CREST = 0.1                                # half width of "on the crest", in L
INNER = 0.25                               # half width of crest and of what is between the horns, in W


def draw(run, time=None, start=None, end=None):
    results, reasons = {}, []
    for judge, options in ((judge_origins, (time,)), (judge_forces, (start, end))):
        try:
            sentence, values = judge(run, *options)
            print(sentence)
            results.update(values)
        except NotInRun as reason:
            reasons.append(str(reason))
    if not results:
        raise NotInRun("; ".join(reasons))
    write(run, results)


def write(run, results):
    folder = run.path / "figures_data"
    folder.mkdir(exist_ok=True)
    lines = ["quantity,value"] + [f"{name},{value:.9g}" for name, value in results.items()]
    (folder / "sectors.csv").write_text("\n".join(lines) + "\n")


def judge_origins(run, time):
    horns, last = find_horns(run), tracks(run).index(time)
    rows = horns.heap.rows(horns.ever(last))
    if len(rows) == 0:
        raise NotInRun(f"needs a dune with horns up to t = {horns.t[last]:.3g} s")
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


def judge_forces(run, start, end):
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


def say(force):
    return f"{force:+.2g} N"


def mean(bins, name, chosen):
    """Mean per grain over some of the bins; NaN for none."""
    number = bins["n"][chosen]
    return float(np.sum(number * bins[name][chosen]) / number.sum()) if number.sum() else np.nan


def dune_shape(run, forces):
    """Means over the window: crest from the centroid along x, W and L [m]."""
    if run.dunes is None:
        raise NotInRun("needs dune.csv with at least one line")
    main = run.dunes[min(run.dunes)]
    inside = np.ones(len(main["t"]), bool)
    if forces.start is not None:
        inside = (main["t"] >= forces.start - 1e-9) & (main["t"] <= forces.end + 1e-9)
    if not inside.any():
        raise NotInRun(f"needs dune.csv between t = {forces.start:g} s and {forces.end:g} s")
    crest = main["crest_x"][inside] - main["Cx"][inside]
    if run.domain is not None:  # across a periodic boundary
        crest -= run.domain[0] * np.round(crest / run.domain[0])
    return tuple(float(np.mean(values)) for values in (crest, main["W"][inside], main["L"][inside]))
