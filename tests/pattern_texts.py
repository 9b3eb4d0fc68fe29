"""Texts made from a regular expression: what leads to each repetition in it, and what that repeats."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import zip_longest
from re import _compiler, _constants, _parser  # type: ignore[attr-defined]
from typing import Any

CHARACTERS = 'a"A1 _\t\n(-,*.\\=!#<[{ε'
"""What sets of characters are tried with."""
MOST = 9
"""So many samples of a part, and the most repetitions that are no repetition without end."""
REPEATS = (_constants.MAX_REPEAT, _constants.MIN_REPEAT, _constants.POSSESSIVE_REPEAT)


def repetitions(pattern: re.Pattern[str]) -> list[tuple[str, str]]:
    """A text that leads to each repetition without end in a pattern, and a text that it repeats.

    >>> repetitions(re.compile("b(?:c|dd)*"))
    [('b', 'c'), ('b', 'dd')]
    """
    return [*dict.fromkeys(_repetitions(_parser.parse(pattern.pattern, pattern.flags), ""))]


def repeats_wrongly(pattern: str) -> bool:
    r"""Whether a pattern repeats possessively what may fail in its middle, behind a repetition or something looked for: Python
    before 3.11.5 then goes on where that failed.

    >>> [repeats_wrongly(each) for each in (r"(?:,\d++)?+", r"(?:(?!b)a)*+", r"(?>(?:,\d++)?)", r"(?:ab)*+")]
    [True, True, False, False]
    """
    return _repeats_wrongly(_parser.parse(pattern))


def _repeats_wrongly(parts: Any) -> bool:
    return any(
        (operator is _constants.POSSESSIVE_REPEAT and _may_fail(operand[2], False))
        or any(_repeats_wrongly(part) for part in _parts(operator, operand))
        for operator, operand in parts
    )


def _may_fail(parts: Any, begun: bool) -> bool:
    for operator, operand in parts:
        looks = operator in (_constants.ASSERT, _constants.ATOMIC_GROUP, *REPEATS)
        if operator is _constants.ASSERT_NOT or (begun and looks):
            return True
        grouped = _parts(operator, operand) if operator in (_constants.BRANCH, _constants.SUBPATTERN) else []
        if any(_may_fail(part, begun) for part in grouped):
            return True
        begun = begun or operator not in (_constants.ASSERT, _constants.AT)
    return False


def _repetitions(parts: Any, before: str) -> Iterator[tuple[str, str]]:
    for operator, operand in parts:
        if operator in REPEATS and operand[1] > MOST:
            yield from ((before, piece) for piece in _samples(operand[2]) if piece)
        for part in _parts(operator, operand):
            yield from _repetitions(part, before)
        before += _of_one(operator, operand)[0]


def _parts(operator: Any, operand: Any) -> list[Any]:
    """The parts of one part of a pattern."""
    if operator is _constants.BRANCH:
        return [*operand[1]]
    if operator is _constants.ATOMIC_GROUP:
        return [operand]
    if operator in (*REPEATS, _constants.SUBPATTERN, _constants.ASSERT, _constants.ASSERT_NOT):
        return [operand[-1]]
    return []


def _samples(parts: Any) -> list[str]:
    """Texts that a part of a pattern matches, looking neither ahead nor back."""
    found = [""]
    for operator, operand in parts:
        each = _of_one(operator, operand)
        found = [*dict.fromkeys([found[0] + one for one in each] + [one + each[0] for one in found])][:MOST]
    return found


def _of_one(operator: Any, operand: Any) -> list[str]:
    if operator is _constants.LITERAL:
        return [chr(operand)]
    if operator in (_constants.IN, _constants.NOT_LITERAL, _constants.ANY):
        return _of_set(operator, operand)
    if operator in (_constants.ASSERT, _constants.ASSERT_NOT, _constants.AT, _constants.GROUPREF):
        return [""]
    alternatives = zip_longest(*map(_samples, _parts(operator, operand)))  # some of each
    found = [*dict.fromkeys(one for each in alternatives for one in each if one is not None)]
    if operator in REPEATS:
        return ([] if operand[0] else [""]) + [one * max(operand[0], 1) for one in found]
    return found


def _of_set(operator: Any, operand: Any) -> list[str]:
    """Some characters of a set."""
    named = (
        [
            chr(value if kind is _constants.LITERAL else value[0])
            for kind, value in operand
            if kind in (_constants.LITERAL, _constants.RANGE)
        ]
        if operator is _constants.IN
        else []
    )
    fits = _compiler.compile(_parser.SubPattern(_parser.State(), [(operator, operand)])).fullmatch
    return [each for each in dict.fromkeys((*CHARACTERS, *named)) if fits(each)][:MOST]
