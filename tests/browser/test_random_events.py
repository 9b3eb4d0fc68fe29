"""What may happen in a lesson hour, in any order: no panel is dead without a word, and nothing that was typed is lost.

    EVENTS_MINUTES=10 pytest tests/browser/test_random_events.py

goes on for ten minutes, twenty events after twenty; otherwise it is a few events of one order.
"""

from __future__ import annotations

import os
import re
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from itertools import count
from random import Random

import pytest
from playwright.sync_api import Browser, Locator, expect

from tests.browser.homes import show
from tests.browser.lab import CELL, Lab, OpenNotebook, Tab, tab_in, tab_of

pytestmark = [pytest.mark.slow, pytest.mark.browser]
MINUTES = float(os.environ.get("EVENTS_MINUTES", "0"))
FEW, MANY = 8, 20
"""How many events are one order, of a short run and of a long one."""
PATIENCE = 30
"""Seconds after which a panel shows what was typed, or says why it does not."""
CELLS = ("panel = explore('J4', 9)\npanel", "panel", "explore('J4', 9)", "import time\ntime.sleep(4)")
"""Two panels of one model, another of the same rules, and a cell that keeps Python busy."""
SHARE = {1: 1, 2: 1, 3: 3}
"""In which cell the model of a cell's panel is made."""
BUSY = 4
RUN = "panel.content.activeCellIndex = given; app.commands.execute('notebook:run-cell');"
OUTPUTS = "return JSON.stringify(panel.content.widgets[given].model.outputs.toJSON());"
NONE_RUNS = """() => {
    const status = window.jupyterapp.shell.currentWidget.sessionContext.session?.kernel?.status;
    const prompts = [...document.querySelectorAll(".jp-Notebook .jp-InputPrompt")].map((each) => each.textContent);
    return ["idle", "starting", "unknown"].includes(status) && !prompts.some((each) => each.includes("*"));
}"""
"""Of a kernel that was restarted twice Jupyter says that it starts, or that it knows nothing of it, until it is asked."""
ANSWER = """const kernel = panel.sessionContext.session?.kernel;
    if (kernel && kernel.status !== "idle") await Promise.race([kernel.requestKernelInfo().catch(() => {}), wait(10_000)]);"""
"""Ask a kernel who it is: until then JupyterLab keeps back what is run in one that was restarted twice."""
DIE = "panel.sessionContext.session.kernel.requestExecute({ code: 'import os; os.kill(os.getpid(), 9)' }).done.catch(() => {});"
WINDOW = {"width": 1400, "height": 4000}
NO_KERNEL = "The kernel does not answer"
LATE = re.compile(r"Comm not found|Canceled future|widget model not found")
"""What JupyterLab says of a kernel that has ended: of what it had sent, of what it was asked, of outputs that it had made."""


