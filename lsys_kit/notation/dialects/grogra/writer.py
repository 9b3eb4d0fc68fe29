r"""A system in GROGRA's notation: its words, its lines, and what the notation lacks.

The records have draws where GROGRA has names: RH(uniform(0, 360)) is written `RH(x0)`, after `\var x0 uniform 0 360`. So a text
has a variable for each distinct draw, function and index.
"""

from __future__ import annotations

import re
from collections.abc import Collection, Iterable, Iterator, Mapping
from dataclasses import dataclass, replace
from itertools import count

from lsys_kit.notation.dialects.grogra.probabilities import complete_probabilities
from lsys_kit.notation.dialects.grogra.variables import Variable, names_of, random_call
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    Style,
    names_in,
    styled_text,
    transform,
)
from lsys_kit.notation.model.modules import END, Item, Module, Pattern, Repeat, expressions_of, with_expressions
from lsys_kit.notation.model.system import LOOK, Constant, LSystem, Production
from lsys_kit.notation.syntax.formatting import unusual

_FunctionKey = tuple[int, int]
"""A sensitive function: its number, and how many values it takes."""


@dataclass(frozen=True)
class Declared:
    """The variables of a system.

    Attributes
    ----------
    draws, functions
        Their names.
    levels
        For each index how many repetitions are around the one that it counts.
    """

    draws: Mapping[Expression, str]
    functions: Mapping[_FunctionKey, str]
    levels: Mapping[str, int]

    @property
    def variables(self) -> Iterator[Variable]:
        """The variables to declare."""
        for drawn, name in self.draws.items():
            yield replace(as_variable(drawn), name=name)
        for (number, values), name in self.functions.items():
            yield Variable(name, "function", (Number(number), Number(values)))
        for name, level in self.levels.items():
            yield Variable(name, "index", (Number(level),) if level else ())


def declarations(system: LSystem) -> Declared:
    """The variables that a system needs.

    >>> from lsys_kit.notation.read import read
    >>> needed = declarations(read("axiom: a\\na -> RH(uniform(0, 360)) repeat(3, i) <b(i)> RU(uniform(0, 360))"))
    >>> [(variable.name, variable.kind) for variable in needed.variables]
    [('x0', 'uniform'), ('i', 'index')]
    """
    taken = {name for expression in _expressions(system) for name in names_in(expression)}
    calls = [call for expression in _expressions(system) for call in _draws_and_senses(expression)]
    draws = dict.fromkeys(call for call in calls if call.operator != "sensed")
    functions = dict.fromkeys(_function_key(call) for call in calls if call.operator == "sensed")
    levels = {repeat.index: level for repeat, level in _repeats(system) if repeat.index}
    return Declared(
        dict(zip(draws, _free_names("x", taken), strict=False)),
        dict(zip(functions, _free_names("f", taken), strict=False)),
        levels,
    )


def _free_names(letter: str, taken: Collection[str]) -> Iterator[str]:
    """Names made of the letter and a number, without those that are taken."""
    return (name for name in (f"{letter}{number}" for number in count()) if name not in taken)


def _expressions(system: LSystem) -> Iterator[Expression]:
    for constant in system.constants:
        yield from (Name(constant.name), constant.value)
    yield from expressions_of(system.axiom)
    for rule in system.rules:
        yield from expressions_of(rule.parameters)
        yield from (part for part in (rule.condition, rule.probability) if part is not None)
        yield from expressions_of(rule.successor)


def _draws_and_senses(expression: Expression) -> Iterator[Apply]:
    """The random and the sensitive calls in an expression."""
    if isinstance(expression, Apply):
        if expression.operator == "sensed" or OPERATORS[expression.operator].random:
            yield expression
        if not OPERATORS[expression.operator].random:
            for operand in expression.operands:
                yield from _draws_and_senses(operand)


def _function_key(call: Apply) -> _FunctionKey:
    first, count = call.operands[0], len(call.operands) - 1
    number = first.value if isinstance(first, Number) else -1
    return (number if isinstance(number, int) else -1), count


