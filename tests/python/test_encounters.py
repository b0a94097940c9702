"""Names of dunes through contact, and the classes of their encounters, of sequences that are built for each of them."""

import numpy as np
import pytest
from made_up_encounters import LARGE, LOOSE, SMALL, TIMES, Pair
import made_up_encounters as built

from barchan.dune import encounters
from barchan.dune.encounters import encounters as find
from barchan.dune.lineage import NONE, follow

KINDS = {"chasing": built.chasing, "touching": built.touching, "undecided": built.undecided,
         "merging": built.merging, "exchange": built.exchange, "passing": built.passing,
         "fragmentation-chasing": built.fragmentation_chasing,
         "fragmentation-exchange": built.fragmentation_exchange, "ejecting two": built.ejecting_two}
SAID = {"touching": "chasing", "passing": "exchange", "ejecting two": "fragmentation-exchange"}
PLACES = {"open": dict(origin=(0.0, 0.0)), "across the outlet": dict(origin=(0.058, 0.0), periodic=(True, True)),
          "across the side": dict(origin=(0.0, 0.0155))}
UP, DOWN = 1, 0   # names: the larger of the first frame is 0


@pytest.fixture(scope="module", params=[(name, place) for name in KINDS for place in PLACES], ids=" ".join)
def told(request):
    name, place = request.param
    pair = Pair(KINDS[name](), **PLACES[place])
    frames = pair.frames()
    return name, pair, frames, follow(frames, pair.bed)


def test_the_class(told):
    name, pair, _, lineage = told
    found = find(lineage, pair.bed)
    assert [(one.upstream, one.downstream, one.kind) for one in found] == [(UP, DOWN, SAID.get(name, name))]


def test_names_stay_and_masses_add_up(told):
    name, pair, frames, lineage = told
    assert lineage.present[:, [UP, DOWN]].all()
    pieces = {"exchange": 1, "ejecting two": 2, "fragmentation-chasing": 1, "fragmentation-exchange": 1}
    assert len(lineage.births) == 2 + pieces.get(name, 0)
    small, large = lineage.n_grains[0, [UP, DOWN]]
    assert (small, large) == (pytest.approx(len(SMALL), rel=0.02), pytest.approx(len(LARGE), rel=0.02))
    if name in ("chasing", "touching", "merging"):
        assert np.all(abs(lineage.n_grains[:, UP] - len(SMALL)) < 0.02 * len(SMALL))
    for frame in range(len(frames)):
        rows = lineage.heaps[:, 0] == frame
        assert lineage.heaps[rows, 3].sum() == pair.n
        assert lineage.heap_volumes[rows].sum() == pytest.approx(pair.n * np.pi / 6 * built.D**3)
        of_dunes = rows & (lineage.heaps[:, 2] != NONE)
        assert lineage.heaps[of_dunes, 3].sum() == np.count_nonzero(frames[frame].dune != NONE)


def test_paths_have_no_jumps(told):
    _, _, _, lineage = told
    for name in (UP, DOWN):
        steps = np.hypot(np.diff(lineage.x[:, name]), np.diff(lineage.z[:, name]))
        assert steps.max() < 5e-3  # half of the large one leaves in one frame; images are 30 and 80 mm apart


def test_times_and_grains_of_an_exchange():
    pair = Pair(built.passing())
    lineage = follow(pair.frames(), pair.bed)
    one, = find(lineage, pair.bed)
    taken = np.count_nonzero(np.arange(len(LARGE)) % 8 == 0)
    assert one.to_upstream == pytest.approx(taken, abs=0.05 * taken + LOOSE / 4)
    assert one.to_downstream <= LOOSE / 4
    assert one.t_contact == pytest.approx(3.0, abs=0.5)   # their edges meet after 4.5 mm at 1.5 mm/s
    assert one.t_apart == pytest.approx(8.0, abs=2.0)
    assert np.isnan(one.t_split)
    assert one.upstream_over_downstream == pytest.approx(len(SMALL) / len(LARGE), rel=0.03)
    assert one.distance_start == pytest.approx(built.X1 - built.X0, abs=1e-4)
    assert abs(one.offset) < 1e-4


