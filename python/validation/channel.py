"""channel: the clear-water channel on several meshes beside DNS, and its figures of merit.
channel_resolved: the same at a lower Reynolds number, every eddy resolved.

DNS: Moser, Kim & Mansour, Phys. Fluids 11, 943 (1999), Re_tau = 392 and 178.
"""

import datetime
import json

import numpy as np

from barchan.figures import channel, style
from barchan.flow.wall_units import friction_velocity
from validation import tables
from barchan.errors import BarchanError, MissingData
from barchan.io.run_folder import RunFolder
from barchan.io.tables import read_columns
from barchan.studies.spec import load_case

# saved as channel_<name>.csv: case in configs/validation, label, colour, line
MESHES = {
    "mesh1": ("channel-mesh-1", "mesh 1", style.BLUE, "-"),
    "mesh1_dns_box": ("channel-mesh-1", "mesh 1, DNS box", style.SKY, (0, (5, 1.2))),
    "mesh2": ("channel-mesh-2", "mesh 2, DNS box", style.GREEN, (0, (3, 1, 1, 1))),
    "mesh3": ("channel-mesh-3", "mesh 3, DNS box", style.VERMILLION, "-"),
    "across": ("channel-mesh-3", "half across", style.GREEN, "-"),
    "along": ("channel-fine", "half both ways", style.BLACK, (0, (5, 1.2))),
}
RESOLVED = {"dns_180": ("channel-dns-180", "this code, no model", style.BLUE, "-")}
SAVED = MESHES | RESOLVED
# Where a run may differ from its case.
TOLD = "domain.size", "fluid.cells", "time.fluid_step", "time.end", "statistics.start"
BULK = {"chan395": 17.545, "chan180": 15.679}  # bulk velocity over u_star of the DNS


def read_channels(folder, meshes=None):
    meshes = meshes or MESHES
    paths = {name: folder / f"channel_{name}.csv" for name in meshes}
    channels = [channel.Channel(name, *meshes[name][1:], tables.read_table(path)) for name, path in paths.items()
                if path.exists()]
    if not channels:
        raise MissingData(f"needs {next(iter(paths.values()))} or another saved channel")
    return channels


def read_dns(name="chan395"):
    return {**channel.read_dns(name), "bulk": BULK[name]}


def changes(config, case):
    """What a run has of the keys TOLD in place of what its case has, as the launcher takes it."""
    told = []
    for section, key in (dotted.split(".") for dotted in TOLD):
        value = config[section][key]
        if value != case[section][key]:
            told.append(f" --set '{section}.{key}={str(value).replace(' ', '')}'")
    return "".join(told)


def save(name, run_path, folder):
    """Keeps the statistics of a run as channel_<name>.csv; returns the path."""
    if name not in SAVED:
        raise BarchanError(f'no mesh "{name}"; meshes: {", ".join(SAVED)}')
    run = RunFolder(run_path)
    source = run.path / "statistics.csv"
    if not source.exists() or not run.domain:
        raise MissingData(f"needs statistics.csv and config.toml in {run_path}")
    config, identity = run.config, json.loads((run.path / "run.json").read_text())
    fluid, statistics = config["fluid"], config["statistics"]
    path = f"configs/validation/{SAVED[name][0]}.toml"
    case = load_case(tables.ROOT / path)
    if fluid["cells"][1] != case["fluid"]["cells"][1]:
        raise BarchanError(f'{run_path} has {fluid["cells"][1]} rows, {path} has {case["fluid"]["cells"][1]}')
    made = datetime.date.fromtimestamp(source.stat().st_mtime)
    samples = read_columns(source)["n_samples"][0]
    notes = {
        "title": case["case"]["title"],
        "command": f"./barchan run {path}{changes(config, case)}",
        "commit": identity["git_hash"],
        "machine": f'{tables.machine()}; {identity["device"]}',
        "date": made.isoformat(),
        "cells": " x ".join(map(str, fluid["cells"])),
        "height": f"{run.domain[1]:g} m",
        "bulk velocity": f'{fluid["mean_velocity"]:g} m/s',
        "averaged": f"{samples * statistics['interval']:.1f} s from {statistics['start']:g} s on",
    }
    path = folder / f"channel_{name}.csv"
    tables.write(path, notes, source.read_text().splitlines())
    return path


def peak(y_plus, values):
    """Height and value of the maximum, by the parabola through three points over ln y^+."""
    n = int(np.argmax(values))
    if n in (0, len(values) - 1):
        return y_plus[n], values[n]
    x = np.log(y_plus[n - 1:n + 2] / y_plus[n])
    a, b, c = np.polyfit(x, values[n - 1:n + 2], 2)
    return y_plus[n] * np.exp(-b / (2 * a)), c - b * b / (4 * a)


def merits(shown, dns):
    """(quantity, unit, reference, value) of everything that is compared."""
    curves = shown.curves
    u_star = friction_velocity(shown.table)
    bulk = float(shown.table.notes["bulk velocity"].split()[0])
    rows = [("u_star", "m/s", bulk / dns["bulk"], u_star)]
    for name in channel.STRESSES:
        expected, found = (peak(c["y_plus"], c[name]) for c in (dns, curves))
        stress = "-uv" if name == "uv" else name
        rows.append((f"{stress} peak", "u_star^2", expected[1], found[1]))
        rows.append((f"{stress} peak y+", "-", expected[0], found[0]))
    inside = (curves["y_plus"] > 5) & (curves["y_plus"] < dns["y_plus"][-1])
    y_plus, u_plus = curves["y_plus"][inside], curves["U_plus"][inside]
    expected = np.interp(np.log(y_plus), np.log(dns["y_plus"]), dns["U_plus"])
    off = u_plus / expected - 1
    worst = int(np.argmax(abs(off)))
    rows.append(("U+ over DNS less 1: largest for y+ > 5", "%", 0.0, 100 * off[worst]))
    rows.append(("  at y+", "-", np.nan, y_plus[worst]))
    deviation = curves["total"] - (1 - curves["y"])
    worst = int(np.argmax(abs(deviation)))
    rows.append(("total stress less 1 - y/h: largest", "%", 0.0, 100 * deviation[worst]))
    rows.append(("  at y/h", "-", np.nan, curves["y"][worst]))
    return rows


def summary(channels, dns):
    """Lines of a summary: a quantity each, value and deviation in % for each channel."""
    header = ["quantity", "unit", "DNS"]
    for shown in channels:
        header += [shown.name, f"{shown.name} off (%)"]
    lines = [",".join(header)]
    for rows in zip(*(merits(shown, dns) for shown in channels)):
        quantity, unit, reference, _ = rows[0]
        cells = [quantity, unit, f"{reference:.4g}" if np.isfinite(reference) else ""]
        for _, _, reference, value in rows:
            off = 100 * (value / reference - 1) if reference > 0 else np.nan
            cells += [f"{value:.4g}", f"{off:.1f}" if np.isfinite(off) else ""]
        lines.append(",".join(cells))
    return lines


def draw(folder):
    return channel.draw_channels(read_channels(folder), read_dns())


def draw_resolved(folder):
    return channel.draw_channels(read_channels(folder, RESOLVED), read_dns("chan180"))


def write_summary(source, out):
    path = out / "channel_summary.csv"
    notes = {"made by": "./barchan plot validation channel",
             "DNS": "Moser, Kim & Mansour (1999), Re_tau = 392; u_star from the bulk velocity"}
    tables.write(path, notes, summary(read_channels(source), read_dns()))
    return path
