"""Scores: what the last check of each exercise gave, for notebooks that are graded."""

from __future__ import annotations

from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.exercises.verdict import Verdict

_last: dict[str, float] = {}


def keep_score(exercise: str, verdict: Verdict) -> None:
    """Keep the score of a check, in place of that of an earlier one."""
    _last[exercise] = float(verdict)


def score(exercise: str) -> float:
    """The score of the answer to an exercise that was checked last.

    Graded notebooks end with a cell `score("1.1")` for each exercise, from which nbgrader takes the points. An answer that
    cannot be run was not checked.

    Parameters
    ----------
    exercise
        Its id, such as "1.1".

    Returns
    -------
    float
        From 0 to 1: 1 if the answer was right, the share of its parts that are right if it has parts, 0 if none was checked.

    Raises
    ------
    ModelNameError
        There is no such exercise.

    Examples
    --------
    >>> from lsys_kit import check
    >>> _ = check("2.1", "2, 3, 5, 8, 13, 26")
    >>> round(score("2.1"), 2)
    0.83
    """
    return _last.get(exercise_of(exercise).id, 0.0)
