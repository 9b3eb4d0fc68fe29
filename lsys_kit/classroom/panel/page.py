"""A page without a kernel: the panel of a system with the books of its settings, one HTML file with no address outside it."""

from __future__ import annotations

import json
import time
from collections.abc import Mapping, Sequence
from itertools import product
from math import prod
from pathlib import Path
from typing import Any

from lsys_kit.budget import current
from lsys_kit.classroom.panel.books.book import book, first_step
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.controls import slider, slider_ranges, slider_values
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.derivation.core.rules import number_from, real_from
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import save_file
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import write
from lsys_kit.pictures.style.labels import escaped

MOST_BOOKS, MOST_CHARACTERS = 2_000, 4_000_000
"""A page holds no more books, and no more than about so many characters of them before they are deflated; nor more than can be
made in the time of one task."""
STYLE = """
.lsys-page {
  margin: 0 auto; padding: 8px 12px 24px; max-width: 1500px; background: #fff; color: #22303c;
  font: 15px/1.5 system-ui, sans-serif;
}
.lsys-page h1 { font-size: 20px; font-weight: 600; margin: 4px 0 8px; overflow-wrap: anywhere; }
@media (prefers-color-scheme: dark) { .lsys-page { background: #161b20; color: #e8edf2; } }
"""
_CELLS, _STROKES, _TISSUES = frozenset(("filament",)), frozenset(("turtle", "painter")), frozenset(("tissue",))
_MAPS = frozenset(("map", "relaxation", "relaxing", "tension"))
_NOT_NEEDED = {"filament": _STROKES | _MAPS | _TISSUES, "plane": _CELLS | _MAPS | _TISSUES, "space": _CELLS | _MAPS | _TISSUES,
               "map": _CELLS | _TISSUES | {"turtle"}, "tissue": _CELLS | _MAPS | {"turtle"}}
"""The scripts that draw other systems than that of a page, by the way in which it is drawn."""


def page(title: str, data: Mapping[str, Any], description: str, language: str = "en") -> str:
    """One HTML file that shows a panel.

    Parameters
    ----------
    title
        The heading of the page.
    data
        What `page_data` makes.
    description
        What is to be seen first, in words: for readers without scripts, and for search.
    language
        The language of the title and the description, as in "en" or "de-AT".

    Raises
    ------
    ModelValueError
        There is no language of that form.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> text = page("Algae", page_data(read("axiom: a\\na -> ab\\nb -> a")), "The word a.")
    >>> text.startswith("<!doctype html>"), text.count("<script"), "://" in text.partition("<script>")[0]
    (True, 2, False)
    """
    body = f"""<h1>{escaped(title)}</h1>
<main id="lsys-here"></main>
<noscript><p>Without JavaScript the panel cannot be moved. It shows: {escaped(description)}</p></noscript>
"""
    script = f'"use strict";\n{compact("page", not_needed(data["mode"]))}\nopenPage();\n'
    return document(title, body, STYLE, description, Program(script, style(), data), language)


def not_needed(*modes: str) -> frozenset[str]:
    """The scripts that are not called on a page of panels that draw in these ways.

    >>> sorted(not_needed("plane", "filament"))
    ['map', 'relaxation', 'relaxing', 'tension', 'tissue']
    """
    return frozenset.intersection(*(_NOT_NEEDED[mode] for mode in modes))


