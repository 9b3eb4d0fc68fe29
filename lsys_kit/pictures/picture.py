"""Pictures of words and of stage diagrams, in every format in which a page shows them or a file keeps them."""

from __future__ import annotations

import base64
import io
from collections.abc import Collection, Mapping
from dataclasses import dataclass, field
from functools import cached_property
from html import unescape
from pathlib import Path
from typing import TYPE_CHECKING

from lsys_kit.budget import Task, current, supervised
from lsys_kit.derivation.petri.pnml import placed_pnml
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.errors import ModelLimitError
from lsys_kit.files import KIT_MARK, marked_png, marked_xml, save_file
from lsys_kit.geometry.meshes.mesh import Mesh, mesh_of
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.surfaces import passed_over
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.pictures.filaments import LOOKS, filament_layout, rows_svg
from lsys_kit.pictures.formats.axes import new_axes, plot_rows, plot_turtle
from lsys_kit.pictures.formats.filament_raster import rows_png
from lsys_kit.pictures.formats.files import save_as
from lsys_kit.pictures.formats.mesh_files import glb, mtl, obj
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.formats.raster import turtle_png
from lsys_kit.pictures.formats.sheet import Sheet
from lsys_kit.pictures.nets.diagram import drawn_stages
from lsys_kit.pictures.nets.painting import paint_stages
from lsys_kit.pictures.nets.parts import parts_of, positions_in, steering_of
from lsys_kit.pictures.rendering.frames import WIDTH, frame_around, in_fine_parts
from lsys_kit.pictures.sizes import enlargement, final_size
from lsys_kit.pictures.svg import FilamentRow, background, described, document, resized, turtle_svg

