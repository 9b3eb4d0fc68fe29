"""What a parser stumbled over in a printed L-system: "Axiom: ..." and "Rules: a < b > c -> d"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.dialect import Diagnostic
from lsys_kit.notation.syntax.failure import ParseFailure
from lsys_kit.notation.syntax.statements import ARROW

_RULE = 'A printed rule reads "a < b > c -> d": left context, what is replaced, right context, an arrow, what replaces it.'
_ARROWS = {"->", "→"}


def _arrow(failure: ParseFailure) -> ModelSyntaxError | None:
    """An arrow too few, too many or misspelt."""
    spelt = re.compile(r"-->|=>|⟶|⇒|-\s+>").match(failure.text, failure.at)
    if spelt and "ARROW" in failure.accepted:
        return failure.error("This is no arrow", 'An arrow is typed "->".', length=len(spelt.group()))
    if {"ARROW", "LESSTHAN"} & failure.accepted and not failure.found and not ARROW.search(failure.before):
        return failure.error("An arrow is missing here", _RULE)
    if failure.found in _ARROWS and ARROW.search(failure.before):
        return failure.error("A second arrow stands in this rule", "Write one rule a line.")
    return None


def _replaced(failure: ParseFailure) -> ModelSyntaxError | None:
    """No module that is replaced, or more than one."""
    if failure.found not in _ARROWS:
        return None
    head = re.sub(r"^rules\s*:", "", failure.before, flags=re.IGNORECASE).strip()
    if not head or head.endswith("<"):
        return failure.error("The module to replace is missing", _RULE)
    return failure.error("Only one module can be replaced", 'Neighbours are contexts, as in "a < b > c -> d".')


def _outside(failure: ParseFailure) -> ModelSyntaxError | None:
    """A condition outside of the brackets, an empty axiom, and what a printed system has not."""
    if not failure.found and re.fullmatch(r"\s*axiom\s*:", failure.before, re.IGNORECASE):
        return failure.error('Nothing stands behind "Axiom:"', 'Write the first word there, as in "Axiom: a[1]b".')
    if failure.found == "/;" or failure.after.startswith("/;"):
        return failure.error("In a printed rule a condition stands in the brackets", 'Type "a[i_ /; i < 3] -> b".')
    if failure.found == ":" and ARROW.search(failure.before):
        return failure.error("Nothing is left to chance in this notation", "Probabilities can be written in the notation abop.")
    if failure.found == "<" and "<" in failure.before:
        return failure.error('A second "<" stands here', _RULE)
    if re.match(r"\s*axiom\s*:", failure.before, re.IGNORECASE) and failure.found == ",":
        return failure.error('A "," is not needed here', "In a printed word modules stand side by side.")
    return None


PRINTED_DIAGNOSTICS: Sequence[Diagnostic] = (_outside, _arrow, _replaced)
"""What is asked about a slip in a printed system."""
