"""Forces in an encounter: built dunes whose grains feel known forces, also across periodic sides."""

import made_up_encounters as built
import numpy as np
import pytest
from made_up_encounters import LARGE, LOOSE, SMALL, TIMES, D, Pair, line, write_run
from test_encounters import PLACES

import barchan
from barchan.dune import encounter_forces

WEIGHT = 1500 * 9.81 * np.pi / 6 * D**3
ON = np.array([0.5, 0.2])  # of the weight, on grains of the small and the large heap
INSIDE = -4.0              # times ON, on those below the surface
RADIUS = np.array([3e-3, 4.5e-3])
EAST, WEST, DIAGONAL = (1.0, 0.0), (-1.0, 0.0), (0.8, 0.6)
CURRENT = "[fluid]\nmean_velocity = [{}, {}]\n"
EVERYWHERE = pytest.mark.parametrize("place", PLACES.values(), ids=PLACES)


def forces(pair, way=EAST, names=("force_drag", "force_pressure_gradient"), at_ends=None):
    """Two parts of the water's force along `way`, with a quarter of it across; the resultant is none. `at_ends` (2): on
    what is upstream in each heap, over ON."""
    place = np.concatenate([grains for grains, _, _ in pair.parts] + [np.zeros((LOOSE, 3))])
    along, across = place[:, (0, 2)] @ way, place[:, (0, 2)] @ (-way[1], way[0])
    over = ON[pair.heap]
    below = (place[:, 1] < 4.2 * D) & (np.hypot(along, across) < RADIUS[pair.heap] - 5 * D)  # two bins from the edge
    over[below & (np.arange(pair.n) < pair.n - LOOSE)] *= INSIDE
    if at_ends is not None:
        end = (along < 13 * D - RADIUS[pair.heap]) & (abs(across) < 8.5 * D) & ~below
        over[end] *= np.array(at_ends)[pair.heap[end]]

    def arrays(frame):
        one = np.outer(over[frame.id] * WEIGHT, [way[0] + 0.25 * way[1], 0, way[1] - 0.25 * way[0]])
        return {"force_total": 0 * one, **{name: share * one for name, share in zip(names, (0.7, 0.3))}}
    return arrays


FINER = np.arange(0, 8.01, 0.2)


def of(tmp_path, parts, times=TIMES, way=EAST, at_ends=None, **options):
    pair = Pair(parts, **options)
    current = CURRENT.format(*0.3 * np.array(way))
    tmp_path.mkdir(exist_ok=True)
    folder = write_run(tmp_path / "run", pair.frames(times), pair.bed, pair.heap, current,
                       forces(pair, way, at_ends=at_ends))
    return encounter_forces.of_run(barchan.Run(folder))


@EVERYWHERE
def test_force_map_and_curves_of_a_merging(tmp_path, place):
    """The same wherever the dunes lie. A loose grain in three thousand lies on a dune of the other heap."""
    found = of(tmp_path, built.merging(), FINER, **place)
    assert (found.encounter.upstream, found.encounter.downstream) == (1, 0)
    assert found.t[0] > 0, "before the first step there are no forces"
    assert found.force == pytest.approx(np.tile(ON[:, None], len(found.t)), rel=0.02)
    assert [one.moment for one in found.maps] == ["approach", "just before contact", "contact", "end"]
    before = found.maps[1]
    assert not found.touching[found.t <= before.end].any() and found.touching[found.t > before.end].all()
    distance = np.mean([built.X1 - built.X0 - 1.5e-3 * t for t in np.linspace(before.start, before.end, before.frames)])
    assert np.diff(before.centroids, axis=0)[0] == pytest.approx([distance, 0], abs=0.2 * D)
    size = np.prod([np.diff(edges)[0] for edges in before.edges])
    grains = before.cover.sum(axis=(1, 2)) * size / (np.pi / 4 * D**2)
    assert grains == pytest.approx([len(SMALL), len(LARGE)], rel=0.01)
    for cover, on in zip(before.cover, ON):
        assert np.median(before.force[cover > 3]) == pytest.approx(on, rel=1e-6)
        where = np.argwhere(cover > 3)
        assert np.ptp(where, axis=0).max() * 2.5 * D < 2 * 4.6e-3, "a dune in two pieces"


