"""The course as static pages in a real browser: each page is opened from a file, asks for nothing, and its panels answer."""

from __future__ import annotations

import json
import re
from collections.abc import Callable, Iterator
from dataclasses import dataclass, field
from functools import lru_cache
from html import unescape
from itertools import pairwise
from pathlib import Path
from typing import Any
from urllib.parse import unquote

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, Page, Route, expect

from lsys_kit import read, system
from lsys_kit.classroom.course import course_files, is_lesson
from lsys_kit.classroom.lessons.lesson import declared
from lsys_kit.classroom.link import link as link_to
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.classroom.panel.controls import slider_ranges
from lsys_kit.classroom.site.showing import asked_settings
from lsys_kit.notation.model.arithmetic import number_text
from lsys_kit.notation.model.system import LSystem
from tests.browser.test_lessons import NOT_RIGHT, ONE_SCREEN, height_of, move_every_slider

pytestmark = [pytest.mark.slow, pytest.mark.browser]
AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
OF_COLOURS = ["color-contrast", "link-in-text-block"]
"""The rules of axe that what is light or dark can break; all others are for what stands in a page."""
PAGES = ["index.html", *(name.replace(".ipynb", ".html") for name in course_files() if name.endswith(".ipynb"))]
LESSONS = [name.replace(".ipynb", ".html") for name in course_files() if is_lesson(name)]

BROKEN = """[...document.querySelectorAll(":is(p, li):not(.part *) > code:not(.long)")]
    .filter((each) => each.getClientRects().length > 1).map((each) => each.textContent)"""
"""Short rules in the text that go on in another line."""


@dataclass
class Tab:
    """A tab in which one page after another is opened, what these ask for, and what they complain of."""

    page: Page
    asked: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        self.page.route("**/*", self.files_only)
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", lambda message: self.faults.append(message.text))

    def files_only(self, route: Route) -> None:
        self.asked.append(route.request.url)
        if route.request.url.startswith("file:"):
            route.continue_()
        else:
            route.abort()


@pytest.fixture(scope="module")
def tabs(browser: Browser) -> Callable[..., Tab]:
    """A tab for each choice of a context; what a page keeps in the browser is gone after each test."""

    @lru_cache
    def tab(is_phone: bool = False, **choices: Any) -> Tab:
        size = {"width": 400, "height": 800} if is_phone else {"width": 1440, "height": 900}
        return Tab(browser.new_context(**{"viewport": size, "has_touch": is_phone, **choices}).new_page())

    return tab


@pytest.fixture
def opened(tabs: Callable[..., Tab], site: Path) -> Iterator[Callable[..., Page]]:
    """Opens a page from its file; whatever else it asks for, or complains of, is a fault."""
    used: list[Tab] = []

    def open_one(name: str, **choices: Any) -> Page:
        tab = tabs(**choices)
        used.append(tab)
        if tab.page.url != "about:blank":
            tab.page.goto("about:blank")
        tab.page.mouse.move(0, 0)
        tab.page.goto((site / name).as_uri())
        return tab.page

    yield open_one
    for tab in used:
        if tab.page.url != "about:blank":  # which has no storage
            tab.page.evaluate("localStorage.clear()")
            tab.page.goto("about:blank")
        faults, asked = [*tab.faults], [*tab.asked]
        tab.faults.clear()
        tab.asked.clear()
        assert faults == []
        assert all(url.startswith(site.as_uri()) for url in asked)


def all_parts_open(page: Page) -> None:
    """Every part is in its place, but for those that a prediction still hides."""
    expect(page.locator("[data-part]:not([data-open]):not([data-answer] *)")).to_have_count(0)


