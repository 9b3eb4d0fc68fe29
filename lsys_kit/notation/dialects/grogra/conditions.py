"""Can two conditions hold at once? Known where they compare parameters with numbers."""

from __future__ import annotations

from collections.abc import Iterator
from fractions import Fraction
from itertools import pairwise, product
from math import prod

from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, Number, function_of, names_in

_TRIED = 1_000
"""So many combinations of values are tried."""


def exclusive(one: Expression | None, other: Expression | None) -> bool:
    """Whether it is certain that two conditions never hold at once; no condition always holds.

    What compares names with numbers alone changes its truth only at those numbers: these, and what lies between and beyond
    them, are tried.

    >>> young, old = (Apply(sign, (Name("t"), Number(5))) for sign in ("<", ">="))
    >>> exclusive(young, old), exclusive(young, young), exclusive(young, None)
    (True, False, False)
    """
    if one is None or other is None or not (_is_plain(one) and _is_plain(other)):
        return False
    names = sorted(names_in(one) | names_in(other))
    values = [_values(name, (one, other)) for name in names]
    if prod(map(len, values)) > _TRIED:
        return False
    order = {name: index for index, name in enumerate(names)}
    both = function_of(Apply("&&", (one, other)), order)
    return not any(both(tried) for tried in product(*values))


def _is_plain(condition: Expression) -> bool:
    """Whether a condition only compares names with numbers."""
    if not isinstance(condition, Apply):
        return False
    if OPERATORS[condition.operator].takes == "truth":
        return all(map(_is_plain, condition.operands))
    kinds = {type(operand) for operand in condition.operands}
    return OPERATORS[condition.operator].gives == "truth" and kinds == {Name, Number}


def _values(name: str, conditions: tuple[Expression, ...]) -> list[Value]:
    """The numbers with which a name is compared, and others between and beyond them."""
    found = sorted({Fraction(value) for condition in conditions for value in _compared(name, condition)})
    between = [(low + high) / 2 for low, high in pairwise(found)]
    return [found[0] - 1, *found, *between, found[-1] + 1]


def _compared(name: str, condition: Expression) -> Iterator[Value]:
    """The numbers with which a condition compares a name."""
    if isinstance(condition, Apply):
        if Name(name) in condition.operands:
            yield from (operand.value for operand in condition.operands if isinstance(operand, Number))
        for operand in condition.operands:
            yield from _compared(name, operand)
