"""Worksheets: a table with cells to fill, and a check that says which are right and gives none away."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import replace
from itertools import islice
from typing import Any, overload

import traitlets
from ipywidgets import HBox, Layout

from lsys_kit.classroom.exercises.asked import answer_by, asked_system, right_history
from lsys_kit.classroom.exercises.declarations import MOST_STEPS
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.lessons.entries import MOST_CHARACTERS, is_number_asked, is_right, nouns_in, readings
from lsys_kit.classroom.lessons.kept import answered, keep
from lsys_kit.classroom.lessons.lesson import Blank, Table, lesson, own_table, table
from lsys_kit.classroom.lessons.slips import exercise_of, row_name, slips_of
from lsys_kit.classroom.lessons.widget import LessonWidget, html, prose_html, prose_text, table_html
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.panel.explorer import Comparison, Explorer
from lsys_kit.classroom.widget import Unfinalized
from lsys_kit.errors import ModelValueError, quotable, require, shown
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.translation import gettext, ngettext

RIGHT, NOT_YET, NO_NUMBER, MISSING = "right", "not yet", "no number", "not filled in yet"
"""What is said of a cell."""
MOST_NOTES = 3
"""So many notes are shown at once."""


@overload
def worksheet(
    number: str | None = None,
    id: str | None = None,
    beside: None = None,
    *,
    columns: Sequence[str] | None = None,
    rows: Sequence[Sequence[object]] | None = None,
    title: str = "",
    system: LSystem | str | None = None,
) -> Worksheet: ...
@overload
def worksheet(
    number: str | None = None,
    id: str | None = None,
    *,
    beside: Explorer | Comparison,
    columns: Sequence[str] | None = None,
    rows: Sequence[Sequence[object]] | None = None,
    title: str = "",
    system: LSystem | str | None = None,
) -> PanelWithWorksheet: ...
@overload
def worksheet(number: str, id: str, beside: Explorer | Comparison) -> PanelWithWorksheet: ...
def worksheet(
    number: str | None = None,
    id: str | None = None,
    beside: Explorer | Comparison | None = None,
    *,
    columns: Sequence[str] | None = None,
    rows: Sequence[Sequence[object]] | None = None,
    title: str = "",
    system: LSystem | str | None = None,
) -> Worksheet | PanelWithWorksheet:
    """A table to be filled in and checked cell by cell: one of a lesson, or one of your own.

    Parameters
    ----------
    number
        The number of the lesson, such as "01", or its name.
    id
        The id of the table.
    beside
        What the table is filled in from: the panel of `explore` or `compare`, which is shown to the left of it where there is
        room, and above it elsewhere.
    columns, rows, title
        A table of your own. In a row `{"right": 3}` is a cell to fill, perhaps with `"within": 0.01`, and `...` one whose
        number is counted in `system` at the step that stands first in the row.
    system
        A system, or its id; a column is called after the symbol that is counted, or "cells", "modules" or "strokes".

    Raises
    ------
    ModelNameError
        There is no such lesson, or it has no such table.
    ModelValueError
        What it shall stand beside is no panel; or a table of your own has a mistake.

    Examples
    --------
    >>> print(worksheet("01", "counts"))
    How many cells? The rules a -> ab, b -> a, from the axiom a
      step  all at once  rule after rule
      0     1            1
      1     ____         ____
      2     ____         ____
      3     ____         ____
      4     ____         ____
    >>> print(worksheet(columns=["step", "a", "b"], rows=[[0, 1, 0], [5, ..., ...]], system="axiom: a\\na -> ab\\nb -> a"))
    Fill in the table
      step  a     b
      0     1     0
      5     ____  ____
    """
    require(beside, (Explorer, Comparison, type(None)), "A panel of explore or compare")
    if columns is None and rows is None:
        of: Any = number  # what is no text is refused there
        found = table(of, "" if id is None else id)
        sheet = Worksheet(found, f"{lesson(of).key} {found.id}")
    else:
        found = _own_table(
            columns, rows, number if isinstance(title, str) and not title and number is not None else title, system
        )
        sheet = Worksheet(found, f"table {found.title} {' '.join(found.columns)}")
    return sheet if beside is None else PanelWithWorksheet(beside, sheet)


def ask(question: str, system: LSystem | str, count: str = "", step: int | None = None) -> Worksheet:
    """Ask how many modules a step of a system has. What is right, and what wrong answers show, the kit finds by itself.

    Parameters
    ----------
    question
        What is asked, such as "How many cells are there after step 7?".
    system
        A system, or the id of one in the catalogue.
    count
        The symbol that is counted, or "strokes"; by default all modules are.
    step
        The step that is asked for; by default that which the question names.

    Raises
    ------
    ModelValueError
        The question is no text or names no step, or the step has no such number.

    Examples
    --------
    >>> print(ask("How many cells has step 7?", system="axiom: a\\na -> ab\\nb -> a", count="a"))
    How many cells has step 7?
      step  a
      7     ____
    """
    if not isinstance(question, str) or not question.strip():
        raise ModelValueError(f'A question must be a text such as "How many cells has step 7?", not {shown(question)}')
    require(count, str, "The name of a symbol")
    named = _NAMED_STEP.search(question)
    if step is None and named is None:
        raise ModelValueError(
            "The question names no step", hint='Give one: ask(..., step=7), or write "step 7" in the question.'
        )
    wanted = int(named[1]) if step is None and named else step
    if type(wanted) is not int or not 0 <= wanted <= MOST_STEPS:
        raise ModelValueError(f"A step must be a whole number up to {MOST_STEPS:,}, not {shown(wanted)}")
    found = _own_table(["step", count.strip() or "cells"], [[wanted, ...]], question, system)
    return Worksheet(found, f"question {found.title}")


_NAMED_STEP = re.compile(r"\b(?:step|Schritt) (\d{1,5})\b")
_COUNTS: Mapping[str, str] = {**dict.fromkeys(("cells", "modules", "length", "letters"), "length"), "strokes": "strokes"}
"""What columns count that are not called after a symbol."""


def _own_table(columns: object, rows: object, title: object, system: object) -> Table:
    """A table of somebody's own, with the cells filled that are counted in a system."""
    if isinstance(columns, str) or not isinstance(columns, Sequence) or isinstance(rows, str) or not isinstance(rows, Sequence):
        raise ModelValueError(
            "A table needs columns and rows", hint='As in columns=["step", "cells"], rows=[[0, 1], [1, {"right": 2}]].'
        )
    require(title, str, "A title")
    require(system, (LSystem, str, type(None)), "A system, or its id")
    counted = system is not None
    text = str(system) if counted else ""
    asked = ({"system": text, "asks": _COUNTS.get(str(each), f"count {each}")} for each in columns[1:])
    of: list[dict[str, str]] = [{}, *asked] if counted else []
    table = own_table(str(title).strip() or gettext("Fill in the table"), columns, [*map(_row, rows)], of)
    filled = (tuple(_answered(table, row, column) for column in range(len(table.columns))) for row in range(len(table.rows)))
    return replace(table, rows=tuple(filled))


