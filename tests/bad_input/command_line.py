"""The program's options."""

from entry import DUNE, Entry

SET = "check case.toml --set "


def line(name, command, says, **more):
    return Entry(name, says, command=command, **more)


ENTRIES = [
    line("no command", "''", ["unknown command", "run, check, info"]),
    line("a misspelt command", "rnu case.toml", ['unknown command "rnu"', 'did you mean "run"']),
    line("the case alone", "case.toml", ["unknown command", "run, check, info"]),
    line("no case", "run", ["CONFIG", "required"]),
    line("an empty case name", "run ''", ["CONFIG", "no name was given"]),
    line("two cases", "run case.toml other.toml", ["other.toml"]),
    line("an unknown option", "run case.toml --outt out", ["--outt", "did you mean --out?"]),
    line("a short option", "run case.toml -o out", ["-o"]),
    line("an option without its value", "run case.toml --out", ["--out"]),
    line("--out empty", "run case.toml --out ''", ["--out", "empty"]),
    line("--threads 0", "run case.toml --out out --threads 0", ["--threads", "1", "4096"]),
    line("--threads -1", "run case.toml --out out --threads -1", ["--threads", "1", "4096"]),
    line("--threads of a million", "run case.toml --out out --threads 1000000", ["--threads", "4096"]),
    line("--threads two", "run case.toml --out out --threads two", ["--threads", "two"]),
    line("--threads 1.5", "run case.toml --out out --threads 1.5", ["--threads", "1.5"]),
    line("--patience forever", "run case.toml --out out --patience forever", ["--patience", "forever"]),
    line("--patience -1", "run case.toml --out out --patience -1", ["--patience"]),
    line("--ranks to the program", "run case.toml --out out --ranks 2", ["--ranks", "mpirun"]),
    line("--set without a key", SET + "=3", ["--set", "key=value"]),
    line("--set without an equals sign", SET + "grains.density", ["--set grains.density", "key=value"]),
    line("--set without a section", SET + "density=3", ["--set density", "density", "of [fluid]"]),
    line("--set with an empty part", SET + "grains..density=3", ["--set grains..density", "empty"]),
    line("--set with points alone", SET + "...=3", ["--set ...", "empty"]),
    line("--set of a key misspelt", SET + "grains.restitutoin=0.3", ["--set grains.restitutoin", 'did you mean "restitution"']),
    line("--set of a section", SET + "grains=3", ["--set grains", "must be a section, [grains]"]),
    line("--set below a value", SET + "time.end.s=3", ["--set time.end.s", '"time.end" is not a section']),
    line("--set without a value", SET + "grains.restitution=", ["--set grains.restitution", "must be a number"]),
    line("--set of a wrong type", SET + "grains.restitution=high", ["--set grains.restitution", "must be a number"]),
    line("--set out of range", SET + "grains.restitution=2", ["--set grains.restitution", "at most 1"]),
    line("--set of two lines", SET + "'grains.restitution=0.1\nrestitution=0.2'", ["--set grains.restitution"]),
    line("--set with control characters", SET + "'grains.\x1b[31m=1'", ["--set", "unknown key"]),
    line("--set with a word after", SET + "time.end=1 2", ["2"]),
    line("--set 60000 parts deep", None, ["--set a.a.a", "unknown key"]),
    line("--set that contradicts", SET + "fluid.pressure_gradient=3", ["--set fluid.pressure_gradient", "give one of the two"]),
    line("--set in a broken file", SET + "time.end=3", ["@[fluid", "not TOML"], edits={"[fluid]": "[fluid"}),
    line("three wrong --set", SET + "time.ende=3 --set grains.restitution=3 --set x", ["time.ende", "grains.restitution", "--set x"], problems=3),
    line("OMP_NUM_THREADS of rubbish", "run case.toml --out out", [], env={"OMP_NUM_THREADS": "many", "OMP_THREAD_LIMIT": "1"}, edits={"end = 0.01": "end = 5e-4"},
         code=0),
    line("OMP_NUM_THREADS of 0", "run case.toml --out out", [], env={"OMP_NUM_THREADS": "0", "OMP_THREAD_LIMIT": "1"}, edits={"end = 0.01": "end = 5e-4"}, code=0),
    line("OMP_NUM_THREADS negative", "run case.toml --out out", [], env={"OMP_NUM_THREADS": "-3", "OMP_THREAD_LIMIT": "1"}, edits={"end = 0.01": "end = 5e-4"}, code=0),
    line("KOKKOS_NUM_THREADS of rubbish", "run case.toml --out out", ["KOKKOS_NUM_THREADS", "many", "--threads"], env={"KOKKOS_NUM_THREADS": "many"}),
    line("KOKKOS_NUM_THREADS of 0", "run case.toml --out out", ["KOKKOS_NUM_THREADS", "--threads"], env={"KOKKOS_NUM_THREADS": "0"}),
    line("a locale that is not there", "run case.toml --out out", [], env={"LC_ALL": "xx_XX.UTF-9"}, edits={"end = 0.01": "end = 5e-4"}, code=0),
    line("--help", "run --help", ["--restart"], code=0),
    line("--version", "--version", ["barchan"], code=0),
    line("--dry-run writes nothing", "run case.toml --out out --dry-run", ["nothing was run"], code=0),
]
for _entry in ENTRIES:
    if _entry.command is None:
        _entry.command = SET + ".".join(["a"] * 60_000) + "=1"