def _repeats(system: LSystem) -> Iterator[tuple[Repeat, int]]:
    """What is repeated, each with the number of repetitions around it."""
    todo: list[tuple[Item, int]] = [(item, 0) for rule in system.rules for item in rule.successor]
    for item, level in todo:
        if isinstance(item, Repeat):
            yield item, level
            todo += [(part, level + 1) for part in item.body]


def as_variable(drawn: Expression) -> Variable:
    """What a draw is declared as, without a name; its inverse is `random_call`.

    >>> as_variable(Apply("normal", (Number(0), Number(3)))).values
    (Number(value=0), Number(value=9))
    """
    assert isinstance(drawn, Apply)
    if drawn.operator != "normal":
        return Variable("", drawn.operator, drawn.operands)
    mean, deviation = drawn.operands
    if isinstance(deviation, Apply) and deviation.operator == "sqrt":
        return Variable("", "normal", (mean, deviation.operands[0]))
    variance = Number(deviation.value**2) if isinstance(deviation, Number) else Apply("^", (deviation, Number(2)))
    return Variable("", "normal", (mean, variance))


def inexpressible(system: LSystem) -> str | None:
    """The first random number, repetition or sensitive function of a system that variables cannot express, in words."""
    needed, constants = declarations(system), {constant.name for constant in system.constants}
    for drawn in needed.draws:
        values = as_variable(drawn).values
        if any(names_in(value) - constants or any(_draws_and_senses(value)) for value in values):
            return "random numbers that depend on parameters"
        if random_call(as_variable(drawn)) != drawn:
            return f"random number like {drawn}"
    if any(number < 0 for number, _ in needed.functions):
        return "sensitive functions whose number is calculated"
    for repeat, level in _repeats(system):
        if repeat.index and repeat.index not in names_of(repeat.body):
            return f'index like "{repeat.index}", which counts and is not used'
        if repeat.index and needed.levels[repeat.index] != level:
            return f'index like "{repeat.index}", which counts at two levels'
    return None


def with_variables(expression: Expression, names: Declared) -> Expression:
    """An expression with variables in place of random and sensitive calls."""

    def change(part: Expression) -> Expression | None:
        if part in names.draws:
            return Name(names.draws[part])
        if not isinstance(part, Apply) or part.operator != "sensed":
            return None
        values = ", ".join(str(with_variables(value, names)) for value in part.operands[1:])
        return Name(f"{names.functions[_function_key(part)]}{f'({values})' if values else ''}")

    return transform(expression, change)


def rule_with_variables(rule: Production, names: Declared) -> Production:
    """A rule with variables in place of random and sensitive calls."""
    condition, probability = (
        part if part is None else with_variables(part, names) for part in (rule.condition, rule.probability)
    )
    successor = with_expressions(rule.successor, lambda expression: with_variables(expression, names))
    return replace(rule, condition=condition, probability=probability, successor=successor)


STYLE = Style({"==": "="})
_COMMAND = re.compile(r"R[ULHVG]|[FfLDNPVCHU]l?[+*]?|@")
_PLAIN_NUMBER = re.compile(r"-?\d+(\.\d+)?")
START = (Pattern("*"),)
"""The axiom of a text that names none."""


def module_text(module: Module | Pattern) -> str:
    """A module; a plain number is glued to a built-in command.

    >>> print(module_text(Module("RU", (45,))), module_text(Module("L*", (0.6,))), module_text(Module("a", (1, 2))))
    RU45 L*0.6 a(1, 2)
    """
    texts = [styled_text(a, STYLE) if isinstance(a, Expression) else number_text(a) for a in module.arguments]
    if len(texts) == 1 and _COMMAND.fullmatch(module.symbol) and _PLAIN_NUMBER.fullmatch(texts[0]):
        return module.symbol + texts[0]
    return f"{module.symbol}({', '.join(texts)})" if texts else module.symbol


def expression_text(expression: Expression) -> str:
    """An expression, with "=" for equality."""
    return styled_text(expression, STYLE)


