"""What a lesson is made of beside its notebook: its objectives, its vote and its tables to fill, as they are declared.

Each lesson has a file in the folder `data`, with the name of its notebook. The right answers are in the package, where anybody
can find them; the notebook shows none of them before the student has answered.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

TRACKS: Mapping[str, str] = {"F": "the fast track of 90 minutes", "C": "the core of a semester", "O": "an option"}
"""The ways through the course that a lesson may belong to."""


@dataclass(frozen=True)
class Option:
    """One of the four answers of a vote, and the reply to those who choose it in the end."""

    text: str
    reply: str
    right: bool = False


@dataclass(frozen=True)
class Vote:
    """The question of a vote, its four options, and how its picture is drawn: the arguments of `draw`, with the id of a system
    as `system` or its text as `rules`, the step as `step`, and new values of constants as `constants`; empty for no picture."""

    question: str
    options: tuple[Option, ...]
    picture: Mapping[str, object] = field(default_factory=dict, hash=False)


@dataclass(frozen=True)
class Blank:
    """A cell of a table that the student fills: the answers that are right, and how far a number may be from them."""

    right: tuple[str, ...]
    within: str = "0"


@dataclass(frozen=True)
class Table:
    """A table to fill; the first cell of a row names the row, and a cell is a text that is given or a blank."""

    id: str
    title: str
    columns: tuple[str, ...]
    rows: tuple[tuple[str | Blank, ...], ...]

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
class Lesson:
    """A lesson, as it is declared.

    Attributes
    ----------
    name
        The name of its file, of its notebook and of its exercises, without the suffix.
    number, title, question, minutes
        Its place in the course, what it is called, what it asks, and how long it takes.
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
    vote, tables
        What the notebook asks.
    settings
        What its text asks of the sliders of a panel, beside its tables: values that are set together, by the sliders' names.
    """

    name: str
    number: int
    title: str
    question: str
    minutes: int
    track: tuple[str, ...]
    objectives: tuple[str, ...]
    summary: str
    systems: tuple[str, ...]
    points: tuple[str, ...]
    misconceptions: tuple[str, ...]
    vote: Vote
    tables: tuple[Table, ...]
    settings: tuple[Mapping[str, str], ...] = field(default=(), hash=False)
