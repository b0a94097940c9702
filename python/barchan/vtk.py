"""Files of a run for VTK and ParaView, VTKHDF, that link to its results: barchan vtk [--temporal] RUN_DIR ...

Exit status: 0 done, 1 a file cannot be written, 2 bad input (no such folder, no frames in it).
"""

import argparse
import sys
from collections.abc import Sequence

from barchan.dune.bodies import bodies_of
from barchan.dune.body_surface import surface_of
from barchan.errors import BarchanError
from barchan.io import vtkhdf, vtkhdf_in_time
from barchan.io.run_folder import RunFolder


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="vtk", description="Writes RUN_DIR/vtkhdf: files for VTK and ParaView, one a "
                                     "frame, that link to grains.h5 and fields.h5 and must stay beside them.")
    parser.add_argument("run_dirs", metavar="RUN_DIR", nargs="+")
    parser.add_argument("--temporal", action="store_true", help="one file with all frames in place of one a frame: "
                        "VTKHDF 2.0, for VTK 9.3, ParaView 5.12 and newer")
    options = parser.parse_args(arguments)
    write = vtkhdf_in_time.write if options.temporal else vtkhdf.write
    for folder in options.run_dirs:
        try:
            run = RunFolder(folder)
            for path in write(run, surface_of(bodies_of(run))):
                print(path)
        except BarchanError as error:
            print(f"vtk: {folder}: {error}", file=sys.stderr)
            return 2
        except OSError as error:
            print(f"vtk: cannot write {error.filename or folder}: {error.strerror or error}", file=sys.stderr)
            return 1
    return 0
