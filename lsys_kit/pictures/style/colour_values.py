"""Colours as text: which a person can name, how they are mixed, and how much two of them contrast (WCAG 2.2, 1.4.3)."""

from __future__ import annotations

import re
from typing import Any

from lsys_kit.errors import ModelValueError, shown
from lsys_kit.notation.analysis.checks import suggestion

_HEXADECIMAL = re.compile(r"#(?:[0-9a-f]{3}|[0-9a-f]{6})", re.IGNORECASE)
BLACK, WHITE = "#000000", "#FFFFFF"


def colour_from(value: object, more: tuple[str, ...] = ()) -> str:
    """A colour from what a person gives: a name of CSS, or red, green and blue in hexadecimal digits; or as matplotlib has it.

    >>> colour_from("seagreen"), colour_from("#0AF"), colour_from("tab:green"), colour_from("k"), colour_from((1, 0.5, 0))
    ('#2e8b57', '#00aaff', '#2ca02c', '#000000', '#ff8000')

    Parameters
    ----------
    value
        The colour.
    more
        What else can be given here.

    Raises
    ------
    ModelValueError
        It is no colour.
    """
    from PIL.ImageColor import colormap, getrgb

    text = value.strip().lower() if isinstance(value, str) else ""
    if _HEXADECIMAL.fullmatch(text):
        return text if len(text) == 7 else "#" + "".join(2 * digit for digit in text[1:])
    if text in colormap:
        return "#" + bytes(getrgb(text)[:3]).hex()
    try:
        return _named_by_matplotlib(value)
    except (ValueError, TypeError):
        besides = "".join(f'"{each}", ' for each in more)
        hint = suggestion(text, [*more, *colormap]) or f'Give {besides}a colour of CSS such as "seagreen", or one as "#2e8b57".'
        raise ModelValueError(f"{shown(value)} is no colour", hint=hint) from None


def _named_by_matplotlib(value: Any) -> str:
    from matplotlib.colors import to_hex, to_rgba

    given: Any = value.strip() if isinstance(value, str) else value
    if to_rgba(given)[3] != 1:
        raise ValueError
    return to_hex(given)


def mixed(colour: str, other: str, strength: float) -> str:
    """A colour mixed with another: 0 is the other, 1 the colour itself.

    >>> mixed("#0072B2", "#ffffff", 0.5)
    '#80b9d9'
    """
    strength = min(1.0, max(0.0, strength))
    pairs = zip(bytes.fromhex(colour[1:]), bytes.fromhex(other[1:]), strict=True)
    return "#" + "".join(f"{int(there - strength * (there - here) + 0.5):02x}" for here, there in pairs)


def luminance(colour: str) -> float:
    """The relative luminance of a colour, from 0 for black to 1 for white."""
    parts = (channel / 255 for channel in bytes.fromhex(colour[1:]))
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def contrast(one: str, other: str) -> float:
    """The contrast of two colours, from 1 to 21.

    >>> round(contrast("#000000", "#ffffff"), 6)
    21.0
    """
    less, more = sorted((luminance(one), luminance(other)))
    return (more + 0.05) / (less + 0.05)
