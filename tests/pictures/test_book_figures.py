"""The figures of The Algorithmic Beauty of Plants, as the gallery draws them: looked at, and measured by a turtle of their own.

The pictures are in the folder `golden/book`. After a change that is meant, they are written anew by
`pytest tests/pictures/test_book_figures.py --renew-pictures`: look at each one before it is committed. Where the book shows a
step of many thousand strokes, an earlier step stands here, that of `notebooks/gallery.ipynb`.
"""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping
from itertools import pairwise
from pathlib import Path
from types import MappingProxyType
from typing import Any
from xml.etree import ElementTree

import nbformat
import numpy as np
import pytest
from scipy.spatial.transform import Rotation

from lsys_kit import book_systems, derive, draw, read, system, write
from lsys_kit.classroom.catalogue import entry
from lsys_kit.derivation.core.words import Word
from lsys_kit.geometry.scene import Scene
from lsys_kit.pictures.picture import Picture
from tests.notebooks.rebuild import ROOT
from tests.pictures.test_seed_figures import GOLDEN, alike

GALLERY = nbformat.read(ROOT / "notebooks" / "gallery.ipynb", as_version=4)
CODE = "\n".join(cell.source for cell in GALLERY.cells if cell.cell_type == "code")
STEPS: Mapping[str, int | None] = {
    id: int(steps) if steps else None
    for id, steps in re.findall(r'^draw\(system\("(ABOP[^"]+)"\)(?:, (\d+))?(?:, light=True.*)?\)$', CODE, re.M)
}
"""The figures that the gallery shows, and how many steps of each, where these are not those of the book."""

PLACES = {"3-mycelis": "3.3.3", "4-sunflower": "4.1", "4-cylinder": "4.2", "4-spike": "4.2"}
"""The sections of listings that have no figure of their own."""

every_figure = pytest.mark.parametrize("id", STEPS)


def drawn(id: str) -> Picture:
    picture = draw(system(id), STEPS[id])
    assert isinstance(picture, Picture)
    return picture


# --- the gallery and the catalogue -------------------------------------------------------------------------------------------


def test_the_gallery_shows_every_figure_of_the_catalogue() -> None:
    assert sorted(STEPS) == sorted(book_systems())


def test_no_figure_of_the_gallery_has_more_steps_than_in_the_book() -> None:
    assert [id for id, steps in STEPS.items() if steps and steps >= (system(id).steps or 0)] == []


@every_figure
def test_a_figure_says_where_it_stands(id: str) -> None:
    found = entry(id)
    number = id.removeprefix("ABOP-")
    place = re.sub(r"([a-f])$", r" \1", PLACES.get(number, number))
    assert found.work == "ABOP"
    assert re.search(rf"\(1990\), (figure {place}\b.*(page|section) \d+|section {place}$)", found.source)
    assert found.status in ("as printed", "memory")


@every_figure
def test_what_is_written_of_a_figure_reads_back(id: str) -> None:
    assert read(write(system(id))) == system(id)


@pytest.mark.parametrize("path", sorted((ROOT / "tests" / "listings" / "abop").glob("*.txt")), ids=lambda path: path.stem)
def test_a_listing_as_printed_is_in_the_catalogue(path: Path) -> None:
    """But for the tropism of figure 2.8, for which the listing has no symbol."""
    printed, number = read(path.read_text("utf-8")), path.stem.partition("-")[0]
    id = {"2.6": "ABOP-2.6a", "2.8": "ABOP-2.8a"}.get(number, f"ABOP-{number}")
    assert printed.productions == system(id).productions
    assert printed.axiom == system(id).axiom[number == "2.8" :]
    assert (printed.steps, printed.angle, printed.constants) == (system(id).steps, system(id).angle, system(id).constants)


def test_no_cell_of_the_gallery_needs_more_than_a_line_and_public_names() -> None:
    assert all(len(cell.source.splitlines()) == 1 for cell in GALLERY.cells if cell.cell_type == "code")


