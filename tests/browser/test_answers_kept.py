"""Nothing typed into a lesson is lost: when its page is loaded anew, its cells are run again, or the kernel is restarted."""

from __future__ import annotations

import pytest
from playwright.sync_api import Locator, expect

from lsys_kit.classroom.lessons.kept import FILE
from tests.browser.lab import OpenNotebook

pytestmark = [pytest.mark.slow, pytest.mark.browser]
QUESTION = "Step 6 has 13 long cells and 8 short ones. How long is the filament?"
WORDS = (
    "from lsys_kit import *\nvote('01')",
    f"predict('{QUESTION}', draw(system('J1'), 6))",
    "worksheet('01', 'counts')",
    "vote('01', again=True)",
)


def asked(notebook: OpenNotebook, number: int, name: str) -> Locator:
    return notebook.output(number).get_by_role("region", name=name)


def expect_all(notebook: OpenNotebook) -> None:
    """All that was typed is there."""
    expect(asked(notebook, 1, "vote").get_by_role("button").nth(3)).to_have_attribute("aria-pressed", "true")
    expect(asked(notebook, 2, "prediction").get_by_role("status")).to_have_text("You said: 21The answer: 34")
    expect(notebook.output(2).locator(".widget-html img")).to_be_visible()
    sheet = asked(notebook, 3, "table to fill")
    expect(sheet.get_by_role("textbox", name="step 1: all at once")).to_have_value("2")
    expect(sheet.get_by_role("textbox", name="step 2: all at once")).to_have_value("4")
    expect(sheet.get_by_role("textbox", name="step 3: all at once")).to_have_value("not checked yet")
    expect(sheet.locator("[data-mark='right']")).to_have_text("✓ right")
    expect(sheet.locator("[data-mark='not yet']")).to_have_text("✗ not yet")
    expect(sheet.locator("li")).to_contain_text("step 2, all at once: Did you apply one production after another")
    again = asked(notebook, 4, "vote")
    expect(again.locator(".lsys-before")).to_have_text("Your first vote was D.")
    expect(again.locator(".lsys-predicted summary")).to_have_text(
        "What you predicted in this lesson (0 of 1 came out as you said)"
    )


def expect_nothing(notebook: OpenNotebook) -> None:
    """All that was typed has been taken back."""
    expect(asked(notebook, 2, "prediction").get_by_role("textbox")).to_have_value("")
    sheet, again = asked(notebook, 3, "table to fill"), asked(notebook, 4, "vote")
    expect(sheet.get_by_role("textbox").first).to_have_value("")
    expect(sheet.get_by_role("status")).to_be_empty()
    expect(again.locator(".lsys-before")).to_have_text("You did not vote the first time.")
    expect(again.locator(".lsys-predicted")).to_be_hidden()


def test_nothing_that_is_typed_is_lost(lab, open_notebook, write_notebook) -> None:
    notebook = open_notebook(write_notebook("kept.ipynb", *WORDS))
    notebook.run_all()
    asked(notebook, 1, "vote").get_by_role("button").nth(3).click()
    prediction = asked(notebook, 2, "prediction")
    prediction.get_by_role("textbox").fill("21")
    prediction.get_by_role("button", name="Show", exact=True).click()
    sheet = asked(notebook, 3, "table to fill")
    for step, entry in (("1", "2"), ("2", "4")):
        sheet.get_by_role("textbox", name=f"step {step}: all at once").fill(entry)
    sheet.get_by_role("button", name="Check").click()
    expect(sheet.get_by_role("status")).to_contain_text("1 of 8 cells is right, 6 are not filled in yet.")
    sheet.get_by_role("textbox", name="step 3: all at once").fill("not checked yet")
    while "not checked yet" not in (lab.folder / FILE).read_text("utf-8"):
        notebook.page.wait_for_timeout(50)
    expect_all(notebook)
    notebook.reload()
    expect_all(notebook)
    notebook.run_all()
    expect_all(notebook)
    notebook.restart()
    notebook.run_all()
    expect_all(notebook)
    notebook.shot("kept")
    for number, name in ((1, "vote"), (2, "prediction"), (3, "table to fill")):
        asked(notebook, number, name).get_by_role("button", name="Start again").click()
    expect_nothing(notebook)  # the kernel has heard it
    notebook.restart()
    notebook.run_all()
    expect_nothing(notebook)
    assert notebook.console == []
