"""The server of a class, with real sockets and a real table: everybody is counted once, nobody is let in who should not be."""

from __future__ import annotations

import asyncio
import json
import random
import socket
import time
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import Request, urlopen

import pytest
from tornado.httpclient import HTTPClientError, HTTPRequest
from tornado.websocket import WebSocketClientConnection, websocket_connect

from lsys_kit import practice
from lsys_kit.classroom.live.events import Events, NotKept
from lsys_kit.classroom.live.limits import Rates
from lsys_kit.classroom.live.report import report_table
from lsys_kit.classroom.live.session import MOST_OF_A_PHONE, Asked, Session
from tests.classroom.live_class import SECONDS, Phone, Running, made_pages, run, running, started, wait_for

PAGES = {"index.html": b"<!doctype html><title>Course</title>"}
VOTE = Asked("vote", "01", 1)


@pytest.fixture(scope="module")
def live(tmp_path_factory: pytest.TempPathFactory) -> Iterator[Running]:
    folder = tmp_path_factory.mktemp("class")
    with running(folder, made_pages(folder, PAGES)) as found:
        wait_for(lambda: not found.server.course.is_coming)
        yield found


@pytest.fixture
def fresh(tmp_path: Path) -> Iterator[Running]:
    with running(tmp_path) as found:
        yield found


def got(address: str, **headers: str) -> tuple[int, Any, bytes]:
    try:
        with urlopen(Request(address, headers=headers), timeout=SECONDS) as answer:
            return answer.status, answer.headers, answer.read()
    except HTTPError as refused:
        return refused.code, refused.headers, refused.read()


def asked(live: Running, content: object, **headers: str) -> Any:
    body = content if isinstance(content, bytes) else json.dumps(content).encode()
    request = Request(f"{live.join}ask", body, {"Content-Type": "application/json", **headers})
    try:
        with urlopen(request, timeout=SECONDS) as answer:
            return json.loads(answer.read())
    except HTTPError as refused:
        return refused.code


async def socket_to(address: str | HTTPRequest) -> WebSocketClientConnection:
    return await websocket_connect(address)


# Joining and voting


def test_phones_vote_and_the_board_counts_them(fresh: Running) -> None:
    async def class_of_three() -> None:
        phones = [Phone(fresh.join, number) for number in range(1, 4)]
        for each in phones:
            await each.connect()
        board = await websocket_connect(fresh.board.replace("http", "ws", 1) + "live")
        await board.write_message(json.dumps({"do": "open", "kind": "vote", "about": "01", "round": 1}))
        for number, each in enumerate(phones):
            await each.told(lambda told: told.get("state", {}).get("current"))
            assert "kept" in await each.keeps("vote", "01", 1, number)
        assert "kept" in await phones[0].keeps("vote", "01", 1, 3)  # a mind may be changed
        await board.write_message(json.dumps({"do": "show", "kind": "vote", "about": "01", "round": 1}))
        while True:
            state = json.loads(await board.read_message())["state"]
            if (state["current"] or {}).get("bars") == [0, 1, 1, 1]:
                break
        assert state["present"] == 3
        await board.write_message(json.dumps({"do": "close", "kind": "vote", "about": "01", "round": 1}))
        await phones[0].told(lambda told: (told.get("state", {}).get("current") or {}).get("status") == "closed")
        assert (await phones[0].keeps("vote", "01", 1, 2))["why"] == "This question is closed."

    run(class_of_three())
    assert fresh.room.session.board(3)["current"]["bars"] == [0, 1, 1, 1]


def test_a_message_that_is_sent_again_counts_once(fresh: Running) -> None:
    async def nervous() -> None:
        phone = Phone(fresh.join, 7)
        for _ in range(3):
            await phone.connect()
            for _ in range(3):
                phone.sent = 0
                assert "kept" in await phone.keeps("vote", "01", 1, 2)
            phone.socket.close()

    run(nervous())
    assert fresh.room.session.values(VOTE) == {f"{7:032x}": 2}
    assert len([*fresh.server.events.of(fresh.code)]) == 1


