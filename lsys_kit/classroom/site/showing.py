"""In the kernel of a lesson that is run for the site: what a cell shows is not a widget but the data of one."""

from __future__ import annotations

from collections.abc import Collection, Iterator, Mapping
from functools import partial
from typing import Any

from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import Lesson, declared, names
from lsys_kit.classroom.lessons.predict import Prediction
from lsys_kit.classroom.lessons.rows import set_by
from lsys_kit.classroom.lessons.rule_finder import RuleFinder
from lsys_kit.classroom.lessons.vote import VoteBox
from lsys_kit.classroom.lessons.widget import html
from lsys_kit.classroom.lessons.worksheet import PanelWithWorksheet, Worksheet
from lsys_kit.classroom.panel.explorer import Comparison, Explorer
from lsys_kit.notation.model.arithmetic import Value, normalised

PART = "application/vnd.lsys-kit.page-part+json"
"""The media type of what a page has to know of a panel, a question or a table to open it: its kind, its data, its words."""
KINDS: Mapping[type, str] = {
    Explorer: "panel",
    Comparison: "comparison",
    VoteBox: "vote",
    Prediction: "prediction",
    Worksheet: "worksheet",
    PanelWithWorksheet: "beside",
    RuleFinder: "rules",
}
"""What the script of a page calls the widgets of the kit."""


def show_for_pages(lesson: str = "") -> None:
    """Let this kernel show the widgets of the kit as data for a page; the panels of a lesson hold what it asks for."""
    from IPython.core.interactiveshell import InteractiveShell

    formatter: Any = InteractiveShell.instance().display_formatter
    asking = declared(lesson) if lesson in names() else None
    for kind in KINDS:
        formatter.mimebundle_formatter.for_type(kind, partial(part, lesson=asking))


def part(widget: Any, include: object = None, exclude: object = None, lesson: Lesson | None = None) -> dict[str, Any]:
    """What a page has to know of a widget, by media types.

    >>> from lsys_kit import worksheet
    >>> part(worksheet("01", "counts"))[PART]["kind"]
    'worksheet'
    """
    found = _seen(widget, lesson)
    if isinstance(widget, Prediction):
        found["answer"] = dict(widget.answer)
    return {PART: found, "text/html": html({"text/plain": repr(widget)}), "text/plain": repr(widget)}


def _seen(widget: Any, lesson: Lesson | None) -> dict[str, Any]:
    return {"kind": next(kind for each, kind in KINDS.items() if isinstance(widget, each)), "data": _data(widget, lesson)}


def _data(widget: Any, lesson: Lesson | None) -> Any:
    if isinstance(widget, PanelWithWorksheet):
        return {"panel": _seen(widget.panel, lesson), "sheet": _data(widget.sheet, lesson)}
    if not isinstance(widget, Explorer | Comparison):
        return widget.page_data
    panels = [widget] if isinstance(widget, Explorer) else [widget.left, widget.right]
    sliders = {"seed", *(name for each in panels for name in each.settings)}
    return widget.page_data([*asked_settings(lesson, sliders)] if lesson else [])


def asked_settings(lesson: Lesson, sliders: Collection[str]) -> Iterator[dict[str, Value]]:
    """What the tables of a lesson say of the sliders of a panel, row by row, and then what its text says.

    A row has the values that stand in it, each in a column whose title has the name of the slider in it, and those that the
    title of the table sets, as in "With dt = 0.8". Settings of the text that name another slider are left out.

    >>> from lsys_kit.classroom.lessons.lesson import lesson
    >>> [*map(str, asked_settings(lesson("11"), ("dt", "t_l")))][6]
    "{'dt': Fraction(4, 5), 't_l': Fraction(1, 10)}"
    >>> [row["w"] for row in asked_settings(lesson("09"), ("w",))]
    [2, 3, 5, 8]
    >>> [*asked_settings(lesson("11"), ("dt", "t_div", "t_l"))][-1].keys()
    dict_keys(['dt', 't_div', 't_l'])
    """
    for table in lesson.tables:
        yield from filter(None, (set_by(table, row, sliders) for row in range(len(table.rows))))
    for together in lesson.settings:
        if set(together) <= set(sliders):
            yield {name: normalised(number_of(text) or 0) for name, text in together.items()}
