"""What `grammar.lark` names, as records: functions, angles, random numbers, and the definitions of a system."""

from __future__ import annotations

import re
from collections.abc import Iterable, Iterator
from dataclasses import dataclass, replace
from itertools import count
from typing import TypeAlias

from lark import Token, v_args

from lsys_kit.budget import current
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.dialects.mathematica.expressions import (
    ANGLES,
    DISTRIBUTIONS,
    FUNCTIONS,
    INSTEAD,
    INVERSES,
    TESTS,
    spelling_hint,
)
from lsys_kit.notation.model.expressions import Apply, Expression, Name, Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import Constant, Production
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS, quoted_dialects
from lsys_kit.notation.syntax.actions import Expressions, Part, Statement, check_arity, check_name, place_of


@v_args(inline=True)
class MathematicaExpressions(Expressions):
    """What expressions name in Mathematica alone."""

    def number(self, token: Token) -> Number:
        return super().number(token.update(value=token.replace("*^", "e")))

    def call(self, name: Token, *operands: Expression) -> Expression:
        if name in TESTS:
            return self._test(name, operands)
        if name not in FUNCTIONS:
            functions = f"Functions are: {', '.join(sorted((*FUNCTIONS, *TESTS, *ANGLES)))}."
            hint = INSTEAD.get(name) or spelling_hint(name) or functions
            raise problem("unknown function", place_of(name), name=name, hint=hint)
        return self._of(name, FUNCTIONS[name], operands)

    def _test(self, name: Token, operands: tuple[Expression, ...]) -> Expression:
        check_arity(name, "abs", operands)
        modulo, relation, value = TESTS[name]
        at = place_of(name, *operands)
        tested = self._applied(modulo, (*operands, Number(2)), at) if modulo else operands[0]
        return self._applied(relation, (tested, Number(value)), at)

    def _of(self, name: Token, operator: str, operands: tuple[Expression, ...]) -> Expression:
        check_arity(name, operator, operands)
        return self._applied(operator, operands, place_of(name, *operands))

    def chain(self, left: Expression, relation: Token, right: Expression, *rest: Part) -> Expression:
        whole = self.binary(left, relation, right)
        for sign, further in zip(rest[::2], rest[1::2], strict=True):
            whole = self._applied("&&", (whole, self.binary(right, sign, further)), place_of(whole, further))
            right = further
        return whole

    def degrees(self, name: Token, angle: Expression, *sign: Token) -> Expression:
        times, degree = (*sign, None)[0], sign[-1]
        if len(sign) == 2 and times not in ("*", "·", "×"):
            raise problem("angle times", place_of(times, degree), name=name)
        return self._of(name, ANGLES[name], (angle,))

    def radians(self, name: Token, angle: Expression) -> Expression:
        raise problem("radians", place_of(name, angle), name=name)

    def inverse(self, name: Token, value: Expression, over: Token, degree: Token) -> Expression:
        if over != "/":
            raise problem("inverse in radians", place_of(name, degree), name=name)
        return self._of(name, INVERSES[name], (value,))

    def uniform(self, name: Token, *ends: Expression) -> Expression:
        return self._applied("uniform", ends, place_of(name, *ends))

    def drawn(self, _: Token, distribution: Token, *operands: Expression) -> Expression:
        if distribution not in DISTRIBUTIONS:
            hint = suggestion(distribution, DISTRIBUTIONS) or f"Distributions are: {', '.join(DISTRIBUTIONS)}."
            raise problem("unknown distribution", place_of(distribution), name=distribution, hint=hint)
        return self._of(distribution, DISTRIBUTIONS[distribution], operands)

    def numbers(self, *values: Expression) -> tuple[Expression, ...]:
        return values

    def table(self, name: Token, weights: tuple[Expression, ...], _: Token, values: tuple[Expression, ...]) -> Expression:
        if [value.value if isinstance(value, Number) else None for value in values] != list(range(len(weights))):
            raise problem("weights", place_of(*values))
        return self._of(name, "table", weights)


WordDefinition: TypeAlias = tuple[Pattern, ...]
SYMBOL_PATTERN = re.compile(r"[A-Za-z_]\w*'*[*+\-]?|[@?][A-Za-z]\w?|\d|[^\w\sε]", re.ASCII)
"""What is possible between quotation marks: a name, perhaps with an operator of GROGRA, or a sign."""


@dataclass(frozen=True)
class RequiredArgument:
    """An argument of a pattern: the name of a parameter, or a value that must match; and its condition."""

    value: Expression
    named: bool = False
    condition: Expression | None = None


