"""Films: a development step after step, or what is in space on a turntable; as an animated GIF or PNG, or as MP4.

All steps have the same frame, so that what grows is seen to grow. Of a filament's developmental sequence one row after another
appears, and of a lineage one step after another. MP4 is written by the program ffmpeg.
"""

from __future__ import annotations

import io
import tempfile
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field, replace
from fractions import Fraction
from functools import cached_property
from pathlib import Path
from typing import TYPE_CHECKING, Any

from lsys_kit.arrays import np
from lsys_kit.budget import Task, check_bytes, counted
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.derive import Choices, Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.derivation.tissues.development import CellDevelopment, CellworkDevelopment
from lsys_kit.errors import LSystemError, ModelLimitError, ModelValueError, require
from lsys_kit.files import marked_gif, marked_mp4, marked_png, path_from
from lsys_kit.geometry.drawing import scene_of, turning_angle
from lsys_kit.geometry.scene import Floats, Scene
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.geometry.unfolded import scenes_between
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.draw import check_choices, derivation_of, draw, state_colours
from lsys_kit.pictures.formats.notebook import SVGPicture, film_bundle, save_as
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.formats.raster import centred, embedded, encoded, turtle_image
from lsys_kit.pictures.legends import Legend, image_with_legend, legend_of
from lsys_kit.pictures.options import (
    STAGES,
    WORD,
    Style,
    coloured_symbols,
    in_chosen_colours,
    in_colours,
    in_widths,
    instead,
    kind_of,
    split_options,
    style_from,
)
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import ViewFrame, frame_around
from lsys_kit.pictures.rendering.light import LitScene, seen_smoothly
from lsys_kit.pictures.rendering.scene_shapes import label_shapes
from lsys_kit.pictures.rendering.view import FROM_THE_RIGHT, View, view_from
from lsys_kit.pictures.sizes import Size, document, enlargement, final_size, size_from
from lsys_kit.pictures.style.themes import drawn_on
from lsys_kit.pictures.tissues.cellworks import SIDE, CellworkPicture, cellwork_steps

if TYPE_CHECKING:
    from PIL.Image import Image

SECONDS, HELD = 0.6, 4
"""The duration of each step in seconds, and the factor by which the last is shown longer."""
RATE = 25
"""An MP4 film has so many pictures a second at least, many of them the same, because players expect about as many."""
SETTINGS = "-preset medium -crf 16 -threads 1 -fflags +bitexact -flags:v +bitexact -movflags +faststart".split()  # noqa: SIM905
"""What ffmpeg is told besides: to lose hardly anything, to write the same every time, and to let a page play the beginning
while the rest is loaded."""


@dataclass(frozen=True)
class Film:
    """Pictures one after another, such as the steps of a development.

    Attributes
    ----------
    text
        What the film shows, in words.
    images
        The pictures, all of the same size.
    seconds
        The duration of each picture.
    held
        The factor by which the last is shown longer.
    """

    text: str
    images: tuple[Image, ...] = field(repr=False)
    seconds: float = SECONDS
    held: int = HELD

    @cached_property
    def gif(self) -> bytes:
        """The film as a GIF that loops for ever."""
        return self._film("GIF")

    @cached_property
    def apng(self) -> bytes:
        """The film as an animated PNG, whose colours are exact."""
        return self._film("PNG")

    @cached_property
    def mp4(self) -> bytes:
        """The film as MP4 (H.264), for slides and for pages with many films.

        Raises
        ------
        LSystemError
            There is no ffmpeg, or it failed.
        """
        with Task("The film was not written"):
            return mp4_of([*self.images, *[self.images[-1]] * (self.held - 1)], self.seconds)

    def save(self, path: str | Path) -> None:
        """Write the film to a file, in the format given by its extension: .gif, .apng, .png or .mp4.

        Raises
        ------
        ModelFileError
            The extension is unknown, or the file cannot be written.
        LSystemError
            For .mp4 there is no ffmpeg, or it failed.
        """
        save_as(
            path_from(path),
            {
                ".gif": lambda: marked_gif(self.gif),
                ".apng": lambda: marked_png(self.apng),
                ".png": lambda: marked_png(self.apng),
                ".mp4": lambda: marked_mp4(self.mp4),
            },
        )

    def _film(self, form: str) -> bytes:
        buffer, step = io.BytesIO(), round(1000 * self.seconds)
        first, *rest = self.images
        first.save(buffer, form, save_all=True, append_images=rest, loop=0, duration=[*[step] * len(rest), self.held * step])
        return buffer.getvalue()

    def _repr_mimebundle_(self, **_: object) -> dict[str, object]:
        return film_bundle(self.gif, lambda: encoded(self.images[-1]), self.text)

    def __repr__(self) -> str:
        return self.text


