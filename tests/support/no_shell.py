#!/usr/bin/env python3
"""Finds what makes a shell, or Python, read text that was put together: no_shell.py FILE.py ...

Allowed are programs started from a list of arguments. A line for each finding; exit status 1 with any.
"""

import ast
import sys

FORBIDDEN = {
    "eval", "exec", "os.system", "os.popen", "subprocess.getoutput", "subprocess.getstatusoutput",
    "asyncio.create_subprocess_shell", "pickle.load", "pickle.loads", "yaml.load",
}  # fmt: skip
STARTERS = {"subprocess." + name for name in ("run", "Popen", "call", "check_call", "check_output")}


def dotted(node):
    """ "a.b.c" of a name or attribute, "" of anything else."""
    if isinstance(node, ast.Name):
        return node.id
    if isinstance(node, ast.Attribute):
        return dotted(node.value) + "." + node.attr
    return ""


def findings(call):
    name = dotted(call.func)
    if name in FORBIDDEN:
        yield f"{name} is not allowed"
    if name in STARTERS and call.args and isinstance(call.args[0], (ast.Constant, ast.JoinedStr, ast.BinOp)):
        yield f"{name} of a text: give a list of arguments"
    if any(k.arg == "shell" and not (isinstance(k.value, ast.Constant) and k.value.value is False) for k in call.keywords):
        yield "shell= is not allowed"


def main():
    found = 0
    for path in sys.argv[1:]:
        with open(path, encoding="utf-8") as source:
            tree = ast.parse(source.read(), path)
        for node in ast.walk(tree):
            if isinstance(node, ast.ImportFrom) and node.module in ("os", "subprocess", "pickle"):
                print(f"{path}:{node.lineno}: import {node.module} as a whole, so that its calls can be seen")
                found += 1
            if isinstance(node, ast.Call):
                for text in findings(node):
                    print(f"{path}:{node.lineno}: {text}")
                    found += 1
    return 1 if found else 0


sys.exit(main())
