"""What is around the program: launcher, studies, pictures."""

import os

from entry import DUNE, Entry

STUDY = '[study]\nbase = "case.toml"\n'
VARY = "[vary]\ngrains.rolling_friction = [0.05, 0.1]\n"


def study(name, text, says, command="sweep study.toml", **more):
    return Entry(name, says, files={"study.toml": text}, command=command, **more)


def launcher(name, command, says, **more):
    return Entry(name, says, command="./barchan " + command, **more)


def plot(name, command, says, **more):
    return Entry(name, says, command="plot " + command, **more)


ENTRIES = [
    launcher("launcher: misspelt command", "chekc case.toml", ["unknown command 'chekc'", "did you mean 'check'"]),
    launcher("launcher: unknown command", "simulate case.toml", ["unknown command 'simulate'", "--help"]),
    launcher("launcher: --ranks 0", "run case.toml --ranks 0", ["--ranks needs a number of at least 1, not '0'"]),
    launcher("launcher: --ranks -2", "run case.toml --ranks=-2", ["--ranks needs a number", "-2"]),
    launcher("launcher: --ranks many", "run case.toml --ranks many", ["--ranks needs a number", "many"]),
    launcher("launcher: --ranks without a number", "run case.toml --ranks", ["--ranks needs a number"]),
    launcher("launcher: --threads 1e3", "run case.toml --threads 1e3", ["--threads needs a number", "1e3"]),
    launcher("launcher: sweep of nothing", "sweep", ["needs a study"]),
    launcher("launcher: plot of nothing", "plot", ["needs a run folder"]),
    study("study: no such file", "", ["nowhere.toml", "No such file"], command="sweep nowhere.toml"),
    study("study: a folder", lambda path: path.mkdir(), ["study.toml", "it is not a file"]),
    study("study: empty", "", ["study.toml", "base"]),
    study("study: not TOML", "[study\n", ["study.toml", "not TOML", "line 1"]),
    study("study: not UTF-8", b'[study]\nbase = "\xff"\n', ["study.toml", "UTF-8"]),
    study("study: a case for a study", DUNE, ["study.toml", "case"], ),
    study("study: unknown section", STUDY + "[varry]\na = [1]\n", ["study.toml", 'did you mean "vary"']),
    study("study: unknown key", STUDY.replace("base", "bsae"), ["study.toml", 'did you mean "base"']),
    study("study: section as a number", "study = 3\n", ["study.toml", "study"]),
    study("study: base as a number", "[study]\nbase = 3\n" + VARY, ["study.toml", "base"]),
    study("study: base missing", STUDY.replace("case.toml", "gone.toml") + VARY, ["gone.toml", "No such file"]),
    study("study: base is a study", STUDY.replace("case.toml", "study.toml") + VARY, ["study.toml"]),
    study("study: no cases", STUDY, ["study.toml", "no cases", "[vary]"]),
    study("study: a value, not a list", STUDY + "[vary]\ngrains.rolling_friction = 0.1\n", ["must be a list"]),
    study("study: an empty list", STUDY + "[vary]\ngrains.rolling_friction = []\n", ["must be a list"]),
    study("study: vary as a number", "vary = 3\n" + STUDY, ["study.toml", "vary"]),
    study("study: vary as a list", STUDY + "[[vary]]\ngrains.rolling_friction = [0.1]\n", ["study.toml", "vary"]),
    study("study: set as a number", "set = 3\n" + STUDY + VARY, ["study.toml", "set"]),
    study("study: case as a table", STUDY + '[case]\nname = "a"\n', ["study.toml", "[[case]]"]),
    study("study: case without a name", STUDY + "[[case]]\nset = {}\n", ["study.toml", "name"]),
    study("study: case with a path for a name", STUDY + '[[case]]\nname = "../a"\n', ["study.toml", "must be of letters"]),
    study("study: two cases of one name", STUDY + '[[case]]\nname = "a"\n[[case]]\nname = "a"\n', ['two cases are named "a"']),
    study("study: unknown key of a case", STUDY + '[[case]]\nname = "a"\nsett = {}\n', ['did you mean "set"']),
    study("study: misspelt key varied", STUDY + "[grid]\ngrains.rolling_frictoin = [0.1]\n", ['did you mean "rolling_friction"']),
    study("study: value out of range", STUDY + "[grid]\ngrains.restitution = [7]\n", ["grains.restitution", "at most 1"]),
    study("study: a date as a value", STUDY + "[grid]\ngrains.restitution = [2026-01-31]\n", ["grains.restitution", "must be a number"]),
    study("study: at_once of 0", STUDY + "at_once = 0\n" + VARY, ["at_once", "at least 1"]),
    study("study: at_once true", STUDY + "at_once = true\n" + VARY, ["at_once", "at least 1"]),
    study("study: --at-once 0", STUDY + VARY, ["--at-once", "at least 1"], command="sweep study.toml --at-once 0"),
    study("study: --at-once many", STUDY + VARY, ["--at-once", "many"], command="sweep study.toml --at-once many"),
    study("study: --threads -1", STUDY + VARY, ["--threads", "at least 1"], command="sweep study.toml --threads -1"),
    study("study: title as a number", STUDY + "title = 3\n" + VARY, ["title", "must be"]),
    study("study: a FIFO", os.mkfifo, ["study.toml", "it is not a file"], limit=10),
    study("study: a million million cases", STUDY + "[grid]\n" + "".join(f"grains.k{n} = {list(range(100))}\n" for n in range(6)),
          ["[grid] makes 1000000000000 cases", "fewer"]),
    study("study: --out is a file", STUDY + VARY, ["case.toml", "--out"], command="sweep study.toml --out case.toml"),
    study("study: a value of two lines", STUDY + '[grid]\ninitial.fluid = ["a\\nb"]\n', ["initial.fluid"]),
    plot("plot: no such folder", "nowhere", ["nowhere"]),
    plot("plot: the case", "case.toml", ["case.toml", "folder"]),
    plot("plot: an empty folder", "empty", ["empty", "nothing to draw"], files={"empty": lambda path: path.mkdir()}),
    plot("plot: unknown figure", "out topvews", ['no figure "topvews"', 'did you mean "topviews"'], given=("good as out",)),
    plot("plot: no data for it", "out profiles", ["profiles"], given=("good as out",)),
    plot("plot: a time that is none", "out horns --time soon", ["--time", "soon"], given=("good as out",)),
    plot("plot: broken grains.h5", "out topviews", ["grains.h5"], given=("good as out",), files={"out/grains.h5": "hello\n"}),
    plot("plot: empty tables", "out morphology", ["dune.csv"], given=("good as out",), files={"out/dune.csv": ""}),
    plot("plot: text in a table", "out morphology", ["dune.csv"], given=("good as out",), files={"out/dune.csv": "t,dune\nx,y\n"}),
    plot("plot: broken run.json", "out history", [], given=("good as out",), files={"out/run.json": "{"}, code=0),
    plot("plot: broken study.json", "out", ["study.json"], files={"out/study.json": "{"}),
]