@dataclass
class Hour:
    """A notebook in which anything happens, what was typed last into the rules of each model, and in the panel of which cell,
    and what has happened."""

    tab: Tab
    name: str
    random: Random
    typed: dict[int, tuple[str | None, int]] = field(default_factory=dict)
    lengths: dict[str, int] = field(default_factory=dict)
    numbers: Iterator[int] = field(default_factory=lambda: count(20))
    events: list[str] = field(default_factory=list)
    has_ended: bool = False
    """whether a kernel has ended so far"""
    shown: set[int] = field(default_factory=set)
    """the cells that were run, and will show a panel unless Python ends before"""

    @property
    def notebook(self) -> OpenNotebook:
        assert self.tab.notebook
        return self.tab.notebook

    def panels(self) -> dict[int, Locator]:
        """The panels that are to be seen, by the numbers of their cells."""
        found = {number: self.cell(number).locator(".lsys-panel") for number in SHARE}
        return {number: panel for number, panel in found.items() if panel.count()}

    def open(self) -> None:
        """Open the notebook in a window in which all its cells are to be seen."""
        self.tab.open(self.name, WINDOW)
        self.notebook._ask("app.shell.collapseLeft();")

    def run(self, number: int) -> None:
        self.notebook._ask(RUN, number)
        self.shown |= {number} & {*SHARE}

    def settle(self) -> None:
        """Wait until Python has nothing to do, and the cells that were run show their panels."""
        self.notebook._ask(ANSWER)
        self.notebook.page.wait_for_function(NONE_RUNS)
        for number in self.shown:
            if "widget-view+json" in self.notebook._ask(OUTPUTS, number):
                expect(self.cell(number).locator(".lsys-panel canvas[data-drawn]").first).to_be_visible()
        self.shown.clear()

    def cell(self, number: int) -> Locator:
        return self.notebook.page.locator(CELL.format(number))

    # -- what may happen ------------------------------------------------------------------------------------------------

    def restart(self) -> None:
        self.has_ended = True
        self.shown.clear()
        self.notebook._ask("await Promise.race([panel.sessionContext.session.kernel.restart(), wait(60_000)]);")

    def die(self) -> None:
        """Jupyter says so in a window of its own."""
        self.has_ended = True
        self.shown.clear()
        self.notebook._ask(DIE)
        self.notebook.page.locator(".jp-Dialog").get_by_role("button", name="Ok").click()

    def interrupt(self) -> None:
        self.notebook._ask("await Promise.race([panel.sessionContext.session.kernel.interrupt(), wait(60_000)]);")

    def busy(self) -> None:
        self.run(BUSY)

    def run_again(self) -> None:
        self.run(self.random.choice([*SHARE]))

    def run_all(self) -> None:
        for number in SHARE:
            self.run(number)

    def closed_tab(self) -> None:
        """The tab is closed, mostly with a saved notebook, and opened again in the same browser."""
        if self.random.random() < 0.7:
            self.notebook._ask("await panel.context.save();")
        self.shown.clear()
        old = self.tab.page
        self.tab = tab_in(old.context, self.tab.lab)
        old.close()
        self.open()

    def type_rules(self) -> None:
        self._put(lambda number: f"c = 2 in 1 .. 5\naxiom: A(c) {'b ' * number}".strip())

    def type_nonsense(self) -> None:
        self._put(lambda number: f"axiom: b{number} -> (")

    def undo(self) -> None:
        self._press("undo")

    def redo(self) -> None:
        self._press("redo")

    def first_rules(self) -> None:
        self._press("back to the first rules")

    def take_up(self) -> None:
        self._press("take up my rules")

    def move(self) -> None:
        """Move the slider of a constant, whose book is asked of Python."""
        for panel in self._chosen():
            handle = panel.locator('.lsys-control[data-control="c"], .lsys-control[data-control="lifeTimeA"]')
            if handle.count():
                handle.locator(".lsys-range").press(self.random.choice(("ArrowLeft", "ArrowRight")))

    def _put(self, rules: Callable[[int], str]) -> None:
        """Type one text or several, as fast as a person."""
        for panel in self._chosen():
            area = rules_of(panel)
            for _ in range(self.random.choice((1, 1, 3))):
                number = next(self.numbers)
                area.fill(rules(number))
                self.lengths[area.input_value()] = number + 1
                self._note(panel)
                self.notebook.page.wait_for_timeout(self.random.choice((0, 100, 400)))

    def _press(self, name: str) -> None:
        for panel in self._chosen():
            button = panel.get_by_role("button", name=name, exact=True)
            if button.count() and button.is_visible() and button.is_enabled():
                button.click()
                self._note(panel)

    def _chosen(self) -> Iterator[Locator]:
        """One of the panels, with its rules open, if there are any."""
        panels = self.panels()
        if panels:
            self._last = self.random.choice([*panels])
            rules_of(panels[self._last])
            yield panels[self._last]

    def _note(self, panel: Locator) -> None:
        text = rules_of(panel).input_value()
        back = panel.get_by_role("button", name="back to the first rules", exact=True)
        self.typed[SHARE[self._last]] = text if back.is_visible() else None, self._last

    # -- what holds, whatever has happened ------------------------------------------------------------------------------

    def check(self) -> None:
        self.settle()
        panels = self.panels()
        for panel in panels.values():
            self._moves(panel)
            self._shows_or_tells(panel)
        for model, (text, cell) in self.typed.items():
            seen = [panel for number, panel in panels.items() if SHARE[number] == model and (number == cell or lives(panel))]
            kept = [rules_of(panel).input_value() for panel in seen]
            offered = any(panel.locator(".lsys-offer").is_visible() for panel in seen)
            assert not seen or text is None or text in kept or offered, f"lost: {text!r}; there are {kept}"
        assert [each for each in self.notebook.console if not (self.has_ended and LATE.search(each))] == []

    def _moves(self, panel: Locator) -> None:
        """What needs no kernel goes on."""
        box = panel.get_by_label("step", exact=True)
        now = int(box.input_value())
        panel.get_by_role("slider", name="step, slider", exact=True).press("ArrowLeft" if now else "ArrowRight")
        expect(panel.locator(".lsys-status")).to_contain_text(f"step {now - 1 if now else 1}")

    def _shows_or_tells(self, panel: Locator) -> None:
        """A panel shows what stands in its rules, or says in words why it does not."""
        end = time.monotonic() + PATIENCE
        while time.monotonic() < end:
            length, status = self.lengths.get(rules_of(panel).input_value()), panel.locator(".lsys-status").inner_text()
            if f" {length} " in status if length else " cell" in status:
                return
            if any(each.is_visible() and each.inner_text() for each in panel.locator(".lsys-message, .lsys-mistake").all()):
                return
            self.notebook.page.wait_for_timeout(200)
        raise AssertionError(f"without a word: {status}")

    def end(self) -> None:
        """Python is restarted, and all cells are run: what was typed is offered, and taken up."""
        self.settle()
        self.restart()
        self.settle()
        for panel in self.panels().values():
            expect(panel).to_contain_text(NO_KERNEL)
        self.run_all()
        self.settle()
        panels = self.panels()
        assert [*panels] == [*SHARE]
        for model, (text, _) in self.typed.items():
            if text is not None:
                panels[model].get_by_role("button", name="take up my rules", exact=True).click()
                expect(rules_of(panels[model])).to_have_value(text)
        self.check()


