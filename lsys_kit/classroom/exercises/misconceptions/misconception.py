"""What a misconception is."""

from __future__ import annotations

from dataclasses import dataclass

from lsys_kit.classroom.exercises.misconceptions.answers import WrongAnswers

BY_DECLARATION = "a slip or an option that names it"
"""To what a misconception applies that computes no answer."""


@dataclass(frozen=True)
class Misconception:
    """A misconception.

    Attributes
    ----------
    name
        What exercises call it.
    applies
        To which questions.
    do, but
        What it does, and how it is.
    answers
        The wrong answers that it yields to a question.
    near
        Whether such an answer is nearly right.
    on_request
        Whether it is looked for in exercises only that expect it, since many answers could be taken for it.
    faint
        Whether one number shows too little of it: in questions for a number it is looked for only where it is expected.
    """

    name: str
    applies: str
    do: str
    but: str
    answers: WrongAnswers
    near: bool = False
    on_request: bool = False
    faint: bool = False
