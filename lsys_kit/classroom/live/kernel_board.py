"""The server of a class that was opened in a notebook: a child process of the kernel, which is one of its boards, by a pipe.

It ends with the kernel, however that ends, and not with a cell that is interrupted.
"""

from __future__ import annotations

import asyncio
import base64
import json
import os
import signal
from collections.abc import Callable, Mapping
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from pathlib import Path
from threading import Thread

from lsys_kit.classroom.exercises.notebooks import renew_exercises
from lsys_kit.classroom.live.audience import Audience
from lsys_kit.classroom.live.course_pages import CoursePages
from lsys_kit.classroom.live.live_class import LiveClass
from lsys_kit.classroom.live.pages import board_data
from lsys_kit.classroom.live.questions import about_prediction
from lsys_kit.classroom.live.server import PORT, ClassServer
from lsys_kit.classroom.live.serving import mistake_told
from lsys_kit.classroom.places import IN_LANGUAGE, choose_course
from lsys_kit.errors import LSystemError, ModelFileError, ModelNameError
from lsys_kit.translation import VARIABLE, language


def serve_kernel(pipe: Connection, folder: str, name: str, port: int | None, course: bool | str, spoken: str) -> None:
    """Open a class in this process, and tell a kernel of it, until the kernel wants no more or is gone."""
    signal.signal(signal.SIGINT, signal.SIG_IGN)
    os.environ[VARIABLE] = language(spoken)

    def tell(told: Mapping[str, object]) -> None:
        pipe.send_bytes(json.dumps(told).encode())

    kernel = _Kernel(pipe)
    try:
        pages = CoursePages(folder, _chosen(course, spoken)) if course else None
        asyncio.run(_serve(kernel, ClassServer(folder, [name], pages), port, tell))
    except LSystemError as fault:
        tell(mistake_told(fault))
    os._exit(0)  # all is kept; workers that are still beginning are not waited for


def _chosen(course: bool | str, spoken: str) -> Path | None:
    """The folder of a course of one's own, whose lessons and exercises are known from now on, in the language in which it was
    opened or that is spoken; none where it is the kit's."""
    folder = Path(course) if isinstance(course, str) else None
    renew_exercises(choose_course(folder, os.environ.get(IN_LANGUAGE) or spoken))
    return folder


class _Kernel:
    """What comes from the kernel, which a thread waits for; a kernel that is gone while nothing is served ends this process."""

    def __init__(self, pipe: Connection) -> None:
        self.pipe = pipe
        self.heard: Callable[[dict[str, object]], object] = lambda _: os._exit(0)
        Thread(target=self._listen, daemon=True).start()

    def _listen(self) -> None:
        try:
            while True:
                content = json.loads(self.pipe.recv_bytes())
                self.heard(content)
        except (EOFError, OSError):
            self.heard({"end": True})


async def _serve(kernel: _Kernel, server: ClassServer, port: int | None, tell: Callable[[Mapping[str, object]], None]) -> None:
    end, loop = asyncio.Event(), asyncio.get_running_loop()
    try:
        _listen_at(server, port)
        [room] = server.classes.values()
        board = _KernelBoard(kernel.pipe, server, room, end)
        kernel.heard = lambda content: loop.call_soon_threadsafe(board.hear, content)
        room.boards.add(board)
        join, code = server.join_address(room.entry.code), room.entry.code
        tell({"about": {"name": room.entry.name, "board": server.board_address(code), **board_data(room.entry, join)}})
        board.show(room.board_state())
        await end.wait()
    finally:
        kernel.heard = lambda _: None
        await server.close()


def _listen_at(server: ClassServer, port: int | None) -> None:
    """Listen at a port; where none is wanted, at the usual one, or at another if that is taken."""
    try:
        server.listen(PORT if port is None else port)
    except ModelFileError:
        if port is not None:
            raise
        server.listen(0)


class _KernelBoard(Audience):
    """The kernel, as a board."""

    def __init__(self, pipe: Connection, server: ClassServer, room: LiveClass, end: asyncio.Event) -> None:
        super().__init__()
        self._pipe, self._server, self._room, self._end, self._sender = pipe, server, room, end, ThreadPoolExecutor(1)
        self._tasks: set[asyncio.Task[None]] = set()

    async def send_text(self, text: str) -> None:
        await asyncio.get_running_loop().run_in_executor(self._sender, self._pipe.send_bytes, text.encode())

    def drop(self) -> None:
        self._messages.clear()

    def hear(self, content: Mapping[str, object]) -> None:
        """Do what comes from the kernel."""
        if "end" in content:
            self._end.set()
            return
        if content.get("kind") == "prediction" and "asked" in content:
            content = {**content, "about": about_prediction(str(content["asked"]))}
            if content["about"] is None:
                return
        work = self._bring(content["want"]) if "want" in content else self._room.told_by(self, content)
        task = asyncio.get_running_loop().create_task(work)
        self._tasks.add(task)
        task.add_done_callback(self._tasks.discard)

    async def _bring(self, wanted: object) -> None:
        """Tell what a question asks, or show a plant."""
        content: object = None
        try:
            match wanted:
                case ["plant", int(number)] if number in self._room.session.plants:
                    picture = self._room.session.plants[number]["picture"]
                    content = f"data:image/svg+xml;base64,{base64.b64encode(picture.encode()).decode()}"
                case ["question", str(kind), str(about)]:
                    content = json.loads((await self._server.what_is_asked(kind, about)).plain)
        except ModelNameError:
            pass
        except LSystemError:
            await asyncio.sleep(1)  # it is asked again
        self.say({"wanted": wanted, "content": content})