def mp4_of(images: Sequence[Image], seconds: float) -> bytes:
    """Pictures of the same size as MP4, each shown so long; the same on the same machine.

    Raises
    ------
    LSystemError
        There is no ffmpeg, or it failed.
    """
    try:
        from imageio_ffmpeg import get_ffmpeg_exe, write_frames

        get_ffmpeg_exe()
    except (ImportError, RuntimeError):
        raise LSystemError(
            "Films in .mp4 are written by the program ffmpeg, which is not installed",
            hint="Install it with: pip install 'lsys-kit[film]'; or take .gif or .apng.",
        ) from None
    even = [_even(image) for image in images]
    with tempfile.TemporaryDirectory() as folder:
        target = Path(folder) / "film.mp4"
        writer = write_frames(
            str(target),
            even[0].size,
            fps=1 / Fraction(seconds).limit_denominator(1_000),
            codec="libx264",
            quality=None,
            macro_block_size=1,
            ffmpeg_log_level="fatal",
            output_params=[*SETTINGS, "-r", f"{max(RATE, 1 / seconds):g}"],
        )
        try:
            writer.send(None)
            for image in counted(even, 1):
                writer.send(image.tobytes())
            writer.close()
            return target.read_bytes()
        except OSError:
            raise LSystemError("ffmpeg did not write the film", hint="Take .gif or .apng.") from None


def _even(image: Image) -> Image:
    """An image with even numbers of pixels across and down, as H.264 wants it: pixels like those of its corner may be added."""
    from PIL import Image

    paper = Image.new(
        "RGB", (image.width + image.width % 2, image.height + image.height % 2), image.convert("RGB").getpixel((0, 0))
    )
    paper.paste(image)
    return paper


# --- what is animated ---

SHAPE_BYTES = 100
"""About what a shape takes in memory."""
PARTS, UNFOLD_SECONDS = 20, 1.5
"""The pictures from a step to the next, and how long these take together, where modules are seen to become their successors."""
MOST_FRAMES = 300
"""The greatest number of steps of a film."""
TURNS, LIT_TURNS, TURN_SECONDS = 60, 36, 0.1
"""The pictures of a whole turn, without and with sun and sky; and the duration of each in seconds."""


def animate(
    what: object,
    n: int | None = None,
    *,
    seconds: object = None,
    turntable: bool = False,
    unfold: bool = False,
    view: object = None,
    size: object = None,
    **choices: object,
) -> Film:
    """Draw the steps of a development one after another, in a common frame, or let each unfold into the next; or turn what is
    in space around.

    Parameters
    ----------
    what
        A system, which is derived first, or a derivation; of maps and cellworks too. A stage diagram, whose tokens move; a
        lineage, which grows. Or a picture, or a list of pictures.
    n
        The number of steps of a system or of a stage diagram; by default its own.
    seconds
        The duration of each picture: 0.6 by default, and the last is shown longer; 0.1 on a turntable. From a step to the
        next 1.5, where they unfold.
    turntable
        Whether the last step is shown from all sides, rather than the steps from one.
    unfold
        Whether between two steps every module becomes its successor in place, all at the same time: a stroke unfolds into
        those that it becomes. Each picture is as large as it fits. Only what a turtle draws unfolds.
    view, size, **choices
        As for `draw`, with `labels`, `colours`, `widths`, `turtle`, `legend`, `light` and `background`; a film has one. On
        a turntable the first picture has this view.

    Raises
    ------
    ModelValueError
        It does not develop, or a choice is out of range; or it lies in the plane, and cannot be turned. Or it is a picture, for
        which something is chosen besides `seconds`, `size`, and on a turntable `view`.
    ModelNameError
        There is no such choice.
    ModelLimitError
        There are too many steps.

    Examples
    --------
    >>> from lsys_kit import read
    >>> plant = animate(read("angle: 25\\naxiom: F\\nF -> F[+F]F[-F]F"), 3, seconds="0.5")
    >>> plant, len(plant.images)
    (steps 0 to 3; the last: 125 segments, width 8.84, height 27, 4)
    """
    for name, choice in (("turntable", turntable), ("unfold", unfold)):
        require(choice, bool, f'True or False for "{name}"')
    unfolding = _unfolding_of(what, turntable) if unfold else None
    usual = TURN_SECONDS if turntable else UNFOLD_SECONDS if unfold else SECONDS
    pace = real_from(usual if seconds is None else seconds, "seconds", "A step is shown for some time, as in seconds=0.5.")
    pixels = size_from(size)  # which is wrong before anything is made
    if not 0.02 <= pace <= 60:
        raise ModelValueError(f"A step can be shown for 0.02 to 60 seconds, not for {pace:g}")
    side, (given, choices) = None if view is None else view_from(view), split_options(choices)
    if isinstance(what, SVGPicture | list | tuple):
        _check_drawn(n, None if turntable else side, given | choices)
    style = _style(what, given)
    with Task("The film was not finished"), drawn_on(style.theme):
        if unfolding is not None:
            derivation = _derived(unfolding, n, _of_turtle(unfolding, choices))
            return _unfolding_film(derivation, pace, choices.get("angle"), side, replace(style, size=pixels))
        if turntable:
            return _turned(what, n, pace, side, pixels, choices | given)
        text, images = _shown(what, n, side, choices, {"size": size, **given}, replace(style, size=pixels))
        return Film(text, tuple(images), pace)


