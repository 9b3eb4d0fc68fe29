"""Equations between words: each says that the successors of some unknown letters, one behind the other, are a known word.

A letter of unknown successor is a number, a known word a text with one character for each module.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Mapping
from dataclasses import dataclass
from itertools import groupby
from typing import TypeAlias

Item: TypeAlias = int | str
"""A part of the left side: an unknown letter, or a known word."""
Successors: TypeAlias = Mapping[int, str]
"""For each letter the word that replaces it."""


@dataclass(frozen=True)
class Equation:
    """The words that stand for `items`, one behind the other, are `target`."""

    items: tuple[Item, ...]
    target: str

    @property
    def unknowns(self) -> Iterator[int]:
        """Its unknown letters, in their order, as often as they occur."""
        return (item for item in self.items if isinstance(item, int))


def put_in(equation: Equation, known: Successors) -> Equation | None:
    """The equation with known successors in place of their letters, without what is known at both ends; None where they differ.

    >>> put_in(Equation((0, 1, 0, 2), "abcab"), {0: "ab"})
    Equation(items=(1, 'ab', 2), target='cab')
    >>> put_in(Equation((0, 1), "abc"), {0: "b"}) is None
    True
    """
    items, target = merged(known.get(item, item) if isinstance(item, int) else item for item in equation.items), equation.target
    if items and isinstance(front := items[0], str):
        if not target.startswith(front):
            return None
        items, target = items[1:], target[len(front) :]
    if items and isinstance(back := items[-1], str):
        if not target.endswith(back):
            return None
        items, target = items[:-1], target[: len(target) - len(back)]
    return Equation(tuple(items), target) if items or not target else None


def merged(items: Iterable[Item]) -> list[Item]:
    """Items with neighbouring known words joined, and without empty ones.

    >>> merged([0, "a", "", "b", 1])
    [0, 'ab', 1]
    """
    found: list[Item] = []
    for known, group in groupby(items, lambda item: isinstance(item, str)):
        if not known:
            found += group
        elif text := "".join(group):  # type: ignore[arg-type]
            found.append(text)
    return found


def linked(equations: Iterable[Equation]) -> list[list[Equation]]:
    """Equations in groups that have no unknown letter in common, so that each can be solved for itself, small groups first.

    >>> [len(group) for group in linked([Equation((0, 1), "a"), Equation((2,), "b"), Equation((1, 3), "c")])]
    [1, 2]
    """
    groups: list[tuple[set[int], list[Equation]]] = []
    for equation in equations:
        letters, together = set(equation.unknowns), [equation]
        apart = []
        for others, group in groups:
            if letters.isdisjoint(others):
                apart.append((others, group))
            else:
                letters, together = letters | others, group + together
        groups = [*apart, (letters, together)]
    return [group for letters, group in sorted(groups, key=lambda found: len(found[0]))]
