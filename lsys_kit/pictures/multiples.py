"""Small multiples: several steps, or plants of several seeds, side by side on one scale, each with a caption.

Source: E. R. Tufte, The Visual Display of Quantitative Information, 1983, on small multiples.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field
from functools import cached_property
from typing import TYPE_CHECKING, NamedTuple

from lsys_kit.geometry.scene import Scene
from lsys_kit.pictures.formats.lettering import advance
from lsys_kit.pictures.formats.notebook import SVGPicture, described
from lsys_kit.pictures.formats.painting import on_ground, painted
from lsys_kit.pictures.formats.raster import embedded, turtle_image
from lsys_kit.pictures.legends import Legend, with_legend
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import LARGEST_SCALE, MARGIN, ViewFrame, frame_on, in_fine_parts, painted_box
from lsys_kit.pictures.rendering.scene_shapes import label_shapes, scene_shapes
from lsys_kit.pictures.shapes import Drawing, Look, Raster, Shape, Text
from lsys_kit.pictures.sizes import document, enlargement, resized
from lsys_kit.pictures.style.themes import theme

if TYPE_CHECKING:
    from PIL.Image import Image

WIDTH, HEIGHT = 760, 540
"""The greatest size of a picture, in pixels."""
GAP, CAPTION, TEXT, LOWER = 30, 44, 13, 22
"""The space between two drawings, that below one, the size of its caption there and how far below the ground it stands, in
pixels."""


class Panel(NamedTuple):
    """Where a drawing lies: its frame in the whole picture, the middle of its cell, and its ground, in pixels."""

    frame: ViewFrame
    middle: float
    ground: float


@dataclass(frozen=True)
class SmallMultiples(SVGPicture):
    """Drawings side by side.

    Attributes
    ----------
    pictures
        The drawings, seen from the same side.
    captions
        For each what stands below it.
    columns
        How many stand in a line; 0 for as many as make them largest.
    labels
        Whether they have their captions.
    legend
        What stands below them all, or None.
    """

    pictures: Sequence[Picture]
    captions: Sequence[str]
    columns: int = 0
    labels: bool = True
    legend: Legend | None = field(default=None, kw_only=True, repr=False)

    @property
    def sunlit(self) -> bool:
        """Whether it shows something in sun and sky, which is pixels in all formats."""
        return self.pictures[-1].sunlit

    @cached_property
    def text(self) -> str:
        """What the picture shows, in words."""
        return described([f"{self.captions[0]} to {self.captions[-1]}", f"the last: {self.pictures[-1].text}"])

    def _image(self, enlarged: float) -> Image:
        return painted(resized(self._shown(0, enlarged), self.pixels), enlarged)

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The drawings with their captions; if they have more shapes than the most, they are pixels."""
        captions = self.captions if self.labels else [""] * len(self.captions)
        broadest = max(advance(caption, TEXT) for caption in captions)
        panels = arranged([each.scene for each in self.pictures], self.columns, broadest)
        frame = panels[0].frame
        factor = enlarged * enlargement(frame.width, frame.height, self.pixels)
        pixels = sum(each.size for each in self.pictures) > most or self.sunlit
        panels_with = zip(self.pictures, panels, captions, strict=True)
        body = [shape for each in panels_with for shape in _panel_shapes(*each, factor if pixels else 0.0)]
        return with_legend(document(body, frame.width, frame.height, self.text, frame.parts), self.legend)

    def __repr__(self) -> str:
        return self.text


def arranged(scenes: Sequence[Scene], columns: int = 0, broadest: float = 0.0) -> list[Panel]:
    """The places of drawings, on the greatest scale on which all fit: in lines of as many, on a common ground; none is narrower
    than the broadest caption, in pixels.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> plants = [scene_of(derive(read("axiom: F\\nF -> FF"), step)) for step in (1, 2)]
    >>> [(round(panel.middle), round(panel.ground), panel.frame.scale) for panel in arranged(plants)]
    [(12, 484, 118.0), (42, 484, 118.0)]
    """
    boxes = [painted_box(scene) for scene in scenes]
    wide, high = max(right - left for left, _, right, _ in boxes), max(top - bottom for _, bottom, _, top in boxes)
    narrow = broadest + GAP
    choices = [columns] if columns else [many for many in range(len(boxes), 0, -1) if many * narrow <= WIDTH or many == 1]
    columns = max(choices, key=lambda many: _scale(wide, high, len(boxes), many))
    scale = _scale(wide, high, len(boxes), columns)
    lines = -(-len(boxes) // columns)
    room = max(wide * scale, broadest)
    across, down = room + GAP, high * scale + CAPTION
    width, height = round(columns * across - GAP) + 2 * MARGIN, round(lines * down) + 2 * MARGIN
    parts = max(in_fine_parts(frame_on(painted_box(scene), scale), scene).parts for scene in scenes)
    panels = []
    for number, (left, bottom, right, _) in enumerate(boxes):
        line, column = divmod(number, columns)
        middle, ground = MARGIN + column * across + room / 2, MARGIN + line * down + high * scale
        corner = (left + right) / 2 - (middle - MARGIN) / scale, bottom + (ground - MARGIN) / scale
        panels.append(Panel(ViewFrame(scale, *corner, width, height, parts), middle, ground))
    return panels


def _scale(wide: float, high: float, many: int, columns: int) -> float:
    """The pixels of a unit with which so many drawings fit into a picture, in so many columns."""
    lines = -(-many // columns)
    across = (WIDTH - 2 * MARGIN + GAP) / columns - GAP
    down = (HEIGHT - 2 * MARGIN) / lines - CAPTION
    return min(across / max(wide, 1e-9), down / max(high, 1e-9), LARGEST_SCALE)


def _panel_shapes(picture: Picture, panel: Panel, caption: str, pixels: float) -> list[Shape]:
    """A drawing with its caption; perhaps as so many pixels in each direction of one of the picture."""
    parts = panel.frame.parts
    drawn = (
        scene_shapes(picture.scene, panel.frame, picture.colour_of, picture.marked)
        if not pixels
        else [_panel_image(picture, panel, pixels), *label_shapes(picture.scene, panel.frame)]
    )
    look = Look(font_size=TEXT * parts, text_anchor="middle", font_family="sans-serif", fill=theme().quiet)
    return [*drawn, Text(round(panel.middle * parts), round((panel.ground + LOWER) * parts), caption, look)]


def _panel_image(picture: Picture, panel: Panel, enlarged: float) -> Raster:
    own, parts = frame_on(painted_box(picture.scene), panel.frame.scale), panel.frame.parts
    image = on_ground(lambda: turtle_image(picture.scene, picture.colour_of, own, enlarged))
    corner = round((panel.middle - own.width / 2) * parts), round((panel.ground - own.height + MARGIN) * parts)
    return embedded(own.width * parts, own.height * parts, image, corner)
