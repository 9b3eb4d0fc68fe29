"""Lanes: parallel lines side by side, in an order with few crossings.

A stretch is the straight part of a line that runs in a lane. At both ends the line turns off, to one side (-1: up or left) or
the other (+1: down or right), and crosses the stretches that it meets there.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import TypeAlias

from lsys_kit.budget import counted

Stretch: TypeAlias = tuple[tuple[float, int], tuple[float, int]]
"""Two ends: for each its position along the lane and the side to which the line turns off."""


def crossings(first: Stretch, second: Stretch) -> int:
    """The number of crossings of two lines, if the lane of the first lies on the -1 side of that of the second.

    >>> crossings(((0, 1), (3, 1)), ((1, 1), (2, 1))), crossings(((1, 1), (2, 1)), ((0, 1), (3, 1)))
    (0, 2)
    """
    count = sum(side > 0 and _inside(end, second) for end, side in first)
    count += sum(side < 0 and _inside(end, first) for end, side in second)
    for end, side in first:
        count += sum(end == other and side > 0 > way and _onward(end, first) == _onward(other, second) for other, way in second)
    return count


def ordered(stretches: Sequence[Stretch]) -> list[int]:
    """The numbers of the stretches in the order of their lanes, from the -1 side.

    Initially longer stretches lie outside, and later ones before earlier ones of the same length; then each is moved to its
    best place until no move reduces the crossings.

    >>> ordered([((1, 1), (2, 1)), ((0, 1), (3, 1))])
    [1, 0]
    """
    order = sorted(range(len(stretches)), key=lambda i: (-_stretch_length(stretches[i]), -i))
    cost = [[crossings(a, b) for b in stretches] for a in counted(stretches, 1)]
    improved = True
    while improved:
        improved = False
        for number in counted(tuple(order), 1):
            improved |= _moved_to_best_place(order, number, cost)
    return order


def _moved_to_best_place(order: list[int], number: int, cost: Sequence[Sequence[int]]) -> bool:
    """Move a stretch to the place with the fewest crossings; tell whether that helped."""
    now = order.index(number)
    rest = order[:now] + order[now + 1 :]
    totals = [sum(cost[number][other] for other in rest)]
    for other in rest:
        totals.append(totals[-1] - cost[number][other] + cost[other][number])
    best = min(range(len(totals)), key=lambda place: (totals[place], abs(place - now)))
    if totals[best] == totals[now]:
        return False
    order[:] = [*rest[:best], number, *rest[best:]]
    return True


def levels(stretches: Sequence[Stretch], order: Sequence[int]) -> list[int]:
    """The lane of each stretch, from 0: stretches that do not overlap share a lane, and the order is kept.

    >>> levels([((0, 1), (1, 1)), ((2, 1), (3, 1)), ((0, 1), (3, 1))], [0, 1, 2])
    [0, 0, 1]
    """
    found = [0] * len(stretches)
    for place, number in enumerate(order):
        found[number] = max(
            (found[other] + 1 for other in order[:place] if _meet(stretches[number], stretches[other])), default=0
        )
    return found


def _low(stretch: Stretch) -> float:
    return min(stretch[0][0], stretch[1][0])


def _high(stretch: Stretch) -> float:
    return max(stretch[0][0], stretch[1][0])


def _stretch_length(stretch: Stretch) -> float:
    return _high(stretch) - _low(stretch)


def _inside(position: float, stretch: Stretch) -> bool:
    return _low(stretch) < position < _high(stretch)


def _onward(end: float, stretch: Stretch) -> bool:
    """Whether a stretch runs towards higher positions from one of its ends."""
    return end == _low(stretch)


def _meet(a: Stretch, b: Stretch) -> bool:
    return _low(a) <= _high(b) and _low(b) <= _high(a)
