"""Exercises as a student solves them: typed into a cell of the notebook, wrong first, then right, and both replies are seen."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, expect

from lsys_kit.pictures.style.palette import GREEN, ORANGE
from tests.browser.lab import OpenNotebook

MIRROR = '"""\naxiom: al\nar -> {}\nal -> {}\nbr -> ar\nbl -> al\n"""'
SOLVED = {
    "1.1": ("01_all_at_once", '"al al br"', "Almost", "stop one step too early", '"bl ar bl ar ar"'),
    "1.3": (
        "01_all_at_once",
        MIRROR.format("bl ar", "al br"),
        "Almost",
        "exchange what two kinds of modules become",
        MIRROR.format("al br", "bl ar"),
    ),
    "1.5": ("01_all_at_once", '"A"', "Not yet", "A name has no meaning by itself", '"c"'),
    "4.2": ("04_the_turtle", "90", "Not yet", "With 90° the fourth stroke leads home", '"72 degrees"'),
    "4.5": ("04_the_turtle", '"FFF+FFF+FFF+FFF"', "Not yet", "This square has no gaps", '"FfF+FfF+FfF+FfF"'),
}
"""For exercises of five kinds the notebook, a wrong answer, the word and a part of its reply, and a right answer."""


def run_imports(notebook: OpenNotebook) -> None:
    """Run the first cell of code by keyboard."""
    notebook.cell(1).locator(".cm-content").click()
    notebook.run_by_key()


def answered(notebook: OpenNotebook, exercise: str, answer: str) -> Locator:
    """The reply, after an answer was typed in the place of what stood there and the cell was run by keyboard."""
    [number] = notebook.cells_showing(f'\ncheck("{exercise}", answer)')
    notebook.cell(number).locator(".cm-content").click()
    keyboard = notebook.page.keyboard
    keyboard.press("Control+a")
    keyboard.press("Delete")
    keyboard.insert_text(f'answer = {answer}\ncheck("{exercise}", answer)')
    notebook.run_by_key("Control+Enter")
    return notebook.output(number).get_by_role("status")


def expect_reply(reply: Locator, word: str, says: str, colour: str) -> None:
    expect(reply).to_be_visible()
    expect(reply.locator("b")).to_have_text(f"{word}.")
    expect(reply).to_contain_text(says)
    channels = ", ".join(str(int(colour[at : at + 2], 16)) for at in (1, 3, 5))
    expect(reply).to_have_css("border-left-color", f"rgb({channels})")


@pytest.mark.parametrize("exercise", SOLVED)
def test_an_exercise_is_solved_at_the_second_try(open_notebook, exercise):
    name, wrong, word, says, right = SOLVED[exercise]
    notebook = open_notebook(f"exercises/{name}.ipynb")
    notebook.hide_file_browser()
    run_imports(notebook)
    for answer, *told in ((wrong, word, says, ORANGE), (right, "Correct", "", GREEN)):
        reply = answered(notebook, exercise, answer)
        for width in (400, 1440):
            notebook.page.set_viewport_size({"width": width, "height": 900})
            reply.scroll_into_view_if_needed()
            expect_reply(reply, *told)
            notebook.shot(f"exercise-{exercise}-{told[0].replace(' ', '-')}-{width}")
    assert notebook.console == []


def test_progress_is_shown_at_the_end_and_kept_in_the_course(open_notebook, lab):
    notebook = open_notebook("exercises/17_languages.ipynb")
    notebook.hide_file_browser()
    run_imports(notebook)
    answered(notebook, "17.2", "1")
    [number] = notebook.cells_showing('progress("17_languages")')
    notebook.cell(number).locator(".cm-content").click()
    notebook.page.keyboard.press("Control+Enter")
    notebook.idle()
    shown = notebook.output(number).get_by_role("region", name="progress")
    expect(shown).to_contain_text("Languages: 0 of 5 solved, 1 more tried.")
    expect(shown).to_contain_text("Next: 17.1")
    for width in (400, 1440):
        notebook.page.set_viewport_size({"width": width, "height": 900})
        notebook.shot(f"progress-{width}")
    assert ",17.2,tried\n" in (lab.folder / "progress.csv").read_text()
    assert notebook.console == []
