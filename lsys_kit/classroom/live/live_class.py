"""A class that is open: its session, who is there, what phones say to it, and what the teacher does."""

from __future__ import annotations

import asyncio
import json
from collections.abc import Awaitable, Callable, Mapping

from lsys_kit.classroom.live.audience import Audience
from lsys_kit.classroom.live.course_pages import CoursePages
from lsys_kit.classroom.live.events import TEACHER, ClassEntry, Event, NotKept
from lsys_kit.classroom.live.limits import MOST_MESSAGE, Rates
from lsys_kit.classroom.live.questions import EXERCISE, ROUNDS, named, question, value_of
from lsys_kit.classroom.live.session import GAME, MOST_OF_A_PHONE, PLANT, WALL, Asked, Session
from lsys_kit.classroom.live.workers import Workers
from lsys_kit.errors import LSystemError, ModelLimitError
from lsys_kit.translation import gettext

BETWEEN_STATES = 0.1
"""The board is drawn anew no more often than this, in seconds."""
MOST_REPLY = 400
"""So many characters of a reply to an answer are kept."""
_LAST_SENT = 2**53


class LiveClass:
    """A class with whoever is there: its session, its board and its phones."""

    def __init__(
        self,
        entry: ClassEntry,
        keep: Callable[[Event], Awaitable[bool]],
        workers: Workers,
        rates: Rates,
        course: CoursePages | None = None,
    ) -> None:
        self.entry = entry
        self._keep, self._workers, self._rates, self._course = keep, workers, rates, course
        self.session = Session()
        self.boards: set[Audience] = set()
        self.phones: dict[str, set[Audience]] = {}
        self.fault = ""
        self._behind: set[str] | None = set()
        self._board_behind, self._telling = False, False
        self._number = 0

    @property
    def present(self) -> list[str]:
        """The phones that are there, in the order in which they came."""
        return [*self.phones]

    async def keep(self, event: Event) -> bool:
        """Keep an event; then it counts, and is seen. Whether its number is new.

        Raises
        ------
        NotKept
            It could not be written.
        """
        try:
            is_new = await self._keep(event)
        except NotKept as fault:
            self.fault = str(fault)
            self.behind(event.phone)
            raise
        if self.fault:
            self.fault = ""
            self.behind(event.phone)
        return is_new

    def take(self, event: Event) -> None:
        """Let an event count that is kept."""
        self.session.take(event)
        self.behind(None if event.phone == TEACHER else event.phone)

    def behind(self, phone: str | None) -> None:
        """Something has changed for the board and a phone, or for all phones; they are told soon."""
        self._board_behind = True
        if phone is None or self._behind is None:
            self._behind = None
        else:
            self._behind.add(phone)
        if not self._telling:
            self._telling = True
            asyncio.get_running_loop().call_later(BETWEEN_STATES / 4, self._tell)

    def _tell(self) -> None:
        behind, self._behind = self._behind, set()
        for phone in self.present if behind is None else [each for each in behind if each in self.phones]:
            self.tell_phone(phone)
        if self._board_behind and self.boards:
            state = self.board_state()
            for board in self.boards:
                board.show(state)
        self._board_behind = False
        asyncio.get_running_loop().call_later(BETWEEN_STATES, self._told)

    def _told(self) -> None:
        self._telling = False
        if self._board_behind or self._behind is None or self._behind:
            self.behind("")

    def tell_phone(self, phone: str) -> None:
        """Send a phone its state."""
        state = json.dumps({"state": self.session.phone(phone)})
        for each in self.phones.get(phone, ()):
            each.show(state)

    def board_state(self) -> str:
        """What the board shows now."""
        fault = self.fault or (self._course.fault if self._course else "")
        pages = self._course.progress if self._course else None
        return json.dumps({"state": {**self.session.board(len(self.phones)), "fault": fault, "pages": pages}})

    # What phones say

    async def said(self, phone: str, message: Mapping[str, object]) -> dict[str, object]:
        """Keep what a phone says, and answer it: kept, or refused and why, or to be sent again later."""
        sent = message.get("sent")
        if type(sent) is not int or not 0 < sent < _LAST_SENT:
            return {"refused": 0, "why": gettext("This message cannot be understood.")}
        try:
            asked, value = self._understood(message)
        except (LSystemError, TypeError, KeyError, ValueError, AttributeError):
            return {"refused": sent, "why": gettext("This message cannot be understood.")}
        if not self._rates.allow(phone):
            return {"later": sent, "why": gettext("Slowly, please.")}
        if why := self.session.refusal(asked):
            return {"refused": sent, "why": why}
        try:
            await self.keep(Event(self.entry.code, phone, sent, *asked, value))
        except NotKept:
            return {"later": sent, "why": gettext("The teacher's computer cannot keep it now.")}
        return {"kept": sent}

    def _understood(self, message: Mapping[str, object]) -> tuple[Asked, object]:
        kind, about, round = (message[name] for name in ("kind", "about", "round"))
        if not (isinstance(kind, str) and isinstance(about, str) and type(round) is int):
            raise ValueError
        if kind == GAME:
            asked = Asked(GAME, about, round)
            return asked, self.session.game_value(asked, message["value"])
        known = named(kind, about, str(message.get("asked", "")))
        if not 0 < round <= ROUNDS[known.kind] or kind == EXERCISE:
            raise ValueError
        return Asked(known.kind, known.about, round), value_of(known, message["value"])

    async def asks(self, phone: str, content: Mapping[str, object]) -> bytes:
        """What the kit answers to a phone; a try at an exercise and a plant are kept before the phone hears of it."""
        kind, sent = content.get("kind"), content.get("sent")
        if kind == PLANT and self.session.planted[phone] >= MOST_OF_A_PHONE:
            return mistake(f"You have sent {MOST_OF_A_PHONE} plants already", "That is all the wall has room for.").encode()
        number = sent if type(sent) is int and 0 < sent < _LAST_SENT else 0
        counted = number and (kind == PLANT or (kind == "check" and not (content.get("hint") or content.get("solution"))))
        asked = {name: value for name, value in content.items() if name not in ("sent", "phone")}
        answer = await self._workers.ask(phone, asked)
        found = json.loads(answer) if counted else {}
        if not counted or "mistake" in found:
            return answer
        if kind == PLANT:
            event = (PLANT, "", 1, {name: str(found.get(name, "")) for name in ("picture", "description", "rules")})
        else:
            known = question(EXERCISE, str(content["id"]))
            if self.session.refusal(Asked(EXERCISE, known.about, 1)):
                return answer
            event = (EXERCISE, known.about, 1, {"said": found["said"], "message": found["message"][:MOST_REPLY]})
        await self.keep(Event(self.entry.code, phone, number, *event))
        return answer

    # What the teacher does

    async def told_by(self, board: Audience, content: Mapping[str, object]) -> None:
        """Do what the teacher asks for at a board; a board hears of what cannot be done."""
        try:
            await self.does(content)
        except LSystemError as fault:
            board.say({"mistake": f"{fault.message}. {fault.hint or ''}".strip()})

    async def does(self, content: Mapping[str, object]) -> None:
        """Keep and do what the teacher asks for.

        Raises
        ------
        LSystemError
            It cannot be done, or not be kept.
        """
        done = content.get("do")
        if done in ("open", "close", "show"):
            asked = self._asked_by(content)
            value: object = [*asked]
            if done == "open":
                value = {**asked._asdict(), "seats": self.present}
            await self._did(str(done), "", int(content.get("on") is not False), value)
        elif done == "begin":
            what = str(content.get("what", ""))
            if len(what) > MOST_MESSAGE:
                raise ModelLimitError("This model is too long for a game", limit=MOST_MESSAGE)
            game = json.loads(await self._workers.ask(TEACHER, {"kind": "game", "what": what}))
            if "mistake" in game:
                raise LSystemError(game["mistake"]["message"].rstrip("."), hint=game["mistake"]["hint"] or None)
            await self._did("begin", str(len(self.session.games) + 1), 0, {"game": game, "seats": self.present})
        elif done == "mark":
            about, text = str(content.get("about")), str(content.get("text"))[:MOST_REPLY]
            question("prediction", about)
            await self._did("mark", about, int(content.get("on") is not False), text)
        elif done == "remove" and type(content.get("number")) is int:
            await self._did("remove", "", 0, content["number"])
        elif done == "finish":
            await self._did("finish", "", 0, None)
        else:
            raise LSystemError("The board asks for something that nobody knows")

    def _asked_by(self, content: Mapping[str, object]) -> Asked:
        kind, about, round = content.get("kind"), content.get("about"), content.get("round")
        asked = Asked(str(kind), str(about), round if type(round) is int else 0)
        if asked.kind == WALL:
            return Asked(WALL, "", 1)
        if asked.kind == GAME:
            if asked.about not in self.session.games or not 0 < asked.round <= len(self.session.game(asked.about).turns):
                raise LSystemError("There is no such step of a game")
            return asked
        known = question(asked.kind, asked.about)
        if not 0 < asked.round <= ROUNDS[known.kind]:
            raise LSystemError("There is no such question")
        return asked

    async def _did(self, kind: str, about: str, round: int, value: object) -> None:
        is_new = False
        while not is_new:  # another server of this class may have taken the number
            self._number = max(self._number, self.session.last_done) + 1
            is_new = await self.keep(Event(self.entry.code, TEACHER, self._number, kind, about, round, value))


def mistake(message: str, hint: str) -> str:
    """What a page hears in place of an answer, as JSON."""
    return json.dumps({"mistake": {"message": message, "hint": hint}})