@pytest.mark.slow
def test_a_server_that_is_killed_goes_on_where_it_was(tmp_path: Path) -> None:
    """A phone sends again what was not acknowledged; what was acknowledged is there."""
    kept: set[int] = set()

    async def through_a_crash() -> tuple[str, int]:
        first = started(tmp_path)
        port = int(first.join.split(":")[2].split("/")[0])
        phone = Phone(first.join, 5)
        await phone.connected()
        assert "kept" in await phone.keeps("prediction", "01:1", 1, "first")
        first.kill()
        while await phone.hear() is not None:
            pass
        await phone.say("prediction", "01:1", 1, "third")
        second = started(tmp_path, port)
        try:
            assert (second.code, second.board.split("/board/")[1]) == (first.code, first.board.split("/board/")[1])
            await phone.connected()
            while phone.waiting:
                found = await phone.hear()
                kept.add(found.get("kept", 0))
        finally:
            second.kill()
        return first.code, phone.sent

    code, sent = run(through_a_crash())
    events = Events(tmp_path)
    assert Session(events.of(code)).values(Asked("prediction", "01:1", 1)) == {f"{5:032x}": "third"}
    assert sent in kept
    events.close()


def test_a_full_disk_is_told_and_nothing_is_acknowledged_that_is_not_kept(
    fresh: Running, monkeypatch: pytest.MonkeyPatch
) -> None:
    keep = fresh.server.events.keep

    def full(_: object) -> list[bool]:
        raise NotKept("Nothing can be kept: database or disk is full")

    async def on_a_full_disk() -> None:
        phone = Phone(fresh.join, 9)
        await phone.connect()
        monkeypatch.setattr(fresh.server.events, "keep", full)
        assert "later" in await phone.keeps("vote", "01", 1, 2)
        assert "full" in json.loads(fresh.room.board_state())["state"]["fault"]
        assert fresh.room.session.values(VOTE) == {}
        monkeypatch.setattr(fresh.server.events, "keep", keep)
        phone.sent = 0
        assert "kept" in await phone.keeps("vote", "01", 1, 2)
        assert not json.loads(fresh.room.board_state())["state"]["fault"]

    run(on_a_full_disk())


@pytest.mark.slow
def test_two_boards_show_the_same(fresh: Running) -> None:
    async def both() -> None:
        boards = [await websocket_connect(fresh.board.replace("http", "ws", 1) + "live") for _ in range(2)]
        await boards[0].write_message(json.dumps({"do": "begin", "what": "K16"}))
        states = []
        for board in boards:
            while True:
                state = json.loads(await board.read_message())["state"]
                if state["current"]:
                    break
            states.append(state)
        assert states[0] == states[1]
        assert states[0]["current"]["before"] == ["s", "a", "a", "a", "a"]

    run(both())


def test_a_clock_that_jumps_changes_nothing(fresh: Running, monkeypatch: pytest.MonkeyPatch) -> None:
    async def through_time() -> None:
        phone = Phone(fresh.join, 3)
        await phone.connect()
        for days, choice in ((0, 1), (-400, 2), (400, 0)):
            monkeypatch.setattr(time, "time", lambda days=days: 1.8e9 + 86_400 * days)
            assert "kept" in await phone.keeps("vote", "01", 1, choice)

    run(through_time())
    assert fresh.room.session.values(VOTE) == {f"{3:032x}": 0}


# Who is let in


def test_every_page_forbids_what_it_does_not_need(live: Running) -> None:
    for address in (live.server.address + "/", live.join, live.board, f"{live.join}course/index.html", f"{live.join}nothing"):
        _, headers, page = got(address)
        assert headers["X-Content-Type-Options"] == "nosniff"
        assert headers["Referrer-Policy"] == "no-referrer"
        assert "frame-ancestors 'none'" in headers["Content-Security-Policy"]
        assert b"://" not in page.partition(b"<script")[0]
    for address in (live.join, live.board):
        page = got(address)[2]
        assert b"default-src 'none'; script-src 'sha256-" in page
        assert b"connect-src 'self'" in page


@pytest.mark.parametrize(
    "path",
    [
        "course/../../../../etc/passwd",
        "course/..%2f..%2fpyproject.toml",
        "course/%2e%2e/class.sqlite3",
        "course//etc/passwd",
        "course/index.html%00",
        "course/",
        "class.sqlite3",
        "../class.sqlite3",
    ],
)
def test_no_path_leads_to_a_file(live: Running, path: str) -> None:
    host, port = live.server.address.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), SECONDS) as raw:
        raw.sendall(f"GET /{live.code}/{path} HTTP/1.1\r\nHost: {host}\r\nConnection: close\r\n\r\n".encode())
        answer = b"".join(iter(lambda: raw.recv(65_536), b""))
    assert answer.split()[1] in (b"404", b"400")
    assert b"root:" not in answer
    assert b"SQLite" not in answer


