"""Timed systems, lineages, stages and continuity do not run away, whatever a division makes; and nothing comes out of them but
what they are asked for or an error of the kit."""

from __future__ import annotations

import subprocess
import sys
from collections.abc import Callable
from contextlib import suppress
from fractions import Fraction
from itertools import product

import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, continuity, derive, draw, growth, limits, lineage, pnml, read, stages, timed
from lsys_kit.notation.model.system import LSystem
from tests.timing import spent

MANY = "repeat(100000,i)<repeat(100000,j)<B(0)>>"
BOMBS = {
    "a timed division": f"axiom: A(0)\nA(1) -> {MANY}",
    "daughters of many ages": "axiom: A(0)\nA(1) -> repeat(1000,i)<repeat(1000,j)<B(i,j)>>",
    "a decomposition": f"axiom: A(0)\nA(t) -> A(t+1)\ndecomposition:\nA(t) : t >= 1 -> {MANY}",
    "a production": f"axiom: A(0)\nA(t) : t < 1 -> A(t+1)\nA(t) -> {MANY}",
    "one that doubles": "axiom: a(0)\na(n) -> a(n+1)\ndecomposition:\na(n) : n < 60 -> a(n+1) a(n+1)",
}
CALLS = (
    "timed(s).word(5)",
    "lineage(timed(s), 5)",
    "stages(timed(s))",
    "stages(s, durations=True)",
    "continuity(s, {'A B': 't'})",
    "lineage(derive(s, 0))",
)
CHILD = """
import resource, sys, time
import sympy  # which takes most of a second
from lsys_kit import LSystemError, continuity, derive, lineage, read, stages, timed
resource.setrlimit(resource.RLIMIT_AS, (2 * 2**30, 2 * 2**30))
s = read(sys.argv[2])
before, start = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss, time.process_time()
try:
    {call}
    found = "finished"
except LSystemError as error:
    found = type(error).__name__
spent, held = time.process_time() - start, resource.getrusage(resource.RUSAGE_SELF).ru_maxrss - before
print(found, spent < 1, held < 300 * 1024)
"""
FORTY = " ".join(f"S{number}" for number in range(40))


@pytest.mark.slow
@pytest.mark.parametrize(("name", "call"), list(product(BOMBS, CALLS)))
def test_a_bomb_is_refused_before_it_is_built(name: str, call: str) -> None:
    program = CHILD.replace("{call}", call)
    found = subprocess.run([sys.executable, "-c", program, name, BOMBS[name]], capture_output=True, text=True, check=True)
    what, soon, small = found.stdout.split()
    assert (soon, small) == ("True", "True")
    assert what in ("ModelLimitError", "ModelValueError") or call == "lineage(derive(s, 0))"


@pytest.mark.slow
@pytest.mark.parametrize("name", ["a timed division", "a decomposition", "a production"])
def test_the_division_is_named(name: str) -> None:
    with pytest.raises(ModelLimitError, match="A\\(1\\) becomes more than 100,000 modules at once") as caught:
        timed(read(BOMBS[name])).word(5)
    assert caught.value.line is not None


@pytest.mark.slow
def test_a_life_of_many_steps_is_one_cell() -> None:
    for text in ("axiom: A\nA -> A", "axiom: A(0)\nA(t) -> A(t+1)"):
        (cell,) = lineage(read(text), 5_000).cells
        assert len(cell.modules) == 5_001
    with pytest.raises(ModelLimitError, match="100,000 modules together"):
        lineage(read("axiom: A\nA -> A"), 100_000)


@pytest.mark.slow
def test_a_mother_may_have_many_daughters() -> None:
    tree = lineage(timed(read("axiom: A(0)\nA(1) -> repeat(20000)<B(0)>")), 2)
    assert len(tree.daughters(0)) == 20_000


@pytest.mark.slow
def test_cells_that_are_dead_count() -> None:
    short = timed(read("axiom: A(0)\nA(1) -> A(0) repeat(60000)<B(0)>\nB(1/2) -> ε"))
    with pytest.raises(ModelLimitError, match="may have 100,000 cells"):
        lineage(short, "5/2")
    with limits(segments=50), pytest.raises(ModelLimitError, match="The tree of this lineage would have"):
        draw(lineage(timed(read("axiom: A(0)\nA(1) -> A(0) repeat(30)<B(0)>\nB(1/2) -> ε")), "5/2"))


def test_a_decomposition_whose_repetition_depends_on_age_has_a_lineage() -> None:
    tree = lineage(read("axiom: A(0)\nA(t) -> A(t+1)\ndecomposition:\nA(t) : t >= 2 -> repeat(t) <B> A(0)"), 5)
    assert str(tree) == "5 cells at time 5, after 2 divisions"
    assert tree.divisions == (2, 4)


