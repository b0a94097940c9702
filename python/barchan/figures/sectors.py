"""sectors: the paper's statements on horn grains and on the force on grains, judged by a run; no picture.

One line on where horn grains began (text on Fig. 11 of Lima et al. 2022), one on the signs of the
mean force (text on Fig. 13).
"""

from barchan.dune.sectors import judge_forces, judge_origins
from barchan.errors import MissingData
from barchan.figures.result import Told


def draw(run, time=None, start=None, end=None):
    """What the run's files allow of the two."""
    told, reasons, values = Told([]), [], {}
    for judge, options in ((judge_origins, (time,)), (judge_forces, (start, end))):
        try:
            sentence, found = judge(run, *options)
            told.sentences.append(sentence)
            values |= found
        except MissingData as reason:
            reasons.append(str(reason))
    if not values:
        raise MissingData("; ".join(reasons))
    told.numbers["sectors"] = {"quantity": list(values), "value": list(values.values())}
    return told
