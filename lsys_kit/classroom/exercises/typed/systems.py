"""Systems as people write them: all on one line, with other arrows, with words for operators, products without a sign."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeVar

from lsys_kit.classroom.exercises.typed.formulas import with_operators
from lsys_kit.classroom.exercises.typed.text import unquoted
from lsys_kit.errors import LSystemError

Read = TypeVar("Read")
_ERASED = re.compile(r"(->|→)[ \t]*(?:\"\"|''|\\(?:var)?epsilon\b|\bepsilon\b|λ|∅)[ \t]*$", re.MULTILINE)
_IN_A_WORD = re.compile(r"(->|→)[ \t]*(?:empty|nothing)[ \t]*$", re.MULTILINE | re.IGNORECASE)
_NOTHING = re.compile(r"(->|→)[ \t]*$", re.MULTILINE)
_FULL_STOP = re.compile(r"(?<=[\w\])])\.[ \t]*$", re.MULTILINE)
_NEXT_LINE = re.compile(r"[ \t]*;[ \t]*(?!\n)|[ \t]*,[ \t]*(?=[^,;\n]*?(?:->|→))")
_SETTING = re.compile(r"^(\s*(?:axiom|angle|heading|length))\s*=", re.MULTILINE | re.IGNORECASE)
_COMMA = re.compile(r",(?![^(\n]*\))[ \t]*")
_WITHIN = re.compile(r"\([^()\n]*\)|:[^\n]*?(?=->|→)")
_PRODUCT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)(?=[A-Za-z])")
_FIRST_WORD = re.compile(r"^\s*[^\n:=>→]+\n(?=[^\n]*(?:->|→))")


def read_typed(text: str, reader: Callable[[str], Read], known: str = "") -> Read:
    """What a reader makes of a system; where it cannot be read as it stands, in the form that the kit writes.

    `known` is what the question itself says, whose symbols mean themselves.

    >>> from lsys_kit.notation.read import read
    >>> print(read_typed("axiom = F; F => F[+F]F.", read))
    axiom: F
    F -> F[+F]F
    """
    text = _cleaned(text, known)
    try:
        return reader(text)
    except LSystemError as mistake:
        try:
            return reader(_spelt_out(text))
        except LSystemError:
            raise mistake from None


def _cleaned(text: str, known: str) -> str:
    """A text without what no notation means: quotation marks around it, full stops at the ends of its lines."""
    text = unquoted(text).replace(r"\rightarrow", "->").replace(r"\to", "->").replace("−>", "->").replace("–>", "->")
    text = _ERASED.sub(r"\1 ε", text)
    if not re.search(r"\b(empty|nothing)\b", known):
        text = _IN_A_WORD.sub(r"\1 ε", text)
    return text if _FULL_STOP.search(known) else _FULL_STOP.sub("", text)


def _spelt_out(text: str) -> str:
    """A text as the kit writes it.

    >>> _spelt_out("axiom: M(1), M(x) : x > 1 and x < 3 -> M(2x)")
    'axiom: M(1)\\nM(x) : x > 1 && x < 3 -> M(2*x)'
    >>> _spelt_out("a\\na -> a, b\\nb ->")
    'axiom: a\\na -> a b\\nb -> ε'
    """
    text = re.sub(r"(?:-+|=+)>", "->", text).replace("°", "").strip()
    text = _SETTING.sub(r"\1:", _NEXT_LINE.sub("\n", text))
    text = _COMMA.sub(" ", _NOTHING.sub(r"\1 ε", text))
    text = _WITHIN.sub(lambda found: _PRODUCT.sub(r"\1*", with_operators(found[0])), text)
    return f"axiom: {text}" if _FIRST_WORD.match(text) else text
