"""Numbers as answers: one number, with a unit or without, or a row or table of them."""

from __future__ import annotations

import math
import re
from collections.abc import Sequence
from contextlib import suppress
from fractions import Fraction
from itertools import takewhile
from typing import Any

from lsys_kit.classroom.exercises.asked import asked_steps, bound_of, last_step, right_history, what_is_asked
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference, one_apart
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.typed import (
    UNITS,
    WORDS,
    TypedNumber,
    converted,
    is_unsolved,
    keyboard_text,
    means_the_same,
    names_of,
    parts,
    quoted,
    typed_number,
    unquoted,
    with_digits,
)
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError, quotable
from lsys_kit.notation.model.arithmetic import Value, number_text
from lsys_kit.notation.model.expressions import Function, function_of
from lsys_kit.notation.read import checked_expression
from lsys_kit.translation import gettext
from lsys_kit.translation import number_text as written

FORMULA = re.compile(r"\{([^{}]+)\}")
"""A formula in a reply, of which the value is shown."""
MOST_APART = 1_000_000
"""How many times too large or too small a number may be that counts as a try."""
MOST_DENOMINATOR = 10_000
"""Fractions with a larger denominator are shown as decimals."""
MOST_DECIMALS = 12
"""A fraction with more decimals is no decimal number."""
_GIVEN = re.compile(r"\b([A-Za-z]) = \d")
"""A letter with its value, as a question gives it."""
_FILLING, _DOUBTFUL = (frozenset(WORDS[kind].split()) for kind in ("filling", "doubtful"))
"""Words that may stand around any number, and words by which it is another number, or none."""
_PREPOSITIONS = frozenset(
    ["after", "at", "by", "for", "from", "in", "of", "on", "per", "to", "nach", "bei", "für", "von", "pro"]
)
_TIMES, _UNITS = frozenset(["times", "mal"]), frozenset(["unit", "units"])
"""What may stand behind a number that counts nothing, and behind one that measures something."""
_MEASURED = re.compile(r"\b(?:long|lengths?|far|distances?|times?|ages?|dt|concentrations?)\b", re.IGNORECASE)


def _no_units(exercise: Exercise) -> frozenset[str]:
    """The words behind a number that name no unit: none where the question has one."""
    asked = " ".join(_ASKED_FOR.findall(exercise.question)) or exercise.question
    return frozenset() if exercise.unit else _TIMES | _UNITS if _MEASURED.search(asked) else _TIMES


def _words_of(exercise: Exercise) -> frozenset[str]:
    text = f"{exercise.question} {exercise.unit} {gettext(exercise.unit)} {' '.join(exercise.symbols)}".lower()
    return frozenset(word.removesuffix("s") for word in re.findall(r"[^\W\d_]+|[°%]", text))


def _is_in_place(exercise: Exercise, word: str, is_last: bool = False) -> bool:
    """Whether a word beside a number says no more than the question does; a single letter, than what it asks for.

    The last letter is no article.
    """
    noun = word.lower().removesuffix("s")
    if exercise.kind == "number" and len(word) == 1 and word.isalpha() and (is_last or word not in _FILLING):
        named = _NAME.findall(" ".join(_ASKED_FOR.findall(exercise.question)))
        return (word in named and word not in _FILLING) or word in exercise.asks.split()
    return (
        word.lower() in _FILLING | _PREPOSITIONS | _no_units(exercise)
        or noun in _words_of(exercise) - _DOUBTFUL
        or (bool(exercise.unit) and means_the_same(word, exercise.unit))
    )


# Numbers of steps


