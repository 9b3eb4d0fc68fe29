"""`practice`: exercises without end, made at random. One that a misconception would answer rightly is thrown away.

Tries are kept in the record of progress, and say which exercise comes next.
"""

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
from lsys_kit.classroom.exercises.practice.schedule import (
    LEVELS,
    Practised,
    due,
    kept_name,
    last_level,
    level_after,
    new_seed,
    practised,
)
from lsys_kit.classroom.exercises.progress import keep_try, record_so_far
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.exercises.verdict import Verdict
from lsys_kit.errors import ModelNameError, ModelValueError, quotable, require, whole_number
from lsys_kit.notation.analysis.checks import suggestion
from lsys_kit.translation import gettext, language


@dataclass(frozen=True, repr=False)
class Practice:
    """An exercise made at random: it displays as its question, and checks answers as `check` does.

    Attributes
    ----------
    topic, level, seed
        What it was made from.
    exercise
        What is asked, with the right answer.
    note
        Why this exercise comes, where that is to be said.
    then
        Where to go on after this one, as topic, level and seed: it is one of another topic, which was missed.
    """

    topic: str
    level: int
    seed: int
    exercise: Exercise
    note: str = ""
    then: tuple[str, int, int] | None = None

    def check(self, answer: object = None, hint: int = 0, solution: bool = False) -> Verdict:
        """The verdict on an answer; after a try a hint or the solution can be shown, as `check` does.

        The try is kept with the progress, without the answer.

        >>> practice("derive", seed=9).check("a")
        Not yet. That is the word of step 1. Or did you leave out one of the productions?
        """
        verdict = checked(self.exercise, answer, hint, solution, "check(answer")
        return verdict.with_more(keep_try(kept_name(self.topic, self.level, self.seed), answer, verdict))

    def next(self) -> Practice:
        """Another exercise: after two right answers at once one of the next level, after two wrong ones of the one before.

        A topic that was missed comes again after two others, and when it is solved at once then, after four and after eight.

        >>> practice("walls", seed=7).next().seed
        8
        """
        done = [each for each in practised(record_so_far().tries) if each.topic in TOPICS and each.level <= LEVELS]
        topic, level, seed = self.then or (self.topic, self.level, self.seed)
        found = level_after(done, topic, level)
        missed = None if self.then or found.why else due(done, topic)
        if missed is not None:
            return self._again(missed, done)
        why = found.why or ("back" if self.then else "")
        title = gettext(TOPICS[topic]["title"])
        note = reply(f"practice.{why}", level=found.level, title=title) if why else ""
        return replace(practice(topic, found.level, new_seed(done, topic, found.level, seed + 1)), note=note)

    def _again(self, missed: str, done: list[Practised]) -> Practice:
        """An exercise of a topic that was missed; then this one goes on."""
        level = level_after(done, missed, last_level(done, missed)).level
        note = reply("practice.again", title=gettext(TOPICS[missed]["title"]))
        then = self.topic, self.level, self.seed
        return replace(practice(missed, level, new_seed(done, missed, level, 0)), note=note, then=then)

    def _repr_markdown_(self) -> str:
        note = f"*{self.note}*\n\n" if self.note else ""
        return f"{note}**{self.exercise.title}**\n\n{self.exercise.question.strip()}{listing(self.exercise)}"

    def __repr__(self) -> str:
        return self._repr_markdown_().replace("**", "").replace(f"*{self.note}*", self.note)


def practice(topic: str, level: int = 1, seed: int = 0) -> Practice:
    """An exercise made at random, to practise without end; the same seed gives the same exercise.

    Parameters
    ----------
    topic
        What is practised: "strokes" (lesson 0), "derive", "misprint" (1), "counts", "matrix", "length", "first" (2), "brackets"
        (3), "turtle" (4), "stages" (5), "conditions", "formulas" (6), "life spans" (7), "chance" (8), "context" (9),
        "flowering" (10), "slices" (11), "lengths" (12), "space" (13), "looking" (14), "hedge" (15), "walls" (16), "language",
        "growth type" (17), "rules" (18) or "diffusion" (19).
    level
        1, 2 or 3, from easy to hard.
    seed
        Which exercise; a whole number.

    Returns
    -------
    Practice
        The exercise, which displays as its question. Its `check(answer, hint=0, solution=False)` says whether an answer is
        right; its `next()` is another exercise, at a level that follows the answers, and now and then of a topic that was
        missed. No misconception that is looked for leads to the right answer.

    Raises
    ------
    ModelNameError
        There is no such topic.
    ModelValueError
        There is no such level, or the seed is no whole number.

    Examples
    --------
    >>> exercise = practice("derive", seed=9)
    >>> exercise
    A word by hand
    <BLANKLINE>
    Derive by hand:
    <BLANKLINE>
        axiom: b
        a -> a a b
        b -> a
    <BLANKLINE>
    Write the word of step 3.
    >>> exercise.check("a a b")
    Almost. That is what comes out if you stop one step too early, or call the axiom step 1. The axiom is step 0, and step 1 is
    what its modules become.
    >>> exercise.check("a a b a a b a")
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
