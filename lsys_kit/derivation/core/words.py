"""Words: rows of modules, held as the numbers of their states, printed in the notation of their system."""

from __future__ import annotations

from array import array
from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from itertools import chain
from typing import TYPE_CHECKING, TypeAlias, overload

from lsys_kit.arrays import arrays_pay, np
from lsys_kit.budget import INTERVAL, Task, check_bytes, counted
from lsys_kit.derivation.core.states import States
from lsys_kit.errors import every, require
from lsys_kit.notation.model.modules import Module, joined, rounded_module
from lsys_kit.notation.registry import dialect_named

if TYPE_CHECKING:
    from numpy.typing import NDArray

Codes: TypeAlias = "list[int] | tuple[int, ...] | array[int] | NDArray[np.integer]"
"""The numbers of states."""
MOST_COUNTED = 4_096
"""In words up to this length states are counted one by one."""
MOST_SHOWN = 2_000
"""How many characters `repr` shows of a long word."""


class Word(Sequence[Module]):
    """A word of a derivation.

    Its text, `str(word)`, has exact values, and reads back; where it is only shown, values have four digits at most.

    Attributes
    ----------
    states
        The table that says what each number stands for.
    codes
        The numbers: a list, or an array, of Python or of numpy, of the smallest unsigned type that holds them.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> word = derive(read("axiom: A(1)\\nA(t) -> A(t+1) [B]"), 2)[-1]
    >>> print(word), len(word), word[0].symbol, word[0].arguments
    A(3)[B][B]
    (None, 7, 'A', (3,))
    """

    __slots__ = ("codes", "states")

    def __init__(self, states: States, codes: Codes) -> None:
        self.states, self.codes = states, codes

    def __len__(self) -> int:
        return len(self.codes)

    @overload
    def __getitem__(self, index: int) -> Module: ...
    @overload
    def __getitem__(self, index: slice) -> Word: ...
    def __getitem__(self, index: int | slice) -> Module | Word:
        if isinstance(index, slice):
            return Word(self.states, self.codes[index])
        return self.states.modules[self.codes[index]]

    def __iter__(self) -> Iterator[Module]:
        return map(self.states.modules.__getitem__, self.numbers())

    def __eq__(self, other: object) -> bool:
        """Equal words have equal modules, whatever system they come from."""
        if not isinstance(other, Word):
            return NotImplemented
        return len(self) == len(other) and all(a == b for a, b in zip(self, other, strict=True))

    def __hash__(self) -> int:
        return hash(tuple(self))

    def __str__(self) -> str:
        with Task("The text of the word was not written"):
            return text_of(self.states, self.codes)

    def __repr__(self) -> str:
        with Task("The word was not shown"):
            return abridged(self, MOST_SHOWN)

    @property
    def bytes(self) -> int:
        return len(self.codes) * getattr(self.codes, "itemsize", 8)

    def numbers(self) -> list[int]:
        """The states' numbers as a plain list."""
        return listed(self.codes)

    def coded(self, coding: Mapping[str, str]) -> str:
        """The word's text with some of its modules replaced: a coding (Rozenberg and Salomaa 1980).

        >>> from lsys_kit import derive, read
        >>> derive(read("axiom: S L(1)"), 0)[0].coded({"S": "M(1)"})
        'M(1)L(1)'
        """
        require(coding, Mapping, "A dictionary of what is written in place of modules")
        every([*coding.values()], str, "The text that is written in place of a module")
        with Task("The text of the word was not written"):
            texts = {state: str(self.states.modules[state]) for state in counted(state_counts(self))}
            texts = {state: coding.get(text, text) for state, text in texts.items()}
            _check_size(texts, state_counts(self))
            return joined(map(texts.__getitem__, chain.from_iterable(blocks(self.numbers()))))

    def counts(self) -> Mapping[str, int]:
        """How often each symbol occurs.

        >>> from lsys_kit import derive, read
        >>> dict(derive(read("axiom: a\\na -> ab\\nb -> a"), 5)[-1].counts())
        {'a': 8, 'b': 5}
        """
        found: Counter[str] = Counter()
        for state, count in state_counts(self).items():
            found[self.states.modules[state].symbol] += count
        return found


def listed(codes: Codes) -> list[int]:
    """The numbers of states as a plain list."""
    return list(codes) if isinstance(codes, list | tuple) else codes.tolist()


def state_counts(word: Word) -> Counter[int]:
    """How often each state occurs in a word; in the order of their numbers, where the word is an array."""
    if isinstance(word.codes, list | tuple):
        return Counter(word.codes)
    if arrays_pay(len(word), MOST_COUNTED):
        counts = np.bincount(word.codes)
        return Counter({state: int(counts[state]) for state in np.flatnonzero(counts).tolist()})
    return Counter(dict(sorted(Counter(listed(word.codes)).items())))


def blocks(numbers: Sequence[int], size: int = INTERVAL) -> Iterator[Sequence[int]]:
    """A row of numbers in blocks, with a look at the budget after each.

    >>> list(blocks([1, 2, 3, 4, 5], 2))
    [[1, 2], [3, 4], [5]]
    """
    return (numbers[first : first + size] for first in counted(range(0, len(numbers), size), 1))


def text_of(states: States, codes: Codes, shown: bool = False) -> str:
    """The text of a row of states, in their system's notation; if it is only shown, with rounded values."""
    notation = dialect_named(states.system.notation)
    counts = state_counts(Word(states, codes))
    texts = {
        state: notation.module(rounded_module(module) if shown else module)
        for state in counted(counts)
        for module in (states.modules[state],)
    }
    _check_size(texts, counts)
    return notation.joined(map(texts.__getitem__, chain.from_iterable(blocks(listed(codes)))))


def _check_size(texts: Mapping[int, str], counts: Mapping[int, int]) -> None:
    size = sum(len(texts[state]) * count for state, count in counts.items())
    check_bytes(size, lambda: "The text of the word was not written")


def abridged(word: Word, characters: int) -> str:
    """The text of a word as it is shown: with rounded values, and with its middle left out where it is long.

    >>> from lsys_kit import derive, read
    >>> abridged(derive(read("axiom: F\\nF -> F+F"), 9)[-1], 40)
    'F+F+F+F+F+F+F+F+F+F+ ... +F+F+F+F+F+F+F+F+F+F (1,023 modules)'
    """
    shown = shortened(word, characters)
    return f"{shown} ({len(word):,} modules)" if " ... " in shown else shown


def shortened(word: Word, characters: int) -> str:
    """The same, where it is said elsewhere how long the word is."""
    half = max(1, characters // 2)
    if len(word) <= characters and len(whole := text_of(word.states, word.codes, shown=True)) <= characters:
        return whole
    front, back = (text_of(word.states, part, shown=True) for part in (word.codes[:half], word.codes[-half:]))
    return f"{front[:half]} ... {back[-half:]}"
