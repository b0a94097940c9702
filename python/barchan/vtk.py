"""Files of a run for VTK and ParaView, VTKHDF, that link to its results: barchan vtk RUN_DIR ...

Exit status: 0 done, 1 a file cannot be written, 2 bad input (no such folder, no frames in it).
"""

import argparse
import sys
from collections.abc import Sequence

from barchan.errors import BarchanError
from barchan.io import vtkhdf
from barchan.io.run_folder import RunFolder


def main(arguments: Sequence[str]) -> int:
    parser = argparse.ArgumentParser(prog="vtk", description="Writes RUN_DIR/vtkhdf: files for VTK and ParaView, one a "
                                     "frame, that link to grains.h5 and fields.h5 and must stay beside them.")
    parser.add_argument("run_dirs", metavar="RUN_DIR", nargs="+")
    for folder in parser.parse_args(arguments).run_dirs:
        try:
            for series in vtkhdf.write(RunFolder(folder)):
                print(series)
        except BarchanError as error:
            print(f"vtk: {folder}: {error}", file=sys.stderr)
            return 2
        except OSError as error:
            print(f"vtk: cannot write {error.filename or folder}: {error.strerror or error}", file=sys.stderr)
            return 1
    return 0
