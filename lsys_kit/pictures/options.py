"""Kinds of pictures and how they look: as which something is drawn, which options that has, and whose symbols have colours."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, replace
from typing import Any, TypeAlias

from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Choices, Derivation
from lsys_kit.derivation.growth.growth import Growth
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.derivation.tissues.development import AnyDevelopment, CellDevelopment
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError, quotable, require, shown
from lsys_kit.geometry.drawing import PIPES, scene_of
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.formats.notebook import listed
from lsys_kit.pictures.rendering.frames import in_units
from lsys_kit.pictures.rendering.light import Sun, sun_from
from lsys_kit.pictures.rendering.looks import with_colours_of_symbols, with_start, with_widths
from lsys_kit.pictures.sizes import Size, size_from
from lsys_kit.pictures.style.colour_values import colour_from
from lsys_kit.pictures.style.labels import polar_symbols
from lsys_kit.pictures.style.themes import LIGHT, Theme, theme_from

Symbols: TypeAlias = Mapping[str, tuple[str, ...]]
"""Names of symbols, each with those that it stands for: one, or the two polarities of a cell."""
OPTIONS = ("labels", "colours", "widths", "turtle", "legend", "light", "background")
FLAGS = ("labels", "turtle", "legend")
"""All of them; those that are chosen or not."""
DRAWING, STEPS, FILAMENT = "the drawing of a turtle", "drawings side by side", "a filament"
STAGES, LINEAGE = "a stage diagram", "a lineage"
MAP, SPHERE, CELLWORK = "a map", "a map on a sphere", "a cellwork"
KINDS: Mapping[str, tuple[str, ...]] = {
    DRAWING: ("colours", "widths", "turtle", "legend", "light", "background"),
    STEPS: OPTIONS,
    FILAMENT: ("labels", "colours", "legend", "background"),
    STAGES: ("labels", "colours", "background"),
    LINEAGE: ("labels", "colours", "legend", "background"),
    MAP: ("labels", "background"),
    SPHERE: ("background",),
    CELLWORK: ("colours", "legend", "light", "background"),
}
"""The kinds of pictures, each with the options that it has."""
COLOURS, WIDTHS = ("natural", "symbols"), (PIPES, "order", "constant")
"""What colours and widths can be, besides colours of single symbols and a factor."""
LEAST_FACTOR, GREATEST_FACTOR = 0.1, 20.0


@dataclass(frozen=True)
class Style:
    """How something is drawn.

    Attributes
    ----------
    labels, legend
        Whether it has labels and a legend; None where that is left to the kind of picture.
    turtle
        Whether it is marked where the turtle starts and looks.
    colours
        Whose colours strokes have: "natural" ones, or those of "symbols"; "" for those of the system.
    widths
        Where the widths of strokes come from: "pipes", their "order", or they are "constant"; "" as the system says.
    light
        Where the sun stands; None for a drawing without sun and sky.
    theme
        The colours of the picture, and how bold its strokes are.
    size
        The width and height of the picture, if it is not of the usual size.
    """

    labels: bool | None = None
    legend: bool | None = None
    turtle: bool = False
    colours: str = ""
    widths: str = ""
    light: Sun | None = None
    theme: Theme = LIGHT
    size: Size | None = None


def style_from(given: Choices, kind: str, symbols: Symbols, size: object = None) -> Style:
    """The style that a person chooses for a kind of picture, whose symbols may be given colours.

    >>> found = style_from({"colours": {"A": "navy"}, "background": "dark"}, STAGES, {"A": ("A",)})
    >>> found.theme.symbols, found.theme.dark
    ((('A', '#000080'),), True)
    >>> style_from({"widths": 2}, DRAWING, {}).theme.boldness
    2.0

    Raises
    ------
    ModelValueError
        An option means nothing for this kind of picture, or its value is none that there is.
    """
    pixels = size_from(size)
    for name, value in given.items():
        if name not in KINDS[kind]:
            there = listed(KINDS[kind]) + " alone" * (len(KINDS[kind]) == 1)
            raise ModelValueError(f'"{name}" means nothing for {kind}', hint=f"What can be chosen is {there}.")
        if name in FLAGS:
            require(value, bool, f'True or False for "{name}"')
    found = Style(theme=theme_from(given["background"]) if "background" in given else LIGHT, size=pixels)
    if "colours" in given:
        found = _with_colours(found, given["colours"], kind, symbols)
    if "widths" in given:
        found = _with_widths(found, given["widths"])
    if "light" in given:
        found = replace(found, light=sun_from(given["light"]))
    return replace(found, **{name: value for name, value in given.items() if name in FLAGS})


def _with_colours(found: Style, value: object, kind: str, symbols: Symbols) -> Style:
    if isinstance(value, str) and value in COLOURS:
        if value == "natural" and kind not in (DRAWING, STEPS):
            raise ModelValueError(
                "Only strokes of a turtle have natural colours, and there are none here",
                hint='Give colours="symbols", or colours of single symbols.',
            )
        return replace(found, colours=value)
    if not isinstance(value, Mapping):
        raise ModelValueError(
            f'"colours" are "natural", "symbols" or colours of symbols, not {shown(value)}',
            hint='For example colours={"A": "seagreen"}.',
        )
    chosen = tuple((each, colour_from(colour)) for name, colour in value.items() for each in _called(name, symbols))
    return replace(found, theme=replace(found.theme, symbols=chosen))


def _called(symbol: object, symbols: Symbols) -> tuple[str, ...]:
    if not isinstance(symbol, str) or symbol not in symbols:
        text = quotable(symbol) if isinstance(symbol, str) else ""
        name = f'"{text}"' if isinstance(symbol, str) else shown(symbol)
        hint = suggestion(text, symbols) or f"Symbols are: {', '.join(sorted(symbols))}."
        raise ModelNameError(f"There is no symbol {name} here that could have a colour", hint=hint)
    return symbols[symbol]


def _with_widths(found: Style, value: object) -> Style:
    if isinstance(value, str) and value in WIDTHS:
        return replace(found, widths=value, theme=replace(found.theme, even=value == "constant"))
    try:
        factor = real_from(value, "widths")
    except LSystemError as mistake:
        raise ModelValueError(f'"widths" are "pipes", "order", "constant" or a factor, not {shown(value)}') from mistake
    if not LEAST_FACTOR <= factor <= GREATEST_FACTOR:
        raise ModelValueError(f'A factor of "widths" is {LEAST_FACTOR:g} to {GREATEST_FACTOR:g}, not {factor:g}')
    return replace(found, theme=replace(found.theme, boldness=factor))


def in_colours(what: Derivation | Word, angle: float, style: Style) -> Scene:
    """The scene of a word with the colours that were chosen."""
    return in_chosen_colours(scene_of(what, angle, style.colours, style.widths), what.states, style)


def in_chosen_colours(scene: Scene, states: States, style: Style) -> Scene:
    """A scene in which the colours that were chosen are those of symbols."""
    chosen = dict(style.theme.symbols)
    if style.colours == "symbols":
        return with_colours_of_symbols(scene)
    if not chosen:
        return scene
    return with_colours_of_symbols(scene, [state for state, module in enumerate(states.modules) if module.symbol in chosen])


def in_widths(scenes: Sequence[Scene], system: LSystem, style: Style) -> list[Scene]:
    """Scenes of a system with the widths that were chosen, such that all fit into one frame."""
    found = [with_widths(scene, style.widths, style.theme.boldness) for scene in in_units(scenes, system, style.widths)]
    return [with_start(scene, system) for scene in found] if style.turtle else found


def split_options(choices: Mapping[str, object]) -> tuple[dict[str, Any], dict[str, Any]]:
    """The options among some choices that are given, and the other choices."""
    given = {name: value for name, value in choices.items() if name in OPTIONS and value is not None}
    return given, {name: value for name, value in choices.items() if name not in OPTIONS}


# --- the kinds ---

DRAWABLE = (LSystem, Derivation, Word, CellSystem, CellDevelopment, Stages, Lineage)
"""What can be drawn."""


WORD = "timed(system).word(4)"
"""An example of a word of a timed system."""


def instead(what: object, function: str, of_words: str) -> str:
    """What to try in place of a text or a timed system, of which a function makes no picture.

    >>> instead("K5", "draw", "")
    "For example draw(system('K5')), or draw(read(text))."
    """
    if isinstance(what, str):
        return f"For example {function}(system({shown(what)})), or {function}(read(text))."
    if isinstance(what, Growth):
        return "Growth is plotted: plot(growth(system)); its curve with plot(system)."
    if isinstance(what, Timed):
        return f"At a time it has a word: {of_words}; up to a time a lineage: {function}(lineage(timed(system), 4))."
    return ""


def check_drawable(what: object, n: int | None = None) -> None:
    """It can be drawn, and its number of steps can be chosen if one is."""
    if not isinstance(what, DRAWABLE):
        hint = instead(what, "draw", f"draw({WORD})")
        raise ModelValueError(
            "Only systems, derivations, words, developments, stage diagrams and lineages can be drawn, "
            f"not {type(what).__name__}",
            hint=hint,
        )
    if n is not None and isinstance(what, Stages | Lineage):
        hint = "Give the word of a step as tokens=..., or animate(...)." if isinstance(what, Stages) else ""
        raise ModelValueError(f"The steps of {kind_of(what, {})} are chosen when it is made, not when it is drawn", hint=hint)


def kind_of(what: object, choices: Choices) -> str:
    """The kind of picture that is drawn of something."""
    if isinstance(what, CellSystem | CellDevelopment):
        return f"a {cell_system_of(what).kind}"
    if isinstance(what, LSystem | Derivation | Word):
        if drawing_mode(system_of(what)) is DrawingMode.FILAMENT:
            return FILAMENT
        several = any(isinstance(choices.get(name), Sequence) and len(choices[name]) for name in ("steps", "seeds"))
        return STEPS if several else DRAWING
    return {Stages: STAGES, Lineage: LINEAGE}.get(type(what), DRAWING)


def coloured_symbols(what: object) -> Symbols:
    """The symbols in something whose colours can be chosen; both polarities of a cell are chosen by its letter."""
    if isinstance(what, CellSystem | CellDevelopment):
        cells = cell_system_of(what)
        return {label: (label,) for label in cells.labels} if isinstance(cells, CellworkSystem) else {}
    if isinstance(what, LSystem | Derivation | Word):
        return named_symbols(system_of(what))
    if isinstance(what, Stages):
        return named_symbols(what.system)
    return named_symbols(what.states.system) if isinstance(what, Lineage) else {}


def named_symbols(system: LSystem) -> Symbols:
    """The symbols of a system by their names.

    >>> from lsys_kit.notation.read import read
    >>> named_symbols(read("axiom: ar b\\nar -> al"))
    {'a': ('ar', 'al'), 'ar': ('ar',), 'b': ('b',), 'al': ('al',)}
    """
    found: dict[str, tuple[str, ...]] = {}
    for symbol, (letter, _) in polar_symbols(system).items():
        found[letter] = (*found.get(letter, ()), symbol)
    return found | {symbol: (symbol,) for symbol in symbols(system)}


def system_of(what: LSystem | Derivation | Word) -> LSystem:
    return what if isinstance(what, LSystem) else what.states.system


def cell_system_of(what: CellSystem | AnyDevelopment) -> CellSystem:
    system: CellSystem = what if isinstance(what, CellSystem) else what.system
    return system
