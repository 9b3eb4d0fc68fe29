"""What the widgets of a lesson share: their style, their prose, and what a notebook shows of anything else."""

from __future__ import annotations

import base64
import re
import sys
from collections.abc import Iterable, Mapping
from typing import Any

import traitlets
from ipywidgets import HTML, HTMLMath, Widget

from lsys_kit.budget import Task
from lsys_kit.classroom.exercises.verdict import PLAIN_TEXT
from lsys_kit.classroom.panel.bundle import Data, translated_words
from lsys_kit.classroom.panel.widget_scripts import ScriptedWidget
from lsys_kit.errors import shown
from lsys_kit.files import Entries
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.supervision import supervised

MOST_TYPED = 1_000
"""What is typed into a box is cut off here."""
_MARKED = re.compile(r"`([^`]+)`|\*([^*]+)\*")


class LessonWidget(ScriptedWidget):
    """A widget of a lesson."""

    _style_name = "lessons"
    words = traitlets.Dict().tag(sync=True)

    @traitlets.default("words")
    def _translated_labels(self) -> dict[str, str]:
        return translated_words("filling", "predicting", "voting")


def boxed_html(*parts: str) -> str:
    """Parts of HTML in a box in which dollar signs begin no formula."""
    return f'<div class="{PLAIN_TEXT}">{"".join(parts)}</div>'


def table_html(head: Iterable[str], rows: Iterable[Iterable[str]], caption: str = "") -> str:
    """A table of cells that are HTML, in a box."""
    columns = "".join(f"<th>{each}</th>" for each in head)
    body = "".join("<tr>" + "".join(f"<td>{cell}</td>" for cell in row) + "</tr>" for row in rows)
    return boxed_html(f"<table>{caption}<thead><tr>{columns}</tr></thead><tbody>{body}</tbody></table>")


def prose_html(text: str) -> str:
    """A text as HTML; a part between backticks is code, and one between asterisks is emphasised.

    >>> prose_html("What does `F[+F]` make in *Anabaena* < 5?")
    'What does <code>F[+F]</code> make in <i>Anabaena</i> &lt; 5?'
    """
    return _MARKED.sub(lambda found: f"<code>{found[1]}</code>" if found[1] else f"<i>{found[2]}</i>", escaped(text))


def prose_text(text: str) -> str:
    """A text without those marks.

    >>> prose_text("What does `F[+F]` make in *Anabaena*?")
    'What does F[+F] make in Anabaena?'
    """
    return _MARKED.sub(r"\1\2", text)


_IMAGES: Mapping[str, str] = {"image/svg+xml": "svg+xml", "image/png": "png", "image/jpeg": "jpeg"}
_STYLE = "line-height:1.4;overflow-x:auto;margin:4px 0;white-space:pre-wrap;word-break:normal;overflow-wrap:anywhere"


def media(what: object) -> Data:
    """What a notebook would show of an object, by media types; a text stands for itself.

    >>> media("21 cells")
    {'text/plain': '21 cells'}
    """
    if isinstance(what, str):
        return {"text/plain": what}
    from IPython.core.formatters import DisplayFormatter
    from IPython.core.interactiveshell import InteractiveShell

    formatter: Any = InteractiveShell.instance().display_formatter if InteractiveShell.initialized() else DisplayFormatter()
    if _is_the_kits(what):  # which looks at budgets of its own
        data, _ = formatter.format(what)
    else:
        with Task("It was not shown"), supervised():
            data, _ = formatter.format(what)
        data = {kind: value for kind, value in data.items() if kind != "text/html"}
    if not data:  # of what cannot be written
        return {"text/plain": shown(what)}
    return {kind: base64.b64encode(value).decode() if isinstance(value, bytes) else value for kind, value in data.items()}


def widget(what: object) -> object:
    """The widget that shows an object; a widget shows itself."""
    if isinstance(what, Widget):
        return what
    data = media(what)
    if "text/html" in data or "text/latex" not in data:
        as_in_a_notebook = ("jp-RenderedHTMLCommon",) if "text/html" in data else ()
        return HTML(html(data), _dom_classes=as_in_a_notebook)
    return HTMLMath(f"<div>{escaped(data['text/latex'])}</div>")


def html(data: Entries) -> str:
    """What is shown by media types, as HTML: the kit's own HTML, else a picture, else the text."""
    if "text/html" in data:
        return str(data["text/html"])
    for kind, form in _IMAGES.items():
        if kind in data:
            return _image(form, data[kind], data["text/plain"])
    return f'<pre class="{PLAIN_TEXT}" style="{_STYLE}">{escaped_lines(data["text/plain"])}</pre>'


def escaped_lines(text: str) -> str:
    """A text of several lines, as it may stand in HTML."""
    return "\n".join(map(escaped, str(text).split("\n")))


def forget_figure(what: object) -> None:
    """Take a figure from those that matplotlib shows at the end of a cell by itself, so that it is not seen too early."""
    pyplot = sys.modules.get("matplotlib.pyplot")
    if pyplot is not None and type(what).__module__.startswith("matplotlib."):
        pyplot.close(getattr(what, "figure", what))


def _image(form: str, data: str, text: str) -> str:
    packed = base64.b64encode(data.encode()).decode() if form == "svg+xml" else "".join(data.split())
    return f'<img alt="{escaped(text)}" style="max-width:100%" src="data:image/{form};base64,{packed}">'


def _is_the_kits(what: object) -> bool:
    return type(what).__module__.split(".")[0] == "lsys_kit"
