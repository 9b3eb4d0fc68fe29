"""What a person types or hands over, brought into one form before the kit's grammars read it; nothing is ever run."""

from __future__ import annotations

import re
from collections.abc import Iterable, Mapping
from decimal import Decimal
from fractions import Fraction

from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import ModelValueError, quotable, shown
from lsys_kit.notation.model.arithmetic import Value, is_symbolic

_ASSIGNED = re.compile(r"^\s*[A-Za-z_]\w*\s*(\([^()=]*\))?\s*=(?!=)\s*")
"""The beginning of `N(12) = 21` or `t = d - s`."""
_THOUSANDS = re.compile(r"[+-]?\d{1,3}(,\d{3})+")
_DECIMAL_COMMA = re.compile(r"[+-]?\d+,\d{1,2}")
_WITH_UNIT = re.compile(r"^(?P<number>.*?[\d)])\s*(?P<unit>[^\W\d_][\w .]*|°|%)\s*$", re.DOTALL)
_SIGNS = str.maketrans(
    {
        "−": "-",
        "–": "-",
        "·": "*",
        "×": "*",
        "÷": "/",
        "²": "^2",
        "³": "^3",
        "\u00a0": " ",
        "≤": "<=",
        "≥": ">=",
        "≠": "!=",
        "π": "pi",
    }
)


def text_answer(answer: object, what: str, example: str) -> str:
    """An answer that must be a text."""
    if not isinstance(answer, str):
        raise ModelValueError(f"{what} must be a text such as {example}, not {type(answer).__name__}")
    return answer


def unassigned(text: str) -> str:
    """A text without the name that it is assigned to.

    >>> unassigned("N(12) = 21"), unassigned("t == 5")
    ('21', 't == 5')
    """
    return _ASSIGNED.sub("", text, count=1)


def number_and_unit(answer: object) -> tuple[Value, str]:
    """A number as a person writes it, and the word behind it.

    >>> number_and_unit("N(12) = 21 cells"), number_and_unit("1,000"), number_and_unit(Decimal("0.5"))
    ((21, 'cells'), (1000, ''), (Fraction(1, 2), ''))
    """
    if isinstance(answer, Decimal) and answer.is_finite():
        return number_from(Fraction(answer)), ""
    if not isinstance(answer, str):
        return _known(number_from(answer, "answer")), ""
    text = unassigned(answer.translate(_SIGNS)).strip().strip("$≈~ ").rstrip(". ")
    if not any(map(str.isdigit, text)) and "pi" not in text:
        raise ModelValueError(f'"{quotable(text)}" is no number', hint="Write it in digits.")
    found = _WITH_UNIT.match(text)
    number, unit = (found["number"], found["unit"].strip()) if found else (text, "")
    return _known(number_from(_plain_number(number.strip()), "answer")), unit


def _plain_number(text: str) -> str:
    if _THOUSANDS.fullmatch(text):
        return text.replace(",", "")
    return (text.replace(",", ".") if _DECIMAL_COMMA.fullmatch(text) else text).replace("**", "^")


def _known(number: Value) -> Value:
    if is_symbolic(number):
        raise ModelValueError(f'A number is needed, and "{quotable(str(number))}" is none')
    return number


def parts(answer: object, what: str) -> list[object]:
    """The parts of a row or table, in order: of a text what stands between commas, semicolons, bars, brackets, blanks.

    >>> parts("[[1, 1], [1, 0]]", "Numbers"), parts((1, 2), "Numbers")
    (['1', '1', '1', '0'], [1, 2])
    """
    if isinstance(answer, str):
        text = unassigned(answer.translate(_SIGNS)) if "\n" not in answer else answer.translate(_SIGNS)
        return [part for part in re.split(r"[\s,;|\[\](){}&]+", text) if part]
    return list(_flat(answer, what))


def _flat(answer: object, what: str, depth: int = 0) -> Iterable[object]:
    if hasattr(answer, "tolist") and callable(answer.tolist):
        answer = answer.tolist()
    if isinstance(answer, Mapping):
        answer = list(answer.values())
    if depth > 3 or isinstance(answer, str | bytes) or not isinstance(answer, Iterable):
        if depth == 0:
            raise ModelValueError(f"{what} are needed, not {type(answer).__name__}")
        yield answer
        return
    for number, part in enumerate(answer):
        if number > 10_000:
            raise ModelValueError(f"{what} are needed, at most 10,000 of them")
        yield from _flat(part, what, depth + 1)


_FRACTION = re.compile(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}")
_ROOT = re.compile(r"\\sqrt\s*\{([^{}]*)\}")
_POWER = re.compile(r"\^\s*\{([^{}]*)\}")
_LATEX = (
    (r"\left", ""),
    (r"\right", ""),
    (r"\cdot", "*"),
    (r"\times", "*"),
    (r"\,", " "),
    (r"\;", " "),
    (r"\leq", "<="),
    (r"\le", "<="),
    (r"\geq", ">="),
    (r"\ge", ">="),
    (r"\neq", "!="),
    (r"\lfloor", "floor("),
    (r"\rfloor", ")"),
    (r"\ln", "log"),
    (r"\log", "log"),
    (r"\exp", "exp"),
    (r"\min", "min"),
    (r"\max", "max"),
    (r"\sin", "sin"),
    (r"\cos", "cos"),
    (r"\tan", "tan"),
    (r"\(", ""),
    (r"\)", ""),
)
_IMPLICIT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)\s*(?=[A-Za-z_(])|(?<=\))\s*(?=[\w(])")
MOST_NESTED = 20
"""Fractions within fractions that are read."""


def assigned_name(text: str) -> str:
    """The name to which a formula is assigned, or nothing.

    >>> assigned_name("t = d - s"), assigned_name("t == 5")
    ('t', '')
    """
    found = _ASSIGNED.match(text.strip().strip("$"))
    return found[0].partition("=")[0].partition("(")[0].strip() if found else ""


def formula_text(text: str) -> str:
    """A formula as the kit writes it, from simple LaTeX, from Python's powers, without the name that it is assigned to.

    >>> formula_text("t = d - s**2"), formula_text(r"$\\frac{d + 1}{2} \\cdot s$"), formula_text("2s + 2(d - s)")
    ('d - s^2', '((d + 1)/(2)) * s', '2*s + 2*(d - s)')
    """
    text = unassigned(text.translate(_SIGNS).strip().strip("$").strip())
    for _ in range(MOST_NESTED):
        before = text
        for pattern, form in ((_FRACTION, r"((\1)/(\2))"), (_ROOT, r"sqrt(\1)"), (_POWER, r"^(\1)")):
            text = pattern.sub(form, text)
        if text == before:
            break
    for latex, plain in _LATEX:
        text = text.replace(latex, plain)
    return _IMPLICIT.sub(lambda found: f"{found[1] or ''}*", text.replace("**", "^")).strip()


def quoted(answer: object) -> str:
    """What was typed, as a message quotes it."""
    return quotable(" ".join(answer.split())) if isinstance(answer, str) else shown(answer)
