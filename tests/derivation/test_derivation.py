"""A derivation: words when they are asked for, sizes before they are built, nothing computed twice."""

from __future__ import annotations

import os
import subprocess
import sys

import numpy as np
import pytest

from lsys_kit.budget import limits
from lsys_kit.derivation.derive import Derivation, derive, lengths
from lsys_kit.errors import ModelLimitError, ModelNameError, ModelValueError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read
from tests.timing import spent

FIBONACCI = read("axiom: a\na -> ab\nb -> a")
TENFOLD = read("axiom: F\nF -> FFFFFFFFFF")
EVERY_MODULE_NEW = read("axiom: A(1)\nA(x) -> A(2*x) A(2*x+1)")
EVERY_MODULE_NEW_IN_CONTEXT = read("axiom: A(1)\nA(y) < A(x) -> A(2*x+y) A(2*x)\nA(x) -> A(2*x) A(2*x+1)")


def refused(system: LSystem, steps: int) -> ModelLimitError:
    with pytest.raises(ModelLimitError) as caught:
        derive(system, steps)
    return caught.value


def test_a_derivation_has_the_axiom_and_one_word_a_step() -> None:
    derivation = derive(FIBONACCI, 4)
    assert len(derivation) == 5
    assert [str(word) for word in derivation] == ["a", "a b", "a b a", "a b a a b", "a b a a b a b a"]
    assert str(derivation[-2]) == "a b a a b"
    assert [str(word) for word in derivation[1:3]] == ["a b", "a b a"]
    assert repr(derivation) == "0 a\n1 a b\n2 a b a\n3 a b a a b\n4 a b a a b a b a"


def test_there_is_no_word_behind_the_last_step() -> None:
    with pytest.raises(IndexError, match="step a very large int of a derivation of 2 steps"):
        derive(FIBONACCI, 2)[10**5000]
    with pytest.raises(IndexError, match="step 3 of a derivation of 2 steps"):
        derive(FIBONACCI, 2)[3]
    with pytest.raises(IndexError):
        derive(FIBONACCI, 2)[-4]


def test_a_word_is_built_once() -> None:
    derivation = derive(FIBONACCI, 20)
    assert derivation[20] is derivation[-1]
    assert derivation.to(25)[20] is derivation[20]


def test_the_last_word_needs_no_other() -> None:
    derivation = derive(FIBONACCI, 30)
    assert len(derivation[-1]) == 2_178_309
    assert list(derivation._engine._words) == [30]


def test_a_derivation_goes_on_where_it_was() -> None:
    short = derive(FIBONACCI, 3)
    long = short.to(10)
    assert (len(short), len(long)) == (4, 11)
    assert long[3] is short[3]
    assert long.states is short.states
    assert list(long.to(3)) == list(short)


def test_large_words_take_one_byte_a_module() -> None:
    word = derive(read("axiom: F\nF -> F[+F]F[-F]F"), 8)[-1]
    assert len(word) == word.bytes == 976_561


def test_a_short_word_follows_a_long_one_with_many_states() -> None:
    found = derive(read(f"axiom: S T(0)\nS -> S c\nc -> ε\nT(t) : t < 300 -> T(t+1)\nT(t) -> {'c ' * 5_000}"), 5)
    assert len(list(found)) == 6
    assert [len(word) for word in found.to(303)][300:] == [3, 5_002, 2, 2]


def test_words_with_many_states_take_as_many_bytes_as_they_need() -> None:
    word = derive(EVERY_MODULE_NEW, 13)[-1]
    assert not isinstance(word.codes, list | tuple)
    assert word.codes.itemsize == 2
    assert [module.arguments[0] for module in word] == list(range(2**13, 2**14))


@pytest.mark.parametrize("steps", [-1, 2.0, "3", None, True, np.float64(2)])
def test_the_number_of_steps_is_a_whole_number(steps: object) -> None:
    with pytest.raises(ModelValueError, match="The number of steps must be a whole number from 0 on, not "):
        derive(FIBONACCI, steps)  # type: ignore[arg-type]


def test_numpys_whole_numbers_are_whole_numbers() -> None:
    assert len(derive(FIBONACCI, np.int64(3))) == 4  # type: ignore[arg-type]


def test_an_unknown_arithmetic_is_named() -> None:
    with pytest.raises(ModelNameError, match='There is no arithmetic called "double"'):
        derive(FIBONACCI, 1, arithmetic="double")


# Limits


def test_a_step_past_the_limit_is_refused_before_it_is_built() -> None:
    with spent() as taken:
        error = refused(TENFOLD, 20)
    assert error.message == "Step 7 would have 10,000,000 modules; the limit is 5,000,000"
    assert error.hint == "Step 6 is the last that can be reached. Take fewer steps, or set limits(modules=...)."
    assert (error.limit, error.needed) == (5_000_000, 10_000_000)
    assert taken.seconds < 0.01 * 5  # some milliseconds of the processor's time, where building the word would take seconds


