"""What is nearer covers what is farther, in every format. (The canvas in the browser: see tests of the painter.)"""

from __future__ import annotations

import cProfile
import io
import pstats
import re
from itertools import pairwise, permutations

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from matplotlib.path import Path
from PIL import Image

from lsys_kit import derive, draw, figure, read
from lsys_kit.geometry.scene import DISC, OWN, Discs, Polygons, Scene, Segments
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.pictures.formats.axes import frame_in, plot_turtle
from lsys_kit.pictures.formats.raster import turtle_image
from lsys_kit.pictures.formats.svg import element
from lsys_kit.pictures.rendering.display_list import AreaRun, LineRun, display_list
from lsys_kit.pictures.rendering.frames import frame_around
from lsys_kit.pictures.rendering.scene_shapes import scene_shapes
from lsys_kit.pictures.rendering.view import FRONT, MOST_CYLINDERS, project
from lsys_kit.pictures.style.palette import PAPER

POINT = st.tuples(*[st.integers(-6, 6)] * 3)
COLOUR, WIDTH = st.integers(0, 15), st.sampled_from([OWN, 0.5, 1, 2])


def built(strokes, faces, rounds):
    """A scene in space of strokes with widths and colours, triangles with colours, and spheres with radii and colours."""

    def column(rows, at, kind=np.int64):
        return np.array([row[at] for row in rows], kind)

    ends = np.array([(*row[0], *row[1]) for row in strokes], float).reshape(-1, 6)
    corners = np.array([row[:3] for row in faces], float).reshape(-1, 3)
    zeros = [np.zeros(len(rows), np.int64) for rows in (strokes, faces, rounds)]
    return Scene(
        Segments(ends, zeros[0], zeros[0], column(strokes, 2, float), column(strokes, 3)),
        polygons=Polygons(corners, np.arange(len(faces) + 1) * 3, zeros[1], column(faces, 3)),
        discs=Discs(
            column(rounds, 0, float).reshape(-1, 3), column(rounds, 1, float), zeros[2] + DISC, zeros[2], column(rounds, 2)
        ),
    )


SCENES = st.builds(
    built,
    st.lists(st.tuples(POINT, POINT, WIDTH, COLOUR), min_size=1, max_size=8),
    st.lists(st.tuples(POINT, POINT, POINT, COLOUR), max_size=6),
    st.lists(st.tuples(POINT, st.integers(1, 4), COLOUR), max_size=6),
)
SIDES = st.tuples(st.sampled_from([0, 90, 30, -145]), st.sampled_from([0, 90, 20, -60]))


def painted(shapes):
    """The shapes of a display list in the order of painting: their kinds and numbers."""
    return [(type(run).__name__, number) for run in shapes for number in run.numbers.tolist()]


@given(SCENES, SIDES)
def test_what_is_nearer_is_painted_later(scene, side):
    around, above = np.radians(side)
    towards = np.array([np.sin(around) * np.cos(above), -np.cos(around) * np.cos(above), np.sin(above)])
    [seen] = project([scene], side)
    middles = [corners.mean(axis=0) for corners in (*scene.polygons, *scene.segments.points.reshape(-1, 2, 3))]
    depths = [float(middle @ towards) for middle in (*middles, *scene.discs.centres)]
    assert sorted(seen.order.tolist()) == [*range(len(depths))]
    in_order = [depths[number] for number in seen.order]
    assert all(one < other + 1e-3 for place, one in enumerate(in_order) for other in in_order[place:])


@given(SCENES, SIDES)
def test_a_casing_hides_what_is_farther_than_its_stroke_is_long(scene, side):
    """What crosses a stroke behind it is interrupted there; what it is joined to is not, and no edge of a polygon has one."""
    [seen] = project([scene], side)
    shapes, strokes = display_list(seen, 20.0, {}), len(scene.segments)
    where = {one: place for place, one in enumerate(painted(shapes))}
    assert {shapes.palette[colour] for colour in shapes.lines.colours[:strokes]} == {PAPER}
    depths, ends = seen.depths[len(scene.polygons) :], scene.segments.points.reshape(-1, 2, 3)
    lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
    sides = {(*one, *other) for a, b, c in map(np.ndarray.tolist, scene.polygons) for one, other in permutations((a, b, c), 2)}
    for number in range(strokes):
        if (*ends[number].ravel().tolist(),) in sides:
            continue
        for face in range(len(scene.polygons)):
            behind = depths[number] - seen.depths[face] - lengths[number]
            if abs(behind) > 1e-3:
                assert (where["LineRun", number] > where["AreaRun", face]) == (behind > 0)


@given(SIDES)
def test_the_casing_of_a_stroke_does_not_part_it_from_the_polygon_whose_edge_it_is(side):
    [seen] = project([trace_in_space(derive(read("axiom: &(70) { . F(2) +(120) F(2) +(120) F(2) } F"), 0)[0])], side)
    shapes = display_list(seen, 20.0, {})
    where = {one: place for place, one in enumerate(painted(shapes))}
    casings = [where["LineRun", number] < where["AreaRun", 0] for number in range(4)]
    assert casings[:3] == [True, True, True]
    assert shapes.palette[shapes.lines.colours[0]] == PAPER


