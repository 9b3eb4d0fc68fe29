"""The stage diagram in a book: its parts as lists and texts."""

from __future__ import annotations

from collections.abc import Callable, Collection, Mapping
from contextlib import suppress
from typing import Any, TypeAlias

from lsys_kit.derivation.petri.stages import Stages, stages
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.nets.layout import EDGE, RADIUS
from lsys_kit.pictures.nets.parts import LINE, ArcPart, BarPart, NotePart, Parts, PlacePart, parts_of, steering_of
from lsys_kit.pictures.style.labels import place_text, visible

Unfolding: TypeAlias = bool | str | Collection[str]
"""Which symbols of a stage diagram are unfolded, as `stages` takes it."""
NARROW, LOW = 320, 40
"""The size of a diagram that has nothing but a sentence, in pixels."""


def net_of(system: LSystem, constants: Mapping[str, object], unfold: Unfolding = False) -> Stages:
    """The stage diagram of a system; grouped, where other constants or edited rules keep it from being unfolded.

    >>> from lsys_kit.notation.read import read
    >>> net_of(read("axiom: A(1)\\nA(t) : t < 3 -> A(t+1)"), {}, "B")
    A(1) -> A(2)
    A(2) -> A(3)
    """
    given: dict[str, Any] = dict(constants)
    if unfold is not False:
        with suppress(LSystemError):
            return stages(system, unfold=unfold, **given)
    return stages(system, **given)


def net_entry(
    made: Callable[[], Stages], steering: Callable[[LSystem], frozenset[str]] = steering_of
) -> tuple[Stages | None, dict[str, Any]]:
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


def _diagram(parts: Parts, names: list[str]) -> dict[str, Any]:
    return {
        "width": parts.width,
        "height": parts.height,
        "description": visible(parts.description),
        "radius": RADIUS,
        "names": [*map(visible, names)],
        "places": [*map(_place, parts.places)],
        "bars": [*map(_bar, parts.bars)],
        "arcs": [*map(_arc, parts.arcs)],
        "notes": [*map(_note, parts.notes)],
        "footnotes": [
            {"x": EDGE, "y": _tenths(parts.foot + LINE * line), "text": visible(text)}
            for line, text in enumerate(parts.footnotes)
        ],
    }


def _place(part: PlacePart) -> dict[str, Any]:
    return {
        "place": part.place,
        "x": _tenths(part.x),
        "y": _tenths(part.y),
        "letter": visible(part.letter),
        "subscript": visible(part.subscript),
        "values": part.values,
        "name": visible(part.name),
        "title": visible(part.title),
        "colour": part.colour,
        "strength": part.strength,
    }


def _bar(part: BarPart) -> dict[str, Any]:
    return {
        "x": _tenths(part.x),
        "y": _tenths(part.y),
        "half": _tenths(part.half),
        "line": part.line,
        "terms": visible(part.terms),
        "full": visible(part.full),
        "tx": _tenths(part.tx),
        "ty": _tenths(part.ty),
    }


def _arc(part: ArcPart) -> dict[str, Any]:
    return {"path": part.path, "band": part.band, "head": part.head}


def _note(part: NotePart) -> list[Any]:
    return [_tenths(part.x), _tenths(part.y), _tenths(part.width), visible(part.text)]


def _tenths(pixels: float) -> float:
    return round(pixels, 1)
