"""A run at the end of a notebook's cell: a table of its state and the animation of the report.

Nothing is loaded from elsewhere. The animation is a page of its own, in a frame, so that its looks and its keys are not
those of the notebook. At most 24 frames of 2,000 grains travel, less than 0.5 MB; of a large run fewer frames are read.
"""

from html import escape

from barchan import report
from barchan.errors import BarchanError, MissingData
from barchan.report import grains

MOST_FRAMES, MOST_GRAINS = 24, 2000
MOST_READ = 10_000_000  # grains of all frames: reading them takes some seconds
PAGE = """<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><meta name="color-scheme" content="light dark">
<meta http-equiv="Content-Security-Policy"
 content="default-src 'none'; style-src 'unsafe-inline'; script-src 'unsafe-inline'">
<title>{title}</title><style>{css} body {{ margin: 0; padding: .3rem .5rem; max-width: none; }}</style></head>
<body>{player}
<script type="application/json" id="facts">{facts}</script>
<script type="text/plain" id="data">{data}</script>
<script>{js}</script>
</body></html>"""
# The frame is as high as what is in it, which is known when it is there.
FRAME = """<iframe title="the grains" srcdoc="{page}" style="width: 100%; max-width: 50rem; height: 24rem; border: 0"
 onload="this.style.height = this.contentDocument.documentElement.scrollHeight + 'px'"></iframe>"""


def html(run):
    """Of a run with any files or none."""
    return f"<div><b>{escape(str(run.title))}</b>{report.table(state(run))}{animation(run)}</div>"


def state(run):
    """(name, value): what is known."""
    summary = report.read_summary(run)
    seconds, end = summary.get("simulated_seconds"), run.config.get("time", {}).get("end")
    size = run.main_dune_columns if run.dune_columns else {}
    return [
        ("folder", run.path), ("status", summary.get("status", "no run.json")),
        ("time", f"{seconds:g} s" + (f" of {end:g} s" if end else "") if seconds is not None else None),
        ("grains", count(run)),
        *((f"{what} {name}", f"{1e3 * size[name][-1]:.3g} mm" if name in size else None)
          for what, name in (("width", "W"), ("length", "L"))),
    ]


def count(run):
    """Grains in the last frame."""
    try:
        file = run.need_grains()
        with file.open() as content:
            return f"{len(content[file.frames[-1][1]]['id']):,}"
    except BarchanError:
        return None


def animation(run):
    """A frame with the player; a sentence where the grains cannot be read, nothing where there are none."""
    try:
        file = run.need_grains()
        with file.open() as content:
            largest = max(len(content[file.frames[index][1]]["id"]) for index in (0, -1))
        frames = max(1, min(MOST_FRAMES, MOST_READ // max(1, largest)))
        facts, data = grains.pack(run, frames, MOST_GRAINS)
    except MissingData:
        return ""
    except BarchanError as reason:
        return f"<p>The grains cannot be shown: {escape(str(reason))}.</p>"
    page = PAGE.format(title=escape(str(run.title)), css=report.template("css"), player=report.player(facts, None),
                       facts=grains.to_script(facts), data=data, js=report.template("js"))
    return FRAME.format(page=escape(page))
