"""Words with a misprint, without a step, or not wholly known: the fewest edits with which some system fits."""

from __future__ import annotations

import random
from collections.abc import Iterator
from itertools import product
from typing import Any

import pytest
from hypothesis import assume, example, given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, infer, read, system, systems
from lsys_kit.derivation.inference import infer as infer_module
from lsys_kit.derivation.inference import mending, word_equations
from lsys_kit.derivation.inference.mending import Effort, Near, Stretches, is_one_of
from tests.derivation.test_inference import Rules, in_letters, texts, words_of

DETERMINISTIC = [id for id in systems() if all(rule.probability is None for rule in system(id).productions)]
MOST_MODULES, MOST_ITEMS = 12_000, 500_000
"""Of so many modules are the words that a system is found from, after so many looks at items of equations: some two seconds."""
FIBONACCI = words_of("a", {"a": "ab", "b": "a"}, 16)


def distance(one: str, other: str) -> int:
    """Of letters that are another, missing, too many, or exchanged with their neighbour, once (optimal string alignment)."""
    costs = {(i, j): i + j for i in range(len(one) + 1) for j in range(len(other) + 1)}
    for i, j in product(range(1, len(one) + 1), range(1, len(other) + 1)):
        costs[i, j] = min(costs[i - 1, j] + 1, costs[i, j - 1] + 1, costs[i - 1, j - 1] + (one[i - 1] != other[j - 1]))
        if i > 1 and j > 1 and one[i - 1] == other[j - 2] and one[i - 2] == other[j - 1]:
            costs[i, j] = min(costs[i, j], costs[i - 2, j - 2] + 1)
    return costs[len(one), len(other)]


LETTERS = st.sampled_from("ab")


@given(st.text(LETTERS, max_size=7), st.text(LETTERS, max_size=7), st.integers(0, 2))
@example("abb", "bab", 1)
@example("aab", "abaa", 2)
def test_a_word_is_near_another_if_so_many_edits_lie_between(word: str, other: str, most: int) -> None:
    assert is_one_of(other, Near(word, most)) == (distance(word, other) <= most)


@given(st.text(st.sampled_from("ab?"), max_size=5), st.text(LETTERS, max_size=6))
def test_a_question_mark_stands_for_any_stretch(word: str, other: str) -> None:
    fitting = {""}
    for letter in word:
        more = {a + b for a in fitting for b in ([letter] if letter != "?" else map("".join, _all_words(6)))}
        fitting = {each for each in more if len(each) <= 6}
    assert is_one_of(other, Stretches(word, "?")) == (other in fitting)


def _all_words(longest: int) -> Iterator[tuple[str, ...]]:
    return (each for size in range(longest + 1) for each in product("ab", repeat=size))


@pytest.mark.parametrize("step", [2, 5, 9, pytest.param(16, marks=pytest.mark.slow)])
def test_of_seventeen_words_with_one_wrong_letter_it_is_found(step: int) -> None:
    words, place = [*FIBONACCI], len(FIBONACCI[step]) // 2
    found = words[step][place]
    words[step] = f"{words[step][:place]}{'b' if found == 'a' else 'a'}{words[step][place + 1 :]}"
    fits = infer(words)
    assert not fits
    (only,) = fits.mended
    assert in_letters(only) == FIBONACCI
    assert (only.edits[0].step, only.edits[0].place, str(only.edits[0].instead[0])) == (step, place + 1, found)
    assert [str(rule) for rule in only.systems[0].productions] == ["a -> a b", "b -> a"]
    assert str(fits).endswith("One system fits the mended words:\n  a -> a b\n  b -> a")


