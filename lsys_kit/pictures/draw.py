"""Drawing: words and systems as pictures that a notebook shows, a file keeps, or a matplotlib figure takes in."""

from __future__ import annotations

from collections.abc import Callable, Collection, Iterable, Mapping, Sequence
from dataclasses import replace
from typing import TYPE_CHECKING, Any, Literal, NamedTuple, TypeAlias, overload

from lsys_kit.budget import Task, counted
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.derivation.tissues.development import CellDevelopment, CellworkDevelopment, Development
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError, require, shown, whole_number
from lsys_kit.geometry.drawing import turning_angle
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.scene import Scene
from lsys_kit.geometry.turtle.commands import DrawingMode, drawing_mode
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.cells import CellSystem, CellworkSystem, MapSystem
from lsys_kit.notation.model.system import USUAL_STEPS, LSystem
from lsys_kit.pictures.filaments import LOOKS, FilamentRow
from lsys_kit.pictures.formats.axes import new_axes, set_ground
from lsys_kit.pictures.formats.notebook import SVGPicture
from lsys_kit.pictures.legends import legend_of, letters_of
from lsys_kit.pictures.lineages import LineagePicture, lineage_picture
from lsys_kit.pictures.multiples import SmallMultiples
from lsys_kit.pictures.options import (
    CELLWORK,
    KINDS,
    LINEAGE,
    MAP,
    SPHERE,
    STAGES,
    Style,
    check_drawable,
    coloured_symbols,
    in_colours,
    in_widths,
    kind_of,
    split_options,
    style_from,
)
from lsys_kit.pictures.picture import NetPicture, Picture
from lsys_kit.pictures.plots.chart import Plot, painted
from lsys_kit.pictures.rendering.light import LitScene, seen_smoothly, upright
from lsys_kit.pictures.rendering.view import view_from
from lsys_kit.pictures.style.palette import colour_of
from lsys_kit.pictures.style.themes import drawn_on
from lsys_kit.pictures.tissues.cellworks import CellworkPicture, cellwork_picture
from lsys_kit.pictures.tissues.maps import MapPicture, map_picture
from lsys_kit.pictures.tissues.phases import PhasesPicture, phases_picture
from lsys_kit.pictures.tissues.spheres import sphere_picture
from lsys_kit.worlds.derive import derive
from lsys_kit.worlds.fields import Field

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST = 36
"""The greatest number of words in a picture."""


class ChosenWord(NamedTuple):
    """A word, or a derivation whose last word is drawn; its step and its seed; and what stands below it, if it is not alone."""

    word: Derivation | Word
    step: int
    seed: int | None = None
    caption: str = ""


def _numbers_from(value: object, name: str) -> tuple[int, ...]:
    if not isinstance(value, Sequence) or isinstance(value, str):
        raise ModelValueError(f'"{name}" takes a list of whole numbers, not {shown(value)}')
    if len(value) > MOST:
        raise _too_many(len(value))
    return tuple(whole_number(each, f'A number of "{name}"') for each in value)


def _too_many(needed: int) -> ModelLimitError:
    return ModelLimitError(f"A picture shows {MOST} drawings at most, not {needed:,}", limit=MOST, needed=needed)


def _chosen_words(
    what: LSystem | Derivation | Word, n: int | None, steps: Sequence[int], seeds: Sequence[int], choices: Mapping[str, object]
) -> list[ChosenWord]:
    """The words that are drawn: each of some steps for each of some seeds; by default the last step, and one seed."""
    if len(steps) * len(seeds) > MOST:
        raise _too_many(len(steps) * len(seeds))
    if seeds and (not isinstance(what, LSystem) or choices.get("seed") is not None):
        raise ModelValueError("Seeds are chosen when a system is derived", hint="Give either seed=1 or seeds=[1, 2, 3].")
    if steps and (isinstance(what, Word) or n is not None):
        raise ModelValueError("Steps are chosen by n or by steps, and a word has none", hint="Give steps=[4, 6, 8] alone.")
    choices = {name: value for name, value in choices.items() if value is not None}
    last = max(steps) if steps and isinstance(what, LSystem) else n
    own = choices.pop("seed", None)
    rows = [(seed, derivation_of(what, last, seed=own if seed is None else seed, **choices)) for seed in seeds or (None,)]
    return [_chosen(word, step, seed) for seed, word in rows for step in steps or (None,)]


