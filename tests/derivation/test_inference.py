"""The systems behind words: all of them are found, each derives the words, and where there is none the reason is named.

The published systems are those of the literature on inference (McQuillan, Bernard and Prusinkiewicz 2018; Bernard and McQuillan
2018), as collected in the data set alilotfi90/D0L-Quant-and-Classical-Solver.
"""

from __future__ import annotations

import json
import random
from collections.abc import Iterator, Mapping, Sequence
from fractions import Fraction
from itertools import product
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from lsys_kit import ModelLimitError, derive, infer, limits, system
from lsys_kit.derivation.inference.infer import Fits, Wider, parting_step
from lsys_kit.derivation.inference.mending import Mending
from lsys_kit.derivation.inference.problem import Conditions, counted_tables, problem_of, read_words, table_of, tables
from lsys_kit.derivation.inference.stochastic import Choice
from lsys_kit.derivation.inference.word_equations import (
    Bounds,
    Equation,
    GivenUp,
    Trials,
    count_of,
    first_bounds,
    possible_lengths,
    solutions,
)
from lsys_kit.notation.model.modules import Module
from lsys_kit.notation.read import read

PUBLISHED = {
    case["name"]: case
    for case in json.loads((Path(__file__).parent / "cases" / "inference.json").read_text(encoding="utf-8"))["systems"]
}
Rules = Mapping[str, str]


def words_of(axiom: str, rules: Rules, steps: int) -> list[str]:
    """The words of a D0L system, by its definition."""
    words = [axiom]
    for _ in range(steps):
        words.append("".join(rules.get(letter, letter) for letter in words[-1]))
    return words


def published_words(name: str) -> list[str]:
    case = PUBLISHED[name]
    return words_of(case["axiom"], case["productions"], case["steps"])


def texts(fits: Fits) -> list[list[str]]:
    """The words that each system derives."""
    return [["".join(module.symbol for module in word) for word in derive(fit, len(fits.words) - 1)] for fit in fits]


def rules_of(fit: Any, letters: str) -> dict[str, str]:
    """What a system makes of some letters."""
    made = {rule.predecessor.symbol: "".join(item.symbol for item in rule.successor) for rule in fit.productions}
    return {letter: made.get(letter, letter) for letter in letters}


def fitting(words: Sequence[str], erasing: bool) -> Iterator[dict[str, str]]:
    """All rules that fit, by trying all parts of the words as successors."""
    letters = sorted({*"".join(words[:-1])})
    parts = {word[i:j] for word in words[1:] for i in range(len(word) + 1) for j in range(i, len(word) + 1)}
    for chosen in product(sorted(part for part in parts | {""} if part or erasing), repeat=len(letters)):
        rules = dict(zip(letters, chosen, strict=True))
        if words_of(words[0], rules, len(words) - 1) == words:
            yield rules


@pytest.mark.parametrize("name", PUBLISHED)
def test_all_systems_that_fit_published_words_are_found(name: str) -> None:
    case, words = PUBLISHED[name], published_words(name)
    fits = infer(words, case["constants"])
    assert len(fits) == case["fits"]
    assert texts(fits) == [words] * len(fits)
    assert any(rules_of(fit, "".join(case["productions"])) == case["productions"] for fit in fits)


@pytest.mark.parametrize(("steps", "systems"), [(1, 1), (2, 2), (3, 2), (4, 1)])
def test_each_step_of_anabaena_tells_more_of_its_rules(steps: int, systems: int) -> None:
    fits = infer(derive(system("J1"), steps))
    assert len(fits) == systems
    assert all(list(derive(fit, steps)) == list(derive(system("J1"), steps)) for fit in fits)


def test_the_rules_of_anabaena_are_found_from_five_words() -> None:
    assert set(infer(derive(system("J1"), 4))[0].productions) == set(system("J1").productions)


TINY = [
    ["a", "b"],
    ["ab", "ba"],
    ["ab", "abb", "abbbb"],
    ["a", "", ""],
    ["aa", "abab"],
    ["ab", "aab", "aabaab"],
    ["ab", "c"],
    ["abc", "abca"],
    ["aba", "bab"],
    ["a", "aa", "aaa"],
    ["a", ""],
    ["", "a"],
    ["", ""],
    ["abab", "cc"],
    ["ab", "ab", "ba"],
]


