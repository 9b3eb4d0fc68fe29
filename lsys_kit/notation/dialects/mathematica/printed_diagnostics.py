"""Diagnostics of a printed L-system: "Axiom: ..." and "Rules: a < b > c -> d"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.common_diagnostics import second_arrow
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure
from lsys_kit.notation.syntax.text.statements import ARROW

_PRINTED_RULE = (
    'A printed rule reads "a < b > c -> d": left context, what is replaced, right context, an arrow, what replaces it.'
)
_PRINTED_ARROWS = {"->", "→"}


def _printed_arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow too few, too many or misspelt."""
    spelt = re.compile(r"-->|=>|⟶|⇒|-\s+>").match(failure.text, failure.at)
    if spelt and "ARROW" in failure.accepted:
        return failure.error("This is not an arrow", 'An arrow is typed "->".', length=len(spelt.group()))
    if {"ARROW", "LESSTHAN"} & failure.accepted and not failure.found and not ARROW.search(failure.before):
        return failure.error("An arrow is missing here", _PRINTED_RULE)
    return second_arrow(failure)


def _printed_predecessor(failure: ParseFailure) -> ModelSyntaxError | None:
    """No module to replace, or more than one."""
    if failure.found not in _PRINTED_ARROWS:
        return None
    head = re.sub(r"^rules\s*:", "", failure.before, flags=re.IGNORECASE).strip()
    if not head or head.endswith("<"):
        return failure.error("The module to replace is missing", _PRINTED_RULE)
    return failure.error("Only one module can be replaced", 'Neighbours are contexts, as in "a < b > c -> d".')


def _misplaced_part(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition outside of the brackets, an empty axiom, or something that a printed system does not have."""
    if not failure.found and re.fullmatch(r"\s*axiom\s*:", failure.before, re.IGNORECASE):
        return failure.error('There is nothing after "Axiom:"', 'Write the first word there, as in "Axiom: a[1]b".')
    if failure.found == "/;" or failure.after.startswith("/;"):
        return failure.error("In a printed rule a condition belongs in the brackets", 'Type "a[i_ /; i < 3] -> b".')
    if failure.found == ":" and ARROW.search(failure.before):
        return failure.error("This notation has no probabilities", "Probabilities can be written in the notation abop.")
    if failure.found == "<" and "<" in failure.before:
        return failure.error('This is a second "<"', _PRINTED_RULE)
    if re.match(r"\s*axiom\s*:", failure.before, re.IGNORECASE) and failure.found == ",":
        return failure.error('A "," is not needed here', "In a printed word modules are written side by side.")
    return None


PRINTED_DIAGNOSTICS: Sequence[Diagnostic] = (_misplaced_part, _printed_arrow, _printed_predecessor)
"""The diagnostics of a printed system."""