def test_a_diagram_with_too_many_arcs_is_grouped_or_refused() -> None:
    net = stages(read(f"axiom: S0\n{'; '.join(())}" + "\n".join(f"S{number} -> {FORTY}" for number in range(40))))
    assert net.grouped
    assert len(net.arcs) == 1_600
    with pytest.raises(ModelLimitError, match="1,600 arcs would not be legible"):
        draw(net).svg  # noqa: B018
    assert pnml(net).count("<arc") == 1_640


def test_continuity_of_many_ages_is_refused() -> None:
    with pytest.raises(ModelLimitError, match="first and last ages"):
        continuity(read("axiom: A(0)\nA(1) -> repeat(1000, i)<B(i)>\nB(2000) -> ε"), {"A B": "t"})


@pytest.mark.slow
@pytest.mark.parametrize(
    "growth_function",
    [
        "*".join(f"(t+{number})" for number in range(30)),
        "*".join(f"sin(t+{number})" for number in range(25)),
        "*".join(f"log(t+{number})" for number in range(1, 25)),
    ],
)
def test_continuity_of_products_ends_with_its_budget(growth_function: str) -> None:
    with spent() as taken, limits(seconds=0.3), pytest.raises(ModelLimitError, match="was not decided"):
        continuity(read("axiom: a(0)\na(1) -> a(0) b(0)\nb(1) -> a(0)"), {"a": growth_function, "b": "t"}, order=9)
    assert taken.seconds < 2


def test_continuity_of_tangents_is_decided() -> None:
    assert len(continuity(read("axiom: a(0)\na(1) -> a(0)"), {"a": "tan(t)"}).divisions) == 1


NUMBERS = ("0", "1", "2", "-1", "1/2", "1/3", "10^9", "1/10^9", "c", "c/3", "sqrt(2)", "1e300", "0 - 1e300", "2^200", "1e-300")
"""Ages as a stranger may write them."""
TIMES = (
    0,
    1,
    -1,
    "1/2",
    10**6,
    1e300,
    5e-324,
    float("nan"),
    float("inf"),
    "1/3",
    "x",
    None,
    True,
    "",
    2**4000,
    Fraction(1, 3**300),
)
"""Times of all kinds."""
UNKNOWN = ("1", "c", "1e300", "0")


FORMS = (
    "{0}({1}) -> {2}",
    "{0}(t) : t < {1} -> {0}(t+1)\n{0}(t) -> {2}",
    "{0}(t) -> {0}(t+c)\n>{0}(t) : t > {1} -> {2}",
    "{0}(t) : t+c >= {1} -> {2}\n{0}(t) -> {0}(t+c)",
    "{0}(t) -> {0}(t+c)\n>{0}(t) : 1/t > {1} -> {2}",
    "{0}(t) : t*t < {1} -> {0}(t+1)\n{0}(t) -> {2}",
    "{0}(t) : t/{1} > 1 || !(t != {1}) -> {2}\n{0}(t) -> {0}(t+1)",
    "{0}(t) -> {0}(t+c)\n>{0}(t) : t >= {1} -> {0}(t-1) repeat(t) <B(0)>",
)
"""What is said of a letter, given an age and a successor; lines with > are decomposition rules."""


@st.composite
def _strange_systems(draw: st.DrawFn) -> str:
    age = st.sampled_from(NUMBERS)
    lines = [f"c = {draw(st.sampled_from(['1', '0', '3/7', '1e300']))}", f"axiom: A({draw(age)}) B(0) X"]
    below: list[str] = []
    for letter in "AB":
        made = draw(st.lists(st.sampled_from(["A(0)", "B(0)", "B(c)", f"A({draw(age)})", "X", "[B(0)]"]), max_size=3))
        text = draw(st.sampled_from(FORMS)).format(letter, draw(age), " ".join(made) or "ε")
        for line in text.splitlines():
            (below if line[0] == ">" else lines).append(line.lstrip(">"))
    return "\n".join(lines) + ("\ndecomposition:\n" + "\n".join(below) if below else "")


def _questions(system: LSystem, time: object, unknown: str) -> list[Callable[[], object]]:
    """Whatever may be asked of a system with ages."""
    return [
        lambda: timed(system, c=unknown).word(time),
        lambda: str(lineage(timed(system), time)),
        lambda: pnml(stages(timed(system, c=unknown))),
        lambda: repr(stages(system, durations=True)),
        lambda: repr(stages(system, durations=True, c=unknown)),
        lambda: draw(stages(system, durations=True)),
        lambda: repr(continuity(system, {"A": "1 + t", "B": "c*t"}, c=unknown)),
        lambda: str(lineage(derive(system, 3))),
        lambda: repr(growth(system)),
        lambda: draw(lineage(timed(system), 3)),
    ]


@pytest.mark.slow
@given(_strange_systems(), st.sampled_from(TIMES), st.sampled_from(UNKNOWN))
def test_a_stranger_gets_an_answer_or_an_explanation(text: str, time: object, unknown: str) -> None:
    try:
        system = read(text)
    except LSystemError:
        return
    with limits(seconds=0.5, modules=2_000):
        for ask in _questions(system, time, unknown):
            with suppress(LSystemError):
                ask()
