"""The water's force along the current on two dunes that meet, and whose grains lie in whose dune; no drawing.

Forces are means over grains at the surface, as fractions of the submerged weight of a grain of mean diameter and mean
density, called weight here. Maps move with the centroid of both dunes. Definitions: docs/dune-measures.md,
"Encounters". SI units.
"""

from dataclasses import dataclass

import numpy as np

from barchan.dune import encounters
from barchan.dune.composition import at_surface
from barchan.dune.current import direction
from barchan.dune.encounters import Encounter
from barchan.dune.force_depth import read_frame, submerged_weight
from barchan.dune.lineage import NONE, Lineage, follow
from barchan.dune.shape import Bed, Sand, number_of_bins
from barchan.dune.tracks import tracks
from barchan.errors import MissingData
from barchan.io.frames import FrameFile, Grains
from barchan.io.run_folder import RunFolder
from barchan.stats import spread, within

WATER = ("force_drag", "force_added_mass", "force_lift", "force_pressure_gradient", "force_stress", "force_flow")
FRAMES = 6    # of a mean over time
FEWEST = 20   # grains of which a mean on part of a dune is formed
END = 10.0    # [d] along the current, of the upstream end of a dune
MIDDLE = 7.5  # [d] across the current, from the middle of a dune to both sides of its upstream end


@dataclass
class Sample:
    """N grains of one frame: x, z [m] from the centroid of both dunes, force over weight, whether at the surface of a
    dune, whether loose, the dune from which it is, cross-section [m2]. centroids (2, 2): x, z [m] of what is of the
    upstream and the downstream dune, NaN where nothing is in a dune."""

    time: float
    x: np.ndarray
    force: np.ndarray
    surface: np.ndarray
    loose: np.ndarray
    home: np.ndarray
    area: np.ndarray
    centroids: np.ndarray


@dataclass
class Map:
    """Means over `frames` frames from `start` to `end` [s]. edges: of bins along x and z, from the centroid of both
    dunes [m]. By bin: n, grains of all frames; force, NaN without grains. cover (2): summed cross-sections of what is
    of the upstream and the downstream dune over the area of the bin. centroids as in Sample."""

    moment: str
    start: float
    end: float
    frames: int
    edges: tuple[np.ndarray, np.ndarray]
    n: np.ndarray
    force: np.ndarray
    cover: np.ndarray
    centroids: np.ndarray


