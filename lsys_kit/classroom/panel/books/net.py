"""The stage diagram in a book: its parts as lists and texts."""

from __future__ import annotations

import re
from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from typing import NamedTuple, TypeAlias

from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.derivation.petri.stages import Stages, stages
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.nets.layout import EDGE, RADIUS
from lsys_kit.pictures.nets.parts import LINE, Parts, parts_of
from lsys_kit.pictures.style.labels import place_text, steering_of, visible

Unfolding: TypeAlias = bool | str | Collection[str]
"""Which symbols of a stage diagram are unfolded, as `stages` takes it."""
_PIXELS = frozenset(("x", "y", "half", "tx", "ty", "width"))
_PATHS, _WHOLE = frozenset(("path", "band", "head", "line")), re.compile(r"\.0(?!\d)")
"""Parts that are paths of SVG, and what of their numbers is left out."""
NARROW, LOW = 320, 40
"""The size of a diagram that has nothing but a sentence, in pixels."""


def net_of(system: LSystem, constants: Mapping[str, object], unfold: Unfolding = False) -> Stages:
    """The stage diagram of a system; grouped, where other constants or edited rules keep it from being unfolded.

    >>> from lsys_kit.notation.read import read
    >>> net_of(read("axiom: A(1)\\nA(t) : t < 3 -> A(t+1)"), {}, "B")
    A(1) -> A(2)
    A(2) -> A(3)
    """
    given: Data = dict(constants)
    if unfold is not False:
        with suppress(LSystemError):
            return stages(system, unfold=unfold, **given)
    return stages(system, **given)


def net_entry(
    made: Callable[[], Stages], steering: Callable[[LSystem], frozenset[str]] = steering_of
) -> tuple[Stages | None, Data]:
    """A net and its diagram, without the symbols that only steer; where there is none to be drawn, a diagram that says why.

    >>> from lsys_kit.derivation.petri.stages import stages
    >>> from lsys_kit.notation.read import read
    >>> net, diagram = net_entry(lambda: stages(read("axiom: a\\na -> ab\\nb -> a")))
    >>> diagram["names"], [(place["name"], place["x"], place["y"]) for place in diagram["places"]]
    (['a', 'b'], [('b', 31.0, 73.0), ('a', 109.0, 73.0)])
    """
    try:
        net = made()
        parts = parts_of(net, False, steering(net.system))
        return net, _diagram(parts, [place_text(place, net.system) for place in net.places])
    except LSystemError as error:
        text = f"There is no stage diagram: {error.message}"
        return None, _diagram(Parts(NARROW, LOW, text, (), (), (), (), (text,), LOW / 2), [])


def _diagram(parts: Parts, names: list[str]) -> Data:
    return {
        "width": parts.width,
        "height": parts.height,
        "description": visible(parts.description),
        "radius": RADIUS,
        "names": [*map(visible, names)],
        "places": [*map(_written, parts.places)],
        "bars": [*map(_written, parts.bars)],
        "arcs": [*map(_written, parts.arcs)],
        "notes": [[*_written(note).values()] for note in parts.notes],
        "footnotes": [
            {"x": EDGE, "y": _tenths(parts.foot + LINE * line), "text": visible(text)}
            for line, text in enumerate(parts.footnotes)
        ],
    }


def _written(part: NamedTuple) -> Data:
    """A part, without the number of an arc or a transition, which nobody asks for; texts are visible, paths without zeros that
    say nothing, and pixels in tenths."""
    found = {name: value for name, value in part._asdict().items() if name not in ("arc", "transition")}
    return {
        name: _short(visible(value), name) if isinstance(value, str) else _tenths(value) if name in _PIXELS else value
        for name, value in found.items()
    }


def _short(text: str, name: str) -> str:
    return _WHOLE.sub("", text) if name in _PATHS else text


def _tenths(pixels: float) -> float:
    return round(pixels, 1)
