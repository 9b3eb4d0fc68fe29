"""Map systems as texts: as print has them, as the kit writes them, and what is said of the slips that students make."""

from __future__ import annotations

from collections.abc import Sequence
from contextlib import suppress

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.errors import LSystemError, ModelLimitError, ModelNameError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.dialects.map.dialect import read_map
from lsys_kit.notation.model.cells import Edge, EdgeMarker, EdgeProduction, MapSystem, Marker
from lsys_kit.notation.read import read
from tests.derivation.random_maps import map_systems

MARKER = 'A marker reads "[-A]" or "[+A]": the side of the wall, the letter of a wall to come.'
PRODUCTION = 'A production reads "A -> B[-A][+A]B": a wall, an arrow, the walls that it becomes, with markers between.'
FIRST = 'Give the walls of the first cell, one after another, clockwise, as in "map: ABAB".'
LETTERS = "Walls are letters, perhaps with a digit and an arrow: A, A1, A>."
BETWEEN = 'Markers belong between two parts of a wall, as in "A -> B[-A]B".'
PROPAGATING = "A map is propagating: every wall becomes one wall or several."
SIDES = "Left of the wall is +, right is -, seen in its direction."
POINTS = "A wall points one way, and its arrow comes after its letter: A> or A<."


@given(map_systems())
def test_what_is_written_reads_back(system: MapSystem) -> None:
    assert read_map(str(system)) == system


def test_what_is_read_is_a_record() -> None:
    found = read_map("map: A> B C2<\nsteps: 3\nA> -> B [-A>] [+C2] A<  /* twice */")
    assert found.axiom == (Edge("A", ">"), Edge("B"), Edge("C2", "<"))
    assert found.productions == (
        EdgeProduction(Edge("A", ">"), (Edge("B"), Marker("-", Edge("A", ">")), Marker("+", Edge("C2")), Edge("A", "<"))),
    )
    assert found.steps == 3
    assert str(found) == "map: A>BC2<\nsteps: 3\nA> -> B[-A>][+C2]A<"


def test_a_marker_has_a_short_text() -> None:
    assert Marker("-", Edge("A", ">")).short == "[-A>]"
    marker = EdgeMarker("PQ", Edge("P"), ("PR", "QR"), "PQ")
    assert (marker.short, str(marker.turned)) == ("[PQ: P]", "[PQ: QR|P|PR, PQ]")
    assert marker.turned.halves == marker.halves[::-1]


@pytest.mark.parametrize(
    "text",
    [
        "ω: ABC\np_1 : A → B[-A][+A]B",
        "\\omega = ABC\nA \\rightarrow B[−A][+A]B,",
        "Startwort ABC,\nA ::= B [- A] [+ A] B",
        "axiom: A B C\nA --> B[-A]\n    [+A]B",
        "P = {\n  A -> B[-A][+A]B\n}\nmap: ABC",
        "map:ABC\np1: A->B[-A][+A]B",
        "$\\omega : ABC$\n$A \\to B[-A][+A]B$",
        "```\n**map:** ABC\n1. A -> B[-A][+A]B\n```",
        "$$\\begin{aligned}\n\\omega &: ABC \\\\\np_1 &: A \\rightarrow B[-A][+A]B\n\\end{aligned}$$",
        "\\[\n\\omega: ABC\n\\]\n\\[ A \\longmapsto B[-A][+A]B \\quad (1) \\]",
    ],
)
def test_print_has_many_forms(text: str) -> None:
    assert read_map(text) == read_map("map: ABC\nA -> B[-A][+A]B")


def test_a_mistake_in_a_formula_is_shown_where_it_was_typed() -> None:
    with pytest.raises(ModelSyntaxError) as found:
        read_map("$\\omega : ABAB$\n$p_1 : A \\to B[-A+A]B$")
    assert (found.value.message, found.value.line, found.value.column) == ('This "+" is outside of a marker', 2, 18)


