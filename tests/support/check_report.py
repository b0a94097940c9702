#!/usr/bin/env python3
"""Reads a report page back: check_report.py RUN_DIR whole|nasty|flow.

Prints what is wrong, a sentence a line; the exit status is then 1.
"""

import base64
import json
import os
import re
import sys
from html.parser import HTMLParser
from pathlib import Path

import numpy as np

os.environ.setdefault("HDF5_USE_FILE_LOCKING", "FALSE")
import h5py  # noqa: E402

NASTY = 'A </script><script>alert(1)</script> & "dune" {{css}}'
wrong = []


def expect(condition, text):
    if not condition:
        wrong.append(text)


class Page(HTMLParser):
    """Elements by name, text of the elements with an id, all attributes that could load something."""

    def __init__(self, text):
        super().__init__()
        self.tags, self.texts, self.loads, self.inside = [], {}, [], []
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.tags.append(tag)
        self.loads += [value for name, value in attributes.items()
                       if name in ("src", "href", "data", "poster")]
        if tag not in ("meta", "input", "br"):
            self.inside.append(attributes.get("id") or tag)

    def handle_endtag(self, _tag):
        if self.inside:
            self.inside.pop()

    def handle_data(self, data):
        for name in self.inside:
            self.texts[name] = self.texts.get(name, "") + data


def verdicts(text):
    """{name of the check: verdict} of the table of health."""
    body = text.partition('<table class="health">')[2].partition("<tbody>")[2].partition("</table>")[0]
    return dict(re.findall(r"<tr><th>(.*?)<small>.*?</span> ([a-z ]+)</td></tr>", body))


def check_self_contained(text, page):
    found = re.search(r"https?://|//[a-z]+\.|url\(|@import|<link|<img|<iframe", text)
    expect(not found, f"the page refers to something: {found}")
    expect(not page.loads, f"the page loads {page.loads}")
    expect(len(text) < 6e6, "the page is larger than 6 MB")
    expect("{{" not in text.replace("{{css}}", ""), "a place of the template is empty")


def check_grains(folder, page):
    """Every grain stands where grains.h5 has it, within the rounding to 16 bits; thinned ones are named."""
    facts = json.loads(page.texts["facts"])
    words = np.frombuffer(base64.b64decode(page.texts["data"]), "<u2").astype(float)
    n, times = facts["n"], facts["times"]
    expect(n <= 10_000 and len(times) <= 60, "too many grains or frames")
    expect(len(words) == n * (1 + 3 * len(times)), "the data have another length than the facts say")
    with h5py.File(folder / "grains.h5") as file:
        frames = [file[name] for name in sorted(file) if "x" in file[name]]
        fullest = np.sort(max((frame["id"][:] for frame in frames), key=len))
        expect(np.allclose(times, [frame.attrs["time"] for frame in frames]),
               "other times than those of grains.h5")
        ids = fullest[::-(-len(fullest) // 10_000)]
        expect(n == len(ids), f"{n} grains shown, not {len(ids)}")
        expect(f"{n:,} of {len(fullest):,} grains" in page.texts["player"],
               "does not say how many grains are left out")
        for index, frame in enumerate(frames):
            shown = words[n:].reshape(len(times), 3, n)[index]
            places = dict(zip(frame["id"][:].tolist(), frame["x"][:]))
            there = np.array([number in places for number in ids.tolist()])
            expect(np.array_equal(shown[0] != 65535, there), f"frame {index}: other grains are there")
            true = np.array([places[number] for number in ids[there].tolist()])
            for axis, (low, high) in enumerate(facts["bounds"]):
                seen = low + shown[axis, there] / 65534 * (high - low)
                expect(np.allclose(seen, true[:, axis], rtol=0, atol=0.51 * (high - low) / 65534),
                       f"frame {index}: positions along axis {axis} are wrong")


def main(folder, kind):
    text = (folder / "report.html").read_text(encoding="utf-8")
    page = Page(text)
    check_self_contained(text, page)
    expect(page.tags.count("script") == 3, "text of the run became a script")
    found = verdicts(text)
    if kind == "flow":
        expect("canvas" not in page.tags, "no grains, but a canvas")
        expect("no pictures of grains" in text, "does not say that there are no grains")
    else:
        check_grains(folder, page)
    n_curves = page.tags.count("figure")
    expect(n_curves == {"whole": 15, "flow": 15, "nasty": 0}[kind], f"{n_curves} curves")
    drawn = re.findall(r"<figcaption><b>(.*?)</b>", text)
    if kind != "nasty":  # what does not vary is not drawn
        expect("CFL number" in drawn and "bulk velocity" not in drawn, f"curves of {drawn}")
    if kind == "whole":
        expect(set(found.values()) == {"ok", "not recorded"}, f"a healthy run: {found}")
        expect(found["largest CFL number"] == "ok" and found["largest overlap"] == "ok", "reads history.csv")
    if kind == "nasty":
        expect(page.texts["title"] == NASTY, f"the title became {page.texts['title']}")
        bad = sorted(name for name, verdict in found.items() if verdict == "look at this")
        expect(bad == ["continuity residual, relative", "grains", "largest CFL number", "largest overlap",
                       "ledger: exchange mismatch", "pressure iterations", "status"], f"to look at: {bad}")
    for sentence in wrong:
        print(f"{folder.name}: {sentence}")
    return bool(wrong)


if __name__ == "__main__":
    sys.exit(main(Path(sys.argv[1]), sys.argv[2]))
