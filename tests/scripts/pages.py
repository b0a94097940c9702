#!/usr/bin/python3
"""What the pages tell a user to type works: commands are parsed and their cases checked, figures and tests are there,
whole cases and studies pass the check, Python is run on a made-up run, and links lead to a page and a heading."""
import os
import re
import shlex
import subprocess
import sys
import tempfile
from functools import lru_cache
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
PROGRAM = os.environ["BARCHAN_PROGRAM"]
FOLDERS = "", "docs/", "docs/dev/", "docs/site/", "packaging/", "notebooks/"
PAGES = [page for pattern in (folder + "*.md" for folder in FOLDERS)
         for page in sorted(ROOT.glob(pattern)) if page.name != "CHANGELOG.md"]
BLOCK = re.compile(r"^```(\w*)\n(.*?)^```", re.S | re.M)
INLINE = re.compile(r"`((?:\./)?barchan [^`\n]+)`")
PLACEHOLDER = re.compile(r"\b[A-Z]{2,}(?:_[A-Z]+)*\b|\.\.\.|<|\[|…")
ONLY_READ = "study", "find_dunes", "BarchanBmi"  # blocks of Python that need more than a run

sys.path.insert(0, str(ROOT / "python"))
wrong = []


def say(page, text):
    wrong.append(f"{page.relative_to(ROOT)}: {text}")


def call(*words, folder):
    return subprocess.run([str(word) for word in words], cwd=folder, capture_output=True, text=True, check=False,
                          env={**os.environ, "PYTHONPATH": str(ROOT / "python")})


once = lru_cache(call)


def last_line(done):
    return (done.stderr or done.stdout).strip().splitlines()[-1:]


# --- links

def anchors(text):
    """The anchors of a page, as they are made of its headings."""
    seen, names = {}, set()
    for heading in re.findall(r"^#+ (.+)$", re.sub(r"```.*?```", "", text, flags=re.S), re.M):
        name = re.sub(r"[^\w\- ]", "", re.sub(r"\[([^]]*)\]\([^)]*\)", r"\1", heading).lower()).replace(" ", "-")
        names.add(name if name not in seen else f"{name}-{seen[name]}")
        seen[name] = seen.get(name, 0) + 1
    return names


def check_links(page, text):
    prose = re.sub(r"```.*?```|`[^`\n]*`", "", text, flags=re.S)
    for target, heading in re.findall(r"\]\(([^)\s#]*)(?:#([^)\s]*))?\)", prose):
        if "://" in target or target.startswith("mailto:"):
            continue
        # Pages of the site stand among those of docs/ there.
        folder = page.parent.parent if page.parent.name == "site" and target.endswith(".md") else page.parent
        path = (folder / target).resolve() if target else page
        if not path.exists():
            say(page, f"links to {target}, which is not there")
        elif heading and heading not in anchors(path.read_text()):
            say(page, f"links to {target}#{heading}; there is no such heading")


# --- commands

def commands(text):
    for language, block in BLOCK.findall(text):
        if language in ("", "bash", "sh", "console"):
            for line in block.replace("\\\n", " ").splitlines():
                line = re.sub(r"\s+#.*", "", line.strip().removeprefix("$ "))
                if line.startswith(("./barchan ", "barchan ")):
                    yield line
    for line in INLINE.findall(re.sub(r"```.*?```", "", text, flags=re.S)):
        yield line


