"""A slider moved as a person moves it, with a real mouse or finger: drag until the number is there, then press beside it."""

from __future__ import annotations

import contextlib
from abc import ABC, abstractmethod
from collections.abc import Callable, Iterator
from fractions import Fraction

from playwright.sync_api import Locator, Page, expect

MOST_PRESSES = 40
"""How often somebody presses a button beside a number and does not lose patience."""


MOST_DRAGS = 3
"""How often somebody takes a slider that stops at each value, and has no buttons."""
SLOP = 24
"""Pixels that a finger moves before the browser takes it for a movement."""


class Pointer(ABC):
    """What a hand does on a page: a press at a place, movements to others, and the end of it."""

    def __init__(self, page: Page) -> None:
        self.page = page

    @abstractmethod
    def pressed(self, x: float, y: float) -> contextlib.AbstractContextManager[Callable[[float, float], None]]:
        """Press at a place; what is given moves on from there."""

    @abstractmethod
    def tap(self, button: Locator) -> None:
        """Press a button."""

    def _seen(self, _: None) -> None:
        """Wait until what was done is seen."""
        self.page.evaluate("new Promise(done => requestAnimationFrame(() => requestAnimationFrame(done)))")


class Mouse(Pointer):
    @contextlib.contextmanager
    def pressed(self, x: float, y: float) -> Iterator[Callable[[float, float], None]]:
        self.page.mouse.move(x, y)
        self.page.mouse.down()
        yield lambda x, y: self._seen(self.page.mouse.move(x, y))
        self.page.mouse.up()

    def tap(self, button: Locator) -> None:
        button.click()


class Finger(Pointer):
    @contextlib.contextmanager
    def pressed(self, x: float, y: float) -> Iterator[Callable[[float, float], None]]:
        session = self.page.context.new_cdp_session(self.page)

        def touch(kind: str, *points: dict[str, float]) -> None:
            session.send("Input.dispatchTouchEvent", {"type": kind, "touchPoints": [*points]})

        touch("touchStart", {"x": x, "y": y})
        touch("touchMove", {"x": x + SLOP, "y": y})
        yield lambda x, y: self._seen(touch("touchMove", {"x": x, "y": y}))
        touch("touchEnd")
        session.detach()

    def tap(self, button: Locator) -> None:
        button.tap()


def control(panel: Locator, name: str) -> Locator:
    """The label, the box and the slider of a setting."""
    return panel.locator(f'.lsys-control[data-control="{name}"]').first


def reach(hand: Pointer, panel: Locator, name: str, wanted: str) -> int:
    """Bring a setting to a value; how many presses of the buttons beside its number it took."""
    there, bar = control(panel, name), control(panel, name).locator(".lsys-range")
    box = there.get_by_label(name, exact=True)
    box.scroll_into_view_if_needed()
    if bar.count() and bar.is_visible():  # it may stand in a line of its own
        bar.scroll_into_view_if_needed()
    for _ in range(MOST_DRAGS if bar.count() else 0):  # what is still loaded may move the slider away from under a hand
        if box.input_value() != wanted:
            drag(hand, bar, box, Fraction(wanted))
        if there.locator(".lsys-next").first.is_visible():
            break
    presses = 0
    while (now := box.input_value()) != wanted:
        presses += 1
        assert presses <= MOST_PRESSES, f"{name} stands at {now}, and {wanted} is not reached"
        hand.tap(next_to(panel, name, up=Fraction(now) < Fraction(wanted)))
        expect(box).not_to_have_value(now)
    return presses


def next_to(panel: Locator, name: str, up: bool) -> Locator:
    """The button that leads to the next value: beside the number or, for steps, that of the player."""
    button = control(panel, name).locator(".lsys-next").nth(int(up))
    if button.is_visible():
        return button
    assert name == "step", f"{name} has no button to the next value"
    return panel.get_by_role("button", name="one step on" if up else "one step back", exact=True).first


def drag(hand: Pointer, bar: Locator, box: Locator, wanted: Fraction) -> None:
    """Move the slider until the box beside it shows the value, or as near as whole pixels come."""
    seen = bar.bounding_box()
    assert seen
    part = bar.evaluate("bar => (bar.value - bar.min) / (bar.max - bar.min)")
    low, high, y = int(seen["x"]), int(seen["x"] + seen["width"]) + 1, seen["y"] + seen["height"] / 2
    with hand.pressed(seen["x"] + 8 + part * (seen["width"] - 16), y) as move:
        while low < high:
            x = (low + high) // 2
            move(x, y)
            if (now := Fraction(box.input_value())) == wanted:
                return
            low, high = (x + 1, high) if now < wanted else (low, x)
