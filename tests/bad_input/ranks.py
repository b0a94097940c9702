"""Several ranks: numbers that do not fit, and that bad input is told once."""

from entry import DRY, DUNE, TABLE, Entry, grains_csv

ENTRIES = [
    Entry("ranks: more than columns", ["--ranks", "3 ranks cannot share 3 x 2", "the next smaller number"],
          {"cells = [10, 14, 6]": "cells = [3, 14, 2]"}, ranks=3),
    Entry("ranks: a prime that does not fit", ["--ranks", "7 ranks", "the next smaller number that can is"], ranks=7),
    Entry("ranks: bad key told once", ["@grain_stpe", 'did you mean "grain_step"'], {"grain_step": "grain_stpe"}, ranks=2),
    Entry("ranks: not TOML told once", ["@[fluid", "not TOML"], {"[fluid]": "[fluid"}, ranks=2),
    Entry("ranks: no case", ["nowhere.toml", "No such file"], command="run nowhere.toml --out out", ranks=2),
    Entry("ranks: bad option told once", ["--threads"], command="run case.toml --threads 0", ranks=2),
    Entry("ranks: bad table told once", ["grains.csv:1:", "unknown column"], base=TABLE, files={"grains.csv": "a,b\n1,2\n"}, ranks=2),
    Entry("ranks: overlaps told once", ["grains.csv", "overlap"], base=TABLE, ranks=2,
          files={"grains.csv": grains_csv([(n, 2e-4, 0.006, 0.001 + 1e-5 * n, 0.003) for n in range(1, 6)])}),
    Entry("ranks: damaged restart told once", ["restart_0000000004.h5", "damaged"], given=("good as out",), ranks=2,
          files={"out/restart_0000000004.h5": lambda path: path.write_bytes(path.read_bytes()[:-9] + bytes(9) + b"more")},
          command="run case.toml --quiet --out out --restart out/restart_0000000004.h5"),
    Entry("ranks: restart of another mesh told once", ["fluid.cells", "written with"], {"cells = [10,": "cells = [12,"}, ranks=2,
          given=("good as out",), command="run case.toml --quiet --out out --restart out/restart_0000000004.h5"),
    Entry("ranks: --out is a file", ["out", "a file, not a folder", "another --out"], files={"out": "mine\n"}, ranks=2),
]
