"""Wrong letters: single letters of the words with another in whose place some system fits.

A slip in a word upsets the step to it and the step from it alone. So only a word is suspected without whose two steps the
others agree; each of its letters is tried with every other one, against what the other steps make certain.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice, pairwise, takewhile

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.bounds import Bounds, first_bounds
from lsys_kit.derivation.inference.equations import Equation, Item, merged, put_in
from lsys_kit.derivation.inference.problem import FIRST_CHARACTER, Conditions
from lsys_kit.derivation.inference.refusals import Contradiction
from lsys_kit.derivation.inference.search import GivenUp, Solution, deduced, solutions
from lsys_kit.derivation.inference.words import Row
from lsys_kit.notation.model.modules import Module

MOST_LETTERS_READ, LETTERS_A_TRIAL = 2_000_000, 500
"""So many letters are read at most while those of a word are tried; a trial takes as long as reading so many."""

MOST_SUCCESSORS_TRIED = 200
"""So many successors are tried for a letter in doubt."""


@dataclass(frozen=True)
class Slip:
    """A letter with another in whose place some system fits.

    Attributes
    ----------
    step, place
        Where it stands; the place is counted from 1.
    found, instead
        The letter, and the one that should be there.
    """

    step: int
    place: int
    found: Module
    instead: Module

    def __str__(self) -> str:
        return f"letter {self.place} of step {self.step}, {self.found}, were {self.instead}"


@dataclass(frozen=True)
class _Texts:
    """Words as texts with a character for each module."""

    words: tuple[str, ...]
    unchanged: str
    erasing: bool

    def equation(self, word: str, following: str) -> Equation | None:
        """What a step asks."""
        return put_in(Equation(tuple(self.items(word, {})), following), {})

    def items(self, word: str, known: Solution) -> list[Item]:
        """The letters of a word, with known successors in place of those that have one."""
        numbers = ((letter, ord(letter) - FIRST_CHARACTER) for letter in word)
        return merged(letter if letter in self.unchanged else known.get(number, number) for letter, number in numbers)


def slips(words: Sequence[Row], found: Contradiction, conditions: Conditions) -> Iterator[Slip]:
    """The single letters that could be wrong where words contradict one another; those near that place are tried first.

    >>> from lsys_kit.derivation.inference.refusals import contradiction
    >>> from lsys_kit.derivation.inference.words import read_words
    >>> words = read_words(["a", "ab", "aba", "abbab"])
    >>> [str(slip) for slip in slips(words, contradiction(words, Conditions()), Conditions())]
    ['letter 3 of step 3, b, were a']
    """
    modules = [*dict.fromkeys(module for word in words for module in word)]
    codes = {module: chr(FIRST_CHARACTER + number) for number, module in enumerate(modules)}
    texts = _Texts(tuple("".join(codes[module] for module in word) for word in words),
                   "".join(codes[module] for module in modules if module.symbol in conditions.unchanged), conditions.erasing)
    near = {found.step: found.begin, found.step - 1: found.place - 1}
    for suspect in range(found.step, -1, -1):
        for place, letter in _slips_of(texts, suspect, near.get(suspect, 0)):
            yield Slip(suspect, place + 1, words[suspect][place], modules[ord(letter) - FIRST_CHARACTER])


def _slips_of(texts: _Texts, suspect: int, near: int) -> Iterator[tuple[int, str]]:
    """The places of a word, and what could stand there."""
    steps = [*zip(texts.words, texts.words[1:], strict=False)]
    others = [texts.equation(*step) for number, step in enumerate(steps) if number not in (suspect - 1, suspect)]
    bounds = _first_bounds(texts)
    known = None if None in others else deduced(tuple(each for each in others if each and each.items), bounds)
    if known is None or not _solvable(known.equations, known.bounds):
        return
    most = MOST_LETTERS_READ // (LETTERS_A_TRIAL + sum(map(len, texts.words)))
    for place, letter in islice(_changes(texts, suspect, known.successors, near), most):
        check_budget()
        word = texts.words[suspect][:place] + letter + texts.words[suspect][place + 1:]
        around = [texts.words[suspect - 1]] * (suspect > 0) + [word] + [*texts.words[suspect + 1:suspect + 2]]
        changed = [texts.equation(*step) for step in pairwise(around)]
        changed = [each and put_in(each, known.successors) for each in changed]
        left = [each for each in changed if each and each.items]
        if None not in changed and _solvable([*known.equations, *left], known.bounds):
            yield place, letter


def _first_bounds(texts: _Texts) -> Bounds:
    numbers = max(map(ord, "".join(texts.words))) - FIRST_CHARACTER + 1
    return first_bounds([Equation((), word) for word in texts.words], numbers, texts.erasing)


def _changes(texts: _Texts, suspect: int, known: Solution, near: int) -> Iterator[tuple[int, str]]:
    """The places of a word that can be wrong, with every other letter."""
    alphabet = sorted({*"".join(texts.words)})
    word = texts.words[suspect]
    places = _places(texts.items(texts.words[suspect - 1], known), word) if suspect else range(len(word))
    for place in sorted(places, key=lambda place: abs(place - near)):
        yield from ((place, letter) for letter in alphabet if letter != word[place])


def _places(items: Sequence[Item], word: str) -> Iterable[int]:
    """Where one letter may be wrong: where what is known at either end differs first, else where nothing is known.

    >>> [*_places(["abc", 0], "axbb")], [*_places([0, "bc"], "aaxc")], [*_places(["ab", 0, "b"], "abccb")]
    ([1], [2], [2, 3])
    """
    front = items[0] if items and isinstance(items[0], str) else ""
    back = items[-1] if len(items) > 1 and isinstance(items[-1], str) else ""
    if (same := _same(front, word)) < len(front):
        return range(same, min(same + 1, len(word)))
    if (same := _same(back[::-1], word[::-1])) < len(back):
        return range(max(0, len(word) - same - 1), len(word) - same)
    return range(len(front), len(word) - len(back))


def _same(one: str, other: str) -> int:
    """How many letters two words have in common at the front."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _solvable(equations: Sequence[Equation], bounds: Bounds) -> bool:
    """Whether a solution is soon found."""
    with suppress(GivenUp):
        return next(solutions(equations, bounds, MOST_SUCCESSORS_TRIED), None) is not None
    return False
