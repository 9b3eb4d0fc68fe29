"""Predict, then reveal: a question with a box, and what answers it appears only after something was typed."""

from __future__ import annotations

from collections.abc import Mapping

import traitlets
from ipywidgets import VBox, Widget

from lsys_kit.classroom.lessons.kept import answered, keep
from lsys_kit.classroom.lessons.opening import announce
from lsys_kit.classroom.lessons.predicted import OPEN, asked_of, key_of, outcome
from lsys_kit.classroom.lessons.widget import (
    MOST_TYPED,
    LessonWidget,
    boxed_html,
    forget_figure,
    media,
    prose_html,
    prose_text,
    widget,
)
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.widget import Unfinalized
from lsys_kit.errors import ModelValueError, shown

_STORED = ("image/svg+xml", "image/png", "text/latex")
"""What a stored notebook keeps of what is revealed, beside its HTML and its text."""


def predict(question: str, what: object) -> Prediction:
    """Ask a question, and show what answers it only after something was typed, or on request.

    Whatever is typed will do: it is kept, and stays beside what is then shown. Of a question of the lessons it is said in a
    few words what came out, too, and again at the second vote.

    Parameters
    ----------
    question
        A sentence; a part between backticks is code.
    what
        Anything that a notebook can show: a panel, a picture, a derivation, a text.

    Raises
    ------
    ModelValueError
        The question is no text.

    Examples
    --------
    >>> predict("How many cells has step 6?", "21 cells")
    How many cells has step 6?
    21 cells
    """
    if not isinstance(question, str) or not question.strip():
        raise ModelValueError(f'A question must be a text such as "How many cells has step 6?", not {shown(question)}')
    found = Prediction(question.strip(), what)
    announce("prediction", question.strip())
    return found


class Prompt(LessonWidget):
    """The question of a prediction, and the box for it.

    Attributes
    ----------
    typed
        The prediction; empty before there is one, or where there was none.
    revealed
        Whether the answer is to be shown.
    outcome
        What came out, in a few words, and whether it was predicted; empty before that, and where it is not known.
    """

    _script_name = "predicting"
    question = traitlets.Unicode().tag(sync=True)
    typed = traitlets.Unicode().tag(sync=True)
    revealed = traitlets.Bool(False).tag(sync=True)
    outcome = traitlets.Dict().tag(sync=True)

    def __init__(self, question: str, what: str = "") -> None:
        self._key = key_of(question, what)
        kept = answered(self._key)
        super().__init__(question=question, typed="".join(kept[:1]), revealed=len(kept) == 1)
        self._tell()
        self.observe(self._tell, ["typed", "revealed"])

    def _tell(self, _: object = None) -> None:
        self.outcome = outcome(self.question, self.typed) if self.revealed else {}
        keep(self._key, [self.typed] if self.revealed else [self.typed, OPEN] if self.typed else [])

    @traitlets.validate("typed")
    def _shortened(self, proposal: traitlets.Bunch) -> str:
        return str(proposal["value"])[:MOST_TYPED]

    def __repr__(self) -> str:
        return prose_text(self.question)


class Prediction(Unfinalized, VBox):  # type: ignore[misc]
    """The question that `predict` asks, and below it, once it is revealed, what answers it.

    Attributes
    ----------
    prompt
        The question and the box: what was typed is `prompt.typed`.
    """

    def __init__(self, question: str, what: object) -> None:
        self._what, self._media, self._shown = what, media(what), tuple[object, ...]()
        self.prompt = Prompt(question, str(self._media["text/plain"]))
        forget_figure(what)
        super().__init__([self.prompt], _dom_classes=("lsys-prediction",))
        self.prompt.observe(self._reveal, "revealed")
        self._reveal()

    def _reveal(self, _: object = None) -> None:
        if self.prompt.revealed and not self._shown:
            self._shown = (widget(self._what),)
        self.children = (self.prompt, *self._shown) if self.prompt.revealed else (self.prompt,)

    @property
    def answer(self) -> Mapping[str, object]:
        """What is shown once it is revealed, by media types."""
        return self._media

    @property
    def page_data(self) -> Data:
        """What a page without a kernel has to know of the question; what answers it stands beside it there."""
        asked = asked_of(self.prompt.question)
        known = {"known": {"answer": asked.answer, "right": list(asked.right), "later": asked.later}} if asked else {}
        return {"question": self.prompt.question, **known}

    def _repr_mimebundle_(self, **options: object) -> Data:
        bundle = super()._repr_mimebundle_(**options)
        pictures = {kind: self._media[kind] for kind in _STORED if kind in self._media}
        asked = (
            {"text/html": boxed_html(f"<p>{prose_html(self.prompt.question)}</p>") + self._media["text/html"]}
            if "text/html" in self._media
            else {}
        )
        return {**dict(bundle or {}), **pictures, **asked, "text/plain": repr(self)}

    def close(self) -> None:
        """Close the question, and what it shows."""
        for each in {self.prompt, *self._shown, *([self._what] if isinstance(self._what, Widget) else [])}:
            each.close()
        super().close()

    def __repr__(self) -> str:
        return f"{self.prompt!r}\n{self._media['text/plain']}"
