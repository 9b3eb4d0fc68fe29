"""What the makers of practice exercises share: what a topic says, random systems, and how a question shows them."""

from __future__ import annotations

import re
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from fractions import Fraction
from random import Random
from string import ascii_uppercase
from typing import Any, TypeAlias

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Option, Slip
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.files import Entries, toml_tables
from lsys_kit.translation import gettext
from lsys_kit.worlds.derive import derive

TOPICS = toml_tables(__package__, "topics.toml")
"""What can be practised: what the exercises of each topic say, and the lesson that it goes with."""
_AS_KEY: Mapping[str, Callable[[Any], object]] = {"kind": str, "asks": str, "unit": str, "expects": tuple, "unlikely": tuple}
"""Which of that are keys of exercises, and what becomes of them."""
Rules: TypeAlias = Mapping[str, Sequence[str]]
"""For each letter what it becomes."""
Number: TypeAlias = Fraction | int


@dataclass(frozen=True)
class Draft:
    """What the exercises of a topic say at a level: with values it becomes an exercise.

    >>> draft = Draft({"kind": "number", "question": "How many {what}?", "hints": [], "replies": ["You guessed."]})
    >>> draft.number(3, [4], what="cells").question, draft.number(3, [3]) is None
    ('How many cells?', True)
    >>> Draft({}).choice(Random(1), "a", [("a", "No.")]) is None
    True
    """

    said: Entries

    def text(self, part: str, **values: object) -> str:
        """A text in the chosen language, with its values."""
        return gettext(self.said.get(part, ""), **values)

    def exercise(
        self, solution: object, keys: Entries | None = None, after: str = "", listing: str = "", **values: object
    ) -> Exercise:
        """An exercise with further keys; they, too, are values for its texts, and `after` continues its explanation."""
        keys = {**{key: _AS_KEY[key](self.said[key]) for key in _AS_KEY if key in self.said}, **(keys or {})}
        values = {**keys, **values, "listing": quoted_lines(listing or keys.get("system", ""))}
        return Exercise(
            id="",
            title="",
            question=self.text("question", **values) + self.text("ends"),
            solution=str(solution),
            explanation=self.text("explanation", **values) + after,
            otherwise=self.text("otherwise"),
            hints=tuple(map(gettext, self.said["hints"])),
            **keys,
        )

    def number(self, right: Number, wrong: Sequence[Number], **values: Any) -> Exercise | None:
        """A question for a number, with a reply to each wrong one; None where two of all these are the same."""
        if len({right, *wrong}) <= len(wrong) or right <= 0:
            return None
        slips = tuple(Slip(str(each), gettext(says)) for each, says in zip(wrong, self.said["replies"], strict=True))
        return self.exercise(right, {"slips": slips, **values.pop("keys", {})}, **values)

    def choice(self, chance: Random, right: str, wrong: Sequence[tuple[str, str]], **values: Any) -> Exercise | None:
        """A question with options in no order, of which each wrong one has its reply; None where two of them are the same."""
        if len({right, *(each for each, _ in wrong)}) <= len(wrong):
            return None
        options = [Option(right), *(Option(each, says) for each, says in wrong)]
        chance.shuffle(options)
        letter = ascii_uppercase[[option.text for option in options].index(right)]
        return self.exercise(letter, {"options": tuple(options)}, **values)


Maker: TypeAlias = Callable[[Random, int, Draft], Exercise | None]
"""From a source of chance, a level and what is said there to an exercise, which may be too easy, or None if there is none."""


ALPHABETS = ("abcde", "kmnps", "pqrst", "uvwxy", "rstuv", "bcdeh", "wxyzu", "ABCDE", "LMSTK", "PQRST")
"""Letters for systems, in which none is a command of the turtle, and none is easily taken for another."""


def random_letters(chance: Random, number: int) -> str:
    """So many letters for a system.

    >>> random_letters(Random(1), 3)
    'pqr'
    """
    return chance.choice(ALPHABETS)[:number]


def random_rules(chance: Random, letters: Sequence[str], longest: int) -> Rules:
    """A production for each letter, with 1 to `longest` letters.

    >>> random_rules(Random(1), "ab", 2)
    {'a': ['a'], 'b': ['a', 'b']}
    """
    return {letter: [chance.choice(letters) for _ in range(chance.randint(1, longest))] for letter in letters}


def system_text(axiom: str, rules: Rules) -> str:
    """A system in the kit's notation.

    >>> system_text("a", {"a": ["a", "b"]})
    'axiom: a\\na -> a b'
    """
    return "\n".join([f"axiom: {axiom}", *(f"{letter} -> {' '.join(successor)}" for letter, successor in rules.items())])


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
    return reply("practice.derivation") + "\n" + "\n".join(f"  {step}  {word}" for step, word in enumerate(words))
