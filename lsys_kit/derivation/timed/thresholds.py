"""Thresholds: the ages at which a rule may begin or cease to match a module that grows older.

A condition that compares sums and multiples of the age with values that do not change, as `t + dt >= t_div && p == LEFT`, is
true or false on whole stretches of age. Its thresholds are where these meet.
"""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from functools import cached_property
from typing import Any

from lsys_kit.derivation.core.rules import Rule
from lsys_kit.derivation.core.states import States
from lsys_kit.notation.model.arithmetic import Value, divide
from lsys_kit.notation.model.expressions import Apply, Expression, Name, function_of, names_in
from lsys_kit.notation.model.modules import Module

_LINEAR: Mapping[str, Callable[[Sequence[Any], Sequence[Value]], Value]] = {
    "+": lambda slopes, _: slopes[0] + slopes[1],
    "-": lambda slopes, _: slopes[0] - slopes[1],
    "-x": lambda slopes, _: -slopes[0],
    "*": lambda slopes, factors: slopes[0] * factors[1] + slopes[1] * factors[0],
    "/": lambda slopes, factors: divide(slopes[0], factors[1]),
}
"""For each operator that may keep a slope the same at all ages how it does, given slopes and fixed values of its operands."""
_CONNECTIVES = frozenset(("&&", "||", "!"))
_COMPARISONS = frozenset(("<", "<=", ">", ">=", "==", "!="))


@dataclass(frozen=True)
class AgeTerms:
    """The expressions of a rule as functions of the age of the module that it replaces.

    Attributes
    ----------
    states
        The table of modules.
    rule
        The rule.
    parameter
        Which parameter of its predecessor is the age.
    """

    states: States
    rule: Rule
    parameter: int

    @cached_property
    def age(self) -> str | None:
        """What the rule calls the age; None where it has no name for it."""
        asked = self.rule.production.predecessor.arguments[self.parameter]
        return asked.name if isinstance(asked, Name) and asked.name not in self._constants else None

    @cached_property
    def _constants(self) -> Mapping[str, int]:
        """The place of each declared constant among their values."""
        return {constant.name: at for at, constant in enumerate(self.states.system.constants)}

    @cached_property
    def _order(self) -> Mapping[str, int]:
        """The place of each name among the values of a module and of the constants."""
        asked = self.rule.production.predecessor.arguments
        order = {name: len(asked) + at for name, at in self._constants.items()}
        named = {argument.name: at for at, argument in enumerate(asked) if isinstance(argument, Name)}
        return {**named, **order}

    def depends(self, expression: Expression) -> bool:
        """Whether an expression depends on the age."""
        return self.age is not None and self.age in names_in(expression)

    def value(self, expression: Expression, module: Module) -> Value:
        """The value of an expression for a module."""
        found: Value = function_of(expression, self._order, self.states.arithmetic)((*module.arguments, *self.states.constants))
        return found

    def slope(self, expression: Expression, module: Module) -> Value | None:
        """By how much an expression grows while the age grows by 1; None where that is not the same at all ages.

        >>> from lsys_kit.notation.read import read
        >>> states = States(read("axiom: M(0,3)\\nM(t,p) -> M(2*t-p,p)"))
        >>> rule, = states.rules["M", 2]
        >>> AgeTerms(states, rule, 0).slope(rule.production.successor[0].arguments[0], states.modules[0])
        2
        """
        if not self.depends(expression):
            return 0
        if not isinstance(expression, Apply):
            return 1
        parts = expression.operands
        slopes = [self.slope(part, module) for part in parts]
        if None in slopes or expression.operator not in _LINEAR:
            return None
        if expression.operator == "*" and all(map(self.depends, parts)):
            return None
        if expression.operator == "/" and self.depends(parts[1]):
            return None
        factors = [0 if self.depends(part) else self.value(part, module) for part in parts]
        return _LINEAR[expression.operator](slopes, factors)

    def thresholds(self, module: Module) -> list[Value] | None:
        """The ages at which the rule may begin or cease to match a module; None where its condition asks otherwise for the age.

        >>> from lsys_kit.notation.read import read
        >>> states = States(read("dt = 0.7\\naxiom: M(0.4)\\nM(t) : t+dt < 1 || t > 5 -> M(t+dt)"))
        >>> print(*AgeTerms(states, states.rules["M", 1][0], 0).thresholds(states.modules[0]))
        3/10 5
        """
        found: list[Value] = []
        for difference in self._compared():
            slope = None if difference is None else self.slope(difference, module)
            if difference is None or slope is None:
                return None
            if slope != 0:
                young = Module(
                    module.symbol, tuple(0 if at == self.parameter else value for at, value in enumerate(module.arguments))
                )
                found.append(divide(-self.value(difference, young), slope))
        asked = self.rule.production.predecessor.arguments[self.parameter]
        return found if self.age is not None else [*found, self.value(asked, module)]

    def _compared(self) -> Iterator[Expression | None]:
        """What is compared with 0 wherever the age is asked for; None for a question of another kind."""
        arguments = self.rule.production.predecessor.arguments
        for at, _ in self.rule.equalities:
            if self.depends(arguments[at]):
                yield None
        todo = [] if self.rule.production.condition is None else [self.rule.production.condition]
        while todo:
            part = todo.pop()
            if not self.depends(part):
                continue
            if isinstance(part, Apply) and part.operator in _CONNECTIVES:
                todo += part.operands[::-1]
            else:
                compared = isinstance(part, Apply) and part.operator in _COMPARISONS
                yield Apply("-", part.operands) if compared else None  # type: ignore[union-attr]


def unit_slope(expression: Expression, age: str) -> bool:
    """Whether an expression is the age plus or minus something that does not depend on it.

    >>> from lsys_kit.notation.read import read_expression
    >>> [unit_slope(read_expression(text), "t") for text in ("t + dt - 1", "1 - t", "2*t", "3")]
    [True, False, False, False]
    """
    if not isinstance(expression, Apply):
        return expression == Name(age)
    if expression.operator not in ("+", "-") or sum(age in names_in(part) for part in expression.operands) != 1:
        return False
    part = next(part for part in expression.operands if age in names_in(part))
    return unit_slope(part, age) and (expression.operator == "+" or part is expression.operands[0])


def is_pointwise(condition: Expression | None, age: str) -> bool:
    """Whether a condition asks somewhere whether the age has just a certain value."""
    if not isinstance(condition, Apply) or age not in names_in(condition):
        return False
    return condition.operator in ("==", "!=") or any(is_pointwise(part, age) for part in condition.operands)