def _chosen(word: Derivation | Word, step: int | None, seed: int | None) -> ChosenWord:
    if step is not None:
        assert isinstance(word, Derivation)
        if step > word.steps:
            raise ModelValueError(f"Step {step} has not been derived", hint=f"The last step is {word.steps}.")
        word = word.to(step)
    number = word.steps if isinstance(word, Derivation) else 0
    names = [f"seed {seed}"] * (seed is not None) + [f"step {step}"] * (step is not None)
    return ChosenWord(word, number, seed, ", ".join(names))


def derivation_of(what: LSystem | Derivation | Word, n: int | None, **choices: Any) -> Derivation | Word:
    """The derivation of a system; a derivation or word unchanged, because its steps are fixed already."""
    if isinstance(what, LSystem):
        return derive(what, n if n is not None else what.steps if what.steps is not None else USUAL_STEPS, **choices)
    if n is not None or choices.keys() - {"seed", "arithmetic"}:
        raise ModelValueError("Steps and constants are chosen when a system is derived, not when a word is drawn")
    return what


# --- from what is given to a picture ---

AnyPicture: TypeAlias = "MapPicture | PhasesPicture | Picture | NetPicture | LineagePicture | SmallMultiples"
_CELL_PICTURES: Mapping[str, Callable[..., AnyPicture]] = {MAP: map_picture, SPHERE: sphere_picture, CELLWORK: cellwork_picture}
"""How the kinds of systems of cells are drawn."""
MOST_ROWS = 24
"""The greatest number of rows of a developmental sequence, which shows the last steps."""


