"""Stochastic systems from several derivations: the productions are found, and the probabilities lie within their errors."""

from __future__ import annotations

from collections.abc import Mapping
from fractions import Fraction
from itertools import pairwise
from typing import Any

import pytest

from lsys_kit import LSystemError, ModelLimitError, derive, infer, read
from lsys_kit.derivation.inference import stochastic
from lsys_kit.derivation.inference.infer import StochasticFits

SYSTEMS = {
    "ABOP, section 1.7": ("axiom: F\nF -> F[+F]F[-F]F : 1/3\nF -> F[+F]F : 1/3\nF -> F[-F]F : 1/3", 3),
    "two letters": ("axiom: a\na -> a b : 0.6\na -> b a a : 0.4\nb -> a : 0.5\nb -> b : 0.5", 5),
    "three letters": ("axiom: a\na -> b a : 0.7\na -> c : 0.3\nb -> b b : 0.2\nb -> c b : 0.8\nc -> a c", 6),
    "two buds": ("axiom: X\nX -> F[+X]F X : 0.5\nX -> F[-X]X : 0.5\nF -> F F", 4),
}
"""Systems with a number of steps; each letter has successors that cannot be taken for one another."""


def inferred(rules: str, steps: int, several: int) -> StochasticFits:
    return infer([derive(read(rules), steps, seed=seed) for seed in range(several)], stochastic=True)


@pytest.mark.slow
@pytest.mark.parametrize("name", SYSTEMS)
def test_the_productions_are_found_and_the_probabilities_within_four_errors(name: str) -> None:
    rules, steps = SYSTEMS[name]
    fits, wanted = inferred(rules, steps, 6), read(rules)
    found = {(str(each.letter), tuple(map(str, each.successor))): each for each in fits.choices}
    for rule in wanted.productions:
        probability = Fraction(1) if rule.probability is None else Fraction(str(rule.probability).replace(" ", ""))
        each = found.pop((str(rule.predecessor), tuple(map(str, rule.successor))))
        assert abs(each.probability - probability) <= 4 * each.error
        assert 0 <= each.times <= each.of
    assert not found


def test_probabilities_of_a_letter_sum_to_one_and_a_system_is_made_of_them() -> None:
    fits = inferred(*SYSTEMS["two letters"], 4)
    for letter in ("a", "b"):
        assert sum(each.probability for each in fits.choices if str(each.letter) == letter) == 1
    assert {str(rule.predecessor) for rule in fits[0].productions} == {"a", "b"}
    assert derive(read(str(fits[0])), 3).lengths[0] == 1


@pytest.mark.slow
def test_more_derivations_leave_smaller_errors() -> None:
    few, many = (inferred(*SYSTEMS["two letters"], several) for several in (3, 12))
    assert max(each.error for each in many.choices) < max(each.error for each in few.choices)


def test_of_a_deterministic_system_there_is_no_doubt() -> None:
    fits = infer(["a", "ab", "aba", "abaab"], stochastic=True)
    assert [str(rule) for rule in fits[0].productions] == ["a -> a b", "b -> a"]
    assert "±" not in str(fits)
    assert str(fits).splitlines()[0] == "The stochastic system that fits this derivation (3 steps) best:"


def test_constants_stay_and_brackets_are_nested() -> None:
    fits = infer([["F", "F[+F]F"], ["F", "FF"], ["F", "F[+F]F"]], stochastic=True)
    assert [str(rule) for rule in fits[0].productions] == ["F -> F[+F]F : 2/3", "F -> F F : 1/3"]


def test_of_letters_that_only_last_words_have_nothing_is_known() -> None:
    assert str(infer([["a", "bc"], ["a", "ba"]], stochastic=True)).splitlines()[-1] == (
        "Nothing is known of what becomes of b, c: only last words have it."
    )


def test_where_no_stochastic_system_fits_none_is_given() -> None:
    assert str(infer([["ab", "a"]], stochastic=True)).startswith("No stochastic system without contexts fits")
    assert infer([["ab", "a"]], stochastic=True, erasing=True)