_OF_STEP = rf"(?:{'|'.join(WORDS['labels'].split())})"
_STEP = r"(\d++)"
_AT = r"(?:at|in|im|bei|after|nach)\s++(?:the\s++)?"
_AT_ITS_STEP = re.compile(rf"(?<!\w){_AT}(?:{_OF_STEP}\s++{_STEP}|{_STEP}\s++{_OF_STEP})\W*+\Z", re.IGNORECASE)
_ITS_STEP_FIRST = re.compile(
    rf"\W*+(?:(?:{_AT})?{_OF_STEP}\s++{_STEP}\s*+(?:[:=,]|(?:has|it\s++is|hat|ist)\b)|[A-Za-z]\w*+\s*+\({_STEP}\)\s*+="
    rf"|{_AT}{_STEP}\s++{_OF_STEP}\b\s*+[:=,]?)",
    re.IGNORECASE,
)
"""The step that a number is of, as in "64 at step 3", "step 3: 64" and "N(3) = 64"."""
_SEPARATED = re.compile(r"[,;\n]\s*+(?:(?:and|und)\s++)?|(?<!\s)\s++(?:and|und|then|dann)\s++")
_BESIDE_A_STEP = re.compile(
    r"\W*+(?:(?:it\s++is\s++)?(?:at|in|im|bei)\s++)?(?:the\s++|der\s++|dem\s++)?(?:(\d{1,9})\s++)?(?:steps?|schritte?n?)\s++"
    rf"(after|before|nach|vor)\s++(?:the\s++)?(?:{_OF_STEP}\s++)?(\d{{1,9}})\W*+\Z",
    re.IGNORECASE,
)
"""A step that is told by another one, as in "the step after 19"."""
_COUNTED = ("length", "count", "strokes")
_ROW = re.compile(r"\W*+\d{1,18}(?:\s*+[,;]\s*+\d{1,18}){2,}\W*+")
_STAGES = re.compile(r"\W*+(\w++(?>(?:\s*+,\s*+\w++)+))\s*+:\s*+(\d{1,3})\W*+")
"""A row with a number for each step, and stages with their number, as in "r, s, t, u: 4"."""


def _of_the_step(exercise: Exercise, answer: str) -> str:
    """An answer without the step that it names; of numbers of several steps that of the one that is asked for."""
    text = with_digits(unquoted(keyboard_text(answer)))
    stages = _STAGES.fullmatch(text)
    if stages and len(re.findall(r"\w+", stages[1])) == int(stages[2]):
        return stages[2]
    beside = _BESIDE_A_STEP.match(text)
    if beside and (what_is_asked(exercise) == "first" or means_the_same(exercise.unit, "steps")):
        by, other = int(beside[1] or 1), int(beside[3])
        return str(other + by if beside[2].lower() in ("after", "nach") else other - by)
    if means_the_same(exercise.unit, "steps"):
        return _of_several_steps(exercise, text, answer)
    if what_is_asked(exercise) not in _COUNTED:
        return answer
    if _ROW.fullmatch(text):
        row, values = [*map(int, re.findall(r"\d+", text))], [*right_history(exercise).values(exercise, exercise.steps)]
        return str(row[-1]) if row in (values, values[1:]) else answer
    found: dict[str, str] = {}
    for part in _SEPARATED.split(text):
        behind, before = _AT_ITS_STEP.search(part), _ITS_STEP_FIRST.match(part)
        number = part[: behind.start()] if behind else part[before.end() :] if before else ""
        if not any(map(str.isdigit, number)):
            return answer
        step = next(filter(None, (behind or before).groups()))  # type: ignore[union-attr]
        found[step.lstrip("0") or "0"] = number
    if str(exercise.steps) not in found:
        step = quotable(next(reversed(found)))
        said = reply("number.other_step", answer=quoted(answer), step=step, asked=exercise.steps)
        raise ModelValueError(said, hint=reply("number.only_asked"))
    return found[str(exercise.steps)]


_STEP_NAMED = re.compile(rf"\b{_OF_STEP}\s++(\d{{1,9}})\b", re.IGNORECASE)
_CLAUSES = re.compile(r"[,;.]\s++|\b(?:so|and|then|thus|hence|therefore|but|und|also|dann|daher|aber)\b", re.IGNORECASE)
_REASON = re.compile(r"\b(?:because|since|weil)\b|\(", re.IGNORECASE)
"""Where a reason begins."""


