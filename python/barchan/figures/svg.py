"""Figures as SVG files whose ink follows a light or a dark page.

Black lines and words become `--ink`, white becomes `--paper`, greys their counterparts between the two, and colours
that a dark page swallows become brighter there. The background is transparent. A page says which it is by its
`color-scheme`; elsewhere the reader's setting counts.
"""

import io
import re

import matplotlib

from barchan.figures import style

# Of dark pages: (red, green, blue) of words, of the page.
WORDS, PAGE = (0xE6, 0xE8, 0xEA), (0x2E, 0x39, 0x3E)
# colour on a light page: its name, and its colour on a dark one
COLOURS = {
    style.BLUE.lower(): ("blue", "#4ba3dc"),
    style.VERMILLION.lower(): ("vermillion", "#f08a4b"),
    style.SAND.lower(): ("sand", "#7a6a45"),
    style.SAND_EDGE.lower(): ("sand-edge", "#d8c49a"),
    "#f3ebd8": ("pale-sand", "#6b5d3e"),
    "#c9b183": ("slip-face", "#b39a63"),
    "#dcebf5": ("water", "#223a48"),
}
COLOUR = re.compile(r"(?<=[: \"])#[0-9a-f]{6}(?=[;\"])")
LONG = re.compile(r"scale\([^)]*\)|(\d+\.\d{3,})")  # coordinates [points], which need two digits; scales need all
DARK = "@media (prefers-color-scheme: dark)"


def named(colour):
    """(name, colour on a dark page) of a colour, None where it stays as it is."""
    levels = {int(colour[i:i + 2], 16) for i in (1, 3, 5)}
    if len(levels) > 1:
        return COLOURS.get(colour)
    level = levels.pop()
    name = {0: "ink", 255: "paper"}.get(level, f"grey-{level}")
    mixed = (round(words + (page - words) * level / 255) for words, page in zip(WORDS, PAGE))
    return name, "#" + "".join(f"{part:02x}" for part in mixed)


def rules(colours):
    """The style sheet of a file with these colours."""
    names = {colour: named(colour) for colour in sorted(colours) if named(colour)}
    light = "".join(f"--{name}:{colour};" for colour, (name, _) in names.items())
    dark = "".join(f"--{name}:{there};" for name, there in names.values())
    return f":root{{color-scheme:light dark;fill:var(--ink);{light}}}{DARK}{{:root{{{dark}}}}}"


def adapted(text):
    """The text of an SVG file of matplotlib, with colours by name."""
    sheet = rules({style.BLACK, *COLOUR.findall(text)})
    text = COLOUR.sub(lambda found: f"var(--{named(found[0])[0]})" if named(found[0]) else found[0], text)
    return re.sub(r"(<svg[^>]*>)", rf"\1<style>{sheet}</style>", text, count=1, flags=re.S)


def encoded(figure, title):
    """Bytes of the file; the same figure gives the same bytes."""
    for axes in figure.axes:
        if axes.get_facecolor()[:3] == (1.0, 1.0, 1.0):
            axes.patch.set_alpha(0.0)
    written = io.StringIO()
    with matplotlib.rc_context({"svg.hashsalt": "barchan"}):
        figure.savefig(written, format="svg", facecolor="none", dpi=2 * style.DPI,
                       metadata={"Title": title, "Date": None})
    return adapted(LONG.sub(lambda found: f"{float(found[1]):.2f}" if found[1] else found[0],
                            written.getvalue())).encode()
