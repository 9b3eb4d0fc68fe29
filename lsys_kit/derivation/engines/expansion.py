"""Expansion: the word of a step, built without the words of earlier steps.

The length of what a state becomes in k steps is known beforehand, so each piece has its place in one array. What a state
becomes in k steps is written where it is first needed, and every later occurrence is a copy of that stretch.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from functools import lru_cache
from typing import Any

import numpy as np

from lsys_kit.budget import check_budget, counted
from lsys_kit.derivation.core.states import States

BYTES = 256
"""How many different bytes there are."""
MOST_LISTED = 4_096
"""Words up to this length are lists, which are quicker than arrays at that size."""
MODULES_BETWEEN_CHECKS = 2**16
"""The budget is checked after so many modules that are written one by one or copied."""
STEPS_BETWEEN_CHECKS = 10
"""The budget is checked after so many steps of a few thousand states at most."""
PIECE = 64
"""Pieces up to this length, at least 1, are assembled as tuples and written at once."""


@lru_cache(maxsize=1_024)
def code_type(states: int) -> np.dtype[Any]:
    """The smallest unsigned type that can number so many states."""
    return np.min_scalar_type(max(states - 1, 0))


def compact(codes: Sequence[int], states: int) -> Sequence[int] | np.ndarray[Any, Any]:
    """A word of a table of so many states: a list where it is short, else an array of the smallest type."""
    return codes if len(codes) <= MOST_LISTED else np.array(codes, code_type(states))


class ByteTable:
    """Rows of states by number, where both fit into bytes: a string of numbers is replaced by `bytes.translate` and `replace`.

    Attributes
    ----------
    known
        The numbers whose rows are in the table.

    Notes
    -----
    A number whose row has one state is translated. One whose row has several states, or none, is translated into a byte that
    stands for no state, and that byte is replaced by the row: so what is put in is never replaced itself. For words of 3,000
    and of a million modules this takes a quarter to a twentieth of the time of any way through arrays of places.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> table = ByteTable(states)
    >>> [table.add(state, states.successor(state)) for state in (0, 1)]
    [True, True]
    >>> table.replaced(bytes([0, 1, 0])).tolist()
    [0, 1, 0, 0, 1]
    """

    def __init__(self, states: States) -> None:
        self.states = states
        self.known: set[int] = set()
        self._table = bytearray(range(BYTES))
        self._several: list[tuple[bytes, bytes]] = []

    def add(self, number: int, row: Sequence[int]) -> bool:
        """Put the row of a number into the table; False where bytes run out."""
        if number in self.known:
            return True
        free = BYTES - 1 - len(self._several)
        if number >= BYTES or free < len(self.states):
            return False
        if len(row) != 1:
            self._several.append((bytes((free,)), bytes(row)))
        self._table[number] = row[0] if len(row) == 1 else free
        self.known.add(number)
        return True

    def replaced(self, word: bytes) -> np.ndarray[Any, np.dtype[np.uint8]]:
        """The rows of some numbers, one after another."""
        word = word.translate(self._table)
        for free, row in self._several:
            word = word.replace(free, row)
        return np.frombuffer(word, np.uint8)


def expand(states: States, present: Sequence[Collection[int]]) -> np.ndarray[Any, Any]:
    """The word of the last step, as an array of states.

    Parameters
    ----------
    states
        The table.
    present
        The states that occur in the word of each step.

    Returns
    -------
    numpy.ndarray
        The codes, of the smallest unsigned integer type that holds them.
    """
    sizes = _sizes(states, present)
    pieces = _pieces(states, present, sizes)
    word = np.empty(sum(sizes[0][state] for state in states.axiom), dtype=code_type(len(states)))
    written: dict[tuple[int, int], int] = {}
    todo = [(state, 0) for state in reversed(states.axiom)]
    at = look = 0
    while todo:
        state, step = todo.pop()
        if at >= look:
            check_budget()
            look = at + MODULES_BETWEEN_CHECKS
        size = sizes[step][state]
        if size <= PIECE:
            word[at : at + size] = pieces[step][state]
        elif (state, step) in written:
            start = written[state, step]
            word[at : at + size] = word[start : start + size]
        else:
            written[state, step] = at
            todo += [(successor, step + 1) for successor in reversed(states.successor(state))]
            continue
        at += size
    return word


def _sizes(states: States, present: Sequence[Collection[int]]) -> list[dict[int, int]]:
    """For each step and state the length of what the state becomes by the last step."""
    sizes = [dict.fromkeys(present[-1], 1)]
    for here in counted(reversed(present[:-1]), STEPS_BETWEEN_CHECKS):
        after = sizes[-1]
        sizes.append({state: sum(after[s] for s in states.successor(state)) for state in here})
    return sizes[::-1]


def _pieces(
    states: States, present: Sequence[Collection[int]], sizes: Sequence[dict[int, int]]
) -> list[dict[int, tuple[int, ...]]]:
    """For each step and state whose size is small, what the state becomes by the last step."""
    pieces: list[dict[int, tuple[int, ...]]] = [{state: (state,) for state in present[-1]}]
    for step in counted(range(len(present) - 2, -1, -1), STEPS_BETWEEN_CHECKS):
        after = pieces[-1]
        pieces.append(
            {
                state: tuple([code for s in states.successor(state) for code in after[s]])
                for state in present[step]
                if sizes[step][state] <= PIECE
            }
        )
    return pieces[::-1]
