"""A real server of a class for tests: in a thread of this process, or in a process of its own that can be killed."""

from __future__ import annotations

import asyncio
import json
import os
import re
import signal
import socket
import subprocess
import sys
import threading
import time
from collections.abc import Awaitable, Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from tornado.websocket import WebSocketClientConnection, websocket_connect

from lsys_kit.classroom.live.course_pages import PAGES, CoursePages, mark_made
from lsys_kit.classroom.live.live_class import LiveClass
from lsys_kit.classroom.live.server import ClassServer

SECONDS = 60
"""How long anything may take on a busy machine."""


@dataclass
class Running:
    """A server in a thread."""

    server: ClassServer
    loop: asyncio.AbstractEventLoop

    @property
    def room(self) -> LiveClass:
        """Its first class."""
        return next(iter(self.server.classes.values()))

    @property
    def code(self) -> str:
        return self.room.entry.code

    @property
    def join(self) -> str:
        return self.server.join_address(self.code)

    @property
    def board(self) -> str:
        return self.server.board_address(self.code)

    def do(self, **content: Any) -> None:
        """What the teacher does, as the board says it."""
        asyncio.run_coroutine_threadsafe(self.room.does(content), self.loop).result(SECONDS)


def made_pages(folder: Path, pages: Mapping[str, bytes]) -> CoursePages:
    """Pages of the course that were made before."""
    for name, content in pages.items():
        (folder / PAGES / name).parent.mkdir(parents=True, exist_ok=True)
        (folder / PAGES / name).write_bytes(content)
    mark_made(folder / PAGES)
    return CoursePages(folder)


@contextmanager
def running(
    folder: Path, course: CoursePages | None = None, names: tuple[str, ...] = ("10b",), workers: int = 2
) -> Iterator[Running]:
    """A server in a thread of this process."""
    ready, found = threading.Event(), {}

    async def serve() -> None:
        server, end = ClassServer(folder, list(names), course, workers), asyncio.Event()
        server.listen(0, "127.0.0.1")
        found.update(running=Running(server, asyncio.get_running_loop()), end=end)
        ready.set()
        await end.wait()
        await server.close()

    thread = threading.Thread(target=lambda: asyncio.run(serve()), daemon=True)
    thread.start()
    assert ready.wait(SECONDS)
    try:
        yield found["running"]
    finally:
        found["running"].loop.call_soon_threadsafe(found["end"].set)
        thread.join(SECONDS)


@dataclass
class Process:
    """A server in a process of its own, as `lsys-kit class` starts it."""

    process: subprocess.Popen[str]
    folder: Path
    join: str
    board: str
    code: str

    def kill(self) -> None:
        """End it as a power cut would."""
        os.killpg(self.process.pid, signal.SIGKILL)
        self.process.wait(SECONDS)


def started(folder: Path, port: int = 0, course: bool | Path = False) -> Process:
    """A server, by default without the pages of the course, or with those of one in a folder, in a process group of its own."""
    command = [
        sys.executable,
        "-m",
        "lsys_kit",
        "class",
        "--folder",
        str(folder),
        "--port",
        str(port),
        *(["--course", str(course)] if isinstance(course, Path) else [] if course else ["--no-course"]),
    ]
    process = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    said = []
    assert process.stdout
    for line in process.stdout:
        said.append(line)
        if line.startswith("Ctrl+C"):
            break
    text = "".join(said)
    code, join = re.search(r"code ([A-Z]{4}) at (\S+)", text).groups()
    board = re.search(r"alone: (\S+)", text)[1]
    return Process(process, folder, re.sub(r"//[^:/]+", "//127.0.0.1", join), re.sub(r"//[^:/]+", "//127.0.0.1", board), code)


