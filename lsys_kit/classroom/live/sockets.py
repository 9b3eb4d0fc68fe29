"""The sockets of phones and boards. For those who do not read only the last state waits, and after a while they are dropped."""

from __future__ import annotations

import asyncio
import json
from urllib.parse import urlsplit

import tornado.web
import tornado.websocket

from lsys_kit.classroom.live import limits
from lsys_kit.classroom.live.audience import Audience
from lsys_kit.classroom.live.handlers import PHONE, OfTheClasses
from lsys_kit.classroom.live.limits import MOST_PHONES
from lsys_kit.classroom.live.live_class import LiveClass

MOST_SOCKETS, MOST_OF_ONE = 1_500, 4
"""So many sockets are open at a time, and so many of one phone."""


class _Socket(OfTheClasses, tornado.websocket.WebSocketHandler, Audience):
    """A phone or a board that is there."""

    def initialize(self) -> None:
        Audience.__init__(self)

    def check_origin(self, origin: str) -> bool:
        return urlsplit(origin).netloc.lower() == str(self.request.host).lower()

    async def send_text(self, text: str) -> None:
        try:
            await asyncio.wait_for(self.write_message(text), limits.PATIENCE)
        except tornado.websocket.WebSocketClosedError as gone:
            raise OSError from gone

    def drop(self) -> None:
        stream = getattr(self.ws_connection, "stream", None)
        if stream is not None:
            stream.close()

    def leave(self) -> None:
        self.close(1000, "opened elsewhere")

    def read(self, message: str | bytes) -> dict[str, object]:
        """What a message says; nothing, where it cannot be understood."""
        try:
            found = json.loads(message)
        except (ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


class PhoneSocket(_Socket):
    """A phone."""

    room: LiveClass | None = None

    def prepare(self) -> None:
        code, phone = self.path_args[0], self.get_query_argument("phone", "")
        room = self.server.classes.get(code)
        if room is None or not PHONE.fullmatch(phone):
            raise tornado.web.HTTPError(404)
        full = len(room.session.phones) >= MOST_PHONES and phone not in room.session.phones
        is_there = phone in room.phones
        if not (self.server.rejoining.allow(phone) if is_there else self.server.joining.allow(str(self.request.remote_ip))):
            raise tornado.web.HTTPError(429)
        if full or self.server.sockets >= MOST_SOCKETS:
            raise tornado.web.HTTPError(503)

    def open(self, code: str) -> None:
        self.room, self.phone = self.server.classes[code], self.get_query_argument("phone")
        self.server.sockets += 1
        own = self.room.phones.setdefault(self.phone, set())
        own.add(self)
        while len(own) > MOST_OF_ONE:
            oldest = next(each for each in own if each is not self)
            own.discard(oldest)
            oldest.leave()
        self.room.behind(self.phone)

    async def on_message(self, message: str | bytes) -> None:
        if self.room is not None:
            self.say(await self.room.said(self.phone, self.read(message)))

    def on_close(self) -> None:
        if self.room is not None:
            self.server.sockets -= 1
            own = self.room.phones.get(self.phone, set())
            own.discard(self)
            if not own:
                self.room.phones.pop(self.phone, None)
            self.room.behind("")


class BoardSocket(_Socket):
    """A board."""

    room: LiveClass | None = None

    def prepare(self) -> None:
        if self.server.with_secret(self.path_args[0]) is None:
            raise tornado.web.HTTPError(404)

    def open(self, secret: str) -> None:
        self.room = self.server.with_secret(secret)
        if self.room is not None:
            self.room.boards.add(self)
            self.show(self.room.board_state())

    async def on_message(self, message: str | bytes) -> None:
        if self.room is not None:
            await self.room.told_by(self, self.read(message))

    def on_close(self) -> None:
        if self.room is not None:
            self.room.boards.discard(self)