@pytest.mark.parametrize("erasing", [False, True])
@pytest.mark.parametrize("words", TINY, ids="-".join)
def test_the_fits_are_those_that_trying_all_finds(words: list[str], erasing: bool) -> None:
    same_as_by_trying(words, erasing)


def same_as_by_trying(words: list[str], erasing: bool) -> None:
    fits, letters = infer(words, erasing=erasing), "".join(sorted({*"".join(words[:-1])}))
    found = [tuple(rules_of(fit, letters).items()) for fit in fits]
    assert len(set(found)) == len(found)
    assert sorted(found) == sorted(tuple(rules.items()) for rules in fitting(words, erasing))
    assert bool(fits) == (fits.refusal is None)


LETTERS = st.sampled_from("ab")


@given(st.lists(st.text(LETTERS, max_size=4), min_size=2, max_size=4), st.booleans())
def test_the_fits_to_any_words_are_those_that_trying_all_finds(words: list[str], erasing: bool) -> None:
    same_as_by_trying(words, erasing)


@given(
    st.dictionaries(st.sampled_from("abcd"), st.text(st.sampled_from("abcd+["), max_size=3), min_size=1),
    st.text(st.sampled_from("abcd"), min_size=1, max_size=3),
    st.integers(1, 4),
)
def test_the_true_system_is_among_the_fits_and_each_derives_the_words(rules: Rules, axiom: str, steps: int) -> None:
    words = words_of(axiom, rules, steps)
    try:
        fits = infer(words, erasing=True)
    except ModelLimitError as error:
        fits = error.partial  # type: ignore[assignment]
    else:
        seen = "".join(sorted({*"".join(words[:-1])} - {*"+["}))
        assert {letter: rules.get(letter, letter) for letter in seen} in [rules_of(fit, seen) for fit in fits]
    assert texts(fits) == [words] * len(fits)


def test_hormone_diffusion_needs_both_neighbours() -> None:
    words = derive(system("J2"), 15)
    fits = infer(words)
    assert not fits
    assert str(fits) == (
        "No system fits these 16 words. Step 1 cannot come from step 0: letter 3 of step 0, a, would have to "
        "become b, and there is a. With context=(1, 1) one system fits."
    )
    assert not infer(words, context=(1, 0))
    found = infer(words, context=(1, 1))
    assert [list(derive(fit, 15)) for fit in found] == [list(words)]


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "steps", "said"),
    [
        (
            "P9",
            7,
            "With context=(1, 0) 4,978,590,703,566,480 systems fit: of 53 letters, told apart by their neighbours, 43 can "
            "become different words.",
        ),
        (
            "K17a",
            24,
            "With context=(1, 0), erasing=True 14,348,907 systems fit: of 58 letters, told apart by their neighbours, 30 "
            "can become different words.",
        ),
        (
            "K17b",
            31,
            "With context=(1, 0), erasing=True 129,140,163 systems fit: of 73 letters, told apart by their neighbours, 34 "
            "can become different words.",
        ),
    ],
)
def test_no_system_without_contexts_fits_where_neighbours_have_a_say(name: str, steps: int, said: str) -> None:
    fits = infer(derive(system(name), steps), constants="+-/")
    assert not fits
    assert fits.refusal is not None
    assert str(fits).endswith(said)


CONDITIONS = [Conditions(), Conditions(erasing=True), Conditions(context=(1, 0)), Conditions(erasing=True, context=(1, 1))]
BRANCHED = [["a", "a[b]", "a[b]b"], ["a[b]b", "a[b]b[b]"], ["ab", "[ab]", "[[ab]]"], ["a[b]", "[a]b"]]


