"""Cellwork systems as texts: what is written reads back, and what is said of slips."""

from __future__ import annotations

from collections.abc import Sequence
from fractions import Fraction

import pytest
from hypothesis import given

from lsys_kit import ModelNameError, limits, read, read_cellwork, read_map
from lsys_kit.classroom.catalogue import entry
from lsys_kit.errors import LSystemError, ModelLimitError, ModelSyntaxError, ModelValueError
from lsys_kit.notation.fragments import LinkContent, packed
from lsys_kit.notation.model.cells import (
    CellworkProduction,
    CellworkSystem,
    Corner,
    Edge,
    EdgeMarker,
    FirstWall,
    WallProduction,
)
from lsys_kit.notation.read import cells_notation
from tests.derivation.random_cellworks import BOX, cellwork_systems

TETRAHEDRON = (
    "cellwork: 1(0,0,0) 2(1,0,0) 3(0,1,0) 4(0,0,1)\nwall W: 1 A 2 A 3 A\nwall W: 1 A 2 A 4 A\nwall W: 1 A 3 A 4 A\n"
    "wall W: 2 A 3 A 4 A"
)
MARKER = (
    'A marker reads "[PQ: PR|P|PR, PQ]": the wall that is divided, its daughters on both sides of the new edge, the new wall.'
)
PRODUCTION = 'A production reads "P: * -> R [PQ: PR|P|PR, PQ] R": an edge, walls, an arrow, edges with markers between.'
CORNERS = 'Corners are written as in "cellwork: 1(0,0,0) 2(1,0,0)": a number, and its place in space.'
IN_TURN = 'A wall is written as in "wall PQ: 1 P 2 Q 3 P 4 Q": corners and edges in turn, once around it.'
TWO_WALLS = "Each edge of a closed cell belongs to two of its walls."


@given(cellwork_systems())
def test_what_is_written_reads_back(system: CellworkSystem) -> None:
    assert read_cellwork(str(system)) == system


def test_what_is_read_is_a_record() -> None:
    found = read_cellwork(
        f"{TETRAHEDRON}\nsteps: 3\nA: W -> A B> [W: W|c<|V, U] [*: W|c>|V, U] A  /* twice */\nwall V -> W".replace(
            "A: W", "A>: W"
        )
        .replace("A 2", "A> 2")
        .replace("2(1,0,0)", "2(-1.5, 2/3, 0)")
    )
    assert found.corners[1] == Corner("2", (Fraction(-3, 2), Fraction(2, 3), Fraction(0)))
    assert found.walls[0] == FirstWall("W", ("1", "2", "3"), (Edge("A", ">"), Edge("A"), Edge("A")))
    assert found.productions == (
        CellworkProduction(
            Edge("A", ">"),
            (
                Edge("A"),
                Edge("B", ">"),
                EdgeMarker("W", Edge("c", "<"), ("W", "V"), "U"),
                EdgeMarker("*", Edge("c", ">"), ("W", "V"), "U"),
                Edge("A"),
            ),
            ("W",),
        ),
    )
    assert found.wall_productions == (WallProduction("V", "W"),)
    assert found.steps == 3
    assert "A>: W -> A B> [W: W|c<|V, U] [*: W|c>|V, U] A" in str(found)
    assert read_cellwork(str(found)) == found


