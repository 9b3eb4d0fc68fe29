"""Scenes: arrays of plain shapes, each with the state of the module that it comes from; an array has a row for each shape.

Lengths are in the units of the model. In the plane x grows to the right and y upwards; in space x grows to the right, z
upwards, and y away from the viewer. A scene knows no screen, no palette and no file.
"""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass, field
from typing import TYPE_CHECKING, TypeAlias

from lsys_kit.arrays import np

if TYPE_CHECKING:
    from numpy.typing import NDArray


@dataclass(frozen=True)
class Labels:
    """Short texts at points.

    points
        Shape (n, 2) or (n, 3): where the turtle wrote each.
    texts
        What it wrote.
    states
        The state of the module of each.
    """

    points: NDArray[np.float64]
    texts: tuple[str, ...]
    states: NDArray[np.int64]

    def __len__(self) -> int:
        return len(self.texts)


def no_labels(dimension: int = 2) -> Labels:
    return Labels(np.empty((0, dimension)), (), np.empty(0, np.int64))


Floats: TypeAlias = "NDArray[np.float64]"
Integers: TypeAlias = "NDArray[np.int64]"
Flags: TypeAlias = "NDArray[np.bool_]"
Stroke: TypeAlias = tuple[float, ...]
"""The beginning and the end of a stroke, with 2 or 3 coordinates each, where there is no array of them."""

OWN = -1
"""Stands for the colour that belongs to the symbol of a shape, or the width that belongs to the branch order of a stroke."""


