"""Kinds of pictures: which kind something is drawn as, and which of its symbols can be coloured."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from typing import Any

from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.derivation.timed.timed import Timed
from lsys_kit.derivation.tissues.development import CellDevelopment
from lsys_kit.errors import ModelValueError, shown
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.options import DRAWING, FILAMENT, LINEAGE, STAGES, STEPS, Symbols
from lsys_kit.pictures.style.labels import polar_symbols

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


def kind_of(what: object, choices: Mapping[str, Any]) -> str:
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


def cell_system_of(what: CellSystem | CellDevelopment[Any, Any]) -> CellSystem:
    system: CellSystem = what if isinstance(what, CellSystem) else what.system
    return system