def test_the_board_needs_its_secret(live: Running) -> None:
    assert got(live.board)[0] == 200
    secret = live.room.entry.secret
    for wrong in (secret[:-1], secret + "a", secret.swapcase(), "a" * len(secret), live.code):
        assert got(f"{live.server.address}/board/{wrong}/")[0] == 404
        with pytest.raises(HTTPClientError):
            run(socket_to(f"{live.server.address.replace('http', 'ws', 1)}/board/{wrong}/live"))
    assert secret.encode() not in got(live.join)[2]


def test_a_phone_cannot_do_what_the_teacher_does(live: Running) -> None:
    async def pretends() -> None:
        phone = Phone(live.join, 66)
        await phone.connect()
        for message in (
            {"do": "open", "kind": "vote", "about": "02", "round": 1},
            {"sent": 1, "kind": "open", "about": "", "round": 1, "value": 1},
        ):
            await phone.socket.write_message(json.dumps(message))
            assert "refused" in await phone.told(lambda each: "refused" in each)

    run(pretends())
    assert live.room.session.current is None


def test_another_site_can_neither_connect_nor_ask(live: Running) -> None:
    for origin in ("http://evil.example", "null", live.server.address + ".evil.example"):
        request = HTTPRequest(f"{live.join.replace('http', 'ws', 1)}live?phone={'a' * 32}", headers={"Origin": origin})
        with pytest.raises(HTTPClientError, match="403"):
            run(socket_to(request))
        assert asked(live, {"phone": "a" * 32, "kind": "check", "id": "1.1", "answer": "x"}, Origin=origin) == 403


@pytest.mark.parametrize(
    "text",
    [b"", b"{}", b"[1]", b"\xff\xfe", b"null", b'{"phone": "x"}', b'{"phone": 1}', b"[" * 50_000],
    ids=lambda each: ascii(each[:12]),
)
def test_a_question_that_no_page_asks_is_refused(live: Running, text: bytes) -> None:
    assert asked(live, text) in (400, 413)


HOSTILE_FRAMES = [
    "",
    "{",
    "[]",
    "[" * 15_000,
    '{"sent": 1e999, "kind": "vote"}',
    '{"sent": -1}',
    '{"sent": 1}',
    '{"sent": true, "kind": "vote", "about": "01", "round": 1, "value": 1}',
    '{"sent": 1, "kind": "vote", "about": "01", "round": 3, "value": 1}',
    '{"sent": 1, "kind": "vote", "about": "99", "round": 1, "value": 1}',
    '{"sent": 1, "kind": "vote", "about": {"a": 1}, "round": 1, "value": 1}',
    '{"sent": 1, "kind": "exercise", "about": "1.1", "round": 1, "value": {"said": "Correct"}}',
    '{"sent": 1, "kind": "plant", "about": "", "round": 1, "value": {"picture": "<svg onload=alert(1)>"}}',
    '{"sent": 1, "kind": "game", "about": "1", "round": 1, "value": {"0": 0}}',
    '{"sent": 1, "kind": "table", "about": "01:counts", "round": 1, "value": [1, 2]}',
    '{"sent": 1, "kind": "prediction", "about": "01", "asked": "?", "round": 1, "value": "x"}',
    '{"sent": 9007199254740993, "kind": "vote", "about": "01", "round": 1, "value": 1}',
]


def test_a_hostile_frame_changes_nothing_and_disturbs_nobody(live: Running) -> None:
    before = [*live.server.events.of(live.code)]

    async def send_all() -> None:
        hostile, other = Phone(live.join, 13), Phone(live.join, 14)
        await hostile.connect()
        await other.connect()
        for frame in HOSTILE_FRAMES:
            await hostile.socket.write_message(frame)
            assert "refused" in await hostile.told(lambda each: "refused" in each)
        await hostile.socket.write_message(b"\x00\xff", binary=True)
        await hostile.told(lambda each: "refused" in each)
        await hostile.socket.write_message("x" * 40_000)
        while await hostile.hear() is not None:  # too large: the server hangs up
            pass
        assert "kept" in await other.keeps("vote", "02", 1, 1)

    run(send_all())
    assert len([*live.server.events.of(live.code)]) == len(before) + 1


