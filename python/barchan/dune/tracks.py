"""Where every grain is in every frame, and the main dune among them.

Frames are those of tracks.h5 where the run has it (ids, dunes and positions alone, at short intervals), else
those of grains.h5. Lengths in m.
"""

from functools import cached_property, lru_cache
from typing import Any

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


def known_grains(run: RunFolder) -> Grains:
    """Each grain of grains.h5 by id, with its diameter, heap and kind, where it is first seen.

    Looks at the first and the last frame, and at all where grains are fed on the way.
    """
    count = len(run.need_grains().frames)
    chosen = range(count) if "feed" in run.config.get("grains", {}) else sorted({0, count - 1})
    seen = [run.frame(index) for index in chosen]
    first = np.unique(np.concatenate([grains.id for grains in seen]), return_index=True)[1]

    def of_all(name: str) -> Any:
        parts = [getattr(grains, name) for grains in seen]
        return None if any(part is None for part in parts) else np.concatenate(parts)[first]

    return Grains(0.0, of_all("id"), of_all("x"), of_all("d"), heap=of_all("heap"),
                  heaps=max((grains.heaps for grains in seen), key=len), kind=of_all("kind"), kinds=seen[0].kinds,
                  shapes=seen[0].shapes)


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
    def known(self) -> Grains:
        return known_grains(self.run)

    @cached_property
    def diameters(self) -> tuple[np.ndarray, np.ndarray]:
        """(ids, diameters [m]), ordered by id."""
        return self.known.id, self.known.d

    def read(self, index: int) -> Grains:
        """The grains of a frame, ordered by id; those whose position is not a number are left out."""
        time, name = self.file.frames[index]
        with self.file.open() as file:
            number, x = file[name]["id"][:], file[name]["x"][:].astype(float)
            d, dune, turned = (file[name][key][:] if key in file[name] else None
                               for key in ("d", "dune", "orientation"))
        order = np.argsort(number)
        order = order[np.isfinite(x[order]).all(axis=1)]
        number, x = number[order], x[order]
        return Grains(time, number, x, self._diameters_of(number) if d is None else d[order],
                      dune if dune is None else dune[order],
                      **({} if turned is None else self._turned(number, turned[order])))

    def _turned(self, number: np.ndarray, orientation: np.ndarray) -> dict[str, Any]:
        """What the spheres of clumps follow from, of a frame with these ids."""
        kind = None if self.known.kind is None else self.known.kind[self._places(number)]
        return {"orientation": orientation.astype(float), "kind": kind, "shapes": self.known.shapes}

    def _places(self, number: np.ndarray) -> np.ndarray:
        return np.minimum(np.searchsorted(self.known.id, number), len(self.known.id) - 1)

    @cached_property
    def heaps(self) -> tuple[np.ndarray, np.ndarray | None]:
        """(ids, heap of each), ordered by id; None for a run without heaps."""
        return self.known.id, self.known.heap

    def _diameters_of(self, number: np.ndarray) -> np.ndarray:
        ids, d = self.diameters
        at = self._places(number)
        return np.where(ids[at] == number, d[at], d.mean())

    def main_dune(self, grains: Grains) -> Dune | None:
        """The run's main dune, None while there is none."""
        if not self.run.dune_columns or MAIN not in self.run.dune_columns:
            raise MissingData("needs dune.csv with the main dune")
        return main_dune(grains, self.bed, self.run.dune_columns[MAIN])