def _of_several_steps(exercise: Exercise, text: str, answer: str) -> str:
    """Of an answer that names several steps the one of which the question asks; without a reason, which may name one, too."""
    said, reason = text, _REASON.search(text)
    if reason and _STEP_NAMED.search(text, reason.end()) and any(map(str.isdigit, text[: reason.start()])):
        said = answer = text[: reason.start()].rstrip(" ,;:-(")
    asked = re.findall(r"`(\w+)`", " ".join(_ASKED_FOR.findall(exercise.question)))
    named = [(clause, found[0]) for clause in _CLAUSES.split(said) if len(found := _STEP_NAMED.findall(clause)) == 1]
    telling = {step for clause, step in named if any(re.search(rf"(?<!\w){symbol}(?!\w)", clause) for symbol in asked)}
    return telling.pop() if len(named) > 1 and len(telling) == 1 else answer


# One number


_COMPARED = re.compile(r"^(.*(?:[<>]=?|==))\s*([-+]?[\d.]+)$", re.DOTALL)
_BOUND = re.compile(r"\s*+([A-Za-z]\w*+)\s*+(<=|>=)([^<>=]+)")
_EXTREME = {
    "<=": r"\b(?:largest|greatest|highest|longest|most|größte\w*|höchste\w*)\b",
    ">=": r"\b(?:smallest|least|lowest|shortest|kleinste\w*)\b",
}
"""The largest value of a name, as in "dt <= 1.2", and the smallest."""
_NAMED_LAST = re.compile(r"(?:^\W*+|[,;]\s*+|\b(?:and|und)\s++)([A-Za-z])\s*+(?>(?:\([^()]*+\)\s*+)?)=[^=]*+\Z")
_COORDINATES = frozenset("xyz")
"""Names that nobody gives to another number of one's own."""
_COORDINATE = re.compile(r"(?<!\w)([xyz])\s*+=(?!=)")
_ASKED_FOR = re.compile(r"\*\*(.*?)\*\*", re.DOTALL)
_NAME = re.compile(r"(?<![A-Za-z])[A-Za-z](?![A-Za-z])")
_CONDITION = re.compile(r"\b(?:when|if|where|wenn|falls|wo)\s++([A-Za-z])\s*+=[^=]*+\Z")
_PARAMETER = re.compile(r"\w\(([A-Za-z])\)")
_CODE = re.compile(r"`[^`]*`|^ {4}.*$", re.MULTILINE)


def _alone(exercise: Exercise, answer: str) -> str:
    """An answer without the part of a condition of the question that stands before its number.

    Also without the name of which the question asks for the greatest or least value.
    """
    text = keyboard_text(answer)
    compared = _COMPARED.match(text.strip())
    unspaced = "".join(exercise.question.split())
    if compared and f"`{''.join(compared[1].split())}" in unspaced:
        return compared[2]
    bound, asked = _BOUND.fullmatch(text), " ".join(_ASKED_FOR.findall(exercise.question))
    is_asked = bound and f"`{bound[1]}`" in asked and re.search(_EXTREME[bound[2]], asked, re.IGNORECASE)
    return bound[3] if bound and is_asked else answer


def _refuse_other_name(exercise: Exercise, answer: str) -> None:
    """Refuse the value of a name that the words of the question use, but not for what it asks for."""
    named = _NAMED_LAST.search(answer)
    told = _NAME.findall(_CODE.sub("", exercise.question))
    asked = _NAME.findall(" ".join(_ASKED_FOR.findall(exercise.question)))
    parameters = [name for code in _CODE.findall(exercise.question) for name in _PARAMETER.findall(code)]
    condition = _CONDITION.search(answer)
    other = (named and named[1] in _COORDINATES & {*told} - {*asked} and named) or (
        condition and condition[1] in {*parameters} - {*asked} and condition
    )
    if len({*_COORDINATE.findall(answer)}) > 1:
        raise ModelValueError(reply("typed.one_needed", answer=quoted(answer)), hint=reply("typed.alone"))
    if other:
        raise ModelNameError(reply("number.other_name", name=other[1], answer=quoted(answer)), hint=reply("number.only_asked"))


