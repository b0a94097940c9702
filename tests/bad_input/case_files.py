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
    Entry("number beyond all", "[time] end = 1e400", "@end | not TOML | 1e400"),
    Entry("word without quotes", "[initial] fluid = turbulent", "@fluid = | not TOML"),
    Entry("section twice", "[restart] => [time]\n[restart]", "case.toml: | not TOML | existing table 'time'"),
    Entry("control characters", "", "case.toml: | not TOML", text=DUNE.encode().replace(b"Small", b"\x1b[31mSmall")),
    Entry("a restart file", "", "case.toml: | not TOML | not text", given=("good/restart_0000000004.h5 as case.toml",)),
    Entry("100 MB that begin well", "", "case.toml: cannot be read | 100 MB long", files={"case.toml": sparse}),
    Entry("arrays nested 100000 deep", "", "case.toml: | not TOML", text="x = " + "[" * 100_000),
    Entry("100000 unknown keys", "", "case.toml:2: | unknown key | and 99973 more", problems=100_003,
          text="[time]\n" + "".join(f"k{n} = 1\n" for n in range(100_000))),
    Entry("old Macintosh line ends", "", "case.toml:1: | not TOML", text=DUNE.replace("\n", "\r")),
    Entry("no such file", "", "nowhere.toml | No such file", command="run nowhere.toml --out out"),
    Entry("byte order mark and Windows line ends", text=b"\xef\xbb\xbf" + DUNE.replace("\n", "\r\n").encode(), **GOOD),
]

KEYS = [
    Entry("misspelt key", "grain_step => grain_stpe", '@grain_stpe | [time] grain_stpe | did you mean "grain_step"'),
    Entry("section as a list", "[fluid] => [[fluid]]", "@[[fluid]] | must be a section, [fluid]"),
    Entry("ten problems", 'title => titel ;; [time] end = -1 ;; [domain] size = [0.012, 0.006] ;; [fluid] cells = 10 ;; '
          '[fluid] mean_velocity = "fast" ;; [grains] restitution = 2 ;; [grains] gravity = 9.81 ;; [restart] keep = 0 '
          ';; [coupling] drag = "ergun" ;; [coupling] forces = "all"', "10 problems | cells | titel | restitution | "
          "gravity | keep | drag | forces | size", problems=10),
]

SIZES, FLUID_STEP = "[grains] sizes = ", "[time] fluid_step = "
VALUES = [
    # numbers nobody means
    Entry("steps of 1e-300", FLUID_STEP + "1e-300 ;; [time] grain_step = 1e-300",
          "@fluid_step | @grain_step | at least 1e-15", problems=2),
    Entry("grains of 1e300 m", SIZES + "[[1e300, 2]]", "@sizes | at most"),
    Entry("9e18 grains", SIZES + "[[2e-4, 9000000000000000000]]", "@sizes | at most"),
    Entry("first row of 1e-300 m", "[fluid] first_cell_height = 1e-300", "@first_cell_height | must be larger | rows would grow"),
    Entry("equal rows above the lid", "[fluid] uniform_height = 0.02", "@uniform_height | must be lower | may not shrink"),
    Entry("equal rows of no height", "-[fluid] first_cell_height ;; [fluid] uniform_height = 0.002",
          "@uniform_height | must come with a first_cell_height"),
    Entry("1e15 cells", "-[fluid] first_cell_height ;; [fluid] cells = [100000, 100000, 100000] ;; " + FLUID_STEP +
          '1e-12 ;; [time] grain_step = 1e-12 ;; [time] end = 1e-11 ;; [fluid] mean_velocity = 1e-9 ;; '
          '[initial] fluid = "still"', "case.toml | cells"),
    Entry("cells for a terabyte", "-[fluid] first_cell_height ;; [fluid] cells = [2000, 2000, 1000] ;; " + FLUID_STEP +
          "1e-7 ;; [time] grain_step = 1e-7 ;; [time] end = 1e-5", "needs about | GB | fluid.cells"),
    Entry("a length of no unit", '[grains] skin = "3 dd"', '@skin | a number of metres, or of mean grain diameters as in "3 d"'),
    Entry("a length below zero", '[coupling] smoothing_length = "-3 d"', "@smoothing_length | at least 0"),
    Entry("diameters of a table", '[coupling] smoothing_length = "3 d"', "@smoothing_length | must be in metres", base=TABLE,
          files={"grains.csv": "id,diameter,x,y,z\n"}),
    Entry("a force that is not there", '[coupling] forces = ["drag", "lfit"]', '@forces | must be an array | did you mean "lift"'),
    Entry("one grain", SIZES + "[[2e-4, 1]] ;; " + SHORT, code=0),
    Entry("a title of other letters", '[case] title = "Düne 沙丘 <b>&amp;\\"</b>" ;; ' + SHORT, code=0),
]

