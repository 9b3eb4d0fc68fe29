"""What a parser stumbled over in a printed L-system: "Axiom: ..." and "Rules: a < b > c -> d"."""

from __future__ import annotations

import re
from collections.abc import Sequence

from lsys_kit.errors import ModelSyntaxError
from lsys_kit.notation.syntax.dialect import Question
from lsys_kit.notation.syntax.failure import Stumble
from lsys_kit.notation.syntax.statements import ARROW

_RULE = 'A printed rule reads "a < b > c -> d": left context, what is replaced, right context, an arrow, what replaces it.'
_ARROWS = {"->", "→"}


def _arrow(stumble: Stumble) -> ModelSyntaxError | None:
    """An arrow too few, too many or misspelt."""
    spelt = re.compile(r"-->|=>|⟶|⇒|-\s+>").match(stumble.text, stumble.at)
    if spelt and "ARROW" in stumble.accepted:
        return stumble.error("This is no arrow", 'An arrow is typed "->".', length=len(spelt.group()))
    if {"ARROW", "LESSTHAN"} & stumble.accepted and not stumble.found and not ARROW.search(stumble.before):
        return stumble.error("An arrow is missing here", _RULE)
    if stumble.found in _ARROWS and ARROW.search(stumble.before):
        return stumble.error("A second arrow stands in this rule", "Write one rule a line.")
    return None


def _replaced(stumble: Stumble) -> ModelSyntaxError | None:
    """No module that is replaced, or more than one."""
    if stumble.found not in _ARROWS:
        return None
    head = re.sub(r"^rules\s*:", "", stumble.before, flags=re.IGNORECASE).strip()
    if not head or head.endswith("<"):
        return stumble.error("The module to replace is missing", _RULE)
    return stumble.error("Only one module can be replaced", 'Neighbours are contexts, as in "a < b > c -> d".')


def _outside(stumble: Stumble) -> ModelSyntaxError | None:
    """A condition outside of the brackets, an empty axiom, and what a printed system has not."""
    if not stumble.found and re.fullmatch(r"\s*axiom\s*:", stumble.before, re.IGNORECASE):
        return stumble.error('Nothing stands behind "Axiom:"', 'Write the first word there, as in "Axiom: a[1]b".')
    if stumble.found == "/;" or stumble.after.startswith("/;"):
        return stumble.error("In a printed rule a condition stands in the brackets", 'Type "a[i_ /; i < 3] -> b".')
    if stumble.found == ":" and ARROW.search(stumble.before):
        return stumble.error("Nothing is left to chance in this notation", "Probabilities can be written in the notation abop.")
    if stumble.found == "<" and "<" in stumble.before:
        return stumble.error('A second "<" stands here', _RULE)
    if re.match(r"\s*axiom\s*:", stumble.before, re.IGNORECASE) and stumble.found == ",":
        return stumble.error('A "," is not needed here', "In a printed word modules stand side by side.")
    return None


PRINTED: Sequence[Question] = (_outside, _arrow, _replaced)
"""What is asked about a slip in a printed system."""
