"""What a case reads: tables of grains, HDF5 files, restart files."""

import h5py
import numpy

from entry import SHORT, TABLE, Entry

# Grains that float apart from each other; ids from 1: line 2 is grain 1.
GOOD = "id,diameter,x,y,z\n" + "".join(
    f"{n + 1},2e-4,{0.004 + 3e-4 * (n % 5):.10g},{4e-4 + 3e-4 * (n // 5):.10g},0.003\n" for n in range(20))
END = "[time] end = 0.002"
RESTART = "restart_0000000004.h5"
AGAIN = f"run case.toml --quiet --out out --restart out/{RESTART}"


def table(name, text, says="", edits="", **more):
    return Entry("table: " + name, edits if says else SHORT, says, base=TABLE, files={"grains.csv": text},
                 code=2 if says else 0, **more)


def grain(name, line, says=""):
    """The good table with another grain in line 3."""
    lines = GOOD.splitlines(keepends=True)
    return table(name, "".join([*lines[:2], line + "\n", *lines[3:]]), says)


TABLES = [
    table("last line cut", GOOD[:-10], "grains.csv:21: | values"),
    table("at the speed of light", GOOD.replace("z\n", "z,vx\n").replace("0.003\n", "0.003,3e8\n"),
          "grains.csv | grain | m/s | grain_step"),
    table("50 MB of garbage", b"xyz\0" * 12_500_000, "grains.csv:1: | not text"),
    table("a column missing, before the run", GOOD.replace(",diameter", ""), "grains.csv:1: | diameter",
          command="check case.toml"),
    table("too small for the grain step, before the run", GOOD.replace("2e-4,", "2e-6,", 1),
          "grains.csv | time.grain_step must be at most | Rayleigh", command="check case.toml"),
    table("mark, spaces, comments, Windows line ends",
          b"\xef\xbb\xbf" + GOOD.replace(",", " , ").replace("\n", "\r\n\r\n# x\r\n").encode()),
    grain("diameter of 1e-300", "2,1e-300,0.0043,4e-4,0.003", "grains.csv | time.grain_step must be at most"),
    grain("the largest id", "9223372036854775807,2e-4,0.0043,4e-4,0.003"),
    table("two at one place", GOOD + GOOD.splitlines()[-1].replace(GOOD.splitlines()[-1].split(",")[0], "77", 1) + "\n",
          "grains.csv | and 77 are at one place"),
    grain("outside", "2,2e-4,0.0043,4e-4,-0.009", "grains.csv | grain 2 | outside the domain | domain.size"),
    grain("inside the floor", "2,2e-4,0.0043,0,0.003", "grains.csv | grain 2 | the floor"),
]

N = 4


def frame(**changed):
    """A grains.h5 as another program may write it, with some arrays changed; None leaves one out."""
    def make(path):
        arrays = {"id": numpy.arange(N), "d": numpy.full(N, 2e-4), "u": numpy.zeros((N, 3), "f4"),
                  "omega": numpy.zeros((N, 3), "f4"), "x": [[0.004 + 4e-4 * n, 4e-4, 0.003] for n in range(N)], **changed}
        with h5py.File(path, "w") as file:
            group = file.create_group("frame_000000")
            group.attrs["time"], group.attrs["step"] = 0.0, 0
            for name, values in arrays.items():
                if values is not None:
                    group[name] = values
    return make


def foreign(path):
    with h5py.File(path, "w") as file:
        file["positions"] = numpy.zeros((5, 3))


def cut(keep):
    return lambda path: path.write_bytes(path.read_bytes()[: int(path.stat().st_size * keep)])


def flip(at):
    """One byte wrong at this share of the file."""
    def change(path):
        data = bytearray(path.read_bytes())
        data[int(len(data) * at)] ^= 0x55
        path.write_bytes(bytes(data))
    return change


