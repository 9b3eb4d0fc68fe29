"""Paths of SVG: in a plain form, of moves, straight lines, cubic curves and closing lines alone; and as corners.

Source: Scalable Vector Graphics (SVG) 2, chapter 9.3.
"""

from __future__ import annotations

import math
import re
from collections.abc import Iterator, Sequence
from typing import NamedTuple

import numpy as np

from lsys_kit.geometry.scene import Floats
from lsys_kit.pictures.formats.vector.shapes import Point

ARC = 0.5522847498
"""How far the controls of a quarter of a circle lie along its tangents, to the radius."""
LEAST_PIECES = 3
"""A curve has so many straight pieces at least, and as many as the square root of its length: then none is seen."""
_OTHER = re.compile(r"[^MLZ\d.\- ]")
_COMMAND = re.compile(r"([MLHVQCZmlhvqcz])([^MLHVQCZmlhvqcz]*)")
_SIZES = {"M": 2, "L": 2, "H": 1, "V": 1, "Q": 4, "C": 6}


class Subpath(NamedTuple):
    """A line through corners, and whether it is closed."""

    corners: Floats
    closed: bool


def plain(data: str) -> str:
    """A path in the plain form: absolute, each command with its own letter.

    >>> plain("M0 0h10v5z"), plain("M0 0Q30 0 30 30")
    ('M0 0L10 0L10 5Z', 'M0 0C20 0 30 10 30 30')
    """
    return "".join(_plain_commands(data)) if _OTHER.search(data) else data


def _plain_commands(data: str) -> Iterator[str]:
    here, start = (0.0, 0.0), (0.0, 0.0)
    for letter, written in _COMMAND.findall(data):
        command, numbers = letter.upper(), [float(number) for number in written.replace(",", " ").split()]
        if command == "Z":
            here = start
            yield "Z"
            continue
        size = _SIZES[command]
        for first in range(0, len(numbers), size):
            points = _points(command, numbers[first : first + size], here, here if letter.islower() else (0.0, 0.0))
            if command == "M":
                start, command = points[-1], "L"
                yield "M" + _written(points)
            else:
                yield (
                    ("C" + _written(_raised(here, *points)))
                    if command == "Q"
                    else ("C" if command == "C" else "L") + _written(points)
                )
            here = points[-1]


def _points(command: str, numbers: Sequence[float], here: Point, origin: Point) -> list[Point]:
    """The points of a command."""
    if command == "H":
        return [(origin[0] + numbers[0], here[1])]
    if command == "V":
        return [(here[0], origin[1] + numbers[0])]
    return [(origin[0] + x, origin[1] + y) for x, y in zip(numbers[::2], numbers[1::2], strict=True)]


def _raised(start: Point, control: Point, end: Point) -> list[Point]:
    """A quadratic curve as a cubic one."""
    first, second = (((edge[0] + 2 * control[0]) / 3, (edge[1] + 2 * control[1]) / 3) for edge in (start, end))
    return [first, second, end]


def _written(points: Sequence[Point]) -> str:
    return " ".join(f"{x:.7g} {y:.7g}" for x, y in points)


def rectangle(x: float, y: float, width: float, height: float, corner: float = 0.0) -> str:
    """A rectangle, perhaps with round corners, in the plain form.

    >>> rectangle(0, 0, 20, 10)
    'M0 0L20 0L20 10L0 10Z'
    """
    across, up = min(corner, width / 2), min(corner, height / 2)
    if not across:
        return (
            f"M{_written([(x, y)])}L{_written([(x + width, y)])}L{_written([(x + width, y + height)])}"
            f"L{_written([(x, y + height)])}Z"
        )
    quarters = [
        ((x + width - across, y + up), (0, -1), (1, 0)),
        ((x + width - across, y + height - up), (1, 0), (0, 1)),
        ((x + across, y + height - up), (0, 1), (-1, 0)),
        ((x + across, y + up), (-1, 0), (0, -1)),
    ]
    return _of_quarters(quarters, across, up)


