"""From the text of a lesson's file to its record; what is missing or does not fit is an error that names its place."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from fractions import Fraction
from typing import Any

from lsys_kit.classroom.lessons.answers import number_of
from lsys_kit.classroom.lessons.lesson import TRACKS, Blank, Lesson, Option, Table, Vote
from lsys_kit.errors import ModelFileError, shown

OPTIONS = 4
"""How many options a vote has."""
_NAME = re.compile(r"\d\d_[a-z0-9_]+")
_ID = re.compile(r"[a-z0-9-]+")
_PICTURE = ("system", "rules", "step", "angle", "cells", "view", "constants")


def lesson_from(name: str, entries: Mapping[str, Any]) -> Lesson:
    """The record of a lesson, from the entries of its file.

    Raises
    ------
    ModelFileError
        An entry is missing, unknown or not what it should be.
    """
    where = f"The lesson {name}"
    if not _NAME.fullmatch(name):
        raise ModelFileError(f"{where} must be called by two digits and small letters, such as 01_all_at_once")
    found = _taken(where, entries, _LESSON)
    if found["number"] != int(name[:2]):
        raise ModelFileError(f'{where}: "number" must be {int(name[:2])}, as in its name, not {found["number"]}')
    if unknown := [each for each in found["track"] if each not in TRACKS]:
        raise ModelFileError(f'{where}: "track" has letters of {", ".join(TRACKS)}, not {unknown[0]}')
    vote = _vote(f"{where}, vote", found.pop("vote"))
    tables = tuple(_table(f"{where}, table {place}", each) for place, each in enumerate(found.pop("tables"), 1))
    if len({each.id for each in tables}) < len(tables):
        raise ModelFileError(f"{where}: two tables have the same id")
    rows = found.pop("settings")
    settings = tuple(_settings(f"{where}, settings {place}", each) for place, each in enumerate(rows, 1))
    return Lesson(name=name, vote=vote, tables=tables, settings=settings, **found)


def _settings(where: str, row: object) -> dict[str, str]:
    return {name: _numeral(f'{where}, "{name}"', value) for name, value in _entries(where, row).items()}


def _vote(where: str, entries: Mapping[str, Any]) -> Vote:
    found = _taken(where, entries, _VOTE)
    options = tuple(
        Option(**_taken(f"{where}, option {place}", each, _OPTION)) for place, each in enumerate(found["options"], 1)
    )
    if len(options) != OPTIONS or sum(each.right for each in options) != 1:
        raise ModelFileError(f"{where}: there must be {OPTIONS} options, and one of them must have right = true")
    if unknown := [key for key in found["picture"] if key not in _PICTURE]:
        raise ModelFileError(f'{where}: a picture has no "{unknown[0]}"', hint=f"It may have: {', '.join(_PICTURE)}.")
    if found["picture"] and ("system" in found["picture"]) == ("rules" in found["picture"]):
        raise ModelFileError(f'{where}: a picture needs the id of its "system", or its "rules"')
    _entries(f'{where}, picture, "constants"', found["picture"].get("constants", {}))
    return Vote(found["question"], options, found["picture"])


def _table(where: str, entries: Mapping[str, Any]) -> Table:
    found = _taken(where, entries, _TABLE)
    if not _ID.fullmatch(found["id"]):
        raise ModelFileError(f'{where}: "id" must have small letters, digits and hyphens only')
    rows = tuple(_row(f"{where}, row {place}", each, found["columns"]) for place, each in enumerate(found["rows"], 1))
    table = Table(found["id"], found["title"], found["columns"], rows)
    if not table.blanks:
        raise ModelFileError(f"{where} has no cell to fill", hint='A cell to fill is { right = "3" }.')
    return table


def _row(where: str, cells: object, columns: Sequence[str]) -> tuple[str | Blank, ...]:
    if not isinstance(cells, list) or len(cells) != len(columns):
        raise ModelFileError(f"{where} must have {len(columns)} cells, one for each column")
    row = tuple(_cell(f"{where}, column {place}", each) for place, each in enumerate(cells, 1))
    if isinstance(row[0], Blank):
        raise ModelFileError(f"{where}: the first cell names the row and must be given")
    return row


def _cell(where: str, cell: object) -> str | Blank:
    if not isinstance(cell, dict):
        return _text(where, cell)
    found = _taken(where, cell, _BLANK)
    if not found["right"] or not all(map(str.strip, found["right"])):
        raise ModelFileError(f'{where}: "right" is empty')
    return Blank(**found)


# What an entry may be


def _text(where: str, value: object) -> str:
    """A text; a number is one, too, in a table."""
    if isinstance(value, bool) or not isinstance(value, str | int | float) or not str(value).strip():
        raise ModelFileError(f"{where} must be a text, not {shown(value)}")
    return str(value).strip()


def _number(where: str, value: object) -> int:
    if isinstance(value, bool) or not isinstance(value, int) or value < 0:
        raise ModelFileError(f"{where} must be a whole number, not {shown(value)}")
    return value


def _truth(where: str, value: object) -> bool:
    if not isinstance(value, bool):
        raise ModelFileError(f"{where} must be true or false, not {shown(value)}")
    return value


def _texts(where: str, value: object) -> tuple[str, ...]:
    if not isinstance(value, list):
        raise ModelFileError(f"{where} must be a list of texts, not {shown(value)}")
    return tuple(_text(f"{where}, entry {place}", each) for place, each in enumerate(value, 1))


def _answers(where: str, value: object) -> tuple[str, ...]:
    """One right answer, or a list of them."""
    return _texts(where, value) if isinstance(value, list) else (_text(where, value),)


def _distance(where: str, value: object) -> str:
    text = _numeral(where, value)
    if Fraction(number_of(text) or 0) < 0:
        raise ModelFileError(f"{where} must be a number from 0 on, not {shown(value)}")
    return text


def _numeral(where: str, value: object) -> str:
    text = _text(where, value)
    if number_of(text) is None:
        raise ModelFileError(f"{where} must be a number, not {shown(value)}")
    return text


def _list(where: str, value: object) -> list[Any]:
    if not isinstance(value, list):
        raise ModelFileError(f"{where} must be a list, not {shown(value)}")
    return value


def _entries(where: str, value: object) -> dict[str, Any]:
    if not isinstance(value, dict):
        raise ModelFileError(f"{where} must be a table of entries, not {shown(value)}")
    return value


Shape = Mapping[str, tuple[Callable[[str, object], Any], Any]]
"""For each entry how it is read, and what it is when it is left out; `...` where it may not be left out."""
_LESSON: Shape = {
    "number": (_number, ...),
    "title": (_text, ...),
    "question": (_text, ...),
    "minutes": (_number, ...),
    "track": (_texts, ...),
    "objectives": (_texts, ...),
    "summary": (_text, ...),
    "systems": (_texts, ...),
    "points": (_texts, ...),
    "misconceptions": (_texts, ...),
    "vote": (_entries, ...),
    "tables": (_list, ...),
    "settings": (_list, []),
}
_VOTE: Shape = {"question": (_text, ...), "options": (_list, ...), "picture": (_entries, {})}
_OPTION: Shape = {"text": (_text, ...), "reply": (_text, ...), "right": (_truth, False)}
_TABLE: Shape = {"id": (_text, ...), "title": (_text, ...), "columns": (_texts, ...), "rows": (_list, ...)}
_BLANK: Shape = {"right": (_answers, ...), "within": (_distance, "0")}


def _taken(where: str, entries: object, shape: Shape) -> dict[str, Any]:
    """The entries of a shape, each read; none may be unknown."""
    given = _entries(where, entries)
    for key in given:
        if key not in shape:
            raise ModelFileError(f'{where} has an unknown entry "{key}"', hint=f"Entries are: {', '.join(shape)}.")
    for key, (_, default) in shape.items():
        if default is ... and key not in given:
            raise ModelFileError(f'{where} has no "{key}"')
    return {key: read(f'{where}, "{key}"', given[key]) if key in given else default for key, (read, default) in shape.items()}
