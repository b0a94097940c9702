"""A line of progress on standard error, for what takes more than a few seconds."""

import sys
import time
from collections.abc import Iterator, Sequence
from typing import Any

PATIENCE = 2.0  # [s] before it says anything
INTERVAL = 0.5  # [s] between two words


class Progress:
    """The items of a sequence in turn: `words` 12 of 100, about 8 s left. Silent where `shown` is false."""

    def __init__(self, items: Sequence[Any], words: str, shown: bool = True) -> None:
        self.items, self.words, self.shown = items, words, shown

    def __iter__(self) -> Iterator[Any]:
        began = said = time.monotonic()
        spoken = False
        try:
            for done, item in enumerate(self.items):
                now = time.monotonic()
                if self.shown and done and now - began > PATIENCE and now - said > INTERVAL:
                    left = (now - began) / done * (len(self.items) - done)
                    print(f"\r{self.words}: {done} of {len(self.items)}, about {left:.0f} s left ", end="",
                          file=sys.stderr, flush=True)
                    said, spoken = now, True
                yield item
        finally:
            if spoken:
                print(file=sys.stderr)