def _row(cells: object) -> object:
    """A row as a file has it; a cell whose number is counted has no answer yet."""
    if isinstance(cells, str) or not isinstance(cells, Sequence):
        return cells
    return [{"right": COUNTED} if each is ... else each for each in cells]


def _is_nowhere(asked: Exercise) -> bool:
    """Whether the symbol that is counted is none of the system, as when it is mistyped."""
    counted = asked.asks.removeprefix("count ")
    return counted not in (asked.asks, *symbols(asked_system(asked)))


COUNTED = "..."
"""In place of the answer of a cell that is counted."""


def _answered(table: Table, row: int, column: int) -> str | Blank:
    cell = table.rows[row][column]
    if not isinstance(cell, Blank) or cell.right != (COUNTED,):
        return cell
    name = table.rows[row][0]
    if not table.of:
        raise ModelValueError(
            "Nothing is known of a cell that is ...", hint='Give the system that it counts in, or {"right": 3}.'
        )
    if not (isinstance(name, str) and name.isascii() and name.isdecimal() and len(name) < 6):
        raise ModelValueError(f'The first cell of the row must be a step, not "{quotable(str(name))}"')
    asked = exercise_of(table, row, column, int(name))
    answer = None if asked is None else answer_by(asked, right_history(asked))
    if answer is None or (answer == 0 and asked is not None and _is_nowhere(asked)):
        raise ModelValueError(f'"{quotable(table.columns[column])}" cannot be counted in this system')
    return replace(cell, right=(str(answer),))


