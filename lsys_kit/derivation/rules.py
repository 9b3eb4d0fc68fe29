"""Productions made ready to run: for each kind of module the rules that may rewrite it, as functions of its values.

A rule's functions take one tuple: the values of the module's parameters, then those of the declared constants. So a
constant that a slider moves changes a tuple, and nothing is read or put together again.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache
from typing import Any

from lsys_kit.errors import ModelNameError, ModelValueError
from lsys_kit.notation.arithmetic import Value, reason, sound, tidy
from lsys_kit.notation.checks import suggestion
from lsys_kit.notation.expressions import Function, Name, function_of
from lsys_kit.notation.model import LSystem, Production
from lsys_kit.notation.read import read_number


@dataclass(frozen=True)
class Rule:
    """One production, ready to run.

    Attributes
    ----------
    number
        The production's place in the order written, from 0.
    equalities
        Pairs of a parameter's index and a function whose value it must have.
    condition
        A truth, or None.
    successor
        Pairs of a symbol and the functions of its arguments.
    """

    number: int
    production: Production
    equalities: tuple[tuple[int, Function], ...]
    condition: Function | None
    successor: tuple[tuple[str, tuple[Function, ...]], ...]


Rules = Mapping[tuple[str, int], tuple[Rule, ...]]
"""For each symbol and number of parameters its rules, in the order written."""


@lru_cache(maxsize=256)
def rules_of(system: LSystem, arithmetic: str = "exact", interpretation: bool = False) -> Rules:
    """The rules of a system, by the symbol and the number of parameters that they rewrite.

    >>> from lsys_kit.notation.read import read
    >>> sorted(rules_of(read("axiom: A(0)\\nA(t) : t < 5 -> A(t+1) B")))
    [('A', 1)]
    """
    constants = [constant.name for constant in system.constants]
    rules: dict[tuple[str, int], list[Rule]] = {}
    for number, production in enumerate(system.interpretation if interpretation else system.productions):
        arguments = production.predecessor.arguments
        order = {name: len(arguments) + index for index, name in enumerate(constants)}
        formal = [isinstance(a, Name) and a.name not in order for a in arguments]
        order.update({a.name: i for i, a in enumerate(arguments) if formal[i]})  # type: ignore[union-attr]

        def ready(expression: Any, order: Mapping[str, int] = order) -> Function:
            return function_of(expression, order, arithmetic)

        rules.setdefault((production.predecessor.symbol, len(arguments)), []).append(Rule(
            number, production,
            tuple((i, ready(a)) for i, a in enumerate(arguments) if not formal[i]),
            None if production.condition is None else ready(production.condition),
            tuple((m.symbol, tuple(map(ready, m.arguments))) for m in production.successor)))
    return {kind: tuple(found) for kind, found in rules.items()}


def constants_of(system: LSystem, changes: Mapping[str, object], arithmetic: str = "exact") -> tuple[Value, ...]:
    """The values of the declared constants, in their order, with some of them changed.

    >>> from lsys_kit.notation.read import read
    >>> constants_of(read("dt = 7/10\\nhalf = dt/2\\naxiom: A"), {"dt": "14/10"})
    (Fraction(7, 5), Fraction(7, 10))
    """
    names = [constant.name for constant in system.constants]
    for name in changes:
        if name not in names:
            hint = suggestion(name, names) or (f"Its constants are: {', '.join(names)}." if names else "It has none.")
            raise ModelNameError(f'The system declares no constant "{name}"', hint=hint)
    order = {name: index for index, name in enumerate(names)}
    values: list[Value] = []
    for constant in system.constants:
        try:
            value = (number_from(changes[constant.name], constant.name) if constant.name in changes
                     else sound(function_of(constant.value, order, arithmetic)(tuple(values))))
        except (ArithmeticError, ValueError) as fault:
            raise ModelValueError(f'The constant "{constant.name}" has no value: {reason(fault)}', system.source or None,
                                  *(constant.at or (None, None))) from None
        values.append(float(value) if arithmetic == "float" else value)
    return tuple(values)


def number_from(given: object, name: str = "value") -> Value:
    """A number as a person gives it, exactly: 1.4 and "1.4" and "14/10" are all 7/5.

    >>> number_from(1.4), number_from("14/10"), number_from(Fraction(4, 2))
    (Fraction(7, 5), Fraction(7, 5), 2)
    """
    if isinstance(given, str):
        return read_number(given)
    if isinstance(given, numbers.Real) and not isinstance(given, bool) and _finite(given):
        if isinstance(given, numbers.Rational):
            return tidy(Fraction(int(given.numerator), int(given.denominator)))
        return tidy(Fraction(repr(float(given))))
    raise ModelValueError(f'"{name}" must be a number, not {str(given)[:40]!r}')


def _finite(given: numbers.Real) -> bool:
    try:
        return math.isfinite(given)
    except OverflowError:
        return False
