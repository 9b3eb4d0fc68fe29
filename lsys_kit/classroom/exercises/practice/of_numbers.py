"""Practice exercises whose answer is a number, a row of numbers, or a stage diagram."""

from __future__ import annotations

from collections import Counter
from fractions import Fraction
from itertools import pairwise, product
from random import Random

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Slip
from lsys_kit.classroom.exercises.practice.drafts import (
    OF_BRANCHES,
    OF_ORDER,
    OF_OVERLAPS,
    OF_PICTURES,
    OF_SILENT_LETTERS,
    Rules,
    Topic,
    quoted_lines,
    random_rules,
    system_text,
)
from lsys_kit.derivation.growth.growth import growth

_NOT_COUNTED = (*OF_OVERLAPS, *OF_ORDER, *OF_PICTURES, *OF_SILENT_LETTERS, *OF_BRANCHES, "one production a step")
_COUNTING = ("Write the first words, and count.",
             "Order does not matter: of a production keep how many of each letter it makes.",
             "How many of each kind come from how many of each kind in the step before?")


def _counts_text(system: str, steps: int) -> str:
    return "Modules at each step: " + ", ".join(map(str, growth(system_of(system)).lengths(steps)))


# How many


def _counts(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system, steps = system_text("a", random_rules(chance, letters, 2 + (level > 1))), 3 + level
    found = [growth(system_of(system)).counts_of(letter, steps)[steps] for letter in letters if f"\n{letter} ->" in system]
    if not 6 < sum(found) < 200 or 0 in found or len(set(found)) < len(found):
        return None
    return Exercise(
        "", "", "table", f"How often does each letter stand in the word of step {steps}?{quoted_lines(system)}"
        f"Give the numbers of {', '.join(letters)}, in this order.", ", ".join(map(str, found)), _counts_text(system, steps),
        _COUNTING, system=system, asks="counts", steps=steps, symbols=tuple(letters),
        expects=("one step too few", "sequential"), unlikely=_NOT_COUNTED)


def _matrix(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system = system_text("a", random_rules(chance, letters, 2 + level))
    model = system_of(system)
    entries = list(map(int, growth(model).matrix))
    size = len(letters)
    if len(entries) != size * size or len(set(entries)) < 2:
        return None
    order = ", ".join(letters)
    rows = "\n".join(" ".join(map(str, entries[at : at + size])) for at in range(0, len(entries), size))
    return Exercise(
        "", "", "table", f"Write the growth matrix, with rows and columns in the order {order}: the entry in row i and "
        f"column j says how many j one i becomes.{quoted_lines(system)}", rows, "Each row counts the letters of one successor.",
        ("The matrix has a row for each letter.", "Take one production: how often does each letter stand behind its arrow?",
         "Write these numbers in the row of the letter before the arrow."),
        system=system, asks="matrix", expects=("rows and columns",), unlikely=_NOT_COUNTED)


def _length(chance: Random, level: int) -> Exercise | None:
    system = system_text("a", random_rules(chance, "abc"[: 2 + (level > 1)], 2))
    steps = 6 + 2 * level + chance.randint(0, 3)
    found = growth(system_of(system)).lengths(steps)
    if found[3] < 3 or not 12 < found[-1] < 100 * 3**level:
        return None
    return Exercise(
        "", "", "number", f"How many letters has the word of step {steps}?{quoted_lines(system)}"
        "Count without writing the words.",
        str(found[-1]), _counts_text(system, steps), _COUNTING, system=system, asks="length", steps=steps, unit="letters",
        expects=("one step too few", "Fibonacci by reflex"), unlikely=_NOT_COUNTED)


def _first_past(chance: Random, level: int) -> Exercise | None:
    system = system_text("a", random_rules(chance, "abc"[: 2 + (level > 1)], 3))
    bound = 10 ** (1 + level)
    lengths = growth(system_of(system)).lengths(40)
    first = next((step for step, length in enumerate(lengths) if length > bound), 0)
    if first < 4 or first > 30:
        return None
    return Exercise(
        "", "", "number", f"Which is the first step whose word has more than {bound:,} letters?{quoted_lines(system)}",
        str(first),
        _counts_text(system, first), _COUNTING, system=system, asks=f"first step past {bound}", steps=40,
        expects=("linear growth", "axiom as step 1"), unlikely=_NOT_COUNTED,
        otherwise="Count the letters of the first steps, and go on from them.")


# Life spans


def _life_spans(chance: Random, level: int) -> Exercise | None:
    life_a, life_b = chance.sample(range(2, 5 + level), 2)
    daughters_a = chance.choice([("A", "B"), ("B", "A"), ("B", "B")])
    daughters_b = chance.choice([("A", "B"), ("B", "A"), ("A",)])
    system = "\n".join(["axiom: A(1)", *_ageing("A", life_a, daughters_a), *_ageing("B", life_b, daughters_b)])
    steps = life_a + life_b + 4 + level + chance.randint(0, 3)
    found = growth(system_of(system)).lengths(steps)
    if not 4 < found[-1] < 500:
        return None
    return Exercise(
        "", "", "number", f"A cell A lives {life_a} steps and then becomes {_and(daughters_a)}; a cell B lives {life_b} "
        f"steps and then becomes {_and(daughters_b)}. The filament begins with one newborn A."
        f"{quoted_lines(system)}How many cells has it after step {steps}?", str(found[-1]), _counts_text(system, steps),
        ("A cell that waits is one cell, whatever its age.", "In which step did the cells divide that make those of now?",
         "Write the number of cells for each age, step by step: all of them move on by one, the oldest divide."),
        system=system, asks="length", steps=steps, unit="cells",
        expects=("Fibonacci by reflex", "one step too few", "doubling by reflex"), unlikely=_NOT_COUNTED)


def _ageing(cell: str, life: int, daughters: tuple[str, ...]) -> list[str]:
    newborn = " ".join(f"{each}(1)" for each in daughters)
    return [f"{cell}(t) : t < {life} -> {cell}(t+1)", f"{cell}(t) : t == {life} -> {newborn}"]


def _and(cells: tuple[str, ...]) -> str:
    return " and ".join(f"one {cell}" for cell in cells) if len(set(cells)) == len(cells) else f"two {cells[0]}"


# Chance


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
    lines = [f"{letter} -> {' '.join(made)}   with probability {odds}"
             for letter, choices in rules.items() for made, odds in choices]
    stays = "" if level > 2 else "A letter without a production stays. "
    if share in (weight, 1 - weight, Fraction(1, 2)) or weight == Fraction(1, 2):  # a half is its own contrary
        return None
    return Exercise(
        "", "", "number", f"The axiom is {' '.join(axiom)}.{quoted_lines(chr(10).join(lines))}{stays}"
        f"What is the probability that the word of step {steps} is {word}? Give a fraction or a decimal number.", str(share),
        f"The probabilities of all words of step {steps}: "
        + ", ".join(f"{each}: {odds}" for each, odds in sorted(outcomes.items())) + ".",
        ("Each letter chooses by itself.", "Which choices lead to this word, in one step or in several?",
         "What must happen together is multiplied; ways that exclude one another are added."),
        tolerance=Fraction(1, 1000), expects=("contrary", "percent"),
        slips=(Slip(str(weight), "That is the probability of one choice; how many choices are there?"),
               Slip(str(1 - weight), "That is the probability of the other choice of one letter; how many choices are there?")),
        otherwise="Write down every way that leads to the word, with what each letter chooses.")


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


# Stage diagrams


def _net(chance: Random, level: int) -> Exercise | None:
    letters = "abcde"[: 2 + level]
    rules: Rules = {letter: [following] for letter, following in pairwise(letters)}
    last = [chance.choice(letters) for _ in range(3)]
    system = system_text(letters[0], {**rules, letters[-1]: last})
    if level > 2:
        system = system_text(letters[0], {**rules, letters[1]: [letters[2], chance.choice(letters)], letters[-1]: last})
    lines = [f"{place} -> {_sum(made)}" for place, made in _successors(system)]
    if len(set(last)) != 2:  # two daughters of one kind, and another
        return None
    return Exercise(
        "", "", "net", "Write the stage diagram of these rules: a line for each stage, such as C -> L + 2 S for a stage C "
        f"whose cells become one L and two S.{quoted_lines(system)}", "\n".join(lines),
        "A line for each production, with its daughters counted.",
        ("Each letter is a stage, a place of the diagram.",
         "Each production is a transition: it takes one token from its stage.",
         "Daughters of one kind are counted, and put into one place."),
        system=system, expects=("arcs reversed", "copies not counted"),
        unlikely=(*_NOT_COUNTED, "sequential", "leftmost only", "old word kept"))


def _successors(system: str) -> list[tuple[str, list[str]]]:
    return [(line.split(" -> ")[0], line.split(" -> ")[1].split()) for line in system.splitlines()[1:]]


def _sum(letters: list[str]) -> str:
    return " + ".join(f"{copies} {letter}" if copies > 1 else letter for letter, copies in Counter(letters).items())


OF_NUMBERS = {
    "counts": Topic("How many of each", 2, _counts),
    "matrix": Topic("The growth matrix", 2, _matrix),
    "length": Topic("How long a word", 2, _length),
    "first": Topic("When it is long", 2, _first_past),
    "stages": Topic("A stage diagram", 5, _net),
    "life spans": Topic("Life spans", 7, _life_spans),
    "chance": Topic("Chance", 8, _chance),
}
"""In the order of the lessons."""
