"""What the widgets of a lesson share: their style, their prose, and what a stored notebook shows of them."""

from __future__ import annotations

import re

import traitlets

from lsys_kit.classroom.exercises.verdict import PLAIN_TEXT
from lsys_kit.classroom.widget import KitWidget
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import gettext

MOST_TYPED = 1_000
"""What is typed into a box is cut off here."""
LABELS = (
    "vote",
    "prediction",
    "table to fill",
    "Show",
    "I have no idea, show me",
    "You said:",
    "You wanted to see it.",
    "Check",
    "Right",
    "Not right",
    "right",
    "not yet",
    "not filled in yet",
    "The kernel does not answer. Run the cell again.",
)
"""What the scripts of questions show by themselves."""
_MARKED = re.compile(r"`([^`]+)`|\*([^*]+)\*")


class LessonWidget(KitWidget):
    """A widget of a lesson."""

    words = traitlets.Dict().tag(sync=True)

    @traitlets.default("words")
    def _translated_labels(self) -> dict[str, str]:
        """The labels that another language has another word for."""
        return {label: gettext(label) for label in LABELS if gettext(label) != label}


def boxed_html(*parts: str) -> str:
    """Parts of HTML in a box in which dollar signs begin no formula."""
    return f'<div class="{PLAIN_TEXT}">{"".join(parts)}</div>'


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
