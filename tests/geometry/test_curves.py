"""Generalised cylinders, patches and given headings, beside a plain turtle that follows their definitions."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from lsys_kit import ModelLimitError, derive, draw, limits, read
from lsys_kit.geometry.meshes.mesh import mesh_of
from lsys_kit.geometry.scene import OWN
from lsys_kit.geometry.turtle.commands import in_plane
from lsys_kit.geometry.turtle.space import trace_in_space
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.system import LSystem

NEAR = 1e-9


class PlainTurtle:
    """A turtle whose frame is a matrix with the columns H, L and U; a curve is what de Casteljau's construction gives."""

    def __init__(self):
        self.place, self.frame, self.width = np.zeros(3), np.array([[0.0, -1, 0], [0, 0, -1], [1, 0, 0]]), 0.1
        self.axis, self.stack, self.ends, self.widths, self.points, self.corners = None, [], [], [], {}, []
        self.scale = 1.0

    def obey(self, symbol, *values):
        x = values[0] if values else None
        if symbol in "+-&^\\/":
            axis, way = {"+": (2, 1), "-": (2, -1), "&": (1, 1), "^": (1, -1), "\\": (0, -1), "/": (0, 1)}[symbol]
            degrees = (90 if x is None else x) * way
            self.frame = Rotation.from_rotvec(np.radians(degrees) * self.frame[:, axis]).as_matrix() @ self.frame
        elif symbol == "!":
            self.width = x
        elif symbol in ("@D", "@Di"):
            self.scale = x * (self.scale if symbol == "@Di" else 1)
        elif symbol in "Ff":
            start, self.place = self.place, self.place + self.scale * (1 if x is None else x) * self.frame[:, 0]
            if symbol == "F" and self.axis is None:
                self.ends.append((*start, *self.place))
                self.widths.append(self.scale * self.width)
        elif symbol == "[":
            self.stack.append((self.place, self.frame, self.width, self.axis, self.scale))
            self.axis = None
        elif symbol == "]":
            self.place, self.frame, self.width, self.axis, self.scale = self.stack.pop()
        elif symbol == "@Gs":
            self.axis = self.place, self.frame[:, 0], self.scale * self.width
        elif symbol in ("@Gc", "@Ge") and self.axis is not None:
            self.curve(8 if x is None else x)
            self.axis = None if symbol == "@Ge" else (self.place, self.frame[:, 0], self.scale * self.width)
        elif symbol == "@PC":
            self.points[values] = self.place
        elif symbol == "@PD":
            self.patch(*values)

    def curve(self, parts):
        (first, heading, width), last = self.axis, self.place
        reach = 1.2 * np.linalg.norm(last - first) / 3
        handles = [first, first + reach * heading, last - reach * self.frame[:, 0], last]
        places = [casteljau(handles, number / parts) for number in range(parts + 1)]
        self.ends += [(*start, *end) for start, end in pairwise(places)]
        self.widths += [width + (self.scale * self.width - width) * number / parts for number in range(1, parts + 1)]

    def patch(self, which, along, across):
        rows = [[self.points[which, row, column] for column in range(4)] for row in range(4)]

        def place(s, t):
            return casteljau([casteljau(row, t / across) for row in rows], s / along)

        self.corners += [
            place(i + a, j + b) for i in range(along) for j in range(across) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))
        ]


def casteljau(points, t):
    while len(points) > 1:
        points = [(1 - t) * a + t * b for a, b in pairwise(points)]
    return points[0]


def drawn(modules):
    return trace_in_space(derive(LSystem(tuple(Pattern(s, tuple(map(Number, values))) for s, *values in modules), ()), 0)[0])


def drawn_text(text):
    return trace_in_space(derive(read(f"axiom: {text}"), 0)[0])


turns = st.tuples(st.sampled_from("+-&^\\/"), st.integers(-180, 180))
steps = st.tuples(st.sampled_from("Ff"), st.integers(1, 5))
cylinders = st.sampled_from([("@Gs",), ("@Gc",), ("@Ge",)]) | st.tuples(st.sampled_from(["@Gc", "@Ge"]), st.integers(1, 9))
scales = st.tuples(st.sampled_from(["@D", "@Di"]), st.sampled_from([0.5, 1, 3]))
words = st.lists(turns | steps | cylinders | scales | st.tuples(st.just("!"), st.integers(1, 9)), max_size=20).flatmap(
    lambda word: st.integers(0, len(word)).map(
        lambda at: [("!", 2), ("@Gs",), *word[:at], ("[",), *word[at:], ("]",), ("F", 1), ("@Ge", 3)]
    )
)