def test_what_is_seen_is_said_above_each_picture() -> None:
    for before, cell in pairwise(GALLERY.cells):
        if cell.cell_type == "code":
            assert before.cell_type == "markdown" or before.source.startswith("from lsys_kit")
            assert cell.source.startswith("from lsys_kit") or len(before.source) > 20


# --- the pictures ------------------------------------------------------------------------------------------------------------


def test_every_golden_picture_of_the_book_belongs_to_a_figure() -> None:
    assert {path.stem for path in (GOLDEN / "book").glob("*.svg")} == STEPS.keys()


@pytest.mark.slow
@every_figure
def test_a_figure_of_the_book_is_drawn_as_it_was(id: str, request: pytest.FixtureRequest) -> None:
    path, svg = GOLDEN / "book" / f"{id}.svg", drawn(id).svg
    if request.config.getoption("--renew-pictures"):
        path.write_text(f"{svg}\n", encoding="utf-8")
    ElementTree.fromstring(svg)
    assert alike(svg, path.read_text(encoding="utf-8").rstrip("\n")), f"{id} looks different now"


# --- a turtle of their own (The Algorithmic Beauty of Plants, sections 1.3, 1.5, 2.1 and 2.3.2) ------------------------------

ROTATIONS: Mapping[str, tuple[int, int]] = {"+": (2, 1), "-": (2, -1), "&": (1, 1), "^": (1, -1), "\\": (0, -1), "/": (0, 1)}
"""About which axis a command turns, heading, left or up, and in which sense."""
UPWARDS = np.array([0.0, 1.0, 0.0])


class PlainTurtle:
    """A point and a frame of three rows H, L, U; y points up and z towards the viewer, as in the book."""

    def __init__(self, angle: float) -> None:
        self.angle, self.at = angle, np.zeros(3)
        self.frame = np.array([UPWARDS, [-1.0, 0.0, 0.0], [0.0, 0.0, 1.0]])
        self.pull, self.stack = np.zeros(3), list[Any]()
        self.strokes, self.places = list[Any](), list[Any]()

    def rotate(self, axis: np.ndarray, degrees: float) -> None:
        self.frame = Rotation.from_rotvec(np.radians(degrees) * axis).apply(self.frame)

    def do(self, symbol: str, values: list[float]) -> None:
        if symbol.startswith("F") or symbol in ("f", "G"):
            start, self.at = self.at, self.at + (values[0] if values else 1.0) * self.frame[0]
            if symbol != "f":
                self.strokes.append([start, self.at])
                self.rotate(np.cross(self.frame[0], self.pull), np.degrees(1.0))
        elif symbol in ROTATIONS:
            axis, sense = ROTATIONS[symbol]
            self.rotate(self.frame[axis], sense * (values[0] if values else self.angle))
        elif symbol in OTHERS:
            OTHERS[symbol](self, values)


def level(turtle: PlainTurtle, _: list[float]) -> None:
    left = np.cross(UPWARDS, turtle.frame[0])
    if np.linalg.norm(left) > 1e-12:
        left /= np.linalg.norm(left)
        turtle.frame = np.array([turtle.frame[0], left, np.cross(turtle.frame[0], left)])


def push(turtle: PlainTurtle, _: list[float]) -> None:
    turtle.stack.append((turtle.at, turtle.frame, turtle.pull))


def pop(turtle: PlainTurtle, _: list[float]) -> None:
    turtle.at, turtle.frame, turtle.pull = turtle.stack.pop()


def pull(turtle: PlainTurtle, values: list[float]) -> None:
    turtle.pull = values[1] * np.array(values[2:])


OTHERS: Mapping[str, Callable[[PlainTurtle, list[float]], None]] = {
    "[": push,
    "]": pop,
    "$": level,
    "@Ts": pull,
    "|": lambda turtle, _: turtle.rotate(turtle.frame[2], 180.0),
    **dict.fromkeys("DSR", lambda turtle, _: turtle.places.append(turtle.at)),
}
"""The other commands that the listings have; D, S and R are the florets of chapter 4."""
DRAWN_AS: Mapping[str, Mapping[str, str]] = {"ABOP-5.9": {"X": "&"}, "ABOP-3-mycelis": {"G": ""}}
"""Symbols that turn as a command does, or are not drawn."""