def test_a_rare_successor_that_only_a_long_word_has_is_found() -> None:
    short = [["a", "aa"]] * 40
    fits = infer([*short, ["a" * 60, "aa" * 30 + "ac" + "aa" * 29]], stochastic=True)
    assert "a -> a c" in str(fits)


def test_where_too_many_rare_successors_would_have_to_be_looked_for_that_is_said(monkeypatch: pytest.MonkeyPatch) -> None:
    """Each search finds what one more long word has; `No system fits` would be wrong."""
    monkeypatch.setattr(stochastic, "MOST_SEARCHED", 6)
    derivations = [["a", "b"], ["aaa", "bbcb"]]
    assert "a -> c b" in str(infer(derivations, stochastic=True))
    monkeypatch.setattr(stochastic, "MOST_SEARCHES", 1)
    with pytest.raises(ModelLimitError, match="too long for a stochastic system"):
        infer(derivations, stochastic=True)


def made(before: str, after: str, successors: Mapping[str, set[str]]) -> bool:
    """Whether a word becomes another where each letter has one of its successors; a constant has itself."""
    if not before:
        return not after
    ways = successors.get(before[0], {before[0]})
    return any(after.startswith(way) and made(before[1:], after[len(way) :], successors) for way in ways)


@pytest.mark.parametrize(
    "derivations",
    [
        [["aa", "aaa"]] * 3,  # no successor can be done without, though each is rare
        [["b", "a", "a", "bbb", "baab"]],
        [["b", "aab"], ["b", "aab", "aaaab", "a" * 12 + "b", "a" * 29 + "b"], ["a", "a", "aaa"]],  # slow to settle
        [["a+b", "ab+c"], ["a+b", "a+b"]],
        [["+-", "+-"], ["a-", "b-"]],
    ],
)
def test_the_productions_make_every_step(derivations: list[list[str]]) -> None:
    fits = infer(derivations, stochastic=True)
    successors: dict[str, set[str]] = {}
    for each in fits.choices:
        successors.setdefault(str(each.letter), set()).add("".join(map(str, each.successor)))
    assert all(made(*step, successors) for words in derivations for step in pairwise(words))
    for letter in successors:
        whole = sum(each.probability for each in fits.choices if str(each.letter) == letter)
        assert whole == pytest.approx(1, abs=1e-6)


@pytest.mark.parametrize("words", [["a+", "a"], ["a+", "+a"], ["+a", "a+"]])
def test_constants_that_do_not_stay_are_in_no_system(words: list[str]) -> None:
    assert not infer([words], stochastic=True)


@pytest.mark.parametrize(
    ("given", "choices", "message"),
    [
        ("ab", {}, "Several derivations are needed, not str"),
        ([], {}, "Several derivations are needed; there are none"),
        ([["a", None]], {}, "all words must be known"),
        ([["a"]], {}, "Rules are found from two words at least"),
        ([["", ""]], {}, "All these words are empty"),
        ([["a", "b"]], {"context": (1, 0)}, "Angles and contexts are not for stochastic systems"),
        ([["a", "b"]], {"angle": 60}, "Angles and contexts are not for stochastic systems"),
        ([["a", "b"]], {"stochastic": 1}, 'True or False for "stochastic" is needed'),
        ([["ab" * 900, "ba" * 900]], {}, "too long for a stochastic system"),
        ([["a" * 4_000, "b" * 4_000]], {}, "too long for a stochastic system"),
        ([[[f"a{at}" for at in range(500)], [f"b{at}" for at in range(500)]]], {}, "too long for a stochastic system"),
        ([["a", "b"]] * 1_001, {}, "There are more than 1,000 derivations"),
    ],
)
def test_what_is_no_derivations_is_refused(given: Any, choices: dict[str, Any], message: str) -> None:
    with pytest.raises(LSystemError, match=message):
        infer(given, **{"stochastic": True, **choices})
