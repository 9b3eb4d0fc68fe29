"""Labels: how a module's name is set in pictures, as mathematics: a letter, perhaps a subscript, and its values.

A name such as `u1` or `a_r` is a letter with a subscript; so is `ar` where the system also has `al`: the last letter is the
polarity. All text is escaped: a model's names can never become markup.
"""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence
from functools import lru_cache
from html import escape
from string import punctuation

from lsys_kit.derivation.petri.net import Place
from lsys_kit.errors import printable
from lsys_kit.geometry.turtle.commands import COMMANDS, Effect, symbols_with
from lsys_kit.notation.model.arithmetic import Value, is_symbolic, number_of, number_text, rounded
from lsys_kit.notation.model.formulas import Element, formula_text, values_element
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.shapes import Look, Span


def escaped(text: str) -> str:
    """A text as it may stand in HTML or SVG: no markup, and nothing that would not show or would turn it around.

    >>> escaped("<b>"), escaped("a\\x1bb")
    ('&lt;b&gt;', 'a?b')
    """
    return escape(visible(text))


def visible(text: str) -> str:
    """A text without what would not show or would turn it around.

    >>> visible("a\\u202eb")
    'a?b'
    """
    return text if text.isprintable() else "".join(map(printable, text))


@lru_cache(maxsize=64)
def polar_symbols(system: LSystem) -> Mapping[str, tuple[str, str]]:
    """The symbols that come in two polarities, each with the letter and the polarity, "l" or "r".

    >>> from lsys_kit import read
    >>> polar_symbols(read("axiom: ar\\nar -> al b\\nal -> b ar"))
    {'ar': ('a', 'r'), 'al': ('a', 'l')}
    """
    names = set(symbols(system))
    return {
        name: (name[:-1].rstrip("_"), name[-1])
        for name in symbols(system)
        if len(name) > 1 and name[-1] in "lr" and name[:-1] + {"l": "r", "r": "l"}[name[-1]] in names
    }


def steering_of(system: LSystem) -> frozenset[str]:
    """The symbols that only steer the turtle, and so are no stages and no cells.

    >>> from lsys_kit import read
    >>> sorted(steering_of(read("axiom: F [+ &(60) f] A")) & set("F[+&]fA"))
    ['&', '+', '[', ']']
    """
    interpreted = {rule.predecessor.symbol for rule in system.interpretation}
    invisible = COMMANDS[system.turtle].keys() - symbols_with(Effect.VISIBLE, system.turtle)
    return frozenset(punctuation) | (invisible - interpreted)


def label_parts(symbol: str, system: LSystem) -> tuple[str, str]:
    """A symbol's letter and its subscript, which may be empty.

    >>> from lsys_kit import read
    >>> label_parts("u12", read("axiom: u12"))
    ('u', '12')
    """
    if symbol in polar_symbols(system):
        return polar_symbols(system)[symbol]
    match = re.fullmatch(r"([A-Za-z]+)_?(\d+)|([A-Za-z]+)_(\w+)", symbol)
    if not match:
        return symbol, ""
    return (match[1], match[2]) if match[1] else (match[3], match[4])


def values_text(module: Module) -> str:
    """A module's values in parentheses, as they are shown, or nothing."""
    values = ",".join(
        formula_text(value)
        if is_symbolic(value)
        else number_text(rounded(value))
        if abs(float(value)) < 1e6
        else f"{float(value):.3g}"
        for value in module.arguments
    )
    return f"({values})" if values else ""


def shared_formulas(modules: Sequence[Module]) -> tuple[Value, ...]:
    """The values that the modules of a stage have in common, as formulas; none where they have no formulas in common.

    >>> from lsys_kit import derive, read
    >>> word = derive(read("q = 1/2\\naxiom: A(1)\\nA(x) -> A(q*x) A(q*x)"), 2, letters="q")[-1]
    >>> [number_text(value.expression) for value in shared_formulas([*word])]
    ['q^2']
    """
    if len({len(module.arguments) for module in modules}) != 1:
        return ()
    columns = zip(*(module.arguments for module in modules), strict=True)
    shared = [{*column} for column in columns if len({*map(number_of, column)}) == 1]
    return () if any(len(column) > 1 for column in shared) else tuple(column.pop() for column in shared)


def mathml(formula: Element) -> str:
    """An element of MathML as HTML.

    >>> mathml(["msup", "q", "2"])
    '<msup><mi>q</mi><mn>2</mn></msup>'
    """
    if isinstance(formula, str):
        tag = "mn" if formula[:1].isdigit() else "mi" if formula[:1].isalpha() else "mo"
        low = ' stretchy="false"' if formula in ("(", ")") else ""
        return f"<{tag}{low}>{escaped(formula)}</{tag}>"
    return f"<{formula[0]}>{''.join(map(mathml, formula[1:]))}</{formula[0]}>"


def label_spans(letter: str, subscript: str, values: str = "") -> list[str | Span]:
    """A label in pieces: italic letter, small lowered subscript, upright values.

    >>> [each.text for each in label_spans("a", "r", "(2)")], label_spans("+", "", "(2)")
    (['a', 'r', '(2)'], ['+(2)'])
    """
    if not (letter[:1].isalpha() or subscript):
        return [letter + values]
    first = Span(letter, Look(font_style="italic")) if letter[:1].isalpha() else letter
    if not subscript:
        return [first, values]
    return [first, Span(subscript, Look(dy=3, font_size="70%")), *([Span(values, Look(dy=-3))] if values else [])]


def html_label(module: Module, system: LSystem) -> str:
    """A module as HTML.

    >>> from lsys_kit import read
    >>> html_label(Module("a_r", (2,)), read("axiom: a_r(2)"))
    '<i>a</i><sub style="line-height:0">r</sub>(2)'
    """
    letter, subscript = label_parts(module.symbol, system)
    text = f"<i>{escaped(letter)}</i>" if letter[:1].isalpha() else escaped(letter)
    formula = values_element(module.arguments)
    values = escaped(values_text(module)) if formula is None else f"<math>{mathml(formula[0])}</math>"
    return text + (f'<sub style="line-height:0">{escaped(subscript)}</sub>' if subscript else "") + values


def place_parts(place: Place, system: LSystem) -> tuple[str, str, str]:
    """A stage's letter, subscript and values: without the polarity, where its modules differ in that, and with the values
    that they share, if all have as many.

    >>> from lsys_kit import read, stages
    >>> system = read("axiom: M(5,1)\\nM(t,p) -> M(t,-p)\\ninterpretation:\\nM(t,p) : p < 0 -> L(1,1)\\nM(t,p) -> R(1,1)")
    >>> place_parts(stages(system).places[0], system)
    ('M', '', '(5)')
    """
    letter, subscript = label_parts(place.symbol, system)
    if not place.modules:
        return letter, subscript, ""
    rows = [module.arguments for module in place.modules]
    columns = zip(*rows, strict=True) if len({*map(len, rows)}) == 1 else ()
    shared = [column[0] for column in columns if len(set(column)) == 1]
    values = values_text(Module(place.symbol, tuple(shared)))
    merged = len({module.symbol for module in place.modules}) > 1
    return letter, "" if merged else subscript, values


def place_text(place: Place, system: LSystem) -> str:
    """A stage's label as plain text."""
    letter, subscript, values = place_parts(place, system)
    return letter + (f"_{subscript}" if subscript else "") + values
