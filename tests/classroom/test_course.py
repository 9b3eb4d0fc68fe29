"""The course belongs to the student who works in it: copying it again never takes a line from him."""

from __future__ import annotations

import json
import os
from pathlib import Path

import nbformat
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output

from lsys_kit.classroom.course import MANIFEST, Copied, copy_course, copy_report, course_files
from lsys_kit.classroom.places import Place
from lsys_kit.errors import ModelFileError

LESSON, EXERCISE = "notebooks/01_lesson.ipynb", "exercises/01_exercise.ipynb"


@pytest.fixture
def kit(tmp_path: Path) -> Path:
    """A small course as the kit brings it."""
    for name in (LESSON, EXERCISE):
        path = tmp_path / "kit" / name
        path.parent.mkdir(parents=True)
        path.write_text("version 1")
    return tmp_path / "kit"


@pytest.fixture
def mine(kit: Path, tmp_path: Path) -> Path:
    """The course, copied into a folder of mine."""
    copy_course(tmp_path / "mine", kit)
    return tmp_path / "mine"


def what(copied: tuple[Copied, ...]) -> dict[str, str]:
    return {file.name: file.what for file in copied}


def contents(folder: Path) -> dict[str, str]:
    return {str(path.relative_to(folder)): path.read_text() for path in sorted(folder.rglob("*.ipynb"))}


def test_the_course_of_the_kit_has_lessons_and_exercises():
    assert {name.rpartition("/")[0] for name in course_files()} == {"notebooks", "exercises", "notebooks/reference"}


def test_the_course_opens_with_the_first_lesson():
    assert next(iter(course_files())).startswith("notebooks/00_")


def test_a_new_folder_gets_every_file(kit, tmp_path):
    assert what(copy_course(tmp_path / "mine", kit)) == {LESSON: "new", EXERCISE: "new"}
    assert contents(tmp_path / "mine") == {LESSON: "version 1", EXERCISE: "version 1"}


def test_a_lesson_is_copied_without_what_it_shows_and_says_how_a_cell_is_run(kit, tmp_path):
    cells = [
        new_markdown_cell("# All at once", id="title"),
        new_code_cell("derive(x)", id="word", execution_count=3, outputs=[new_output("stream", text="0 ar")]),
    ]
    for name in (LESSON, EXERCISE):
        (kit / name).write_text(nbformat.writes(new_notebook(cells=cells)))
    copy_course(tmp_path / "mine", kit)
    lesson, exercise = (nbformat.read(tmp_path / "mine" / name, as_version=4) for name in (LESSON, EXERCISE))
    nbformat.validate(lesson)
    assert [cell.id for cell in lesson.cells] == ["title", "how-to-run-a-cell", "word"]
    assert "Shift + Enter" in lesson.cells[1].source
    assert (lesson.cells[2].outputs, lesson.cells[2].execution_count) == ([], None)
    assert exercise.cells[1].outputs[0].text == "0 ar"


def test_the_teachers_pages_are_not_copied(kit, tmp_path):
    (kit / "notebooks" / "teacher").mkdir()
    (kit / "notebooks" / "teacher" / "01_lesson.md").write_text("The answer is C.")
    copy_course(tmp_path / "mine", kit)
    assert not (tmp_path / "mine" / "notebooks" / "teacher").exists()
    assert not any(name.startswith("notebooks/teacher") for name in course_files())


def test_every_lesson_that_comes_with_the_kit_is_copied_unrun_and_the_gallery_with_its_pictures(tmp_path):
    copy_course(tmp_path)
    for path in (tmp_path / "notebooks").glob("*.ipynb"):
        cells = nbformat.read(path, as_version=4).cells
        assert any(cell.get("outputs") or cell.get("execution_count") for cell in cells) == (path.stem == "gallery")


def test_copying_twice_changes_nothing(kit, mine):
    before = {path: path.stat().st_mtime_ns for path in mine.rglob("*.ipynb")}
    assert what(copy_course(mine, kit)) == {LESSON: "same", EXERCISE: "same"}
    assert {path: path.stat().st_mtime_ns for path in mine.rglob("*.ipynb")} == before


def test_an_untouched_lesson_is_renewed(kit, mine):
    (kit / LESSON).write_text("version 2")
    assert what(copy_course(mine, kit)) == {LESSON: "renewed", EXERCISE: "same"}
    assert contents(mine)[LESSON] == "version 2"


def test_a_changed_lesson_is_kept_where_there_is_no_news(kit, mine):
    (mine / LESSON).write_text("my work")
    assert what(copy_course(mine, kit))[LESSON] == "kept"
    assert contents(mine) == {LESSON: "my work", EXERCISE: "version 1"}


def test_news_of_a_changed_lesson_stand_beside_it_once(kit, mine):
    (mine / LESSON).write_text("my work")
    (kit / LESSON).write_text("version 2")
    copied = copy_course(mine, kit)
    beside = LESSON.replace(".ipynb", ".new.ipynb")
    assert contents(mine) == {LESSON: "my work", beside: "version 2", EXERCISE: "version 1"}
    assert f"You have changed {LESSON}; its new version is {beside}." in copy_report("The course is", mine, copied)
    (mine / beside).unlink()
    assert what(copy_course(mine, kit))[LESSON] == "kept"
    assert beside not in contents(mine)