def walked(word: Word, angle: float, drawn_as: Mapping[str, str] = MappingProxyType({})) -> PlainTurtle:
    turtle = PlainTurtle(angle)
    for module in word:
        turtle.do(drawn_as.get(module.symbol, module.symbol), [float(value) for value in module.arguments])
    return turtle


def in_the_scene(points: list[Any], scene: Scene) -> np.ndarray:
    """Points in the axes of a scene: in the plane x and y, in space z up and y away from the viewer."""
    places = np.array(points).reshape(-1, 3)
    return places[:, :2] if scene.dimension == 2 else places[:, [0, 2, 1]] * [1.0, -1.0, 1.0]


@pytest.mark.slow
@every_figure
def test_a_plain_turtle_draws_the_same_figure_of_the_book(id: str) -> None:
    picture, word = drawn(id), derive(system(id), STEPS[id] or system(id).steps)[-1]
    scene = picture.scene if picture.solid is None else picture.solid
    turtle = walked(word, float(system(id).angle), DRAWN_AS.get(id, {}))
    expected = in_the_scene(turtle.strokes, scene)
    assert len(scene.segments) == len(turtle.strokes)
    assert np.allclose(scene.segments.points, expected, rtol=0, atol=1e-9 * max(1.0, np.abs(expected).max(initial=0.0)))
    if len(scene.discs):
        expected = in_the_scene(turtle.places, scene)
        assert np.allclose(scene.discs.centres, expected, rtol=0, atol=1e-9 * np.abs(expected).max())


# --- what geometry says of them ----------------------------------------------------------------------------------------------


def corners(id: str, steps: int | None = None) -> np.ndarray:
    """The corners of a line without branches or gaps, from its start on, at the step of the book or another one."""
    found = system(id)
    ends = np.array(walked(derive(found, found.steps if steps is None else steps)[-1], float(found.angle)).strokes)
    assert np.allclose(ends[1:, 0], ends[:-1, 1])
    return np.concatenate([ends[:1, 0], ends[:, 1]])


def different(points: np.ndarray) -> int:
    return len(np.unique(points.round(6) + 0.0, axis=0))


@pytest.mark.slow
@pytest.mark.parametrize("id", ["ABOP-1.6", "ABOP-1.7a", *(f"ABOP-1.9{letter}" for letter in "abcdef")])
def test_an_island_has_a_coast_that_closes(id: str) -> None:
    line = corners(id, 3 if id != "ABOP-1.7a" else 2)
    assert line[0] == pytest.approx(line[-1], abs=1e-6)


@pytest.mark.parametrize("step", range(4))
def test_a_quadratic_koch_island_keeps_its_area(step: int) -> None:
    """Figure 1.6: each dent is as large as a bump, while the sides become a fourth as long."""
    x, y, _ = corners("ABOP-1.6", step).T
    assert abs(x[:-1] @ y[1:] - x[1:] @ y[:-1]) / 2 == pytest.approx(16**step)


@pytest.mark.parametrize(
    ("id", "axiom", "base"),
    [
        ("ABOP-1.6", 4, 8),
        ("ABOP-1.7a", 4, 18),
        ("ABOP-1.7b", 1, 5),
        ("ABOP-1.8", 4, 18),
        ("ABOP-1.10a", 1, 2),
        ("ABOP-1.10b", 1, 3),
        ("ABOP-1.11a", 1, 7),
        ("ABOP-1.11b", 1, 25),
        ("ABOP-1.24a", 1, 5),
        ("ABOP-1.24b", 1, 5),
        ("ABOP-1.24c", 1, 8),
    ],
)
def test_edges_multiply(id: str, axiom: int, base: int) -> None:
    words = derive(system(id), 3)
    assert [sum(module.symbol.startswith("F") for module in word) for word in words] == [axiom * base**n for n in range(4)]


