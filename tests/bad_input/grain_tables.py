"""CSV files of grains."""

from entry import DUNE, TABLE, Entry, grains_csv

GOOD = grains_csv()
HEADER = "id,diameter,x,y,z\n"


def grain(text, line=3):
    """The good table with another line."""
    lines = GOOD.splitlines()
    lines[line - 1] = text
    return "\n".join(lines) + "\n"


def csv(name, text, says, **more):
    return Entry(name, says, base=TABLE, files={"grains.csv": text}, **more)


ENTRIES = [
    csv("table: empty", "", ["grains.csv", "it is empty", "id,diameter,x,y,z"]),
    csv("table: one byte order mark", b"\xef\xbb\xbf", ["grains.csv", "it is empty"]),
    csv("table: comments alone", "# a\n# b\n", ["grains.csv", "it is empty"]),
    csv("table: header alone", HEADER, ["grains.csv:1:", "no grains"]),
    csv("table: no header", GOOD.partition("\n")[2], ["grains.csv:1:", "header", "id,diameter,x,y,z"]),
    csv("table: semicolons", GOOD.replace(",", ";"), ["grains.csv:1:", "commas", "semicolons"]),
    csv("table: semicolons and decimal commas", GOOD.replace(",", ";").replace(".", ","), ["grains.csv:1:", "semicolons"]),
    csv("table: tabs", GOOD.replace(",", "\t"), ["grains.csv:1:", "commas", "tabs"]),
    csv("table: spaces", GOOD.replace(",", " "), ["grains.csv:1:", "commas", "spaces"]),
    csv("table: decimal commas", grain("2,0,0002,0,0043,0,0004,0,003"), ["grains.csv:3:", "9 values", "5 columns", "decimal commas"]),
    csv("table: quoted decimal commas", grain('2,"0,0002","0,0043","0,0004","0,003"'), ["grains.csv:3:", "quotes"]),
    csv("table: quoted titles", GOOD.replace("id,diameter,x,y,z", '"id","diameter","x","y","z"'), ["grains.csv:1:", "without quotes"]),
    csv("table: quoted numbers", grain('"2","2e-4","0.0043","0.0004","0.003"'), ["grains.csv:3:", "id", "without quotes"]),
    csv("table: missing column", GOOD.replace("diameter", "vx"), ["grains.csv:1:", '"diameter" is missing']),
    csv("table: radius for diameter", GOOD.replace("diameter", "radius"), ["grains.csv:1:", 'unknown column "radius"', "diameter"]),
    csv("table: upper-case titles", GOOD.replace("id,diameter", "ID,Diameter"), ["grains.csv:1:", 'unknown column "ID"', 'did you mean "id"']),
    csv("table: units in titles", GOOD.replace("diameter", "diameter [m]"), ["grains.csv:1:", 'unknown column "diameter [m]"',
                                                                              'did you mean "diameter"']),
    csv("table: empty title", GOOD.replace("id,diameter", "id,,diameter"), ["grains.csv:1:", "column 2 has no name"]),
    csv("table: column twice", GOOD.replace("x,y,z", "x,x,z"), ["grains.csv:1:", '"x" appears twice']),
    csv("table: an unknown column", GOOD.replace("x,y,z", "x,y,z,colour"), ["grains.csv:1:", 'unknown column "colour"']),
    csv("table: too few values", grain("2,2e-4,0.0043"), ["grains.csv:3:", "3 values", "5 columns"]),
    csv("table: too many values", grain("2,2e-4,0.0043,4e-4,0.003,7"), ["grains.csv:3:", "6 values", "5 columns"]),
    csv("table: an empty field", grain("2,,0.0043,4e-4,0.003"), ["grains.csv:3:", "diameter", "must be a number"]),
    csv("table: last line cut", GOOD[:-10], ["grains.csv:21:", "values"]),
    csv("table: text for a number", grain("2,2e-4,left,4e-4,0.003"), ["grains.csv:3:", 'x = "left"', "must be a number"]),
    csv("table: number with unit", grain("2,0.2mm,0.0043,4e-4,0.003"), ["grains.csv:3:", 'diameter = "0.2mm"', "must be a number"]),
    csv("table: NaN", grain("2,2e-4,nan,4e-4,0.003"), ["grains.csv:3:", "x = nan", "finite"]),
    csv("table: NaN of a spreadsheet", grain("2,2e-4,#N/A,4e-4,0.003"), ["grains.csv:3:", "#N/A", "must be a number"]),
    csv("table: infinite", grain("2,2e-4,0.0043,inf,0.003"), ["grains.csv:3:", "y = inf", "finite"]),
    csv("table: 1e400", grain("2,1e400,0.0043,4e-4,0.003"), ["grains.csv:3:", "diameter = ", "1e400"]),
    csv("table: hexadecimal", grain("2,0x1p-12,0.0043,4e-4,0.003"), ["grains.csv:3:", "must be a number"]),
    csv("table: diameter of 0", grain("2,0,0.0043,4e-4,0.003"), ["grains.csv:3:", "diameter", "above 0"]),
    csv("table: negative diameter", grain("2,-2e-4,0.0043,4e-4,0.003"), ["grains.csv:3:", "diameter", "above 0"]),
    csv("table: diameter of 1e-300", grain("2,1e-300,0.0043,4e-4,0.003"), ["grains.csv", "time.grain_step must be at most"]),
    csv("table: id with a fraction", grain("2.5,2e-4,0.0043,4e-4,0.003"), ["grains.csv:3:", "id", "whole number"]),
    csv("table: id as a float", grain("2.0,2e-4,0.0043,4e-4,0.003"), ["grains.csv:3:", "id", "whole number"]),
    csv("table: negative id", grain("-2,2e-4,0.0043,4e-4,0.003"), [], code=0),
    csv("table: id beyond 64 bits", grain("99999999999999999999,2e-4,0.0043,4e-4,0.003"), ["grains.csv:3:", "id", "at most"]),
    csv("table: huge id", grain("9223372036854775807,2e-4,0.0043,4e-4,0.003"), [], code=0),
    csv("table: id twice", grain("1,2e-4,0.0043,4e-4,0.003"), ["grains.csv:3:", "id 1", "line 2"]),
    csv("table: outside along x", grain("2,2e-4,0.0143,4e-4,0.003"), ["grains.csv", "grain 2", "outside the domain", "domain.size"]),
    csv("table: outside along z", grain("2,2e-4,0.0043,4e-4,-0.009"), ["grains.csv", "grain 2", "outside the domain"]),
    csv("table: above the top", grain("2,2e-4,0.0043,0.1,0.003"), ["grains.csv", "grain 2", "outside the domain"]),
    csv("table: far outside", grain("2,2e-4,1e300,4e-4,0.003"), ["grains.csv", "grain 2", "outside the domain"]),
    csv("table: all in mm", grains_csv([(n, 0.2, 4 + 0.3 * n, 0.4, 3.0) for n in range(9)]), ["grains.csv", "wider than the domain", "0.2 mm is 2e-4"]),
    csv("table: diameters in mm", grains_csv([(1, 0.2, 0.004, 4e-4, 0.003)]), ["grains.csv", "0.2 m, wider than the domain", "0.2 mm is 2e-4"]),
    csv("table: x for z", grains_csv([(n, 2e-4, 3e-3, 0.003, 4e-3 + 2e-3 * n) for n in range(9)]), ["grains.csv", "outside the domain"]),
    csv("table: below the floor", grain("2,2e-4,0.0043,-5e-4,0.003"), ["grains.csv", "grain 2", "outside the domain"]),
    csv("table: inside the floor", grain("2,2e-4,0.0043,0,0.003"), ["grains.csv", "grain 2", "the floor"]),
    csv("table: on top of each other", grain("2,2e-4,0.004,4e-4,0.003"), ["grains.csv", "overlap", "grain 1", "grain 2"]),
    csv("table: half in each other", grain("2,2e-4,0.0041,4e-4,0.003"), ["grains.csv", "overlap by 50.0 %", "grain 2"]),
    csv("table: at the speed of light", GOOD.replace("y,z\n", "y,z,vx\n").replace("0.003\n", "0.003,3e8\n"), ["grains.csv", "grain", "m/s", "grain_step"]),
    csv("table: infinite speed", GOOD.replace("y,z\n", "y,z,vx\n").replace("0.003\n", "0.003,1e999\n"), ["grains.csv:2:", "vx", "1e999"]),
    csv("table: NUL bytes", grain("2,2e-4\0,0.0043,4e-4,0.003"), ["grains.csv:3:", "must be a number"]),
    csv("table: UTF-16", GOOD.encode("utf-16"), ["grains.csv:1:", "UTF-8"]),
    csv("table: an HDF5 file", b"\x89HDF\r\n\x1a\n" + bytes(100), ["grains.csv:1:", "HDF5", ".h5"]),
    csv("table: a spreadsheet", b"PK\x03\x04" + bytes(range(256)) * 8, ["grains.csv:1:", "not text"]),
    csv("table: 50 MB of garbage", b"xyz\0" * 12_500_000, ["grains.csv:1:", "not text"]),
    csv("table: a dune.csv", "t,dune,n_grains,W,L,H\n0,0,200,1,1,1\n", ["grains.csv:1:", 'unknown column "t"']),
    csv("table: a web page", "<!DOCTYPE html>\n<html><body>404</body></html>\n", ["grains.csv:1:", "header", "id,diameter,x,y,z"]),
    csv("table: smallest grain too small for the step", grain("2,2e-6,0.0043,4e-4,0.003"), ["grains.csv", "time.grain_step must be at most"]),
    csv("table: grain wider than the channel", grain("2,8e-3,0.0043,3e-3,0.003"), ["grains.csv", "0.008 m, wider than the domain"]),
    csv("table: grain wider than a third of it", grain("2,2.5e-3,0.0043,3e-3,0.003"), ["grains.csv", "its own image"]),
    # Strange, but a table all the same.
    csv("table: Windows line ends", GOOD.replace("\n", "\r\n"), [], code=0),
    csv("table: byte order mark", b"\xef\xbb\xbf" + GOOD.encode(), [], code=0),
    csv("table: no newline at the end", GOOD.rstrip("\n"), [], code=0),
    csv("table: spaces around", GOOD.replace(",", " , "), [], code=0),
    csv("table: blank lines and comments", GOOD.replace("\n", "\n\n# x\n"), [], code=0),
    csv("table: columns in another order", grains_csv([(0.003, 4e-4, 0.004, 2e-4, 7)], "z,y,x,diameter,id"), [], code=0),
    csv("table: one grain", HEADER + "1,2e-4,0.004,4e-4,0.003\n", [], code=0),
    csv("table: old Macintosh line ends", GOOD.replace("\n", "\r"), ["grains.csv:1:", "line ends"]),
]
for _entry in ENTRIES:
    if _entry.code == 0:
        _entry.edits = {"end = 0.01": "end = 5e-4"}
