"""Surfaces that `~` draws, as in `~L(2)`: leaves, needles, petals, sepals, buds, flowers and fruits, and those of a model.

The kit's own are defined in `surfaces.toml`: blades by their midrib and margin, flowers by their petals, solids by a profile.
"""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache, lru_cache
from importlib.resources import files
from itertools import pairwise
from typing import Any

import numpy as np

from lsys_kit.errors import quotable
from lsys_kit.geometry.turtle.commands.table import COMMANDS
from lsys_kit.geometry.turtle.patches import (
    Face,
    Facets,
    blade_control,
    joined_facets,
    mirrored_control,
    patch_facets,
    polygon_facets,
    revolved_facets,
    rolled,
    turned,
)
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.surfaces import ROW, SurfaceShape
from lsys_kit.notation.model.system import LSystem

PATCH_FACES = 5
"""A patch that a model declares is drawn as so many rows and columns of faces."""


@dataclass(frozen=True)
class Surface:
    """A surface composed of faces.

    Attributes
    ----------
    name
        Its name.
    symbols
        The symbols that stand for it after a tilde.
    faces
        The corners of each face, in order.
    normals
        The unit normal at each corner; none for a flat surface.
    outlines
        What is drawn of it in the plane of a picture.
    """

    name: str
    symbols: tuple[str, ...]
    faces: tuple[Face, ...]
    normals: tuple[Face, ...]
    outlines: tuple[Face, ...]


@cache
def surfaces() -> Mapping[str, Surface]:
    """The surfaces that the kit has, by name; each is about 1 long.

    >>> list(surfaces())
    ['leaf', 'needle', 'petal', 'sepal', 'bud', 'flower', 'rosette', 'fruit']
    >>> len(surfaces()["bud"].faces)
    48
    """
    tables = tomllib.loads((files(__package__) / "surfaces.toml").read_text(encoding="utf-8"))
    return {name: Surface(name, tuple(table["symbols"]), *_facets(table)) for name, table in tables.items()}


def _facets(table: Mapping[str, Any]) -> Facets:
    """The faces of a surface, as it is described."""
    if "profile" in table:
        return revolved_facets(table["profile"], table["sides"], table["pieces"])
    blade = _blade(table)
    if "petals" not in table:
        return blade
    turns = [360 * number / table["petals"] for number in range(table["petals"])]
    if "opening" in table:
        opened = blade.mapped(rolled(90)).mapped(turned(table["opening"]))
        return joined_facets([opened.mapped(rolled(turn)) for turn in turns])
    return joined_facets([blade.mapped(turned(turn)) for turn in turns])


def _blade(table: Mapping[str, Any]) -> Facets:
    """A blade: two halves on both sides of its midrib, perhaps with a stalk."""
    control = blade_control(table["midrib"], table["margin"], table["bulge"])
    parts = [patch_facets(half, *table["faces"]) for half in (control, mirrored_control(control))]
    outline = parts[0].outlines[0]
    if "stalk" in table:
        length, width = table["stalk"]
        ahead = [length * row / 3 for row in range(ROW)]
        stalk = blade_control([(x, 0.0) for x in ahead], [(x, width / 2, 0.0) for x in ahead], 0.0)
        parts += [patch_facets(half, 1, 1) for half in (stalk, mirrored_control(stalk))]
        outline = ((0.0, 0.0, 0.0), *outline[1:], (length, width / 2, 0.0), (0.0, width / 2, 0.0))
    mirrored = tuple((ahead, 0.0 - left, up) for ahead, left, up in reversed(outline))
    return joined_facets(parts)._replace(outlines=(outline, mirrored))


@lru_cache(maxsize=256)
def declared_surface(shape: SurfaceShape) -> Surface:
    """A surface that a model declares.

    >>> [len(faces) for faces in declared_surface(SurfaceShape("scale", ((0, 0, 0), (1, 0, 0), (1, 1, 0)))).faces]
    [3]
    """
    if shape.polygon:
        facets = polygon_facets([_floats(corner) for corner in shape.polygon])
    else:
        controls = (np.array([_floats(point) for point in patch]).reshape(ROW, ROW, 3) for patch in shape.patches)
        facets = joined_facets([patch_facets(control, PATCH_FACES, PATCH_FACES) for control in controls])
    return Surface(shape.name, (shape.name,), *facets)


def _floats(point: Sequence[Any]) -> tuple[float, float, float]:
    ahead, left, up = map(float, point)
    return ahead, left, up


@lru_cache(maxsize=64)
def surfaces_by_symbol(system: LSystem) -> Mapping[str, Surface]:
    """The surfaces of a system, by what stands for them after a tilde: its own, and those of the kit.

    >>> from lsys_kit.notation.read import read
    >>> found = surfaces_by_symbol(read("surface L: (0, 0) (1, 0) (1, 1)\\naxiom: ~L"))
    >>> found["L"].name, found["leaf"].name, len(found["L"].faces)
    ('L', 'leaf', 1)
    """
    kits = {symbol: surface for surface in surfaces().values() for symbol in surface.symbols}
    return {**kits, **{shape.name: declared_surface(shape) for shape in system.surfaces}}


def passed_over(unknown: Sequence[str]) -> str:
    """What a turtle has passed over, in words; empty if that is nothing.

    Parameters
    ----------
    unknown
        Symbols that look like commands and are none; after a tilde, what no surface is called.

    Examples
    --------
    >>> passed_over(["~X"])
    'no surface is called X: there are L (leaf), needle, ...; a model declares others'
    >>> passed_over(["~"])
    'passed over, because no surface is named after it: ~'
    """
    names = [symbol[1:] for symbol in unknown if symbol[0] == "~" and symbol != "~"]
    others = [symbol for symbol in unknown if symbol[0] != "~" and symbol != "@PD"]
    there_are = ", ".join(
        f"{surface.symbols[0]} ({surface.name})" if len(surface.symbols) > 1 else surface.name
        for surface in surfaces().values()
    )
    said = [
        f"passed over, without a meaning here: {quotable(' '.join(others))}" if others else "",
        f"no surface is called {quotable(' or '.join(names))}: there are {there_are}; a model declares others" if names else "",
        "@PD draws a patch whose sixteen control points are set by @PC" if "@PD" in unknown else "",
        "passed over, because no surface is named after it: ~" if "~" in unknown else "",
    ]
    return "; ".join(filter(None, said))


def surfaces_of(system: LSystem) -> Mapping[str, str]:
    """For each symbol of a system that is drawn as a surface, directly or by interpretation, the name of the surface.

    >>> from lsys_kit.notation.read import read
    >>> surfaces_of(read("axiom: A\\nA -> F [+ ~ L] B\\ninterpretation:\\nB -> ~flower(2)"))
    {'L': 'leaf', 'flower': 'flower', 'B': 'flower'}
    """
    known = surfaces_by_symbol(system)
    words = [tuple(flat(word)) for word in (system.axiom, *(rule.successor for rule in system.rules))]
    called = [
        (behind.symbol, surface.name)
        for word in words
        for before, behind in pairwise(word)
        if before.symbol == "~" and (surface := known.get(behind.symbol))
    ]
    drawn = [
        (module.symbol, command.surface)
        for word in words
        for module in word
        for command in COMMANDS[system.turtle].get(module.symbol, ())
        if command.surface
    ]
    found = dict((*called, *drawn))
    for rule in system.interpretation:
        shown = next((found[module.symbol] for module in flat(rule.successor) if module.symbol in found), None)
        if shown:
            found.setdefault(rule.predecessor.symbol, shown)
    return found
