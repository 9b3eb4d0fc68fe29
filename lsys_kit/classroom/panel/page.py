"""A page without a kernel: the panel of a system with the books of its settings, one HTML file with no address outside it."""

from __future__ import annotations

import json
from collections.abc import Callable, Collection, Iterator, Mapping, Sequence
from functools import partial
from pathlib import Path
from typing import Any, NamedTuple

from lsys_kit.budget import current, processor_time
from lsys_kit.classroom.panel.books.book import book, first_step
from lsys_kit.classroom.panel.books.net import Unfolding
from lsys_kit.classroom.panel.bundle import compact, style
from lsys_kit.classroom.panel.controls import slider, slider_ranges, slider_values
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.classroom.panel.held import SEED, Held, constant_choice, fewest, held_text, planned, seed_choice, settings
from lsys_kit.classroom.panel.labels import translated_labels
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelFileError, quotable
from lsys_kit.files import path_from, save_file
from lsys_kit.geometry.drawing import turning_angle
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.write import write
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.themes import DARK, LIGHT

MOST_BOOKS, MOST_CHARACTERS = 2_000, 400_000
"""A page holds no more books, and no more than about so many characters of them, deflated; nor more than can be made in the
time of one task."""
MOST_FOR_FEWEST = 1_100_000
"""It may have so many characters if the sliders could not move otherwise."""
STYLE = f"""
.lsys-page {{
  margin: 0 auto; padding: 8px 12px 24px; max-width: 1500px; background: {LIGHT.paper}; color: {LIGHT.ink};
  font: 15px/1.5 system-ui, sans-serif;
}}
.lsys-page h1 {{ font-size: 20px; font-weight: 600; margin: 4px 0 8px; overflow-wrap: anywhere; }}
@media (prefers-color-scheme: dark) {{ .lsys-page {{ background: {DARK.paper}; color: {DARK.ink}; }} }}
"""
_CELLS, _STROKES, _TISSUES = frozenset(("filament",)), frozenset(("turtle", "painter", "projection")), frozenset(("tissue",))
_MAPS = frozenset(("map", "relaxation", "relaxing", "tension"))
_NOT_NEEDED = {
    "filament": _STROKES | _MAPS | _TISSUES,
    "plane": _CELLS | _MAPS | _TISSUES,
    "space": _CELLS | _MAPS | _TISSUES,
    "map": _CELLS | _TISSUES | {"turtle"},
    "tissue": _CELLS | _MAPS | {"turtle"},
}
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


def page_data(
    system: LSystem,
    changes: Mapping[str, object] | None = None,
    seed: int = 0,
    *,
    title: str = "",
    step: int | None = None,
    angle: object = None,
    around: int = 0,
    above: int = 0,
    asked: Sequence[Mapping[str, object]] = (),
    without: Collection[str] = (),
    unfold: Unfolding = False,
    made: Made | None = None,
) -> dict[str, Any]:
    """What a page says of a system: its sliders, and the books of their settings.

    Parameters
    ----------
    system
        Any L-system.
    changes
        First values of declared constants.
    seed
        The first seed of the random numbers.
    title
        The id of the system, if it is one of the catalogue.
    step, angle, around, above
        What is shown first: the step, by default the system's own; the degrees by which the turtle turns; the side from which a
        plant in space is seen.
    asked
        Settings that the page shall hold before all others, each the values of one slider or of several together; the seed is
        called `seed`. What is no value of a slider is passed over.
    without
        What has no slider: names of constants, `angle`, `seed`.
    unfold
        The symbols that are unfolded in the stage diagram, as for `stages`.
    made
        A book of the system that is there already: that of the first settings need not be made again.

    Raises
    ------
    LSystemError
        A value lies outside its slider's range, or the first book cannot be made.
    """
    given = {name: number_from(value, name) for name, value in (changes or {}).items()}
    ranges = slider_ranges(system, given)
    start: dict[str, Value] = {
        **{name: value for name, value in given.items() if name not in ranges},
        **{name: span.value for name, span in ranges.items()},
        SEED: seed,
    }
    wanted = first_step(system) if step is None else step
    shelf = _Shelf(start, partial(book, system, title=title, least=wanted, unfold=unfold))
    if made and {**made.settings, SEED: made.seed} == start and wanted <= max(made.least, made.book["steps"]):
        shelf.put(start, made)
    first = shelf.first()
    values = {name: slider_values(span) for name, span in ranges.items() if name not in without}
    held = _held(shelf, values, seed if first["chance"] and "seed" not in without else None, asked)
    fixed = {name: value for name, value in start.items() if name not in held.values and (name != SEED or first["chance"])}
    turn = turning_angle(angle, system)
    model = {
        "constants": [slider(name, held.values[name], start[name]) for name in values if name in held.values],
        "chance": SEED in held.values,
        "seeds": [*map(number_text, held.values.get(SEED, ()))],
        "together": held.together,
        "fixed": held_text(fixed, held, values),
        "without": sorted(without),
        "unfold": unfold,
        "step": min(wanted, first["steps"]),
        "angle": round(turn, 1),
        "around": around,
        "above": above,
        "seed": seed,
        **translated_labels(),
    }
    own = {"notation": system.notation, "text": write(system), "angle": round(float(system.angle), 1)}
    kept = {name: number_text(value) for name, value in fixed.items() if name != SEED}
    return {
        "model": model,
        "mode": first["mode"],
        "system": own,
        "fixed": kept,
        "books": deflated(shared([shelf.book(each) for each in settings(held)])),
    }