@pytest.mark.slow
@pytest.mark.parametrize("id", DETERMINISTIC)
def test_of_words_with_one_wrong_letter_soon_all_is_said(id: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Up to seventeen words: what may be wrong is found, or out of reach, after so many looks as a machine has time for."""
    rng, looks, cost = random.Random(id), list[float](), word_equations.cost_of_look
    monkeypatch.setattr(word_equations, "cost_of_look", lambda *seen: looks.append(cost(*seen)) or looks[-1])  # type: ignore[func-returns-value]
    try:
        derivation = derive(system(id), 0)
        while len(derivation) < 17 and sum(derivation.to(len(derivation)).lengths) <= MOST_MODULES:
            derivation = derivation.to(len(derivation))
    except LSystemError:  # its modules ask something, or its words are of another kind
        return
    words = [[*word] for word in derivation]
    step = rng.randrange(1, len(words)) if len(words) > 1 else 0
    others = sorted({module for word in words for module in word if module.symbol not in "[]+-"} - {*words[step][:1]}, key=str)
    asks = any(module.symbol[0] in "?%" for word in words for module in word)  # no letter that rules alone replace
    if len(words) < 2 or not words[step] or not others or asks:
        return
    words[step][0] = rng.choice(others)
    try:
        fits = infer(words)
    except ModelLimitError:  # more than a thousand fit
        fits = None
    assert sum(looks) <= MOST_ITEMS
    assert fits is None or fits or fits.refusal.contradiction or fits.mended or fits.refusal.out_of_reach


def test_two_wrong_letters_in_different_words_are_found() -> None:
    words = ["a", "ab", "aba", "abaab", "abaabbba", "abaababaabaab", "abaababaabaababaababb"]
    (only,) = infer(words).mended
    assert str(only) == "letter 6 of step 4, b, were a and letter 21 of step 6, b, were a"


def test_a_step_that_is_missing_is_found_with_its_word() -> None:
    fits = infer([*FIBONACCI[:6], *FIBONACCI[7:10]])
    assert [in_letters(each) for each in fits.mended] == [FIBONACCI[:10]]
    assert "would fit if there were a step more between steps 5 and 6, a b a a b a b a a b a a b a b a a b a b a." in str(fits)


def test_a_step_that_stands_there_twice_is_found() -> None:
    fits = infer([*FIBONACCI[:5], *FIBONACCI[4:8]])
    assert FIBONACCI[:8] in [in_letters(each) for each in fits.mended]
    assert "if the word of step 4 were left out" in str(fits)


def test_a_letter_is_suspected_before_a_step_and_a_step_before_a_word() -> None:
    assert [str(each) for each in infer(["a", "ab", "abb", "abba"]).mended] == ["letter 4 of step 3, a, were b"]
    assert [str(each) for each in infer(["a", "ab", "aba", "ab", "abaababa"]).mended] == ["the word of step 3 were a b a a b"]


@given(
    st.dictionaries(st.sampled_from("abc"), st.text(st.sampled_from("abc"), min_size=1, max_size=3), min_size=3),
    st.integers(3, 5),
    st.data(),
)
def test_each_mending_is_fitted_by_its_systems_and_has_as_many_edits_as_were_made(rules: Rules, steps: int, data: Any) -> None:
    words = words_of("a", rules, steps)
    step = data.draw(st.integers(1, steps))
    place = data.draw(st.integers(0, len(words[step]) - 1))
    right = words[step][place]
    words[step] = words[step][:place] + data.draw(st.sampled_from("abc")) + words[step][place + 1 :]
    assume(right in "".join(words))  # a letter that stands nowhere else is not thought of
    try:
        fits = infer(words)
    except ModelLimitError:  # more than a thousand fit
        return
    for each in fits.mended[:6]:
        assert len(each.edits) == 1
        assert each.systems
        assert all([tuple(word) for word in derive(found, len(each.words) - 1)] == [*each.words] for found in each.systems)
    assert fits or fits.mended or fits.refusal.out_of_reach


@pytest.mark.slow
@pytest.mark.parametrize(
    ("words", "filled", "said"),
    [
        (["a", None, "aba", "abaab"], {1: "ab"}, "The word of step 1 is a b."),
        ([None, "ab", "aba", "abaab"], {0: "a"}, "The word of step 0 is a."),
        (["a", None, None, "abaab", "abaababa"], {1: "ab", 2: "aba"}, "The word of step 2 is a b a."),
        (["a", "ab", "a?", "abaab", "abaababa"], {2: "aba"}, "The word of step 2 is a b a."),
        (["a", "ab", "aba", "?ab", "?"], {3: "abaab"}, "The word of step 3 is a b a a b."),
        (["a", "[b ? a]", "[b a]"], None, "No system"),
    ],
)
def test_what_is_not_known_is_filled_in(words: list[str | None], filled: dict[int, str] | None, said: str) -> None:
    fits = infer(words)
    assert said in str(fits)
    for step, word in (filled or {}).items():
        assert "".join(module.symbol for module in fits.words[step]) == word
        assert texts(fits)[0][step] == word


@pytest.mark.slow
def test_all_systems_that_fit_with_an_unknown_word_are_those_that_trying_all_finds() -> None:
    """Every word of up to three letters is tried in the place of the unknown one."""
    for words in (["a", None, "aab"], ["ab", None, "bab"], ["b", "a", None, "ba"], ["a", "ab", None, "abb"]):
        at = words.index(None)
        tried = {
            str(fit) for other in map("".join, _all_words(3)) if other for fit in infer([*words[:at], other, *words[at + 1 :]])
        }
        assert {str(fit) for fit in infer(words)} == tried


def test_a_misprint_beside_an_unknown_word_is_found() -> None:
    fits = infer(["a", "ab", "aba", None, "abbababa", "abaababaabaab"])
    assert not fits
    assert [in_letters(each) for each in fits.mended] == [FIBONACCI[:6]]
    assert str(fits).splitlines()[0] == (
        "No system fits these 6 words. A system without contexts would fit if letter 3 of step 4, b, were a. One system fits "
        "the mended words:"
    )


def test_a_misprint_before_a_last_word_that_is_not_known_is_found() -> None:
    (only,) = infer(["a", "ab", "aba", "abbab", None]).mended
    assert str(only) == "letter 3 of step 3, b, were a"


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["aa", "bcbc", "aaaaaa", "bcbcbcbcbcbd"], "Two systems fit the mended words."),
        (["bc", "bcbc", "bcbcbcbc", "bcbcbcbcbcbcbcbd"], "Several systems fit the mended words."),
    ],
)
def test_of_several_systems_that_fit_mended_words_none_is_named(words: list[str], said: str) -> None:
    fits = infer(words)
    assert len(fits.mended[0].systems) == {"Two": 2}.get(said.split()[0], 3)
    assert str(fits).endswith(said)


def test_systems_that_fill_in_different_words_are_told_so() -> None:
    said = str(infer(["a", None, "abaab"]))
    assert said.splitlines()[0] == "2 systems fit these 3 words; they part at step 3:"
    assert "The systems have different words of step 1." in said


def test_an_unknown_axiom_is_one_of_several() -> None:
    fits = infer([None, "abab", "abcabc"])
    assert {str(fit.axiom[0]) for fit in fits} >= {"a"}
    assert all([*map(str, derive(fit, 2))][1:] == ["a b a b", "a b c a b c"] for fit in fits)


@pytest.mark.parametrize("words", [["a", "ab", "ab?"], ["abc", None, None, "abaababaabaab" * 9]])
def test_what_is_out_of_reach_is_said_to_be(words: list[str | None]) -> None:
    with pytest.raises(ModelLimitError, match=r"^What is unknown of these \d words is out of reach. Give more words"):
        infer(words)


def test_unknown_words_have_no_contexts() -> None:
    with pytest.raises(ModelValueError, match="With contexts all words must be known"):
        infer(["a", None, "a"], context=(1, 0))


def test_too_many_systems_with_unknown_words_are_refused(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(infer_module, "MOST_FITS", 1)
    with pytest.raises(ModelLimitError, match="More than 1 systems fit these 3 words"):
        infer(["a", None, "abaab"])


def test_a_misprint_in_a_published_plant_is_found() -> None:
    words = [str(word).replace(" ", "") for word in derive(read("axiom: X\nX -> F[+X][-X]F X\nF -> F F"), 5)]
    chance = random.Random(3)
    for _ in range(4):
        step = chance.randrange(2, 6)
        place = chance.randrange(len(words[step]))
        bad = words[step][:place] + words[step][place + 1 :]
        fits = infer([*words[:step], bad, *words[step + 1 :]])
        assert words in [in_letters(each) for each in fits.mended]


def test_modules_with_values_are_mended_too() -> None:
    words = [[str(module) for module in word] for word in derive(system("J1"), 6)]
    words[4][2] = "al"
    assert [str(each) for each in infer(words).mended] == [f"letter 3 of step 4, al, were {derive(system('J1'), 6)[4][2]}"]


def test_a_search_for_edits_that_is_too_long_is_broken_off(monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setattr(mending, "MOST_READ_FOR_ONE", 10)
    monkeypatch.setattr(infer_module, "Effort", lambda left=100: Effort(left))
    fits = infer(["a", "ab", "aba", "abbab", "abaababa"])
    assert "is out of reach" in str(fits)
    assert not fits.mended
