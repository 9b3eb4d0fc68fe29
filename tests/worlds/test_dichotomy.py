"""The sensitive dichotomy of seed 003: both apices of a fork grow on, unless another shoot is near."""

from __future__ import annotations

import math
from collections.abc import Sequence
from fractions import Fraction
from pathlib import Path

import pytest

from lsys_kit import LSystemError, ModelLimitError, ModelValueError, derive, draw, explain, explore, growth, limits, read, write
from lsys_kit.classroom.magic import shown
from lsys_kit.derivation.derive import derive as words_alone
from lsys_kit.notation.model.system import LSystem
from lsys_kit.worlds.sight import observe

LISTING = (Path(__file__).parents[1] / "listings" / "003-sensitive-dichotomy.grogra.txt").read_text(encoding="utf-8")


def dichotomy(threshold: float = 60) -> LSystem:
    return read(LISTING.replace("60", str(threshold)), "grogra")


def shoots(system: LSystem, steps: int, **choices: object) -> list[int]:
    """How many shoots there are at each step."""
    return [word.counts().get("F", 0) for word in derive(system, steps, **choices)]


def by_definition(threshold: float, steps: int) -> list[str]:
    """The words of the dichotomy, derived by reading the rules: the turtle in the plane, every distance rounded."""
    word, words = ["a"], []
    for _ in range(steps + 1):
        words.append("".join(word))
        place, way, last, stack, drawn, asking = (0.0, 0.0), 0, (), [], [], {}
        for at, module in enumerate(word):
            if module in "ab":
                asking[at] = last
            elif module in "+-":
                way += 30 if module == "+" else -30
            elif module in "FG":
                end = tuple(
                    p + {"F": 100, "G": 70}[module] * f(math.radians(way))
                    for p, f in zip(place, (math.sin, math.cos), strict=True)
                )
                drawn.append((place, end))
                place, last = end, (len(drawn) - 1, *last)
            elif module == "[":
                stack.append((place, way, last))
            elif module == "]":
                place, way, last = stack.pop()
        word = [
            made
            for at, module in enumerate(word)
            for made in (grown(module, asking[at], drawn, threshold) if at in asking else module)
        ]
    return words


def grown(module: str, branch: Sequence[int], drawn: Sequence[Sequence[Sequence[float]]], threshold: float) -> str:
    points = [point for number, ends in enumerate(drawn) if number not in branch[:2] for point in ends]
    near = min((math.dist(drawn[branch[0]][1], point) for point in points), default=math.inf) if branch else math.inf
    return f"{'F' if module == 'a' else 'G'}[-b]+a" if near > threshold + 1e-9 else module


def told(word: Sequence) -> str:
    """A word of the listing in the letters of `by_definition`; a roll by half a turn only changes sides."""
    lengths = {100: "F", 70: "G"}
    return "".join(lengths[m.arguments[0]] if m.symbol == "F" else m.symbol for m in word if m.symbol != "RH")


def test_the_dichotomy_grows_as_the_table_of_systems_says() -> None:
    assert shoots(dichotomy(), 5) == [0, 1, 3, 7, 15, 27]


@pytest.mark.parametrize("threshold", [20, 41, 60, 69, 70, 101])
def test_the_dichotomy_is_that_of_its_definition(threshold: int) -> None:
    # without the rolls + and - are mirrored after each shoot; that a plant and its mirror image grow alike is the law here
    counts = [word.count("F") + word.count("G") for word in by_definition(threshold, 6)]
    rolled = shoots(read(LISTING.replace("60", str(threshold)).replace("RH180 ", ""), "grogra"), 6)
    assert rolled == counts
    words = derive(read(LISTING.replace("60", str(threshold)).replace("RH180 ", ""), "grogra"), 6)
    assert list(map(told, words)) == by_definition(threshold, 6)


def test_thresholds_between_41_and_69_change_little() -> None:
    counts = [shoots(dichotomy(threshold), 8)[-1] for threshold in range(41, 70, 4)]
    assert all(101 <= count <= 103 for count in counts)


def test_a_threshold_of_70_stops_the_shorter_branches() -> None:
    """A shoot of 70 is 70 away from the begin of its sister, exactly: rounding errors do not let it grow."""
    for threshold in (70, 71):
        word = derive(dichotomy(threshold), 9)[-1]
        lengths = [module.arguments[0] for module in word if module.symbol == "F"]
        assert (lengths.count(100), lengths.count(70)) == (9, 8)
    assert shoots(dichotomy(101), 9)[-3:] == [3, 3, 3]


def test_both_apices_of_a_fork_get_the_same_answer() -> None:
    sight = derive(dichotomy(), 6).sight(6)
    assert sight
    answers = [sight.sees(at, 2, 1) for at, module in enumerate(sight.word) if module.symbol in "ab"]
    assert len(answers) == 2 * 28 - 12
    assert answers[::2] == answers[1::2]
    across = math.sqrt(100**2 + 70**2 - 2 * 100 * 70 * math.cos(math.radians(60)))  # from a shoot's tip to its sister's
    assert sorted(map(float, set(answers))) == pytest.approx([30, 70, across])


def test_a_word_of_the_sensitive_dichotomy_is_one_of_the_other() -> None:
    """Where nothing is near, the apices grow as those that see nothing: 2^n - 1 shoots."""
    blind = read(LISTING.replace("(f(1) > 60)", ""), "grogra")
    assert list(map(str, derive(dichotomy(), 4))) == list(map(str, derive(blind, 4)))
    assert shoots(blind, 8)[-1] == 255 > shoots(dichotomy(), 8)[-1]