@pytest.mark.parametrize(
    ("right", "left"),
    [
        ("\\overrightarrow{A}", "\\overleftarrow{A}"),
        ("\\vec A", "\\overleftarrow A"),
        ("A\u20d7", "A\u20d6"),
        ("A>", "A<"),
        ("\\vec{ A }", "A  <"),
    ],
)
def test_arrows_stand_over_the_letters_or_behind_them(right: str, left: str) -> None:
    assert read_map(f"map: {right} {left} B").axiom == (Edge("A", ">"), Edge("A", "<"), Edge("B"))


def test_a_map_may_cover_a_sphere() -> None:
    found = read_map("Sphere: D> D<\nD> -> A> B>")
    assert found == MapSystem((Edge("D", ">"), Edge("D", "<")), read_map("map: DDD\nD> -> A> B>").productions, None, True)
    assert str(found) == "sphere: D>D<\nD> -> A>B>"
    assert read_map(str(found)) == found
    with pytest.raises(ModelValueError, match="This is a map system, not an L-system"):
        read(str(found))


UNREADABLE = [
    ("", "There is no first cell", 1, 1, 'Give its walls, one after another, clockwise, as in "map: ABAB".'),
    ("A -> B", "There is no first cell", 1, 7, 'Give its walls, one after another, clockwise, as in "map: ABAB".'),
    ("map:", "The first cell has no walls", 1, 1, FIRST),
    ("axiom", "The first cell has no walls", 1, 1, FIRST),
    ("map ABAB", 'A ":" is missing after "map"', 1, 1, 'Type "map: ABAB".'),
    ("map = ABAB", 'A ":" is missing after "map"', 1, 1, 'Type "map: ABAB".'),
    ("start: ABAB", 'A map system has no "start:"', 1, 1, 'It has "map:", "steps:" and productions.'),
    ("map: A, B, C", 'A "," is not needed here', 1, 7, "Walls are written side by side, with or without blanks between them."),
    ("map: AB[+A]B", "A marker is not possible here", 1, 8, "Markers come after the arrow of a production."),
    ("map: A(2)BC", "A wall has no values", 1, 7, LETTERS),
    ("map: ABC -> D", "An arrow is not possible here", 1, 10, PRODUCTION),
    ("map: ABC\nmap: ABC", "This is a second first cell", 2, 1, "A map begins with one cell."),
    ("map: ABC\nsteps: 2\nsteps: 3", '"steps:" is set a second time', 3, 1, "Keep one of the two lines."),
    ("map: ABC\nsteps: many", 'After "steps:" a whole number is needed', 2, 1, 'Type "steps: 4".'),
    ("map: ABC\nsteps: 1234567890", "This number is too large", 2, 8, None),
    ("map: ABC\nangle: 90", 'A map system has no "angle:"', 2, 1, 'It has "map:", "steps:" and productions.'),
    ("map: ABC\nA B", "An arrow is missing here", 2, 3, PRODUCTION),
    ("map: ABC\nA => B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("map: ABC\nA - > B", "This is not an arrow", 2, 3, 'An arrow is typed "->", in one piece.'),
    ("map: ABC\nA -> B -> C", "This is a second arrow in one production", 2, 8, "Write one production per line."),
    ("-> B", "There is nothing before the arrow", 1, 1, PRODUCTION),
    ("map: ABC\nA ->", "There is nothing after the arrow", 2, 3, "Walls are never erased: write what this one becomes."),
    ("map: ABC\nA -> ε", "A wall cannot be erased", 2, 6, PROPAGATING),
    ("map: ABC\nA -> *", "A wall cannot be erased", 2, 6, PROPAGATING),
    ("map: ABC\nAB -> C", "Only one wall can be replaced", 2, 2, "Maps have no contexts. Write a production for each wall."),
    (
        "map: ABC\nA < B > C -> D",
        "Only one wall can be replaced",
        2,
        5,
        "Maps have no contexts. Write a production for each wall.",
    ),
    ("map: ABC\nA(t) -> B", "A wall has no values", 2, 2, LETTERS),
    ("map: ABC\nA : 1 < 2 -> B", "A wall has no condition", 2, 3, PRODUCTION),
    ("map: ABC\nA_1 -> B", "A letter has no subscript here", 2, 2, "Write the number after the letter, as in A1."),
    ("map: ABC\nA>> -> B", 'This is a second ">"', 2, 3, POINTS),
    ("map: ABC\nA -> > B", 'There is no wall before this ">"', 2, 6, POINTS),
    ("map: ABC\nA -> 1", "A number is not a wall", 2, 6, "Walls are letters, perhaps with a digit after them: A, A1."),
    ("map: ABC\nA -> B; C", 'A ";" is not needed here', 2, 7, "Write one production per line."),
    ("map: ABC\nA -> B[-A", 'This "[" is never closed', 2, 7, MARKER),
    ("map: ABC\nA -> B]B", 'This "]" closes nothing', 2, 7, MARKER),
    ("map: ABC\nA -> B[A]B", "This marker does not say on which side it is", 2, 8, SIDES),
    ("map: ABC\nA -> B[~A]B", "This marker does not say on which side it is", 2, 8, SIDES),
    ("map: ABC\nA -> B[-]B", "This marker has no letter", 2, 9, MARKER),
    ("map: ABC\nA -> B[-AB]B", "A marker has one letter", 2, 10, 'Write a marker for each: "[-A][-B]".'),
    ("map: ABC\nA -> B[+-A]B", "A marker is on one side", 2, 9, 'For both sides write two: "[-A][+A]".'),
    ("map: ABC\nA -> B[[-A]]B", "A marker inside a marker is not possible", 2, 8, MARKER),
    ("map: ABC\nA -> B-A]B", 'This "-" is outside of a marker', 2, 7, MARKER),
    ("map: ABC\n# a cell", "This is not a production", 2, 1, 'A comment is written between "/*" and "*/".'),
    ("map: ABC\n/* a cell", "This comment is never closed", 2, 1, 'A comment ends with "*/".'),
    (
        "map: ABC\n\u0410 -> B",
        'I cannot read the character "А" (CYRILLIC CAPITAL LETTER A)',
        2,
        1,
        "Walls are letters from A to Z.",
    ),
]
SENSELESS = [
    ("map: AB", "The first cell has only 2 walls", 1, 6, 'A cell has three walls or more, as in "map: AAA".'),
    ("map: A>", "The first cell has only 1 wall", 1, 6, 'A cell has three walls or more, as in "map: AAA".'),
    (
        "sphere: D>",
        "The sphere has only 1 wall from pole to pole",
        1,
        9,
        'Two walls or more divide it into cells, as in "sphere: D>D>D>D>".',
    ),
    (
        "map: ABC\nA< -> B",
        "A production is written in the direction of its wall",
        2,
        1,
        'Write "A> -> ...": what becomes of the wall, from its beginning to its end.',
    ),
    (
        "map: ABC\nA -> B\nA -> C",
        "This is a second production for A",
        3,
        1,
        "A wall has at most one production. With an arrow and without, walls are different ones.",
    ),
    ("map: ABC\nA -> [-A]", "Nothing is left of the wall A", 2, 7, "Walls are never erased: write the letter of a wall too."),
    ("map: ABC\nA> -> [-A]B", "This marker is at the end of the wall", 2, 8, BETWEEN),
    ("map: ABC\nA> -> B[-A]", "This marker is at the end of the wall", 2, 9, BETWEEN),
    (
        "map: ABC\nA -> B[-A]C",
        "The neutral wall A would become something else from its other end",
        2,
        6,
        'Read backwards, where left is right, this is "C[+A]B", and a wall without an arrow has no beginning. '
        'Make both the same, or give the wall an arrow: "A> -> ...".',
    ),
]


@pytest.mark.parametrize(
    ("kind", "row"), [*((ModelSyntaxError, row) for row in UNREADABLE), *((ModelValueError, row) for row in SENSELESS)]
)
def test_a_slip_is_explained(kind: type[LSystemError], row: Sequence[object]) -> None:
    text, *expected = row
    with pytest.raises(LSystemError) as caught:
        read_map(str(text))
    error = caught.value
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


@pytest.mark.parametrize(
    "successor", ["B[-A][+A]B", "B[+A][-A]B", "B[-A]x[+A]B", "B>B<", "B<[-C>]x[+C>]B>", "A", "B[-A][-C][+C][+A]B"]
)
def test_a_neutral_wall_becomes_the_same_from_both_ends(successor: str) -> None:
    assert read_map(f"map: AAA\nA -> {successor}").productions


@pytest.mark.parametrize("successor", ["B[-A]B", "B>B>", "BC", "B[-A>][+A<]B", "B[-A]x[-A]B", "B[-A][-C][+A][+C]B"])
def test_a_neutral_wall_that_differs_from_its_ends_is_refused_but_not_one_with_an_arrow(successor: str) -> None:
    with pytest.raises(ModelValueError, match="The neutral wall A would become something else"):
        read_map(f"map: AAA\nA -> {successor}")
    assert read_map(f"map: AAA\nA> -> {successor}").productions


def test_what_can_never_take_part_is_told() -> None:
    assert read_map("map: A>A>A>\nA> -> A>[-B>]A>\nC -> D").notes == (
        "The production C -> D is never used: no wall C occurs.",
        "Markers of B> divide no cell: they need markers of B<, and there are none.",
    )
    assert read_map("map: A>A>A<\nA> -> A>[-B>][-B<][-C]A>\nB> -> A>\nC -> D").notes == ()


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("map: " + "A" * 60_000, "This line has 60,005 characters; the limit is 50,000"),
        ("map: ABC" + "".join(f"\nA{i} -> A" for i in range(1_001)), "The model has more than 1,000 productions"),
        ("map: A" + "1" * 65 + "BC", "This name has more than 64 letters"),
        ("map: ABC" + " " * 1_000_000, "The text has 1,000,008 characters; the limit is 1,000,000"),
    ],
)
def test_what_is_too_long_is_refused(text: str, message: str) -> None:
    with pytest.raises((ModelLimitError, ModelSyntaxError)) as caught:
        read_map(text)
    assert caught.value.message == message


