"""Practice exercises whose answer is a word, or a place in a derivation."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from random import Random

from lsys_kit.classroom.exercises.exercise import Exercise, Slip
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.kinds.kind import first_difference
from lsys_kit.classroom.exercises.practice.drafts import (
    OF_BRANCHES,
    OF_OVERLAPS,
    OF_PICTURES,
    OF_SILENT_LETTERS,
    Topic,
    derivation_text,
    quoted_lines,
    random_rules,
    size_of,
    system_text,
    words_of,
)
from lsys_kit.translation import gettext

MOST_WRITTEN = 60
"""The most modules of a word that is to be written by hand."""


def _word_exercise(
    system: str,
    steps: int,
    question: str,
    hints: tuple[str, ...],
    expects: tuple[str, ...],
    unlikely: tuple[str, ...],
    longest: int = MOST_WRITTEN,
) -> Exercise | None:
    words = words_of(system, steps)
    if not 3 < size_of(words[-1]) <= longest or words[-1] in words[:-1]:
        return None
    return Exercise(
        "",
        "",
        "word",
        gettext(
            "{question}{listing}Write the word of step {steps}.", question=question, listing=quoted_lines(system), steps=steps
        ),
        words[-1],
        derivation_text(words),
        hints,
        system=system,
        steps=steps,
        expects=expects,
        unlikely=unlikely,
    )


# All at once


def _derive(chance: Random, level: int) -> Exercise | None:
    rules = random_rules(chance, "abcd"[: 2 + (level > 1)], 2 + (level > 2))
    return _word_exercise(
        system_text(chance.choice([*rules]), rules),
        3 + (level > 1),
        gettext("Derive by hand:"),
        (
            gettext("The axiom is step 0. Write each word on a line of its own."),
            gettext("In a step every letter of the word is replaced, each by its own production."),
            gettext(
                "Go through the word from left to right, and look each letter up in the rules, not in what you have just "
                "written."
            ),
        ),
        ("sequential", "one step too few", "leftmost only"),
        (*OF_OVERLAPS, *OF_SILENT_LETTERS, *OF_BRANCHES, *OF_PICTURES),
        12 + 8 * level,
    )


# Brackets


def _brackets(chance: Random, level: int) -> Exercise | None:
    branch = ["[", chance.choice("+-"), "X", "]"]
    parts = [["F"], branch, ["X"]] if level == 1 else [["F"], branch, ["F"], ["[", chance.choice("+-"), "X", "]"], ["X"]]
    chance.shuffle(parts)
    rules = {"X": [*chain.from_iterable(parts)], "F": ["F", "F"] if level > 1 else [*chance.choice(["FF", "XF", "FX"])]}
    return _word_exercise(
        system_text("X", rules),
        2,
        gettext("A plant that is typed as a word:"),
        (
            gettext("What has no production stays as it is: the brackets, + and -."),
            gettext("What stands in brackets is rewritten like everything else."),
            gettext("Replace each letter where it stands, and copy all other characters."),
        ),
        ("sequential", "one step too few", "branches kept"),
        (*OF_OVERLAPS, *OF_SILENT_LETTERS, *OF_PICTURES, "word reversed"),
    )


# Parameters and conditions


def _conditions(chance: Random, level: int) -> Exercise | None:
    bound, start, again = chance.randint(2, 4), chance.randint(1, 2), chance.randint(0, 2)
    older, daughters = chance.choice([1, 1, 2]), [f"A({again})", f"B({chance.randint(1, 3)})"]
    chance.shuffle(daughters)
    lines = [f"axiom: A({start})" + f" A({chance.randint(0, bound)})" * (level == 1)]
    if level > 2:  # the second production has no condition: it is for the modules that the first leaves
        lines += [f"A(x) : x < {bound} -> A(x+{older})", f"A(x) -> {' '.join(daughters)}"]
    else:
        lines += [f"A(x) : x < {bound} -> A(x+{older})", f"A(x) : x >= {bound} -> {' '.join(daughters)}"]
    if level > 1:
        ripe = chance.randint(2, 4)
        lines += [f"B(y) : y < {ripe} -> B(y+1)", f"B(y) : y >= {ripe} -> A({chance.randint(0, 2)}) B(1)"]
    overlaps = () if level > 2 else OF_OVERLAPS
    silent = OF_SILENT_LETTERS if level > 1 else ()
    return _word_exercise(
        "\n".join(lines),
        bound + 1 + level,
        gettext("The productions have conditions:"),
        (
            gettext("A condition is asked of the value that the module has before the step."),
            gettext("Take each module by itself: for which of its productions does its value fulfil the condition?"),
            gettext("Try the bound itself: does the condition hold for it?"),
        ),
        ("strictness confused", "condition after the step", *(("first match overlooked",) if level > 2 else ())),
        (*overlaps, *silent, *OF_BRANCHES, *OF_PICTURES, "condition one off", "condition dropped"),
    )


# Neighbours


def _context(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    left, old = chance.sample(letters, 2)
    new = [chance.choice(letters) for _ in range(chance.randint(1, 1 + (level > 1)))]
    lines = [f"{left} < {old} -> {' '.join(new)}"]
    if level > 1:
        other = chance.choice(letters)
        lines.append(f"{other} -> {' '.join(chance.choice(letters) for _ in range(chance.randint(1, 2)))}")
    if level > 2:
        one, right = chance.sample(letters, 2)
        lines.insert(1, f"{one} > {right} -> {chance.choice(letters)}")
    axiom = " ".join(chance.choice(letters) for _ in range(4 + level))
    if f"{left} {old}" not in axiom or new == [old]:  # nothing would happen in the first step
        return None
    return _word_exercise(
        "\n".join([f"axiom: {axiom}", *lines]),
        2 + (level > 1),
        gettext("The productions look at neighbours:"),
        (
            gettext("What stands before < is the neighbour on the left, what stands behind > that on the right."),
            gettext("Neighbours are read in the word before the step, not in the one that is being written."),
            gettext("The first module has no neighbour on its left. A module without a production that fits stays."),
        ),
        ("context in the new word", "context overlooked"),
        (*OF_OVERLAPS, *OF_SILENT_LETTERS, *OF_BRANCHES, *OF_PICTURES, "production missing"),
        24,
    )


# A misprint


def _misprint(chance: Random, level: int) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system = system_text("a", random_rules(chance, letters, 2))
    steps = 4 + (level > 1)
    words = words_of(system, steps)
    wrong = chance.randint(2, steps)
    word = words[wrong].split()
    if not 3 <= len(words[-1].split()) <= 24 or len(word) < 2 or len(set(words)) <= steps:
        return None
    at = chance.randrange(len(word))
    word[at] = chance.choice([letter for letter in letters if letter != word[at]])
    printed = [*words[:wrong], " ".join(word), *words[wrong + 1 :]]
    exercise = Exercise(
        "",
        "",
        "line",
        gettext(
            "The words of steps 0, 1, 2, ... of this system are printed below, one a line. In one of "
            "them a letter is wrong; axiom and rules are right.{listing}In which line is the misprint?",
            listing=quoted_lines(system),
        ),
        str(wrong + 1),
        gettext("Line {wrong} must be: {words}. ", wrong=wrong + 1, words=words[wrong]) + derivation_text(words),
        (
            gettext("Line 1 is the axiom. Derive line 2 from it, and compare."),
            gettext("Derive each line from the line before, as long as these agree."),
            gettext("Where a line does not follow from the one before, derive two steps from the last line that is right."),
        ),
        text="\n".join(printed),
        otherwise=gettext("Derive the lines one after another, from the first on."),
        expects=("sequential",),
    )
    return _with_first_departures(exercise, system, printed)


def _with_first_departures(exercise: Exercise, system: str, printed: list[str]) -> Exercise | None:
    """An exercise with the lines as slips at which words derived by a misconception first differ from those printed."""
    derived = Exercise(
        "", "", "words", "", "\n".join(words_of(system, len(printed) - 1)), "", (), system=system, steps=len(printed) - 1
    )
    slips: dict[str, Slip] = {}
    for wrong in wrong_answers(derived):
        line = str(first_difference([" ".join(map(str, word)) for word in wrong.answer], printed) + 1)
        if wrong.misconception is None or wrong.misconception.near or int(line) > len(printed):
            continue
        if line == exercise.solution and wrong.misconception.name in ("sequential", "leftmost only", "one production a step"):
            return None
        if line != exercise.solution:
            slips.setdefault(line, Slip(line, misconception=wrong.misconception.name))
    following = str(int(exercise.solution) + 1)
    if int(following) <= len(printed):
        says = gettext("This line does not follow from the one before; which of the two is wrong?")
        slips[following] = Slip(following, says, near=True)
    return replace(exercise, slips=tuple(slips.values()))


OF_WORDS = {
    "derive": Topic("A word by hand", 1, _derive),
    "misprint": Topic("Find the misprint", 1, _misprint),
    "brackets": Topic("A word with branches", 3, _brackets),
    "conditions": Topic("Parameters and conditions", 6, _conditions),
    "context": Topic("Neighbours", 9, _context),
}
"""In the order of the lessons."""
