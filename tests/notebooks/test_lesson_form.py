"""Every lesson has its form: a vote, predictions, a table to fill, a panel, the vote again, and a page for the teacher."""

from __future__ import annotations

import ast
import re
import tomllib
from collections.abc import Iterator
from functools import cache
from pathlib import Path

import nbformat
import pytest

import lsys_kit
from lsys_kit import compare, explore, limits
from lsys_kit.classroom.catalogue import entry
from lsys_kit.classroom.lessons.lesson import LETTERS, Lesson, declared, names
from lsys_kit.classroom.panel.explorer import Explorer
from tests.notebooks.rebuild import ROOT

LESSONS = ROOT / "notebooks"
TEACHER = LESSONS / "teacher"
POINTS = tomllib.loads((ROOT / "tests" / "classroom" / "points.toml").read_text("utf-8"))["point"]
"""What the works teach, and the lessons that owe it."""
SECTIONS = ("Minutes", "On the board", "Misconceptions", "Answers", "Rubric", "Going on", "Sources")
"""The sections of a teacher's page."""
OPTIONAL = "Optional: "
"""What the heading of a section begins with that is homework, or another hour: it comes after the second vote."""
MOST_LINES = 6
MOST_CONTROLS = 3
"""The sliders of a panel beside that of the step."""
FEW = 12_000
"""The modules of a panel whose sliders are counted, so that its steps are few."""
FIRST_WITH_PYTHON = 8
"""Before this lesson nothing is asked of a student's Python but names, numbers and texts."""
PLAIN = (
    ast.Module,
    ast.ImportFrom,
    ast.alias,
    ast.Expr,
    ast.Assign,
    ast.Call,
    ast.keyword,
    ast.Name,
    ast.Load,
    ast.Store,
    ast.Constant,
    ast.Attribute,
    ast.Subscript,
    ast.List,
    ast.Tuple,
    ast.Dict,
    ast.UnaryOp,
    ast.USub,
    ast.BinOp,
    ast.Add,
    ast.Sub,
    ast.Mult,
    ast.Div,
)

every_lesson = pytest.mark.parametrize("name", names())


@cache
def notebook(name: str) -> nbformat.NotebookNode:
    return nbformat.read(LESSONS / f"{name}.ipynb", as_version=4)


def code(name: str) -> list[str]:
    return [cell.source for cell in notebook(name).cells if cell.cell_type == "code"]


def prose(name: str) -> str:
    return "\n\n".join(cell.source for cell in notebook(name).cells if cell.cell_type == "markdown")


def one_line(text: str) -> str:
    return " ".join(text.split())


def page(name: str) -> str:
    return (TEACHER / f"{name}.md").read_text("utf-8")


def calls(name: str, function: str) -> list[tuple[int, ast.Call]]:
    """The calls of a function in a lesson, each with the number of its code cell."""
    return [
        (number, node)
        for number, source in enumerate(code(name))
        if not source.startswith("%")
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and node.func.id == function
    ]


def given(call: ast.Call) -> list[object]:
    return [each.value if isinstance(each, ast.Constant) else ... for each in call.args]


@every_lesson
def test_a_lesson_has_a_notebook_and_a_page_for_the_teacher(name: str) -> None:
    assert (LESSONS / f"{name}.ipynb").is_file()
    assert (TEACHER / f"{name}.md").is_file()


def test_no_page_for_the_teacher_is_left_over() -> None:
    assert {path.stem for path in TEACHER.iterdir()} <= set(names())
    assert {path.suffix for path in TEACHER.iterdir()} <= {".md"}


@every_lesson
def test_of_each_prediction_it_is_declared_what_came_out(name: str) -> None:
    named = {
        target.id: node.value.value
        for source in code(name)
        if not source.startswith("%")
        for node in ast.walk(ast.parse(source))
        if isinstance(node, ast.Assign) and isinstance(node.value, ast.Constant)
        for target in node.targets
        if isinstance(target, ast.Name)
    }
    asked = [call.args[0] for _, call in calls(name, "predict")]
    questions = [named.get(each.id) if isinstance(each, ast.Name) else ast.literal_eval(each) for each in asked]
    assert questions == [each.question for each in declared(name).predictions]


