"""A class that is opened in a notebook: its server ends with the kernel, and questions of cells are opened for all phones."""

from __future__ import annotations

import json
import os
import signal
import socket
import subprocess
import sys
from collections.abc import Iterator
from pathlib import Path
from typing import Any
from urllib.error import HTTPError
from urllib.request import urlopen

import pytest

from lsys_kit import LSystemError, ModelFileError, ModelValueError, open_class, predict, vote
from lsys_kit.__main__ import main
from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.live.notebook import ClassBoard
from lsys_kit.classroom.live.questions import about_prediction, predictions, questions
from lsys_kit.classroom.widget import KitWidget
from tests.classroom.live_class import SECONDS, Phone, run, wait_for

pytestmark = pytest.mark.slow
QUESTION = "Step 3 is `al al br al br`. What is the word of step 4?"


@pytest.fixture
def board(tmp_path: Path) -> Iterator[ClassBoard]:
    found = open_class("10b", tmp_path, port=0, course=False)
    yield found
    found.end()


def current(board: ClassBoard) -> dict[str, Any]:
    return board.state.get("current") or {}


def at_home(board: ClassBoard) -> str:
    """The address of a class on this machine."""
    return f"http://127.0.0.1:{board.address.split(':')[2]}"


def page_at(address: str) -> str:
    """A page, also one that says why it is not there."""
    try:
        with urlopen(address, timeout=SECONDS) as answer:
            return answer.read().decode()
    except HTTPError as refused:
        return refused.read().decode()


def test_cells_open_questions_and_the_board_below_the_cell_counts(board: ClassBoard) -> None:
    async def two_phones() -> None:
        phones = [Phone(at_home(board), number) for number in (1, 2)]
        for each in phones:
            await each.connect()
        for round in (1, 2):
            vote("01", again=round == 2)
            for number, each in enumerate(phones):
                await each.told(lambda told, round=round: (told["state"].get("current") or {}).get("round") == round)
                assert "kept" in await each.keeps("vote", "01", round, number + round)
            board._handle_custom_msg({"do": "show", "kind": "vote", "about": "01", "round": round}, [])
        predict(QUESTION, "bl ar bl ar ar")
        for each in phones:
            await each.told(lambda told: (told["state"].get("current") or {}).get("kind") == "prediction")
        vote("01")
        predict("A question that no lesson asks", "nothing")

    run(two_phones())
    wait_for(lambda: current(board).get("kind") == "vote")
    wait_for(lambda: current(board).get("bars") == [0, 1, 1, 0])
    assert open_class("10b", board._class._folder).state == board.state