CONTRADICTIONS = [
    Entry("drag at a wall that does not drag", '[coupling] forces = ["drag", "wall_drag"] ;; [fluid] bottom = "free_slip"',
          "@forces | wall_drag | free-slip bottom"),
    Entry("a million grain steps and more", "[time] grain_step = 1e-11", "@grain_step | millionth"),
    Entry("one tiny grain among many", "[1.5e-4, 20] => [1e-6, 1]", "@grain_step | d = 1e-06 m"),
    Entry("diameters in mm", SIZES + "[[0.15, 20], [0.2, 160], [0.25, 20]]",
          "@sizes | 0.25 m, wider than the domain | 0.2 mm is 2e-4"),
    Entry("forces of no flow", '[coupling] forces = ["drag"]', "@forces | must be absent without a [fluid]", base=DRY),
    Entry("a solver of no flow", "[solver] max_iterations = 10", "@max_iterations | must be absent without a [fluid]", base=DRY),
    Entry("frames of no grains", "[output] dune_interval = 1", "@dune_interval | must be absent without a [grains]", base=WET),
    Entry("restart files to keep of none", "[restart] keep = 5", "@keep | both intervals are 0"),
    Entry("a law of no drag", '[coupling] forces = ["buoyancy"] ;; [coupling] drag = "di_felice"', '@drag = | without "drag"'),
    Entry("too few rows", "[fluid] cells = [10, 3, 6] ;; -[fluid] first_cell_height", "warning | has 3 rows over a no-slip floor", **GOOD),
    Entry("uniform at no speed", '[initial] fluid = "uniform" ;; -[fluid] mean_velocity', "@fluid = | must come with a mean_velocity"),
    Entry("a glued floor of nothing", '[grains] floor = "glued"', '@[grains] | floor_diameter | must be above 0 with floor = "glued"'),
    Entry("glued spheres on a smooth floor", "[grains] floor_diameter = 2e-4", "@floor_diameter | must be absent unless"),
    Entry("glued boulders", '[grains] floor = "glued" ;; [grains] floor_diameter = 1e-3', "@floor_diameter | fall between"),
    Entry("one glued sphere", '[grains] floor = "glued" ;; [grains] floor_diameter = 5e-3',
          "@floor_diameter | at least 3 spheres long | fall between", problems=2),
    Entry("a floor that is not there", '[grains] floor = "rough"', '@floor = | "smooth"'),
    Entry("a glued floor", '[grains] floor = "glued" ;; [grains] floor_diameter = "1 d" ;; ' + SHORT, code=0),
    Entry("frames after the end", "[output] grains_interval = 0.011", "warning | grains_interval is longer than the run", **GOOD),
    Entry("cells smaller than grains", "-[fluid] first_cell_height ;; [fluid] cells = [100, 50, 60] ;; " + FLUID_STEP +
          '1e-4 ;; [coupling] exchange = "smoothed"', "warning | 0.50 mean grain diameters | 1.2 to 1.6", **GOOD),
]


def grains_from(name, value, says, **more):
    return Entry(name, f"[initial] grains = {value}", says, base=TABLE, **more)


def flow_from(name, value, says, **more):
    return Entry(name, f"[initial] fluid = {value}", says, **more)


STARTS = [
    grains_from("a FIFO", '"grains.csv"', "@grains = | not a file but a device or a pipe", files={"grains.csv": os.mkfifo}),
    grains_from("a case without grains", '"other.toml"', "@grains = | a case with [grains]", files={"other.toml": WET}),
    # Its results would be removed as those of an earlier run in that folder.
    grains_from("in the run folder", '"out/grains.h5"', "initial.grains =  | grains.h5 | in the run folder | another --out",
                given=("good as out",)),
    flow_from("a case of the same name", '"flow/case.toml"', "initial.fluid =  | flow/case.toml | another --out",
              files={"flow/case.toml": DUNE}, command="run case.toml --quiet"),
]

def kinds(name, sections, says, **more):
    """Sections [[grains.kind]] and [[grains.pair]] after the case."""
    return Entry(name, "", says, text=DUNE + sections, **more)


GLASS = '[[grains.kind]]\nname = "glass"\n'
KINDS = [
    kinds("kinds of one name", GLASS + GLASS, "case.toml | must be another one for each kind"),
    kinds("a kind without a name", "[[grains.kind]]\ndensity = 4100\n", "case.toml | name: required key is missing"),
    kinds("a name with a comma", '[[grains.kind]]\nname = "a,b"\n', "case.toml | must be a word of letters"),
    kinds("a kind as a section", '[grains.kind]\nname = "glass"\n', "case.toml | must be sections, [[grains.kind]]"),
    kinds("five kinds", "".join(f'[[grains.kind]]\nname = "k{n}"\n' for n in range(5)), "case.toml | at most 4 sections"),
    kinds("a pair of no kinds", '[[grains.pair]]\nkinds = ["a", "b"]\nrestitution = 0.5\n',
          "case.toml | must be absent without [[grains.kind]]"),
    kinds("a pair with a stranger", GLASS + '[[grains.pair]]\nkinds = ["glass", "glas"]\nrestitution = 0.5\n',
          'case.toml | must be names of [[grains.kind]] | did you mean "glass"'),
    kinds("a kind with a material of nothing", GLASS + "youngs_modulus = 0\n", "case.toml | youngs_modulus = 0: must be at least"),
    kinds("a kind that floats", GLASS + "density = 900\nyoungs_modulus = 4e5\n", 'warning | those of "glass" float', **GOOD),
]


ENTRIES = {"syntax": SYNTAX, "keys": KEYS, "values": VALUES, "contradictions": CONTRADICTIONS, "kinds": KINDS, "starts": STARTS}
