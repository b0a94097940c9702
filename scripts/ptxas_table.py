#!/usr/bin/env python3
"""Prints what each kernel takes of a multiprocessor, for each architecture, from what `nvcc -Xptxas=-v` said.

usage: ptxas_table.py LOG [--expect ARCHITECTURE ...]

A kernel of the program that was compiled several times counts once, with the numbers of the last time. --expect ends
with exit code 1 if one of these architectures (sm_90 ...) has no kernel in the log.
"""
import argparse
import re
import subprocess
import sys

ENTRY = re.compile(r"Compiling entry function '(.*)' for '(sm_\w+)'$")
FRAME = re.compile(r"(\d+) bytes stack frame, (\d+) bytes spill stores, (\d+) bytes spill loads")
USED = re.compile(r"Used (\d+) registers")
LAUNCH = re.compile(r".*?Kokkos::Impl::Parallel(?:For|Reduce|Scan)<")
POLICY = re.compile(r", Kokkos::(Impl::)?(RangePolicy|MDRangePolicy|TeamPolicy|FunctorAnalysis|HostSpace).*")
NOISE = re.compile(r"barchan::|launch_detail::|\(anonymous namespace\)::|Kokkos::Impl::Combined[A-Za-z]*<|Kokkos::")
COLUMNS = ("registers", "stack", "spills")


def kernel_name(function):
    """What the program calls a kernel, of its demangled function; None if it is not one of the program's."""
    launched = LAUNCH.match(function)
    if not launched or "barchan::" not in function:
        return None
    name = NOISE.sub("", POLICY.sub("", function[launched.end():]))
    return None if name.startswith("Impl::") else name


def demangled(text):
    return subprocess.run(["c++filt"], input=text, capture_output=True, text=True, check=True).stdout


def read(text):
    """Kernel -> architecture -> (registers, bytes of stack, bytes spilled), of a demangled log."""
    kernels, name, architecture, frame = {}, None, "", (0, 0)
    for line in text.splitlines():
        if entry := ENTRY.search(line):
            name, architecture, frame = kernel_name(entry[1]), entry[2], (0, 0)
        elif found := FRAME.search(line):
            # A function that was not inlined has a line of its own after that of its kernel.
            frame = frame[0] or int(found[1]), frame[1] + int(found[2]) + int(found[3])
        elif (found := USED.search(line)) and name:
            kernels.setdefault(name, {})[architecture] = (int(found[1]), *frame)
            name = None
    return kernels


def architectures(kernels):
    return sorted({found for rows in kernels.values() for found in rows}, key=lambda name: (len(name), name))


def table(kernels):
    """Lines: for each of COLUMNS one column an architecture, then the kernel; "-" where it was not compiled."""
    known = architectures(kernels)
    heads = [name.removeprefix("sm_") for name in known]
    yield "  ".join(f"{column + ' on sm_':>{7 * len(known)}}" for column in COLUMNS)
    yield "  ".join("".join(f"{head:>7}" for head in heads) for _ in COLUMNS) + "  kernel"
    for name, rows in sorted(kernels.items()):
        cells = [[str(rows[one][n]) if one in rows else "-" for one in known] for n in range(len(COLUMNS))]
        yield "  ".join("".join(f"{cell:>7}" for cell in column) for column in cells) + f"  {name}"
    for one in known:
        found = [rows[one] for rows in kernels.values() if one in rows]
        spilling = sum(row[2] > 0 for row in found)
        yield (f"{one}: {len(found)} kernels, {min(row[0] for row in found)} to {max(row[0] for row in found)} "
               f"registers, {spilling} spill")


def main():
    parser = argparse.ArgumentParser(description=__doc__.split("\n\n")[0])
    parser.add_argument("log")
    parser.add_argument("--expect", nargs="*", default=[], metavar="ARCHITECTURE")
    options = parser.parse_args()
    try:
        with open(options.log, encoding="utf-8", errors="replace") as file:
            kernels = read(demangled(file.read()))
    except OSError as error:
        sys.exit(f"ptxas_table: cannot read {options.log}: {error.strerror}")
    if not kernels:
        sys.exit(f"ptxas_table: no kernels of the program in {options.log}; is it what nvcc -Xptxas=-v said?")
    print("\n".join(table(kernels)))
    missing = [name for name in options.expect if name not in architectures(kernels)]
    if missing:
        sys.exit(f"ptxas_table: nothing was compiled for {', '.join(missing)}")


if __name__ == "__main__":
    main()
