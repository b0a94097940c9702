"""Files that are not TOML, or not text, or not files."""

import os

from entry import DUNE, Entry


def fifo(path):
    os.mkfifo(path)


def folder(path):
    path.mkdir()


def hundred_megabytes(start):
    """Sparse: the file need not be read to be refused."""
    def make(path):
        path.write_bytes(start)
        os.truncate(path, 100_000_000)
    return make


def link_to(target):
    return lambda path: path.symlink_to(target)


ENTRIES = [
    Entry("empty file", ["case.toml", "[time]", "required section is missing"], text="", problems=3),
    Entry("only a comment", ["[domain]", "required section is missing"], text="# nothing yet\n", problems=3),
    Entry("only white space", ["[time]", "required section is missing"], text=" \n\t\n\n", problems=3),
    Entry("unclosed string", ["@title", "not TOML"], {'"Small coupled case"': '"Small coupled case'}),
    Entry("unclosed array", ["case.toml:", "not TOML"], {"cells = [10, 14, 6]": "cells = [10, 14, 6"}),
    Entry("unclosed section header", ["@[fluid", "not TOML"], {"[fluid]": "[fluid"}),
    Entry("closing bracket too many", ["@[fluid", "not TOML"], {"[fluid]": "[fluid]]"}),
    Entry("no equals sign", ["@end", "not TOML"], {"end = 0.01": "end 0.01"}),
    Entry("colon for equals", ["@end", "not TOML"], {"end = 0.01": "end: 0.01"}),
    Entry("no value", ["@end", "not TOML"], {"end = 0.01": "end ="}),
    Entry("two values", ["@end", "not TOML"], {"end = 0.01": "end = 0.01 0.02"}),
    Entry("unit behind a number", ["@end", "not TOML", "without a unit"], {"end = 0.01": "end = 0.01 s"}),
    Entry("decimal comma", ["@end", "not TOML", "after a point, not a comma"], {"end = 0.01": "end = 0,01"}),
    Entry("number without leading zero", ["@end", "not TOML", "0.01"], {"end = 0.01": "end = .01"}),
    Entry("number with trailing point", ["@mean", "not TOML", "both sides of the point"], {"mean_velocity = 0.2": "mean_velocity = 1."}),
    Entry("Fortran exponent", ["@grain_step", "not TOML", "written with e, as in 5e-6"], {"grain_step = 5e-6": "grain_step = 5d-6"}),
    Entry("hexadecimal float", ["@grain_step", "not TOML"], {"grain_step = 5e-6": "grain_step = 0x1p-18"}),
    Entry("expression", ["@grain_step", "not TOML"], {"grain_step = 5e-6": "grain_step = 1/2e5"}),
    Entry("word without quotes", ["@fluid =", "not TOML", "text stands in quotes"], {'fluid = "turbulent"': "fluid = turbulent"}),
    Entry("single-quoted and unclosed", ["@title", "not TOML"], {'"Small coupled case"': "'Small"}),
    Entry("Python's True", ["@frozen", "not TOML", "true and false are lower case"], {"[grains]": "[grains]\nfrozen = True"}),
    Entry("Python's None", ["@frozen", "not TOML"], {"[grains]": "[grains]\nfrozen = None"}),
    Entry("comment as in C", ["@// from", "not TOML"], {"[time]": "// from the paper\n[time]"}),
    Entry("JSON", ["case.toml:1:", "not TOML"], text='{ "time": { "end": 1 } }\n'),
    Entry("YAML", ["case.toml:1:", "not TOML"], text="time:\n  end: 1\n"),
    Entry("OpenFOAM dictionary", ["case.toml:1:", "not TOML"], text="FoamFile { version 2.0; }\n"),
    Entry("section twice", ["case.toml:", "not TOML", "existing table 'time'"], {"[restart]": "[time]\n[restart]"}),
    Entry("key twice", ["not TOML", "end"], {"end = 0.01": "end = 0.01\nend = 0.02"}),
    Entry("section given as key and header", ["not TOML"], {"# 200": "grains = 3\n# 200"}),
    Entry("key of a table closed before", ["not TOML"], {"[output]": "[initial.grains]\npour.seed = 1\n[output]"}),
    Entry("integer beyond 64 bits", ["@cells", "not TOML"], {"cells = [10,": "cells = [99999999999999999999,"}),
    Entry("bad escape in a string", ["@title", "not TOML"], {"Small coupled": "Small \\q coupled"}),
    Entry("Windows path in a string", ["@fluid =", "not TOML", "a backslash"], {'"turbulent"': '"C:\\users\\flow.h5"'}),
    Entry("byte that is not UTF-8", ["case.toml:", "not TOML"], text=DUNE.encode().replace(b"Small", b"Sm\xe4ll")),
    Entry("UTF-16", ["case.toml:1:", "not TOML", "UTF-8"], text=DUNE.encode("utf-16")),
    Entry("UTF-16 without a mark", ["case.toml:1:", "not TOML", "UTF-8"], text=DUNE.encode("utf-16-le")),
    Entry("NUL bytes", ["case.toml:", "not TOML"], text=DUNE.encode().replace(b"end", b"\0end")),
    Entry("control characters", ["case.toml:", "not TOML"], text=DUNE.encode().replace(b"Small", b"\x1b[31mSmall")),
    Entry("random bytes", ["case.toml:1:", "not TOML"], text=bytes((n * n * 31 + n * 7) % 251 for n in range(100000))),
    Entry("a restart file as the case", ["case.toml:", "not TOML", "not text"], text="",
          given=("good/restart_0000000004.h5 as case.toml",)),
    Entry("a picture as the case", ["case.toml:", "not TOML", "not text"], text=b"\x89PNG\r\n\x1a\n" + bytes(64)),
    Entry("100 MB of garbage", ["case.toml: cannot be read", "100 MB long"], files={"case.toml": hundred_megabytes(b"xyz\0")},
          text=""),
    Entry("100 MB that begin well", ["case.toml: cannot be read", "100 MB long"], files={"case.toml": hundred_megabytes(b"[time]\n")}, text=""),
    Entry("arrays nested 100000 deep", ["case.toml:", "not TOML"], text="x = " + "[" * 100_000),
    Entry("tables nested 10000 deep", ["case.toml:1:"], text="x = " + "{a=" * 10_000),
    Entry("dotted key of 100000 parts", ["case.toml:1:"], text=".".join(["a"] * 100_000) + " = 1\n" + DUNE),
    Entry("header of 100000 parts", ["case.toml:"], text=DUNE + "[" + ".".join(["a"] * 100_000) + "]\n"),
    Entry("100000 unknown keys", ["case.toml:2:", "unknown key", "and 99973 more"], problems=100_003,
          text="[time]\n" + "".join(f"k{n} = 1\n" for n in range(100_000))),
    Entry("cut in the middle", ["not TOML", "case.toml:"], text=DUNE[: DUNE.index("first_cell") + 14]),
    Entry("a merge conflict", ["case.toml:", "not TOML"], {"end = 0.01": "<<<<<<< HEAD\nend = 0.01\n=======\nend = 0.02\n>>>>>>> b"}),
    Entry("non-breaking space", ["@end", "not TOML"], {"end = 0.01": "end\u00a0= 0.01"}),
    Entry("typographic quotes", ["@title", "not TOML"], {'"Small coupled case"': "\u201cSmall\u201d"}),
    Entry("minus sign of a word processor", ["@grain_step", "not TOML"], {"grain_step = 5e-6": "grain_step = 5e\u22126"}),
    Entry("no such file", ["nowhere.toml", "No such file"], command="run nowhere.toml --out out"),
    Entry("a folder as the case", ["case.toml", "folder"], files={"case.toml": folder}, text=""),
    Entry("/dev/null as the case", ["/dev/null", "not a file but a device"], command="run /dev/null --out out"),
    Entry("/dev/zero as the case", ["/dev/zero", "not a file"], command="run /dev/zero --out out", limit=10),
    Entry("a FIFO as the case", ["case.toml", "not a file"], files={"case.toml": fifo}, text="", limit=10),
    Entry("a broken link as the case", ["case.toml", "No such file"], files={"case.toml": link_to("gone.toml")}, text=""),
    Entry("a link to itself as the case", ["case.toml", "Too many levels"], files={"case.toml": link_to("case.toml")}, text=""),
    # Strange, but TOML and text all the same.
    Entry("byte order mark", [], text=b"\xef\xbb\xbf" + DUNE.encode(), command="check case.toml", code=0),
    Entry("Windows line ends", [], text=DUNE.replace("\n", "\r\n"), command="check case.toml", code=0),
    Entry("no newline at the end", [], text=DUNE.rstrip("\n"), command="check case.toml", code=0),
    Entry("tabs for indents", [], text=DUNE.replace("\nend", "\n\t\tend"), command="check case.toml", code=0),
    Entry("old Macintosh line ends", ["case.toml:1:", "not TOML"], text=DUNE.replace("\n", "\r")),
]
