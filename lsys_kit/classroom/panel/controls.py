"""Sliders made from the model: one for each constant used in calculations, over the range that the model declares.

A slider's handle works in doubles; the value that a model gets is exact. Each slider is paired with a labelled number box,
because a slider's handle has no accessible name and does not obey the arrow keys everywhere.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from fractions import Fraction
from typing import TYPE_CHECKING, Any

from lsys_kit.derivation.core.rules import constants_of
from lsys_kit.errors import ModelValueError
from lsys_kit.notation.model.arithmetic import Value, normalised, number_text
from lsys_kit.notation.model.expressions import OPERATORS, Apply, Expression, Name, function_of
from lsys_kit.notation.model.system import LSystem

if TYPE_CHECKING:
    import ipywidgets


@dataclass(frozen=True)
class SliderRange:
    """The values that a slider offers: `low`, `low + step`, ... up to `high`; it starts at `value`."""

    value: Value
    low: Value
    high: Value
    step: Value

    def nearest(self, reading: float) -> Value:
        """The exact value that a slider's reading stands for.

        >>> SliderRange(Fraction(7, 10), Fraction(1, 10), 2, Fraction(1, 10)).nearest(0.7000000000000001)
        Fraction(7, 10)
        """
        low, step = Fraction(self.low), Fraction(self.step)
        return normalised(low + round((Fraction(reading) - low) / step) * step)


def slider_ranges(system: LSystem, changes: Mapping[str, object]) -> dict[str, SliderRange]:
    """For each constant that has a slider, the slider's values.

    Raises
    ------
    ModelValueError
        A value lies outside the range that the system declares.

    Examples
    --------
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
                raise ModelValueError(f"{constant.name} = {number_text(value)} lies outside its slider's range",
                                      hint=f"It goes from {number_text(low)} to {number_text(high)}.")
            found[constant.name] = SliderRange(value, low, high, step)
        elif _calculated_with(constant.name, system):
            found[constant.name] = _guessed(value)
    return found


def _guessed(value: Value) -> SliderRange:
    """A range for a constant without one: from 0 or 1 to about twice its value."""
    if isinstance(value, int) and value >= 1:
        return SliderRange(value, 1, max(2 * value, 6), 1)
    size = abs(Fraction(value)) or Fraction(1, 2)
    low, high = (-2 * size, Fraction(0)) if value < 0 else (Fraction(0), 2 * size)
    return SliderRange(normalised(Fraction(value)), normalised(low), normalised(high), normalised(size / 10))


def _calculated_with(name: str, system: LSystem) -> bool:
    """Whether a constant is used in arithmetic or an inequality; LEFT and RIGHT, for example, are only tested for equality."""
    expressions: list[Any] = [constant.value for constant in system.constants]
    for rule in system.rules:
        expressions += [rule.condition, rule.probability, *(a for module in rule.modules for a in module.arguments)]
    return any(_operates_on(name, expression) for expression in expressions if isinstance(expression, Apply))


def _operates_on(name: str, expression: Expression) -> bool:
    if not isinstance(expression, Apply):
        return False
    tells_apart = expression.operator in ("==", "!=") or OPERATORS[expression.operator].takes == "truth"
    direct = any(isinstance(operand, Name) and operand.name == name for operand in expression.operands)
    return (direct and not tells_apart) or any(_operates_on(name, operand) for operand in expression.operands)


@dataclass(frozen=True)
class Control:
    """A slider with its number box, and the exact values that they stand for."""

    slider: ipywidgets.Widget
    box: ipywidgets.Widget
    span: SliderRange

    @property
    def value(self) -> Value:
        """The exact value chosen."""
        return self.span.nearest(self.slider.value)

    def linked(self, in_browser: bool) -> None:
        """Let slider and number box follow each other.

        In the browser where the kernel is not needed; otherwise in the kernel, after the observers that the slider already has,
        so that a movement is one message to the kernel and the picture is updated before the box.
        """
        import ipywidgets as widgets

        link = widgets.jslink if in_browser else widgets.link
        link((self.slider, "value"), (self.box, "value"))

    def row(self) -> ipywidgets.Widget:
        """Both, side by side."""
        import ipywidgets as widgets

        return widgets.HBox([self.box, self.slider], layout=widgets.Layout(align_items="center"))


def control(name: str, span: SliderRange) -> Control:
    """A slider and a labelled number box, not linked yet."""
    import ipywidgets as widgets

    whole = all(isinstance(part, int) for part in (span.low, span.high, span.step))
    kind, box_kind = (widgets.IntSlider, widgets.BoundedIntText) if whole else (widgets.FloatSlider, widgets.BoundedFloatText)
    convert = int if whole else float
    options = {"value": convert(span.value), "min": convert(span.low), "max": convert(span.high), "step": convert(span.step)}
    slider = kind(**options, readout=False, continuous_update=True, layout=widgets.Layout(width="180px"))
    box = box_kind(**options, description=name, style={"description_width": "initial"},
                   layout=widgets.Layout(width=f"{9 * len(name) + 82}px"))
    return Control(slider, box, span)
