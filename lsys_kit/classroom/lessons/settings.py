"""Which settings of a panel a lesson asks for: in its tables, where a column that is named after a slider lists its values,
and in its text, of which it declares them."""

from __future__ import annotations

import re
from collections.abc import Collection, Iterator, Sequence

from lsys_kit.classroom.lessons.answers import number_of
from lsys_kit.classroom.lessons.lesson import Lesson
from lsys_kit.classroom.lessons.widget import prose_text
from lsys_kit.notation.model.arithmetic import Value, normalised

_SET = re.compile(r"\b(\w++) = ([\d./]+\d|\d)")


def asked_settings(lesson: Lesson, sliders: Collection[str]) -> Iterator[dict[str, Value]]:
    """What the tables of a lesson say of the sliders of a panel, row by row, and then what its text says.

    Parameters
    ----------
    lesson
        The lesson.
    sliders
        The names of the sliders.

    Yields
    ------
    dict
        Values of sliders: those that stand in the row, each in a column whose title has the name of the slider in it, and those
        that the title of the table sets, as in "With dt = 0.8". Settings of the text that name another slider are left out.

    Examples
    --------
    >>> from lsys_kit.classroom.lessons.declared import lesson
    >>> [*map(str, asked_settings(lesson("11"), ("dt", "t_l")))][6]
    "{'dt': Fraction(4, 5), 't_l': Fraction(1, 10)}"
    >>> [row["w"] for row in asked_settings(lesson("09"), ("w",))]
    [2, 3, 5, 8]
    >>> [*asked_settings(lesson("11"), ("dt", "t_div", "t_l"))][-1].keys()
    dict_keys(['dt', 't_div', 't_l'])
    """
    for table in lesson.tables:
        for row in table.rows:
            titled = ((_named(column, sliders), cell) for column, cell in zip(table.columns, row, strict=True))
            found = _values([*_SET.findall(prose_text(table.title)), *titled], sliders)
            if found:
                yield found
    for together in lesson.settings:
        if set(together) <= set(sliders):
            yield _values([*together.items()], sliders)


def _named(title: str, sliders: Collection[str]) -> str:
    """The first slider that is named in the title of a column; "" where none is."""
    return next((word for word in re.findall(r"\w+", prose_text(title)) if word in sliders), "")


def _values(cells: Sequence[tuple[str, object]], sliders: Collection[str]) -> dict[str, Value]:
    """The numbers among the cells of sliders."""
    numbers = ((name, number_of(cell)) for name, cell in cells if name in sliders and isinstance(cell, str))
    return {name: normalised(number) for name, number in numbers if number is not None}
