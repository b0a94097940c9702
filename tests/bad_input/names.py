"""Names with spaces, accents, quotes, line ends: they work, and messages show them."""

from entry import DUNE, TABLE, Entry, grains_csv

SHORT = DUNE.replace("end = 0.01", "end = 5e-4")
BAD = DUNE.replace("end = 0.01", "end = -1")


def named(name, file, **more):
    """The case under this name: a good one runs, a bad one is told with its name."""
    quoted = "'" + file.replace("'", "'\\''") + "'"
    return [Entry(f"{name}, good", [], text="", files={file: SHORT}, command=f"run {quoted} --quiet --out 'out {name}'", code=0, **more),
            Entry(f"{name}, bad", [file.replace("\n", "\\n") + ":5:", "must be above 0"], text="", files={file: BAD}, command=f"run {quoted} --quiet", **more)]


ENTRIES = [
    *named("a space in the name", "my case.toml"),
    *named("accents in the name", "düne à côté.toml"),
    *named("another alphabet in the name", "дюна 沙丘.toml"),
    *named("quotes in the name", "it's \"mine\".toml"),
    *named("a percent sign in the name", "50%s {} %n.toml"),
    *named("an equals sign in the name", "a=b.toml"),
    *named("a hyphen at the start", "./-case.toml"),
    *named("no ending", "case"),
    *named("two endings", "case.toml.bak"),
    *named("a long name", "n" * 200 + ".toml"),
    Entry("a line end in the name", ["two\\nlines.toml:5:"], text="", files={"two\nlines.toml": BAD}, command="run 'two\nlines.toml' --quiet"),
    Entry("a name that is not UTF-8", ["bad_\\xff.toml:5:"], text="", files={b"bad_\xff.toml".decode(errors="surrogateescape"): BAD},
          command="run 'bad_\udcff.toml' --quiet"),
    Entry("a table with a space in its name", [], base=TABLE.replace("grains.csv", "meine Körner.csv"),
          edits={"end = 0.01": "end = 5e-4"}, files={"meine Körner.csv": grains_csv()}, code=0),
    Entry("a bad table with a space in its name", ["meine Körner.csv:1:", "empty"], base=TABLE.replace("grains.csv", "meine Körner.csv"),
          files={"meine Körner.csv": ""}),
    Entry("a title of other letters", [], {'"Small coupled case"': '"Düne 沙丘 <b>&amp;\\"</b>"', "end = 0.01": "end = 5e-4"}, code=0),
]
