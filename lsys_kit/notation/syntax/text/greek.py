"""Greek letters as names: the book has constants such as α and δ, the kit has names of the letters A to Z.

Three of them mean something else: ω before the axiom, δ before the angle, ε for nothing.
"""

from __future__ import annotations

import re
import unicodedata
from collections.abc import Iterator

from lsys_kit.notation.syntax.text.statements import ARROW, OMEGA
from lsys_kit.notation.syntax.text.transcript import Edit

GREEK = re.compile(r"[Α-ΡΣ-Ωα-δζ-ωϑϕϱµ]|\\(?:[Aa]lpha|[Bb]eta|[Gg]amma|[Dd]elta|theta|lambda|mu|phi|psi|rho|sigma|tau|omega)\b")
"""A letter, or its macro in LaTeX."""
_SETTING = re.compile(
    rf"(?:^|[,;])[ \t]*+(?:(?P<axiom>{OMEGA})[ \t]*+(?:[:=]|{ARROW.pattern})"
    r"|(?P<angle>δ|\\delta)[ \t]*+[:=](?:[ \t]*+(?P<value>\d[\d.]*+))?)"
)
"""Where a letter has its own meaning: before the axiom or the angle, at the beginning of a line or after a comma."""


def name_of(letter: str) -> str:
    r"""The name of a Greek letter.

    >>> name_of("α"), name_of("Δ"), name_of(r"\beta")
    ('alpha', 'Delta', 'beta')
    """
    if letter[0] == "\\":
        return letter[1:]
    name = unicodedata.name(unicodedata.normalize("NFKC", letter)).split()[-1].lower().replace("lamda", "lambda")
    return name.capitalize() if letter.isupper() else name


def named_letters(text: str, start: int, latex: bool) -> Iterator[tuple[str, Edit]]:
    """The Greek letters of a line that begins at an offset, each with the edit that puts its name in place.

    >>> [edit.text for _, edit in named_letters("αβ -> F(α_1)", 0, False)]
    ['alpha ', 'beta', 'alpha']
    """
    settings = {match.start("axiom" if match["axiom"] else "angle") for match in _SETTING.finditer(text)}
    for match in GREEK.finditer(text):
        letter = match.group()
        if match.start() in settings or (letter[0] == "\\" and not latex):  # a backslash is a roll, before a name
            continue
        before, after = text[match.start() - 1 : match.start()], text[match.end() : match.end() + 1]
        apart = " " * bool(re.match(r"[A-Za-z]", before)), " " * (after.isalpha() and after != "ε")
        yield letter, Edit(start + match.start(), start + match.end(), f"{apart[0]}{name_of(letter)}{apart[1]}")


def angle_as_constant(text: str, start: int) -> Edit | None:
    """Where a line sets the angle δ, the edit that declares a constant of the same value before it."""
    setting = next((match for match in _SETTING.finditer(text) if match["value"]), None)
    if setting is None:
        return None
    at = start + setting.start("angle")
    return Edit(at, at, f"delta = {setting['value']}\n")
