"""Pictures as a file keeps them, in the format given by its extension, and as a notebook shows them: with a text alternative,
which JupyterLab gives to no picture that comes without one.
"""

from __future__ import annotations

import base64
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterable, Mapping, Sequence
from dataclasses import dataclass, field
from functools import cached_property
from html import escape
from pathlib import Path
from typing import TYPE_CHECKING, TypeAlias
from warnings import warn

from lsys_kit.budget import Task, current
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.errors import ModelFileError, ModelValueError, quotable, require, shown
from lsys_kit.files import marked_png, marked_xml, path_from, save_file
from lsys_kit.pictures.formats.axes import plot_drawing
from lsys_kit.pictures.formats.painting import on_ground, painted
from lsys_kit.pictures.formats.pdf import pdf
from lsys_kit.pictures.formats.raster import encoded
from lsys_kit.pictures.formats.svg import svg
from lsys_kit.pictures.shapes import Drawing, has_pixels
from lsys_kit.pictures.sizes import SHARP, Size, resized
from lsys_kit.pictures.style.themes import LIGHT, Theme, drawn_on
from lsys_kit.supervision import supervised

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL.Image import Image

Encoders: TypeAlias = Mapping[str, Callable[[], bytes]]
"""For each extension a function that encodes the picture."""
FILMS = (".gif", ".apng", ".mp4")
"""The extensions of films."""


def save_as(path: Path, formats: Encoders, hint: str = "") -> None:
    """Write a file in the format given by its extension; a file that the kit has made before is replaced, no other.

    Parameters
    ----------
    path
        The path of the file.
    formats
        The formats, by extension.
    hint
        An addition to the error message if the extension is unknown.

    Raises
    ------
    ModelFileError
        The name ends in something else, a file that the kit did not make is there already, or the file cannot be written.
    """
    if path.suffix.lower() not in formats:
        raise ModelFileError(
            f'This picture cannot be written to "{quotable(path.name)}"',
            hint=f"Let the name end in {listed(formats)}. {hint}".rstrip(),
        )
    with Task("The file was not written"):
        content = formats[path.suffix.lower()]()
    save_file(path, content)


def listed(endings: Iterable[str]) -> str:
    """The extensions, in a sentence.

    >>> listed([".svg", ".png", ".pdf"])
    '.svg, .png or .pdf'
    """
    *most, last = endings
    return f"{', '.join(most)} or {last}" if most else last


INCH = 96
"""The pixels of an inch, as CSS has them."""
DOTS = 300
"""The dots of an inch of what is pixels in a PDF."""
SAVED = 5
"""So many calls up from a warning somebody saves a picture."""
LEAST_DOTS, MOST_DOTS = 24, 2_400
"""The least and the greatest number of dots of an inch of a PNG."""


@dataclass(frozen=True)
class SVGPicture(ABC):
    """A picture of shapes, which each format paints; its text alternative is what `repr` says of it.

    Attributes
    ----------
    pixels
        Its width and height, if it is not of the usual size.
    theme
        Its colours.
    """

    pixels: Size | None = field(default=None, kw_only=True, repr=False)
    theme: Theme = field(default=LIGHT, kw_only=True, repr=False)

    @property
    def sunlit(self) -> bool:
        """Whether it shows something in sun and sky, which is pixels in all formats."""
        return False

    @abstractmethod
    def _shown(self, most: int, enlarged: float) -> Drawing:
        """What the picture shows, in its usual size; if it has more shapes than the most, these are pixels, so many in each
        direction of its own."""

    @cached_property
    def svg(self) -> str:
        """The picture as SVG text."""
        with Task("The picture was not drawn"), drawn_on(self.theme):
            return svg(resized(self._shown(current().segments, SHARP), self.pixels))

    def _vector(self, ending: str, pixels: float) -> Drawing:
        """The shapes of a file; if they are pixels, so many in each direction of one of the picture, a warning says it."""
        drawing = self.drawing(pixels)
        if has_pixels(drawing.shapes):
            warn(
                f"The {ending} file holds pixels, as it would have more than {current().figure:,} shapes. "
                "Take fewer steps, or set limits(figure=...).",
                stacklevel=SAVED,
            )
        return drawing

    @cached_property
    def png(self) -> bytes:
        """The picture as PNG."""
        return encoded(self.image())

    @cached_property
    def pdf(self) -> bytes:
        """The picture as PDF, whose text can be selected."""
        with Task("The PDF was not written"):
            return pdf(self.drawing(DOTS / INCH))

    def image(self, enlarged: float = 1.0) -> Image:
        """The picture as an image, perhaps enlarged."""
        factor = enlargement_from(enlarged)
        with Task("The picture was not drawn"), drawn_on(self.theme):
            return on_ground(lambda: self._image(factor))

    def _image(self, enlarged: float) -> Image:
        return painted(self.drawing(enlarged), enlarged)

    def film_images(self) -> Sequence[Image]:
        """The images of a film of the picture, all of the same size: its steps, if it has any."""
        return [self.image()]

    def drawing(self, enlarged: float = 1.0) -> Drawing:
        """The shapes of the picture; what of it is pixels has so many in each direction of its own."""
        with Task("The picture was not drawn"), drawn_on(self.theme):
            return resized(self._shown(current().figure, enlargement_from(enlarged)), self.pixels)

    def plot_into(self, ax: Axes) -> None:
        """Paint the picture into axes of a matplotlib figure, whose units are pixels or those of its turtle."""
        from matplotlib.axes import Axes

        require(ax, Axes, "The axes of a figure")
        with Task("The figure was not drawn"), supervised(), drawn_on(self.theme):
            self._plot_into(ax)

    def _plot_into(self, ax: Axes) -> None:
        plot_drawing(ax, self.drawing())

    def save(self, path: str | Path, *, dpi: object = None) -> None:
        """Write the picture to a file, in the format given by its extension: .svg, .png or .pdf.

        Files in .svg and .pdf hold shapes; if these are more than `limits(figure=...)` allows, pixels, as a warning says.

        What a turtle has drawn can be written to .glb and .obj files, too, which are for 3D programs and contain only the last
        step; the colours of an .obj file are kept in an .mtl file beside it. Labels are no shapes in space, and left out there.
        A stage diagram can be written to a .pnml file, for Petri-net tools (see `pnml`).

        Parameters
        ----------
        path
            The file, whose name says the format.
        dpi
            For .png files the dots of an inch of paper: with 300 the picture has 300/96 of its size in pixels.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        ModelValueError
            The dots are no number from 24 to 2400, or the file is no .png file.
        """
        path = path_from(path)
        save_as(path, *self._encoders(path, dots_from(dpi, path)))

    def _encoders(self, path: Path, dots: float | None) -> tuple[Encoders, str]:
        """For each extension what encodes the picture; and what else there is, where none fits."""
        return {
            ".svg": lambda: marked_xml(svg(self._vector(".svg", SHARP))),
            ".png": lambda: marked_png(self.png if dots is None else encoded(self.image(dots / INCH)), dots),
            ".pdf": lambda: pdf(self._vector(".pdf", DOTS / INCH)),
        }, ""

    def _repr_mimebundle_(self, **_: object) -> dict[str, object]:
        if self.sunlit:
            return png_bundle(self.image(SHARP), repr(self))
        return svg_bundle(self.svg, repr(self), on_light=self.theme.ground == LIGHT.ground)


