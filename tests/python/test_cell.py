"""A run at the end of a notebook's cell: a table and the animation, in one piece and small."""

import html
import json
import re
from html.parser import HTMLParser

import h5py
import numpy as np
import pytest
from fake_runs import fake

import barchan
from barchan.report import cell, grains


class Page(HTMLParser):
    """Rows of tables, the page in the frame, and what is fetched from elsewhere."""

    def __init__(self, text):
        super().__init__()
        self.text, self.frame, self.fetched, self.open = [], None, [], []
        self.feed(text)
        assert not self.open

    def handle_starttag(self, tag, attributes):
        values = dict(attributes)
        self.fetched += [values[name] for name in ("src", "href", "data") if name in values]
        self.frame = values.get("srcdoc", self.frame)
        if tag not in ("meta", "input"):
            self.open.append(tag)

    def handle_endtag(self, tag):
        assert self.open.pop() == tag

    def handle_data(self, data):
        self.text.append(data)


def facts_of(page):
    return json.loads(re.search(r'<script type="application/json" id="facts">(.*?)</script>', page, re.S)[1])


def test_state_and_grains():
    run = barchan.Run(fake())
    shown = Page(run._repr_html_())
    dune = run.dunes.loc[0].iloc[-1]
    for text in (run.title, "done", f"{1e3 * dune.W:.3g} mm", f"{1e3 * dune.L:.3g} mm", f"{len(run.grains()):,}"):
        assert text in shown.text
    page = Page(shown.frame)
    assert not shown.fetched and not page.fetched and "://" not in shown.frame
    facts = facts_of(shown.frame)
    assert facts["times"] == run.grain_times.tolist() and 0 < facts["n"] <= cell.MOST_GRAINS
    assert "▶" in page.text
    assert not list(run.path.glob("report.html"))


def test_names_are_text(tmp_path):
    title = '<script>alert("&amp;")</script>'
    (tmp_path / "config.toml").write_text(f"[case]\ntitle = {json.dumps(title)}\n")
    shown = barchan.Run(tmp_path)._repr_html_()
    assert html.escape(title) in shown and "<script" not in shown


def test_a_run_without_anything(tmp_path):
    shown = Page(barchan.Run(tmp_path)._repr_html_())
    assert shown.frame is None and "no run.json" in shown.text and tmp_path.name in shown.text


def write_grains(path, n, frames):
    random = np.random.default_rng(3)
    with h5py.File(path / "grains.h5", "w") as file:
        for index in range(frames):
            group = file.create_group(f"frame_{index:06d}")
            group.attrs["time"] = 0.1 * index
            group["id"], group["x"], group["d"] = np.arange(n), random.random((n, 3)), np.full(n, 2e-4)


def test_a_long_run_stays_small(tmp_path):
    write_grains(tmp_path, 4 * cell.MOST_GRAINS, 3 * cell.MOST_FRAMES)
    shown = barchan.Run(tmp_path)._repr_html_()
    facts = facts_of(Page(shown).frame)
    assert (len(facts["times"]), facts["n"]) == (cell.MOST_FRAMES, cell.MOST_GRAINS)
    assert facts["times"][-1] == pytest.approx(0.1 * (3 * cell.MOST_FRAMES - 1))
    assert "every 4th by its number" in Page(shown).frame
    assert 300_000 < len(shown) < 500_000


def test_of_a_large_run_few_frames_are_read(tmp_path, monkeypatch):
    write_grains(tmp_path, 50, 20)
    monkeypatch.setattr(cell, "MOST_READ", 4 * 50 + 49)
    assert len(facts_of(Page(barchan.Run(tmp_path)._repr_html_()).frame)["times"]) == 4


def test_grains_that_cannot_be_read(tmp_path, monkeypatch):
    write_grains(tmp_path, 50, 3)

    def broken(*_):
        raise barchan.BarchanError("cannot read <it>")
    monkeypatch.setattr(grains, "pack", broken)
    shown = barchan.Run(tmp_path)._repr_html_()
    assert "The grains cannot be shown: cannot read &lt;it&gt;." in shown and "iframe" not in shown
