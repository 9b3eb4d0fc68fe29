"""Block statements of cpfg, `{x = t + 1;}`, by substitution: what follows has the expression in place of the name."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, field, replace
from typing import TypeAlias

from lsys_kit.budget import current
from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.analysis.checks import span
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name
from lsys_kit.notation.model.modules import Pattern, flat
from lsys_kit.notation.model.system import Production

Bindings: TypeAlias = Mapping[str, Expression]
"""The expressions of names at some place of a rule."""
MOST_OPERATORS = 1_000
"""The greatest number of operators in an expression, after substitution."""


@dataclass(frozen=True)
class Assignment:
    """A name and its expression from there on."""

    name: Name
    value: Expression


@dataclass(frozen=True)
class Choice:
    """The blocks for a condition that is true, and that is false."""

    condition: Expression
    then: Block
    otherwise: Block
    depth: int = field(init=False, compare=False, repr=False)

    def __post_init__(self) -> None:
        inner = (part.depth for part in (*self.then, *self.otherwise) if isinstance(part, Choice))
        object.__setattr__(self, "depth", 1 + max(inner, default=0))


Block: TypeAlias = tuple[Assignment | Choice, ...]
"""Statements, in the order written."""


def substitute(production: Production, before: Block, after: Block, constants: Collection[str], source: str) -> Production:
    """A rule with what its blocks compute: one before its condition, one after it.

    >>> x, doubled = Name("x"), Apply("+", (Name("t"), Name("t")))
    >>> rule = Production((Pattern("M", (Name("t"),)),), (Pattern("I", (x,)),))
    >>> print(substitute(rule, (), (Assignment(x, doubled),), (), ""))
    M(t) -> I(t + t)
    """
    if not before and not after:
        return production
    names = [argument.name for module in production.parameters for argument in module.arguments if isinstance(argument, Name)]
    rule = _Rule(frozenset(names), frozenset(constants), source)
    first = rule.computed(before, {})
    last = rule.computed(after, first)
    condition, probability = production.condition, production.probability
    done = replace(
        production,
        condition=None if condition is None else rule.replaced(condition, first),
        successor=tuple(_substituted_module(rule, module, last) for module in flat(production.successor)),
        probability=None if probability is None else rule.replaced(probability, last),
    )
    _check_draws(done, (*before, *after), source)
    return done


def computed(block: Block, constants: Iterable[str], source: str, before: Iterable[str] = ()) -> Bindings:
    """What the statements of a block compute, by name, perhaps from values before; they use constants, and do not change them.

    >>> print(computed((Assignment(Name("n"), Name("k")), Assignment(Name("m"), Name("n"))), ["k"], "")["m"])
    k
    """
    return _Rule(frozenset(before), frozenset(constants), source).computed(block, {})


def assigned_names(block: Block) -> set[str]:
    """The names to which the statements of a block give values."""
    return {assignment.name.name for assignment in _assignments(block)}


def _substituted_module(rule: _Rule, module: Pattern, values: Bindings) -> Pattern:
    return replace(module, arguments=tuple(rule.replaced(a, values) for a in module.arguments))


@dataclass(frozen=True)
class _Rule:
    """What a rule's blocks may use: its parameters, and the constants, which they may not change."""

    parameters: frozenset[str]
    constants: frozenset[str]
    source: str

    def computed(self, block: Block, values: Bindings) -> Bindings:
        """The bindings after a block."""
        for statement in block:
            if isinstance(statement, Choice):
                values = self._chosen(statement, values)
            elif statement.name.name in self.constants:
                raise ModelNameError(
                    f'The constant "{statement.name}" cannot be changed',
                    self.source,
                    *span(statement.name),
                    "Give what is computed a name of its own.",
                )
            else:
                values = {**values, statement.name.name: self.replaced(statement.value, values)}
        return values

    def _chosen(self, choice: Choice, values: Bindings) -> Bindings:
        """The bindings after a choice."""
        condition = self.replaced(choice.condition, values)
        then, otherwise = self.computed(choice.then, values), self.computed(choice.otherwise, values)
        changed = [name for name in {**then, **otherwise} if then.get(name) is not otherwise.get(name)]
        return {
            **values,
            **{
                name: Apply(
                    "if", (condition, self._value(name, then, choice, "false"), self._value(name, otherwise, choice, "true"))
                )
                for name in changed
            },
        }

    def _value(self, name: str, values: Bindings, choice: Choice, truth: str) -> Expression:
        """The expression of a name in one of the two cases."""
        if name in values or name in self.parameters:
            return values.get(name, Name(name))
        raise ModelNameError(
            f'"{name}" has a value only where this condition is {truth}',
            self.source,
            *span(choice.condition),
            f'Give it one in the other case, too: "else {{{name} = 0;}}".',
        )

    def replaced(self, expression: Expression, values: Bindings) -> Expression:
        """An expression with its names replaced."""
        result = _with_values(expression, values)
        if getattr(result, "depth", 0) > current().depth or _long(result):
            raise ModelSyntaxError(
                "What is computed here becomes too long an expression",
                self.source,
                *span(expression),
                "Compute less in one rule, and the rest in the next step.",
            )
        return result


def _with_values(expression: Expression, values: Bindings) -> Expression:
    if isinstance(expression, Name):
        return values.get(expression.name, expression)
    if not isinstance(expression, Apply):
        return expression
    operands = tuple(_with_values(operand, values) for operand in expression.operands)
    same = all(new is old for new, old in zip(operands, expression.operands, strict=True))
    return expression if same else replace(expression, operands=operands)


def _operators(expression: Expression | None) -> Iterator[Apply]:
    """The operators of an expression with their operands; what occurs twice comes twice."""
    if isinstance(expression, Apply):
        yield expression
        for operand in expression.operands:
            yield from _operators(operand)


def _long(expression: Expression) -> bool:
    return any(number == MOST_OPERATORS for number, _ in enumerate(_operators(expression)))


def _assignments(block: Block) -> Iterator[Assignment]:
    for statement in block:
        if isinstance(statement, Assignment):
            yield statement
        else:
            yield from (*_assignments(statement.then), *_assignments(statement.otherwise))


def _check_draws(production: Production, block: Block, source: str) -> None:
    """No random number that was drawn once in a block is drawn twice in what became of the rule."""
    arguments = [argument for module in flat(production.successor) for argument in module.arguments]
    drawn: set[int] = set()
    for expression in (production.condition, production.probability, *arguments):
        for applied in _operators(expression):
            if OPERATORS[applied.operator].random and id(applied) in drawn:
                raise _drawn_twice(applied, block, source)
            drawn.add(id(applied))


def _drawn_twice(draw: Apply, block: Block, source: str) -> ModelValueError:
    """The error for a random number that is used twice, with its name, if it has one."""
    owner = next((a for a in _assignments(block) if any(applied is draw for applied in _operators(a.value))), None)
    what = f'The random number "{owner.name}"' if owner else "This random number"
    return ModelValueError(
        f"{what} would be drawn anew at each of its uses",
        source,
        *span(owner.name if owner else draw),
        'Make it the parameter of a module, as in "A --> B(ran(1))", and use that in the next step.',
    )
