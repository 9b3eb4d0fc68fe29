"""Numbers as people write them: in digits or words, as a calculation, within a short sentence, in rows."""

from __future__ import annotations

import math
import re
from collections.abc import Iterable, Mapping
from dataclasses import dataclass
from decimal import Decimal
from fractions import Fraction

from lsys_kit.classroom.exercises.typed.formulas import formula_text
from lsys_kit.classroom.exercises.typed.number_words import with_digits
from lsys_kit.classroom.exercises.typed.text import ARROW, keyboard_text, quoted, unlabelled, unquoted
from lsys_kit.derivation.core.rules import number_from
from lsys_kit.errors import LSystemError, ModelNameError, ModelSyntaxError, ModelValueError, quotable
from lsys_kit.notation.model.arithmetic import Value, is_symbolic
from lsys_kit.translation import gettext

_EQUALS = re.compile(r"(?<![<>=!])=(?!=)|≈")
_GROUPED = re.compile(r"[+-]?\d{1,3}([ ']\d{3})+")
_COMMAS = re.compile(r"[+-]?\d{1,3}(,\d{3})+")
_DECIMAL_COMMA = re.compile(r"[+-]?(\d+,\d{1,2}|\d+,\d{4,}|0,\d+)")
_SCIENTIFIC = re.compile(r"(?<!\w)(\d+(?:\.\d+)?)[eE]([+-]?\d{1,3})(?!\w)")
_SENTENCE = re.compile(
    r"^(?P<before>(?:(?!pi\b)[^\W\d_]++(?:[\s:]|\.(?!(?<=[\s:]\.)\d))++)*+)"
    r"(?P<number>(?:.*(?:[^\w\s°%]|[°%](?!$)))?+(?:(?<=[)}])|[\w\s]*?(?:\d|(?<![A-Za-z])pi\b)))\s*"
    r"(?P<after>(?!pi\b)[^\W\d_][^\W\d]*(?:\s[\w\s]*)?|°|%)?$",
    re.DOTALL,
)
"""Words, a number, words: whatever has other signs belongs to the number."""
_REPLACED = (
    (re.compile(r"\bper\s+cent\b", re.IGNORECASE), "percent"),
    (re.compile(r"\b(?:no|nr)\.\s*(?=\d)", re.IGNORECASE), ""),
    (re.compile(r"°(?=\s*[-+*/:])"), ""),
    (re.compile(r"(?<=\d)\s+out of\s+(?=\d)"), "/"),
    (re.compile(r"(?<=[\d)])\s*:\s*(?=[\d(])"), "/"),
    (re.compile(r"(?<=\d)\s*x\s*(?=\d)"), "*"),
)


@dataclass(frozen=True)
class TypedNumber:
    """A number, and the words around it.

    Attributes
    ----------
    value
        The number, exactly where it was written exactly.
    before, after
        The words in front of it and behind it; what is behind it may be a unit.
    of_pi
        Whether it was written as a multiple of pi.
    """

    value: Value
    before: tuple[str, ...] = ()
    after: tuple[str, ...] = ()
    of_pi: bool = False


def typed_number(answer: object, decimal_comma: bool = False) -> TypedNumber:
    """A number as a person writes it, with the words around it; `decimal_comma` says what the comma in 1,272 is.

    >>> typed_number("N(12) = 21 cells").value, typed_number("1,000").value, typed_number(Decimal("0.5")).value
    (21, 1000, Fraction(1, 2))
    >>> typed_number("about .5").value, typed_number("No.5 .").value
    (Fraction(1, 2), 5)
    >>> typed_number("at step twenty-one"), typed_number("2π/5 rad").after
    (TypedNumber(value=21, before=('at', 'step'), after=(), of_pi=False), ('rad',))
    """
    if isinstance(answer, Decimal) and answer.is_finite():
        return TypedNumber(number_from(Fraction(answer)))
    if not isinstance(answer, str):
        return TypedNumber(_known(number_from(answer, "answer")))
    text = with_digits(unquoted(keyboard_text(answer)).strip("$ "))
    for pattern, plain in _REPLACED:
        text = pattern.sub(plain, text)
    fault: LSystemError | None = None
    for part in reversed(_EQUALS.split(text)):
        try:
            return _in_sentence(part.strip(" \t\n!~$").rstrip(" ."), answer, decimal_comma)
        except (ModelSyntaxError, ModelNameError, ModelValueError) as mistake:
            fault = fault or mistake
    raise fault or ModelValueError(gettext("A number is needed"))


