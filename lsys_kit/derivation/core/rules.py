"""Productions made ready to run: for each kind of module the rules that may rewrite it, as functions of its values.

A rule's functions take one tuple: the values of the module's parameters, then those of the declared constants. So a
constant that a slider moves changes a tuple, and nothing is read or put together again.
"""

from __future__ import annotations

import math
import numbers
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from fractions import Fraction
from functools import cached_property, lru_cache
from typing import TYPE_CHECKING, TypeAlias, TypeGuard

from lsys_kit.errors import ModelNameError, ModelValueError, quotable, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.arithmetic import Formula, Value, expanded_value, finite, is_symbolic, normalised, reason_of
from lsys_kit.notation.model.expressions import Apply, Expression, Function, Name, Number, function_of, is_random, sensed_in
from lsys_kit.notation.model.modules import CLOSING, OPENING, Item, Module, Pattern, Repeat, expressions_of
from lsys_kit.notation.model.system import LSystem, Production
from lsys_kit.notation.read import read_number

if TYPE_CHECKING:
    import sympy

Values: TypeAlias = tuple[Value, ...]
ModuleKind: TypeAlias = tuple[str, int]
"""What a rule asks of a module first: its symbol and the number of its parameters."""
Branch: TypeAlias = tuple["ModuleKind | Branch", ...]
"""A row of modules, some of them branches: what a right context asks for."""


@dataclass(frozen=True)
class ModuleTemplate:
    """A module of a successor: its symbol and the functions of its arguments."""

    symbol: str
    arguments: tuple[Function, ...]


@dataclass(frozen=True)
class RepeatTemplate:
    """A repeated part of a successor: the function that counts, and what is written each time."""

    count: Function
    body: tuple[ModuleTemplate | RepeatTemplate, ...]


@dataclass(frozen=True)
class Rule:
    """One production, ready to run.

    number
        The production's place in the order written, from 0.
    predecessors
        What is replaced: a module, or several one directly behind the other.
    left, right
        What must stand to the left, the nearest first, and to the right, the nearest first.
    equalities
        Pairs of a parameter's index and a function whose value it must have.
    condition, probability
        A truth and a weight, or None.
    successor
        What it makes.
    random
        Whether it draws random numbers.
    looks
        Whether it asks what the turtle sees.
    matches_anew
        Whether its condition or its probability does so, so that equal modules may be matched differently.
    questions
        What its condition asks, each with the function of the answer.
    """

    number: int
    production: Production
    predecessors: tuple[ModuleKind, ...]
    left: tuple[ModuleKind, ...]
    right: Branch
    equalities: tuple[tuple[int, Function], ...]
    condition: Function | None
    probability: Function | None
    successor: tuple[ModuleTemplate | RepeatTemplate, ...]
    random: bool
    looks: bool
    matches_anew: bool
    questions: tuple[tuple[Apply, Function], ...]

    @cached_property
    def least(self) -> int:
        """How many modules it makes at least, before any decomposition."""
        return sum(isinstance(part, ModuleTemplate) for part in self.successor)

    @cached_property
    def d0l(self) -> bool:
        """Whether a module alone decides what the rule does: no neighbour, no chance, and nothing that the turtle sees."""
        alone = len(self.predecessors) == 1 and not (self.left or self.right)
        return alone and not (self.random or self.looks or self.probability is not None)


Rules: TypeAlias = Mapping[ModuleKind, tuple[Rule, ...]]
"""For each symbol and number of parameters its rules, in the order written."""


def rules_of(system: LSystem, arithmetic: str = "exact", section: str = "productions") -> Rules:
    """The rules of a system, by the symbol and the number of parameters of the module that they rewrite; of several, the first.

    >>> from lsys_kit import read
    >>> sorted(rules_of(read("axiom: A(0)\\nA(t) : t < 5 -> A(t+1) B")))
    [('A', 1)]
    """
    return _rules(system, system.source, arithmetic, section)


@lru_cache(maxsize=256)
def _rules(system: LSystem, source: str, arithmetic: str, section: str) -> Rules:
    """The rules; a system that is equal, and was written otherwise, has rules of its own, which stand elsewhere in its text."""
    rules: dict[ModuleKind, list[Rule]] = {}
    for number, production in enumerate(getattr(system, section)):
        rules.setdefault(kind_of(production.predecessor), []).append(rule_for(system, number, production, arithmetic))
    return {kind: tuple(found) for kind, found in rules.items()}


def kind_of(module: Module | Pattern) -> ModuleKind:
    """A module's symbol and the number of its parameters."""
    return module.symbol, len(module.arguments)


def rule_for(system: LSystem, number: int, production: Production, arithmetic: str) -> Rule:
    """A production made ready; its functions take the values of all its parameters, then those of the system's constants."""
    arguments, order = _arguments(production), order_of(system, production)
    formal = {i for i, a in enumerate(arguments) if isinstance(a, Name) and order[a.name] < len(arguments)}

    def ready(expression: Expression) -> Function:
        return function_of(expression, order, arithmetic)

    made = [expression for expression in expressions_of(production.successor) if isinstance(expression, Expression)]
    matched = [part for part in (production.condition, production.probability) if part is not None]
    return Rule(
        number,
        production,
        tuple(map(kind_of, production.predecessors)),
        tuple(map(kind_of, reversed(production.left))),
        _branched_context(production.right),
        tuple((i, ready(a)) for i, a in enumerate(arguments) if i not in formal),
        None if production.condition is None else ready(production.condition),
        None if production.probability is None else ready(production.probability),
        _templates(production.successor, order, len(arguments) + len(system.constants), arithmetic),
        any(map(is_random, [*matched, *made])),
        any(map(_looks, [*matched, *made])),
        any(is_random(part) or _looks(part) for part in matched),
        tuple((question, ready(question)) for question in sensed_in(production.condition)) if production.condition else (),
    )


