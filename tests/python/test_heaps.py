"""Grains of several heaps: read with the names of these, and told apart in pictures."""

import base64

import numpy as np
import pytest
from fake_runs import fake
from matplotlib.colors import to_rgb

import barchan
from barchan.figures import grain_image, movie, style
from barchan.io.frames import with_fed
from barchan.report import grains as packed


@pytest.fixture(scope="module")
def run():
    return barchan.Run(fake("--heaps"))


def test_each_grain_knows_its_heap(run):
    grains = run.frame(3)
    assert grains.heaps == ("first", "<second>")
    assert np.array_equal(grains.heap, grains.id % 3 // 2)
    assert np.array_equal(run.grains(frame=3).heap, run.grains(frame=3).index % 3 // 2)
    one = barchan.Run(fake()).frame(3)
    assert one.heap is None and one.heaps == ()


def test_seen_from_above_they_have_the_colours_of_their_heaps(run):
    """In full light: no shade changes the ratio of the three parts of a colour."""
    grains = run.frame(0)
    window = (0.015, 0.035, 0.01, 0.03)
    picture = grain_image.top_view(grains, window, 400, 2e-3)
    for heap, colour in enumerate(style.GROUPS[:2]):
        alone = grain_image.top_view(of_heap(grains, heap), window, 400, 2e-3)
        inside = alone[alone.min(axis=2) < 0.3]  # not towards white at an edge
        ratio = inside / inside.max(axis=1, keepdims=True)
        assert np.median(abs(ratio - np.array(to_rgb(colour)) / max(to_rgb(colour))).max(axis=1)) < 0.01
    one = grain_image.top_view(barchan.Run(fake()).frame(0), window, 400, 2e-3)
    assert abs(one - picture).max() > 0.3


def of_heap(grains, heap):
    rows = grains.heap == heap
    return type(grains)(grains.time, grains.id[rows], grains.x[rows], grains.d[rows], heap=grains.heap[rows],
                        heaps=grains.heaps)


def test_the_key_of_the_figure_names_them(run):
    bar = run.figure("topviews").axes[-1]
    assert [text.get_text() for text in bar.get_xticklabels()] == ["first", "<second>"]


def test_tracks_have_the_heaps_of_their_grains(run):
    grains = movie.known_grains(run)
    assert np.array_equal(grains.heap, grains.id % 3 // 2) and grains.heaps == ("first", "<second>")


def test_they_travel_inside_the_report(run):
    facts, data = packed.pack(run)
    words = np.frombuffer(base64.b64decode(data), "<u2")
    assert len(words) == facts["n"] * (2 + 3 * len(facts["times"]))
    assert set(words[-facts["n"]:]) == {0, 1}
    kept, _ = packed.kept_ids(run, packed.evenly(len(run.grain_file.frames), packed.MOST_FRAMES))
    assert np.array_equal(words[-facts["n"]:], kept % 3 // 2)
    assert [heap["name"] for heap in facts["groups"]] == ["first", "<second>"]
    facts, data = packed.pack(barchan.Run(fake()))
    assert facts["groups"] == [] and len(base64.b64decode(data)) == 2 * facts["n"] * (1 + 3 * len(facts["times"]))


def test_fed_grains_are_a_heap_of_their_own():
    heap, names = with_fed(np.array([0, -1, 1]), ("first", "second"))
    assert heap.tolist() == [0, 2, 1] and names == ("first", "second", "fed")
    assert with_fed(np.array([0, 1]), ("first", "second"))[1] == ("first", "second")
    assert with_fed(None, ()) == (None, ())
