"""Counts of states, step after step, from the table of states alone."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator, Mapping, Sequence
from functools import partial
from itertools import count, islice

from lsys_kit.budget import check_budget, check_bytes
from lsys_kit.derivation.core.chance import splitmix64
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.engines.counting import next_counts
from lsys_kit.derivation.growth.recurrences import shortest_rule

OBJECT_BYTES = 36
"""What an integer and its place in a row take, besides its digits."""


def counts_of_steps(table: States) -> Iterator[Mapping[int, int]]:
    """How often each state occurs at step 0, 1, 2, ...

    >>> from lsys_kit.notation.read import read
    >>> [dict(counts) for counts in islice(counts_of_steps(States(read("axiom: a\\na -> ab\\nb -> a"))), 3)]
    [{0: 1}, {0: 1, 1: 1}, {0: 2, 1: 1}]
    """
    counts: Mapping[int, int] = Counter(table.axiom)
    while True:
        yield counts
        check_budget()
        counts = next_counts(table, counts)


def row_of(table: States, counts: Mapping[int, int]) -> tuple[int, ...]:
    """The count of each state."""
    return tuple(counts.get(state, 0) for state in range(len(table)))


def held(rows: Iterator[tuple[int, ...]]) -> Iterator[tuple[int, ...]]:
    """The same rows of counts, as long as there is room for all of them."""
    size = 0
    for row in rows:
        size += sum(OBJECT_BYTES + number.bit_length() // 8 for number in row)
        check_bytes(size, lambda: "The counts of so many steps were not found")
        yield row


def orbit(table: States) -> tuple[tuple[int, ...], list[tuple[int, ...]]]:
    """The shortest rule that the counts of all states obey together, and as many rows of counts.

    It is the rule of a weighted sum of the counts, unless the weights are unlucky; so it is checked against the counts.

    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: a\\na -> ab\\nb -> a"))
    >>> [len(states.successor(state)) for state in (0, 1)], orbit(states)
    ([2, 1], ((1, 1), [(1, 0), (1, 1)]))
    """
    rows = list(held(row_of(table, counts) for counts in islice(counts_of_steps(table), 2 * len(table) + 2)))
    rule = next(rule for rule in map(partial(_rule_of_weighted_sum, rows), count()) if _continued(rule, rows))
    return rule, rows[: len(rule)]


def _rule_of_weighted_sum(rows: Sequence[Sequence[int]], trial: int) -> tuple[int, ...]:
    """The shortest rule of a sum of the counts, with other weights at each trial."""
    weights = [splitmix64(splitmix64(trial) ^ state) % 2**20 for state in range(len(rows[0]))]
    return tuple(map(int, shortest_rule([sum(map(int.__mul__, weights, row)) for row in rows])))


def _continued(rule: Sequence[int], rows: Sequence[Sequence[int]]) -> bool:
    """Whether a rule gives each count of the row behind the first ones."""
    size = len(rule)
    return all(
        column[size] == sum(c * column[size - k] for k, c in enumerate(rule, 1) if c) for column in zip(*rows, strict=True)
    )
