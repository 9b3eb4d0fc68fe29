"""Kept steps: the words of a derivation, all while there is room; then some, from which the others are made again.

What a step makes of a word depends on the word and the step alone, so that a word need not be kept to be seen. Of long
derivations every second, every fourth, ... is kept, and beside them the last and that which was asked for last.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from lsys_kit.budget import current
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.engines.engine import Origins

SHARE = 4
"""Of the bytes that a derivation may hold, words in columns take one of so many parts."""

LOOK_BYTES = 2**20
"""So many bytes are added before the limit is looked at again."""


@dataclass
class KeptStep:
    """A step: the size of its word; the word, unless it is to be made again; where its modules come from, if that is known."""

    size: int
    word: Word | None
    origins: Callable[[], Origins] | None = None


class KeptSteps(list[KeptStep]):
    """The steps from some step on. Words are left out if it is known how one is made of the word before, and its number here.

    >>> from lsys_kit.derivation.core.states import States
    >>> from lsys_kit import limits, read
    >>> states = States(read("axiom: a"))
    >>> steps = KeptSteps(lambda before, number: Word(states, [*before.codes, 0]))
    >>> with limits(bytes=1_000):
    ...     for number in range(9):
    ...         steps.add(Word(states, [0] * (number + 1)))
    >>> [step.word is not None for step in steps], len(steps.word(3))
    ([True, False, True, False, True, False, True, True, True], 4)
    """

    def __init__(self, again: Callable[[Word, int], Word] | None = None) -> None:
        self.again = again
        self.bytes = 0
        self._every, self._look = 1, 0
        self._asked: tuple[int, Word] | None = None

    def add(self, word: Word, origins: Callable[[], Origins] | None = None, more: int = 0) -> None:
        """Add a step, which takes so many bytes more than its word; where there is no room, leave words out."""
        self.bytes += word.bytes + more
        self.append(KeptStep(len(word), word, origins))
        if self.again is None or self.bytes < self._look:
            return
        most = current().bytes // SHARE
        self._look = self.bytes + min(LOOK_BYTES, most // SHARE)
        while self.bytes > most and self._every < len(self):
            self._every *= 2
            for number, step in enumerate(self[:-1]):
                if step.word is not None and number % self._every:
                    self.bytes -= step.word.bytes
                    step.word = None

    def word(self, number: int) -> Word:
        """The word of a step."""
        found = self[number].word
        if found is not None:
            return found
        first = next(at for at in range(number, -1, -1) if self[at].word is not None)
        word = self[first].word
        if self._asked is not None and first < self._asked[0] <= number:
            first, word = self._asked
        assert word is not None
        assert self.again is not None
        for at in range(first + 1, number + 1):
            word = self.again(word, at)
        self._asked = number, word
        return word
