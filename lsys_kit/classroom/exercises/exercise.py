"""The records of exercises: a lesson's file, an exercise, and the wrong answers that it declares itself."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field

from lsys_kit.notation.model.arithmetic import Value


@dataclass(frozen=True)
class Slip:
    """A wrong answer that an exercise expects, and the reply to it.

    Attributes
    ----------
    answer
        As a student would type it.
    says
        What is true of everybody who gives it; empty where `misconception` names the sentence.
    misconception
        A name in the table of misconceptions, or empty.
    near
        Whether it is nearly right.
    """

    answer: str
    says: str = ""
    misconception: str = ""
    near: bool = False


@dataclass(frozen=True)
class Option:
    """One of the options of a choice; a wrong one says why, or names the misconception that leads to it."""

    text: str
    says: str = ""
    misconception: str = ""


@dataclass(frozen=True)
class Exercise:
    """An exercise as its file declares it; `.github/EXERCISES.md` explains each key.

    Attributes
    ----------
    id, title, question
        What is asked; the question is Markdown.
    kind
        A key of `ANSWER_KINDS`.
    solution, explanation, picture
        The right answer, as a student would type it, and why; a model whose drawing is shown with that, or empty.
    hints
        Help on request, in order.
    objective
        Which of the lesson's objectives it tests, from 1.
    slips
        The wrong answers that it expects, with replies.
    expects, unlikely
        Misconceptions of the table that must apply, and those that are not looked for.
    otherwise
        The reply to a wrong answer that nothing explains, or empty.
    template
        What the cell shows before anything is typed.
    system, constants, steps, at, asks
        The system that the question is about, values for its constants, the step, the steps of a table, and what is asked.
    also
        Further right answers, as a student would type them.
    symbols
        The letters of a word without a system; the order of counts in a table; the places of a net that the question names.
    text
        The word or program of which a symbol or line is asked.
    unit, tolerance
        Of a number.
    options
        Of a choice.
    given, probes, settings, names, drawn
        Of a system, or the first of a map: the part that the question gives; further axioms and constants for which it must be
        right; how its symbols may be renamed ("new", "any" or "fixed"); whether angle, heading and length count,
        and of a drawing the direction in which it stands.
    behind
        Of a system: whether what is typed stands behind what the question gives, and need not be right in front of it.
    values
        Of an expression: its names, each with the values for which it is asked.
    """

    id: str
    title: str
    kind: str
    question: str
    solution: str
    explanation: str = ""
    hints: tuple[str, ...] = ()
    also: tuple[str, ...] = ()
    objective: int = 0
    slips: tuple[Slip, ...] = ()
    expects: tuple[str, ...] = ()
    unlikely: tuple[str, ...] = ()
    otherwise: str = ""
    picture: str = ""
    template: str = "..."
    system: str = ""
    constants: Mapping[str, Value] = field(default_factory=dict, hash=False)
    steps: int = 0
    at: tuple[int, ...] = ()
    asks: str = ""
    symbols: tuple[str, ...] = ()
    text: str = ""
    unit: str = ""
    tolerance: Value = 0
    options: tuple[Option, ...] = ()
    given: str = ""
    probes: tuple[str, ...] = ()
    settings: tuple[Mapping[str, Value], ...] = field(default=(), hash=False)
    names: str = "new"
    drawn: bool = False
    behind: bool = False
    values: Mapping[str, Sequence[Value]] = field(default_factory=dict, hash=False)

    def __repr__(self) -> str:
        return f"{self.id:8} {self.title}"


@dataclass(frozen=True)
class Lesson:
    """The exercises of one lesson.

    Attributes
    ----------
    name
        The name of its notebook, without the suffix; the lesson's notebook has the same name.
    title, objectives, introduction, summary
        The text around the exercises, in Markdown.
    exercises
        In their order.
    """

    name: str
    title: str
    objectives: tuple[str, ...]
    introduction: str
    summary: str
    exercises: tuple[Exercise, ...]
