"""Themes: the colours of paper, of what is written on it, and of the lines and fills of symbols there.

A theme holds for all that is drawn within a block, whoever draws it:

>>> with drawn_on(DARK):
...     theme().paper
'#161B20'
>>> theme().paper
'#FFFFFF'

The panel has the same themes. On light paper symbols have the colours of `palette`; on dark paper lines are lighter, of about
the same hues, such that people with any kind of colour vision can tell them apart, and in grey too. All lines have a contrast
of 3:1 and more against their paper, and all text one of 4.5:1 (WCAG 2.2, 1.4.11 and 1.4.3).
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping
from contextlib import contextmanager
from contextvars import ContextVar
from dataclasses import dataclass, replace
from functools import lru_cache

from lsys_kit.errors import ModelValueError, shown
from lsys_kit.files import toml_tables
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.pictures.style.colour_values import BLACK, WHITE, colour_from, contrast, luminance, mixed

LINE, TEXT, FAINT, FINER = 3.0, 4.5, 1.3, 0.04
"""The least contrasts of lines, text and chosen edges with their paper; by which parts a colour is mixed with ink until it has
one."""
BLACKEST = 0.179
"""Paper of a luminance below this is dark: white contrasts with it more than black does."""
NOTHING = "none"
"""The ground of a picture without paper."""
COLOURS = toml_tables(__package__, "colours.toml")
DARK_LINES: Mapping[str, str] = COLOURS["dark_lines"]
"""Lines on dark paper."""


@dataclass(frozen=True)
class Theme:
    """How a picture looks.

    Attributes
    ----------
    paper, ink, quiet
        The colours of paper, of text and arrows, and of what is less important.
    mark, mark_edge
        The colours behind what is marked, and around it.
    ground
        The colour of the sheet: that of paper, or `NOTHING`.
    symbols
        Symbols and the colours that a person has chosen for them, which stay as they are.
    boldness
        The factor by which strokes are broader than usual.
    even
        Whether strokes of all branch orders are equally broad.
    reduced
        The factor by which the picture is made smaller than usual, at most 1; strokes stay as broad as can be seen.
    """

    paper: str
    ink: str
    quiet: str
    mark: str
    mark_edge: str
    ground: str
    symbols: tuple[tuple[str, str], ...] = ()
    boldness: float = 1.0
    even: bool = False
    reduced: float = 1.0

    @property
    def dark(self) -> bool:
        """Whether the paper is dark."""
        return luminance(self.paper) < BLACKEST

    @property
    def transparent(self) -> bool:
        """Whether there is no paper."""
        return self.ground == NOTHING


LIGHT, DARK = (Theme(**COLOURS[name], ground=COLOURS[name]["paper"]) for name in ("light", "dark"))
GROUNDS: Mapping[str, Theme] = {"light": LIGHT, "dark": DARK, NOTHING: replace(LIGHT, ground=NOTHING)}
"""The backgrounds that have a name."""
_current: ContextVar[Theme] = ContextVar("theme", default=LIGHT)


def theme() -> Theme:
    """The theme in force here."""
    return _current.get()


@contextmanager
def drawn_on(chosen: Theme) -> Iterator[None]:
    """Draw in a theme."""
    before = theme()
    try:
        _current.set(chosen)
        yield
    finally:
        _current.set(before)


def theme_from(background: object) -> Theme:
    """A theme from what a person gives as background: "light", "dark", "none", or a colour.

    >>> theme_from("dark") == DARK, theme_from("#000").dark, theme_from("none").transparent
    (True, True, True)

    Raises
    ------
    ModelValueError
        It is no background.
    """
    if isinstance(background, str) and background in GROUNDS:
        return GROUNDS[background]
    if isinstance(background, str) and (hint := suggestion(background, [*GROUNDS])):
        raise ModelValueError(f"{shown(background)} is no background", hint=hint)
    paper = colour_from(background, (*GROUNDS,))
    base = DARK if luminance(paper) < BLACKEST else LIGHT
    seen = replace(base, paper=paper, ground=paper)
    return replace(seen, ink=_seen(base.ink, seen, TEXT), quiet=_seen(base.quiet, seen, TEXT))


def line(colour: str) -> str:
    """The colour of a line of a colour in the theme in force: one in which it can be seen on its paper.

    >>> line("#28A964")
    '#28A964'
    >>> with drawn_on(DARK):
    ...     line("#0658A0"), line("#000000")
    ('#3570A4', '#66686a')
    """
    return _line(colour, theme())


def text_colour(colour: str) -> str:
    """The colour of text in a colour in the theme in force: one in which it can be read on its paper.

    >>> text_colour("#0658A0")
    '#0658A0'
    >>> with drawn_on(DARK):
    ...     contrast(text_colour("#0658A0"), DARK.paper) >= TEXT
    True
    """
    return _seen(line(colour), theme(), TEXT)


def edge_colour(colour: str) -> str:
    """The colour of the edge of what is filled with a colour: that of its lines, or quiet where a person chose that of paper.

    >>> with drawn_on(replace(LIGHT, symbols=(("a", "#ffffff"), ("b", "#808080")))):
    ...     edge_colour("#ffffff") == LIGHT.quiet, edge_colour("#808080")
    (True, '#808080')
    """
    found = line(colour)
    return theme().quiet if contrast(found, theme().paper) < FAINT else found


@lru_cache(maxsize=2_048)
def _line(colour: str, chosen: Theme) -> str:
    if colour in dict(chosen.symbols).values():
        return colour
    return _seen(DARK_LINES.get(colour, colour) if chosen.dark else colour, chosen, LINE)


def _seen(colour: str, chosen: Theme, least: float) -> str:
    """The shade of a colour with a contrast against the paper: mixed with ink, or at last with white or black, as little as
    needed."""
    extreme = WHITE if chosen.dark else BLACK
    for ink in (chosen.ink, extreme):
        strength, shade = 1.0, colour
        while contrast(shade, chosen.paper) < least and strength > 0:
            strength -= FINER
            shade = mixed(colour, ink, strength)
        if contrast(shade, chosen.paper) >= least:
            break
    return shade
