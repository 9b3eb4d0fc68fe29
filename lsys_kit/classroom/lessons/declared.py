"""The lessons of the course: those that are declared in the folder `data`, by their numbers."""

from __future__ import annotations

import tomllib
from functools import cache
from importlib.resources import files

from lsys_kit.classroom.lessons.declaration import lesson_from
from lsys_kit.classroom.lessons.lesson import Lesson, Table
from lsys_kit.errors import ModelNameError, ModelValueError, quotable, shown
from lsys_kit.notation.analysis.checks import suggestion

FOLDER = files(__package__) / "data"


def names() -> tuple[str, ...]:
    """The names of all lessons, in their order."""
    return tuple(sorted(file.name.removesuffix(".toml") for file in FOLDER.iterdir() if file.name.endswith(".toml")))


def lesson(number: str | int) -> Lesson:
    """The lesson with a number, such as "01".

    Raises
    ------
    ModelNameError
        There is no such lesson.

    Examples
    --------
    >>> lesson("01").title
    'All at once'
    """
    if isinstance(number, bool) or not isinstance(number, str | int):
        raise ModelValueError(f'The number of a lesson must be a text such as "01", not {shown(number)}')
    known = {name[:2]: name for name in names()}
    asked = str(number).strip().zfill(2) if isinstance(number, str) or 0 <= number < 100 else shown(number)
    if asked not in known:
        hint = suggestion(asked[:20], known) or f"Lessons are: {', '.join(known)}."
        raise ModelNameError(f'There is no lesson "{quotable(asked)}"', hint=hint)
    return declared(known[asked])


def table(number: str | int, id: str) -> Table:
    """The table to fill of a lesson that has this id.

    Raises
    ------
    ModelNameError
        There is no such lesson, or it has no such table.
    """
    of = lesson(number)
    known = {each.id: each for each in of.tables}
    if not isinstance(id, str):
        raise ModelValueError(f'The id of a table must be a text such as "steps", not {shown(id)}')
    if id.strip() not in known:
        hint = suggestion(id[:20], known) or f"Its tables are: {', '.join(known)}."
        raise ModelNameError(f'Lesson {of.number} has no table "{quotable(id)}"', hint=hint)
    return known[id.strip()]


@cache
def declared(name: str) -> Lesson:
    """The lesson of a file, by its name without the suffix."""
    return lesson_from(name, tomllib.loads((FOLDER / f"{name}.toml").read_text(encoding="utf-8")))