def _read_number(exercise: Exercise, answer: object) -> Value:
    if isinstance(answer, str) and exercise.kind == "number":
        answer = _of_the_step(exercise, _alone(exercise, answer))
        _refuse_other_name(exercise, answer)
        if is_unsolved(keyboard_text(answer), _GIVEN.findall(exercise.question)):
            raise ModelValueError(reply("typed.equation", answer=quoted(answer)), hint=reply("typed.alone"))
    found = typed_number(answer, _asks_for_decimals(exercise, answer))
    words = (*found.before, *found.after)
    if any(word.lower() in _DOUBTFUL for word in words):
        raise ModelValueError(reply("number.one_needed"), hint=reply("number.alone"))
    unit = next((word for word in found.after[:1] if word.lower() in UNITS), "")
    is_counted = exercise.kind == "number" and exercise.unit and exercise.unit.lower() not in UNITS
    if is_counted and {"per", "pro"} & {*map(str.lower, found.after)}:  # a rate
        raise _other_unit(exercise, " ".join(found.after))
    odd = _odd_words(exercise, found, unit)
    is_apart = odd and found.after and odd[0] not in (*found.after[:1], *found.before)  # as "each" in "three walls each"
    is_a_letter = odd and exercise.unit and len(odd[0]) == 1 and odd[0] in found.before
    if len(odd) > 1 or is_apart or is_a_letter:
        raise ModelValueError(reply("typed.unreadable", answer=quoted(answer)), hint=reply("typed.alone"))
    if counted := _other_thing(exercise, found):
        raise _other_unit(exercise, counted)
    if odd and len(odd[0]) == 1 and odd[0].isalpha() and not exercise.unit:
        raise ModelNameError(reply("number.other_name", name=odd[0], answer=quoted(answer)), hint=reply("number.only_asked"))
    if odd:
        raise _other_unit(exercise, odd[0])
    if not unit and found.of_pi and exercise.unit.lower() in names_of("degrees"):
        unit = "radians"
    return _in_the_unit(exercise, found.value, unit) if unit else found.value


def _odd_words(exercise: Exercise, found: TypedNumber, unit: str) -> list[str]:
    """The words beside a number, other than its unit, that neither belong to the question nor fill a sentence."""
    words = [(word, False) for word in (*found.before, *found.after)]
    if found.after:
        words[-1] = found.after[-1], True
    return [
        word
        for word, is_last in words
        if word != unit and not (_is_in_place(exercise, word, is_last) or _is_of_the_unit(exercise, word))
    ]


def _other_thing(exercise: Exercise, found: TypedNumber) -> str:
    """The noun beside a number, where it is not what the question counts; of one without a unit a noun that is counted."""
    phrase = list(takewhile(lambda word: word.lower() not in _PREPOSITIONS, found.after))
    before = found.before[0].lower() if not found.after and len(found.before) == 1 else ""
    is_counted = bool(exercise.unit) and exercise.unit.lower() not in UNITS
    if not phrase and (before.endswith("s") or (is_counted and len(before) > 1 and before not in WORDS["labels"].split())):
        phrase = list(found.before)  # as in "cells: 9" and "height 10"
    no_nouns = _FILLING | _no_units(exercise)
    nouns = [word for word in phrase if word.lower() not in no_nouns and word.lower() not in UNITS]
    if exercise.kind != "number" or not nouns or any(_is_of_the_unit(exercise, word) for word in nouns):
        return ""
    return nouns[-1] if exercise.unit or nouns[-1].lower().endswith("s") else ""


def _is_of_the_unit(exercise: Exercise, word: str) -> bool:
    if word == "F" and what_is_asked(exercise) == "strokes":  # the symbol that draws one
        return True
    units = (exercise.unit, gettext(exercise.unit))
    return bool(exercise.unit) and any(means_the_same(word, unit) for unit in units)


