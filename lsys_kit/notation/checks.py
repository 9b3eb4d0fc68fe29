"""Does a text that can be read also make sense? Names that stand for something, truths where truths are asked for,
brackets that close. Each check raises the error that a student can act on."""

from __future__ import annotations

from collections.abc import Collection, Iterable
from difflib import get_close_matches

from lsys_kit.errors import ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.budget import current
from lsys_kit.notation.expressions import OPERATORS, Apply, Expression, Name, gives
from lsys_kit.notation.model import Constant, Module, Production


def span(thing: object) -> tuple[int | None, int | None]:
    """Where a record stood in its text."""
    return getattr(thing, "at", None) or (None, None)


def suggestion(name: str, known: Collection[str]) -> str | None:
    """A hint that names what was probably meant.

    >>> suggestion("lifetimeA", ["lifeTimeA", "dt"])
    'Did you mean "lifeTimeA"?'
    """
    close = get_close_matches(name, sorted(known), 1, 0.6) or get_close_matches(name.lower(), sorted(known), 1, 0.6)
    return f'Did you mean "{close[0]}"?' if close else None


def check_expression(expression: Expression, names: Collection[str], source: str, wanted: str = "number") -> None:
    """Every name is known, every operator gets what it takes, and the whole is what is wanted of it."""
    if isinstance(expression, Name) and expression.name not in names:
        known = ", ".join(f'"{name}"' for name in sorted(names))
        hint = suggestion(expression.name, names) or (f"Known here: {known}." if known else "No names are known here.")
        raise ModelNameError(f'I do not know the name "{expression.name}"', source, *span(expression), hint)
    if isinstance(expression, Apply):
        for operand in expression.operands:
            check_expression(operand, names, source, OPERATORS[expression.operator].takes)
    if gives(expression) != wanted:
        if wanted == "truth":
            raise ModelValueError(f'"{expression}" is a number, but something true or false is needed here', source,
                                  *span(expression), f'Compare it with something, as in "{expression} > 0".')
        raise ModelValueError(f'"{expression}" is true or false, but a number is needed here', source, *span(expression))


def check_constants(constants: Iterable[Constant], source: str) -> None:
    """Every constant is declared once, from those before it."""
    names: set[str] = set()
    for constant in constants:
        if constant.name in names:
            raise ModelNameError(f'The constant "{constant.name}" is declared twice', source, *span(constant))
        for expression in (constant.value, *(constant.range or ())):
            check_expression(expression, names, source)
        names.add(constant.name)


def check_production(production: Production, constants: Collection[str], source: str) -> None:
    """Parameters are distinct, names known, the condition a truth, the brackets closed."""
    parameters: list[str] = []
    for argument in production.predecessor.arguments:
        if isinstance(argument, Name) and argument.name not in constants:
            if argument.name in parameters:
                raise ModelNameError(f'The parameter "{argument.name}" is named twice', source, *span(argument))
            parameters.append(argument.name)
        elif isinstance(argument, Apply | Name):
            check_expression(argument, constants, source)
    names = {*parameters, *constants}
    if production.condition is not None:
        check_expression(production.condition, names, source, "truth")
    check_word(production.successor, names, source)


def check_word(word: Iterable[Module], names: Collection[str], source: str) -> None:
    """The arguments are numbers, not too many, and the brackets close."""
    opened: list[Module] = []
    closing = {"]": "[", ")": "("}
    for module in word:
        if len(module.arguments) > current().parameters:
            raise ModelSyntaxError(f'"{module.symbol}" has more than {current().parameters} parameters', source, *span(module))
        for argument in module.arguments:
            if isinstance(argument, Expression):
                check_expression(argument, names, source)
        if module.symbol in closing.values():
            opened.append(module)
            if len(opened) > current().brackets:
                raise ModelSyntaxError(f"More than {current().brackets} brackets are open at once", source, *span(module))
        elif module.symbol in closing and (not opened or opened.pop().symbol != closing[module.symbol]):
            raise ModelSyntaxError(f'This "{module.symbol}" closes nothing', source, *span(module),
                                   f'Every branch begins with "{closing[module.symbol]}".')
    if opened:
        raise ModelSyntaxError(f'This "{opened[-1].symbol}" is never closed', source, *span(opened[-1]),
                               f'Every branch ends with "{"]" if opened[-1].symbol == "[" else ")"}".')
