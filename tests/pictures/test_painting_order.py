"""What is nearer covers what is farther, in every format. (The canvas in the browser: see tests of the painter.)"""

from __future__ import annotations

import cProfile
import io
import pstats
import re
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from matplotlib.figure import Figure
from PIL import Image

from lsys_kit import derive, draw, figure, read
from lsys_kit.geometry.scene import DISC, OWN, Discs, Polygons, Scene, Segments
from lsys_kit.pictures.display_list import Faces, Strokes, display_list, frame_of
from lsys_kit.pictures.formats.axes import plot_turtle
from lsys_kit.pictures.formats.raster import turtle_image
from lsys_kit.pictures.style.palette import CHOSEN, tinted
from lsys_kit.pictures.svg import turtle_svg
from lsys_kit.pictures.view import project

POINT = st.tuples(*[st.integers(-6, 6)] * 3)
COLOUR, WIDTH = st.integers(0, 15), st.sampled_from([OWN, 0.5, 1, 2])


def built(strokes, faces, rounds):
    """A scene in space of strokes with widths and colours, triangles with colours, and spheres with radii and colours."""
    def column(rows, at, kind=np.int64):
        return np.array([row[at] for row in rows], kind)

    ends = np.array([(*row[0], *row[1]) for row in strokes], float).reshape(-1, 6)
    corners = np.array([row[:3] for row in faces], float).reshape(-1, 3)
    zeros = [np.zeros(len(rows), np.int64) for rows in (strokes, faces, rounds)]
    return Scene(Segments(ends, zeros[0], zeros[0], column(strokes, 2, float), column(strokes, 3)),
                 polygons=Polygons(corners, np.arange(len(faces) + 1) * 3, zeros[1], column(faces, 3)),
                 discs=Discs(column(rounds, 0, float).reshape(-1, 3), column(rounds, 1, float), zeros[2] + DISC, zeros[2],
                             column(rounds, 2)))


SCENES = st.builds(built, st.lists(st.tuples(POINT, POINT, WIDTH, COLOUR), min_size=1, max_size=8),
                   st.lists(st.tuples(POINT, POINT, POINT, COLOUR), max_size=6),
                   st.lists(st.tuples(POINT, st.integers(1, 4), COLOUR), max_size=6))
SIDES = st.tuples(st.sampled_from([0, 90, 30, -145]), st.sampled_from([0, 90, 20, -60]))


def painted(scene, scale=20.0):
    """The shapes of a projected scene in the order of painting: their kinds and numbers."""
    return [(type(run).__name__, number) for run in display_list(scene, scale, {}) for number in run.numbers.tolist()]


def depth(scene, kind, number, towards):
    """How near the middle of a shape is."""
    middle = {"Strokes": lambda: scene.segments.points.reshape(-1, 2, 3)[number].mean(axis=0),
              "Faces": lambda: list(scene.polygons)[number].mean(axis=0), "Rounds": lambda: scene.discs.centres[number]}
    return float(middle[kind]() @ towards)


@given(SCENES, SIDES)
def test_what_is_nearer_is_painted_later(scene, side):
    around, above = np.radians(side)
    towards = np.array([np.sin(around) * np.cos(above), -np.cos(around) * np.cos(above), np.sin(above)])
    order = painted(project(scene, *side))
    assert len(order) == len(set(order)) == len(scene.segments) + len(scene.polygons) + len(scene.discs)
    depths = [depth(scene, kind, number, towards) for kind, number in order]
    assert all(one < other + 1e-3 for place, one in enumerate(depths) for other in depths[place:])


@given(SCENES)
def test_svg_has_the_shapes_in_the_order_in_which_they_are_painted(scene):
    flat = project(scene)
    frame = frame_of(flat.box)
    svg = turtle_svg(flat, frame, {})
    points = frame.points(flat.segments.ends).tolist()
    centres = frame.points(flat.discs.centres).tolist()
    corners = [frame.points(each).tolist() for each in flat.polygons]
    written = {"Strokes": lambda n: "M{} {}L{} {}".format(*points[n]),
               "Rounds": lambda n: 'cx="{}" cy="{}"'.format(*centres[n]),
               "Faces": lambda n: " ".join(map("{0[0]},{0[1]}".format, corners[n]))}
    found = re.findall(r'M\S+ \S+?L\S+ -?\d+|cx="\S+" cy="\S+"|(?<=points=")[^"]*', svg)
    assert found == [written[kind](number) for kind, number in painted(flat, frame.scale)]