class Worksheet(LessonWidget):
    """The table that `worksheet` shows.

    What is typed into it is kept, with the first entry of each cell that was checked.

    Attributes
    ----------
    typed
        What is in the cells to be filled, row by row.
    entries
        What was in them when they were last checked.
    """

    _script_name = "filling"
    sheet = traitlets.Dict().tag(sync=True)
    typed: traitlets.List[object] = traitlets.List().tag(sync=True)
    asked = traitlets.Dict().tag(sync=True)
    result = traitlets.Dict().tag(sync=True)

    def __init__(self, table: Table, name: str = "") -> None:
        self._table, self._name = table, name
        rows = [[None if isinstance(cell, Blank) else cell for cell in row] for row in table.rows]
        typed, checked = (self._fitting(self._kept(what)) for what in ("typed", "checked"))
        super().__init__(sheet={"title": table.title, "columns": list(table.columns), "rows": rows}, typed=typed)
        self.observe(self._check, "asked")
        self.observe(self._keep_typed, "typed")
        if any(checked):
            self.asked = {"number": 0, "entries": checked}

    @property
    def entries(self) -> list[str]:
        """What was in the cells to be filled, row by row, when they were last checked."""
        return self._fitting(self.asked.get("entries", ()))

    @property
    def page_data(self) -> Data:
        """What a page without a kernel has to know: the table, and the right answers and known slips, no secret there."""
        slips = [slips_of(self._table, number) for number in range(len(self._table.blanks))]
        says = list(dict.fromkeys(each.says for known in slips for each in known))
        blanks = [
            {
                "right": list(blank.right),
                "within": blank.within,
                "slips": [[each.answer, each.within, says.index(each.says)] for each in known],
            }
            for (_, _, blank), known in zip(self._table.blanks, slips, strict=True)
        ]
        return {"sheet": self.sheet, "blanks": blanks, "says": says}

    def _fitting(self, given: Iterable[object]) -> list[str]:
        """Texts for the cells to be filled, so many as there are."""
        texts = [str(each)[: MOST_CHARACTERS + 1] for each in islice(given, len(self._table.blanks))]
        return texts + [""] * (len(self._table.blanks) - len(texts))

    def _kept(self, what: str) -> tuple[str, ...]:
        return answered(f"{self._name} {what}") if self._name else ()

    def _keep(self, what: str, entries: Sequence[str]) -> None:
        if self._name:
            keep(f"{self._name} {what}", entries if any(entries) else ())

    def _keep_typed(self, _: object) -> None:
        self._keep("typed", self._fitting(self.typed))

    def _check(self, _: object) -> None:
        first = [before or now for before, now in zip(self._first(), self.entries, strict=True)] if self.asked else ()
        self._keep("checked", self.entries)
        self._keep("first", first)
        number = self.asked.get("number", 0)
        self.result = {"number": number, "first": first, **checked(self._table, self.entries)} if self.asked else {}

    def _first(self) -> list[str]:
        return self._fitting(self.result.get("first", ()) or self._kept("first"))

    def _stored(self) -> Data:
        rows = (map(_cell_html, row) for row in self._table.rows)
        title = f"<caption>{prose_html(self._table.title)}</caption>"
        return {"text/html": table_html(map(prose_html, self._table.columns), rows, title), "text/plain": repr(self)}

    def __repr__(self) -> str:
        cells = [self._table.columns, *([_cell_text(cell) for cell in row] for row in self._table.rows)]
        texts = [[prose_text(cell) for cell in row] for row in cells]
        widths = [max(map(len, column)) for column in zip(*texts, strict=True)]
        lines = ("  ".join(cell.ljust(width) for cell, width in zip(row, widths, strict=True)).rstrip() for row in texts)
        return "\n".join([prose_text(self._table.title), *(f"  {line}" for line in lines)])


class PanelWithWorksheet(Unfinalized, HBox):  # type: ignore[misc]
    """A panel, and beside it a table that is filled in from what it shows.

    Attributes
    ----------
    panel
        The panel, as `explore` or `compare` makes it.
    sheet
        The table.
    """

    def __init__(self, panel: Explorer | Comparison, sheet: Worksheet) -> None:
        self.panel, self.sheet = panel, sheet
        for each, share in ((panel, "99 1 540px"), (sheet, "1 1 334px")):
            each.layout.flex, each.layout.min_width = share, "0"
        super().__init__([panel, sheet], layout=Layout(flex_flow="row wrap", align_items="flex-start", grid_gap="0 12px"))

    def _repr_mimebundle_(self, **options: object) -> Data:
        panel, sheet = self.panel._stored(), self.sheet._stored()
        return {
            **dict(super()._repr_mimebundle_(**options) or {}),
            "text/html": html(panel) + sheet["text/html"],
            "text/plain": repr(self),
        }

    def close(self) -> None:
        """Close the panel and the table, and what the browser keeps of them."""
        for each in (self.panel, self.sheet):
            each.close()
        super().close()

    def __repr__(self) -> str:
        return f"{self.panel!r}\n{self.sheet!r}"


