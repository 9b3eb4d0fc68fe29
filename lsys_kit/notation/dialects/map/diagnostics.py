"""Diagnostics of a map system."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.dialects.map.spelling import RULE_EXAMPLE
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import ARROW

_MARKER = 'A marker reads "[-A]" or "[+A]": the side of the wall, the letter of a wall to come.'
_FIRST_HINT = 'Give the walls of the first cell, one after another, clockwise, as in "map: ABAB".'
_MISSPELT_ARROWS = re.compile(r"::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>|=")
_SETTING = re.compile(r"([A-Za-z]{2,})[ \t]*:")
_FIRST_CELL = re.compile(r"(map|sphere|axiom|omega|ω)\b", re.IGNORECASE)
_FOREIGN_SIGNS: Mapping[str, tuple[str, str]] = {
    "(": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ")": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ":": ("A wall has no condition", RULE_EXAMPLE),
    ";": ('A ";" is not needed here', "Write one production per line."),
    ",": ('A "," is not needed here', "Walls are written side by side, with or without blanks between them."),
    "ε": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "*": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "_": ("A letter has no subscript here", "Write the number after the letter, as in A1."),
    "+": ('This "+" is outside of a marker', _MARKER),
    "-": ('This "-" is outside of a marker', _MARKER),
    "[": ("A marker inside a marker is not possible", _MARKER),
}
"""Signs that other systems have and maps have not: what to say of them, what to write."""


def _foreign_setting(failure: ParseFailure) -> ModelSyntaxError | None:
    """A word with a colon, which maps do not have; or the first cell without its colon, or without walls."""
    statement = failure.statement
    setting, axiom = _SETTING.match(statement), _FIRST_CELL.match(statement)
    if axiom and not ARROW.search(statement):
        return _first_cell(failure, axiom[1], statement[axiom.end() :].strip())
    if setting and setting[1].lower() == "steps":
        return failure.error('After "steps:" a whole number is needed', 'Type "steps: 4".', failure.start, 5)
    if setting and not ARROW.search(statement):
        return failure.error(
            f'A map system has no "{setting[1]}:"', 'It has "map:", "steps:" and productions.', failure.start, len(setting[1])
        )
    return None


def _first_cell(failure: ParseFailure, word: str, rest: str) -> ModelSyntaxError | None:
    """The first cell without its colon, or without walls."""
    walls = rest.lstrip(":= \t")
    if not walls:
        return failure.error("The first cell has no walls", _FIRST_HINT, failure.start, len(word))
    if rest[0] != ":" and (rest[0] != "=" or word.isascii()):
        return failure.error(f'A ":" is missing after "{word}"', f'Type "map: {excerpt(walls)}".', failure.start, len(word))
    return None


def _brackets(failure: ParseFailure) -> ModelSyntaxError | None:
    """Markers: their brackets, their side, their letter."""
    opened = unclosed_bracket(failure.before, "[]")
    if failure.found == "]" and opened is None:
        return failure.error('This "]" closes nothing', _MARKER)
    if "ARROW" in failure.accepted or not ARROW.search(failure.text, failure.start, failure.end):
        return (
            failure.error("A marker is not possible here", "Markers come after the arrow of a production.")
            if failure.found == "["
            else None
        )
    if opened is None:
        return None
    at = failure.start + opened
    if not failure.found or ("RSQB" in failure.accepted and ARROW.match(failure.found)):
        return failure.error('This "[" is never closed', _MARKER, at, 1)
    if failure.accepted == {"SIDE"} and failure.found != "[":
        return failure.error(
            "This marker does not say on which side it is", "Left of the wall is +, right is -, seen in its direction."
        )
    if failure.found == "]" and "LABEL" in failure.accepted:
        return failure.error("This marker has no letter", _MARKER)
    if failure.found in ("+", "-", "−") and "LABEL" in failure.accepted:
        return failure.error("A marker is on one side", 'For both sides write two: "[-A][+A]".')
    if "RSQB" in failure.accepted and failure.found.isalnum():
        return failure.error("A marker has one letter", 'Write a marker for each: "[-A][-B]".')
    return None


def _arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow that is missing, misspelt, or with nothing before or after it."""
    arrow = ARROW.search(failure.text, failure.start, failure.end)
    if ARROW.match(failure.found) and "ARROW" not in failure.accepted:
        return failure.error(
            "An arrow is not possible here" if failure.before else "There is nothing before the arrow", RULE_EXAMPLE
        )
    if not failure.found and arrow and arrow.end() - failure.start >= len(failure.before):
        return failure.error(
            "There is nothing after the arrow",
            "Walls are never erased: write what this one becomes.",
            arrow.start(),
            len(arrow.group()),
        )
    if arrow is None and "ARROW" in failure.accepted:
        spelt = _MISSPELT_ARROWS.match(failure.text, failure.at, failure.end)
        if spelt:
            return failure.error("This is not an arrow", 'An arrow is typed "->", in one piece.', length=len(spelt.group()))
        return failure.error("An arrow is missing here", RULE_EXAMPLE)
    return None


def _walls(failure: ParseFailure) -> ModelSyntaxError | None:
    """Something beside a wall."""
    if failure.found in ("<", ">"):
        message = "This is a second {}" if re.search(r"\w[<>]$", failure.before) else "There is no wall before this {}"
        return failure.error(
            message.format(quoted(failure.found)), "A wall points one way, and its arrow comes after its letter: A> or A<."
        )
    if "ARROW" in failure.accepted and failure.found[:1].isalpha() and failure.found.isascii():
        return failure.error("Only one wall can be replaced", "Maps have no contexts. Write a production for each wall.")
    if failure.found[:1].isdigit():
        return failure.error("A number is not a wall", "Walls are letters, perhaps with a digit after them: A, A1.")
    return failure.error(*_FOREIGN_SIGNS[failure.found]) if failure.found in _FOREIGN_SIGNS else None


DIAGNOSTICS: Sequence[Diagnostic] = (
    "foreign_comment",
    _foreign_setting,
    _brackets,
    "second_arrow",
    _arrow,
    _walls,
    "unreadable_character",
)
"""The diagnostics of a map system, the most specific first."""
