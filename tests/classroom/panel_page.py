"""A panel in a page of a real browser without Jupyter: what the browser asks is answered by an explorer in this process."""

from __future__ import annotations

import json
from dataclasses import dataclass, field
from typing import Any

from playwright.sync_api import Browser, Locator, Page

from lsys_kit.classroom.panel.bundle import bundled, style
from lsys_kit.classroom.panel.explorer import Explorer

TRAITS = ("model", "step", "angle", "around", "above", "mark", "seed", "settings", "letters")
HOST = """
const handlers = {};
const host = {
  get: (name) => data[name],
  set(name, value) {
    const before = JSON.stringify(data[name]);
    data[name] = value;
    if (JSON.stringify(value) !== before) for (const handler of [...(handlers[name] ?? [])]) handler(value);
  },
  on(name, handler) {
    (handlers[name] ??= []).push(handler);
    return () => { handlers[name] = handlers[name].filter((each) => each !== handler); };
  },
  save: () => { window.asked.push("save"); },
  book: (settings) => ask({ kind: "book", ...settings }),
  async rules(text, constants) {
    const answer = await ask({ kind: "rules", text, constants });
    const same = ([name, value]) => JSON.stringify(data[name]) === JSON.stringify(value);
    const changed = Object.entries(answer.state ?? {}).filter((each) => !same(each));
    Object.assign(data, Object.fromEntries(changed)); // all at once, as in Jupyter; who listens is told in any order
    for (const [name, value] of window.inOrder(changed)) for (const handler of [...(handlers[name] ?? [])]) handler(value);
    return answer;
  },
  variants: () => ask({ kind: "variants" }),
  keep: (what, state) => ask({ kind: "keep", what, state }),
  keeps: ["svg", "page", "link"], editable: true, ahead: true,
};
window.asked = [];
window.answered = [];
window.inOrder = (changed) => changed;
window.delay = () => 0;
let answering = Promise.resolve();
const ask = (content) => {
  window.asked.push(content.kind);
  const answer = answering.then(() => window.kernel(content)) // one after another, as a kernel answers
    .then((found) => new Promise((resolve) => { setTimeout(() => resolve(found), window.delay()); }));
  answer.then(() => setTimeout(() => window.answered.push(content.kind))); // when the panel has shown it
  answering = answer;
  return answer;
};
const openOne = () => openPanel(document.getElementById("here"), host);
Object.assign(window, { host, data, openOne, handlersOf: () => handlers });
window.panel = window.openOne();
"""
PAPER = '<!doctype html><html lang="en"><head><meta charset="utf-8"><title>Panel</title></head>'


@dataclass
class PanelPage:
    """A page with a panel, and the explorer that answers it."""

    page: Page
    explorer: Explorer
    errors: list[str] = field(default_factory=list)

    @property
    def asked(self) -> list[str]:
        """What the browser has asked the kernel so far."""
        found: list[str] = self.page.evaluate("window.asked")
        return found

    def at(self, where: str) -> Locator:
        """The part of the panel that a selector finds."""
        return self.page.locator(where)

    def control(self, name: str) -> Locator:
        """The slider of a name."""
        return self.page.get_by_role("slider", name=f"{name}, slider", exact=True)

    def view(self, title: str) -> None:
        """Show or hide a view."""
        show_more(self.at(".lsys-panel").first)
        self.at(".lsys-tabs").get_by_role("button", name=title, exact=True).click()

    def more(self) -> None:
        """Show what stands behind "more"."""
        show_more(self.at(".lsys-panel").first)

    def shot(self, path: Any) -> None:
        """Keep a picture of the whole page."""
        self.page.screenshot(path=path, full_page=True)


def show_more(panel: Locator) -> None:
    """Show what stands behind "more" in a panel, where it is not shown already."""
    opener = panel.get_by_role("button", name="more", exact=True)
    if opener.get_attribute("aria-expanded") == "false":
        opener.click()


@dataclass
class Tab:
    """A tab of a browser, in which one panel after another may be opened."""

    page: Page
    shown: PanelPage | None = None

    def __post_init__(self) -> None:
        self.page.on("pageerror", lambda error: self._note(f"{error}"))
        self.page.on("console", lambda message: self._note(message.text) if message.type == "error" else None)
        self.page.on("dialog", lambda dialog: (self._note(dialog.message), dialog.dismiss()))
        self.page.expose_function("kernel", lambda content: answered(self.shown.explorer, content) if self.shown else {})

    def _note(self, error: str) -> None:
        if self.shown:
            self.shown.errors.append(error)


def open_tab(browser: Browser, **context: Any) -> Tab:
    """An empty tab of its own context."""
    return Tab(browser.new_context(**{"viewport": {"width": 1440, "height": 900}, **context}).new_page())


def open_panel(tab: Tab, explorer: Explorer, dark: bool = False) -> PanelPage:
    """A page with the panel of an explorer, in the place of what the tab has shown so far."""
    page = tab.page
    page.mouse.move(0, 0)
    page.goto("about:blank")
    tab.shown = PanelPage(page, explorer)
    theme = "false" if dark else "true"
    body = f'<body data-jp-theme-light="{theme}"><main id="here"></main></body></html>'
    page.set_content(f"{PAPER}<style>{style()}</style>{body}")
    data = json.dumps({name: getattr(explorer, name) for name in TRAITS})
    page.add_script_tag(content=f"{bundled('panel')}\nconst data = {data};\n{HOST}", type="module")
    page.locator("canvas[data-drawn]").first.wait_for()
    return tab.shown


def answered(explorer: Explorer, content: dict[str, Any]) -> dict[str, Any]:
    """What an explorer answers to a message."""
    replies: list[dict[str, Any]] = []
    explorer.send = lambda reply, buffers=None: replies.append(reply)
    explorer._answer(explorer, {"number": 1, **content}, [])
    state = {name: getattr(explorer, name) for name in TRAITS} if "opened" in replies[0] else {}
    return {**replies[0], "state": state}
