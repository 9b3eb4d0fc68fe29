"""Films: a development step after step, as an animated GIF or PNG.

All steps have the same frame, so that what grows is seen to grow. Of a filament's developmental sequence one row after another
appears.
"""

from __future__ import annotations

import io
from dataclasses import dataclass, field, replace
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, check_bytes, counted
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.derive import Derivation
from lsys_kit.errors import ModelLimitError, ModelValueError
from lsys_kit.files import marked_gif, marked_png
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.mode import DrawingMode, drawing_mode
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.chosen_words import derivation_of
from lsys_kit.pictures.draw import draw, state_colours
from lsys_kit.pictures.filaments import filament_layout
from lsys_kit.pictures.formats.files import save_as
from lsys_kit.pictures.formats.notebook import film_bundle
from lsys_kit.pictures.formats.raster import centred, turtle_image
from lsys_kit.pictures.rendering.frames import MARGIN, WIDTH, frame_around
from lsys_kit.pictures.rendering.line_widths import in_units
from lsys_kit.pictures.rendering.view import View, project, view_from
from lsys_kit.pictures.sizes import Size, enlargement, final_size, size_from
from lsys_kit.pictures.style.palette import PAPER

if TYPE_CHECKING:
    from PIL.Image import Image

SECONDS, HELD = 0.6, 4
"""The duration of each step in seconds, and the factor by which the last is shown longer."""
SHAPE_BYTES = 100
"""About what a shape takes in memory."""
MOST_FRAMES = 300
"""The greatest number of steps of a film."""


@dataclass(frozen=True)
class Film:
    """The steps of a development, one picture after another.

    Attributes
    ----------
    text
        What the film shows, in words.
    images
        The pictures, all of the same size.
    seconds
        The duration of each picture; the last is shown `HELD` times as long.
    """

    text: str
    images: tuple[Image, ...] = field(repr=False)
    seconds: float = SECONDS

    @cached_property
    def gif(self) -> bytes:
        """The film as a GIF that loops for ever."""
        return self._film("GIF")

    @cached_property
    def apng(self) -> bytes:
        """The film as an animated PNG, whose colours are exact."""
        return self._film("PNG")

    def save(self, path: str | Path) -> None:
        """Write the film to a file, in the format given by its extension: .gif, .apng or .png.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        """
        save_as(Path(path), {".gif": lambda: marked_gif(self.gif), ".apng": lambda: marked_png(self.apng),
                             ".png": lambda: marked_png(self.apng)})

    def _film(self, form: str) -> bytes:
        buffer, step = io.BytesIO(), round(1000 * self.seconds)
        first, *rest = self.images
        first.save(buffer, form, save_all=True, append_images=rest, loop=0, duration=[*[step] * len(rest), HELD * step])
        return buffer.getvalue()

    def _repr_mimebundle_(self, **_: object) -> dict[str, Any]:
        return film_bundle(self.gif, self._last, self.text)

    def _last(self) -> bytes:
        """The last picture, as PNG."""
        buffer = io.BytesIO()
        self.images[-1].save(buffer, "PNG")
        return buffer.getvalue()

    def __repr__(self) -> str:
        return self.text


def animate(what: LSystem | Derivation, n: int | None = None, *, seconds: object = SECONDS, angle: object = None,
            seed: int | None = None, arithmetic: str = "exact", view: object = None, size: object = None,
            **constants: object) -> Film:
    """Draw the steps of a development one after another, in a common frame.

    Parameters
    ----------
    what
        A system, which is derived first, or a derivation.
    n
        The number of steps of a system; by default its own.
    seconds
        The duration of each step; the last is shown longer.
    angle, seed, arithmetic, view, size, **constants
        As for `draw`.

    Raises
    ------
    ModelValueError
        It does not develop, or a choice is out of range.
    ModelLimitError
        There are too many steps.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> plant = animate(read("angle: 25\\naxiom: F\\nF -> F[+F]F[-F]F"), 3, seconds="0.5")
    >>> plant, len(plant.images)
    (steps 0 to 3; the last: 125 segments, width 8.84, height 27, 4)
    """
    if not isinstance(what, LSystem | Derivation):
        raise ModelValueError(f"Only systems and derivations can be animated, not {type(what).__name__}")
    pace = real_from(seconds, "seconds")
    if not 0.02 <= pace <= 60:
        raise ModelValueError(f"A step can be shown for 0.02 to 60 seconds, not for {pace:g}")
    derivation = derivation_of(what, n, seed=seed, arithmetic=arithmetic, **constants)
    assert isinstance(derivation, Derivation)
    if derivation.steps >= MOST_FRAMES:
        raise ModelLimitError(f"A film of {derivation.steps + 1:,} pictures is too long; it can have {MOST_FRAMES:,}",
                              limit=MOST_FRAMES, needed=derivation.steps + 1)
    with Task("The film was not finished"):
        if drawing_mode(derivation.states.system) is DrawingMode.FILAMENT:
            return _sequence_film(derivation, pace, size_from(size))
        turn = real_from(angle, "angle") if angle is not None else float(derivation.states.system.angle)
        return _turtle_film(derivation, turn, pace, None if view is None else view_from(view), size_from(size))


def _turtle_film(derivation: Derivation, turn: float, pace: float, view: View | None, size: Size | None) -> Film:
    """What the turtle draws, step after step."""
    steps: list[Scene] = []
    for step in counted(range(derivation.steps + 1), 1):
        steps.append(scene_of(derivation.to(step), turn))
        check_bytes(SHAPE_BYTES * sum(scene.size for scene in steps), lambda: "The film was not finished")
    scenes = project(in_units(steps, derivation.states.system), view)
    frame, colour_of = frame_around(scenes), state_colours(derivation)
    enlarged, whole = enlargement(frame.width, frame.height, size), final_size(frame.width, frame.height, size)
    images = tuple(centred(turtle_image(scene, colour_of, frame, enlarged), whole) for scene in scenes)
    return Film(_caption(derivation, steps[-1]), images, pace)


def _caption(derivation: Derivation, last: Scene) -> str:
    return f"steps 0 to {derivation.steps}; the last: {last}"


def _sequence_film(derivation: Derivation, pace: float, size: Size | None) -> Film:
    """A developmental sequence, whose rows appear one after another."""
    from PIL import Image

    picture = draw(derivation)
    usual = WIDTH, filament_layout(picture.rows, written=False).height
    enlarged = enlargement(*usual, size)
    picture = replace(picture, pixels=(round(WIDTH * enlarged), None))
    whole = Image.open(io.BytesIO(picture.png)).convert("RGB")
    images, margin = list[Image.Image](), MARGIN * enlarged
    for shown in range(1, len(picture.rows) + 1):
        until = round(margin + shown * (whole.height - 2 * margin) / len(picture.rows))
        image = Image.new("RGB", whole.size, PAPER)
        image.paste(whole.crop((0, 0, whole.width, until)))
        images.append(centred(image, final_size(*usual, size)))
    return Film(picture.text, tuple(images), pace)
