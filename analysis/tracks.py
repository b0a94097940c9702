"""Where every grain is in every frame, and the main dune among them.

Frames are those of tracks.h5 where the run has it (ids, dunes and positions alone, at short intervals), else
those of grains.h5. Lengths in m.
"""

from functools import cached_property, lru_cache

import numpy as np

from dune_shape import MAIN, Bed, main_dune
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
            d, dune = (file[name][key][:] if key in file[name] else None for key in ("d", "dune"))
        order = np.argsort(number)
        order = order[np.isfinite(x[order]).all(axis=1)]
        number, x = number[order], x[order]
        return Grains(time, number, x, self._diameters_of(number) if d is None else d[order],
                      dune if dune is None else dune[order])

    def _diameters_of(self, number):
        ids, d = self.diameters
        at = np.minimum(np.searchsorted(ids, number), len(ids) - 1)
        return np.where(ids[at] == number, d[at], d.mean())

    def main_dune(self, grains):
        """The run's main dune, None while there is none."""
        if not self.run.dunes or MAIN not in self.run.dunes:
            raise NotInRun("needs dune.csv with the main dune")
        return main_dune(grains, self.bed, self.run.dunes[MAIN])