def described(parts: Iterable[str]) -> str:
    """Parts of a description, joined as a sentence."""
    return "; ".join(part for part in parts if part)


def dots_from(value: object, path: Path) -> float | None:
    """The dots of an inch that a person wants, for a file of a name.

    >>> dots_from("300", Path("plant.png")), dots_from(None, Path("plant.svg"))
    (300.0, None)

    Raises
    ------
    ModelValueError
        They are no number, too few or too many; or they mean nothing in this file.
    """
    if value is None:
        return None
    if path.suffix.lower() != ".png":
        raise ModelValueError("Dots per inch are chosen for .png files", hint="Other formats are as sharp as the paper.")
    dots = real_from(value, "dpi", "A printer wants 300 dots per inch: dpi=300.")
    if not LEAST_DOTS <= dots <= MOST_DOTS:
        raise ModelValueError(f"A picture can have {LEAST_DOTS} to {MOST_DOTS:,} dots per inch, not {dots:g}")
    return dots


def svg_bundle(svg: str, text: str, on_light: bool = False) -> dict[str, object]:
    """A picture in SVG with its text alternative, by media types; one on light paper gets dark paper where the notebook has,
    unless it has spheres, whose light would come from below there.

    >>> svg_bundle("<svg/>", "a <plant>")["text/html"]
    '<img alt="a &lt;plant&gt;" src="data:image/svg+xml;base64,PHN2Zy8+">'
    """
    darkened = on_light and GRADIENT not in svg
    image = _image("svg+xml", svg.encode(), text, "lsys-picture" if darkened else "")
    return {"text/html": f"{image}{DARKENED}" if darkened else image, "image/svg+xml": svg, "text/plain": text}


def png_bundle(image: Image, text: str) -> dict[str, object]:
    """A picture of pixels, so many in each direction of one of the page as screens have, with its text alternative."""
    png = encoded(image)
    size = f' width="{round(image.width / SHARP)}"'
    return {"text/html": _image("png", png, text, more=size), "image/png": base64.b64encode(png).decode(), "text/plain": text}


def film_bundle(moving: bytes, still: Callable[[], bytes], text: str) -> dict[str, object]:
    """A film as a GIF that can be stopped, with its text alternative, by media types; stopped it shows its last picture."""
    html = (
        f"{_STYLE}<div class='lsys-film'><label><input type='checkbox' checked> play</label><br>"
        f"{_image('gif', moving, text, 'lsys-moving')}{_image('png', still(), text, 'lsys-still')}</div>"
    )
    return {"text/html": html, "image/gif": base64.b64encode(moving).decode(), "text/plain": text}


DARKENED = (
    '<style>body[data-jp-theme-light="false"] .lsys-picture {filter: invert(.9) hue-rotate(180deg); border-radius: 4px}</style>'
)
"""In a dark notebook light and dark change places, and hues stay."""
GRADIENT = "<radialGradient"
"""What a picture with spheres has."""
_STYLE = (
    "<style>.lsys-film:has(input:checked) .lsys-still, .lsys-film:has(input:not(:checked)) .lsys-moving {display: none}</style>"
)


def _image(form: str, data: bytes, text: str, kind: str = "", more: str = "") -> str:
    named = f' class="{kind}"' if kind else ""
    return f'<img alt="{escape(text)}"{named}{more} src="data:image/{form};base64,{base64.b64encode(data).decode()}">'


def enlargement_from(given: object) -> float:
    """How much a picture is enlarged: a number greater than 0."""
    factor = real_from(given, "enlarged")
    if not factor > 0:
        raise ModelValueError(f'"enlarged" must be greater than 0, not {shown(given)}')
    return factor