@overload
def draw(
    what: Stages,
    n: None = None,
    *,
    tokens: Word | None = None,
    positions: bool = False,
    size: object = None,
    labels: bool | None = None,
    colours: object = None,
    background: object = None,
) -> NetPicture: ...
@overload
def draw(
    what: Lineage,
    n: None = None,
    *,
    intervals: Iterable[tuple[object, object]] = (),
    size: object = None,
    labels: bool | None = None,
    colours: object = None,
    legend: bool | None = None,
    background: object = None,
) -> LineagePicture: ...
@overload
def draw(
    what: LSystem | Derivation | Word,
    n: int | None = None,
    *,
    angle: object = None,
    seed: int | None = None,
    arithmetic: str = "exact",
    marked: Collection[int] = (),
    cells: str | None = None,
    field: Field | None = None,
    view: object = None,
    steps: Sequence[int] = (),
    seeds: Sequence[int] = (),
    size: object = None,
    labels: bool | None = None,
    colours: object = None,
    widths: object = None,
    turtle: bool | None = None,
    legend: bool | None = None,
    light: object = None,
    background: object = None,
    **constants: object,
) -> Picture: ...
@overload
def draw(
    what: MapSystem | Development,
    n: int | None = None,
    *,
    iterations: Sequence[int] = (),
    phases: Literal[False] = False,
    labels: bool | None = None,
    size: object = None,
    background: object = None,
    **forces: object,
) -> MapPicture: ...
@overload
def draw(
    what: MapSystem | Development,
    n: int | None = None,
    *,
    phases: Literal[True],
    labels: bool | None = None,
    size: object = None,
    background: object = None,
    **forces: object,
) -> PhasesPicture: ...
@overload
def draw(
    what: CellworkSystem | CellworkDevelopment,
    n: int | None = None,
    *,
    view: object = ...,
    cell: int | None = None,
    generation: int | None = None,
    explode: object = ...,
    size: object = None,
    colours: object = None,
    legend: bool | None = None,
    light: object = None,
    background: object = None,
    **forces: object,
) -> CellworkPicture: ...
def draw(what: object, n: int | None = None, **choices: object) -> AnyPicture:
    """Draw a system, a derivation, a word, a stage diagram or a lineage.

    Parameters
    ----------
    what
        A system is derived first. A filament is then shown as a developmental sequence, one row a step; anything else as
        the turtle draws its last word. A single word is shown as it is. The maps of a map system stand side by side; of a
        cellwork system one sees the last step in space. A lineage is shown as far as its lines are not too dense.
    n
        The number of steps of a system; by default its own.
    angle
        The turning angle in degrees; by default the system's.
    cells
        How the cells of a filament are drawn: as "rectangles" with round ends or as "ellipses"; by default as the system says.
    view
        From which side something in space is seen, in degrees: around, 0 from the front and 90 from the right; and above, 0
        from the side and 90 from the top. By default plants are seen from (30, 15), and from the front if they are flat.
    steps, seeds
        Steps, and seeds, that are drawn side by side on one scale, each with a caption; of a filament the rows.
    size
        The width of the picture in pixels, or its width and height; all of it is enlarged, with its strokes and its text.
    labels
        False leaves out names, numbers of steps, times and ages. The cells of a filament have letters where these are more
        than two; True writes them in any case.
    colours
        "symbols": each has its own, the same in all pictures. "natural": strokes are brown to green, from the stem to the tips.
        Or the colours of some symbols, by names of CSS or hexadecimal: `colours={"L": "seagreen", "B": "#cc79a7"}`. By default
        strokes have the colours that the model chooses; where it chooses none, those of a plant, that is of a system with
        branches, are natural, unless it interprets several kinds of modules as strokes and has no leaves or flowers; all others
        are those of symbols. `colours: symbols` in a text says the same for all pictures of its system.
    widths
        A factor by which strokes are broader; "pipes", by which a stroke is the broader, the more tips it bears (the pipe
        model); "order", by which each is as broad as its branch order says; or "constant". By default strokes are as broad as
        the model says; where it says nothing, those of a plant by the pipe model, all others by branch order. No stroke is
        finer than 0.7 pixels.
    turtle
        Whether an arrow marks where the turtle starts, pointing where it looks then.
    legend
        Whether there is a legend below: which colour stands for which symbol, and which commands the turtle passed over.
    light
        True draws what a turtle has drawn, or a cellwork, in sun and sky on a ground that takes its shadow; then a drawing in
        the plane stands upright. Two angles in degrees say from where the sun shines, as `view` says from where one looks:
        `light=(-60, 30)` is a low sun at the left. Leaves let a part of the light through, and vary a little by the seed. Such
        a picture consists of pixels, which .svg and .pdf files contain.
    background
        "light" or "dark" paper, "none", or a colour. On dark paper lines are lighter.
    **choices
        For a system `seed`, `arithmetic`, `field` and new values of constants, as for `derive`; `marked`, the states whose
        modules are marked. For a stage diagram `tokens`, a word whose modules are its tokens, and `positions`, whether arcs say
        where in the successor a module stands. For a lineage `intervals`, stretches of time that are marked beside it.
        For a map system `iterations`, after which its last step is shown on the way to rest, or `phases`: whether it is shown
        how the last step comes about, from the walls that are replaced to the markers that match; and new values of the forces
        that shape it: `stiffness`, `rest`, `pressure`, `damping`. A cellwork system has all but the phases, too; and `cell`, a
        number, or `generation`, the number of divisions behind cells, to light these alone;
        and `explode`, by which part of their way from the middle cells are pulled apart, such that one sees those within: 0.3
        for all cells by default, and 0 for chosen ones.

    Raises
    ------
    ModelValueError
        It cannot be drawn, or the choices do not apply to it, or mean nothing for this kind of picture.
    ModelNameError
        There is no such choice, or no such symbol.

    Examples
    --------
    >>> from lsys_kit import read
    >>> draw(read("angle: 60\\nheading: 0\\naxiom: F--F--F\\nF -> F+F--F+F"), 3)
    192 segments, width 27, height 31.18
    >>> draw(read("angle: 30\\naxiom: F[&F][^F]"), 0, light=True)
    3 segments, width 0, height 1.87, depth 1; in sunlight, as an image of pixels in any format
    """
    with Task("The drawing was not finished"):
        return _drawn(what, n, **choices)


def _drawn(what: object, n: int | None, size: object = None, **choices: object) -> AnyPicture:
    check_drawable(what, n)
    if "ax" in choices:
        raise ModelNameError(
            "A drawing is a picture of its own", hint="Into the axes of a figure draws: figure(what, ax, n=4)."
        )
    given, choices = split_options(choices)
    style = style_from(given, kind_of(what, choices), coloured_symbols(what), size)
    with drawn_on(style.theme):
        picture = _in_style(what, n, style, **choices)
    return replace(picture, pixels=style.size, theme=style.theme)