def _style(what: object, given: Mapping[str, object]) -> Style:
    last = what[-1] if isinstance(what, list | tuple) and what else what
    if isinstance(last, SVGPicture):
        return Style(theme=replace(last.theme, ground=last.theme.paper))
    style = style_from(given, kind_of(what, {}), coloured_symbols(what))
    if style.theme.transparent:
        raise ModelValueError("A film has a background", hint='Give background="light", "dark" or a colour.')
    return style


def _check_drawn(n: int | None, side: View | None, choices: Mapping[str, object]) -> None:
    """Nothing is chosen for pictures that was chosen when they were drawn."""
    chosen = [*["n"] * (n is not None), *["view"] * (side is not None), *choices]
    if chosen:
        raise ModelValueError("What a picture shows is chosen when it is drawn", hint=f"Give {chosen[0]}= to draw(...).")


def _shown(
    what: Any, n: int | None, side: View | None, choices: Choices, given: Choices, style: Style
) -> tuple[str, Sequence[Image]]:
    if isinstance(what, LSystem | Derivation):
        derivation = _derived(what, n, _of_turtle(what, choices))
        if drawing_mode(derivation.states.system) is DrawingMode.FILAMENT:
            return _filmed(draw(derivation, **given))
        return _turtle_film(
            derivation, choices.get("angle"), side, style, choices.get("seed") or derivation.states.system.seed or 0
        )
    if isinstance(what, CellworkSystem | CellworkDevelopment):
        steps = cellwork_steps(what, n, legend=bool(style.legend), light=style.light, **choices)
        solids = [step.solid for step in steps if step.solid is not None]
        scenes = seen_smoothly(solids, side or SIDE, style.light, leafy=False)
        told = f"steps 0 to {len(steps) - 1}; the last: {steps[-1].text}"
        return told, _framed(scenes, steps[-1].colour_of, style.size, steps[-1].legend)
    if isinstance(what, CellSystem | CellDevelopment | Lineage):
        seen = {} if side is None else {"view": side}
        drawn: Any = what
        return _filmed(draw(drawn, n, **(seen | {**choices, **given})))
    if isinstance(what, Stages):
        return _net_film(what, n, choices, given)
    return _pictures_film(what, style.size)


def _of_turtle(what: LSystem | Derivation, choices: Choices) -> Choices:
    """The choices of how something is derived that a turtle draws."""
    if isinstance(what, LSystem):
        _check_choices(choices, ("angle", "view"), kind_of(what, {}), what)
    return {name: value for name, value in choices.items() if name != "angle"}


def _check_choices(choices: Choices, own: tuple[str, ...], kind: str, system: LSystem) -> None:
    options = *own, "seed", "arithmetic", "field", "seconds", "turntable", "unfold"
    check_choices(choices, options, kind, [each.name for each in system.constants])


