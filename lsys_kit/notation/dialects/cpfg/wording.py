"""What the kit says of its own notation, in the words of cpfg."""

from __future__ import annotations

import re
from collections.abc import Sequence
from typing import TypeVar

from lsys_kit.errors import LSystemError

ErrorT = TypeVar("ErrorT", bound=LSystemError)

_WORDS: Sequence[tuple[str, str]] = (
    (r"(?<!-)->", "-->"), (r'"ε" or "\*"', '"*"'), (r'"dt = 0\.5"', '"#define dt 0.5"'), (r'"c = \.\.\."', '"#define c ..."'),
    (r'"axiom: A"', '"Axiom: A"'), ("of the interpretation", "of the homomorphism"), (r"uniform\(1, 2\)", "ran(2)"),
    (r'"uniform\(0, ([^"]*)"', r'"ran(\1"'),
)
"""What the kit's own notation spells otherwise."""


def in_cpfg(said: str) -> str:
    """A sentence about the kit's own notation, as it reads for cpfg.

    >>> in_cpfg('A production reads "A -> B".')
    'A production reads "A --> B".'
    """
    for pattern, spelt in _WORDS:
        said = re.sub(pattern, spelt, said)
    return said


def reworded(error: ErrorT) -> ErrorT:
    """An error in cpfg's words."""
    error.message = in_cpfg(error.message)
    return error.with_hint(in_cpfg(error.hint)) if error.hint else error
