"""What a wrong entry of a table shows: the known slips of each cell, with what is true of an entry that equals one.

A table may name slips itself. Where a column counts something of a system, they are those of the exercises: words rewritten one
rule after the other, one step too many, the numbers of all steps added up. Then come the numbers of the cells above, below and
beside; at last slips of reckoning. Of several that make the same entry only the first is said.
"""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import suppress
from dataclasses import dataclass
from fractions import Fraction
from functools import lru_cache

from lsys_kit.budget import limits
from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import shown_by, wrong_answers
from lsys_kit.classroom.exercises.misconceptions.table import MISCONCEPTIONS
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.lessons.entries import is_number_asked, is_right, nouns_in, number_of
from lsys_kit.classroom.lessons.lesson import Blank, Table
from lsys_kit.classroom.lessons.rows import set_by, step_of
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.translation import gettext, language

MOST_ALIKE = 2
"""What belongs in more cells of a row and a column than that is not said to belong in one of them."""
LEAST_COUNTED = 2
"""From this number on one may be off by one."""
NEAR = 3
"""How many times as far off as it may be a number is still near."""


@dataclass(frozen=True)
class Known:
    """An entry that is understood, how far a number may be from it, and what is said of it."""

    answer: str
    says: str
    within: str = "0"


def slips_of(table: Table, number: int) -> tuple[Known, ...]:
    """The slips that are known of a cell that is to be filled, counted from 0; the first that fits an entry is said.

    >>> from lsys_kit.classroom.lessons.lesson import table
    >>> counts = table("01", "counts")
    >>> next(each.says for each in slips_of(counts, 2) if each.answer == "5")
    'Did you write what the modules become behind the old word, or go one step too far, or add up the numbers of all steps?'
    """
    return _slips_of(table, number, language())


@lru_cache(maxsize=2048)
def _slips_of(table: Table, number: int, _: str) -> tuple[Known, ...]:
    blank, found = table.blanks[number][2], list[Known]()
    for each in _all(table, number):
        right = is_right(each.answer, blank.right, blank.within)
        if not right and not any(is_right(each.answer, [other.answer]) and other.within == each.within for other in found):
            found.append(each)
    if number_of(blank.within):
        found.append(Known(blank.right[0], reply("number.close"), f"{NEAR * (number_of(blank.within) or 0)}"))
    return tuple(found)


def _all(table: Table, number: int) -> Iterator[Known]:
    row, column, blank = table.blanks[number]
    yield from (Known(answer, slip.says, blank.within) for slip in blank.slips for answer in slip.answer)
    yield from _of_the_system(table, row, column, blank)
    yield from _of_other_cells(table, row, column, blank)
    if (right := number_of(blank.right[0])) is not None:
        yield from _of_reckoning(table, column, right, blank)


# The slips of exercises


def exercise_of(table: Table, row: int, column: int, at: int | None = None) -> Exercise | None:
    """What a cell asks of a system, as an exercise, perhaps at a step; None where it asks nothing of one."""
    counted, cell = table.of[column] if table.of else None, table.rows[row][column]
    step = step_of(table, row, column) if at is None else at
    if counted is None or not counted.asks or step is None:
        return None
    name = table.rows[row][0]
    assert isinstance(name, str)
    text = counted.system.replace("{row}", prose_text(name))
    constants = [constant.name for constant in system_of(text).constants]
    right, within = (cell.right[0], cell.within) if isinstance(cell, Blank) else (cell, "0")
    return Exercise(
        f"{table.id} {row} {column}",
        table.title,
        "number",
        table.title,
        right,
        "",
        (),
        system=text,
        constants={**set_by(table, row, constants), **{name: number_from(value) for name, value in counted.constants.items()}},
        steps=step,
        asks=counted.asks,
        tolerance=number_from(within),
    )


def _of_the_system(table: Table, row: int, column: int, blank: Blank) -> Iterator[Known]:
    with suppress(LSystemError), limits(modules=20_000, seconds=2):
        if (exercise := exercise_of(table, row, column)) is None:
            return
        for wrong in wrong_answers(exercise):
            yield Known(number_text(wrong.answer), shown_by(exercise, wrong.answer), blank.within)


# Other cells


def _of_other_cells(table: Table, row: int, column: int, blank: Blank) -> Iterator[Known]:
    numbers = is_number_asked(blank.right)
    beside = [(row, each) for each in range(1, len(table.columns)) if each != column]
    above = sorted(((each, column) for each in range(len(table.rows)) if each != row), key=lambda place: abs(place[0] - row))
    values = {place: _value(table.rows[place[0]][place[1]]) for place in (*above, *beside)}
    for place, value in values.items():
        alike = sum(is_right(value, [other]) for other in values.values())
        if alike <= MOST_ALIKE and is_number_asked([value]) == numbers:
            yield Known(value, _belongs(table, row, place))


def _value(cell: str | Blank) -> str:
    return cell.right[0] if isinstance(cell, Blank) else cell


def _belongs(table: Table, row: int, place: tuple[int, int]) -> str:
    if place[0] == row:
        return gettext('That belongs in the column "{column}".', column=prose_text(table.columns[place[1]]))
    name = row_name(table, place[0])
    if place[0] == row - 1:
        return gettext("That belongs to {row}, the row above.", row=name)
    if place[0] == row + 1:
        return gettext("That belongs to {row}, the row below.", row=name)
    return gettext("That belongs to {row}.", row=name)


def row_name(table: Table, row: int) -> str:
    """What a row is called: by the title of its first column, too, where a number stands there.

    >>> from lsys_kit.classroom.lessons.lesson import table
    >>> row_name(table("01", "counts"), 2), row_name(table("02", "rates"), 1)
    ('step 2', 'K5')
    """
    name = prose_text(_value(table.rows[row][0]))
    return f"{prose_text(table.columns[0])} {name}" if is_number_asked([name]) else name


# Slips of reckoning


def _of_reckoning(table: Table, column: int, right: Fraction, blank: Blank) -> Iterator[Known]:
    within, degrees = number_of(blank.within) or 0, "degree" in nouns_in(table.title, table.columns[column])
    if degrees:
        yield from _of_angles(right)
    for digits in (1, 2):
        rounded = Fraction(round(right, digits))
        if rounded and rounded != right:
            yield Known(str(rounded), gettext("That is rounded too far: more digits are needed."))
    if right:
        yield Known(str(-right), gettext("Look at its sign."), blank.within)
        for other in (right * Fraction(10) ** power for power in (1, -1, 2, -2, 3, -3)):
            if right.denominator > 1 or other.denominator > 1:
                yield Known(str(other), gettext("Is the decimal point in the right place?"))
    if right.denominator > 1:
        yield Known(str(1 / right), _explained("number inverted"), str(within / right**2))
    elif right >= LEAST_COUNTED:
        yield from (Known(str(right + by), gettext("That is off by one: count once more.")) for by in (-1, 1))


def _of_angles(right: Fraction) -> Iterator[Known]:
    for by in (180, -180):
        yield Known(str(right + by), gettext("That is the opposite direction."))
    yield Known(str(360 - right), gettext("That is the same turn, taken the other way round."))


def _explained(misconception: str) -> str:
    found = MISCONCEPTIONS[misconception]
    return reply("reply.comes_out", do=gettext(found.do), but=gettext(found.but))
