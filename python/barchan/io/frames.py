"""Files of frames: grains.h5, fields.h5, tracks.h5 and flow_average.h5."""

import operator
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from barchan.errors import BarchanError, seconds
from barchan.io.clumps import Shapes
from barchan.io.hdf5 import Group, Root, open_file, patiently


@dataclass
class Grains:
    """Grains of one frame. What the frame has not is None.

    Attributes
    ----------
    time : float
        Time [s].
    id : numpy.ndarray
        (N) ids, ascending.
    x : numpy.ndarray
        (N, 3) centres [m].
    d : numpy.ndarray
        (N) diameters [m].
    dune : numpy.ndarray, optional
        (N) label of the dune, -1: in none.
    u : numpy.ndarray, optional
        (N, 3) velocities [m/s].
    heap : numpy.ndarray, optional
        (N) number of the heap that each came from, the place of its name in `heaps`.
    heaps : tuple of str
        Names of the heaps.
    kind : numpy.ndarray, optional
        (N) number of the kind, the place of its name in `kinds`.
    kinds : tuple of str
        Names of the kinds.
    orientation : numpy.ndarray, optional
        (N, 4) quaternions w, x, y, z that turn the principal axes of clumps into space.
    shapes : Shapes, optional
        Spheres of the clumps of each kind; barchan.io.clumps.spheres_of puts them in their places.
    """

    time: float
    id: np.ndarray
    x: np.ndarray
    d: np.ndarray
    dune: np.ndarray | None = None
    u: np.ndarray | None = None
    heap: np.ndarray | None = None
    heaps: tuple[str, ...] = ()
    kind: np.ndarray | None = None
    kinds: tuple[str, ...] = ()
    orientation: np.ndarray | None = None
    shapes: Shapes | None = None

    @property
    def group(self) -> np.ndarray | None:
        """What pictures colour the grains by, an index of `groups` (N): kinds, else heaps, else None: heights."""
        return self.heap if self.kind is None else self.kind

    @property
    def groups(self) -> tuple[str, ...]:
        return self.kinds or self.heaps


def names_of(frame: Group, name: str) -> tuple[str, ...]:
    """Names of the heaps or kinds whose numbers an array "heap" or "kind" of a frame holds; () where it has none."""
    if name not in frame:
        return ()
    names = tuple(str(frame[name].attrs.get("names", "")).splitlines())
    return names + tuple(f"{name} {n + 1}" for n in range(len(names), int(np.max(frame[name][:], initial=-1)) + 1))


def with_fed(heap: np.ndarray | None, names: tuple[str, ...]) -> tuple[np.ndarray | None, tuple[str, ...]]:
    """Numbers and names of heaps; grains of none, -1, as a heap of their own: they were fed on the way."""
    if heap is None or np.min(heap, initial=0) >= 0:
        return heap, names
    return np.where(heap < 0, len(names), heap), (*names, "fed")


@dataclass
class Flow:
    """A vertical plane z = `z` of the flow, from wall to top and from end to end.

    u, v [m/s] and alpha_f, each (ny + 2, nx + 2), at x (nx + 2) and y (ny + 2) [m]: the cell centres
    and the edges of the domain, where the nearest cell's value stands, at a no-slip wall zero.
    """

    time: float
    z: float
    x: np.ndarray
    y: np.ndarray
    u: np.ndarray
    v: np.ndarray
    alpha_f: np.ndarray


def whole(frame: object) -> int:
    """The number of a frame; else a BarchanError."""
    try:
        return operator.index(frame)  # type: ignore[arg-type]
    except TypeError:
        raise BarchanError(f"frame must be a whole number, and is {frame!r}") from None


def frame_names(file: Group) -> list[str]:
    """Of an open file: frame_000000 to frame_000249, then, in groups, frame_group_001/frame_000250 and so on."""
    names = [name for name in file if name.startswith("frame_")]
    groups = [(name, file[name]) for name in names if name.startswith("frame_group_")]
    names = [name for name in names if not name.startswith("frame_group_")]
    names += [f"{name}/{frame}" for name, group in groups if isinstance(group, Group) for frame in group]
    return sorted(names, key=lambda name: name.rpartition("frame_")[2].zfill(9))


class FrameFile:
    """Times and names of the frames of a file that are complete; `frames` is a list of (time [s], name)."""

    frames: list[tuple[float, str]]
    config_text: str
    title: str

    def __init__(self, path: Path, needed: tuple[str, ...]) -> None:
        self.path = path
        patiently(path, lambda: self._look(needed))

    def _look(self, needed: tuple[str, ...]) -> None:
        with self.open() as file:
            self.config_text = file.attrs.get("config", "")
            self.title = file.attrs.get("title", "")
            self.frames = []
            for name in frame_names(file):
                group = file[name]
                if "time" in group.attrs and all(key in group for key in needed):
                    self.frames.append((float(group.attrs["time"]), name))

    def open(self) -> Root:
        return open_file(self.path)

    @property
    def times(self) -> np.ndarray:
        """[s]"""
        return np.array([time for time, _ in self.frames])

    def index(self, t: float | None = None, frame: int | None = None) -> int:
        """The frame nearest to t [s], or number `frame` (negative: from the end); without either the last.

        Raises BarchanError where both are given, where t is farther from every frame than they are from each other,
        or where there is no such frame.
        """
        times, count = self.times, len(self.frames)
        if t is not None and frame is not None:
            raise BarchanError("give t or frame, not both")
        if t is None:
            wanted = -1 if frame is None else whole(frame)
            if not -count <= wanted < count:
                raise BarchanError(f"no frame {wanted} in {self.path}: it has {count}, 0 to {count - 1}")
            return wanted % count
        t = seconds("t", t)
        reach = np.diff(times).max() if count > 1 else 0.0
        if not times[0] - reach * (1 + 1e-9) <= t <= times[-1] + reach * (1 + 1e-9):
            raise BarchanError(f"no frame near t = {t:g} s in {self.path}: it has {times[0]:g} to {times[-1]:g} s")
        return int(np.argmin(abs(times - t)))

    def evenly_spaced(self, counts: tuple[int, ...] = (8, 6, 7, 5)) -> list[int]:
        """Indices of frames evenly spaced in time, first and last included.

        Takes the first of `counts` for which frames lie at exactly even times; when none does, the
        frames nearest to the times of the first.
        """
        times = self.times
        chosen: list[int] = []
        for count in counts + counts[:1]:
            wanted = np.linspace(times[0], times[-1], count)
            chosen = [int(np.argmin(abs(times - time))) for time in wanted]
            if np.allclose(times[chosen], wanted, atol=0.01 * (times[-1] - times[0]) / count):
                break
        return sorted(set(chosen))
