"""The case file: text, keys, values, contradictions, and what it starts from."""

import os

from entry import DRY, DUNE, SHORT, TABLE, WET, Entry

GOOD = {"code": 0, "command": "check case.toml"}


def sparse(path):
    path.write_bytes(b"[time]\n")
    os.truncate(path, 100_000_000)


SYNTAX = [
    Entry("empty file", "", "case.toml | [time] | required section is missing", text="", problems=3),
    Entry("unclosed string", '[case] title = "Small', "@title | not TOML"),
    Entry("unit behind a number", "[time] end = 0.01 s", "@end | not TOML"),
    Entry("decimal comma", "[time] end = 0,01", "@end | not TOML"),
    Entry("Fortran exponent", "[time] grain_step = 5d-6", "@grain_step | not TOML"),
    Entry("number beyond all", "[time] end = 1e400", "@end | not TOML | 1e400"),
    Entry("word without quotes", "[initial] fluid = turbulent", "@fluid = | not TOML"),
    Entry("Windows path", '[initial] fluid = "C:\\users\\flow.h5"', "@fluid = | not TOML"),
    Entry("section twice", "[restart] => [time]\n[restart]", "case.toml: | not TOML | existing table 'time'"),
    Entry("UTF-16", "", "case.toml:1: | not TOML | UTF-8", text=DUNE.encode("utf-16")),
    Entry("control characters", "", "case.toml: | not TOML", text=DUNE.encode().replace(b"Small", b"\x1b[31mSmall")),
    Entry("a restart file", "", "case.toml: | not TOML | not text", given=("good/restart_0000000004.h5 as case.toml",)),
    Entry("100 MB that begin well", "", "case.toml: cannot be read | 100 MB long", files={"case.toml": sparse}),
    Entry("arrays nested 100000 deep", "", "case.toml: | not TOML", text="x = " + "[" * 100_000),
    Entry("100000 unknown keys", "", "case.toml:2: | unknown key | and 99973 more", problems=100_003,
          text="[time]\n" + "".join(f"k{n} = 1\n" for n in range(100_000))),
    Entry("old Macintosh line ends", "", "case.toml:1: | not TOML", text=DUNE.replace("\n", "\r")),
    Entry("no such file", "", "nowhere.toml | No such file", command="run nowhere.toml --out out"),
    Entry("a device", "", "/dev/zero | not a file", command="run /dev/zero --out out"),
    Entry("byte order mark and Windows line ends", text=b"\xef\xbb\xbf" + DUNE.replace("\n", "\r\n").encode(), **GOOD),
]

KEYS = [
    Entry("misspelt key", "grain_step => grain_stpe", '@grain_stpe | [time] grain_stpe | did you mean "grain_step"'),
    Entry("key of another section", "[time] density = 1000", '@density | did you mean "density" of'),
    Entry("misspelt section", "[fluid] => [fliud]", '@[fliud] | unknown section | did you mean "fluid"'),
    Entry("section as a list", "[fluid] => [[fluid]]", "@[[fluid]] | must be a section, [fluid]"),
    Entry("section as a number", text="output = 1\n" + DUNE.split("[output]")[0],
          says="@output | must be a section, [output]"),
    Entry("neither flow nor grains", text="[time]\nend = 1\n[domain]\nsize = [1, 1, 1]\n",
          says="[fluid] | nothing to run"),
    Entry("grains from nowhere", "-[initial] grains", "[initial] grains | a file or { pour", base=TABLE),
    Entry("ten problems", 'title => titel ;; [time] end = -1 ;; [domain] size = [0.012, 0.006] ;; [fluid] cells = 10 ;; '
          '[fluid] mean_velocity = "fast" ;; [grains] restitution = 2 ;; [grains] gravity = 9.81 ;; [restart] keep = 0 '
          ';; [coupling] drag = "ergun" ;; [coupling] forces = "all"', "10 problems | cells | titel | restitution | "
          "gravity | keep | drag | forces | size", problems=10),
]

