"""The server of a class, on the teacher's laptop: phones join, vote, predict and play; the board shows what the class thinks.

What a phone says is kept before the phone hears so. Whatever needs Python is done by worker processes. For those who do not
read what they are sent only the last state waits, and after a while they are dropped; what is sent is bounded in size and in
rate, for each phone and for all. The board's rights need its secret, and no path leads to a file: pages are in memory.
"""

from __future__ import annotations

import asyncio
import hmac
import json
import re
import socket
import sqlite3
import time
from collections import deque
from collections.abc import Mapping
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from gzip import compress
from hashlib import sha256
from pathlib import Path
from typing import Any
from urllib.parse import urlsplit

import tornado.httpserver
import tornado.ioloop
import tornado.netutil
import tornado.web
import tornado.websocket

from lsys_kit.classroom.live import pages
from lsys_kit.classroom.live.events import LETTERS, TEACHER, ClassEntry, Event, Events, NotKept
from lsys_kit.classroom.live.questions import EXERCISE, ROUNDS, VOTE, named, question, questions, value_of
from lsys_kit.classroom.live.session import GAME, MOST_OF_A_PHONE, PLANT, WALL, Asked, Session
from lsys_kit.classroom.live.workers import Busy, Workers
from lsys_kit.errors import LSystemError, ModelFileError, ModelLimitError
from lsys_kit.translation import gettext

PORT = 8765
MOST_MESSAGE, MOST_ASKED = 16_000, 64_000
"""So many bytes at most a message of a phone has, and a question to the kit."""
MOST_SOCKETS, MOST_OF_ONE, MOST_PHONES = 1_500, 4, 2_000
"""So many sockets are open at a time; so many of one phone; and so many phones take part in a class."""
PATIENCE = 15.0
"""Who has not read for so many seconds is dropped; the page of a phone comes back by itself."""
MOST_UNREAD = 500
"""Who has not read so many messages is dropped, too."""
BETWEEN_STATES = 0.1
"""The board is drawn anew no more often than this, in seconds."""
BETWEEN_LOOKS = 0.25
"""What other servers of the same table have kept is looked for again after so many seconds."""
MOST_REPLY = 400
"""So many characters of a reply to an answer are kept."""
_PHONE = re.compile(r"[0-9a-f]{32}")
_HOST = re.compile(r"[\w.\[\]:-]{1,253}")
_LAST_SENT = 2**53
SECURE: Mapping[str, str] = {
    "Content-Security-Policy": "frame-ancestors 'none'; base-uri 'none'; form-action 'none'; object-src 'none'",
    "X-Content-Type-Options": "nosniff",
    "X-Frame-Options": "DENY",
    "Referrer-Policy": "no-referrer",
    "Cross-Origin-Opener-Policy": "same-origin",
    "Cross-Origin-Resource-Policy": "same-origin",
    "Cache-Control": "no-cache",
    "Server": "lsys-kit",
}
"""Headers of every answer; which scripts a page runs, it says itself."""


class Rate:
    """How often something may be done: so many times at once, and so many times a second in the long run."""

    def __init__(self, burst: float, second: float) -> None:
        self._burst, self._second = burst, second
        self._left, self._seen = burst, time.monotonic()

    def allows(self) -> bool:
        """Whether it may be done once more now."""
        now = time.monotonic()
        self._left = min(self._burst, self._left + (now - self._seen) * self._second)
        self._seen = now
        if self._left < 1:
            return False
        self._left -= 1
        return True

    @property
    def is_full(self) -> bool:
        """Whether it is as if nothing had been done for long."""
        return self._left + (time.monotonic() - self._seen) * self._second >= self._burst


class Rates:
    """The rates of many, by their names; those that have done nothing for long are forgotten."""

    def __init__(self, burst: float, second: float) -> None:
        self._limits, self._of = (burst, second), dict[str, Rate]()

    def allow(self, name: str) -> bool:
        """Whether one of them may do it once more now."""
        if len(self._of) > MOST_PHONES:
            self._of = {each: rate for each, rate in self._of.items() if not rate.is_full}
        return self._of.setdefault(name, Rate(*self._limits)).allows()


