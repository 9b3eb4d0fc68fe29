"""Whatever is moved, typed and chosen in a panel, in whatever order: it shows what stands in it.

A panel that was opened anew with the text and the values that stand in another shows the same words, the same drawing, the same
tokens; and its word is the one that is derived.
"""

from __future__ import annotations

import random
import re
from collections.abc import Mapping
from dataclasses import dataclass, field
from typing import Any

import pytest

from lsys_kit import derive, explore
from lsys_kit.errors import LSystemError
from lsys_kit.notation.model.system import LSystem
from lsys_kit.notation.read import read_any
from tests.classroom.panel_page import PanelPage, Tab, open_panel, open_tab

SYSTEMS: Mapping[str, tuple[tuple[str, str], ...]] = {
    "J4": (
        ("lifeTimeB = 2", "lifeTimeB = 3"),
        ("-> Al(1) Br(1)", "-> Br(1) Al(1)"),
        ("axiom: Al(1)", "axiom: Br(1)"),
        ("-> Bl(1) Ar(1)", "-> Bl(1 Ar(1)"),
    ),
    "K7": (("[+F]F : 0.33", "[+F] : 0.33"), ("axiom: F", "axiom: FF"), ("F[-F]F : 0.33", "FX : 1")),
    "K8": (("RU35 *", "RU60 *"), ("?0.65", "?0.8"), ("1-9", "1-")),
    "K28": (("B -> A", "B -> B"), ("ABAB", "ABABAB"), ("B -> A", "B -> Ax"), ("steps: 4", "steps: 4\nfree = 1")),
    "K33": (("R: * -> Q", "R: * -> P"), ("R: * -> Q", "R: * -> ")),
    "K34": (("L> -> D>[+e]x>[-e]D>", "L> -> D>[-e]x>[+e]D>"), ("steps: 4", "steps: 3"), ("D>D>D>D>", "D>D>")),
}
"""Systems of every kind, each with slips and changes: what stands in its text, and what is typed in its place."""
STILL = frozenset(["K33"])
"""Systems whose constants are not moved: under some values their cells do not come to rest in time."""
ACTS = {"K28": 7, "K33": 5, "K34": 4}
"""How much is done in panels whose cells take long to come to rest; in all others a dozen things are."""
LONGEST = 0.4
"""Seconds between one action and the next."""
SETTLED = """() => asked.filter((kind) => kind !== "save").length === answered.length"""
SHOWN = """() => ({
  text: document.querySelector(".lsys-rules").value, status: document.querySelector(".lsys-status").textContent,
  word: document.querySelector(".lsys-word").textContent, tokens: document.querySelector(".lsys-stages, svg")?.textContent,
  drawing: document.querySelector("canvas[data-drawn]").toDataURL(), step: data.step, seed: data.seed, settings: data.settings,
  angle: data.angle })"""


@dataclass
class Person:
    """Somebody who does one thing after another in a panel, by chance."""

    panel: PanelPage
    chance: random.Random
    edits: tuple[tuple[str, str], ...]
    moves: bool = True
    done: list[str] = field(default_factory=list)

    def act(self) -> None:
        """Do something, and wait, or do not. Whoever types has moved a slider before."""
        act = self.chance.choice([*[self._move, self._type] * 2, self._step, self._sow, self._go_back, self._reset])
        if act == self._type:
            self.done.append(f"_move {self._move()}")
        self.done.append(f"{act.__name__} {act()}")
        self.panel.page.wait_for_timeout(1_000 * self.chance.choice([0, 0, LONGEST * self.chance.random()]))

    def _move(self) -> object:
        names = sorted(self.panel.page.evaluate("Object.keys(data.settings)"))
        return self._slide(self.chance.choice(names)) if names and self.moves else None

    def _slide(self, name: str, most: int = 10**6) -> object:
        bar = self.panel.control(name)
        value = self.chance.randint(0, min(most, int(bar.get_attribute("max") or 0)))
        bar.evaluate("(bar, value) => { bar.value = value; bar.dispatchEvent(new Event('input', { bubbles: true })); }", value)
        return name, value

    def _type(self) -> object:
        area = self.panel.at(".lsys-rules")
        text = area.input_value()
        before, after = self.chance.choice(self.edits)
        changed = text.replace(before, after, 1) if before in text else text.replace(after, before, 1)
        area.fill(changed)
        return before, after, changed == text

    def _step(self) -> object:
        return self._slide("step", 5)

    def _press(self, name: str) -> object:
        found = self.panel.page.get_by_role("button", name=name, exact=True)
        if found.count() and found.first.is_visible() and found.first.is_enabled():
            found.first.click()
            return name
        return None

    def _sow(self) -> object:
        return self._press("another seed, at random")

    def _go_back(self) -> object:
        return self._press("back to the first rules")

    def _reset(self) -> object:
        return self._press("reset")


def shown(panel: PanelPage) -> dict[str, Any]:
    """What stands in a panel, and what it shows, when all is answered."""
    page = panel.page
    page.wait_for_timeout(300)  # a text is read when no key was pressed for a while
    page.wait_for_function(SETTLED)
    page.wait_for_timeout(60)
    return dict(page.evaluate(SHOWN))


@pytest.fixture(scope="module")
def tabs(browser):
    return open_tab(browser), open_tab(browser)


@pytest.mark.slow
@pytest.mark.parametrize("seed", range(2))
@pytest.mark.parametrize("id", SYSTEMS)
def test_a_panel_shows_what_stands_in_it(id: str, seed: int, tabs: tuple[Tab, Tab]) -> None:
    chance = random.Random(f"{id} {seed}")
    panel = open_panel(tabs[0], explore(id, 2))
    panel.page.evaluate(
        """(seed) => { // answers take a while, and what changes at once is told in any order
      const next = () => (seed = (seed * 16807) % 2147483647) / 2147483647;
      window.delay = () => 80 * next();
      window.inOrder = (changed) => [...changed].sort(() => next() - 0.5);
    }""",
        chance.randrange(1, 2**31 - 1),
    )
    panel.view("rules")
    person = Person(panel, chance, SYSTEMS[id], id not in STILL)
    understood = str(panel.at(".lsys-rules").input_value())
    for number in range(ACTS.get(id, 12)):
        person.act()
        if number % 2 == 0 and not person.done[-1].startswith("_type"):
            continue
        found = shown(panel)
        try:
            read_any(found["text"])
        except LSystemError:
            assert panel.at(".lsys-mistake").inner_text() != "", person.done
            continue
        understood = found["text"]
        assert_is_what_a_new_panel_shows(understood, found, tabs[1], person.done)
    assert panel.errors == []


def assert_is_what_a_new_panel_shows(text: str, found: dict[str, Any], tab: Tab, done: list[str]) -> None:
    system = read_any(text)
    settings = found["settings"]
    if isinstance(system, LSystem):
        opened = explore(system, found["step"], seed=found["seed"], angle=found["angle"], **settings)
        words = derive(system, found["step"], seed=found["seed"], **settings)
        assert re.search(rf"\b{len(words[-1]):,} (module|cell|letter|character)", found["status"]), done
    else:
        opened = explore(system, found["step"], **settings)
    other = open_panel(tab, opened)
    other.view("rules")
    anew = shown(other)
    for each in ("status", "word", "tokens", "drawing"):
        assert found[each] == anew[each], (each, found["status"], anew["status"], settings, done)
