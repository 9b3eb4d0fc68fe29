"""Predefined surfaces, as in `~L(2)`: leaves, petals, buds and flowers; their shapes are defined in `surfaces.toml`."""

from __future__ import annotations

import tomllib
from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from functools import cache
from importlib.resources import files
from itertools import pairwise
from typing import TypeAlias

from lsys_kit.errors import quotable
from lsys_kit.geometry.turtle.commands import COMMANDS
from lsys_kit.notation.model.modules import flat
from lsys_kit.notation.model.system import LSystem

Corner: TypeAlias = tuple[float, float, float]
"""A point in the frame of the turtle: ahead, to the left, up."""


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
    faces: tuple[tuple[Corner, ...], ...]


@cache
def surfaces() -> Mapping[str, Surface]:
    """All surfaces, by name.

    >>> list(surfaces())
    ['leaf', 'petal', 'bud', 'flower', 'rosette']
    >>> len(surfaces()["bud"].faces)
    10
    """
    tables = tomllib.loads((files(__package__) / "surfaces.toml").read_text(encoding="utf-8"))
    return {name: Surface(name, tuple(table["symbols"]), tuple(tuple((ahead, left, up) for ahead, left, up in face)
                                                               for face in table["faces"]))
            for name, table in tables.items()}


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
    'no surface is called X: there are L (leaf), P (petal), B (bud), K (flower), rosette'
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
