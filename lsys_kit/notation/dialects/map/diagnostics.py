"""What the parser stumbled over in a map system, in the words of the person who typed it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, excerpt, quoted, unclosed_bracket
from lsys_kit.notation.syntax.statements import ARROW

_PRODUCTION = 'A production reads "A -> B[-A][+A]B": a wall, an arrow, the walls that it becomes, with markers between them.'
_MARKER = 'A marker reads "[-A]" or "[+A]": the side of the wall, the letter of a wall to come.'
_FIRST = 'Give the walls of the first cell, one after another, clockwise, as in "map: ABAB".'
_ARROWS = re.compile(r"::=|:=|=>|⇒|↦|[–—−~]>|-[ \t]+>|=")
_SETTING = re.compile(r"([A-Za-z]{2,})[ \t]*:")
_AXIOM = re.compile(r"(map|axiom|omega|ω)\b", re.IGNORECASE)
_SIGNS: Mapping[str, tuple[str, str]] = {
    "(": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ")": ("A wall has no values", "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."),
    ":": ("A wall has no condition", _PRODUCTION),
    ";": ('A ";" is not needed here', "Write one production a line."),
    ",": ('A "," is not needed here', "Walls stand side by side, with or without blanks between them."),
    "ε": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "*": ("A wall cannot be erased", "A map is propagating: every wall becomes one wall or several."),
    "_": ("A letter has no subscript here", "Write the number behind the letter, as in A1."),
    "+": ('This "+" stands outside of a marker', _MARKER),
    "-": ('This "-" stands outside of a marker', _MARKER),
    "[": ("A marker stands inside a marker", _MARKER),
}
"""What stands in other systems and not in maps: what to say of it, what to write."""


def _setting(failure: ParseFailure) -> ModelSyntaxError | None:
    """A word with a colon, which maps do not have; or the first cell without its colon, or without walls."""
    statement = failure.text[failure.start:failure.end]
    setting, axiom = _SETTING.match(statement), _AXIOM.match(statement)
    if axiom and not ARROW.search(statement):
        return _first_cell(failure, axiom[1], statement[axiom.end():].strip())
    if setting and setting[1].lower() == "steps":
        return failure.error('Behind "steps:" a whole number is needed', 'Type "steps: 4".', failure.start, 5)
    if setting and not ARROW.search(statement):
        return failure.error(f'A map system has no "{setting[1]}:"', 'It has "map:", "steps:" and productions.', failure.start,
                             len(setting[1]))
    return None


def _first_cell(failure: ParseFailure, word: str, rest: str) -> ModelSyntaxError | None:
    """The first cell without its colon, or without walls."""
    walls = rest.lstrip(":= \t")
    if not walls:
        return failure.error("The first cell has no walls", _FIRST, failure.start, len(word))
    if rest[0] != ":" and (rest[0] != "=" or word.isascii()):
        return failure.error(f'A ":" is missing behind "{word}"', f'Type "map: {excerpt(walls)}".', failure.start, len(word))
    return None


def _comment(failure: ParseFailure) -> ModelSyntaxError | None:
    found = re.match("#|//|%", failure.text[failure.start:failure.end])
    return failure.error("This is no production", 'A comment stands between "/*" and "*/".', failure.start,
                         len(found.group())) if found else None


def _brackets(failure: ParseFailure) -> ModelSyntaxError | None:
    """Markers: their brackets, their side, their letter."""
    opened = unclosed_bracket(failure.before, "[]")
    if failure.found == "]" and opened is None:
        return failure.error('This "]" closes nothing', _MARKER)
    if "ARROW" in failure.accepted or not ARROW.search(failure.text, failure.start, failure.end):
        return failure.error("A marker stands here", "Markers stand behind the arrow of a production.") \
            if failure.found == "[" else None
    if opened is None:
        return None
    at = failure.start + opened
    if not failure.found or ("RSQB" in failure.accepted and ARROW.match(failure.found)):
        return failure.error('This "[" is never closed', _MARKER, at, 1)
    if failure.accepted == {"SIDE"} and failure.found != "[":
        return failure.error("This marker does not say on which side it stands",
                             "Left of the wall is +, right is -, seen in its direction.")
    if failure.found == "]" and "LABEL" in failure.accepted:
        return failure.error("This marker has no letter", _MARKER)
    if failure.found in ("+", "-", "−") and "LABEL" in failure.accepted:
        return failure.error("A marker stands on one side", 'For both sides write two: "[-A][+A]".')
    if "RSQB" in failure.accepted and failure.found.isalnum():
        return failure.error("A marker has one letter", 'Write a marker for each: "[-A][-B]".')
    return None


def _arrows(failure: ParseFailure) -> ModelSyntaxError | None:
    arrow = ARROW.search(failure.text, failure.start, failure.end)
    if ARROW.match(failure.found):
        if arrow and arrow.start() < failure.at:
            return failure.error("A second arrow stands in this production", "Write one production a line.")
        if "ARROW" not in failure.accepted:
            return failure.error("Nothing stands before the arrow" if not failure.before else "An arrow cannot stand here",
                                 _PRODUCTION)
    if not failure.found and arrow and arrow.end() - failure.start >= len(failure.before):
        return failure.error("Nothing stands behind the arrow", "Walls are never erased: write what this one becomes.",
                             arrow.start(), len(arrow.group()))
    if arrow is None and "ARROW" in failure.accepted:
        spelt = _ARROWS.match(failure.text, failure.at, failure.end)
        if spelt:
            return failure.error("This is no arrow", 'An arrow is typed "->", in one piece.', length=len(spelt.group()))
        return failure.error("An arrow is missing here", _PRODUCTION)
    return None


def _walls(failure: ParseFailure) -> ModelSyntaxError | None:
    """What stands beside a wall."""
    if failure.found in ("<", ">"):
        message = "A second {} stands here" if re.search(r"\w[<>]$", failure.before) else "No wall stands before this {}"
        return failure.error(message.format(quoted(failure.found)),
                             'A wall points one way, and its arrow stands behind its letter: A> or A<.')
    if "ARROW" in failure.accepted and failure.found[:1].isalpha() and failure.found.isascii():
        return failure.error("Only one wall can be replaced", "Maps have no contexts. Write a production for each wall.")
    if failure.found[:1].isdigit():
        return failure.error("A number stands alone here", "Walls are letters, perhaps with a digit behind: A, A1.")
    return failure.error(*_SIGNS[failure.found]) if failure.found in _SIGNS else None


def _unreadable(failure: ParseFailure) -> ModelSyntaxError | None:
    if not failure.found or failure.found.isascii() or failure.found[0] in "→⟶ω−":
        return None
    return failure.error(f"I cannot read the character {named(failure.found[0])}", "Walls are letters from A to Z.", length=1)


DIAGNOSTICS: Sequence[Diagnostic] = (_comment, _setting, _brackets, _arrows, _walls, _unreadable)
"""What is asked about a slip in a map system, the most telling first."""