def test_the_steps_that_fit_are_kept() -> None:
    partial = refused(TENFOLD, 20).partial
    assert isinstance(partial, Derivation)
    assert partial.lengths == [10**step for step in range(7)]
    assert len(partial[-1]) == 1_000_000


def test_the_kept_steps_are_named() -> None:
    with limits(modules=10):
        assert (
            refused(TENFOLD, 2).hint == "Step 1 is the last that can be reached. Take fewer steps, or set limits(modules=...)."
        )
    with limits(modules=9):
        assert (
            refused(TENFOLD, 2).hint == "Step 0 is the last that can be reached. Take fewer steps, or set limits(modules=...)."
        )
    with limits(modules=2):
        error = refused(read("axiom: A B C"), 2)
    assert error.message == "Step 0 would have 3 modules; the limit is 2"
    assert error.hint == "Take fewer steps, or set limits(modules=...)."
    assert error.partial is None


def test_an_immense_step_is_named_by_its_number_of_digits() -> None:
    with limits(modules=10**57, bytes=10**70), pytest.raises(ModelLimitError) as caught:
        derive(TENFOLD, 60)
    assert caught.value.message == "Step 58 would have about 10^58 modules; the limit is about 10^57"


@pytest.mark.parametrize("ages", [3, 100, 160, 170, 180, 200, 256, 300])
def test_a_short_word_is_the_same_however_many_states_there_are(ages: int) -> None:
    """Up to 256 states a step is made of letters: here a third of the states divide, and one in seven dies."""
    found = derive(
        read(
            f"ages = {ages}\naxiom: [X]\nX -> repeat(ages, i) <A(i)>\nA(t) : mod(t,7) == 6 -> ε\n"
            "A(t) : mod(t,3) == 0 -> A(mod(t+1,ages)) A(mod(5*t+2,ages))\nA(t) -> A(mod(t+3,ages))"
        ),
        9,
    )
    expected = list(found.states.axiom)
    for word in found:
        assert word.numbers() == expected
        expected = [made for state in expected for made in found.states.successor(state)]


def test_the_limit_can_be_lowered_afterwards() -> None:
    derivation = derive(TENFOLD, 5)
    with limits(modules=1_000), pytest.raises(ModelLimitError, match="Step 4 would have 10,000 modules; the limit is 1,000"):
        derivation.to(5)


def test_bytes_are_counted_too() -> None:
    with limits(bytes=50_000):
        error = refused(TENFOLD, 20)
    assert error.message == "Step 5 would take 100,600 bytes; the limit is 50,000"
    assert error.hint == "Step 4 is the last that can be reached. Take fewer steps, or set limits(bytes=...)."


def test_many_different_modules_are_counted_by_what_the_table_takes() -> None:
    with limits(bytes=5_000_000):
        error = refused(EVERY_MODULE_NEW, 40)
    assert "bytes; the limit is 5,000,000" in error.message
    assert isinstance(error.partial, Derivation)
    assert len(error.partial[-1]) == 2**error.partial.steps


def test_deriving_takes_no_longer_than_it_may() -> None:
    with spent() as taken, limits(seconds=0.2, modules=2**40, bytes=2**34):
        error = refused(read("axiom: A(1)\nA(x) -> A(max(2*x, 0)) A(2*x+1)"), 40)
    assert taken.seconds < 0.2 * 5
    assert error.message.endswith(" was not reached in 0.2 seconds")
    assert error.hint is not None
    assert error.hint.endswith("set limits(seconds=...).")
    assert (error.limit, error.needed) == (0.2, None)
    assert isinstance(error.partial, Derivation)
    assert len(error.partial[-1]) == 2**error.partial.steps


@pytest.mark.slow
def test_counting_takes_no_longer_than_it_may() -> None:
    with limits(seconds=0.1), pytest.raises(ModelLimitError, match=r"Step \d+ was not reached in 0\.1 seconds"):
        list(lengths(EVERY_MODULE_NEW, 100))


def test_time_that_the_asker_spends_is_not_counted(monkeypatch: pytest.MonkeyPatch) -> None:
    now = [0.0]
    monkeypatch.setattr("lsys_kit.budget.processor_time", lambda: now[0])
    with limits(seconds=10):
        for _ in lengths(FIBONACCI, 4):
            now[0] += 9


def test_lengths_have_no_limit() -> None:
    assert len(str(list(lengths(FIBONACCI, 10_000))[-1])) == 2_090


def test_an_axiom_may_be_a_million_modules_less_than_the_limit() -> None:
    axiom = FIBONACCI.axiom * 40_000
    derivation = derive(LSystem(axiom, FIBONACCI.productions), 8)
    assert derivation.lengths[-1] == 40_000 * 55
    assert len(derivation[-1]) == 40_000 * 55


