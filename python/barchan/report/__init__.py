"""report: one page about a run that needs nothing else: no network, no other file.

Its parts: page.html, .css and .js beside this file; numbers from run.json, config.toml, log.txt, the
tables and grains.h5, as far as they are there. All text from the run is escaped.
"""

import math
import re
import shlex
import time
from datetime import datetime
from html import escape
from pathlib import Path

import numpy as np

from barchan.errors import BarchanError, MissingData
from barchan.io.run_folder import json_of, text_of
from barchan.io.writing import write
from barchan.report import curves as curve_figures
from barchan.report import grains as grain_pictures
from barchan.report import health as health_checks

HERE = Path(__file__).parent
TEXTS = ("title", "status", "message", "version", "git_hash", "backend", "device")  # of run.json
MARKS = {health_checks.OK: ("ok", "✓"), health_checks.LOOK: ("look", "!"),
         health_checks.UNKNOWN: ("none", "–")}
PHASES = {"exchange": "exchange of momentum", "grains": "grain steps", "list": "neighbour lists",
          "deposit": "grains to mesh", "fluid": "flow", "pressure": "pressure", "output": "files",
          "analytics": "dune analytics"}


def write_files(run, reload=None):
    """Writes report.html into the run folder; returns its path in a list.

    reload: seconds after which the page loads itself again, for a run that goes on; None: never. Such a page has the
    date at which it was begun: it is older than what the run has written since.
    """
    began = time.time()
    summary = read_summary(run)
    if not (summary or run.config or run.history_columns or run.dune_columns):
        raise MissingData("needs at least run.json, config.toml or a table with a line in it")
    found = health_checks.checks(run, summary)
    facts, data, missing = packed_grains(run)
    parts = {
        "title": escape(title(run, summary)), "status": status(summary), "header": header(run, summary),
        "summary": verdict(found), "health": health(found), "derived": derived(run),
        "player": player(facts, missing), "curves": curves(run),
        "phases": phases(summary), "rates": rates(summary), "config": config(run),
        "files": files(run), "commands": commands(run, summary), "next": next_steps(run),
        "css": template("css"), "js": template("js"), **reloading(reload),
        "facts": grain_pictures.to_script(facts or {}), "data": data,
    }
    page = re.sub(r"\{\{(\w+)\}\}", lambda match: parts[match[1]], template("html"))
    path = run.path / "report.html"
    write(path, page, None if reload is None else began)
    return [path]


def template(ending):
    return (HERE / f"page.{ending}").read_text(encoding="utf-8")


def reloading(seconds):
    """What a page that loads itself again has more than another."""
    if seconds is None:
        return {"reload_after": "", "reload_js": "", "reload_note": ""}
    return {"reload_after": f' data-reload="{seconds:g}"', "reload_js": f"<script>\n{template('reload.js')}</script>\n",
            "reload_note": '<p class="quiet">The run goes on; this page loads itself again.</p>\n'}


def read_summary(run):
    """run.json, {} when it is not there or not whole; of a foreign one what is no number or text is left out."""
    def numbers(table):
        return {name: value if value is None or math.isfinite(value) else None for name, value in table.items()
                if value is None or type(value) in (int, float)}

    summary = json_of(run.path / "run.json")
    tables = {name: numbers(value) for name, value in summary.items() if isinstance(value, dict)}
    texts = {name: str(summary[name]) for name in TEXTS if summary.get(name)}
    return numbers(summary) | tables | texts


def title(run, summary):
    return summary.get("title") or str(run.title)


def packed_grains(run):
    """(facts, data, None), or (None, "", a sentence why there are no grains)."""
    try:
        return *grain_pictures.pack(run), None
    except MissingData:
        return None, "", "This run has no pictures of grains (no frame with grains in grains.h5)."
    except BarchanError as reason:
        return None, "", f"The grains cannot be shown: {reason}."


def status(summary):
    state = str(summary.get("status", "no run.json"))
    return f'<span class="badge {"good" if state == "done" else "other"}">{escape(state)}</span>'


def table(rows, kind=""):
    """Two columns: name and value, escaped; rows without a value are left out."""
    lines = "".join(f"<tr><th>{escape(str(name))}</th><td>{escape(str(value))}</td></tr>"
                    for name, value in rows if value not in (None, ""))
    return f'<table class="{kind}">{lines}</table>' if lines else '<p class="quiet">Not recorded.</p>'


def header(run, summary):
    seconds, wall = summary.get("simulated_seconds"), summary.get("wall_seconds")
    end = run.config.get("time", {}).get("end")
    return table([
        ("simulated", f"{seconds:g} s" + (f" of {end:g} s" if end else "") if seconds is not None else None),
        ("wall time", duration(wall) if wall is not None else None), ("steps", summary.get("steps")),
        ("version", " ".join(filter(None, (summary.get("version"), summary.get("git_hash"))))),
        ("backend", summary.get("backend")), ("device", summary.get("device")),
        ("threads, ranks", ", ".join(str(summary[key]) for key in ("threads", "ranks") if key in summary)),
        ("started", date(run.path / "config.toml")), ("last written", date(run.path / "run.json")),
        ("this page", f"{datetime.now():%Y-%m-%d %H:%M}"),
    ])


