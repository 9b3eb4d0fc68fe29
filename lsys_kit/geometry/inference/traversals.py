"""The ways in which a turtle can draw strokes: from which point, in which order, where it stands in the end; and their words.

What matters to what a word makes later is which stroke the turtle drew before each, how far it turned between them, and where
it ends: brackets return it to what it drew before. Strokes drawn in one go need no brackets.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from itertools import combinations
from typing import TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.geometry.inference.strokes import Strokes, Turning

START = -1
Numbers: TypeAlias = tuple[int, ...]


@dataclass(frozen=True)
class Traversal:
    """A way to draw strokes.

    before
        For each stroke the number of that at whose end it begins, an earlier one; or `START`.
    turns
        For each stroke the number of turns to the left before it. The first at the start has none.
    points
        The point at which the turtle begins, then for each stroke that at which it ends.
    last
        The stroke at whose end the turtle stands in the end, or `START`.
    """

    before: Numbers
    turns: Numbers
    points: Numbers
    last: int

    def __len__(self) -> int:
        return len(self.before)


@dataclass(frozen=True)
class _Place:
    """A place at which strokes can go on: behind which stroke, at which point, in which direction."""

    behind: int
    point: int
    heading: float | None


@dataclass(frozen=True)
class _Drawn:
    """What has been drawn of a traversal, and which strokes of the drawing that were."""

    before: Numbers
    turns: Numbers
    points: Numbers
    numbers: Numbers


def in_one_go(strokes: Strokes, turning: Turning, size: int) -> Iterator[Traversal]:
    """The ways to draw so many of the strokes one after another, without brackets.

    >>> from lsys_kit.geometry.inference.strokes import read_drawings
    >>> [corner] = read_drawings([[(0, 0, 0, 1), (1, 1, 0, 1)]])
    >>> [each.turns for each in in_one_go(corner, Turning(90), 2)]
    [(0, -1), (0, 1)]
    """
    for start in strokes.leaving:
        for drawn in _going_on(strokes, turning, size, _Drawn((START,), (), (start,), ()), None):
            yield Traversal(drawn.before[:-1], drawn.turns, drawn.points, size - 1)


def _going_on(strokes: Strokes, turning: Turning, size: int, drawn: _Drawn, heading: float | None) -> Iterator[_Drawn]:
    check_budget()
    done = len(drawn.numbers)
    if done == size:
        yield drawn
        return
    for number, end, direction in _free(strokes, drawn.points[-1], drawn.numbers):
        turn = 0 if heading is None else turning.number(direction - heading)
        if turn is not None:
            further = _Drawn((*drawn.before, done), (*drawn.turns, turn), (*drawn.points, end), (*drawn.numbers, number))
            yield from _going_on(strokes, turning, size, further, direction)


def _free(strokes: Strokes, point: int, drawn: Sequence[int]) -> list[tuple[int, int, float]]:
    """The strokes that leave a point and are not drawn yet; of several that lie on one another the first."""
    found: dict[int, tuple[int, int, float]] = {}
    for each in strokes.leaving[point]:
        if each[0] not in drawn:
            found.setdefault(each[1], each)
    return [*found.values()]


def branching(strokes: Strokes, turning: Turning, size: int) -> Iterator[Traversal]:
    """The ways to draw so many of the strokes with branches.

    >>> from lsys_kit.geometry.inference.strokes import read_drawings
    >>> [corner] = read_drawings([[(0, 0, 0, 1), (1, 1, 0, 1)]])
    >>> sum(1 for each in branching(corner, Turning(90), 2))
    9
    """
    for start in strokes.leaving:
        for drawn in _branching(strokes, turning, size, (_Place(START, start, None),), _Drawn((), (), (start,), ())):
            for last in range(START, size):
                yield Traversal(drawn.before, drawn.turns, drawn.points, last)


def _branching(strokes: Strokes, turning: Turning, size: int, places: Sequence[_Place], drawn: _Drawn) -> Iterator[_Drawn]:
    check_budget()
    done = len(drawn.numbers)
    if done == size:
        yield drawn
    elif places and (size < len(strokes) or _all_reached(strokes, places, drawn.numbers)):
        free = [each for each in strokes.leaving[places[0].point] if each[0] not in drawn.numbers]
        for many in range(min(len(free), size - done), -1, -1):
            for chosen in combinations(free, many):
                turns = _turns(places[0], chosen, turning)
                if turns is not None:
                    ends, numbers = [each[1] for each in chosen], [each[0] for each in chosen]
                    further = _Drawn(
                        (*drawn.before, *(places[0].behind,) * many),
                        (*drawn.turns, *turns),
                        (*drawn.points, *ends),
                        (*drawn.numbers, *numbers),
                    )
                    reached = [_Place(done + at, end, direction) for at, (_, end, direction) in enumerate(chosen)]
                    yield from _branching(strokes, turning, size, (*places[1:], *reached), further)


def _turns(place: _Place, chosen: Sequence[tuple[int, int, float]], turning: Turning) -> list[int] | None:
    """The turns from a place to some strokes; None where they are no multiples of the angle."""
    found = []
    for _, _, direction in chosen:
        turn = turning.number(direction - (chosen[0][2] if place.heading is None else place.heading))
        if turn is None:
            return None
        found.append(turn)
    return found


def _all_reached(strokes: Strokes, places: Sequence[_Place], drawn: Sequence[int]) -> bool:
    """Whether all strokes that are not drawn yet can be, from some places."""
    left, seen, reached = [place.point for place in places], set[int](), {*drawn}
    while left:
        point = left.pop()
        if point not in seen:
            seen.add(point)
            free = [(number, end) for number, end, _ in strokes.leaving[point] if number not in drawn]
            reached |= {number for number, _ in free}
            left += [end for _, end in free]
    return len(reached) == len(strokes)


@dataclass(frozen=True)
class Apex:
    """A letter that draws nothing.

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
