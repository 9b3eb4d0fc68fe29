"""Every lesson in a real JupyterLab, opened and run once for all that is asked of it: a prediction is answered, a vote cast,
every slider moves something that is seen; then whatever its text asks for is done, with a real mouse, and what is moved, what
is looked at and what is filled in are on one screen."""

from __future__ import annotations

import re
from collections.abc import Iterator

import pytest
from playwright.sync_api import Locator, expect

from lsys_kit.classroom.lessons.kept import FILE
from tests.browser.lab import Lab, OpenNotebook, Tab
from tests.browser.reader import PAINTED, PATIENCE, ROWS, SEEN, Reader
from tests.browser.requests import lessons

ONE_SCREEN = 840
"""Pixels: a panel as it opens, with what moves it and what is moved, is no higher on a screen of 1440 by 900."""
NOT_RIGHT = re.compile("cannot be read as a number|Look again at|Answer ")
"""What is said of an entry such as "no idea"."""


@pytest.fixture(scope="module", params=[path.stem for path in lessons()])
def lesson(request: pytest.FixtureRequest, lab: Lab, lab_tab: Tab) -> Iterator[tuple[str, OpenNotebook]]:
    """The number of a lesson, and its notebook, of which all cells have been run."""
    (lab.folder / FILE).unlink(missing_ok=True)
    notebook = lab_tab.open(f"notebooks/{request.param}.ipynb", {"width": 1440, "height": 900})
    notebook.run_all()
    yield request.param[:2], notebook
    notebook.close()


def test_a_lesson_is_worked_through(lesson: tuple[str, OpenNotebook]) -> None:
    number, notebook = lesson
    assert notebook.cell_errors() == []
    answer_predictions(notebook)
    cast_votes(notebook)
    check_worksheets(notebook)
    for cell in sorted({*notebook.cells_showing("explore("), *notebook.cells_showing("compare(")}):
        panels = notebook.output(cell).locator(".lsys-panel")
        expect(panels.first).to_be_visible()
        assert height_of(panels.first) <= ONE_SCREEN
        for place in range(panels.count()):
            move_every_slider(panels.nth(place))
        notebook.shot(f"{number}-{cell}")
    assert notebook.cell_errors() == []
    assert notebook.console == []


def test_what_a_lesson_asks_for_is_done_with_a_mouse(lesson: tuple[str, OpenNotebook]) -> None:
    number, notebook = lesson
    reader = Reader(notebook, number)
    for said, *acts in ROWS[number]:
        reader._follow(said, acts)
    assert reader._apart == []
    assert notebook.console == []


def height_of(panel: Locator) -> float:
    """The height of a panel, or of a comparison, whose drawings have been drawn."""
    expect(panel.locator(PAINTED).first).to_be_visible()
    return float(panel.evaluate("panel => panel.getBoundingClientRect().height"))


def answer_predictions(notebook: OpenNotebook) -> None:
    """Type something for the first prediction, and ask to see all others."""
    for place, number in enumerate(notebook.cells_showing("predict(")):
        asked = notebook.output(number).get_by_role("region", name="prediction")
        if place:
            asked.get_by_role("button", name="I have no idea, show me").click()
        else:
            asked.get_by_role("textbox").fill("21")
            asked.get_by_role("button", name="Show", exact=True).click()
            expect(asked.get_by_role("status")).to_contain_text("You said: 21")
        answers = notebook.output(number).locator(".widget-html, .widget-htmlmath, .lsys-panel, .lsys-found")
        answers.first.wait_for()  # as `expect` does, but `expect` describes the whole page each time that it looks in vain


def cast_votes(notebook: OpenNotebook) -> None:
    """Vote for the first option, and for the second at the end."""
    for place, number in enumerate(notebook.cells_showing("vote(")):
        box = notebook.output(number).get_by_role("region", name="vote")
        box.get_by_role("button").nth(place).click()
        expect(box.get_by_role("status")).to_contain_text(("Your vote, A, is kept.", "ight.")[place])


def check_worksheets(notebook: OpenNotebook) -> None:
    """Fill a table with what is hardly right, and let it be checked."""
    for number in notebook.cells_showing("worksheet("):
        sheet = notebook.output(number).get_by_role("region", name="table to fill")
        sheet.get_by_role("textbox").first.fill("no idea")
        sheet.get_by_role("button", name="Check").click()
        expect(sheet.get_by_role("status")).to_contain_text(NOT_RIGHT)
        if notebook.output(number).locator(".lsys-panel").count():  # what is moved, what is seen and what is filled in
            sides = (
                notebook.output(number)
                .locator(".lsys-panel, .lsys-lesson:has(.lsys-sheet)")
                .evaluate_all(
                    "(sides) => sides.map((each) => each.getBoundingClientRect()).map(({ top, bottom }) => [top, bottom])"
                )
            )
            assert max(bottom for _, bottom in sides) - min(top for top, _ in sides) <= ONE_SCREEN


def move_every_slider(panel: Locator) -> None:
    """Each slider changes the word, the stage diagram or the drawing, and is put back."""
    sliders = panel.locator(
        ".lsys-control:not([hidden]):not([data-view] *) .lsys-range"
    )  # what walks and unfolds has tests of its own
    for index in range(sliders.count()):
        slider, before = sliders.nth(index), panel.evaluate(SEEN)
        there, back = (
            ("ArrowLeft", "ArrowRight") if slider.input_value() == slider.get_attribute("max") else ("ArrowRight", "ArrowLeft")
        )
        slider.press(there)
        await_change(panel, before)
        slider.press(back)


def await_change(panel: Locator, before: str) -> None:
    for _ in range(PATIENCE):
        if panel.evaluate(SEEN) != before:
            return
        panel.page.wait_for_timeout(50)
    raise AssertionError(f"The slider changes nothing:\n{before}")
