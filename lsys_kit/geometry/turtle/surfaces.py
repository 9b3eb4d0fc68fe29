"""Predefined surfaces, as in `~L(2)`: leaves, needles, petals, sepals, buds, flowers and fruits.

Their shapes are defined in `surfaces.toml`: blades by the outline of one half, flowers by their petals, solids by a profile.
"""

from __future__ import annotations

import math
import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import pairwise
from typing import Any, TypeAlias

from lsys_kit.errors import quotable
from lsys_kit.geometry.turtle.commands import COMMANDS
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import LSystem

Corner: TypeAlias = tuple[float, float, float]
"""A point in the frame of the turtle: ahead, to the left, up."""
Faces: TypeAlias = tuple[tuple[Corner, ...], ...]
DECIMALS = 4
"""So many decimals of a corner are kept: a surface is about 1 long."""


@dataclass(frozen=True)
class Surface:
    """A surface composed of plane faces.

    Attributes
    ----------
    name
        Its name.
    symbols
        The symbols that stand for it after a tilde.
    faces
        The corners of each face, in order; the surface has about unit length.
    """

    name: str
    symbols: tuple[str, ...]
    faces: Faces


@cache
def surfaces() -> Mapping[str, Surface]:
    """All surfaces, by name.

    >>> list(surfaces())
    ['leaf', 'needle', 'petal', 'sepal', 'bud', 'flower', 'rosette', 'fruit']
    >>> len(surfaces()["bud"].faces)
    25
    """
    tables = tomllib.loads((files(__package__) / "surfaces.toml").read_text(encoding="utf-8"))
    return {name: Surface(name, tuple(table["symbols"]), _rounded(_faces(table))) for name, table in tables.items()}


def _faces(table: Mapping[str, Any]) -> Faces:
    """The faces of a surface, as it is described."""
    if "profile" in table:
        return _solid_of_revolution(table["profile"], table["sides"])
    blade = _blade(table["outline"], table.get("fold", 0))
    if "petals" not in table:
        return blade
    turns = [360 * number / table["petals"] for number in range(table["petals"])]
    if "opening" in table:
        opened = [[_turned(_rolled(corner, 90), table["opening"]) for corner in face] for face in blade]
        return tuple(tuple(_rolled(corner, turn) for corner in face) for turn in turns for face in opened)
    return tuple(tuple(_turned(corner, turn) for corner in face) for turn in turns for face in blade)


def _blade(outline: Sequence[Sequence[float]], fold: float) -> Faces:
    """A blade: two halves on both sides of its midrib, raised by the fold.

    >>> _blade([(0, 0), (1, 2), (2, 0)], 0)
    (((0, 0.0, 0.0), (1, 2.0, 0.0), (2, 0.0, 0.0)), ((0, 0.0, 0.0), (1, -2.0, 0.0), (2, 0.0, 0.0)))
    """
    aside, up = math.cos(math.radians(fold)), math.sin(math.radians(fold))
    return tuple(tuple((ahead, side * width * aside, width * up) for ahead, width in outline) for side in (1, -1))


def _turned(corner: Corner, degrees: float) -> Corner:
    """A corner after a turn to the left."""
    (ahead, left, up), cos, sin = corner, math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return cos * ahead - sin * left, sin * ahead + cos * left, up


def _rolled(corner: Corner, degrees: float) -> Corner:
    """A corner after a roll to the right, about the direction ahead."""
    (ahead, left, up), cos, sin = corner, math.cos(math.radians(degrees)), math.sin(math.radians(degrees))
    return ahead, cos * left - sin * up, sin * left + cos * up


def _solid_of_revolution(profile: Sequence[Sequence[float]], sides: int) -> Faces:
    """The faces between the rings of a profile that is turned about the direction ahead; at its ends they are triangles.

    >>> len(_solid_of_revolution([(0, 0), (1, 1), (2, 1), (3, 0)], 4))
    12
    """
    rings = [[_rolled((ahead, out, 0.0), 360 * side / sides) for side in range(sides)] for ahead, out in profile]
    return tuple(tuple(dict.fromkeys((here[side], there[side], there[side - 1], here[side - 1])))
                 for here, there in pairwise(rings) for side in range(sides))


def _rounded(faces: Faces) -> Faces:
    """Corners with few decimals, and no negative zeros."""
    return tuple(tuple((_few(ahead), _few(left), _few(up)) for ahead, left, up in face) for face in faces)


def _few(number: float) -> float:
    return round(number, DECIMALS) + 0.0


@cache
def surface_called(symbol: str) -> Surface | None:
    """The surface that a symbol stands for after a tilde, or None.

    >>> surface_called("K").name
    'flower'
    """
    return next((surface for surface in surfaces().values() if symbol in surface.symbols), None)


def passed_over(unknown: Sequence[str]) -> str:
    """What a turtle has passed over, in words; empty if that is nothing.

    Parameters
    ----------
    unknown
        Symbols that look like commands and are none; after a tilde, what no surface is called.

    Examples
    --------
    >>> passed_over(["~X"])
    'no surface is called X: there are L (leaf), needle, P (petal), sepal, B (bud), K (flower), rosette, fruit'
    >>> passed_over(["~"])
    'passed over, because no surface is named after it: ~'
    """
    names = [symbol[1:] for symbol in unknown if symbol[0] == "~" and symbol != "~"]
    others = [symbol for symbol in unknown if symbol[0] != "~"]
    there_are = ", ".join(f"{surface.symbols[0]} ({surface.name})" if len(surface.symbols) > 1 else surface.name
                          for surface in surfaces().values())
    said = [f"passed over, without a meaning here: {quotable(' '.join(others))}" if others else "",
            f"no surface is called {quotable(' or '.join(names))}: there are {there_are}" if names else "",
            "passed over, because no surface is named after it: ~" if "~" in unknown else ""]
    return "; ".join(filter(None, said))


def surfaces_of(system: LSystem) -> Mapping[str, str]:
    """For each symbol of a system that is drawn as a surface, directly or by interpretation, the name of the surface.

    >>> from lsys_kit.notation.read import read
    >>> surfaces_of(read("axiom: A\\nA -> F [+ ~ L] B\\ninterpretation:\\nB -> ~flower(2)"))
    {'L': 'leaf', 'flower': 'flower', 'B': 'flower'}
    """
    words = [tuple(flat(word)) for word in (system.axiom, *(rule.successor for rule in system.rules))]
    called = [(behind.symbol, surface.name) for word in words for before, behind in pairwise(word)
              if before.symbol == "~" and (surface := surface_called(behind.symbol))]
    drawn = [(module.symbol, command.surface) for word in words for module in word
            for command in COMMANDS[system.turtle].get(module.symbol, ()) if command.surface]
    found = dict((*called, *drawn))
    for rule in system.interpretation:
        shown = next((found[module.symbol] for module in flat(rule.successor) if module.symbol in found), None)
        if shown:
            found.setdefault(rule.predecessor.symbol, shown)
    return found
