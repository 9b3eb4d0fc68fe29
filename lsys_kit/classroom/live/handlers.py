"""What is asked of a server of classes over HTTP. Pages are in memory: no path leads to a file."""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from typing import Any
from urllib.parse import urlsplit

import tornado.web

from lsys_kit.classroom.live import pages
from lsys_kit.classroom.live.classes import Classes
from lsys_kit.classroom.live.events import NotKept
from lsys_kit.classroom.live.live_class import LiveClass, mistake
from lsys_kit.classroom.live.pages import Page
from lsys_kit.classroom.live.questions import questions
from lsys_kit.classroom.live.workers import Busy
from lsys_kit.errors import LSystemError

PHONE = re.compile(r"[0-9a-f]{32}")
"""What a phone calls itself."""
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


class Application(tornado.web.Application):
    """The addresses of a server."""

    def __init__(self, server: Classes, handlers: list[Any], **settings: Any) -> None:
        super().__init__(handlers, **settings)
        self.class_server = server

    def log_request(self, handler: tornado.web.RequestHandler) -> None:
        """Nothing is written down of who has asked for what."""


class OfTheClasses(tornado.web.RequestHandler):
    """What requests and sockets share: the server of the class, and the headers of all that it sends."""

    application: Application

    @property
    def server(self) -> Classes:
        return self.application.class_server

    def set_default_headers(self) -> None:
        for name, value in SECURE.items():
            self.set_header(name, value)


class _Handler(OfTheClasses):
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
        self.send(Page(pages.problem_page(status_code).encode()), "text/html; charset=utf-8")

    def send(self, page: Page, kind: str) -> None:
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


class DoorHandler(_Handler):
    """The page on which a code is typed."""

    def get(self) -> None:
        self.send(Page(pages.door_page().encode()), "text/html; charset=utf-8")


class PhoneHandler(_Handler):
    """The page of a phone."""

    def get(self, code: str) -> None:
        room = self.room(code)
        if code != room.entry.code or not self.request.path.endswith("/"):
            self.redirect(f"/{room.entry.code}/")
        else:
            self.send(Page(pages.phone_page(room.entry, self.server.course is not None).encode()), "text/html; charset=utf-8")


class CourseHandler(_Handler):
    """A page of the course."""

    def get(self, code: str, name: str) -> None:
        room, course = self.room(code), self.server.course
        page = course.pages.get(name) if course else None
        if page is None and course and course.is_coming:
            self.set_status(503)
            if progress := course.progress:
                self.set_header("Pages-Made", "{made}/{many}".format(**progress))
            page = Page(pages.waiting_page(room.entry).encode())
        if page is None:
            raise tornado.web.HTTPError(404)
        self.send(page, "text/html; charset=utf-8")


class QuestionHandler(_Handler):
    """What a question asks, which a phone and the board need once."""

    async def get(self, kind: str, about: str) -> None:
        if (kind, about) not in questions():
            raise tornado.web.HTTPError(404)
        try:
            found = await self.server.what_is_asked(kind, about)
        except Busy:
            raise tornado.web.HTTPError(503) from None
        self.send(found, "application/json")


class AskHandler(_Handler):
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
        if not isinstance(phone, str) or not PHONE.fullmatch(phone):
            raise tornado.web.HTTPError(400)
        self.set_header("Content-Type", "application/json")
        if not self.server.asking.allow(phone):
            self.finish(mistake("You ask faster than can be answered", "Wait a moment."))
            return
        try:
            self.finish(await room.asks(phone, content))
        except (Busy, NotKept) as fault:
            self.finish(mistake(fault.message, fault.hint or ""))
        except LSystemError:
            raise tornado.web.HTTPError(400) from None


class BoardHandler(_Handler):
    """The board of a class."""

    def get(self, secret: str) -> None:
        room = self.board(secret)
        if not self.request.path.endswith("/"):
            self.redirect(f"/board/{room.entry.secret}/")
        else:
            page = pages.board_page(room.entry, self.server.join_address(room.entry.code))
            self.send(Page(page.encode()), "text/html; charset=utf-8")


class PlantHandler(_Handler):
    """A drawing of the wall, in which nothing runs."""

    def get(self, secret: str, number: str) -> None:
        room = self.board(secret)
        plant = room.session.plants.get(int(number))
        if plant is None:
            raise tornado.web.HTTPError(404)
        self.set_header("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'; img-src data:; sandbox")
        self.send(Page(plant["picture"].encode()), "image/svg+xml")


class NothingHandler(_Handler):
    """Every other address."""

    def prepare(self) -> None:
        raise tornado.web.HTTPError(404)
