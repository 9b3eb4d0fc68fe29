"""The question that words ask: which successors of their letters turn each word into the next?

A letter is a module between its neighbours: the same module between others is another letter, whose successor is free.
Without contexts a letter is a module alone. Constants are known: they stay as they are, and contexts pass over them. So are the
brackets of branches (ABOP, section 1.6.1), which contexts understand.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from dataclasses import dataclass
from math import inf
from typing import TypeAlias

from lsys_kit.budget import INTERVAL, counted
from lsys_kit.derivation.core.matching import Neighbours, Passing, neighbours, neighbours_along
from lsys_kit.derivation.inference.word_equations.bounds import Bounds, first_bounds
from lsys_kit.derivation.inference.word_equations.counting import Count, count_of
from lsys_kit.derivation.inference.word_equations.equations import Equation, put_in
from lsys_kit.derivation.inference.word_equations.search import Solution, solutions
from lsys_kit.derivation.inference.words import Row
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module

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
    """What systems are looked for.

    Attributes
    ----------
    constants
        Symbols that stay as they are.
    erasing
        Whether a letter may become nothing.
    context
        How many neighbours to the left and to the right a production may look at.
    """

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

    Attributes
    ----------
    letters
        The letters whose successors are unknown; a number in an equation is a place here.
    modules
        The modules that a character of a known word stands for.
    equations
        One for each step that has an unknown letter.
    bounds
        How many letters the successors can have.
    possible
        False where the known letters alone contradict the words.
    nested
        Whether the brackets of a successor must be well nested, since contexts follow branches.
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
        yield letter_at(word, around, place, conditions.context)


def letter_at(word: Row, around: Neighbours, place: int, context: tuple[int, int]) -> Letter:
    """The letter at a place of a word."""
    left = neighbours_along(around.before, place, context[0])
    right = neighbours_along(around.after, place, context[1])
    return Letter(tuple(word[at] for at in reversed(left)), word[place], tuple(word[at] for at in right))


def tables(problem: Problem, trials: float = inf) -> Iterator[Table]:
    """All answers, one after another; `GivenUp` where so many trials do not suffice."""
    if problem.possible:
        for solution in solutions(problem.equations, problem.bounds, trials):
            table = table_of(problem, solution)
            if not problem.nested or all(map(well_nested, table.values())):
                yield table


def counted_tables(problem: Problem, trials: float = inf) -> Count:
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
