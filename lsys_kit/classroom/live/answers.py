"""What pages and phones of a class ask the kit: what all pages of the course do, drawings for the wall, and games.

A worker process answers, under limits lower than those of a kernel: see `workers`.
"""

from __future__ import annotations

from collections.abc import Mapping

from lsys_kit.classroom.live.game import game_data, game_of
from lsys_kit.classroom.live.questions import asked_of, question
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.classroom.site import answers
from lsys_kit.classroom.wall import drawn_as
from lsys_kit.errors import ModelValueError
from lsys_kit.files import Entries

BUDGET: Mapping[str, float] = {**answers.BUDGET, "seconds": 2.0}
"""The limits of an answer."""


def answer(asked: Entries) -> Data:
    """What is answered to a question; a mistake in a model is an answer too.

    >>> answer({"kind": "check", "id": "1.1", "answer": "bl ar bl ar ar"})["said"]
    'Correct'
    """
    return answers.answer(asked, _KINDS, BUDGET)


def _plant(asked: Mapping[str, object]) -> Data:
    """A model or a link drawn for the wall."""
    drawn = drawn_as(str(asked["text"]), BUDGET["seconds"])
    if len(drawn.get("picture", "")) > MOST_PICTURE:
        raise ModelValueError("This drawing is too large for the wall", hint="Take fewer steps.")
    return drawn or {"mistake": {"message": "It takes too long to draw", "hint": "Take fewer steps."}}


MOST_PICTURE = 400_000
"""The greatest size of a drawing on the wall, in characters."""


def _asked(asked: Mapping[str, object]) -> Data:
    """What a question of a lesson asks, with its picture."""
    return asked_of(question(str(asked["of"]), str(asked["about"])))


def _game(asked: Mapping[str, object]) -> Data:
    """The game with a system."""
    return game_data(game_of(str(asked["what"])))


_KINDS: answers.Kinds = {**answers.KINDS, "plant": _plant, "asked": _asked, "game": _game}