def checked(table: Table, entries: Sequence[str]) -> Data:
    """What is said of each cell and of the whole table, and notes on wrong cells: what their entries show.

    >>> found = checked(table("01", "counts"), ["2", "2", "3", "9"])
    >>> found["text"]
    '3 of 8 cells are right, 4 are not filled in yet.'
    >>> found["notes"]
    ['step 2, rule after rule: That is what comes out if you write what the modules become behind the old word. A step \
replaces the whole word: nothing of the old one is left beside the new.']
    """
    marks = marked(table, entries)
    notes, unexplained = _notes(table, entries, marks)
    return {"marks": marks, "text": summary(table, marks, unexplained), "notes": notes}


def marked(table: Table, entries: Sequence[str]) -> list[str]:
    """What is said of each cell that was to be filled.

    >>> marked(table("01", "counts"), ["2", "2", "3", "abc"])[:5]
    ['right', 'right', 'right', 'no number', 'not filled in yet']
    """
    given = [*entries, *[""] * len(table.blanks)]
    return [_mark(table, number, entry) for number, entry in zip(range(len(table.blanks)), given, strict=False)]


def _mark(table: Table, number: int, entry: str) -> str:
    blank, nouns = table.blanks[number][2], nouns_of(table)
    if not entry.strip():
        return MISSING
    if is_right(entry, blank.right, blank.within, nouns):
        return RIGHT
    return NOT_YET if readings(entry, nouns) or not is_number_asked(blank.right) else NO_NUMBER


def nouns_of(table: Table) -> frozenset[str]:
    """What may stand behind a number in a table: the words of its titles."""
    return nouns_in(table.title, *table.columns)


def _notes(table: Table, entries: Sequence[str], marks: Sequence[str]) -> tuple[list[str], list[int]]:
    """What the entries of wrong cells show, each note with its cells; and the wrong cells of which nothing is known."""
    places: dict[str, list[str]] = {}
    unexplained: list[int] = []
    for number, mark in enumerate(marks):
        if mark in (RIGHT, MISSING):
            continue
        if says := _shown(table, number, entries[number], mark):
            places.setdefault(says, []).append(_place(table, number))
        else:
            unexplained.append(number)
    notes = [f"{'; '.join(where)}: {says}" for says, where in islice(places.items(), MOST_NOTES)]
    return notes, unexplained


def _shown(table: Table, number: int, entry: str, mark: str) -> str:
    blank, nouns = table.blanks[number][2], nouns_of(table)
    if mark == NO_NUMBER:
        return gettext("That cannot be read as a number. Write it in digits, such as 21, 0.5 or 3/4.")
    if {*blank.right} & {"yes", "no"} and not is_right(entry, ["yes", "no"]):
        return gettext('Answer "yes" or "no".')
    return next((known.says for known in slips_of(table, number) if is_right(entry, [known.answer], known.within, nouns)), "")


def summary(table: Table, marks: Sequence[str], unexplained: Sequence[int] = ()) -> str:
    """What is said of the whole table: how much is right, and the first wrong cell of which nothing else is said.

    >>> summary(table("01", "counts"), marked(table("01", "counts"), ["2", "2", "3", "77"]), [3])
    '3 of 8 cells are right, 4 are not filled in yet. Look again at step 2, rule after rule.'
    """
    right, missing, total = marks.count(RIGHT), marks.count(MISSING), len(marks)
    if right == total:
        return gettext("All cells are right.") if total > 1 else gettext("The cell is right.")
    parts = [
        ngettext("{number} of {total} cells is right", "{number} of {total} cells are right", right, total=total)
        if total > 1
        else gettext("0 of 1 cell is right")
    ]
    if missing:
        parts.append(ngettext("{number} is not filled in yet", "{number} are not filled in yet", missing))
    again = gettext("Look again at {place}.", place=_place(table, unexplained[0])) if unexplained else ""
    return f"{', '.join(parts)}. {again}".rstrip()


def _place(table: Table, number: int) -> str:
    """Where a cell stands, by the names of its row and column."""
    row, column, _ = table.blanks[number]
    return f"{row_name(table, row)}, {prose_text(table.columns[column])}"


def _cell_text(cell: str | Blank) -> str:
    return "____" if isinstance(cell, Blank) else cell


def _cell_html(cell: str | Blank) -> str:
    return "&nbsp;" * 8 if isinstance(cell, Blank) else prose_html(cell)