def _derived(what: LSystem | Derivation, n: int | None, choices: Mapping[str, object]) -> Derivation:
    derivation = derivation_of(what, n, **{"seed": None, "arithmetic": "exact", **choices})
    assert isinstance(derivation, Derivation)
    if derivation.steps >= MOST_FRAMES:
        raise _too_long(derivation.steps + 1)
    return derivation


def _too_long(pictures: int) -> ModelLimitError:
    return ModelLimitError(
        f"A film of {pictures:,} pictures is too long; it can have {MOST_FRAMES:,}", limit=MOST_FRAMES, needed=pictures
    )


def _filmed(picture: SVGPicture) -> tuple[str, Sequence[Image]]:
    with drawn_on(picture.theme):
        return repr(picture), picture.film_images()


def _net_film(net: Stages, n: int | None, choices: Choices, given: Choices) -> tuple[str, Sequence[Image]]:
    _check_choices(choices, ("positions",), STAGES, net.system)
    own = {name: value for name, value in choices.items() if name != "positions"}
    derivation = _derived(net.system, n, own)
    told = {"positions": choices["positions"]} if "positions" in choices else {}
    pictures = [draw(net, tokens=word, **told, **given) for word in derivation]
    return f"steps 0 to {derivation.steps}; the last: {pictures[-1]!r}", [picture.image() for picture in counted(pictures, 1)]


def _pictures_film(what: object, size: Size | None) -> tuple[str, Sequence[Image]]:
    """A picture that unfolds, or several pictures one after another, on paper on which all have room."""
    if isinstance(what, SVGPicture):
        return _filmed(what)
    if not isinstance(what, Sequence) or not what or not all(isinstance(each, SVGPicture) for each in what):
        raise ModelValueError(
            f"Only systems and derivations, stage diagrams, lineages and pictures can be animated, not {type(what).__name__}",
            hint=instead(what, "animate", f"animate([draw({WORD}), ...])"),
        )
    if len(what) > MOST_FRAMES:
        raise _too_long(len(what))
    images = [picture.image() for picture in counted(what, 1)]
    wide, high = (max(sides) for sides in zip(*(image.size for image in images), strict=True))
    paper = final_size(wide, high, size)
    return f"{len(what)} pictures; the last: {what[-1]!r}", [
        centred(picture.image(enlargement(wide, high, size)) if size else image, paper)
        for picture, image in zip(what, images, strict=True)
    ]


def _turtle_film(
    derivation: Derivation, angle: object, view: View | None, style: Style, seed: int
) -> tuple[str, Sequence[Image]]:
    turn = turning_angle(angle, derivation.states.system)
    steps: list[Scene] = []
    for step in counted(range(derivation.steps + 1), 1):
        steps.append(in_colours(derivation.to(step), turn, style))
        check_bytes(SHAPE_BYTES * sum(scene.size for scene in steps), lambda: "The film was not finished")
    scenes = seen_smoothly(in_widths(steps, derivation.states.system, style), view, style.light, [seed] * len(steps))
    legend = legend_of([derivation.states] * len(scenes), scenes, style.light is not None) if style.legend else None
    return f"steps 0 to {derivation.steps}; the last: {steps[-1]}", _framed(
        scenes, state_colours(derivation), style.size, legend
    )


def _framed(
    scenes: Sequence[Scene], colour_of: Mapping[int, str], size: Size | None, legend: Legend | None = None
) -> list[Image]:
    frame = frame_around(scenes)
    width, more = legend.size(frame.width) if legend else (frame.width, 0)
    enlarged, whole = enlargement(width, frame.height + more, size), final_size(width, frame.height + more, size)
    images = (_with_labels(turtle_image(scene, colour_of, frame, enlarged), scene, frame) for scene in counted(scenes, 1))
    return [centred(image_with_legend(image, legend, enlarged), whole) for image in images]


def _with_labels(image: Image, scene: Scene, frame: ViewFrame) -> Image:
    if not len(scene.labels):
        return image
    body = [embedded(frame.width * frame.parts, frame.height * frame.parts, image), *label_shapes(scene, frame)]
    return painted(document(body, frame.width, frame.height, "", frame.parts), image.width / frame.width)


