"""HDF5 files that are none, are damaged, or were made by something else."""

import os

import h5py
import numpy

from entry import DUNE, TABLE, Entry

N = 4


def frame(path, frames=1, **changed):
    """A grains.h5 as another program may write it, with some arrays changed; None leaves one out."""
    arrays = {"id": numpy.arange(N), "d": numpy.full(N, 2e-4), "u": numpy.zeros((N, 3), "f4"), "omega": numpy.zeros((N, 3), "f4"),
              "x": numpy.array([[0.004 + 4e-4 * n, 4e-4, 0.003] for n in range(N)]), **changed}
    with h5py.File(path, "w") as file:
        for number in range(frames):
            group = file.create_group(f"frame_{number:06d}")
            group.attrs["time"], group.attrs["step"] = 0.1 * number, number
            for name, values in arrays.items():
                if values is not None:
                    group[name] = values


def edited(**changed):
    return lambda path: frame(path, **changed)


def cut(path, keep):
    data = path.read_bytes()
    path.write_bytes(data[: int(len(data) * keep)])


def flip(path, at):
    data = bytearray(path.read_bytes())
    data[int(len(data) * at)] ^= 0x55
    path.write_bytes(bytes(data))


def h5(function):
    """A file written by h5py."""
    def make(path):
        with h5py.File(path, "w") as file:
            function(file)
    return make


def from_file(name, make, says, **more):
    return Entry(name, says, {'grains = "grains.csv"': 'grains = "start.h5"'}, base=TABLE, files={"start.h5": make}, **more)


def info(name, make, says, **more):
    return Entry(name, says, text="", command="info start.h5", files={"start.h5": make}, **more)




def huge(file):
    group = file.create_group("frame_000000")
    group.attrs["time"], group.attrs["step"] = 0.0, 0
    group.create_dataset("id", shape=(2**40,), dtype="i8", chunks=(2**10,))


