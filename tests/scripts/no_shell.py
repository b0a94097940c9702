#!/usr/bin/env python3
"""No text that was put together - from a case file, a path, an argument - is ever read as a command: programs are
started from lists of arguments, or not at all. And shellcheck, where there is one, finds nothing in the scripts (an
expansion without quotes is the other way to a command nobody wrote)."""

import ast
import pathlib
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
FORBIDDEN = {
    "eval", "exec", "os.system", "os.popen", "subprocess.getoutput", "subprocess.getstatusoutput",
    "asyncio.create_subprocess_shell", "pickle.load", "pickle.loads", "yaml.load",
}  # fmt: skip
STARTERS = {"subprocess." + name for name in ("run", "Popen", "call", "check_call", "check_output")}
# In C++ nothing starts a program: what runs over ranks, draws or sweeps is started by the launcher. But one line becomes
# the build of itself that is made for the processor, with the arguments it was given.
CPP = re.compile(r"\b(system|popen|wordexp|exec[lv]p?e?|posix_spawnp?) *\(")
BECOMES_ITSELF = ROOT / "src/app/best_program.cpp", "    execv(program.c_str(), argv);"
# `eval`, and a text for `sh -c` into which something is expanded; "\$@" and '...' are for the inner shell.
SHELL = re.compile(r"""(^|[;&|(] *|\b(then|do|else) +)eval\b|"""
                   r"""\b(ba|da)?sh +(-[a-z]+ +)*-[a-z]*c +([^ '"]|"([^"\\$`]|\\.)*[$`])""")


def files(folders, *ends):
    return sorted(path for folder in folders for end in ends for path in (ROOT / folder).rglob("*" + end))


def dotted(node):
    """ "a.b.c" of a name or attribute, "" of anything else."""
    if isinstance(node, ast.Name):
        return node.id
    return dotted(node.value) + "." + node.attr if isinstance(node, ast.Attribute) else ""


def findings(node):
    if isinstance(node, ast.ImportFrom) and node.module in ("os", "subprocess", "pickle"):
        yield f"import {node.module} as a whole, so that its calls can be seen"
    if not isinstance(node, ast.Call):
        return
    name = dotted(node.func)
    if name in FORBIDDEN:
        yield f"{name} is not allowed"
    if name in STARTERS and node.args and isinstance(node.args[0], (ast.Constant, ast.JoinedStr, ast.BinOp)):
        yield f"{name} of a text: give a list of arguments"
    if any(k.arg == "shell" and getattr(k.value, "value", True) is not False for k in node.keywords):
        yield "shell= is not allowed"


def main():
    found = []
    sources = files(("kernels", "src", "perf", "tests"), ".hpp", ".cpp")
    pythons = files(("python", "scripts", "perf", "tests"), ".py")
    shells = [*files(("scripts", "tests", ".ci"), ".sh"), ROOT / "barchan"]
    for paths, pattern in ((sources, CPP), (shells, SHELL)):
        for path in paths:
            lines = enumerate(path.read_text().splitlines(), 1)
            found += [f"{path}:{n}: {line}" for n, line in lines
                      if pattern.search(line) and (path, line) != BECOMES_ITSELF]
    for path in pythons:
        for node in ast.walk(ast.parse(path.read_text(encoding="utf-8"), str(path))):
            found += [f"{path}:{node.lineno}: {text}" for text in findings(node)]
    if shutil.which("shellcheck"):
        names = [str(path.relative_to(ROOT)) for path in shells]
        done = subprocess.run(["shellcheck", *names], cwd=ROOT, stdout=subprocess.PIPE, text=True)
        found += [done.stdout] if done.returncode != 0 else []
    else:
        print("no shellcheck: scripts not looked at")
    print(*found, sep="\n")
    print(f"{len(sources)} C++, {len(pythons)} Python and {len(shells)} shell files, {len(found)} problems")
    return 1 if found else 0


sys.exit(main())