def flip_last(name):
    """One bit wrong in an array of the last frame."""
    def change(path):
        with h5py.File(path, "r+") as file:
            array = file[max(file)][name]
            raw = array[...].view("u1")
            raw.flat[raw.size // 2] ^= 1
            array[...] = raw.view(array.dtype).reshape(array.shape)
    return change


def start(name, make, says, **more):
    return Entry("grains.h5: " + name, '[initial] grains = "start.h5"', "start.h5 | " + says, base=TABLE,
                 files={"start.h5": make} if make else {}, **more)


def flow(name, says, edits="", change=None, given="good/" + RESTART):
    return Entry("flow: " + name, '[initial] fluid = "start.h5" ;; ' + edits, "start.h5 | " + says,
                 given=(given + " as start.h5",), files={"start.h5": change} if change else {})


def info(name, says, make=None, given=()):
    return Entry("info: " + name, "", says, text="", command="info start.h5", given=given,
                 files={"start.h5": make} if make is not None else {})


HDF5 = [
    start("text", "id,diameter,x,y,z\n", "not an HDF5 file"),
    start("signature alone", b"\x89HDF\r\n\x1a\n", ""),
    start("of another program", foreign, "no frames of grains"),
    Entry("grains.h5: made by hand", '[initial] grains = "start.h5"', base=TABLE, files={"start.h5": frame()}, code=0),
    start("ids as reals", frame(id=numpy.arange(N) * 1.0), "integers | id"),
    start("positions transposed", frame(x=numpy.zeros((3, N))), "3 x 4 | 4 x 3"),
    start("a group for ids", lambda path: (frame(id=None)(path), h5py.File(path, "a").create_group("frame_000000/id")), "id"),
    start("cut", cut(0.5), "cut short", given=("good/grains.h5 as start.h5",)),
    *(start(f"one bit wrong in {name}", flip_last(name), f"damaged | checksum | /{name}",
            given=("good/grains.h5 as start.h5",)) for name in ("id", "x", "d", "u", "omega")),
    flow("one bit wrong", "damaged", change=flip(0.6)),
    Entry("flow: on other cells of the same box", '[initial] fluid = "start.h5" ;; [fluid] cells = [12, 14, 6]',
          given=(f"good/{RESTART} as start.h5",), code=0),
    info("a restart with a wrong bit", "start.h5 | damaged", flip(0.6), (f"good/{RESTART} as start.h5",)),
]


def restart(name, says="", edits=END, change=None, file="out/" + RESTART, given="good as out", **more):
    return Entry("restart: " + name, edits, says, given=(given,), files={file: change} if change is not None else {},
                 **{"command": AGAIN, "code": 2 if says else 0, **more})


def restart_from(name, file, says):
    return restart(name, says, command=AGAIN.replace("out/" + RESTART, file))


def rewritten(change, format=None):
    """The file with changed content and without its seal; format 5 had none, and is checked by looking."""
    def make(path):
        path.write_bytes(path.read_bytes()[512:])  # h5py would keep the block before the data as it is
        with h5py.File(path, "a") as file:
            if format:
                file.attrs.modify("format", format)
            change(file)
    return make


def fill(name, value):
    def change(file):
        file[name][...] = value
    return change


def fewer_grains(file):
    del file["grains/kin"]
    file["grains/kin"] = numpy.zeros((3, 11))


RESTARTS = [
    restart_from("grains.h5", "out/grains.h5", "grains.h5 | not a restart file"),
    *(restart(f"cut at {keep}", RESTART + " | cut short", change=cut(keep)) for keep in (0.001, 0.999)),
    *(restart(f"a bit wrong at {at}", RESTART + " | damaged | another one is out/restart_0000000002.h5", change=flip(at))
      for at in (0.01, 0.5)),
    restart("a bit of the seal wrong", RESTART, change=flip(1e-9)),
    restart("edited by hand", RESTART + " | seal", change=rewritten(fill("grains/kin", 1.0))),
    restart("of an older format", RESTART + " | format 3 | reads 5 to", change=rewritten(lambda file: None, 3)),
    restart("of a newer format", RESTART + " | format 99 | newer", change=rewritten(lambda file: None, 99)),
    restart("no format", RESTART, change=rewritten(lambda file: file.attrs.__delitem__("format"))),
    restart("fewer grains in one array", RESTART + " | grains/kin", change=rewritten(fewer_grains, 5)),
    restart("NaN in grains", RESTART + " | finite", change=rewritten(fill("grains/kin", numpy.nan), 5)),
    # of another case
    restart("four keys changed", "time.fluid_step | written with 0.00025 | fluid.cells | domain.size | grains.density",
            "[time] fluid_step = 2e-4 ;; [fluid] cells = [12, 14, 6] ;; [domain] size = [0.014, 0.006, 0.006] ;; "
            "[grains] density = 2600"),
    restart("of a case without water", "[fluid] | without this section", given="dry as out"),
    restart("beyond the end", "its time, 0.001 s, is beyond time.end | a later end", "[time] end = 0.0005"),
    restart("into a folder of other tables", "history.csv | columns | another folder", change="a,b,c\n1,2,3\n",
            file="out/history.csv"),
    restart("a damaged grains.h5 in the folder", "out/grains.h5 | another folder", change=cut(0.5), file="out/grains.h5"),
    restart("at the end already", edits="[time] end = 0.001"),
    restart("other friction", "changed since | sliding_friction", "[time] end = 0.0015 ;; [grains] sliding_friction = 0.2",
            code=0, command=AGAIN.replace(" --quiet", "")),
]

ENTRIES = {"grain tables": TABLES, "HDF5 files": HDF5, "restarts": RESTARTS}