def joined_word(texts: Iterable[str]) -> str:
    """The texts of modules as one word: blanks between them, none inside brackets.

    >>> joined_word(["F", "[", "RU45", "b", "]", "a"])
    'F [RU45 b] a'
    """
    parts: list[str] = []
    for text in texts:
        if parts and parts[-1] != "[" and text != "]":
            parts.append(" ")
        parts.append(text)
    return "".join(parts)


def successor_text(items: Iterable[Item]) -> str:
    """The text of a successor, with what is repeated as `&(n) < ... >`."""
    return joined_word(
        f"&{_count_text(item.count)} < {successor_text(item.body)} >" if isinstance(item, Repeat) else module_text(item)
        for item in items
    )


def _count_text(count: Expression) -> str:
    text = styled_text(count, STYLE)
    return text if text.isdigit() else f"({text})"


def rule_text(rule: Production, arrow: str = "#") -> str:
    """The text of a rule: the condition in front, the probability at the end."""
    condition = "" if rule.condition is None else f"({styled_text(rule.condition, STYLE)})"
    left, right = joined_word(map(module_text, rule.left)), joined_word(map(module_text, rule.right))
    probability = "" if rule.probability is None else f"?{styled_text(rule.probability, STYLE)}"
    parts = (
        condition,
        f"{left} <" if left else "",
        module_text(rule.predecessor),
        f"> {right}" if right else "",
        arrow,
        successor_text(rule.successor),
        probability,
    )
    return " ".join(filter(None, parts))


def system_text(system: LSystem) -> str:
    """The text of a system that lacks nothing in GROGRA's notation."""
    names = declarations(system)
    return ",\n".join(
        [
            *_settings(system),
            *map(_constant, system.constants),
            *map(_variable, names.variables),
            *_axiom(system),
            *(rule_text(rule_with_variables(rule, names)) for rule in system.productions),
            *(rule_text(rule_with_variables(rule, names), "##") for rule in system.interpretation),
        ]
    )


def _settings(system: LSystem) -> Iterator[str]:
    """The lines of settings that differ from the defaults."""
    if system.turtle != "grogra":
        yield f"\\set turtle {system.turtle}"
    for directive, value, usual in (
        ("\\angle", system.angle, 90),
        ("\\set heading", system.heading, 90),
        ("\\length", system.length, None),
        ("\\set seed", system.seed, None),
        ("\\set depth", system.depth, 1),
    ):
        if value is not None and value != usual:
            yield f"{directive} {_value_text(Number(value))}"
    yield from (f"\\set {name} {said}" for name, said in unusual(system, *LOOK))


def _constant(constant: Constant) -> str:
    ends = [_value_text(part) for part in constant.range or ()]
    span = " in {} .. {} by {}".format(*ends) if ends else ""
    return f"\\const {constant.name} {_value_text(constant.value)}{span}"


def _value_text(value: Expression) -> str:
    """A value on a line of its own: in parentheses, if it is calculated."""
    text = styled_text(value, STYLE)
    return text if isinstance(value, Name) or re.fullmatch(r"-?[\d.]+(e[+-]?\d+)?", text) else f"({text})"


def _axiom(system: LSystem) -> Iterator[str]:
    if system.axiom != START or system.steps is not None or all(r.predecessor != START[0] for r in system.productions):
        steps = "" if system.steps is None else f" {min(1, system.steps)}-{system.steps}"
        yield f"\\axiom {joined_word(map(module_text, system.axiom))}{steps}"


def _variable(variable: Variable) -> str:
    return " ".join(("\\var", variable.name, variable.kind, *map(_value_text, variable.values)))


def missing_feature(system: LSystem) -> str | None:
    """What else a system has and GROGRA's notation lacks, in words."""
    ends = any(module.symbol == END for rule in system.rules for module in rule.right)
    return (
        (None if system.decomposition_depth is None else "depth of decomposition")
        or ("branch ends in contexts" if ends else None)
        or (None if system.axiom else "empty axiom")
        or inexpressible(system)
        or (None if complete_probabilities(system)[0] == system.productions else "probabilities with another sum than 1")
    )
