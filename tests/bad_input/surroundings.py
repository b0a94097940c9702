"""What is around the case: the command line, file names, folders, ranks, studies, pictures."""

import os
import shlex

from entry import DUNE, SHORT, Entry

SET, RUN = "check case.toml --set ", "run case.toml --out out"


def line(name, command, says, **more):
    return Entry(name, more.pop("edits", ""), says, command=command, **more)


COMMAND_LINE = [
    line("no command", "''", "unknown command | run, check, new, info"),
    line("--ranks to the program", RUN + " --ranks 2", "--ranks | mpirun"),
    line("--set of a section", SET + "grains=3", "--set grains | must be a section, [grains]"),
    line("OMP_NUM_THREADS of rubbish", RUN, "", edits=SHORT, code=0,
         env={"OMP_NUM_THREADS": "many", "OMP_THREAD_LIMIT": "1"}),
    line("KOKKOS_NUM_THREADS of rubbish", RUN, "KOKKOS_NUM_THREADS | many | --threads", env={"KOKKOS_NUM_THREADS": "many"}),
    line("a locale that is not there", RUN, "", edits=SHORT, env={"LC_ALL": "xx_XX.UTF-9"}, code=0),
    line("--dry-run writes nothing", RUN + " --dry-run", "nothing was run", code=0),
]

BAD, WELL = DUNE.replace("end = 0.01", "end = -1"), DUNE.replace("end = 0.01", "end = 5e-4")
STRANGE = "./-дюна 沙丘's \"à\" 50%s {} a=b"
NAMES = [
    line("strange letters, good", f"run {shlex.quote(STRANGE)} --quiet --out 'out дюна'", "", files={STRANGE: WELL}, code=0),
    line("strange letters, bad", f"run {shlex.quote(STRANGE)} --quiet", STRANGE[2:] + ":5: | above 0", files={STRANGE: BAD}),
    line("a line end", "run 'two\nlines.toml' --quiet", "two\\nlines.toml:5:", files={"two\nlines.toml": BAD}),
    line("not UTF-8", "run 'bad_\udcff.toml' --quiet", "bad_\\xff.toml:5:", files={"bad_\udcff.toml": BAD}),
]

FULL = {"edits": "[time] end = 0.001", "code": 1}


def under(user_or_limit, name, says, **more):
    return Entry(name, more.pop("edits", ""), says, under=user_or_limit, **more)


FOLDERS = [
    Entry("--out is a file", "", "out | a file, not a folder | --out", files={"out": "mine\n"}),
    line("--out below a file", "run case.toml --quiet --out case.toml/run", "case.toml is a file, not a folder | another --out"),
    line("--out below /proc", "run case.toml --quiet --out /proc/run", "/proc | --out"),
    line("--out with a name too long", "run case.toml --quiet --out " + "o" * 300, "too long | --out"),
    line("--out holds the case as config.toml", "run config.toml --quiet --out .", "config.toml | another --out",
         files={"config.toml": DUNE}),
    Entry("a folder called history.csv in it", "", "history.csv | out", files={"out/history.csv": os.mkdir}),
    under("nobody", "read-only folder", "locked/run | Permission denied | --out", files={"locked": os.mkdir},
          command="run case.toml --quiet --out locked/run"),
    under("nobody", "read-only run folder, restart", "locked | --out", given=("good as locked",),
          command="run case.toml --quiet --out locked --restart locked/restart_0000000004.h5"),
    under("nobody", "flow that may not be read", "secret.h5 | Permission denied", edits='[initial] fluid = "secret.h5"',
          given=("good/restart_0000000004.h5 as secret.h5",)),
    # Full disks show on the way: exit code 1, and each file is whole or gone.
    under("tmpfs 4k", "no room for the first table", "cannot write out/ | No space left", **FULL),
    under("tmpfs 440k", "no room for the restart file", "restart_0000000004.h5 | No space left", **FULL),
    under("fsize 20000", "files may not grow", "cannot write out/ | File too large", **FULL),
    under("as 900000000", "no memory for the flow", "not enough memory | fewer fluid.cells", code=1, edits=
          "[fluid] cells = [300, 300, 100] ;; -[fluid] first_cell_height ;; [time] fluid_step = 1e-5 ;; "
          '[time] grain_step = 2e-6 ;; [coupling] scheme = "centred"'),
]

RANKS = [
    Entry("more than columns", "[fluid] cells = [3, 14, 2]", "--ranks | 3 ranks cannot share 3 x 2 | the next smaller number",
          ranks=3),
    Entry("bad key told once", "grain_step => grain_stpe", '@grain_stpe | did you mean "grain_step"', ranks=2),
    Entry("damaged restart told once", "", "restart_0000000004.h5 | damaged", given=("good as out",), ranks=2,
          files={"out/restart_0000000004.h5": lambda path: path.write_bytes(path.read_bytes() + b"more")},
          command="run case.toml --quiet --out out --restart out/restart_0000000004.h5"),
]

STUDY, VARY = '[study]\nbase = "case.toml"\n', "[vary]\ngrains.rolling_friction = [0.05, 0.1]\n"


def study(name, text, says, options=""):
    return line("study: " + name, "sweep study.toml " + options, says, files={"study.toml": text})


def plot(name, command, says, **files):
    return line("plot: " + name, "plot " + command, says, given=("good as out",),
                files={f"out/{file.replace('_', '.')}": text for file, text in files.items()})


SCRIPTS = [
    study("not TOML", "[study\n", "study.toml | not TOML | line 1"),
    study("base missing", STUDY.replace("case.toml", "gone.toml") + VARY, "gone.toml | No such file"),
    study("no cases", STUDY, "study.toml | no cases | [vary]"),
    study("a value, not a list", STUDY + "[vary]\ngrains.rolling_friction = 0.1\n", "must be a list"),
    study("like what is no name", STUDY + "[cases]\na.like = 3\n", "like must be the name of a case before it"),
    study("a line of cases without keys", STUDY + "[cases]\na = 3\n", "must have a line NAME = { key = value }"),
    study("a dot in a name", STUDY + "[cases]\na-0.5 = { grains.restitution = 0.5 }\n", 'stands in quotes: "a-0.5"'),
    study("two cases of one name", STUDY + '[[case]]\nname = "a"\n' * 2, 'two cases are named "a"'),
    study("key without a value in the base case", STUDY + "[vary]\ngrains.density = [2500, 2600]\n",
          "grains.density has no value in the base case"),
    study("misspelt key set", STUDY + "[set]\ngrains.restitutoin = 0.2\n" + VARY, 'did you mean "restitution"'),
    study("value out of range", STUDY + "[vary]\ngrains.restitution = [7.0]\n", "grains.restitution"),
    study("a million million cases", STUDY + "[grid]\n" + "".join(f"grains.k{n} = {list(range(100))}\n" for n in range(6)),
          "[grid] makes 1000000000000 cases | fewer"),
    plot("a time that is none", "out horns --time soon", "--time | soon"),
    plot("broken grains.h5", "out topviews", "grains.h5", grains_h5="hello\n"),
    plot("broken study.json", "out", "study.json", study_json="{"),
]

ENTRIES = {"command line": COMMAND_LINE, "names": NAMES, "folders": FOLDERS, "ranks": RANKS, "scripts": SCRIPTS}