@dataclass
class Forces:
    """F frames with forces: t (F) [s]; touching (F). Of upstream and downstream dune (2, F): force, mean at the surface
    over weight, NaN where the dune is not there; foreign, share of its first grains that bear the other's name; amid,
    share that lies among more grains of the other; end, force at the upstream end of the dune alone."""

    encounter: Encounter
    t: np.ndarray
    touching: np.ndarray
    force: np.ndarray
    foreign: np.ndarray
    amid: np.ndarray
    end: np.ndarray
    maps: list[Map]

    def means(self, values: np.ndarray) -> np.ndarray:
        """(3, n) of consecutive FRAMES frames or some more: middle [s], mean and half its 95 % interval, NaN where less
        than half of them have a value."""
        rows = []
        for part in np.array_split(np.arange(len(self.t)), max(1, len(self.t) // FRAMES)):
            known = part[np.isfinite(values[part])]
            enough = len(known) >= max(2, len(part) / 2)
            found = spread(values[known].tolist() if enough else [np.nan])
            rows.append((self.t[part].mean(), found.mean, found.interval))
        return np.array(rows).T


def of_run(run: RunFolder) -> Forces:
    """Of the first encounter with a contact, else of the first one."""
    lineage, found = encounters.find(run)
    if not found:
        raise MissingData("needs two dunes that meet in tracks.h5 or grains.h5")
    file = run.frame_file("grains.h5", ("id", "x", "d", "dune", "force_total"))
    if file is None:
        raise MissingData("needs grains.h5 with forces (output.grain_forces = true)")
    one = next((each for each in found if np.isfinite(each.t_contact)), found[0])
    chosen = [frame for frame in file.frames if frame[0] > 0 and frame[0] >= one.t_start * (1 - 1e-9)]
    if not chosen:
        raise MissingData(f"needs a frame of grains.h5 with forces after t = {one.t_start:g} s")
    return _read(run, file, chosen, lineage, one)


def _read(run: RunFolder, file: FrameFile, frames: list[tuple[float, str]], lineage: Lineage, one: Encounter) -> Forces:
    bed, pair = tracks(run).bed, (one.upstream, one.downstream)
    t = np.array([time for time, _ in frames])
    named = _names_at(run, [*t, one.t_start])
    ids, first = named.pop()
    home = np.full(int(ids.max(initial=0)) + 1, NONE)
    home[ids] = first
    there = np.clip(np.searchsorted(lineage.t, t * (1 + 1e-9), side="right") - 1, 0, None)
    body = lineage.body[there][:, pair]
    touching = (body[:, 0] == body[:, 1]) & (body[:, 0] != NONE)
    windows = moments(lineage, bed, one, t, touching)
    kept: dict[int, Sample] = {}
    wanted = {index for rows in windows.values() for index in rows}
    force, foreign, amid, end = np.full((4, 2, len(t)), np.nan)
    total = [max(1, np.count_nonzero(home == dune)) for dune in pair]
    with file.open() as content:
        for index, (time, group) in enumerate(frames):
            way = direction(run.config, time)
            parts = [part for part in WATER if part in content[group]]
            if not parts:
                raise MissingData("needs grains.h5 with forces of the water")
            grains, along = read_frame(content[group], parts, way)
            name = _values_of(grains.id, *named[index])
            name[grains.dune == NONE] = NONE
            origin = _values_of(grains.id, np.arange(len(home)), home)
            weight = float(np.mean(submerged_weight(run.config, grains.d.mean(), grains.kind)))
            moved = [np.count_nonzero((origin == dune) & (name == other)) for dune, other in zip(pair, pair[::-1])]
            foreign[:, index] = np.divide(moved, total)
            amid[:, index] = np.divide(among_others(grains, origin, pair, bed), total)
            sample = sample_of(grains, along / weight, origin, pair, bed)
            if sample is None:
                continue
            force[:, index] = [mean_of(sample.force[sample.surface & (name == dune)]) for dune in pair]
            end[:, index] = [mean_of(sample.force[upstream_end(sample, name == dune, way, grains.d.mean())])
                             for dune in pair]
            if index in wanted:
                kept[index] = sample
    sizes = bed.lengths / number_of_bins(bed, float(tracks(run).read(0).d.mean()))
    maps = [map_of(moment, [kept[row] for row in rows if row in kept], pair, sizes) for moment, rows in windows.items()
            if any(row in kept for row in rows)]
    if not maps:
        raise MissingData("needs a frame of grains.h5 with forces in which a dune is there")
    return Forces(one, t, touching, force, foreign, amid, end, maps)


def _names_at(run: RunFolder, times: list[float]) -> list[tuple[np.ndarray, np.ndarray]]:
    """(ids, names) of the grains at each time: those of the last frame of the tracks not after it."""
    source = tracks(run)
    wanted = [source.index(max(time, source.times[0])) for time in times]
    found: dict[float, tuple[np.ndarray, np.ndarray]] = {}

    def keep(grains: Grains, names: np.ndarray) -> None:
        if grains.time in at:
            found[grains.time] = grains.id.astype(np.int32), names.astype(np.int16)  # of a long run many

    at = {float(source.times[index]) for index in wanted}
    follow((source.read(index) for index in range(max(wanted) + 1)), source.bed, seen=keep)
    return [found[float(source.times[index])] for index in wanted]


def _values_of(wanted: np.ndarray, ids: np.ndarray, values: np.ndarray) -> np.ndarray:
    """Of these ids, where `ids` ascend; NONE of those that are not among them."""
    if not len(ids):
        return np.full(len(wanted), NONE)
    at = np.minimum(np.searchsorted(ids, wanted), len(ids) - 1)
    return np.where(ids[at] == wanted, values[at], NONE)


def mean_of(values: np.ndarray) -> float:
    """NaN of fewer than FEWEST values."""
    return float(values.mean()) if len(values) >= FEWEST else np.nan


def moments(lineage: Lineage, bed: Bed, one: Encounter, t: np.ndarray, touching: np.ndarray) -> dict[str, range]:
    """{moment: rows of t}: at most four of FRAMES frames each, of which none is in two. The contact is the first that
    lasts as long, else the first of all; there is a moment halfway after it where there is none of the approach."""
    count = len(t)

    def rows(first: int) -> range:
        return range(max(0, first), min(first + FRAMES, count))

    if not np.isfinite(one.t_contact):
        between = encounters.separation(lineage, bed, one.upstream, one.downstream)
        apart = np.linalg.norm(bed.nearest(between), axis=1)
        inside = within(lineage.t, t[0], t[-1]) & np.isfinite(apart)
        least = lineage.t[inside][np.argmin(apart[inside])] if inside.any() else t[0]
        closest = int(np.argmin(abs(t - least)))
        plan = {"start": rows(0), "closest": rows(closest - FRAMES // 2), "end": rows(count - FRAMES)}
        order: tuple[str, ...] = ("start", "end", "closest")
    else:
        lasting = [row for row in range(count - FRAMES + 1) if touching[row:row + FRAMES].all()]
        contact = lasting[0] if lasting else int(np.searchsorted(t, one.t_contact * (1 - 1e-9)))
        parted = int(np.searchsorted(t, one.t_apart * (1 - 1e-9))) if np.isfinite(one.t_apart) else count
        last = "apart" if parted <= count - FRAMES else "end"
        end = min(parted, count - FRAMES)
        plan = {"approach": rows(contact // 2 - FRAMES),
                "just before contact": range(max(0, contact - FRAMES), contact),
                "contact": rows(contact), "halfway": rows((contact + end) // 2), last: rows(end)}
        order = ("just before contact", "contact", last, "approach", "halfway")
    found: dict[str, range] = {}
    for moment in order:
        taken = {row for chosen in found.values() for row in chosen}
        if plan[moment] and len(found) < 4 and not taken & set(plan[moment]):
            found[moment] = plan[moment]
    return {moment: found[moment] for moment in plan if moment in found}


def sample_of(grains: Grains, force: np.ndarray, home: np.ndarray, pair: tuple[int, int], bed: Bed) -> Sample | None:
    """None where no grain of the two is in a dune. force (N): over weight; home (N): the dune from which each is."""
    assert grains.dune is not None
    places, volumes = np.full((2, 3), np.nan), np.zeros(2)
    for index, dune in enumerate(pair):
        rows = np.nonzero((home == dune) & (grains.dune != NONE))[0]
        if len(rows):
            sand = Sand.of(grains, rows, bed)
            places[index], volumes[index] = sand.centroid, np.sum(sand.radius**3)
    known = volumes > 0
    if not known.any():
        return None
    first = places[known][0]
    middle = first + np.average(bed.nearest(places[known] - first), axis=0, weights=volumes[known])
    return Sample(grains.time, bed.nearest(grains.x - middle)[:, (0, 2)], force, at_surfaces(grains, bed),
                  grains.dune == NONE, home, np.pi / 4 * grains.d**2, bed.nearest(places - middle)[:, (0, 2)])


def upstream_end(sample: Sample, own: np.ndarray, way: np.ndarray, d: float) -> np.ndarray:
    """(N) which grains at the surface of a dune make its upstream end: within END of its most upstream ones and MIDDLE
    of its middle. own (N): which are of it; way: unit vector (2) of the current; d: mean diameter [m]."""
    chosen = own & sample.surface
    if not chosen.any():
        return chosen
    along, across = sample.x @ way, sample.x @ np.array((-way[1], way[0]))
    first, middle = np.percentile(along[chosen], 1), np.mean(across[chosen])
    return chosen & (along < first + END * d) & (abs(across - middle) < MIDDLE * d)


def at_surfaces(grains: Grains, bed: Bed) -> np.ndarray:
    """(N) which grains are at the surface of a dune."""
    assert grains.dune is not None
    result = np.zeros(len(grains.id), bool)
    for label in np.unique(grains.dune[grains.dune != NONE]):
        rows = np.nonzero(grains.dune == label)[0]
        result[rows] = at_surface(grains, rows, Sand.of(grains, rows, bed))
    return result


def among_others(grains: Grains, home: np.ndarray, pair: tuple[int, int], bed: Bed) -> tuple[int, int]:
    """How many grains of each dune of `pair` lie in a dune, in a bin with more grains of the other one. home (N): the
    dune by name from which each grain is."""
    assert grains.dune is not None
    shape = number_of_bins(bed, float(grains.d.mean()))
    place = np.floor(grains.x[:, (0, 2)] / (bed.lengths / shape)).astype(int)
    place = np.where(bed.periodic, place % shape, np.clip(place, 0, shape - 1))
    bins = np.ravel_multi_index(tuple(place.T), tuple(shape))
    up, down = (np.bincount(bins[(home == dune) & (grains.dune != NONE)], minlength=shape.prod()) for dune in pair)
    return int(up[down > up].sum()), int(down[up > down].sum())


def map_of(moment: str, samples: list[Sample], pair: tuple[int, int], sizes: np.ndarray) -> Map:
    """The mean over frames, in bins of these sizes (2) [m]."""
    reach = np.max([abs(sample.x).max(axis=0) for sample in samples], axis=0)
    half = np.ceil(reach / sizes + 0.5).astype(int)
    edges = tuple((np.arange(-n, n + 2) - 0.5) * size for n, size in zip(half, sizes))
    n, force = np.zeros(2 * half + 1), np.zeros(2 * half + 1)
    cover = np.zeros((2, *(2 * half + 1)))
    for sample in samples:
        place = tuple(np.round(sample.x / sizes).astype(int).T + half[:, None])
        drawn = sample.surface | sample.loose
        top = tuple(axis[drawn] for axis in place)
        np.add.at(n, top, 1)
        np.add.at(force, top, sample.force[drawn])
        for index, dune in enumerate(pair):
            own = sample.home == dune
            np.add.at(cover[index], tuple(axis[own] for axis in place), sample.area[own])
    with np.errstate(invalid="ignore"):
        mean = force / n
    return Map(moment, samples[0].time, samples[-1].time, len(samples), (edges[0], edges[1]), n, mean,
               cover / (len(samples) * np.prod(sizes)), np.mean([sample.centroids for sample in samples], axis=0))
