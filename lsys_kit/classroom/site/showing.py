"""In the kernel of a lesson that is run for the site: what a cell shows is not a widget but the data of one.

The first picture of a lesson, a drawing or that of its vote, comes with a small one for the first page. What fails is told: a
notebook would pass over it, and the page would lack it without a word.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Iterator, Mapping
from dataclasses import replace
from typing import Any

from lsys_kit.budget import current, limits
from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import Lesson, all_declared
from lsys_kit.classroom.lessons.predict import Prediction
from lsys_kit.classroom.lessons.rows import set_by
from lsys_kit.classroom.lessons.rule_finder import RuleFinder
from lsys_kit.classroom.lessons.vote import VoteBox, drawn
from lsys_kit.classroom.lessons.widget import html
from lsys_kit.classroom.lessons.worksheet import PanelWithWorksheet, Worksheet
from lsys_kit.classroom.panel.explorer import Comparison, Explorer
from lsys_kit.notation.model.arithmetic import Value, normalised
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.style.themes import DARK, LIGHT, NOTHING

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


SMALL, FAULT = "application/vnd.lsys-kit.small-picture", "application/vnd.lsys-kit.page-fault"
"""The media types of a picture for the first page, in SVG, and of what has failed, in words."""


def show_for_pages(lesson: str = "") -> None:
    """Let this kernel show the widgets of the kit as data for a page; the panels of a lesson hold what it asks for."""
    from IPython.core.interactiveshell import InteractiveShell

    formatter: Any = InteractiveShell.instance().display_formatter
    asking = next((each for each in all_declared() if each.name == lesson), None)
    first = iter([small_picture])  # the first picture alone is made small

    def with_small(shown: dict[str, object], picture: Callable[[], Any]) -> dict[str, object]:
        make = next(first, None)
        return shown if make is None else shown | {SMALL: make(picture())}

    def show_part(widget: object, include: object = None, exclude: object = None) -> dict[str, object]:
        choices = asking.vote.picture if asking and asking.vote and isinstance(widget, VoteBox) else {}
        shown = part(widget, asking)
        return with_small(shown, lambda: drawn(choices)) if choices else shown

    def show_picture(picture: SVGPicture, include: object = None, exclude: object = None) -> dict[str, object]:
        return with_small(picture._repr_mimebundle_(), lambda: picture)

    for kind in KINDS:
        formatter.mimebundle_formatter.for_type(kind, or_fault(show_part))
    formatter.mimebundle_formatter.for_type(SVGPicture, or_fault(show_picture))


def or_fault(show: Callable[..., dict[str, object]]) -> Callable[..., dict[str, object]]:
    """A function that shows something, with what it fails of as what it shows.

    >>> or_fault(lambda widget: 1 / 0)(None)
    {'application/vnd.lsys-kit.page-fault': 'ZeroDivisionError: division by zero', 'text/plain': ''}
    """

    def safely(*given: object, **options: object) -> dict[str, object]:
        try:
            return show(*given, **options)
        except Exception as fault:
            return {FAULT: f"{type(fault).__name__}: {fault}", "text/plain": ""}

    return safely


SMALL_WIDTH, MOST_SHAPES = 320, 20_000
"""The width of a small picture in pixels; one of more shapes is of pixels."""
THEMES = replace(LIGHT, ground=NOTHING), replace(DARK, ground=NOTHING)
_COLOURED = re.compile(r'(fill|stroke|stop-color)="(#[0-9A-Fa-f]{3,8})"')


def small_picture(picture: SVGPicture) -> str:
    """A picture in SVG for the first page, without paper and labels, which is light or dark as the page is.

    >>> from lsys_kit import draw, system
    >>> small_picture(draw(system("J1"), 2)).count("@media (prefers-color-scheme:dark)")
    1
    """
    bare = replace(picture, labels=False, current=None) if isinstance(picture, Picture) else picture
    with limits(segments=min(MOST_SHAPES, current().segments)):
        light, dark = (replace(bare, pixels=(SMALL_WIDTH, None), theme=theme).svg for theme in THEMES)
    return light_or_dark(light, dark)


def light_or_dark(light: str, dark: str) -> str:
    """A light picture that has the colours of a dark one where the page is dark; it stays light where colours part."""
    pairs = [*zip(_COLOURED.findall(light), _COLOURED.findall(dark), strict=False)]
    changed = {before: after[1] for before, after in pairs if before != after}
    if any(changed.get(before, before[1]) != after[1] for before, after in pairs):
        return light
    rules = "".join(f'[{name}="{colour}"]{{{name}:{seen}}}' for (name, colour), seen in changed.items())
    begin, rest = light.split(">", 1)
    return f"{begin}><style>@media (prefers-color-scheme:dark){{{rules}}}</style>{rest}"


def part(widget: object, lesson: Lesson | None = None) -> dict[str, object]:
    """What a page has to know of a widget, by media types.

    >>> from lsys_kit import worksheet
    >>> part(worksheet("01", "counts"))[PART]["kind"]
    'worksheet'
    """
    found = _seen(widget, lesson)
    if isinstance(widget, Prediction):
        found["answer"] = dict(widget.answer)
    return {PART: found, "text/html": html({"text/plain": repr(widget)}), "text/plain": repr(widget)}


def _seen(widget: object, lesson: Lesson | None) -> dict[str, object]:
    return {"kind": next(kind for each, kind in KINDS.items() if isinstance(widget, each)), "data": _data(widget, lesson)}


def _data(widget: Any, lesson: Lesson | None) -> object:
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
