"""A class at work: what its events amount to, what a phone may say, and what the board and each phone are shown of it.

A session is a fold of events: after a restart it is what it was, and a board that reconnects, a report after class and a test
read the same.
"""

from __future__ import annotations

from collections import Counter
from collections.abc import Callable, Iterable, Mapping
from itertools import islice
from typing import Any, NamedTuple, TypeAlias

from lsys_kit.classroom.lessons.entries import number_of
from lsys_kit.classroom.lessons.lesson import lesson
from lsys_kit.classroom.live.events import TEACHER, Event
from lsys_kit.classroom.live.game import Game, cells_of, game_from, made_by, outcome
from lsys_kit.classroom.live.questions import (
    EXERCISE,
    PREDICTION,
    ROUNDS,
    TABLE,
    VOTE,
    in_words,
    question,
    questions,
    replies,
    right_cells,
    right_option,
    table_of,
)
from lsys_kit.classroom.panel.bundle import Data
from lsys_kit.errors import LSystemError
from lsys_kit.translation import gettext

GAME, PLANT, WALL = "game", "plant", "wall"
"""Be the cell; a plant that was sent to the wall; and the wall, which can be opened like a question."""
OPEN, CLOSED = "open", "closed"
MOST_SHOWN, MOST_SAID = 40, 4
"""So many different predictions are shown, and so many replies to an exercise."""
MOST_PLANTS, MOST_OF_A_PHONE = 200, 30
"""So many plants the wall has room for, older ones give way; and so many a phone may send."""
FEW_NUMBERS = 12
"""Predictions that are numbers are bars, if there are no more different ones than this; else a cloud of words."""


Said: TypeAlias = dict[str, Any]
"""What phones have said, by their names."""


class Asked(NamedTuple):
    """A question in one of its rounds: the first vote or the second; of a game its step."""

    kind: str
    about: str
    round: int


