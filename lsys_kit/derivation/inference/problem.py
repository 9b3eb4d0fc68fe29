"""The question that words ask: which successors of their letters turn each word into the next?

A letter is a module between its neighbours: the same module between others is another letter, whose successor is free.
Without contexts a letter is a module alone. Constants are known: they stay as they are, and contexts pass over them. So are the
brackets of branches (ABOP, section 1.6.1), which contexts understand.
"""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from fractions import Fraction
from typing import TypeAlias

from lsys_kit.budget import INTERVAL, counted
from lsys_kit.derivation.core.matching import Passing, neighbours, neighbours_along
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.derivation.inference.word_equations import (
    Bounds,
    Count,
    Equation,
    Solution,
    Trials,
    count_of,
    first_bounds,
    put_in,
    solutions,
)
from lsys_kit.errors import ModelLimitError, ModelValueError, quotable, shown
from lsys_kit.notation.model.arithmetic import is_symbolic, normalised
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module, joined

Row: TypeAlias = tuple[Module, ...]
"""A word."""
GAP = Module("?")
"""It stands for a stretch of a word of which nothing is known."""
MOST_MODULES = 100_000
"""So many modules may all words have together."""
NUMBER = r"-?\d+(?:\.\d+)?(?:/0*[1-9]\d*|[eE][-+]?\d{1,3})?"
ARGUMENTS = rf"\(\s*+({NUMBER}(?>(?:\s*+,\s*+{NUMBER})*))\s*+\)"
MODULE = re.compile(rf"(\w++|\S)(?:{ARGUMENTS})?")
VALUE = re.compile(rf"[^\s()]{ARGUMENTS}")


def read_words(given: object) -> tuple[Row, ...]:
    """The words of steps 0, 1, 2, ... as rows of modules.

    A text is a row of one-letter symbols. Where one of the texts has a blank, or numbers in parentheses behind a symbol, all
    are read as `derive` prints words. A question mark is a stretch of which nothing is known, and None a word of which nothing
    is.

    >>> [len(word) for word in read_words(["ar", "albr"])]
    [2, 4]
    >>> [len(word) for word in read_words(["ar", "al br", "bl(1) ar ar"])]
    [1, 2, 3]
    >>> read_words(["a", None])[1] == (GAP,)
    True
    """
    hint = 'Give the words of steps 0, 1, 2, ... in a list, as in infer(["a", "ab", "aba"]).'
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise ModelValueError(f"A sequence of words is needed, not {type(given).__name__}", hint=hint)
    words = [*counted(given, 1)]
    if len(words) < 2:
        there = "is one" if words else "are none"
        raise ModelValueError(f"Rules are found from two words at least; there {there}", hint=hint)
    texts = [word for word in words if isinstance(word, str)]
    valued = any(map(VALUE.search, texts))
    printed = valued or any(len(text.split()) > 1 for text in texts)
    found, left = [], MOST_MODULES
    for step, word in enumerate(words):
        found.append(_row(word, step, printed, valued))
        left -= len(found[-1])
        if left < 0:
            raise ModelLimitError(
                f"The words up to step {step} have more than {MOST_MODULES:,} modules",
                limit=MOST_MODULES,
                hint="Give fewer steps.",
            )
    return tuple(found)


def _row(word: object, step: int, printed: bool, valued: bool) -> Row:
    if word is None:
        return (GAP,)
    if isinstance(word, str):
        if valued and (stray := re.search(r"\([^()]*\)?|\)", VALUE.sub(" ", word))):  # no symbol, where symbols have values
            raise ModelValueError(
                f'The word of step {step} has "{quotable(stray[0])}", which are no values',
                hint="Values are numbers with commas between them, as in A(1,2.5).",
            )
        row = tuple(_printed_modules(word) if printed else (Module(letter) for letter in word.strip()))
    elif isinstance(word, Sequence) and not isinstance(word, bytes | bytearray):
        row = tuple(_module(each, step) for each in counted(word))
    else:
        raise ModelValueError(f"The word of step {step} must be a text or a row of modules, not {type(word).__name__}")
    for module in row:
        if module.symbol == CUT or (module.symbol[:1] == "?" and len(module.symbol) > 1):
            raise ModelValueError(
                f'The word of step {step} has the module "{quotable(module.symbol)}", which is no letter '
                "that rules alone replace",
                hint="Such a module cuts a branch, or asks what the turtle sees.",
            )
    return row


def _printed_modules(text: str) -> Iterable[Module]:
    for found in MODULE.finditer(text.rstrip()):
        yield Module(found[1], tuple(normalised(Fraction(value)) for value in found[2].split(",")) if found[2] else ())


def _module(given: object, step: int) -> Module:
    if isinstance(given, str) and given.strip():
        return Module(given)
    if not isinstance(given, Module):
        raise ModelValueError(f"The word of step {step} must be a text or a row of modules, and has {shown(given)}")
    if any(map(is_symbolic, given.arguments)):
        raise ModelValueError(
            f"The word of step {step} has {quotable(str(given))}, whose value is not known",
            hint="Give the constants of the system numbers.",
        )
    return Module(given.symbol, given.arguments)


def text_of(row: Iterable[Module]) -> str:
    """A word as a message shows it: ε where it is empty, without its middle where it is long.

    >>> text_of([]), text_of([Module("al"), Module("br")])
    ('ε', 'al br')
    """
    text = joined(map(str, row)) or "ε"
    return quotable(text if len(text) <= 70 else f"{text[:40]} ... {text[-20:]}")