SLIPS = [
    (ModelSyntaxError, "", "There is no first cell", 1, 1, 'Give its corners, as in "cellwork: 1(0,0,0) 2(1,0,0) ...".'),
    (ModelSyntaxError, "cellwork: 1(0,0) 2(1,0)", "This is no corner", 1, 16, CORNERS),
    (ModelSyntaxError, f"{BOX}\n{BOX}", '"cellwork:" is set a second time', 8, 1, "Keep one of the two lines."),
    (ModelSyntaxError, f"{BOX}\nsteps: many", 'After "steps:" a whole number is needed', 8, 1, 'Type "steps: 4".'),
    (ModelSyntaxError, f"{BOX}\nsteps: 1234567890", "This number is too large", 8, 8, None),
    (ModelSyntaxError, f"cellwork: 1({'1' * 31},0,0)", "This number is too large", 1, 13, None),
    (ModelSyntaxError, f"{BOX}\nwall {'W' * 65} -> V", "This name has more than 64 letters", 8, 6, None),
    (
        ModelSyntaxError,
        f"{BOX}\nangle: 90",
        'A cellwork has no "angle:"',
        8,
        1,
        'It has "cellwork:", "wall ...:", "steps:" and productions.',
    ),
    (ModelSyntaxError, f"{BOX}\nwall S: 1 A 2 3", "Corners and edges do not stand here in turn", 8, 15, IN_TURN),
    (
        ModelSyntaxError,
        f"{BOX}\nA: -> B",
        "The walls of the edge are missing here",
        8,
        4,
        'Write "P: * -> ..." for an edge P in any walls.',
    ),
    (ModelSyntaxError, f"{BOX}\nA: *", "An arrow is missing here", 8, 5, PRODUCTION),
    (
        ModelSyntaxError,
        f"{BOX}\nA: * ->",
        "There is nothing after the arrow",
        8,
        8,
        "Edges are never erased: write what this one becomes.",
    ),
    (ModelSyntaxError, f"{BOX}\nA B", 'I did not expect "B"', 8, 3, PRODUCTION),
    (ModelSyntaxError, f"{BOX}\nA", "Something is missing here", 8, 2, PRODUCTION),
    (
        ModelSyntaxError,
        f"{BOX}\nA: * -> B -> C",
        "This is a second arrow in one production",
        8,
        11,
        "Write one production per line.",
    ),
    (ModelSyntaxError, f"{BOX}\nA: * -> B [S: S|c|S, T", 'This "[" is never closed', 8, 11, MARKER),
    (ModelSyntaxError, f"{BOX}\nA: * -> B ] B", 'This "]" closes nothing', 8, 11, MARKER),
    (ModelSyntaxError, f"{BOX}\nA: * -> B [S: S|c|S] B", "This marker cannot be read", 8, 20, MARKER),
    (ModelSyntaxError, f"{BOX}\n# a cell", "This is not a production", 8, 1, 'A comment is written between "/*" and "*/".'),
    (
        ModelSyntaxError,
        f"{BOX}\n\u0410: * -> B",
        'I cannot read the character "А" (CYRILLIC CAPITAL LETTER A)',
        8,
        1,
        "Edges are letters from A to Z, walls names of such letters.",
    ),
    (ModelValueError, BOX.rpartition("\n")[0], "The first cell is not closed: the edge 2-3 belongs to 1 wall", 2, 6, TWO_WALLS),
    (
        ModelValueError,
        f"{BOX}\nwall S: 1 A 2 A 3 A 4 A",
        "The first cell is not closed: the edge 1-2 belongs to 3 walls",
        2,
        6,
        TWO_WALLS,
    ),
    (
        ModelValueError,
        BOX.replace("1(0,0,0)", "1(0,0,0) 9(2,2,2)"),
        "The walls of the first cell are no single closed surface: vertices less edges and walls are 3, not 2",
        2,
        6,
        "A cell is one piece without holes, and each corner belongs to it.",
    ),
    (
        ModelValueError,
        BOX.replace("2(1,0,0)", "1(1,0,0)"),
        "The corner 1 is given twice",
        1,
        20,
        "Give each corner a number of its own.",
    ),
    (
        ModelValueError,
        BOX.replace("8(0,1,1)", ""),
        "The wall S has a corner 8, which is not given",
        3,
        6,
        'Give it a place behind "cellwork:".',
    ),
    (
        ModelValueError,
        f"{BOX}\nwall S: 1 A 2 A 1 A",
        "The wall S comes to corner 1 twice",
        8,
        6,
        "Its corners are met once each on the way around it.",
    ),
    (ModelValueError, f"{BOX}\nwall S: 1 A 2 A", "This wall has only 2 corners", 8, 6, "A wall has three corners or more."),
    (
        ModelValueError,
        BOX.replace("wall T: 1 A 2", "wall T: 1 B 2"),
        "The edge 1-2 is A in one wall and B in another",
        4,
        6,
        "Give it the same letter and direction in both.",
    ),
    (
        ModelValueError,
        BOX.replace("5 A 6 A 7", "5 A> 6 A 7").replace("6 A 5 A", "6 A> 5 A"),
        "The edge 5-6 is A> in one wall and A< in another",
        4,
        6,
        "Give it the same letter and direction in both.",
    ),
    (
        ModelValueError,
        f"{BOX}\nA<: * -> B",
        "A production is written in the direction of its edge",
        8,
        1,
        'Write "A>: ...": what becomes of the edge, from its beginning to its end.',
    ),
    (
        ModelValueError,
        f"{BOX}\nA: S T -> B\nA: T S -> C",
        "This is a second production for A in the same walls",
        9,
        1,
        "The first one would always be applied.",
    ),
    (
        ModelValueError,
        f"{BOX}\nwall S -> T\nwall S -> U",
        "This is a second production for the wall S",
        9,
        6,
        "A wall that is not divided becomes one wall.",
    ),
    (
        ModelValueError,
        f"{BOX}\nA: * -> [S: S|c|S, T]",
        "Nothing is left of the edge A",
        8,
        1,
        "Edges are never erased: write the letter of an edge too.",
    ),
    (
        ModelValueError,
        f"{BOX}\nA: * -> B [S: S|c|S, T]",
        "This marker is at the end of the edge",
        8,
        12,
        "Markers belong between two edges, where there is a new vertex.",
    ),
    (
        ModelValueError,
        f"{BOX}\nA: * -> B [S: S|c|T, T] B",
        "The neutral edge A would become something else from its other end",
        8,
        1,
        'Read backwards, this is "B [S: T|c|S, T] B", and an edge without an arrow has no beginning. '
        'Make both the same, or give the edge an arrow: "A>: ...".',
    ),
]


