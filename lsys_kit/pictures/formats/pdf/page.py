"""Pictures as PDF: the shapes of a drawing as the operators of a page.

The operators are written directly. What the kit draws are paths, texts, images and radial gradients, and a path of SVG becomes
one of PDF letter by letter, ten times as fast as by a library. Source: ISO 32000-1:2008, chapters 8 to 11.
"""

from __future__ import annotations

import io
import re
from collections.abc import Iterator, Mapping, Sequence
from itertools import pairwise

from lsys_kit.budget import counted
from lsys_kit.files import KIT_MARK
from lsys_kit.pictures.formats.pdf.fonts import add_font
from lsys_kit.pictures.formats.pdf.objects import Objects, dictionary, number_text, reference, string
from lsys_kit.pictures.formats.vector.lettering import SLANT, advance, outlines
from lsys_kit.pictures.formats.vector.paths import ellipse
from lsys_kit.pictures.formats.vector.shapes import Drawing, Font, Gradient, Look, Outline, Place, Raster, Shape, Sphere, Text

POINT = 0.75
"""A pixel, of which an inch has 96, in points, of which it has 72."""
ROUND_JOINS = "1 j"
_CURVE = re.compile(r"C([\d.\-]+) ([\d.\-]+) ([\d.\-]+) ([\d.\-]+) ([\d.\-]+) ([\d.\-]+)")
_LINE = re.compile(r"([ML])([\d.\-]+) ([\d.\-]+)")
_LETTERS = str.maketrans("MLZ", "mlh")


def pdf(drawing: Drawing) -> bytes:
    """A drawing as a page of its size."""
    objects = Objects()
    writer = _Writer(objects, drawing.shapes)
    content = objects.stream(writer.content(drawing.shapes, Place(POINT, 0.0, POINT * drawing.height)).encode("ascii"))
    resources = objects.add(dictionary(writer.resources))
    page, pages = resources + 1, resources + 2
    objects.add(
        dictionary(
            {
                "Type": "/Page",
                "Parent": reference(pages),
                "MediaBox": [0, 0, POINT * drawing.width, POINT * drawing.height],
                "Group": {"S": "/Transparency", "CS": "/DeviceRGB"},
                "Resources": reference(resources),
                "Contents": reference(content),
            }
        )
    )
    objects.add(dictionary({"Type": "/Pages", "Kids": [reference(page)], "Count": 1}))
    root = objects.add(
        dictionary({"Type": "/Catalog", "Pages": reference(pages), "ViewerPreferences": {"DisplayDocTitle": "true"}})
    )
    info = objects.add(f"<</Title {string(drawing.title)} /Creator {string(KIT_MARK.decode())}>>")
    return objects.file(root, info)


def operators(data: str) -> str:
    """A path in the plain form as operators.

    >>> operators("M0 0L1 2C3 4 5 6 7 8Z")
    '0 0 m 1 2 l  3 4 5 6 7 8 c h '
    """
    if "C" in data:
        data = _CURVE.sub(r" \1 \2 \3 \4 \5 \6 c ", data)
    return _LINE.sub(r"\2 \3 \1 ", data).replace("Z", "Z ").translate(_LETTERS)


def _colour(colour: str, operator: str) -> str:
    return " ".join(number_text(channel / 255) for channel in bytes.fromhex(colour[1:])) + f" {operator}"


