"""Choices as answers: one of some options, one symbol of a word, one line of a program."""

from __future__ import annotations

import re
from string import ascii_uppercase

from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.kinds.kind import AnswerKind, Difference
from lsys_kit.classroom.exercises.typed import quoted, text_answer
from lsys_kit.errors import ModelNameError, ModelValueError, whole_number

# One of some options


def letters(exercise: Exercise) -> str:
    """The letters of the options of a choice."""
    return ascii_uppercase[: len(exercise.options)]


def listing(exercise: Exercise) -> str:
    """What stands below a question, in Markdown: the options of a choice, or the numbered lines of a program.

    >>> listing(Exercise("1", "", "line", "", "2", "", (), text="a\\nb")).splitlines()[2:]
    ['     1  a', '     2  b']
    """
    if exercise.options:
        options = zip(letters(exercise), exercise.options, strict=True)
        return "\n\n" + "\n".join(f"- **{letter}** {option.text}" for letter, option in options)
    if exercise.kind == "line":
        lines = exercise.text.strip("\n").splitlines()
        return "\n\n" + "\n".join(f"    {number:2}  {line}" for number, line in enumerate(lines, 1))
    return ""


def _plain(text: str) -> str:
    return " ".join(text.replace("`", "").split()).strip(".\"'").casefold()


def _read_choice(exercise: Exercise, answer: object) -> str:
    text = text_answer(answer, "An option", '"A"').strip()
    known = letters(exercise)
    by_text = {_plain(option.text): letter for option, letter in zip(exercise.options, known, strict=True)}
    letter = re.sub(r"^(option|answer)\s+", "", text, flags=re.IGNORECASE).strip(" ().:\"'").upper()
    if letter in known and len(letter) == 1:
        return letter
    if _plain(text) in by_text:
        return by_text[_plain(text)]
    raise ModelNameError(f'"{quoted(text)}" is none of the options', hint=f"Choose one of: {', '.join(known)}.")


def _choice_difference(exercise: Exercise, own: str, _: str) -> Difference:
    says = exercise.options[letters(exercise).index(own)].says
    return Difference(says or exercise.otherwise or f"{own} is not the right one.")


CHOICE = AnswerKind(
    'option, as its letter in quotation marks, such as "A"',
    _read_choice,
    lambda _, a, b: a == b,
    _choice_difference,
    lambda *_: True,
)


# One symbol


def _units(text: str) -> list[str]:
    """The symbols of a text: what stands between its blanks, or its characters."""
    return text.split() if " " in text.strip() else [*text.strip()]


def _read_symbol(exercise: Exercise, answer: object) -> tuple[str, int]:
    """The symbol, and its position from 1; 0 where the symbol alone was given and does not stand there once."""
    units = _units(exercise.text)
    text = (
        str(answer).strip().strip("\"'`")
        if isinstance(answer, int) and not isinstance(answer, bool)
        else text_answer(answer, "A symbol", '"["').strip().strip("\"'`")
    )
    text = re.sub(r"^(position|symbol|no\.?|number)\s+", "", text, flags=re.IGNORECASE)
    if text.isascii() and text.isdigit() and text not in units:
        if not units or not 1 <= int(text[:9]) <= len(units):
            raise ModelValueError(
                f"The word has the positions 1 to {len(units)}" if units else "A symbol is needed, not a number"
            )
        return units[int(text) - 1], int(text)
    if units and text not in units and exercise.symbols and text not in exercise.symbols:
        raise ModelNameError(f'The symbol "{quoted(text)}" does not occur in the question')
    if not text or len(text.split()) > 1 or (len(text) > 1 and all(len(unit) == 1 for unit in units)):
        raise ModelValueError("One symbol is needed, or its position")
    return text, units.index(text) + 1 if units.count(text) == 1 else 0


def _same_symbol(_: Exercise, own: tuple[str, int], wanted: tuple[str, int]) -> bool:
    return own[0] == wanted[0] and (own[1] == wanted[1] or not wanted[1])


def _symbol_difference(exercise: Exercise, own: tuple[str, int], wanted: tuple[str, int]) -> Difference:
    if own[0] == wanted[0] and not own[1]:
        return Difference("It occurs several times: give its position, counted from 1.", 1, True)
    return Difference(exercise.otherwise or f"{own[0]} is not the one that is asked for.")


SYMBOL = AnswerKind(
    "symbol, as a text in quotation marks, or its position", _read_symbol, _same_symbol, _symbol_difference, lambda *_: True
)


# One line


def _read_line(exercise: Exercise, answer: object) -> int:
    lines = exercise.text.strip("\n").splitlines()
    if isinstance(answer, str):
        text = answer.strip().strip("\"'`")
        same = [number for number, line in enumerate(lines, 1) if line.split() == text.split()]
        if len(same) == 1:
            return same[0]
        number = re.sub(r"^line\s+|\.$", "", text, flags=re.IGNORECASE)
        if not (number.isascii() and number.isdigit() and len(number) < 9):
            raise ModelValueError(f'"{quoted(text)}" is no line of the program', hint=f"Give a number from 1 to {len(lines)}.")
        answer = int(number)
    found = whole_number(answer, "The number of a line")
    if not 1 <= found <= len(lines):
        raise ModelValueError(f"The program has the lines 1 to {len(lines)}")
    return found


def _line_difference(exercise: Exercise, own: int, _: int) -> Difference:
    return Difference(f"It is not line {own}. {exercise.otherwise}".strip())


LINE = AnswerKind("line, as its number", _read_line, lambda _, a, b: a == b, _line_difference, lambda *_: True)
