"""The case file: text, keys, values, contradictions, and what it starts from."""

import os

from entry import DRY, DUNE, POUR, SHORT, TABLE, WET, Entry

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
    Entry("1e15 cells", "-[fluid] first_cell_height ;; [fluid] cells = [100000, 100000, 100000] ;; " + FLUID_STEP +
          '1e-12 ;; [time] grain_step = 1e-12 ;; [time] end = 1e-11 ;; [fluid] mean_velocity = 1e-9 ;; '
          '[initial] fluid = "still"', "case.toml | cells"),
    Entry("cells for a terabyte", "-[fluid] first_cell_height ;; [fluid] cells = [2000, 2000, 1000] ;; " + FLUID_STEP +
          "1e-7 ;; [time] grain_step = 1e-7 ;; [time] end = 1e-5", "needs about | GB | fluid.cells"),
    Entry("a length below zero", '[coupling] smoothing_length = "-3 d"', "@smoothing_length | at least 0"),
    Entry("a force that is not there", '[coupling] forces = ["drag", "lfit"]', '@forces | must be an array | did you mean "lift"'),
    Entry("one grain", SIZES + "[[2e-4, 1]] ;; " + SHORT, code=0),
    Entry("a title of other letters", '[case] title = "Düne 沙丘 <b>&amp;\\"</b>" ;; ' + SHORT, code=0),
]

FOLLOW = '[grains] boundary_x = "follow"'
CONTRADICTIONS = [
    Entry("drag at a wall that does not drag", '[coupling] forces = ["drag", "wall_drag"] ;; [fluid] bottom = "free_slip"',
          "@forces | wall_drag | free-slip bottom"),
    Entry("a million grain steps and more", "[time] grain_step = 1e-11", "@grain_step | millionth"),
    Entry("one tiny grain among many", "[1.5e-4, 20] => [1e-6, 1]", "@grain_step | d = 1e-06 m"),
    Entry("diameters in mm", SIZES + "[[0.15, 20], [0.2, 160], [0.25, 20]]",
          "@sizes | 0.25 m, wider than the domain | 0.2 mm is 2e-4"),
    Entry("too few rows", "[fluid] cells = [10, 3, 6] ;; -[fluid] first_cell_height", "warning | has 3 rows over a no-slip floor", **GOOD),
    Entry("a schedule of one section", "-[fluid] mean_velocity ;; [fluid] schedule = {time = 0, velocity = 0.2}",
          "@schedule | must be sections, [[fluid.schedule]]"),
    Entry("a glued floor of nothing", '[grains] floor = "glued"', '@[grains] | floor_diameter | must be above 0 with floor = "glued"'),
    Entry("glued spheres on a smooth floor", "[grains] floor_diameter = 2e-4", "@floor_diameter | must be absent unless"),
    Entry("glued boulders", '[grains] floor = "glued" ;; [grains] floor_diameter = 1e-3', "@floor_diameter | fall between"),
    Entry("one glued sphere", '[grains] floor = "glued" ;; [grains] floor_diameter = 5e-3',
          "@floor_diameter | at least 3 spheres long | fall between", problems=2),
    Entry("a floor that is not there", '[grains] floor = "rough"', '@floor = | "smooth"'),
    Entry("a glued floor", '[grains] floor = "glued" ;; [grains] floor_diameter = "1 d" ;; ' + SHORT, code=0),
    Entry("a window of no flow", FOLLOW, "@boundary_x | without a [fluid]", base=DRY),
    Entry("a window in a bed", FOLLOW + ' ;; [initial.grains.pour] shape = "bed" ;; -[initial.grains.pour] centre ;; '
          "-[initial.grains.pour] radius ;; [grains] sizes = [[2e-4, 3000]]",
          "initial.grains.pour | grains lie within 0.0012 m | take a longer domain.size"),
    Entry("a window around a few grains", FOLLOW + " ;; " + SIZES + "[[2e-4, 20]]", "initial.grains.pour | holds no dune"),
    Entry("a feed at the edge of the window", FOLLOW + " ;; [grains.feed] rate = 10",
          "@[grains.feed] | must be at least a cell, 0.0012 m"),
    Entry("a feed in a window", FOLLOW + " ;; [grains.feed] rate = 1e4 ;; [grains.feed] x = 2e-3 ;; " + SHORT, code=0),
    Entry("the viscosity of layers without them", '[coupling] forces = "complete" ;; [coupling] scheme = "smoothed"',
          "warning | mixture_viscosity | layered", **GOOD),
    Entry("cells smaller than grains", "-[fluid] first_cell_height ;; [fluid] cells = [100, 50, 60] ;; " + FLUID_STEP +
          '1e-4 ;; [coupling] scheme = "smoothed"', "warning | 0.50 mean grain diameters | 1.2 to 1.6", **GOOD),
]


