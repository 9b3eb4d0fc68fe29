"""A course of one's own: lessons are found where they lie, begun from a template or a copy, checked, and handed out."""

from __future__ import annotations

import json
import os
import shutil
import zipfile
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from lsys_kit import LSystemError, ModelFileError, ModelNameError, ModelValueError, ask, check, predict, read, vote, worksheet
from lsys_kit.__main__ import main
from lsys_kit.classroom.authoring.check import findings_in
from lsys_kit.classroom.authoring.computed import wrong_calculations
from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.authoring.unpack import unpack
from lsys_kit.classroom.authoring.written import without_marks
from lsys_kit.classroom.course import copy_course, course_files
from lsys_kit.classroom.exercises import registry
from lsys_kit.classroom.exercises.lint import problems_in
from lsys_kit.classroom.lessons.lesson import declared_in, lesson, names
from lsys_kit.classroom.lessons.predicted import outcome
from lsys_kit.classroom.live import questions
from lsys_kit.classroom.live.session import plan
from lsys_kit.classroom.panel.controls import slider_ranges, slider_values
from lsys_kit.classroom.places import VARIABLE, choose_course, course_of, kit_place, places
from lsys_kit.classroom.site.build import build_site

FIBONACCI = "axiom: a\na -> ab\nb -> a"


@pytest.fixture
def ferns(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Iterator[Path]:
    """A new lesson, in the folder in which Python runs."""
    monkeypatch.chdir(tmp_path)
    monkeypatch.delenv(VARIABLE, raising=False)
    monkeypatch.setattr(registry, "_added", {})
    yield write_lesson("ferns", tmp_path / "ferns")
    os.environ.pop(VARIABLE, None)


def change(path: Path, old: str, new: str) -> None:
    text = path.read_text("utf-8")
    assert old in text, old
    path.write_text(text.replace(old, new, 1), "utf-8")


def change_cell(root: Path, old: str, new: str) -> None:
    path = root / "notebooks" / "ferns.ipynb"
    notebook = json.loads(path.read_text("utf-8"))
    cell = next(cell for cell in notebook["cells"] if old in "".join(cell["source"]))
    cell["source"] = "".join(cell["source"]).replace(old, new, 1)
    path.write_text(json.dumps(notebook), "utf-8")


# --- where lessons are found ------------------------------------------------------------------------------------------


@pytest.mark.parametrize("inside", ["", "notebooks", "exercises", "notebooks/teacher"])
def test_a_lesson_is_found_from_wherever_its_notebooks_run(ferns: Path, monkeypatch: pytest.MonkeyPatch, inside: str) -> None:
    monkeypatch.chdir(ferns / inside)
    assert lesson("ferns").title == "Ferns"
    assert vote("ferns").asked["options"][0].startswith("`B -> FB`")
    assert repr(worksheet("ferns", "buds")).startswith("How many?")
    assert outcome("Step 2 has 4 buds. How many has step 4?", "16") == {"answer": "sixteen", "right": True}
    assert check("ferns.2", 64).said == "Correct"
    assert lesson("01").title == "All at once"


def test_one_id_in_two_lessons_is_told_before_anybody_answers(ferns: Path, tmp_path: Path) -> None:
    course = tmp_path / "course"
    shutil.copytree(ferns, course / "ferns")
    write_lesson("buds", course / "buds")
    change(course / "buds" / "exercises" / "buds.toml", '"buds.2"', '"ferns.2"')
    [found] = [each for each in findings_in(course, run=False) if not each.advice]
    assert found.where.startswith("ferns/exercises/ferns.toml, line ")
    assert found.where.endswith("exercise ferns.2")
    assert found.what == 'The exercise "ferns.2" stands in buds/exercises/buds.toml too'


def test_the_exercises_of_a_course_are_those_of_its_lessons(
    ferns: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]
) -> None:
    course = tmp_path / "course"
    shutil.copytree(ferns, course / "ferns")
    (course / "course.toml").write_text('lessons = ["ferns", 1]', "utf-8")
    change(course / "ferns" / "exercises" / "ferns.toml", 'solution = "64"', 'solution = "65"')
    assert main(["exercises", "check", str(course)]) == 2
    assert "exercise ferns.2: The system gives another answer: 64" in capsys.readouterr().out


def test_a_copy_has_the_title_that_it_is_given(ferns: Path, tmp_path: Path) -> None:
    root = write_lesson("strip", tmp_path / "strip", "4", 'A "dragon" in a strip')
    declared = declared_in(course_of(root).places[0], "strip")
    assert declared is not None
    assert declared.title == "A 'dragon' in a strip"
    first = json.loads((root / "notebooks" / "strip.ipynb").read_text("utf-8"))["cells"][0]["source"]
    assert first[0] == '# A "dragon" in a strip\n'
    assert first[2].startswith("*60 minutes")
    assert (root / "notebooks" / "teacher" / "strip.md").read_text("utf-8").startswith('# For the teacher: A "dragon"')
    assert (root / "exercises" / "strip.toml").read_text("utf-8").startswith("title = \"A 'dragon' in a strip\"")


@pytest.mark.slow
def test_pages_of_ones_own_course_name_the_command_that_opens_it(ferns: Path, tmp_path: Path) -> None:
    pages = build_site(tmp_path / "pages", ferns)
    assert all("lsys-kit lab --course ferns<" in page.read_text("utf-8") for page in pages)


@pytest.mark.parametrize(
    ("typed", "hint"),
    [("right = True", "small letters"), ("title = „Farne“", "straight"), ('title = "Ferns', "Is a quotation mark")],
)
def test_what_is_no_toml_is_told_with_what_to_type(ferns: Path, typed: str, hint: str) -> None:
    for file in ("notebooks/ferns.toml", "exercises/ferns.toml"):
        text = (ferns / file).read_text("utf-8")
        (ferns / file).write_text(f"{typed}\n{text}", "utf-8")
        assert any(hint in each.hint for each in findings_in(ferns, run=False))
        (ferns / file).write_text(text, "utf-8")


