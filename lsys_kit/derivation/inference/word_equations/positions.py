"""Where in the known word the successor of each letter can begin: sets of positions, as the bits of whole numbers."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from functools import lru_cache
from typing import Protocol

from lsys_kit.derivation.inference.word_equations.equations import Equation


class Lengths(Protocol):
    """The shortest and the longest successor that each letter can have."""

    def shortest(self, letter: int) -> int: ...
    def longest(self, letter: int) -> int: ...


def cuts(equation: Equation, lengths: Lengths) -> list[int] | None:
    """For each gap between the items the positions where it can be; None where the equation has no solution.

    It is known from the left where the successors up to a gap can end, from the right where those behind it can begin.

    >>> class OneOrTwo:
    ...     shortest, longest = (lambda self, letter: 1), (lambda self, letter: 2)
    >>> [list(bits(gap)) for gap in cuts(Equation((0, "b", 1), "abbb"), OneOrTwo())]
    [[0], [1, 2], [2, 3], [4]]
    """
    size = len(equation.target)
    last = 1 << size
    ends = [1]
    for item in equation.items:
        if isinstance(item, str):
            ends.append((ends[-1] & occurrences(item, equation.target)) << len(item))
        else:
            ends.append(smeared(ends[-1], lengths.shortest(item), min(lengths.longest(item), size)) & (2 * last - 1))
    here = ends[-1] & last
    found = [here]
    for item, end in zip(reversed(equation.items), reversed(ends[:-1]), strict=True):
        if isinstance(item, str):
            here = here >> len(item)
        else:
            longest = min(lengths.longest(item), size)
            here = smeared(here, 0, longest - lengths.shortest(item)) >> longest
        here &= end
        found.append(here)
    return found[::-1] if here else None


def smeared(positions: int, shortest: int, longest: int) -> int:
    """All positions that are so many further on.

    >>> [*bits(smeared(0b1001, 1, 2))]
    [1, 2, 4, 5]
    """
    positions, done, wanted = positions << shortest, 1, longest - shortest + 1
    while done < wanted:
        further = min(done, wanted - done)
        positions |= positions << further
        done += further
    return positions


@lru_cache(maxsize=4096)
def occurrences(word: str, text: str) -> int:
    """The positions at which a word occurs in a text.

    >>> [*bits(occurrences("aa", "aaab"))]
    [0, 1]
    """
    found, at = 0, text.find(word)
    while at >= 0:
        found |= 1 << at
        at = text.find(word, at + 1)
    return found


def bits(positions: int) -> Iterator[int]:
    """The positions of a set, in their order."""
    while positions:
        least = positions & -positions
        yield least.bit_length() - 1
        positions ^= least


def least(positions: int) -> int:
    """The first position of a set."""
    return (positions & -positions).bit_length() - 1


def greatest(positions: int) -> int:
    """The last position of a set."""
    return positions.bit_length() - 1


def parts(equation: Equation, gaps: Sequence[int]) -> Iterator[Equation]:
    """The equations into which one falls where only one position is possible for a gap.

    >>> [*parts(Equation((0, "b", 1), "abcc"), [1, 2, 4, 16])]
    [Equation(items=(0,), target='a'), Equation(items=('b',), target='b'), Equation(items=(1,), target='cc')]
    """
    begin = 0
    for end in range(1, len(gaps)):
        if gaps[end] & (gaps[end] - 1) == 0:
            yield Equation(equation.items[begin:end], equation.target[least(gaps[begin]) : least(gaps[end])])
            begin = end
