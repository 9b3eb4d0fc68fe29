"""Drawing: words and systems as pictures that a notebook shows, a file keeps, or a matplotlib figure takes in."""

from __future__ import annotations

from collections.abc import Collection, Iterable, Mapping, Sequence
from typing import TYPE_CHECKING, Any, overload

from lsys_kit.budget import Task
from lsys_kit.derivation.cellworks.development import CellworkDevelopment
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.core.words import Word
from lsys_kit.derivation.derive import Derivation
from lsys_kit.derivation.maps.development import Development
from lsys_kit.derivation.petri.stages import Stages
from lsys_kit.derivation.timed.ages import age_model
from lsys_kit.derivation.timed.lineage import Lineage
from lsys_kit.errors import ModelNameError, ModelValueError, require, shown, whole_number
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.geometry.filament import filament
from lsys_kit.geometry.turtle.mode import DrawingMode, drawing_mode
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.notation.model.cellworks import CellworkSystem
from lsys_kit.notation.model.maps import MapSystem
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.cellworks import CellworkPicture, cellwork_picture
from lsys_kit.pictures.filaments import LOOKS
from lsys_kit.pictures.formats.axes import new_axes
from lsys_kit.pictures.line_widths import in_units
from lsys_kit.pictures.lineages.picture import LineagePicture, lineage_picture
from lsys_kit.pictures.maps import MapPicture, map_picture
from lsys_kit.pictures.picture import NetPicture, Picture, plotted
from lsys_kit.pictures.plots.chart import Plot, painted
from lsys_kit.pictures.spheres import sphere_picture
from lsys_kit.pictures.style.palette import colour_of
from lsys_kit.pictures.svg import FilamentRow
from lsys_kit.pictures.view import project, view_from
from lsys_kit.worlds.derive import derive
from lsys_kit.worlds.fields import Field

if TYPE_CHECKING:
    from matplotlib.axes import Axes

MOST_ROWS = 24
"""The greatest number of rows of a developmental sequence, which shows the last steps."""


@overload
def draw(what: Stages, n: None = None, *, tokens: Word | None = None, positions: bool = False) -> NetPicture: ...
@overload
def draw(what: Lineage, n: None = None, *, intervals: Iterable[tuple[object, object]] = ()) -> LineagePicture: ...
@overload
def draw(what: LSystem | Derivation | Word, n: int | None = None, *, angle: object = None, seed: int | None = None,
         arithmetic: str = "exact", marked: Collection[int] = (), cells: str | None = None, field: Field | None = None,
         view: object = None, **constants: object) -> Picture: ...
@overload
def draw(what: MapSystem | Development, n: int | None = None, *, iterations: Sequence[int] = (), labels: bool = True,
         **forces: object) -> MapPicture: ...
@overload
def draw(what: CellworkSystem | CellworkDevelopment, n: int | None = None, *, view: object = ..., cell: int | None = None,
         generation: int | None = None, **forces: object) -> CellworkPicture: ...
def draw(what: Any, n: int | None = None, **choices: Any) -> MapPicture | Picture | NetPicture | LineagePicture:
    """Draw a system, a derivation, a word, a stage diagram or a lineage.

    Parameters
    ----------
    what
        A system is derived first. A filament is then shown as a developmental sequence, one row a step; anything else as
        the turtle draws its last word. A single word is shown as it is. The maps of a map system stand side by side; of a
        cellwork system one sees the last step in space.
    n
        The number of steps of a system; by default its own.
    angle
        The turning angle in degrees; by default the system's.
    cells
        How the cells of a filament are drawn: as "rectangles" with round ends or as "ellipses"; by default as the system says.
    view
        From which side something in space is seen, in degrees: around, 0 from the front and 90 from the right; and above, 0
        from the side and 90 from the top. By default plants are seen from (30, 15), and from the front if they are flat.
    **choices
        For a system `seed`, `arithmetic`, `field` and new values of constants, as for `derive`; `marked`, the states whose
        modules are marked. For a stage diagram `tokens`, a word whose modules are its tokens, and `positions`, whether arcs say
        where in the successor a module stands. For a lineage `intervals`, stretches of time that are marked beside it.
        For a map system `iterations`, after which its last step is shown on the way to rest; `labels`, whether walls of a map
        in the plane have theirs; and new values of the forces that shape it: `stiffness`, `rest`, `pressure`, `damping`. A
        cellwork system has all of these but `labels`, too; and `cell`, a number, or `generation`, the number of divisions
        behind cells, to light these alone.

    Raises
    ------
    ModelValueError
        It cannot be drawn, or the choices do not apply to it.
    ModelNameError
        There is no such choice.

    Examples
    --------
    >>> from lsys_kit.notation.read import read
    >>> draw(read("angle: 60\\nheading: 0\\naxiom: F--F--F\\nF -> F+F--F+F"), 3)
    192 segments, width 27, height 31.18
    """
    with Task("The drawing was not finished"):
        return _drawn(what, n, **choices)


def _drawn(what: Any, n: int | None, **choices: Any) -> MapPicture | Picture | NetPicture | LineagePicture:
    if isinstance(what, Stages):
        _check_options(choices, ("tokens", "positions"))
        return _net_picture(what, **choices)
    if isinstance(what, MapSystem | Development):
        system = what if isinstance(what, MapSystem) else what.system
        return (sphere_picture if system.sphere else map_picture)(what, n, **choices)
    if isinstance(what, CellworkSystem | CellworkDevelopment):
        return cellwork_picture(what, n, **choices)
    if isinstance(what, Lineage):
        _check_options(choices, ("intervals",))
        return lineage_picture(what, **choices)
    if isinstance(what, LSystem):
        options = "angle", "seed", "arithmetic", "marked", "cells", "field", "view"
        _check_options(choices, options, [each.name for each in what.constants])
    return _drawing(what, n, **choices)