@given(SCENES)
def test_a_figure_has_the_shapes_in_the_order_in_which_they_are_painted(scene):
    ax, flat = Figure().add_subplot(), project(scene)
    plot_turtle(ax, flat, {})
    paths = ax.collections[0].get_paths()
    expected = {"Strokes": 2, "Faces": 4, "Rounds": 26}
    assert [len(path.vertices) for path in paths] == [expected[kind] for kind, _ in painted(flat)]


@pytest.mark.slow
@settings(max_examples=25)
@given(SCENES)
def test_each_point_of_a_png_has_the_colour_of_what_is_painted_there_last(scene):
    flat = project(scene)
    frame = frame_of(flat.box)
    image = np.array(turtle_image(flat, {}, frame))
    rows, columns = (np.arange(3, size - 3, 7) for size in image.shape[:2])
    seen, sure = np.full((len(rows), len(columns)), -1), np.ones((len(rows), len(columns)), bool)
    places = np.stack(np.meshgrid(columns + 0.5, rows + 0.5), axis=-1)
    colours = []
    for run in display_list(flat, frame.scale, {}):
        for number in run.numbers.tolist():
            inside = within(flat, frame, run, number, places)
            seen[inside > 2] = len(colours)
            sure &= np.abs(inside) > 2
            colours.append(run.colour if isinstance(run, Strokes) else tinted(CHOSEN[
                (flat.polygons if isinstance(run, Faces) else flat.discs).colours[number]], 0.7))
    expected = np.array([tuple(bytes.fromhex(colour[1:])) for colour in [*colours, "#ffffff"]])[seen]
    assert (image[np.ix_(rows, columns)] == expected)[sure].all()


def within(scene, frame, run, number, places):
    """How many pixels far places lie inside a shape; negative outside."""
    if isinstance(run, Faces):
        a, b, c = frame.points(list(scene.polygons)[number]) / 10
        turn = np.sign((b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]))
        edges = [turn * ((q[0] - p[0]) * (places[..., 1] - p[1]) - (q[1] - p[1]) * (places[..., 0] - p[0])) / np.hypot(*(q - p))
                 if (q != p).any() else np.zeros(places.shape[:2]) for p, q in ((a, b), (b, c), (c, a))]
        least = np.min(edges, axis=0)
        return np.where(least < 0, -distance(places, (a, b, c, a)), least) if turn else -distance(places, (a, b, c, a))
    if isinstance(run, Strokes):
        return run.width / 20 - distance(places, frame.points(scene.segments.ends[number]).reshape(2, 2) / 10)
    centre = frame.points(scene.discs.centres[number]) / 10
    return scene.discs.radii[number] * frame.scale - np.hypot(*np.moveaxis(places - centre, -1, 0))


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
    picture = draw(derive(read(f"axiom: {far + near if far_first else near + far}"), 0))
    near_one = tuple(bytes.fromhex(tinted(CHOSEN[2], 0.7)[1:]))
    image = Image.open(io.BytesIO(picture.png))
    assert image.getpixel((image.width // 2, image.height // 2)) == near_one
    assert re.findall(r'<circle [^>]*fill="([^"]*)"', picture.svg)[-1] == tinted(CHOSEN[2], 0.7)
    assert figure(picture).collections[0].get_facecolors()[-1][:3] == pytest.approx(np.array(near_one) / 255)


def test_ten_times_as_many_strokes_of_changing_looks_are_painted_with_hardly_more_calls():
    def calls(strokes):
        points = [(0, depth, 0) for depth in range(strokes)]
        scene = project(built([(point, (1, *point[1:]), 0.01 + point[1] % 2 / 100, point[1] % 3) for point in points], [], []))
        frame, profile = frame_of(scene.box), cProfile.Profile()
        profile.runcall(turtle_image, scene, {}, frame)
        return pstats.Stats(profile).total_calls

    calls(1)  # imports what paints
    assert calls(2_000) < 1.5 * calls(200)


def test_where_nothing_is_drawn_in_space_the_picture_is_empty():
    picture = draw(read("axiom: A&"), 0)
    assert picture.scene.order.tolist() == []
    assert "<path" not in picture.svg
    assert Image.open(io.BytesIO(picture.png)).convert("L").getextrema() == (255, 255)
    assert len(figure(picture).collections[0].get_paths()) == 0