@dataclass(frozen=True)
class PatternDefinition:
    """A pattern of a rule, with the condition after it."""

    symbol: Token
    arguments: tuple[RequiredArgument, ...]
    condition: Expression | None = None

    @property
    def conditions(self) -> Iterator[Expression]:
        """All its conditions, in the order written."""
        yield from (condition for condition in (*(one.condition for one in self.arguments), self.condition) if condition)


@dataclass(frozen=True)
class RuleDefinition:
    """A production, with the arguments of its patterns, and its place."""

    production: Production
    arguments: tuple[RequiredArgument, ...]
    at: tuple[int, int]


@dataclass(frozen=True)
class RuleList:
    """The members of LRULES: rules, or names of rules; and whether a comma follows the last."""

    members: tuple[RuleDefinition | Token, ...] = ()
    comma: bool = False


@dataclass(frozen=True)
class SystemDefinition:
    """An LSystem: its axiom and its rules, or the names of them; None where the text's only ones are meant."""

    axiom: WordDefinition | Token | None = None
    rules: RuleList | Token | None = None
    printed: bool = False


@dataclass(frozen=True)
class Run:
    """A system that is run, or its name, and for how many steps."""

    system: SystemDefinition | Token
    steps: Expression


def both(first: Expression | None, second: Expression) -> Expression:
    """One condition and another; what the other joins is joined in turn.

    >>> from lsys_kit.notation.read import read_expression
    >>> print(both(read_expression("a > 0"), read_expression("b > 0 && c > 0")))
    a > 0 && b > 0 && c > 0
    """
    if first is None:
        return second
    if isinstance(second, Apply) and second.operator == "&&":
        return both(both(first, second.operands[0]), second.operands[1])
    return Apply("&&", (first, second), first.at)


def condition_of(conditions: Iterable[Expression]) -> Expression | None:
    """What several conditions say together."""
    whole: Expression | None = None
    for condition in conditions:
        whole = both(whole, condition)
    return whole


