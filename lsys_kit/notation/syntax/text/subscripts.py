"""Subscripts printed on a line of their own, below the letters that they belong to, as Mathematica prints its output."""

from __future__ import annotations

import re
from collections.abc import Iterator
from itertools import pairwise

from lsys_kit.notation.syntax.text.statements import ARROW, blank_parentheses
from lsys_kit.notation.syntax.text.transcript import Edit

_LINE = r"[ \t]++[A-Za-z0-9](?:[ \t]++[A-Za-z0-9])*+[ \t]*+"
_SUBSCRIPTS = re.compile(_LINE)
LINE_OF_SUBSCRIPTS = re.compile(rf"\n{_LINE}(?:\n|\Z)")
"""What a text with subscripts has."""
_LETTER = re.compile(r"(?<![\w\\])[A-Za-z](?!\w)")
_AXIOM = re.compile(r"[ \t]*+(?:axiom|start\w*|ω|\\omega)\b", re.IGNORECASE)
_BRACKETS = str.maketrans("[]", "()")


def subscripts(plain: str, joint: str, values: str = "()") -> Iterator[Edit]:
    """The edits that put each subscript behind its letter, the first behind the first.

    Parameters
    ----------
    plain
        The text without its comments.
    joint
        What stands between a letter and its subscript in a name.
    values
        The brackets around values.

    Examples
    --------
    >>> [*subscripts("a -> b\\n r    l", "_")]
    [Edit(start=1, end=1, text='_r '), Edit(start=6, end=6, text='_l '), Edit(start=7, end=14, text='')]
    """
    if not LINE_OF_SUBSCRIPTS.search(f"\n{plain}"):
        return
    lines = [match for match in re.finditer(r"[^\n]+", plain) if not match.group().isspace()]
    for above, below in pairwise(lines):
        names = above.group()
        if not _SUBSCRIPTS.fullmatch(below.group()) or not (ARROW.search(names) or _AXIOM.match(names)):
            continue
        letters = [*_LETTER.finditer(blank_parentheses(names.translate(_BRACKETS) if values == "[]" else names))]
        found = below.group().split()
        if len(letters) == len(found):
            for letter, subscript in zip(letters, found, strict=True):
                yield Edit(above.start() + letter.end(), above.start() + letter.end(), f"{joint}{subscript} ")
            yield Edit(*below.span(), "")
