"""What goes wrong in a class, with real parts: slow and silent phones, full disks, several servers, and too many questions."""

from __future__ import annotations

import asyncio
import json
import resource
import socket
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Event
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest
from tornado.websocket import websocket_connect

from lsys_kit.classroom.live import limits, workers
from lsys_kit.classroom.live.events import FILE, Events
from lsys_kit.classroom.live.session import Asked, Session
from tests.classroom.live_class import SECONDS, Phone, Process, Running, flooded, is_dropped, run, running, started, wait_for

VOTE = Asked("vote", "01", 1)


def place_of(live: Running) -> tuple[str, int]:
    host, port = live.server.address.removeprefix("http://").split(":")
    return host, int(port)


def joined(live: Running, number: int, receives: int = 0) -> socket.socket:
    """A phone as a bare socket."""
    host, port = place_of(live)
    raw = socket.socket()
    if receives:
        raw.setsockopt(socket.SOL_SOCKET, socket.SO_RCVBUF, receives)
    raw.settimeout(SECONDS)
    raw.connect((host, port))
    head = f"GET /{live.code}/live?phone={number:032x} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
    key = "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n"
    raw.sendall(f"{head}Connection: Upgrade\r\n{key}\r\n".encode())
    return raw


@pytest.mark.slow
@pytest.mark.parametrize(
    "begin",
    [
        "GET / HTTP/1.1\r\nHost: x\r\nX-Slow: ",
        "POST /{code}/ask HTTP/1.1\r\nHost: x\r\nContent-Type: application/json\r\nContent-Length: 5000\r\n\r\n",
    ],
    ids=["head", "body"],
)
def test_what_comes_byte_by_byte_is_not_waited_for(tmp_path: Path, begin: str, monkeypatch: pytest.MonkeyPatch) -> None:
    """Slow loris: whoever has not said all in time is dropped, though something comes all the time."""
    monkeypatch.setattr(limits, "PATIENCE", 1.0)
    with running(tmp_path) as live, socket.create_connection(place_of(live), SECONDS) as raw:
        raw.sendall(begin.format(code=live.code).encode())
        assert is_dropped(raw, b"abcdefgh")


