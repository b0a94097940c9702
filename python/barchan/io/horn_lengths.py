"""Horns by height, in steady numbers: the median over a second of what dune.csv measures at single times.

The columns horn_left_2d and horn_right_2d are of sand two grains high. Grains that pass a tip still come and go.
"""

from bisect import bisect_left
from collections.abc import Mapping
from statistics import median
from typing import Any

SECOND = 1.0
SIDES = ("left", "right")


def name(side: str) -> str:
    return f"horn_{side}_2d_1s"


ABOUT = {name(side): ("m", f"median of horn_{side}_2d over the last second") for side in SIDES}


def medians(dune: Mapping[str, Any]) -> dict[str, list[float]]:
    """{name(side): [m]} from the columns of one dune (t ascends), if the run has measured them."""
    return {name(side): over_the_last_second(dune["t"], dune[f"horn_{side}_2d"])
            for side in SIDES if f"horn_{side}_2d" in dune}


def over_the_last_second(t: Any, values: Any) -> list[float]:
    """At each t the median of the values from t - 1 s to t."""
    return [median(values[bisect_left(t, end - SECOND * (1 + 1e-9)):row + 1]) for row, end in enumerate(t)]


def best_known(dune: Mapping[str, object]) -> dict[str, str]:
    """{side: name of its column}: of the medians; of a run that has none, of the farthest grains."""
    return {side: name(side) if name(side) in dune else f"horn_{side}" for side in SIDES}
