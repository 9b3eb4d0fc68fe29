"""The classes of a server: they share a table, into which all that is said at the same time is written at once, and workers."""

from __future__ import annotations

import asyncio
import hmac
import json
import sqlite3
from collections import deque
from concurrent.futures import ThreadPoolExecutor
from contextlib import suppress
from pathlib import Path

from lsys_kit.classroom.live.course_pages import CoursePages
from lsys_kit.classroom.live.events import Event, Events, NotKept
from lsys_kit.classroom.live.limits import Rates
from lsys_kit.classroom.live.live_class import LiveClass
from lsys_kit.classroom.live.pages import Page
from lsys_kit.classroom.live.questions import VOTE, questions
from lsys_kit.classroom.live.workers import Busy, Workers

BETWEEN_LOOKS = 0.25
"""What other servers of the same table have kept is looked for again after so many seconds."""


class Classes:
    """Several classes, one table and one group of workers.

    Parameters
    ----------
    folder
        Where what the classes say is kept.
    names
        The names of the classes; those that are known already go on where they were.
    course
        The pages of the course; none where there is no course.
    workers
        How many worker processes there are.
    """

    def __init__(
        self, folder: str | Path, names: list[str], course: CoursePages | None = None, workers: int | None = None
    ) -> None:
        self.events = Events(folder)
        entries = [self.events.named(name) for name in names]
        self.workers = Workers(workers)
        self.rates, self.asking, self.joining, self.rejoining = Rates(20, 4), Rates(12, 3), Rates(400, 20), Rates(30, 2)
        self.course = course
        self.address = ""
        self._asked: dict[tuple[str, str], Page] = {}
        questions()  # they are read before anybody waits for them
        self._writer = ThreadPoolExecutor(1)
        self._pending: deque[tuple[Event, asyncio.Future[bool]]] = deque()
        self._writing = False
        self.sockets = 0
        self.classes = {entry.code: LiveClass(entry, self.keep, self.workers, self.rates, course) for entry in entries}
        for event in self.events.news():
            if event.code in self.classes:
                self.classes[event.code].session.take(event)

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

    async def follow(self) -> None:
        """Take in what other servers of the same table have kept."""
        while True:
            await asyncio.sleep(BETWEEN_LOOKS)
            with suppress(sqlite3.Error):  # it is looked for again
                self._take(await asyncio.get_running_loop().run_in_executor(self._writer, self.events.news))

    async def what_is_asked(self, kind: str, about: str) -> Page:
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
            self._asked[kind, about] = Page(content)
        return self._asked[kind, about]

    async def get_ready(self) -> None:
        """Have at hand what every vote asks, so that nobody waits for it in class."""
        for kind, about in questions():
            if kind == VOTE:
                with suppress(Busy):
                    await self.what_is_asked(kind, about)

    def bring_course(self) -> None:
        """Begin to bring the pages of the course; boards tell how many are there."""
        loop = asyncio.get_running_loop()

        def changed() -> None:
            with suppress(RuntimeError):  # all is closed
                loop.call_soon_threadsafe(self._tell_boards)

        if self.course is not None:
            self.course.begin(changed)

    def _tell_boards(self) -> None:
        for room in self.classes.values():
            room.behind("")

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
        """End all workers, and close the table."""
        if self.course is not None:
            await asyncio.get_running_loop().run_in_executor(None, self.course.close)
        self.workers.close()
        self._writer.shutdown()
        self.events.close()
