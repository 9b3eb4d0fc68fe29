"""Somebody who does what a lesson's text asks for, with a real mouse, in JupyterLab: each sentence that asks for something
has a row in `requests.toml`.

A row is a sentence, and what is done: `panel 0 left`, the panel of the lesson that the next words are about, counted from 0,
and perhaps its side; `slide NAME VALUE`; `press NAME`, a button; `rules OLD => NEW`, perhaps several joined by `;;`; and so on,
as the methods of `Reader` say. `on paper` is done away from the screen; `no request` only sounds like one.
"""

from __future__ import annotations

import re
import tomllib
from pathlib import Path

from playwright.sync_api import Locator, expect

from lsys_kit.classroom.lessons.lesson import lesson as declared
from tests.browser.hands import Mouse, control, reach
from tests.browser.lab import OpenNotebook

ROWS: dict[str, list[list[str]]] = tomllib.loads((Path(__file__).parent / "requests.toml").read_text("utf-8"))
NOTHING = {"on paper", "no request", "link", "open"}
READ = 400
"""Milliseconds after the last key in which rules that were typed are sent to be read."""
VIEWS = {"rules": "rules", "stages": "stages", "how many": "counts", "nine seeds": "seeds", "nine variants": "variants"}
"""The views by the names of their buttons."""
SEVERAL, BECOMES = " ;; ", " => "
OF_A_MOTHER = re.compile("comes from|Mother: ")
HEIGHT = """[...document.querySelectorAll(".jp-WindowedPanel-outer")].find((each) => each.checkVisibility()).clientHeight"""
"""How much of a notebook is seen at once."""
EDGES = "each => [each.getBoundingClientRect().top, each.getBoundingClientRect().bottom]"
VISIBLE_VIEWS = """panel => [...panel.querySelectorAll("[data-view]")].filter((each) => each.checkVisibility()).map(
    (each) => [each.dataset.view, each.getBoundingClientRect().top, each.getBoundingClientRect().bottom])"""
PAINTED = "canvas[data-drawn], [data-view=sample] svg"
"""What is there when a panel is."""
PATIENCE = 200
"""How often one looks whether a view has changed."""
SEEN = """panel => [
    ...panel.querySelectorAll(".lsys-word"), ...panel.querySelectorAll(".lsys-status"),
    ...panel.querySelectorAll("[data-view=sample] .lsys-caption")].map(view => view.innerText).concat(
    [...panel.querySelectorAll("[data-place]")].map(stage => stage.getAttribute("aria-label")),
    [...panel.querySelectorAll("canvas.lsys-canvas")].map(canvas => canvas.dataset.drawn)).join("\\n")"""


