"""What a kind of answers is: how an answer is read, when it is right, and what can be said of a wrong one."""

from __future__ import annotations

from collections.abc import Callable, Iterable
from dataclasses import dataclass
from typing import Generic, TypeVar

from lsys_kit.classroom.exercises.exercise import Exercise

Answer = TypeVar("Answer")
"""What an answer of a kind means: a word, a net, a drawing."""


@dataclass(frozen=True)
class Difference:
    """How a wrong answer differs, where no misconception explains it.

    Attributes
    ----------
    message
        Where it differs first, and what to look at; never what should be there.
    likeness
        How much of it is right, from 0 to 1.
    near
        Whether it is right but for one thing.
    at_a_place
        Whether the message names the place of a word at which it differs.
    at_a_case
        Whether it shows a case, or a place, that goes with whatever else is said.
    explains
        Whether it says how the answer came about: a misconception is asked about at most, and no repair is looked for.
    """

    message: str
    likeness: float = 0
    near: bool = False
    at_a_place: bool = False
    at_a_case: bool = False
    explains: bool = False


@dataclass(frozen=True)
class AnswerKind(Generic[Answer]):
    """One kind of answers.

    Attributes
    ----------
    read
        From the exercise and the answer as given to its meaning.
    difference
        From the exercise, a wrong answer and the solution to what can be said.
    same
        Whether two answers to an exercise mean the same.
    honest
        Whether a wrong answer is a try, after which the solution may be shown.
    praise
        What is added to a right answer.
    alike
        Whether an answer is a wrong one that is understood; `same`, where that will do.
    parts_right
        Of a wrong answer how many of its parts are right, and how many there are, which is its mark; None where it is right as
        a whole or not.
    picture
        What is drawn beside the reply to a wrong answer, as SVG text or empty.
    """

    read: Callable[[Exercise, object], Answer]
    difference: Callable[[Exercise, Answer, Answer], Difference]
    same: Callable[[Exercise, Answer, Answer], bool] = lambda exercise, own, other: bool(own == other)
    honest: Callable[[Exercise, Answer, Answer], bool] = lambda exercise, own, solution: True
    praise: Callable[[Exercise, Answer, Answer], str] = lambda exercise, own, solution: ""
    alike: Callable[[Exercise, Answer, Answer], bool] | None = None
    parts_right: Callable[[Exercise, Answer, Answer], tuple[int, int]] | None = None
    picture: Callable[[Exercise, Answer, Answer], str] = lambda exercise, own, solution: ""


def first_difference(mine: Iterable[object], wanted: Iterable[object]) -> int:
    """The first position, from 0, at which two rows differ; the length of the shorter where it begins the longer.

    >>> first_difference("abc", "abd"), first_difference("ab", "abd")
    (2, 2)
    """
    one, other = tuple(mine), tuple(wanted)
    shorter = min(len(one), len(other))
    return next((i for i in range(shorter) if one[i] != other[i]), shorter)


def one_apart(mine: tuple[object, ...], wanted: tuple[object, ...]) -> bool:
    """Whether two rows, of four or more, differ by one thing that is changed, missing or too much.

    >>> one_apart(tuple("abab"), tuple("abbb")), one_apart(tuple("aba"), tuple("abab")), one_apart(tuple("abab"), tuple("baba"))
    (True, True, False)
    """
    if len(wanted) < 4 or abs(len(mine) - len(wanted)) > 1:
        return False
    at = first_difference(mine, wanted)
    return mine[at + (len(mine) >= len(wanted)) :] == wanted[at + (len(wanted) >= len(mine)) :]
