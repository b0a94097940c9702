"""force_depth of a study of held heaps: the force of the water along the stream on their grains, by depth.

Means of the last two thirds of the run, or from --from to --to. Definitions: barchan/dune/force_depth.py.
"""

import numpy as np

from barchan.errors import MissingData
from barchan.dune.force_depth import EDGES, PARTS, of_run
from barchan.figures import style
from barchan.figures.result import keep_cases, say
from barchan.io.study_folder import plain
from barchan.stats import spread


def draw(study, ax=None, start=None, end=None):
    """One panel for each part of the heap; the curves are means over the realisations."""
    found = {case.name: [of_run(run, start, end) for run in case.runs] for case in study.cases if case.runs}
    if not found:
        raise MissingData("needs a case with grains.h5")
    figure, ((*panels,),) = style.panels(ax, 1, 3, figsize=(style.FULL_WIDTH, 2.8), sharey=True)
    middle = 0.5 * (EDGES[1:] + EDGES[:-1])
    rows, totals = [], []
    for name, runs in found.items():
        total = spread([run["total"] for run in runs])
        totals.append(f"{name}: force on the heap over its weight {total.mean:.3f} +- {total.deviation:.3f} "
                      f"({total.count})")
        for part, axes in zip(PARTS, panels):
            means, fluctuations = (np.nanmean([run[part][which] for run in runs], axis=0) for which in (0, 1))
            axes.plot(middle, means, marker="o", ms=2.5, label=plain(name))
            rows += [(name, part, *line) for line in zip(EDGES[:-1], EDGES[1:], means, fluctuations)]
    for index, (part, axes) in enumerate(zip(PARTS, panels)):
        axes.axhline(0, color=style.GREY, lw=0.6)
        axes.set(title=part, xlabel="depth (d)", xlim=(0, EDGES[-1]))
        style.panel_label(axes, index)
    panels[0].set_ylabel("force along the stream / weight")
    panels[-1].legend(loc="upper right")
    say(figure, totals)
    keep_cases(figure, "force_depth", dict(zip(("case", "part", "depth_from", "depth_to", "mean", "rms"),
                                               ([list(column)] for column in zip(*rows)))))
    return figure
