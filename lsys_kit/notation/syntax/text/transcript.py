"""What a text became before it is read, with the place of each character in what was typed."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Sequence
from dataclasses import dataclass, field
from typing import NamedTuple

from lsys_kit.errors import LSystemError


class Edit(NamedTuple):
    """A stretch of the source, and what is written in its place."""

    start: int
    end: int
    text: str


@dataclass(frozen=True)
class Transcript:
    """A source as the kit writes it.

    Attributes
    ----------
    source, text
        What was typed, and what is read.
    notes
        What was understood.
    """

    source: str
    text: str
    notes: tuple[str, ...] = ()
    _starts: Sequence[int] = field(default=(0,), repr=False)
    _origins: Sequence[int] = field(default=(0,), repr=False)

    def origin(self, offset: int) -> int:
        """Where in the source a character of the text comes from; what was put in comes from the place where it was put.

        >>> from lsys_kit.notation.syntax.text.transcription import transcribe
        >>> found = transcribe("n=3, δ=60°\\nF\\nF → F+F")
        >>> found.text, found.origin(found.text.index("F+F"))
        ('steps:3\\n δ=60°\\naxiom: F\\nF → F+F', 17)
        """
        piece = bisect_right(self._starts, offset) - 1
        last = self._origins[piece + 1] if piece + 1 < len(self._origins) else len(self.source)
        return min(self._origins[piece] + offset - self._starts[piece], last)

    def relocated(self, error: LSystemError) -> LSystemError:
        """An error about the text, as one about the source."""
        if self.text == self.source or error.line is None or error.source != self.text:
            return error
        before = sum(len(line) + 1 for line in self.text.split("\n")[:error.line - 1])
        start, end = before + (error.column or 1) - 1, before + (error.end or 2) - 1
        return error.moved(self.source, self.origin(start), max(self.origin(end), self.origin(start) + 1))


def as_typed(source: str) -> Transcript:
    """A text that is read as it stands."""
    return Transcript(source, source)