def save_page(path: str | Path, text: str) -> None:
    """Write a page to an .html file.

    Raises
    ------
    ModelFileError
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    path = path_from(path)
    if path.suffix.lower() != ".html":
        raise ModelFileError(f'A page cannot be written to "{quotable(path.name)}"', hint="Let the name end in .html.")
    save_file(path, text.encode())


def _held(
    shelf: _Shelf, values: Mapping[str, Sequence[Value]], seed: int | None, asked: Sequence[Mapping[str, object]]
) -> Held:
    """The settings for which a page has room: what a book takes is seen from those with the fewest values of each slider."""
    rows = [*_asked_settings(values, seed, asked)]
    choices = {
        name: constant_choice(each, shelf.start[name], {row[name] for row in rows if name in row})
        for name, each in values.items()
    }
    if seed is not None:
        choices[SEED] = seed_choice(seed, {int(row[SEED]) for row in rows if SEED in row})
    few = fewest(choices, shelf.room([{}], MOST_FOR_FEWEST))
    most = shelf.room([*settings(few)], MOST_CHARACTERS)
    away = [[name for name in row if name in few.values and row[name] != choices[name].first] for row in rows]
    together = [*dict.fromkeys(name for names in away if len(names) > 1 for name in names)]
    return planned({name: choices[name] for name in few.values}, together, most)


def _asked_settings(
    values: Mapping[str, Sequence[Value]], seed: int | None, asked: Sequence[Mapping[str, object]]
) -> Iterator[dict[str, Value]]:
    """What is asked for of the sliders of a system: whatever lies between their ends, and whole seeds."""
    for row in asked:
        given = {name: number_from(value, name) for name, value in row.items()}
        found = {
            name: value for name, value in given.items() if name in values and values[name][0] <= value <= values[name][-1]
        }
        if seed is not None and "seed" not in values and isinstance(given.get("seed"), int):
            found[SEED] = given["seed"]
        if found:
            yield found


class Made(NamedTuple):
    """A book with the settings of which it is, the step that it should hold, and the seconds that it took."""

    settings: Mapping[str, Value]
    seed: int
    least: int
    book: dict[str, Any]
    seconds: float


class _Shelf:
    """The books of a system, each made once, and how many of them a page has room for."""

    def __init__(self, start: Mapping[str, Value], made: Callable[[Mapping[str, Value], int], dict[str, Any]]) -> None:
        self.start, self._made, self._seconds, self._book = start, dict[tuple[Value, ...], dict[str, Any]](), 0.0, made

    def put(self, chosen: Mapping[str, Value], made: Made) -> None:
        """Take a book of some settings that is there already."""
        self._made[tuple(chosen.values())] = made.book
        self._seconds += made.seconds

    def first(self) -> dict[str, Any]:
        """The book of the first settings.

        Raises
        ------
        LSystemError
            It cannot be made.
        """
        return self._kept(self.start)

    def book(self, chosen: Mapping[str, Value]) -> dict[str, Any]:
        """The book of some settings, or why there is none."""
        try:
            return self._kept({**self.start, **chosen})
        except LSystemError as error:
            return {"mistake": {"message": error.message, "hint": error.hint or ""}}

    def room(self, sample: Sequence[Mapping[str, Value]], characters: int) -> float:
        """How many books a page has room for that are like those of some settings."""
        size, many = len(deflated(shared([self.book(each) for each in sample]))), len(sample)
        seconds = self._seconds / max(1, len(self._made))
        return min(MOST_BOOKS, many * characters / size, current().seconds / max(seconds, 1e-3))

    def _kept(self, chosen: Mapping[str, Value]) -> dict[str, Any]:
        key = tuple(chosen.values())
        if key not in self._made:
            began = processor_time()
            self._made[key] = self._book({name: value for name, value in chosen.items() if name != SEED}, int(chosen[SEED]))
            self._seconds += processor_time() - began
        return self._made[key]


def shared(books: Sequence[Mapping[str, Any]]) -> dict[str, Any]:
    """Books with what they have in common written once: for each entry its different values, and for each book their numbers.

    >>> shared([{"a": [1], "b": 2}, {"a": [1], "b": 3, "c": 4}])
    {'names': ['a', 'b', 'c'], 'parts': [[[1]], [2, 3], [4]], 'rows': [[0, 0, -1], [0, 1, 0]]}
    """
    names = [*dict.fromkeys(name for each in books for name in each)]
    parts: list[dict[str, int]] = [{} for _ in names]
    rows = [
        [
            parts[number].setdefault(json.dumps(each[name]), len(parts[number])) if name in each else -1
            for number, name in enumerate(names)
        ]
        for each in books
    ]
    return {"names": names, "parts": [[*map(json.loads, part)] for part in parts], "rows": rows}


def deflated(content: object) -> str:
    """Anything as JSON, deflated (RFC 1950), in base 64."""
    return deflated_text(json.dumps(content, separators=(",", ":")))
