"""Verdicts: what a check says, as a sentence, as a box in a notebook, and as a score."""

from __future__ import annotations

import base64
from collections.abc import Mapping
from html import unescape

from lsys_kit.errors import require
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.pictures.style.palette import BLUE, GREEN, INK, ORANGE, PAPER, QUIET
from lsys_kit.translation import gettext

SIGNS_AND_COLOURS: Mapping[str, tuple[str, str]] = {
    "Correct": ("✓", GREEN),
    "Almost": ("≈", ORANGE),
    "Not yet": ("✗", ORANGE),
    "Not readable yet": ("?", ORANGE),
    "Not answered yet": ("○", QUIET),
    "Hint": ("→", BLUE),
}
"""For each verdict its sign and its colour; the meaning never depends on the colour alone."""
THEMED = f"background:var(--jp-layout-color0,{PAPER});color:var(--jp-ui-font-color0,{INK})"
"""The paper and the ink of JupyterLab's theme, where there is one."""


PLAIN_TEXT = "mathjax_ignore tex2jax_ignore"
"""The classes of HTML in which dollar signs begin no formula: those of MathJax 3, which notebooks use, and of its version 2,
which web pages made of notebooks use."""


class Verdict(float):
    """A score from 0 to 1 that is displayed as a sentence.

    Attributes
    ----------
    said
        "Correct", "Almost", "Not yet", "Not readable yet", "Not answered yet" or "Hint"; displayed in the chosen language.
    message
        The reply to the answer; lines that begin with two blanks quote it.
    picture
        What is drawn beside it, as SVG text, or empty.

    Examples
    --------
    >>> Verdict("Almost", "You counted one step too few: step 0 is the axiom itself.")
    Almost. You counted one step too few: step 0 is the axiom itself.
    >>> Verdict("Correct") + 0
    1.0
    """

    __slots__ = ("message", "picture", "said")
    said: str
    message: str
    picture: str

    def __new__(cls, said: str, message: str = "", score: float | None = None, picture: str = "") -> Verdict:
        """A verdict; without a score it is 1 where the answer is correct, else 0."""
        verdict = super().__new__(cls, (said == "Correct") if score is None else score)
        verdict.said, verdict.message, verdict.picture = said, message, picture
        return verdict

    def with_more(self, more: str, picture: str = "") -> Verdict:
        """The same verdict with more to say, or to show.

        >>> Verdict("Correct").with_more("Well done.")
        Correct. Well done.
        """
        require(more, str, "A text")
        require(picture, str, "A picture as SVG")
        return Verdict(self.said, f"{self.message}\n{more}".strip(), float(self), picture or self.picture)

    @property
    def described(self) -> str:
        """The text alternative of the picture, or empty."""
        return unescape(self.picture.partition('aria-label="')[2].partition('"')[0])

    def __repr__(self) -> str:
        return f"{gettext(self.said)}. {self.message}".rstrip()

    __str__ = __repr__

    def _repr_html_(self) -> str:
        """The box: a sign, a word and the message, all text escaped."""
        sign, colour = SIGNS_AND_COLOURS[self.said]
        return (
            f'<div class="{PLAIN_TEXT}" role="status" style="border-left:6px solid {colour};{THEMED};padding:6px 12px">'
            f'<span aria-hidden="true">{sign}</span> <b>{escaped(gettext(self.said))}.</b> {_html(self.message)}'
            f"{self._image()}</div>"
        )

    def _image(self) -> str:
        """The picture on a line of its own."""
        data, look = base64.b64encode(self.picture.encode()).decode(), "display:block;margin:4px 0"
        return f'<img alt="{escaped(self.described)}" style="{look}" src="data:image/svg+xml;base64,{data}">' if data else ""


def _html(message: str) -> str:
    """A message as HTML: quoted lines keep their blanks, so that a caret stays under its place.

    >>> _html("This is wrong.\\n  a < b\\n    ^")
    'This is wrong.<pre style="margin:4px 0">  a &lt; b\\n    ^</pre>'
    """
    lines = message.split("\n")
    quoted = next((i for i, line in enumerate(lines) if line.startswith("  ")), len(lines))
    last = next((i for i in range(quoted, len(lines)) if not lines[i].startswith("  ")), len(lines))
    html = "<br>".join(map(escaped, lines[:quoted]))
    if quoted < len(lines):
        html += '<pre style="margin:4px 0">' + "\n".join(map(escaped, lines[quoted:last])) + "</pre>"
        html += _html("\n".join(lines[last:]))
    return html
