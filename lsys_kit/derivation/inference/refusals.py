"""Why no system fits: the first step that cannot come from the one before, and what may be wrong with a single letter.

A letter is another, missing, or too many, or two neighbours have changed places. Such a slip upsets the step to the word and
the step from it alone. So only a word is suspected without whose two steps the others agree; every slip in it is tried,
against what the other steps make certain.
"""

from __future__ import annotations

from bisect import bisect_left
from collections.abc import Iterable, Iterator, Sequence
from contextlib import suppress
from dataclasses import dataclass
from itertools import islice, pairwise, takewhile

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.problem import (
    FIRST_CHARACTER,
    Conditions,
    Letter,
    Row,
    Table,
    letters_of,
    problem_of,
    tables,
    text_of,
)
from lsys_kit.derivation.inference.word_equations import (
    Bounds,
    Equation,
    GivenUp,
    Item,
    Known,
    Solution,
    deduced,
    first_bounds,
    merged,
    put_in,
    solutions,
)
from lsys_kit.notation.model.modules import Module

MOST_SUCCESSORS_TRIED = 5_000
"""Beyond so many trials it is not said where words contradict one another."""
SOLUTIONS_COMPARED = 20
"""What a letter would have to become is said where so many solutions agree on it."""


@dataclass(frozen=True)
class Contradiction:
    """A step that cannot come from the one before.

    The letter of the earlier word at a `place`, from 1, is the first for which there is no successor (0 and None where that
    word has no letter). What is `needed` is what it must become as elsewhere, and what is `there` stands in its place, at the
    `begin` in the later word; None where no successor has the right length.
    """

    step: int
    place: int
    module: Module | None
    needed: Row | None = None
    there: Row = ()
    begin: int = 0

    def __str__(self) -> str:
        said = f"Step {self.step} cannot come from step {self.step - 1}"
        if self.module is None:
            return f"{said}, which is empty."
        where = f"{said}: letter {self.place} of step {self.step - 1}, {self.module},"
        if self.needed is None:
            return f"{where} has no successor with which all others can have theirs."
        return f"{where} would have to become {text_of(self.needed)}, and there is {text_of(self.there)}."


def contradiction(words: Sequence[Row], conditions: Conditions) -> Contradiction | None:
    """Where words contradict one another, which no system fits: the first letter that has no successor; None where that is not
    soon found."""
    with suppress(GivenUp):
        step = 1 + bisect_left(range(1, len(words)), True, key=lambda step: _contradict(words[: step + 1], conditions))
        words = words[: step + 1]
        letters = [*letters_of(words[step - 1], conditions)]
        place = bisect_left(range(1, len(letters)), True, key=lambda count: _contradict(words, conditions, count))
        if not letters:
            return Contradiction(step, 0, None)
        some = islice(tables(problem_of(words, conditions, place), MOST_SUCCESSORS_TRIED), SOLUTIONS_COMPARED)
        asked = {_asked(words[step], letters[: place + 1], table, conditions) for table in some}
        needed, there, begin = asked.pop() if len(asked) == 1 else (None, (), place)
        if needed == there:
            needed, there = None, ()
        return Contradiction(step, place + 1, letters[place].module, needed, there, begin)
    return None


def _asked(word: Row, letters: Sequence[Letter], table: Table, conditions: Conditions) -> tuple[Row | None, Row, int]:
    """What the last of some letters would become, what stands in its place, and where."""
    *before, needed = (
        (letter.module,) if letter.module.symbol in conditions.unchanged else table.get(letter) for letter in letters
    )
    begin = sum(len(each or ()) for each in before)
    return needed, word[begin : begin + len(needed or ())], begin


def _contradict(words: Sequence[Row], conditions: Conditions, last: int | None = None) -> bool:
    """Whether no system fits words, or the first letters of their last step."""
    check_budget()
    return next(tables(problem_of(words, conditions, last), MOST_SUCCESSORS_TRIED), None) is None


MOST_LETTERS_READ, LETTERS_A_TRIAL = 2_000_000, 500
"""So many letters are read at most while those of a word are tried; a trial takes as long as reading so many."""

MOST_TRIED_FOR_A_SLIP = 200
"""So many successors are tried for a letter in doubt."""


@dataclass(frozen=True)
class Slip:
    """Some letters of a word, the first at a place counted from 1, and those in whose place some system fits: one, none where a
    letter is missing or too many, or two."""

    step: int
    place: int
    found: Row
    instead: Row

    def __str__(self) -> str:
        if not self.found:
            where = f"behind letter {self.place - 1}" if self.place > 1 else "at the beginning"
            return f"{self.instead[0]} stood {where} of step {self.step}"
        if not self.instead:
            return f"letter {self.place} of step {self.step}, {self.found[0]}, were left out"
        if len(self.found) > 1:
            return f"letters {self.place} and {self.place + 1} of step {self.step}, {text_of(self.found)}, changed places"
        return f"letter {self.place} of step {self.step}, {self.found[0]}, were {self.instead[0]}"


@dataclass(frozen=True)
class _Change:
    """A word with one slip mended: at which place, how many letters are replaced, by what."""

    place: int
    letters: int
    instead: str

    def to(self, word: str) -> str:
        return word[: self.place] + self.instead + word[self.place + self.letters :]


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
    """The slips that there may be where words contradict one another; those near that place are tried first.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> words = read_words(["a", "ab", "aba", "abbab"])
    >>> [str(slip) for slip in slips(words, contradiction(words, Conditions()), Conditions())]
    ['letter 3 of step 3, b, were a']
    """
    texts, modules = _texts(words, conditions), _modules(words)
    near = {found.step: found.begin, found.step - 1: found.place - 1}
    for suspect in range(found.step, -1, -1):
        for change in _slips_of(texts, suspect, near.get(suspect, 0)):
            yield Slip(
                suspect,
                change.place + 1,
                words[suspect][change.place : change.place + change.letters],
                tuple(modules[ord(letter) - FIRST_CHARACTER] for letter in change.instead),
            )