def _in_sentence(text: str, answer: str, decimal_comma: bool) -> TypedNumber:
    found = _SENTENCE.match(text)
    if not found:
        raise ModelValueError(gettext('"{answer}" is no number', answer=quoted(answer)), hint=gettext("Write it in digits."))
    number = formula_text(_plain(found["number"].strip(), decimal_comma))
    value = _value(re.sub(r"\bpi\b", f"({math.pi!r})", number), answer)
    before, after = (tuple(re.findall(r"[^\W\d_]+|[°%]", found[part] or "")) for part in ("before", "after"))
    return TypedNumber(value, before, after, "pi" in number)


def _value(number: str, answer: str) -> Value:
    try:
        return _known(number_from(number, "answer"))
    except (ModelSyntaxError, ModelNameError):
        raise ModelValueError(
            gettext('"{answer}" cannot be read as a number', answer=quoted(answer)),
            hint=gettext('Write it alone, as in "21", "0.75" or "3/4".'),
        ) from None


def _plain(text: str, decimal_comma: bool) -> str:
    """A number with a point, and nothing between its thousands."""
    text = _SCIENTIFIC.sub(r"\1*10^(\2)", text)
    if _DECIMAL_COMMA.fullmatch(text) or (decimal_comma and text.count(",") == 1 and _COMMAS.fullmatch(text)):
        return text.replace(",", ".")
    return re.sub(r"[, ']", "", text) if _COMMAS.fullmatch(text) or _GROUPED.fullmatch(text) else text


def _known(number: Value) -> Value:
    if is_symbolic(number):
        raise ModelValueError(gettext('A number is needed, and "{text}" is none', text=quotable(str(number))))
    return number


# Rows

_MATRIX = re.compile(r"\\(?:begin|end)\s*\{[^{}]*\}|\b(?:np\.)?(?:Matrix|matrix|array)\b")
_BETWEEN = re.compile(rf"\\\\|{ARROW}|\band\b|(?<=\s)/(?=\s)")


def parts(answer: object, what: str) -> list[object]:
    """The parts of a row or table, in order: of a text what stands between commas, semicolons, bars, brackets, blanks.

    >>> parts("[[1, 1], [1, 0]]", "Numbers"), parts((1, 2), "Numbers")
    (['1', '1', '1', '0'], [1, 2])
    >>> parts("N(0) = one, N(1) = 2 and N(2) = 3", "Numbers")
    ['1', '2', '3']
    """
    if isinstance(answer, str):
        text = _BETWEEN.sub(",", _MATRIX.sub(" ", with_digits(unquoted(keyboard_text(answer)))))
        return [part for part in re.split(r"[\s,;|\[\](){}&]+", unlabelled(text)) if part.strip(".")]
    return list(_flat(answer, what))


def _flat(answer: object, what: str, depth: int = 0) -> Iterable[object]:
    if hasattr(answer, "tolist") and callable(answer.tolist):
        answer = answer.tolist()
    if isinstance(answer, Mapping):
        answer = list(answer.values())
    if depth > 3 or isinstance(answer, str | bytes) or not isinstance(answer, Iterable):
        if depth == 0:
            raise ModelValueError(gettext("{what} are needed, not {kind}", what=what, kind=type(answer).__name__))
        yield answer
        return
    for number, part in enumerate(answer):
        if number > 10_000:
            raise ModelValueError(gettext("{what} are needed, at most 10,000 of them", what=what))
        yield from _flat(part, what, depth + 1)