@pytest.mark.parametrize("way, heaps", [(WEST, [1, 0]), (DIAGONAL, [0, 1])], ids=["west", "diagonal"])
def test_forces_are_along_the_current(tmp_path, way, heaps):
    """Heaps in the order of the stream; what its upstream end feels is of each dune alone."""
    at_ends = np.array([3.0, -2.0])
    found = of(tmp_path, built.merging(), TIMES[:30], way, at_ends)
    assert [found.encounter.upstream, found.encounter.downstream] == [1 - heap for heap in heaps]
    assert found.end == pytest.approx(np.tile((ON * at_ends)[heaps, None], len(found.t)), rel=0.03)
    found = of(tmp_path / "even", built.merging(), TIMES[:30], way)
    assert found.force == pytest.approx(np.tile(ON[heaps, None], len(found.t)), rel=0.02)
    assert found.end == pytest.approx(np.tile(ON[heaps, None], len(found.t)), rel=0.02)


def test_kinds_of_unlike_density(tmp_path):
    """The weight is that of the mean density; each heap is of one kind."""
    pair = Pair(built.merging())
    kinds = "".join(f"[[grains.kind]]\nname = \"{name}\"\n{density}" for name, density in
                    (("glass", ""), ("zirconium", "density = 4100\n")))
    force = forces(pair)
    folders = [write_run(tmp_path / name, pair.frames(TIMES[:8]), pair.bed, pair.heap, kinds, more)
               for name, more in (("run", lambda frame: force(frame) | {"kind": pair.heap[frame.id]}), ("bare", force))]
    found = encounter_forces.of_run(barchan.Run(folders[0]))
    mean = (1500 * np.mean(pair.heap == 0) + 3100 * np.mean(pair.heap == 1)) / 1500
    assert found.force * mean == pytest.approx(np.tile(ON[:, None], len(found.t)), rel=0.02)
    with pytest.raises(barchan.MissingData, match="with the kind of each grain"):
        encounter_forces.of_run(barchan.Run(folders[1]))


def test_grains_that_change_sides(tmp_path):
    """An eighth of the large dune leaves on the small one."""
    found = of(tmp_path, built.passing())
    assert [one.moment for one in found.maps][-1] == "apart"
    taken = np.count_nonzero(np.arange(len(LARGE)) % 8 == 0) / len(LARGE)
    for share in found.foreign, found.amid:
        assert share[:, -1] == pytest.approx([0, taken], abs=0.01)
        assert share[:, 0] == pytest.approx([0, 0], abs=0.01)


@EVERYWHERE
def test_moments_without_contact(tmp_path, place):
    """Also where each dune is at another side of the domain."""
    found = of(tmp_path, built.chasing(), **place)
    assert [one.moment for one in found.maps] == ["start", "end"]  # they are closest at the start
    assert not found.touching.any()
    near = built.after(4, line(built.X0, 0.6e-3), lambda t: np.array((built.X0 + 2.4e-3 - 0.5e-3 * (t - 4), 0.015)))
    found = of(tmp_path / "near", [(SMALL, 0, near), (LARGE, 1, line(built.X1, 0.0))], **place)
    assert not found.touching.any()
    assert [(one.moment, one.start, one.end) for one in found.maps] == [
        ("start", 0.25, 1.5), ("closest", 3.25, 4.5), ("end", 8.75, 10)]


def test_halfway(tmp_path):
    """Between the first and the last six frames of a contact that comes too early for a map of the approach."""
    found = of(tmp_path, built.merging(), TIMES[4:])
    assert [one.moment for one in found.maps] == ["just before contact", "contact", "halfway", "end"]
    contact, halfway, end = (one.start for one in found.maps[1:])
    assert halfway == pytest.approx(0.5 * (contact + end), abs=0.13)  # half a frame
    assert [one.frames for one in found.maps] == [encounter_forces.FRAMES] * 4


def test_means_of_curves():
    """Of 13 frames seven and six; 2.447 is Student's t of six degrees of freedom, 0.975."""
    t, values = np.arange(13.0), np.array([0, 1, 2, 3, 4, 5, 6, np.nan, 7, np.nan, np.nan, 7, np.nan])
    found = encounter_forces.Forces(None, t, t > 99, *(None,) * 4, [])
    middle, mean, interval = found.means(values)
    assert middle == pytest.approx([3, 9.5])
    assert mean[0] == pytest.approx(3) and interval[0] == pytest.approx(2.447 * np.sqrt(28 / 6 / 7), rel=1e-3)
    assert np.isnan([mean[1], interval[1]]).all(), "two of six are not half of them"
    values[12] = 7
    assert np.array(found.means(values))[1:, 1] == pytest.approx([7, 0])


