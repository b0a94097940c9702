"""Where results cannot go."""

import os

from entry import DUNE, TABLE, Entry, grains_csv

SHORT = {"end = 0.01": "end = 0.001"}
GO_ON = "run case.toml --quiet --out locked --restart locked/restart_0000000004.h5"


def nobody(name, says, **more):
    return Entry(name, says, place="nobody", **more)


def folder(path):
    path.mkdir()


ENTRIES = [
    Entry("--out is a file", ["out", "a file, not a folder", "--out"], files={"out": "mine\n"}),
    Entry("--out below a file", ["notes.txt is a file, not a folder", "another --out"], files={"notes.txt": "mine\n"}, command="run case.toml --quiet --out notes.txt/run"),
    Entry("--out is the case", ["case.toml is a file, not a folder", "another --out"], command="run case.toml --quiet --out case.toml"),
    Entry("--out is /dev/null", ["/dev/null", "--out"], command="run case.toml --quiet --out /dev/null"),
    Entry("--out below /proc", ["/proc", "--out"], command="run case.toml --quiet --out /proc/run"),
    Entry("--out is a broken link", ["out", "--out"], files={"out": lambda path: path.symlink_to("gone/far")}),
    Entry("--out is a FIFO", ["out", "--out"], files={"out": os.mkfifo}, limit=10),
    Entry("--out with a name too long", ["too long", "--out"], command="run case.toml --quiet --out " + "o" * 300),
    Entry("--out with a path too long", ["too long", "--out"], command="run case.toml --quiet --out " + "/".join(["o" * 100] * 50)),
    Entry("--out is where the case called config.toml is", ["config.toml", "another --out"], text=None, edits={},
          files={"config.toml": DUNE}, command="run config.toml --quiet --out ."),
    Entry("a folder called history.csv in it", ["history.csv", "out"], files={"out/history.csv": folder}),
    Entry("a folder called grains.h5 in it", ["grains.h5", "out"], files={"out/grains.h5": folder}),
    Entry("runs is a file", ["runs", "--out"], files={"runs": "mine\n"}, command="run case.toml --quiet"),
    nobody("read-only folder", ["locked/run", "Permission denied", "--out"], files={"locked": folder},
           command="run case.toml --quiet --out locked/run"),
    nobody("read-only run folder", ["locked", "--out"], given=("good as locked",), command="run case.toml --quiet --out locked"),
    nobody("read-only run folder, restart", ["locked", "--out"], given=("good as locked",), command=GO_ON),
    nobody("case that may not be read", ["secret.toml", "Permission denied"], files={"secret.toml": DUNE},
           command="run secret.toml --quiet --out out"),
    nobody("table that may not be read", ["secret.csv", "Permission denied"], base=TABLE.replace("grains.csv", "secret.csv"),
           files={"secret.csv": grains_csv()}),
    nobody("flow that may not be read", ["secret.h5", "Permission denied"], edits={'fluid = "turbulent"': 'fluid = "secret.h5"'},
           given=("good/restart_0000000004.h5 as secret.h5",)),
    # Full disks are met on the way: exit code 1, and what is there is whole or gone.
    Entry("no room for the first table", ["cannot write out/", "No space left"], SHORT, place="tmpfs 4k", code=1, writes=True),
    Entry("no room for the fields", ["cannot write out/", ".h5", "No space left"], SHORT, place="tmpfs 64k", code=1, writes=True),
    Entry("no room for the restart file", ["restart_0000000004.h5", "No space left"], SHORT, place="tmpfs 440k", code=1, writes=True),
    Entry("files may not grow", ["File too large"], SHORT, place="prlimit 20000", code=1, writes=True),
    Entry("no file may be written", ["File too large"], SHORT, place="prlimit 0", code=1, writes=True),
]
