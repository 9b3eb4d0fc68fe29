"""What the makers of practice exercises share: random systems, and how a question shows them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from string import ascii_uppercase
from typing import TypeAlias

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Option, Slip
from lsys_kit.translation import gettext
from lsys_kit.worlds.derive import derive

Rules: TypeAlias = Mapping[str, Sequence[str]]
"""For each letter what it becomes."""
OF_OVERLAPS = ("all matches applied", "first match overlooked")
OF_ORDER = ("daughters reversed", "plus and minus swapped", "pen up")
OF_PICTURES = ("angle between strokes", "angle of the whole fork")
OF_SILENT_LETTERS, OF_BRANCHES = ("letters vanish",), ("branches kept", "brackets dropped")
"""Misconceptions that change nothing where productions do not overlap, where order does not count, where nothing is drawn,
where every letter has a production, where there are no branches."""


@dataclass(frozen=True)
class Topic:
    """A kind of exercises that are made at random.

    Attributes
    ----------
    title
        What is practised.
    lesson
        The number of the lesson that it goes with.
    draft
        From a source of chance and a level to an exercise, which may be too easy, or None if there is none.
    """

    title: str
    lesson: int
    draft: Callable[[Random, int], Exercise | None]


def random_rules(chance: Random, letters: Sequence[str], longest: int) -> Rules:
    """A production for each letter, with 1 to `longest` letters.

    >>> random_rules(Random(1), "ab", 2)
    {'a': ['a'], 'b': ['a', 'b']}
    """
    return {letter: [chance.choice(letters) for _ in range(chance.randint(1, longest))] for letter in letters}


def rules_text(rules: Rules) -> str:
    """Productions in the kit's notation.

    >>> rules_text({"a": ["a", "b"]})
    'a -> a b'
    """
    return "\n".join(f"{letter} -> {' '.join(successor)}" for letter, successor in rules.items())


def system_text(axiom: str, rules: Rules) -> str:
    """A system in the kit's notation."""
    return f"axiom: {axiom}\n{rules_text(rules)}"


def quoted_lines(text: str) -> str:
    """A listing in a question, as Markdown."""
    return "\n\n" + "\n".join(f"    {line}" for line in text.splitlines()) + "\n\n"


def words_of(system: str, steps: int) -> list[str]:
    """The words of a system, as texts."""
    return [str(word) for word in derive(system_of(system), steps)]


def size_of(word: str) -> int:
    """How many modules are written in a word.

    >>> size_of("A(1)B(2)"), size_of("a b"), size_of("F[+F]")
    (2, 2, 5)
    """
    return sum(map(len, re.sub(r"\([^()]*\)", "", word).split()))


def derivation_text(words: Sequence[str]) -> str:
    """Words with their steps, for an explanation."""
    return gettext("Step by step:") + "\n" + "\n".join(f"  {step}  {word}" for step, word in enumerate(words))


def number_exercise(
    question: str,
    right: Fraction | int,
    wrong: Sequence[tuple[Fraction | int, str]],
    explanation: str,
    hints: tuple[str, ...],
    unit: str = "",
) -> Exercise | None:
    """A question for a number, with wrong answers and what is said of each; None where two of all these are the same.

    >>> number_exercise("How many?", 3, [(3, "You guessed.")], "", ()) is None
    True
    """
    if len({right, *(each for each, _ in wrong)}) <= len(wrong) or right <= 0:
        return None
    slips = tuple(Slip(str(each), says) for each, says in wrong)
    return Exercise("", "", "number", question, str(right), explanation, hints, slips=slips, unit=unit)


def choice_exercise(
    chance: Random, question: str, right: str, wrong: Sequence[tuple[str, str]], explanation: str, hints: tuple[str, ...]
) -> Exercise | None:
    """A question with options in no order, of which each wrong one has its reply; None where two of them are the same.

    >>> choice_exercise(Random(1), "Which?", "a", [("a", "No.")], "", ()) is None
    True
    """
    if len({right, *(each for each, _ in wrong)}) <= len(wrong):
        return None
    options = [Option(right), *(Option(each, says) for each, says in wrong)]
    chance.shuffle(options)
    letter = ascii_uppercase[[option.text for option in options].index(right)]
    return Exercise("", "", "choice", question, letter, explanation, hints, options=tuple(options))