def test_every_picture_is_shown_in_its_place(opened: Callable[..., Page]) -> None:
    """First those that are in view: a place has its size from the beginning, so that nothing moves."""
    page = opened("notebooks/gallery.html")
    pictures = page.locator("img[data-part]")
    sizes = pictures.evaluate_all("(all) => all.map((each) => [each.width, each.height])")
    all_parts_open(page)
    assert pictures.count() > 50
    page.evaluate("Promise.all([...document.images].map((each) => each.decode()))")
    assert pictures.evaluate_all("(all) => all.map((each) => [each.width, each.height])") == sizes
    assert all(src.startswith("blob:") for src in pictures.evaluate_all("(all) => all.map((each) => each.src)"))


def test_a_link_that_no_panel_of_a_page_shows_is_said_to_lead_elsewhere(opened: Callable[..., Page]) -> None:
    page = opened("notebooks/01_all_at_once.html")
    message = page.locator("main > .lsys-message")
    for fragment, said in (
        (link_to(system("K9")), "leads to another model"),
        (link_to(system("K9"))[:-3], "is broken"),
        ("#lsys=", "is broken"),
        ("#top", ""),
    ):
        page.evaluate("fragment => { location.hash = fragment; }", fragment)
        page.reload()
        expect(message).to_contain_text(said) if said else expect(message).to_have_count(0)


def test_what_was_typed_is_there_again_when_a_page_is_loaded_once_more(opened: Callable[..., Page]) -> None:
    page = opened("notebooks/01_all_at_once.html")
    all_parts_open(page)
    first, second = (page.get_by_role("region", name="vote").nth(place) for place in (0, 1))
    first.get_by_role("button").nth(3).click()
    asked = page.get_by_role("region", name="prediction").filter(has_text="How long is the filament?")
    asked.get_by_role("textbox").fill("21")
    asked.get_by_role("button", name="Show", exact=True).click()
    sheet = page.get_by_role("region", name="table to fill").first
    for name, entry in (("step 1: all at once", "3"), ("step 1: rule after rule", "2"), ("step 2: all at once", "abc")):
        sheet.get_by_role("textbox", name=name).fill(entry)
    sheet.get_by_role("button", name="Check").click()
    sheet.get_by_role("textbox", name="step 1: all at once").fill("2")
    page.wait_for_timeout(600)
    page.reload()
    all_parts_open(page)
    expect(first.get_by_role("button").nth(3)).to_have_attribute("aria-pressed", "true")
    expect(second.locator(".lsys-before")).to_have_text("Your first vote was D.")
    expect(asked.get_by_role("status")).to_have_text("You said: 21The answer: 34")
    second.locator("summary").click()
    expect(second.locator(".lsys-predicted li")).to_have_text(
        "Step 6 has 13 long cells and 8 short ones. How long is the filament?You said: 21The answer: 34"
    )
    box = sheet.get_by_role("textbox", name="step 1: all at once")
    expect(box).to_have_value("2")
    expect(sheet.locator("[data-mark='no number']")).to_have_text("? no number")
    sheet.get_by_role("button", name="Check").click()
    expect(sheet.locator(".lsys-mark").first).to_have_text("✓ right; first you said 3")
    sheet.get_by_role("button", name="Start again").click()
    asked.get_by_role("button", name="Start again").click()
    first.get_by_role("button", name="Start again").click()
    page.reload()
    all_parts_open(page)
    expect(box).to_have_value("")
    expect(asked.get_by_role("textbox")).to_have_value("")
    expect(second.locator(".lsys-before")).to_have_text("You did not vote the first time.")


def shot(page: Page, name: str, config: pytest.Config) -> None:
    folder = config.getoption("screenshots")
    if folder:
        Path(folder).mkdir(parents=True, exist_ok=True)
        page.screenshot(path=Path(folder) / f"site-{name.replace('/', '-')}.png", full_page=True)


def panels_of(page: Path) -> Iterator[dict[str, Any]]:
    """What a page knows of each of its panels."""
    data = json.loads(re.search(r'id="lsys-data">(.*?)</script>', page.read_text("utf-8"))[1])
    for part in data["parts"]:
        part = part["data"]["panel"] if part["kind"] == "beside" else part
        sides = [part["data"]] if part["kind"] == "panel" else [part["data"].get(side) for side in ("left", "right")]
        yield from (panel for panel in sides if panel and panel["mode"] not in ("map", "tissue"))


