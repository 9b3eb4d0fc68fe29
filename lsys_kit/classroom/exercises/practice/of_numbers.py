"""Practice exercises whose answer is a number, a row of numbers, or a stage diagram."""

from __future__ import annotations

from collections import Counter
from itertools import pairwise
from random import Random

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise
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
from lsys_kit.translation import gettext

_NOT_COUNTED = (*OF_OVERLAPS, *OF_ORDER, *OF_PICTURES, *OF_SILENT_LETTERS, *OF_BRANCHES, "one production a step")


def _counting() -> tuple[str, str, str]:
    """The hints where modules are counted."""
    return (
        gettext("Write the first words, and count."),
        gettext("Order does not matter: of a production keep how many of each letter it makes."),
        gettext("How many of each kind come from how many of each kind in the step before?"),
    )


def _counts_text(system: str, steps: int) -> str:
    return gettext("Modules at each step: ") + ", ".join(map(str, growth(system_of(system)).lengths(steps)))


# How many


def _counts(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system, steps = system_text("a", random_rules(chance, letters, 2 + (level > 1))), 3 + level
    found = [growth(system_of(system)).counts_of(letter, steps)[steps] for letter in letters if f"\n{letter} ->" in system]
    if not 6 < sum(found) < 200 or 0 in found or len(set(found)) < len(found):
        return None
    return Exercise(
        "",
        "",
        "table",
        gettext(
            "How often does each letter stand in the word of step {steps}?{listing}Give the numbers of "
            "{letters}, in this order.",
            steps=steps,
            listing=quoted_lines(system),
            letters=", ".join(letters),
        ),
        ", ".join(map(str, found)),
        _counts_text(system, steps),
        _counting(),
        system=system,
        asks="counts",
        steps=steps,
        symbols=tuple(letters),
        expects=("one step too few", "sequential"),
        unlikely=_NOT_COUNTED,
    )


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
        "",
        "",
        "table",
        gettext(
            "Write the growth matrix, with rows and columns in the order {order}: the entry in row i "
            "and column j says how many j one i becomes.{listing}",
            order=order,
            listing=quoted_lines(system),
        ),
        rows,
        gettext("Each row counts the letters of one successor."),
        (
            gettext("The matrix has a row for each letter."),
            gettext("Take one production: how often does each letter stand behind its arrow?"),
            gettext("Write these numbers in the row of the letter before the arrow."),
        ),
        system=system,
        asks="matrix",
        expects=("rows and columns",),
        unlikely=_NOT_COUNTED,
    )


def _length(chance: Random, level: int) -> Exercise | None:
    system = system_text("a", random_rules(chance, "abc"[: 2 + (level > 1)], 2))
    steps = 6 + 2 * level + chance.randint(0, 3)
    found = growth(system_of(system)).lengths(steps)
    if found[3] < 3 or not 12 < found[-1] < 100 * 3**level:
        return None
    return Exercise(
        "",
        "",
        "number",
        gettext(
            "How many letters has the word of step {steps}?{listing}Count without writing the words.",
            steps=steps,
            listing=quoted_lines(system),
        ),
        str(found[-1]),
        _counts_text(system, steps),
        _counting(),
        system=system,
        asks="length",
        steps=steps,
        unit="letters",
        expects=("one step too few", "Fibonacci by reflex"),
        unlikely=_NOT_COUNTED,
    )


def _first_past(chance: Random, level: int) -> Exercise | None:
    system = system_text("a", random_rules(chance, "abc"[: 2 + (level > 1)], 3))
    bound = 10 ** (1 + level)
    lengths = growth(system_of(system)).lengths(40)
    first = next((step for step, length in enumerate(lengths) if length > bound), 0)
    if first < 4 or first > 30:
        return None
    return Exercise(
        "",
        "",
        "number",
        gettext(
            "Which is the first step whose word has more than {bound} letters?{listing}",
            bound=f"{bound:,}",
            listing=quoted_lines(system),
        ),
        str(first),
        _counts_text(system, first),
        _counting(),
        system=system,
        asks=f"first step past {bound}",
        steps=40,
        expects=("linear growth", "axiom as step 1"),
        unlikely=_NOT_COUNTED,
        otherwise=gettext("Count the letters of the first steps, and go on from them."),
    )


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
        "",
        "",
        "number",
        gettext(
            "A cell A lives {life_a} steps and then becomes {daughters_a}; a cell B lives {life_b} "
            "steps and then becomes {daughters_b}. The filament begins with one newborn A.{listing}How "
            "many cells has it after step {steps}?",
            life_a=life_a,
            daughters_a=_and(daughters_a),
            life_b=life_b,
            daughters_b=_and(daughters_b),
            listing=quoted_lines(system),
            steps=steps,
        ),
        str(found[-1]),
        _counts_text(system, steps),
        (
            gettext("A cell that waits is one cell, whatever its age."),
            gettext("In which step did the cells divide that make those of now?"),
            gettext("Write the number of cells for each age, step by step: all of them move on by one, the oldest divide."),
        ),
        system=system,
        asks="length",
        steps=steps,
        unit="cells",
        expects=("Fibonacci by reflex", "one step too few", "doubling by reflex"),
        unlikely=_NOT_COUNTED,
    )


def _ageing(cell: str, life: int, daughters: tuple[str, ...]) -> list[str]:
    newborn = " ".join(f"{each}(1)" for each in daughters)
    return [f"{cell}(t) : t < {life} -> {cell}(t+1)", f"{cell}(t) : t == {life} -> {newborn}"]


def _and(cells: tuple[str, ...]) -> str:
    if len(cells) == 1:
        return gettext("one {cell}", cell=cells[0])
    if len(set(cells)) == 1:
        return gettext("two {cell}", cell=cells[0])
    return gettext("one {cell} and one {other}", cell=cells[0], other=cells[1])


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
        "",
        "",
        "net",
        gettext(
            "Write the stage diagram of these rules: a line for each stage, such as C -> L + 2 S for a "
            "stage C whose cells become one L and two S.{listing}",
            listing=quoted_lines(system),
        ),
        "\n".join(lines),
        gettext("A line for each production, with its daughters counted."),
        (
            gettext("Each letter is a stage, a place of the diagram."),
            gettext("Each production is a transition: it takes one token from its stage."),
            gettext("Daughters of one kind are counted, and put into one place."),
        ),
        system=system,
        expects=("arcs reversed", "copies not counted"),
        unlikely=(*_NOT_COUNTED, "sequential", "leftmost only", "old word kept"),
    )


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
}
"""In the order of the lessons."""