class _Writer:
    """What writes the operators of shapes, and adds to a file what they need beside them."""

    def __init__(self, objects: Objects, shapes: Sequence[Shape]) -> None:
        self._objects = objects
        self.resources: dict[str, dict[str, str]] = {"ExtGState": {}, "Font": {}, "Shading": {}, "XObject": {}}
        self._names: dict[object, str] = {}
        self._codes: dict[Font, Mapping[str, int]] = {}
        for font in dict.fromkeys(shape.font for shape in shapes if isinstance(shape, Text)):
            letters = {
                letter
                for shape in shapes
                if isinstance(shape, Text) and shape.font == font
                for run in shape.runs
                for letter in run.text
            }
            number, self._codes[font] = add_font(objects, font, letters)
            self._named("Font", font, number)

    def _named(self, kind: str, key: object, number: int) -> str:
        """The name by which the page calls an object."""
        own = self.resources[kind]
        name = f"{kind[0]}{len(own)}"
        own[name] = reference(number)
        self._names[key] = name
        return name

    def content(self, shapes: Sequence[Shape], page: Place) -> str:
        """The operators of shapes, given where a drawing lies on the page; y grows downwards there."""
        parts: list[str] = [f"{number_text(page.scale)} 0 0 {number_text(-page.scale)} 0 {number_text(page.y)} cm"]
        place = None
        for shape in counted(shapes):
            if shape.place != place:
                parts += ["Q"] * (place is not None)
                scale, x, y = place = shape.place
                parts.append(f"q {scale:.8f} 0 0 {scale:.8f} {number_text(x)} {number_text(y)} cm")
            parts += self._shape(shape)
        return "\n".join([*parts, *["Q"] * (place is not None)])

    def _shape(self, shape: Shape) -> Iterator[str]:
        if isinstance(shape, Outline):
            return self._outline(shape)
        if isinstance(shape, Sphere):
            return self._sphere(shape)
        return self._text(shape) if isinstance(shape, Text) else self._raster(shape)

    def _outline(self, shape: Outline) -> Iterator[str]:
        look, path = shape.look, operators(shape.data)
        clear = self._opacity(look)
        yield from (f"q {clear}",) if clear else ()
        if look.fill:
            yield _colour(look.fill, "rg")
        if look.stroke:
            dashes = " ".join(map(number_text, look.dashes))
            yield (
                f"{_colour(look.stroke, 'RG')} {number_text(look.width)} w {int(look.round_ends)} J {ROUND_JOINS} "
                f"[{dashes}] 0 d"
            )
        painted = "B" if look.fill and look.stroke else "f" if look.fill else "S"
        yield path + painted + "*" * (look.evenodd and painted != "S")
        yield from ("Q",) if clear else ()

    def _opacity(self, look: Look) -> str:
        """What makes that what follows is not opaque; nothing, if it is."""
        key = (look.fill_opacity, look.stroke_opacity)
        if key == (1, 1):
            return ""
        if key not in self._names:
            self._named("ExtGState", key, self._objects.add(dictionary({"Type": "/ExtGState", "ca": key[0], "CA": key[1]})))
        return f"/{self._names[key]} gs"

    def _sphere(self, shape: Sphere) -> Iterator[str]:
        """A circle through which one sees a gradient."""
        gradient, side = shape.gradient, number_text(2 * shape.radius)
        if gradient not in self._names:
            self._named("Shading", gradient, self._shading(gradient, [_channels(stop.colour) for stop in gradient.stops]))
        corner = f"{number_text(shape.x - shape.radius)} {number_text(shape.y - shape.radius)}"
        mask = self._mask(gradient) if any(stop.opacity < 1 for stop in gradient.stops) else ""
        yield f"q {side} 0 0 {side} {corner} cm {operators(ellipse(0.5, 0.5, 0.5, 0.5))}W n {mask}/{self._names[gradient]} sh Q"

    def _shading(self, gradient: Gradient, colours: Sequence[Sequence[float]]) -> int:
        """A radial gradient in a square whose side is 1, through some colours."""
        offsets = [stop.offset for stop in gradient.stops]
        pieces = [{"FunctionType": 2, "Domain": [0, 1], "N": 1, "C0": first, "C1": last} for first, last in pairwise(colours)]
        function = {
            "FunctionType": 3,
            "Domain": [0, 1],
            "Functions": pieces,
            "Bounds": offsets[1:-1],
            "Encode": [0, 1] * len(pieces),
        }
        space = "/DeviceRGB" if len(colours[0]) == 3 else "/DeviceGray"
        return self._objects.add(
            dictionary(
                {
                    "ShadingType": 3,
                    "ColorSpace": space,
                    "Extend": ["true", "true"],
                    "Function": function,
                    "Coords": [gradient.x, gradient.y, 0, gradient.x, gradient.y, gradient.radius],
                }
            )
        )

    def _mask(self, gradient: Gradient) -> str:
        """What makes a gradient as opaque as its stops say."""
        key = ("mask", gradient)
        if key not in self._names:
            grey = self._shading(gradient, [[stop.opacity] for stop in gradient.stops])
            form = self._objects.stream(
                b"/S0 sh",
                {
                    "Type": "/XObject",
                    "Subtype": "/Form",
                    "BBox": [0, 0, 1, 1],
                    "Group": {"S": "/Transparency", "CS": "/DeviceGray"},
                    "Resources": {"Shading": {"S0": reference(grey)}},
                },
            )
            mask = {"Type": "/Mask", "S": "/Luminosity", "G": reference(form)}
            self._named("ExtGState", key, self._objects.add(dictionary({"Type": "/ExtGState", "SMask": mask})))
        return f"/{self._names[key]} gs "

    def _text(self, shape: Text) -> Iterator[str]:
        if shape.halo:
            yield f"{_colour(shape.halo, 'RG')} {number_text(shape.halo_width)} w 1 J {ROUND_JOINS} [] 0 d {_contours(shape)}S"
        codes, name = self._codes[shape.font], self._names[shape.font]
        yield f"BT {_colour(shape.colour, 'rg')}"
        for run in shape.runs:
            text = "".join(f"{codes[letter]:04X}" for letter in run.text)
            lean = number_text(SLANT if run.italic else 0)
            yield f"/{name} {number_text(run.size)} Tf 1 0 {lean} -1 {number_text(run.x)} {number_text(run.y)} Tm <{text}> Tj"
        yield "ET"

    def _raster(self, shape: Raster) -> Iterator[str]:
        from PIL import Image

        seen = Image.open(io.BytesIO(shape.png)).convert("RGBA")
        image = Image.alpha_composite(Image.new("RGBA", seen.size, "white"), seen).convert("RGB")
        number = self._objects.stream(
            image.tobytes(),
            {
                "Type": "/XObject",
                "Subtype": "/Image",
                "Width": image.width,
                "Height": image.height,
                "ColorSpace": "/DeviceRGB",
                "BitsPerComponent": 8,
            },
        )
        name = self._named("XObject", object(), number)
        x, y, width, height = map(number_text, (shape.x, shape.y + shape.height, shape.width, -shape.height))
        yield f"q {width} 0 0 {height} {x} {y} cm /{name} Do Q"


def _channels(colour: str) -> list[float]:
    return [channel / 255 for channel in bytes.fromhex(colour[1:])]


def _contours(shape: Text) -> str:
    """The outlines of the letters of a text; as a text of their own they would be found twice."""
    parts = []
    for run in shape.runs:
        x = run.x
        for letter in run.text:
            for corners in outlines(letter, run.size, run.italic, shape.font):
                points = [f"{number_text(x + across)} {number_text(run.y + down)}" for across, down in corners.tolist()]
                parts.append(f"{points[0]} m " + "".join(f"{point} l " for point in points[1:]) + "h ")
            x += advance(letter, run.size, shape.font)
    return "".join(parts)