GRAINS = ("good/grains.h5 as start.h5",)
ENTRIES = [
    from_file("grains.h5: empty file", b"", ["start.h5", "not an HDF5 file"]),
    from_file("grains.h5: text", "id,diameter,x,y,z\n", ["start.h5", "not an HDF5 file"]),
    from_file("grains.h5: zeros", bytes(100_000), ["start.h5", "not an HDF5 file"]),
    from_file("grains.h5: signature alone", b"\x89HDF\r\n\x1a\n", ["start.h5"]),
    from_file("grains.h5: nothing in it", h5(lambda file: None), ["start.h5", "no frames of grains"]),
    from_file("grains.h5: of another program", h5(lambda file: file.create_dataset("positions", data=numpy.zeros((5, 3)))),
              ["start.h5", "no frames of grains"]),
    from_file("grains.h5: made by hand", edited(), [], code=0),
    from_file("grains.h5: no ids", edited(id=None), ["start.h5", "id"]),
    from_file("grains.h5: no diameters", edited(d=None), ["start.h5", "frame_000000/d"]),
    from_file("grains.h5: no positions", edited(x=None), ["start.h5", "frame_000000/x"]),
    from_file("grains.h5: positions transposed", edited(x=numpy.zeros((3, N))), ["start.h5", "3 x 4", "4 x 3"]),
    from_file("grains.h5: fewer diameters", edited(d=numpy.full(N - 1, 2e-4)), ["start.h5", "frame_000000/d"]),
    from_file("grains.h5: ids as reals", edited(id=numpy.arange(N) * 1.0), ["start.h5", "integers", "id"]),
    from_file("grains.h5: positions as integers", edited(x=numpy.zeros((N, 3), "i8")), ["start.h5", "real numbers", "x"]),
    from_file("grains.h5: positions as text", edited(x=numpy.full((N, 3), b"x")), ["start.h5", "x"]),
    from_file("grains.h5: a scalar for ids", edited(id=numpy.int64(7)), ["start.h5"]),
    from_file("grains.h5: a group for ids", lambda path: (frame(path, id=None), h5py.File(path, "a").create_group("frame_000000/id/a")),
              ["start.h5", "id"]),
    from_file("grains.h5: no grains", edited(id=numpy.zeros(0, "i8"), d=numpy.zeros(0), x=numpy.zeros((0, 3)), u=numpy.zeros((0, 3)),
                                             omega=numpy.zeros((0, 3))), ["start.h5", "no grains"]),
    from_file("grains.h5: NaN position", edited(x=numpy.full((N, 3), numpy.nan)), ["start.h5", "grain 0", "not finite"]),
    from_file("grains.h5: infinite speed", edited(u=numpy.full((N, 3), numpy.inf, "f4")), ["start.h5", "grain", "finite"]),
    from_file("grains.h5: NaN diameter", edited(d=numpy.full(N, numpy.nan)), ["start.h5", "grain 0", "diameter"]),
    from_file("grains.h5: diameters of 0", edited(d=numpy.zeros(N)), ["start.h5", "grain 0", "diameter", "above 0"]),
    from_file("grains.h5: negative diameters", edited(d=numpy.full(N, -2e-4)), ["start.h5", "grain 0", "diameter", "above 0"]),
    from_file("grains.h5: ids twice", edited(id=numpy.zeros(N, "i8")), ["start.h5", "grain 0", "is in it twice"]),
    from_file("grains.h5: negative ids", edited(id=-1 - numpy.arange(N)), [], code=0),
    from_file("grains.h5: outside", edited(x=numpy.full((N, 3), 1.0)), ["start.h5", "outside the domain"]),
    from_file("grains.h5: on top of each other", edited(x=numpy.full((N, 3), 0.003)), ["start.h5", "overlap"]),
    from_file("grains.h5: an array larger than the file", h5(huge), ["start.h5"]),
    Entry("grains.h5: flow instead of grains", ["start.h5", "id"], {'grains = "grains.csv"': 'grains = "start.h5"'}, base=TABLE,
          given=("good/fields.h5 as start.h5",)),
    *[Entry(f"grains.h5: cut at {keep:.0%}", ["start.h5", "cut short"], {'grains = "grains.csv"': 'grains = "start.h5"'}, base=TABLE,
            given=GRAINS, files={"start.h5": lambda path, keep=keep: cut(path, keep)}) for keep in (0.1, 0.5, 0.9, 0.99)],
    Entry("grains.h5: a folder", ["@grains =", "is a folder"], {'grains = "grains.csv"': 'grains = "start.h5"'}, base=TABLE,
          files={"start.h5": lambda path: path.mkdir()}),
    # As the flow of a start: a restart file of another kind or case.
    Entry("flow: a table called .h5", ["start.h5", "not an HDF5 file"], {'fluid = "turbulent"': 'fluid = "start.h5"'},
          files={"start.h5": "id,x\n"}),
    Entry("flow: fields.h5", ["start.h5", "not a restart file"], {'fluid = "turbulent"': 'fluid = "start.h5"'},
          given=("good/fields.h5 as start.h5",)),
    Entry("flow: grains.h5", ["start.h5", "not a restart file"], {'fluid = "turbulent"': 'fluid = "start.h5"'}, given=GRAINS),
    Entry("flow: of another mesh", ["start.h5", "the same mesh", "[10, 14, 6]"],
          {'fluid = "turbulent"': 'fluid = "start.h5"', "cells = [10,": "cells = [12,"},
          given=("good/restart_0000000004.h5 as start.h5",)),
    Entry("flow: of another domain", ["start.h5", "the same domain", "0.012"],
          {'fluid = "turbulent"': 'fluid = "start.h5"', "[0.012,": "[0.014,"}, given=("good/restart_0000000004.h5 as start.h5",)),
    *[Entry(f"flow: cut at {keep:.0%}", ["start.h5", "cut short"], {'fluid = "turbulent"': 'fluid = "start.h5"'},
            given=("good/restart_0000000004.h5 as start.h5",), files={"start.h5": lambda path, keep=keep: cut(path, keep)})
      for keep in (0.3, 0.999)],
    Entry("flow: one bit wrong", ["start.h5", "damaged"], {'fluid = "turbulent"': 'fluid = "start.h5"'},
          given=("good/restart_0000000004.h5 as start.h5",), files={"start.h5": lambda path: flip(path, 0.6)}),
    # info
    info("info: empty file", b"", ["start.h5", "not an HDF5 file"]),
    info("info: text", "hello\n", ["start.h5", "not an HDF5 file"]),
    info("info: foreign", h5(lambda file: file.create_dataset("a", data=[1, 2])), ["start.h5", "not one that barchan wrote"]),
    info("info: a folder", lambda path: path.mkdir(), ["start.h5", "folder"]),
    Entry("info: no such file", ["nowhere.h5", "No such file"], text="", command="info nowhere.h5"),
    Entry("info: /dev/zero", ["/dev/zero", "not a file but a device"], text="", command="info /dev/zero", limit=10),
    Entry("info: a FIFO", ["start.h5", "not a file but a device or a pipe"], text="", command="info start.h5", files={"start.h5": os.mkfifo},
          limit=10),
    Entry("info: the case", ["case.toml", "not an HDF5 file"], command="info case.toml"),
    Entry("info: cut", ["start.h5", "cut short"], text="", command="info start.h5", given=GRAINS,
          files={"start.h5": lambda path: cut(path, 0.5)}),
    Entry("info: a restart with a wrong bit", ["start.h5", "damaged"], text="", command="info start.h5",
          given=("good/restart_0000000004.h5 as start.h5",), files={"start.h5": lambda path: flip(path, 0.6)}),
]
