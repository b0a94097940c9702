"""Restart files: damaged, of other versions, of other cases, and folders that do not fit."""

import h5py
import numpy

from entry import DRY, DUNE, TABLE, Entry
from hdf5_files import cut, flip, h5

LAST, FIRST = "good/restart_0000000004.h5", "good/restart_0000000002.h5"
GO_ON = "run case.toml --quiet --out out --restart out/restart_0000000004.h5"
OWN = {"end = 0.01": "end = 0.002"}


def restart(name, says, edits=None, command=GO_ON, **more):
    return Entry(name, says, edits or OWN, given=("good as out",), command=command, **more)


def damaged(name, says, change, **more):
    return restart(name, says, files={"out/restart_0000000004.h5": change}, **more)


def rewritten(path, change):
    """The file with changed content and without a seal of its own."""
    data = path.read_bytes()
    path.write_bytes(data[512:])  # h5py would keep the block before the data as it is
    with h5py.File(path, "a") as file:
        change(file)


def as_format(number):
    def change(path):
        rewritten(path, lambda file: file.attrs.modify("format", number))
    return change


def unsealed(change):
    """An older format has no seal: what is wrong with it must be found by looking."""
    def make(path):
        def edit(file):
            file.attrs.modify("format", 5)
            change(file)
        rewritten(path, edit)
    return make


def resize(name, shape):
    def change(file):
        del file[name]
        file[name] = numpy.zeros(shape)
    return change


def fill(name, value):
    def change(file):
        file[name][...] = value
    return change


