"""Formulas as people write them: simple LaTeX, Python's powers, words for operators, products without a sign."""

from __future__ import annotations

import re
from collections.abc import Collection

from lsys_kit.classroom.exercises.typed.text import keyboard_text, unassigned

_FRACTION = re.compile(r"\\[dt]?frac\s*\{([^{}]*)\}\s*\{([^{}]*)\}")
_ROOT = re.compile(r"\\sqrt\s*\{([^{}]*)\}")
_POWER = re.compile(r"\^\s*\{([^{}]*)\}")
_LATEX = (
    (r"\left", ""),
    (r"\right", ""),
    (r"\cdot", "*"),
    (r"\times", "*"),
    (r"\,", " "),
    (r"\;", " "),
    (r"\leq", "<="),
    (r"\le", "<="),
    (r"\geq", ">="),
    (r"\ge", ">="),
    (r"\neq", "!="),
    (r"\land", "&&"),
    (r"\lor", "||"),
    (r"\lfloor", "floor("),
    (r"\rfloor", ")"),
    (r"\ln", "log"),
    (r"\log", "log"),
    (r"\exp", "exp"),
    (r"\min", "min"),
    (r"\max", "max"),
    (r"\sin", "sin"),
    (r"\cos", "cos"),
    (r"\tan", "tan"),
    (r"\pi", "pi"),
    (r"\(", ""),
    (r"\)", ""),
)
_JOINED = (("and", "&&"), ("or", "||"), ("not", "!"))
_IMPLICIT = re.compile(r"(?<![\w.])(\d+(?:\.\d+)?)\s*(?=[A-Za-z_(])|(?<=\))\s*(?=[\w(])")
_WORD = re.compile(r"[A-Za-z_]\w*")
MOST_NESTED = 20
"""Fractions within fractions that are read."""


def formula_text(text: str, names: Collection[str] = ()) -> str:
    """A formula as the kit writes it, from simple LaTeX, from Python's powers, without the name that it is assigned to.

    >>> formula_text("t = d - s**2"), formula_text(r"$\\frac{d + 1}{2} \\cdot s$"), formula_text("2s + 2(d - s)")
    ('d - s^2', '((d + 1)/(2)) * s', '2*s + 2*(d - s)')
    >>> formula_text("u n < vm or not m < 2", ["u", "n", "v", "m"])
    'u*n < v*m || ! m < 2'
    """
    text = unassigned(keyboard_text(text).strip().strip("$").strip())
    for _ in range(MOST_NESTED):
        before = text
        for pattern, form in ((_FRACTION, r"((\1)/(\2))"), (_ROOT, r"sqrt(\1)"), (_POWER, r"^(\1)")):
            text = pattern.sub(form, text)
        if text == before:
            break
    for latex, plain in _LATEX:
        text = text.replace(latex, plain)
    text = with_operators(text.replace("**", "^"), names)
    return _IMPLICIT.sub(lambda found: f"{found[1] or ''}*", _products_of(text, names)).strip()


def with_operators(text: str, names: Collection[str] = ()) -> str:
    """A condition with signs for its words.

    >>> with_operators("s > 5 and not s > 7 | s == 1")
    's > 5 && ! s > 7 || s == 1'
    """
    for word, sign in _JOINED:
        if word not in names:
            text = re.sub(rf"\b{word}\b", sign, text, flags=re.IGNORECASE)
    return re.sub(r"(?<!\|)\|(?!\|)", "||", re.sub(r"(?<!&)&(?!&)", "&&", text))


def _products_of(text: str, names: Collection[str]) -> str:
    """A formula with a sign between names of one letter that stand side by side."""
    if not names or not all(len(name) == 1 for name in names):
        return text
    spread = _WORD.sub(lambda found: "*".join(found[0]) if set(found[0]) <= set(names) else found[0], text)
    letters = "".join(map(re.escape, names))
    return re.sub(rf"(?<![A-Za-z_])([{letters}]|\d)\s+(?=[{letters}](?!\w))", r"\1*", spread)