@pytest.mark.slow
def test_a_phone_that_does_not_read_is_dropped_and_the_others_do_not_wait(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(limits, "PATIENCE", 1.0)
    frame = b"\x81\x82\0\0\0\0{}"

    async def beside_it(live: Running, silent: socket.socket) -> int:
        phone, heard = Phone(live.join, 1), 0
        await phone.connect()
        flood = asyncio.get_running_loop().run_in_executor(None, flooded, silent, frame)
        while not flood.done():
            heard += bool(await phone.keeps("vote", "01", 1, 1))
        return heard

    with running(tmp_path) as live:
        silent = joined(live, 2, receives=2048)
        assert run(beside_it(live, silent)) > 1
        silent.close()
        wait_for(lambda: f"{2:032x}" not in live.room.phones)


@pytest.mark.slow
@pytest.mark.skipif(not hasattr(resource, "prlimit"), reason="limits of another process are those of Linux")
def test_on_a_full_disk_nothing_is_acknowledged_and_afterwards_it_goes_on(tmp_path: Path) -> None:
    """The files of the server may grow no more; then they may."""
    process = started(tmp_path)
    log = tmp_path / f"{FILE}-wal"

    def may_grow(bytes: int) -> None:
        resource.prlimit(process.process.pid, resource.RLIMIT_FSIZE, (bytes, resource.RLIM_INFINITY))

    async def through_a_full_disk() -> None:
        phone = Phone(process.join, 9)
        await phone.connect()
        board = await websocket_connect(process.board.replace("http", "ws", 1) + "live")
        assert "kept" in await phone.keeps("vote", "01", 1, 1)
        may_grow(log.stat().st_size)
        assert "later" in await phone.keeps("vote", "01", 1, 2)
        await shows(board, "Nothing can be kept")
        await board.write_message(json.dumps({"do": "open", "kind": "vote", "about": "02", "round": 1}))
        assert "Nothing can be kept" in json.loads(await told(board, "mistake"))["mistake"]
        with urlopen(process.join, timeout=SECONDS) as page:
            assert page.status == 200
        may_grow(resource.RLIM_INFINITY)
        phone.sent -= 1
        assert "kept" in await phone.keeps("vote", "01", 1, 2)
        await shows(board, "")

    async def told(board: Any, name: str) -> Any:
        while True:
            text = await asyncio.wait_for(board.read_message(), SECONDS)
            if name in json.loads(text):
                return text

    async def shows(board: Any, fault: str) -> None:
        while True:
            state = json.loads(await told(board, "state"))["state"]
            if state["fault"].startswith(fault) and bool(state["fault"]) == bool(fault):
                return

    try:
        run(through_a_full_disk())
    finally:
        process.kill()
    events = Events(tmp_path)
    assert [event.value for event in events.of(process.code)] == [1, 2]
    events.close()


@pytest.mark.slow
def test_two_servers_of_one_table_are_one_class(tmp_path: Path) -> None:
    """Votes at either are counted once and shown by both boards; what one teacher opens the other's phones are asked."""
    servers = [started(tmp_path), started(tmp_path)]
    assert servers[0].code == servers[1].code

    async def both() -> None:
        phones = [Phone(servers[number % 2].join, number) for number in range(1, 11)]
        await asyncio.gather(*(each.connect() for each in phones))
        boards = [await websocket_connect(each.board.replace("http", "ws", 1) + "live") for each in servers]
        for content in ({"do": "open"}, {"do": "show"}):
            await asyncio.gather(
                *(each.write_message(json.dumps({**content, "kind": "vote", "about": "01", "round": 1})) for each in boards)
            )
        for each in phones:
            await each.told(lambda told: (told.get("state", {}).get("current") or {}).get("about") == "01")
        answers = await asyncio.gather(*(each.keeps("vote", "01", 1, each.number % 4) for each in phones))
        assert all("kept" in each for each in answers)
        moved = Phone(servers[0].join, 1)  # a phone that comes to the other server sends again what it had sent
        await moved.connect()
        assert "kept" in await moved.keeps("vote", "01", 1, 1)
        for board in boards:
            while True:
                state = json.loads(await asyncio.wait_for(board.read_message(), SECONDS)).get("state", {})
                if (state.get("current") or {}).get("bars") == [2, 3, 3, 2]:
                    break

    try:
        run(both())
    finally:
        for each in servers:
            each.kill()
    events = Events(tmp_path)
    said = [*events.of(servers[0].code)]
    events.close()
    assert len([each for each in said if each.phone]) == 10
    assert [each.kind for each in said if not each.phone].count("show") == 2
    assert len(Session(said).values(VOTE)) == 10


@pytest.mark.slow
def test_servers_that_begin_at_once_have_one_table_and_one_class(tmp_path: Path) -> None:
    async def all_at_once() -> list[Process]:
        loop = asyncio.get_running_loop()
        return [*await asyncio.gather(*(loop.run_in_executor(None, started, tmp_path) for _ in range(3)))]

    servers = run(all_at_once())
    for each in servers:
        each.kill()
    assert len({(each.code, each.board.split("/board/")[1]) for each in servers}) == 1


@pytest.mark.slow
def test_what_a_question_asks_is_refused_for_a_while_where_too_much_is_asked(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Its page asks again; a fault of the server it is not, and it is not kept in place of the question."""
    with running(tmp_path) as live:
        place = f"{live.server.address}/asked/prediction/01:1"
        monkeypatch.setattr(workers, "MOST_IN_ALL", 0)
        with pytest.raises(HTTPError, match="503"):
            urlopen(place, timeout=SECONDS)
        monkeypatch.undo()
        monkeypatch.setattr(workers, "LONGEST", 0.0)
        with pytest.raises(HTTPError, match="503"):
            urlopen(place, timeout=SECONDS)
        monkeypatch.undo()
        with urlopen(place, timeout=SECONDS) as answer:
            assert "question" in json.loads(answer.read())


def test_a_worker_that_two_threads_end_is_ended_once(monkeypatch: pytest.MonkeyPatch) -> None:
    worker, closed = workers._Worker(), list[int]()
    connection: Any = worker.connection
    close = connection._close

    def slowly() -> None:
        closed.append(worker.connection.fileno())
        Event().wait(0.05)
        close()

    monkeypatch.setattr(connection, "_close", slowly)
    with ThreadPoolExecutor(8) as pool:
        assert not any(each.exception() for each in [pool.submit(worker.end) for _ in range(8)])
    assert len(closed) == 1
    assert not worker.process.is_alive()