def _in_the_unit(exercise: Exercise, number: Value, unit: str) -> Value:
    in_the_text = exercise.kind == "table" and bool(names_of(unit) & {*_words_of(exercise), *exercise.question.lower().split()})
    if exercise.unit.lower() in names_of(unit) or (in_the_text and not exercise.unit):
        return number
    same = converted(number, unit, exercise.unit)
    if same is None and unit in names_of("%") and not exercise.unit:
        same = number / 100
    if same is None:
        raise _other_unit(exercise, unit)
    return same


def _other_unit(exercise: Exercise, word: str) -> ModelNameError:
    return ModelNameError(
        reply("number.other_unit", unit=quotable(word)),
        hint=reply("number.its_unit", unit=gettext(exercise.unit)) if exercise.unit else reply("number.without_unit"),
    )


def _asks_for_decimals(exercise: Exercise, answer: object) -> bool:
    """Whether the comma of an answer such as 1,272 is a decimal one: a number with decimals, below 1000, is asked for."""
    whole, point, _ = exercise.solution.strip().lstrip("+-").partition(".")
    decimals = bool(exercise.tolerance or point) and exercise.kind == "number"
    if decimals and isinstance(answer, str) and whole.isdigit() and len(whole) > 3 and re.search(r"\d,\d{3}(?!\d)", answer):
        raise ModelValueError(reply("number.comma", answer=quoted(answer)), hint=reply("number.point"))
    return decimals


def _distance(own: Value, wanted: Value) -> Any:
    """How far two numbers are apart, exactly where they are exact."""
    try:
        return abs(own - wanted)
    except OverflowError:
        return math.inf


def _tolerance(exercise: Exercise, own: Value) -> Value:
    """How far an answer may be from the solution: not at all where both are written as fractions.

    >>> share = Exercise("1", "", "number", "", "1/8", "", (), tolerance=0.01)
    >>> _tolerance(share, Fraction(3, 23)), _tolerance(share, Fraction(13, 100))
    (0, 0.01)
    """
    is_fraction = isinstance(own, Fraction) and bool(10**MOST_DECIMALS % own.denominator)
    return 0 if is_fraction and "/" in exercise.solution else exercise.tolerance


def same_number(exercise: Exercise, own: Value, wanted: Value) -> bool:
    """Whether two numbers are equal, within the tolerance of the question; doubles up to rounding.

    >>> same_number(Exercise("1", "", "number", "", "", "", (), tolerance=1), 20, 21)
    True
    """
    if _distance(own, wanted) <= _tolerance(exercise, own):
        return True
    with suppress(OverflowError):  # a whole number beyond all doubles equals none of them
        inexact = isinstance(own, float) or isinstance(wanted, float)
        return inexact and math.isclose(own, wanted, rel_tol=1e-9, abs_tol=1e-12)
    return False


def _number_difference(exercise: Exercise, number: Value, solution: Value) -> Difference:
    is_long = isinstance(number, Fraction) and number.denominator > MOST_DENOMINATOR
    shown = f"{float(number):.10g}" if isinstance(number, float) or is_long else number_text(number)
    measured = f" {gettext(exercise.unit)}" if exercise.unit.lower() in UNITS else ""
    said = reply("number.not_asked_for", number=f"{shown}{measured}")
    if "contrary" in exercise.expects and not 0 <= number <= 1:
        return Difference(f"{said} {reply('number.probability')}")
    counted = (exercise.unit and exercise.unit.lower() not in UNITS) or what_is_asked(exercise)
    if counted and isinstance(solution, int) and (number != int(number) or number < 0):
        return Difference(f"{said} {reply('number.not_negative' if number < 0 else 'number.whole')}")
    if exercise.tolerance and _distance(number, solution) <= 3 * _tolerance(exercise, number):
        return Difference(f"{said} {reply('number.close')}", 1, True)
    if decimals := _too_few_decimals(exercise, number, solution):
        return Difference(f"{said} {reply('number.decimals', number=decimals)}", 1, True)
    related = _related(exercise, number, solution)
    shown = f"{_with_this(exercise, number)} {with_values(exercise.otherwise, number)}".strip()
    message = " ".join(filter(None, (said, related, shown or _try_small(exercise))))
    return Difference(message, near=bool(related and counted), explains=_is_of_a_distant_step(exercise, number))


