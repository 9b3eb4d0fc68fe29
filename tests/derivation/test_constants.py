"""Constants: declared in the model, changed by whoever derives it, exact either way."""

from __future__ import annotations

from decimal import Decimal
from fractions import Fraction

import numpy as np
import pytest
import sympy

from lsys_kit.derivation.core.rules import constants_of, number_from
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.errors import LSystemError, ModelNameError, ModelValueError
from lsys_kit.notation.model.arithmetic import Value
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read

TIMED = read("dt = 0.7 in 0.1 .. 2 by 0.1\nhalf = dt/2\naxiom: A(0)\nA(t) -> A(t+dt)")
LIVES = read(
    "lifeTimeA = 3\nlifeTimeB = lifeTimeA\naxiom: A(1)\n"
    "A(lifeTimeA) -> A(1) B(1)\nA(t) -> A(t+1)\nB(t) -> B(min(t+1, lifeTimeB))"
)


@pytest.mark.parametrize(
    ("given", "exact"),
    [
        (1.4, Fraction(7, 5)),
        ("1.4", Fraction(7, 5)),
        ("14/10", Fraction(7, 5)),
        ("2*0.7", Fraction(7, 5)),
        ("2^-1", Fraction(1, 2)),
        (Fraction(7, 5), Fraction(7, 5)),
        (Fraction(4, 2), 2),
        (sympy.Rational(7, 5), Fraction(7, 5)),
        (sympy.Integer(3), 3),
        (sympy.Float("1.5"), Fraction(3, 2)),
        (np.float64(1.4), Fraction(7, 5)),
        (np.float32(0.5), Fraction(1, 2)),
        (np.int8(3), 3),
        (np.uint64(2**63), 2**63),
        (1e-3, Fraction(1, 1000)),
        (3, 3),
        (-2.0, -2),
        ("-1/3", Fraction(-1, 3)),
    ],
)
def test_a_number_is_what_was_typed(given: object, exact: Value) -> None:
    number = number_from(given)
    assert number == exact
    assert type(number) is type(exact)
    assert derive(TIMED, 10, dt=given)[-1][0].arguments == (10 * exact,)


@pytest.mark.parametrize(
    "given",
    [
        None,
        True,
        np.bool_(True),
        1j,
        float("nan"),
        float("inf"),
        np.inf,
        [1],
        10**400,
        sympy.pi,
        b"1",
        Decimal("1.4"),
        Fraction(10**400),
    ],
)
def test_what_is_no_number_is_refused(given: object) -> None:
    with pytest.raises(ModelValueError, match='"dt" must be a number, not '):
        derive(TIMED, 1, dt=given)


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("", "A value is missing here"),
        ("1,4", "A number is typed with a point"),
        ("x", 'I do not know the name "x"'),
        ("1/0", '"1/0" has no value: division by zero'),
        ("1 < 2", '"1 < 2" is true or false, but a number is needed here'),
        ("__import__(1)", 'I do not know the function "__import__"'),
        ("9^9^9^9", '"9^9^9^9" has no value: the result is too large'),
        ("1" * 3_000, "This number is too long"),
    ],
)
def test_a_text_that_is_no_number_is_explained(given: str, message: str) -> None:
    with pytest.raises(LSystemError) as caught:
        derive(TIMED, 1, dt=given)
    assert caught.value.message == message


def test_an_unknown_constant_is_named() -> None:
    with pytest.raises(ModelNameError, match=r'The system declares no constant "lifetimeA"\. Did you mean "lifeTimeA"\?'):
        derive(LIVES, 3, lifetimeA=2)
    with pytest.raises(ModelNameError, match=r"Its constants are: lifeTimeA, lifeTimeB\."):
        derive(LIVES, 3, q=2)
    with pytest.raises(ModelNameError, match=r'no constant "dt"\. It has none\.'):
        derive(read("axiom: A"), 3, dt=2)


def test_a_constant_made_of_others_moves_with_them() -> None:
    assert constants_of(TIMED, {"dt": 1}) == (1, Fraction(1, 2))
    assert constants_of(TIMED, {"half": 1}) == (Fraction(7, 10), 1)


def test_a_constant_before_the_arrow_asks_for_its_value() -> None:
    assert derive(LIVES, 3).lengths == [1, 1, 1, 2]
    assert derive(LIVES, 3, lifeTimeA=1).lengths == [1, 2, 3, 4]


def test_growth_and_stages_follow_the_constants() -> None:
    assert [len(growth(LIVES, lifeTimeA=n).states) for n in (1, 2, 4)] == [2, 4, 8]
    assert [len(stages(LIVES, lifeTimeA=n).places) for n in (1, 2, 4)] == [2, 4, 8]


def test_a_constant_may_leave_the_range_of_its_slider() -> None:
    assert derive(TIMED, 1, dt=5)[-1][0].arguments == (5,)


@pytest.mark.parametrize("arithmetic", ["exact", "float"])
@pytest.mark.parametrize("changes", [{"dt": 0}, {"dt": "1e200"}])
def test_a_constant_without_a_value_is_named(arithmetic: str, changes: dict[str, object]) -> None:
    system = read("dt = 1\nrate = 1/dt + dt*dt\naxiom: A(rate)")
    with pytest.raises(ModelValueError) as caught:
        derive(system, 1, arithmetic=arithmetic, **changes)
    why = "the result is too large" if changes["dt"] else "division by zero"
    assert caught.value.message == f'The constant "rate" has no value: {why}'
    assert (caught.value.line, caught.value.column) == (2, 1)


def test_float_constants_are_doubles() -> None:
    assert [type(value) for value in constants_of(TIMED, {"dt": "1/3"}, "float")] == [float, float]


def test_a_model_without_text_can_be_wrong_too() -> None:
    system = read("k = 1\naxiom: A(1/k)")
    with pytest.raises(ModelValueError, match="The axiom has no value: division by zero"):
        derive(LSystem(tuple(m.__class__(m.symbol, m.arguments) for m in system.axiom), (), system.constants), 0, k=0)