def page_data(system: LSystem, changes: Mapping[str, object] | None = None, seed: int = 0, *, title: str = "",
              step: int | None = None, angle: object = None, around: int = 0, above: int = 0) -> dict[str, Any]:
    """What a page says of a system: its sliders, and the books of all their settings.

    Parameters
    ----------
    system
        Any L-system.
    changes
        First values of declared constants.
    seed
        The seed of the random numbers.
    title
        The id of the system, if it is one of the catalogue.
    step, angle, around, above
        What is shown first: the step, by default the system's own; the degrees by which the turtle turns; the side from which a
        plant in space is seen.

    Raises
    ------
    LSystemError
        A value lies outside its slider's range, or the first book cannot be made.
    """
    given = {name: number_from(value, name) for name, value in (changes or {}).items()}
    ranges = slider_ranges(system, given)
    values = {name: slider_values(span) for name, span in ranges.items()}
    start = {**{name: value for name, value in given.items() if name not in ranges},
             **{name: span.value for name, span in ranges.items()}}
    wanted = first_step(system) if step is None else step
    began = time.thread_time()
    first = book(system, start, seed, title=title, least=wanted)
    live = live_constants(values, _room(len(json.dumps(first)), time.thread_time() - began))
    fixed = {name: number_text(value) for name, value in start.items() if name not in live}
    books = [_book(system, {**start, **dict(zip(live, chosen, strict=True))}, seed, title, wanted)
             for chosen in product(*(values[name] for name in live))]
    turn = real_from(angle, "angle") if angle is not None else float(system.angle)
    model = {"constants": [slider(name, values[name], ranges[name].value) for name in live],
             "chance": False, "fixed": kept_text(fixed, seed if first["chance"] else None), "step": min(wanted, first["steps"]),
             "angle": round(turn, 1), "around": around, "above": above, "seed": seed}
    own = {"notation": system.notation, "text": write(system), "angle": round(float(system.angle), 1)}
    return {"model": model, "mode": first["mode"], "system": own, "fixed": fixed, "books": deflated(shared(books))}


def save_page(path: str | Path, text: str) -> None:
    """Write a page to an .html file.

    Raises
    ------
    ModelFileError
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    if Path(path).suffix.lower() != ".html":
        raise ModelFileError(f'A page cannot be written to "{quotable(Path(path).name)}"', hint="Let the name end in .html.")
    save_file(Path(path), text.encode())


def live_constants(values: Mapping[str, Sequence[Value]], most: int) -> list[str]:
    """The constants that can be moved on a page with room for so many books: in their order, while there is room.

    >>> live_constants({"a": range(6), "b": range(1000), "c": range(6)}, 800)
    ['a', 'c']
    """
    live: list[str] = []
    for name in values:
        if prod(len(values[each]) for each in (*live, name)) <= most:
            live.append(name)
    return live


def _room(size: int, seconds: float) -> int:
    """How many books of about so many characters, each made in about so many seconds, a page has room for."""
    return int(min(MOST_BOOKS, MOST_CHARACTERS / size, current().seconds / max(seconds, 1e-3)))


def shared(books: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Books with what they have in common written once: for each entry its different values, and for each book their numbers.

    >>> shared([{"a": [1], "b": 2}, {"a": [1], "b": 3, "c": 4}])
    {'names': ['a', 'b', 'c'], 'parts': [[[1]], [2, 3], [4]], 'rows': [[0, 0, -1], [0, 1, 0]]}
    """
    names = [*dict.fromkeys(name for each in books for name in each)]
    parts: list[dict[str, int]] = [{} for _ in names]
    rows = [[parts[number].setdefault(json.dumps(each[name]), len(parts[number])) if name in each else -1
             for number, name in enumerate(names)] for each in books]
    return {"names": names, "parts": [[*map(json.loads, part)] for part in parts], "rows": rows}


def deflated(content: object) -> str:
    """Anything as JSON, deflated (RFC 1950), in base 64."""
    return deflated_text(json.dumps(content, separators=(",", ":")))


def _book(system: LSystem, settings: Mapping[str, object], seed: int, title: str, least: int) -> dict[str, Any]:
    """The book of some settings, or why there is none."""
    try:
        return book(system, settings, seed, title=title, least=least)
    except LSystemError as error:
        return {"mistake": {"message": error.message, "hint": error.hint or ""}}


def kept_text(fixed: Mapping[str, str], seed: int | None) -> str:
    """What a page says of what cannot be moved on it."""
    kept = [*(f"{name} = {text}" for name, text in fixed.items()), *([] if seed is None else [f"seed = {seed}"])]
    return f"Fixed on this page: {', '.join(kept)}." if kept else ""