def test_a_message_of_a_gigabyte_is_not_read(live: Running) -> None:
    host, port = live.server.address.removeprefix("http://").split(":")
    with socket.create_connection((host, int(port)), SECONDS) as raw:
        head = f"GET /{live.code}/live?phone={'b' * 32} HTTP/1.1\r\nHost: {host}:{port}\r\nUpgrade: websocket\r\n"
        head += "Connection: Upgrade\r\n"
        raw.sendall((head + "Sec-WebSocket-Key: dGhlIHNhbXBsZSBub25jZQ==\r\nSec-WebSocket-Version: 13\r\n\r\n").encode())
        assert b"101" in raw.recv(4096)
        raw.sendall(b"\x81\xff" + (2**30).to_bytes(8, "big") + b"\0\0\0\0")
        sent = 0
        try:
            while sent < 2**26:
                sent += raw.send(b"x" * 65_536)
        except OSError:
            pass
        assert sent < 2**26, "the server hangs up"
    assert asked(live, b"x" * 200_000) in (400, 413)


def test_one_phone_cannot_flood_a_class(fresh: Running) -> None:
    async def flood() -> None:
        phone = Phone(fresh.join, 21)
        await phone.connect()
        for number in range(200):
            await phone.say("prediction", "01:1", 1, f"spam {number}")
        later = 0
        for _ in range(200):
            later += "later" in await phone.told(lambda each: "kept" in each or "later" in each)
        assert later > 120

    run(flood())


@pytest.mark.slow
def test_ten_thousand_joins_from_one_phone_are_one_phone(fresh: Running, pytestconfig: pytest.Config) -> None:
    """It is counted once, has few sockets, and the others vote meanwhile; a quick check tries three hundred."""
    joins = 10_000 if pytestconfig.getoption("--thorough") else 300
    fresh.server.joining = Rates(50, 0.001)

    async def join_again() -> int:
        refused = 0
        other = Phone(fresh.join, 1)
        await other.connect()
        for number in range(joins):
            try:
                socket = await websocket_connect(f"{fresh.join.replace('http', 'ws', 1)}live?phone={2:032x}")
                if number % 3:
                    socket.close()
            except HTTPClientError:
                refused += 1
        assert refused > joins // 2, "a phone that comes again too fast is refused"
        assert "kept" in await other.keeps("vote", "01", 1, 1)
        assert len(fresh.room.phones.get(f"{2:032x}", ())) <= 4
        strangers = 0
        for number in range(3, 99):
            try:
                (await websocket_connect(f"{fresh.join.replace('http', 'ws', 1)}live?phone={number:032x}")).close()
            except HTTPClientError:
                strangers += 1
        return strangers

    assert run(join_again()) > 40, "strangers that come too fast are refused"


@pytest.mark.slow
def test_heads_that_never_end_keep_nobody_waiting(fresh: Running) -> None:
    """Slow loris."""
    host, port = fresh.server.address.removeprefix("http://").split(":")
    slow = [socket.create_connection((host, int(port)), SECONDS) for _ in range(200)]
    for each in slow:
        each.sendall(b"GET / HTTP/1.1\r\nHost: x\r\nX-Slow: ")
    assert got(fresh.join)[0] == 200
    for each in slow:
        each.close()


@pytest.mark.slow
def test_several_classes_know_nothing_of_each_other(tmp_path: Path) -> None:
    with running(tmp_path, names=("10a", "10b")) as found:
        first, second = found.server.classes.values()

        async def vote_in_the_first() -> None:
            phone = Phone(found.server.join_address(first.entry.code), 1)
            await phone.connect()
            assert "kept" in await phone.keeps("vote", "01", 1, 1)

        run(vote_in_the_first())
        assert (len(first.session.values(VOTE)), len(second.session.values(VOTE))) == (1, 0)
        assert first.entry.secret != second.entry.secret
        assert (
            got(f"{found.server.address}/board/{first.entry.secret}/")[2]
            != got(found.server.board_address(second.entry.code))[2]
        )


# What the kit answers


PANEL = {"notation": "abop", "text": "axiom: a\na -> ab\nb -> a", "step": 2}
BOMB = "axiom: F\nF -> " + "F" * 200 + "\nsteps: 9"


def ask(live: Running, phone: int, **content: Any) -> Any:
    return asked(live, {"phone": f"{phone:032x}", **content})