@EVERYWHERE
@pytest.mark.parametrize("way", [EAST, DIAGONAL], ids=["east", "diagonal"])
def test_the_upstream_end(place, way):
    """Only there is the force known."""
    pair, way = Pair(built.merging(), **place), np.array(way)
    grains = pair.frame(0.0)
    offset = pair.bed.nearest(grains.x - np.array([built.X1, 0, 0.015]) - pair.origin)[:, (0, 2)]
    force = np.where((offset @ way < -2.0e-3) & (abs(offset @ (-way[1], way[0])) < 8 * D), 0.1, 9.0)
    sample = encounter_forces.sample_of(grains, force, pair.heap[grains.id], (0, 1), pair.bed)
    large = pair.heap[grains.id] == 1
    for along, known in ((way, True), (-way, False)):
        end = encounter_forces.upstream_end(sample, large, along, D)
        assert np.count_nonzero(end) > 100
        assert sample.surface[end].all()
        assert (force[end] == (0.1 if known else 9.0)).all()


def test_only_the_surface_counts():
    """Of a block six grains high, away from its edge the uppermost grains alone."""
    pair = Pair(built.merging())
    grains = pair.frame(0.0)
    surface = encounter_forces.at_surfaces(grains, pair.bed)
    inner = np.hypot(grains.x[:, 0] - built.X1, grains.x[:, 2] - 0.015) < 3.5e-3
    inner &= grains.id < len(SMALL) + len(LARGE)
    assert surface[inner & (grains.x[:, 1] > 5.3 * D)].all()
    assert not surface[inner & (grains.x[:, 1] < 4.2 * D)].any()


def test_what_it_needs(tmp_path):
    pair = Pair(built.merging())
    frames = pair.frames(TIMES[:8])
    bare = write_run(tmp_path / "bare", frames, pair.bed, pair.heap)
    with pytest.raises(barchan.MissingData, match="output.grain_forces = true"):
        barchan.Run(bare).figure("encounter_forces")
    dry = write_run(tmp_path / "dry", frames, pair.bed, pair.heap, more=forces(pair, names=()))
    with pytest.raises(barchan.MissingData, match="forces of the water"):
        barchan.Run(dry).figure("encounter_forces")


def test_the_picture_and_its_numbers(tmp_path):
    pair = Pair(built.merging())
    folder = write_run(tmp_path / "run", pair.frames(FINER), pair.bed, pair.heap, more=forces(pair))
    figure = barchan.Run(folder).figure("encounter_forces")
    numbers = figure.numbers["encounter_forces"]
    assert numbers["force_upstream"][3] == pytest.approx(ON[0], rel=0.02)
    assert set(figure.numbers["encounter_force_maps"]["map"]) == {0, 1, 2, 3}
    said = next(said for said in figure.sentences if "just before contact" in said)
    assert "submerged weight of a grain of mean diameter, 0.500 +- 0.000 on dune 1, 0.200 +- 0.000 on dune 0" in said


def test_forces_against_the_current_are_seen(tmp_path):
    pair = Pair(built.chasing())
    force = forces(pair, WEST)
    folder = write_run(tmp_path / "run", pair.frames(TIMES[:16]), pair.bed, pair.heap, more=lambda frame: {
        name: (1 + 0.2 * (-1)**round(4 * frame.time)) * values for name, values in force(frame).items()})
    panel, = (axes for axes in barchan.Run(folder).figure("encounter_forces").axes
              if axes.get_ylabel().startswith("force /"))
    bands = [path.vertices[:, 1].min() for band in panel.collections[:2] for path in band.get_paths()]
    assert panel.get_ylim()[0] <= min(bands) < -1.05 * ON[0] and panel.get_ylim()[1] > 0


@pytest.mark.parametrize("array, missing", [("cover", "cover 0.3 of a bin"), ("n", "6 grains at the surface in a bin")])
def test_maps_that_show_nothing(tmp_path, monkeypatch, array, missing):
    found = of(tmp_path, built.chasing(), TIMES[:8])
    for one in found.maps:
        setattr(one, array, 0 * getattr(one, array))
    monkeypatch.setattr(encounter_forces, "of_run", lambda run: found)
    with pytest.raises(barchan.MissingData, match=missing):
        barchan.Run(tmp_path / "run").figure("encounter_forces")
