"""Worksheets: a table with cells to fill, and a check that says which are right and gives none away."""

from __future__ import annotations

from collections.abc import Sequence
from itertools import islice
from typing import overload

import traitlets
from ipywidgets import HBox, Layout

from lsys_kit.classroom.lessons.lesson import MOST_CHARACTERS, Blank, Table, is_right, table
from lsys_kit.classroom.lessons.widget import LessonWidget, html, prose_html, prose_text, table_html
from lsys_kit.classroom.panel.bundle import Data, bundled, style
from lsys_kit.classroom.panel.explorer import Comparison, Explorer
from lsys_kit.classroom.widget import Unfinalized
from lsys_kit.errors import require
from lsys_kit.translation import gettext, ngettext

RIGHT, NOT_YET, MISSING = "right", "not yet", "not filled in yet"
"""What is said of a cell."""


@overload
def worksheet(number: str, id: str) -> Worksheet: ...
@overload
def worksheet(number: str, id: str, beside: Explorer | Comparison) -> PanelWithWorksheet: ...
def worksheet(number: str, id: str, beside: Explorer | Comparison | None = None) -> Worksheet | PanelWithWorksheet:
    """A table of a lesson, to be filled in and checked cell by cell.

    Parameters
    ----------
    number
        The number of the lesson, such as "01".
    id
        The id of the table.
    beside
        What the table is filled in from: the panel of `explore` or `compare`, which is shown to the left of it where there is
        room, and above it elsewhere.

    Raises
    ------
    ModelNameError
        There is no such lesson, or it has no such table.
    ModelValueError
        What it shall stand beside is no panel.

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
    """
    require(beside, (Explorer, Comparison, type(None)), "A panel of explore or compare")
    sheet = Worksheet(table(number, id))
    return sheet if beside is None else PanelWithWorksheet(beside, sheet)


class Worksheet(LessonWidget):
    """The table that `worksheet` shows.

    Attributes
    ----------
    entries
        What is in the cells to be filled, row by row, when they were last checked.
    """

    _esm = bundled("filling")
    _css = style("lessons")
    sheet = traitlets.Dict().tag(sync=True)
    asked = traitlets.Dict().tag(sync=True)
    result = traitlets.Dict().tag(sync=True)

    def __init__(self, table: Table) -> None:
        self._table = table
        rows = [[None if isinstance(cell, Blank) else cell for cell in row] for row in table.rows]
        super().__init__(sheet={"title": table.title, "columns": list(table.columns), "rows": rows})
        self.observe(self._check, "asked")

    @property
    def entries(self) -> list[str]:
        """What is in the cells to be filled, row by row, when they were last checked."""
        given = [str(each)[: MOST_CHARACTERS + 1] for each in islice(self.asked.get("entries", ()), len(self._table.blanks))]
        return (given + [""] * len(self._table.blanks))[: len(self._table.blanks)]

    @property
    def page_data(self) -> Data:
        """What a page without a kernel has to know: the table, and the right answers, which are no secret there."""
        blanks = [{"right": list(blank.right), "within": blank.within} for _, _, blank in self._table.blanks]
        return {"sheet": self.sheet, "blanks": blanks}

    def _check(self, _: object) -> None:
        marks = marked(self._table, self.entries)
        self.result = {"number": self.asked.get("number", 0), "marks": marks, "text": summary(self._table, marks)}

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
        for each, share in ((panel, "1 1 540px"), (sheet, "0 1 360px")):
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


def marked(table: Table, entries: Sequence[str]) -> list[str]:
    """What is said of each cell that was to be filled.

    >>> marked(table("01", "counts"), ["2", "2", "3", "5"])
    ['right', 'right', 'right', 'not yet', 'not filled in yet', 'not filled in yet', 'not filled in yet', 'not filled in yet']
    """
    given = [*entries, *[""] * len(table.blanks)]
    return [
        MISSING if not entry.strip() else RIGHT if is_right(entry, blank.right, blank.within) else NOT_YET
        for entry, (_, _, blank) in zip(given, table.blanks, strict=False)
    ]


def summary(table: Table, marks: Sequence[str]) -> str:
    """What is said of the whole table: how much is right, and the first cell that is not.

    >>> summary(table("01", "counts"), marked(table("01", "counts"), ["2", "2", "3", "5"]))
    '3 of 8 cells are right, 4 are not filled in yet. Look again at row 2, rule after rule.'
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
    again = gettext("Look again at {place}.", place=_place(table, marks.index(NOT_YET))) if NOT_YET in marks else ""
    return f"{', '.join(parts)}. {again}".rstrip()


def _place(table: Table, number: int) -> str:
    """Where a cell stands, by the names of its row and column."""
    row, column, _ = table.blanks[number]
    name = prose_text(_cell_text(table.rows[row][0]))
    return gettext("row {row}, {column}", row=name, column=prose_text(table.columns[column]))


def _cell_text(cell: str | Blank) -> str:
    return "____" if isinstance(cell, Blank) else cell


def _cell_html(cell: str | Blank) -> str:
    return "&nbsp;" * 8 if isinstance(cell, Blank) else prose_html(cell)