def _unfolding_of(what: object, turntable: bool) -> LSystem | Derivation:
    """What is to unfold, which a turtle draws."""
    if turntable:
        raise ModelValueError("On a turntable nothing unfolds", hint="Give one of the two: unfold=True or turntable=True.")
    if isinstance(what, LSystem | Derivation):
        system = what.states.system if isinstance(what, Derivation) else what
        if drawing_mode(system) is not DrawingMode.FILAMENT:
            return what
    raise ModelValueError(
        "Only what a turtle draws unfolds in a film",
        hint='The cells of a filament unfold in the panel: explore(..., show=["drawing", "unfolding"]).',
    )


def _unfolding_film(derivation: Derivation, pace: float, angle: object, view: View | None, style: Style) -> Film:
    """Each step unfolds into the next; what is drawn is always as large as it fits."""
    system, last = derivation.states.system, derivation.steps
    turn, parts = turning_angle(angle, system), max(1, min(PARTS, (MOST_FRAMES - 1) // max(1, last)))
    scenes: list[Scene] = []

    def add(scene: Scene) -> None:
        scenes.append(in_chosen_colours(scene, derivation.states, style))
        check_bytes(SHAPE_BYTES * sum(scene.size for scene in scenes), lambda: "The film was not finished")

    for step in range(last):
        between = scenes_between(derivation, step, turn, style.colours, style.widths)
        for number in counted(range(parts), 1):
            add(between(number / parts))
    add(scene_of(derivation, turn, style.colours, style.widths))
    seen = seen_smoothly(_as_large_as_the_last(in_widths(scenes, system, style)), view, style.light)
    legend = legend_of([derivation.states] * len(seen), seen, style.light is not None) if style.legend else None
    images = _framed(seen, state_colours(derivation), style.size, legend)
    return Film(f"steps 0 to {last} unfold; the last: {scenes[-1]}", tuple(images), pace / parts, parts)


NO_LENGTH = 1e-12
"""What is no longer than this has no length."""


def _as_large_as_the_last(scenes: Sequence[Scene]) -> list[Scene]:
    """Scenes enlarged and moved so that each fits into the room of the last."""
    least, most = scenes[-1].corners
    return [_fitted(scene, least, most) for scene in scenes]


def _fitted(scene: Scene, least: Floats, most: Floats) -> Scene:
    low, high = scene.corners
    spans = [*zip(most - least, high - low, strict=True)]
    scale = min((room / span for room, span in spans if min(room, span) > NO_LENGTH), default=1.0)
    away, widths = (least + most) / 2 - scale * (low + high) / 2, scene.segments.widths

    def moved(points: Floats) -> Floats:
        found: Floats = scale * points + np.tile(away, points.shape[1] // len(away))
        return found

    widened = np.where(widths > 0, scale * widths, widths)
    return replace(
        scene,
        segments=replace(scene.segments, ends=moved(scene.segments.ends), widths=widened),
        polygons=replace(scene.polygons, points=moved(scene.polygons.points)),
        discs=replace(scene.discs, centres=moved(scene.discs.centres), radii=scale * scene.discs.radii),
        labels=replace(scene.labels, points=moved(scene.labels.points)),
    )


def _turned(what: Any, n: int | None, pace: float, view: View | None, size: Size | None, choices: Choices) -> Film:
    picture = what if isinstance(what, SVGPicture) else draw(what, n, **choices)
    if not isinstance(picture, Picture) or picture.solid is None:
        raise ModelValueError(
            "A turntable shows what is in space, and this lies in the plane", hint="Animate its steps: without turntable=True."
        )
    scenes = [*_around(picture, picture.solid, view or FROM_THE_RIGHT)]
    return Film(f"{picture!r}; from all sides", tuple(_framed(scenes, picture.colour_of, size, picture.legend)), pace, 1)


def _around(picture: Picture, solid: Scene, view: View) -> Iterator[Scene]:
    """A scene from all sides, one after another: it turns to the left, as a plant whose right side comes to the front, and not
    the sun."""
    seen, leafy = picture.scene, not isinstance(picture, CellworkPicture)
    sun, seeds, turns = (seen.sun, [seen.seed], LIT_TURNS) if isinstance(seen, LitScene) else (None, [], TURNS)
    for turn in (360 * number / turns for number in range(turns)):
        yield from seen_smoothly([solid], (view[0] + turn, view[1]), sun and sun.turned(turn), seeds, leafy)
