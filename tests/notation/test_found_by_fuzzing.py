"""Texts on which a fuzzer once found a reader wrong: each is read and reads back, or is explained."""

from __future__ import annotations

import pytest

from lsys_kit.errors import LSystemError
from lsys_kit.notation.read import read
from lsys_kit.notation.registry import DIALECTS
from lsys_kit.notation.write import write

FOUND = {
    "a separator that is a blank to Python, and none to the grammar": " \x1c",
    "a roll before a name that LaTeX knows": "\\omega : \\overrightarrow{A}\\overrightarrow B \\over",
    "letters that part a name only after another is parted": "axiom: F\nF -> JJJ+JJF",
    "a number of many digits": "axiom: A(0)\nA(t) -> A(1." + "4" * 99 + "1)",
    "a very small number": "axiom: A(0)\nA(t) -> A(t + 3e-99)",
    "parameters of a macro that are no names": "Axiom: A\n#define x(" + "n" * 60 + " * g,p)",
    "an @ before a name": "steps: 15\naxiom: @b@ a a a a a a/a a/!a @b a a a a aa d\nb < a -> V",
}


@pytest.mark.parametrize("notation", DIALECTS)
@pytest.mark.parametrize("text", FOUND.values(), ids=FOUND)
def test_a_text_is_read_and_reads_back_or_is_explained(text: str, notation: str) -> None:
    try:
        found = read(text, notation)
    except LSystemError as error:
        str(error)
        return
    assert read(write(found), notation) == found
