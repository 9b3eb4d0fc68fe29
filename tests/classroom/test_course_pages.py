"""The pages of the course come while the class is open: phones join at once, and each page can be opened when it is made."""

from __future__ import annotations

import json
import multiprocessing
import os
import signal
from collections.abc import Iterator
from pathlib import Path
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest
from nbformat import writes
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook

from lsys_kit.classroom.live import course_pages
from lsys_kit.classroom.live.course_pages import MADE, PAGES, CoursePages, is_made
from tests.classroom.live_class import SECONDS, Phone, Running, made_pages, run, running, started, wait_for

LESSON, EXERCISES = "notebooks/01_all_at_once", "exercises/01_all_at_once"


def write_notebook(course: Path, name: str, source: str) -> None:
    path = course / f"{name}.ipynb"
    path.parent.mkdir(parents=True, exist_ok=True)
    path.write_text(writes(new_notebook(cells=[new_markdown_cell("# Title"), new_code_cell(source)])))


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course of a lesson and its exercises."""
    write_notebook(tmp_path / "course", LESSON, "print('read')")
    write_notebook(tmp_path / "course", EXERCISES, "check(1)")
    return tmp_path / "course"


def answered(live: Running, name: str) -> tuple[int, str]:
    try:
        with urlopen(f"{live.join}course/{name}.html", timeout=SECONDS) as answer:
            return answer.status, answer.read().decode()
    except HTTPError as refused:
        return refused.code, refused.read().decode()


def board(live: Running) -> dict[str, object]:
    return json.loads(live.room.board_state())["state"]


def vote_at(live: Running) -> None:
    """Join the class, and vote."""

    async def votes() -> None:
        phone = Phone(live.join, 1)
        await phone.connect()
        assert "kept" in await phone.keeps("vote", "01", 1, 2)

    run(votes())


def test_pages_that_are_made_are_those_of_this_kit_and_this_course(
    course: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = tmp_path / PAGES
    assert not is_made(place)
    made_pages(tmp_path, {"index.html": b"page"})
    assert is_made(place)
    assert not is_made(place, course)
    monkeypatch.setattr(course_pages, "language", lambda: "de")
    assert not is_made(place)
    monkeypatch.undo()
    for odd in ("", "{}", "[1]", "3", "\x00"):
        (place / MADE).write_text(odd)
        assert not is_made(place)


def test_pages_that_are_made_are_there_without_links(tmp_path: Path) -> None:
    pages = made_pages(tmp_path, {"index.html": b"page", f"{LESSON}.html": b"lesson"})
    (tmp_path / "secret").write_text("secret")
    (tmp_path / PAGES / "link.html").symlink_to(tmp_path / "secret")
    heard: list[int] = []
    pages.begin(lambda: heard.append(len(pages.pages)))
    wait_for(lambda: heard)
    assert (heard, {*pages.pages}) == ([2], {"index.html", f"{LESSON}.html"})
    assert (pages.is_coming, pages.progress, pages.fault) == (False, None, "")
    pages.close()


@pytest.mark.slow
def test_a_class_is_open_while_its_pages_are_made(course: Path, tmp_path: Path) -> None:
    said: list[str] = []
    with running(tmp_path, CoursePages(tmp_path, course, said.append)) as live:
        status, page = answered(live, LESSON)
        assert (status, "This page is being made." in page) == (503, True)
        vote_at(live)
        assert answered(live, "index")[0] == 503
        wait_for(lambda: board(live)["pages"])
        assert board(live)["pages"]["many"] == 3
        wait_for(lambda: answered(live, EXERCISES)[0] == 200)
        wait_for(lambda: answered(live, LESSON)[0] == 200)
        assert "read" in answered(live, LESSON)[1]
        wait_for(lambda: board(live)["pages"] is None)
        assert answered(live, "index")[0] == 200
        assert answered(live, "notebooks/nothing")[0] == 404
    assert said == ["The pages of the course are made, once. Phones can join meanwhile."]
    assert is_made(tmp_path / PAGES, course)
    with running(tmp_path, CoursePages(tmp_path, course, said.append)) as live:
        wait_for(lambda: answered(live, "index")[0] == 200)
        assert board(live)["pages"] is None
    assert len(said) == 1, "they are made once"


@pytest.mark.slow
def test_pages_that_cannot_be_made_are_told_and_the_class_goes_on(course: Path, tmp_path: Path) -> None:
    write_notebook(course, LESSON, "1 / 0")
    said: list[str] = []
    with running(tmp_path, CoursePages(tmp_path, course, said.append)) as live:
        wait_for(lambda: board(live)["fault"])
        assert "The pages of the course cannot be made: A cell of notebooks/01_all_at_once.ipynb fails" in board(live)["fault"]
        wait_for(lambda: answered(live, LESSON)[0] == 404)
        assert answered(live, EXERCISES)[0] == 200
        vote_at(live)
    assert said[1:] == [board(live)["fault"]]
    assert not is_made(tmp_path / PAGES, course)


@pytest.mark.slow
def test_a_folder_that_cannot_have_pages_is_told(course: Path, tmp_path: Path) -> None:
    (tmp_path / PAGES).write_text("mine")
    pages = CoursePages(tmp_path, course)
    pages.begin(lambda: None)
    wait_for(lambda: not pages.is_coming)
    assert "cannot be written" in pages.fault
    pages.close()


@pytest.mark.slow
def test_a_class_ends_though_a_cell_of_its_course_does_not(
    course: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(course_pages, "ENDING", 1.0)
    write_notebook(course, LESSON, "import time\ntime.sleep(600)")
    with running(tmp_path, CoursePages(tmp_path, course)) as live:
        wait_for(lambda: answered(live, EXERCISES)[0] == 200)
    assert multiprocessing.active_children() == []
    assert not is_made(tmp_path / PAGES, course)


def in_session(session: int) -> Iterator[int]:
    """The processes of a session that have not ended yet."""
    for each in filter(str.isdigit, os.listdir("/proc")):
        try:
            with open(f"/proc/{each}/stat", encoding="ascii", errors="replace") as stat:
                state, _, _, found = stat.read().rpartition(")")[2].split()[:4]
        except OSError:
            continue
        if int(found) == session and state != "Z":
            yield int(each)


@pytest.mark.slow
@pytest.mark.skipif(not Path("/proc/self/stat").exists(), reason="processes are listed as on Linux")
def test_nothing_is_made_for_a_server_that_was_killed(course: Path, tmp_path: Path) -> None:
    write_notebook(course, LESSON, "import time\ntime.sleep(600)")
    server = started(tmp_path, course=course)
    place = tmp_path / PAGES / f"{EXERCISES}.html"
    wait_for(place.exists)
    os.kill(server.process.pid, signal.SIGKILL)
    server.process.wait(SECONDS)
    try:
        wait_for(lambda: not [*in_session(server.process.pid)])
    finally:
        for each in in_session(server.process.pid):
            os.kill(each, signal.SIGKILL)