class Audience:
    """Somebody who is told of a class: what was acknowledged, and the last state; older states are not sent."""

    def __init__(self) -> None:
        self._messages: deque[str] = deque()
        self._state: str | None = None
        self._last_state = ""
        self._sending = False

    async def send_text(self, text: str) -> None:
        """Send a text, and wait until there is room for the next.

        Raises
        ------
        OSError, TimeoutError
            Nobody is there any more, or nobody reads.
        """
        raise NotImplementedError

    def drop(self) -> None:
        """Let go of somebody who does not read."""
        raise NotImplementedError

    def show(self, state: str) -> None:
        """Send a state, in place of one that has not been sent yet."""
        if state != self._last_state:
            self._state = state
            self._send_soon()

    def say(self, message: Mapping[str, object]) -> None:
        """Send a message; who does not read is dropped."""
        self._messages.append(json.dumps(message))
        if len(self._messages) > MOST_UNREAD:
            self.drop()
        else:
            self._send_soon()

    def _send_soon(self) -> None:
        if not self._sending:
            self._sending = True
            asyncio.get_running_loop().create_task(self._send())

    async def _send(self) -> None:
        try:
            while self._messages or self._state is not None:
                if self._messages:
                    text = self._messages.popleft()
                else:
                    text, self._state = self._state or "", None
                    self._last_state = text
                await self.send_text(text)
        except TimeoutError:
            self.drop()
        except OSError:
            pass
        finally:
            self._sending = False


class LiveClass:
    """A class with whoever is there: its session, its board and its phones."""

    def __init__(self, entry: ClassEntry, server: ClassServer) -> None:
        self.entry, self.server = entry, server
        self.session = Session()
        self.boards: set[Audience] = set()
        self.phones: dict[str, set[_Socket]] = {}
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
            is_new = await self.server.keep(event)
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
        return json.dumps({"state": {**self.session.board(len(self.phones)), "fault": self.fault}})

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
        if not self.server.rates.allow(phone):
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
            return _mistake(f"You have sent {MOST_OF_A_PHONE} plants already", "That is all the wall has room for.").encode()
        number = sent if type(sent) is int and 0 < sent < _LAST_SENT else 0
        counted = number and (kind == PLANT or (kind == "check" and not (content.get("hint") or content.get("solution"))))
        asked = {name: value for name, value in content.items() if name not in ("sent", "phone")}
        answer = await self.server.workers.ask(phone, asked)
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
            game = json.loads(await self.server.workers.ask(TEACHER, {"kind": "game", "what": what}))
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


