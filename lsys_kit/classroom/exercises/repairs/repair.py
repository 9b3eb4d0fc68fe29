"""What a repair is: a change of a wrong answer that may make it right, and what is said of it if it does."""

from __future__ import annotations

import re
from collections import Counter
from collections.abc import Callable, Iterator, Sequence
from dataclasses import dataclass
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.notation.model.modules import CLOSING, OPENING, Module, Pattern


@dataclass(frozen=True)
class Repair:
    """A change of a wrong answer.

    Attributes
    ----------
    answer
        Makes the answer with the change; it may fail, where that is no answer at all.
    said
        What is said if it is right then: what kind of thing is to be changed, and where; never what should stand there.
    near
        Whether it is a small change, so that the answer is nearly right.
    case
        Whether the place at which the answer first differs, or a case in which it does, says more.
    changes
        How many changes it is made of.
    """

    answer: Callable[[], object]
    said: Callable[[], str]
    near: bool = True
    case: bool = False
    changes: int = 1


Repairs: TypeAlias = Callable[[Exercise, Any, Any], Iterator[Repair]]
"""From an exercise, a wrong answer and the solution to changes of the answer, the smallest first."""

# Rows of modules


TURNS = frozenset("+-&^/\\|")
"""The symbols that turn the turtle."""


def class_of(symbol: str) -> str:
    """What kind of symbol it is, for a reply.

    >>> class_of("+"), class_of("]"), class_of("F"), class_of("ar")
    ('sign', 'bracket', 'stroke', 'module')
    """
    if symbol in TURNS:
        return "sign"
    if symbol in OPENING | CLOSING:
        return "bracket"
    return "stroke" if symbol in ("F", "f") else "module"


def row_change(own: Sequence[object], right: Sequence[object]) -> str:
    """How a row differs from the right one: the name of a reply of the place `repair`.

    >>> rows = [[*map(Module, text)] for text in ("F[+F]", "F[-F]", "F[+F", "F+F", "[+F]F", "FFF")]
    >>> [row_change(rows[0], row) for row in rows[1:]]
    ['changed_sign', 'extra_bracket', 'brackets_extra', 'order', 'several']
    """
    first = 0
    while first < min(len(own), len(right)) and own[first] == right[first]:
        first += 1
    last = 0
    while last < min(len(own), len(right)) - first and own[-1 - last] == right[-1 - last]:
        last += 1
    mine, wanted = list(own[first : len(own) - last]), list(right[first : len(right) - last])
    if abs(len(own) - len(right)) > 1 and _has_more_brackets(right, own):
        return "brackets_missing"
    if abs(len(own) - len(right)) > 1 and _has_more_brackets(own, right):
        return "brackets_extra"
    if len(mine) + len(wanted) == 1:
        return f"missing_{_class(wanted[0])}" if wanted else f"extra_{_class(mine[0])}"
    if not mine or not wanted:
        return "missing_several" if wanted else "extra_several"
    if len(mine) == len(wanted) == 1:
        return _changed(mine[0], wanted[0])
    if Counter(map(str, mine)) == Counter(map(str, wanted)):
        return "order"
    return "several"


def _symbol(part: object) -> str:
    return part.symbol if isinstance(part, Module | Pattern) else ""


def _class(part: object) -> str:
    return class_of(_symbol(part))


def _is_bracket(part: object) -> bool:
    return _class(part) == "bracket"


def _has_more_brackets(longer: Sequence[object], shorter: Sequence[object]) -> bool:
    """Whether a row is another one with more brackets."""
    rest = iter(shorter)
    part = next(rest, None)
    for each in longer:
        if each == part:
            part = next(rest, None)
        elif not _is_bracket(each):
            return False
    return part is None


def _changed(mine: object, wanted: object) -> str:
    if _symbol(mine) == _symbol(wanted):
        if isinstance(mine, Module | Pattern) and not mine.arguments:
            return "missing_argument"
        return "changed_number" if _differ_in_a_number(mine, wanted) else "changed_argument"
    if {_symbol(mine), _symbol(wanted)} == {"F", "f"}:
        return "changed_pen"
    return f"changed_{_class(mine)}" if _class(mine) == _class(wanted) != "stroke" else "changed_module"


def _differ_in_a_number(mine: object, wanted: object) -> bool:
    """Whether two modules are the same but for numbers, with the same operators."""
    forms = [re.sub(r"\d+(?:\.\d+)?(?:/\d+)?", "0", str(each).replace(" ", "")) for each in (mine, wanted)]
    return forms[0] == forms[1]


def said_of_row(own: Sequence[object], right: Sequence[object]) -> str:
    """What is said of a row that differs from the right one."""
    return reply(f"repair.{row_change(own, right)}")
