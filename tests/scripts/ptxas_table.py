#!/usr/bin/python3
"""The table of registers and spills of scripts/ptxas_table.py, on what nvcc 13.0 said of two small kernels for three
architectures with at most 40 registers; and what it says of logs without kernels."""
import pathlib
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
LOG = ROOT / "tests/reference/ptxas.log"


def table(log, *options):
    return subprocess.run([sys.executable, ROOT / "scripts/ptxas_table.py", log, *options], capture_output=True,
                          text=True)


def expect(done, status, *rows):
    """This exit code, and lines that consist of these words."""
    lines = [line.split() for line in (done.stdout + done.stderr).splitlines()]
    missing = [row for row in rows if row.split() not in lines]
    if done.returncode != status or missing:
        sys.exit(f"FAILED: exit code {done.returncode}, not {status}; without {missing}:\n{done.stdout}{done.stderr}")


def main(work):
    text = LOG.read_text()
    expect(table(LOG, "--expect", "sm_80", "sm_90", "sm_100"), 0, "80 90 100 80 90 100 80 90 100 kernel",
           "8 8 8 0 0 0 0 0 0 Bar", "40 40 40 1936 2016 2064 5736 5408 6384 Foo",
           "sm_90: 2 kernels, 8 to 40 registers, 1 spill")
    changed = work / "log"
    # Compiled again for one architecture, the last numbers count; not for another one, there is a gap.
    again = text[text.index("Compiling entry", text.index("'sm_80'")):text.index("Overriding", text.index("'sm_80'"))]
    changed.write_text(text + again.replace("Used 40", "Used 39"))
    expect(table(changed), 0, "39 40 40 1936 2016 2064 5736 5408 6384 Foo")
    changed.write_text(text[:text.index("'sm_100'")])
    expect(table(changed), 0, "8 8 0 0 0 0 Bar", "40 40 1936 2016 5736 5408 Foo")
    expect(table(changed, "--expect", "sm_100"), 1, "ptxas_table: nothing was compiled for sm_100")
    changed.write_text(text.replace("7barchan", "7another"))
    expect(table(changed), 1, f"ptxas_table: no kernels of the program in {changed}; is it what nvcc -Xptxas=-v said?")
    expect(table(work / "none"), 1, f"ptxas_table: cannot read {work / 'none'}: No such file or directory")
    print("registers and spills are read as nvcc writes them")


if __name__ == "__main__":
    with tempfile.TemporaryDirectory() as name:
        main(pathlib.Path(name))
