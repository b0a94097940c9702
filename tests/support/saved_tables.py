"""Results of tests/scripts/nightly/cfdem.py as tables for the figure of docs/validation.md."""
import datetime
import json
import pathlib
import sys

import beside_cfdem as beside

sys.path.append(str(pathlib.Path(__file__).resolve().parents[2] / "python"))
from validation import tables


def write(folder, states, drops, heap_run, heap):
    """Of the held grains, the bed of the tutorial and the heap in flow."""
    folder.mkdir(parents=True, exist_ok=True)
    commit = json.loads((heap_run / "run.json").read_text())["git_hash"]
    notes = {"test": "script.nightly.cfdem",
             "command": "BARCHAN_RESULTS=docs/validation ./barchan test -L nightly -R cfdem", "commit": commit,
             "machine": tables.machine(), "date": datetime.date.today().isoformat()}

    def table(name, rows):
        lines = [",".join(rows[0])] + [",".join(f"{v:.6g}" if isinstance(v, float) else str(v) for v in row.values())
                                       for row in rows]
        tables.write(folder / f"beside_cfdem_{name}.csv", notes, lines)

    def classes(name, state):
        """Drag and the other forces by height."""
        y, ends = state.x[:, 1], beside.HELD[name][1]
        for (low, n, drag, sd), (*_, rest, _) in zip(beside.by_height(y, state.drag, ends),
                                                     beside.by_height(y, state.rest, ends)):
            yield {"case": name, "low": float(low), "n": n, "drag": float(drag), "sd": float(sd), "rest": float(rest)}

    table("forces", [row for name, state in states.items() for row in classes(name, state)])
    table("ergun", [{"superficial": u, "drop": drop} for u, drop in drops])
    table("heap", list(heap.series()))
    table("velocity", list(heap.profile()))