def grains_from(name, value, says, **more):
    return Entry(name, f"[initial] grains = {value}", says, base=TABLE, **more)


def flow_from(name, value, says, **more):
    return Entry(name, f"[initial] fluid = {value}", says, **more)


def heaps(name, says, *sections, **more):
    """`sections`: what follows "[[initial." in each."""
    text = "".join(f"[[initial.{section}\n" for section in sections)
    return Entry(name, f"[output] => {text}[output]", says, base=DRY.replace(POUR, ""), **more)


def body(name, keys, says, **more):
    """`keys` of a body named "post"."""
    edits = " ;; ".join(f"[[body]] {key}" for key in ['name = "post"', *keys.split("; ")])
    return Entry(name, edits, says, **more)


UPRIGHT, SOLID_DUNE = 'shape = "cylinder"; centre = [0.004, 0.003]; ', 'shape = "dune"; centre = [0.008, 0.003]; '
HALF = 'shape = "box"; centre = [0.004, {}]; size = [0.002, 0.003]; height = 0.006'
BODIES = [
    body("a body of no shape that we know", 'shape = "cone"', '@shape | "cylinder" | "wave"'),
    body("a cylinder of no radius", UPRIGHT + "height = 0.003",
         "[body.1] radius | must be above 0 with an upright cylinder"),
    body("a cylinder with a slope", UPRIGHT + "radius = 0.0025; height = 0.003; lee = 1e-3",
         "@lee | must be absent with an upright cylinder"),
    body("a body across the side", 'shape = "sphere"; centre = [0.004, 0.001]; radius = 0.0025',
         "@centre = [0.004, 0.001 | must keep the body inside the domain along z | -0.0015"),
    body("a body above the lid", UPRIGHT + "radius = 0.0025; height = 0.003; base = 0.006",
         "@base | must leave a part of the body in the domain"),
    body("a body that fills the box", 'shape = "box"; height = 0.006', "@shape | must leave water beside or above"),
    body("a body across the stream", 'shape = "box"; centre = [0.004, 0]; size = [0.003, 0]; height = 0.006',
         "@shape | must leave water beside or above"),
    Entry("two bodies that close the channel together", body("", HALF.format("0.0015"), "").edits +
          ' ;; [output] => [[body]]\nname = "other"\n' + HALF.format("0.0045").replace("; ", "\n") + "\n[output]",
          "case.toml | [[body]] must leave water beside or above | along x"),
    body("a wave up to the lid", 'shape = "wave"; height = 0.002; wavelength = 0.006; base = 0.005',
         "case.toml | [[body]] must leave water beside or above | along x"),
    body("posts that overlap", 'shape = "fence"; centre = [0.004, 0.003]; radius = 5e-4; height = 0.003; '
         "length = 0.004; spacing = 1e-3", "@spacing | above the diameter of a post, 0.001 m"),
    body("a box turned at no end", 'shape = "box"; height = 0.002; angle = 0.3', "@angle | through the whole domain"),
    body("a dune that is all lee", SOLID_DUNE + "height = 1e-3; size = [0.005, 0.005]; lee = 0.005",
         "@lee | below the length of the dune, 0.005 m"),
    body("a dune in the air", SOLID_DUNE + "height = 1e-3; size = [0.005, 0.005]; lee = 0.001; base = 1e-3",
         "@base | stands on the floor"),
    body("a dune around the box", SOLID_DUNE + "height = 1e-3; size = [0.0085, 0.005]; lee = 0.0015",
         "@size = [0.0085 | half the length of the domain, 0.006 m"),
    body("a wave that does not fit", 'shape = "wave"; height = 1e-3; wavelength = 0.005',
         "@wavelength | a whole number of times"),
    body("a body of half a cell", UPRIGHT + "radius = 3e-4; height = 0.001",
         "warning | cells across its smallest width", **GOOD),
    body("a body of one row", UPRIGHT + "radius = 0.0021; height = 3e-4", "warning | rows of cells high", **GOOD),
]

