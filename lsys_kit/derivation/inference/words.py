"""The words whose rules are looked for, however they are given, as rows of modules."""

from __future__ import annotations

import re
from collections.abc import Iterable, Sequence
from fractions import Fraction
from typing import TypeAlias

from lsys_kit.budget import counted
from lsys_kit.derivation.core.traits import CUT
from lsys_kit.errors import ModelLimitError, ModelValueError, quotable, shown
from lsys_kit.notation.model.arithmetic import is_symbolic, normalised
from lsys_kit.notation.model.modules import Module, joined

Row: TypeAlias = tuple[Module, ...]
"""A word."""
MOST_MODULES = 100_000
"""So many modules may all words have together."""
NUMBER = r"-?\d+(?:\.\d+)?(?:/0*[1-9]\d*|[eE][-+]?\d{1,3})?"
ARGUMENTS = rf"\(\s*+({NUMBER}(?:\s*+,\s*+{NUMBER})*+)\s*+\)"
MODULE = re.compile(rf"(\w++|\S)(?:{ARGUMENTS})?")
VALUE = re.compile(rf"[^\s()]{ARGUMENTS}")


def read_words(given: object) -> tuple[Row, ...]:
    """The words of steps 0, 1, 2, ... as rows of modules.

    A text is a row of one-letter symbols. Where one of the texts has a blank, or numbers in parentheses behind a symbol, all
    are read as `derive` prints words.

    >>> [len(word) for word in read_words(["ar", "albr"])]
    [2, 4]
    >>> [len(word) for word in read_words(["ar", "al br", "bl(1) ar ar"])]
    [1, 2, 3]

    Raises
    ------
    ModelValueError
        There are not two words at least, or one of them is none.
    """
    if isinstance(given, str) or not isinstance(given, Iterable):
        raise ModelValueError(
            f"A sequence of words is needed, not {type(given).__name__}",
            hint='Give the words of steps 0, 1, 2, ... in a list, as in infer(["a", "ab", "aba"]).',
        )
    words = [*counted(given, 1)]
    if len(words) < 2:
        raise ModelValueError(
            f"Rules are found from two words at least; there {'is one' if words else 'are none'}",
            hint='Give the words of steps 0, 1, 2, ... in a list, as in infer(["a", "ab", "aba"]).',
        )
    texts = [word for word in words if isinstance(word, str)]
    valued = any(map(VALUE.search, texts))
    printed = valued or any(len(text.split()) > 1 for text in texts)
    found, left = [], MOST_MODULES
    for step, word in enumerate(words):
        found.append(_row(word, step, printed, valued))
        left -= len(found[-1])
        if left < 0:
            raise ModelLimitError(
                f"The words up to step {step} have more than {MOST_MODULES:,} modules",
                limit=MOST_MODULES,
                hint="Give fewer steps.",
            )
    return tuple(found)


def _row(word: object, step: int, printed: bool, valued: bool) -> Row:
    if isinstance(word, str):
        if valued:
            _require_values(word, step)
        row = tuple(_printed_modules(word) if printed else (Module(letter) for letter in word.strip()))
    elif isinstance(word, Sequence) and not isinstance(word, bytes | bytearray):
        row = tuple(_module(each, step) for each in counted(word))
    else:
        raise ModelValueError(f"The word of step {step} must be a text or a row of modules, not {type(word).__name__}")
    for module in row:
        if module.symbol == CUT or (module.symbol[:1] == "?" and len(module.symbol) > 1):
            raise ModelValueError(
                f'The word of step {step} has the module "{quotable(module.symbol)}", which is no letter '
                "that rules alone replace",
                hint="Such a module cuts a branch, or asks what the turtle sees.",
            )
    return row


def _require_values(text: str, step: int) -> None:
    """Refuse parentheses without numbers in words whose symbols have values: there they are no symbols themselves."""
    found = re.search(r"\([^()]*\)?|\)", VALUE.sub(" ", text))
    if found:
        raise ModelValueError(
            f'The word of step {step} has "{quotable(found[0])}", which are no values',
            hint="Values are numbers with commas between them, as in A(1,2.5).",
        )


def _printed_modules(text: str) -> Iterable[Module]:
    """The modules of a text as `derive` prints it."""
    for found in MODULE.finditer(text.rstrip()):
        yield Module(found[1], tuple(normalised(Fraction(value)) for value in found[2].split(",")) if found[2] else ())


def _module(given: object, step: int) -> Module:
    if isinstance(given, str) and given.strip():
        return Module(given)
    if not isinstance(given, Module):
        raise ModelValueError(f"The word of step {step} must be a text or a row of modules, and has {shown(given)}")
    if any(map(is_symbolic, given.arguments)):
        raise ModelValueError(
            f"The word of step {step} has {quotable(str(given))}, whose value is not known",
            hint="Give the constants of the system numbers.",
        )
    return Module(given.symbol, given.arguments)


def text_of(row: Iterable[Module]) -> str:
    """A word as a message shows it: ε where it is empty, without its middle where it is long.

    >>> text_of([]), text_of([Module("al"), Module("br")])
    ('ε', 'al br')
    """
    text = joined(map(str, row)) or "ε"
    return quotable(text if len(text) <= 70 else f"{text[:40]} ... {text[-20:]}")
