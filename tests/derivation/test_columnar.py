"""Words as columns are the words that the table of states gives."""

from __future__ import annotations

import pytest
from hypothesis import HealthCheck, given, settings

import lsys_kit.derivation.engines.counting as counting
from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, limits, read
from lsys_kit.derivation.engines.columnar import ColumnWord
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


def words(system: LSystem, steps: int, from_states: int) -> list[str] | str:
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(counting, "DIFFERENT", from_states)
        try:
            with limits(modules=3_000):
                return [str(word) for word in derive(system, steps, arithmetic="float")]
        except LSystemError as error:
            return str(error)


@pytest.mark.parametrize("system", [SPREADING, MIXED])
def test_columns_give_the_words_of_the_table(system: LSystem) -> None:
    assert words(system, 9, -1) == words(system, 9, 10**9)


@settings(suppress_health_check=[HealthCheck.function_scoped_fixture], max_examples=60)
@given(system=systems())
def test_columns_give_the_words_of_the_table_for_any_system(system: LSystem) -> None:
    assert words(system, 4, -1) == words(system, 4, 10**9)


def test_a_million_different_modules_are_no_burden() -> None:
    derivation = derive(SPREADING, 18, arithmetic="float")
    assert derivation.lengths[-1] == len(derivation[-1]) == 2**18
    assert isinstance(derivation[-1], ColumnWord)
    assert len(derivation.states) < 2_000
    assert derivation.origins(3).parents == [0, 0, 1, 1, 2, 2, 3, 3]


def test_a_value_that_is_none_names_its_module() -> None:
    system = read("axiom: A(9)\nA(x) -> A(x-1) A(1/(x-1))")
    assert words(system, 9, -1) == words(system, 9, 10**9)
    with pytest.MonkeyPatch.context() as patch:
        patch.setattr(counting, "DIFFERENT", -1)
        with pytest.raises(ModelValueError, match=r"A\(1\) under production 1"):
            derive(system, 9, arithmetic="float")


def test_columns_are_refused_by_their_size() -> None:
    with limits(modules=100_000), pytest.raises(ModelLimitError, match="Step 17 would have 131,072 modules") as error:
        derive(SPREADING, 20, arithmetic="float")
    assert error.value.partial.steps == 16
    with limits(bytes=2_000_000), pytest.raises(ModelLimitError, match="bytes"):
        derive(SPREADING, 20, arithmetic="float")


def test_what_numpy_computes_otherwise_stays_with_the_table() -> None:
    for text in ("sin(x)", "x^2", "exp(-x)"):
        system = read(f"axiom: A(1)\nA(x) -> A(x/2) A({text})")
        assert not isinstance(derive(system, 9, arithmetic="float")[-1], ColumnWord)