def test_panels_are_answered_as_a_kernel_answers(live: Running) -> None:
    opened = ask(live, 31, kind="open", panel=PANEL)
    assert opened["model"]["book"]["steps"] > 2
    assert opened["values"]["step"] == 2
    typed = ask(
        live, 31, kind="rules", text="axiom: A(1)\nn = 3 in 1 .. 6\nA(t) : t < n -> A(t+1)\nA(t) -> A(1) A(1)", panel=PANEL
    )
    assert [each["name"] for each in typed["model"]["constants"]] == ["n"]
    assert typed["values"]["settings"] == {"n": "3"}
    panel = {**PANEL, **typed["system"], **typed["values"]}
    assert ask(live, 31, kind="book", constants={"n": "5"}, seed=0, panel=panel)["book"]["states"]
    assert "<svg" in ask(live, 31, kind="keep", what="svg", state={}, panel=panel)["text"]
    wrong = ask(live, 32, kind="rules", text="axiom: a\na -> b = c", panel=PANEL)
    assert wrong["mistake"]["line"] == 2


@pytest.mark.slow
def test_exercises_are_answered_and_the_class_hears_of_it(fresh: Running) -> None:
    assert ask(fresh, 41, kind="check", id="1.1", answer="al al br", sent=1)["said"] == "Almost"
    assert ask(fresh, 42, kind="check", id="1.1", answer="bl ar bl ar ar", sent=1)["said"] == "Correct"
    hinted = ask(fresh, 41, kind="check", id="1.1", answer="al al br", hint=1)["message"]
    assert "Write one line for each step" in hinted
    fresh.do(do="open", kind="exercise", about="1.1", round=1)
    fresh.do(do="show", kind="exercise", about="1.1", round=1)
    seen = fresh.room.session.board(2)["current"]
    assert (seen["solved"], seen["stuck"], seen["replies"][0]["count"]) == (1, 1, 1)


@pytest.mark.slow
def test_a_phone_sends_no_more_plants_than_the_wall_has_room_for(fresh: Running) -> None:
    fresh.room.session.planted[f"{52:032x}"] = MOST_OF_A_PHONE
    assert "plants already" in ask(fresh, 52, kind="plant", text="axiom: F", sent=1)["mistake"]["message"]
    assert "description" in ask(fresh, 53, kind="plant", text="axiom: F", sent=1)


def test_exercises_without_end_follow_what_was_right(live: Running) -> None:
    wanted = {"topic": "derive", "level": 1, "seed": 3}
    first = ask(live, 54, kind="practice", **wanted)
    assert (first["level"], first["note"]) == (1, "")
    exercise = practice("derive", 1, 3).exercise
    assert exercise.question.strip() == first["question"]
    assert exercise.solution not in json.dumps(first)
    assert ask(live, 54, kind="practice check", answer=exercise.solution, **wanted)["said"] == "Correct"
    assert "Hint 1" in ask(live, 54, kind="practice check", answer="a", hint=1, **wanted)["message"]
    tries = [[first["name"], True], ["practice: derive 1 4", True]]
    assert ask(live, 54, kind="practice", **wanted, tries=tries)["level"] == 2
    choice = ask(live, 55, kind="practice", topic="turtle", level=1, seed=1)
    assert [each["letter"] for each in choice["options"]] == [*"ABCD"]
    for odd in ({"topic": "?"}, {"level": 9}, {"level": True}, {"seed": -1}, {"seed": 10**9}, {"tries": [1]}, {"tries": 5}):
        assert "mistake" in ask(live, 56 + len(str(odd)), kind="practice", **{**wanted, **odd})


@pytest.mark.slow
def test_plants_come_to_the_wall_and_are_taken_away(fresh: Running) -> None:
    assert "description" in ask(fresh, 51, kind="plant", text="axiom: F\nF -> F[+F]F\nsteps: 3", sent=1)
    assert "mistake" in ask(fresh, 51, kind="plant", text="axiom: <script>", sent=2)
    fresh.do(do="open", kind="wall", about="", round=1)
    [plant] = fresh.room.session.board(1)["current"]["plants"]
    status, headers, picture = got(f"{fresh.board}plants/{plant['number']}")
    assert (status, picture[:4]) == (200, b"<svg")
    assert "sandbox" in headers["Content-Security-Policy"]
    assert "picture" not in json.dumps(fresh.room.session.phone("x"))
    fresh.do(do="remove", number=plant["number"])
    assert fresh.room.session.board(1)["current"]["plants"] == []


