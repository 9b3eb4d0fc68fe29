"""Surfaces that a model declares: a polygon or Bezier patches, read and written back."""

from __future__ import annotations

import re
from fractions import Fraction

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from lsys_kit import (
    LSystemError,
    ModelLimitError,
    ModelNameError,
    ModelSyntaxError,
    ModelValueError,
    limits,
    read,
    with_surface,
    write,
)
from lsys_kit.notation.model.modules import Pattern
from lsys_kit.notation.model.surfaces import SurfaceShape
from lsys_kit.notation.model.system import LSystem

ROWS = "\n        ".join(" ".join(f"({row}, {column})" for column in range(4)) for row in range(4))
MODEL = f"""
surface leaf: (0, 0) (0.3, 0.2)
    (1, 0) (1/3, -0.2, 2 * 0.1)
surface Q:
  patch {ROWS}
  patch {ROWS}
axiom: A
A -> F~leaf(2)~Q
"""

coordinates = st.one_of(st.integers(-5, 5), st.fractions(-9, 9, max_denominator=1_000), st.floats(-9, 9))
points = st.tuples(coordinates, coordinates, coordinates)
shapes = st.one_of(
    st.lists(points, min_size=3, max_size=9).map(lambda corners: {"polygon": tuple(corners)}),
    st.lists(st.lists(points, min_size=16, max_size=16).map(tuple), min_size=1, max_size=2).map(
        lambda patches: {"patches": tuple(patches)}
    ),
)


def test_a_polygon_and_patches_are_read() -> None:
    leaf, patches = read(MODEL).surfaces
    assert leaf == SurfaceShape("leaf", ((0, 0, 0), (0.3, 0.2, 0), (1, 0, 0), (Fraction(1, 3), -0.2, 0.2)))
    assert [len(patch) for patch in patches.patches] == [16, 16]
    assert patches.patches[0][7] == (1, 3, 0)


def test_surfaces_are_written_back() -> None:
    text = write(read(MODEL))
    assert text.startswith("surface leaf: (0, 0) (0.3, 0.2) (1, 0) (1/3, -0.2, 0.2)\nsurface Q:\n  patch (0, 0) (0, 1)")
    assert read(text) == read(MODEL)
    assert write(read(text)) == text


@pytest.mark.slow
@settings(max_examples=25)
@given(st.lists(shapes, max_size=2))
def test_what_is_written_reads_back(found: list[dict[str, object]]) -> None:
    system = LSystem(
        (Pattern("A"),), (), surfaces=tuple(SurfaceShape(f"s{number}", **shape) for number, shape in enumerate(found))
    )  # type: ignore[arg-type]
    assert read(write(system)) == system


def test_the_name_of_a_surface_is_no_row_of_letters() -> None:
    system = read("surface ab: (0, 0) (1, 0) (1, 1)\naxiom: a b\na -> ~ab")
    assert [str(module) for module in system.productions[0].successor] == ["~", "ab"]


def test_an_indented_model_has_surfaces_too() -> None:
    assert (
        len(
            read("""
        axiom: A
        surface leaf: (0, 0) (1, 0) (1, 1)
        A -> ~leaf""").surfaces
        )
        == 1
    )


@pytest.mark.parametrize(
    ("line", "message", "quoted", "error"),
    [
        ("surface leaf: (0,0) (1,0)", "A polygon has at least three corners", "surface leaf:", ModelSyntaxError),
        ("surface leaf: patch (0,0) (1,2)", "A patch has 16 control points, not 2", "patch", ModelSyntaxError),
        ("surface leaf: (0,0) (1,0) (n,1)", 'The name "n" cannot be used here', "n", ModelNameError),
        ("surface leaf: (0,0) (1,0) (1<2,1)", '"1 < 2" is true or false, but a number is needed here', "1<2", ModelValueError),
        ("surface leaf: (0,0) (1e9+1,1) (2,0)", "This point is too far away", "1e9+1,1", ModelValueError),
        (
            "surface leaf: (0,0) (1,1) (2,0)\nsurface leaf: (0,0) (1,1) (2,0)",
            'The surface "leaf" is declared twice',
            "surface leaf:",
            ModelNameError,
        ),
        ("surface: (0,0) (1,1) (2,0)", "A surface needs a name and a colon", "surface", ModelSyntaxError),
        ("surface leaf (0,0) (1,1) (2,0)", "A surface needs a name and a colon", "surface", ModelSyntaxError),
        ("surface leaf: leaf.s", "A model opens no files", "leaf.s", ModelSyntaxError),
        ("surface leaf:", 'There is nothing after "surface leaf:"', "surface leaf:", ModelSyntaxError),
        ("surface leaf: (0) (1,0) (1,1)", "This is no point of a surface", "(0", ModelSyntaxError),
        ("surface leaf: (0,0), (1,1), (2,0)", 'I did not expect "," here', ",", ModelSyntaxError),
        ("surface leaf: round", 'I did not expect "round" here', "round", ModelSyntaxError),
    ],
)
def test_what_is_wrong_with_a_surface_is_said(line: str, message: str, quoted: str, error: type[LSystemError]) -> None:
    text = f"n = 3\naxiom: A\n{line}\nA -> F ~leaf"
    with pytest.raises(error) as caught:
        read(text)
    found = caught.value
    assert found.message == message
    assert text[slice(*found.span or ())] == quoted
    assert found.line == 3 + line.count("\n")
    assert found.hint or "true or false" in message


def test_brackets_that_match_are_not_said_to_be_open() -> None:
    with pytest.raises(ModelSyntaxError, match="A number is typed with a point"):
        read("axiom: A\nsurfaces leaf: (0,0) (1,0) (1,1)")