class Reader:
    """Somebody who does what a lesson says, in JupyterLab; each public method is a word of the rows."""

    def __init__(self, notebook: OpenNotebook, lesson: str) -> None:
        self._notebook, self._lesson, self._hand = notebook, lesson, Mouse(notebook.page)
        self._number, self._opening = "", dict[str, set[str]]()
        self._apart: list[str] = []
        self._reveal()

    def _follow(self, said: str, acts: list[str]) -> None:
        """Do what a sentence says."""
        self._said = said
        self._used: dict[str, Locator] = {}
        self._looked_at: set[str] = set()
        try:
            for act in acts:
                self._do(act)
            self._measure()
        except Exception as fault:
            fault.add_note(f"Lesson {self._lesson}, {said!r}: {act}")
            self._notebook.shot(f"request-{self._lesson}")
            raise

    def _use(self, *what: Locator) -> None:
        self._used.update((str(each), each) for each in what)

    def _measure(self) -> None:
        """Note where what this sentence has used, and the views that it looks at, are on no one screen."""
        if not self._used:
            return
        high = self._notebook.page.evaluate(HEIGHT)
        edges = [each.evaluate(EDGES) for each in self._used.values()]
        if self._looked_at:
            edges += [where for view, *where in self._panel.evaluate(VISIBLE_VIEWS) if view in self._looked_at]
        span = max(bottom for _, bottom in edges) - min(top for top, _ in edges)
        if span > high:
            self._apart.append(f"{span - high:.0f} pixels more than one screen: {self._said}")

    def _do(self, act: str) -> None:
        if act in NOTHING:
            return
        word = max((name for name in vars(Reader) if f"{act} ".startswith(f"{name.replace('_', ' ')} ")), key=len)
        rest = act[len(word) + 1 :]
        method = getattr(self, word)
        method(rest) if rest else method()

    def _reveal(self) -> None:
        """Ask to see what predictions still hide."""
        for number in self._notebook.cells_showing("predict("):
            asked = self._notebook.output(number).get_by_role("region", name="prediction")
            asked.wait_for()
            button = asked.get_by_role("button", name="I have no idea, show me")
            if button.is_visible():
                button.click()

    def _output(self, source: str, at: int = 0) -> Locator:
        return self._notebook.output(self._notebook.cells_showing(source)[at])

    def _see(self) -> str:
        """What the views show."""
        return str(self._panel.evaluate(SEEN))

    def _await_change(self, before: str) -> None:
        self._panel.locator(PAINTED).first.wait_for()
        for _ in range(PATIENCE):
            if self._see() != before:
                return
            self._notebook.page.wait_for_timeout(50)
        raise AssertionError(f"Nothing has changed:\n{before}")

    # -- panels

    def panel(self, which: str) -> None:
        """The panel of a number, of a comparison perhaps one side."""
        number, _, side = which.partition(" ")
        if number != self._number:
            self._measure()
            self._used.clear()
        cells = sorted({*self._notebook.cells_showing("explore("), *self._notebook.cells_showing("compare(")})
        whole = self._notebook.output(cells[int(number)]).locator(".lsys-panel").first
        whole.locator(PAINTED).first.wait_for()
        behind = whole.get_by_role("button", name="more", exact=True, expanded=False)
        while behind.count():  # it may have been left open, and then a panel is as high as it can be
            behind.first.click()
        self._number = number
        if number not in self._opening:
            self._opening[number] = {view for view, *_ in whole.evaluate(VISIBLE_VIEWS)} - {"rules"}
        self._looked_at = {*self._opening[number]}
        self._panel = whole.locator(".lsys-side").nth(["left", "right"].index(side)) if side else whole

    def slide(self, asked: str) -> None:
        """Bring a slider to a value, which changes what is seen."""
        name, value = asked.split()
        before, was = self._see(), control(self._panel, name).get_by_label(name, exact=True).input_value()
        self._use(control(self._panel, name))
        reach(self._hand, self._panel, name, value)
        if was != value:
            self._await_change(before)
        expect(self._panel.locator('[aria-busy="true"]')).to_have_count(0)
        expect(self._panel.locator(".lsys-message:visible")).to_have_count(0)

    def type(self, asked: str) -> None:
        """Type a value into the box of a slider."""
        name, value = asked.split()
        before, box = self._see(), control(self._panel, name).get_by_label(name, exact=True)
        self._use(control(self._panel, name))
        box.fill(value)
        box.press("Enter")
        expect(box).to_have_value(value)
        self._await_change(before)

    def press(self, name: str) -> None:
        """Press a button; one that stays pressed stays so."""
        button = self._panel.get_by_role("button", name=name, exact=True).first
        if button.get_attribute("aria-pressed") == "true":
            return
        before = self._see()
        button.click()
        if name in VIEWS and button.get_attribute("aria-pressed") == "true":
            expect(self._panel.locator(f'[data-view="{VIEWS[name]}"]').first).to_be_visible()
            self._use(self._panel.locator(f'[data-view="{VIEWS[name]}"]').first)
        else:
            self._use(button)
            self._await_change(before)

    def letter(self, name: str) -> None:
        """A constant that is a letter, with formulas in the word, becomes a number."""
        switch, formulas = control(self._panel, name).get_by_role("button", name=f"{name} as a letter"), ".lsys-word math"
        self._use(switch)
        expect(self._panel.locator(formulas).first).to_be_visible()
        switch.click()
        expect(self._panel.locator(formulas)).to_have_count(0)

    def play(self) -> None:
        """Let the steps go by to the last one."""
        self._panel.get_by_role("button", name="to step 0", exact=True).click()
        self._panel.get_by_role("button", name="play", exact=True).click()
        expect(self._panel.locator(".lsys-status")).to_contain_text("step 2: ")
        self._panel.get_by_role("button", name="pause", exact=True).click()

    def choose(self, asked: str) -> None:
        """Choose from a list behind *more*."""
        name, value = asked.split()
        self._panel.get_by_label(name, exact=True).select_option(value)

    def tick(self, name: str) -> None:
        canvas, box = self._panel.locator("canvas.lsys-canvas"), self._panel.get_by_label(name)
        self._use(box)
        if box.is_checked():
            return
        before = canvas.screenshot()
        box.check()
        for _ in range(PATIENCE):
            if canvas.screenshot() != before:
                return
        raise AssertionError("Nothing has changed")

    def click(self, what: str) -> None:
        """Click a stage, a tile of a gallery, or cells of the drawing until one is hit; it is lit."""
        if what == "stage":
            self._panel.locator("[data-place]").first.click()
            expect(self._panel.locator("[data-place]").first).to_have_attribute("aria-pressed", "true")
        elif what == "drawing":
            canvas = self._panel.locator("canvas.lsys-canvas")
            size = canvas.bounding_box()
            assert size
            for part in range(4, 40):
                canvas.click(position={"x": size["width"] / 2 + 17, "y": size["height"] * part / 48})
                if OF_A_MOTHER.search(self._panel.locator(".lsys-sentence").first.inner_text()):
                    break
            expect(self._panel.locator(".lsys-sentence").first).to_contain_text(OF_A_MOTHER)
        else:
            tile = self._panel.locator(".lsys-tile-button").nth(int(what.removeprefix("tile ")))
            tile.click()
            expect(tile).to_have_attribute("aria-pressed", "true")

    def drag(self, _: str) -> None:
        """Turn the drawing."""
        canvas = self._panel.locator("canvas.lsys-canvas")
        canvas.scroll_into_view_if_needed()
        size, before = canvas.bounding_box(), canvas.get_attribute("data-around")
        assert size
        with self._hand.pressed(size["x"] + size["width"] / 2, size["y"] + size["height"] / 2) as move:
            for part in range(1, 6):
                move(size["x"] + size["width"] / 2 + 20 * part, size["y"] + size["height"] / 2)
        expect(canvas).not_to_have_attribute("data-around", before or "")

    def scroll(self, _: str) -> None:
        """Move the stages sideways, where they are wider than their view."""
        body = self._panel.locator('[data-view="stages"] .lsys-body')
        if body.evaluate("body => body.scrollWidth > body.clientWidth + 1"):
            body.hover()
            self._notebook.page.mouse.wheel(200, 0)
            self._notebook.page.wait_for_timeout(200)
            assert body.evaluate("body => body.scrollLeft") > 0

    # -- rules

    def rules(self, asked: str) -> None:
        """Put something in the place of something in the rules; or `back`, the first ones."""
        before, back = self._see(), self._panel.get_by_role("button", name="back to the first rules").first
        if asked == "back":
            back.click()
            expect(back).to_be_hidden()
        else:
            self._edit(asked)
            self._await_change(before)
        self._notebook.page.wait_for_timeout(READ)
        self._notebook.idle()
        expect(self._panel.locator(".lsys-mistake").first).to_have_text("")

    def mistake(self, asked: str) -> None:
        """A change of the rules that the panel does not accept, and says why."""
        self._edit(asked)
        expect(self._panel.locator(".lsys-mistake").first).not_to_have_text("")

    def same_word(self, asked: str) -> None:
        """A change of the rules that changes no word."""
        before = self._panel.locator('[data-view="word"] .lsys-word').inner_text()
        self._edit(asked)
        self._notebook.page.wait_for_timeout(600)
        expect(self._panel.locator(".lsys-mistake").first).to_have_text("")
        assert self._panel.locator('[data-view="word"] .lsys-word').inner_text() == before

    @property
    def _area(self) -> Locator:
        return self._panel.get_by_label("rules of the model").first

    def _edit(self, asked: str) -> None:
        if not self._area.is_visible():
            self.press("rules")
        self._use(self._panel.locator('[data-view="rules"]').first)
        for change in asked.split(SEVERAL):
            old, new = change.split(BECOMES)
            self._area.click()
            at = self._area.input_value().find(old)
            assert at >= 0, f"The rules have no {old!r}:\n{self._area.input_value()}"
            self._area.evaluate("(area, [at, end]) => area.setSelectionRange(at, end)", [at, at + len(old)])
            self._keys(new)

    def _keys(self, text: str) -> None:
        if text:
            self._notebook.page.keyboard.insert_text(text)
        else:
            self._notebook.page.keyboard.press("Delete")

    # -- questions

    def vote(self, again: str = "") -> None:
        """Vote for the first option."""
        box = self._output("vote(", -1 if again else 0).get_by_role("region", name="vote")
        box.get_by_role("button").first.click()
        expect(box.get_by_role("button").first).to_have_attribute("aria-pressed", "true")

    def predict(self) -> None:
        """A prediction has been asked for; what answers it is there."""
        expect(self._output("predict(").get_by_role("region", name="prediction").get_by_role("status")).not_to_have_text("")

    def fill(self, id: str) -> None:
        """Fill the first cell of a table with what is right, and let it be checked."""
        table = next(each for each in declared(self._lesson).tables if each.id == id)
        whole = self._output(f'worksheet("{self._lesson}", "{id}"')
        sheet = whole.get_by_role("region", name="table to fill")
        self._use(sheet, *whole.locator("canvas.lsys-canvas:visible").all())
        sheet.get_by_role("textbox").first.fill(table.blanks[0][2].right[0])
        sheet.get_by_role("button", name="Check").click()
        sheet.locator('[data-mark="right"]').first.wait_for()

    def finder(self, step: str) -> None:
        """Move the slider of the steps of the rules that fit."""
        found = self._notebook.page.get_by_role("region", name="rules that fit")
        self._output("rule_finder(")
        for _ in range(int(step)):
            found.get_by_role("slider", name="Step").press("ArrowRight")
        expect(found.get_by_role("slider", name="Step")).to_have_attribute("aria-valuetext", re.compile(f"step {step} "))

    # -- cells

    def run(self) -> None:
        """The cells have been run, and nothing is wrong with them."""
        assert self._notebook.cell_errors() == []

    def cell(self, asked: str) -> None:
        """Put something in the place of something in a cell of code, and run it."""
        old, new = asked.split(BECOMES)
        number = self._notebook.cells_showing(old)[0]
        self._notebook.cell(number)
        self._notebook._ask(
            """const cell = panel.content.widgets[given[0]], editor = cell.editor;
            const at = cell.model.sharedModel.getSource().indexOf(given[1]);
            panel.content.activeCellIndex = given[0];
            panel.content.mode = 'edit';
            editor.setSelection({ start: editor.getPositionAt(at), end: editor.getPositionAt(at + given[1].length) });
            editor.focus();""",
            [number, old],
        )
        self._keys(new)
        self._notebook.run_by_key()
        assert self._notebook.cells_showing(new)[0] == number
        assert self._notebook.cell_errors() == []

    def new_cell(self, source: str) -> None:
        """A new cell at the end is run."""
        self._notebook._ask(
            """panel.content.activeCellIndex = panel.content.widgets.length - 1;
            await app.commands.execute('notebook:insert-cell-below');
            panel.content.mode = 'edit';
            panel.content.activeCell.editor.focus();"""
        )
        self._keys(source)
        self._notebook.run_by_key()
        assert self._notebook.cell_errors() == []

    def untick(self) -> None:
        """Take away the tick of a film."""
        film = self._output("animate(").locator('input[type="checkbox"]').first
        film.uncheck()
        expect(film).not_to_be_checked()
