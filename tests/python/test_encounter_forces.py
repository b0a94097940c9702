"""Forces in an encounter: built dunes whose grains feel known forces, also across periodic sides."""

import made_up_encounters as built
import numpy as np
import pytest
from made_up_encounters import LARGE, SMALL, TIMES, D, Pair, write_run

import barchan
from barchan.dune import encounter_forces

WEIGHT = 1500 * 9.81 * np.pi / 6 * D**3
ON = np.array([0.5, 0.2])  # of the weight, on grains of the small and the large heap
CURRENT = "[fluid]\nmean_velocity = {}\n"
PLACES = [((0.0, 0.0), (False, True)), ((0.0, 0.0155), (False, True)), ((0.06, 0.0), (True, True))]
ACROSS = ["in the middle", "across the side in z", "across the side in x"]


def forces(pair, way=1.0, names=("force_drag", "force_pressure_gradient")):
    """Two parts of the water's force along x, of which a quarter is along -z, too; the resultant is none."""
    def arrays(frame):
        one = np.outer(ON[pair.heap[frame.id]] * WEIGHT * way, [1, 0, -0.25])
        return {"force_total": 0 * one, **{name: share * one for name, share in zip(names, (0.7, 0.3))}}
    return arrays


FINER = np.arange(0, 8.01, 0.2)


def of(tmp_path, parts, times=TIMES, way=1.0, **options):
    pair = Pair(parts, **options)
    folder = write_run(tmp_path / "run", pair.frames(times), pair.bed, pair.heap, CURRENT.format(0.3 * way),
                       forces(pair, way))
    return encounter_forces.of_run(barchan.Run(folder))


@pytest.mark.parametrize("origin, periodic", PLACES, ids=ACROSS)
def test_force_map_and_curves_of_a_merging(tmp_path, origin, periodic):
    """The same wherever the dunes lie. A loose grain in three thousand lies on a dune of the other heap."""
    found = of(tmp_path, built.merging(), FINER, origin=origin, periodic=periodic)
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


def test_forces_are_along_the_current(tmp_path):
    found = of(tmp_path, built.merging(), TIMES[:30], way=-1.0)
    assert (found.encounter.upstream, found.encounter.downstream) == (0, 1)
    assert np.nanmean(found.force, axis=1) == pytest.approx(ON[::-1], rel=0.02)


def test_grains_that_change_sides(tmp_path):
    """An eighth of the large dune leaves on the small one."""
    found = of(tmp_path, built.passing())
    assert [one.moment for one in found.maps][-1] == "apart"
    taken = np.count_nonzero(np.arange(len(LARGE)) % 8 == 0) / len(LARGE)
    for share in found.foreign, found.amid:
        assert share[:, -1] == pytest.approx([0, taken], abs=0.01)
        assert share[:, 0] == pytest.approx([0, 0], abs=0.01)


def test_moments_without_contact(tmp_path):
    found = of(tmp_path, built.chasing())
    assert [one.moment for one in found.maps] == ["start", "end"]  # they are closest at the start
    assert not found.touching.any()


@pytest.mark.parametrize("origin, periodic", PLACES, ids=ACROSS)
def test_the_upstream_end(origin, periodic):
    """Only there is the force known."""
    pair = Pair(built.merging(), origin=origin, periodic=periodic)
    grains = pair.frame(0.0)
    offset = pair.bed.nearest(grains.x - np.array([built.X1, 0, 0.015]) - pair.origin)
    force = np.where((offset[:, 0] < -2.0e-3) & (abs(offset[:, 2]) < 8 * D), 0.1, 9.0)
    sample = encounter_forces.sample_of(grains, force, pair.heap[grains.id], (0, 1), pair.bed)
    large = pair.heap[grains.id] == 1
    for way, known in ((1.0, True), (-1.0, False)):
        end = encounter_forces.upstream_end(sample, large, np.array((way, 0.0)), D)
        assert np.count_nonzero(end) > 100
        assert (force[end] == (0.1 if known else 9.0)).all()


def test_only_the_surface_counts():
    """Of a block six grains high, away from its edge the uppermost grains alone."""
    pair = Pair(built.merging())
    grains = pair.frame(0.0)
    surface = encounter_forces.at_surface(grains, pair.bed)
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
    assert "0.500 +- 0.000 on dune 1, 0.200 +- 0.000 on dune 0" in said