def _in_style(what: Any, n: int | None, style: Style, **choices: Any) -> AnyPicture:
    labels, legend = style.labels is not False, style.legend is not False
    if isinstance(what, Stages):
        check_choices(choices, ("tokens", "positions"), STAGES)
        return _net_picture(what, labels, **choices)
    if isinstance(what, CellSystem | CellDevelopment):
        kind, looks = kind_of(what, choices), {"labels": labels, "legend": bool(style.legend), "light": style.light}
        draws: Callable[..., AnyPicture] = phases_picture if kind == MAP and _yes(choices, "phases") else _CELL_PICTURES[kind]
        return draws(what, n, **{name: value for name, value in looks.items() if name in KINDS[kind]}, **choices)
    if isinstance(what, Lineage):
        check_choices(choices, ("intervals",), LINEAGE)
        return lineage_picture(what, labels=labels, legend=legend, **choices)
    if isinstance(what, LSystem):
        names = "angle", "seed", "arithmetic", "marked", "cells", "field", "view", "steps", "seeds"
        check_choices(choices, names, kind_of(what, choices), [each.name for each in what.constants])
    return _drawing(what, n, style, **choices)


def _yes(choices: dict[str, object], name: str) -> bool:
    """Whether a choice is made, which is taken out of the others."""
    chosen = choices.pop(name, False)
    require(chosen, bool, f'True or False for "{name}"')
    return bool(chosen)


def check_choices(given: Iterable[str], options: Sequence[str], kind: str, constants: Sequence[str] = ()) -> None:
    """Every choice is one of the picture, or a constant of the system."""
    options = [*options, "size", *KINDS[kind]]
    for name in given:
        if name not in options and name not in constants:
            declared = f" Constants of the system are: {', '.join(constants)}." if constants else ""
            hint = suggestion(name, [*options, *constants]) or f"Options are: {', '.join(options)}.{declared}"
            raise ModelNameError(f'There is no option "{name}" here', hint=hint)


def _net_picture(net: Stages, labels: bool, tokens: Word | None = None, positions: bool = False) -> NetPicture:
    require(positions, bool, 'True or False for "positions"')
    return NetPicture(net, None if tokens is None else net.tokens(tokens), positions, labels)


def _drawing(
    what: LSystem | Derivation | Word,
    n: int | None,
    style: Style,
    *,
    angle: object = None,
    marked: Collection[int] = (),
    cells: str | None = None,
    view: object = None,
    steps: object = (),
    seeds: object = (),
    **choices: object,
) -> AnyPicture:
    require(marked, Collection, "A collection of states")
    states = frozenset(whole_number(each, "A state") for each in counted(marked))
    side = None if view is None else view_from(view)
    drawn = _chosen_words(what, n, _numbers_from(steps, "steps"), _numbers_from(seeds, "seeds"), choices)
    system = drawn[0].word.states.system
    if drawing_mode(system) is DrawingMode.FILAMENT:
        return _sequence(drawn, states, cells, style)
    turn = turning_angle(angle, system)
    scenes = in_widths([in_colours(each.word, turn, style) for each in drawn], system, style)
    usual = whole_number(choices.get("seed") or system.seed or 0, "The seed")
    thrown = [usual if each.seed is None else each.seed for each in drawn]
    pictures = [
        Picture((FilamentRow(each.step, seen),), state_colours(each.word), None, states, _solid(scene, seen))
        for each, scene, seen in zip(drawn, scenes, seen_smoothly(scenes, side, style.light, thrown), strict=True)
    ]
    lit = style.light is not None
    legend = legend_of([each.word.states for each in drawn], scenes, lit) if style.legend else None
    if not drawn[0].caption:
        return replace(pictures[0], legend=legend)
    columns = len({each.step for each in drawn}) if len({each.seed for each in drawn}) > 1 else 0
    captions = [each.caption for each in drawn]
    return SmallMultiples(pictures, captions, columns if columns > 1 else 0, style.labels is not False, legend=legend)


