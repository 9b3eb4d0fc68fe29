"""What `infer` refuses or breaks off, and the forms in which it takes words."""

from __future__ import annotations

from collections.abc import Iterator
from math import comb
from typing import Any

import pytest

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, infer, limits, read, system
from lsys_kit.derivation.inference import infer as infer_module
from lsys_kit.derivation.inference import refusals
from lsys_kit.derivation.inference.problem import Problem, Table, tables
from tests.derivation.test_inference import texts


@pytest.mark.slow
def test_more_than_a_thousand_fits_are_refused() -> None:
    with pytest.raises(ModelLimitError, match=r"^17,620,076,360 systems fit these 2 words. Give more steps. They") as refused:
        infer(["abcdefghijklmn", "abcdefghijklmnabcdefghijklmnabcdefghijklmn"])
    assert (len(refused.value.partial), refused.value.needed) == (1000, comb(41, 13))  # type: ignore[arg-type]


def test_too_many_fits_are_refused_with_those_that_were_found(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(infer_module, "MOST_FITS", 20)
    with pytest.raises(
        ModelLimitError,
        match=r"^1,716 systems fit these 2 words. Give more steps. They differ in what "
        r"becomes of a \(8 ways\), b \(35 ways\), .*, g \(8 ways\).$",
    ) as refused:
        infer(["abcdefg", "abcdefgabcdefg"])
    assert (len(refused.value.partial), refused.value.needed) == (20, comb(13, 6))  # type: ignore[arg-type]
    with pytest.raises(ModelLimitError, match=r"^55 systems fit these 3 words. Give more steps. All have x -> a b c. They"):
        infer(["x", "abc", "abcdeabcdefg"])


def test_more_fits_than_can_soon_be_counted_are_refused_with_what_is_known(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(infer_module, "MOST_FITS", 20)
    monkeypatch.setattr(infer_module, "MOST_TRIED_TO_COUNT", 3)
    with pytest.raises(
        ModelLimitError,
        match=r"^More than 20 systems fit these 2 words. .* They differ in what "
        r"becomes of e, f, g.$",
    ) as refused:
        infer(["abcdefg", "abcdefgabcdefg"])
    assert refused.value.needed is None
    with pytest.raises(ModelLimitError, match=r"All that were found have x -> a b c d e f g. They differ"):
        infer(["x", "abcdefg", "abcdefgabcdefg"])


@pytest.mark.slow
def test_of_modules_with_values_it_is_said_that_laws_are_looked_for_without_contexts() -> None:
    ages = derive(read("axiom: a(0) b(7)\na(t) -> a(t+1) a(t+1)\nb(t) -> b(t+1)"), 4)
    with pytest.raises(
        ModelLimitError,
        match=r"systems fit these 5 words. With contexts, a module with other values, or other "
        r"neighbours, is another letter: laws of values are looked for without contexts",
    ):
        infer(ages, context=(1, 1))


@pytest.mark.parametrize(
    ("given", "message"),
    [
        ("aab", "A sequence of words is needed, not str"),
        (7, "A sequence of words is needed, not int"),
        ([], "Rules are found from two words at least; there are none"),
        (["a"], "Rules are found from two words at least; there is one"),
        (["a", 7], "The word of step 1 must be a text or a row of modules, not int"),
        (["a", b"a"], "The word of step 1 must be a text or a row of modules, not bytes"),
        (["a", ["a", 7]], "The word of step 1 must be a text or a row of modules, and has 7"),
        (["a", "a%"], 'The word of step 1 has the module "%", which is no letter that rules alone replace'),
        (["a", ["?P"]], 'The word of step 1 has the module "?P", which is no letter that rules alone replace'),
        (["A(1)", "A(nan)"], 'The word of step 1 has "(nan)", which are no values'),
        (["A(1/0) B", "A(1)"], 'The word of step 0 has "(1/0)", which are no values'),
        (["A(1)", "A(2"], 'The word of step 1 has "(2", which are no values'),
        (["a" * 60_000] * 2, "The words up to step 1 have more than 100,000 modules"),
    ],
)
def test_what_is_no_sequence_of_words_is_refused(given: Any, message: str) -> None:
    with pytest.raises(LSystemError) as refused:
        infer(given)
    assert refused.value.message == message


def test_a_value_that_is_not_known_is_refused() -> None:
    growing = read("c = 1\naxiom: a(c)\na(x) -> a(x+c)")
    with pytest.raises(ModelValueError, match=r"^The word of step 0 has a\(c\), whose value is not known"):
        infer(derive(growing, 2, c="c"))


@pytest.mark.parametrize(
    ("choices", "message"),
    [
        ({"constants": 7}, "The constants must be symbols in a row, not int"),
        ({"constants": [7]}, "A symbol as a constant is needed"),
        ({"context": 1}, "The context must be two whole numbers"),
        ({"erasing": 1}, 'True or False for "erasing" is needed, not int'),
        ({"context": "11"}, "The context must be two whole numbers"),
        ({"context": (1,)}, "The context must be two whole numbers"),
        ({"context": (-1, 0)}, "Each size of the context must be a whole number from 0 on, not -1"),
    ],
)
def test_what_cannot_be_looked_for_is_refused(choices: Any, message: str) -> None:
    with pytest.raises(ModelValueError, match=message):
        infer(["a", "ab"], **choices)


def test_contexts_need_branches_that_are_well_nested() -> None:
    words = ["ab", "b[a", "a]"]
    assert "With context" not in str(infer(words))
    with pytest.raises(ModelValueError, match=r"^The word of step 1 has a bracket without its partner"):
        infer(words, context=(1, 0))
    fits = infer(["ab", "[a]b", "[[a]]b"], context=(0, 1))
    assert [[str(rule) for rule in fit.productions] for fit in fits] == [["a -> [a]"]]


def test_words_are_texts_of_letters_or_rows_of_names_or_as_derive_prints_them() -> None:
    expected = infer(derive(system("J1"), 4)).systems
    printed = [str(word) for word in derive(system("J1"), 4)]
    assert infer(printed).systems == infer([word.split() for word in printed]).systems == expected
    assert infer(["A(1, 2)", "A(1e-05, 2)"]).systems == infer(["A(1,2)", "A(0.00001,2)"]).systems
    assert infer([str(word) for word in derive(system("P4"), 9)]).systems == infer(derive(system("P4"), 9)).systems


def test_a_search_that_takes_too_long_keeps_what_it_found(monkeypatch: pytest.MonkeyPatch) -> None:
    def long(problem: Problem) -> Iterator[Table]:
        yield next(tables(problem))
        raise ModelLimitError("The search was not finished", limit=1)

    monkeypatch.setattr(infer_module, "tables", long)
    with pytest.raises(ModelLimitError, match=r"^The search was not finished.$") as refused:
        infer(["a", "ab", "aba"])
    assert texts(refused.value.partial) == [["a", "ab", "aba"]]  # type: ignore[arg-type]


def test_that_no_system_fits_is_said_though_the_reason_takes_too_long(monkeypatch: pytest.MonkeyPatch) -> None:
    def long(*_: object) -> None:
        raise ModelLimitError("The reason was not found", limit=1)

    monkeypatch.setattr(infer_module, "contradiction", long)
    assert str(infer(["ab", "c"])) == "No system fits these 2 words."


def test_what_a_search_asks_of_the_budget_names_the_search() -> None:
    with limits(seconds=1e-9), pytest.raises(ModelLimitError, match=r"^The search for systems was not finished, with 0 found"):
        infer(["ab" * 50, "ab" * 99])


@pytest.mark.slow
def test_no_more_is_said_of_a_refusal_than_is_soon_found(monkeypatch: pytest.MonkeyPatch) -> None:
    words = ["abcab", "aabbcabcabcaab", "aabbcabcaabbcabcaabbcabcaabbcaabbcabcaabbcaabbcabca"]
    monkeypatch.setattr(infer_module, "MOST_SUCCESSORS_TRIED", 10)
    assert "Step 2 cannot come from step 1" in str(infer(words))
    assert str(infer(words)).endswith("With context=(2, 1) many systems fit.")
    monkeypatch.setattr(infer_module, "MOST_TRIED_FOR_ONE", 0)
    assert str(infer(words)).startswith("No system fits these 3 words. Step 2")
    monkeypatch.setattr(refusals, "MOST_SUCCESSORS_TRIED", 0)
    assert str(infer(words)) == (
        "No system fits these 3 words. What would have to be another letter or word is out of reach: too much is possible. "
        "Whether a system with contexts fits is out of reach."
    )
