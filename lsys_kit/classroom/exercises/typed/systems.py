"""Systems as people write them: all on one line, with other arrows, with words for operators, products without a sign."""

from __future__ import annotations

import re
from collections.abc import Callable
from typing import TypeVar

from lsys_kit.classroom.exercises.typed.formulas import with_operators
from lsys_kit.classroom.exercises.typed.text import ARROW, unquoted, without_commas
from lsys_kit.errors import LSystemError

Read = TypeVar("Read")
_ERASED = re.compile(r"(->|→)[ \t]*(?:\"\"|''|\\(?:var)?epsilon\b|\bepsilon\b|λ|∅)[ \t]*$", re.MULTILINE)
_IN_A_WORD = re.compile(r"(->|→)[ \t]*(?:empty|nothing)[ \t]*$", re.MULTILINE | re.IGNORECASE)
_NOTHING = re.compile(r"(->|→)[ \t]*$", re.MULTILINE)
_FULL_STOP = re.compile(r"(?<=[\w\])])\.[ \t]*$", re.MULTILINE)
_NEXT_LINE = re.compile(r";[ \t]*(?!\n)|,[ \t]*+(?=[^,;\n]*?(?:->|→))")
_SETTING = re.compile(r"^([ \t]*(?:axiom|angle|heading|length))[ \t]*=", re.MULTILINE | re.IGNORECASE)
_ARROW = re.compile(r"->|→|$")
_ARGUMENTS = re.compile(r"\([^()\n]*\)")
_PRODUCT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)(?=[A-Za-z])")
_FIRST_WORD = re.compile(r"^\s*+[^\n:=>→]++\n(?=[^\n]*(?:->|→))")


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
    text = re.sub(ARROW, "->", text).replace("°", "").strip()
    text = _SETTING.sub(r"\1:", _NEXT_LINE.sub("\n", text))
    text = without_commas(_NOTHING.sub(r"\1 ε", text))
    text = "\n".join(map(_with_signs, text.split("\n")))
    return f"axiom: {text}" if _FIRST_WORD.match(text) else text


def _with_signs(line: str) -> str:
    """A line with signs for the words and the products in its arguments and its condition."""
    arrow = _ARROW.search(line)
    assert arrow
    before, colon, condition = line[: arrow.start()].partition(":") if arrow[0] else (line, "", "")
    made = _in_arguments(line[arrow.start() :]) if arrow[0] else ""
    return _in_arguments(before) + _signs(colon + condition) + made


def _in_arguments(text: str) -> str:
    return _ARGUMENTS.sub(lambda found: _signs(found[0]), text)


def _signs(formula: str) -> str:
    return _PRODUCT.sub(r"\1*", with_operators(formula))
