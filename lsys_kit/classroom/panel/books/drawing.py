"""How a book says what is drawn: for each state the cells and walls of a filament, or the calls of a turtle."""

from __future__ import annotations

import math
from collections.abc import Iterable, Mapping, Sequence
from itertools import pairwise
from typing import Any

from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.states import States
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.geometry.drawing import has_natural_colours
from lsys_kit.geometry.filament import shapes_of
from lsys_kit.geometry.turtle.commands import (
    DrawingMode,
    Instruction,
    drawing_mode,
    initial_colour,
    initial_step,
    instructions,
    unknown_commands,
)
from lsys_kit.geometry.turtle.plane import PLANE_HANDLERS
from lsys_kit.geometry.turtle.space import SPACE_HANDLERS
from lsys_kit.geometry.turtle.surfaces import Surface, passed_over, surfaces_by_symbol
from lsys_kit.geometry.turtle.turtle import label_text
from lsys_kit.notation.model.modules import Module, flat
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.pictures.filaments import time_text
from lsys_kit.pictures.style.labels import visible
from lsys_kit.pictures.style.palette import CHOSEN

BY_ANGLE = frozenset(("turn", "turn by mirrored angle", "turn back", "pitch", "roll"))
"""The actions whose quantity is the angle."""
GREATEST = 1e300
"""Stands for what is infinite, which JSON has no number for: a turtle that bends by so much points straight down."""
_TILDE = -1
"""The number of a module that is in no word: beside it, the symbols of surfaces are commands."""


def drawn_rows(states: States, numbers: Sequence[int], mode: DrawingMode) -> list[list[Any]]:
    """For each of some states what is drawn.

    In a filament its cells and walls as in `shapes_of`; for a turtle its calls, each an action, a factor and an addend, the
    values of its module or 0, for a label what it says, and a surface or 0.

    Raises
    ------
    LSystemError
        It cannot be drawn.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> states = States(read("axiom: F(2)+A"))
    >>> drawn_rows(states, states.axiom, DrawingMode.PLANE)
    [[['draw', 0, 2, [2], 0]], [['turn', 1, 0, 0, 0]], []]
    """
    if mode is DrawingMode.FILAMENT:
        return [
            [[None if math.isnan(number) else _plain(number) for number in shape] for shape in shapes]
            for shapes in shapes_of(states, numbers).values()
        ]
    system, drawn = states.system, interpretations(states, numbers)
    if any(module.symbol == "~" for module in system.modules):
        drawn = {**drawn, _TILDE: (Module("~"),)}
    handlers = PLANE_HANDLERS if mode is DrawingMode.PLANE else SPACE_HANDLERS
    calls = instructions(drawn, system.turtle, system.angle)
    known = surfaces_by_symbol(system)
    return [[_call(each, known) for each in calls[state] if each.action in handlers] for state in numbers]


def _call(instruction: Instruction, known: Mapping[str, Surface]) -> list[Any]:
    action, factor, addend, values, symbol, surface = instruction
    if action == "draw expected surface":
        surface = symbol if symbol in known else ""
    said = [label_text(values)] if action == "draw label" and values else [*map(_plain, values)]
    return [action, _plain(factor), _plain(addend), said or 0, surface or 0]


def _plain(number: float) -> float:
    """A number as short as it can be written in JSON."""
    number = max(-GREATEST, min(GREATEST, number))
    return int(number) if abs(number) < GREATEST and number == int(number) else number


def drawing_entries(states: States, numbers: Sequence[int], drawn: list[list[Any]], last: int) -> dict[str, Any]:
    """The entries of a book that say how it is drawn, given its states, what each is drawn as, and its last step."""
    system, mode = states.system, drawing_mode(states.system)
    if mode is DrawingMode.FILAMENT:
        step = age_model(states).step
        return {
            "mode": "filament",
            "cells": drawn,
            "look": system.cells,
            "time": None if step is None else float(step),
            "times": [] if step is None else [time_text(step * number) for number in range(last + 1)],
            "unknown": [],
            "said": "",
        }
    unknown = (*unknown_commands(interpretations(states, numbers), system), *_not_surfaces(system))
    return {
        "mode": mode.name.lower(),
        "turtle": _turtle(system, drawn),
        "unknown": [*map(visible, unknown)],
        "said": passed_over(unknown),
    }


def _turtle(system: LSystem, calls: list[list[Any]]) -> dict[str, Any]:
    dialect = TURTLE_DIALECTS[system.turtle]
    named = {surface for row in calls for *_, surface in row if surface}
    return {
        "side": dialect.left,
        "length": initial_step(system),
        "width": dialect.width,
        "colour": initial_colour(system),
        "natural": has_natural_colours(system),
        "heading": float(system.heading),
        "angle": float(system.angle),
        "pixels": system.widths or ("auto" if dialect.pixels else "units"),
        "calls": calls,
        "surfaces": {name: faces_in(surfaces_by_symbol(system)[name], drawing_mode(system)) for name in sorted(named)},
        "colours": [*CHOSEN],
        "uses angle": any(action in BY_ANGLE and factor for row in calls for action, factor, *_ in row),
    }


def faces_in(surface: Surface, mode: DrawingMode) -> dict[str, list[Any]]:
    """The faces of a surface in a book, none where it is flat, and its outlines."""
    curved = mode is DrawingMode.SPACE and bool(surface.normals)
    return {
        "faces": [[*map(list, face)] for face in surface.faces if curved],
        "outlines": [[*map(list, face)] for face in surface.outlines],
    }


def _not_surfaces(system: LSystem) -> Iterable[str]:
    """What stands behind a tilde and is no surface, with its tilde."""
    known = surfaces_by_symbol(system)
    words = [tuple(flat(word)) for word in (system.axiom, *(rule.successor for rule in system.rules))]
    return dict.fromkeys(
        f"~{behind.symbol}"
        for word in words
        for before, behind in pairwise(word)
        if before.symbol == "~" and behind.symbol not in known
    )
