"""How shapes look, by themselves and as a person chooses: their colours, the widths of strokes, and the start of the turtle."""

from __future__ import annotations

from collections.abc import Collection, Mapping, Sequence
from dataclasses import replace

from lsys_kit.arrays import np
from lsys_kit.geometry.scene import OWN, Discs, Integers, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.space import initial_frame
from lsys_kit.notation.model.system import LSystem
from lsys_kit.pictures.style.palette import CHOSEN, GREEN
from lsys_kit.pictures.style.themes import theme

STROKES = (2.4, 1.7, 1.3, 1.0)
"""Stroke widths by branch order, in pixels; deeper branches have the last."""
CONSTANT_ORDER = 1
"""The branch order whose width all strokes have where that is constant."""
LEAST = (15, 11, 8, 7)
"""The least widths by branch order where the turtle chooses none, in tenths of a pixel: finer lines are too pale to be seen."""
THINNEST, BROADEST = 7, 4_000
"""The least and the greatest width of a stroke, in tenths of a pixel: what is finer is too pale to be seen."""
SAMPLE = 20_000
"""The median length of strokes is estimated from at most this number of them."""
USUAL_LENGTH, FINEST, STURDY, BOLDEST = 12, 0.3, 0.8, 2.0
"""The median length of strokes in pixels at which they have their usual width; the least factor by which they are finer where
they are short; and in space, where one sees each by itself, the least and the greatest factor."""


def widths_by_order(usual: Sequence[float]) -> list[float]:
    """Widths by branch order in the theme in force, given the usual ones: broader by a factor, or all the same.

    >>> widths_by_order(STROKES) == [*STROKES]
    True
    """
    chosen = [usual[CONSTANT_ORDER]] * len(usual) if theme().even else usual
    return [theme().boldness * width for width in chosen]


def thinnest() -> int:
    """The least width of a stroke in the theme in force, in tenths of a pixel of the usual size.

    >>> from dataclasses import replace
    >>> from lsys_kit.pictures.style.themes import LIGHT, drawn_on
    >>> with drawn_on(replace(LIGHT, reduced=0.5)):
    ...     thinnest()
    14
    """
    return round(THINNEST / theme().reduced)


def stroke_widths(segments: Segments, scale: float, thin: float) -> Integers:
    """The widths of strokes in tenths of a pixel: one that the turtle has set is scaled with the drawing; others depend on the
    branch order, and are made finer by a factor."""
    by_order = np.array(
        [
            max(round(least), thinnest(), round(10 * width * thin))
            for width, least in zip(widths_by_order(STROKES), widths_by_order(LEAST), strict=True)
        ]
    )
    widths = by_order[np.minimum(segments.orders, len(STROKES) - 1)]
    if (segments.widths != OWN).any():
        given = np.clip(np.rint(segments.widths * scale * 10), thinnest(), BROADEST).astype(np.int64)
        widths = np.where(segments.widths == OWN, widths, given)
    return widths


def stroke_scale(segments: Segments, scale: float, boldest: float = 1.0) -> float:
    """The factor by which strokes are finer where they are short on the average, or bolder where that is allowed."""
    if not len(segments):
        return 1.0
    return min(boldest, max(FINEST, median_length(segments) * scale / USUAL_LENGTH))


def median_length(segments: Segments) -> float:
    """The median length of strokes, from a part of them where they are many; infinite without strokes."""
    some = segments.ends[:: len(segments) // SAMPLE + 1]
    return float(np.median(np.hypot(some[:, 2] - some[:, 0], some[:, 3] - some[:, 1]))) if len(some) else np.inf


def numbered_colours(states: Integers, colours: Integers, colour_of: Mapping[int, str]) -> tuple[list[str], Integers]:
    """The colours in use, and for each shape the number of its own: that of its symbol, or the one that the turtle chose."""
    names = list(dict.fromkeys((*colour_of.values(), GREEN, *CHOSEN)))
    of_state = np.full(int(states.max(initial=0)) + 1, names.index(GREEN))
    for state, colour in colour_of.items():
        if state < len(of_state):
            of_state[state] = names.index(colour)
    chosen = np.array([names.index(colour) for colour in CHOSEN])
    return names, np.where(colours == OWN, of_state[states], chosen[colours % len(CHOSEN)])


# --- as a person chooses ---

START, START_COLOUR = 0.12, 4
"""The length of the arrow at the start as a share of the drawing, and its colour, as a turtle chooses it by number."""


def with_colours_of_symbols(scene: Scene, states: Collection[int] | None = None) -> Scene:
    """A scene in which shapes have the colours of their symbols: all of them, or those that modules of some states drew.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> with_colours_of_symbols(scene_of(derive(read("axiom: F ;(2) F"), 0))).segments.colours.tolist()
    [-1, -1]
    """
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    return replace(
        scene,
        segments=replace(segments, colours=_colours(segments, states)),
        polygons=replace(polygons, colours=_colours(polygons, states)),
        discs=replace(discs, colours=_colours(discs, states)),
    )


def _colours(shapes: Segments | Polygons | Discs, states: Collection[int] | None) -> Integers:
    theirs = np.ones(len(shapes), bool) if states is None else np.isin(shapes.states, list(states))
    return np.where(theirs, OWN, np.broadcast_to(shapes.colours, len(shapes)))


def with_start(scene: Scene, system: LSystem) -> Scene:
    """A scene with an arrow whose tip is where the turtle starts, and which points where it looks then.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> plant = derive(read("axiom: F(10)"), 0)
    >>> with_start(scene_of(plant), plant.states.system).polygons.points.round(2).tolist()
    [[0.0, 0.0], [-0.48, -1.2], [0.48, -1.2]]
    """
    axes = [0, 2] if scene.dimension == 2 else [0, 1, 2]
    head, left = np.array(initial_frame(system.turtle, float(system.heading))[:2])[:, axes]
    size = (float(np.ptp(scene.corners, axis=0).max()) or 1.0) * START
    arrow, found = size * np.array([0 * head, left * 0.4 - head, -left * 0.4 - head]), scene.polygons
    flat = np.zeros((3, 3)) if len(found.normals) else found.normals
    return replace(
        scene,
        polygons=Polygons(
            np.concatenate([found.points, arrow]),
            np.append(found.starts, len(found.points) + 3),
            np.append(found.states, 0),
            np.append(np.broadcast_to(found.colours, len(found)), START_COLOUR),
            np.concatenate([found.normals, flat]),
        ),
    )


def with_widths(scene: Scene, widths: str = "", factor: float = 1.0) -> Scene:
    """A scene with strokes for which the turtle has set no width, if these are chosen by "order" or "constant"; else those that
    have widths are broader by a factor.

    >>> from lsys_kit import derive, read
    >>> from lsys_kit.geometry.drawing import scene_of
    >>> scene = scene_of(derive(read("axiom: F !(3) F"), 0))
    >>> with_widths(scene, "order").segments.widths.tolist(), with_widths(scene, factor=2).segments.widths.tolist()
    ([-1.0], [-1.0, 6.0])
    """
    segments = scene.segments
    if widths in ("order", "constant"):
        return replace(scene, segments=replace(segments, widths=np.array([float(OWN)])))
    given = np.where(segments.widths == OWN, OWN, segments.widths * factor)
    return replace(scene, segments=replace(segments, widths=given))