def test_a_copy_of_the_chosen_course_asks_the_same_and_other_exercises_of_that_name_are_named(
    ferns: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    copy = shutil.copytree(ferns, tmp_path / "copy")
    choose_course(copy)
    monkeypatch.chdir(ferns / "exercises")
    assert check("ferns.2", "64").said == "Correct"
    assert [each.id for each in registry.exercises()].count("ferns.2") == 1
    asked = ferns / "exercises" / "ferns.toml"
    asked.write_text(asked.read_text("utf-8").replace('solution = "64"', 'solution = "65"'), "utf-8")
    with pytest.raises(ModelFileError, match=r'There are 2 exercises with the id "ferns\.2"'):
        check("ferns.2", "64")


def test_a_drawing_of_nothing_is_no_solution_and_every_answer_gets_a_reply(ferns: Path) -> None:
    path = ferns / "exercises" / "ferns.toml"
    nothing = 'id = "ferns.9"\nkind = "drawing"\ntitle = "Draw"\nquestion = "Draw it."\nsolution = """axiom: T\nT -> F"""\n'
    path.write_text(path.read_text("utf-8") + f"\n[[exercise]]\n{nothing}", "utf-8")
    assert any("draws nothing at step 0" in each.what for each in problems_in(path.parent))
    registry.exercises(path.parent)
    assert check("ferns.9", "axiom: F").said != "Correct"


def test_elsewhere_it_is_not_known(ferns: Path) -> None:
    with pytest.raises(ModelNameError, match="There is no lesson"):
        lesson("ferns")
    choose_course(ferns)
    assert lesson("ferns").title == "Ferns"
    assert names() == ("ferns",)
    choose_course(None)
    assert names()[0].startswith("00")


def test_the_lessons_of_the_kit_are_read_by_the_same_code() -> None:
    course = course_of()
    assert [name for _, name in course.lessons] == [*kit_place().names()]
    assert all(declared_in(place, name) == lesson(name) for place, name in course.lessons)
    assert places() == (kit_place(),)


def test_a_change_is_seen_at_once(ferns: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ferns)
    assert lesson("ferns").minutes == 40
    change(ferns / "notebooks" / "ferns.toml", "minutes = 40", "minutes = 45")
    assert lesson("ferns").minutes == 45
    change(ferns / "exercises" / "ferns.toml", 'solution = "64"', 'solution = "63"')
    assert check("ferns.2", 63).said == "Correct"


def test_a_lesson_of_the_folder_comes_before_that_of_the_kit(ferns: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    for path in (*ferns.rglob("ferns.*"),):
        path.rename(path.with_name(path.name.replace("ferns", "01_ferns")))
    monkeypatch.chdir(ferns)
    assert lesson("01").title == "Ferns"
    assert lesson("02").title == "How many"[:8] or lesson("02").number == 2


def test_a_broken_declaration_stops_no_other_lesson(ferns: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.chdir(ferns)
    (ferns / "notebooks" / "ferns.toml").write_text("title = ")
    with pytest.raises(ModelFileError, match=r"ferns\.toml"):
        lesson("ferns")
    assert predict("How many?", "21").prompt.question == "How many?"
    assert lesson("01").number == 1


# --- a course ---------------------------------------------------------------------------------------------------------


def test_a_course_is_a_list_of_own_lessons_and_of_those_of_the_kit(ferns: Path, tmp_path: Path) -> None:
    root = tmp_path / "garden"
    root.mkdir()
    shutil.move(str(ferns), root / "ferns")
    write_lesson("waiting", root / "waiting", "5")
    (root / "course.toml").write_text('title = "My garden"\nlessons = ["waiting", 1, "ferns", "02_how_many"]\n')
    course = course_of(root)
    assert course.title == "My garden"
    assert [name for _, name in course.lessons] == ["waiting", "01_all_at_once", "ferns", "02_how_many"]
    files = [*course_files(root)]
    assert [name for name in files if name.startswith("notebooks/") and name.endswith(".ipynb")] == [
        "notebooks/waiting.ipynb",
        "notebooks/01_all_at_once.ipynb",
        "notebooks/ferns.ipynb",
        "notebooks/02_how_many.ipynb",
    ]
    assert {"exercises/ferns.ipynb", "exercises/ferns.toml", "exercises/01_all_at_once.ipynb", "notebooks/ferns.toml"} <= {
        *files
    }
    assert "notebooks/01_all_at_once.toml" not in files, "what comes with the kit is known to it"


@pytest.mark.parametrize(
    ("text", "says"),
    [
        ('lessons = ["fern"]', 'Did you mean "ferns"'),
        ("lessons = [77]", "there is no lesson 77"),
        ('lessons = ["../elsewhere"]', "there is no lesson"),
        ('lessons = ["ferns", "ferns"]', "the same name"),
        ('lessons = "ferns"', '"lessons" must be a list'),
        ('titel = "x"', 'Did you mean "title"'),
        ("title = ", "course.toml"),
        ("title = 3", '"title" must be a text'),
    ],
)
def test_a_mistake_in_the_list_is_named(ferns: Path, text: str, says: str) -> None:
    (ferns / "course.toml").write_text(text)
    with pytest.raises(ModelFileError) as mistake:
        course_of(ferns)
    assert says in str(mistake.value)


def test_nothing_outside_the_folder_is_read_and_no_link_followed(ferns: Path, tmp_path: Path) -> None:
    (tmp_path / "other").mkdir()
    secret = write_lesson("secret", tmp_path / "other" / "secret")
    (ferns / "secret").symlink_to(secret)
    (ferns / "notebooks" / "stolen.ipynb").symlink_to(secret / "notebooks" / "secret.ipynb")
    assert [name for _, name in course_of(ferns).lessons] == ["ferns"]
    assert not [name for name in course_files(ferns) if "secret" in name or "stolen" in name]


def test_students_get_the_lesson_with_what_it_asks(ferns: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    copied = copy_course(tmp_path / "mine", ferns)
    assert {each.what for each in copied} == {"new"}
    assert not list((tmp_path / "mine").rglob("teacher"))
    monkeypatch.chdir(tmp_path / "mine" / "notebooks")
    assert lesson("ferns").title == "Ferns"
    monkeypatch.chdir(tmp_path / "mine" / "exercises")
    assert check("ferns.1", "F[F[B]B]F[B]B").said == "Correct"


@pytest.mark.parametrize("command", ["site -o out", "lab out", "class --folder out", "collect handed_in -o marks.csv"])
@pytest.mark.parametrize("kind", ["missing", "empty", "a file", "broken", "no rights", "archive"])
def test_a_folder_that_is_no_course_is_told_in_words(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, capsys: pytest.CaptureFixture[str], command: str, kind: str
) -> None:
    monkeypatch.chdir(tmp_path)
    place = tmp_path / ("it.zip" if kind == "archive" else "it")
    if kind in ("a file", "archive"):
        place.write_text("no")
    elif kind != "missing":
        place.mkdir()
    if kind == "broken":
        (place / "course.toml").write_text("[")
    if kind == "no rights" and os.geteuid() == 0:
        pytest.skip("whoever may do everything is refused nothing")
    if kind == "no rights":
        place.chmod(0)
    assert main([*command.split(), "--course", str(place)]) == 2
    told = capsys.readouterr().err
    assert told.startswith("lsys-kit: ")
    assert place.name in told or "course.toml" in told
    assert "Traceback" not in told


@pytest.mark.parametrize("part", ["notebooks", "exercises"])
@pytest.mark.parametrize("is_inside", [False, True])
def test_a_part_that_cannot_be_read_is_told(ferns: Path, monkeypatch: pytest.MonkeyPatch, part: str, is_inside: bool) -> None:
    scandir = os.scandir

    def refused(path: Path) -> Any:
        if Path(path) == ferns / part:
            raise PermissionError(13, "Permission denied")
        return scandir(path)

    monkeypatch.setattr(os, "scandir", refused)
    with pytest.raises(ModelFileError, match="cannot be read: Permission denied"):
        course_of(ferns.parent if is_inside else ferns)


# --- a lesson is begun ------------------------------------------------------------------------------------------------


def test_a_new_lesson_has_nothing_wrong_but_what_is_to_be_replaced(ferns: Path) -> None:
    found = findings_in(ferns, run=False)
    assert {each.what for each in found} == {
        "A sentence of advice from the template stands here still",
        "The exercise is still that of the template",
    }
    change(ferns / "exercises" / "ferns.toml", "the rule is `B -> F[B]B`", "its rule is `B -> F[B]B`")
    assert sum("exercise" in each.what for each in findings_in(ferns, run=False)) == 4
    assert problems_in(ferns) == []
    assert sorted(path.relative_to(ferns).as_posix() for path in ferns.rglob("*.*") if not path.name.startswith(".")) == [
        "exercises/ferns.ipynb",
        "exercises/ferns.toml",
        "notebooks/ferns.ipynb",
        "notebooks/ferns.toml",
        "notebooks/teacher/ferns.md",
    ]


@pytest.mark.parametrize("number", [pytest.param(each, marks=pytest.mark.slow) for each in range(20)])
def test_a_copy_of_a_lesson_is_a_lesson(tmp_path: Path, number: int) -> None:
    root = write_lesson("mine", tmp_path / "mine", str(number))
    assert findings_in(root, run=False) == []
    text = (root / "notebooks" / "mine.ipynb").read_text("utf-8")
    assert f'vote(\\"{number:02}\\"' not in text
    assert declared_in(course_of(root).lessons[0][0], "mine") is not None


@pytest.mark.parametrize("name", ["Ferns", "my-fern", "", "1", "a/b", "../x", "con man", "ö"])
def test_a_lesson_has_the_name_of_a_file(tmp_path: Path, name: str) -> None:
    with pytest.raises(ModelValueError, match="small letters"):
        write_lesson(name, tmp_path / "it")


def test_nothing_is_overwritten(ferns: Path) -> None:
    before = {path: path.read_bytes() for path in ferns.rglob("*") if path.is_file()}
    with pytest.raises(ModelFileError, match="already exists"):
        write_lesson("ferns")
    assert {path: path.read_bytes() for path in ferns.rglob("*") if path.is_file()} == before
    with pytest.raises(ModelNameError, match="The kit has no lesson"):
        write_lesson("other", begin="99")


# --- what a careful colleague would say -------------------------------------------------------------------------------

TOML, EXERCISES, TEACHER = "notebooks/ferns.toml", "exercises/ferns.toml", "notebooks/teacher/ferns.md"
MISTAKES: dict[str, tuple[str, str, str, str]] = {
    "a number of a table": (TOML, "{ right = 32 }", "{ right = 30 }", "stands 30, and the system gives 32"),
    "a given number of a table": (TOML, "[0, 1, 0]", "[0, 1, 1]", "stands 1, and the system gives 0"),
    "a system of a table": (
        TOML,
        'system = "axiom: B\\nB -> F[+B]B", asks = "count B"',
        'system = "K99", asks = "length"',
        "K99",
    ),
    "a slip that is right": (TOML, "{ answer = 9,", "{ answer = 27,", "the slip"),
    "an entry": (TOML, "minutes = 40", "minuts = 40", "minuts"),
    "minutes as a text": (TOML, "minutes = 40", 'minutes = "40"', "minutes"),
    "minutes that cannot hold": (TOML, "minutes = 40", "minutes = 5", "minutes will be needed"),
    "minutes unlike the page": (TOML, "minutes = 40", "minutes = 45", "number of minutes that is declared"),
    "a quotation mark": (TOML, 'title = "Ferns"', 'title = "Ferns', "quotation mark"),
    "two right options": (TOML, 'reply = "Then there', 'right = true\nreply = "Then there', "right = true, not 2"),
    "no right option": (TOML, "right = true\n", "", "right = true, not none"),
    "the same option twice": (
        TOML,
        "`B -> F[+F]B`: a bud makes a piece of stem with a bare side stem",
        "`B -> FB`: a bud makes a piece of stem",
        "are the same",
    ),
    "a long right option": (
        TOML,
        'and a bud at its end."',
        "and a bud at its end" + ", which is what all of the buds do in each step of the way" * 2 + '."',
        "much longer",
    ),
    "a short right option": (
        TOML,
        "`B -> F[+B]B`: a bud makes a piece of stem, a side bud, and a bud at its end.",
        "`B -> F[+B]B`",
        "much shorter",
    ),
    "the rules of the picture": (TOML, 'B -> F[+B]B", step = 5', 'B -> F[+B", step = 5', "picture of the vote cannot be drawn"),
    "a picture without end": (TOML, "step = 5", "step = 90", "picture of the vote cannot be drawn"),
    "the question": (
        TOML,
        'question = "Which rule has grown',
        'question = "Which rule grew',
        "The question that is declared is not on the page",
    ),
    "an objective": (
        TOML,
        '"grow a plant by hand',
        '"draw a plant by hand',
        "The objective that is declared is not on the page",
    ),
    "the summary": (TOML, "double their number in each step.", "double their numbers.", "The summary that is declared"),
    "a prediction, letter for letter": (TOML, "How many has step 4?", "How many has step four?", "is declared and never asked"),
    "the id of a table": (TOML, 'id = "buds"', 'id = "bud"', 'no table "buds"'),
    "another right option": (TEACHER, "**B**", "**C**", "does not name the right option"),
    "a table of the teacher's": (TEACHER, "| 5 | 32 | 31 |", "| 5 | 32 | 30 |", "31 is missing"),
    "minutes of the parts": (TEACHER, "by hand 10", "by hand 25", "take 55 minutes together"),
    "a solution": (EXERCISES, 'solution = "64"', 'solution = "32"', "The system gives another answer"),
    "a solution that is told": (EXERCISES, "Multiply from step to step.", "It is 64.", "A hint contains the solution"),
    "a kind of exercises": (EXERCISES, 'kind = "table"', 'kind = "tabel"', 'Did you mean "table"'),
    "an id twice": (EXERCISES, 'id = "ferns.2"', 'id = "ferns.1"', "too"),
    "an id of the kit": (EXERCISES, 'id = "ferns.2"', 'id = "1.1"', "The kit has an exercise with this id"),
    "no explanation": (
        EXERCISES,
        'explanation = "The number of buds doubles in each step: 1, 2, 4, 8, 16, 32, 64."\n',
        "",
        "Nothing explains",
    ),
    "minutes in a table": (
        TEACHER,
        "40 minutes: mystery and vote 5, by hand 10, let it grow 10, change a rule 10, vote again and summary 5.",
        "| minutes | what |\n|---|---|\n| 15 | the vote |\n| 35 | the rest |",
        "ferns.md, line 5: advice: The parts on the teacher's page take 50 minutes together",
    ),
    "a row of the teacher's": (
        TEACHER,
        "| 3 | 8 | 7 |",
        "| 3 | 8 | 6 |",
        'row "3", column "pieces of stem", and the lesson has 7',
    ),
    "a number of the teacher's": (TEACHER, "27 with", "26 buds with", "says 26 buds, and the lesson has 27"),
    "what is accepted": (TOML, '["16", "sixteen"]', '["16", "eighteen"]', "there is no eighteen in the answer"),
    "a number that has to be met": (
        TOML,
        '["B -> FB", 1],',
        '["B -> FB", { right = "1.25", within = "0.01" }], ["B -> B", { right = "2.25" }],',
        "2.25 has to be met exactly",
    ),
    "a number of a system that the title names": (
        TOML,
        '[[tables]]\nid = "changed"',
        '[[tables]]\nid = "tips"\ntitle = "Tips `*` of `K8`: how many has step 9?"\ncolumns = ["seed", "tips"]\n'
        'rows = [[2, { right = "24" }]]\n\n[[tables]]\nid = "changed"',
        "stands 24, and the system gives 42",
    ),
    "a number of a symbol that the column names": (
        TOML,
        '[[tables]]\nid = "changed"',
        '[[tables]]\nid = "cells"\ntitle = "Where are the cells of `P2`?"\ncolumns = ["step", "B", "C"]\n'
        'rows = [[11, { right = "2" }, { right = "2" }]]\n\n[[tables]]\nid = "changed"',
        'column "C", stands 2, and the system gives 1',
    ),
    "an explanation": (EXERCISES, "8, 16, 32, 64.", "8, 16, 32, 46.", "The explanation says 46, and the solution is 64"),
    "a decimal comma": (TOML, '["B -> F[+F]B", { right = 1 }]', '["B -> F[+F]B", { right = "1,5" }]', "whoever types 1.5"),
    "a unit": (
        EXERCISES,
        "How many buds has step 6?",
        "How many, in steps, has step 6?",
        'asks for steps, and the unit is "buds"',
    ),
    "a calculation of an exercise": (
        EXERCISES,
        "8, 16, 32, 64.",
        "8, 16, 32, 64, which is 27/256, about 0.15.",
        "27/256 ≈ 0.15; it comes to 0.105",
    ),
    "a rule of an exercise": (
        EXERCISES,
        'question = "The axiom is `B`, and the rule is `B -> F[B]B`.',
        'question = "The axiom is `B`, and the rule is\\n\\n    B -> F[B]\\n\\nHere `B` is a bud.',
        "has the rule B -> F[B], and the system has B -> F[B]B",
    ),
    "a section of the teacher's": (
        TEACHER,
        "## On the board",
        "Open the predictions in sections 2, 3 and 4.\n\n## On the board",
        "has a prediction in section 3, and none",
    ),
    "a vote of the teacher's": (
        TEACHER,
        "## On the board",
        "Open the first vote in section 2, the tables in sections 3 and 4.\n\n## On the board",
        "has a vote in section 2, and none",
    ),
    "a reply that says what is right": (
        TOML,
        "Then there is one bud for ever",
        "No, the right one is B",
        "option A says that B",
    ),
    "a word of a hint": (
        EXERCISES,
        "The F of step 1 stays as it is.",
        "Step 1 is F[B]F.",
        "The word of step 1 is said to be F[B]F, and the system makes F[B]B",
    ),
    "a count that is predicted": (TOML, 'answer = "nine"', 'answer = "seven"', "Step 2 is said to have seven"),
    "an objective that is not tested": (EXERCISES, "objective = 1", "objective = 2", "No exercise tests objective 1"),
}
REPLY = "Wherever a bud was, two stand in the next step: one turned to the side, one straight on."
"""What is said to those who vote for the right option."""
OPTION = "A bud makes a piece of stem, a side bud, and a bud at its end."
WORDS = "| step | word |\n|---|---|\n| 0 | `B` |\n| 1 | `F[+B]B` |\n| 2 | `F[+F[+B]B]F[+B]` |"
WORDS_OF_STEPS = (
    "\n\n| n | |\n|---|---|\n| 0 | `B` |\n| 1 | `F[+B]B` |\n| 2 | `F[+F[+B]B]F[+B]` |\n"
    "| 3 | `F[+F[+F[+B]B]F[+B]B]F[+F[+B]B]F[+B]B` |\n\n"
)
IN_CELLS: dict[str, tuple[str, str, str]] = {
    "a section that there is not": ("Now let a bud", "As in section 9, let a bud", "There is no section 9"),
    "a system that there is not": ("Now let a bud", "As in `K110`, let a bud", 'Did you mean "K11"?'),
    "a slider to be moved on": ("Move the slider **step**", "Move **roll** on", 'slider "roll" is to be moved'),
    "another vote": ('vote("ferns")', 'vote("fern")', 'Did you mean "ferns"'),
    "the vote of another lesson": ('vote("ferns")', 'vote("01")', 'asks the vote of the lesson "01"'),
    "another table": ('worksheet("ferns", "buds"', 'worksheet("ferns", "bud"', 'has no table "bud"'),
    "no second vote": ('vote("ferns", again=True)', "plant", "does not come again"),
    "another prediction": ("How many has step 4?", "How many has step 5?", "not declared what came out"),
    "no Python": ("plant = read('''", "plant = = read('''", "This is no Python"),
    "a link": ("../exercises/ferns.ipynb", "../exercises/fern.ipynb", "leads nowhere"),
    "a link to a heading": ("**Look.**", "[there](#6-Nowhere) **Look.**", "There is no heading"),
    "a picture without a text": ("**Look.**", "![](pictures/fern.png) **Look.**", "no text for those who cannot see"),
    "a picture that is not there": ("**Look.**", "![a fern](pictures/fern.png) **Look.**", "There is no picture"),
    "code with the answer": ("draw(plant, 4)", '"16"', "gives its answer away"),
    "the right option before the vote": ("all at the same time.", OPTION, "Words of the right option stand on the page"),
    "an answer with its noun": ("Take the rule", "There will be 16 buds. Take the rule", 'The answer "16" stands on the page'),
    "an open answer": ("**Look.** If", "How many?\n\nWith the changed rule step 2 has 9.\n\nIf", "stands open"),
    "a fold without an end": ("</details>", "", "This <details> has no </details>"),
    "an end without a fold": ("**Look.**", "</details> **Look.**", "This </details> has no <details>"),
    "a calculation": ("**Look.**", "Look: 2 · 2 · 2 · 2 = 18 buds. **Look.**", "2 · 2 · 2 · 2 = 18; it comes to 16"),
    "a word of a step": ("**Look.**", "Step 1 is `F[-B]B`. **Look.**", "step 1 is said to be F[-B]B, and the system makes"),
    "a row of words": ("in each step.", f"in each step.\n\n{WORDS}", "F[+F[+B]B]F[+B], in the row of step 2, does not follow"),
    "a panel that is not there": ("**Look.**", "See the panel of section 1. **Look.**", "Section 1 has no panel"),
    "digits that are exchanged": ("If you have said 8", "There are 61. If you have said 8", "says 61, and the answer"),
    "a sign of a rule": ("B -> F[+B]B'''", "B -> F[-B]B'''", "stands in no text, and one sign of it"),
    "a step too far": ("Move the slider **step**", "Drag the slider **step** from 0 to 50", "The step is to be 50"),
    "an angle too far": ("Move the slider **step**", "Set the angle to 200, move **step**", "The angle is to be 200"),
    "what is to be done": ("**Look.**", "TODO a picture **Look.**", "Something is unfinished: TODO"),
    "a count of a step": ("**Look.**", "Step 7 has 182 buds. **Look.**", "said to have 182, and the system makes 128"),
    "a sum": ("**Look.**", "Together 2 buds and 3 pieces, which are 6 parts. **Look.**", "2 + 3 = 6; it comes to 5"),
    "a rule of the section": ("**Look.**", "The only rule is `B -> F[+B`. **Look.**", "B -> F[+B, and the system has B"),
    "a rule in words": (
        "**Look.**",
        "Each `F` is replaced by `F` and each `B` by `B`. **Look.**",
        "the rule is B -> B, and the system has B -> F[+B]B",
    ),
    "a rule of the catalogue": ("**Look.**", "`K5` has the rule `F -> F[-F`. **Look.**", "rule is F -> F[-F, and the system"),
    "a fold": ("**Look.**", "<details><summary>So?</summary>\n\nTen. See:\n\n</details> **Look.**", "says Ten, and the answer"),
    "a power in raised signs": ("**Look.**", "Look: 2<sup>3</sup> = 9. **Look.**", "2^(3) = 9; it comes to 8"),
    "a word twice": ("**Look.**", "The the buds. **Look.**", 'A word stands twice: "The the"'),
    "a level of headings": ("## 2 By hand", "#### 2 By hand", "is of level 4, and the one before it of level 2"),
    "a lesson that there is not": ("**Look.**", "As in lesson 27. **Look.**", "There is no lesson 27"),
    "a turn": ("by 30 degrees", "by 60 degrees", "said to be 60 degrees, and the systems of this lesson turn by 30"),
    "a few cells": ("**Look.**", "Step 2 has 11 buds. **Look.**", "said to have 11 buds, and the system makes"),
    "a slider without a value": ("Move the slider **step**", "Move only **w** and **step**", 'The slider "w" is to be moved'),
    "a word that comes of another": (
        "**Look.**",
        "By `B -> F[+B]B` and the word `F B` the new word is `F F[+B]`. **Look.**",
        "F F[+B] is said to come of F B in one step",
    ),
    "a word of a table of the system's": (
        "**Look.**",
        f"{WORDS_OF_STEPS} **Look.**",
        "word of step 2 is said to be F[+F[+B]B]F[+B], and the system makes",
    ),
    "the right reply before the vote": ("all at the same time.", REPLY, "Words of the reply to the right option stand"),
}  # fmt: skip


@pytest.mark.slow
@pytest.mark.parametrize("mistake", MISTAKES)
def test_a_mistake_in_a_file_is_found(ferns: Path, mistake: str) -> None:
    file, old, new, says = MISTAKES[mistake]
    change(ferns / file, old, new)
    found = [str(each) for each in findings_in(ferns, run=False)]
    assert any(says in each for each in found), found


@pytest.mark.slow
@pytest.mark.parametrize("mistake", IN_CELLS)
def test_a_mistake_in_a_cell_is_found(ferns: Path, mistake: str) -> None:
    old, new, says = IN_CELLS[mistake]
    change_cell(ferns, old, new)
    found = [str(each) for each in findings_in(ferns, run=False)]
    assert any(says in each and "ferns.ipynb, cell" in each for each in found), found


def test_what_is_right_of_a_system_is_not_found(ferns: Path) -> None:
    counts = "Step 7 has 128 buds, step 8 has 900 parts more. Together 2 buds and 3 pieces, which are 5 parts."
    rules = "So that the rule is `F -> FF`. `K5` has the rule `F -> F[+F]F[-F]F`. Each `B` is replaced by `F[+B]B`."
    said = "Step 2 has 4 buds, as in lesson 7, and I knew that that is 3/8, about 0.38. `+` turns it by 30 degrees."
    fold = "<details><summary>So?</summary>\n\nSixteen. See:\n\n</details>"
    before = findings_in(ferns, run=False)
    change_cell(ferns, "**Look.**", f"{counts} {rules} {said}\n\n{fold}\n\n**Look.**")
    assert {each.what for each in findings_in(ferns, run=False)} == {each.what for each in before}


def test_a_vote_in_a_cell_of_text_is_never_asked(ferns: Path) -> None:
    path = ferns / "notebooks" / "ferns.ipynb"
    notebook = json.loads(path.read_text("utf-8"))
    at = next(at for at, cell in enumerate(notebook["cells"]) if 'vote("ferns")' in "".join(cell["source"]))
    kept = {key: notebook["cells"][at][key] for key in ("id", "metadata", "source")}
    notebook["cells"][at] = kept | {"cell_type": "markdown"}
    path.write_text(json.dumps(notebook), "utf-8")
    found = [str(each) for each in findings_in(ferns, run=False)]
    assert any("cell 3: advice: This text is code, which is not run: vote(...)" in each for each in found), found
    assert any("is never asked a first time" in each for each in found), found


def test_what_stands_before_its_question_or_its_explanation_is_found(ferns: Path) -> None:
    change(ferns / TOML, 'answer = "sixteen"', 'answer = "sixteen buds in all"')
    change_cell(ferns, "Take the rule", "There are sixteen buds in all. Take the rule")
    change_cell(ferns, "**Look.** If", "The **axiom** is the first word. If")
    change_cell(ferns, "A bud `B` grows", "With the axiom a bud `B` grows")
    found = " ".join(map(str, findings_in(ferns, run=False)))
    assert 'The answer "sixteen buds in all" stands on the page before its question' in found
    assert '"axiom" is used before it is explained' in found


def test_a_word_that_is_called_something_later_may_not_be_used_before(ferns: Path) -> None:
    change_cell(ferns, "**Look.** If", "Such a bud is called a **sleeper**. If")
    assert not any("sleeper" in str(each) for each in findings_in(ferns, run=False))
    change_cell(ferns, "A bud `B` grows", "A sleeper `B` grows")
    assert any('"sleeper" is used before it is explained' in str(each) for each in findings_in(ferns, run=False))


def test_a_count_that_is_not_the_declared_one_is_found(ferns: Path) -> None:
    change(ferns / TOML, "How many has step 4?", "How many buds has step 4?")
    change_cell(ferns, "How many has step 4?", "How many buds has step 4?")
    change_cell(ferns, "**Look.** If", "There are 12 buds, of 40 in all. If")
    assert any("The text says 12 buds, and the answer" in str(each) for each in findings_in(ferns, run=False))
    change_cell(ferns, "There are 12 buds", "There are 12 buds in step 3, and sixteen")
    assert not any("The text says" in str(each) for each in findings_in(ferns, run=False))


def test_a_part_of_a_whole_that_no_table_has_is_found(ferns: Path) -> None:
    change(ferns / TOML, 'title = "How many buds has step 3?"', 'title = "Of 100 buds, how many?"')
    change_cell(ferns, "## 5 Vote again", "Of course 27 of 100 buds. And 28 of 100 buds?\n\n## 5 Vote again")
    assert [
        str(each) for each in findings_in(ferns, run=False) if "of 100" in str(each) and "The text says 2" in str(each)
    ] == [
        'ferns.ipynb, cell 15, line 1: advice: The text says 28 of 100 buds, and the table "changed" has no such number. '
        "Change the one that is wrong."
    ]


@given(st.integers(0, 999), st.integers(1, 99), st.integers(2, 30), st.integers(1, 4), st.integers(-3, 3))
def test_a_calculation_is_found_where_it_is_wrong(a: int, b: int, c: int, places: int, off: int) -> None:
    assert bool([*wrong_calculations(f"so {a} + {b} · {c} = {a + b * c + off:,} cells")]) is (off != 0)
    assert bool([*wrong_calculations(f"*q* = {a + b * c + off} = ({a} + {b}·{c})")]) is (off != 0)
    assume((Fraction(a, c) * 10**places).denominator != 2)  # halfway, of which both neighbours are rounded values
    rounded = round(Fraction(a, c), places) + Fraction(off, 10**places)
    assert bool([*wrong_calculations(f"| {a}/{c} ≈ {float(rounded):.{places}f} |")]) is (off != 0)


@pytest.mark.parametrize(
    "text",
    [
        "2³ + 10 = 18", "1/(1 - *q*) = 5 + 1", "2 *q* + 3 = 5", "ln 2 = 0.693 + 0", "√2 · 2 = 2.83", "8 · 8 · 8 · 8 = 4.096",
        "2,5 · 2 = 5", "n = 3, 2 · 3 = 6", "5 · 181 ≈ 900", "x - 3 = 5 - 1", "1 + 2 = 3 x", "2 · 3 = 6%", "2 + 3 +\n4 · 5 = 25",
        "10^999999999 = 5 + 1", "`2 + 2` = 5 + 1", "P2 + 1 = 5 + 9", "1 / 0 = 5 + 2", "2 + 2 = `x`",
    ],
)  # fmt: skip
def test_what_is_right_or_cannot_be_worked_out_is_no_wrong_calculation(text: str) -> None:
    assert [*wrong_calculations(without_marks(text))] == []


def test_advice_that_was_looked_at_is_not_said_again(ferns: Path) -> None:
    change(ferns / TOML, "minutes = 40", 'accepted = ["the template"]\nminutes = 40')
    assert findings_in(ferns, run=False) == []


@pytest.mark.slow
@pytest.mark.parametrize(
    ("old", "new", "says"),
    [
        ("axiom: B\n", "axiom: B C(\n", "cell 5: The cell fails"),
        ("explore(plant, 3)", "explore(plants, 3)", "cell 9: The cell fails: NameError"),
        ("Move the slider **step**", "Set *turn* to 40, move the slider **step**", 'The slider "turn" is to be moved'),
    ],
)
def test_what_fails_or_is_not_reached_is_found_by_running(ferns: Path, old: str, new: str, says: str) -> None:
    change_cell(ferns, old, new)
    assert any(says in str(each) for each in findings_in(ferns)), [*map(str, findings_in(ferns))]


@pytest.mark.slow
def test_a_kernel_that_dies_costs_no_other_finding(ferns: Path) -> None:
    change_cell(ferns, "plant = read('''", "import os\nos._exit(1)\nplant = read('''")
    change_cell(ferns, "../exercises/ferns.ipynb", "../exercises/fern.ipynb")
    found = [str(each) for each in findings_in(ferns)]
    assert any("has died" in each for each in found), found
    assert any("leads nowhere" in each for each in found), found


@pytest.mark.parametrize(("last", "found"), [("10", False), ("12", True), ("10-15", False), ("15 min", True)])
def test_minutes_are_added_up_wherever_their_column_is(ferns: Path, last: str, found: bool) -> None:
    text = (ferns / TEACHER).read_text("utf-8")
    rows = f"| part | time |\n|---|---:|\n| vote | 5 min |\n| hands | 25 |\n| the rest | {last} |\n| **Total** | 40 |\n"
    (ferns / TEACHER).write_text(text.replace("40 minutes: mystery", f"{rows}\nIt begins"), "utf-8")
    assert any("minutes together" in str(each) for each in findings_in(ferns, run=False)) is found


def test_a_list_of_rules_that_is_not_the_systems_is_found(ferns: Path) -> None:
    change_cell(ferns, "B -> F[+B]B'''", "B -> F[+C]B\nC -> DB\nD -> F'''")
    change_cell(ferns, "**Look.** If", "The rules are `B -> F[+C]B`, `C -> DB` and `D -> B`. If")
    found = [str(each) for each in findings_in(ferns, run=False)]
    assert any("one is another one than in cell 5: D -> B; there it is D -> F" in each for each in found), found
    change_cell(ferns, "`D -> B`", "`D -> F`")
    assert not any("one is another one" in str(each) for each in findings_in(ferns, run=False))


@pytest.mark.parametrize("value", ["2.5", "3", "-1", "0.7"])
def test_the_range_that_is_proposed_has_the_value(ferns: Path, value: str) -> None:
    change_cell(ferns, "angle: 30\n", "angle: 30\nlong = 1 in 0.5 .. 2.4 by 0.5\n")
    change_cell(ferns, "B -> F[+B]B", "B -> F(long)[+B]B")
    change_cell(ferns, "Move the slider **step**", f"Put **long** to {value}. Move the slider **step**")
    said = next(str(each) for each in findings_in(ferns, run=False) if "slider goes" in str(each))
    assert f'"long" is to be {value}, ' in said, said
    declared = said.partition("that has it: ")[2].removesuffix(".")
    assert Fraction(value) in slider_values(slider_ranges(read(f"{declared}\naxiom: F(long)"), {})["long"])


@pytest.mark.slow
def test_a_value_that_a_slider_does_not_reach_is_found(ferns: Path) -> None:
    change_cell(ferns, "angle: 30\n", "angle: 30\nlong = 1 in 0 .. 2 by 0.5\n")
    change_cell(ferns, "B -> F[+B]B", "B -> F(long)[+B]B")
    change_cell(ferns, "Move the slider **step**", "Set *long* to 1.3. Move the slider **step**")
    found = [str(each) for each in findings_in(ferns)]
    assert any('"long" is to be 1.3, and its slider goes from 0 to 2, with 1.5 nearest' in each for each in found), found


@pytest.mark.slow
def test_the_lessons_of_the_kit_pass() -> None:
    assert [*map(str, findings_in(run=False))] == []


@pytest.mark.slow
@pytest.mark.parametrize("content", [b"", b"{}", b"[]", b"\xff\xfe", b"[" * 100_000, b'{"cells": 3}', b'{"cells": [{}]}'])
def test_a_notebook_that_is_none_is_told_in_words(ferns: Path, content: bytes) -> None:
    (ferns / "notebooks" / "ferns.ipynb").write_bytes(content)
    found = findings_in(ferns, run=False)
    assert any("is no notebook" in str(each) for each in found), [*map(str, found)]


def test_a_file_too_large_is_told_in_words(ferns: Path) -> None:
    (ferns / TOML).write_bytes(b"#" * 2_000_000)
    assert any("more than 1,000,000 bytes" in str(each) for each in findings_in(ferns, run=False))


# --- without files ----------------------------------------------------------------------------------------------------


def test_a_vote_of_ones_own_is_kept_and_answered() -> None:
    first = vote("Which is the word?", ["a", "ab", "aba"], right="C", replies=["No.", "No: more.", "Yes."])
    first.chosen = 1
    assert first.said["text"].startswith("Your vote, B, is kept.")
    again = vote("Which is the word?", again=True)
    again.chosen = 2
    assert (again.said["verdict"], again.said["text"]) == ("Right", "Yes.")
    assert vote("Which is the word?", ["a", "ab", "aba"], right="aba").chosen == 1
    first.chosen = again.chosen = -1


def test_a_vote_may_have_no_right_answer() -> None:
    box = vote("Which do you like?", ["oak", "beech"], again=True)
    box.chosen = 0
    assert "verdict" not in box.said
    box.chosen = -1


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ((["a"],), "2 to 6 different options"),
        ((["a", "a"],), "2 to 6 different options"),
        ((["a", "b", "c", "d", "e", "f", "g"],), "2 to 6 different options"),
        (("ab",), "list of texts"),
        (([1, 2],), "list of texts"),
        ((["a", "b"], "C"), "a letter up to B"),
        ((["a", "b"], 1), "a letter up to B"),
        ((["a", "b"], "A", "picture"), "picture"),
        ((["a", "b"], "A", None, ["one"]), "2 options and 1 replies"),
    ],
)
def test_a_vote_of_ones_own_says_what_it_needs(given: tuple[object, ...], says: str) -> None:
    with pytest.raises(ModelValueError, match=says):
        vote("Which?", *given)  # type: ignore[arg-type]


def test_a_table_of_ones_own_counts_in_a_system() -> None:
    sheet = worksheet(columns=["step", "a", "cells"], rows=[[0, 1, 1], [5, ..., ...]], system=read(FIBONACCI))
    sheet.asked = {"number": 1, "entries": ["8", "14"]}
    assert sheet.result["marks"] == ["right", "not yet"]
    sheet = worksheet(columns=["tree", "leaves"], rows=[["oak", {"right": ["many", "a lot"]}]], title="How many?")
    sheet.asked = {"number": 1, "entries": ["a lot"]}
    assert sheet.result["marks"] == ["right"]


@pytest.mark.parametrize(
    ("given", "says"),
    [
        ({"columns": ["a", "b"]}, "needs columns and rows"),
        ({"columns": ["a", "b"], "rows": [["x"]]}, "must have 2 cells"),
        ({"columns": ["a", "b"], "rows": [["x", "y"]]}, "no cell to fill"),
        ({"columns": ["step", "b"], "rows": [[3, ...]]}, "Nothing is known of a cell"),
        ({"columns": ["step", "b"], "rows": [["x", ...]], "system": FIBONACCI}, "must be a step"),
        ({"columns": ["step", "b"], "rows": [[3, {"rihgt": 3}]]}, "rihgt"),
        ({"columns": ["step", "b"], "rows": 3}, "needs columns and rows"),
        ({"columns": ["step", "z"], "rows": [[3, ...]], "system": FIBONACCI}, '"z" cannot be counted in this system'),
    ],
)
def test_a_table_of_ones_own_says_what_it_needs(given: dict[str, object], says: str) -> None:
    with pytest.raises(LSystemError, match=says):
        worksheet(**given)  # type: ignore[call-overload]


def test_a_question_about_a_system_knows_its_answer_and_its_misconceptions() -> None:
    asked = ask("How many cells has step 7?", system=FIBONACCI)
    asked.asked = {"number": 1, "entries": ["34"]}
    assert asked.result["marks"] == ["right"]
    asked.asked = {"number": 2, "entries": ["21"]}
    assert asked.result["marks"] == ["not yet"]
    assert "one step too early" in " ".join(asked.result["notes"])
    assert ask("How many?", FIBONACCI, count="a", step=3).asked == {}
    assert ask("How many?", FIBONACCI, count="b", step=0).asked == {}, "a symbol that a later step has"


@pytest.mark.parametrize(
    ("call", "says"),
    [
        (lambda: ask("How many?", FIBONACCI), "names no step"),
        (lambda: ask(3, FIBONACCI), "must be a text"),  # type: ignore[arg-type]
        (lambda: ask("How many has step 3?", "no such system"), "no such system"),
        (lambda: ask("How many?", FIBONACCI, step=-1), "whole number"),
        (lambda: ask("How many?", FIBONACCI, step=10**6), "whole number"),
        (lambda: ask("How many?", FIBONACCI, count="z", step=3), '"z" cannot be counted'),
    ],
)
def test_a_question_about_a_system_says_what_it_needs(call: Callable[[], object], says: str) -> None:
    with pytest.raises(LSystemError, match=says):
        call()


# --- a class, marks, packages -----------------------------------------------------------------------------------------


def test_a_class_may_open_what_a_lesson_of_ones_own_asks(ferns: Path) -> None:
    choose_course(ferns)
    for cached in (questions.questions, questions.predictions):
        cached.cache_clear()
    try:
        found = questions.questions()
        assert {kind for kind, _ in found} == {"vote", "prediction", "table", "exercise"}
        assert found["vote", "ferns"].page == "notebooks/ferns.html"
        assert questions.right_option("ferns") == 1
        assert questions.named("table", "ferns", lesson("ferns").tables[0].title).about == "ferns:buds"
        assert questions.about_prediction("Step 2 has 4 buds. How many has step 4?") == "ferns:1"
        assert [row["lesson"] for row in plan()] == ["ferns"]
    finally:
        choose_course(None)
        for cached in (questions.questions, questions.predictions):
            cached.cache_clear()


@pytest.mark.slow
def test_answers_that_were_handed_in_are_marked(ferns: Path, tmp_path: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (tmp_path / "handed_in").mkdir()
    cell = {"cell_type": "code", "source": 'answer = 64\ncheck("ferns.2", answer)'}
    (tmp_path / "handed_in" / "ann.ipynb").write_text(json.dumps({"cells": [cell]}))
    assert main(["collect", "handed_in", "--course", "ferns", "-o", "marks.csv"]) == 0
    assert (tmp_path / "marks.csv").read_text().splitlines()[1] == "ann,1.0,1.0,"


def test_exercises_are_packed_and_written_with_their_questions(
    ferns: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    assert main(["exercises", "scorm", "ferns", "-o", "ferns.zip"]) == 0
    (tmp_path / "elsewhere").mkdir()
    monkeypatch.chdir(tmp_path / "elsewhere")
    assert main(["exercises", "scorm", "ferns", "--course", "../ferns", "-o", "ferns.zip"]) == 0
    monkeypatch.chdir(tmp_path)
    assert main(["exercises", "notebooks", "ferns", "-o", "new/folder"]) == 0
    assert (tmp_path / "new" / "folder" / "questions" / "ferns.toml").read_bytes() == (ferns / EXERCISES).read_bytes()


def test_an_exercise_without_hints_and_explanation_is_used(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    (tmp_path / "q").mkdir()
    text = 'title = "Mine"\n[[exercise]]\nid = "q.1"\ntitle = "Two"\nkind = "number"\nquestion = "1 + 1?"\nsolution = "2"\n'
    (tmp_path / "q" / "mine.toml").write_text(text)
    monkeypatch.chdir(tmp_path)
    assert problems_in("q")
    assert all(each.advice for each in problems_in("q"))
    assert main(["exercises", "check", "q"]) == 0
    assert main(["exercises", "notebooks", "q", "-o", "nb"]) == 0
    text = (tmp_path / "nb" / "mine.ipynb").read_text("utf-8")
    assert "hint=1" not in text
    assert "../notebooks/" not in text


# --- archives ---------------------------------------------------------------------------------------------------------


def archive(path: Path, files: dict[str, bytes], link: str = "") -> Path:
    with zipfile.ZipFile(path, "w", zipfile.ZIP_DEFLATED) as made:
        for name, content in files.items():
            info = zipfile.ZipInfo(name)
            info.external_attr = (0o120777 if name == link else 0o644) << 16
            made.writestr(info, content)
    return path


def test_a_lesson_that_was_packed_is_the_same_when_it_is_unpacked(ferns: Path, tmp_path: Path) -> None:
    packed = shutil.make_archive(str(tmp_path / "sent"), "zip", tmp_path, "ferns")
    root, cells, notebooks = unpack(Path(packed))
    assert (cells > 8, notebooks) == (True, 2)
    kept = {path.relative_to(ferns): path.read_bytes() for path in ferns.rglob("*.*") if path.is_file() and path.name[0] != "."}
    assert {path.relative_to(root): path.read_bytes() for path in root.rglob("*.*") if path.is_file()} == kept
    with pytest.raises(ModelFileError, match="already exists"):
        unpack(Path(packed))


@pytest.mark.parametrize("name", ["../out.md", "/etc/out.md", "notebooks/../../out.md", "C:\\out.md"])
def test_an_archive_that_leads_out_of_its_folder_is_refused(tmp_path: Path, name: str) -> None:
    sent = archive(tmp_path / "sent.zip", {"notebooks/ferns.ipynb": b'{"cells": []}', name: b"x"})
    with pytest.raises(ModelFileError, match="has a file outside of it"):
        unpack(sent, tmp_path / "in" / "it")
    assert [*tmp_path.rglob("*")] == [sent]


@pytest.mark.parametrize("name", ["notebooks/con.md", ".ssh/x.md", "run.py", "a/b/c/d/e/f.md"])
def test_nothing_leaves_the_folder_and_no_program_is_taken(tmp_path: Path, monkeypatch: pytest.MonkeyPatch, name: str) -> None:
    monkeypatch.chdir(tmp_path)
    sent = archive(
        tmp_path / "sent.zip",
        {"notebooks/ferns.ipynb": b'{"cells": []}', name: b"x", "notebooks/l.md": b"/etc"},
        "notebooks/l.md",
    )
    unpack(sent, tmp_path / "in" / "it")
    assert [path.name for path in tmp_path.rglob("*") if path.is_file()] == ["sent.zip", "ferns.ipynb"]


@pytest.mark.slow
@pytest.mark.usefixtures("kernels")
def test_copies_of_the_kits_notebooks_are_its_lessons_in_a_course_of_ones_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    course = tmp_path / "course"
    for name in ("notebooks/01_all_at_once.ipynb", "exercises/01_all_at_once.ipynb"):
        (course / name).parent.mkdir(parents=True)
        shutil.copy(course_files()[name], course / name)
    monkeypatch.setenv(VARIABLE, "")
    choose_course(course)
    assert lesson("01").title == "All at once"
    build_site(tmp_path / "pages", course)
    index = (tmp_path / "pages" / "index.html").read_text("utf-8")
    assert "<span>1</span>" in index
    assert "Three programs" in index


@pytest.mark.parametrize("content", [b"", b"PK\x03\x04", b"no archive", b"PK\x05\x06" + b"\0" * 18])
def test_what_is_no_archive_is_told_in_words(tmp_path: Path, content: bytes) -> None:
    (tmp_path / "sent.zip").write_bytes(content)
    with pytest.raises(ModelFileError):
        unpack(tmp_path / "sent.zip", tmp_path / "it")
    assert not (tmp_path / "it").exists()


@pytest.mark.slow
def test_a_bomb_is_refused_before_it_is_written(tmp_path: Path) -> None:
    sent = archive(tmp_path / "sent.zip", {"notebooks/ferns.ipynb": b"0" * 30_000_000})
    with pytest.raises(ModelFileError, match="too large"):
        unpack(sent, tmp_path / "it")
    assert not (tmp_path / "it").exists()
