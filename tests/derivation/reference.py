"""Deriving by the book: the definition of a parametric 0L-system, read literally (ABOP, section 1.10.1).

For each module of the word the first production that matches is looked for; all matches are replaced at once. Nothing is
remembered, counted or shared, and every number is a `Fraction`: slow, and short enough to be believed.
"""

from __future__ import annotations

import math
import operator
from collections.abc import Mapping
from fractions import Fraction
from typing import Any

from lsys_kit.notation.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model import LSystem, Module, Production

Names = Mapping[str, Fraction]
PlainModule = tuple[str, tuple[Fraction, ...]]

OPERATIONS = {
    "+": operator.add, "-": operator.sub, "*": operator.mul, "/": operator.truediv, "^": operator.pow, "-x": operator.neg,
    "==": operator.eq, "!=": operator.ne, "<": operator.lt, "<=": operator.le, ">": operator.gt, ">=": operator.ge,
    "!": operator.not_,
    "abs": abs, "floor": math.floor, "ceil": math.ceil, "min": min, "max": max,
}


def value(expression: Expression, names: Names) -> Any:
    """What an expression comes to: a `Fraction` or a truth."""
    if isinstance(expression, Number):
        return Fraction(expression.value)
    if isinstance(expression, Name):
        return names[expression.name]
    if expression.operator in ("&&", "||"):  # as in C, the second is looked at only where it matters
        left, right = expression.operands
        first = value(left, names)
        return value(right, names) if first == (expression.operator == "&&") else first
    operands = [value(operand, names) for operand in expression.operands]
    result = OPERATIONS[expression.operator](*operands)
    return result if isinstance(result, bool) else Fraction(result)


def constants(system: LSystem) -> Names:
    found: dict[str, Fraction] = {}
    for constant in system.constants:
        found[constant.name] = value(constant.value, found)
    return found


def names_for(production: Production, module: PlainModule, known: Names) -> Names | None:
    """The parameters' values where the production matches the module, else None."""
    symbol, values = module
    formal = production.predecessor.arguments
    if symbol != production.predecessor.symbol or len(values) != len(formal):
        return None
    names = dict(known)
    for expression, given in zip(formal, values, strict=True):
        if isinstance(expression, Name) and expression.name not in known:
            names[expression.name] = given
    asked = [(e, v) for e, v in zip(formal, values, strict=True) if isinstance(e, Number | Apply) or e.name in known]
    holds = all(value(e, known) == v for e, v in asked)
    return names if holds and (production.condition is None or value(production.condition, names)) else None


def made(modules: tuple[Module, ...], names: Names) -> list[PlainModule]:
    return [(m.symbol, tuple(value(a, names) for a in m.arguments)) for m in modules]  # type: ignore[arg-type]


def step(system: LSystem, word: list[PlainModule], known: Names) -> tuple[list[PlainModule], set[int]]:
    """The next word, and the numbers of the productions that were applied."""
    after: list[PlainModule] = []
    applied: set[int] = set()
    for module in word:
        for number, production in enumerate(system.productions):
            names = names_for(production, module, known)
            if names is not None:
                after += made(production.successor, names)
                applied.add(number)
                break
        else:
            after.append(module)
    return after, applied


def words(system: LSystem, steps: int) -> tuple[list[list[PlainModule]], set[int]]:
    """The words of steps 0 to `steps`, and the productions that were applied on the way."""
    known = constants(system)
    found, applied = [made(system.axiom, known)], set[int]()
    for _ in range(steps):
        word, new = step(system, found[-1], known)
        found.append(word)
        applied |= new
    return found, applied
