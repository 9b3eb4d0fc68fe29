"""Pictures of words and of stage diagrams, in every format in which a page shows them or a file keeps them."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from contextlib import AbstractContextManager
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING

from lsys_kit.budget import Task, current
from lsys_kit.derivation.petri.pnml import placed_pnml
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.files import marked_xml, save_file
from lsys_kit.geometry.meshes.mesh import OWN_WIDTHS, Mesh, mesh_of
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.pictures.filaments import LOOKS, FilamentRow, filament_layout, letters_fit, row_shapes
from lsys_kit.pictures.formats.axes import plot_turtle
from lsys_kit.pictures.formats.mesh_files import glb, mtl, obj
from lsys_kit.pictures.formats.notebook import FILMS, Encoders, SVGPicture, described, listed
from lsys_kit.pictures.formats.painting import on_ground, painted
from lsys_kit.pictures.formats.raster import embedded, turtle_image, turtle_picture
from lsys_kit.pictures.legends import Legend, plot_legend, with_legend
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.parts import positions_in
from lsys_kit.pictures.rendering.frames import WIDTH, ViewFrame, frame_around, in_fine_parts
from lsys_kit.pictures.rendering.light import LitScene
from lsys_kit.pictures.rendering.looks import widths_by_order
from lsys_kit.pictures.rendering.scene_shapes import label_shapes, scene_shapes
from lsys_kit.pictures.shapes import Drawing
from lsys_kit.pictures.sizes import document, enlargement, resized
from lsys_kit.pictures.style.labels import visible
from lsys_kit.pictures.style.themes import drawn_on, theme

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from PIL.Image import Image

MOST_PAINTED = 2_000
"""In a picture of pixels more cells than this are painted as pixels at once, which is faster."""


@dataclass(frozen=True)
class Picture(SVGPicture):
    """A picture of one word, or of the steps of a filament below one another.

    Attributes
    ----------
    rows
        The scenes, one for each step that is shown.
    colour_of
        For each state its colour.
    current
        The step whose row is marked, or None.
    marked
        The states whose modules are marked.
    solid
        The scene of the last step in space; None if it lies in the plane.
    look
        How cells are drawn: as "rectangles" or "ellipses".
    time
        The duration of a step of a filament, if its system defines one.
    labels
        Whether the rows of a filament are labelled; True if letters are wanted in its cells.
    letters
        What is written into cells, by their states.
    legend
        What stands below it, or None.
    """

    rows: tuple[FilamentRow, ...]
    colour_of: Mapping[int, str] = field(repr=False)
    current: int | None = None
    marked: Collection[int] = ()
    solid: Scene | None = None
    look: str = LOOKS[0]
    time: Value | None = None
    labels: bool | None = None
    letters: Mapping[int, str] = field(default_factory=dict, kw_only=True, repr=False)
    legend: Legend | None = field(default=None, kw_only=True, repr=False)

    @property
    def scene(self) -> Scene:
        """The projected scene of the last step shown."""
        return self.rows[-1].scene

    @cached_property
    def text(self) -> str:
        """What the picture shows, in words."""
        steps = f"steps {self.rows[0].step} to {self.rows[-1].step}" if len(self.rows) > 1 else ""
        shown = str(self.scene if self.solid is None else self.solid)
        return described([steps, ("the last: " if steps else "") + shown, self._light])

    @property
    def sunlit(self) -> bool:
        """Whether it shows something in sun and sky, which is pixels in all formats."""
        return isinstance(self.scene, LitScene)

    @property
    def _light(self) -> str:
        return "in sunlight, as an image of pixels in any format" if self.sunlit else ""

    @property
    def size(self) -> int:
        """How many shapes there are to draw."""
        return sum(row.scene.size for row in self.rows)

    def _image(self, enlarged: float) -> Image:
        if len(self.scene.cells) or self.legend or len(self.scene.labels):
            most = MOST_PAINTED if len(self.scene.cells) else 0
            return painted(resized(self._shown(most, enlarged), self.pixels), enlarged)
        with self._reduced(frame_around([self.scene])):
            return turtle_picture(self.scene, self.colour_of, self.pixels, enlarged)

    def _plot_into(self, ax: Axes) -> None:
        if self.size > current().figure and not self.sunlit:
            raise ModelLimitError(
                f"The figure would have {self.size:,} shapes; the limit is {current().figure:,}",
                limit=current().figure,
                needed=self.size,
                hint="Take fewer steps, keep the picture as .png, or set limits(figure=...).",
            )
        if len(self.scene.cells) or self.sunlit:
            super()._plot_into(ax)
        else:
            plot_turtle(ax, self.scene, self.colour_of)
            if self.legend is not None:
                plot_legend(ax, self.legend)

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The last scene, or the rows of a filament; if they have more shapes than the most, these are pixels."""
        if len(self.scene.cells):
            return self._sequence(self.size > most, enlarged)
        usual = frame_around([self.scene])
        with self._reduced(usual):
            return self._drawn(usual, most, enlarged)

    def _reduced(self, usual: ViewFrame) -> AbstractContextManager[None]:
        """What makes strokes of a picture that is smaller than usual broad enough to be seen."""
        factor = min(1.0, enlargement(usual.width, usual.height, self.pixels))
        return drawn_on(replace(theme(), reduced=factor))

    def _drawn(self, usual: ViewFrame, most: int, enlarged: float) -> Drawing:
        frame = in_fine_parts(usual, self.scene)
        if self.size > most or self.sunlit:
            factor = enlarged * enlargement(usual.width, usual.height, self.pixels)
            image = on_ground(lambda: turtle_image(self.scene, self.colour_of, usual, factor))
            pixels = embedded(frame.width * frame.parts, frame.height * frame.parts, image)
            body = [pixels, *label_shapes(self.scene, frame)]
        else:
            body = scene_shapes(self.scene, frame, self.colour_of, self.marked)
        return with_legend(document(body, frame.width, frame.height, self.text, frame.parts), self.legend)

    def film_images(self) -> Sequence[Image]:
        """The rows of a filament, which appear one after another."""
        many = len(self.rows) if len(self.scene.cells) and self.current is not None else 0
        pixels = self.size > MOST_PAINTED
        rows = (self._sequence(pixels, 1.0, shown) for shown in range(1, many + 1))
        return [painted(resized(each, self.pixels)) for each in rows] or [self.image()]

    def _sequence(self, pixels: bool, enlarged: float, shown: int = 0) -> Drawing:
        """The rows of a filament, whose cells may be pixels; perhaps as if so many of them were all."""
        labelled = self.labels is not False
        layout, image = filament_layout(self.rows, labelled and self.current is not None, self.time, labelled), None
        height, now = layout.height, self.rows[shown - 1].step if shown else self.current
        begun = {row.step for row in self.rows[: shown or None]}
        sheet = replace(layout, rows=[line for line in layout.rows if line.step in begun])

        def cells() -> Drawing:
            bare = row_shapes(sheet, self.look, self.colour_of, now, self.marked, bare=True)
            return document(bare, WIDTH, sheet.height, "")

        if pixels:
            factor = enlarged * enlargement(WIDTH, height, self.pixels)
            image = embedded(10 * WIDTH, 10 * sheet.height, on_ground(lambda: painted(cells(), factor, quick=True)))
        letters = self.letters if self.labels or letters_fit(layout, self.letters) else {}
        body = row_shapes(sheet, self.look, self.colour_of, now, self.marked, image, letters)
        return with_legend(document(body, WIDTH, height, self.text), self.legend)

    @cached_property
    def mesh(self) -> Mesh:
        """The last step shown as triangles in space."""
        with Task("The mesh was not made"), drawn_on(self.theme):
            return mesh_of(self.scene if self.solid is None else self.solid, widths_by_order(OWN_WIDTHS))

    def _encoders(self, path: Path, dots: float | None) -> tuple[Encoders, str]:
        library = path.parent / ("".join(c if c.isalnum() else "_" for c in path.stem) + ".mtl")

        def with_colours() -> bytes:
            save_file(library, mtl(self.mesh, self.colour_of))
            return obj(self.mesh, self.colour_of, library.name)

        solid: Encoders = {".glb": lambda: glb(self.mesh, self.colour_of), ".obj": with_colours}
        flat, _ = super()._encoders(path, dots)
        return {**flat, **solid}, f"Films end in {listed(FILMS)}, and are made by animate(...)."

    def __repr__(self) -> str:
        return "; ".join(filter(None, (self.text, passed_over(self.scene.unknown))))


@dataclass(frozen=True)
class NetPicture(SVGPicture):
    """A picture of a stage diagram.

    Attributes
    ----------
    net
        The diagram's net.
    tokens
        The number of modules in each place, or None.
    positions
        Whether arcs are labelled with the positions of their modules in the successor.
    labels
        Whether stages have their names.
    """

    net: Stages
    tokens: tuple[int, ...] | None = None
    positions: bool = False
    labels: bool = True

    def _shown(self, most: int, enlarged: float) -> Drawing:
        """The diagram."""
        return drawn_stages(self.net, self.tokens, positions=self.positions, labels=self.labels)

    def _encoders(self, path: Path, dots: float | None) -> tuple[Encoders, str]:
        flat, told = super()._encoders(path, dots)
        return {**flat, ".pnml": lambda: marked_xml(placed_pnml(self.net, self.tokens, positions_in(self.net)))}, told

    def __repr__(self) -> str:
        return visible(self.drawing().title)
