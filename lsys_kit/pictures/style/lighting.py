"""Light and shade: how bright a surface is (Lambert's cosine law), and what becomes of its colour.

The light comes from the left, from above and from behind the viewer. Far things are paler, as in hazy air.
"""

from __future__ import annotations

import math
from collections.abc import Sequence

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import Floats, Integers
from lsys_kit.pictures.style.colour_values import BLACK, WHITE, mixed
from lsys_kit.pictures.style.themes import theme

LIGHT = tuple(part / math.hypot(-0.5, 0.65, 0.57) for part in (-0.5, 0.65, 0.57))
"""The direction to the light: right, up, towards the viewer."""
AMBIENT = 0.3
"""The part of the light that comes from all around."""
STEPS = 16
"""So many steps of brightness and of haze are told apart."""
OWN, BRIGHT, DIM, EDGE = 10, 14, 4, -4
"""The step of brightness at which a surface has its own colour; those of the light and of the dark stripe of a stroke; and by
how many steps the edge of a surface is darker than its inside."""
LIGHTEST, DARKEST = 0.55, 0.5
"""The part of white in the lightest shade of a colour, and of black in the darkest."""
HAZE = 0.3
"""The part of paper in what is farthest."""
HIGHLIGHT = 0.6 * LIGHT[0], 0.6 * LIGHT[1]
"""Where a sphere of radius 1 is brightest, seen from the middle of its disc."""
REACH = 1.6
"""How far from there on a sphere of radius 1 it is darkest."""
SPHERE = ((0.0, 15), (0.45, OWN), (1.0, 2))
"""How bright a sphere is, in steps, at some parts of that way."""
_SHADES = (STEPS + 1) ** 2


def brightness(normals: Floats) -> Integers:
    """How bright surfaces are, in steps, given their unit normals: to the right, up, towards the viewer.

    >>> brightness(np.outer([1, -1], LIGHT)).tolist()
    [16, 5]
    """
    lit = AMBIENT + (1 - AMBIENT) * np.clip(normals @ LIGHT, 0, 1)
    steps: Integers = np.rint(lit * STEPS).astype(np.int64)
    return steps


def shade_numbers(colours: Integers, nearness: Floats, bright: Integers | int) -> Integers:
    """The numbers of shades of colours, given how near surfaces are, from 0 to 1, and how bright, in steps."""
    near = np.rint(nearness * STEPS).astype(np.int64)
    numbers: Integers = (colours * (STEPS + 1) + near) * (STEPS + 1) + np.clip(bright, 0, STEPS)
    return numbers


def shades(names: Sequence[str], numbers: Sequence[int]) -> list[str]:
    """The colours of some shades, or of paper.

    >>> shades(["#800000"], shade_numbers(np.array([0, 0]), np.array([1.0, 0.0]), OWN).tolist())
    ['#800000', '#a64d4d']
    """
    paper = paper_number(names)
    return [theme().ground if number == paper else _shade(names[number // _SHADES], number % _SHADES) for number in numbers]


def _shade(colour: str, number: int) -> str:
    near, bright = divmod(number, STEPS + 1)
    lit = (
        mixed(colour, WHITE, 1 - LIGHTEST * (bright - OWN) / (STEPS - OWN))
        if bright > OWN
        else mixed(colour, BLACK, 1 - DARKEST * (OWN - bright) / OWN)
    )
    return mixed(lit, theme().paper, 1 - HAZE * (1 - near / STEPS))


def sphere_tones(colour: str) -> list[tuple[float, str]]:
    """The colours of a sphere on the way from where it is brightest to where it is darkest, with the parts of that way.

    >>> sphere_tones("#800000")[1]
    (0.45, '#800000')
    """
    return [(share, _shade(colour, STEPS * (STEPS + 1) + bright)) for share, bright in SPHERE]


def paper_number(names: Sequence[str]) -> int:
    """The number that stands for paper."""
    return len(names) * _SHADES