def test_the_words_are_those_of_the_step_whatever_was_derived_before() -> None:
    at_once = derive(dichotomy(), 9)
    one_by_one = derive(dichotomy(), 0)
    for step in range(10):
        one_by_one = one_by_one.to(step)
    assert list(map(str, one_by_one)) == list(map(str, at_once))
    assert one_by_one.ancestors(9)[-1] == 0


def test_the_explanation_tells_what_was_seen() -> None:
    fates = [fate for fate in explain(derive(dichotomy(), 5), 5) if fate.module.symbol in "ab"]
    stopped = [fate for fate in fates if not fate.production.startswith("production")]
    assert len(fates), len(stopped) == (16, 4)
    assert stopped[0].refused == ("production 2, (f(1) > 60) b → RH180 F70 [ - b ] + a: f(1) > 60 is false where f is 30",)


def test_words_alone_do_not_tell_what_is_seen() -> None:
    with pytest.raises(ModelValueError, match="function 2 depends on what the turtle sees"):
        words_alone(dichotomy(), 1)
    with pytest.raises(ModelValueError, match="context-free systems"):
        growth(dichotomy())


def test_the_dichotomy_in_other_arithmetic_and_notation() -> None:
    assert shoots(dichotomy(), 7, arithmetic="float") == shoots(dichotomy(), 7)
    assert shoots(read(write(dichotomy(), "abop")), 7) == shoots(dichotomy(), 7)


def test_chance_and_sight_together_give_the_same_plant_for_the_same_seed() -> None:
    system = read(LISTING.replace("+ a", "RU(x) a").replace("\\angle", "\\var x uniform 20 40,\n\\angle"), "grogra")
    assert str(derive(system, 7, seed=3)[-1]) == str(derive(system, 7, seed=3)[-1])
    assert str(derive(system, 7, seed=3)[-1]) != str(derive(system, 7, seed=4)[-1])


def test_two_buds_that_are_alike_get_their_own_answers() -> None:
    system = read("axiom: F(1) [+(90) F(2) b] [-(90) F(5) b]\nb -> F(sensed(2, 1) / 2)")
    assert str(derive(system, 1)[-1]) == "F(1)[+(90)F(2)F(1)][-(90)F(5)F(2.5)]"


def test_an_answer_is_a_number_like_any_other() -> None:
    system = read("axiom: [F(3) b] +(90) F(4) a\na -> F(sensed(2, 1)) a\nb -> b(sensed(2, 1), sensed(7))")
    assert str(derive(system, 1)[-1]) == "[F(3)b(3,0)]+(90)F(4)F(4)a"
    halves = derive(read("axiom: [F(1)] [+(60) F(1) a] [-(60) F(1)]\na -> a(sensed(2, 1) / 4)"), 1)[-1]
    assert halves[6].arguments == (Fraction(1, 4),)


@pytest.mark.parametrize(
    ("rule", "said", "column"),
    [
        ("a # F(f(1)) a", r"a under production 1, .*, has no value: the result is too large.* an answer is infinite", 1),
        ("(f(0-1) > 60) a # F(1/0) a", "has no value: division by zero", 1),
        ("(g(1) > 60) a # F a", "has no value: function 3 is not known; functions are 1, 2, 4, 7, 9", 1),
        ("(h > 60) a # F a", "function 2, the distance to the nearest shoot, takes 1 or 2 values, not 0", 1),
        ("(f > 60) a # F a", r'"f" is a function, and its values are missing', 2),
    ],
)
def test_a_question_without_an_answer_is_explained(rule: str, said: str, column: int) -> None:
    text = "\\axiom a,\n\\var f function 2 1,\n\\var g function 3 1,\n\\var h function 2 0,\n" + rule
    with pytest.raises(ModelValueError if "missing" not in said else LSystemError, match=said) as caught:
        derive(read(text, "grogra"), 2)
    assert (caught.value.line, caught.value.column) == (5, column)


@pytest.mark.slow
def test_a_derivation_that_takes_too_long_keeps_its_steps() -> None:
    with limits(seconds=0.5), pytest.raises(ModelLimitError, match=r"was not reached in 0\.5 seconds") as caught:
        derive(dichotomy(), 1000)
    kept = [word.counts().get("F", 0) for word in list(caught.value.partial)[:6]]
    assert kept == shoots(dichotomy(), 5)[: len(kept)] != []


def test_a_notebook_shows_the_first_words() -> None:
    text = shown(dichotomy(), "fork")["text/plain"]
    assert "(f0(1) > 60) a # RH180 F100 [- b] + a" in text
    assert "step 2: RH180 F100 [- RH180 F70 [- b] + a] + RH180 F100 [- b] + a" in text


def test_the_dichotomy_can_be_explored_and_drawn() -> None:
    panel = explore(dichotomy())
    panel.step = 5
    assert panel.sight.word.counts()["F"] == 27
    assert str(draw(dichotomy(), 5)).startswith("27 segments")
    assert str(draw(derive(dichotomy(), 5)[-1], angle=40)).startswith("27 segments")


def test_a_plant_and_its_mirror_image_see_the_same() -> None:
    here = derive(dichotomy(), 6)[-1]
    there = derive(read(LISTING.replace("- b", "* b").replace("+ a", "- a").replace("* b", "+ b"), "grogra"), 6)[-1]
    answers = [
        [observe(word).sees(at, 2, 1) for at, module in enumerate(word) if module.symbol in "ab"] for word in (here, there)
    ]
    assert answers[0] == answers[1]
