"""One row of the corpus: a good case, what is wrong with it, and how the program must end."""

import re
from dataclasses import dataclass, field
from pathlib import Path

ROOT = Path(__file__).resolve().parents[2]
DUNE = (ROOT / "tests/support/small_dune.toml").read_text()  # poured grains in a turbulent channel
POUR = '''[initial.grains.pour]
centre = [0.008, 0.003]
radius = 0.0018
'''
# The same with grains from a table beside it.
TABLE = DUNE.replace(POUR, "").replace('fluid = "turbulent"', 'fluid = "turbulent"\ngrains = "grains.csv"')
# The same without water: quick to start.
DRY = re.sub(r"\[fluid\].*?(?=\[grains\])", "", DUNE, flags=re.S).replace('fluid = "turbulent"\n', "")
RUN = "run case.toml --out out --quiet"


def grains_csv(rows=None, header="id,diameter,x,y,z"):
    """A table of grains that float apart from each other."""
    if rows is None:
        rows = [(n, 2e-4, 0.004 + 3e-4 * (n % 5), 4e-4 + 3e-4 * (n // 5), 0.003) for n in range(20)]
        rows = [(row[0] + 1, *row[1:]) for row in rows]  # ids from 1: line 2 is grain 1
    lines = [",".join(f"{value:.10g}" if isinstance(value, float) else str(value) for value in row) for row in rows]
    return "\n".join([header, *lines, ""])


@dataclass
class Entry:
    """`edits` replace text of `base` (each must be there) or `text` is the whole case.toml; `files` are further files
    by name: text, bytes, or a function of the path that makes one. `given` names what is copied from the good runs.
    `says`: words that must be in the message; "@text" stands for "case.toml:N:" of the first line of case.toml that
    starts with `text`. `problems`: lines of the message that name one. `code` 0 marks what is strange but good.
    """

    name: str
    says: list
    edits: dict = field(default_factory=dict)
    base: str = DUNE
    text: object = None
    files: dict = field(default_factory=dict)
    given: tuple = ()
    command: str = RUN
    code: int = 2
    problems: int = 1
    ranks: int = 1
    env: dict = field(default_factory=dict)
    limit: float = 20  # seconds
    place: str = ""  # "read-only", "full" or "nobody": where or as whom it runs
    writes: bool = False  # an exit code of 2 that may leave a file: never without a reason beside the entry

    def config(self):
        """The bytes of case.toml; None for none."""
        if self.text is not None:
            return self.text if isinstance(self.text, bytes) else self.text.encode()
        text = self.base
        for old, new in self.edits.items():
            if text.count(old) < 1:
                raise ValueError(f"{self.name}: the good case has no {old!r}")
            text = text.replace(old, new, 1)
        return text.encode()

    def words(self):
        """`says` with line numbers filled in."""
        lines = (self.config() or b"").decode(errors="replace").splitlines()
        words = []
        for word in self.says:
            if word.startswith("@"):
                at = [n for n, line in enumerate(lines, 1) if line.startswith(word[1:])]
                if not at:
                    raise ValueError(f"{self.name}: no line starts with {word[1:]!r}")
                word = f"case.toml:{at[0]}:"
            words.append(word)
        return words