@given(words)
def test_cylinders_are_where_a_plain_turtle_has_them(word):
    plain = PlainTurtle()
    for module in word:
        plain.obey(*module)
    scene = drawn(word)
    assert scene.segments.ends == pytest.approx(np.array(plain.ends).reshape(-1, 6), rel=NEAR, abs=NEAR)
    assert scene.segments.widths == pytest.approx(np.array(plain.widths), rel=NEAR)


@settings(max_examples=20)
@given(st.lists(st.lists(turns | steps, max_size=3), min_size=16, max_size=16), *[st.integers(1, 4)] * 2, st.integers(0, 1))
def test_patches_are_where_a_plain_turtle_has_them(ways, along, across, first):
    plain, word = PlainTurtle(), [("@PS", 7)]
    for number, way in enumerate(ways):
        row, column = divmod(number, 4)
        for module in (*way, ("@PC", 7, row, column)):
            plain.obey(*module)
        word += [*way, ("@PC", 7, row + first, column + first)]
    plain.obey("@PD", 7, along, across)
    polygons = drawn([*word, ("@PD", 7, along, across)]).polygons
    assert polygons.points == pytest.approx(np.array(plain.corners), rel=NEAR, abs=NEAR)
    assert len(polygons) == along * across


def test_a_cylinder_without_set_widths_has_those_of_branches():
    assert set(drawn_text("@GsF@Gc(2)!(3)F@Ge(2)").segments.widths) == {OWN}


def test_a_cylinder_that_never_began_is_not_drawn():
    assert len(drawn_text("@Gc@Ge F").segments) == 1


def test_a_branch_of_a_cylinder_has_strokes_of_its_own():
    scene = drawn_text("@GsF[+F]F@Ge(3)")
    assert len(scene.segments) == 1 + 3
    assert scene.segments.orders.tolist() == [1, 0, 0, 0]


def test_a_cylinder_is_one_closed_tube():
    mesh = mesh_of(drawn_text("!(0.4)@GsF(2)+(60)&(40)F(2)!(0.2)@GcF^(60)F!(0.1)@Ge(12)"))
    corners = np.unique(mesh.vertices, axis=0, return_inverse=True)[1].ravel()[mesh.triangles.astype(int)]
    edges = Counter(edge for a, b, c in corners.tolist() for edge in ((a, b), (b, c), (c, a)))
    assert set(edges.values()) == {1}
    assert all((b, a) in edges for a, b in edges), "without a notch"
    assert len(np.unique(corners)) == 8 * (8 + 12 + 1), "eight sides, a ring at each joint"


def test_what_spans_between_points_leaves_the_plane_and_is_flat_in_it():
    system = read("axiom: @GsF+F@Ge")
    assert not in_plane(system)
    assert draw(system, 0).scene.dimension == 2


def test_a_patch_without_all_its_control_points_is_named():
    scene = drawn_text("@PS(1)F@PC(1,0,0)@PD(1)@PC(2,0,0)@PD")
    assert len(scene.polygons) == 0
    assert repr(draw(read("axiom: @PS(1)F@PD(1)"), 0)).endswith("@PD draws a patch whose sixteen control points are set by @PC")


def test_patches_of_many_faces_keep_to_the_limit_of_memory():
    points = "".join(f"@PC(1,{row},{column})f" for row in range(4) for column in range(4))
    with limits(bytes=10**6), pytest.raises(ModelLimitError, match="The patches were not drawn"):
        drawn_text(f"@PS(1){points}" + "@PD(1,30,30)" * 2)


def test_a_heading_is_given_as_cpfg_counts_directions():
    """x to the right, y upwards, z towards the viewer."""
    for text, end in (
        ("@R(1,0,0)F", (1, 0, 0)),
        ("@R(0,0,2)F", (0, -1, 0)),
        ("@R(0,3,0)F", (0, 0, 1)),
        ("@R F", (0, 0, 1)),
        ("@R(1,0,0)+(90)F", (0, 0, 1)),
        ("@R(1,0,0)^(90)F", (0, -1, 0)),
        ("@R(1,0,0,0,1,0)^(90)F", (0, 0, 1)),
        ("@R(0,0,-1)+(90)F", (-1, 0, 0)),
        ("@R(0,0,1,0,0,5)F", (0, -1, 0)),
    ):
        assert drawn_text(text).segments.ends[0, 3:] == pytest.approx(end, abs=NEAR), text