SIZES, FLUID_STEP = "[grains] sizes = ", "[time] fluid_step = "
VALUES = [
    Entry("text for a number", '[time] end = "0.01"', "@end | [time] end | must be a number"),
    Entry("not a number", "[time] end = nan", "@end | must be a finite number"),
    Entry("forces: misspelt", '[coupling] forces = ["dragg"]', '@forces | "dragg" | did you mean "drag"'),
    Entry("choice in upper case", '[fluid] turbulence = "WALE"', '@turbulence | did you mean "wale"'),
    Entry("end of 0", "[time] end = 0", "@end | must be above 0"),
    Entry("title of 10000 letters", f'[case] title = "{"S" * 10000}"', "@title | at most"),
    Entry("control characters in the title", '[case] title = "\\u001b[31mA"', "@title | without control characters"),
    # numbers nobody means
    Entry("no end in sight", "[time] end = 1e300", "@end | fluid steps | longer time.fluid_step"),
    Entry("steps of 1e-300", FLUID_STEP + "1e-300 ;; [time] grain_step = 1e-300",
          "@fluid_step | @grain_step | at least 1e-15", problems=2),
    Entry("grains of 1e300 m", SIZES + "[[1e300, 2]]", "@sizes | at most"),
    Entry("9e18 grains", SIZES + "[[2e-4, 9000000000000000000]]", "@sizes | at most"),
    Entry("first row of 1e-300 m", "[fluid] first_cell_height = 1e-300", "@first_cell_height | must be larger | rows would grow"),
    Entry("1e15 cells", "-[fluid] first_cell_height ;; [fluid] cells = [100000, 100000, 100000] ;; " + FLUID_STEP +
          '1e-12 ;; [time] grain_step = 1e-12 ;; [time] end = 1e-11 ;; [fluid] mean_velocity = 1e-9 ;; '
          '[initial] fluid = "still"', "case.toml | cells"),
    Entry("cells for a terabyte", "-[fluid] first_cell_height ;; [fluid] cells = [2000, 2000, 1000] ;; " + FLUID_STEP +
          "1e-7 ;; [time] grain_step = 1e-7 ;; [time] end = 1e-5", "needs about | GB | fluid.cells"),
    Entry("one grain", SIZES + "[[2e-4, 1]] ;; " + SHORT, code=0),
    Entry("a title of other letters", '[case] title = "Düne 沙丘 <b>&amp;\\"</b>" ;; ' + SHORT, code=0),
]

CONTRADICTIONS = [
    Entry("pour without grains", "[grains]\nyoungs_modulus = 1.25e6\nrolling_friction = 0.05\nsizes = "
          "[[1.5e-4, 20], [2e-4, 160], [2.5e-4, 20]]\n => ", "without a [grains] section"),
    Entry("a million grain steps and more", "[time] grain_step = 1e-11", "@grain_step | millionth"),
    Entry("grain step over the Rayleigh limit", "[time] grain_step = 2.5e-5",
          "@grain_step | must be at most | Rayleigh | smallest grain"),
    Entry("one tiny grain among many", "[1.5e-4, 20] => [1e-6, 1]", "@grain_step | d = 1e-06 m"),
    Entry("linear springs at too long a step", '[grains] contact_model = "linear" ;; [grains] linear_stiffness = 1e6',
          "@grain_step | a fifth of the contact"),
    Entry("fluid step over the CFL limit", FLUID_STEP + "0.01", "@fluid_step | CFL | below 1"),
    Entry("grains wider than a period", "[2.5e-4, 20] => [2.5e-3, 1]", "@size | its own image", problems=2),
    Entry("diameters in mm", SIZES + "[[0.15, 20], [0.2, 160], [0.25, 20]]",
          "@sizes | 0.25 m, wider than the domain | 0.2 mm is 2e-4"),
    Entry("cells smaller than grains", "-[fluid] first_cell_height ;; [fluid] cells = [100, 50, 60] ;; " + FLUID_STEP +
          "1e-4", "warning | 0.50 mean grain diameters | 1.2 to 1.6", **GOOD),
]


def grains_from(name, value, says, **more):
    return Entry(name, f"[initial] grains = {value}", says, base=TABLE, **more)


def flow_from(name, value, says, **more):
    return Entry(name, f"[initial] fluid = {value}", says, **more)


STARTS = [
    grains_from("missing table", '"grains.csv"', "@grains = | there is no | grains.csv"),
    grains_from("a FIFO", '"grains.csv"', "@grains = | not a file but a device or a pipe", files={"grains.csv": os.mkfifo}),
    flow_from("in a circle", '"other.toml"', "lead back to this case",
              files={"other.toml": DUNE.replace('fluid = "turbulent"', 'fluid = "case.toml"')}),
    flow_from("a case with a mistake", '"other.toml"', 'other.toml:4: | did you mean "end"', problems=2,
              files={"other.toml": DUNE.replace("end = ", "ende = ")}),
    flow_from("a case without water", '"other.toml"', "@fluid = | a case with [fluid]", files={"other.toml": DRY}),
    grains_from("a case without grains", '"other.toml"', "@grains = | a case with [grains]", files={"other.toml": WET}),
    flow_from("a case on another mesh", '"other.toml"', "@fluid = | the same mesh | [12, 14, 6]",
              files={"other.toml": DUNE.replace("cells = [10,", "cells = [12,")}),
    # Its results would be removed as those of an earlier run in that folder.
    grains_from("in the run folder", '"out/grains.h5"', "initial.grains =  | grains.h5 | in the run folder | another --out",
                given=("good as out",)),
    flow_from("a case of the same name", '"flow/case.toml"', "initial.fluid =  | flow/case.toml | another --out",
              files={"flow/case.toml": DUNE}, command="run case.toml --quiet"),
]

ENTRIES = {"syntax": SYNTAX, "keys": KEYS, "values": VALUES, "contradictions": CONTRADICTIONS, "starts": STARTS}
