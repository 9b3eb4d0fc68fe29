"""What a teacher opens for phones is on the teacher's page where the lesson has it."""

from __future__ import annotations

import ast
import re
from collections.abc import Iterator

import pytest

from lsys_kit.classroom.lessons.lesson import names
from lsys_kit.classroom.live.game import GAMES
from tests.notebooks.test_lesson_form import TEACHER, notebook, one_line

PLAYED = {"01": "J1", "05": "P2", "07": "J4", "09": "K16"}
"""The games of the lessons."""


def asked(name: str) -> Iterator[tuple[str, int]]:
    """What a lesson asks, and in which section, up to the second vote."""
    section = 1
    for cell in notebook(name).cells:
        if cell.cell_type == "markdown":
            section = int(([str(section), *re.findall(r"^## (\d+) ", cell.source, re.MULTILINE)])[-1])
            continue
        for node in ast.walk(ast.parse(cell.source)):
            if isinstance(node, ast.Call) and isinstance(node.func, ast.Name):
                if node.func.id == "vote":
                    yield "second vote" if node.keywords else "first vote", section
                    if node.keywords:
                        return
                elif node.func.id in ("predict", "worksheet"):
                    yield {"predict": "prediction", "worksheet": "table"}[node.func.id], section


def listed(numbers: list[int]) -> str:
    first = [str(each) for each in dict.fromkeys(numbers)]
    return f"section {first[0]}" if len(first) == 1 else f"sections {', '.join(first[:-1])} and {first[-1]}"


@pytest.mark.parametrize("name", names())
def test_a_page_for_the_teacher_says_when_to_open_which_question(name: str) -> None:
    text, found = one_line((TEACHER / f"{name}.md").read_text("utf-8")), [*asked(name)]
    for kind in dict.fromkeys(kind for kind, _ in found):
        sections = [section for each, section in found if each == kind]
        assert f"the {kind}{'s' * (len(sections) > 1)} in {listed(sections)}" in text
    assert all(f"{share} %" in text for share in (30, 50, 80))
    if name[:2] in PLAYED:
        assert re.search(rf"\*game: {PLAYED[name[:2]]}\*", text, re.IGNORECASE)


def test_all_games_are_played() -> None:
    assert {*PLAYED.values()} == {*GAMES}
