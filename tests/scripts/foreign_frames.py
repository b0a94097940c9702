"""Figures read a grains.h5 of others, a damaged one, and one that a run is writing, or say why not."""
import pathlib
import shutil
import subprocess
import sys
import time

import faults
import numpy as np

ROOT = pathlib.Path(__file__).resolve().parents[2]
from barchan.io import hdf5 as hdf5_files  # noqa: E402
from barchan.errors import BarchanError  # noqa: E402
from barchan.io.hdf5 import h5py  # noqa: E402
from barchan.io.frames import FrameFile  # noqa: E402
from barchan.io.run_folder import RunFolder  # noqa: E402

EVERY_STEP = {"time.end": 2, "output.grains_interval": 2.5e-4, "output.fields_interval": 2.5e-4}
LOOKS = 60  # at files that are being written
LAST = "frame_000004"  # of the good run


def refusal(folder, read=lambda run: run.frame(-1)):
    try:
        read(RunFolder(folder))
    except BarchanError as problem:
        return str(problem)
    return "taken"


def changed(good, folder, change):
    """A copy of the good run, with change(file, last frame)."""
    shutil.copytree(good, folder)
    with h5py.File(folder / "grains.h5", "a") as file:
        change(file, file[LAST])
    return folder


def expect(what, said, *words):
    if any(word not in said for word in words):
        faults.fail(f"{what}: {said}")


def link_to_another_file(file, frame):
    del frame["x"]
    frame["x"] = h5py.ExternalLink("other.h5", "x")


def frame_in_another_file(file, frame):
    del file[LAST]
    file[LAST] = h5py.ExternalLink("other.h5", "/")


def link_to_a_link(file, frame):
    del frame["x"]
    file["aside"] = h5py.ExternalLink("other.h5", "x")
    frame["x"] = h5py.SoftLink("/aside")


def values_of_another_file(file, frame):
    shape = frame["u"].shape
    del frame["u"]
    frame.create_dataset("u", shape, "f4", external=[("/etc/services", 0, h5py.h5f.UNLIMITED)])


def values_of_another_array(file, frame):
    layout = h5py.VirtualLayout(frame["u"].shape, "f4")
    layout[...] = h5py.VirtualSource("other.h5", "x", frame["u"].shape)
    del frame["u"]
    frame.create_virtual_dataset("u", layout)


def wrong_bit(name, bit):
    def change(file, frame):
        raw = frame[name][...].view(np.uint8).reshape(-1)
        raw[bit // 8 % raw.size] ^= 1 << bit % 8
        frame[name][...] = raw.view(frame[name].dtype).reshape(frame[name].shape)
    return change


def files_of_others(good, work):
    for number, change in enumerate((link_to_another_file, frame_in_another_file, link_to_a_link)):
        folder = changed(good, work / f"link_{number}", change)
        with h5py.File(folder / "other.h5", "w") as other:
            other["x"] = np.zeros((200, 3))
        expect(change.__name__, refusal(folder), "cannot read", "grains.h5: ", "is a link, perhaps to another file")
    for number, change in enumerate((values_of_another_file, values_of_another_array)):
        folder = changed(good, work / f"values_{number}", change)
        expect(change.__name__, refusal(folder), "cannot read", "grains.h5: ", "lie elsewhere")


def damaged_files(good, work):
    for number in range(30):
        name = ("id", "x", "d", "u", "dune")[number % 5]
        folder = changed(good, work / f"bit_{number}", wrong_bit(name, 7919 * number))
        expect(f"a wrong bit in {name}", refusal(folder), f"{LAST}/{name} is damaged: its checksum")
        if refusal(folder, lambda run: run.frame(0)) != "taken":
            faults.fail("a frame without a wrong bit was refused")

    def without_checksums(file, frame):
        for name in ("id", "x", "d", "u", "dune"):
            del frame[name].attrs["checksum"]
    expect("without checksums", refusal(changed(good, work / "older", without_checksums)), "taken")


def half_a_file(good, work):
    """It may become whole within a second, which begins when the reader first waits."""
    path = work / "grains.h5"
    whole = (good / "grains.h5").read_bytes()
    path.write_bytes(whole[:len(whole) // 2])
    waits, sleep = [], time.sleep

    def complete(seconds):
        waits.append(seconds)
        path.write_bytes(whole)
    hdf5_files.time.sleep = complete
    try:
        if len(FrameFile(path, ("x",)).frames) != 5 or len(waits) != 1:
            faults.fail(f"a file that a run is writing: {len(waits)} waits")
    finally:
        hdf5_files.time.sleep = sleep
    path.write_bytes(whole[:len(whole) // 2])
    expect("half a file", refusal(work), f"cannot read {path}: it is cut short", "or is writing it")


def while_a_run_writes(folder):
    """Readers at many moments of a run that writes frames at every step."""
    run = faults.start(folder, EVERY_STEP)
    try:
        seen = look_at(folder, run)
    finally:
        run.terminate()
        said = run.communicate()[1]
    if run.returncode != 3 or len(seen) < LOOKS:
        faults.fail(f"the run ended with {run.returncode} after {len(seen)} looks: {said}")
    return len(seen)


def look_at(folder, run):
    """(file, number of frames) of all looks."""
    seen, infos = set(), 0
    while run.poll() is None and len(seen) < LOOKS:
        for name, needed in (("grains.h5", ("id", "x", "d")), ("fields.h5", ("u",))):
            if (folder / name).exists():
                seen.add((name, len(FrameFile(folder / name, needed).frames)))
        if len(seen) > 10 * infos:
            faults.expect(subprocess.run([faults.PROGRAM, "info", folder / "fields.h5"], env=faults.ENVIRONMENT,
                                         capture_output=True, text=True), 0)
            infos += 1
    return seen


def main(work):
    faults.expect(faults.run(work / "good", {}), 0)
    expect("the good run", refusal(work / "good"), "taken")
    files_of_others(work / "good", work)
    damaged_files(work / "good", work)
    half_a_file(work / "good", work)
    looks = while_a_run_writes(work / "live")
    print(f"foreign frames: refused or read; looked at {looks} states of files being written")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