BRACKETS = frozenset("[]")
FIRST_CHARACTER = 0xF0000
"""Modules are written as characters from here on, which have no other meaning (Unicode's planes for private use)."""


@dataclass(frozen=True)
class Letter:
    """A module with the modules to its left, in the order written, and to its right.

    >>> print(Letter((Module("b"),), Module("a")))
    b < a
    """

    left: Row
    module: Module
    right: Row = ()

    def __str__(self) -> str:
        left = f"{' '.join(map(str, self.left))} < " if self.left else ""
        return f"{left}{self.module}" + (f" > {' '.join(map(str, self.right))}" if self.right else "")


REST = Letter((), Module(""))
"""What stands for all letters behind some place."""
Table: TypeAlias = dict[Letter, Row]
"""What becomes of each letter."""


@dataclass(frozen=True)
class Conditions:
    """What systems are looked for: symbols that stay as they are, whether a letter may become nothing, and how many neighbours
    to the left and to the right a production may look at."""

    constants: frozenset[str] = frozenset("+-")
    erasing: bool = False
    context: tuple[int, int] = (0, 0)

    @property
    def unchanged(self) -> frozenset[str]:
        """Constants and brackets."""
        return self.constants | BRACKETS


@dataclass(frozen=True)
class Problem:
    """Equations for the successors of letters.

    A number in an equation is a place in `letters`, a character of a known word stands for one of the `modules`. The question
    is not `possible` where the known letters alone contradict the words; it is `nested` where the brackets of a successor must
    be, since contexts follow branches.
    """

    letters: tuple[Letter, ...]
    modules: tuple[Module, ...]
    equations: tuple[Equation, ...]
    bounds: Bounds
    possible: bool
    nested: bool


def problem_of(words: Sequence[Row], conditions: Conditions, last: int | None = None) -> Problem:
    """The question that words ask; with `last`, so many letters of the last word but one have successors, and those behind it
    become whatever is left."""
    codes: dict[Module, str] = {}
    for word in words:
        for module in counted(word):
            codes.setdefault(module, chr(FIRST_CHARACTER + len(codes)))
    numbers: dict[Letter, int] = {}
    rows = [
        [
            codes[letter.module] if letter.module.symbol in conditions.unchanged else numbers.setdefault(letter, len(numbers))
            for letter in letters_of(word, conditions)
        ]
        for word in words[:-1]
    ]
    behind = 0 if last is None else len(rows[-1]) - last
    if behind:
        rows[-1][last:] = [numbers.setdefault(REST, len(numbers))]
    texts = ["".join(codes[module] for module in word) for word in words[1:]]
    equations = [put_in(Equation(tuple(row), text), {}) for row, text in zip(rows, texts, strict=True)]
    left = tuple(equation for equation in equations if equation and equation.items)
    bounds = first_bounds(left, len(numbers), conditions.erasing)
    if behind:
        bounds.least[-1, -1] = 0 if conditions.erasing else behind
    return Problem(tuple(numbers), tuple(codes), left, bounds, None not in equations, conditions.context != (0, 0))


def letters_of(word: Row, conditions: Conditions) -> Iterator[Letter]:
    """The letters of a word: its modules with their neighbours."""
    if conditions.context == (0, 0):
        yield from (Letter((), module) for module in counted(word))
        return
    around = neighbours([module.symbol for module in word], Passing(conditions.constants))
    for place in counted(range(len(word)), max(1, INTERVAL // max(1, sum(conditions.context)))):
        left = neighbours_along(around.before, place, conditions.context[0])
        right = neighbours_along(around.after, place, conditions.context[1])
        yield Letter(tuple(word[at] for at in reversed(left)), word[place], tuple(word[at] for at in right))


def tables(problem: Problem, trials: Trials | None = None) -> Iterator[Table]:
    """All answers, one after another; `GivenUp` where so many trials do not suffice."""
    if problem.possible:
        for solution in solutions(problem.equations, problem.bounds, trials):
            table = table_of(problem, solution)
            if not problem.nested or all(map(well_nested, table.values())):
                yield table


def counted_tables(problem: Problem, trials: Trials | None = None) -> Count:
    """How many answers there are, and what letters become in any of them; `GivenUp` where so many trials do not suffice."""
    if not problem.possible:
        return Count(0)
    usable = (lambda text: well_nested(tuple(modules_of(problem, text)))) if problem.nested else (lambda _: True)
    return count_of(problem.equations, problem.bounds, usable, trials)


def well_nested(word: Row) -> bool:
    """Whether each bracket of a word has its partner.

    >>> well_nested((Module("["), Module("a"), Module("]"))), well_nested((Module("]"), Module("[")))
    (True, False)
    """
    depth = 0
    for module in word:
        depth += (module.symbol in OPENING) - (module.symbol in CLOSING)
        if depth < 0:
            return False
    return depth == 0


def table_of(problem: Problem, solution: Solution) -> Table:
    """A solution, with modules in place of numbers and characters."""
    return {problem.letters[letter]: tuple(modules_of(problem, solution[letter])) for letter in sorted(solution)}


def modules_of(problem: Problem, text: str) -> Iterable[Module]:
    """The modules that a known word stands for."""
    return (problem.modules[ord(character) - FIRST_CHARACTER] for character in text)
