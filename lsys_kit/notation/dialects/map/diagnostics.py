"""What the parser stumbled over in a map system, in the words of the person who typed it."""

from __future__ import annotations

import re
from collections.abc import Mapping, Sequence

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.dialect import Question
from lsys_kit.notation.syntax.failure import Stumble, printed, quoted, unclosed
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


def _setting(stumble: Stumble) -> ModelSyntaxError | None:
    """A word with a colon, which maps do not have; or the first cell without its colon, or without walls."""
    statement = stumble.text[stumble.start:stumble.end]
    setting, axiom = _SETTING.match(statement), _AXIOM.match(statement)
    if axiom and not ARROW.search(statement):
        return _first_cell(stumble, axiom[1], statement[axiom.end():].strip())
    if setting and setting[1].lower() == "steps":
        return stumble.error('Behind "steps:" a whole number is needed', 'Type "steps: 4".', stumble.start, 5)
    if setting and not ARROW.search(statement):
        return stumble.error(f'A map system has no "{setting[1]}:"', 'It has "map:", "steps:" and productions.', stumble.start,
                             len(setting[1]))
    return None


def _first_cell(stumble: Stumble, word: str, rest: str) -> ModelSyntaxError | None:
    """The first cell without its colon, or without walls."""
    walls = rest.lstrip(":= \t")
    if not walls:
        return stumble.error("The first cell has no walls", _FIRST, stumble.start, len(word))
    if rest[0] != ":" and (rest[0] != "=" or word.isascii()):
        return stumble.error(f'A ":" is missing behind "{word}"', f'Type "map: {printed(walls)}".', stumble.start, len(word))
    return None


def _comment(stumble: Stumble) -> ModelSyntaxError | None:
    found = re.match("#|//|%", stumble.text[stumble.start:stumble.end])
    return stumble.error("This is no production", 'A comment stands between "/*" and "*/".', stumble.start,
                         len(found.group())) if found else None


def _brackets(stumble: Stumble) -> ModelSyntaxError | None:
    """Markers: their brackets, their side, their letter."""
    opened = unclosed(stumble.before, "[]")
    if stumble.found == "]" and opened is None:
        return stumble.error('This "]" closes nothing', _MARKER)
    if "ARROW" in stumble.accepted or not ARROW.search(stumble.text, stumble.start, stumble.end):
        return stumble.error("A marker stands here", "Markers stand behind the arrow of a production.") \
            if stumble.found == "[" else None
    if opened is None:
        return None
    at = stumble.start + opened
    if not stumble.found or ("RSQB" in stumble.accepted and ARROW.match(stumble.found)):
        return stumble.error('This "[" is never closed', _MARKER, at, 1)
    if stumble.accepted == {"SIDE"} and stumble.found != "[":
        return stumble.error("This marker does not say on which side it stands",
                             "Left of the wall is +, right is -, seen in its direction.")
    if stumble.found == "]" and "LABEL" in stumble.accepted:
        return stumble.error("This marker has no letter", _MARKER)
    if stumble.found in ("+", "-", "−") and "LABEL" in stumble.accepted:
        return stumble.error("A marker stands on one side", 'For both sides write two: "[-A][+A]".')
    if "RSQB" in stumble.accepted and stumble.found.isalnum():
        return stumble.error("A marker has one letter", 'Write a marker for each: "[-A][-B]".')
    return None


def _arrows(stumble: Stumble) -> ModelSyntaxError | None:
    arrow = ARROW.search(stumble.text, stumble.start, stumble.end)
    if ARROW.match(stumble.found):
        if arrow and arrow.start() < stumble.at:
            return stumble.error("A second arrow stands in this production", "Write one production a line.")
        if "ARROW" not in stumble.accepted:
            return stumble.error("Nothing stands before the arrow" if not stumble.before else "An arrow cannot stand here",
                                 _PRODUCTION)
    if not stumble.found and arrow and arrow.end() - stumble.start >= len(stumble.before):
        return stumble.error("Nothing stands behind the arrow", "Walls are never erased: write what this one becomes.",
                             arrow.start(), len(arrow.group()))
    if arrow is None and "ARROW" in stumble.accepted:
        spelt = _ARROWS.match(stumble.text, stumble.at, stumble.end)
        if spelt:
            return stumble.error("This is no arrow", 'An arrow is typed "->", in one piece.', length=len(spelt.group()))
        return stumble.error("An arrow is missing here", _PRODUCTION)
    return None


def _walls(stumble: Stumble) -> ModelSyntaxError | None:
    """What stands beside a wall."""
    if stumble.found in ("<", ">"):
        message = "A second {} stands here" if re.search(r"\w[<>]$", stumble.before) else "No wall stands before this {}"
        return stumble.error(message.format(quoted(stumble.found)),
                             'A wall points one way, and its arrow stands behind its letter: A> or A<.')
    if "ARROW" in stumble.accepted and stumble.found[:1].isalpha() and stumble.found.isascii():
        return stumble.error("Only one wall can be replaced", "Maps have no contexts. Write a production for each wall.")
    if stumble.found[:1].isdigit():
        return stumble.error("A number stands alone here", "Walls are letters, perhaps with a digit behind: A, A1.")
    return stumble.error(*_SIGNS[stumble.found]) if stumble.found in _SIGNS else None


def _unreadable(stumble: Stumble) -> ModelSyntaxError | None:
    if not stumble.found or stumble.found.isascii() or stumble.found[0] in "→⟶ω−":
        return None
    return stumble.error(f"I cannot read the character {named(stumble.found[0])}", "Walls are letters from A to Z.", length=1)


QUESTIONS: Sequence[Question] = (_comment, _setting, _brackets, _arrows, _walls, _unreadable)
"""What is asked about a slip in a map system, the most telling first."""