def check_command(page, line, help_text, folder):
    words = shlex.split(line.split(" > ")[0])
    command, arguments = words[1], words[2:]
    if PLACEHOLDER.search(command):
        return None
    if command not in ("help", "--help", "--version") and not re.search(rf"^  {command} ", help_text, re.M):
        return say(page, f"{line}: there is no command {command}")
    if command not in ("test", "bench", "benchmark", "plot"):
        for option in (word.split("=")[0] for word in arguments if word.startswith("--")):
            if option not in help_text:
                say(page, f"{line}: the help does not know {option}")
    if any(PLACEHOLDER.search(word) for word in arguments):
        return None
    if arguments and (ROOT / "configs" / arguments[0]).is_file():  # the launcher looks there, too
        arguments[0] = str(ROOT / "configs" / arguments[0])
    path = (folder / arguments[0]).resolve() if arguments else ROOT
    ships = path.is_file() and path.is_relative_to(ROOT / "configs")
    if command in ("run", "check") and arguments and not arguments[0].startswith("-"):
        changes = [word for i, word in enumerate(arguments) if "--set" in (word, arguments[i - 1])]
        done = (once if ships else call)(PROGRAM, "check", arguments[0], "--resolved-only", *changes, folder=folder)
    elif command == "sweep" and ships:
        return None  # studies that ship are listed every night
    elif command == "sweep" and arguments:
        done = call(sys.executable, "-m", "barchan", "sweep", PROGRAM, arguments[0], "--list", folder=folder)
    elif command in ("keys", "new"):
        done = call(PROGRAM, *words[1:], folder=folder)
    elif command == "plot":
        return check_figures(page, line, arguments)
    elif command == "test" and "-R" in arguments:
        name = arguments[arguments.index("-R") + 1]
        done = call("ctest", "--test-dir", Path(PROGRAM).parent, "-N", "--no-tests=error", "-R", name, folder=folder)
    else:
        return None
    if done.returncode:
        say(page, f"{line}: {last_line(done)}")
    return None


def check_figures(page, line, arguments):
    from barchan.figures import registry
    names = {*registry.OF_RUN, *registry.OF_STUDY, *registry.PAPER}
    skip = False
    for word in arguments[1:]:
        if not skip and not word.startswith("-") and arguments[0] != "validation" and word not in names:
            say(page, f"{line}: there is no figure {word}")
        skip = word in ("--from", "--to", "--time", "--column", "--only")


# --- cases and Python

def check_blocks(page, text, folder):
    """Whole cases and studies of a page are saved where it says, `NAME.toml`, and checked; Python is run."""
    python = []
    for language, block in BLOCK.findall(text):
        if language == "toml" and block.startswith(("[case]", "[study]")):
            name = re.findall(r"`([\w-]+\.toml)`", text[:text.index(block)])
            case = folder / (name[-1] if name and (folder / name[-1]).parent == folder else "pasted.toml")
            case.write_text(block)
            if block.startswith("[case]"):
                done = call(PROGRAM, "check", case.name, "--resolved-only", folder=folder)
            else:
                done = call(sys.executable, "-m", "barchan", "sweep", PROGRAM, case.name, "--list", folder=folder)
            if done.returncode:
                say(page, f"its {case.name}: {last_line(done)}")
        elif language == "python" and not any(word in block for word in ONLY_READ):
            python.append("".join(line for line in block.splitlines(keepends=True) if "barchan.run(" not in line))
    if python:
        run_python(page, python, folder)


def run_python(page, blocks, folder):
    """All blocks of a page, one after the other in one process."""
    script = folder / "page.py"
    script.write_text("import matplotlib\nmatplotlib.use('Agg')\n" + "\n".join(blocks))
    done = call(sys.executable, script.name, folder=folder)
    if done.returncode:
        say(page, f"Python: {done.stderr[-600:]}")


def main():
    help_text = call(ROOT / "barchan", "help", folder=ROOT).stdout
    n = 0
    with tempfile.TemporaryDirectory() as name:
        folder = Path(name)
        (folder / "configs").symlink_to(ROOT / "configs")
        for run in ("quickstart", "my-dune"):
            subprocess.run([sys.executable, ROOT / "tests/support/make_fake_run.py", folder / "runs" / run], check=True)
            with (folder / "runs" / run / "config.toml").open("a") as config:
                config.write("[grains]\nsliding_friction = 0.6\n")
        for page in PAGES:
            text = page.read_text()
            check_links(page, text)
            check_blocks(page, text, folder)
            for line in commands(text):
                n += 1
                check_command(page, line, help_text, folder)
    print(*wrong or [f"{len(PAGES)} pages, {n} commands as the program has them"], sep="\n")
    return len(wrong) > 0


if __name__ == "__main__":
    sys.exit(main())
