"""Barchan in Python: runs, studies and figures.

    import barchan

    run = barchan.open("runs/quickstart")
    run.dunes                    # a pandas.DataFrame; attrs["units"]
    run.fields                   # an xarray.Dataset over time, z, y and x, read where it is used
    run.figure("morphology")     # a matplotlib Figure

docs/results.md has the first hour. SI units throughout.
"""

from importlib.util import find_spec
from sys import executable

_lacking = [name for name in ("numpy", "h5py", "matplotlib") if find_spec(name) is None]
if _lacking:
    raise ImportError(f"{executable} has no {', '.join(_lacking)}: use /usr/bin/python3, or install them there")
del find_spec, executable, _lacking

from barchan.errors import BadInput, BarchanError, MissingData, RunFailed, RunStopped
from barchan.api.dunes import find_dunes
from barchan.api.program import check, run, sweep
from barchan.api.run import Run
from barchan.api.run import open_folder as open  # the name that users look for  # noqa: A004
from barchan.api.study import Study

__version__ = "0.3.0"
__all__ = ["BadInput", "BarchanError", "MissingData", "Run", "RunFailed", "RunStopped", "Study", "check", "find_dunes",
           "open", "run", "sweep"]