def _check_options(given: Iterable[str], options: Sequence[str], constants: Sequence[str] = ()) -> None:
    """Every choice is an option of the picture, or a constant of the system."""
    for name in given:
        if name not in options and name not in constants:
            declared = f" Constants of the system are: {', '.join(constants)}." if constants else ""
            hint = suggestion(name, [*options, *constants]) or f"Options are: {', '.join(options)}.{declared}"
            raise ModelNameError(f'There is no option "{name}" here', hint=hint)


def _net_picture(net: Stages, tokens: Word | None = None, positions: bool = False) -> NetPicture:
    require(positions, bool, 'True or False for "positions"')
    return NetPicture(net, None if tokens is None else net.tokens(tokens), positions)


def _drawing(what: LSystem | Derivation | Word, n: int | None, *, angle: object = None, seed: int | None = None,
             arithmetic: str = "exact", marked: Collection[int] = (), cells: str | None = None, field: Field | None = None,
             view: object = None, **constants: object) -> Picture:
    if not isinstance(what, LSystem | Derivation | Word):
        raise ModelValueError("Only systems, derivations, words, stage diagrams and lineages can be drawn, "
                              f"not {type(what).__name__}")
    require(marked, Collection, "A collection of states")
    marked = frozenset(whole_number(each, "A state") for each in marked)
    what = derivation_of(what, n, seed=seed, arithmetic=arithmetic, **({} if field is None else {"field": field}), **constants)
    if drawing_mode(what.states.system) is DrawingMode.FILAMENT:
        return _sequence(what, marked, cells)
    turn = real_from(angle, "angle") if angle is not None else float(what.states.system.angle)
    step, [scene] = what.steps if isinstance(what, Derivation) else 0, in_units([scene_of(what, turn)], what.states.system)
    [seen] = project([scene], None if view is None else view_from(view))
    return Picture((FilamentRow(step, seen),), state_colours(what), None, marked,
                   scene if scene.dimension == 3 else None)


def derivation_of(what: LSystem | Derivation | Word, n: int | None, **choices: Any) -> Derivation | Word:
    """The derivation of a system; a derivation or word unchanged, because its steps are fixed already."""
    if isinstance(what, LSystem):
        return derive(what, n if n is not None else what.steps if what.steps is not None else 5, **choices)
    if n is not None or choices.keys() - {"seed", "arithmetic"}:
        raise ModelValueError("Steps and constants are chosen when a system is derived, not when a word is drawn")
    return what


def _sequence(what: Derivation | Word, marked: Collection[int], cells: str | None) -> Picture:
    """A filament's steps below one another; a word alone."""
    if isinstance(what, Word):
        return filament_picture(what, (FilamentRow(0, filament(what)),), None, marked, cells)
    first = max(0, what.steps + 1 - MOST_ROWS)
    rows = tuple(FilamentRow(step, filament(what[step])) for step in range(first, what.steps + 1))
    return filament_picture(what, rows, what.steps, marked, cells)


def filament_picture(what: Derivation | Word, rows: tuple[FilamentRow, ...], current: int | None, marked: Collection[int] = (),
                     cells: str | None = None) -> Picture:
    """The picture of the rows of a filament, with the settings of its system."""
    look = what.states.system.cells if cells is None else cells
    if look not in LOOKS:
        raise ModelValueError(f"Cells are drawn as {' or '.join(LOOKS)}, not as {shown(look)}")
    return Picture(rows, state_colours(what), current, marked, look=look, time=age_model(what.states).step)


def state_colours(what: Derivation | Word) -> Mapping[int, str]:
    """For each state met so far the colour of its symbol."""
    return {state: colour_of(module.symbol, what.states.system) for state, module in enumerate(what.states.modules)}


def figure(what: Picture | Plot | LSystem | Derivation | Word, ax: Axes | None = None, **choices: Any) -> Axes:
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
        The axes are in space, or it is no drawing of a word.

    Examples
    --------
    >>> from matplotlib.figure import Figure
    >>> from lsys_kit.notation.read import read
    >>> left, right = Figure().subplots(1, 2)
    >>> plant = read("angle: 25\\naxiom: F\\nF -> F[+F]F[-F]F")
    >>> _ = left.plot([len(word) for word in derive(plant, 4)])
    >>> figure(plant, right, n=4) is right
    True
    """
    from matplotlib.axes import Axes

    require(ax, (Axes, type(None)), "The axes of a figure")
    if ax is not None and ax.name == "3d":
        raise ModelValueError("A drawing needs axes in the plane, and these are in space",
                              hint="A plant in space can be kept as .glb, which other programs turn.")
    if isinstance(what, Plot):
        if choices:
            raise ModelNameError(f'There is no option "{next(iter(choices))}" here',
                                 hint="What a plot shows is chosen when it is made.")
        return painted(what, new_axes() if ax is None else ax)
    picture = what if isinstance(what, Picture) else draw(what, **choices)
    if not isinstance(picture, Picture):
        raise ModelValueError("Only a plot, or the drawing of a system, a derivation or a word goes into a figure",
                              hint="Keep other pictures as .svg.")
    return plotted(picture, new_axes() if ax is None else ax)
