"""Misconceptions about growth: from the numbers of the first steps to how somebody continues them."""

from __future__ import annotations

from collections.abc import Iterator, Sequence
from itertools import count

MOST_GIVEN = 6
"""So many first numbers at most are taken as they are before they are continued."""


def linear(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """The same is added at each step.

    >>> from itertools import islice
    >>> [list(islice(found, 4)) for found in linear([1, 5, 25, 125])]
    [[1, 5, 9, 13], [1, 5, 25, 45]]
    """
    for given in range(2, min(MOST_GIVEN, len(values))):
        if values[given - 1] != values[given - 2]:
            yield _continued(values[:given], lambda known: 2 * known[-1] - known[-2])


def added_for_multiplied(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """As much for each step as the first one has, added up.

    >>> from itertools import islice
    >>> [list(islice(found, 4)) for found in added_for_multiplied([1, 5, 25])]
    [[1, 5, 10, 15]]
    """
    if len(values) > 1 and values[0] > 0 and values[1] % values[0] == 0 and values[1] > values[0]:
        first, factor = values[0], values[1] // values[0]
        yield (first * factor * step if step else first for step in count())


def fibonacci(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """Each number the sum of the two before.

    >>> from itertools import islice
    >>> [list(islice(found, 6)) for found in fibonacci([1, 1, 1, 2, 2])][0]
    [1, 1, 2, 3, 5, 8]
    """
    for given in range(2, min(MOST_GIVEN, len(values)) + 1):
        yield _continued(values[:given], lambda known: known[-1] + known[-2])


def doubling(values: Sequence[int]) -> Iterator[Iterator[int]]:
    """Twice as many at each step.

    >>> from itertools import islice
    >>> [list(islice(found, 4)) for found in doubling([1, 2, 3])]
    [[1, 2, 4, 8]]
    """
    if values and values[0] > 0:
        yield (values[0] * 2**step for step in range(4_000))


def last_made(values: Sequence[int]) -> Iterator[int]:
    """What the last step has added.

    >>> list(last_made([1, 3, 7])), list(last_made([3, 1]))
    ([4], [])
    """
    if values[-1] > values[-2] > 0:
        yield values[-1] - values[-2]


def added_up(values: Sequence[int]) -> Iterator[int]:
    """The numbers of all steps together, with that of step 0 or without.

    >>> list(added_up([1, 3, 7]))
    [11, 10]
    """
    yield from (sum(values), sum(values[1:]))


def _continued(given: Sequence[int], following: object) -> Iterator[int]:
    known = list(given)
    yield from known
    while True:
        known = [known[-1], following(known)]  # type: ignore[operator]
        yield known[-1]
