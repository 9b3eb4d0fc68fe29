"""What a text became before it is read, with the place of each character in what was typed."""

from __future__ import annotations

from bisect import bisect_right
from collections.abc import Iterable, Sequence
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
    _ends: Sequence[int] = field(default=(), repr=False)
    _before: Transcript | None = field(default=None, repr=False)

    def origin(self, offset: int) -> int:
        """Where in the source a character of the text comes from; what was put in comes from the place where it was put.

        >>> from lsys_kit.notation.syntax.text.transcription import transcribe
        >>> found = transcribe("n=3, δ=60°\\nF\\nF → F+F")
        >>> found.text, found.origin(found.text.index("F+F"))
        ('steps:3\\n δ=60°\\naxiom: F\\nF → F+F', 17)
        """
        piece = bisect_right(self._starts, offset) - 1
        last = self._ends[piece] if self._ends else len(self.source)
        origin = min(self._origins[piece] + offset - self._starts[piece], last)
        return self._before.origin(origin) if self._before else origin

    def relocated(self, error: LSystemError) -> LSystemError:
        """An error about the text, as one about the source."""
        if self.text == self.source or error.line is None or error.source != self.text:
            return error
        before = sum(len(line) + 1 for line in self.text.split("\n")[: error.line - 1])
        start, end = before + (error.column or 1) - 1, before + (error.end or 2) - 1
        return error.moved(self.source, self.origin(start), max(self.origin(end), self.origin(start) + 1))


def as_typed(source: str) -> Transcript:
    """A text that is read as it stands."""
    return Transcript(source, source)


def edited(source: str | Transcript, edits: Iterable[Edit], notes: Sequence[str] = (), typed: str | None = None) -> Transcript:
    """A text, or a transcript, after some edits; of those that overlap, the first is made.

    Parameters
    ----------
    source
        The text, or what an earlier pass made of it.
    edits
        The edits, in any order.
    notes
        What was understood; read after the edits.
    typed
        The text with some characters in place of others, which the edits refer to.

    Examples
    --------
    >>> found = edited("AXB", [Edit(1, 2, "CC")])
    >>> found.text, [found.origin(at) for at in range(4)]
    ('ACCB', [0, 1, 1, 2])
    """
    before = source if isinstance(source, Transcript) else as_typed(source)
    typed = before.text if typed is None else typed
    pieces: list[Edit] = []
    at = 0
    for edit in sorted(set(edits)):
        if edit.start < at:  # within what another edit has replaced
            continue
        pieces += (Edit(at, edit.start, typed[at : edit.start]), Edit(edit.start, edit.start, edit.text))
        at = edit.end
    return assembled(before, (*pieces, Edit(at, len(typed), typed[at:])), notes)


def assembled(before: Transcript, pieces: Iterable[Edit], notes: Sequence[str] = ()) -> Transcript:
    """A text of pieces, each with its place in what an earlier pass made: in any order, and some of it not at all.

    >>> found = assembled(as_typed("ab"), [Edit(1, 2, "b"), Edit(0, 1, "a")])
    >>> found.text, [found.origin(at) for at in range(3)]
    ('ba', [1, 0, 1])
    """
    parts, starts, origins, ends = [], [0], [0], [0]
    length = 0
    for piece in pieces:
        if piece.text or piece.start < piece.end:
            starts.append(length)
            origins.append(piece.start)
            ends.append(piece.end)
            parts.append(piece.text)
            length += len(piece.text)
    every = tuple(dict.fromkeys((*before.notes, *notes)))
    return Transcript(before.source, "".join(parts), every, starts, origins, ends, before)