def _is_of_a_distant_step(exercise: Exercise, number: Value) -> bool:
    """Whether a number is that of another step than those beside the one that is asked for."""
    if what_is_asked(exercise) not in _COUNTED or exercise.steps < 2:
        return False
    values = right_history(exercise).values(exercise, exercise.steps)
    return number in values[: exercise.steps - 1]


def _too_few_decimals(exercise: Exercise, number: Value, solution: Value) -> int:
    """How many decimals a number has that is the right one, rounded to fewer than are asked for; 0 where it is not that."""
    if not exercise.tolerance or number == int(number):
        return 0
    found = (places for places in range(1, 6) if _distance(number, round(float(solution), places)) < 1e-12)
    return next(found, 0)


def _related(exercise: Exercise, number: Value, solution: Value) -> str:
    """What is said of a number that is one off, where things are counted."""
    asked = what_is_asked(exercise)
    counts = (asked or exercise.unit) and asked != "first" and exercise.unit.lower() not in UNITS and not exercise.tolerance
    return reply("number.one_off") if counts and _distance(number, solution) == 1 < _distance(solution, 0) - 2 else ""


def _with_this(exercise: Exercise, number: Value) -> str:
    """What the system has at the step that is answered, or what it would need for the number that is answered."""
    what, asked = what_is_asked(exercise), exercise.asks
    if not isinstance(number, int) or what not in ("first", "length", "count", "strokes"):
        return ""
    history = right_history(exercise)
    if what == "first":
        if not 0 <= number <= last_step(exercise):
            return reply("number.a_length") if number > 0 else ""
        length = history.values(exercise, number)[number]
        kind = "step_is_past" if length > bound_of(exercise) else "step_is_not_past"
        return reply(f"number.{kind}", step=number, number=f"{length:,}", bound=f"{bound_of(exercise):,}")
    if exercise.steps < 2 or number < 0:
        return ""
    values = history.values(exercise, exercise.steps)
    before, same = values[exercise.steps - 1], [step for step, value in enumerate(values) if value == number]
    if same:
        return reply("number.of_step", step=same[-1], number=number)
    if asked == what and 0 < before < number:
        return reply("number.more_made", step=exercise.steps - 1, before=before, number=number, more=number - before)
    if number < before and sorted(values) == values:
        return reply("number.fewer", step=exercise.steps - 1, before=before)
    return ""


def with_values(text: str, number: Value) -> str:
    """A reply with the values of the formulas in braces, in which `answer` is the number; another one if one has no value.

    >>> with_values("Twice that is {2*answer}. Its root is {sqrt(answer)}. And now?", 9)
    'Twice that is 18. Its root is 3. And now?'
    >>> with_values("The root of it is {sqrt(answer)}. Is that right?", -3)
    'Put it into the formulas of the question: there it has no value.'
    """
    try:
        return FORMULA.sub(lambda found: _rounded(formula_in_reply(found[1])((number,))), text)
    except (ArithmeticError, ValueError, LSystemError):
        return reply("number.no_value")


def formula_in_reply(text: str) -> Function:
    """The function of `answer` that a reply computes."""
    return function_of(checked_expression(text, ("answer",)), {"answer": 0})


def _rounded(value: Value) -> str:
    double = float(value)
    if abs(double) >= 10_000:
        return written(f"{double:,.0f}")
    is_whole = math.isclose(double, round(double), abs_tol=1e-12)
    texts = (f"{double:.{digits}g}" for digits in (4, 6, 8, 10, 17))
    return written(next(text for text in texts if is_whole or float(text) % 1))