@pytest.mark.parametrize("joins, kind", [(True, "merging"), (False, "dispersed")])
def test_a_dune_that_dissolves_in_contact_has_merged_if_its_grains_join_the_other(joins, kind):
    """From 4 to 4.5 s, or for good, the grains of the small one are loose: its name ends."""
    pair = Pair(built.merging())
    frames = pair.frames()
    for frame in frames:
        if 4 <= frame.time <= (4.5 if joins else 99):
            frame.dune[pair.heap[frame.id] == 0] = NONE
    lineage = follow(frames, pair.bed)
    one, = find(lineage, pair.bed)
    assert not lineage.present[-1, UP]
    assert (one.kind, one.t_end) == (kind, pytest.approx(TIMES[-1]))
    assert one.to_downstream == pytest.approx(len(SMALL) if joins else 0, rel=0.02, abs=LOOSE / 4)


@pytest.mark.parametrize("nearer, kind", [(0.4e-3, "chasing"), (0.6e-3, "undecided")])
def test_two_dunes_chase_each_other_while_they_come_no_nearer_than_a_bin(nearer, kind):
    pair = Pair([(SMALL, 0, built.line(built.X0, nearer / TIMES[-1])), (LARGE, 1, built.line(built.X1, 0.0))])
    one, = find(follow(pair.frames(), pair.bed), pair.bed)
    assert one.kind == kind


@pytest.mark.parametrize("left, kind", [(0.6, "merging"), (0.4, "dispersed")])
def test_a_dune_that_is_carried_away_in_contact_is_dispersed(left, kind):
    """From 5 s on only a part of the small one's grains are in the dune, the others are loose. Its name ends if they
    are less than half."""
    pair = Pair(built.merging())
    frames = pair.frames()
    carried = np.arange(pair.n) % 100 >= 100 * left
    for frame in frames:
        if frame.time >= 5:
            frame.dune[(pair.heap[frame.id] == 0) & carried[frame.id]] = NONE
    one, = find(follow(frames, pair.bed), pair.bed)
    assert one.kind == kind


def test_heaps_are_those_of_the_run():
    """Grains of the file's heaps, not of the dunes of the first frame, are counted where it has them."""
    pair = Pair(built.passing())
    frames = pair.frames()
    lineage = follow(frames, pair.bed, pair.heap[frames[0].id])
    last = lineage.heaps[lineage.heaps[:, 0] == len(frames) - 1]
    number = {(heap, name): n for _, heap, name, n in last}
    assert sum(n for (heap, _), n in number.items() if heap == 0) == len(SMALL)
    assert number[1, UP] == pytest.approx(np.count_nonzero(np.arange(len(LARGE)) % 8 == 0), rel=0.05)


def test_a_turned_current_turns_upstream_and_downstream():
    pair = Pair(built.chasing())
    one, = find(follow(pair.frames(), pair.bed), pair.bed, lambda t: np.array((-1.0, 0.0)))
    assert (one.upstream, one.downstream) == (DOWN, UP)
    assert one.kind == "chasing"


def test_dunes_far_from_each_other_do_not_meet():
    for parts in ([(SMALL, 0, built.line(0.006, 0)), (LARGE, 1, built.line(0.07, 0))],
                  [(SMALL, 0, built.line(0.012, 0, 0.006)), (LARGE, 1, built.line(0.024, 0, 0.022))]):
        pair = Pair(parts, periodic=(False, False))
        assert find(follow(pair.frames(TIMES[:6]), pair.bed), pair.bed) == []


def test_a_piece_of_a_moment_is_no_fragment():
    """The large one is in two for half a second."""
    def path(sign):
        return lambda t: np.array((built.X1 + 1e-3 * t, 0.015 + sign * (1e-3 if 2 <= t < 2.5 else 0.0)))
    halves = [(LARGE[built.LEFT], 1, path(-1)), (LARGE[~built.LEFT], 1, path(1))]
    pair = Pair([built.chasing()[0], *halves])
    lineage = follow(pair.frames(), pair.bed)
    assert len(lineage.births) == 3
    assert [one.kind for one in find(lineage, pair.bed)] == ["chasing"]
