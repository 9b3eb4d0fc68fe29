"""Modules with parameters: the fewest cases into which those of a kind fall, each with a condition and laws of its own.

The values of a case lie in a box whose sides are thresholds of single parameters, and boxes of different cases have no value in
common: so a condition compares parameters with numbers, perhaps several in conjunction.
"""

from __future__ import annotations

from collections.abc import Iterable, Iterator, Sequence
from functools import reduce
from itertools import count
from typing import Any, TypeAlias

from lsys_kit.budget import check_budget
from lsys_kit.derivation.inference.laws import POINTS_FOR_TWO_NUMBERS, Values, law_of
from lsys_kit.derivation.inference.problem import Table
from lsys_kit.derivation.inference.words import Row
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Production

Case: TypeAlias = tuple[tuple[Values, Row], ...]
"""The values of some modules of one kind, with their successors."""
Kind: TypeAlias = tuple[str, int]
"""A symbol and the number of its parameters."""
NAMES = ("x", "y", "z")
"""The names of up to so many parameters."""


def general_productions(table: Table) -> Iterator[Production]:
    """Productions with parameters for a table, as few as possible; modules that stay as they are need none.

    >>> from lsys_kit.derivation.inference.problem import Letter
    >>> from lsys_kit.notation.model.modules import Module
    >>> a = [Letter((), Module("a", (age,))) for age in range(4)]
    >>> table = {a[0]: (a[1].module,), a[1]: (a[2].module,), a[2]: (a[3].module,), a[3]: (a[0].module,) * 2}
    >>> [str(production) for production in general_productions(table)]
    ['a(x) : x < 3 -> a(x + 1)', 'a(x) : x >= 3 -> a(0)a(0)']
    """
    kinds: dict[Kind, dict[Values, Row]] = {}
    for letter, word in table.items():
        module = letter.module
        kinds.setdefault((module.symbol, len(module.arguments)), {})[module.arguments] = word
    for kind, successors in kinds.items():
        cases = fewest_cases(kind, successors)
        for case in cases:
            if not _stays(kind, case):
                yield _production(kind, case, [other for other in cases if other is not case])


def _stays(kind: Kind, case: Case) -> bool:
    """Whether the modules of a case remain as they are."""
    return all(len(word) == 1 and (word[0].symbol, word[0].arguments) == (kind[0], values) for values, word in case)


def fewest_cases(kind: Kind, successors: dict[Values, Row]) -> list[Case]:
    """The fewest cases that the modules of a kind fall into, rather with simple laws, which one point shows, than others."""
    points = sorted(successors.items())
    fewest = len({_symbols(word) for word in successors.values()})
    return next(
        found
        for most in count(fewest)
        for free in (1, POINTS_FOR_TWO_NUMBERS - 1)
        for found in _divided(kind, points, [], most, free)
    )


def _divided(kind: Kind, points: Sequence[tuple[Values, Row]], cases: list[Case], most: int, free: int) -> Iterator[list[Case]]:
    """All ways to divide the rest of the points among at most so many cases; so many points of a case need no law yet."""
    check_budget()
    if not points:
        if all(_successor(kind, case, False) is not None for case in cases):
            yield cases
        return
    for number, case in enumerate(cases):
        wider, others = (*case, points[0]), cases[:number] + cases[number + 1 :]
        same = _symbols(case[0][1]) == _symbols(points[0][1])
        if same and _apart(wider, others) and (len(wider) <= free or _successor(kind, wider, False) is not None):
            yield from _divided(kind, points[1:], [*cases[:number], wider, *cases[number + 1 :]], most, free)
    if len(cases) < most and _apart((points[0],), cases):
        yield from _divided(kind, points[1:], [*cases, (points[0],)], most, free)


def _symbols(word: Row) -> tuple[Kind, ...]:
    """The kinds of modules of a word, which are the same in a case."""
    return tuple((module.symbol, len(module.arguments)) for module in word)


def _apart(case: Case, others: Iterable[Case]) -> bool:
    return all(any(_side(case, other, axis) for axis in range(len(case[0][0]))) for other in others)


def _side(case: Case, other: Case, axis: int) -> int:
    """On which side of another case's box one lies: -1 below, 1 above, 0 where they overlap."""
    own, others = _along(case, axis), _along(other, axis)
    return -1 if max(own) < min(others) else 1 if min(own) > max(others) else 0


def _along(case: Case, axis: int) -> list[Any]:
    return [values[axis] for values, _ in case]


def _successor(kind: Kind, case: Case, keeps: bool) -> tuple[Pattern, ...] | None:
    """The successor of a case's modules as a production writes it; None where no laws give their values.

    It may be asked that a value which is that of a parameter is written as the parameter, though it is always the same number.
    """
    names = names_of(kind)
    given, words = [values for values, _ in case], [word for _, word in case]
    found = []
    for index, module in enumerate(words[0]):
        made = [[word[index].arguments[place] for word in words] for place in range(len(module.arguments))]
        laws = [
            Name(names[place])
            if keeps and place < len(names) and values == [each[place] for each in given]
            else law_of(given, values, names, place)
            for place, values in enumerate(made)
        ]
        if None in laws:
            return None
        found.append(Pattern(module.symbol, tuple(law for law in laws if law is not None)))
    return tuple(found)


def names_of(kind: Kind) -> list[str]:
    """The names of a module's parameters.

    >>> names_of(("F", 2)), names_of(("F", 4))
    (['x', 'y'], ['x1', 'x2', 'x3', 'x4'])
    """
    return [*NAMES[: kind[1]]] if kind[1] <= len(NAMES) else [f"x{number}" for number in range(1, kind[1] + 1)]


def _production(kind: Kind, case: Case, others: Sequence[Case]) -> Production:
    own = Pattern(kind[0], tuple(map(Name, names_of(kind))))
    made = _successor(kind, case, keeps=not others)
    assert made is not None
    return Production((own,), made, condition=_condition(kind, case, others))


def _condition(kind: Kind, case: Case, others: Sequence[Case]) -> Expression | None:
    """What distinguishes the modules of a case from those of the others; None where there are none."""
    comparisons: list[Expression] = []
    left = list(others)
    names = names_of(kind)
    while left:
        axis = max(range(kind[1]), key=lambda axis: sum(map(abs, (_side(case, other, axis) for other in left))))
        there = [other for other in left if _side(case, other, axis)]
        left = [other for other in left if not _side(case, other, axis)]
        comparisons += _comparisons(Name(names[axis]), case, there, axis)
    return reduce(lambda one, another: Apply("&&", (one, another)), comparisons) if comparisons else None


def _comparisons(name: Name, case: Case, others: Sequence[Case], axis: int) -> Iterator[Expression]:
    """The comparisons of a parameter that hold in a case and not in others."""
    own = {*_along(case, axis)}
    below = [min(_along(other, axis)) for other in others if _side(case, other, axis) < 0]
    above = [other for other in others if _side(case, other, axis) > 0]
    if len(own) == 1 and ((below and above) or all(len({*_along(other, axis)}) == 1 for other in others)):
        yield Apply("==", (name, Number(own.pop())))
        return
    if above:
        yield Apply(">=", (name, Number(min(own))))
    if below:
        yield Apply("<", (name, Number(min(below))))
