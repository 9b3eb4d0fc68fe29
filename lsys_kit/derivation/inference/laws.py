"""Laws of parameters: how the values of a successor are computed from those of the module that it replaces.

A value stays, is moved by an amount, is multiplied, or both (affine laws); it may also be that of another parameter, the sum or
the difference of two, or always the same.
"""

from __future__ import annotations

from collections.abc import Callable, Iterable, Iterator, Sequence
from fractions import Fraction
from typing import TypeAlias

from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number

Values: TypeAlias = tuple[Value, ...]
"""The values of a module's parameters."""
Law: TypeAlias = Callable[[Sequence[Values], Sequence[Value], Sequence[str], int], Iterator[Expression]]
"""From the values of some modules, what became of a value, the parameters' names and the place of the value: the expression."""
POINTS_FOR_TWO_NUMBERS = 3
"""Through two points there is always a straight line; so many different ones must lie on it."""


def law_of(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Expression | None:
    """The simplest expression for what became of a value; None where there is none.

    >>> print(law_of([(1, 0), (3, 1)], [2, 4], ["x", "y"], 0))
    x + 1
    >>> print(law_of([(1,), (3,), (4,)], [3, 7, 9], ["x"], 0))
    2 * x + 1
    """
    return next((found for law in LAWS for found in law(given, made, names, place)), None)


def _fixed(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    if len({*made}) == 1:
        yield Number(made[0])


def _kept(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    for axis in _axes(names, place):
        if all(values[axis] == value for values, value in zip(given, made, strict=True)):
            yield Name(names[axis])


def _moved(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    for axis in _axes(names, place):
        amounts = {value - values[axis] for values, value in zip(given, made, strict=True)}
        if len(amounts) == 1:
            yield plus(Name(names[axis]), amounts.pop())


def _scaled(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    for axis in _axes(names, place):
        factors = {_quotient(value, values[axis]) if values[axis] else None for values, value in zip(given, made, strict=True)}
        if len(factors) == 1 and None not in factors:
            yield Apply("*", (Number(factors.pop()), Name(names[axis])))  # type: ignore[arg-type]


def _affine(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    for axis in _axes(names, place):
        points = sorted({(values[axis], value) for values, value in zip(given, made, strict=True)})
        if len({x for x, _ in points}) >= POINTS_FOR_TWO_NUMBERS:
            (x0, y0), (x1, y1) = points[0], points[-1]
            factor = _quotient(y1 - y0, x1 - x0)
            if all(y - y0 == factor * (x - x0) for x, y in points):
                yield plus(Apply("*", (Number(factor), Name(names[axis]))), y0 - factor * x0)


def _combined(given: Sequence[Values], made: Sequence[Value], names: Sequence[str], place: int) -> Iterator[Expression]:
    for first in _axes(names, place):
        for second in range(len(names)):
            for operator, sign in (("+", 1), ("-", -1)):
                if first != second and all(
                    values[first] + sign * values[second] == value for values, value in zip(given, made, strict=True)
                ):
                    yield Apply(operator, (Name(names[first]), Name(names[second])))


LAWS: tuple[Law, ...] = (_fixed, _kept, _moved, _scaled, _combined, _affine)
"""The kinds of laws, the simplest first."""


def _axes(names: Sequence[str], place: int) -> Iterable[int]:
    """The parameters, beginning with that at the place of the value."""
    return sorted(range(len(names)), key=lambda axis: axis != place)


def _quotient(above: Value, below: Value) -> Value:
    return above / below if isinstance(above, float) or isinstance(below, float) else normalised(Fraction(above) / below)


def plus(expression: Expression, amount: Value) -> Expression:
    """The sum of an expression and a number, as one writes it.

    >>> print(plus(Name("x"), -2))
    x - 2
    """
    return Apply("+" if amount > 0 else "-", (expression, Number(normalised(amount if amount > 0 else -amount))))