@v_args(inline=True)
class MathematicaStatements(MathematicaExpressions):
    """What the definitions name."""

    def word(self, *modules: Pattern) -> WordDefinition:
        return modules

    def module(self, symbol: Token, *arguments: Expression) -> Pattern:
        return Pattern(str(symbol), arguments, place_of(symbol, *arguments))

    def symbol(self, token: Token) -> Token:
        """The symbol, without its quotation marks."""
        check_name(token)
        if token.type == "NAME":
            return _check_plain_name(token, "A symbol")
        text = re.sub(r"\\(.)", r"\1", token[1:-1])
        if not SYMBOL_PATTERN.fullmatch(text):
            raise problem("several symbols quoted", place_of(token))
        return token.update(value=text)

    def pattern(self, symbol: Token, *arguments: RequiredArgument) -> PatternDefinition:
        return PatternDefinition(symbol, arguments)

    def parameter(self, blank: Token, *condition: Expression) -> RequiredArgument:
        name = blank[:-1]
        if name.endswith("_"):
            raise problem("row of values", place_of(blank), blank=blank, name=name.rstrip("_"))
        check_name(_check_plain_name(blank.update(value=name), "A parameter"))
        return RequiredArgument(Name(name, place_of(blank)), True, *condition)

    def argument(self, value: Expression, *condition: Expression) -> RequiredArgument:
        if condition:
            hint = f'Type "{value}_ /; ...".' if isinstance(value, Name) else ""
            raise problem("condition on value", value.at, hint=hint)
        return RequiredArgument(value)

    def conditioned(self, pattern: PatternDefinition, condition: Expression) -> PatternDefinition:
        return replace(pattern, condition=condition)

    def side(self, _: Token, *patterns: PatternDefinition) -> tuple[PatternDefinition, ...]:
        return patterns

    def succ(self, _: Token, *word: WordDefinition) -> WordDefinition:
        return word[0] if word else ()

    def lrule(
        self,
        keyword: Token,
        left: tuple[PatternDefinition, ...],
        pred: tuple[PatternDefinition, ...],
        right: tuple[PatternDefinition, ...],
        succ: WordDefinition,
        closing: Token,
    ) -> RuleDefinition:
        return _rule_of(left, pred[0], right, succ, (keyword.start_pos or 0, closing.end_pos or 0))

    def before(self, *patterns: PatternDefinition) -> tuple[str, tuple[PatternDefinition, ...]]:
        return "left", patterns

    def behind(self, *patterns: PatternDefinition) -> tuple[str, tuple[PatternDefinition, ...]]:
        return "right", patterns

    def successor(self, *word: WordDefinition) -> WordDefinition:
        return word[0] if word else ()

    def printed_rule(self, *parts: Part) -> Statement:
        sides: dict[str, tuple[PatternDefinition, ...]] = dict(part for part in parts[:-1] if isinstance(part, tuple))
        pattern = next(part for part in parts if isinstance(part, PatternDefinition))
        at = pattern.symbol.start_pos or 0, parts[-2].end_pos or 0
        return "deferred", ("printed_rule", _rule_of(sides.get("left", ()), pattern, sides.get("right", ()), parts[-1], at))

    def last_comma(self) -> None:
        return None

    def lrules(self, _: Token, *members: RuleDefinition | Token | None) -> RuleList:
        return RuleList(tuple(member for member in members if member is not None), None in members)

    def axiom(self, _: Token, word: WordDefinition) -> WordDefinition:
        return word

    def lsystem(self, _: Token, axiom: WordDefinition | Token, rules: RuleList | Token) -> SystemDefinition:
        return SystemDefinition(axiom, rules)

    def run(self, _: Token, system: SystemDefinition | Token, steps: Expression) -> Run:
        return Run(system, steps)

    def definition(self, *parts: object) -> Statement:
        things = [part for part in parts if not isinstance(part, Token)]
        return "deferred", ("definition", (str(parts[0]) if isinstance(parts[0], Token) else "", things[0]))

    def unknown(self, _: Token, __: Token, call: Token) -> Statement:
        name = call.split("[")[0].rstrip()
        at = call.start_pos or 0
        hint = INSTEAD.get(name) or spelling_hint(name) or "What prints or draws can be left out."
        raise problem("unknown call", (at, at + len(name)), name=name, hint=hint)

    def constant(self, name: Token, _: Token, value: Expression, *slider: Part) -> Statement:
        check_name(_check_plain_name(name, "A constant"))
        return "deferred", ("constant", Constant(str(name), value, slider[1:] or None))

    def setting(self, keyword: Token, _: Token, value: Expression) -> Statement:
        return "deferred", ("setting", (str(keyword), value))

    def turtle(self, keyword: Token, _: Token, tradition: Token) -> Statement:
        if tradition[1:-1] not in TURTLE_DIALECTS:
            raise problem("unknown turtle", place_of(tradition), tradition=tradition, turtles=quoted_dialects("or"))
        return "deferred", ("setting", ("turtle", str(tradition[1:-1])))

    def look(self, token: Token) -> Statement:
        name, said = re.findall("[a-z]+", token)
        return "deferred", ("setting", (name, said))

    def row(self, _keyword: Token, _: Token, *symbols: Token) -> Statement:
        bracket = next((symbol for symbol in symbols if symbol in "[]"), None)
        if bracket is not None:
            raise problem("bracket in list", place_of(bracket))
        kept = tuple(dict.fromkeys(str(symbol) for symbol in symbols if (symbol.type, symbol) != ("NAME", "Null")))
        return "deferred", ("setting", ("ignore", kept))

    def alone(self, name: Token) -> Statement:
        return "deferred", ("alone", name)

    def printed_axiom(self, _: Token, word: WordDefinition) -> Statement:
        return "deferred", ("printed_axiom", word)

    def other(self, *parts: Token) -> Statement:
        named = re.search(r"\b\w++(?=\s*+\[)", parts[0]) or re.search(r"\w+", parts[0])
        return "deferred", ("other", named.group() if named else str(parts[0]).strip())


def _check_plain_name(name: Token, what: str) -> Token:
    """A name that means nothing else in Mathematica."""
    if name.endswith("_"):
        raise problem("blank behind name", place_of(name), what=what, name=name.rstrip("_"))
    if name == "Degree":
        raise problem("called Degree", place_of(name), what=what)
    return name


def _rule_of(
    left: tuple[PatternDefinition, ...],
    pattern: PatternDefinition,
    right: tuple[PatternDefinition, ...],
    successor: WordDefinition,
    at: tuple[int, int],
) -> RuleDefinition:
    every = (*left, pattern, *right)
    condition = condition_of(condition for one in every for condition in one.conditions)
    if isinstance(condition, Apply) and condition.depth > current().depth:
        raise problem("conditions too deep", at, most=current().depth)
    numbers = count(1)
    modules = tuple(_module_of(one, numbers) for one in every)
    own = len(left)
    production = Production((modules[own],), successor, condition, modules[:own], modules[own + 1 :])
    return RuleDefinition(production, tuple(argument for one in every for argument in one.arguments), at)


def _module_of(pattern: PatternDefinition, numbers: Iterator[int]) -> Pattern:
    """The module of a pattern; a parameter that is only "_" is named by the next number."""
    arguments = tuple(
        Name(f"_{next(numbers)}", required.value.at) if required.value == Name("") else required.value
        for required in pattern.arguments
    )
    return Pattern(str(pattern.symbol), arguments, place_of(pattern.symbol, *arguments))
