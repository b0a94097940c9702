"""What the launcher calls: python -m barchan plot, vtk, watch, list or sweep, and their arguments."""

import os
import sys


def main() -> int:
    command, arguments = (sys.argv[1] if len(sys.argv) > 1 else ""), sys.argv[2:]
    try:
        if command == "plot":
            from barchan import plot

            return plot.main(arguments)
        if command == "vtk":
            from barchan import vtk

            return vtk.main(arguments)
        if command == "watch":
            from barchan import watch

            return watch.main(arguments)
        if command == "list":
            from barchan import listing

            return listing.main(arguments)
        if command == "sweep":
            from barchan.studies import sweep

            return sweep.main(arguments)
    except KeyboardInterrupt:
        return 3
    except BrokenPipeError:  # the reader of the output has seen enough, as `head` does
        os.dup2(os.open(os.devnull, os.O_WRONLY), sys.stdout.fileno())
        return 0
    print("usage: python -m barchan plot RUN_DIR [FIGURE ...] | vtk RUN_DIR | watch RUN_DIR | list [FOLDER] | "
          "sweep PROGRAM STUDY.toml [...]", file=sys.stderr)
    return 2


if __name__ == "__main__":
    sys.exit(main())
