"""composition: the share of each kind of grains at the surface of the dune, at its crest and in its horns.

Dashed: the share in the whole dune.
"""

import numpy as np

from barchan.dune.composition import REGIONS, composition
from barchan.figures import style
from barchan.figures.result import keep, say
from barchan.io.study_folder import plain

TITLES = {"surface": "surface", "crest": "crest", "horns": "horns"}


def draw(run, ax=None):
    found = composition(run)
    figure, (panels,) = style.panels(ax, 1, 3, sharex=True, sharey=True, figsize=(style.FULL_WIDTH, 2.4))
    whole = found.share("dune")
    for index, (axes, (region, title)) in enumerate(zip(panels, TITLES.items())):
        for number, (name, colour) in enumerate(zip(found.kinds, style.GROUPS)):
            axes.plot(found.t, 100 * found.share(region)[:, number], color=colour, label=plain(name),
                      marker=style.mark_if_few(found.t), ms=3)
            axes.plot(found.t, 100 * whole[:, number], color=colour, lw=0.8, ls=(0, (4, 1.5)))
        axes.set(xlabel="$t$ (s)", ylim=(0, 100), ylabel=f"grains of the {title} (%)")
        style.panel_label(axes, index)
    panels[0].legend(loc="best")
    keep(figure, "composition", {"t": found.t, **{
        f"{region}_{name}": found.count[region][:, number]
        for region in REGIONS for number, name in enumerate(found.kinds)}}, most=None)
    known = [region for region in REGIONS if np.isfinite(found.share(region)[-1]).all()]
    say(figure, [sentence(found, region) for region in known])
    return figure


def sentence(found, region):
    shares = ", ".join(f"{100 * share:.1f} % {name}" for share, name in zip(found.share(region)[-1], found.kinds))
    return f"At the end the {region} {'are' if region == 'horns' else 'is'} {shares}."