def test_a_production_for_a_symbol_called_surface_is_no_surface() -> None:
    assert len(read("axiom: surface A\nsurface A -> B").productions) == 1
    with pytest.raises(ModelSyntaxError, match="no condition before the arrow"):
        read("axiom: surface A\nsurface A : -> B")


def test_the_name_of_a_surface_is_no_longer_than_others() -> None:
    with pytest.raises(ModelSyntaxError, match="more than 64 letters"):
        read(f"surface {'a' * 65}: (0, 0) (1, 0) (1, 1)\naxiom: A")
    with limits(line=20), pytest.raises(ModelLimitError):
        read("surface a: (0, 0) (1, 0) (1, 1)\naxiom: A")


@pytest.mark.parametrize("notation", ["cpfg", "grogra", "mathematica", "fractint", "plant-string"])
def test_a_notation_without_surfaces_says_so(notation: str) -> None:
    system = LSystem((Pattern("F"),), (), surfaces=(SurfaceShape("L", ((0, 0, 0), (1, 0, 0), (1, 1, 0))),))
    with pytest.raises(ModelValueError, match=f"The notation {notation} has no"):
        write(system, notation)


FILE = """0 2 0 1 0 0
PRECISION S: 5 T: 5
CONTACT POINT  X: 1 Y: 2 Z: 3
END POINT  X: 1 Y: 4 Z: 3
HEADING  X: 0.00 Y: 2 Z: 0.00
UP  X: 0 Y: 0.5 Z: 1
SIZE: 2.0
patch
TOP COLOR: 248 DIFFUSE: 0.00 BOTTOM COLOR: 248 DIFFUSE: 0.00
AL: ~ A: ~ AR: ~
L: ~ R: ~
BL: ~ B: ~ BR: ~
1 2 3  1 2 3  1 2 3  1 2 3
1 3 3  2 3 3  3 3 3  -1 3 4.5
1 3 3  2 3 3  3 3 3  -1 3 4.5
1 4 3  1 4 3  1 4 3  1 4 3
"""


def test_a_surface_file_of_cpfg_is_taken_into_the_frame_of_the_turtle() -> None:
    """Its contact point is at the turtle, its heading ahead; with y ahead and z up, x is to the right."""
    system = with_surface(read("surface leaf: (0,0) (1,0) (1,1)\naxiom: F ~L"), "L", FILE)
    assert [surface.name for surface in system.surfaces] == ["leaf", "L"]
    patch = system.surfaces[1].patches[0]
    assert patch[0] == patch[3] == (0, 0, 0)
    assert patch[4:8] == ((0.5, 0, 0), (0.5, -0.5, 0), (0.5, -1, 0), (0.5, 1, 0.75))
    assert read(write(system)) == system
    assert with_surface(system, "L", FILE + FILE).surfaces[1].patches == (patch, patch)


@pytest.mark.parametrize(
    ("old", "new", "message", "line"),
    [
        ("CONTACT POINT  X: 1", "CONTACT POINT  X:", 'There is no line "CONTACT POINT"', None),
        ("SIZE: 2.0", "SIZE: -1", 'There is no line "SIZE:" with a positive number', 7),
        ("SIZE: 2.0", "", 'There is no line "SIZE:" with a positive number', None),
        ("X: 0 Y: 0.5 Z: 1", "X: 0 Y: 0.5 Z: 0", "This direction cannot be used", 6),
        ("X: 0.00 Y: 2", "X: 0.00 Y: 0", "This direction cannot be used", 5),
        ("1 4 3  1 4 3  1 4 3  1 4 3", "1 4 3", "A patch has four lines of four points, and here are 3", None),
    ],
)
def test_what_is_wrong_with_a_surface_file_is_said(old: str, new: str, message: str, line: int | None) -> None:
    with pytest.raises(ModelSyntaxError, match=re.escape(message)) as caught:
        with_surface(LSystem((), ()), "L", FILE.replace(old, new))
    assert caught.value.line == line


def test_a_surface_file_may_have_the_line_ends_of_windows() -> None:
    found, wanted = (with_surface(read("axiom: F ~L"), "L", text) for text in (FILE.replace("\n", "\r\n"), FILE))
    assert found == wanted


@pytest.mark.parametrize(
    ("old", "new"),
    [
        ("SIZE: 2.0", "SIZE: 1e-12"),
        ("1 4 3  1 4 3  1 4 3  1 4 3", "1 4 3  1 4 3  1 4 3  1 4 1e12"),
        ("CONTACT POINT  X: 1", f"CONTACT POINT  X: {'9' * 400}"),
    ],
)
def test_a_surface_is_not_so_large_that_it_cannot_be_written(old: str, new: str) -> None:
    with pytest.raises(ModelValueError, match="A control point is too far away"):
        with_surface(LSystem((), ()), "L", FILE.replace(old, new))


def test_what_is_no_name_and_no_text_of_a_surface_is_refused() -> None:
    with pytest.raises(ModelValueError, match="A surface is called by a name"):
        with_surface(LSystem((), ()), "../leaf.s", FILE)
    with limits(text=9), pytest.raises(ModelLimitError, match="The text has"):
        with_surface(LSystem((), ()), "L", FILE)


def test_a_surface_that_a_view_names_is_noted_and_its_file_is_not_opened() -> None:
    text = "Lsystem: 1\nsurface: l leaf.s 1.5  // a comment\nAxiom: F~l(2)\nendlsystem"
    system = read(text)
    assert 'The surface "~l" is in the file "leaf.s", which a model does not open' in " ".join(system.notes)
    assert [str(module) for module in system.axiom] == ["F", "~", "l(2)"]
    assert with_surface(system, "l", FILE).surfaces[0].name == "l"
    with pytest.raises(ModelSyntaxError, match="A surface has a symbol and a file"):
        read(text.replace("l leaf.s 1.5", "l"))
