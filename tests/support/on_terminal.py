#!/usr/bin/env python3
"""Runs a program on a terminal of its own, 40 columns wide: on_terminal.py PROGRAM [ARGUMENT...]

What it shows goes to standard output as it is, with the control characters; its exit status is ours.
"""

import fcntl
import os
import pty
import struct
import sys
import termios


def main():
    child, terminal = pty.fork()
    if child == 0:
        fcntl.ioctl(0, termios.TIOCSWINSZ, struct.pack("HHHH", 20, 40, 0, 0))
        os.execvp(sys.argv[1], sys.argv[1:])
    while True:
        try:
            shown = os.read(terminal, 65536)
        except OSError:  # how a terminal says that nobody holds it any more
            break
        if not shown:
            break
        os.write(1, shown)
    return os.waitstatus_to_exitcode(os.waitpid(child, 0)[1])


sys.exit(main())