PIECES = [
    "A",
    "B",
    "x1",
    ">",
    "<",
    "[",
    "]",
    "[-",
    "[+A]",
    "->",
    "→",
    "map:",
    "steps:",
    "3",
    "\n",
    " ",
    "ω",
    ":",
    "=",
    ",",
    "ε",
    "\\vec",
    "\\overleftarrow{A}",
    "A\u20d7",
    "{",
    "}",
    "(",
    ")",
    "+",
    "-",
    "−",
    "/*",
    "*/",
    "p_1 :",
    "Startwort",
    "#",
    "_",
    "\u0410",
    "\x00",
]


@given(st.lists(st.sampled_from(PIECES), max_size=14).map("".join))
def test_any_text_is_a_map_system_or_a_slip_that_is_explained(text: str) -> None:
    for whole in (text, f"map: ABC\n{text}", f"map: ABC\nA> -> B{text}"):
        with suppress(LSystemError):
            found = read_map(whole)
            assert read_map(str(found)) == found


def test_a_map_is_no_l_system() -> None:
    written = str(read_map("map: ABAB\nA -> B[-A][+A]B"))
    for notation in (None, "abop", "grogra", "cpfg", "mathematica", "plant-string"):
        with pytest.raises(ModelValueError, match="This is a map system") as caught:
            read(f"\n{written}", notation)
        assert (caught.value.line, caught.value.column, caught.value.hint) == (2, 1, "Maps are read by read_map(text).")
    with pytest.raises(ModelNameError, match="Maps are no L-systems"):
        read("A -> B", "map")
    assert str(read("map : 1 < 2 -> B\naxiom: map")) == "axiom: map\nmap : 1 < 2 -> B"
