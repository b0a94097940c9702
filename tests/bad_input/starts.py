"""What a case starts from: files and other cases that are missing, circular, of another kind."""

import os

from entry import DRY, DUNE, TABLE, Entry, grains_csv

FLOW = 'fluid = "turbulent"'
GRAINS = 'grains = "grains.csv"'
CSV = {"grains.csv": grains_csv()}


def start(name):
    return {GRAINS: f"grains = {name}"}


ENTRIES = [
    Entry("start: missing table", ["@grains =", "there is no", "grains.csv"], base=TABLE),
    Entry("start: missing flow", ["@fluid =", "there is no", "flow.h5"], {FLOW: 'fluid = "flow.h5"'}),
    Entry("start: missing case", ["@fluid =", "there is no", "flow.toml"], {FLOW: 'fluid = "flow.toml"'}),
    Entry("start: a folder", ["@grains =", "is a folder"], base=TABLE, files={"grains.csv": lambda p: p.mkdir()}),
    Entry("start: a FIFO", ["@grains =", "not a file but a device or a pipe"], base=TABLE, files={"grains.csv": os.mkfifo}, limit=10),
    Entry("start: /dev/zero", ["@grains =", "a file ending in .csv"], start('"/dev/zero"'), base=TABLE, limit=10),
    Entry("start: link to /dev/zero", ["@grains =", "must be a file"], base=TABLE, limit=10,
          files={"grains.csv": lambda p: p.symlink_to("/dev/zero")}),
    Entry("start: of another kind", ["@grains =", ".csv, .h5, .toml"], start('"grains.txt"'), base=TABLE),
    Entry("start: upper-case ending", ["@grains =", "a file ending in .csv"], start('"grains.CSV"'), base=TABLE,
          files={"grains.CSV": grains_csv()}),
    Entry("start: empty name", ["@grains =", "a file ending in"], start('""'), base=TABLE),
    Entry("start: word misspelt", ["@fluid =", '"still", "turbulent"'], {FLOW: 'fluid = "turbulant"'}),
    Entry("start: a number", ["@grains =", "must be"], start("7"), base=TABLE),
    Entry("start: a list", ["@grains =", "must be"], start('["a.csv", "b.csv"]'), base=TABLE),
    Entry("start: a table of something else", ["@grains =", "{ pour = {...} }"], start("{ heap = { radius = 1 } }"), base=TABLE, problems=2),
    Entry("start: pour as a text", ["@grains =", "must be a section, [initial.grains.pour]"], start('{ pour = "cone" }'), base=TABLE),
    Entry("start: itself", ["@fluid =", "must not lead back to this case"], {FLOW: 'fluid = "case.toml"'}),
    Entry("start: in a circle", ["lead back to this case"], {FLOW: 'fluid = "other.toml"'},
          files={"other.toml": DUNE.replace(FLOW, 'fluid = "case.toml"')}),
    Entry("start: by a link to itself", ["lead back to this case"], {FLOW: 'fluid = "link.toml"'},
          files={"link.toml": lambda p: p.symlink_to("case.toml")}),
    Entry("start: a case that is not TOML", ["other.toml:1:", "not TOML"], {FLOW: 'fluid = "other.toml"'}, files={"other.toml": "what?\n"}),
    Entry("start: a case with a mistake", ["other.toml:4:", 'did you mean "end"'], {FLOW: 'fluid = "other.toml"'},
          files={"other.toml": DUNE.replace("end = ", "ende = ")}, problems=2),
    Entry("start: a case without water", ["@fluid =", "a case with [fluid]"], {FLOW: 'fluid = "other.toml"'}, files={"other.toml": DRY}),
    Entry("start: a case without grains", ["@grains =", "a case with [grains]"], start('"other.toml"'), base=TABLE,
          files={"other.toml": DUNE[:DUNE.index("[grains]")] + '[initial]\nfluid = "turbulent"\n'}),
    Entry("start: a case on another mesh", ["@fluid =", "the same mesh", "[12, 14, 6]"], {FLOW: 'fluid = "other.toml"'},
          files={"other.toml": DUNE.replace("cells = [10,", "cells = [12,")}),
    Entry("start: a case of another size", ["@fluid =", "the same domain", "0.015"], {FLOW: 'fluid = "other.toml"'},
          files={"other.toml": DUNE.replace("[0.012,", "[0.015,")}),
    Entry("start: a study", ["study.toml:1:", "unknown section"], {FLOW: 'fluid = "study.toml"'},
          files={"study.toml": '[study]\nbase = "case.toml"\n'}, problems=4),
    Entry("start: a case whose table is broken", ["grains.csv:3:", "must be a number"], start('"other.toml"'), base=TABLE,
          files={"other.toml": TABLE, "grains.csv": "id,diameter,x,y,z\n1,2e-4,.004,4e-4,.003\n2,2e-4,x,4e-4,.003\n"}),
    # Its results would be removed as those of an earlier run in that folder.
    Entry("start: in the run folder", ["initial.grains = ", "grains.h5", "in the run folder", "another --out"], start('"out/grains.h5"'), base=TABLE,
          given=("good as out",)),
    Entry("start: flow in the run folder", ["initial.fluid = ", "in the run folder", "another --out"], {FLOW: 'fluid = "out/restart_0000000004.h5"'},
          given=("good as out",)),
    Entry("start: table in the run folder", ["initial.grains = ", "dune.csv", "in the run folder", "another --out"], start('"out/dune.csv"'), base=TABLE,
          files={"out/dune.csv": grains_csv()}),
    Entry("start: a case of the same name", ["initial.fluid = ", "flow/case.toml", "another --out"], {FLOW: 'fluid = "flow/case.toml"'},
          files={"flow/case.toml": DUNE}, command="run case.toml --quiet"),
    Entry("start: a case whose folder is --out", ["initial.fluid = ", "out.toml", "another --out"], {FLOW: 'fluid = "out.toml"'}, files={"out.toml": DUNE}),
]