class ClassServer:
    """Several classes on one port.

    Parameters
    ----------
    folder
        Where what the classes say is kept.
    names
        The names of the classes; those that are known already go on where they were.
    course
        The pages of the course by their names, as bytes; none where there is no course.
    workers
        How many worker processes there are.
    """

    def __init__(
        self, folder: str | Path, names: list[str], course: Mapping[str, bytes] | None = None, workers: int | None = None
    ) -> None:
        self.events = Events(folder)
        entries = [self.events.named(name) for name in names]
        self.workers = Workers(workers)
        self.rates, self.asking, self.joining = Rates(20, 4), Rates(12, 3), Rates(400, 20)
        self.course = {name: _Page(content) for name, content in (course or {}).items()}
        self.address = ""
        self._asked: dict[tuple[str, str], _Page] = {}
        questions()  # they are read before anybody waits for them
        self._writer = ThreadPoolExecutor(1)
        self._pending: deque[tuple[Event, asyncio.Future[bool]]] = deque()
        self._tasks: list[asyncio.Task[None]] = []
        self._writing = False
        self.sockets = 0
        self._server: tornado.httpserver.HTTPServer | None = None
        self.classes = {entry.code: LiveClass(entry, self) for entry in entries}
        for event in self.events.news():
            if event.code in self.classes:
                self.classes[event.code].session.take(event)

    def listen(self, port: int = PORT, host: str = "", address: str | None = None, behind_a_proxy: bool = False) -> int:
        """Begin to listen, and return the port; 0 lets the system choose one.

        Raises
        ------
        ModelFileError
            The port is taken.
        """
        try:
            sockets = tornado.netutil.bind_sockets(port, host or None, socket.AF_INET if not host else socket.AF_UNSPEC)
        except OSError as fault:
            hint = "Choose another one: --port 8766."
            raise ModelFileError(f"The port {port} cannot be used: {fault.strerror or fault}", hint=hint) from None
        self._server = tornado.httpserver.HTTPServer(
            _application(self),
            xheaders=behind_a_proxy,
            max_buffer_size=4 * MOST_ASKED,
            max_header_size=16_000,
            max_body_size=MOST_ASKED,
            idle_connection_timeout=PATIENCE,
            body_timeout=PATIENCE,
        )
        self._server.add_sockets(sockets)
        found = int(sockets[0].getsockname()[1])
        self._tasks = [asyncio.get_running_loop().create_task(each) for each in (self._get_ready(), self._follow())]
        self.address = (address or f"http://{host or own_address()}:{found}").rstrip("/")
        return found

    async def keep(self, event: Event) -> bool:
        """Write an event together with all that wait at the same time; whether its number is new."""
        done: asyncio.Future[bool] = asyncio.get_running_loop().create_future()
        self._pending.append((event, done))
        if not self._writing:
            self._writing = True
            asyncio.get_running_loop().create_task(self._write())
        return await done

    async def _write(self) -> None:
        while self._pending:
            batch = [*self._pending]
            self._pending.clear()
            try:
                events = [each for each, _ in batch]
                new, news = await asyncio.get_running_loop().run_in_executor(self._writer, self._keep, events)
            except Exception as fault:
                for _, done in batch:
                    if not done.done():
                        done.set_exception(fault if isinstance(fault, NotKept) else NotKept(f"Nothing can be kept: {fault}"))
                continue
            self._take(news)
            for (_, done), is_new in zip(batch, new, strict=True):
                if not done.done():
                    done.set_result(is_new)
        self._writing = False

    def _keep(self, events: list[Event]) -> tuple[list[bool], list[Event]]:
        return self.events.keep(events), self.events.news()

    def _take(self, news: list[Event]) -> None:
        for event in news:
            if event.code in self.classes:
                self.classes[event.code].take(event)

    async def _follow(self) -> None:
        """Take in what other servers of the same table have kept."""
        while True:
            await asyncio.sleep(BETWEEN_LOOKS)
            with suppress(sqlite3.Error):  # it is looked for again
                self._take(await asyncio.get_running_loop().run_in_executor(self._writer, self.events.news))

    async def what_is_asked(self, kind: str, about: str) -> _Page:
        """What a question asks, as JSON; a worker draws its picture, once.

        Raises
        ------
        Busy
            It cannot be answered now.
        """
        if (kind, about) not in self._asked:
            content = await self.workers.ask(f"{kind} {about}", {"kind": "asked", "of": kind, "about": about})
            if "mistake" in json.loads(content):
                raise Busy("Too much is asked at once", hint="Try it again in a moment.")
            self._asked[kind, about] = _Page(content)
        return self._asked[kind, about]

    async def _get_ready(self) -> None:
        """Have at hand what every vote asks, so that nobody waits for it in class."""
        for kind, about in questions():
            if kind == VOTE:
                with suppress(Busy):
                    await self.what_is_asked(kind, about)

    def with_secret(self, secret: str) -> LiveClass | None:
        """The class whose board has a secret; all are compared, each in the same time."""
        given = secret.encode("utf-8", "replace")
        found = [room for room in self.classes.values() if hmac.compare_digest(given, room.entry.secret.encode())]
        return found[0] if found else None

    def board_address(self, code: str) -> str:
        """The address of a class's board."""
        return f"{self.address}/board/{self.classes[code].entry.secret}/"

    def join_address(self, code: str) -> str:
        """The address at which phones join a class."""
        return f"{self.address}/{code}/"

    async def close(self) -> None:
        """Stop to listen, and end all workers."""
        for task in self._tasks:
            task.cancel()
        if self._server is not None:
            self._server.stop()
            with suppress(TimeoutError):
                await asyncio.wait_for(self._server.close_all_connections(), 3)
        self.workers.close()
        self._writer.shutdown()
        self.events.close()


