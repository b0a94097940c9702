"""SVG files of figures: ink that follows the page, coordinates that are short and scales that are whole."""
import re
import xml.etree.ElementTree as tree

import numpy as np
import pytest
from matplotlib.figure import Figure

from barchan.figures import style, svg


@pytest.fixture
def drawn(tmp_path):
    with style.look():
        figure = Figure(figsize=(3, 2))
        axes = figure.subplots()
        axes.plot([0, 1], [0, np.pi], color=style.BLUE, label="blue")
        axes.axvspan(0.2, 0.4, color="0.88")
        axes.text(0.5, 1, "black", bbox={"fc": "white", "ec": style.GREEN})
        return style.save(figure, tmp_path, "drawn", "a title", ("png", "pdf", "svg"))


def test_every_kind_that_is_asked_for_is_written(drawn, tmp_path):
    assert [path.suffix for path in drawn] == [".png", ".pdf", ".svg"]
    assert [path.read_bytes()[:4] for path in drawn[:2]] == [b"\x89PNG", b"%PDF"]
    tree.parse(drawn[2])


def test_ink_has_a_colour_for_light_and_for_dark_pages(drawn):
    sheet, body = re.search(r"<style>(:root.*?)</style>(.*)", drawn[2].read_text(), re.S).groups()
    light, dark = (dict(re.findall(r"--([\w-]+):(#\w{6})", part)) for part in sheet.split("@media"))
    used = set(re.findall(r"var\(--([\w-]+)\)", body))
    assert {"ink", "paper", "blue", "grey-224"} <= used <= set(light) == set(dark)
    assert (light["ink"], light["paper"], light["blue"]) == ("#000000", "#ffffff", "#0072b2")
    assert all(light[name] != dark[name] for name in used)
    level = {name: int(colour[1:3], 16) for name, colour in dark.items()}
    assert level["paper"] < level["grey-224"] < level["ink"]  # turned round, and in order
    assert not re.search(r"#000000|#ffffff", body)
    assert style.GREEN.lower() in body  # is seen on both


def test_glyphs_keep_their_scale_and_points_have_two_digits(drawn):
    text = drawn[2].read_text()
    assert re.search(r"scale\(0\.\d{3}", text)
    assert not re.search(r"\d\.\d{3}", re.sub(r"scale\([^)]*\)", "", text.replace('version="1.1"', "")))


def test_the_same_figure_gives_the_same_bytes():
    def one():
        figure = Figure()
        figure.subplots().plot([0, 1], marker="o")
        return svg.encoded(figure, "t")

    assert one() == one()
