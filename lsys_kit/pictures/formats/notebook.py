"""Pictures as a notebook shows them: with a text alternative, which JupyterLab gives to no picture that comes without one."""

from __future__ import annotations

import base64
from abc import ABC, abstractmethod
from collections.abc import Callable
from dataclasses import dataclass, field
from html import escape
from pathlib import Path
from typing import Any

from lsys_kit.files import marked_xml
from lsys_kit.pictures.formats.files import save_as
from lsys_kit.pictures.sizes import Size


@dataclass(frozen=True)
class SVGPicture(ABC):
    """A picture that is written as SVG; its text alternative is what `repr` says of it.

    Attributes
    ----------
    pixels
        Its width and height, if it is not of the usual size.
    """

    pixels: Size | None = field(default=None, kw_only=True, repr=False)

    @property
    @abstractmethod
    def svg(self) -> str:
        """The picture as SVG text."""

    def save(self, path: str | Path) -> None:
        """Write the picture to an .svg file.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        """
        save_as(Path(path), {".svg": lambda: marked_xml(self.svg)})

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return svg_bundle(self.svg, repr(self))


def svg_bundle(svg: str, text: str) -> dict[str, Any]:
    """A picture in SVG with its text alternative, by media types.

    >>> svg_bundle("<svg/>", "a <plant>")["text/html"]
    '<img alt="a &lt;plant&gt;" src="data:image/svg+xml;base64,PHN2Zy8+">'
    """
    return {"text/html": _image("svg+xml", svg.encode(), text), "image/svg+xml": svg, "text/plain": text}


def film_bundle(moving: bytes, still: Callable[[], bytes], text: str) -> dict[str, Any]:
    """A film as a GIF that can be stopped, with its text alternative, by media types; stopped it shows its last picture."""
    html = (f"{_STYLE}<div class='lsys-film'><label><input type='checkbox' checked> play</label><br>"
            f"{_image('gif', moving, text, 'lsys-moving')}{_image('png', still(), text, 'lsys-still')}</div>")
    return {"text/html": html, "image/gif": base64.b64encode(moving).decode(), "text/plain": text}


_STYLE = ("<style>.lsys-film:has(input:checked) .lsys-still, .lsys-film:has(input:not(:checked)) .lsys-moving {display: none}"
          "</style>")


def _image(form: str, data: bytes, text: str, kind: str = "") -> str:
    named = f'class="{kind}" ' if kind else ""
    return f'<img {named}alt="{escape(text)}" src="data:image/{form};base64,{base64.b64encode(data).decode()}">'
