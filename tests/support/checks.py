"""What a script of checks found wrong, and its end."""
import sys

failures = []


def expect_near(what, value, expected, tolerance):
    """Within a part `tolerance` of what is expected."""
    if not abs(value - expected) <= tolerance * abs(expected):
        failures.append(f"{what}: {value:.6g}, not {expected:.6g}")


def end(name, held):
    """Says the failures, and what was checked."""
    for failure in failures:
        print(f"{name}: {failure}", file=sys.stderr)
    print(f"{name}: {held}")
    sys.exit(bool(failures))
