"""Does a text that can be read also make sense? Every name must be known, operators must get the types they take, brackets must
close, sliders must hold their value, and surfaces have points enough. Each check raises the first problem that it finds."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping
from difflib import get_close_matches
from types import MappingProxyType
from typing import NamedTuple

from lsys_kit.budget import current
from lsys_kit.notation.analysis.problems import problem
from lsys_kit.notation.model.arithmetic import Value, finite, reason_of
from lsys_kit.notation.model.expressions import (
    OPERATORS,
    Apply,
    Expression,
    Name,
    Number,
    TextSpan,
    expression_type,
    function_of,
    names_in,
)
from lsys_kit.notation.model.fields import FIELD_FORMS
from lsys_kit.notation.model.modules import Item, Pattern, Repeat
from lsys_kit.notation.model.surfaces import LEAST_CORNERS, ROW, SurfacePoint, SurfaceShape
from lsys_kit.notation.model.system import Constant, MetaRule, Production
from lsys_kit.translation import gettext


def span(record: object) -> tuple[int | None, int | None]:
    """The offsets between which a record was read."""
    return getattr(record, "at", None) or (None, None)


_LONGEST_NAME = 200
"""So much of a name is compared."""


def closest(name: str, known: Collection[str], likeness: float = 0.6) -> str | None:
    """The known name that a name resembles most.

    >>> closest("lifetimeA", ["lifeTimeA", "dt"])
    'lifeTimeA'
    """
    name = name[:_LONGEST_NAME]
    close = get_close_matches(name, sorted(known), 1, likeness) or get_close_matches(name.lower(), sorted(known), 1, likeness)
    return close[0] if close else None


def suggestion(name: object, known: Collection[str], likeness: float = 0.6) -> str | None:
    """A hint that gives the name that was probably meant; None where there is none like it, or no name was given.

    >>> suggestion("lifetimeA", ["lifeTimeA", "dt"])
    'Did you mean "lifeTimeA"?'
    """
    name_meant = closest(name, known, likeness) if isinstance(name, str) else None
    return gettext('Did you mean "{name}"?', name=name_meant) if name_meant else None


SETTINGS = frozenset(("axiom", "Axiom", "angle", "heading", "steps", "alphabet"))
"""Keywords that are followed by a colon, so that no constant can have their name."""


def value_of(expression: Expression, values: Mapping[str, Value] = MappingProxyType({})) -> Value:
    """The value of an expression, given the values of its names.

    >>> value_of(Apply("+", (Name("dt"), Name("dt"))), {"dt": 2})
    4
    """
    order = {name: index for index, name in enumerate(values)}
    try:
        return finite(function_of(expression, order)(tuple(values.values())))
    except ZeroDivisionError as fault:
        raise problem("division by zero", expression.at, expression=expression, reason=reason_of(fault)) from None
    except (ArithmeticError, ValueError) as fault:
        raise problem("no value", expression.at, expression=expression, reason=reason_of(fault)) from None


def check_expression(expression: Expression, names: Collection[str], wanted: str = "number", chance: bool = False) -> None:
    """Every name is known, every operator gets the types it takes, random numbers occur only where they may, and the whole is a
    "number" or a "truth" as wanted."""
    if isinstance(expression, Name) and expression.name not in names:
        known = ", ".join(f'"{name}"' for name in sorted(names))
        raise problem(
            "unknown name" if known else "name among none",
            expression.at,
            closest(expression.name, names),
            name=expression.name,
            known=known,
        )
    if isinstance(expression, Apply):
        operator = OPERATORS[expression.operator]
        if operator.random and not chance:
            raise problem("random number", expression.at, expression=expression)
        for index, operand in enumerate(expression.operands):
            check_expression(operand, names, operator.wanted(index), chance)
    if expression_type(expression) != wanted:
        raise problem("number for truth" if wanted == "truth" else "truth for number", expression.at, expression=expression)


def check_constants(constants: Iterable[Constant]) -> None:
    """Every constant is declared once, from those before it, with a value in the range of its slider."""
    values: dict[str, Value] = {}
    for constant in constants:
        if constant.name in values:
            raise problem("constant twice", constant.at, name=constant.name)
        if constant.name in SETTINGS:
            raise problem(
                "setting as constant", constant.at, name=constant.name, keyword=constant.name.lower(), value=constant.value
            )
        if not isinstance(constant.value, Name) and constant.name in names_in(constant.value):
            raise problem("constant of itself", constant.at, name=constant.name)
        if isinstance(constant.value, Name) and constant.value.name not in values:
            raise problem(
                "name as constant",
                constant.value.at,
                closest(constant.value.name, values),
                name=constant.value,
                constant=constant.name,
            )
        for expression in (constant.value, *(constant.range or ())):
            check_expression(expression, values.keys())
        check_range(constant, values)
        values[constant.name] = value_of(constant.value, values)


def check_range(constant: Constant, values: Mapping[str, Value]) -> None:
    """The value lies between the ends of its slider, whose step is positive."""
    if constant.range is None:
        return
    low, high, step = (value_of(part, values) for part in constant.range)
    first, last, by = constant.range
    if low > high:
        raise problem("range upside down", first.at, name=constant.name, low=first, high=last, step=by)
    if step <= 0:
        raise problem("step of range", by.at, name=constant.name)
    if not low <= value_of(constant.value, values) <= high:
        raise problem("value outside range", constant.value.at, name=constant.name, value=constant.value, low=first, high=last)


def check_production(production: Production, constants: Collection[str], section: str = "productions") -> None:
    """Parameters are distinct, names known, the condition a truth, the brackets closed, contexts and several modules to
    replace where they are possible."""
    names = {*check_parameters(production.parameters, constants), *constants}
    if section != "productions" and (production.left or production.right):
        raise problem(f"context in {section}", production.at)
    if section != "productions" and len(production.predecessors) > 1:
        raise problem(f"several modules in {section}", production.at)
    if (bracket := _first_bracket(production.left)) is not None:
        raise problem("bracket before arrow", bracket.at)
    if (bracket := _first_bracket(production.predecessors)) is not None:
        raise problem("bracket replaced", bracket.at)
    check_word(production.right, constants, arguments=False)
    if production.condition is not None:
        check_expression(production.condition, names, "truth")
    check_probability(production, names, section)
    check_word(production.successor, names, chance=section != "interpretation")


def _first_bracket(modules: Iterable[Pattern]) -> Pattern | None:
    return next((module for module in modules if module.symbol in "[]()"), None)


def check_probability(production: Production, names: Collection[str], section: str) -> None:
    """A probability is a number that is not negative, in a section where chance plays a part."""
    probability = production.probability
    if probability is None:
        return
    if section == "interpretation":
        raise problem("probability in interpretation", probability.at)
    if expression_type(probability) == "truth":
        raise problem("truth as probability", probability.at, expression=probability)
    check_expression(probability, names)
    if isinstance(probability, Number) and probability.value < 0:
        raise problem("negative probability", probability.at)


def check_repeat(repeat: Repeat, names: Collection[str], chance: bool) -> None:
    """The count is a number, whole and not too large where it is a literal; the name of the index is new."""
    check_expression(repeat.count, names, chance=chance)
    if repeat.index in names:
        raise problem("index taken", repeat.at, name=repeat.index)
    if isinstance(repeat.count, Number) and not (
        isinstance(repeat.count.value, int) and 0 <= repeat.count.value <= current().repetitions
    ):
        raise problem("number of repetitions", repeat.count.at, expression=repeat.count, most=current().repetitions)
    check_word(repeat.body, {*names, repeat.index} - {""}, chance=chance)


def check_meta(rule: MetaRule, constants: Collection[str]) -> None:
    """A meta-rule makes a word shorter, and all its names are known."""
    names = {*check_parameters(rule.predecessors, constants), *constants}
    if rule.condition is not None:
        check_expression(rule.condition, names, "truth")
    check_word(rule.successor, names)
    check_shorter(rule)


def check_shorter(rule: MetaRule) -> None:
    """What a meta-rule puts in has fewer modules than what it takes out."""
    if any(isinstance(item, Repeat) for item in rule.successor) or len(rule.successor) >= len(rule.predecessors):
        raise problem("meta-rule not shorter", rule.at)


def check_field(field: Pattern, constants: Collection[str]) -> None:
    """A field is one of those that the kit has, and its values are numbers, as many as it takes."""
    form = FIELD_FORMS.get(field.symbol)
    if form is None:
        raise problem(
            "unknown field",
            field.at,
            closest(field.symbol, FIELD_FORMS, 0.7),
            name=field.symbol,
            known=", ".join(sorted(FIELD_FORMS)),
        )
    if not form.least <= len(field.arguments) <= form.most:
        wanted = f"{form.least}" if form.least == form.most else f"{form.least} to {form.most}"
        raise problem(
            "number of arguments",
            field.at,
            name=field.symbol,
            wanted=gettext("one value") if wanted == "1" else gettext("{number} values", number=wanted),
            given=len(field.arguments),
        )
    for argument in field.arguments:
        check_expression(argument, {*constants, *form.names})


def check_parameters(modules: Iterable[Pattern], constants: Collection[str]) -> list[str]:
    """The parameters that some modules name, each once and not as part of a calculation."""
    parameters: list[str] = []
    for argument in (argument for module in modules for argument in module.arguments):
        if isinstance(argument, Name) and argument.name not in constants:
            if argument.name in parameters:
                raise problem("parameter twice", argument.at, name=argument.name)
            parameters.append(argument.name)
        elif isinstance(argument, Apply):
            strange = sorted(names_in(argument) - set(constants))
            if strange:
                raise problem("calculated parameter", argument.at, expression=argument, name=strange[0])
            check_expression(argument, constants)
    return parameters


_OPENS = {"]": "[", ")": "("}
_CLOSES = {"[": "]", "(": ")"}


def check_word(word: Iterable[Item], names: Collection[str], arguments: bool = True, chance: bool = False) -> None:
    """The arguments are numbers, not too many, and the brackets close."""
    opened: list[Pattern] = []
    for module in word:
        if isinstance(module, Repeat):
            check_repeat(module, names, chance)
            continue
        if len(module.arguments) > current().parameters:
            raise problem("too many parameters", module.at, symbol=module.symbol, most=current().parameters)
        for argument in module.arguments if arguments else ():
            check_expression(argument, names, chance=chance)
        if module.symbol in _CLOSES:
            opened.append(module)
            if len(opened) > current().brackets:
                raise problem("too many brackets", module.at, most=current().brackets)
        elif module.symbol in _OPENS and (not opened or opened.pop().symbol != _OPENS[module.symbol]):
            raise problem("bracket closes nothing", module.at, bracket=module.symbol, other=_OPENS[module.symbol])
    if opened:
        raise problem("bracket never closed", opened[-1].at, bracket=opened[-1].symbol, other=_CLOSES[opened[-1].symbol])


LARGEST = 1e9
"""No coordinate is greater: a surface of size 1 is about 1 long."""


class PointList(NamedTuple):
    """The points of a polygon or of a patch, each with its coordinates as arguments; and where they begin."""

    points: tuple[Pattern, ...]
    at: TextSpan


class SurfaceText(NamedTuple):
    """A surface as it is written: its name, its points, and whether these are patches or one polygon."""

    name: str
    parts: tuple[PointList, ...]
    patched: bool
    at: TextSpan


def checked_surfaces(texts: Iterable[SurfaceText]) -> tuple[SurfaceShape, ...]:
    """The surfaces that are declared, checked."""
    found: dict[str, SurfaceShape] = {}
    for text in texts:
        if text.name in found:
            raise problem("surface twice", text.at, name=text.name)
        for part in text.parts:
            _check_number(part, text.patched)
        shapes = tuple(tuple(_point(point) for point in part.points) for part in text.parts)
        found[text.name] = SurfaceShape(text.name, () if text.patched else shapes[0], shapes if text.patched else (), text.at)
    return tuple(found.values())


def _check_number(part: PointList, patched: bool) -> None:
    count = len(part.points)
    if patched and count != ROW**2:
        raise problem("number of control points", part.at, count=count)
    if count < LEAST_CORNERS:
        raise problem("number of corners", part.at)


def _point(point: Pattern) -> SurfacePoint:
    for coordinate in point.arguments:
        for name in sorted(names_in(coordinate)):
            raise problem("name in surface", coordinate.at, name=name)
        check_expression(coordinate, ())
    values = [value_of(coordinate) for coordinate in point.arguments]
    if not all(-LARGEST <= value <= LARGEST for value in values):
        raise problem("point too far", point.at)
    ahead, left, up = (*values, 0)[:3]
    return ahead, left, up
