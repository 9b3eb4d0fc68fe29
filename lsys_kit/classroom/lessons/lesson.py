"""What a lesson is made of beside its notebook: its objectives, its vote and its tables to fill, as they are declared.

Each lesson has a file of the name of its notebook; `lsys_kit/classroom/places.py` says where. What does not fit in it is an
error that names its place. The right answers are there, where anybody can find them; the notebook shows none of them before
the student has answered.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import dataclass, field
from functools import lru_cache
from pathlib import Path
from typing import Any

from lsys_kit.classroom.lessons.entries import is_number_asked, number_of
from lsys_kit.classroom.places import NAME, Course, Place, course_at_hand, declaration, key_of, kit_place, places
from lsys_kit.errors import LSystemError, ModelFileError, ModelNameError, ModelValueError, quotable, shown
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import ENGLISH

TRACKS: Mapping[str, str] = {"F": "the fast track of 90 minutes", "C": "the core of a semester", "O": "an option"}
"""The ways through the course that a lesson may belong to."""


@dataclass(frozen=True)
class Option:
    """One of the answers of a vote, and the reply to those who choose it in the end."""

    text: str
    reply: str
    right: bool = False


@dataclass(frozen=True)
class Vote:
    """The question of a vote, its options, and how its picture is drawn: the arguments of `draw`, with the id of a system
    as `system` or its text as `rules`, the step as `step`, and new values of constants as `constants`; empty for no picture."""

    question: str
    options: tuple[Option, ...]
    picture: Mapping[str, object] = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class Slip:
    """Wrong entries of a cell, and what is true of whoever makes them."""

    answer: tuple[str, ...]
    says: str


@dataclass(frozen=True)
class Blank:
    """A cell of a table that the student fills: the answers that are right, how far a number may be from them, and slips that
    are known beside those that are computed."""

    right: tuple[str, ...]
    within: str = "0"
    slips: tuple[Slip, ...] = ()


@dataclass(frozen=True)
class Counted:
    """What a column counts: what it asks of a system, as an exercise does ("length", "count a", "strokes"), with values of some
    constants. In the text of the system `{row}` stands for the first cell of a row."""

    system: str = ""
    asks: str = ""
    constants: Mapping[str, object] = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class Table:
    """A table to fill; the first cell of a row names the row, and a cell is a text that is given or a blank.

    What some columns count of a system is in `of`, one entry for each column, or empty.
    """

    id: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str | Blank, ...], ...]
    of: tuple[Counted, ...] = ()

    @property
    def blanks(self) -> tuple[tuple[int, int, Blank], ...]:
        """The blanks, each with its row and its column, row by row."""
        return tuple(
            (row, column, cell)
            for row, cells in enumerate(self.rows)
            for column, cell in enumerate(cells)
            if isinstance(cell, Blank)
        )


@dataclass(frozen=True)
class Asked:
    """A question of `predict`, what its answer is in a few words, and what may be typed for that; nothing where a prediction is
    only set beside the answer. Where the answer has still to be found in what is shown, it comes later, at the second vote."""

    question: str
    answer: str
    right: tuple[str, ...] = ()
    later: bool = False


@dataclass(frozen=True)
class Lesson:
    """A lesson, as it is declared.

    Attributes
    ----------
    name
        The name of its file, of its notebook and of its exercises, without the suffix.
    number, title, question, minutes
        The number with which its name begins, or None; what it is called, what it asks, and how long it takes.
    track
        Letters of `TRACKS`.
    objectives, summary
        What a student can do afterwards, and the lesson in one sentence.
    systems
        The ids of the systems that it teaches.
    points
        The points of the literature that it teaches, each after the number of its work, counted from 000 in the order of the
        catalogue's `WORKS`: "000: columns, centred columns".
    misconceptions
        What students are likely to believe.
    vote, tables, predictions
        What the notebook asks.
    settings
        What its text asks of the sliders of a panel, beside its tables: values that are set together, by the sliders' names.
    accepted
        Advice of `lsys-kit lesson check` that was looked at, and is not to be said again: parts of its sentences.
    language
        The code of the language in which it is written.
    """

    name: str
    number: int | None
    title: str
    question: str
    minutes: int
    track: tuple[str, ...]
    objectives: tuple[str, ...]
    summary: str
    systems: tuple[str, ...]
    points: tuple[str, ...]
    misconceptions: tuple[str, ...]
    vote: Vote | None
    tables: tuple[Table, ...]
    predictions: tuple[Asked, ...] = ()
    settings: tuple[Mapping[str, str], ...] = field(default=(), hash=False)
    accepted: tuple[str, ...] = ()
    language: str = ENGLISH

    @property
    def key(self) -> str:
        """By what notebooks ask for it: "01", or its name where that has no number."""
        return key_of(self.name)


# From the text of a file to the record of its lesson

LETTERS = "ABCDEF"
"""The names of the options of a vote, so many at most."""
FEWEST = 2
"""A vote has so many options at least."""
_ID = re.compile(r"[a-z0-9-]+")
_PICTURE = ("system", "rules", "step", "angle", "cells", "view", "constants")


def lesson_from(name: str, entries: Mapping[str, object]) -> Lesson:
    """The record of a lesson, from the entries of its file."""
    where = f"The lesson {name}"
    _demand(NAME.fullmatch(name), f"{where} must be called by small letters and digits, such as ferns or 01_all_at_once")
    found = _taken(where, entries, _LESSON)
    number, unknown = number_of_name(name), "".join(each for each in found["track"] if each not in TRACKS)
    given = found.pop("number")
    _demand(given in (None, number), f'{where}: "number" must be {number}, as in its name, not {given}')
    _demand(not unknown, f'{where}: "track" has letters of {", ".join(TRACKS)}, not {unknown[:1]}')
    asked = found.pop("vote")
    vote = None if asked is None else _vote(f"{where}, vote", asked)
    tables = _each(f"{where}, table", found.pop("tables"), _table)
    predictions = _each(f"{where}, prediction", found.pop("predictions"), _asked)
    _demand(len({each.id for each in tables}) == len(tables), f"{where}: two tables have the same id")
    settings = _each(f"{where}, settings", found.pop("settings"), _settings)
    return Lesson(name=name, number=number, vote=vote, tables=tables, predictions=predictions, settings=settings, **found)


def number_of_name(name: str) -> int | None:
    """The number with which the name of a lesson begins, or None."""
    return int(name[:2]) if name[:2].isdecimal() else None


def _asked(where: str, entries: object) -> Asked:
    found = _taken(where, entries, _ASKED)
    right = found["right"] or (found["answer"],) * is_number_asked([found["answer"]])
    return Asked(**{**found, "right": right})


def _settings(where: str, row: object) -> dict[str, str]:
    return {name: _numeral(f'{where}, "{name}"', value) for name, value in _entries(where, row).items()}


def _vote(where: str, entries: object) -> Vote:
    found = _taken(where, entries, _VOTE)
    options = _each(f"{where}, option", found["options"], lambda place, each: Option(**_taken(place, each, _OPTION)))
    many, right = len(options), sum(each.right for each in options)
    _demand(FEWEST <= many <= len(LETTERS), f"{where}: there must be {FEWEST} to {len(LETTERS)} options, not {many}")
    _demand(right == 1, f"{where}: one option must have right = true, not {right or 'none'}")
    picture = found["picture"]
    for key in picture:
        _demand(key in _PICTURE, f'{where}: a picture has no "{key}"', f"It may have: {', '.join(_PICTURE)}.")
    one_system = not picture or ("system" in picture) != ("rules" in picture)
    _demand(one_system, f'{where}: a picture needs the id of its "system", or its "rules"')
    _entries(f'{where}, picture, "constants"', picture.get("constants", {}))
    return Vote(found["question"], options, picture)


def _table(where: str, entries: object) -> Table:
    found = _taken(where, entries, _TABLE)
    _demand(_ID.fullmatch(found["id"]), f'{where}: "id" must have small letters, digits and hyphens only')
    columns = found["columns"]
    rows = _each(f"{where}, row", found["rows"], lambda place, cells: _row(place, cells, len(columns)))
    of = _each(f"{where}, of", found["of"], lambda place, each: Counted(**_taken(place, each, _COUNTED)))
    _demand(len(of) in (0, len(columns)), f'{where}: "of" must have an entry for each of the {len(columns)} columns')
    table = Table(found["id"], found["title"], columns, rows, of)
    _demand(table.blanks, f"{where} has no cell to fill", 'A cell to fill is { right = "3" }.')
    return table


def own_table(title: str, columns: object, rows: object, of: object) -> Table:
    """A table that is not in a file.

    Raises
    ------
    ModelValueError
        It has a mistake.
    """
    given = {"id": "own", "title": title, "columns": _listed(columns), "rows": _listed(rows), "of": of}
    try:
        return _table("The table", given)
    except ModelFileError as mistake:
        raise ModelValueError(mistake.message, hint=mistake.hint) from None


def _listed(value: Any) -> Any:
    """Lists and tuples of lists and tuples as lists."""
    return [_listed(each) for each in value] if isinstance(value, list | tuple) else value


def _row(where: str, cells: object, many: int) -> tuple[str | Blank, ...]:
    fits = isinstance(cells, list) and len(cells) == many
    _demand(fits, f"{where} must have {many} cells, one for each column")
    row = _each(f"{where}, column", cells, _cell)
    _demand(isinstance(row[0], str), f"{where}: the first cell names the row and must be given")
    return row


def _cell(where: str, cell: object) -> str | Blank:
    if not isinstance(cell, dict):
        return _text(where, cell)
    found = _taken(where, cell, _BLANK)
    _demand(found["right"] and all(map(str.strip, found["right"])), f'{where}: "right" is empty')
    return Blank(
        **{**found, "slips": _each(f"{where}, slip", found["slips"], lambda at, each: Slip(**_taken(at, each, _SLIP)))}
    )


def _each(where: str, rows: Any, read: Callable[[str, object], object]) -> tuple[Any, ...]:
    """Each of some entries, read; they are counted from 1."""
    return tuple(read(f"{where} {place}", each) for place, each in enumerate(rows, 1))


def _demand(holds: object, message: str, hint: str | None = None) -> None:
    if not holds:
        raise ModelFileError(message, hint=hint)


# What an entry may be


def _fitting(where: str, value: object, fits: bool, what: str) -> object:
    _demand(fits, f"{where} must be {what}, not {shown(value)}")
    return value


def _text(where: str, value: object) -> str:
    """A text; a number is one, too, in a table."""
    fits = isinstance(value, str | int | float) and not isinstance(value, bool) and bool(str(value).strip())
    return str(_fitting(where, value, fits, "a text")).strip()


def _number(where: str, value: object) -> object:
    return _fitting(where, value, type(value) is int and value >= 0, "a whole number")


def _truth(where: str, value: object) -> object:
    return _fitting(where, value, isinstance(value, bool), "true or false")


def _list(where: str, value: object) -> object:
    return _fitting(where, value, isinstance(value, list), "a list")


def _entries(where: str, value: object) -> Any:
    return _fitting(where, value, isinstance(value, dict), "a table of entries")


def _texts(where: str, value: object) -> tuple[str, ...]:
    return _each(f"{where}, entry", _fitting(where, value, isinstance(value, list), "a list of texts"), _text)


def _answers(where: str, value: object) -> tuple[str, ...]:
    return _texts(where, value) if isinstance(value, list) else (_text(where, value),)


def _numeral(where: str, value: object) -> str:
    text = _text(where, value)
    _fitting(where, value, number_of(text) is not None, "a number")
    return text


def _distance(where: str, value: object) -> str:
    text = _numeral(where, value)
    _fitting(where, value, (number_of(text) or 0) >= 0, "a number from 0 on")
    return text


Shape = Mapping[str, tuple[Callable[[str, object], object], object]]
"""For each entry how it is read, and what it is when it is left out; `...` where it may not be left out."""
_LESSON: Shape = {
    "number": (_number, None),
    **dict.fromkeys(("title", "question"), (_text, ...)),
    "minutes": (_number, ...),
    "objectives": (_texts, ...),
    "summary": (_text, ...),
    **dict.fromkeys(("track", "systems", "points", "misconceptions", "accepted"), (_texts, ())),
    "vote": (_entries, None),
    "language": (_text, ENGLISH),
    **dict.fromkeys(("tables", "predictions", "settings"), (_list, [])),
}
_VOTE: Shape = {"question": (_text, ...), "options": (_list, ...), "picture": (_entries, {})}
_OPTION: Shape = {"text": (_text, ...), "reply": (_text, ...), "right": (_truth, False)}
_TABLE: Shape = {"id": (_text, ...), "title": (_text, ...), "columns": (_texts, ...), "rows": (_list, ...), "of": (_list, [])}
_BLANK: Shape = {"right": (_answers, ...), "within": (_distance, "0"), "slips": (_list, [])}
_SLIP: Shape = {"answer": (_answers, ...), "says": (_text, ...)}
_COUNTED: Shape = {"system": (_text, ""), "asks": (_text, ""), "constants": (_entries, {})}
_ASKED: Shape = {"question": (_text, ...), "answer": (_text, ...), "right": (_answers, ()), "later": (_truth, False)}


def _taken(where: str, entries: object, shape: Shape) -> dict[str, Any]:
    """The entries of a shape, each read; none may be unknown."""
    given = _entries(where, entries)
    for key in given:
        _demand(key in shape, f'{where} has an unknown entry "{key}"', f"Entries are: {', '.join(shape)}.")
    for key, (_, default) in shape.items():
        _demand(default is not ... or key in given, f'{where} has no "{key}"')
    return {key: read(f'{where}, "{key}"', given[key]) if key in given else default for key, (read, default) in shape.items()}


# The lessons that are declared


def names() -> tuple[str, ...]:
    """The names of all lessons of the course at hand, in their order."""
    return tuple(name for _, name in course_at_hand().lessons)


def lesson(number: str | int) -> Lesson:
    """The lesson with a number, such as "01", or a name.

    Lessons of the course in which the notebook stands come first.

    >>> lesson("01").title
    'All at once'
    """
    if isinstance(number, bool) or not isinstance(number, str | int):
        raise ModelValueError(f'The number of a lesson must be a text such as "01", not {shown(number)}')
    known = {key_of(name): (place, name) for place in reversed(places()) for name in place.names()}
    asked = str(number).strip() if isinstance(number, str) or 0 <= number < 100 else shown(number)
    asked = key_of(asked.zfill(2) if asked.isdecimal() else asked)
    if asked not in known:
        hint = suggestion(asked[:20], known) or f"Lessons are: {', '.join(sorted(known))}."
        raise ModelNameError(f'There is no lesson "{quotable(asked)}"', hint=hint)
    return declared_in(*known[asked]) or _read(*known[asked])


def table(number: str | int, id: str) -> Table:
    """The table to fill of a lesson that has this id."""
    of = lesson(number)
    known = {each.id: each for each in of.tables}
    if not isinstance(id, str):
        raise ModelValueError(f'The id of a table must be a text such as "steps", not {shown(id)}')
    if id.strip() not in known:
        hint = suggestion(id[:20], known) or f"Its tables are: {', '.join(known)}."
        raise ModelNameError(f'Lesson {of.name if of.number is None else of.number} has no table "{quotable(id)}"', hint=hint)
    return known[id.strip()]


def declared(name: str) -> Lesson:
    """The lesson of a file, by its name without the suffix."""
    return lesson(name)


def declared_in(place: Place, name: str) -> Lesson | None:
    """The lesson of a place, or None where nothing is declared of it; a copy of one of the kit's notebooks is that lesson."""
    if (place.declared / f"{name}.toml").is_file():
        return _read(place, name)
    return None if place.is_kits else declared_in(kit_place(), name)


def translated_lessons(course: Course) -> int:
    """How many lessons of a course are there in the language in which it is opened."""
    found = (declared_in(place, name) for place, name in course.lessons)
    return sum(each is not None and each.language == course.language for each in found)


def all_declared() -> tuple[Lesson, ...]:
    """All lessons that can be read where notebooks look for them."""
    found = list[Lesson]()
    for place in places():
        for name in place.names():
            with suppress(LSystemError):
                found += filter(None, [declared_in(place, name)])
    return tuple(found)


def _read(place: Place, name: str) -> Lesson:
    """The declaration of a lesson, read again when its file has changed."""
    path = place.declared / f"{name}.toml"
    try:
        state = path.lstat()
    except OSError:
        raise ModelFileError(
            f"Nothing is declared of the lesson {name}: there is no file {path.name} beside its notebook",
            hint="lsys-kit lesson new NAME writes one that runs.",
        ) from None
    return _read_as(path, (state.st_mtime_ns, state.st_size))


@lru_cache(maxsize=256)
def _read_as(path: Path, _: object) -> Lesson:
    return lesson_from(path.stem, declaration(path))
