"""What is wrong with a model, before it is put into words.

Checks know the records of a model and no notation. A check raises the problem that it finds, or returns those that are only
worth a note; the notation in which the text is read words them (`syntax.wording`).
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass, field

from lsys_kit.notation.model.expressions import TextSpan


@dataclass(frozen=True)
class Problem:
    """Something wrong with a model.

    Attributes
    ----------
    code
        Which problem it is: a key of the table of wordings.
    place
        The offsets in the text.
    subject
        What it is about, by the names that the wordings use: records, names, numbers.
    suggestion
        The name that was probably meant, if there is one.
    """

    code: str
    place: TextSpan = None
    subject: Mapping[str, object] = field(default_factory=dict)
    suggestion: str | None = None


class ProblemFound(Exception):
    """A problem on its way from a check to whoever words it."""

    def __init__(self, problem: Problem) -> None:
        super().__init__(problem)
        self.problem = problem


def problem(code: str, place: TextSpan = None, suggestion: str | None = None, **subject: object) -> ProblemFound:
    """The exception that reports a problem.

    >>> problem("second axiom", (0, 8)).problem.code
    'second axiom'
    """
    return ProblemFound(Problem(code, place, subject, suggestion))
