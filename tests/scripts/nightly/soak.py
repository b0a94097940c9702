#!/usr/bin/python3
"""As many fluid steps as a day on two cores gives the paper's dune (BARCHAN_SOAK_STEPS: 80,000, of 100 grain steps each)
with a heap small enough for minutes, in one go and, beside it, in pieces that end by a signal, a kill or the
wall-clock limit and go on from restart files. Both must end with the same bits; memory stays flat, the ledger closes
and no grain is lost."""
import os
import pathlib
import random
import signal
import time

import faults


def settings(steps):
    return {"time.end": steps * 2.5e-4, "time.grain_step": 2.5e-6, "grains.boundary_x": "periodic",
            "restart.interval": steps * 2.5e-4 / 200, "output.grains_interval": steps * 2.5e-4 / 40,
            "output.fields_interval": steps * 2.5e-4 / 40, "output.tracks_interval": steps * 2.5e-4 / 40,
            "output.dune_interval": 0.025, "output.history_interval": 0.025}


def resident_kb(process):
    for line in pathlib.Path(f"/proc/{process.pid}/status").read_text().splitlines():
        if line.startswith("VmRSS"):
            return int(line.split()[1])
    return 0


class Pieces:
    """The run in pieces: a new piece whenever the last has ended, until the end is reached."""

    def __init__(self, folder, case, piece_seconds):
        self.folder, self.case, self.piece_seconds = folder, case, piece_seconds
        self.ends = {"SIGTERM": 0, "SIGINT": 0, "SIGKILL": 0, "limit": 0}
        self.done = False
        self.next()

    def next(self):
        self.way = random.choice(sorted(self.ends))
        seconds = self.piece_seconds * random.uniform(0.5, 1.5)
        case = {**self.case, "time.wall_clock_limit": seconds if self.way == "limit" else 0}
        self.process = faults.start(self.folder, case, faults.last_restart(self.folder))
        self.until = time.monotonic() + (1e9 if self.way == "limit" else seconds)

    def look(self):
        if self.process.poll() is None:
            if time.monotonic() > self.until:
                self.process.send_signal(getattr(signal, self.way))
                self.until = 1e18
            return
        said, status = self.process.stderr.read(), self.process.returncode
        if status == 0:
            self.done = True
        elif status in (3, -signal.SIGKILL):
            self.ends[self.way] += 1
            self.next()
        else:
            faults.fail(f"a piece ended with {status}: {said}")


def main(work):
    steps = int(os.environ.get("BARCHAN_SOAK_STEPS", "80000"))
    random.seed(3)
    begin = time.monotonic()
    trial = faults.run(work / "trial", {**settings(steps), "time.end": 0.125})
    faults.expect(trial, 0)
    duration = (time.monotonic() - begin) * steps / 500
    print(f"{steps} fluid steps of 100 grain steps, about {duration / 60:.0f} min", flush=True)
    whole = faults.start(work / "whole", settings(steps))
    pieces = Pieces(work / "pieces", settings(steps), duration / 24)
    memory = []
    while whole.poll() is None or not pieces.done:
        if whole.poll() is None:
            memory.append(resident_kb(whole))
        if not pieces.done:
            pieces.look()
        time.sleep(0.05)
    if whole.returncode != 0:
        faults.fail(f"the whole ended with {whole.returncode}: {whole.stderr.read()}")
    faults.same_run(work / "whole", work / "pieces")
    summary = faults.summary(work / "whole")
    ledger = summary["ledger"]
    worst = max(value for key, value in ledger.items() if key.startswith("largest_"))
    off = max(abs(ledger[f"impulse_given_to_grains_{a}"] - ledger[f"impulse_taken_from_fluid_{a}"]) for a in "xyz")
    exchanged = max(abs(ledger[f"impulse_given_to_grains_{a}"]) for a in "xyz")
    after_tenth = [kb for kb in memory[len(memory) // 10:] if kb]
    growth = max(after_tenth) / after_tenth[0] - 1
    print(f"pieces ended by {pieces.ends}; same bits as in one go. Memory {after_tenth[0]} kB after a tenth, at most "
          f"{growth:+.2%} later; ledger off by {off / exchanged:.2g} of what was exchanged, in one step at most "
          f"{worst:.2g}; largest overlap {summary['max_overlap']:.2%}, CFL {summary['max_cfl']:.2f}; grains "
          f"{summary['grains_inside']} of {summary['grains_initial']}")
    if growth > 0.01 or off > 1e-12 * exchanged or summary["grains_inside"] != summary["grains_initial"]:
        faults.fail("memory, ledger or grains")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
