"""Words: rows of modules that print as the notation and compare by what they say."""

from __future__ import annotations

import re
from fractions import Fraction

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit.budget import limits
from lsys_kit.derivation.core.words import Word, abridged, state_counts
from lsys_kit.derivation.derive import derive
from lsys_kit.derivation.engines.engine import MOST_LISTED
from lsys_kit.errors import ModelLimitError
from lsys_kit.notation.model.arithmetic import DIGITS, normalised, number_text, rounded
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.read import read, read_word

AGEING = read("axiom: A(1)\nA(t) : t < 3 -> A(t+1)[B]\nA(t) -> A(1) C\nB -> ε")
KOCH = read("axiom: F\nF -> F+F--F+F")


def test_a_word_prints_as_its_notation() -> None:
    assert [str(word) for word in derive(AGEING, 3)] == ["A(1)", "A(2)[B]", "A(3)[B][]", "A(1)C[][]"]
    assert str(derive(read("Axiom: I\nI -> I[A]A(I)A", "plant-string"), 1)[-1]) == "I[A]A(I)A"
    assert str(derive(read("axiom: al(2) br"), 0)[0]) == "al(2)br"


def test_a_text_takes_the_bytes_of_all_its_modules() -> None:
    word = derive(read("axiom: a\na -> a a"), 10)[-1]
    with limits(bytes=1024):
        assert str(word).count("a") == 1024
    with limits(bytes=1023), pytest.raises(ModelLimitError, match="it would take 1,024 bytes"):
        str(word)


def test_an_erased_word_is_empty() -> None:
    word = derive(read("axiom: B\nB -> ε"), 1)[-1]
    assert (len(word), str(word), list(word), dict(word.counts())) == (0, "", [], {})


def test_modules_of_a_word_are_found_by_their_place() -> None:
    word = derive(AGEING, 2)[-1]
    assert word[0] == Module("A", (3,))
    assert word[-1] == Module("]")
    assert isinstance(word[1:4], Word)
    assert (str(word[1:4]), str(word[::-1])) == ("[B]", "][]B[A(3)")
    with pytest.raises(IndexError):
        word[len(word)]


def test_parts_of_a_large_word_are_words() -> None:
    word = derive(KOCH, 6)[-1]
    assert len(word) > MOST_LISTED
    assert str(word[:7]) == "F+F--F+"
    assert word[7] == Module("-") or word[7] == Module("F")
    assert list(word[10:20]) == list(word)[10:20]


def test_words_of_different_tables_are_equal_when_their_modules_are() -> None:
    one, other = derive(read("axiom: A B"), 0)[0], derive(read("axiom: B\nB -> A B"), 1)[-1]
    assert one.numbers() != other.numbers()
    assert one == other
    assert hash(one) == hash(other)
    assert one != derive(read("axiom: A B B"), 0)[0]
    assert one != derive(read("axiom: A C"), 0)[0]
    assert one != "A B"


def test_words_of_different_notations_are_equal_when_their_modules_are() -> None:
    one, other = derive(read("axiom: A B"), 0)[0], derive(read("Axiom: AB", "plant-string"), 0)[0]
    assert (str(one), str(other)) == ("A B", "AB")
    assert one == other
    assert hash(one) == hash(other)


def test_a_value_counts_and_not_how_it_is_kept() -> None:
    exact, double = derive(read("axiom: A(2)"), 0)[0], derive(read("axiom: A(2)"), 0, arithmetic="float")[0]
    assert exact == double
    assert hash(exact) == hash(double)


def test_a_list_and_an_array_of_states_are_one_word() -> None:
    word = derive(KOCH, 4)[-1]
    array = Word(word.states, np.array(word.numbers()))
    assert array == word
    assert (str(array), array.counts(), state_counts(array)) == (str(word), word.counts(), state_counts(word))


def test_symbols_are_counted_whatever_their_values() -> None:
    assert dict(derive(read("axiom: A(1) A(2) B"), 0)[0].counts()) == {"A": 2, "B": 1}


def test_a_long_word_is_shortened_in_its_middle() -> None:
    word = derive(KOCH, 5)[-1]
    assert repr(derive(KOCH, 2)[-1]) == str(derive(KOCH, 2)[-1])
    assert abridged(word, 21) == f"{str(word)[:10]} ... {str(word)[-10:]} ({len(word):,} modules)"
    assert len(repr(word)) < 2_050


@pytest.mark.parametrize("characters", range(1, 40))
def test_a_word_that_fits_is_shown_whole(characters: int) -> None:
    for system in (AGEING, KOCH):
        word = derive(system, 2)[-1]
        said = abridged(word, characters)
        assert said == str(word) if len(str(word)) <= characters else said.endswith(f" ({len(word)} modules)")


def test_a_coding_changes_what_is_written() -> None:
    assert derive(AGEING, 1)[-1].coded({"A(2)": "b", "[": "("}) == "b(B]"


def test_words_stand_below_one_another() -> None:
    derivation = derive(read("axiom: a\na -> ab\nb -> a"), 10)
    assert repr(derivation.column()) == str(derivation.column()) == repr(derivation)
    lines = str(derivation.column(centred=True)).split("\n")
    assert lines[0].startswith(" 0 ")
    assert lines[10].startswith("10 a b")
    assert lines[0].index("a") > 80
    assert str(derive(AGEING, 1).column(coding={"B": "b"})) == "0 A(1)\n1 A(2)[b]"


THIRDS = read("axiom: F(1) A(118587876497/38400000000) A(80/3) A(0.25) A(123456) A(25.7)")


def test_a_word_is_shown_with_four_digits_and_written_exactly() -> None:
    word = derive(THIRDS, 0)[0]
    assert repr(word) == "F(1)A(3.088)A(80/3)A(0.25)A(123456)A(25.7)"
    assert "118587876497/38400000000" in str(word)
    assert read_word(str(word)) == tuple(word)
    assert repr(derive(read("axiom: A(0.7)\nA(t) -> A(t+0.1)"), 3, arithmetic="float")) == (
        "0 A(0.7)\n1 A(0.7999999999999999)\n2 A(0.8999999999999999)\n3 A(0.9999999999999999)"
    )


@given(st.one_of(st.fractions().map(normalised), st.floats(allow_nan=False, allow_infinity=False), st.integers()))
def test_what_is_shown_of_a_value_is_near_it_and_short(value: int | Fraction | float) -> None:
    """It is longer than four digits only where it is whole, large, or just beside a number with fewer digits."""
    text, exact = number_text(rounded(value)), number_text(value)
    digits = re.sub(r"e.*|[./]|\D", "", text).strip("0")
    assert abs(Fraction(text) - Fraction(value)) <= Fraction(6, 10**DIGITS) * abs(Fraction(value))
    assert len(digits) <= DIGITS or abs(value) >= 10**DIGITS or text == exact
