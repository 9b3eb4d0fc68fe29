"""Cellworks as pictures: the cells of a step in space, with shaded walls.

Walls of one colour have the same label. Where some cells are lit, those alone have walls, and of the others one sees the edges.
Cells pulled apart show the walls between them.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import cached_property

from lsys_kit.arrays import np
from lsys_kit.budget import current
from lsys_kit.derivation.core.rules import real_from
from lsys_kit.derivation.tissues.cellworks import Cellwork
from lsys_kit.derivation.tissues.development import CellworkDevelopment
from lsys_kit.errors import ModelLimitError, ModelValueError, whole_number
from lsys_kit.geometry.scene import Floats, Scene, Segments
from lsys_kit.geometry.tissues.layout import cellwork_scene, place_cellworks
from lsys_kit.notation.model.cells import CellworkSystem
from lsys_kit.pictures.filaments import FilamentRow
from lsys_kit.pictures.formats.notebook import described
from lsys_kit.pictures.legends import Entry, Legend, in_sunlight
from lsys_kit.pictures.picture import Picture
from lsys_kit.pictures.rendering.light import Sun, seen_smoothly
from lsys_kit.pictures.rendering.view import View, view_from
from lsys_kit.pictures.style.palette import SERIES, tinted
from lsys_kit.pictures.style.themes import theme
from lsys_kit.pictures.tissues.chosen import counts_text, developed, forces_of

SIDE = 30, 25
"""From where cells are seen, in degrees: from the front and somewhat from the right, and from above."""

EDGE = 0.012
"""The width of edges, in units."""
EDGE_ORDER, RELIEF = 3, 0.02
"""The branch order of edges, and their width in sun and sky."""


@dataclass(frozen=True, repr=False)
class CellworkPicture(Picture):
    """A picture of one step of a cellwork, which can be seen from any side.

    Attributes
    ----------
    counts
        How many vertices, edges, walls and cells there are.
    lit
        How many cells have walls in the picture.
    apart
        Whether they are pulled apart.
    """

    counts: tuple[int, int, int, int] = (0, 0, 0, 0)
    lit: int = 0
    apart: bool = False

    @cached_property
    def text(self) -> str:
        """What the picture shows, in words."""
        shown = "" if self.lit == self.counts[3] else f"walls of {self.lit:,} of them, and the edges of the others"
        return described(
            [
                f"step {self.rows[-1].step}",
                counts_text(self.counts),
                shown,
                "cells pulled apart" if self.apart else "",
                "walls of one colour have the same label",
                self._light,
            ]
        )


def cellwork_picture(
    what: CellworkSystem | CellworkDevelopment,
    n: int | None = None,
    *,
    view: object = SIDE,
    cell: int | None = None,
    generation: int | None = None,
    explode: object = None,
    legend: bool = False,
    light: Sun | None = None,
    **forces: object,
) -> CellworkPicture:
    """The picture of a cellwork system after `n` steps, or of the last step of a development; all its cells are pulled apart,
    unless a person says how far."""
    cellworks: CellworkDevelopment = developed(what, n)
    lit, chosen = lit_cells(cellworks, cell, generation), forces_of(forces, "cellwork")
    _check_size(cellworks)
    usual = USUALLY_APART if 1 < len(lit) == len(cellworks[-1].cells) else 0
    side, apart = view_from(view), _apart(usual if explode is None else explode)
    *_, points = place_cellworks(cellworks, chosen)
    return picture_at(cellworks[:], points, lit, side, legend, light, apart)


def cellwork_steps(
    what: CellworkSystem | CellworkDevelopment,
    n: int | None = None,
    *,
    explode: object = 0,
    legend: bool = False,
    light: Sun | None = None,
    **forces: object,
) -> list[CellworkPicture]:
    """The pictures of all steps of a cellwork system, or of a development, for a film."""
    cellworks: CellworkDevelopment = developed(what, n) if isinstance(what, CellworkSystem) else what
    _check_size(cellworks)
    places, apart = place_cellworks(cellworks, forces_of(forces, "cellwork")), _apart(explode)
    return [
        picture_at(cellworks[: step + 1], points, range(len(cellworks[step].cells)), SIDE, legend, light, apart)
        for step, points in enumerate(places)
    ]


def picture_at(
    cellworks: Sequence[Cellwork],
    points: Floats,
    lit: Collection[int],
    view: View,
    legend: bool = False,
    light: Sun | None = None,
    apart: float = 0.0,
) -> CellworkPicture:
    """The picture of the last of the cellworks of steps 0, 1, 2, ..., given the positions of its vertices; perhaps with what
    the colours of walls mean, in sun and sky, and with its cells so far apart."""
    last, labels = cellworks[-1], {label: number for number, label in enumerate(wall_labels(cellworks))}
    solid = cellwork_scene(last, points, labels, lit, len(labels), apart)
    solid = replace(solid, segments=replace(solid.segments, widths=np.array([EDGE])))
    if light is not None:
        solid = _with_edges(solid, len(labels))
    [seen] = seen_smoothly([solid], view, light, leafy=False)
    colours = _colours(labels)
    meaning = Legend(tuple(Entry((colours[number],), ("", "", label)) for label, number in labels.items())) if legend else None
    if meaning is not None and light is not None:
        meaning = in_sunlight(meaning)
    rows = (FilamentRow(len(cellworks) - 1, seen),)
    return CellworkPicture(rows, colours, solid=solid, counts=last.counts, lit=len(lit), apart=bool(apart), legend=meaning)


def _apart(given: object) -> float:
    """How far a person wants cells pulled apart, as a part of the way of each from the middle."""
    found = real_from(given, "explode", _APART_HINT)
    if not 0 <= found <= FARTHEST:
        raise ModelValueError(f'"explode" is a number from 0 to {FARTHEST}, not {found:g}', hint=_APART_HINT)
    return found


USUALLY_APART = 0.3
"""How far the cells of a picture of all are pulled apart, such that one sees the walls between them."""
FARTHEST = 10
"""Cells are pulled apart by so many times their way from the middle at most."""
_APART_HINT = "0.5 moves each cell away from the middle by half of its way from there."


def _with_edges(solid: Scene, state: int) -> Scene:
    """A cellwork whose walls have edges in relief, which are seen where these are not outlined."""
    points, starts, segments = solid.polygons.points, solid.polygons.starts, solid.segments
    following = np.arange(1, len(points) + 1)
    following[starts[1:] - 1] = starts[:-1]
    ends = np.concatenate([segments.ends, np.concatenate([points, points[following]], axis=1)])
    states = np.append(segments.states, np.full(len(points), state))
    return replace(solid, segments=Segments(ends, np.full(len(ends), EDGE_ORDER), states, np.array([RELIEF])))


def lit_cells(development: CellworkDevelopment, cell: int | None = None, generation: int | None = None) -> Collection[int]:
    """The cells of the last step that are shown with their walls: all, one, or those behind which so many divisions lie."""
    cells = range(len(development[-1].cells))
    if cell is not None:
        if whole_number(cell, "The number of a cell") not in cells:
            raise ModelValueError(
                f"There is no cell {cell}", hint=f"The cells of step {development.steps} are 0 to {cells[-1]}."
            )
        return {cell}
    if generation is None:
        return cells
    generations = development.generations
    lit = {each for each in cells if generations[each] == whole_number(generation, "The number of a generation")}
    if not lit:
        there = ", ".join(map(str, sorted({*generations})))
        raise ModelValueError(
            f"There is no cell of generation {generation}",
            hint=f"Generations are counted by divisions; at step {development.steps} there are: {there}.",
        )
    return lit


def _check_size(development: CellworkDevelopment) -> None:
    shapes = len(development[-1].walls) + len(development[-1].edges)
    if shapes > current().figure:
        raise ModelLimitError(
            f"The picture would have {shapes:,} walls and edges; the limit is {current().figure:,}",
            limit=current().figure,
            needed=shapes,
            hint="Take fewer steps, or set limits(figure=...).",
        )


def wall_labels(cellworks: Sequence[Cellwork]) -> Mapping[str, str]:
    """The labels of walls, in the order of their first occurrence, each with its colour."""
    labels = dict.fromkeys(wall.label for found in cellworks for wall in found.walls)
    return {label: SERIES[number % len(SERIES)] for number, label in enumerate(labels)}


def _colours(labels: Mapping[str, int]) -> Mapping[int, str]:
    """The colours of the states: of the labels, those that a person has chosen or others; then of edges."""
    chosen = dict(theme().symbols)
    walls = (chosen.get(label, SERIES[number % len(SERIES)]) for label, number in labels.items())
    return dict(enumerate((*walls, tinted(theme().quiet, 0.6))))