# What is worth telling


def test_values_that_outgrow_128_bits_become_doubles() -> None:
    system = read("axiom: F(1)\nF(x) -> F(1.7185*x)")
    derivation = derive(system, 12)
    first = next(step for step, word in enumerate(derivation) if isinstance(word[0].arguments[0], float))
    assert derivation[first - 1][0].arguments[0].numerator.bit_length() <= 128  # type: ignore[union-attr]
    assert derivation[12][0].arguments[0] == pytest.approx(1.7185**12, rel=1e-15)
    assert derivation.states.inexact == derivation[first][0]
    assert derivation.notes == (f"From step {first} on values outgrow 128 bits and are doubles, such as {derivation[first]}.",)
    assert derivation.to(first - 1).notes == ()


def test_ages_stay_exact() -> None:
    derivation = derive(read("axiom: A(0)\nA(t) -> A(t + 0.1)"), 1_000)
    assert derivation[-1][0].arguments == (100,)
    assert derivation.states.inexact is None
    assert derivation.notes == ()


def test_what_the_reader_found_is_told_with_the_derivation() -> None:
    assert derive(read("axiom: F\nF -> FF"), 1).notes == ('"FF" is read as F F.',)


# Arithmetic


def test_doubles_fall_into_the_trap_that_exact_ages_avoid() -> None:
    """Seed 002, L-system 5: with dt = 0.7 there are 7 cells at step 4, with doubles 5."""
    system = read(
        "dt = 0.7\naxiom: R(0)\n"
        "R(t) : t+dt < 1 -> R(t+dt)\nR(t) -> L(t+dt-0.8) R(t+dt-1)\n"
        "L(t) : t+dt < 1 -> L(t+dt)\nL(t) -> L(t+dt-1) R(t+dt-0.8)"
    )
    assert derive(system, 5).lengths == [1, 1, 2, 4, 7, 9]
    assert derive(system, 5, arithmetic="float").lengths != [1, 1, 2, 4, 7, 9]
    assert derive(system, 4, dt="14/10").lengths == [1, 2, 4, 8, 16]


def test_float_arithmetic_computes_in_doubles_throughout() -> None:
    word = derive(read("c = 0.1\naxiom: A(c)\nA(t) -> A(t + 0.2)"), 1, arithmetic="float")[-1]
    assert word[0].arguments == (0.1 + 0.2,)
    assert derive(read("axiom: A(2)\nA(t) -> A(2^t)"), 1, arithmetic="float")[-1][0].arguments == (4.0,)


@pytest.mark.parametrize("rule", ["A(x) -> A(x*x)", "A(x) -> A(10^400 - 10^400 + x*x)"])
def test_doubles_that_overflow_are_refused(rule: str) -> None:
    with pytest.raises(ModelValueError, match="has no value: the result is too large"):
        derive(read(f"axiom: A(1e200)\n{rule}"), 3, arithmetic="float")


def test_a_double_that_is_no_number_is_refused() -> None:
    with pytest.raises(ModelValueError, match="has no value: the result is not a number"):
        derive(read("axiom: A(1e200)\nA(x) -> A(x*x - x*x)"), 3, arithmetic="float")


# The same everywhere


PRINT = """
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.petri.stages import stages
from lsys_kit.notation.read import read
system = read('''k = 3
axiom: A(0) B
A(t) : t < k -> A(t+1)[B]
A(t) -> u_1 A(0)
B -> al FF
al -> B''')
print(derive(system, 7), stages(system), growth(system), derive(system, 9)[-1].counts(), system, sep="\\n")
try:
    derive(system, 2, kk=3)
except Exception as error:
    print(error)
"""


@pytest.mark.slow
def test_the_order_of_hashes_changes_nothing() -> None:
    said = {
        subprocess.run(
            [sys.executable, "-c", PRINT],
            env={**os.environ, "PYTHONHASHSEED": seed},
            capture_output=True,
            text=True,
            check=True,
        ).stdout
        for seed in ("0", "1", "2")
    }
    assert len(said) == 1
    assert 'Did you mean "k"?' in said.pop()


@pytest.mark.slow
def test_a_step_of_few_modules_that_make_many_has_its_time() -> None:
    """Each of forty modules makes fifty thousand: somebody looks at the clock behind each."""
    system = read("axiom: B" + " A(0)" * 40 + "\nA(x) -> repeat(50000) <F(uniform(0, 1))>\nB < F(x) -> F(x)")
    with spent() as taken, limits(seconds=0.2), pytest.raises(ModelLimitError, match=r"Step 1 was not reached in 0\.2 seconds"):
        derive(system, 1)
    assert taken.seconds < 10  # one module's share, on a slow machine
