"""What the titles and the given cells of a table say of a system: at which step, and with which values of its constants."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator

from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import Table
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.notation.model.arithmetic import Value, normalised

_SET = re.compile(r"\b(\w++) = ([\d./]+\d|\d)")
_STEP = re.compile(r"\bstep (\d+)")
_COUNTED = ("step", "stage")


def set_by(table: Table, row: int, names: Collection[str]) -> dict[str, Value]:
    """The values that a row sets, by the names of constants or sliders.

    They stand in the row, each in a column whose title has the name in it; or the title of the table sets them, as in
    "With dt = 0.8".

    >>> from lsys_kit.classroom.lessons.lesson import table
    >>> set_by(table("09", "turning"), 1, ["w"]), str(set_by(table("11", "ages"), 0, ["dt", "t_l"])["dt"])
    ({'w': 3}, '4/5')
    """
    titled = ((_named(column, names), cell) for column, cell in zip(table.columns, table.rows[row], strict=True))
    cells = [*_SET.findall(prose_text(table.title)), *titled]
    numbers = ((name, number_of(cell)) for name, cell in cells if name in names and isinstance(cell, str))
    return {name: normalised(number) for name, number in numbers if number is not None}


def _named(title: str, names: Collection[str]) -> str:
    return next((word for word in re.findall(r"\w+", prose_text(title)) if word in names), "")


def step_of(table: Table, row: int, column: int) -> int | None:
    """The step of which a cell tells: that of the title of its column, of its row, or of the title of the table.

    >>> from lsys_kit.classroom.lessons.lesson import table
    >>> step_of(table("02", "second-rule"), 0, 2), step_of(table("01", "counts"), 3, 1), step_of(table("11", "slices"), 0, 2)
    (6, 3, 4)
    """
    return next(_steps(table, row, column), None)


def _steps(table: Table, row: int, column: int) -> Iterator[int]:
    yield from map(int, _STEP.findall(prose_text(table.columns[column])))
    for name, cell in zip(table.columns, table.rows[row], strict=True):
        if name in _COUNTED and isinstance(cell, str) and cell.isdecimal():
            yield int(cell)
    yield from map(int, _STEP.findall(prose_text(table.title)))
