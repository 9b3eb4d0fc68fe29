"""What is wrong with a system in Fractint's notation: the diagnostics, the most specific first."""

from __future__ import annotations

import re

from lsys_kit.errors import ModelSyntaxError, named
from lsys_kit.notation.syntax.failure import ParseFailure, quoted
from lsys_kit.notation.syntax.text.statements import ARROW

_RULE = 'A rule reads "F=F+F", each on a line of its own.'
_LINES = f'A line is "Angle 6", "Axiom F--F--F" or a rule. {_RULE}'


def _line(failure: ParseFailure) -> str:
    """The line, in which "/*" does not begin a comment."""
    return failure.source[failure.start : failure.end]


def _colon(failure: ParseFailure) -> ModelSyntaxError | None:
    """A keyword with a colon, as in other notations."""
    keyword = re.match(r"\s*(angle|axiom)\s*:", _line(failure), re.IGNORECASE)
    if keyword and failure.at <= failure.start + keyword.end():
        example = "Angle 6" if keyword[1].lower() == "angle" else "Axiom F--F--F"
        return failure.error('Fractint needs no ":" here', f'Type "{example}".', failure.start + keyword.end() - 1, 1)
    return None


def _angle(failure: ParseFailure) -> ModelSyntaxError | None:
    if not re.match(r"angle\b", _line(failure), re.IGNORECASE):
        return None
    whole = 'It is a whole number: with "Angle 6", + and - turn by a sixth of a full turn, 60 degrees.'
    if "COUNT" in failure.accepted or failure.at == failure.start:
        at = max(failure.at, failure.start + len("angle"))
        return failure.error("The number of parts of a full turn is missing", whole, at)
    return failure.error(f"I did not expect {quoted(failure.found)} after the angle", whole)


def _axiom(failure: ParseFailure) -> ModelSyntaxError | None:
    if not failure.found and re.fullmatch(r"axiom\s*=?", _line(failure), re.IGNORECASE):
        return failure.error("The axiom is missing", 'It is the first word of the system, as in "Axiom F--F--F".')
    return None


def _arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow where Fractint has an equals sign."""
    line = _line(failure)
    arrow = ARROW.search(line)
    if arrow and re.fullmatch(r"\S\s*", line[: arrow.start()]):
        return failure.error(
            "Fractint has no arrows",
            f'Type "{line[0]}={line[arrow.end() :].strip()[:20]}".',
            failure.start + arrow.start(),
            len(arrow[0]),
        )
    return None


def _beginning(failure: ParseFailure) -> ModelSyntaxError | None:
    """A line that begins like no line of a system."""
    if failure.at != failure.start:
        return None
    if failure.found == "}":
        return failure.error('This "}" closes nothing', 'A system begins with its name and "{", as in "Koch {".')
    line = _line(failure)
    head = re.match(r"[^\s=]{2,}(?=\s*=)", line)
    if head:
        return failure.error(
            "A rule rewrites one character", f"{quoted(head[0])} are several characters. {_RULE}", None, len(head[0])
        )
    if len(line) == 1 and line not in "={}":
        return failure.error("This rule has no successor", f'To erase {line}, write "{line}=".')
    return failure.error("This line makes no sense in Fractint", _LINES, None, len(line.split()[0]))


def _in_a_word(failure: ParseFailure) -> ModelSyntaxError | None:
    if failure.found == "=":
        return failure.error('This is a second "="', _RULE)
    if failure.found == "}":
        return failure.error('This "}" closes nothing', 'A system begins with its name and "{", as in "Koch {".')
    if failure.found == "%":
        return failure.error(
            '"%" cannot be a symbol here',
            "In this kit it cuts off a branch, which Fractint does not do. Choose another character.",
        )
    if failure.found:
        return failure.error(
            f"{named(failure.found[0])} cannot be a symbol",
            'Symbols are letters, digits and signs of ASCII, but not ";", "=", "{" and "}".',
        )
    return None


DIAGNOSTICS = (_colon, _angle, _axiom, _arrow, _beginning, _in_a_word)
"""The diagnostics of Fractint's notation, the most specific first."""