@pytest.mark.parametrize("kind", [str, Path])
def test_a_class_has_a_course_of_ones_own(kind: Any, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    """As `lsys-kit class --course`; its phones are asked what the cells of its lessons ask."""
    ferns = write_lesson("ferns", tmp_path / "ferns")
    board = open_class("10b", tmp_path / "class", port=0, course=kind(ferns))
    try:
        assert [each["lesson"] for each in board.about["plan"]] == ["ferns"]
        monkeypatch.chdir(ferns / "notebooks")
        predict("Step 2 has 4 buds. How many has step 4?", "16")
        wait_for(lambda: current(board).get("about") == "ferns:1")
        vote("ferns")
        wait_for(lambda: (current(board).get("kind"), current(board).get("about")) == ("vote", "ferns"))
        wait_for(lambda: ">Ferns</h1>" in page_at(f"{at_home(board)}course/notebooks/ferns.html"))
    finally:
        board.end()


def test_where_there_is_no_course_the_class_is_refused_as_in_the_shell(
    tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    with pytest.raises(ModelFileError) as told:
        open_class("10b", tmp_path / "class", port=0, course=tmp_path)
    assert main(["class", "--folder", str(tmp_path / "class"), "--course", str(tmp_path)]) == 2
    assert told.value.message in capsys.readouterr().err
    assert not (tmp_path / "class").exists()


def test_every_prediction_of_the_course_is_known_by_what_it_asks() -> None:
    for kind, about in questions():
        if kind == "prediction":
            [text] = {each for each in predictions(_lesson(about[:2])) if about_prediction(each) == about}
            assert text
    assert about_prediction("A question that no lesson asks") is None


def _lesson(number: str) -> str:
    from lsys_kit.classroom.lessons.lesson import lesson

    return lesson(number).name


def test_a_board_is_brought_what_a_question_asks_and_the_pictures_of_plants(board: ClassBoard) -> None:
    heard: list[dict[str, Any]] = []
    board.send = heard.append  # as a browser hears it
    for wanted in (["question", "vote", "01"], ["question", "vote", "99"], ["plant", 0], ["plant", "x"], [], None):
        board._handle_custom_msg({"want": wanted}, [])
    wait_for(lambda: len(heard) == 6)
    found = {json.dumps(each["wanted"]): each["content"] for each in heard}
    assert len(found.pop('["question", "vote", "01"]')["options"]) == 4
    assert {*found.values()} == {None}
    board._handle_custom_msg({"do": "nothing that is known"}, [])
    wait_for(lambda: "mistake" in heard[-1])


def test_a_class_goes_on_where_it_was(tmp_path: Path) -> None:
    first = open_class("10b", tmp_path, port=0, course=False)
    vote("02")
    wait_for(lambda: current(first).get("about") == "02")
    first.end()
    wait_for(lambda: first.ended)
    again = open_class("10b", tmp_path, port=0, course=False)
    try:
        assert again.code == first.code
        wait_for(lambda: current(again).get("about") == "02")
    finally:
        again.end()


def test_what_a_class_tells_while_a_board_is_made_reaches_it(board: ClassBoard, monkeypatch: pytest.MonkeyPatch) -> None:
    made = KitWidget.__init__

    def made_slowly(self: KitWidget, **given: Any) -> None:
        monkeypatch.undo()
        made(self, **given)
        vote("02")
        wait_for(lambda: current(board).get("about") == "02")

    monkeypatch.setattr(KitWidget, "__init__", made_slowly)
    assert current(open_class("10b", board._class._folder)).get("about") == "02"


def test_a_port_that_is_taken_is_told(tmp_path: Path) -> None:
    with socket.create_server(("", 0)) as other, pytest.raises(ModelFileError, match="cannot be used"):
        open_class("10b", tmp_path, port=other.getsockname()[1], course=False)


@pytest.mark.parametrize(
    ("choices", "error"),
    [
        ({"name": ""}, ModelValueError),
        ({"name": 3}, LSystemError),
        ({"port": -1}, ModelValueError),
        ({"port": 70_000}, ModelValueError),
        ({"port": "x"}, LSystemError),
        ({"folder": 3}, LSystemError),
        ({"folder": "/dev/null/class"}, ModelFileError),
        ({"course": 3}, ModelValueError),
        ({"course": None}, ModelValueError),
        ({"course": "no"}, ModelFileError),
        ({"course": "a\0b"}, ModelFileError),
        ({"course": Path("/dev/null")}, ModelFileError),
    ],
    ids=str,
)
def test_what_no_class_can_be_opened_with_is_refused(choices: dict[str, Any], error: type[Exception], tmp_path: Path) -> None:
    with pytest.raises(error):
        open_class(**{"folder": tmp_path, "course": False, "port": 0, **choices})


KERNEL = """
import signal, sys, time
from lsys_kit import open_class
if __name__ == "__main__":
    signal.signal(signal.SIGINT, signal.default_int_handler)  # as kernels do, also where whatever started them ignores it
    board = open_class("10b", sys.argv[1], port=0, course=False)
    try:
        print(board.address, flush=True)
        time.sleep(600)
    except KeyboardInterrupt:
        print("interrupted", flush=True)
    time.sleep(600)
"""


@pytest.mark.skipif(sys.platform == "win32", reason="signals of other systems")
def test_a_class_ends_with_its_kernel_and_not_with_a_cell(tmp_path: Path) -> None:
    """As where a cell is interrupted, and then the kernel is killed."""
    script = tmp_path / "kernel.py"
    script.write_text(KERNEL)
    command = [sys.executable, str(script), str(tmp_path / "class")]
    kernel = subprocess.Popen(command, stdout=subprocess.PIPE, text=True, start_new_session=True)
    port = int(kernel.stdout.readline().split(":")[2].split("/")[0])

    def is_gone() -> bool:
        try:
            with urlopen(f"http://127.0.0.1:{port}/", timeout=SECONDS):
                return False
        except OSError:
            return True

    os.killpg(kernel.pid, signal.SIGINT)
    assert kernel.stdout.readline() == "interrupted\n"
    assert not is_gone()
    os.kill(kernel.pid, signal.SIGKILL)
    kernel.wait(SECONDS)
    wait_for(is_gone)
