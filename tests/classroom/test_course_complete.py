"""The course is whole: every lesson has all its parts, every system is taught, and every point where it is owed."""

from __future__ import annotations

from lsys_kit import cellwork_systems, map_systems, systems
from lsys_kit.classroom.exercises.registry import lessons as exercises
from lsys_kit.classroom.lessons.lesson import declared, names
from tests.notebooks.test_lesson_form import LESSONS, POINTS, TEACHER

COURSE = (
    "00_five_characters_one_plant",
    "01_all_at_once",
    "02_how_many",
    "03_type_a_plant",
    "04_the_turtle",
    "05_cells_that_wait",
    "06_parameters",
    "07_life_spans",
    "08_chance",
    "09_neighbours",
    "10_flowering",
    "11_time_in_slices",
    "12_growing_without_a_jump",
    "13_into_space",
    "14_plants_that_look",
    "15_hedges_and_movement",
    "16_tissues",
    "17_languages",
    "18_your_own_plant",
    "19_every_tenth_cell",
)


def test_the_course_has_twenty_lessons_each_with_notebook_page_and_exercises() -> None:
    assert names() == COURSE
    assert tuple(sorted(path.stem for path in LESSONS.glob("[0-9][0-9]_*.ipynb"))) == COURSE
    assert tuple(sorted(path.stem for path in TEACHER.glob("*.md"))) == COURSE
    assert tuple(sorted(each.name for each in exercises())) == COURSE


def test_every_system_of_the_catalogue_is_taught() -> None:
    taught = {id for name in names() for id in declared(name).systems}
    assert {*systems(), *map_systems(), *cellwork_systems()} - taught == set()


def test_every_point_is_taught_where_it_is_owed() -> None:
    taught = {(declared(name).number, point) for name in names() for point in declared(name).points}
    owed = {(number, f"{each['work']}: {each['point']}") for each in POINTS for number in each["owed"]}
    assert owed - taught == set()
    assert {point for _, point in taught} == {point for _, point in owed}
