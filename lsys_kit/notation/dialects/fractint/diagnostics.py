"""What is asked about a slip in a system of Fractint's, the most telling first."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.failure import Stumble, quoted
from lsys_kit.notation.syntax.statements import ARROW

_RULE = 'A rule reads "F=F+F", each on a line of its own.'
_LINES = f'A line is "Angle 6", "Axiom F--F--F" or a rule. {_RULE}'


def _line(stumble: Stumble) -> str:
    """The line, in which "/*" is no comment."""
    return stumble.source[stumble.start:stumble.end]


def _colon(stumble: Stumble) -> ModelSyntaxError | None:
    """A keyword with a colon, as in other notations."""
    keyword = re.match(r"\s*(angle|axiom)\s*:", _line(stumble), re.IGNORECASE)
    if keyword and stumble.at <= stumble.start + keyword.end():
        example = "Angle 6" if keyword[1].lower() == "angle" else "Axiom F--F--F"
        return stumble.error('No ":" stands here in Fractint', f'Type "{example}".', stumble.start + keyword.end() - 1, 1)
    return None


def _angle(stumble: Stumble) -> ModelSyntaxError | None:
    if not re.match(r"angle\b", _line(stumble), re.IGNORECASE):
        return None
    whole = 'It is a whole number: "Angle 6" makes + and - turn by a sixth of a full turn, 60 degrees.'
    if "COUNT" in stumble.accepted or stumble.at == stumble.start:
        return stumble.error("How many parts a full turn has is missing", whole, max(stumble.at, stumble.start + len("angle")))
    return stumble.error(f"I did not expect {quoted(stumble.found)} behind the angle", whole)


def _axiom(stumble: Stumble) -> ModelSyntaxError | None:
    if not stumble.found and re.fullmatch(r"axiom\s*=?", _line(stumble), re.IGNORECASE):
        return stumble.error("The axiom is missing", 'It is the word with which the system begins, as in "Axiom F--F--F".')
    return None


def _arrow(stumble: Stumble) -> ModelSyntaxError | None:
    """An arrow where Fractint has an equals sign."""
    line = _line(stumble)
    arrow = ARROW.search(line)
    if arrow and re.fullmatch(r"\S\s*", line[:arrow.start()]):
        return stumble.error("Fractint has no arrow", f'Type "{line[0]}={line[arrow.end():].strip()[:20]}".',
                             stumble.start + arrow.start(), len(arrow[0]))
    return None


def _beginning(stumble: Stumble) -> ModelSyntaxError | None:
    """A line that begins like no line of a system."""
    if stumble.at != stumble.start:
        return None
    if stumble.found == "}":
        return stumble.error('This "}" closes nothing', 'A system begins with its name and "{", as in "Koch {".')
    line = _line(stumble)
    head = re.match(r"[^\s=]{2,}(?=\s*=)", line)
    if head:
        return stumble.error("A rule rewrites one character", f'{quoted(head[0])} are several. {_RULE}', None, len(head[0]))
    if len(line) == 1 and line not in "={}":
        return stumble.error("This rule says nothing", f'To erase {line}, write "{line}=".')
    return stumble.error("I do not know what this line is to say", _LINES, None, len(line.split()[0]))


def _in_a_word(stumble: Stumble) -> ModelSyntaxError | None:
    if stumble.found == "=":
        return stumble.error('A second "=" stands here', _RULE)
    if stumble.found == "}":
        return stumble.error('This "}" closes nothing', 'A system begins with its name and "{", as in "Koch {".')
    if stumble.found == "%":
        return stumble.error('"%" is no symbol here', "In this kit it cuts off a branch, which Fractint does not know. "
                             "Take another character.")
    if stumble.found:
        return stumble.error(f"{named(stumble.found[0])} is no symbol",
                             'Symbols are letters, digits and signs of ASCII, but not ";", "=", "{" and "}".')
    return None


QUESTIONS = (_colon, _angle, _axiom, _arrow, _beginning, _in_a_word)
"""The questions, in the order in which they are asked."""
