#!/usr/bin/python3
"""Slices: the fields in a layer of cells are those of fields.h5, on one and two ranks and across a restart."""
import os
import subprocess

import matplotlib
import numpy as np

import barchan
import faults

matplotlib.use("agg")
SLICES = {"bed": ("y", 5e-4), "side": ("z", 0.0031), "end": ("x", 0.012)}
ENTRIES = ", ".join(f'{{name = "{name}", normal = "{normal}", at = {at}, interval = 2.5e-3}}'
                    for name, (normal, at) in SLICES.items())
CASE = {"time.end": 0.01, "output.fields_interval": 2.5e-3, "output.slice": f"[{ENTRIES}]"}
ENVIRONMENT = {**faults.ENVIRONMENT, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}


def run(folder, *words, ranks=1, **settings):
    launcher = ["mpirun", "--quiet", "--oversubscribe", "-np", str(ranks)] if ranks > 1 else []
    command = faults.command(folder, {**CASE, **{key.replace("__", "."): value for key, value in settings.items()}})
    return subprocess.run([*launcher, *command, *words], env=ENVIRONMENT, capture_output=True, text=True, timeout=300)


def check_layers(folder):
    """Each slice has the layer of cells that holds its place, with the values of fields.h5."""
    read = barchan.open(folder)
    if sorted(read.slices) != sorted(SLICES):
        faults.fail(f"{folder} has the slices {sorted(read.slices)}")
    for name, (normal, at) in SLICES.items():
        layer = read.slices[name]
        bounds = layer[f"{normal}_bnds"].values
        inside = bounds[0, 0] - 1e-12 <= at <= bounds[0, 1] + 1e-12
        if layer.sizes[normal] != 1 or not inside:
            faults.fail(f"{name}: {layer.sizes[normal]} layers, from {bounds[0]} for {at}")
        whole = read.fields.sel({normal: layer[normal].values})
        if not np.array_equal(whole.time, layer.time) or layer.time.size != 5:
            faults.fail(f"{name} has the times {layer.time.values}")
        for field in ("u", "v", "w", "p", "alpha_f"):
            if not np.array_equal(whole[field].values, layer[field].values):
                faults.fail(f"{folder}: {field} of the slice {name} is not that of fields.h5")
    if float(abs(read.slices["side"].u).max()) == 0:
        faults.fail("nothing flows")


def test(work):
    whole = work / "whole"
    faults.expect(run(whole), 0)
    check_layers(whole)
    parted = work / "parted"
    faults.expect(run(parted, time__end=0.005), 0)
    faults.expect(run(parted, "--resume"), 0)
    for name in SLICES:
        faults.same_bits.compare(whole / f"slice_{name}.h5", parted / f"slice_{name}.h5")
    faults.expect(run(work / "ranks", ranks=2), 0)
    check_layers(work / "ranks")
    paths = barchan.open(whole).figure("probes").numbers
    if sorted(paths) != [f"slice_{name}" for name in sorted(SLICES)]:
        faults.fail(f"the figure has {sorted(paths)}")
    faults.expect(run(whole, "--overwrite", output__slice="[]"), 0)
    if list(whole.glob("slice_*")):
        faults.fail("slices of an earlier run stayed")
    for wrong, told in (('[{name = "a b", at = 0}]', "letters, digits"), ('[{name = "a"}]', "missing"),
                        ('[{name = "a", at = 1.0}]', "inside the domain"),
                        ('[{name = "a", at = 0}, {name = "a", at = 0}]', "earlier slice")):
        faults.expect(run(work / "wrong", output__slice=wrong), 2, told)


if __name__ == "__main__":
    os.environ.setdefault("MPLBACKEND", "agg")
    faults.in_a_new_folder(test)
    print("slices are layers of the fields")
