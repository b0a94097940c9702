"""Measured values that must lie within ranges: each is printed, and what is not within is said again at the end."""

problems = []


def measured(what, value, low, high):
    print(f"[ measured ] {what}: {value:.5g} ({low:g} to {high:g})", flush=True)
    if not low <= value <= high:
        problems.append(f"{what} is {value:.5g}, not within {low:g} to {high:g}")


def status(name):
    """Exit status of the script of this name."""
    print("\n".join(problems) or f"{name}: all within bounds")
    return 1 if problems else 0
