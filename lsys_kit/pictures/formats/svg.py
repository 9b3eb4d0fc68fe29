"""Pictures as SVG: the form of lesson pictures, because it scales, prints, and carries its own description.

Numbers that are whole are written so, others with one decimal; so the text of a picture is the same on every machine. What
could become markup is escaped.
"""

from __future__ import annotations

import base64
from collections.abc import Mapping

from lsys_kit.arrays import is_array
from lsys_kit.budget import counted
from lsys_kit.pictures.shapes import (
    Circle,
    Drawing,
    Ellipse,
    Gradient,
    Gradients,
    Group,
    Look,
    Paper,
    Path,
    Place,
    Polygon,
    Raster,
    Rectangle,
    Shape,
    Span,
    Strokes,
    Text,
    Title,
)
from lsys_kit.pictures.style.labels import escaped

_ELEMENTS: Mapping[type, tuple[str, tuple[str, ...]]] = {
    Path: ("path", ("d",)),
    Strokes: ("path", ("d",)),
    Polygon: ("polygon", ("points",)),
    Circle: ("circle", ("cx", "cy", "r")),
    Ellipse: ("ellipse", ("cx", "cy", "rx", "ry")),
    Rectangle: ("rect", ("x", "y", "width", "height", "rx")),
    Raster: ("image", ("x", "y", "width", "height", "href")),
    Text: ("text", ("x", "y")),
    Group: ("g", ()),
}
"""What a shape is called, and its first attributes in their order."""
_NAMES = {key: key.replace("_", "-") for key in Look.__annotations__}


def svg(drawing: Drawing) -> str:
    """A picture as SVG text, with its text alternative."""
    box, words = " ".join(map(str, drawing.box)), escaped(drawing.title)
    named = f'role="img" aria-label="{words}"'
    head = f"{_look(drawing.look)} {named}>" if drawing.look else f" {named}><title>{words}</title>"
    return (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{box}" width="{drawing.width}" height="{drawing.height}"{head}'
        f"{''.join(map(element, counted(drawing.shapes)))}</svg>"
    )


def element(shape: Shape | Span | str) -> str:
    """A shape as an element of SVG, or a piece of text.

    >>> element(Text(1, 2.5, "<a>", Look(font_size=12)))
    '<text x="1" y="2.5" font-size="12">&lt;a&gt;</text>'
    """
    if isinstance(shape, str | Span | Title | Gradients | Paper):
        return _other(shape)
    name, keys = _ELEMENTS[type(shape)]
    tags = "".join([f' {key}="{value}"' for key, value in shape.tags.items()]) if shape.tags else ""
    first = "".join(
        [
            f' {key}="{value if type(value) is int else _value(value)}"'
            for key, value in zip(keys, shape, strict=False)
            if value is not None
        ]
    )
    if isinstance(shape, Group | Text):
        inside = shape.shapes if isinstance(shape, Group) else shape.inside
        content = escaped(inside) if isinstance(inside, str) else "".join(map(element, inside))
        return f"<{name}{tags}{_transform(shape.place)}{first}{_look(shape.look)}>{content}</{name}>"
    return f"<{name}{tags}{first}{_look(shape.look)}/>"


def _other(shape: str | Span | Title | Gradients | Paper) -> str:
    if isinstance(shape, str):
        return escaped(shape)
    if isinstance(shape, Span):
        return f"<tspan{_look(shape.look)}>{escaped(shape.text)}</tspan>"
    if isinstance(shape, Title):
        return f"<title>{escaped(shape.text)}</title>"
    if isinstance(shape, Paper):
        return f'<rect width="100%" height="100%" fill="{shape.colour}"/>'
    return f"<defs>{''.join(map(_gradient, shape.gradients))}</defs>"


def _value(value: object) -> str:
    if isinstance(value, float):
        return f"{value:.1f}"
    if is_array(value):
        return "M%d %dL%d %d" * len(value) % tuple(value.ravel().tolist())
    if isinstance(value, list):
        return " ".join([f"{x},{y}" for x, y in value])
    return f"data:image/png;base64,{base64.b64encode(value).decode()}" if isinstance(value, bytes) else str(value)


def _transform(place: Place | None) -> str:
    if place is None:
        return ""
    enlarged = f" scale({place.scale})" if place.scale != 1 else ""
    return f' transform="translate({place.x} {place.y}){enlarged}"'


def _look(look: Look) -> str:
    return "".join([f' {_NAMES[key]}="{value if type(value) is str else _said(value)}"' for key, value in look.items()])


def _said(value: object) -> str:
    return f"url(#{value.name})" if isinstance(value, Gradient) else f"{value:g}" if isinstance(value, float) else str(value)


def _gradient(gradient: Gradient) -> str:
    stops = "".join(
        f'<stop offset="{offset}" stop-color="{colour}"' + (f' stop-opacity="{opacity}"/>' if opacity != 1 else "/>")
        for offset, colour, opacity in gradient.stops
    )
    return (
        f'<radialGradient id="{gradient.name}" cx="{gradient.x:.2f}" cy="{gradient.y:.2f}" r="{gradient.radius:.2f}">{stops}'
        "</radialGradient>"
    )
