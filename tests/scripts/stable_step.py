"""The stable grain step that a run writes is that of all contacts of its packing together, within 15 %."""

import os
import subprocess
import sys
import tempfile
from pathlib import Path

from exact_stable_step import compare


def compared(tangential_damping):
    """Run's limit over the exact one."""
    with tempfile.TemporaryDirectory() as folder:
        run = Path(folder) / "heap"
        command = [os.environ["BARCHAN_PROGRAM"], "run", "configs/heap-3k.toml", "--quiet", "--out", run]
        keys = ["--set", "time.end=0.12", "--set", f"grains.tangential_damping={tangential_damping}"]
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        subprocess.run([*command, *keys], check=True, stdout=subprocess.DEVNULL, env=environment)
        exact, written = compare(run)
        print(f"tangential damping {tangential_damping}: {exact:.4g} s, in history.csv {written:.4g} s")
        return written / exact


sys.exit(0 if all(abs(compared(damping) - 1) < 0.15 for damping in (1, 0.25)) else 1)