def date(path):
    """Of a file or link; a copy of a run may have lost it."""
    there = path.exists() or path.is_symlink()
    return f"{datetime.fromtimestamp(path.lstat().st_mtime):%Y-%m-%d %H:%M}" if there else None


def duration(seconds):
    minutes, rest = divmod(round(seconds), 60)
    hours, minutes = divmod(minutes, 60)
    if hours:
        return f"{hours} h {minutes:02d} min"
    return f"{minutes} min {rest:02d} s" if minutes else f"{seconds:.3g} s"


def verdict(found):
    look = [check.name for check in found if check.verdict == health_checks.LOOK]
    if look:
        return f'<span class="mark look">!</span> Look at: {escape(", ".join(look))}.'
    known = sum(check.verdict == health_checks.OK for check in found)
    rest = "" if known == len(found) else f" The other {len(found) - known} are not recorded."
    return f'<span class="mark ok">✓</span> {known} of {len(found)} checks are ok.{rest}'


def health(found):
    rows = []
    for check in found:
        kind, sign = MARKS[check.verdict]
        rows.append(f'<tr><th>{escape(check.name)}<small>{escape(check.about)}</small></th>'
                    f'<td>{escape(check.value)}</td><td class="limit">{escape(check.limit)}</td>'
                    f'<td class="verdict"><span class="mark {kind}">{sign}</span> {check.verdict}</td></tr>')
    return ('<table class="health"><thead><tr><th>check</th><td>value</td><td>limit</td><td>verdict</td></tr>'
            f'</thead><tbody>{"".join(rows)}</tbody></table>')


def derived(run):
    """The derived numbers and warnings at the head of log.txt, or a few from the configuration."""
    lines = text_of(run.path / "log.txt").splitlines()
    matches = (re.match(r"  (\S.*?)\s{2,}(\S.*)$", line) for line in lines)
    rows = [match.groups() for match in matches if match]
    warnings = dict.fromkeys(line.partition(": ")[2] for line in lines if line.startswith("warning: "))
    said = "".join(f'<p class="warning"><span class="mark look">!</span> {escape(text)}</p>'
                   for text in warnings)
    return table(dict(rows or from_config(run.config)).items()) + said


def largest_speed(fluid):
    """Largest bulk velocity [m/s] that a section [fluid] asks for."""
    entries = fluid.get("schedule") or [{"velocity": fluid.get("mean_velocity", 0)}]
    return max(sum(math.hypot(*np.atleast_1d(entry.get(part, 0))) for part in ("velocity", "amplitude"))
               for entry in entries)


def from_config(config):
    fluid, grains = config.get("fluid", {}), config.get("grains", {})
    size = config.get("domain", {}).get("size", [])
    cells, nu = fluid.get("cells"), fluid.get("kinematic_viscosity", 1e-6)
    speed = largest_speed(fluid)
    return [
        ("domain", " × ".join(f"{1e3 * length:g}" for length in size) + " mm" if size else None),
        ("cells", " × ".join(map(str, cells)) if cells else None),
        ("bulk velocity U", f"{speed:g} m/s" if speed else None),
        ("Re = 2 δ U / ν", f"{2 * size[1] * speed / nu:.0f}" if speed and len(size) == 3 else None),
        ("grains", sum(count for _, count in grains.get("sizes", [])) or None),
    ]


def player(facts, missing):
    if facts is None:
        return f'<p class="quiet">{escape(missing)}</p>'
    return f"""<div id="player" tabindex="0">
<div class="controls"><button id="play" type="button" aria-label="play">▶</button>
<input id="scrubber" type="range" min="0" max="{len(facts["times"]) - 1}" value="0" aria-label="time">
<output id="time"></output></div>
<canvas id="top" role="img" aria-label="the grains seen from above"></canvas>
<canvas id="side" role="img" aria-label="the grains seen from the side"></canvas>
<div class="below"><span class="bar">{colour_key(facts)}</span>
<label><input id="near" type="checkbox"> follow the dune</label></div>
<p class="quiet">{escape(facts["note"])} Seen from above, then from the side, x from
left to right. Arrow keys go from one time to the next, the space bar plays.</p></div>"""


def colour_key(facts):
    if facts["groups"]:
        return " ".join(f'<i class="group" style="background:{group["colour"]}"></i> {escape(group["name"])}'
                        for group in facts["groups"])
    swatch = ", ".join(facts["colours"])
    return (f'0 <i style="background:linear-gradient(90deg, {swatch})"></i>\n'
            f'{1e3 * facts["top"]:.2g} mm <span class="quiet">height of a grain\'s top</span>')