@pytest.mark.parametrize("conditions", CONDITIONS, ids=("plain", "erasing", "left context", "erasing, both contexts"))
@pytest.mark.parametrize("words", [*TINY, *BRANCHED], ids="-".join)
def test_as_many_are_counted_as_are_found(words: list[str], conditions: Conditions) -> None:
    problem = problem_of(read_words(words), conditions)
    found, count = [*tables(problem)], counted_tables(problem)
    assert count.solutions == len(found)
    if found:
        assert {problem.letters[letter]: len(ways) for letter, ways in count.successors.items()} == {
            letter: len({table[letter] for table in found}) for letter in found[0]
        }
        assert table_of(problem, count.certain).items() <= found[0].items()


def test_an_equation_of_letters_that_occur_once_is_counted_by_its_cuts() -> None:
    equations = [Equation((0, "b", 1, 2), "abbab")]
    bounds = first_bounds(equations, 3, erasing=False)
    found = [*solutions(equations, bounds)]
    for usable in (lambda _: True, lambda word: word != "ab", lambda word: "b" in word, lambda word: word == "c"):
        fit = [each for each in found if all(map(usable, each.values()))]
        count = count_of(equations, bounds, usable)
        assert count.solutions == len(fit)
        assert count.solutions == 0 or count.successors == {letter: {each[letter] for each in fit} for letter in range(3)}
    assert len(found) == 3
    with pytest.raises(GivenUp):
        count_of(equations, bounds, trials=Trials(1 / 2))


def test_where_a_successor_may_end_is_what_its_counts_allow() -> None:
    alphabet = {"a": 0, "b": 1}
    for least, greatest in product(product(range(3), repeat=3), repeat=2):
        bounds = Bounds(alphabet, np.array([least]), np.array([greatest]))
        for text in ("", "b", "abba", "babab"):
            counts = [(text[:end].count("a"), text[:end].count("b"), end) for end in range(len(text) + 1)]
            fits = [each[-1] for each in counts if (np.array(least) <= each).all() and (each <= np.array(greatest)).all()]
            assert [*possible_lengths(0, text, bounds)] == fits


@pytest.mark.slow
@pytest.mark.parametrize(("name", "steps", "context"), [("P9", 3, (1, 1)), ("K17a", 5, (1, 0)), ("J2", 6, (1, 0))])
def test_as_many_systems_are_counted_as_are_found_for_known_ones(name: str, steps: int, context: tuple[int, int]) -> None:
    problem = problem_of(read_words(derive(system(name), steps)), Conditions(frozenset("+-/"), True, context))
    assert counted_tables(problem).solutions == sum(1 for _ in tables(problem))


def test_a_context_at_the_end_of_a_word_does_not_hold_within_it() -> None:
    words = ["aba", "baa", "cba", "bca", "cbc"]
    fits = infer(words, context=(1, 1))
    assert texts(fits) == [words] * len(fits) != []


def test_a_signal_passes_a_constant() -> None:
    words = derive(read("ignore: +\naxiom: b + a [+ a] a\nb < a -> b"), 3)
    found = infer(words, context=(1, 0))
    assert [str(rule) for rule in found[0].productions] == ["b < a -> b"]
    assert list(derive(found[0], 3)) == list(words)


def wrong(word: str, place: int, other: str) -> str:
    return word[:place] + other + word[place + 1 :]


def missing(word: str, place: int, other: str) -> str:
    return word[:place] + word[place + 1 :]


def too_many(word: str, place: int, other: str) -> str:
    return word[:place] + other + word[place:]


def swapped(word: str, place: int, other: str) -> str:
    return word[:place] + word[place : place + 2][::-1] + word[place + 2 :]


def refused(slip: Any, number: int) -> Iterator[tuple[bool, list[str]]]:
    """Whether the slip is named, and the words, for random systems whose words no system fits with it."""
    chance = random.Random(17)
    while number:
        letters = "abcde"[: chance.randint(2, 5)]
        rules = {letter: "".join(chance.choices(letters, k=chance.randint(1, 3))) for letter in letters}
        words = words_of(chance.choice(letters), rules, chance.randint(3, 5))
        step = chance.randrange(1, len(words))
        bad = slip(words[step], chance.randrange(len(words[step])), chance.choice(letters))
        if bad and bad != words[step] and not (fits := infer([*words[:step], bad, *words[step + 1 :]])):
            number -= 1
            yield any(in_letters(mending) == words for mending in fits.mended), words