def _solid(scene: Scene, seen: Scene) -> Scene | None:
    """A scene in space; one in the plane only if it was set upright to be seen in sun and sky."""
    if scene.dimension == 3:
        return scene
    return upright(scene) if isinstance(seen, LitScene) else None


def _sequence(drawn: Sequence[ChosenWord], marked: Collection[int], cells: str | None, style: Style) -> Picture:
    """A filament's steps below one another; a word alone."""
    last = drawn[-1].word
    if isinstance(last, Word):
        return _in_letters(filament_picture(last, (FilamentRow(0, filament(last)),), None, marked, cells), last, style)
    if len({each.seed for each in drawn}) > 1:
        raise ModelValueError("The rows of a filament are the steps of one seed", hint="Draw one seed at a time.")
    steps = [each.step for each in drawn] if drawn[0].caption else range(max(0, last.steps + 1 - MOST_ROWS), last.steps + 1)
    rows = tuple(FilamentRow(step, filament(last.to(max(steps))[step])) for step in steps)
    return _in_letters(filament_picture(last, rows, steps[-1], marked, cells), last, style)


def _in_letters(picture: Picture, what: Derivation | Word, style: Style) -> Picture:
    scenes = [row.scene for row in picture.rows]
    legend = legend_of([what.states] * len(scenes), scenes) if style.legend else None
    letters = letters_of(what.states, scenes, style.labels)
    return replace(picture, labels=style.labels, letters=letters, legend=legend)


def filament_picture(
    what: Derivation | Word,
    rows: tuple[FilamentRow, ...],
    current: int | None,
    marked: Collection[int] = (),
    cells: str | None = None,
) -> Picture:
    """The picture of the rows of a filament, with the settings of its system."""
    look = what.states.system.cells if cells is None else cells
    if look not in LOOKS:
        raise ModelValueError(f"Cells are drawn as {' or '.join(LOOKS)}, not as {shown(look)}")
    return Picture(rows, state_colours(what), current, marked, look=look, time=age_model(what.states).step)


def state_colours(what: Derivation | Word) -> Mapping[int, str]:
    """For each state met so far the colour of its symbol."""
    return {state: colour_of(module.symbol, what.states.system) for state, module in enumerate(what.states.modules)}


def figure(what: Any, ax: Axes | None = None, **choices: Any) -> Axes:
    """Draw into a matplotlib figure, to be combined with other plots.

    Parameters
    ----------
    what
        A picture, or what `draw` takes; or what `plot` returns.
    ax
        The axes to draw into, in the plane. By default those of a new figure.
    **choices
        As for `draw`.

    Returns
    -------
    matplotlib.axes.Axes
        The axes, without frame, with equal scales.

    Raises
    ------
    ModelValueError
        The axes are in space, or something is chosen for a picture that is drawn already.

    Examples
    --------
    >>> from lsys_kit import derive, read
    >>> from matplotlib.figure import Figure
    >>> left, right = Figure().subplots(1, 2)
    >>> plant = read("angle: 25\\naxiom: F\\nF -> F[+F]F[-F]F")
    >>> _ = left.plot([len(word) for word in derive(plant, 4)])
    >>> figure(plant, right, n=4) is right
    True
    """
    from matplotlib.axes import Axes

    require(ax, (Axes, type(None)), "The axes of a figure")
    if ax is not None and ax.name == "3d":
        raise ModelValueError(
            "A drawing needs axes in the plane, and these are in space",
            hint="A plant in space can be kept as .glb, which other programs turn.",
        )
    if isinstance(what, Plot):
        if choices:
            raise ModelNameError(
                f'There is no option "{next(iter(choices))}" here', hint="What a plot shows is chosen when it is made."
            )
        return painted(what, new_axes(what.theme.ground) if ax is None else ax)
    if isinstance(what, SVGPicture) and choices:
        raise ModelValueError(
            "What a picture shows is chosen when it is drawn", hint=f"Give {next(iter(choices))}= to draw(...)."
        )
    picture = what if isinstance(what, SVGPicture) else draw(what, **choices)
    axes = new_axes(picture.theme.ground) if ax is None else ax
    with Task("The figure was not drawn"), drawn_on(picture.theme):
        picture.plot_into(axes)
    axes.set_aspect("equal")
    axes.autoscale_view()
    axes.set_axis_off()
    set_ground(axes, picture.theme.ground)
    return axes
