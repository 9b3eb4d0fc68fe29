"""Words as columns are the words that the table of states gives, in doubles and exact."""

from __future__ import annotations

from collections.abc import Iterator
from contextlib import contextmanager
from fractions import Fraction

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, read
from lsys_kit.derivation.core.traits import COLUMN_OPERATORS
from lsys_kit.derivation.engines.columnar import OPERATIONS, SHORT_BITS, ColumnWord, ExactColumns, column_function
from lsys_kit.derivation.engines.counting import CountingEngine
from lsys_kit.notation.model.expressions import Number
from lsys_kit.notation.model.system import LSystem
from tests.derivation.random_systems import systems

SPREADING = read("axiom: A(1)\nA(x) -> A(.37*x+.1) A(.59*x+.2)")
MIXED = read("""
c = 3
axiom: A(1,2) B [C(3)]
A(x,y) : x < y && y > c -> A(x*y/7, y-x) B C(x)
A(x,y) -> A(y,x) A(x+1/3, y*1.1)
C(3) -> C(4) C(3.5)
C(x) : !(x <= 3) || x == 0 -> C(abs(x/1.3)) D
B -> ε
D -> B D""")
ROUNDED = read("axiom: A(1)\nA(x) : floor(x) != 2 -> A(-x*1.7) A(ceil(x/3)+0.5)\nA(x) -> A(x-1)A(floor(x/2-3))")
LONG = read("axiom: A(1)\nA(x) -> A(123456789/1000*x+1) A(x/987654321)")
DENOMINATORS = read("axiom: A(1)\nA(x) : x < 1000 -> A(x/3+1) A(x/7-2)")
ARITHMETICS = pytest.mark.parametrize("arithmetic", ["exact", "float"])


@contextmanager
def columns(wanted: bool) -> Iterator[None]:
    """Words are columns from the first step on, or never."""
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(CountingEngine, "_many_new", lambda engine: wanted)
        yield


def words(system: LSystem, steps: int, in_columns: bool, arithmetic: str) -> list[str] | str:
    with columns(in_columns):
        try:
            with limits(modules=3_000):
                return [str(word) for word in derive(system, steps, arithmetic=arithmetic)]
        except LSystemError as error:
            return str(error)


def check_equal(system: LSystem, steps: int, arithmetic: str) -> None:
    assert words(system, steps, True, arithmetic) == words(system, steps, False, arithmetic)


@ARITHMETICS
@pytest.mark.parametrize(
    "system", [SPREADING, MIXED, ROUNDED, LONG, DENOMINATORS], ids=["spreading", "mixed", "rounded", "long", "denominators"]
)
def test_columns_give_the_words_of_the_table(system: LSystem, arithmetic: str) -> None:
    check_equal(system, 9, arithmetic)


@pytest.mark.slow
@ARITHMETICS
@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@given(system=systems())
def test_columns_give_the_words_of_the_table_for_any_system(arithmetic: str, system: LSystem) -> None:
    check_equal(system, 4, arithmetic)


@ARITHMETICS
def test_many_different_modules_are_no_burden(arithmetic: str) -> None:
    derivation = derive(SPREADING, 16, arithmetic=arithmetic)
    assert derivation.lengths[-1] == len(derivation[-1]) == 2**16
    assert isinstance(derivation[-1], ColumnWord)
    assert len(derivation.states) < 2_000
    assert derivation.origins(3).parents == [0, 0, 1, 1, 2, 2, 3, 3]


@pytest.mark.slow
@ARITHMETICS
@pytest.mark.parametrize("successor", ["F(.37*x+.1) [+(x) F(.59*x+.2)]", "F(.37*x+.1) [+ F(.59*x+.2)] [- F(.7*x+.3)]"])
def test_brackets_and_turns_among_different_modules_are_no_burden(successor: str, arithmetic: str) -> None:
    """At most three of eight modules are new at a step; the others are brackets, or turns that stay."""
    system = read(f"axiom: F(1)\nF(x) -> {successor}")
    derivation = derive(system, 9, arithmetic=arithmetic)
    assert isinstance(derivation[-1], ColumnWord)
    assert len(derivation.states) < 1_000
    with columns(False):
        assert str(derivation[-1]) == str(derive(system, 9, arithmetic=arithmetic)[-1])