class Session:
    """What a class has said and done up to now.

    Attributes
    ----------
    current
        The question that the teacher has opened last, or None.
    answers
        For each question what each phone has said last, and the number of the message.
    seats, late
        The phones that were there when the current step of a game began, and those that came later, in their order: by these
        it is known who is which cell.
    status
        Whether a question is open or closed; one that the teacher has never opened is neither, and can be answered in a lesson.
    """

    def __init__(self, events: Iterable[Event] = ()) -> None:
        self.current: Asked | None = None
        self.answers: dict[Asked, dict[str, tuple[int, Any]]] = {}
        self.status: dict[Asked, str] = {}
        self.shown: set[Asked] = set()
        self.marked: dict[str, set[str]] = {}
        self.games: dict[str, Game] = {}
        self.plants: dict[int, Data] = {}
        self._last_plant = -1
        self.planted: Counter[str] = Counter()
        self.phones: dict[str, None] = {}
        self.last_done = 0
        self.seats: list[str] = []
        self.late: dict[str, int] = {}
        for event in events:
            self.take(event)

    def take(self, event: Event) -> None:
        """Take in an event, which was kept."""
        asked = Asked(event.kind, event.about, event.round)
        if event.phone == TEACHER:
            self.last_done = max(self.last_done, event.sent)
            _DONE[event.kind](self, event)
            return
        self.phones.setdefault(event.phone)
        if event.kind == PLANT:
            self._last_plant += 1
            self.planted[event.phone] += 1
            self.plants[self._last_plant] = event.value
            while len(self.plants) > MOST_PLANTS:
                del self.plants[min(self.plants)]
            return
        before = self.answers.setdefault(asked, {}).get(event.phone)
        if before is None or before[0] < event.sent:
            value = {**before[1], **event.value} if event.kind == GAME and before else event.value
            self.answers[asked][event.phone] = (event.sent, value)

    def refusal(self, asked: Asked) -> str | None:
        """Why nothing can be said to a question now; None if it can."""
        status = self.status.get(asked)
        if status == CLOSED or (asked.kind == GAME and status is None):
            return gettext("This question is closed.")
        return None

    # What the teacher does

    def _open(self, event: Event) -> None:
        self.current = Asked(event.value["kind"], event.value["about"], event.value["round"])
        if self.current.kind != WALL:
            self.status[self.current] = OPEN
        self.seats, self.late = list(event.value["seats"]), {}

    def _begin(self, event: Event) -> None:
        self.games[event.about] = game_from(event.value["game"])
        self.current = Asked(GAME, event.about, 1)
        self.status[self.current] = OPEN
        self.seats, self.late = list(event.value["seats"]), {}

    def _close(self, event: Event) -> None:
        self.status[Asked(*event.value)] = CLOSED

    def _show(self, event: Event) -> None:
        (self.shown.add if event.round else self.shown.discard)(Asked(*event.value))

    def _mark(self, event: Event) -> None:
        marked = self.marked.setdefault(event.about, set())
        (marked.add if event.round else marked.discard)(event.value)

    def _remove(self, event: Event) -> None:
        self.plants.pop(event.value, None)

    def _finish(self, event: Event) -> None:
        self.current = None

    # What is shown

    def values(self, asked: Asked) -> Said:
        """What each phone has said to a question."""
        return {phone: value for phone, (_, value) in self.answers.get(asked, {}).items()}

    def board(self, present: int) -> Data:
        """What the board shows, where so many phones are present."""
        found: Data = {"present": present, "current": None}
        if self.current is None:
            return found
        asked = self.current
        found["current"] = {
            "kind": asked.kind,
            "about": asked.about,
            "round": asked.round,
            "status": self.status.get(asked, OPEN),
            "shown": asked in self.shown,
            "rounds": ROUNDS.get(asked.kind, 1),
            "answered": len(self.answers.get(asked, {})),
            **_VIEWS[asked.kind](self, asked),
        }
        return found

    def phone(self, phone: str) -> Data:
        """What a phone shows."""
        asked = self.current
        if asked is None:
            return {"current": None}
        own = self.answers.get(asked, {}).get(phone)
        found: Data = {
            "kind": asked.kind,
            "about": asked.about,
            "round": asked.round,
            "status": self.status.get(asked, OPEN),
            "own": own[1] if own else None,
        }
        if asked.kind == GAME:
            found |= self._cells_of(phone, asked)
        elif asked.kind != WALL:
            known = question(asked.kind, asked.about)
            found |= {"title": known.title, "page": known.page, **in_words(known)}
        if asked.kind == VOTE and asked.round > 1 and asked in self.shown:
            choice = right_option(asked.about)
            found["right"] = choice
            found["reply"] = replies(asked.about)[own[1] if own else choice]
        return {"current": found}

    def _vote(self, asked: Asked) -> Data:
        return self.votes(asked.about, asked.round) if asked in self.shown else {}

    def votes(self, number: str, round: int) -> Data:
        """The votes on a question: how many for each option, and, for the second vote, how many have changed their minds."""
        right = right_option(number)
        first, second = (self.values(Asked(VOTE, number, each)) for each in (1, 2))
        many = len(replies(number))
        found: Data = {"bars": _counts(first if round == 1 else second, many)}
        if round == 2:
            found |= {"before": _counts(first, many), "right": right, "changes": changes(first, second, right)}
        return found

    def _prediction(self, asked: Asked) -> Data:
        if asked not in self.shown:
            return {}
        marked = self.marked.get(asked.about, set())
        counts = Counter(self.values(asked).values())
        said = [{"text": text, "count": count, "right": text in marked} for text, count in counts.most_common(MOST_SHOWN)]
        numbers = [number_of(each["text"]) for each in said]
        if all(number is not None for number in numbers) and 0 < len(said) <= FEW_NUMBERS:
            said = [each for _, each in sorted(zip(numbers, said, strict=True), key=lambda pair: pair[0] or 0)]
            return {"said": said, "numbers": True}
        return {"said": said, "numbers": False, "more": len(counts) - len(said)}

    def _table(self, asked: Asked) -> Data:
        table = table_of(question(TABLE, asked.about))
        marks = [right_cells(table, entries) for entries in self.values(asked).values()]
        cells = [
            {"right": sum(mark[place] is True for mark in marks), "wrong": sum(mark[place] is False for mark in marks)}
            for place in range(len(table.blanks))
        ]
        return {"cells": cells if asked in self.shown else None}

    def _exercise(self, asked: Asked) -> Data:
        said = [*self.values(asked).values()]
        solved = sum(each["said"] == "Correct" for each in said)
        stuck = Counter(each["message"] for each in said if each["said"] not in ("Correct", "Not answered yet"))
        return {
            "solved": solved,
            "stuck": stuck.total(),
            "replies": [{"text": text, "count": count} for text, count in stuck.most_common(MOST_SAID)]
            if asked in self.shown
            else None,
        }

    def _wall(self, asked: Asked) -> Data:
        return {"plants": [{"number": number, **each} for number, each in self.plants.items()]}

    # Be the cell

    def game(self, about: str) -> Game:
        return self.games[about]

    def _cells_of(self, phone: str, asked: Asked) -> Data:
        game = self.game(asked.about)
        turn = game.turns[asked.round - 1]
        many = len(turn.cells)
        if phone in self.seats:
            own = cells_of(self.seats.index(phone), len(self.seats), many)
        else:
            self.late.setdefault(phone, len(self.late))
            own = [(len(self.seats) + self.late[phone]) % many]
        texts = [cell.text for cell in turn.cells]
        cells = [
            {
                "place": place,
                "before": texts[place - 1] if place else None,
                "cell": texts[place],
                "behind": texts[place + 1] if place + 1 < len(texts) else None,
                "choices": turn.cells[place].choices,
            }
            for place in own
        ]
        return {"title": game.title, "rules": game.rules, "cells": cells, "many": len(texts)}

    def chosen(self, asked: Asked) -> dict[int, dict[int, int]]:
        """For each cell how often each choice was made."""
        found: dict[int, dict[int, int]] = {}
        for value in self.values(asked).values():
            for place, choice in value.items():
                counts = found.setdefault(int(place), {})
                counts[choice] = counts.get(choice, 0) + 1
        return found

    def _game_view(self, asked: Asked) -> Data:
        game = self.game(asked.about)
        turn, chosen = game.turns[asked.round - 1], self.chosen(asked)
        found: Data = {
            "question": game.title,
            "rules": game.rules,
            "before": [cell.text for cell in turn.cells],
            "played": [place in chosen for place in range(len(turn.cells))],
            "last": asked.round == len(game.turns),
        }
        if asked in self.shown:
            found["outcome"] = outcome(turn, made_by(turn, chosen))
        return found

    def game_value(self, asked: Asked, value: object) -> dict[str, int]:
        """What a phone has chosen for a cell, or for some.

        Raises
        ------
        LSystemError
            There is no such cell, or no such choice.
        """
        if asked.about not in self.games or not 0 < asked.round <= len(self.game(asked.about).turns):
            raise LSystemError("There is no such step of a game")
        cells = self.game(asked.about).turns[asked.round - 1].cells
        if not isinstance(value, dict) or not value:
            raise LSystemError("No cell was chosen")
        for place, choice in islice(value.items(), len(cells)):
            known = place.isascii() and place.isdigit() and len(place) < 4 and int(place) < len(cells)
            if not known or type(choice) is not int or not 0 <= choice < len(cells[int(place)].choices):
                raise LSystemError("There is no such cell, or no such choice")
        return {str(int(place)): choice for place, choice in islice(value.items(), len(cells))}


