"""The languages of L-systems beside the Chomsky hierarchy, as nested ellipses.

Languages of 0L-systems cut across the finite, the regular and the context-free ones, and are all context-sensitive;
(k,l)-systems add languages up to some that are only recursively enumerable. The picture is drawn anew: that of the textbook,
figure 5.2, whose caption it keeps, was not at hand. Sources: Herman and Rozenberg, Developmental Systems and Languages (1975);
The Algorithmic Beauty of Plants, figure 1.2.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import NamedTuple

from lsys_kit.files import Entries, toml_tables
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.shapes import Circle, Drawing, Ellipse, Look, Text
from lsys_kit.pictures.sizes import document
from lsys_kit.pictures.style.palette import BLUE, QUIET, VERMILION, tinted
from lsys_kit.pictures.style.themes import line, text_colour, theme, theme_from

WIDTH, HEIGHT = 720, 430
"""The size of the picture, in pixels."""


class LanguageClass(NamedTuple):
    """A class of languages: its name, the centre and the half axes of its ellipse, and the position of its name, in pixels."""

    name: str
    centre: tuple[float, float]
    reach: tuple[float, float]
    label: tuple[float, float]
    colour: str

    def holds(self, x: float, y: float) -> bool:
        """Whether a point lies inside."""
        return ((x - self.centre[0]) / self.reach[0]) ** 2 + ((y - self.centre[1]) / self.reach[1]) ** 2 < 1


class Language(NamedTuple):
    """A language that shows that two classes differ: how it is written, its point, and the classes to which it belongs."""

    text: str
    x: float
    y: float
    classes: frozenset[str]


def _classes(told: Entries, *colours: str) -> tuple[LanguageClass, ...]:
    rows = zip(told.items(), colours, strict=True)
    return tuple(LanguageClass(name, centre, reach, label, colour) for (name, (centre, reach, label)), colour in rows)


_TOLD = toml_tables(__package__, "hierarchy.toml")
CHOMSKY = _classes(_TOLD["chomsky"], *[QUIET] * 5)
"""The classes of Chomsky's grammars, each inside the one before."""
PARALLEL = _classes(_TOLD["parallel"], BLUE, VERMILION)
"""The classes of L-systems, the second inside the first."""
LANGUAGES = tuple(Language(**{**each, "classes": frozenset(each["classes"])}) for each in _TOLD["languages"])
"""A language in each part that matters."""


@dataclass(frozen=True)
class HierarchyPicture(SVGPicture):
    """The languages of L-systems beside the Chomsky hierarchy."""

    @property
    def text(self) -> str:
        """What the picture shows, in words."""
        examples = "; ".join(f"{each.text}: {', '.join(sorted(each.classes))}" for each in LANGUAGES)
        return f"{_TOLD['description']}{examples}."

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The ellipses, their names, and the languages."""
        classes, points = (*CHOMSKY, *PARALLEL), (shape for each in LANGUAGES for shape in _point(each))
        return document([*map(_ellipse, classes), *map(_class_name, classes), *points], WIDTH, HEIGHT, self.text)

    def __repr__(self) -> str:
        return self.text


def draw_hierarchy(background: str = "light") -> HierarchyPicture:
    """Draw the languages of 0L-systems and (k,l)-systems beside those of the Chomsky hierarchy.

    Parameters
    ----------
    background
        What it is drawn on: "light", "dark", "none", or a colour.

    Raises
    ------
    ModelValueError
        It is no background.

    Examples
    --------
    >>> print(draw_hierarchy().text[:79])
    Power of 0L-systems and (k,l)-systems in comparison to Chomsky languages: five

    References
    ----------
    Herman and Rozenberg, Developmental Systems and Languages (1975); the caption is that of figure 5.2 of the textbook.
    """
    return HierarchyPicture(theme=theme_from(background))


def _ellipse(each: LanguageClass) -> Ellipse:
    """An ellipse; those of L-systems are broken lines, so that colour alone says nothing."""
    broken = each in PARALLEL
    look = Look(
        fill=tinted(each.colour, 0.3),
        fill_opacity=0.3 if broken else 0.24,
        stroke=line(each.colour),
        stroke_width=20 if broken else 14,
    )
    (x, y), (across, up) = map(_tenths, (each.centre, each.reach))
    return Ellipse(x, y, across, up, look | (Look(stroke_dasharray="90 50") if broken else Look()))


def _tenths(pixels: tuple[float, float]) -> tuple[int, int]:
    return round(10 * pixels[0]), round(10 * pixels[1])


def _class_name(each: LanguageClass) -> Text:
    return _text(each.name, *each.label, 15, theme().ink if each.colour == QUIET else text_colour(each.colour))


def _point(each: Language) -> tuple[Circle, Text]:
    x, y = _tenths((each.x, each.y))
    return Circle(x, y, 30, Look(fill=theme().ink)), _text(each.text, each.x, each.y + 19, 13, theme().ink)


def _text(text: str, x: float, y: float, size: int, colour: str) -> Text:
    look = Look(
        font_family="sans-serif",
        font_size=10 * size,
        text_anchor="middle",
        fill=colour,
        stroke=theme().paper,
        stroke_width=40,
        stroke_linejoin="round",
        paint_order="stroke",
    )
    across, down = _tenths((x, y))
    return Text(across, down, text, look)