@every_lesson
def test_code_that_gives_an_answer_away_is_folded(name: str) -> None:
    cells = [cell for cell in notebook(name).cells if cell.cell_type == "code"]
    folded = [cell.metadata.get("jupyter") == {"source_hidden": True} for cell in cells]
    giving_away = {number for number, call in calls(name, "predict") if isinstance(call.args[1], ast.Constant)}
    assert {number for number, each in enumerate(folded) if each} == giving_away


@every_lesson
def test_it_begins_with_title_question_minutes_and_objectives(name: str) -> None:
    lesson, head = declared(name), one_line(prose(name).partition("\n## ")[0])
    assert head.startswith(f"# {lesson.title}")
    assert head.count("# ") == prose(name).count("\n# ") + 1 == 1
    assert f"{lesson.minutes} minutes" in head
    for text in (lesson.question, *lesson.objectives):
        assert text in head


@every_lesson
def test_its_cells_are_short_and_use_public_names(name: str) -> None:
    assert code(name)[0].startswith("from lsys_kit import ")
    assert max(len(source.splitlines()) for source in code(name)) <= MOST_LINES
    assert not re.search(r"lsys_kit\.\w", "\n".join(code(name)))


@every_lesson
def test_no_programming_is_needed_before_lesson_8(name: str) -> None:
    if declared(name).number < FIRST_WITH_PYTHON:
        for source in code(name):
            if not source.startswith("%"):
                assert {type(node).__name__ for node in ast.walk(ast.parse(source)) if not isinstance(node, PLAIN)} == set()


@every_lesson
def test_the_vote_comes_first_and_again_after_all_else(name: str) -> None:
    number, votes = name[:2], calls(name, "vote")
    assert [(given(call), [each.arg for each in call.keywords]) for _, call in votes] == [([number], []), ([number], ["again"])]
    others = [place for function in ("predict", "worksheet", "explore", "compare") for place, _ in calls(name, function)]
    assert votes[0][0] < min(others)
    assert votes[1][0] > max(place for place in others if place not in optional(name))
    assert votes[1][0] < min(optional(name), default=len(code(name))), "who leaves out what is optional has voted again"


def optional(name: str) -> list[int]:
    """The numbers of the code cells in the optional sections of a lesson, which are homework or another hour."""
    found, number, within = [], 0, False
    for cell in notebook(name).cells:
        if cell.cell_type == "code":
            found += [number] if within else []
            number += 1
        elif cell.source.startswith("## "):
            within = OPTIONAL in cell.source.partition("\n")[0]
    return found


@every_lesson
def test_what_is_optional_is_marked_where_it_begins_and_where_it_is_announced(name: str) -> None:
    contents = one_line(prose(name).partition("\n## ")[0])
    for heading in re.findall(rf"^## (.*{OPTIONAL}.*)$", prose(name), re.MULTILINE):
        assert re.fullmatch(rf"\d+ {OPTIONAL}[^:].*", heading)
        assert f"(#{heading.replace(' ', '-')})" in contents
        assert "optional" in page(name)


@every_lesson
def test_something_is_predicted_filled_in_and_moved(name: str) -> None:
    assert len(calls(name, "predict")) >= 2
    assert [given(call)[:2] for _, call in calls(name, "worksheet")] == [[name[:2], each.id] for each in declared(name).tables]
    assert declared(name).tables
    assert [*calls(name, "explore"), *calls(name, "compare")]


@pytest.mark.slow
@every_lesson
def test_a_panel_has_three_sliders_at_most_beside_the_step(name: str) -> None:
    for panel in panels(name):
        assert len(controls(panel)) <= MOST_CONTROLS, controls(panel)