class Network:
    """A network between phones and a server, which can be cut off without a word to anybody."""

    def __init__(self, port: int) -> None:
        self._port, self._ready = port, threading.Event()
        self._thread = threading.Thread(target=lambda: asyncio.run(self._serve()), daemon=True)
        self._thread.start()
        assert self._ready.wait(SECONDS)

    async def _serve(self) -> None:
        self._loop, self._end, self._there = asyncio.get_running_loop(), asyncio.Event(), asyncio.Event()
        self._there.set()
        server = await asyncio.start_server(self._pass_on, "127.0.0.1", 0)
        self.port = server.sockets[0].getsockname()[1]
        self._ready.set()
        await self._end.wait()

    async def _pass_on(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        await self._there.wait()
        with suppress(OSError):
            others = await asyncio.open_connection("127.0.0.1", self._port)
            await asyncio.gather(self._pump(reader, others[1]), self._pump(others[0], writer))

    async def _pump(self, reader: asyncio.StreamReader, writer: asyncio.StreamWriter) -> None:
        with suppress(OSError):
            while data := await reader.read(65_536):
                await self._there.wait()
                writer.write(data)
                await writer.drain()
        writer.close()

    def is_there(self, there: bool) -> None:
        """Cut it off, or let it be there again."""
        self._loop.call_soon_threadsafe(self._there.set if there else self._there.clear)

    def close(self) -> None:
        self._loop.call_soon_threadsafe(self._end.set)
        self._thread.join(SECONDS)


class Phone:
    """A phone: it sends again what was not acknowledged, as the page does."""

    def __init__(self, join: str, number: int) -> None:
        self.address = f"{join.replace('http', 'ws', 1)}live?phone={number:032x}"
        self.number, self.sent = number, 0
        self.waiting: dict[int, dict[str, Any]] = {}
        self.answers: list[dict[str, Any]] = []
        self.state: dict[str, Any] = {}
        self.socket: WebSocketClientConnection | None = None

    async def connect(self) -> None:
        self.socket = await websocket_connect(self.address)
        for message in [*self.waiting.values()]:
            await self.socket.write_message(json.dumps(message))

    async def connected(self) -> None:
        """Connect, however long it takes."""
        while True:
            try:
                return await self.connect()
            except Exception:
                await asyncio.sleep(0.05)

    async def say(self, kind: str, about: str, round: int, value: Any, **more: Any) -> int:
        self.sent += 1
        self.waiting[self.sent] = {"sent": self.sent, "kind": kind, "about": about, "round": round, "value": value, **more}
        if self.socket is not None:
            await self.socket.write_message(json.dumps(self.waiting[self.sent]))
        return self.sent

    async def hear(self) -> dict[str, Any] | None:
        """The next that it is told; None where the server is gone."""
        assert self.socket is not None
        text = await self.socket.read_message()
        if text is None:
            self.socket = None
            return None
        found: dict[str, Any] = json.loads(text)
        self.state = found.get("state", self.state)
        self.waiting.pop(found.get("kept", found.get("refused", 0)), None)
        self.answers.append(found)
        return found

    async def told(self, wanted: Callable[[dict[str, Any]], object]) -> dict[str, Any]:
        """Hear until it is told something."""
        while True:
            found = await asyncio.wait_for(self.hear(), SECONDS)
            assert found is not None, "the server is gone"
            if wanted(found):
                return found

    async def keeps(self, kind: str, about: str, round: int, value: Any, **more: Any) -> dict[str, Any]:
        """Say something, and hear what becomes of it."""
        number = await self.say(kind, about, round, value, **more)
        return await self.told(lambda each: number in (each.get("kept"), each.get("refused"), each.get("later")))


def wait_for(wanted: Callable[[], object]) -> None:
    """Wait until something is so."""
    end = time.monotonic() + SECONDS
    while not wanted():
        assert time.monotonic() < end
        time.sleep(0.02)


def is_dropped(raw: socket.socket, bytewise: bytes) -> bool:
    """Whether somebody is dropped who sends some bytes one by one, again and again."""
    end, number = time.monotonic() + SECONDS / 2, 0
    raw.settimeout(0.05)
    while time.monotonic() < end:
        try:
            raw.sendall(bytewise[number % len(bytewise) :][:1])
            number += 1
            if not raw.recv(4096):
                return True
        except TimeoutError:
            continue
        except OSError:
            return True
    return False


def flooded(raw: socket.socket, frame: bytes) -> None:
    """Send a frame again and again, and read nothing, until that is not possible any more."""
    with suppress(OSError):
        while True:
            raw.sendall(frame * 1000)


def run(work: Awaitable[Any]) -> Any:
    """What comes of some asynchronous work."""

    async def limited() -> Any:
        return await asyncio.wait_for(work, 4 * SECONDS)

    return asyncio.run(limited())