def test_what_outgrows_exact_numbers_goes_back_to_the_table() -> None:
    """After so many steps the denominators have more than 128 bits, and each value becomes a double by itself."""
    system = read("axiom: " + " ".join(f"A({n}/7)" for n in range(60)) + "\nA(x) -> A(.37*x+.1)")
    with columns(True):
        derivation = derive(system, 22)
    assert isinstance(derivation[12], ColumnWord)
    assert not isinstance(derivation[21], ColumnWord)
    assert derivation.notes
    assert [str(word) for word in derivation] == [str(word) for word in derive(system, 22)]


@ARITHMETICS
@pytest.mark.parametrize(
    "rule",
    [
        "A(x) -> A(x-1) A(1/(x-1))",
        "A(x) -> A(x-1) B(1/(1/x))",
        "A(x) : 1/x > 2 -> B A(x)",
        "A(x) : x == 0 || 1/x < 9 -> A(x-1)",
        "A(x) : 2 > 1/0 -> B",
        "A(x) -> B(2/0) A(x-1)",
    ],
)
def test_a_division_by_zero_names_its_module(rule: str, arithmetic: str) -> None:
    """Where it stands deep in an expression, too, or in a condition."""
    check_equal(read(f"axiom: A(9)\n{rule}\nA(x) -> A(x-1)"), 12, arithmetic)


def test_a_value_that_is_none_names_its_module() -> None:
    with columns(True), pytest.raises(ModelValueError, match=r"A\(1\) under production 1"):
        derive(read("axiom: A(9)\nA(x) -> A(x-1) A(1/(x-1))"), 9, arithmetic="float")


@pytest.mark.parametrize("rule", ["A(x) -> A(1e200*x) A(1/x)", "A(x) -> A(1/(x*1e200*x)) A(x+1)", "A(x) -> A(sqrt(x-3)) A(x)"])
def test_numbers_past_doubles_are_refused_as_in_the_table(rule: str) -> None:
    check_equal(read(f"axiom: A(1e199)\n{rule}"), 4, "float")


def test_columns_are_refused_by_their_size() -> None:
    with limits(modules=100_000), pytest.raises(ModelLimitError, match="Step 17 would have 131,072 modules") as error:
        derive(SPREADING, 20, arithmetic="float")
    assert error.value.partial.steps == 16
    with limits(bytes=2_000_000), pytest.raises(ModelLimitError, match="bytes"):
        derive(SPREADING, 20, arithmetic="float")


def test_modules_that_come_back_stay_with_the_table() -> None:
    """Sixty different modules in the axiom, and hardly a new one from then on: they are counted."""
    system = read("axiom: " + " ".join(f"A({n})" for n in range(60)) + "\nA(x) : x > 0 -> A(x-1) A(x-1)")
    assert not isinstance(derive(system, 8)[-1], ColumnWord)


def test_what_numpy_computes_otherwise_stays_with_the_table() -> None:
    for text in ("sin(x)", "x^2", "exp(-x)"):
        system = read(f"axiom: A(1)\nA(x) -> A(x/2) A({text})")
        assert not isinstance(derive(system, 9, arithmetic="float")[-1], ColumnWord)


def test_each_column_operator_has_its_operation() -> None:
    assert OPERATIONS["exact"].keys() == COLUMN_OPERATORS
    assert OPERATIONS["float"].keys() == COLUMN_OPERATORS | {"sqrt"}


@given(st.lists(st.fractions(max_denominator=10**20), min_size=1, max_size=5), st.fractions())
def test_exact_columns_compute_as_fractions_do(values: list[Fraction], other: Fraction) -> None:
    columns = ExactColumns((len(values), 1))
    for row, value in enumerate(values):
        columns.write(column_function(Number(value), "exact"), {}, row, 0)
    try:
        found = columns.whole()
    except OverflowError:
        return
    assert [row[0] for row in found.rows()] == values
    assert (found.bits <= SHORT_BITS) == (found.numerators.dtype != object)
    (column,) = found.columns(slice(None), 1)
    constant = column_function(Number(other), "exact")({})
    for text, expected in (
        ("+", [v + other for v in values]),
        ("-", [v - other for v in values]),
        ("*", [v * other for v in values]),
        ("<", [v < other for v in values]),
        ("==", [v == other for v in values]),
        ("abs", list(map(abs, values))),
        ("floor", [v // 1 for v in values]),
        ("ceil", [-(-v // 1) for v in values]),
    ):
        operation = OPERATIONS["exact"][text]
        result = operation(column) if text in ("abs", "floor", "ceil") else operation(column, constant)
        as_numbers = (
            result.tolist() if text in ("<", "==") else [Fraction(n, result.denominator) for n in result.numerators.tolist()]
        )
        assert as_numbers == expected
