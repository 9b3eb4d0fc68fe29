"""A class with nbgrader: its three commands on submissions that are right, partly right, wrong, broken, malicious, endless."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest

from lsys_kit import check, score
from lsys_kit.classroom.exercises import progress as scores
from lsys_kit.classroom.exercises.notebooks import exercise_notebook
from lsys_kit.classroom.exercises.registry import lessons

LESSON = next(lesson for lesson in lessons() if lesson.name.startswith("01"))
FIRST, SECOND = LESSON.exercises[:2]
ALMOST = "al al br"
POINTS = len(LESSON.exercises)
CONFIG = """\
c = get_config()
c.CourseDirectory.course_id = "plants"
c.Execute.timeout = 10
"""


def _right(exercise):
    return f'answer = """{exercise.solution}"""\ncheck("{exercise.id}", answer)'


SUBMISSIONS = {
    "right": {exercise.id: _right(exercise) for exercise in LESSON.exercises},
    "partly": {FIRST.id: _right(FIRST), SECOND.id: f'check("{SECOND.id}", "...")'},
    "almost": {FIRST.id: f'answer = "{ALMOST}"\ncheck("{FIRST.id}", answer)'},
    "untouched": {},
    "broken": {FIRST.id: "answer = (((", SECOND.id: _right(SECOND)},
    "malicious": {FIRST.id: 'score = lambda _: 1\ncheck = score\ncheck("1.1", "")'},
    "endless": {FIRST.id: "while True: pass", SECOND.id: _right(SECOND)},
}
"""For each student what stands in the cells of answers."""
SCORES = {"right": POINTS, "partly": 1, "almost": 0, "untouched": 0, "broken": 1, "malicious": 0, "endless": 1}


def _submission(release: str, answers: dict[str, str]) -> str:
    notebook = json.loads(release)
    for cell in notebook["cells"]:
        for number, source in answers.items():
            if cell["id"] == f"exercise-{number.replace('.', '-')}-answer":
                cell["source"] = source
    return json.dumps(notebook)


def _nbgrader(course: Path, *command: str) -> str:
    home = {"HOME": str(course), "PYTHONPATH": os.pathsep.join(filter(None, sys.path))}
    run = subprocess.run(
        [sys.executable, "-m", "nbgrader", *command],
        cwd=course,
        capture_output=True,
        text=True,
        check=False,
        env={**os.environ, **home},
    )
    return run.stdout + run.stderr


@pytest.mark.slow
def test_nbgrader_marks_a_class(tmp_path, monkeypatch):
    commands = os.path.dirname(sys.executable)  # nbgrader calls alembic, which is installed beside it
    monkeypatch.setenv("PATH", f"{commands}{os.pathsep}{os.environ['PATH']}")
    (tmp_path / "nbgrader_config.py").write_text(CONFIG, encoding="utf-8")
    source = tmp_path / "source" / "lesson" / "lesson.ipynb"
    source.parent.mkdir(parents=True)
    source.write_text(exercise_notebook(LESSON), encoding="utf-8")
    said = _nbgrader(tmp_path, "generate_assignment", "lesson")
    release = tmp_path / "release" / "lesson" / "lesson.ipynb"
    assert release.exists(), said
    assert release.read_text("utf-8").count('score(\\"') == POINTS
    assert "answer = ..." in release.read_text("utf-8")
    for student, answers in SUBMISSIONS.items():
        handed_in = tmp_path / "submitted" / student / "lesson" / "lesson.ipynb"
        handed_in.parent.mkdir(parents=True)
        handed_in.write_text(_submission(release.read_text("utf-8"), answers), encoding="utf-8")
    said = _nbgrader(tmp_path, "autograde", "lesson")
    assert _scores(tmp_path) == SCORES, said
    _nbgrader(tmp_path, "generate_feedback", "lesson")
    assert {page.parts[-3] for page in (tmp_path / "feedback").glob("*/lesson/lesson.html")} == set(SUBMISSIONS)


def _scores(course: Path) -> dict[str, float]:
    from nbgrader.api import Gradebook

    with Gradebook(f"sqlite:///{course / 'gradebook.db'}") as book:
        found = {each.student.id: each for each in book.assignment_submissions("lesson")}
        assert {each.max_score for each in found.values()} == {POINTS}
        return {student: each.score for student, each in found.items()}


def test_a_score_is_that_of_the_last_check(monkeypatch):
    monkeypatch.setattr(scores, "_last", {})
    assert score("1.1") == 0
    check("1.1", FIRST.solution)
    assert score("1.1") == 1
    check("1.1", ALMOST)
    assert repr(score("1.1")) == "0.0"


def test_cells_for_marks_are_locked_and_each_has_a_name_of_its_own():
    cells = json.loads(exercise_notebook(LESSON))["cells"]
    graded = [cell["metadata"]["nbgrader"] for cell in cells if cell["metadata"]]
    kinds = [(each["grade"], each["locked"], each["solution"], each["points"]) for each in graded]
    assert kinds == [(True, True, False, 1)] * POINTS
    assert len({each["grade_id"] for each in graded}) == POINTS
