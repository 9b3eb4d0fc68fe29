"""Does a text that can be read also make sense? Names that stand for something, truths where truths are asked for,
brackets that close, sliders whose values are in their range. Each check raises the error that a student can act on."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType

from lsys_kit.budget import current
from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value, finite, reason_of
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    expression_type,
    function_of,
    names_in,
)
from lsys_kit.notation.model.system import Constant, Item, MetaRule, Module, Production, Repeat


def span(thing: object) -> tuple[int | None, int | None]:
    """Where a record stood in its text."""
    return getattr(thing, "at", None) or (None, None)


def suggestion(name: str, known: Collection[str], likeness: float = 0.6) -> str | None:
    """A hint that names what was probably meant.

    >>> suggestion("lifetimeA", ["lifeTimeA", "dt"])
    'Did you mean "lifeTimeA"?'
    """
    close = (get_close_matches(name, sorted(known), 1, likeness)
             or get_close_matches(name.lower(), sorted(known), 1, likeness))
    return f'Did you mean "{close[0]}"?' if close else None


_NO_NAMES = 'A parameter is named before the arrow, as in "A(t) -> A(t+1)"; a constant on a line before, as in "dt = 0.5".'
_RANDOM = 'Random numbers stand behind the arrow of a production, as in "A -> F(uniform(1, 2))".'
SETTINGS = frozenset(("axiom", "Axiom", "angle", "heading", "steps", "alphabet"))
"""What is set with a colon and is no constant."""


def value_of(expression: Expression, source: str, values: Mapping[str, Value] = MappingProxyType({})) -> Value:
    """What an expression comes to, given the values of its names.

    >>> value_of(Apply("+", (Name("dt"), Name("dt"))), "", {"dt": 2})
    4
    """
    order = {name: index for index, name in enumerate(values)}
    try:
        return finite(function_of(expression, order)(tuple(values.values())))
    except (ArithmeticError, ValueError) as fault:
        raise ModelValueError(f'"{expression}" has no value: {reason_of(fault)}', source, *span(expression)) from None


def check_expression(expression: Expression, names: Collection[str], source: str, wanted: str = "number",
                     chance: bool = False) -> None:
    """Every name is known, every operator gets what it takes, nothing is random where chance has no place, and the whole is
    what is wanted of it."""
    if isinstance(expression, Name) and expression.name not in names:
        known = ", ".join(f'"{name}"' for name in sorted(names))
        hint = suggestion(expression.name, names) or (f"Known here: {known}." if known else _NO_NAMES)
        raise ModelNameError(f'I do not know the name "{expression.name}"', source, *span(expression), hint)
    if isinstance(expression, Apply):
        operator = OPERATORS[expression.operator]
        if operator.random and not chance:
            raise ModelValueError(f'"{expression}" is another number at every use, which cannot be here', source,
                                  *span(expression), _RANDOM)
        for index, operand in enumerate(expression.operands):
            check_expression(operand, names, source, operator.wanted(index), chance)
    if expression_type(expression) != wanted:
        if wanted == "truth":
            raise ModelValueError(f'"{expression}" is a number, but something true or false is needed here', source,
                                  *span(expression), f'Compare it with something, as in "{expression} > 0".')
        raise ModelValueError(f'"{expression}" is true or false, but a number is needed here', source, *span(expression))


def check_constants(constants: Iterable[Constant], source: str) -> None:
    """Every constant is declared once, from those before it, with a value in the range of its slider."""
    values: dict[str, Value] = {}
    for constant in constants:
        if constant.name in values:
            raise ModelNameError(f'The constant "{constant.name}" is declared twice', source, *span(constant),
                                 "Keep one of the two lines.")
        if constant.name in SETTINGS:
            raise ModelNameError(f'"{constant.name}" is no constant', source, *span(constant),
                                 f'Type "{constant.name.lower()}: {constant.value}".')
        if isinstance(constant.value, Name) and constant.value.name not in values:
            hint = suggestion(constant.value.name, values) or f'A production reads "{constant.name} -> {constant.value}".'
            raise ModelNameError(f'I do not know the name "{constant.value}"', source, *span(constant.value), hint)
        for expression in (constant.value, *(constant.range or ())):
            check_expression(expression, values.keys(), source)
        check_range(constant, values, source)
        values[constant.name] = value_of(constant.value, source, values)


def check_range(constant: Constant, values: Mapping[str, Value], source: str) -> None:
    """The value lies between the ends of its slider, which has a step that leads from one to the other."""
    if constant.range is None:
        return
    low, high, step = (value_of(part, source, values) for part in constant.range)
    shown = f"{constant.range[0]} .. {constant.range[1]}"
    if low > high:
        raise ModelValueError(f'The range of "{constant.name}" is upside down', source, *span(constant.range[0]),
                              f'Write the smaller end first: "in {constant.range[1]} .. {constant.range[0]}".')
    if step <= 0:
        raise ModelValueError(f'The step of "{constant.name}" must be greater than 0', source, *span(constant.range[2]),
                              'It says how far one move of the slider goes, as in "by 0.1".')
    if not low <= value_of(constant.value, source, values) <= high:
        raise ModelValueError(f'"{constant.name}" is {constant.value}, which is not in its range {shown}', source,
                              *span(constant.value), "Choose a value in the range, or a wider range.")


def check_production(production: Production, constants: Collection[str], source: str, section: str = "productions") -> None:
    """Parameters are distinct, names known, the condition a truth, the brackets closed, contexts where they are possible."""
    names = {*check_parameters(production.parameters, constants, source), *constants}
    if section != "productions" and (production.left or production.right):
        raise ModelSyntaxError(f"A rule of the {section} has no context", source, *span(production),
                               "It is applied to one module at a time.")
    bracket = next((module for module in (*production.left, production.predecessor) if module.symbol in "[]()"), None)
    if bracket is not None:
        raise ModelSyntaxError("A bracket cannot stand here", source, *span(bracket),
                               "A right context may name branches; a left context passes them.")
    check_word(production.right, constants, source, arguments=False)
    if production.condition is not None:
        check_expression(production.condition, names, source, "truth")
    check_probability(production, names, source, section)
    check_word(production.successor, names, source, chance=section != "interpretation")


def check_probability(production: Production, names: Collection[str], source: str, section: str) -> None:
    """A probability is a number, and stands where something is left to chance."""
    probability = production.probability
    if probability is None:
        return
    if section == "interpretation":
        raise ModelValueError("A rule of the interpretation has no probability", source, *span(probability),
                              "A word is always drawn alike; what is left to chance stands in the productions.")
    if expression_type(probability) == "truth":
        raise ModelValueError(f'A probability stands behind the successor, but "{probability}" is true or false', source,
                              *span(probability), 'A condition stands before the arrow, as in "A(t) : t < 5 -> B".')
    check_expression(probability, names, source)
    if isinstance(probability, Number) and probability.value < 0:
        raise ModelValueError("A probability is not negative", source, *span(probability))


def check_repeat(repeat: Repeat, names: Collection[str], source: str, chance: bool) -> None:
    """The count is a number, whole and not too great where it is written out; the name that counts is new."""
    check_expression(repeat.count, names, source, chance=chance)
    if repeat.index in names:
        raise ModelNameError(f'The name "{repeat.index}" is already used', source, *span(repeat),
                             "Give what counts the repetitions a name of its own.")
    if isinstance(repeat.count, Number) and not (isinstance(repeat.count.value, int)
                                                 and 0 <= repeat.count.value <= current().repetitions):
        raise ModelValueError(f'"{repeat.count}" is no number of repetitions', source, *span(repeat.count),
                              f"Repetitions are counted from 0 up to {current().repetitions:,}.")
    check_word(repeat.body, {*names, repeat.index} - {""}, source, chance=chance)


def check_meta(rule: MetaRule, constants: Collection[str], source: str) -> None:
    """A meta-rule makes a word shorter, and knows its names."""
    names = {*check_parameters(rule.predecessors, constants, source), *constants}
    if rule.condition is not None:
        check_expression(rule.condition, names, source, "truth")
    check_word(rule.successor, names, source)
    if any(isinstance(item, Repeat) for item in rule.successor) or len(rule.successor) >= len(rule.predecessors):
        raise ModelSyntaxError("A meta-rule must make the word shorter", source, *span(rule),
                               "Let fewer modules stand behind the arrow than before it.")


def check_parameters(modules: Iterable[Module], constants: Collection[str], source: str) -> list[str]:
    """The parameters that some modules name: each once, each alone."""
    parameters: list[str] = []
    for argument in (argument for module in modules for argument in module.arguments):
        if isinstance(argument, Name) and argument.name not in constants:
            if argument.name in parameters:
                raise ModelNameError(f'The parameter "{argument.name}" is named twice', source, *span(argument),
                                     "Give each parameter a name of its own.")
            parameters.append(argument.name)
        elif isinstance(argument, Apply):
            strange = sorted(names_in(argument) - set(constants))
            if strange:
                raise ModelNameError(f'Before the arrow a parameter stands alone, not as "{argument}"', source, *span(argument),
                                     f'Write "{strange[0]}" there, and the calculation behind the arrow.')
            check_expression(argument, constants, source)
    return parameters


def check_word(word: Iterable[Item], names: Collection[str], source: str, arguments: bool = True, chance: bool = False) -> None:
    """The arguments are numbers, not too many, and the brackets close."""
    opened: list[Module] = []
    closing = {"]": "[", ")": "("}
    for module in word:
        if isinstance(module, Repeat):
            check_repeat(module, names, source, chance)
            continue
        if len(module.arguments) > current().parameters:
            raise ModelSyntaxError(f'"{module.symbol}" has more than {current().parameters} parameters', source, *span(module))
        for argument in module.arguments if arguments else ():
            if isinstance(argument, Expression):
                check_expression(argument, names, source, chance=chance)
        if module.symbol in closing.values():
            opened.append(module)
            if len(opened) > current().brackets:
                raise ModelSyntaxError(f"More than {current().brackets:,} brackets are open at once", source, *span(module))
        elif module.symbol in closing and (not opened or opened.pop().symbol != closing[module.symbol]):
            raise ModelSyntaxError(f'This "{module.symbol}" closes nothing', source, *span(module),
                                   f'Every branch begins with "{closing[module.symbol]}".')
    if opened:
        raise ModelSyntaxError(f'This "{opened[-1].symbol}" is never closed', source, *span(opened[-1]),
                               f'Every branch ends with "{"]" if opened[-1].symbol == "[" else ")"}".')
