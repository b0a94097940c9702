"""Where every grain is in every frame, and the main dune among them.

Frames are those of tracks.h5 where the run has it (ids and positions alone, at short intervals), else
those of grains.h5. Lengths in m.
"""

from functools import cached_property, lru_cache

import numpy as np

from dune_regions import Bed, find_dunes
from run_folder import Grains, NotInRun, PlotError


@lru_cache(maxsize=4)
def tracks(run):
    """The tracks of a run, opened once for all figures of it."""
    return Tracks(run)


def bed_of(run):
    if run.domain is None:
        raise NotInRun("needs config.toml with the size of the domain")
    grains = run.config.get("grains", {})
    periodic = (grains.get("boundary_x", "exit") == "periodic",
                grains.get("boundary_z", "periodic") == "periodic")
    return Bed((run.domain[0], run.domain[2]), periodic)


class Tracks:
    def __init__(self, run):
        self.run = run
        self.bed = bed_of(run)
        self.file = run._frame_file("tracks.h5", ("id", "x")) or run.need_grains()
        self.times = self.file.times

    def index(self, time):
        """The last frame not after `time` [s]; None: the last of all."""
        if time is None:
            return len(self.times) - 1
        if time < self.times[0]:
            raise PlotError(f"no frame at or before t = {time:g} s: the first is at {self.times[0]:g} s")
        return int(np.searchsorted(self.times, time * (1 + 1e-9), side="right")) - 1

    @cached_property
    def diameters(self):
        """(ids, diameters [m]), ordered by id: of the first frame of grains.h5, which has all grains."""
        first = self.run.grains(0)
        return first.id, first.d

    def read(self, index):
        """The grains of a frame, ordered by id; those whose position is not a number are left out."""
        time, name = self.file.frames[index]
        with self.file.open() as file:
            number, x = file[name]["id"][:], file[name]["x"][:].astype(float)
            d = file[name]["d"][:] if "d" in file[name] else None
        order = np.argsort(number)
        order = order[np.isfinite(x[order]).all(axis=1)]
        number, x = number[order], x[order]
        return Grains(time, number, x, self._diameters_of(number) if d is None else d[order])

    def _diameters_of(self, number):
        ids, d = self.diameters
        at = np.minimum(np.searchsorted(ids, number), len(ids) - 1)
        return np.where(ids[at] == number, d[at], d.mean())

    def main_dune(self, grains, last):
        """The run's main dune, None when it is gone.

        It is the one at the place that dune.csv gives for its first label; without that table the
        one nearest to `last`, its last centroid, at first (None) the largest.
        """
        dunes = find_dunes(grains, self.bed)
        place = self._place_in_table(grains.time)
        place = last if place is None else place
        if place is None or not dunes:
            return dunes[0] if dunes else None
        distances = [np.hypot(*self.bed.nearest(dune.centroid - place)[[0, 2]]) for dune in dunes]
        nearest = int(np.argmin(distances))
        found = dunes[nearest]
        return found if distances[nearest] <= max(found.W, found.L) else None

    @cached_property
    def _table(self):
        dunes = self.run.dunes
        return dunes[min(dunes)] if dunes else None

    def _place_in_table(self, time):
        table = self._table
        if table is None or not table["t"][0] - 1e-9 <= time <= table["t"][-1] + 1e-9:
            return None
        return np.array([np.interp(time, table["t"], table[name]) for name in ("Cx", "Cy", "Cz")])
