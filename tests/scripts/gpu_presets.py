#!/usr/bin/python3
"""The presets of GPUs refuse a Kokkos without their backend, none at all, and one whose compiler is gone; each with one
message that names what is missing. A Kokkos that has the backend is taken, with its compiler."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
BUILD = pathlib.Path(os.environ["BARCHAN_PROGRAM"]).parent
PRESETS = {preset["name"]: preset["cacheVariables"]["BARCHAN_BACKEND"]
           for preset in json.loads((ROOT / "CMakePresets.json").read_text())["configurePresets"]
           if "BARCHAN_BACKEND" in preset.get("cacheVariables", {})}


def cached(name):
    return re.search(rf"^{name}:\w+=(.*)$", (BUILD / "CMakeCache.txt").read_text(), re.MULTILINE)[1]


def configure(preset, folder, kokkos, *options):
    """Exit code of cmake and what it said, its lines joined; as without a CXX."""
    environment = {name: value for name, value in os.environ.items() if name not in ("CXX", "Kokkos_ROOT")}
    if kokkos:
        environment["Kokkos_ROOT"] = str(kokkos)
    words = ["cmake", "--preset", preset, "-S", ROOT, "-B", folder, *options]
    done = subprocess.run(words, env=environment, cwd=ROOT, capture_output=True, text=True)
    return done.returncode, " ".join((done.stdout + done.stderr).split())


def expect(what, said, status, *words):
    code, text = said
    missing = [word for word in words if word not in text]
    if (code == 0) != (status == 0) or missing or text.count("CMake Error") != (status != 0):
        sys.exit(f"FAILED: {what}: exit code {code}, without {missing}: {text[-800:]}")


def main(work):
    kokkos_dir = pathlib.Path(cached("Kokkos_DIR"))
    prefix = next(folder.parent for folder in kokkos_dir.parents if folder.name == "lib")
    compiler = cached("CMAKE_CXX_COMPILER")
    has = re.search(r"Kokkos_DEVICES ([^)]*)", (kokkos_dir / "KokkosConfigCommon.cmake").read_text())[1]
    gone = work / "gone/lib/cmake/Kokkos"
    gone.mkdir(parents=True)
    shutil.copy(kokkos_dir / "KokkosConfigCommon.cmake", gone)
    record = gone / "KokkosConfigCommon.cmake"
    record.write_text(re.sub('_CXX_COMPILER ".*"', '_CXX_COMPILER "/nowhere/compiler"', record.read_text()))
    for preset, backend in PRESETS.items():
        if backend not in has.split(";"):
            # nvcc_wrapper comes only with the Kokkos that is looked for
            ours = [f"-DCMAKE_CXX_COMPILER={compiler}"] if preset == "cuda" else []
            said = configure(preset, work / preset, prefix, *ours)
            expect(preset, said, 1, f"without {backend}", f"Kokkos_ENABLE_{backend}=ON")
        if preset != "cuda":
            expect(preset, configure(preset, work / "none", None), 1, "Set Kokkos_ROOT", f"Kokkos_ENABLE_{backend}=ON")
            expect(preset, configure(preset, work / "gone-build", work / "gone"), 1, "/nowhere/compiler", "is not here")
    expect("one that is there", configure("hip", work / "there", prefix, f"-DBARCHAN_BACKEND={has.split(';')[0]}",
                                          f"-DCMAKE_CXX_COMPILER={compiler}"), 0)
    print(f"{', '.join(PRESETS)}: refuse what they cannot use")


if __name__ == "__main__":
    if set(PRESETS) != {"cuda", "hip", "sycl"}:
        sys.exit(f"FAILED: the presets of GPUs are {PRESETS}")
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
