"""Repairs of drawings: a character of the word, or a part of the system, from which they were drawn."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Sequence
from dataclasses import replace
from difflib import SequenceMatcher
from functools import partial
from itertools import combinations, pairwise
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.asked import written
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.drawings import Drawn, drawn
from lsys_kit.classroom.exercises.repairs.of_systems import repairs_of
from lsys_kit.classroom.exercises.repairs.repair import Repair, class_of, row_change, said_of_row
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.geometry.sameness import same_strokes
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module
from lsys_kit.notation.model.system import LSystem

Row: TypeAlias = tuple[Module, ...]
MOST_MODULES = 60
"""In longer words only what is to be changed towards the solution is looked for."""
MOST_AT_ONCE = 2
"""So many modules are changed at one place where another place is changed too."""
MIRRORED = {"+": "-", "-": "+"}
PAIRS = ("[]", "()")
"""Brackets that belong together."""
ALIKE = ("+-", "Ff", "[]", "()", "[(", "])")
"""Symbols that are easily taken for one another."""


def of_drawings(exercise: Exercise, mine: Drawn, wanted: Drawn) -> Iterator[Repair]:
    """Repairs of a drawing: of its word, where a word was typed, else of its system."""
    system, target = mine.derivation.states.system, wanted.derivation.states.system
    if len(mine.derivation) == 1:
        word, right = tuple(mine.derivation[0]), _nearest(exercise, tuple(mine.derivation[0]), wanted)
        if not exercise.system and system.angle != target.angle:
            turned = replace(system, angle=target.angle)
            yield Repair(partial(_drawn, turned, word), partial(reply, "repair.angle"))
        for changed in filter(_is_balanced, _towards(word, right)):
            yield Repair(partial(_drawn, system, changed), partial(said_of_row, word, changed), case=True)
        for changed in filter(_is_balanced, _alike_words(word)):
            yield Repair(partial(_drawn, system, changed), partial(said_of_row, word, changed), case=True)
        for one, other in _word_pairs(word, right):
            if not _is_balanced(other):
                continue
            yield Repair(partial(_drawn, system, other), partial(_two_said, word, one, other), near=False, case=True, changes=2)
        for changed in filter(_is_balanced, _words(word, right)):
            yield Repair(partial(_drawn, system, changed), partial(said_of_row, word, changed), case=True)
    else:
        yield from repairs_of(system, target, partial(drawn, exercise), settings=("angle",))


def _drawn(system: LSystem, word: Row) -> Drawn:
    return Drawn(written(system, word))


def _nearest(exercise: Exercise, word: Row, wanted: Drawn) -> Row:
    """The right word, or that which turns the other way throughout, where it is right too and more like an answer."""
    right = tuple(wanted.derivation[-1])
    other = tuple(replace(each, symbol=MIRRORED.get(each.symbol, each.symbol)) for each in right)
    system = wanted.derivation.states.system
    if other == right or len(right) > MOST_MODULES:
        return right
    if not same_strokes(_drawn(system, other).strokes, wanted.strokes, turned=not exercise.drawn):
        return right
    return max((right, other), key=lambda row: SequenceMatcher(None, word, row, autojunk=False).ratio())


def _is_balanced(word: Row) -> bool:
    """Whether each closing bracket has its opening one, and something in between: others may be drawn right by chance.

    >>> _is_balanced(tuple(map(Module, "F[+F]"))), _is_balanced(tuple(map(Module, "F]")))
    (True, False)
    """
    if any(one.symbol in OPENING and other.symbol in CLOSING for one, other in pairwise(word)):
        return False
    opened: list[str] = []
    for module in word:
        if module.symbol in OPENING:
            opened.append(module.symbol)
        elif module.symbol in CLOSING and (not opened or f"{opened.pop()}{module.symbol}" not in PAIRS):
            return False
    return not opened


def _two_said(word: Row, one: Row, both: Row) -> str:
    """What is said of two changes: a pair of brackets, the order, or one of them where that is sure."""
    changed = [(a.symbol, b.symbol) for a, b in zip(word, both, strict=False) if a != b]
    if len(word) == len(both) and len(changed) == 2 and all(class_of(each) == "bracket" for pair in changed for each in pair):
        return reply("repair.changed_brackets")
    if row_change(word, both).startswith("brackets") or Counter(map(str, word)) == Counter(map(str, both)):
        return reply("repair.order") if len(word) == len(both) else said_of_row(word, both)
    if _brackets_in(word) - _brackets_in(both) > 1:
        return f"{reply('repair.two')} {reply('repair.brackets_extra')}"
    return f"{reply('repair.two')} {said_of_row(word, one)}"


def _brackets_in(word: Row) -> int:
    return sum(class_of(module.symbol) == "bracket" for module in word)


def _words(word: Row, right: Row) -> Iterator[Row]:
    """A word with one thing left out or added anywhere."""
    if len(word) > MOST_MODULES:
        return
    for at in range(len(word)):
        yield (*word[:at], *word[at + 1 :])
    for new in dict.fromkeys((*word, *right)):
        for at in range(len(word) + 1):
            yield (*word[:at], new, *word[at:])


def _alike_words(word: Row) -> Iterator[Row]:
    """A word with one symbol taken for another, or with two neighbours exchanged."""
    if len(word) > MOST_MODULES:
        return
    for at, module in enumerate(word):
        for pair in ALIKE:
            if module.symbol in pair:
                yield (*word[:at], replace(module, symbol=pair[1 - pair.index(module.symbol)]), *word[at + 1 :])
        if at + 1 < len(word) and word[at + 1] != module:
            yield (*word[:at], word[at + 1], module, *word[at + 2 :])


def _operations(word: Row, right: Row) -> list[tuple[str, int, int, int, int]]:
    return [each for each in SequenceMatcher(None, word, right, autojunk=False).get_opcodes() if each[0] != "equal"]


def _made(word: Row, right: Row, operations: Sequence[tuple[str, int, int, int, int]]) -> Row:
    row: list[Any] = list(word)
    for _, start, end, first, last in reversed(operations):
        row[start:end] = right[first:last]
    return tuple(row)


def _towards(word: Row, right: Row) -> Iterator[Row]:
    for operation in _operations(word, right):
        yield _made(word, right, [operation])


def _word_pairs(word: Row, right: Row) -> Iterator[tuple[Row, Row]]:
    """Two changes towards the solution, small ones or an exchange: the word with one of them, and with both."""
    for one, other in combinations(_operations(word, right), 2):
        both = _made(word, right, [one, other])
        are_small = all(max(each[2] - each[1], each[4] - each[3]) <= MOST_AT_ONCE for each in (one, other))
        if are_small or Counter(map(str, word)) == Counter(map(str, both)):
            yield _made(word, right, [one]), both
