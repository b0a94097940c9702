#!/usr/bin/python3
"""On a terminal a run keeps one live line, cut to the width and written over; the log stays free of it, and --quiet
shows none."""

import fcntl
import os
import pty
import re
import struct
import termios

import faults

CLEAR = b"\r\033[K"


def shown_on_terminal(folder, *options):
    """What a run of a second or more shows on a terminal of its own, 40 columns wide, control characters and all."""
    child, terminal = pty.fork()
    if child == 0:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", 20, 40, 0, 0))
        os.execv(faults.PROGRAM, [faults.PROGRAM, "run", str(faults.CASE), "--set", "time.end=0.2", "--threads", "1",
                                  "--out", str(folder), *options])
    shown = b""
    try:
        while piece := os.read(terminal, 65536):
            shown += piece
    except OSError:  # how a terminal says that nobody holds it any more
        pass
    status = os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])
    if status != 0:
        faults.fail(f"exit code {status}: {shown}")
    return shown


def main(work):
    shown = shown_on_terminal(work / "run")
    # What stands between two clearings without a line end is a live line.
    lines = [piece.decode() for piece in shown.split(CLEAR)[1:-1] if b"\n" not in piece]
    longest = max(map(len, lines), default=0)
    if not 20 < longest < 40:
        faults.fail(f"a live line of {longest} characters on 40 columns: {shown}")
    if not shown.endswith(b"\r\n"):
        faults.fail(f"what follows would stand in the live line: {shown}")
    if re.search(rb"[\r\033]", (work / "run" / "log.txt").read_bytes()):
        faults.fail("log.txt has control characters")
    if CLEAR in shown_on_terminal(work / "run", "--quiet"):
        faults.fail("--quiet has a live line")
    print(f"live line: {len(lines)} lines were written over")


if __name__ == "__main__":
    faults.in_a_new_folder(main)