ENTRIES = [
    restart("restart: no such file", ["restart_0000000099.h5", "No such file"],
            command="run case.toml --quiet --out out --restart out/restart_0000000099.h5"),
    restart("restart: no name", ["no name was given"], command="run case.toml --quiet --out out --restart ''"),
    restart("restart: a folder", ["out", "folder"], command="run case.toml --quiet --out out --restart out"),
    restart("restart: /dev/zero", ["/dev/zero", "not a file but a device"], command="run case.toml --quiet --out out --restart /dev/zero", limit=10),
    restart("restart: grains.h5", ["grains.h5", "not a restart file"], command="run case.toml --quiet --out out --restart out/grains.h5"),
    restart("restart: fields.h5", ["fields.h5", "not a restart file"], command="run case.toml --quiet --out out --restart out/fields.h5"),
    restart("restart: a table", ["dune.csv", "not an HDF5 file"], command="run case.toml --quiet --out out --restart out/dune.csv"),
    restart("restart: the case", ["case.toml", "not an HDF5 file"], command="run case.toml --quiet --out out --restart case.toml"),
    damaged("restart: empty", ["cannot re", "restart_0000000004.h5"], b""),
    damaged("restart: text", ["restart_0000000004.h5", "not an HDF5 file"], "hello\n"),
    damaged("restart: foreign HDF5", ["restart_0000000004.h5", "not a restart file"], h5(lambda file: file.create_dataset("a", data=[1.0]))),
    *[damaged(f"restart: cut at {keep:.1%}", ["restart_0000000004.h5", "cut short"], lambda path, keep=keep: cut(path, keep))
      for keep in (0.001, 0.02, 0.5, 0.9, 0.999)],
    *[damaged(f"restart: a bit wrong at {at:.0%}", ["restart_0000000004.h5", "damaged", "another one is out/restart_0000000002.h5"], lambda path, at=at: flip(path, at))
      for at in (0.01, 0.1, 0.3, 0.5, 0.7, 0.95)],
    damaged("restart: a bit of the seal wrong", ["restart_0000000004.h5"], lambda path: flip(path, 1e-9)),
    damaged("restart: bytes appended", ["restart_0000000004.h5", "damaged"], lambda path: path.write_bytes(path.read_bytes() + b"more")),
    damaged("restart: edited by hand", ["restart_0000000004.h5", "seal"], lambda path: rewritten(path, fill("grains/kin", 1.0))),
    damaged("restart: of an older format", ["restart_0000000004.h5", "format 3", "reads 5 to"], as_format(3)),
    damaged("restart: of a newer format", ["restart_0000000004.h5", "format 99", "newer"], as_format(99)),
    damaged("restart: no format", ["restart_0000000004.h5"], lambda path: rewritten(path, lambda file: file.attrs.__delitem__("format"))),
    damaged("restart: grains left out", ["restart_0000000004.h5", "grains/kin"], unsealed(lambda file: file.__delitem__("grains/kin"))),
    damaged("restart: fewer grains in one array", ["restart_0000000004.h5", "grains/kin"], unsealed(resize("grains/kin", (3, 11)))),
    damaged("restart: NaN in grains", ["restart_0000000004.h5", "finite"], unsealed(fill("grains/kin", numpy.nan))),
    damaged("restart: without contacts", ["restart_0000000004.h5", "contacts"], unsealed(lambda file: file.__delitem__("contacts"))),
    # of another case
    restart("restart: another mesh", ["fluid.cells = [12, 14, 6]", "written with [10, 14, 6]"], {"cells = [10,": "cells = [12,"}),
    restart("restart: another size", ["domain.size", "written with"], {"[0.012,": "[0.014,"}),
    restart("restart: another fluid step", ["time.fluid_step", "written with 0.00025"], {"fluid_step = 2.5e-4": "fluid_step = 2e-4"}),
    restart("restart: another first row", ["fluid.first_cell_height", "written with"], {"2.6e-4": "2.8e-4"}),
    restart("restart: other boundaries", ["grains.boundary_x", 'written with "exit"'], {"[grains]": '[grains]\nboundary_x = "periodic"'}),
    restart("restart: other density of grains", ["grains.density", "written with 2500"], {"[grains]": "[grains]\ndensity = 2600"}),
    restart("restart: two keys changed", ["time.fluid_step", "fluid.cells"],
            {"fluid_step = 2.5e-4": "fluid_step = 2e-4", "cells = [10,": "cells = [12,"}),
    restart("restart: of a case with water", ["[fluid]", "with this section"], {"end = 0.01": "end = 0.002"}, base=DRY),
    Entry("restart: of a case without water", ["[fluid]", "without this section"], OWN, given=("dry as out",), command=GO_ON),
    Entry("restart: of a case without grains", ["[grains]", "without this section"], OWN, given=("wet as out",), command=GO_ON),
    restart("restart: at the end already", [], {"end = 0.01": "end = 0.001"}, code=0),
    restart("restart: beyond the end", ["its time, 0.001 s, is beyond time.end", "a later end"], {"end = 0.01": "end = 0.0005"}),
    restart("restart: a longer grain step than stable", ["@grain_step", "Rayleigh"], {"grain_step = 5e-6": "grain_step = 2.5e-5"}),
    restart("restart: into a folder of other tables", ["history.csv", "columns", "another folder"], files={"out/history.csv": "a,b,c\n1,2,3\n"}),
    restart("restart: the second table is not ours", ["dune.csv", "columns", "another folder"], files={"out/dune.csv": "a,b,c\n1,2,3\n"}),
    restart("restart: a damaged grains.h5 in the folder", ["out/grains.h5", "another folder"],
            files={"out/grains.h5": lambda path: cut(path, 0.5)}),
    restart("restart: a foreign fields.h5 in the folder", ["out/fields.h5", "another folder"], files={"out/fields.h5": "hello\n"}),
    restart("restart: an older one than the last", [], {"end = 0.01": "end = 0.001"}, code=0,
            command="run case.toml --quiet --out out --restart out/restart_0000000002.h5"),
    restart("restart: other friction", ["changed since", "sliding_friction"], {"end = 0.01": "end = 0.0015",
            "[grains]": "[grains]\nsliding_friction = 0.2"}, code=0, command=GO_ON.replace(" --quiet", "")),
]
