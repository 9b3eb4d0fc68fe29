"""In the kernel of a lesson that is run for the site: what a cell shows is not a widget but the data of one."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any

from lsys_kit.classroom.lessons.displayed import html
from lsys_kit.classroom.lessons.predict import Prediction
from lsys_kit.classroom.lessons.vote import VoteBox
from lsys_kit.classroom.lessons.worksheet import Worksheet
from lsys_kit.classroom.panel.comparison import Comparison
from lsys_kit.classroom.panel.explorer import Explorer

PART = "application/vnd.lsys-kit.page-part+json"
"""The media type of what a page has to know of a panel, a vote, a prediction or a table: its kind, its data, its words."""
KINDS: Mapping[type, str] = {Explorer: "panel", Comparison: "comparison", VoteBox: "vote", Prediction: "prediction",
                             Worksheet: "worksheet"}
"""What the script of a page calls the widgets of the kit."""


def show_for_pages() -> None:
    """Let this kernel show the widgets of the kit as data for a page."""
    from IPython.core.interactiveshell import InteractiveShell

    formatter: Any = InteractiveShell.instance().display_formatter
    for kind in KINDS:
        formatter.mimebundle_formatter.for_type(kind, part)


def part(widget: Any, include: object = None, exclude: object = None) -> dict[str, Any]:
    """What a page has to know of a widget, by media types.

    >>> from lsys_kit import worksheet
    >>> part(worksheet("01", "counts"))[PART]["kind"]
    'worksheet'
    """
    found = {"kind": next(kind for each, kind in KINDS.items() if isinstance(widget, each)), "data": widget.page_data}
    if isinstance(widget, Prediction):
        found["answer"] = dict(widget.answer)
    return {PART: found, "text/html": html({"text/plain": repr(widget)}), "text/plain": repr(widget)}