def own_address() -> str:
    """The address of this machine in its network; no packet is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("10.255.255.255", 9))
            return str(probe.getsockname()[0])
        except OSError:
            return "127.0.0.1"


class _Page:
    """A page in memory, as it is sent, and by what a browser knows it again."""

    def __init__(self, content: bytes) -> None:
        self.packed, self.plain = compress(content, 6), content
        self.tag = f'"{sha256(content).hexdigest()[:32]}"'


# What is asked over HTTP


class _OfTheClass(tornado.web.RequestHandler):
    """What requests and sockets share: the server of the class, and the headers of all that it sends."""

    application: _Application

    @property
    def server(self) -> ClassServer:
        return self.application.class_server

    def set_default_headers(self) -> None:
        for name, value in SECURE.items():
            self.set_header(name, value)


class _Handler(_OfTheClass):
    """What all requests share."""

    def room(self, code: str) -> LiveClass:
        found = self.server.classes.get(code.upper())
        if found is None:
            if not self.server.joining.allow(str(self.request.remote_ip)):
                raise tornado.web.HTTPError(429)
            raise tornado.web.HTTPError(404)
        return found

    def board(self, secret: str) -> LiveClass:
        found = self.server.with_secret(secret)
        if found is None:
            raise tornado.web.HTTPError(404)
        return found

    def write_error(self, status_code: int, **_: object) -> None:
        self.send(_Page(pages.problem_page(status_code).encode()), "text/html; charset=utf-8")

    def send(self, page: _Page, kind: str) -> None:
        """Send a page, if the browser does not have it already."""
        self.set_header("Content-Type", kind)
        self.set_header("Vary", "Accept-Encoding")
        self.set_header("ETag", page.tag)
        if self.get_status() == 200 and self.request.headers.get("If-None-Match") == page.tag:
            self.set_status(304)
            self.finish()
        elif "gzip" in self.request.headers.get("Accept-Encoding", ""):
            self.set_header("Content-Encoding", "gzip")
            self.finish(page.packed)
        else:
            self.finish(page.plain)

    def compute_etag(self) -> str | None:
        return None  # it is set where there is one


class _Door(_Handler):
    """The page on which a code is typed."""

    def get(self) -> None:
        self.send(_Page(pages.door_page().encode()), "text/html; charset=utf-8")


class _Phone(_Handler):
    """The page of a phone."""

    def get(self, code: str) -> None:
        room = self.room(code)
        if code != room.entry.code or not self.request.path.endswith("/"):
            self.redirect(f"/{room.entry.code}/")
        else:
            self.send(_Page(pages.phone_page(room.entry, bool(self.server.course)).encode()), "text/html; charset=utf-8")


class _Course(_Handler):
    """A page of the course."""

    def get(self, code: str, name: str) -> None:
        self.room(code)
        page = self.server.course.get(name)
        if page is None:
            raise tornado.web.HTTPError(404)
        self.send(page, "text/html; charset=utf-8")


class _Asked(_Handler):
    """What a question asks, which a phone and the board need once."""

    async def get(self, kind: str, about: str) -> None:
        if (kind, about) not in questions():
            raise tornado.web.HTTPError(404)
        try:
            found = await self.server.what_is_asked(kind, about)
        except Busy:
            raise tornado.web.HTTPError(503) from None
        self.send(found, "application/json")


class _Ask(_Handler):
    """A question of a page to the kit."""

    async def post(self, code: str) -> None:
        room = self.room(code)
        origin = self.request.headers.get("Origin")
        if origin and urlsplit(origin).netloc.lower() != str(self.request.host).lower():
            raise tornado.web.HTTPError(403)
        try:
            content = json.loads(self.request.body)
            phone = content.get("phone")
        except (ValueError, AttributeError, RecursionError):
            raise tornado.web.HTTPError(400) from None
        if not isinstance(phone, str) or not _PHONE.fullmatch(phone):
            raise tornado.web.HTTPError(400)
        self.set_header("Content-Type", "application/json")
        if not self.server.asking.allow(phone):
            self.finish(_mistake("You ask faster than can be answered", "Wait a moment."))
            return
        try:
            self.finish(await room.asks(phone, content))
        except (Busy, NotKept) as fault:
            self.finish(_mistake(fault.message, fault.hint or ""))
        except LSystemError:
            raise tornado.web.HTTPError(400) from None


def _mistake(message: str, hint: str) -> str:
    return json.dumps({"mistake": {"message": message, "hint": hint}})


class _Board(_Handler):
    """The board of a class."""

    def get(self, secret: str) -> None:
        room = self.board(secret)
        if not self.request.path.endswith("/"):
            self.redirect(f"/board/{room.entry.secret}/")
        else:
            page = pages.board_page(room.entry, self.server.join_address(room.entry.code))
            self.send(_Page(page.encode()), "text/html; charset=utf-8")


class _Plant(_Handler):
    """A drawing of the wall, in which nothing runs."""

    def get(self, secret: str, number: str) -> None:
        room = self.board(secret)
        plant = room.session.plants.get(int(number))
        if plant is None:
            raise tornado.web.HTTPError(404)
        self.set_header("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox")
        self.send(_Page(plant["picture"].encode()), "image/svg+xml")


# Sockets


class _Socket(_OfTheClass, tornado.websocket.WebSocketHandler, Audience):
    """A phone or a board that is there."""

    def initialize(self) -> None:
        Audience.__init__(self)

    def check_origin(self, origin: str) -> bool:
        return urlsplit(origin).netloc.lower() == str(self.request.host).lower()

    async def send_text(self, text: str) -> None:
        try:
            await asyncio.wait_for(self.write_message(text), PATIENCE)
        except tornado.websocket.WebSocketClosedError as gone:
            raise OSError from gone

    def drop(self) -> None:
        stream = getattr(self.ws_connection, "stream", None)
        if stream is not None:
            stream.close()

    def read(self, message: str | bytes) -> dict[str, object]:
        """What a message says; nothing, where it cannot be understood."""
        try:
            found = json.loads(message)
        except (ValueError, RecursionError):
            return {}
        return found if isinstance(found, dict) else {}


class _PhoneSocket(_Socket):
    """A phone."""

    room: LiveClass | None = None

    def prepare(self) -> None:
        code, phone = self.path_args[0], self.get_query_argument("phone", "")
        room = self.server.classes.get(code)
        if room is None or not _PHONE.fullmatch(phone):
            raise tornado.web.HTTPError(404)
        full = len(room.session.phones) >= MOST_PHONES and phone not in room.session.phones
        if phone not in room.phones and not self.server.joining.allow(str(self.request.remote_ip)):
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
            oldest.close(1000, "opened elsewhere")
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


class _BoardSocket(_Socket):
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


class _Application(tornado.web.Application):
    """The addresses of a server."""

    def __init__(self, server: ClassServer, handlers: list[Any], **settings: Any) -> None:
        super().__init__(handlers, **settings)
        self.class_server = server

    def log_request(self, handler: tornado.web.RequestHandler) -> None:
        """Nothing is written down of who has asked for what."""


def _application(server: ClassServer) -> _Application:
    code = rf"([{LETTERS}{LETTERS.lower()}]{{4}})"
    key = r"([\w-]{8,64})"
    return _Application(
        server,
        [
            (r"/", _Door),
            (rf"/{code}/?", _Phone),
            (rf"/{code}/course/([\w/.-]{{1,200}})", _Course),
            (r"/asked/([a-z]{4,12})/([\w.:-]{1,60})", _Asked),
            (rf"/{code}/ask", _Ask),
            (rf"/{code}/live", _PhoneSocket),
            (rf"/board/{key}/?", _Board),
            (rf"/board/{key}/live", _BoardSocket),
            (rf"/board/{key}/plants/(\d{{1,6}})", _Plant),
        ],
        default_handler_class=_Nothing,
        websocket_max_message_size=MOST_MESSAGE,
        websocket_ping_interval=20,
        websocket_ping_timeout=15,
        compress_response=False,
    )


class _Nothing(_Handler):
    """Every other address."""

    def prepare(self) -> None:
        raise tornado.web.HTTPError(404)