def ellipse(x: float, y: float, across: float, up: float) -> str:
    """An ellipse in the plain form, of four curves.

    >>> ellipse(0, 0, 10, 10)[:40]
    'M0 -10L0 -10C5.522847 -10 10 -5.522847 1'
    """
    ways = [(0, -1), (1, 0), (0, 1), (-1, 0), (0, -1)]
    return _of_quarters([((x, y), ways[number], ways[number + 1]) for number in range(4)], across, up)


def _of_quarters(quarters: Sequence[tuple[Point, Point, Point]], across: float, up: float) -> str:
    """Quarters of ellipses, joined by straight lines: each with its centre and the directions to its ends."""
    parts: list[str] = []
    for (x, y), (from_x, from_y), (to_x, to_y) in quarters:
        start = x + across * from_x, y + up * from_y
        controls = [
            (x + across * (from_x + ARC * to_x), y + up * (from_y + ARC * to_y)),
            (x + across * (to_x + ARC * from_x), y + up * (to_y + ARC * from_y)),
            (x + across * to_x, y + up * to_y),
        ]
        parts.append(("L" if parts else f"M{_written([start])}L") + _written([start]) + "C" + _written(controls))
    return "".join(parts) + "Z"


def subpaths(data: str, scale: float = 1.0) -> list[Subpath]:
    """The corners of a path in the plain form, whose curves become straight pieces, given how many points a unit has.

    >>> [(path.corners.tolist(), path.closed) for path in subpaths("M0 0L1 0M2 2L3 3L2 3Z")]
    [([[0.0, 0.0], [1.0, 0.0]], False), ([[2.0, 2.0], [3.0, 3.0], [2.0, 3.0]], True)]
    """
    found: list[Subpath] = []
    for part in data.split("M")[1:]:
        corners: list[Point] = []
        for piece in re.split(r"(?=[CL])", part.rstrip("Z ")):
            numbers = [float(number) for number in piece.lstrip("CL").split()]
            points = [*zip(numbers[::2], numbers[1::2], strict=True)]
            corners += _curve([corners[-1], *points], scale) if piece[0] == "C" else points
        found.append(Subpath(np.array(corners), part.rstrip().endswith("Z")))
    return found


def _curve(controls: Sequence[Point], scale: float) -> list[Point]:
    """The corners of a cubic curve behind its start."""
    start, first, second, end = np.array(controls)
    length = float(np.hypot(*np.diff(controls, axis=0).T).sum()) * scale
    shares = np.linspace(0, 1, max(LEAST_PIECES, math.ceil(length**0.5)) + 1)[1:, None]
    rest = 1 - shares
    points = rest**3 * start + 3 * rest**2 * shares * first + 3 * rest * shares**2 * second + shares**3 * end
    return [*map(tuple, points.tolist())]


def dashed(path: Subpath, dashes: Sequence[float]) -> Iterator[Subpath]:
    """The dashes of a line: a stretch is drawn, the next left out, and so on.

    >>> [part.corners[:, 0].tolist() for part in dashed(Subpath(np.array([[0, 0], [10, 0]]), False), (4, 3))]
    [[0.0, 4.0], [7.0, 10.0]]
    """
    corners = np.vstack([path.corners, path.corners[:1]]) if path.closed else path.corners
    lengths = np.concatenate([[0.0], np.cumsum(np.hypot(*np.diff(corners, axis=0).T))])
    at, number = 0.0, 0
    while at < lengths[-1]:
        end = min(at + max(dashes[number % len(dashes)], 1e-3), lengths[-1])
        if number % 2 == 0:
            inside = lengths[(lengths > at) & (lengths < end)]
            places = np.array([at, *inside, end])
            yield Subpath(np.stack([np.interp(places, lengths, corners[:, axis]) for axis in (0, 1)], axis=1), False)
        at, number = end, number + 1
