#!/usr/bin/python3
"""Going on: --resume from the last restart file or from the start, --restart latest and --restart FOLDER.

Each gives the bits of an unbroken run; what differs from the run that began is refused, with its reason.
"""
import faults

CASE = {**faults.OFTEN, "time.end": 0.02, "restart.interval": 0, "output.history_interval": 1e-3}


def run(folder, *words, **settings):
    command = faults.command(folder, {**CASE, **{key.replace("__", "."): value for key, value in settings.items()}})
    return faults.subprocess.run([*command, *words], env=faults.ENVIRONMENT, capture_output=True, text=True)


def stopped(work, name):
    """A run that has come to the middle, and has no other restart file than that."""
    faults.expect(run(work / name, time__end=0.01), 0)
    return work / name


def test(work):
    whole = work / "whole"
    faults.expect(run(whole, "--resume"), 0)  # there is nothing yet: from the start
    before = (whole / "run.json").read_bytes()
    faults.expect(run(whole, "--resume"), 0)
    if (whole / "run.json").read_bytes() != before:
        faults.fail("a finished run was computed again")
    for name, words in (("resumed", ["--resume"]), ("latest", ["--restart", "latest"]),
                        ("folder", ["--restart", work / "folder"])):
        folder = stopped(work, name)
        faults.expect(run(folder), 2, "holds a finished run of another configuration: go on with --resume")
        faults.expect(run(folder, *map(str, words)), 0)
        faults.same_run(whole, folder)
    other = stopped(work, "other")
    content = {path.name: path.read_bytes() for path in other.iterdir()}
    faults.expect(run(other, "--resume", grains__density=2600), 2, "density")
    faults.expect(run(other, "--resume", "--overwrite"), 2, "--resume")
    faults.expect(run(other, "--resume", "--restart", "latest"), 2, "--restart")
    if {path.name: path.read_bytes() for path in other.iterdir()} != content:
        faults.fail("a refused run changed the folder")
    for words in (("--restart", "latest"), ("--restart", str(work))):
        faults.expect(run(work / "new", *words), 2, "holds no restart file")
    if (work / "new").exists():
        faults.fail("a refused run made its folder")


if __name__ == "__main__":
    faults.in_a_new_folder(test)
    print("runs go on as they should")