def lives(panel: Locator) -> bool:
    """Whether Python has not ended since a panel was made: else it shows what it showed, and what was typed into another of its
    model is offered when its cell is run again."""
    return NO_KERNEL not in panel.inner_text()


def rules_of(panel: Locator) -> Locator:
    tab = panel.locator(".lsys-tabs").get_by_role("button", name="rules", exact=True)
    if tab.get_attribute("aria-pressed") == "false":
        tab.click()
    return panel.get_by_label("rules of the model")


EVENTS = (
    *[Hour.type_rules] * 5,
    *[Hour.busy, Hour.restart, Hour.run_again, Hour.undo, Hour.take_up] * 2,
    *(Hour.type_nonsense, Hour.redo, Hour.first_rules, Hour.move, Hour.run_all, Hour.closed_tab, Hour.die, Hour.interrupt),
)


def happens(hour: Hour, events: int) -> None:
    """Some events, after most of which it is looked whether all holds; then the end of the hour."""
    hour.run_all()
    hour.check()
    for _ in range(events):
        event = hour.random.choice(EVENTS)
        hour.events.append(event.__name__)
        print(event.__name__, end=" ", flush=True)
        event(hour)
        if hour.random.random() < 0.6:
            hour.check()
            hour.events.append("looked")
    hour.end()


def test_no_panel_is_dead_without_a_word_and_nothing_typed_is_lost(
    browser: Browser, lab: Lab, write_notebook: Callable[..., str], pytestconfig: pytest.Config
) -> None:
    end = time.monotonic() + 60 * MINUTES
    for seed in count(int(os.environ.get("EVENTS_SEED", "1"))):
        name = write_notebook(f"events{seed}.ipynb", *map(show, CELLS))
        hour = Hour(tab_of(browser, lab), name, Random(seed))
        try:
            hour.open()
            happens(hour, MANY if MINUTES else FEW)
        except BaseException as fault:
            fault.add_note(f"seed {seed}: {', '.join(hour.events)}")
            if folder := pytestconfig.getoption("screenshots"):
                hour.tab.page.screenshot(path=f"{folder}/events-{seed}.png")
            raise
        finally:
            hour.notebook.close()
            hour.tab.page.context.close()
        print(f"after seed {seed} all holds", flush=True)
        if time.monotonic() > end:
            return