def in_letters(mending: Mending) -> list[str]:
    """The words that a mending makes."""
    return ["".join(module.symbol for module in word) for word in mending.words]


@pytest.mark.slow
@pytest.mark.parametrize("slip", [wrong, missing, too_many, swapped])
def test_a_refusal_names_the_slip(slip: Any) -> None:
    assert sum(named for named, _ in refused(slip, 25)) >= 20


def test_a_refusal_names_a_slip_in_few_words() -> None:
    assert sum(named for named, _ in refused(wrong, 5)) >= 4


@pytest.mark.parametrize(
    ("words", "said"),
    [
        (["a", "ab", "abc", "abaab"], "if letter 3 of step 2, c, were a."),
        (["a", "ab", "aba", "abaab", "abaababa", "abaacabaabaab"], "if letter 5 of step 5, c, were b."),
        (["a", "ab", "aba", "abaa", "abaababa"], "if b stood behind letter 4 of step 3"),
        (["a", "ab", "aba", "baab", "abaababa"], "if a stood at the beginning of step 3"),
        (["a", "ab", "aba", "abaaab", "abaababa"], "if letter 5 of step 3, a, were left out."),
        (["a", "ab", "aba", "ababa", "abaababa"], "letters 4 and 5 of step 3, b a, changed places"),
        (["a", "ab", "aba", "baaab", "abaababa"], "letters 1 and 2 of step 3, b a, changed places"),
        (["a", "ab", "aba", "abaab", "ab", "abaababaabaab"], "would fit if the word of step 4 were a b a a b a b a."),
        (["a", "ab", "aba", "ab", "abaababa"], "if the word of step 3 were a b a a b."),
        (["abcdef", "uvxyz"], " other changes were made."),
        (["ab", "c"], "or if one other change were made. With erasing=True 2 systems fit: of 2 letters 2 can become different"),
        (["ab", "b", ""], "With erasing=True one system fits."),
        (["+a", "a+"], "letter 1 of step 0, +, would have to become +, and there is a."),
        (["a+b", "ab"], "letter 1 of step 0, a, has no successor"),
        (["a", "aa", "aa"], "letter 1 of step 1, a, has no successor"),
        (["abc", "ab"], "letter 1 of step 0, a, has no successor with which all others can have theirs."),
    ],
)
def test_a_refusal_says_where_and_why(words: list[str], said: str) -> None:
    assert said in str(infer(words))


def test_nothing_comes_from_the_empty_word() -> None:
    assert "Step 2 cannot come from step 1, which is empty." in str(infer(["a", "", "a"], erasing=True))


def test_systems_that_make_the_same_words_are_told_so() -> None:
    said = str(infer(derive(system("J1"), 2)))
    assert said.splitlines()[0] == "2 systems fit these 3 words; if bl stays as it is, their words are the same up to step 13:"
    assert "all have\n  ar -> al br\n" in said


def test_many_systems_are_not_all_shown() -> None:
    fits = infer(["abcde", "aabbccddee"])
    assert str(fits).splitlines()[0] == f"{len(fits)} systems fit these 2 words; they part at step 2:"
    assert str(fits).splitlines()[-1] == f" and {len(fits) - 20} more"


def test_words_too_large_to_be_looked_at_are_not_compared() -> None:
    with limits(modules=100):
        fits = infer(["ab", "abaab" * 15])
        assert "later words are too long to be compared" in str(fits)


def test_what_is_not_known_of_the_last_word_is_a_condition_of_what_is_said_of_later_ones() -> None:
    said = str(infer(["A", "Bd", "cAA"])).splitlines()[0]
    assert said == "2 systems fit these 3 words; if c stays as it is, their words are the same up to step 13:"


def test_of_letters_that_only_the_last_word_has_nothing_is_known() -> None:
    assert (
        str(infer(["a", "b[+c]c"])).splitlines()[-1] == "Nothing is known of what becomes of b, c: only the last word has it."
    )