def panels(name: str) -> Iterator[Explorer]:
    """The panels of a lesson, with few steps."""
    known = {each: getattr(lsys_kit, each) for each in lsys_kit.__all__}
    known["explore"] = lambda what, step=None, **choices: explore(what, **choices)
    known["compare"] = lambda *what, step=None, **choices: compare(*what, **choices)
    for number, call in (*calls(name, "read"), *calls(name, "system")):
        for made in ast.parse(code(name)[number]).body:
            if isinstance(made, ast.Assign) and ast.dump(made.value) == ast.dump(call):
                exec(ast.unparse(made), known)
    with limits(modules=FEW):
        for function in ("explore", "compare"):
            for _, call in calls(name, function):
                panel = eval(ast.unparse(call), known)
                yield from (panel,) if function == "explore" else (panel.left, panel.right)


def controls(panel: Explorer) -> list[str]:
    """The sliders of a panel, beside that of the step."""
    model, book = panel.model, panel.model["book"]
    angle = ["angle"] if (book.get("turtle") or {}).get("uses angle") and "angle" not in model["without"] else []
    side = ["around", "above"] if book["mode"] in ("space", "tissue") else []
    return [*(each["name"] for each in model["constants"]), *angle, *side, *(["seed"] if model["chance"] else [])]


@every_lesson
def test_it_ends_with_its_summary_and_its_exercises(name: str) -> None:
    end = one_line(prose(name).rpartition("\n## ")[2])
    assert end.startswith("Summary")
    assert declared(name).summary in end
    assert f"(../exercises/{name}.ipynb)" in end


@every_lesson
def test_it_names_every_system_that_it_teaches(name: str) -> None:
    text = "\n".join([prose(name), *code(name)])
    for id in declared(name).systems:
        assert entry(id).id == id
        assert re.search(rf"\b{id}\b", text), f"{id} is not in the notebook"


@every_lesson
def test_it_teaches_the_points_that_it_owes(name: str) -> None:
    lesson, known = declared(name), {f"{each['work']}: {each['point']}": each["owed"] for each in POINTS}
    assert set(lesson.points) - set(known) == set()
    assert {point for point, owed in known.items() if lesson.number in owed} - set(lesson.points) == set()


@every_lesson
def test_the_page_for_the_teacher_is_complete(name: str) -> None:
    lesson, text = declared(name), page(name)
    assert text.startswith(f"# For the teacher: {lesson.title}\n")
    assert tuple(re.findall(r"^## (.*)$", text, re.MULTILINE)) == SECTIONS
    parts = {part.partition("\n")[0]: one_line(part) for part in text.split("\n## ")[1:]}
    assert f"{lesson.minutes} minutes" in parts["Minutes"]
    for misconception in lesson.misconceptions:
        assert misconception in parts["Misconceptions"]
    for answer in answers(lesson):
        assert answer in parts["Answers"]
    for point in lesson.points:
        assert point.partition(": ")[2] in parts["Sources"]


def answers(lesson: Lesson) -> list[str]:
    """What the answers on a teacher's page must hold: the letter of the right option, and each table with its answers."""
    right = next(letter for letter, each in zip(LETTERS, lesson.vote.options, strict=True) if each.right)
    filled = [blank.right[0] for table in lesson.tables for _, _, blank in table.blanks]
    return [f"**{right}**", *(table.title for table in lesson.tables), *filled]


@every_lesson
def test_nothing_for_the_teacher_stands_in_the_notebook(name: str) -> None:
    assert not re.search(r"for the teacher|rubric|misconception", prose(name), re.IGNORECASE)


def test_a_point_stands_once_in_the_table() -> None:
    assert len({(each["work"], each["point"]) for each in POINTS}) == len(POINTS) == 107


@pytest.mark.parametrize("path", sorted(LESSONS.rglob("*.*")), ids=lambda path: path.name)
def test_links_of_lessons_and_of_pages_for_the_teacher_lead_somewhere(path: Path) -> None:
    text = prose(path.stem) if path.suffix == ".ipynb" and path.parent == LESSONS else path.read_text("utf-8")
    text = re.sub(r"`[^`\n]*`", "", text)  # a word such as I[A](B) is no link
    for link in re.findall(r"\]\((?!https?:|#)([^)#]+)", text) if path.parent != LESSONS / "reference" else ():
        assert (path.parent / link).is_file(), link
