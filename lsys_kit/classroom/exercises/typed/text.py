"""What a person types, brought into the characters that the kit's grammars read; nothing is ever run."""

from __future__ import annotations

import re
import unicodedata

from lsys_kit.errors import ModelValueError, quotable, shown
from lsys_kit.translation import gettext

_ASSIGNED = re.compile(r"^\s*+[A-Za-z_]\w*+\s*+(?:\([^()=]*\)\s*+)?=(?!=)\s*")
"""The beginning of `N(12) = 21` or `t = d - s`."""
ARROW = r"(?<![-=])[-=]++>|→"
"""An arrow, however long."""
_OUTSIDE = re.compile(r"[^()]++\)?")
"""What stands between two parentheses, with the second if it closes one."""
_RAISED = "⁰¹²³⁴⁵⁶⁷⁸⁹"
_RAISED_NUMBER = re.compile(rf"([⁺⁻]?)([{_RAISED}]+)")
_DIGITS = str.maketrans(_RAISED, "0123456789")
_ROOT_SIGN = re.compile(r"√\s*(?=\()|√\s*(\d+(?:\.\d+)?|[A-Za-z]\w*)")
_SIGNS = str.maketrans(
    {
        "−": "-",
        "–": "-",
        "·": "*",
        "⋅": "*",
        "×": "*",
        "÷": "/",
        "º": "°",
        "≤": "<=",
        "≥": ">=",
        "≠": "!=",
        "∧": "&&",
        "∨": "||",
        "¬": "!",
        "⟶": "->",
        "⇒": "->",
        "π": "pi",
    }
)


def text_answer(answer: object, what: str, example: str) -> str:
    """An answer that must be a text."""
    if not isinstance(answer, str):
        raise ModelValueError(
            gettext(
                "{what} must be a text such as {example}, not {kind}", what=what, example=example, kind=type(answer).__name__
            )
        )
    return answer


def keyboard_text(text: str) -> str:
    """A text in the characters of a keyboard: signs, raised digits, fractions and letters that have another form there.

    >>> keyboard_text("2·x² ≤ ½"), keyboard_text("2⁶−1"), keyboard_text("√169 + 1½"), keyboard_text("７０９")
    ('2*x^2 <= (1/2)', '2^6-1', 'sqrt(169) + (1+1/2)', '709')
    """
    text = _RAISED_NUMBER.sub(_power, text.translate(_SIGNS))
    text = re.sub(r"(?<!\d)(\d+)\s*([¼-¾⅐-⅞])", lambda found: f"({found[1]}+{_fraction(found[2])})", text)
    text = re.sub(r"[¼-¾⅐-⅞]", lambda found: f"({_fraction(found[0])})", text)
    text = _ROOT_SIGN.sub(lambda found: f"sqrt({found[1]})" if found[1] else "sqrt", text)
    return "".join(unicodedata.normalize("NFKC", each) if each not in "…" else each for each in text)


def _power(found: re.Match[str]) -> str:
    digits = found[2].translate(_DIGITS)
    return f"^(-{digits})" if found[1] == "⁻" else f"^{digits}"


def _fraction(sign: str) -> str:
    return unicodedata.normalize("NFKC", sign).replace("⁄", "/")


def unassigned(text: str) -> str:
    """A text without the name that it is assigned to.

    >>> unassigned("N(12) = 21"), unassigned("t == 5")
    ('21', 't == 5')
    """
    return _ASSIGNED.sub("", text, count=1)


def assigned_name(text: str) -> str:
    """The name to which a formula is assigned, or nothing.

    >>> assigned_name("t = d - s"), assigned_name("t == 5")
    ('t', '')
    """
    found = _ASSIGNED.match(text.strip().strip("$"))
    return found[0].partition("=")[0].partition("(")[0].strip() if found else ""


_LABEL = re.compile(r"(?<![\w.)\]])(?:[^\W\d]\w*(?:\s*\([^()]*\)|\s+\d+)?|\d+)\s*(?::|=(?![=>]))\s*")


def unlabelled(text: str) -> str:
    """A row without the names of its parts.

    >>> unlabelled("N(8) = 7, N(9) = 10"), unlabelled("0: 2, 1: 3"), unlabelled("a: 1 2, b: 1 0")
    ('7, 10', '2, 3', '1 2, 1 0')
    """
    return _LABEL.sub("", text)


def without_commas(text: str) -> str:
    """A text with blanks for the commas between its modules, which are outside parentheses.

    >>> without_commas("A(1, 2), b,b")
    'A(1, 2) b b'
    """
    return _OUTSIDE.sub(lambda found: found[0] if found[0].endswith(")") else re.sub(r",[ \t]*", " ", found[0]), text)


def unquoted(text: str) -> str:
    """A text without the quotation marks around it.

    >>> unquoted("`br -> ar`"), unquoted("'a'"), unquoted("don't")
    ('br -> ar', 'a', "don't")
    """
    text = text.strip()
    while len(text) > 1 and text[0] == text[-1] and text[0] in "\"'`":
        text = text[1:-1].strip()
    return text


def quoted(answer: object) -> str:
    """What was typed, as a message quotes it."""
    return quotable(" ".join(answer.split())) if isinstance(answer, str) else shown(answer)