@pytest.mark.parametrize(("name", "steps"), [("P3", 9), ("P3", 12), ("J4", 10), ("J5", 15), ("P4", 9), ("P4", 12), ("P5", 6)])
def test_laws_and_thresholds_of_parameters_are_found(name: str, steps: int) -> None:
    """The one system with the fewest productions goes on as the true one does."""
    fits = infer(derive(system(name), steps))
    assert [list(derive(fit, steps + 6)) for fit in fits] == [list(derive(system(name), steps + 6))]
    assert len(fits[0].productions) == len(system(name).productions)


def test_conditions_stand_in_conjunction() -> None:
    assert str(infer(derive(system("P4"), 9))) == "\n".join(
        [
            "One system fits these 10 words:",
            "  M(x,y) : x < 5 -> M(x + 1,y)",
            "  M(x,y) : x >= 5 && y == -1 -> M(1,-1)M(2,1)",
            "  M(x,y) : x >= 5 && y == 1 -> M(2,-1)M(1,1)",
            "The number that a condition compares with could lie anywhere between the values that occur on its two sides.",
        ]
    )


@pytest.mark.parametrize(
    ("rules", "steps"),
    [
        ("axiom: F(1)\nF(x) -> F(2*x) B(x)\nB(x) -> B(x + 1/2)", 4),
        ("axiom: F(1)\nF(x) -> F(3*x - 1)", 4),
        ("axiom: A(0,1)\nA(x,y) -> A(y, x+y)", 5),
        ("axiom: A(9,1)\nA(x,y) -> A(x - y, y)", 4),
        ("axiom: A(1,2,3,4)\nA(a,b,c,d) -> A(b,c,d,a)", 4),
        ("axiom: F(0.5)\nF(x) -> F(x*0.1)", 4),
        ("axiom: C(0)\nC(t) : t <= 2 -> C(t+1)\n", 5),
        ("axiom: A(0) [ /(180) B(7) ]\nA(t) : t == 2 -> A(5)\nA(t) : t < 2 -> A(t+1)\nA(t) : t > 2 -> A(t - 1)", 9),
    ],
)
def test_other_laws_are_found(rules: str, steps: int) -> None:
    words = derive(read(rules), steps)
    found = infer(words)
    assert [list(derive(fit, steps + 2)) for fit in found] == [list(derive(read(rules), steps + 2))]


def test_values_without_a_law_are_taken_one_by_one() -> None:
    words = [[Module("a", (value,))] for value in (3, 1, 4, 15, 9, 2, 6)]
    found = infer(words)
    assert [list(word) for word in derive(found[0], 6)] == words


def test_several_systems_part_where_the_first_two_do() -> None:
    fits = [read(f"axiom: a\na -> a b\nb -> {successor}") for successor in ("a", "b", "c")]
    assert parting_step(fits, 1) == 2


def test_how_many_systems_fit_under_wider_conditions_is_said() -> None:
    erasing = Conditions(erasing=True)
    assert [str(Wider(erasing, many)) for many in (None, 1, 20)] == [
        "With erasing=True many systems fit.",
        "With erasing=True one system fits.",
        "With erasing=True 20 systems fit.",
    ]


@pytest.mark.slow
def test_what_is_known_of_later_words_is_said() -> None:
    assert "later words are too long to be compared" in str(infer(["ab", "ab" * 400]))
    assert "if c, d stay as they are, their words are the same up to step" in str(infer(["ab", "cdcd"]))


def test_a_production_that_was_used_perhaps_is_told_so() -> None:
    choice = Choice(Module("a"), (Module("b"),), Fraction(1, 2), 0.1, 1.5, 3)
    assert "about 1.5" in str(choice)


def test_systems_whose_words_never_part_are_told_so() -> None:
    assert "their words are the same up to step 12" in str(infer(["ab", "abab"]))


def test_first_words_that_take_too_long_to_refute_are_left_to_the_whole_search(monkeypatch: pytest.MonkeyPatch) -> None:
    words = list(derive(system("K5"), 4))
    monkeypatch.setattr("lsys_kit.derivation.inference.infer.MOST_SEEN_FOR_ONE", 0)
    assert len(infer(words)) == 1
