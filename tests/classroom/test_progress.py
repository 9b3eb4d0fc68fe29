"""What was tried and solved is kept beside the course: in words that anybody can read, and never at the cost of a check."""

from __future__ import annotations

import io
import os
import re
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path

import pytest

from lsys_kit import LSystemError, ModelNameError, ModelValueError, check, files, progress
from lsys_kit.classroom.course import copy_course
from lsys_kit.classroom.exercises import progress as kept
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.progress import FILE, HEAD, MOST_BYTES, Record, Try, progress_of, record_so_far
from lsys_kit.classroom.exercises.registry import lessons
from lsys_kit.files import append_line

RIGHT, NEAR, UNREADABLE = "bl ar bl ar ar", "al al br", "al al bx"
"""Answers to exercise 1.1."""


@pytest.fixture(autouse=True)
def new_session(monkeypatch):
    """As if Python had just begun."""
    for name in ("_seen", "_said"):
        monkeypatch.setattr(kept, name, set())
    monkeypatch.setattr(kept, "_not_kept", [])


@pytest.fixture
def course(tmp_path: Path, monkeypatch) -> Path:
    """A small copy of the course, with Python running in its exercises, as in a notebook."""
    source = tmp_path / "kit" / "exercises" / "01_all_at_once.ipynb"
    source.parent.mkdir(parents=True)
    source.write_text("version 1")
    copy_course(tmp_path / "course", tmp_path / "kit")
    monkeypatch.chdir(tmp_path / "course" / "exercises")
    return tmp_path / "course"


def results(course: Path) -> list[str]:
    """The lines of the file, without their times."""
    head, *lines = (course / FILE).read_text().splitlines()
    assert head == HEAD
    assert all(re.match(r"\d{4}-\d\d-\d\d \d\d:\d\d,", line) for line in lines)
    return [line.partition(",")[2] for line in lines]


def begin_again(monkeypatch) -> None:
    """As if Python had been started again."""
    for name in ("_seen", "_said"):
        monkeypatch.setattr(kept, name, set())


# What is kept


def test_a_try_and_a_solution_are_a_line_each(course):
    check("1.1", NEAR)
    check("1.1", RIGHT)
    assert results(course) == ["1.1,tried", "1.1,solved"]


def test_what_is_no_try_is_not_kept(course):
    for answer in (..., "", UNREADABLE, "(("):
        check("1.1", answer)
    assert not (course / FILE).exists()


def test_hints_and_the_same_answer_again_are_no_new_try(course):
    for choices in ({}, {"hint": 1}, {"hint": 2}, {"solution": True}):
        check("1.1", f" {NEAR}  ", **choices)
        check("1.2", 34.0, **choices)
    assert results(course) == ["1.1,tried", "1.2,tried"]


def test_nothing_is_added_to_an_exercise_that_is_solved(course, monkeypatch):
    for answer in (RIGHT, NEAR, "bl, ar, bl, ar, ar"):
        check("1.1", answer)
    begin_again(monkeypatch)
    check("1.1", RIGHT)
    assert results(course) == ["1.1,solved"]


def test_the_file_tells_nothing_of_how_near_a_number_is(course):
    for number in (20, 22, 1, 10**6):
        check("1.2", number)
    assert results(course) == ["1.2,tried"] * 4


def test_an_update_of_the_course_leaves_the_record_as_it_is(course, tmp_path):
    check("1.1", RIGHT)
    before = (course / FILE).read_bytes()
    (tmp_path / "kit" / "exercises" / "01_all_at_once.ipynb").write_text("version 2")
    (tmp_path / "kit" / "exercises" / FILE).write_text("the kit's")
    copy_course(course, tmp_path / "kit")
    assert (course / FILE).read_bytes() == before
    assert record_so_far().solved("1.1")


@pytest.mark.slow
def test_two_notebooks_at_the_same_time_lose_nothing(tmp_path):
    lines = [f"2026-01-01 10:00,{number},tried{'!' * 3_000}" for number in range(400)]  # many lines cross a block of the disk
    with ThreadPoolExecutor(8) as threads:
        list(threads.map(lambda line: append_line(tmp_path / FILE, line, HEAD), lines))
    head, *written = (tmp_path / FILE).read_text().splitlines()
    assert (head, sorted(written)) == (HEAD, sorted(lines))


