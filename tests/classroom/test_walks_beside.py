"""Beside the reply to a wrong drawing stand the turtle of the answer and the right one, as far as the first difference."""

import re

import pytest

from lsys_kit import check
from lsys_kit.classroom.exercises.check import checked
from lsys_kit.classroom.exercises.kinds.drawings import DRAWING, MOST_FOLLOWED
from lsys_kit.classroom.exercises.kinds.table import solution_of
from lsys_kit.classroom.site.answers import BUDGET, KINDS, answer
from lsys_kit.pictures.style.palette import BLUE, INK, ORANGE, QUIET
from tests.classroom.answers import EXERCISES, as_typed, wrong_answers_to

DRAWINGS = [each for each in EXERCISES if each.kind == "drawing"]
WIND = "angle: 25.7\naxiom: F\nF -> "


def strokes_in(picture: str) -> dict[str, list[int]]:
    """For each colour how many strokes have it, in each drawing of a picture."""
    found: dict[str, list[int]] = {}
    for path, colour in re.findall(r'<path d="([^"]*)" stroke="([^"]*)"', picture):
        found.setdefault(colour, []).append(path.count("M"))
    return found


def captions_in(picture: str) -> list[str]:
    return re.findall(r"<text[^>]*>([^<]*)<", picture)


@pytest.mark.slow
@pytest.mark.parametrize("exercise", DRAWINGS, ids=lambda each: each.id)
def test_no_more_of_the_right_drawing_is_shown_than_one_stroke_and_of_a_word_none(exercise):
    solution = solution_of(exercise)
    for wrong in wrong_answers_to(exercise):
        verdict = checked(exercise, as_typed(exercise, wrong.answer), 0, False, "")
        own, shown = DRAWING.read(exercise, as_typed(exercise, wrong.answer)), strokes_in(verdict.picture)
        if not verdict.picture:
            continue
        agreed = shown.get(INK, [0])
        assert agreed[0] + sum(shown.get(ORANGE, [])) + sum(shown.get(QUIET, [])) == len(own.ends) <= MOST_FOLLOWED
        assert len({*agreed}) == 1
        assert sum(shown.get(BLUE, [])) <= (len(solution.derivation) > 1)
        assert captions_in(verdict.picture) == ["your turtle", "the right one"][: 1 + (BLUE in shown)]


@pytest.mark.parametrize(
    ("exercise", "typed", "strokes"),
    [
        ("4.3", "F[+F]F[-FF]F", {INK: [1], ORANGE: [1], QUIET: [4]}),
        ("4.5", "FFF+FFF", {INK: [1], ORANGE: [1], QUIET: [4]}),
        ("0.3", "F[+F]F[-FF]", {INK: [4], ORANGE: [1]}),
        ("4.3", "F[-F]F", {INK: [3]}),
        ("0.5", WIND + "F[+F]F[-F]F", {INK: [3, 3], ORANGE: [1], BLUE: [1], QUIET: [21]}),
        ("0.5", WIND + "F[+F]", {INK: [3, 3], ORANGE: [1], BLUE: [1]}),
    ],
)
def test_both_turtles_go_as_far_as_the_first_difference(exercise, typed, strokes):
    assert strokes_in(check(exercise, typed).picture) == strokes


@pytest.mark.parametrize("typed", ["F[-F]F[+FF]F", "FFFF", "+++", "F[-F"])
def test_there_is_no_picture_of_what_is_right_or_has_no_place_of_a_difference(typed):
    verdict = check("4.3", typed)
    assert bool(verdict.picture) == (typed == "FFFF")


def test_a_picture_is_told_in_words_and_reaches_pages():
    verdict = check("4.3", "F[+F]F[-FF]F")
    assert (
        '<img alt="Your turtle has just drawn stroke 2, the first that is not in the right drawing."' in verdict._repr_html_()
    )
    found = answer({"kind": "check", "id": "4.3", "answer": "F[+F]F[-FF]F"}, KINDS, BUDGET)
    assert found["picture"] == verdict.picture
    assert found["described"] == "Your turtle has just drawn stroke 2, the first that is not in the right drawing."