def curves(run):
    parts = []
    if run.dune_columns:
        others = len(run.dune_columns) - 1
        more = f" {others} more {'dune has' if others == 1 else 'dunes have'} been counted." if others else ""
        parts.append(("The dune", f"Dune {min(run.dune_columns)}, the largest of the first time.{more}",
                      curve_figures.figures(run.dune_columns[min(run.dune_columns)], curve_figures.MORPHOLOGY)))
    if run.history_columns:
        parts.append(("Flow and solver", "", curve_figures.figures(run.history_columns, curve_figures.HISTORY)))
    return "".join(f'<section><h2>{name}</h2><p class="quiet">{about}</p>'
                   f'<div class="plots">{plots}</div></section>' for name, about, plots in parts if plots)


def phases(summary):
    spent = {name: value for name, value in (summary.get("phases") or {}).items() if value}
    total = sum(spent.values())
    if not total:
        return '<p class="quiet">Not recorded.</p>'
    rows = []
    for name, value in sorted(spent.items(), key=lambda item: -item[1]):
        share = value / total
        rows.append(f'<tr><th>{escape(PHASES.get(name, name))}</th><td>{1e3 * value:.3g} ms</td>'
                    f'<td>{100 * share:.1f} %</td>'
                    f'<td class="share"><i style="width:{100 * share:.1f}%"></i></td></tr>')
    return ('<table class="phases"><thead><tr><th>phase</th><td>per step</td><td>share</td><td></td></tr>'
            f'</thead><tbody>{"".join(rows)}</tbody></table>')


def rates(summary):
    def per_second(key):
        value = summary.get(key)
        return f"{value / 1e6:.3g} million/s" if value else None
    steps, wall = summary.get("steps"), summary.get("wall_seconds")
    return table([("grains × grain steps", per_second("grain_steps_per_second")),
                  ("cells × fluid steps", per_second("cell_steps_per_second")),
                  ("wall time per step", f"{1e3 * sum(filter(None, summary['phases'].values())):.3g} ms"
                   if steps and wall and summary.get("phases") else None)])


def config(run):
    text = text_of(run.path / "config.toml")
    for file in (run.field_file,) if not text else ():
        text = file.config_text if file else ""
    return f"<pre>{escape(text)}</pre>" if text else '<p class="quiet">Not recorded.</p>'


def files(run):
    """Name, size and date of each file; folders with their number of files."""
    rows = []
    for path in sorted(run.path.iterdir()):
        if path.name.startswith("report.html"):
            continue
        try:
            rows.append((path.name + "/" * (path.is_dir() and not path.is_symlink()), amount(path), date(path)))
        except OSError:  # gone since, as the temporary file of a run
            continue
    body = "".join(f"<tr><th>{escape(name)}</th><td>{amount}</td><td>{when}</td></tr>"
                   for name, amount, when in rows)
    return f'<table class="files">{body}</table>'


def amount(path):
    """How much is there; where a link leads is another matter."""
    if path.is_symlink():
        return "link"
    return f"{sum(1 for _ in path.iterdir())} files" if path.is_dir() else size(path.lstat().st_size)


def size(n_bytes):
    for unit in ("B", "kB", "MB"):
        if n_bytes < 1000:
            return f"{n_bytes:.3g} {unit}"
        n_bytes /= 1000
    return f"{n_bytes:.3g} GB"


def commands(run, summary):
    folder, again = (shlex.quote("./" * name.startswith("-") + name) for name in (str(run.path), f"{run.path}-again"))
    commit, _, changed = str(summary.get("git_hash", "")).partition("-")
    count = summary.get("threads")
    threads = f" --threads {count}" if type(count) is int and count > 0 else ""
    lines = [f"git checkout {commit}" + ("    # and changes that were not committed" if changed else "")] \
        if re.fullmatch(r"[0-9a-f]{7,40}", commit) else []
    lines += [f"./barchan run {folder}/config.toml --out {again}{threads}",
              f"./barchan plot {folder}", f"./barchan plot {folder} report"]
    start = {key: value for key, value in run.config.get("initial", {}).items()
             if isinstance(value, str) and value.endswith((".toml", ".h5", ".csv"))}
    needs = ("The run starts from " + " and ".join(f"{value} ({key})" for key, value in start.items())
             + ": the files must be there." if start else "")
    return f"<pre>{escape(chr(10).join(lines))}</pre><p class=\"quiet\">{escape(needs)}</p>"


def next_steps(run):
    """Commands and files that lead on from here."""
    folder = str(run.path)
    shown = [name for name in ("grains.xdmf", "fields.xdmf") if (run.path / name).exists()]
    steps = [f"<code>./barchan plot {escape(folder)} --help</code> lists all figures",
             f"<code>barchan.open({escape(repr(folder))})</code> reads the tables in Python"]
    steps += [f"<code>{shown[0]}</code> opens in ParaView"] if shown else []
    return "; ".join(steps) + ". Tutorials: docs/first-case.md, docs/results.md."
