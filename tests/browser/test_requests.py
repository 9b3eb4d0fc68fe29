"""What a lesson's text asks of its sliders can be done on its page, with a mouse and with a finger, on a wide and on a narrow
screen; `test_lessons.py` does all that it asks for in JupyterLab."""

from __future__ import annotations

from pathlib import Path

import pytest
from playwright.sync_api import Page

from tests.browser.hands import Finger, Mouse, control, reach
from tests.browser.reader import ROWS
from tests.browser.requests import lessons
from tests.browser.test_site import all_parts_open, opened, tabs  # noqa: F401

NAMES = [path.stem for path in lessons()]
HANDS = ((Finger, 400), (Mouse, 1440), (Mouse, 400), (Finger, 1440))
"""With what, and on how wide a screen, lesson after lesson is worked through."""


def asked_of(lesson: str) -> dict[int, list[tuple[str, str]]]:
    """By the numbers of its panels, the values that a lesson's text asks for while the rules are those of the panel."""
    found: dict[int, list[tuple[str, str]]] = {}
    for number, name, value in slides(lesson):
        found.setdefault(number, []).append((name, value))
    return found


def slides(lesson: str) -> list[tuple[int, str, str]]:
    panel, edited, found = 0, set[int](), []
    for _, *acts in ROWS[lesson]:
        for act in acts:
            if act.startswith("panel "):
                panel = int(act.split()[1])
            elif act == "rules back":
                edited.discard(panel)
            elif act.startswith("rules "):
                edited.add(panel)
            elif act.startswith("slide ") and panel not in edited:
                found.append((panel, *act.split()[1:]))
    return found


@pytest.mark.slow
@pytest.mark.parametrize(
    ("name", "hand", "width"), [(f"notebooks/{name}.html", *HANDS[number % len(HANDS)]) for number, name in enumerate(NAMES)]
)
def test_each_value_that_a_lesson_asks_for_is_reached_by_hand_on_its_page(opened, hand, width, name) -> None:  # noqa: F811
    page: Page = opened(name, is_phone=width == 400, has_touch=hand is Finger)
    all_parts_open(page)
    hidden = page.get_by_role("button", name="I have no idea, show me")
    while hidden.count():
        hidden.first.click()
    all_parts_open(page)
    panels = page.locator(".part .lsys-panel:not(.lsys-both .lsys-panel)")
    for number, values in asked_of(Path(name).stem[:2]).items():
        for setting, value in values:
            if control(panels.nth(number), setting).count():
                reach(hand(page), panels.nth(number), setting, value)
