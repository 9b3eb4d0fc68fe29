"""The form of a system: what is written there, however its parameters are called and its formulas are spelt.

Two systems that do the same may have other forms. What is said of somebody's productions must be true of their form.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Iterator, Mapping, Sequence
from contextlib import suppress
from dataclasses import replace
from typing import Any

from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.expressions import (
    Apply,
    Expression,
    Name,
    Number,
    expression_type,
    function_of,
    names_in,
    substituted,
)
from lsys_kit.notation.model.modules import Item, Pattern, Repeat, expressions_of, rewritten, with_expressions
from lsys_kit.notation.model.system import LSystem, Production, symbols

_TURNED = {">": "<", ">=": "<="}
_SYMMETRIC = frozenset(["+", "*", "==", "!=", "&&", "||", "min", "max"])
BLOCKS = ("productions", "decomposition", "interpretation")


def normal(expression: Expression) -> Expression:
    """An expression in the one of its usual forms that stands for all of them.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(normal(read_expression("4 - 2 < t && 1 + s == 5")), normal(read_expression("s + 1 == 5 && t > 2")), sep=", ")
    1 + s == 5 && 2 < t, 1 + s == 5 && 2 < t
    """
    if not isinstance(expression, Apply):
        return replace(expression, at=None)
    operator, operands = expression.operator, tuple(map(normal, expression.operands))
    if expression_type(expression) == "number" and all(isinstance(each, Number) for each in operands):
        with suppress(ArithmeticError, ValueError, KeyError, LSystemError):
            return Number(function_of(expression, {})(()))
    if operator in _TURNED:
        operator, operands = _TURNED[operator], operands[::-1]
    if operator in _SYMMETRIC:
        operands = tuple(sorted(operands, key=str))
    return Apply(operator, operands)


def form_of(system: LSystem, without: Collection[Production] = (), drawn: bool = False) -> tuple[object, ...]:
    """What is written in a system; productions for different symbols in any order.

    >>> from lsys_kit.notation.read import read
    >>> one, other = read("axiom: M(1)\\nM(s) : s == 5 -> N\\nN -> M(2)"), read("axiom: M(1)\\nN -> M(1+1)\\nM(5) -> N")
    >>> form_of(one) == form_of(other)
    True
    """
    left_out = set(map(_form_of_rule, without))
    blocks = [
        tuple(sorted((form for rule in getattr(system, block) if (form := _form_of_rule(rule)) not in left_out), key=_symbols))
        for block in BLOCKS
    ]
    settings = (system.angle, system.heading, system.length) if drawn else ()
    return (_plain(system.axiom), *blocks, *settings)


def _symbols(form: tuple[Any, ...]) -> tuple[str, ...]:
    return tuple(module.symbol for module in form[0])


def _plain(items: Iterable[Item]) -> tuple[Item, ...]:
    return with_expressions(items, normal)


def _form_of_rule(rule: Production) -> tuple[object, ...]:
    """A production with its parameters called by their numbers; a value before the arrow is a condition."""
    names: dict[str, Expression] = {}
    fixed: list[Expression] = []
    parameters: list[Pattern] = []
    for module in rule.parameters:
        own: list[Expression] = []
        for argument in module.arguments:
            name = Name(f"_{len(names) + len(fixed)}")
            own.append(names.setdefault(argument.name, name) if isinstance(argument, Name) else name)
            if not isinstance(argument, Name):
                fixed.append(Apply("==", (name, argument)))
        parameters.append(Pattern(module.symbol, tuple(own)))

    def called(expression: Expression) -> Expression:
        return normal(substituted(expression, names))

    conditions = sorted([*map(called, fixed), *([called(rule.condition)] if rule.condition is not None else [])], key=str)
    left, own_ones = len(rule.left), len(rule.left) + len(rule.predecessors)
    return (
        tuple(parameters[left:own_ones]),
        tuple(parameters[:left]),
        tuple(parameters[own_ones:]),
        tuple(conditions),
        with_expressions(rule.successor, called),
        None if rule.probability is None else called(rule.probability),
    )


def with_names(system: LSystem, names: Mapping[str, str]) -> LSystem:
    """A system with other names for its symbols.

    >>> from lsys_kit.notation.read import read
    >>> print(with_names(read("axiom: a\\na -> a b"), {"a": "x"}))
    axiom: x
    x -> x b
    """
    return rules_with(system, lambda symbol: [names.get(symbol, symbol)])


def rules_with(system: LSystem, symbols_for: Callable[[str], Sequence[str]]) -> LSystem:
    """A system with others in place of its symbols; the first of several has the arguments."""

    def module(each: Pattern) -> Iterator[Pattern]:
        first, *others = symbols_for(each.symbol)
        yield replace(each, symbol=first)
        yield from map(Pattern, others)

    def word(items: Iterable[Item]) -> Any:
        return rewritten(items, module, lambda count: count)

    def rule(found: Production) -> Production:
        return replace(found, **{part: word(getattr(found, part)) for part in ("predecessors", "successor", "left", "right")})

    blocks: dict[str, Any] = {block: tuple(map(rule, getattr(system, block))) for block in BLOCKS}
    return replace(system, axiom=word(system.axiom), **blocks)


def in_names_of(mine: LSystem, other: LSystem, known: Collection[str], names: str) -> LSystem:
    """A system whose free names are those that another has in their places, where it has as many.

    >>> from lsys_kit.notation.read import read
    >>> mine, other = read("axiom: x\\nx -> x y"), read("axiom: a\\na -> a b")
    >>> print(in_names_of(mine, other, "ab", "new"))
    axiom: a
    a -> a b
    """
    own, theirs = (list(_names(system)) for system in (mine, other))
    if names == "new":
        own, theirs = [each for each in own if each not in known], [each for each in theirs if each not in own]
    if names == "fixed" or len(own) != len(theirs):
        return mine
    return with_names(mine, dict(zip(own, theirs, strict=True)))


def _names(system: LSystem) -> Iterator[str]:
    return (symbol for symbol in dict.fromkeys(symbols(system)) if symbol[:1].isalpha())


def is_sensible(system: LSystem) -> bool:
    """Whether every name in a system's productions is a parameter, a constant or what counts in a repeated part."""
    constants = {constant.name for constant in system.constants}
    return all(_names_used(rule) <= constants | _names_given(rule) for rule in (*system.productions, *system.decomposition))


def _names_used(rule: Production) -> frozenset[str]:
    others = [part for part in (rule.condition, rule.probability) if part is not None]
    return frozenset().union(*map(names_in, [*expressions_of(rule.successor), *others]))


def _names_given(rule: Production) -> set[str]:
    formal = {a.name for module in rule.parameters for a in module.arguments if isinstance(a, Name)}
    return formal | set(_indices(rule.successor))


def _indices(items: Iterable[Item]) -> Iterator[str]:
    for item in items:
        if isinstance(item, Repeat):
            yield item.index
            yield from _indices(item.body)