def _arguments(production: Production) -> list[Expression]:
    return [argument for module in production.parameters for argument in module.arguments]


def order_of(system: LSystem, production: Production) -> dict[str, int]:
    """For each name its place among the values that a production's functions take: its parameters, then the constants."""
    arguments = _arguments(production)
    order = {constant.name: len(arguments) + index for index, constant in enumerate(system.constants)}
    order.update({a.name: i for i, a in enumerate(arguments) if isinstance(a, Name) and a.name not in order})
    return order


def _looks(expression: Expression) -> bool:
    return any(True for _ in sensed_in(expression))


def _templates(
    items: Sequence[Item], order: Mapping[str, int], size: int, arithmetic: str
) -> tuple[ModuleTemplate | RepeatTemplate, ...]:
    """A successor's functions; those of a repeated part take one value more, what counts in it."""
    found: list[ModuleTemplate | RepeatTemplate] = []
    for item in items:
        if isinstance(item, Repeat):
            inner = {**order, item.index: size} if item.index else order
            body = _templates(item.body, inner, size + 1, arithmetic)
            found.append(RepeatTemplate(function_of(item.count, order, arithmetic), body))
        else:
            found.append(ModuleTemplate(item.symbol, tuple(function_of(a, order, arithmetic) for a in item.arguments)))
    return tuple(found)


def is_branch(item: ModuleKind | Branch) -> TypeGuard[Branch]:
    """Whether an item of what a right context asks for is a branch, perhaps an empty one, and no module."""
    return not item or not isinstance(item[0], str)


def _branched_context(modules: Sequence[Pattern]) -> Branch:
    """A right context with its branches as rows of their own."""
    rows: list[list[ModuleKind | Branch]] = [[]]
    for module in modules:
        if module.symbol in OPENING:
            rows.append([])
        elif module.symbol in CLOSING:
            branch = tuple(rows.pop())
            rows[-1].append(branch)
        else:
            rows[-1].append(kind_of(module))
    return tuple(rows[0])


def constants_of(system: LSystem, changes: Mapping[str, object], arithmetic: str = "exact") -> Values:
    """The values of the declared constants, in their order, with some of them changed.

    >>> from lsys_kit import read
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
            value = (
                number_from(changes[constant.name], constant.name)
                if constant.name in changes
                else finite(function_of(constant.value, order, arithmetic)(tuple(values)))
            )
        except (ArithmeticError, ValueError, TypeError) as fault:
            if isinstance(fault, TypeError) and not any(map(is_symbolic, values)):
                raise
            reason = "it depends on an unknown constant" if isinstance(fault, TypeError) else reason_of(fault)
            said = f'The constant "{constant.name}" has no value: {reason}'
            raise ModelValueError(said, system.source or None, *(constant.at or (None, None))) from None
        values.append(float(value) if arithmetic == "float" and not is_symbolic(value) else value)
    return tuple(values)


def with_constants(system: LSystem, values: Mapping[str, object]) -> LSystem:
    """A system with other values of some of its constants.

    >>> from lsys_kit import read
    >>> print(with_constants(read("dt = 7/10\\naxiom: A(dt)"), {"dt": "1.4"}))
    dt = 1.4
    axiom: A(dt)
    """
    constants_of(system, values)
    changed = {name: Number(number_from(value)) for name, value in values.items()}
    return replace(system, constants=tuple(replace(c, value=changed.get(c.name, c.value)) for c in system.constants))


def number_from(given: object, name: str = "value") -> Value:
    """A number as a person gives it, exactly: 1.4 and "1.4" and "14/10" are all 7/5.

    A name that stands for itself, or a sympy expression, stays unknown.

    >>> number_from(1.4), number_from("14/10"), number_from(Fraction(4, 2)), number_from("dt", "dt")
    (Fraction(7, 5), Fraction(7, 5), 2, dt)
    """
    if isinstance(given, str):
        return unknown_constant(name) if given == name else read_number(given)
    if isinstance(given, Formula):
        return expanded_value(given)
    if getattr(given, "free_symbols", None) and getattr(given, "is_commutative", False) and hasattr(given, "is_real"):
        return expanded_value(given)
    if isinstance(given, numbers.Real) and not isinstance(given, bool) and _finite(given):
        if isinstance(given, numbers.Rational):
            return normalised(Fraction(int(given.numerator), int(given.denominator)))
        return normalised(Fraction(repr(float(given))))
    raise ModelValueError(f'"{name}" must be a number, not {_beginning(given)}')


def real_from(given: object, name: str, hint: str | None = None) -> float:
    """A number as a person gives it, where it has to be known, as a double; the hint says what to write instead.

    >>> real_from("14/10", "angle", "Angles are in degrees.")
    1.4
    """
    try:
        return float(number_from(given, name))
    except ModelNameError:
        wanted = "a number"
    except (TypeError, OverflowError):
        wanted = "a number that is known and not too large"
    raise ModelValueError(f'"{name}" must be {wanted}, not {_beginning(given)}', hint=hint)


def unknown_constant(name: str) -> sympy.Symbol:
    """A constant whose value is not known: a real number with a name."""
    import sympy

    return sympy.Symbol(name, real=True)


def _beginning(given: object) -> str:
    try:
        return repr(quotable(str(given)[:40])) if isinstance(given, str | numbers.Number) else shown(given)
    except ValueError:  # Python refuses to write a whole number of thousands of digits
        return "one of thousands of digits"


def _finite(given: numbers.Real) -> bool:
    try:
        return math.isfinite(given)
    except OverflowError:
        return False
