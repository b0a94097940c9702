"""Where every grain is in every frame, and the main dune among them.

Frames are those of tracks.h5 where the run has it (ids, dunes and positions alone, at short intervals), else
those of grains.h5. Lengths in m.
"""

from functools import cached_property, lru_cache

import numpy as np

from barchan.dune.shape import MAIN, Bed, Dune, main_dune
from barchan.errors import BarchanError, MissingData
from barchan.io.frames import Grains
from barchan.io.run_folder import RunFolder


@lru_cache(maxsize=4)
def tracks(run: RunFolder) -> "Tracks":
    """The tracks of a run, opened once for all figures of it."""
    return Tracks(run)


def bed_of(run: RunFolder) -> Bed:
    if run.domain is None:
        raise MissingData("needs config.toml with the size of the domain")
    grains = run.config.get("grains", {})
    periodic = (grains.get("boundary_x", "exit") in ("periodic", "follow"),
                grains.get("boundary_z", "periodic") == "periodic")
    return Bed((run.domain[0], run.domain[2]), periodic)


class Tracks:
    def __init__(self, run: RunFolder) -> None:
        self.run = run
        self.bed = bed_of(run)
        self.file = run.frame_file("tracks.h5", ("id", "x")) or run.need_grains()
        self.times = self.file.times

    def index(self, time: float | None) -> int:
        """The last frame not after `time` [s]; None: the last of all."""
        if time is None:
            return len(self.times) - 1
        if time < self.times[0]:
            raise BarchanError(f"no frame at or before t = {time:g} s: the first is at {self.times[0]:g} s")
        return int(np.searchsorted(self.times, time * (1 + 1e-9), side="right")) - 1

    @cached_property
    def diameters(self) -> tuple[np.ndarray, np.ndarray]:
        """(ids, diameters [m]), ordered by id: of the first frame of grains.h5, which has all grains."""
        first = self.run.frame(0)
        return first.id, first.d

    def read(self, index: int) -> Grains:
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

    @cached_property
    def heaps(self) -> tuple[np.ndarray, np.ndarray | None]:
        """(ids, heap of each), ordered by id, of the first frame of grains.h5; None for a run without heaps."""
        file = self.run.need_grains()
        with file.open() as content:
            group = content[file.frames[0][1]]
            order = np.argsort(group["id"][:])
            return group["id"][:][order], group["heap"][:][order].astype(int) if "heap" in group else None

    def _diameters_of(self, number: np.ndarray) -> np.ndarray:
        ids, d = self.diameters
        at = np.minimum(np.searchsorted(ids, number), len(ids) - 1)
        return np.where(ids[at] == number, d[at], d.mean())

    def main_dune(self, grains: Grains) -> Dune | None:
        """The run's main dune, None while there is none."""
        if not self.run.dune_columns or MAIN not in self.run.dune_columns:
            raise MissingData("needs dune.csv with the main dune")
        return main_dune(grains, self.bed, self.run.dune_columns[MAIN])