def test_the_dragon_never_draws_an_edge_twice() -> None:
    line = corners("ABOP-1.10a")
    assert different((line[1:] + line[:-1]) / 2) == 2**10


@pytest.mark.parametrize("id", ["ABOP-1.10b", "ABOP-1.11a", "ABOP-1.11b"])
def test_a_curve_that_fills_or_spares_an_area_comes_to_no_point_twice(id: str) -> None:
    line = corners(id)
    assert different(line) == len(line)


def test_the_quadratic_gosper_curve_fills_a_square() -> None:
    line = corners("ABOP-1.11b")
    assert np.ptp(line, axis=0) == pytest.approx([25, 25, 0], abs=1e-6)
    assert len(line) - 1 == 25 * 25


@pytest.mark.parametrize(
    ("id", "side", "width"),
    [
        ("ABOP-1.15", 32, 31),
        ("ABOP-1.16a", 27, 26),
        ("ABOP-1.16b", 16, 15),
        ("ABOP-1.17a", 27, 26),
        ("ABOP-1.17b", 25, 24 * 2**0.5),
    ],
)
def test_a_curve_of_tiles_visits_every_point_of_a_square(id: str, side: int, width: float) -> None:
    line = corners(id)
    assert len(line) == different(line) == side**2
    assert np.ptp(line, axis=0) == pytest.approx([width, width, 0], abs=1e-6), "the last square stands on a corner"


def test_hilberts_curve_in_space_visits_every_point_of_a_cube() -> None:
    line = corners("ABOP-1.19")
    assert len(line) == different(line) == 4**3
    assert np.ptp(line, axis=0) == pytest.approx([3, 3, 3])


@pytest.mark.parametrize(("letter", "divergence"), [("a", 137.3), ("b", 137.5), ("c", 137.6)])
def test_florets_obey_vogels_formula(letter: str, divergence: float) -> None:
    """Equation (4.1): floret n stands at n times the divergence, as far out as the root of n."""
    found, number = draw(system(f"ABOP-4.2{letter}"), 50).scene.discs.centres @ [1, 1j], np.arange(50)
    assert found == pytest.approx(1j * np.sqrt(number) * np.exp(1j * np.radians(divergence * (number + 1))), abs=1e-9)


@pytest.mark.parametrize("id", ["ABOP-2.6a", "ABOP-2.7"])
def test_a_tree_forks_at_every_step(id: str) -> None:
    assert [word.counts()["F"] for word in derive(system(id), 6)] == [2**n - 1 for n in range(7)]


@pytest.mark.parametrize("id", [*(f"ABOP-5.6{letter}" for letter in "abcdef"), "ABOP-5.11b"])
def test_a_leaf_is_the_same_on_both_sides(id: str) -> None:
    points = np.array(walked(derive(system(id), 9)[-1], float(system(id).angle)).strokes).reshape(-1, 3)
    mirrored = points * [-1, 1, 1]
    assert different(np.concatenate([points, mirrored])) == different(points)


@pytest.mark.slow
def test_a_sunflower_has_as_many_seeds_florets_and_petals_as_its_numbers_say() -> None:
    counts = derive(system("ABOP-4-sunflower"), 630)[-1].counts()
    assert [counts[organ] for organ in "SRMNOP"] == [441, 125, 15, 15, 15, 18]


@pytest.mark.parametrize("step", [40, 50, 60, 70])
def test_wall_lettuce_flowers_from_the_top_down(step: int) -> None:
    blooming, depth = list[bool](), 0
    for module in derive(system("ABOP-3-mycelis"), step)[-1]:
        depth += (module.symbol == "[") - (module.symbol == "]")
        if module.symbol == "[" and depth == 1:
            blooming.append(False)
        elif module.symbol == "K" and depth:
            blooming[-1] = True
    assert blooming == sorted(blooming) != [False] * len(blooming)
