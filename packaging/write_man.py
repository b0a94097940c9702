#!/usr/bin/python3
"""The man page, from `barchan --help` of an installation.

write_man.py DESTDIR PREFIX VERSION     called by cmake --install; DESTDIR may be empty
"""
import re
import subprocess
import sys
from pathlib import Path

ENTRY = re.compile(r"^ {2,6}(\S.*?) {2,}(.*)$")  # of two columns, as in the lists of commands, options and variables


def read(usage):
    """What it is; [[command with its arguments, words, [(option, words)]]]; environment; the paragraphs besides."""
    head, _, first, *rest = [block.splitlines() for block in usage.strip().split("\n\n")]
    commands = []
    for line in first:
        name, words = ENTRY.match(line).groups()
        if line.startswith("   "):
            commands[-1][2].append((name, words))
        else:
            commands.append([name, words, []])
    environment = [ENTRY.match(line).groups() for block in rest if block[0] == "Environment:" for line in block[1:]]
    return head[0].partition(": ")[2], commands, environment, [block for block in rest if block[0] != "Environment:"]


def roff(text):
    """As the page is to show it."""
    return re.sub(r"^([.'])", r"\\&\1", text.replace("\\", "\\e").replace("-", "\\-"), flags=re.M)


def entry(name, words):
    return [".TP", f".B {roff(name)}", roff(words)]


def man_page(usage, version, prefix):
    what, commands, environment, paragraphs = read(usage)
    lines = [f'.TH BARCHAN 1 "" "barchan {version}" "User Commands"', ".SH NAME", f"barchan \\- {roff(what)}",
             ".SH SYNOPSIS", ".B barchan", ".I COMMAND", "[arguments]", ".SH COMMANDS"]
    for name, words, options in commands:
        lines += entry(name, words)
        if options:
            lines += [".RS", *(line for option in options for line in entry(*option)), ".RE"]
    lines.append(".SH NOTES")
    for paragraph in paragraphs:
        lines += [".PP", *(f".br\n{roff(line.strip())}" if line.startswith(" ") else roff(line) for line in paragraph)]
    lines += [".SH ENVIRONMENT", *(line for variable in environment for line in entry(*variable))]
    return "\n".join([*lines, ".SH SEE ALSO", f"The pages in {roff(prefix)}/share/doc/barchan/docs"]) + "\n"


def main(destdir, prefix, version):
    staged = destdir + prefix
    usage = subprocess.run([f"{staged}/bin/barchan", "--help"], check=True, capture_output=True, text=True).stdout
    usage = usage.replace(str(Path(staged).resolve()), prefix)
    path = Path(staged, "share/man/man1/barchan.1")
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(man_page(usage, version, prefix))


main(*sys.argv[1:])