def test_work_in_the_new_version_is_kept_too(kit, mine):
    (mine / LESSON).write_text("my work")
    for version in ("version 2", "version 3", "version 4"):
        (kit / LESSON).write_text(version)
        copy_course(mine, kit)
        if version == "version 3":
            (mine / LESSON.replace(".ipynb", ".new.ipynb")).write_text("my work in version 3")
    assert contents(mine) == {
        LESSON: "my work",
        LESSON.replace(".ipynb", ".new.ipynb"): "my work in version 3",
        LESSON.replace(".ipynb", ".new2.ipynb"): "version 4",
        EXERCISE: "version 1",
    }


def test_a_deleted_lesson_comes_back(kit, mine):
    (mine / LESSON).unlink()
    assert what(copy_course(mine, kit))[LESSON] == "new"


@pytest.mark.parametrize(
    "manifest",
    [
        "",
        "[]",
        "{",
        '{"files": 3}',
        "[" * 100_000,
        "\0",
        json.dumps({"files": {LESSON: 1}}),
        json.dumps({"files": {"../../outside.ipynb": "0" * 64}}),
    ],
)
def test_without_a_manifest_that_can_be_read_every_difference_is_the_students(kit, mine, manifest):
    (mine / LESSON).write_text("my work")
    (kit / LESSON).write_text("version 2")
    (mine / MANIFEST).write_text(manifest)
    assert what(copy_course(mine, kit)) == {LESSON: "beside", EXERCISE: "same"}
    assert contents(mine)[LESSON] == "my work"


def test_the_students_own_files_stay(kit, mine):
    (mine / "notebooks" / "my_own.ipynb").write_text("mine")
    copy_course(mine, kit)
    assert contents(mine)["notebooks/my_own.ipynb"] == "mine"


def test_a_link_in_the_folder_is_not_followed(kit, mine, tmp_path):
    outside = tmp_path / "outside.ipynb"
    outside.write_text("version 1")
    (mine / LESSON).unlink()
    (mine / LESSON).symlink_to(outside)
    (mine / LESSON.replace(".ipynb", ".new.ipynb")).symlink_to(outside)
    (mine / MANIFEST).rename(tmp_path / "manifest")
    (mine / MANIFEST).symlink_to(tmp_path / "manifest")
    known = (tmp_path / "manifest").read_text()
    (kit / LESSON).write_text("version 2")
    copied = copy_course(mine, kit)
    assert outside.read_text() == "version 1"
    assert (tmp_path / "manifest").read_text() == known
    assert copied[0].beside == LESSON.replace(".ipynb", ".new2.ipynb")


def test_a_link_in_place_of_an_untouched_lesson_stays(kit, mine, tmp_path):
    (mine / LESSON).rename(tmp_path / "elsewhere.ipynb")
    (mine / LESSON).symlink_to(tmp_path / "elsewhere.ipynb")
    (kit / LESSON).write_text("version 2")
    assert what(copy_course(mine, kit))[LESSON] == "beside"
    assert (mine / LESSON).is_symlink()
    assert (tmp_path / "elsewhere.ipynb").read_text() == "version 1"


def test_a_link_in_place_of_a_folder_is_refused(kit, tmp_path):
    (tmp_path / "outside").mkdir()
    (tmp_path / "mine").mkdir()
    (tmp_path / "mine" / "notebooks").symlink_to(tmp_path / "outside")
    with pytest.raises(ModelFileError, match="links are not followed"):
        copy_course(tmp_path / "mine", kit)
    assert list((tmp_path / "outside").iterdir()) == []


def test_a_reference_is_copied_beside_the_lessons(kit, tmp_path):
    (kit / "notebooks" / "reference").mkdir()
    (kit / "notebooks" / "reference" / "commands.ipynb").write_text("version 1")
    assert what(copy_course(tmp_path / "mine", kit))["notebooks/reference/commands.ipynb"] == "new"
    (tmp_path / "other" / "notebooks").mkdir(parents=True)
    (tmp_path / "outside").mkdir()
    (tmp_path / "other" / "notebooks" / "reference").symlink_to(tmp_path / "outside")
    with pytest.raises(ModelFileError, match="links are not followed"):
        copy_course(tmp_path / "other", kit)
    assert list((tmp_path / "outside").iterdir()) == []


def test_only_files_with_plain_names_are_of_the_course(kit):
    for name in (".hidden.ipynb", "a b.ipynb", "a\nb.ipynb", "conftest.py", "data.pkl", "x" * 200 + ".md", "ä.ipynb"):
        (kit / "notebooks" / name).write_text("no")
    (kit / "notebooks" / "folder.ipynb").mkdir()
    (kit / "notebooks" / "link.ipynb").symlink_to(kit / LESSON)
    assert set(course_files(kit)) == {LESSON, EXERCISE}


def test_a_folder_that_cannot_be_made_is_a_message(kit, tmp_path):
    (tmp_path / "file").write_text("")
    with pytest.raises(ModelFileError, match="cannot be copied"):
        copy_course(tmp_path / "file", kit)


def test_an_installation_without_the_course_says_so(tmp_path, monkeypatch):
    empty = Place(tmp_path, tmp_path, tmp_path)
    monkeypatch.setattr("lsys_kit.classroom.course.kit_place", lambda: empty)
    with pytest.raises(ModelFileError, match="Install lsys-kit again"):
        course_files()


def test_no_draft_is_left(kit, mine):
    (kit / LESSON).write_text("version 2")
    copy_course(mine, kit)
    assert sorted(os.listdir(mine / "notebooks")) == ["01_lesson.ipynb"]
    assert sorted(os.listdir(mine)) == [MANIFEST, "exercises", "notebooks"]
