"""Films: a development step after step, or what is in space on a turntable.

All steps have the same frame, so that what grows is seen to grow. Of a filament's developmental sequence one row after another
appears, and of a lineage one step after another.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any

from lsys_kit.budget import Task, check_bytes, counted
from lsys_kit.derivation.cellworks.development import CellworkDevelopment
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.maps.development import Development
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.errors import ModelLimitError, ModelValueError, require
from lsys_kit.geometry.drawing import turning_angle
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands.mode import DrawingMode, drawing_mode
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.chosen_words import derivation_of
from lsys_kit.pictures.draw import check_choices, draw, state_colours
from lsys_kit.pictures.formats.film import SECONDS, Film
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.formats.painting import painted
from lsys_kit.pictures.formats.raster import centred, embedded, turtle_image
from lsys_kit.pictures.kinds import WORD, coloured_symbols, instead, kind_of
from lsys_kit.pictures.legends import Legend, image_with_legend, legend_of
from lsys_kit.pictures.options import STAGES, Options, options_from, seen_as, split_options
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.frames import ViewFrame, frame_around, in_units
from lsys_kit.pictures.rendering.scene_shapes import label_shapes
from lsys_kit.pictures.rendering.view import FROM_THE_RIGHT, View, project_smoothly, view_from
from lsys_kit.pictures.sizes import document, enlargement, final_size, size_from
from lsys_kit.pictures.style.themes import drawn_on
from lsys_kit.pictures.tissues.cellworks import SIDE, cellwork_steps

if TYPE_CHECKING:
    from PIL.Image import Image

SHAPE_BYTES = 100
"""About what a shape takes in memory."""
MOST_FRAMES = 300
"""The greatest number of steps of a film."""
TURNS, TURN_SECONDS = 60, 0.1
"""The pictures of a whole turn, and the duration of each in seconds."""


def animate(
    what: Any,
    n: int | None = None,
    *,
    seconds: object = None,
    turntable: bool = False,
    view: object = None,
    size: object = None,
    **choices: Any,
) -> Film:
    """Draw the steps of a development one after another, in a common frame; or turn what is in space around.

    Parameters
    ----------
    what
        A system, which is derived first, or a derivation; of maps and cellworks too. A stage diagram, whose tokens move; a
        lineage, which grows. Or a picture, or a list of pictures.
    n
        The number of steps of a system or of a stage diagram; by default its own.
    seconds
        The duration of each picture: 0.6 by default, and the last is shown longer; 0.1 on a turntable.
    turntable
        Whether the last step is shown from all sides, rather than the steps from one.
    view, size, **choices
        As for `draw`, with `labels`, `colours`, `widths`, `turtle`, `legend` and `background`, but a film has a background. On
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
    >>> from lsys_kit.notation.read import read
    >>> plant = animate(read("angle: 25\\naxiom: F\\nF -> F[+F]F[-F]F"), 3, seconds="0.5")
    >>> plant, len(plant.images)
    (steps 0 to 3; the last: 125 segments, width 8.84, height 27, 4)
    """
    require(turntable, bool, 'True or False for "turntable"')
    usual = TURN_SECONDS if turntable else SECONDS
    pace = real_from(usual if seconds is None else seconds, "seconds", "A step is shown for some time, as in seconds=0.5.")
    size_from(size)  # which is wrong before anything is made
    if not 0.02 <= pace <= 60:
        raise ModelValueError(f"A step can be shown for 0.02 to 60 seconds, not for {pace:g}")
    side, (given, choices) = None if view is None else view_from(view), split_options(choices)
    if isinstance(what, SVGPicture | list | tuple):
        _check_drawn(n, None if turntable else side, given | choices)
    options = _options(what, given)
    with Task("The film was not finished"), drawn_on(options.theme):
        if turntable:
            return _turned(what, n, pace, side, size, choices | given)
        text, images = _shown(what, n, side, size, choices, given, options)
        return Film(text, tuple(images), pace)


def _options(what: Any, given: Mapping[str, Any]) -> Options:
    """How the pictures of a film look."""
    last = what[-1] if isinstance(what, list | tuple) and what else what
    if isinstance(last, SVGPicture):
        return Options(theme=replace(last.theme, ground=last.theme.paper))
    options = options_from(given, kind_of(what, {}), coloured_symbols(what))
    if options.theme.transparent:
        raise ModelValueError("A film has a background", hint='Give background="light", "dark" or a colour.')
    return options


def _check_drawn(n: int | None, side: View | None, choices: Mapping[str, Any]) -> None:
    """Nothing is chosen for pictures that was chosen when they were drawn."""
    chosen = [*["n"] * (n is not None), *["view"] * (side is not None), *choices]
    if chosen:
        raise ModelValueError("What a picture shows is chosen when it is drawn", hint=f"Give {chosen[0]}= to draw(...).")


def _shown(
    what: Any,
    n: int | None,
    side: View | None,
    size: object,
    choices: Mapping[str, Any],
    given: Mapping[str, Any],
    options: Options,
) -> tuple[str, Sequence[Image]]:
    """What a film shows, in words, and its pictures."""
    if isinstance(what, LSystem | Derivation):
        if isinstance(what, LSystem):
            _check_choices(choices, ("angle", "view"), kind_of(what, {}), what)
        derivation = _derived(what, n, {name: value for name, value in choices.items() if name != "angle"})
        if drawing_mode(derivation.states.system) is DrawingMode.FILAMENT:
            return _filmed(draw(derivation, size=size, **given))
        return _turtle_film(derivation, choices.get("angle"), side, size, options)
    if isinstance(what, CellworkSystem | CellworkDevelopment):
        steps = cellwork_steps(what, n, legend=bool(options.legend), **choices)
        scenes = project_smoothly([step.solid for step in steps if step.solid is not None], side or SIDE)
        told = f"steps 0 to {len(steps) - 1}; the last: {steps[-1].text}"
        return told, _framed(scenes, steps[-1].colour_of, size, steps[-1].legend)
    if isinstance(what, MapSystem | Development | Lineage):
        seen: dict[str, Any] = {} if side is None else {"view": side}
        drawn: Any = what
        return _filmed(draw(drawn, n, size=size, **(seen | {**choices, **given})))
    if isinstance(what, Stages):
        return _net_film(what, n, size, choices, given)
    return _pictures_film(what, size)


def _check_choices(choices: Mapping[str, Any], own: tuple[str, ...], kind: str, system: LSystem) -> None:
    """Every choice is one of the film, or a constant of the system."""
    options = *own, "seed", "arithmetic", "field", "seconds", "turntable"
    check_choices(choices, options, kind, [each.name for each in system.constants])


def _derived(what: LSystem | Derivation, n: int | None, choices: Mapping[str, Any]) -> Derivation:
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


def _net_film(
    net: Stages, n: int | None, size: object, choices: Mapping[str, Any], given: Mapping[str, Any]
) -> tuple[str, Sequence[Image]]:
    """A stage diagram with the tokens of each step."""
    _check_choices(choices, ("positions",), STAGES, net.system)
    own = {name: value for name, value in choices.items() if name != "positions"}
    derivation = _derived(net.system, n, own)
    told = {"positions": choices["positions"]} if "positions" in choices else {}
    pictures = [draw(net, tokens=word, size=size, **told, **given) for word in derivation]
    return f"steps 0 to {derivation.steps}; the last: {pictures[-1]!r}", [picture.image() for picture in counted(pictures, 1)]


def _pictures_film(what: Any, size: object) -> tuple[str, Sequence[Image]]:
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
    found = size_from(size)
    paper = final_size(wide, high, found)
    return f"{len(what)} pictures; the last: {what[-1]!r}", [
        centred(picture.image(enlargement(wide, high, found)) if found else image, paper)
        for picture, image in zip(what, images, strict=True)
    ]


def _turtle_film(
    derivation: Derivation, angle: object, view: View | None, size: object, options: Options
) -> tuple[str, Sequence[Image]]:
    """What the turtle draws, step after step."""
    turn = turning_angle(angle, derivation.states.system)
    steps: list[Scene] = []
    for step in counted(range(derivation.steps + 1), 1):
        steps.append(seen_as(derivation.to(step), turn, options))
        check_bytes(SHAPE_BYTES * sum(scene.size for scene in steps), lambda: "The film was not finished")
    scenes = project_smoothly(in_units(steps, derivation.states.system), view)
    legend = legend_of([derivation.states] * len(scenes), scenes) if options.legend else None
    return f"steps 0 to {derivation.steps}; the last: {steps[-1]}", _framed(scenes, state_colours(derivation), size, legend)


def _framed(scenes: Sequence[Scene], colour_of: Mapping[int, str], size: object, legend: Legend | None = None) -> list[Image]:
    """Scenes as images in a common frame, each with the legend below."""
    frame, found = frame_around(scenes), size_from(size)
    width, more = legend.size(frame.width) if legend else (frame.width, 0)
    enlarged, whole = enlargement(width, frame.height + more, found), final_size(width, frame.height + more, found)
    images = (_with_labels(turtle_image(scene, colour_of, frame, enlarged), scene, frame) for scene in counted(scenes, 1))
    return [centred(image_with_legend(image, legend, enlarged), whole) for image in images]


def _with_labels(image: Image, scene: Scene, frame: ViewFrame) -> Image:
    """An image of a scene with what the turtle has written."""
    if not len(scene.labels):
        return image
    body = [embedded(frame.width * frame.parts, frame.height * frame.parts, image), *label_shapes(scene, frame)]
    return painted(document(body, frame.width, frame.height, "", frame.parts), image.width / frame.width)


def _turned(what: Any, n: int | None, pace: float, view: View | None, size: object, choices: Mapping[str, Any]) -> Film:
    """What is in space, from all sides."""
    picture = what if isinstance(what, SVGPicture) else draw(what, n, **choices)
    if not isinstance(picture, Picture) or picture.solid is None:
        raise ModelValueError(
            "A turntable shows what is in space, and this lies in the plane", hint="Animate its steps: without turntable=True."
        )
    scenes = list(_around(picture.solid, view or FROM_THE_RIGHT))
    return Film(f"{picture!r}; from all sides", tuple(_framed(scenes, picture.colour_of, size, picture.legend)), pace, 1)


def _around(solid: Scene, view: View) -> Iterator[Scene]:
    """A scene from all sides, one after another: it turns to the left, as a plant whose right side comes to the front."""
    for number in range(TURNS):
        yield from project_smoothly([solid], (view[0] + 360 * number / TURNS, view[1]))