FIRST = "heap]]\ncentre = [0.003, 0.003]\nradius = 0.0015"
HEAPS = [
    heaps("two heaps and a crater", "", FIRST, "heap]]\ncentre = [0.007, 0.003]\nradius = 0.0015",
          "crater]]\ncentre = [0.003, 0.003]\nradius = 5e-4\ndepth = 2e-4", "heap]]\nshape = \"ridge\"\n"
          "centre = [0.01, 0]\nradius = 0.0011", code=0, command="run case.toml --out out --quiet --set time.end=5e-4"),
    heaps("a heap beside the box", "[initial.heap.1] radius = 0.004 | along z it spans -0.001 to 0.007 m",
          "heap]]\ncentre = [0.005, 0.003]\nradius = 0.004"),
    heaps("a heap of no kind", '[initial.heap.1] kind = "glas": must be the name of a [[grains.kind]] | did you mean "glass"',
          'heap]]\ncentre = [0.005, 0.003]\nradius = 0.0015\nkind = "glas"\n[[grains.kind]]\nname = "glass"'),
    heaps("a heap of no shape", '@shape = | "cone", "ridge", "bed"', 'heap]]\nshape = "cube"'),
    Entry("a heap as a section", "[output] => [initial.heap]\n[output]",
          "must be sections, [[initial.heap]] for each of them", base=DRY),
    heaps("a crater without depth", "@[[initial.crater]] | depth: required key is missing", FIRST,
          "crater]]\ncentre = [0.003, 0.003]\nradius = 5e-4"),
    heaps("a crater below the floor", "initial.crater.1: depth = 0.005: must be at most", FIRST,
          "crater]]\ncentre = [0.003, 0.003]\nradius = 5e-4\ndepth = 5e-3"),
    Entry("heaps and a pour", "[output] => [[initial.heap]]\nradius = 0.001\n[output]",
          "[initial] heap = | contradicts initial.grains", base=DRY),
]

STARTS = [
    grains_from("a FIFO", '"grains.csv"', "@grains = | not a file but a device or a pipe", files={"grains.csv": os.mkfifo}),
    grains_from("a case without grains", '"other.toml"', "@grains = | a case with [grains]", files={"other.toml": WET}),
    # Its results would be removed as those of an earlier run in that folder.
]

def kinds(name, sections, says, **more):
    """Sections [[grains.kind]] and [[grains.pair]] after the case."""
    return Entry(name, "", says, text=DUNE + sections, **more)


GLASS = '[[grains.kind]]\nname = "glass"\n'
KINDS = [
    kinds("a kind as a section", '[grains.kind]\nname = "glass"\n', "case.toml | must be sections, [[grains.kind]]"),
    kinds("a kind with a material of nothing", GLASS + "youngs_modulus = 0\n", "case.toml | youngs_modulus = 0: must be at least"),
    kinds("a kind that floats", GLASS + "density = 900\nyoungs_modulus = 4e5\n", 'warning | those of "glass" float', **GOOD),
]


ENTRIES = {"syntax": SYNTAX, "keys": KEYS, "values": VALUES, "contradictions": CONTRADICTIONS, "kinds": KINDS,
           "heaps": HEAPS, "bodies": BODIES, "starts": STARTS}
