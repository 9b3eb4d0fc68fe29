"""Growth that stops where tips meet: Ulam's branching, and the Sierpinski triangle, as open systems.

After the models ulam and Sierpinski of the Virtual Laboratory (Calgary): an apex stretches out tentacles f, each with a query
module at its tip, and a tentacle becomes a branch F if it meets no other. The strict predecessor f ?E(x) has two modules.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Sequence
from itertools import accumulate

import pytest

from lsys_kit import derive, explain, read, write
from lsys_kit.geometry.drawing import scene_of
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.fields import Question
from lsys_kit.worlds.neighbours import Surroundings

ULAM = """angle: 90
axiom: [F A] [+ F A] [- F A] [+(180) F A]
f ?E(x) : x == 1 -> F A
decomposition:
A -> [+ f ?E(0)] [- f ?E(0)] f ?E(0)"""
IN_SPACE = """angle: 90
axiom: [F A] [+ F A] [- F A] [+(180) F A] [^ F A] [& F A]
f ?E(x) : x == 1 -> F A
decomposition:
A -> [+ f ?E(0)] [- f ?E(0)] [& f ?E(0)] [^ f ?E(0)] f ?E(0)"""
SIERPINSKI = """axiom: +(180) [-(30) F A] [+(30) F B]
f ?E(x) : x == 1 -> F A
g ?E(x) : x == 1 -> F B
decomposition:
A -> [f ?E(0)] [+(60) g ?E(0)]
B -> [-(60) f ?E(0)] [g ?E(0)]
interpretation:
g -> f"""
BY_SPHERES = """angle: 90
field: space(1)
axiom: [F A] [+ F A] [- F A] [+(180) F A]
f ?E(r) : r > 0 -> F A
decomposition:
A -> [+ f ?E(0)] [- f ?E(0)] f ?E(0)
interpretation:
f -> f(0.9) @O(0.5)"""
"""The same with a field that a text names: a tip ends just short of its place, in a sphere that no other tip may enter."""


class Alone:
    """Answers 1 to the only one who asks from a place, and 0 where several meet."""

    def answer(self, questions: Sequence[Question], scene: Surroundings) -> list[int]:
        places = [tuple(round(coordinate, 6) for coordinate in question.place) for question in questions]
        asking = Counter(places)
        return [int(asking[place] == 1) for place in places]


def automaton(dimensions: int, steps: int) -> list[int]:
    """How many cells live: one is born where exactly one neighbour lives, and none dies (Ulam and Warburton)."""
    ways = [tuple(sign * (axis == other) for other in range(dimensions)) for axis in range(dimensions) for sign in (-1, 1)]
    living, sizes = {(0,) * dimensions}, [1]
    for _ in range(steps):
        near = Counter(tuple(map(sum, zip(cell, way, strict=True))) for cell in living for way in ways)
        living |= {cell for cell, neighbours in near.items() if neighbours == 1}
        sizes.append(len(living))
    return sizes


def shoots(system: LSystem, steps: int, **choices: object) -> list[int]:
    return [word.counts()["F"] for word in derive(system, steps, **choices)][1:]


@pytest.mark.parametrize(("text", "dimensions", "steps"), [(ULAM, 2, 9), (IN_SPACE, 3, 4)])
def test_ulams_branching_has_a_shoot_for_each_living_cell_but_the_first(text: str, dimensions: int, steps: int) -> None:
    grown = shoots(read(text), steps, field=Alone())
    assert [1 + count for count in grown] == automaton(dimensions, steps)[1:]


def test_ulams_branching_grows_by_four_times_a_power_of_three() -> None:
    """The power is the number of ones in the binary digits of n, less one (Applegate, Pol and Sloane, 2010)."""
    born = [4 * 3 ** (n.bit_count() - 1) for n in range(1, 9)]
    assert shoots(read(ULAM), 8, field=Alone()) == list(accumulate(born))


def test_the_ends_of_the_shoots_are_the_living_cells() -> None:
    ends = scene_of(derive(read(ULAM), 8, field=Alone())[-1]).segments.ends.round().astype(int)
    assert len({tuple(end) for end in ends[:, -len(ends[0]) // 2 :].tolist()}) == automaton(2, 8)[-1] - 1


def test_the_sierpinski_triangle_is_pascals_triangle_of_odd_numbers() -> None:
    """In row n there are 2^m odd numbers, where n has m ones in binary digits, and 3^k in the first 2^k rows."""
    grown = shoots(read(SIERPINSKI), 15, field=Alone())
    assert grown == list(accumulate(2 ** row.bit_count() for row in range(1, 16)))
    assert [1 + grown[2**k - 2] for k in range(1, 5)] == [3**k for k in range(1, 5)]


def test_each_row_of_the_triangle_is_where_the_binomial_coefficients_are_odd() -> None:
    ends = scene_of(derive(read(SIERPINSKI), 15, field=Alone())[-1]).segments.ends
    x, y = ends[:, -len(ends[0]) // 2], ends[:, -1]
    rows = [round(-height / 0.75**0.5) for height in y]
    found = {(row, round(across + row / 2)) for row, across in zip(rows, x, strict=True)}
    assert found == {(row, k) for row in range(1, 16) for k in range(row + 1) if (row & k) == k}


def test_spheres_at_the_tips_tell_the_same() -> None:
    assert shoots(read(BY_SPHERES), 7) == shoots(read(ULAM), 7, field=Alone())


def test_it_is_the_same_in_cpfgs_notation() -> None:
    cpfg = read(
        "Lsystem: 1\nderivation length: 10\nAxiom: [FA][+(90)FA][-(90)FA][|FA]\nf?E(x) : x==1 --> FA\n"
        "decomposition\nA --> [+(90)f?E(0)][-(90)f?E(0)]f?E(0)\nendlsystem",
        "cpfg",
    )
    assert shoots(cpfg, 10, field=Alone()) == shoots(read(ULAM), 10, field=Alone())
    written = read(write(read(SIERPINSKI), "cpfg"), "cpfg")
    assert shoots(written, 10, field=Alone()) == shoots(read(SIERPINSKI), 10, field=Alone())


def test_the_answer_is_told_to_who_asks_why_a_tip_stopped() -> None:
    assert "x == 1 is false where x = 0" in str(explain(derive(read(ULAM), 4, field=Alone()), 4))