def _try_small(exercise: Exercise) -> str:
    """What to compare one's way of counting with: the first steps, which can be written down."""
    if what_is_asked(exercise) not in ("length", "count", "strokes") or exercise.steps < 4:
        return ""
    values = right_history(exercise).values(exercise, 2)
    return reply("number.small_step", number=values[2])


def _honest_number(_: Exercise, number: Value, solution: Value) -> bool:
    if not solution:
        return bool(0 < _distance(number, 0) <= MOST_APART)
    size, wanted = _distance(number, 0), _distance(solution, 0)
    return bool(number and wanted <= MOST_APART * size and size <= MOST_APART * wanted)


NUMBER = AnswerKind(_read_number, _number_difference, same_number, _honest_number)


# Rows and tables

_NO_ONE = frozenset(["none", "nothing", "keine", "keiner", "nichts"])
"""Words for no number of a row."""


def _read_table(exercise: Exercise, answer: object) -> tuple[Value, ...]:
    found = _by_symbols(exercise, answer) or parts(answer, reply("table.what"))
    if len(found) > 1 and what_is_asked(exercise):
        found = ["0" if isinstance(part, str) and part.lower() in _NO_ONE else part for part in found]
    found = [part for part in found if not _is_a_word_in_place(exercise, part)]
    found = _without_symbols(exercise, found)
    if not found:
        raise ModelValueError(reply("table.none"))
    return tuple(_read_number(exercise, part) for part in found)


_OF_A_SYMBOL = re.compile(
    r"\W*+(?:(\d++)\s*+(?>(?:\*\s*+)?(?:(?:tokens?|marken?)\s++)?(?:in\s++)?)([^\W\d]\w*+)"
    r"|([^\W\d]\w*+)\s*+(?:[:=]|has\b|hat\b)\s*+(\d++)|([^\W\d_])(\d++))\W*+"
)
"""A number with its symbol, as in "2 L", "L: 2" and "L2"."""
_GLUED_ROW = re.compile(r"\s*+(?:[^\W\d_]\d++\s++)*[^\W\d_]\d++\s*+")


def _by_symbols(exercise: Exercise, answer: object) -> list[object]:
    """The numbers of a row in which each stands with its symbol, in the order of the question; nothing where it is none."""
    if not isinstance(answer, str) or what_is_asked(exercise) != "counts" or len(exercise.symbols) < 2:
        return []
    text = with_digits(unquoted(keyboard_text(answer)))
    between = r"\s+" if _GLUED_ROW.fullmatch(text) else r"[,;\n]|\band\b|\bund\b"
    found = [_OF_A_SYMBOL.fullmatch(part) for part in re.split(between, text) if part.strip()]
    numbers = {each[2] or each[3] or each[5]: each[1] or each[4] or each[6] for each in found if each}
    given, names = [*numbers], exercise.symbols
    in_order = given == [*names[: len(given)]] and not any(each and each[5] for each in found)
    if len(numbers) < max(len(found), 2) or not set(given) <= set(names) or in_order:
        return []
    if missing := [symbol for symbol in names if symbol not in numbers]:
        raise ModelValueError(reply("table.no_number_for", symbols=", ".join(missing)))
    return [numbers[symbol] for symbol in names]


def _without_symbols(exercise: Exercise, found: list[object]) -> list[object]:
    """The numbers of a row such as 1S, 2L, in the order of the question's symbols."""
    numbers: dict[str, object] = {}
    for part in found:
        counted = re.fullmatch(r"(\d+)\*?([^\W\d]\w*)", part) if isinstance(part, str) else None
        if counted is None or counted[2] not in exercise.symbols or counted[2] in numbers:
            return found
        numbers[counted[2]] = counted[1]
    return [numbers[symbol] for symbol in exercise.symbols] if len(numbers) == len(exercise.symbols) else found


