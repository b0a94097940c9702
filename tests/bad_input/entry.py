"""One row of the tables: a good case, what is wrong with it, and how the program must end."""

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DUNE = (ROOT / "tests/support/small_dune.toml").read_text()  # poured grains in a turbulent channel
POUR = '''[initial.grains.pour]
centre = [0.008, 0.003]
radius = 0.0018
'''


def without(text, *keys):
    """`text` without the lines of these keys."""
    return re.sub(rf"^({'|'.join(keys)}) = .*\n", "", text, flags=re.M)


# The same with grains from a table beside it.
TABLE = DUNE.replace(POUR, "").replace('fluid = "turbulent"', 'fluid = "turbulent"\ngrains = "grains.csv"')
# The same without water, and without grains.
DRY = without(re.sub(r"\[fluid\].*?(?=\[grains\])", "", DUNE, flags=re.S), "fluid", "fields_interval")
WET = without(DUNE[: DUNE.index("[grains]")], "grain_step") + '[initial]\nfluid = "turbulent"\n'
SHORT = "[time] end = 5e-4"  # for what is good and must run


def edited(text, edits):
    """`text` after edits, separated by " ;; ": "[section] key = value" replaces the line of that key or adds it to the
    section, "-[section] key" removes it, and "old => new" replaces text that must be there."""
    for edit in filter(None, edits.split(" ;; ")):
        old, arrow, new = edit.partition(" => ")
        if not arrow:
            section, line = re.match(r"-?(\[.*?\]) (.*)", edit, re.S).groups()
            key = line.partition(" = ")[0]
            new = "" if edit.startswith("-") else line + "\n"
            head = f"{section}\n"
            if head not in text:
                text += head
            start = text.index(head) + len(head)
            body = re.match(r"(?:(?!\[).*\n)*", text[start:])[0]
            found = re.search(rf"^{re.escape(key)} = .*\n", body, re.M)
            if found:
                text = text[: start + found.start()] + new + text[start + found.end():]
            else:
                text = text[:start] + new + text[start:]
        elif old in text:
            text = text.replace(old, new, 1)
        else:
            raise ValueError(f"the good case has no {old!r}")
    return text


@dataclass
class Entry:
    """`edits` change `base`, or `text` is the whole case.toml; `files` are further files by name: text, bytes, or a
    function of the path that makes one. `given` names what is copied from the good runs. `says`: words that must be
    in the message, separated by " | "; "@text" stands for "case.toml:N:" of the first line that starts with `text`.
    `problems`: how many the message names. Exit code 0 marks what is strange but good, 1 what fails on the way.
    """

    name: str
    edits: str = ""
    says: str = ""
    base: str = DUNE
    text: object = None
    files: dict = field(default_factory=dict)
    given: tuple = ()
    command: str = "run case.toml --out out --quiet"
    code: int = 2
    problems: int = 1
    ranks: int = 1
    env: dict = field(default_factory=dict)
    under: str = ""  # "nobody", "tmpfs SIZE", "fsize BYTES", "as BYTES": as whom, where, within what

    def config(self):
        """The bytes of case.toml."""
        text = self.text if self.text is not None else edited(self.base, self.edits)
        return text if isinstance(text, bytes) else text.encode()

    def expected(self):
        """`says` in parts, with line numbers filled in."""
        lines = self.config().decode(errors="replace").splitlines()
        line_of = lambda start: next(n for n, line in enumerate(lines, 1) if line.startswith(start))
        return [f"case.toml:{line_of(part[1:])}:" if part.startswith("@") else part
                for part in filter(None, self.says.split(" | "))]