def held_by(model: dict[str, Any], fixed: dict[str, str], asked: dict[str, str]) -> bool:
    """Whether a panel has the book of some values of its sliders, all others being at their first."""
    texts = {name: [text] for name, text in fixed.items()} | {each["name"]: each["texts"] for each in model["constants"]}
    texts["seed"] = [asked.get("seed", "")] if model.get("thrown") else model["seeds"] or [str(model["seed"])]
    first = fixed | {each["name"]: each["texts"][each["index"]] for each in model["constants"]} | {"seed": str(model["seed"])}
    away = [name for name, value in asked.items() if value != first[name]]
    return all(value in texts[name] for name, value in asked.items()) and (
        len(away) < 2 or {*away} <= {name or "seed" for name in model["together"]}
    )


@pytest.mark.parametrize("name", LESSONS)
def test_every_slider_moves_and_reaches_what_the_lesson_asks_for(site: Path, name: str) -> None:
    lesson, offered, moved = declared(Path(name).stem), set(), set()
    for panel in panels_of(site / name):
        model, fixed, said = panel["model"], panel["fixed"], panel["model"]["fixed"]
        whole = read(panel["system"]["text"], panel["system"]["notation"])
        sliders, moving = slider_ranges(whole, fixed).keys(), {each["name"] for each in model["constants"]}
        assert all(len(each["texts"]) > 1 for each in model["constants"])
        assert all(f"{constant} = " in said for constant in sliders - moving)
        chance = is_by_chance(whole)
        assert model["chance"] or not chance or "seed = " in said
        possible = {*sliders, *(["seed"] if chance else [])}
        offered |= sliders
        moved |= moving
        for row in asked_settings(lesson, possible - {*model["without"]}):
            assert held_by(model, fixed, {each: number_text(value) for each, value in row.items()}), (row, said)
    named = ([word for word in re.findall(r"\w+", table.columns[0]) if word in offered] for table in lesson.tables)
    assert {words[0] for words in named if words} <= moved, "no panel of the lesson moves what its tables ask for"


def is_by_chance(of: LSystem) -> bool:
    return bool(book(of, {}, 0)["chance"])


def test_no_page_is_larger_than_a_photograph(site: Path) -> None:
    pages = [site / "notebooks/gallery.html", *filter(Path.exists, (site / name for name in LESSONS))]
    assert {page.name: size for page in pages if (size := page.stat().st_size) > 1_200_000} == {}


def test_a_printed_sheet_of_exercises_has_lines_for_answers(opened: Callable[..., Page]) -> None:
    page = opened(LESSONS[1].replace("notebooks", "exercises"), reduced_motion="reduce")
    page.emulate_media(media="print")
    questions = page.locator(".question:visible")
    assert questions.count() == page.locator(".room:visible").count() == 5
    assert "score(" not in page.locator("main").inner_text()
    assert "run its cell" not in page.locator("main").inner_text()


def test_a_printed_lesson_is_a_worksheet(opened: Callable[..., Page]) -> None:
    page = opened(LESSONS[1], reduced_motion="reduce")  # a tab of its own, which stays paper
    page.emulate_media(media="print")
    all_parts_open(page)
    expect(page.locator(".lsys-side canvas[data-drawn]").first).to_be_visible()
    assert page.locator("button:visible:not(.lsys-option), input[type=range]:visible, details:not([open]):visible").count() == 0
    assert page.locator(".lsys-option:visible, td input:visible, .lsys-predict input:visible").count() > 10
    assert len({side.evaluate("side => side.offsetTop") for side in page.locator(".lsys-side").all()[:2]}) == 1


