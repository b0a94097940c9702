"""What the plot command says when it cannot draw."""

import sys


def fail(message):
    """One line on standard error; returns the exit status of bad input."""
    note(message)
    return 2


def note(message):
    """One line on standard error."""
    print(f"plot: {message}", file=sys.stderr)