def doubtful_words(words: Sequence[Row], found: Contradiction, conditions: Conditions) -> Iterator[int]:
    """The steps without whose word all others agree, where words contradict one another.

    >>> from lsys_kit.derivation.inference.problem import read_words
    >>> words = read_words(["a", "ab", "aba", "ab", "abaababa", "abaababaabaab"])
    >>> [*doubtful_words(words, contradiction(words, Conditions()), Conditions())]
    [3]
    """
    texts = _texts(words, conditions)
    return (suspect for suspect in range(found.step + 1) if len(words) > 2 and _known_without(texts, suspect))


def _modules(words: Sequence[Row]) -> list[Module]:
    return [*dict.fromkeys(module for word in words for module in word)]


def _texts(words: Sequence[Row], conditions: Conditions) -> _Texts:
    codes = {module: chr(FIRST_CHARACTER + number) for number, module in enumerate(_modules(words))}
    return _Texts(
        tuple("".join(codes[module] for module in word) for word in words),
        "".join(code for module, code in codes.items() if module.symbol in conditions.unchanged),
        conditions.erasing,
    )


def _known_without(texts: _Texts, suspect: int) -> Known | None:
    """What follows from all steps but those to and from a word; None where they contradict one another."""
    steps = [*zip(texts.words, texts.words[1:], strict=False)]
    others = [texts.equation(*step) for number, step in enumerate(steps) if number not in (suspect - 1, suspect)]
    known = None if None in others else deduced(tuple(each for each in others if each and each.items), _first_bounds(texts))
    return known if known and _solvable(known.equations, known.bounds) else None


def _slips_of(texts: _Texts, suspect: int, near: int) -> Iterator[_Change]:
    known = _known_without(texts, suspect)
    if known is None:
        return
    most = MOST_LETTERS_READ // (LETTERS_A_TRIAL + sum(map(len, texts.words)))
    for change in islice(_changes(texts, suspect, known.successors, near), most):
        check_budget()
        before, behind = texts.words[max(0, suspect - 1) : suspect], texts.words[suspect + 1 : suspect + 2]
        around = [*before, change.to(texts.words[suspect]), *behind]
        changed = [texts.equation(*step) for step in pairwise(around)]
        changed = [each and put_in(each, known.successors) for each in changed]
        left = [each for each in changed if each and each.items]
        if None not in changed and _solvable([*known.equations, *left], known.bounds):
            yield change


def _first_bounds(texts: _Texts) -> Bounds:
    numbers = max(map(ord, "".join(texts.words))) - FIRST_CHARACTER + 1
    longer = [Equation((), word + word[-1:]) for word in texts.words]  # a letter may be missing
    return first_bounds(longer, numbers, texts.erasing)


def _changes(texts: _Texts, suspect: int, known: Solution, near: int) -> Iterator[_Change]:
    """What may have to be changed in a word, each new word once."""
    alphabet = sorted({*"".join(texts.words)})
    word = texts.words[suspect]
    places = _places(texts.items(texts.words[suspect - 1], known), word) if suspect else range(len(word) + 1)
    tried = {word}
    for place in sorted(places, key=lambda place: abs(place - near)):
        for change in _changes_at(word, place, alphabet):
            if (new := change.to(word)) not in tried:
                tried.add(new)
                yield change


def _changes_at(word: str, place: int, alphabet: Iterable[str]) -> Iterator[_Change]:
    """What may have to be changed at a place of a word: a letter is another, neighbours changed places, one is missing or too
    many."""
    if place < len(word):
        yield from (_Change(place, 1, letter) for letter in alphabet)
    yield from (_Change(first, 2, word[first : first + 2][::-1]) for first in (place, place - 1) if 0 <= first < len(word) - 1)
    yield from (_Change(place, 0, letter) for letter in alphabet)
    if place < len(word) and len(word) > 1:
        yield _Change(place, 1, "")


def _places(items: Sequence[Item], word: str) -> Iterable[int]:
    """Where a slip may be: where what is known at either end differs first, else where nothing is known.

    >>> [*_places(["abc", 0], "axbb")], [*_places([0, "bc"], "aaxc")], [*_places(["ab", 0, "b"], "abccb")]
    ([1], [2, 3], [2, 3, 4])
    """
    front = items[0] if items and isinstance(items[0], str) else ""
    back = items[-1] if len(items) > 1 and isinstance(items[-1], str) else ""
    if (same := _same(front, word)) < len(front):
        return range(same, same + 1)
    if (same := _same(back[::-1], word[::-1])) < len(back):
        return range(max(0, len(word) - same - 1), len(word) - same + 1)
    return range(len(front), len(word) - len(back) + 1)


def _same(one: str, other: str) -> int:
    """How many letters two words have in common at the front."""
    return sum(1 for _ in takewhile(lambda pair: pair[0] == pair[1], zip(one, other, strict=False)))


def _solvable(equations: Sequence[Equation], bounds: Bounds) -> bool:
    with suppress(GivenUp):
        return next(solutions(equations, bounds, MOST_TRIED_FOR_A_SLIP), None) is not None
    return False
