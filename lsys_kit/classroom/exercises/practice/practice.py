"""`practice`: exercises without end, made at random. One that a misconception would answer rightly is thrown away."""

from __future__ import annotations

from dataclasses import dataclass, replace
from functools import lru_cache
from random import Random

from lsys_kit.budget import Task, check_budget
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.exercise import Exercise
from lsys_kit.classroom.exercises.judging import is_right_by_mistake, wrong_answers
from lsys_kit.classroom.exercises.kinds.choices import listing
from lsys_kit.classroom.exercises.practice.drafts import TOPICS, Draft
from lsys_kit.classroom.exercises.practice.makers import MAKERS
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.errors import ModelNameError, ModelValueError, quotable, require, whole_number
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import language

LEVELS = 3
"""How many levels there are."""


@dataclass(frozen=True, repr=False)
class Practice:
    """An exercise made at random: it displays as its question, and checks answers as `check` does.

    Attributes
    ----------
    topic, level, seed
        What it was made from.
    exercise
        What is asked, with the right answer.
    """

    topic: str
    level: int
    seed: int
    exercise: Exercise

    def check(self, answer: object = None, hint: int = 0, solution: bool = False) -> Verdict:
        """The verdict on an answer; after a try a hint or the solution can be shown, as `check` does.

        >>> practice("derive", seed=17).check("a")
        Not yet. That is the word of step 0. Or did you leave out one of the productions?
        """
        return checked(self.exercise, answer, hint, solution, "check(answer")

    def next(self) -> Practice:
        """Another exercise of the same kind and level."""
        return practice(self.topic, self.level, self.seed + 1)

    def _repr_markdown_(self) -> str:
        return f"**{self.exercise.title}**\n\n{self.exercise.question.strip()}{listing(self.exercise)}"

    def __repr__(self) -> str:
        return self._repr_markdown_().replace("**", "")


def practice(topic: str, level: int = 1, seed: int = 0) -> Practice:
    """An exercise made at random, to practise without end; the same seed gives the same exercise.

    Parameters
    ----------
    topic
        What is practised: "strokes" (lesson 0), "derive", "misprint" (1), "counts", "matrix", "length", "first" (2), "brackets"
        (3), "turtle" (4), "stages" (5), "conditions" (6), "life spans" (7), "chance" (8), "context" (9), "flowering" (10),
        "slices" (11), "lengths" (12), "space" (13), "looking" (14), "hedge" (15), "walls" (16), "language", "growth type" (17)
        or "rules" (18).
    level
        1, 2 or 3, from easy to hard.
    seed
        Which exercise; a whole number.

    Returns
    -------
    Practice
        The exercise, which displays as its question. Its `check(answer, hint=0, solution=False)` says whether an answer is
        right; its `next()` is another exercise. No misconception that is looked for leads to the right answer.

    Raises
    ------
    ModelNameError
        There is no such topic.
    ModelValueError
        There is no such level, or the seed is no whole number.

    Examples
    --------
    >>> exercise = practice("derive", seed=17)
    >>> exercise
    A word by hand
    <BLANKLINE>
    Derive by hand:
    <BLANKLINE>
        axiom: a
        a -> b a
        b -> a b
    <BLANKLINE>
    Write the word of step 3.
    >>> exercise.check("a b b a")
    Almost. That is what comes out if you stop one step too early, or call the axiom step 1. The axiom is step 0, and step 1 is
    what its modules become.
    >>> exercise.check("b a a b a b b a")
    Correct.
    """
    require(topic, str, 'A topic such as "derive"')
    if topic not in TOPICS:
        hint = suggestion(topic, TOPICS) or f"Topics are: {', '.join(TOPICS)}."
        raise ModelNameError(f'There is nothing to practise that is called "{quotable(topic)}"', hint=hint)
    level = whole_number(level, "The level")
    if not 1 <= level <= LEVELS:
        raise ModelValueError(f"The levels are 1 to {LEVELS}, not {level}")
    seed = whole_number(seed, "The seed")
    return Practice(topic, level, seed, _made(topic, level, seed, language()))


@lru_cache(maxsize=512)
def _made(topic: str, level: int, seed: int, _: str) -> Exercise:
    """The first sound exercise that chance yields, in the chosen language."""
    chance = Random(f"{topic}, {level}, {seed}")  # noqa: S311 (nothing secret depends on it)
    said = TOPICS[topic]
    draft = Draft({**said, **said.get(f"level_{level}", {})})
    with Task("No exercise was found"):
        while True:
            check_budget()
            made = MAKERS[topic](chance, level, draft)
            named = made and replace(made, id=f"{topic}, level {level}, seed {seed}", title=draft.text("title"))
            if named is not None and is_sound(named):
                return named


def is_sound(exercise: Exercise) -> bool:
    """Whether the misconceptions that an exercise is to uncover yield wrong answers, and none the right one."""
    if is_right_by_mistake(exercise):
        return False
    reached = {wrong.misconception.name for wrong in wrong_answers(exercise) if wrong.misconception}
    return set(exercise.expects) <= reached
