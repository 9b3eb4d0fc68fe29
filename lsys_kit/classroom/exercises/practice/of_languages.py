"""Practice exercises about languages: which words a system makes, how fast they grow, and which rules made given words."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import replace
from random import Random

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Slip
from lsys_kit.classroom.exercises.misconceptions import rewriting
from lsys_kit.classroom.exercises.practice.drafts import (
    Topic,
    choice_exercise,
    derivation_text,
    quoted_lines,
    random_rules,
    system_text,
    words_of,
)
from lsys_kit.derivation.growth.growth import growth
from lsys_kit.derivation.inference.infer import infer
from lsys_kit.translation import gettext

# Words of a language


def _language(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system = system_text("a", random_rules(chance, letters, 2 + (level > 2)))
    words = words_of(system, 9)
    at = 2 + (level > 1) + chance.randint(0, 1)
    right = words[at]
    if not 3 <= len(right.split()) <= 14 or len(words[-1].split()) < 2 * len(right.split()):
        return None
    one = chance.choice([*_wrong_words(rewriting.leftmost_only, system, at + 2), ""])
    other = chance.choice([*_wrong_words(rewriting.sequential, system, at), ""])
    changed = right.split()
    place = chance.randrange(len(changed))
    changed[place] = chance.choice([letter for letter in letters if letter != changed[place]])
    wrong = [
        (one, gettext("It comes out if in each step the first letter alone is replaced. In a step all letters are.")),
        (
            other,
            gettext(
                "It comes out if the productions are applied one after another. In a step all letters are replaced at once."
            ),
        ),
        (" ".join(changed), gettext("Derive the words up to this length: none of them is this one.")),
    ]
    if not all(word and word not in words and len(word.split()) <= 16 for word, _ in wrong):
        return None
    return choice_exercise(
        chance,
        gettext(
            "The language of a D0L-system is the set of all words that it derives from its axiom.{listing}Which "
            "of these words is in its language?",
            listing=quoted_lines(system),
        ),
        right,
        wrong,
        derivation_text(words[: at + 1]),
        (
            gettext("The words of a D0L-system are those of step 0, 1, 2, ..., one for each step."),
            gettext("Derive one word after another until they are longer than all options."),
            gettext("A word that a Chomsky grammar with the same productions makes need not be among them."),
        ),
    )


def _wrong_words(step: rewriting.WrongStep, system: str, steps: int) -> list[str]:
    """The words that somebody derives who takes wrong steps, without the first two."""
    found = [" ".join(module.symbol for module in word) for word in rewriting.words_by(step, system_of(system), steps)]
    return [word for word in found[2:] if 2 < len(word.split()) <= 16]


# Types of growth


TYPES = ("bounded", "linear", "quadratic", "exponential")
"""The types of growth that are told apart."""
REPLIES = {
    "bounded": "Is there a letter that makes others again and again, and is never used up?",
    "linear": "It would be linear if in every step the same number of letters were added.",
    "quadratic": "It would be quadratic if what is added grew by the same number in every step.",
    "exponential": "It would be exponential if some letter made itself twice, directly or through others.",
}


def growth_type(lengths: Sequence[int]) -> str:
    """The type of growth of a long row of lengths; empty where it is none of those that are told apart.

    >>> growth_type([2 * n + 3 for n in range(40)]), growth_type([1, 2] * 20), growth_type([2**n for n in range(40)])
    ('linear', 'bounded', 'exponential')
    """
    late = lengths[len(lengths) // 2 :]
    if max(late) <= max(lengths[: len(lengths) // 2]):
        return "bounded"
    ratio = late[-1] / late[0]
    if ratio > len(lengths):
        return "exponential"
    differences = [after - before for before, after in zip(late, late[6:], strict=False)]
    second = {after - before for before, after in zip(differences, differences[6:], strict=False)}
    return "" if len(second) > 1 else "linear" if second == {0} else "quadratic"


def _growth_type(chance: Random, level: int) -> Exercise | None:
    letters = "abcd"[: 2 + (level > 1)]
    wanted = chance.choice(TYPES[: 3 + (level > 1)] if level > 1 else ("bounded", "linear", "exponential"))
    rules = {
        letter: [chance.choice(letters[max(0, at - (level > 2)) :]) for _ in range(chance.randint(1, 2 + (level > 1)))]
        for at, letter in enumerate(letters)
    }
    rules["a"] = ["a", *rules["a"]] if wanted == "quadratic" else rules["a"]
    system = system_text("a", rules)
    lengths = growth(system_of(system)).lengths(48)
    if growth_type(lengths) != wanted or (wanted == "bounded" and lengths[1] == 1):
        return None
    return choice_exercise(
        chance,
        gettext("How do the lengths of the words grow with the number of steps?{listing}", listing=quoted_lines(system)),
        gettext(wanted),
        [(gettext(each), gettext(REPLIES[each])) for each in TYPES if each != wanted],
        gettext("The lengths of the first words: ") + ", ".join(map(str, lengths[:9])) + ", ...",
        (
            gettext("Write the lengths of the first words."),
            gettext("Which letters make themselves again, and what do they make besides?"),
            gettext(
                "A letter that makes itself twice doubles; one that makes itself and a letter that stays adds; what it "
                "makes may grow, too."
            ),
        ),
    )


# Which rules


def _rules(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    rules = random_rules(chance, letters, 2 + (level > 2))
    words = words_of(system_text(chance.choice(letters), rules), 3 + (level == 1))
    asked = chance.choice(letters)
    if len({*words}) < len(words) or not 4 < len(words[-1].split()) <= 24 or len(rules[asked]) < 2:
        return None
    if asked not in " ".join(words[:-1]) or len(infer([word.replace(" ", "") for word in words])) != 1:
        return None
    right, others = " ".join(rules[asked]), [" ".join(rules[letter]) for letter in letters if letter != asked]
    wrong = {
        right[:-2]: gettext("Then one letter of the next word would come from nothing. Cut it elsewhere."),
        **dict.fromkeys(others, gettext("That is what another letter becomes.")),
    }
    wrong[f"{right} {letters[0]}"] = gettext("Then a letter would be left over. Cut the next word elsewhere.")
    wrong.pop(right, None)
    exercise = Exercise(
        "",
        "",
        "word",
        gettext(
            "These are the words of steps 0, 1, 2, ... of a D0L-system in which no letter "
            "vanishes.{listing}What does {asked} become in a step?",
            listing=quoted_lines(chr(10).join(words)),
            asked=asked,
        ),
        right,
        gettext("The one system that fits: ")
        + ", ".join(f"{letter} -> {' '.join(made)}" for letter, made in rules.items() if letter in " ".join(words[:-1]))
        + ".",
        (
            gettext("Begin with the step from the shortest word."),
            gettext("The next word is cut into pieces, one for each letter, in their order."),
            gettext("The same letter has the same piece everywhere: try a cut, and see if it fits all the other steps."),
        ),
        symbols=tuple(letters),
        unlikely=("word reversed",),
    )
    return replace(exercise, slips=tuple(Slip(word, says) for word, says in wrong.items()))


OF_LANGUAGES = {
    "language": Topic("A word of the language", 17, _language),
    "growth type": Topic("How fast it grows", 17, _growth_type),
    "rules": Topic("Which rule was it?", 18, _rules),
}
"""In the order of the lessons."""