@dataclass(frozen=True)
class Segments:
    """Straight strokes.

    ends
        Shape (n, 4) in the plane: x and y of the start, x and y of the end; (n, 6) in space.
    orders
        The branch order of each, the number of brackets around it.
    states
        The state of the module that drew it.
    widths
        In the model's units; or a single one for all. `OWN` if the turtle has set none.
    colours
        Numbers of colours; or a single one for all. `OWN` if the turtle has set none.
    """

    ends: Floats
    orders: Integers
    states: Integers
    widths: Floats = field(default_factory=lambda: np.array([float(OWN)]))
    colours: Integers = field(default_factory=lambda: np.array([OWN]))

    def __len__(self) -> int:
        return len(self.ends)

    @property
    def points(self) -> Floats:
        """All end points, shape (2n, 2) or (2n, 3)."""
        return self.ends.reshape(-1, self.ends.shape[1] // 2)


@dataclass(frozen=True)
class Cells:
    """Cells of a filament: ellipses in a row.

    centres
        Shape (n, 2).
    sizes
        Shape (n, 2): length along the filament, and width.
    polarities
        -1 for a cell that points left, 1 for one that points right, 0 for one without polarity.
    shades
        0 for a young cell to 1 for an old one.
    states
        The state of the module of each.
    """

    centres: Floats
    sizes: Floats
    polarities: Integers
    shades: Floats
    states: Integers

    def __len__(self) -> int:
        return len(self.centres)

    @property
    def points(self) -> Floats:
        """The corners of their bounding boxes."""
        return np.concatenate([self.centres - self.sizes / 2, self.centres + self.sizes / 2])


@dataclass(frozen=True)
class Walls:
    """Walls between the cells of a filament.

    places
        The position of each along the filament.
    heights
        The width of the wider of the two neighbouring cells.
    ages
        NaN if a wall has no age.
    shades, states
        As of `Cells`.
    """

    places: Floats
    heights: Floats
    ages: Floats
    shades: Floats
    states: Integers

    def __len__(self) -> int:
        return len(self.places)

    @property
    def points(self) -> Floats:
        """Their end points."""
        return np.concatenate([np.column_stack([self.places, side * self.heights / 2]) for side in (-1, 1)])


@dataclass(frozen=True)
class Polygons:
    """Filled outlines: leaves, petals, and what stands in `{ }`.

    points
        Shape (m, 2) or (m, 3): the corners of all, one polygon after another.
    starts
        Shape (n + 1,): the index in `points` of the first corner of each; the last is m.
    states, colours
        As of `Segments`.
    normals
        Shape (m, 3): at each corner of a face of a curved surface the unit normal of the surface, zeros at those of flat
        polygons; shape (0, 3) if all are flat.
    """

    points: Floats
    starts: Integers
    states: Integers
    colours: Integers
    normals: Floats = field(default_factory=lambda: np.empty((0, 3)))

    def __len__(self) -> int:
        return len(self.starts) - 1

    @property
    def smooth(self) -> NDArray[np.bool_]:
        """Shape (n,): whether each is a face of a curved surface."""
        if not len(self.normals):
            return np.zeros(len(self), bool)
        found: NDArray[np.bool_] = np.any(self.normals[self.starts[:-1]], axis=1)
        return found

    def __iter__(self) -> Iterator[Floats]:
        return iter(np.split(self.points, self.starts[1:-1]) if len(self) else [])


@dataclass(frozen=True)
class Discs:
    """Circles, discs and spheres.

    centres
        Shape (n, 2) or (n, 3).
    radii
        Shape (n,).
    kinds
        `CIRCLE`, `DISC` or `SPHERE`; in space a circle and a disc face the viewer.
    states, colours
        As of `Segments`.
    """

    centres: Floats
    radii: Floats
    kinds: Integers
    states: Integers
    colours: Integers

    def __len__(self) -> int:
        return len(self.centres)

    @property
    def points(self) -> Floats:
        """The corners of their bounding boxes."""
        reach = self.radii[:, None]
        return np.concatenate([self.centres - reach, self.centres + reach])


CIRCLE, DISC, SPHERE = range(3)


def no_segments(dimension: int = 2) -> Segments:
    return Segments(np.empty((0, 2 * dimension)), np.empty(0, np.int64), np.empty(0, np.int64))


def no_cells() -> Cells:
    return Cells(np.empty((0, 2)), np.empty((0, 2)), np.empty(0, np.int64), np.empty(0), np.empty(0, np.int64))


def no_walls() -> Walls:
    return Walls(np.empty(0), np.empty(0), np.empty(0), np.empty(0), np.empty(0, np.int64))


def no_polygons(dimension: int = 2) -> Polygons:
    return Polygons(np.empty((0, dimension)), np.zeros(1, np.int64), np.empty(0, np.int64), np.empty(0, np.int64))


def no_discs(dimension: int = 2) -> Discs:
    return Discs(np.empty((0, dimension)), np.empty(0), *(np.empty(0, np.int64) for _ in range(3)))


@dataclass(frozen=True)
class Scene:
    """The shapes of a word, in the plane or in space.

    segments, cells, walls, polygons, discs, labels
        The shapes, and what is written.
    unknown
        The symbols that look like commands and are none, in the order of their first occurrence.
    """

    segments: Segments = field(default_factory=no_segments)
    cells: Cells = field(default_factory=no_cells)
    walls: Walls = field(default_factory=no_walls)
    polygons: Polygons = field(default_factory=no_polygons)
    discs: Discs = field(default_factory=no_discs)
    labels: Labels = field(default_factory=no_labels)
    unknown: tuple[str, ...] = ()

    @property
    def _shapes(self) -> dict[str, Segments | Cells | Walls | Polygons | Discs | Labels]:
        return {name: getattr(self, name) for name in ("segments", "cells", "walls", "polygons", "discs", "labels")}

    @property
    def dimension(self) -> int:
        """2 in the plane, 3 in space."""
        return int(self.segments.ends.shape[1]) // 2

    @property
    def size(self) -> int:
        """How many shapes there are to draw, with each corner of a polygon."""
        others = len(self.segments) + len(self.cells) + len(self.walls) + len(self.discs) + len(self.labels)
        return others + len(self.polygons.points)

    @property
    def corners(self) -> tuple[Floats, Floats]:
        """The bounding box: the least and the greatest of each coordinate; zeros for an empty scene."""
        found = [each.points for each in self._shapes.values() if len(each)] or [np.zeros((1, self.dimension))]
        axes = range(self.dimension)  # column by column, which is ten times as fast
        return (
            np.array([min(points[:, axis].min() for points in found) for axis in axes]),
            np.array([max(points[:, axis].max() for points in found) for axis in axes]),
        )

    @property
    def box(self) -> tuple[float, float, float, float]:
        """Least x, least y, greatest x, greatest y in the plane of the picture; zeros for an empty scene."""
        least, greatest = self.corners
        up = self.dimension - 1  # y in the plane, z in space
        return float(least[0]), float(least[up]), float(greatest[0]), float(greatest[up])

    @property
    def width(self) -> float:
        """The extent in x, in the units of the model."""
        left, _, right, _ = self.box
        return right - left

    @property
    def height(self) -> float:
        """The extent from the lowest point to the highest, in the units of the model."""
        _, bottom, _, top = self.box
        return top - bottom

    @property
    def measures(self) -> str:
        """Its width and height, and its depth in space, in words."""
        least, greatest = self.corners
        depth = f", depth {_two_decimals(float(greatest[1] - least[1]))}" if self.dimension == 3 else ""
        return f"width {_two_decimals(self.width)}, height {_two_decimals(self.height)}{depth}"

    def __str__(self) -> str:
        """The scene in words: the line that replaces a picture where none can be shown."""
        counted = [
            f"{len(each):,} {name[: -1 if len(each) == 1 else None]}" for name, each in self._shapes.items() if len(each)
        ]
        return f"{', '.join(counted) or 'nothing to draw'}, {self.measures}"


def _two_decimals(length: float) -> str:
    """A length with at most two decimals, in which rounding errors do not show."""
    return f"{length + 1e-9:.2f}".rstrip("0").rstrip(".")
