"""Sliders made from the model: one for each constant used in calculations, over the range that the model declares.

What a slider moves through is a list of exact values; the browser knows only their places in it, and their texts.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from itertools import count

from lsys_kit.derivation.core.rules import constants_of, real_from
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, function_of
from lsys_kit.notation.model.system import LSystem
from lsys_kit.translation import gettext


@dataclass(frozen=True)
class SliderRange:
    """The values that a slider offers: `low`, `low + step`, ... up to `high`; it starts at `value`."""

    value: Value
    low: Value
    high: Value
    step: Value


def slider_ranges(system: LSystem, changes: Mapping[str, object]) -> dict[str, SliderRange]:
    """For each constant that has a slider, the slider's values: where it declares a range, or is a number of its own.

    >>> from lsys_kit.notation.read import read
    >>> slider_ranges(read("lifeTime = 3 in 1 .. 6\\naxiom: A(lifeTime)"), {})["lifeTime"].high
    6
    """
    values = dict(zip((c.name for c in system.constants), constants_of(system, changes), strict=True))
    found: dict[str, SliderRange] = {}
    order = {name: i for i, name in enumerate(values)}
    for constant in system.constants:
        value = values[constant.name]
        if constant.range:
            low, high, step = (function_of(part, order)(tuple(values.values())) for part in constant.range)
            if not low <= value <= high:
                raise ModelValueError(
                    f"{constant.name} = {number_text(value)} lies outside its slider's range",
                    hint=f"It goes from {number_text(low)} to {number_text(high)}.",
                )
            found[constant.name] = SliderRange(value, low, high, step)
        elif not _derived(constant.value) and _calculated_with(constant.name, system):
            found[constant.name] = _guessed(value)
    return found


def _derived(value: Expression) -> bool:
    """Whether a constant is made of others, or of a function, and so is nobody's to move: a golden section, a threshold."""
    if isinstance(value, Apply):
        return OPERATORS[value.operator].precedence is None or any(map(_derived, value.operands))
    return isinstance(value, Name)


def _guessed(value: Value) -> SliderRange:
    """A range for a constant without one: from 0 or 1 to about twice its value."""
    if isinstance(value, int) and value >= 1:
        return SliderRange(value, 1, max(2 * value, 6), 1)
    size = abs(Fraction(value)) or Fraction(1, 2)
    low, high = (-2 * size, Fraction(0)) if value < 0 else (Fraction(0), 2 * size)
    return SliderRange(normalised(Fraction(value)), normalised(low), normalised(high), normalised(size / 10))


def _calculated_with(name: str, system: LSystem) -> bool:
    """Whether a constant is used in arithmetic or an inequality; LEFT and RIGHT, for example, are only tested for equality."""
    expressions: list[object] = [constant.value for constant in system.constants]
    for rule in system.rules:
        expressions += [rule.condition, rule.probability, *(a for module in rule.modules for a in module.arguments)]
    return any(_operates_on(name, expression) for expression in expressions if isinstance(expression, Apply))


def _operates_on(name: str, expression: Expression) -> bool:
    if not isinstance(expression, Apply):
        return False
    tells_apart = expression.operator in ("==", "!=") or OPERATORS[expression.operator].takes == "truth"
    direct = any(isinstance(operand, Name) and operand.name == name for operand in expression.operands)
    return (direct and not tells_apart) or any(_operates_on(name, operand) for operand in expression.operands)


def slider(name: str, values: Sequence[Value], first: Value, what: str = "") -> dict[str, object]:
    """A slider as the browser needs it: the texts of its values, and the place of the first one; `what` it is, if no constant.

    >>> slider("c", (1, 2, 3), 2)
    {'name': 'c', 'texts': ['1', '2', '3'], 'hint': 'the constant c', 'index': 1}
    """
    hint = f"{what} {name}" if what else gettext("the constant {name}", name=name)
    return {"name": name, "texts": [*map(number_text, values)], "hint": hint, "index": values.index(first)}


MOST_VALUES = 2_000
"""A slider has no more values, but for the ends; of a finer range it offers every second, fifth, tenth, ..."""


def slider_values(span: SliderRange) -> tuple[Value, ...]:
    """The values that a slider offers, its first one among them.

    >>> [str(value) for value in slider_values(SliderRange(1, Fraction(1, 2), 2, Fraction(1, 2)))]
    ['1/2', '1', '3/2', '2']
    """
    low, high, step = (Fraction(part) for part in (span.low, span.high, span.step))
    many = (high - low) // step if step > 0 else 0
    coarser = next(stride for stride in _strides() if many <= MOST_VALUES * stride)
    grid = {normalised(low + number * step) for number in range(0, many + 1, coarser)}
    return tuple(sorted({*grid, normalised(low + many * step), span.value}))


def _strides() -> Iterator[int]:
    """1, 2, 5, 10, 20, 50, and so on: of round numbers, every so many are round again."""
    yield from (digit * 10**zeros for zeros in count() for digit in (1, 2, 5))


def nearest(values: Sequence[Value], name: str, wanted: object) -> Value:
    """The value of a slider that is nearest to a number, or to the text of one."""
    number = real_from(wanted, name, f"A slider has numbers, as in {name}={number_text(values[0])}.")
    return min(values, key=lambda value: abs(float(value) - number))


def plain_number(value: Value) -> int | float:
    """A value as a number that is no fraction."""
    return value if isinstance(value, int) else float(value)