_DONE: Mapping[str, Callable[..., None]] = {
    "open": Session._open,
    "begin": Session._begin,
    "close": Session._close,
    "show": Session._show,
    "mark": Session._mark,
    "remove": Session._remove,
    "finish": Session._finish,
}
"""What comes of each thing that a teacher does."""
_VIEWS: Mapping[str, Callable[..., Data]] = {
    VOTE: Session._vote,
    PREDICTION: Session._prediction,
    TABLE: Session._table,
    EXERCISE: Session._exercise,
    WALL: Session._wall,
    GAME: Session._game_view,
}


def _counts(votes: Mapping[str, int], options: int) -> list[int]:
    counts = Counter(votes.values())
    return [counts[place] for place in range(options)]


def changes(first: Mapping[str, int], second: Mapping[str, int], right: int) -> Data:
    """What has changed between two votes of those who gave both, and the normalised gain: the part of the possible gain that
    was made (R. R. Hake, Interactive-engagement versus traditional methods, *American Journal of Physics* 66 (1998), 64-74).

    >>> changes({"p": 0, "q": 2, "r": 1}, {"p": 2, "q": 2, "r": 1, "s": 2}, 2)
    {'both': 3, 'better': 1, 'worse': 0, 'gain': 0.5}
    """
    both = [phone for phone in first if phone in second]
    before, after = (sum(votes[phone] == right for phone in both) for votes in (first, second))
    better = sum(first[phone] != right == second[phone] for phone in both)
    gain = (after - before) / (len(both) - before) if len(both) > before else None
    return {"both": len(both), "better": better, "worse": better - (after - before), "gain": gain}


def plan() -> list[Data]:
    """What the board's list offers: the lessons with their questions."""
    found: dict[str, Data] = {}
    for each in questions().values():
        row = found.setdefault(each.lesson, {"lesson": each.lesson, "title": lesson(each.lesson).title, "items": []})
        named = {"kind": each.kind, "about": each.about, "title": each.title, "rounds": ROUNDS[each.kind]}
        row["items"].append({**named, **in_words(each)})
    return [*found.values()]