@pytest.mark.parametrize("row", SLIPS, ids=[str(row[2]) for row in SLIPS])
def test_a_slip_is_explained(row: Sequence[object]) -> None:
    kind, text, *expected = row
    with pytest.raises(LSystemError) as caught:
        read_cellwork(str(text))
    error = caught.value
    assert [error.message, error.line, error.column, error.hint] == expected
    assert type(error) is kind


def test_two_closed_surfaces_are_no_cell() -> None:
    corners, *walls = TETRAHEDRON.split("\n")
    other = [wall.translate(str.maketrans("1234", "5678")) for wall in walls]
    more = f"{corners} {' '.join(f'{number}({number},0,0)' for number in range(5, 9))}"
    with pytest.raises(ModelValueError, match="are no single closed surface: vertices less edges and walls are 4, not 2"):
        read_cellwork("\n".join((more, *walls, *other)))
    with pytest.raises(ModelValueError, match="no single closed surface"):
        read_cellwork(
            "\n".join((corners, *walls, *(wall.translate(str.maketrans("234", "567")) for wall in walls))).replace(
                "4(0,0,1)", "4(0,0,1) 5(-1,0,0) 6(0,-1,0) 7(0,0,-1)"
            )
        )


def test_parts_that_are_never_used_are_noted() -> None:
    found = read_cellwork(f"{TETRAHEDRON}\nA: * -> A [W: W|c>|W, W] A\nZ: * -> A\nA: W -> B\nB: * -> c")
    assert found.notes == (
        "The production Z: * -> A is never used: no edge Z occurs.",
        "Markers c> divide no wall: they need markers c<, and there are none.",
    )
    assert read_cellwork(f"{TETRAHEDRON}\nA: * -> A [V: W|c|W, W] A").notes == (
        "The marker [V: W|c|W, W] divides no wall: no wall V occurs.",
    )
    assert read_cellwork(f"{TETRAHEDRON}\nA: * -> A [W: W|c|W, W] [W: W|d|W, W] A".replace("[W: W|d|W, W] A", "A")).notes == ()
    directed = f"{TETRAHEDRON}\nB>: * -> A".replace("1 A 2 A 3", "1 B> 2 A 3").replace("1 A 2 A 4", "1 B> 2 A 4")
    assert read_cellwork(directed).notes == ()


def test_systems_of_cells_say_what_they_are_systems_of() -> None:
    systems = read_map("map: AAA"), read_map("sphere: AA"), read_cellwork(TETRAHEDRON)
    assert [system.kind for system in systems] == ["map", "map on a sphere", "cellwork"]
    assert read_cellwork(TETRAHEDRON).labels == {"W"}


def test_a_cellwork_is_no_l_system_and_is_referred_to_its_reader() -> None:
    with pytest.raises(ModelValueError, match=r"This is a cellwork system, not an L-system.*read_cellwork\(text\)"):
        read(entry("K33").rules)
    with pytest.raises(ModelNameError, match=r"Cellworks are no L-systems.*read_cellwork\(text\)"):
        read("axiom: A", "cellwork")
    with pytest.raises(ModelValueError, match="A model is read from text, not from int"):
        read_cellwork(3)  # type: ignore[arg-type]


def test_a_cellwork_has_so_many_walls_and_productions_and_no_more() -> None:
    with limits(rules=3), pytest.raises(ModelLimitError, match="The model has more than 6 "):
        read_cellwork(BOX)
    with limits(rules=2), pytest.raises(ModelLimitError):
        read_cellwork(TETRAHEDRON)


def test_the_link_of_a_cellwork_is_read_by_its_reader() -> None:
    address = packed(LinkContent("cellwork", {}, TETRAHEDRON))
    assert read_cellwork(address) == read_cellwork(TETRAHEDRON)
    assert [cells_notation(text) for text in (address, TETRAHEDRON, "axiom: A")] == ["cellwork", "cellwork", None]
    with pytest.raises(ModelValueError, match="This is the link of a cellwork system, not of an L-system"):
        read(address)
    with pytest.raises(ModelValueError, match="This is the link of another system, not of a cellwork system"):
        read_cellwork(packed(LinkContent("map", {}, "map: ABAB")))
