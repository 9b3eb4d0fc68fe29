"""Diagnostics of a cellwork system."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.dialects.cellwork.spelling import MARKER, RULE_EXAMPLE
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure, quoted, unclosed_bracket
from lsys_kit.notation.syntax.text.statements import ARROW

_CORNERS = 'Corners are written as in "cellwork: 1(0,0,0) 2(1,0,0)": a number, and its place in space.'
_WALL = 'A wall is written as in "wall PQ: 1 P 2 Q 3 P 4 Q": corners and edges in turn, once around it.'
_SETTING = re.compile(r"([A-Za-z]{2,})[ \t]*:")


def _settings(failure: ParseFailure) -> ModelSyntaxError | None:
    """A setting that cellworks do not have, or whose value is missing."""
    setting = _SETTING.match(failure.statement)
    if setting is None or ARROW.search(failure.statement):
        return None
    name = setting[1].lower()
    if name == "steps":
        return failure.error('After "steps:" a whole number is needed', 'Type "steps: 4".', failure.start, 5)
    if name == "cellwork":
        return failure.error("This is no corner", _CORNERS)
    return failure.error(
        f'A cellwork has no "{setting[1]}:"',
        'It has "cellwork:", "wall ...:", "steps:" and productions.',
        failure.start,
        len(setting[1]),
    )


def _wall(failure: ParseFailure) -> ModelSyntaxError | None:
    """A wall of the first cell whose corners and edges are not in turn."""
    if not re.match(r"wall\b", failure.statement, re.IGNORECASE) or ARROW.search(failure.statement):
        return None
    return failure.error("Corners and edges do not stand here in turn", _WALL)


def _marker(failure: ParseFailure) -> ModelSyntaxError | None:
    """A marker that lacks something, or its bracket."""
    opened = unclosed_bracket(failure.before, "[]")
    if failure.found == "]" and opened is None:
        return failure.error('This "]" closes nothing', MARKER)
    if opened is None:
        return None
    if not failure.found:
        return failure.error('This "[" is never closed', MARKER, failure.start + opened, 1)
    return failure.error("This marker cannot be read", MARKER)


def _production(failure: ParseFailure) -> ModelSyntaxError | None:
    """A production whose walls, arrow or successor are missing."""
    if not failure.found and ARROW.search(failure.before):
        return failure.error("There is nothing after the arrow", "Edges are never erased: write what this one becomes.")
    if ARROW.match(failure.found):
        return failure.error("The walls of the edge are missing here", 'Write "P: * -> ..." for an edge P in any walls.')
    if "ARROW" in failure.accepted:
        return failure.error("An arrow is missing here", RULE_EXAMPLE)
    return failure.error(
        f"I did not expect {quoted(failure.found)}" if failure.found else "Something is missing here", RULE_EXAMPLE
    )


DIAGNOSTICS: Sequence[Diagnostic] = (
    "foreign_comment",
    "unreadable_character",
    _settings,
    _wall,
    "second_arrow",
    _marker,
    _production,
)
"""The diagnostics of a cellwork system, the most specific first."""