@pytest.mark.slow
def test_a_bomb_is_stopped_and_the_others_are_answered(live: Running) -> None:
    bombs = [
        {"kind": "rules", "text": BOMB, "panel": PANEL},
        {"kind": "plant", "text": BOMB},
        {"kind": "check", "id": "1.3", "answer": BOMB},
        {"kind": "rules", "text": "axiom: A(1)\nA(t) -> A(t*t*t*t+1)\nsteps: 40", "panel": PANEL},
        {"kind": "open", "panel": {"notation": [], "text": 3}},
        {"kind": "__class__"},
        {},
    ]
    for number, bomb in enumerate(bombs, 60):
        found = ask(live, number, **bomb)
        assert "mistake" in found or found.get("said") in ("Not yet", "Not readable yet") or "model" in found, bomb
    assert ask(live, 70, kind="check", id="1.1", answer="bl ar bl ar ar")["said"] == "Correct"


@pytest.mark.slow
def test_a_class_of_thirty_goes_through_lesson_one(tmp_path: Path) -> None:
    """From joining to the report: two votes, a prediction, a table, the game of the cell, an exercise, a plant."""
    draw = random.Random(1)
    with running(tmp_path) as found:

        async def lesson() -> None:
            phones = [Phone(found.join, number) for number in range(1, 31)]
            await asyncio.gather(*(each.connect() for each in phones))
            loop = asyncio.get_running_loop()

            async def teacher(**content: Any) -> None:
                await loop.run_in_executor(None, lambda: found.do(**content))

            async def everybody(kind: str, about: str, round: int, value: Any) -> None:
                answers = await asyncio.gather(
                    *(each.keeps(kind, about, round, value(number)) for number, each in enumerate(phones))
                )
                assert all("kept" in each for each in answers)

            await teacher(do="open", kind="vote", about="01", round=1)
            await everybody("vote", "01", 1, lambda number: 2 if number < 12 else number % 2)
            await teacher(do="show", kind="vote", about="01", round=1)
            await teacher(do="close", kind="vote", about="01", round=1)
            await teacher(do="open", kind="prediction", about="01:1", round=1)
            await everybody("prediction", "01:1", 1, lambda number: draw.choice(["bl ar bl ar ar", "bl ar", "8"]))
            await everybody("table", "01:counts", 1, lambda number: ["2", "2", "3", "4", "5", "8", "8", "16"][: number % 9])
            await teacher(do="begin", what="J1")
            for step in (1, 2, 3):
                if step > 1:
                    await teacher(do="open", kind="game", about="1", round=step)
                for each in phones:
                    while (each.state.get("current") or {}).get("round") != step or each.state["current"]["kind"] != "game":
                        await each.hear()
                    cells = each.state["current"]["cells"]
                    turn = found.room.session.game("1").turns[step - 1]
                    chosen = {str(cell["place"]): turn.cells[cell["place"]].right for cell in cells}
                    assert "kept" in await each.keeps("game", "1", step, chosen)
                await teacher(do="show", kind="game", about="1", round=step)
                assert found.room.session.board(30)["current"]["outcome"]["parts"] is None
            await teacher(do="open", kind="vote", about="01", round=2)
            await everybody("vote", "01", 2, lambda number: 2 if number < 27 else 3)
            await teacher(do="show", kind="vote", about="01", round=2)

        run(lesson())
        for number in range(1, 31):
            answer = "bl ar bl ar ar" if number % 3 else "al al br"
            assert ask(found, number, kind="check", id="1.1", answer=answer, sent=100)["said"] in ("Correct", "Almost")
        assert "description" in ask(found, 1, kind="plant", text="axiom: F\nF -> F[+F]F\nsteps: 3", sent=101)
        found.do(do="finish")
        seen = found.room.session.votes("01", 2)
        assert (seen["before"], seen["bars"]) == ([9, 9, 12, 0], [0, 0, 27, 3])
        assert seen["changes"] == {"both": 30, "better": 15, "worse": 0, "gain": pytest.approx(15 / 18)}
        code = found.code
    events = Events(tmp_path)
    table = report_table(Session(events.of(code)))
    events.close()
    assert "01,vote,2,C,27,yes,30" in table
    assert "1.1,exercise,1,Correct" in table
    assert ",game,3," in table
