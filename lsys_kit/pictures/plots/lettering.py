"""Labels of plots: a small part of the mathematical text of matplotlib, measured and set in pieces.

`"length $N(n)$"` has an italic N and n; `"$t_{div}$"` has a subscript. Matplotlib sets the same text where it makes pixels.
"""

from __future__ import annotations

import re
from collections.abc import Iterator
from typing import NamedTuple

from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.shapes import Look, Span
from lsys_kit.pictures.style.labels import visible

SUBSCRIPT, LOWERED = 0.7, 0.25
"""The size of a subscript and how far it is lowered, to the size of the text."""
MOST_LETTERS = 32
"""A longer label is cut short."""
_ATOM = re.compile(r"_\{\\mathrm\{(?P<sub>[^{}]*)\}\}|\\mathit\{(?P<name>[^{}]*)\}|(?P<letter>[A-Za-z])|(?P<other>[^A-Za-z])")
_DOLLAR = re.compile(r"(?<!\\)\$")
_PLAIN = re.compile(r"[A-Za-z0-9]+")


class Part(NamedTuple):
    """A piece of text in one style."""

    text: str
    italic: bool = False
    lowered: bool = False


def mathematics(letter: str, subscript: str = "", values: str = "") -> str:
    """A name as mathematical text: an italic letter or word, a subscript, upright values; other signs stand as they are.

    >>> mathematics("t", "div"), mathematics("a", "", "(2)"), mathematics("+")
    ('$\\\\mathit{t}_{\\\\mathrm{div}}$', '$\\\\mathit{a}$(2)', '+')
    """
    if not _PLAIN.fullmatch(letter) or "$" in subscript + values or len(letter + subscript + values) > MOST_LETTERS:
        return literal(f"{letter}{subscript and '_' + subscript}{values}")
    lowered = f"_{{\\mathrm{{{subscript}}}}}" if _PLAIN.fullmatch(subscript) else literal(subscript)
    return f"$\\mathit{{{letter}}}{lowered}${values}"


def literal(text: str) -> str:
    """A text in which no sign begins mathematics, no longer than a label may be.

    >>> print(literal("a$b"), literal("x" * 50))
    a\\$b xxxxxxxxxxxxxxxxxxxxxxxxxxxxxxx…
    """
    short = text if len(text) <= MOST_LETTERS else f"{text[: MOST_LETTERS - 1]}…"
    return visible(short).replace("$", "\\$")


def parts(text: str) -> Iterator[Part]:
    """The pieces of a label.

    >>> [*parts("time $t_{\\\\mathrm{div}}$")]
    [Part(text='time ', italic=False, lowered=False), Part(text='t', italic=True, lowered=False), \
Part(text='div', italic=False, lowered=True)]
    """
    for number, piece in enumerate(_DOLLAR.split(text)):
        if number % 2 == 0:
            yield from [Part(piece.replace("\\$", "$"))] if piece else []
            continue
        for found in _ATOM.finditer(piece):
            if found["sub"] is not None:
                yield Part(found["sub"], lowered=True)
            else:
                yield Part(found["name"] or found["letter"] or found["other"], italic=found["other"] is None)


def width(text: str, size: float) -> float:
    """The width of a label."""
    return sum(advance(part.text, size * (SUBSCRIPT if part.lowered else 1)) for part in parts(text))


def plain(text: str) -> str:
    """A label as plain text.

    >>> plain("$t_{\\\\mathrm{div}}$ in steps")
    't_div in steps'
    """
    return "".join(("_" if part.lowered else "") + part.text for part in parts(text))


def spans(text: str, size: float) -> list[str | Span]:
    """A label in pieces of text."""
    found, drop, back = list[str | Span](), round(LOWERED * size), Look()
    for part in parts(text):
        look = Look(dy=drop, font_size=f"{SUBSCRIPT:.0%}") if part.lowered else back
        look = look | Look(font_style="italic") if part.italic else look
        found.append(Span(part.text, look) if look else part.text)
        back = Look(dy=-drop) if part.lowered else Look()
    return found