@pytest.mark.parametrize("name", LESSONS)
def test_nothing_that_is_printed_is_cut_or_takes_most_of_a_page(opened: Callable[..., Page], name: str) -> None:
    page = opened(name, reduced_motion="reduce")
    page.set_viewport_size({"width": 794, "height": 1123})  # A4
    page.emulate_media(media="print")
    all_parts_open(page)
    tables, whole = page.locator(".lsys-scroll"), page.locator(".output :is(img, svg), .part-vote")
    assert tables.evaluate_all("(all) => all.every((each) => each.scrollWidth <= each.clientWidth + 1)")
    assert whole.evaluate_all("(all) => all.every((each) => each.getBoundingClientRect().height < 600)")


@pytest.mark.parametrize("name", LESSONS)
def test_a_lesson_is_worked_through_without_a_kernel(opened, pytestconfig, name: str) -> None:
    page = opened(name)
    all_parts_open(page)
    answer_predictions(page)
    cast_votes(page)
    check_tables(page)
    panels = page.locator(".part .lsys-panel:not(.lsys-both .lsys-panel)")
    assert panels.count()
    for place in range(panels.count()):
        assert height_of(panels.nth(place)) <= ONE_SCREEN
        move_every_slider(panels.nth(place))
    shot(page, name, pytestconfig)


def answer_predictions(page: Page) -> None:
    """Type something for the first prediction, and ask to see all others; only then is the answer there."""
    asked = page.get_by_role("region", name="prediction")
    for place in range(asked.count()):
        shown = page.locator(".part-prediction").nth(place).locator("[data-answer]")
        expect(shown).to_have_count(0)
        if place:
            asked.nth(place).get_by_role("button", name="I have no idea, show me").click()
        else:
            asked.nth(place).get_by_role("textbox").fill("21")
            asked.nth(place).get_by_role("button", name="Show", exact=True).click()
            expect(asked.nth(place).get_by_role("status")).to_contain_text("You said: 21")
        expect(shown).to_be_visible()


def cast_votes(page: Page) -> None:
    """Vote for the first option, and for the second at the end, which is replied to."""
    for place, said in enumerate(("Your vote, A, is kept.", "ight.")):
        box = page.get_by_role("region", name="vote")
        if box.count() > place:
            box.nth(place).get_by_role("button").nth(place).click()
            expect(box.nth(place).get_by_role("status")).to_contain_text(said)
    if page.get_by_role("region", name="vote").count() > 1:
        expect(page.get_by_role("region", name="vote").nth(1)).to_contain_text("Your first vote was A.")


def check_tables(page: Page) -> None:
    """Fill each table with what is hardly right, and let it be checked."""
    sheets = page.get_by_role("region", name="table to fill")
    for place in range(sheets.count()):
        sheets.nth(place).get_by_role("textbox").first.fill("no idea")
        sheets.nth(place).get_by_role("button", name="Check").click()
        expect(sheets.nth(place).get_by_role("status")).to_contain_text(NOT_RIGHT)


@pytest.mark.parametrize("name", PAGES)
def test_a_page_fits_a_phone_and_axe_finds_nothing(opened, pytestconfig, name: str) -> None:
    """Dark when it is opened, then light, as when the morning comes."""
    page = opened(name, is_phone=True, color_scheme="dark")
    all_parts_open(page)
    assert page.evaluate("document.documentElement.lang") == "en"
    page.evaluate(AXE.read_text(encoding="utf-8"))
    for scheme, asked in (("dark", {}), ("light", {"runOnly": OF_COLOURS})):
        page.emulate_media(color_scheme=scheme)
        assert page.evaluate("document.documentElement.scrollWidth") <= 400
        assert page.evaluate(BROKEN) == []
        found = page.evaluate(
            """async (asked) => (await axe.run({ resultTypes: ["violations"], ...asked })).violations
            .map((each) => [each.id, ...each.nodes.slice(0, 3).map((node) => node.html.slice(0, 200))])""",
            asked,
        )
        assert found == [], f"{scheme}: {json.dumps(found, indent=1)}"
        shot(page, f"{name}-{scheme}", pytestconfig)
    page.emulate_media(color_scheme="dark")
    labels = page.locator(".lsys-lesson").evaluate_all("(all) => all.map((each) => each.ariaLabel)")
    assert len(labels) == len({*labels})


