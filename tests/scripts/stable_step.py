"""The stable grain step that a run writes is that of all contacts of its packing together, within 15 %."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from exact_stable_step import compare

with tempfile.TemporaryDirectory() as folder:
    run = Path(folder) / "heap"
    command = [os.environ["BARCHAN_PROGRAM"], "run", "configs/heap-3k.toml", "--quiet", "--out", run]
    subprocess.run([*command, "--set", "time.end=0.12"], check=True, stdout=subprocess.DEVNULL,
                   env={**os.environ, "OMP_NUM_THREADS": "1"})
    exact, written = compare(run)
    print(f"{exact:.4g} s, in history.csv {written:.4g} s")
    sys.exit(0 if abs(written / exact - 1) < 0.15 else 1)
