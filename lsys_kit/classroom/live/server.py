"""The server of a class, on the teacher's laptop: phones join, vote, predict and play; the board shows what the class thinks.

What a phone says is kept before the phone hears so. Whatever needs Python is done by worker processes. What is sent is bounded
in size and in rate, for each phone and for all. The board's rights need its secret.
"""

from __future__ import annotations

import asyncio
import socket
from contextlib import suppress

import tornado.httpserver
import tornado.netutil

from lsys_kit.classroom.live import limits
from lsys_kit.classroom.live.classes import Classes
from lsys_kit.classroom.live.events import LETTERS
from lsys_kit.classroom.live.handlers import (
    Application,
    AskHandler,
    BoardHandler,
    CourseHandler,
    DoorHandler,
    NothingHandler,
    PhoneHandler,
    PlantHandler,
    QuestionHandler,
)
from lsys_kit.classroom.live.limits import MOST_ASKED, MOST_MESSAGE
from lsys_kit.classroom.live.sockets import BoardSocket, PhoneSocket
from lsys_kit.errors import ModelFileError

PORT = 8765
PING, PATIENCE = 20, 15
"""After how many seconds a phone is asked whether it is there, and after how many more without an answer it is given up."""


class ClassServer(Classes):
    """Several classes on one port."""

    _tasks: tuple[asyncio.Task[None], ...] = ()
    _server: tornado.httpserver.HTTPServer | None = None

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
            idle_connection_timeout=limits.PATIENCE,
            body_timeout=limits.PATIENCE,
        )
        self._server.add_sockets(sockets)
        found = int(sockets[0].getsockname()[1])
        self._tasks = tuple(asyncio.get_running_loop().create_task(each) for each in (self.get_ready(), self.follow()))
        self.bring_course()
        self.address = (address or f"http://{host or own_address()}:{found}").rstrip("/")
        return found

    async def close(self) -> None:
        """Stop to listen, and end all workers."""
        for task in self._tasks:
            task.cancel()
        if self._server is not None:
            self._server.stop()
            with suppress(TimeoutError):
                await asyncio.wait_for(self._server.close_all_connections(), 3)
        await super().close()


def own_address() -> str:
    """The address of this machine in its network; no packet is sent."""
    with socket.socket(socket.AF_INET, socket.SOCK_DGRAM) as probe:
        try:
            probe.connect(("10.255.255.255", 9))
            return str(probe.getsockname()[0])
        except OSError:
            return "127.0.0.1"


def _application(server: ClassServer) -> Application:
    code = rf"([{LETTERS}{LETTERS.lower()}]{{4}})"
    key = r"([\w-]{8,64})"
    return Application(
        server,
        [
            (r"/", DoorHandler),
            (rf"/{code}/?", PhoneHandler),
            (rf"/{code}/course/([\w/.-]{{1,200}})", CourseHandler),
            (r"/asked/([a-z]{4,12})/([\w.:-]{1,60})", QuestionHandler),
            (rf"/{code}/ask", AskHandler),
            (rf"/{code}/live", PhoneSocket),
            (rf"/board/{key}/?", BoardHandler),
            (rf"/board/{key}/live", BoardSocket),
            (rf"/board/{key}/plants/(\d{{1,6}})", PlantHandler),
        ],
        default_handler_class=NothingHandler,
        websocket_max_message_size=MOST_MESSAGE,
        websocket_ping_interval=PING,
        websocket_ping_timeout=PATIENCE,
        compress_response=False,
    )
