"""The words that draw strokes in a given way."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass

from lsys_kit.geometry.inference.traversals import START, Traversal


@dataclass(frozen=True)
class Apex:
    """A letter that draws nothing.

    Attributes
    ----------
    turns
        The number of turns to the left before it.
    symbol
        The letter.
    """

    turns: int
    symbol: str = "X"


def turns_text(number: int) -> str:
    """So many turns, to the left where the number is positive.

    >>> turns_text(2), turns_text(-1)
    ('++', '-')
    """
    return "+" * number or "-" * -number


def word_of(way: Traversal, behind: int = 0) -> str:
    """The word that draws in some way, with so many turns behind it.

    >>> word_of(Traversal((-1, 0, 0), (0, 1, 0), (0, 1, 2, 3), last=2))
    'F[+F]F'
    >>> word_of(Traversal((-1, 0), (0, 1), (0, 1, 2), last=-1), 2)
    '[F+F]++'
    """
    main = {START}
    at = way.last
    while at != START:
        main.add(at)
        at = way.before[at]
    return _from(way, START, main, {}) + turns_text(behind)


def word_with(way: Traversal, apices: Mapping[int, Sequence[Apex]]) -> str:
    """The word that draws in some way, with letters at the ends of strokes; it does not matter where the turtle ends.

    >>> word_with(Traversal((-1, 0), (0, 1), (0, 1, 2), last=-1), {0: [Apex(-1)], 1: [Apex(2)]})
    'F[-X]+F++X'
    """
    return _from(way, START, set(), apices)


def _from(way: Traversal, behind: int, main: set[int], apices: Mapping[int, Sequence[Apex]]) -> str:
    """What is drawn from the end of a stroke on: branches in brackets, then what needs none."""
    following = [each for each in range(len(way)) if way.before[each] == behind]
    parts = [
        (each in main, turns_text(way.turns[each]) + "F" + _from(way, each, main, apices))
        for each in sorted(following, key=lambda each: (each in main, -abs(way.turns[each]), -way.turns[each]))
    ]
    parts = [*((False, turns_text(apex.turns) + apex.symbol) for apex in apices.get(behind, ())), *parts]
    if not parts:
        return ""
    bare = parts[-1][0] or behind not in main
    return "".join(f"[{text}]" for _, text in (parts[:-1] if bare else parts)) + (parts[-1][1] if bare else "")