def test_a_line_that_another_notebook_adds_in_between_is_not_overwritten(tmp_path, monkeypatch):
    class Slow(io.FileIO):
        def write(self, content: bytes) -> int:
            with (tmp_path / FILE).open("ab") as other:
                other.write(b"other\n")
            return super().write(content)

    monkeypatch.setattr(files, "open", lambda opened, mode, buffering: Slow(opened, mode), raising=False)
    append_line(tmp_path / FILE, "own", HEAD)
    assert (tmp_path / FILE).read_text() == f"{HEAD}\nother\nown\n"


# Where it is kept


def test_nothing_is_written_where_there_is_no_course(tmp_path, monkeypatch):
    monkeypatch.chdir(tmp_path)
    assert check("1.1", RIGHT).message == ""
    assert list(tmp_path.iterdir()) == []
    assert progress(1).count("solved") == 1
    assert "forgotten when Python ends" in repr(progress())


def test_python_in_the_folder_of_the_course_or_two_below_finds_it(course, monkeypatch):
    for number, folder in enumerate((course, course / "notebooks" / "reference"), 1):
        folder.mkdir(parents=True, exist_ok=True)
        monkeypatch.chdir(folder)
        check("1.2", number)
    assert results(course) == ["1.2,tried"] * 2
    (course / "a" / "b" / "c").mkdir(parents=True)
    monkeypatch.chdir(course / "a" / "b" / "c")
    assert record_so_far().folder is None


def test_a_manifest_that_is_a_link_makes_no_course(course, tmp_path, monkeypatch):
    (tmp_path / "other").mkdir()
    (tmp_path / "other" / ".lsys_kit_course.json").symlink_to(course / ".lsys_kit_course.json")
    monkeypatch.chdir(tmp_path / "other")
    check("1.1", RIGHT)
    assert record_so_far().folder is None
    assert not (tmp_path / "other" / FILE).exists()


# What goes wrong


BROKEN = {
    "a folder": lambda path: path.mkdir(),
    "a link": lambda path: (path.with_name("target").write_text(f"{HEAD}\n"), path.symlink_to(path.with_name("target"))),
    "a dead link": lambda path: path.symlink_to(path.with_name("nowhere")),
    "a pipe": lambda path: os.mkfifo(path),
    "somebody's own": lambda path: path.write_text("my,own,table\n1,2,3\n"),
    "empty": lambda path: path.write_text(""),
    "binary": lambda path: path.write_bytes(bytes(range(256)) * 40),
    "one long line": lambda path: path.write_text("," * MOST_BYTES),
    "full": lambda path: path.write_text(HEAD + "\n2026-01-01 10:00,0.1,tried" * 50_000),
}


@pytest.mark.slow
@pytest.mark.parametrize("broken", BROKEN)
def test_a_broken_record_stops_no_check_is_left_as_it_is_and_is_named_once(course, broken):
    BROKEN[broken](course / FILE)
    before = _state(course)
    verdict = check("1.1", RIGHT)
    assert (verdict.said, float(verdict)) == ("Correct", 1)
    assert "This try is not kept" in verdict.message
    assert "not kept" not in check("1.2", 21).message
    assert progress(1).count("solved") == 2
    assert _state(course) == before


def _state(course: Path) -> dict[str, object]:
    return {path.name: path.read_bytes() if path.is_file() else os.path.lexists(path) for path in course.iterdir()}


def test_a_folder_that_cannot_be_written_to_stops_no_check(course, monkeypatch):
    def refuse(*_: object) -> None:
        raise PermissionError(13, "Permission denied")

    monkeypatch.setattr(kept, "append_line", refuse)
    verdict = check("1.1", NEAR)
    assert verdict.said == "Almost"
    assert verdict.message.endswith(f"\nThis try is not kept in {FILE}: Permission denied.")
    assert "Permission" not in check("1.1", NEAR + " bl").message
    assert progress(1).record.tried("1.1") == 2