def test_a_lesson_is_done_with_its_second_vote_and_the_first_page_knows(opened: Callable[..., Page]) -> None:
    page = opened(LESSONS[0])
    page.evaluate("localStorage.clear()")
    page = opened(LESSONS[0])
    all_parts_open(page)
    box = page.get_by_role("checkbox", name="I have done this lesson")
    cast_votes(page)
    expect(box).to_be_checked()
    page = opened("index.html")
    rows, told = page.locator("[data-lesson]"), page.get_by_role("status")
    expect(told).to_have_text(f"You have done 1 of {rows.count()} lessons. Go on with 1 · All at once.")
    assert rows.evaluate_all("(all) => all.map((each) => each.hasAttribute('data-done'))").count(True) == 1
    page.get_by_role("checkbox", name="All at once: done").check()
    page.get_by_role("checkbox", name="Five characters, one plant: done").uncheck()
    page.reload()
    expect(told).to_contain_text("You have done 1 of")
    expect(page.get_by_role("checkbox", name="All at once: done")).to_be_checked()
    page = opened(LESSONS[0])
    all_parts_open(page)
    expect(page.get_by_role("checkbox", name="I have done this lesson")).not_to_be_checked()
    page.evaluate("localStorage.clear()")


def test_the_first_page_has_a_picture_of_each_lesson_in_its_own_colours(opened: Callable[..., Page]) -> None:
    page = opened("index.html", color_scheme="dark")
    all_parts_open(page)
    pictures = page.locator("[data-lesson] img")
    assert pictures.count() == page.locator("[data-lesson]").count()
    page.evaluate("Promise.all([...document.images].map((each) => each.decode()))")
    assert all(width > 100 for width in pictures.evaluate_all("(all) => all.map((each) => each.naturalWidth)"))


@pytest.mark.parametrize("name", PAGES)
def test_headings_are_in_order_and_links_lead_to_what_is_there(opened, site: Path, name: str) -> None:
    page = opened(name, java_script_enabled=False)
    tags = page.locator("h1, h2, h3, h4, h5").evaluate_all("found => found.map(each => each.tagName)")
    levels = [int(tag[1]) for tag in tags]
    assert levels[0] == 1
    assert levels.count(1) == 1
    assert all(after <= before + 1 for before, after in pairwise(levels))
    for link in page.locator("a").evaluate_all("found => found.map(each => each.getAttribute('href'))"):
        file, _, place = link.partition("#")
        target = (site / name).parent / file if file else site / name
        assert target.is_file(), link
        if place:
            assert f'id="{unquote(place)}"' in unescape(target.read_text("utf-8")), link


def test_a_page_is_left_by_keys_and_its_skip_link_leads_to_the_text(opened) -> None:
    page = opened(LESSONS[0])
    all_parts_open(page)
    page.keyboard.press("Tab")
    expect(page.locator(".skip")).to_be_focused()
    page.keyboard.press("Enter")
    assert page.url.endswith("#main")
    page.keyboard.press("Tab")
    assert page.evaluate("document.querySelector('main').contains(document.activeElement)")


def test_without_scripts_every_question_can_be_read_and_every_answer_opened(opened) -> None:
    page = opened(LESSONS[0], java_script_enabled=False)
    predictions = page.locator(".part-prediction details")
    for place in range(predictions.count()):
        expect(predictions.nth(place).locator("[data-answer]")).to_be_hidden()
        predictions.nth(place).locator("summary").click()
        expect(predictions.nth(place).locator("[data-answer]")).to_be_visible()
    for part in page.locator(".part").all():
        assert part.inner_text().strip()
