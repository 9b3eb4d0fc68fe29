"""Practice exercises about chance: how likely a word is."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import product
from random import Random

from lsys_kit.classroom.exercises.exercise import Exercise, Slip
from lsys_kit.classroom.exercises.practice.drafts import Topic, quoted_lines
from lsys_kit.translation import gettext


def _chance(chance: Random, level: int) -> Exercise | None:
    weight = Fraction(chance.randint(1, 6), chance.randint(7, 10))
    rules = {"A": [(["A", "B"], weight), (["B"] if level > 1 else ["A"], 1 - weight)]}
    if level > 2:
        rules["B"] = [(["A"], Fraction(1, 3)), (["B"], Fraction(2, 3))]
    axiom, steps = (["A", "A"], 1) if level == 1 else (["A"], 2)
    if level == 1 and chance.random() < 0.5:
        axiom = ["A", "B", "A", "A"]
    outcomes = _after(rules, axiom, steps)
    word = chance.choice(sorted(outcomes))
    share = outcomes[word]
    lines = [
        f"{letter} -> {' '.join(made)}   {gettext('with probability {odds}', odds=odds)}"
        for letter, choices in rules.items()
        for made, odds in choices
    ]
    stays = "" if level > 2 else gettext("A letter without a production stays. ")
    if share in (weight, 1 - weight, Fraction(1, 2)) or weight == Fraction(1, 2):  # a half is its own contrary
        return None
    return Exercise(
        "",
        "",
        "number",
        gettext(
            "The axiom is {axiom}.{listing}{stays}What is the probability that the word of step "
            "{steps} is {word}? Give a fraction or a decimal number.",
            axiom=" ".join(axiom),
            listing=quoted_lines(chr(10).join(lines)),
            stays=stays,
            steps=steps,
            word=word,
        ),
        str(share),
        gettext("The probabilities of all words of step {steps}: ", steps=steps)
        + ", ".join(f"{each}: {odds}" for each, odds in sorted(outcomes.items()))
        + ".",
        (
            gettext("Each letter chooses by itself."),
            gettext("Which choices lead to this word, in one step or in several?"),
            gettext("What must happen together is multiplied; ways that exclude one another are added."),
        ),
        tolerance=Fraction(1, 1000),
        expects=("contrary", "percent"),
        slips=(
            Slip(str(weight), gettext("That is the probability of one choice; how many choices are there?")),
            Slip(
                str(1 - weight),
                gettext("That is the probability of the other choice of one letter; how many choices are there?"),
            ),
        ),
        otherwise=gettext("Write down every way that leads to the word, with what each letter chooses."),
    )


def _after(rules: dict[str, list[tuple[list[str], Fraction]]], word: list[str], steps: int) -> dict[str, Fraction]:
    """The probability of each word after some steps."""
    found = {" ".join(word): Fraction(1)}
    for _ in range(steps):
        after: Counter[str] = Counter()
        for before, odds in found.items():
            for choices in product(*(rules.get(letter, [([letter], Fraction(1))]) for letter in before.split())):
                share = odds
                for _, each in choices:
                    share *= each
                after[" ".join(letter for made, _ in choices for letter in made)] += share  # type: ignore[assignment]
        found = {each: Fraction(odds) for each, odds in after.items()}
    return found


OF_CHANCE = {"chance": Topic("Chance", 8, _chance)}
"""In the order of the lessons."""