def test_a_current_folder_that_is_gone_stops_no_check(tmp_path, monkeypatch):
    (tmp_path / "gone").mkdir()
    monkeypatch.chdir(tmp_path / "gone")
    (tmp_path / "gone").rmdir()
    assert check("1.1", RIGHT).said == "Correct"
    assert "✓ 1.1" in repr(progress())


def test_lines_that_cannot_be_read_are_left_out_and_counted(course):
    (course / FILE).write_bytes(f"\ufeff{HEAD}\r\n\r\n2026,1.1,solved\r\nnonsense\r\n2026,1.2,tr".encode() + b"\xff")
    assert record_so_far().problem == f"In {FILE} 2 lines cannot be read."
    assert "2 lines cannot be read" in progress(1)._repr_html_()
    check("1.3", "axiom: b")
    assert record_so_far().tries == (Try("1.1", True), Try("1.3", False))


def test_a_line_is_not_added_to_a_file_of_somebody_else(tmp_path):
    (tmp_path / "mine").write_text("mine")
    with pytest.raises(OSError, match="not a file of the kit"):
        append_line(tmp_path / "mine", "line", HEAD)
    assert (tmp_path / "mine").read_text() == "mine"


# The page


def test_what_is_solved_and_tried_is_counted(new_session):
    tries = [("1.1", False), ("1.1", False), ("1.1", True), ("1.1", False), ("1.2", False)]
    page = progress_of(Record(tuple(Try(*each) for each in tries)), 1)
    assert repr(page).splitlines()[:4] == [
        "All at once: 1 of 5 solved, 1 more tried.",
        "✓ 1.1  A word by hand (3 tries)",
        "◐ 1.2  Find the bug",
        "○ 1.3  The filament in a mirror",
    ]


@pytest.mark.parametrize(
    ("tries", "lesson", "following"),
    [
        ((), None, "0.1"),
        ((), 1, "1.1"),
        ((Try("1.1", True),), None, "1.2"),
        ((Try("1.3", False),), None, "1.1"),
        ((Try("1.1", True), Try("3.1", True)), None, "3.2"),
        (tuple(Try(f"1.{n}", True) for n in range(1, 6)), None, "2.1"),
        (tuple(Try(f"18.{n}", True) for n in range(1, 7)), None, "19.1"),
        (tuple(Try(f"19.{n}", True) for n in range(1, 9)), None, "0.1"),
        ((Try("unknown", True),), None, "0.1"),
    ],
)
def test_next_is_the_first_exercise_not_solved_of_the_lesson_worked_on_last(tries, lesson, following, monkeypatch):
    monkeypatch.setattr(registry, "_added", {})  # no folders of a teacher's own
    assert progress_of(Record(tries), lesson).next[1].id == following


def test_when_all_is_solved_the_page_says_so(monkeypatch):
    tries = tuple(Try(exercise.id, True) for lesson in lessons() for exercise in lesson.exercises)
    monkeypatch.setattr("lsys_kit.classroom.exercises.progress.all_lessons", lessons)
    page = progress_of(Record(tries))
    assert page.next is None
    assert "All exercises are solved." in repr(page)


@pytest.mark.parametrize("lesson", [1, "01", "01_all_at_once"])
def test_a_lesson_has_a_number_and_a_name(lesson):
    assert progress(lesson).lessons[0].name == "01_all_at_once"


@pytest.mark.parametrize(
    ("lesson", "error"),
    [
        (99, ModelNameError),
        (-1, ModelNameError),
        pytest.param(10**5000, ModelNameError, id="huge"),
        ("01_all_at_onse", ModelNameError),
        (True, ModelValueError),
        ([], ModelValueError),
    ],
)
def test_an_unknown_lesson_is_an_error_in_words(lesson, error):
    with pytest.raises(error):
        progress(lesson)
    with pytest.raises(LSystemError, match=r"[Ll]esson"):
        progress(lesson)


def test_in_a_course_the_page_has_links_that_lead_from_where_python_runs(course):
    assert 'href="01_all_at_once.ipynb"' in progress()._repr_html_()
    assert "href" not in progress_of(Record())._repr_html_()


def test_no_word_claims_to_be_an_examination():
    assert "not an examination" in repr(progress())