@given(SCENES)
def test_svg_has_the_shapes_in_the_order_in_which_they_are_painted(scene):
    [seen] = project([scene], FRONT)
    frame = frame_around([seen])
    shapes, svg = display_list(seen, frame.scale, {}), "".join(map(element, scene_shapes(seen, frame, {})))
    points = frame.points(shapes.lines.ends).tolist()
    centres = frame.points(shapes.rounds.centres).tolist()
    corners = [frame.points(each).tolist() for each in np.split(shapes.areas.points, shapes.areas.starts[1:-1])]
    written = {
        "LineRun": lambda n: "M{} {}L{} {}".format(*points[n]),
        "RoundRun": lambda n: 'cx="{}" cy="{}"'.format(*centres[n]),
        "AreaRun": lambda n: " ".join(map("{0[0]},{0[1]}".format, corners[n])),
    }
    found = re.findall(r'M\S+ \S+?L\S+ -?\d+|cx="\S+" cy="\S+"|(?<=points=")[^"]*', svg)
    assert found == [written[kind](number) for kind, number in painted(shapes)]


@given(SCENES)
def test_a_figure_has_the_shapes_in_the_order_in_which_they_are_painted(scene):
    ax, [seen] = Figure().add_subplot(), project([scene], FRONT)
    plot_turtle(ax, seen, {})
    shapes = display_list(seen, frame_in(ax, seen).scale, {})
    corners = np.diff(shapes.areas.starts)
    expected = {"LineRun": lambda _: 2, "RoundRun": lambda _: None, "AreaRun": lambda n: corners[n] + 1}
    sizes = [len(path.vertices) for strokes in ax.collections for path in strokes.get_paths()]
    for size, (kind, number) in zip(sizes, painted(shapes), strict=True):
        assert size == expected[kind](number) or (kind == "RoundRun" and size > 12)


@pytest.mark.slow
@settings(max_examples=25)
@given(SCENES)
def test_each_point_of_a_png_has_the_colour_of_what_is_painted_there_last(scene):
    [seen] = project([scene], FRONT)
    frame = frame_around([seen])
    image = np.array(turtle_image(seen, {}, frame))
    rows, columns = (np.arange(3, size - 3, 7) for size in image.shape[:2])
    last, sure = np.full((len(rows), len(columns)), -1), np.ones((len(rows), len(columns)), bool)
    places = np.stack(np.meshgrid(columns + 0.5, rows + 0.5), axis=-1)
    colours, shapes = [], display_list(seen, frame.scale, {})
    for run in shapes:
        for number in run.numbers.tolist():
            inside = within(shapes, frame, run, number, places)
            last[inside > 2] = len(colours)
            sure &= np.abs(inside) > 2
            colours.append(
                run.colour
                if isinstance(run, LineRun)
                else shapes.palette[(shapes.areas if isinstance(run, AreaRun) else shapes.rounds).fills[number]]
            )
    expected = np.array([tuple(bytes.fromhex(colour[1:])) for colour in [*colours, "#ffffff"]])[last]
    assert (image[np.ix_(rows, columns)] == expected)[sure].all()


def within(shapes, frame, run, number, places):
    """How many pixels far places lie inside a shape; negative outside."""
    if isinstance(run, AreaRun):
        corners = frame.points(shapes.areas.points[slice(*shapes.areas.starts[number : number + 2])]) / 10
        inside = Path(np.vstack([corners, corners[:1]])).contains_points(places.reshape(-1, 2)).reshape(places.shape[:2])
        return np.where(inside, 1, -1) * distance(places, [*corners, corners[0]])
    if isinstance(run, LineRun):
        return run.width / 20 - distance(places, frame.points(shapes.lines.ends[number]).reshape(2, 2) / 10)
    centre = frame.points(shapes.rounds.centres[number]) / 10
    return shapes.rounds.radii[number] * frame.scale - np.hypot(*np.moveaxis(places - centre, -1, 0))


def distance(places, corners):
    """How far places are from a line of several parts."""
    found = []
    for p, q in pairwise(corners):
        along = np.clip(((places - p) @ (q - p)) / max((q - p) @ (q - p), 1e-12), 0, 1)
        found.append(np.hypot(*np.moveaxis(places - p - along[..., None] * (q - p), -1, 0)))
    return np.min(found, axis=0)


@pytest.mark.parametrize("far_first", [True, False])
def test_a_far_sphere_does_not_cover_a_near_one(far_first):
    far, near = "[&(90)f(4);(4)@O(3)]", "[^(90)f(4);(2)@O(2)]"  # away from the viewer, towards the viewer
    picture = draw(derive(read(f"axiom: {far + near if far_first else near + far}"), 0), view=FRONT)
    image = Image.open(io.BytesIO(picture.png))
    red, green, blue = image.getpixel((image.width // 2, image.height // 2))
    assert green > max(red, blue)  # as colour 2 is, where colour 4 is red
    *_, last = re.findall(r'<circle [^>]*fill="url\(#lsys-sphere-(\w\w)(\w\w)(\w\w)\)', picture.svg)
    assert last[1] > max(last[0], last[2])
    near_one = figure(picture).collections[-1].get_facecolors()[-1][:3]
    assert near_one[1] > max(near_one[0], near_one[2])


@pytest.mark.slow
def test_of_very_many_strokes_more_are_painted_with_hardly_more_calls():
    def calls(strokes):
        points = [(0, depth, 0) for depth in range(strokes)]
        rows = [(point, (1, *point[1:]), 0.01 + point[1] % 2 / 100, point[1] % 3) for point in points]
        [scene] = project([built(rows, [], [])], FRONT)
        frame, profile = frame_around([scene]), cProfile.Profile()
        profile.runcall(turtle_image, scene, {}, frame)
        return pstats.Stats(profile).total_calls

    calls(1)  # imports what paints
    assert calls(MOST_CYLINDERS + 20_000) < 1.5 * calls(MOST_CYLINDERS + 2_000)


def test_where_nothing_is_drawn_in_space_the_picture_is_empty():
    picture = draw(read("axiom: A&"), 0)
    assert "<path" not in picture.svg
    assert Image.open(io.BytesIO(picture.png)).convert("L").getextrema() == (255, 255)
    assert not figure(picture).collections
