"""Votes, predictions and tables to fill in JupyterLab, Notebook 7 and Voila: by mouse and keyboard, in light and dark."""

from __future__ import annotations

from collections.abc import Callable

import pytest
from playwright.sync_api import Page, expect

from tests.browser.homes import HOMES

WORDS = (
    "vote('01')",
    "predict('How many cells has step 6 of `J1`?', explore('J1', 6))",
    "predict('What is its word?', derive(system('J1'), 3))",
    "worksheet('01', 'counts')",
    "vote('01', again=True)",
)


@pytest.fixture(scope="module")
def home(request: pytest.FixtureRequest, open_at_home: Callable[..., Page]) -> Page:
    """A notebook with these words in one of the three homes, for all tests."""
    page = open_at_home(request.param, *WORDS, name="words", viewport={"width": 1440, "height": 1000})
    expect(page.locator(".lsys-lesson").first).to_be_visible(timeout=90_000)
    return page


def options(page: Page, again: bool = False):
    return page.get_by_role("region", name="vote").nth(int(again)).get_by_role("button")


@HOMES
def test_a_vote_is_kept_and_judged_only_the_second_time(home):
    page = home
    first, second = (page.get_by_role("region", name="vote").nth(n) for n in (0, 1))
    expect(second.locator(".lsys-before")).to_have_text("You did not vote the first time.")
    options(page).nth(0).press("Enter")
    expect(options(page).nth(0)).to_have_attribute("aria-pressed", "true")
    expect(first.get_by_role("status")).to_have_text(
        "Your vote, A, is kept. The question comes again at the end of the lesson."
    )
    expect(second.locator(".lsys-before")).to_have_text("Your first vote was A.")
    options(page, again=True).nth(0).click()
    expect(second.get_by_role("status")).to_contain_text("✗ Not right.")
    options(page, again=True).nth(2).press(" ")
    expect(second.get_by_role("status")).to_contain_text("✓ Right.")
    expect(second.get_by_role("status")).to_contain_text("You have changed your vote from A to C.")
    expect(options(page).nth(0)).to_have_attribute("aria-pressed", "true")


@HOMES
def test_what_answers_a_question_appears_after_a_prediction(home):
    page = home
    first, second = (page.get_by_role("region", name="prediction").nth(n) for n in (0, 1))
    box = first.get_by_role("textbox", name="How many cells has step 6 of J1?")
    expect(first.get_by_role("button", name="Show", exact=True)).to_be_disabled()
    expect(page.locator(".lsys-panel")).to_have_count(0)
    box.fill("<b>21</b> $x$")
    box.press("Enter")
    expect(first.get_by_role("status")).to_have_text("You said: <b>21</b> $x$")
    expect(page.locator(".lsys-panel canvas[data-drawn]").first).to_be_visible()
    expect(page.get_by_text("al al br al br")).to_have_count(0)
    second.get_by_role("button", name="I have no idea, show me").click()
    expect(second.get_by_role("status")).to_have_text("You wanted to see it.")
    expect(page.get_by_text("al al br al br")).to_be_visible()


@HOMES
def test_a_table_says_which_cells_are_right_and_gives_none_away(home):
    page = home
    for (row, column), entry in {("1", "all at once"): "2", ("1", "rule after rule"): " 2 ", ("2", "all at once"): "4"}.items():
        page.get_by_role("textbox", name=f"step {row}: {column}").fill(entry)
    page.get_by_role("textbox", name="step 2: all at once").press("Enter")
    sheet = page.get_by_role("region", name="table to fill")
    expect(sheet.get_by_role("status")).to_have_text(
        "2 of 8 cells are right, 5 are not filled in yet.step 2, all at once: Did you apply one production after another, "
        "the second to what the first has made, or double the number in every step?"
    )
    expect(sheet.locator('[data-mark="right"]')).to_have_text(["✓ right"] * 2)
    expect(sheet.locator('[data-mark="not yet"]')).to_have_text("✗ not yet")
    box = page.get_by_role("textbox", name="step 2: all at once")
    expect(box).to_have_attribute("aria-invalid", "true")
    box.fill("3")
    expect(box).to_have_attribute("aria-invalid", "false")
    sheet.get_by_role("button", name="Check").click()
    expect(sheet.get_by_role("status")).to_have_text("3 of 8 cells are right, 5 are not filled in yet.")
