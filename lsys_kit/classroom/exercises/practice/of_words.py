"""Practice exercises about words: derived by hand, with a misprint, of a language, and made by which rules."""

from __future__ import annotations

from dataclasses import replace
from itertools import chain
from random import Random

from lsys_kit.classroom.exercises.asked import system_of
from lsys_kit.classroom.exercises.exercise import Exercise, Slip
from lsys_kit.classroom.exercises.judging import wrong_answers
from lsys_kit.classroom.exercises.kinds.kind import first_difference
from lsys_kit.classroom.exercises.misconceptions.of_steps import WrongStep, leftmost_only, sequential, words_by
from lsys_kit.classroom.exercises.practice.drafts import (
    Draft,
    Maker,
    derivation_text,
    random_rules,
    size_of,
    system_text,
    words_of,
)
from lsys_kit.derivation.inference.infer import infer
from lsys_kit.translation import gettext

MOST_WRITTEN = 60
"""The most modules of a word that is to be written by hand."""


def _word(draft: Draft, system: str, steps: int, longest: int = MOST_WRITTEN) -> Exercise | None:
    words = words_of(system, steps)
    if not 3 < size_of(words[-1]) <= longest or words[-1] in words[:-1]:
        return None
    return draft.exercise(words[-1], {"system": system, "steps": steps}, derivation_text(words), question=draft.text("task"))


def _derive(chance: Random, level: int, draft: Draft) -> Exercise | None:
    rules = random_rules(chance, "abcd"[: 2 + (level > 1)], 2 + (level > 2))
    return _word(draft, system_text(chance.choice([*rules]), rules), 3 + (level > 1), 12 + 8 * level)


def _brackets(chance: Random, level: int, draft: Draft) -> Exercise | None:
    branch = ["[", chance.choice("+-"), "X", "]"]
    parts = [["F"], branch, ["X"]] if level == 1 else [["F"], branch, ["F"], ["[", chance.choice("+-"), "X", "]"], ["X"]]
    chance.shuffle(parts)
    rules = {"X": [*chain.from_iterable(parts)], "F": ["F", "F"] if level > 1 else [*chance.choice(["FF", "XF", "FX"])]}
    return _word(draft, system_text("X", rules), 2)


def _conditions(chance: Random, level: int, draft: Draft) -> Exercise | None:
    bound, start, again = chance.randint(2, 4), chance.randint(1, 2), chance.randint(0, 2)
    older, daughters = chance.choice([1, 1, 2]), [f"A({again})", f"B({chance.randint(1, 3)})"]
    chance.shuffle(daughters)
    lines = [f"axiom: A({start})" + f" A({chance.randint(0, bound)})" * (level == 1)]
    past = f" : x >= {bound}" if level < 3 else ""  # without it the production is for the modules that the first leaves
    lines += [f"A(x) : x < {bound} -> A(x+{older})", f"A(x){past} -> {' '.join(daughters)}"]
    if level > 1:
        ripe = chance.randint(2, 4)
        lines += [f"B(y) : y < {ripe} -> B(y+1)", f"B(y) : y >= {ripe} -> A({chance.randint(0, 2)}) B(1)"]
    return _word(draft, "\n".join(lines), bound + 1 + level)


def _context(chance: Random, level: int, draft: Draft) -> Exercise | None:
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
    return _word(draft, "\n".join([f"axiom: {axiom}", *lines]), 2 + (level > 1), 24)


# A misprint


def _misprint(chance: Random, level: int, draft: Draft) -> Exercise | None:
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
    line, text = wrong + 1, "\n".join(printed)
    exercise = draft.exercise(line, {"text": text}, derivation_text(words), system, wrong=line, words=words[wrong])
    return _with_first_departures(exercise, system, printed, draft.text("following"))


def _with_first_departures(exercise: Exercise, system: str, printed: list[str], following: str) -> Exercise | None:
    """An exercise with the lines as slips at which words derived by a misconception first differ from those printed."""
    last = len(printed) - 1
    solution = "\n".join(words_of(system, last))
    derived = replace(exercise, kind="words", solution=solution, system=system, steps=last, text="", expects=())
    slips: dict[str, Slip] = {}
    for wrong in wrong_answers(derived):
        line = str(first_difference([" ".join(map(str, word)) for word in wrong.answer], printed) + 1)
        if wrong.misconception is None or wrong.misconception.near or int(line) > len(printed):
            continue
        if line == exercise.solution and wrong.misconception.name in ("sequential", "leftmost only", "one production a step"):
            return None
        if line != exercise.solution:
            slips.setdefault(line, Slip(line, misconception=wrong.misconception.name))
    after = str(int(exercise.solution) + 1)
    if int(after) <= len(printed):
        slips[after] = Slip(after, following, near=True)
    return replace(exercise, slips=tuple(slips.values()))


# A word of a language


def _language(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    system = system_text("a", random_rules(chance, letters, 2 + (level > 2)))
    words = words_of(system, 9)
    at = 2 + (level > 1) + chance.randint(0, 1)
    right = words[at]
    if not 3 <= len(right.split()) <= 14 or len(words[-1].split()) < 2 * len(right.split()):
        return None
    one = chance.choice([*_wrong_words(leftmost_only, system, at + 2), ""])
    other = chance.choice([*_wrong_words(sequential, system, at), ""])
    changed = right.split()
    place = chance.randrange(len(changed))
    changed[place] = chance.choice([letter for letter in letters if letter != changed[place]])
    wrong = [one, other, " ".join(changed)]
    if not all(word and word not in words and len(word.split()) <= 16 for word in wrong):
        return None
    replies = zip(wrong, map(gettext, draft.said["replies"]), strict=True)
    return draft.choice(chance, right, [*replies], after=derivation_text(words[: at + 1]), listing=system)


def _wrong_words(step: WrongStep, system: str, steps: int) -> list[str]:
    """The words that somebody derives who takes wrong steps, without the first two."""
    found = [" ".join(module.symbol for module in word) for word in words_by(step, system_of(system), steps)]
    return [word for word in found[2:] if 2 < len(word.split()) <= 16]


# Which rules


def _rules(chance: Random, level: int, draft: Draft) -> Exercise | None:
    letters = "abc"[: 2 + (level > 1)]
    rules = random_rules(chance, letters, 2 + (level > 2))
    words = words_of(system_text(chance.choice(letters), rules), 3 + (level == 1))
    asked = chance.choice(letters)
    if len({*words}) < len(words) or not 4 < len(words[-1].split()) <= 24 or len(rules[asked]) < 2:
        return None
    replaced = " ".join(words[:-1])
    if asked not in replaced or len(infer([word.replace(" ", "") for word in words])) != 1:
        return None
    right, others = " ".join(rules[asked]), [" ".join(rules[letter]) for letter in letters if letter != asked]
    wrong = {right[:-2]: "too_short", **dict.fromkeys(others, "of_another")}
    wrong[f"{right} {letters[0]}"] = "too_long"
    wrong.pop(right, None)
    keys = {"symbols": tuple(letters), "slips": tuple(Slip(word, draft.text(says)) for word, says in wrong.items())}
    fitting = ", ".join(f"{letter} -> {' '.join(made)}" for letter, made in rules.items() if letter in replaced)
    return draft.exercise(right, keys, f"{fitting}.", "\n".join(words), asked=asked)


OF_WORDS: dict[str, Maker] = {
    "derive": _derive,
    "misprint": _misprint,
    "brackets": _brackets,
    "conditions": _conditions,
    "context": _context,
    "language": _language,
    "rules": _rules,
}