def _is_a_word_in_place(exercise: Exercise, part: object) -> bool:
    if not isinstance(part, str) or not part.isalpha():
        return False
    return part.lower() not in _DOUBTFUL and (
        _is_in_place(exercise, part) or bool(names_of(part) & {word for each in _words_of(exercise) for word in names_of(each)})
    )


def _same_table(exercise: Exercise, own: tuple[Value, ...], wanted: tuple[Value, ...]) -> bool:
    return len(own) == len(wanted) and all(same_number(exercise, a, b) for a, b in zip(own, wanted, strict=True))


def _numbers_right(exercise: Exercise, own: tuple[Value, ...], wanted: tuple[Value, ...]) -> tuple[int, int]:
    return sum(same_number(exercise, a, b) for a, b in zip(own, wanted, strict=False)), max(len(own), len(wanted))


def _table_difference(exercise: Exercise, own: tuple[Value, ...], solution: tuple[Value, ...]) -> Difference:
    pairs = zip(own, solution, strict=False)
    last = min(len(own), len(solution))
    at = next((i for i, (a, b) in enumerate(pairs) if not same_number(exercise, a, b)), last)
    said = [] if len(own) == len(solution) else [reply("table.count", number=len(own), asked=len(solution))]
    exchanged = _exchanged(exercise, own, solution)
    begins = len(own) - len(solution)
    in_steps = len(own) == len(solution) > 2 and bool(_steps_of(exercise))
    if in_steps and _same_table(exercise, own[1:], solution[:-1]):
        said.append(reply("table.late"))
    elif in_steps and _same_table(exercise, own[:-1], solution[1:]):
        said.append(reply("table.early"))
    elif begins > 0 and _same_table(exercise, own[begins:], solution):
        return Difference(reply("table.begins_early", number=begins), 1, True, explains=True)
    elif len(own) == 1 < len(solution):
        pass
    elif exchanged:
        said.append(reply("table.exchanged", one=exchanged[0], other=exchanged[1]))
    elif at == last:
        said.append(reply("table.agree"))
    else:
        said += [reply("table.first_right", number=at)] if at > 1 else []
        said.append(_look_at(exercise, at, number_text(own[at])))
    return Difference(" ".join(said), at / max(len(own), len(solution), 1), one_apart(own, solution))


def _exchanged(exercise: Exercise, own: Sequence[Value], solution: Sequence[Value]) -> list[int]:
    """The two places whose numbers are exchanged, from 1, where nothing else is wrong."""
    if len(own) != len(solution):
        return []
    wrong = [at for at, (a, b) in enumerate(zip(own, solution, strict=True)) if not same_number(exercise, a, b)]
    is_swap = len(wrong) == 2 and own[wrong[0]] == solution[wrong[1]] and own[wrong[1]] == solution[wrong[0]]
    return [at + 1 for at in wrong] if is_swap else []


def _steps_of(exercise: Exercise) -> Sequence[int]:
    """The steps whose numbers stand in a row, if it is one of steps."""
    return asked_steps(exercise) if what_is_asked(exercise) in ("lengths", "counts") and not exercise.symbols else ()


def _look_at(exercise: Exercise, at: int, own: str) -> str:
    what, names = what_is_asked(exercise), exercise.symbols
    if what == "matrix" and names and at < len(names) ** 2:
        symbol, row = names[at % len(names)], names[at // len(names)]
        return reply("table.number_of_entry", at=at + 1, symbol=symbol, row=row, number=own)
    if what == "counts" and at < len(names):
        return reply("table.number_of_symbol", at=at + 1, symbol=names[at], number=own)
    steps = _steps_of(exercise)
    if at < len(steps):
        return reply("table.number_of_step", at=at + 1, step=steps[at], number=own)
    return reply("table.number", at=at + 1, number=own)


def _honest_table(_: Exercise, own: tuple[Value, ...], solution: tuple[Value, ...]) -> bool:
    return any(own) or own == solution[: len(own)]


TABLE = AnswerKind(_read_table, _table_difference, _same_table, _honest_table, parts_right=_numbers_right)