if TYPE_CHECKING:
    from matplotlib.axes import Axes


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
    """

    rows: tuple[FilamentRow, ...]
    colour_of: Mapping[int, str] = field(repr=False)
    current: int | None = None
    marked: Collection[int] = ()
    solid: Scene | None = None
    look: str = LOOKS[0]
    time: Value | None = None

    @property
    def scene(self) -> Scene:
        """The projected scene of the last step shown."""
        return self.rows[-1].scene

    @cached_property
    def text(self) -> str:
        """What the picture shows, in words."""
        steps = f"steps {self.rows[0].step} to {self.rows[-1].step}" if len(self.rows) > 1 else ""
        return described([steps, ("the last: " if steps else "") + str(self.scene if self.solid is None else self.solid)])

    @property
    def size(self) -> int:
        """How many shapes there are to draw."""
        return sum(row.scene.size for row in self.rows)

    @cached_property
    def svg(self) -> str:
        """The picture as SVG text."""
        with Task("The picture was not drawn"):
            pixels, parts = self.size > current().segments, 10
            if len(self.scene.cells):
                sheet = filament_layout(self.rows, not pixels and self.current is not None, self.time)
                width, height = WIDTH, sheet.height
                body = "" if pixels else rows_svg(sheet, self.look, self.colour_of, self.current, self.marked)
            else:
                frame = in_fine_parts(frame_around([self.scene]), self.scene)
                width, height, parts = frame.width, frame.height, frame.parts
                body = "" if pixels else turtle_svg(self.scene, frame, self.colour_of, self.marked)
            if pixels:
                data = base64.b64encode(self.png).decode()
                body = f'<image width="{width * parts}" height="{height * parts}" href="data:image/png;base64,{data}"/>'
            return resized(document(background(width, height, parts) + body, width, height, self.text, parts), self.pixels)

    @cached_property
    def png(self) -> bytes:
        """The picture as PNG, without text."""
        with Task("The picture was not drawn"):
            if len(self.scene.cells):
                return rows_png(self.rows, self.look, self.colour_of, self.pixels)
            return turtle_png(self.scene, self.colour_of, self.pixels)

    @cached_property
    def mesh(self) -> Mesh:
        """The last step shown as triangles in space."""
        with Task("The mesh was not made"):
            return mesh_of(self.scene if self.solid is None else self.solid)

    def save(self, path: str | Path) -> None:
        """Write the picture to a file, in the format given by its extension: .svg, .png, .pdf, .glb or .obj.

        The last two are for 3D programs and contain only the last step. The colours of an .obj file are kept in an .mtl file
        beside it.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        """
        path = Path(path)
        library = path.parent / ("".join(c if c.isalnum() else "_" for c in path.stem) + ".mtl")
        if path.suffix.lower() == ".obj":
            save_file(library, mtl(self.mesh, self.colour_of))
        save_as(path, {".svg": lambda: marked_xml(self.svg), ".png": lambda: marked_png(self.png), ".pdf": lambda: _pdf(self),
                       ".glb": lambda: glb(self.mesh, self.colour_of),
                       ".obj": lambda: obj(self.mesh, self.colour_of, library.name)},
                "Films end in .gif or .apng, and are made by animate(...).")

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
    """

    net: Stages
    tokens: tuple[int, ...] | None = None
    positions: bool = False

    @cached_property
    def svg(self) -> str:
        """The picture as SVG text."""
        with Task("The picture was not drawn"):
            return resized(drawn_stages(self.net, self.tokens, positions=self.positions), self.pixels)

    @cached_property
    def png(self) -> bytes:
        """The picture as PNG."""
        with Task("The picture was not drawn"):
            parts = parts_of(self.net, self.positions, steering_of(self.net.system))
            tokens = (0,) * len(self.net.places) if self.tokens is None else self.tokens
            width, height = final_size(parts.width, parts.height, self.pixels)
            factor = enlargement(parts.width, parts.height, self.pixels)
            sheet = Sheet(width, height)
            left, top = (width - factor * parts.width) / 2, (height - factor * parts.height) / 2
            paint_stages(sheet.part(left, top, factor), parts, tokens)
            return sheet.png

    def save(self, path: str | Path) -> None:
        """Write the picture to an .svg or .png file, or the net to a .pnml file for Petri-net tools (see `pnml`).

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        """
        save_as(Path(path), {".svg": lambda: marked_xml(self.svg), ".png": lambda: marked_png(self.png),
                             ".pnml": lambda: marked_xml(placed_pnml(self.net, self.tokens, positions_in(self.net)))})

    def __repr__(self) -> str:
        return unescape(self.svg.split('aria-label="')[1].split('"')[0])


def plotted(picture: Picture, ax: Axes) -> Axes:
    """The axes with the picture drawn into them, without frame, with equal scales."""
    if picture.size > current().figure:
        raise ModelLimitError(f"The figure would have {picture.size:,} shapes; the limit is {current().figure:,}",
                              limit=current().figure, needed=picture.size,
                              hint="Take fewer steps, keep the picture as .png, or set limits(figure=...).")
    with Task("The figure was not drawn"), supervised():
        return _plotted(picture, ax)


def _plotted(picture: Picture, ax: Axes) -> Axes:
    if len(picture.scene.cells):
        plot_rows(ax, picture.rows, picture.look, picture.colour_of)
    else:
        plot_turtle(ax, picture.scene, picture.colour_of)
    ax.set_aspect("equal")
    ax.autoscale_view()
    ax.set_axis_off()
    return ax


def _pdf(picture: Picture) -> bytes:
    with Task("The PDF was not written"), supervised():
        return _pdf_bytes(picture)


def _pdf_bytes(picture: Picture) -> bytes:
    from matplotlib import rc_context

    buffer = io.BytesIO()
    sheet = plotted(picture, new_axes()).get_figure(root=True)
    assert sheet is not None
    facts = {"CreationDate": None, "Title": picture.text, "Creator": KIT_MARK.decode()}
    with rc_context({"pdf.fonttype": 42}):  # embedded fonts, so that text can be searched and edited
        sheet.savefig(buffer, format="pdf", bbox_inches="tight", metadata=facts)
    return buffer.getvalue()
