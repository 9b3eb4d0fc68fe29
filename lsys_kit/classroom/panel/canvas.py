"""Drawings that the browser turns by itself: in the plane by the turtle's angle, in space to any point of view.

The canvases are the kit's own, some four hundred lines in all, and need only anywidget. k3d was tried (3.2, November 2026) and
rejected: it sends 2.6 MB of JavaScript through the kernel to every page and needs WebGL, which not every school has; the
mouse turns its pictures, the keyboard does not; and its strokes and colours are not those of the other pictures. pythreejs and
ipyvolume are no longer maintained. Here a plant in space looks as in the picture of a stored notebook, which `project` makes
from the same scene; it is painted from far to near, the far parts paler.

Where anywidget is missing, drawings and diagrams are plain SVG in an HTML widget, redrawn in the kernel.
"""

from __future__ import annotations

from collections.abc import Collection, Mapping
from functools import lru_cache
from pathlib import Path as File
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from lsys_kit.geometry.scene import CIRCLE, Discs, Integers, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.plane import Path
from lsys_kit.pictures.display_list import numbered_colours
from lsys_kit.pictures.style.palette import MARK_EDGE

HOW_TO_TURN = ("Turn it with the arrow keys or by dragging; plus and minus bring it nearer or farther, Shift and an arrow key "
               "move along it, Home puts it back.")
"""Instructions for those who cannot see that a drawing can be turned."""
_HERE = File(__file__).parent


class _Points(NamedTuple):
    """The points of a drawing, by their numbers: which are the ends of strokes, the corners, the centres; and where they are.

    In the plane that is told by the turtle's path: point 0 is the origin, point i + 1 the end of step i.
    """

    ends: Integers
    corners: Integers
    centres: Integers
    many: int
    where: bytes


def packed(scene: Scene, path: Path | None, colour_of: Mapping[int, str], marked: Collection[int] = ()) -> dict[str, Any]:
    """A drawing as the traits of its canvas, all numbers in one buffer.

    Parameters
    ----------
    scene
        What is drawn.
    path
        The turtle's path, from which the canvas finds the points of a scene in the plane; None for a scene in space.
    colour_of, marked
        As for `Picture`.

    Examples
    --------
    >>> from lsys_kit.derivation.derive import derive
    >>> from lsys_kit.geometry.turtle.plane import place_path, trace
    >>> from lsys_kit.notation.read import read
    >>> path = trace(derive(read("axiom: F+F"), 0)[0])
    >>> traits = packed(place_path(path, 90), path, {0: "#009E73"})
    >>> np.frombuffer(traits["shapes"], "<i4")[:9].tolist()  # 2 strokes, 0 other shapes, 2 steps; from 0 and 1, to 1 and 2
    [2, 0, 0, 0, 2, 0, 1, 1, 2]
    """
    points = _points_in_space(scene) if path is None else _points_in_plane(path)
    segments, polygons, discs = scene.segments, scene.polygons, scene.discs
    chosen = list(marked)

    def looks(shapes: Segments | Polygons | Discs, more: ArrayLike = 0) -> bytes:
        numbers = numbered_colours(shapes.states, shapes.colours, colour_of)[1]
        return _int_bytes(numbers * 16 + np.isin(shapes.states, chosen) * 2 + more)

    counts = [len(segments), len(polygons), len(points.corners), len(discs), points.many]
    data = [_int_bytes(counts), _int_bytes(points.ends.T), looks(segments, np.minimum(segments.orders, 3) * 4),
            _float_bytes(np.broadcast_to(segments.widths, len(segments)))]
    if len(polygons):
        data += [_int_bytes(polygons.starts), looks(polygons), _int_bytes(points.corners)]
    data += [_int_bytes(points.centres), looks(discs, discs.kinds == CIRCLE), _float_bytes(discs.radii), points.where]
    starts, stops = np.split(segments.ends, 2, axis=1)
    return {"shapes": b"".join(data), "colours": numbered_colours(segments.states, segments.colours, colour_of)[0],
            "typical": float(np.median(np.linalg.norm(stops - starts, axis=1))) if len(segments) else 1.0}


def _points_in_plane(path: Path) -> _Points:
    ends = np.column_stack([path.parents + 1, np.arange(1, len(path) + 1)])[path.drawn]
    corners = [corner + 1 for outline in path.outlines for corner in outline.corners]
    centres = [found.place + 1 for found in path.rounds]
    where = _float_bytes([path.turns, path.offsets, path.lengths]) + _int_bytes(path.parents)
    return _Points(ends, np.array(corners, np.int64), np.array(centres, np.int64), len(path), where)


def _points_in_space(scene: Scene) -> _Points:
    places = np.concatenate([scene.segments.points, scene.polygons.points, scene.discs.centres])
    first, last = 2 * len(scene.segments), len(places) - len(scene.discs)
    numbers = np.arange(len(places))
    return _Points(numbers[:first].reshape(-1, 2), numbers[first:last], numbers[last:], len(places), _float_bytes(places.T))


def _int_bytes(numbers: ArrayLike) -> bytes:
    return np.ascontiguousarray(numbers, "<i4").tobytes()


def _float_bytes(numbers: ArrayLike) -> bytes:
    return np.ascontiguousarray(numbers, "<f4").tobytes()


class WidgetClasses(NamedTuple):
    """The classes of the canvas in the plane, of that in space, and of the diagram."""

    flat: Any
    space: Any
    diagram: Any


@lru_cache(maxsize=1)
def widget_classes() -> WidgetClasses | None:
    """The classes of the widgets, or None where anywidget is missing."""
    try:
        import anywidget
        import traitlets
    except ImportError:
        return None

    class Canvas(anywidget.AnyWidget):
        """Shapes whose points the browser finds by itself."""

        shapes = traitlets.Bytes().tag(sync=True)
        typical = traitlets.Float(1.0).tag(sync=True)
        colours = traitlets.List(traitlets.Unicode()).tag(sync=True)
        mark = traitlets.Unicode(MARK_EDGE).tag(sync=True)
        description = traitlets.Unicode().tag(sync=True)

    class Flat(Canvas):
        """A turtle's path in the plane."""

        _esm = _script("pen.js", "flat.js")
        angle = traitlets.Float(90.0).tag(sync=True)
        heading = traitlets.Float(90.0).tag(sync=True)

    class Space(Canvas):
        """A scene in space.

        `around` and `above` are the point of view, as for `project`, and `near` is the magnification; each increment of
        `returns` shows the whole from the front again.
        """

        _esm = _script("pen.js", "space.js")
        around = traitlets.Int().tag(sync=True)
        above = traitlets.Int().tag(sync=True)
        near = traitlets.Float(1.0).tag(sync=True)
        returns = traitlets.Int().tag(sync=True)

    class Diagram(anywidget.AnyWidget):
        """A stage diagram whose stages can be chosen."""

        _esm = _script("diagram.js")
        svg = traitlets.Unicode().tag(sync=True)
        chosen = traitlets.Int(-1).tag(sync=True)

    return WidgetClasses(Flat, Space, Diagram)


def _script(*names: str) -> str:
    return "\n".join((_HERE / name).read_text(encoding="utf-8") for name in names)
