"""Books of turtles for the scripts of the panel, and the scripts themselves, in an empty page of a browser."""

from __future__ import annotations

import json
import re
from collections.abc import Sequence
from pathlib import Path
from typing import Any
from weakref import WeakKeyDictionary

from playwright.sync_api import JSHandle, Page

import lsys_kit.classroom.panel
from lsys_kit.classroom.panel.books.book import faces_in, unit_of_widths
from lsys_kit.derivation.core.interpretation import interpretations
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.drawing import has_natural_colours
from lsys_kit.geometry.turtle.commands import (
    Instruction,
    drawing_mode,
    initial_colour,
    initial_step,
    initial_width,
    instructions,
)
from lsys_kit.geometry.turtle.surfaces import surfaces_by_symbol
from lsys_kit.geometry.turtle.turtle import label_text
from lsys_kit.notation.model.turtle_dialects import TURTLE_DIALECTS
from lsys_kit.pictures.draw import state_colours
from lsys_kit.pictures.style.palette import CHOSEN

SCRIPTS = Path(lsys_kit.classroom.panel.__file__).parent / "scripts"
TURTLE = (
    "constants",
    "numbers",
    "turtle_actions",
    "outlines",
    "depths",
    "projection",
    "turtle_plane",
    "turtle_space",
    "turtle",
)
PAINTER = (*TURTLE, "colours", "shaders", "sunlight", "painter")
IMPORT = re.compile(r"^import .*;$\n", re.MULTILINE)


def joined(*names: str) -> str:
    """Some scripts as one text without imports and exports."""
    texts = [next(SCRIPTS.rglob(f"{name}.js")).read_text(encoding="utf-8") for name in names]
    return "\n".join(re.sub(r"^export ", "", IMPORT.sub("", text), flags=re.MULTILINE) for text in texts)


def answers(page: Page, code: str, given: Any, *names: str) -> Any:
    """What some code makes of what is given, with the scripts before it."""
    return called(page, f"{joined(*names)}\n{BOOKS}", f"given => {{ {code} }}", given)


def called(page: Page, scripts: str, function: str, given: Any) -> Any:
    """What a function, with some scripts before it, makes of what is given: both ways as JSON, which is much the fastest, and
    compiled once a page."""
    known = _FUNCTIONS.setdefault(page, {})
    if (scripts, function) not in known:
        known[scripts, function] = page.evaluate_handle(
            f"() => {{ {scripts}\nreturn text => JSON.stringify(({function})(JSON.parse(text))); }}"
        )
    return json.loads(page.evaluate("([made, text]) => made(text)", [known[scripts, function], json.dumps(given)]))


_FUNCTIONS: WeakKeyDictionary[Page, dict[tuple[str, str], JSHandle]] = WeakKeyDictionary()
"""What a page has compiled already."""
BOOKS = "const bookOf = (data) => ({ data, word: (step) => Int32Array.from(data.words[step]) });"


def book_of(words: Sequence[Word]) -> dict[str, Any]:
    """As much of the book of some words of one derivation as a turtle needs."""
    states, system = words[0].states, words[0].states.system
    numbers = list(range(len(states.modules)))
    dialect, colour_of = TURTLE_DIALECTS[system.turtle], state_colours(words[-1])
    compiled = instructions(interpretations(states, numbers), system.turtle, system.angle)
    return {
        "mode": drawing_mode(system).name.lower(),
        "words": [word.numbers() for word in words],
        "symbols": [[str(state), "", colour_of[state], 0] for state in numbers],
        "states": [[state] for state in numbers],
        "turtle": {
            "side": dialect.left,
            "length": initial_step(system),
            "width": initial_width(system),
            "colour": initial_colour(system),
            "natural": has_natural_colours(system),
            "heading": float(system.heading),
            "angle": float(system.angle),
            "widths": unit_of_widths(system),
            "calls": [[call_of(each) for each in compiled[state]] for state in numbers],
            "surfaces": {name: faces_in(surface, drawing_mode(system)) for name, surface in surfaces_by_symbol(system).items()},
            "colours": CHOSEN,
        },
    }


def call_of(instruction: Instruction) -> list[Any]:
    """An instruction in a book; an infinite strength is written in letters."""
    action, factor, addend, values, symbol, surface = instruction
    if action == "draw expected surface":
        surface = symbol
    said = [label_text(values)] if action == "draw label" and values else list(values)
    return [action, factor, addend if abs(addend) < float("inf") else "Infinity", said or 0, surface or 0]
