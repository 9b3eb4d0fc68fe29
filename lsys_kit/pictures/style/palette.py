"""Colours: one for each symbol, the same in the word, the stage diagram and the drawing.

The colours have about the hues of Okabe and Ito's (Color Universal Design, 2008), which people with any kind of colour vision
can tell apart, but are dark enough for thin lines on white paper: all have a contrast of 3:1 and more (WCAG 2.2, 1.4.11). The
first three differ in grey too. Age or another value is a colour's strength; what matters is never said by colour alone.
"""

from __future__ import annotations

from collections.abc import Mapping
from functools import lru_cache

from lsys_kit.geometry.turtle.surfaces import surfaces_of
from lsys_kit.notation.model.system import LSystem, symbols
from lsys_kit.pictures.style.colour_values import BLACK, mixed
from lsys_kit.pictures.style.labels import polar_symbols
from lsys_kit.pictures.style.themes import COLOURS, LIGHT, theme

SERIES: tuple[str, ...] = tuple(COLOURS["series"].values())
GREEN, ORANGE, BLUE, PURPLE, VERMILION, SKY = SERIES
NATURAL = {name: COLOURS["series"][colour] for name, colour in COLOURS["natural"].items()}
"""What has its natural colour, as far as there is one."""
RAMP: tuple[str, ...] = tuple(COLOURS["turtle"]["ramp"])
"""The colours through which `'` steps."""
CHOSEN: tuple[str, ...] = (*COLOURS["turtle"]["chosen"], *RAMP)
"""The colours that a turtle chooses by number."""
PALEST, LABELLED, STRONGEST = 0.45, 0.58, 0.85
"""The strengths of fills: the least at which colours can be told apart with any kind of colour vision; the greatest behind a
label; the greatest."""
OLDEST = 0.6
"""How light the line of the oldest wall is, compared with its colour."""
INK, QUIET, PAPER = LIGHT.ink, LIGHT.quiet, LIGHT.paper
"""On light paper: text and arrows; brackets, turns and captions, which are no part of the organism; the paper."""
MARK, MARK_EDGE = LIGHT.mark, LIGHT.mark_edge
"""There: behind what is marked, as the chosen stage or the current row; and around it."""


def colours(system: LSystem) -> Mapping[str, str]:
    """A colour for each letter, digit or name that is a symbol; both polarities of a cell share theirs, and leaves are green.

    Symbols for which a person has chosen a colour have that.

    >>> from lsys_kit import read
    >>> colours(read("axiom: ar\\nar -> al br\\nal -> bl ar\\nbr -> ar\\nbl -> al"))
    {'ar': '#28A964', 'al': '#28A964', 'br': '#AF7605', 'bl': '#AF7605'}
    """
    chosen = theme().symbols
    return {**_own_colours(system), **dict(chosen)} if chosen else _own_colours(system)


@lru_cache(maxsize=64)
def _own_colours(system: LSystem) -> Mapping[str, str]:
    pairs = polar_symbols(system)
    found = {symbol: NATURAL[name] for symbol, name in surfaces_of(system).items() if name in NATURAL}
    free = [colour for colour in SERIES if colour not in found.values()]
    bases: dict[str, str] = {}
    for symbol in symbols(system):
        if symbol[0].isalnum() and symbol not in found:
            base = pairs[symbol][0] if symbol in pairs else symbol
            found[symbol] = bases.setdefault(base, free[len(bases) % len(free)])
    return found


def colour_of(symbol: str, system: LSystem) -> str:
    """The colour in which what a symbol stands for is drawn; where a sign draws, green.

    >>> from lsys_kit import read
    >>> colour_of("B", read("axiom: A B {F}")) == ORANGE, colour_of("{", read("axiom: A B {F}")) == GREEN
    (True, True)
    """
    return colours(system).get(symbol, GREEN)


def cell_fill(colour: str, age: float) -> str:
    """The fill of a cell of some colour: the older, from 0 to 1, the stronger.

    >>> cell_fill("#0072B2", 0) == tinted("#0072B2", PALEST)
    True
    """
    return tinted(colour, PALEST + (STRONGEST - PALEST) * age)


def tinted(colour: str, strength: float) -> str:
    """A colour mixed with the paper of the theme: 0 is the paper, 1 the colour itself.

    >>> tinted("#0072B2", 0.5)
    '#80b9d9'
    """
    return mixed(colour, theme().paper, strength)


def shaded(colour: str, light: float) -> str:
    """A colour mixed with black: 0 is black, 1 the colour itself.

    >>> shaded("#0072B2", 0.5)
    '#003959'
    """
    return mixed(colour, BLACK, light)
