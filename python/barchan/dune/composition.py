"""Which kinds of grains lie where in the main dune.

Regions of the grains of the dune: `surface`, whose tops reach to within a mean diameter below the surface (surface.py);
`crest`, those of the surface where it is at least CREST of its greatest height; `horns` (horns.py). Shares are by
number.
"""

from dataclasses import dataclass

import numpy as np

from barchan.dune.horns import members
from barchan.dune.shape import MAIN, Dune, Sand, main_dune
from barchan.dune.tracks import bed_of
from barchan.errors import MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder

REGIONS = ("dune", "surface", "crest", "horns")
CREST = 0.8   # of the greatest height of the surface
FEWEST = 20   # grains of which shares are formed


@dataclass
class Composition:
    """t (F) [s]; names of the K kinds; count, by region (F, K): the grains of each kind there."""

    t: np.ndarray
    kinds: tuple[str, ...]
    count: dict[str, np.ndarray]

    def share(self, region: str) -> np.ndarray:
        """(F, K) of the grains there, NaN where they are fewer than 20."""
        count = self.count[region]
        total = count.sum(axis=1, keepdims=True)
        return np.where(total >= FEWEST, count / np.maximum(total, 1), np.nan)


def regions(grains: Grains, dune: Dune) -> dict[str, np.ndarray]:
    """{region: rows of the grains of the frame that are in it}."""
    surface = at_surface(grains, dune.rows, dune)
    crest = surface & (dune.surface.at(dune.x, dune.z) >= CREST * dune.surface.h.max())
    ids, _ = members(grains, dune)
    return {"dune": dune.rows, "surface": dune.rows[surface], "crest": dune.rows[crest],
            "horns": np.nonzero(np.isin(grains.id, ids))[0]}


def at_surface(grains: Grains, rows: np.ndarray, sand: Dune | Sand) -> np.ndarray:
    """(n) which grains of a dune, in these rows of the frame, are at its surface."""
    top = grains.x[rows, 1] + 0.5 * grains.d[rows]
    return top >= sand.surface.at(sand.x, sand.z) - float(grains.d.mean())


def composition(run: RunFolder) -> Composition:
    """Of all frames of grains.h5. Raises MissingData for grains of one kind."""
    file, bed = run.need_grains(), bed_of(run)
    kinds = run.frame(0).kinds
    if not kinds:
        raise MissingData("needs grains.h5 of a run with several kinds of grains")
    if not run.dune_columns or MAIN not in run.dune_columns:
        raise MissingData("needs dune.csv with the main dune")
    count = {region: np.zeros((len(file.frames), len(kinds)), int) for region in REGIONS}
    for index in range(len(file.frames)):
        grains = run.frame(index)
        dune = main_dune(grains, bed, run.dune_columns[MAIN])
        if dune is None or grains.kind is None:
            continue
        for region, rows in regions(grains, dune).items():
            count[region][index] = np.bincount(grains.kind[rows], minlength=len(kinds))
    return Composition(file.times, kinds, count)
