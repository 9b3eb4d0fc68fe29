"""A class in real browsers: a board for the projector and two phones with touch, and the server is killed in the middle."""

from __future__ import annotations

import io
import re
import shutil
from collections.abc import Iterator
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import axe_playwright_python
import nbformat
import pytest
import zxingcpp
from PIL import Image
from playwright.sync_api import Browser, Locator, Page, Request, expect

from lsys_kit.classroom.authoring.new import write_lesson
from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.live.course_pages import PAGES, mark_made
from lsys_kit.classroom.live.server import PATIENCE, PING
from lsys_kit.classroom.site.build import build_site
from lsys_kit.classroom.site.pages import CLASS
from tests.classroom.live_class import Network, Process, started

pytestmark = [pytest.mark.slow, pytest.mark.browser]
AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
NAMES = ("notebooks/01_all_at_once.ipynb", "exercises/01_all_at_once.ipynb", "notebooks/07_life_spans.ipynb")
EXPECTED_NOISE = re.compile(r"WebSocket connection to|net::ERR_(CONNECTION_(REFUSED|RESET)|EMPTY_RESPONSE)")
"""What a browser says of a server that was killed."""


@dataclass
class Visitor:
    """A tab, what it asked for, what it complained of, and the address of the server as it knows it, if that is another one."""

    page: Page
    asked: list[str] = field(default_factory=list)
    faults: list[str] = field(default_factory=list)
    own: str = ""

    def __post_init__(self) -> None:
        self.page.on("request", lambda request: self.asked.append(_address(request)))
        self.page.on("pageerror", lambda error: self.faults.append(str(error)))
        self.page.on("console", lambda message: self.faults.append(message.text))


def _address(request: Request) -> str:
    return request.url


@dataclass
class Class:
    """A class: its server, its board and two phones."""

    server: Process
    board: Visitor
    phones: list[Visitor]

    @property
    def all(self) -> list[Visitor]:
        return [self.board, *self.phones]


@pytest.fixture(scope="module")
def pages(tmp_path_factory: pytest.TempPathFactory, kernels: None) -> Path:
    """A folder of a class with some of the pages of the course, as those of all are made."""
    folder, course = tmp_path_factory.mktemp("pages"), tmp_path_factory.mktemp("course")
    for name in NAMES:
        (course / name).parent.mkdir(exist_ok=True)
        shutil.copy(course_files()[name], course / name)
    build_site(folder / PAGES, course, live=CLASS)
    mark_made(folder / PAGES)
    return folder


@pytest.fixture
def live(browser: Browser, pages: Path, tmp_path: Path) -> Iterator[Class]:
    folder = tmp_path / "class"
    shutil.copytree(pages, folder)
    server = started(folder, course=True)

    def visitor(width: int, height: int, **choices: Any) -> Visitor:
        return Visitor(browser.new_context(viewport={"width": width, "height": height}, **choices).new_page())

    found = Class(server, visitor(1440, 900), [visitor(400, 800, has_touch=True, is_mobile=True) for _ in range(2)])
    found.board.page.goto(server.board)
    yield found
    for each in found.all:
        each.page.context.close()
    found.server.kill()
    faults = [fault for each in found.all for fault in each.faults if not EXPECTED_NOISE.search(fault)]
    assert faults == []
    own = server.join.removesuffix(f"/{server.code}/")
    strange = [
        url
        for each in found.all
        for url in each.asked
        if not url.startswith(
            (own, own.replace("http", "ws"), each.own or own, (each.own or own).replace("http", "ws"), "data:", "blob:")
        )
    ]
    assert strange == []


def shot(page: Page, name: str, config: pytest.Config) -> None:
    if folder := config.getoption("screenshots"):
        Path(folder).mkdir(parents=True, exist_ok=True)
        page.screenshot(path=Path(folder) / f"class-{name}.png")


def read_codes(page: Page, size: tuple[int, int] | None = None) -> list[str]:
    """What the QR codes on a screen say, as a phone's camera reads them; of a given size, as from afar."""
    seen = Image.open(io.BytesIO(page.screenshot())).convert("L")
    return [each.text for each in zxingcpp.read_barcodes(seen.resize(size) if size else seen)]


def kept(phone: Page) -> None:
    expect(phone.locator(".tick[data-kept=true]")).to_be_visible()


def opens(board: Page, text: str) -> None:
    """Open the question whose entry in the list begins so, and wait until it is seen."""
    option = board.locator(".board-items option", has_text=text).first
    board.locator(".board-items").select_option(option.get_attribute("value"))
    board.get_by_role("button", name="Open", exact=True).click()
    expect(board.locator("#here")).to_have_attribute("data-kind", text.partition(":")[0])


def serious(page: Page) -> list[str]:
    """What axe finds that is serious."""
    page.context.new_cdp_session(page).send("Page.setBypassCSP", {"enabled": True})
    page.evaluate(AXE.read_text("utf-8"))
    found = page.evaluate("axe.run()")
    return [f"{each['id']}: {each['nodes'][0]['html'][:200]}" for each in found["violations"]]


def test_a_lesson_with_two_phones_and_a_server_that_is_killed(live: Class, pytestconfig: pytest.Config) -> None:
    board, phones = live.board.page, [each.page for each in live.phones]
    expect(board.locator(".board-letters")).to_have_text(live.server.code)
    [joined] = read_codes(board)
    assert read_codes(board, (480, 300)) == [joined], "also from afar"
    assert joined.endswith(f"/{live.server.code}/")
    assert joined.split("//")[1].split(":")[1] == live.server.join.split("//")[1].split(":")[1]
    shot(board, "board-join", pytestconfig)
    for phone in phones:
        phone.goto(live.server.join)
        expect(phone.locator("#link[data-there=true]")).to_be_visible()
    expect(board.locator("#present")).to_have_text(re.compile("2 here"))

    # The first vote, with a remote control
    board.keyboard.press("PageDown")
    for phone, choice in zip(phones, (0, 2), strict=True):
        phone.locator(".choice").nth(choice).tap()
        kept(phone)
    expect(board.locator(".board-count strong")).to_have_text("2")
    expect(board.locator(".board-bar")).to_have_count(0)
    shot(board, "board-vote", pytestconfig)
    shot(phones[0], "phone-vote", pytestconfig)
    board.keyboard.press("PageDown")
    expect(board.locator(".board-bar strong")).to_have_text(["1", "0", "1", "0"])
    shot(board, "board-bars", pytestconfig)

    # The server is killed; what is chosen meanwhile is sent again, and counted once
    live.server.kill()
    expect(phones[0].locator("#link[data-there=false]")).to_be_visible()
    phones[0].locator(".choice").nth(1).tap()
    expect(phones[0].locator(".tick[data-kept=true]")).to_have_count(0)
    port = int(live.server.join.split(":")[2].split("/")[0])
    live.server = started(live.server.folder, port, course=True)
    kept(phones[0])
    expect(board.locator(".board-bar strong")).to_have_text(["0", "1", "1", "0"])

    # The second vote
    board.keyboard.press("PageDown")
    expect(phones[0].locator(".choice").first).to_be_disabled()
    expect(board.locator(".board-kind")).to_contain_text("closed")
    board.keyboard.press("PageDown")
    for phone in phones:
        expect(phone.locator(".phone-kind")).to_have_text("Second vote")
        phone.locator(".choice").nth(2).tap()
        kept(phone)
    board.keyboard.press("PageDown")
    expect(board.locator(".board-option[data-right]")).to_contain_text("Program 3")
    expect(board.locator(".board-changes")).to_contain_text(
        "1 from wrong to right, 0 from right to wrong, of 2 who voted twice"
    )
    expect(phones[0].locator(".phone-reply")).to_contain_text("Right")
    shot(board, "board-second", pytestconfig)
    shot(phones[0], "phone-second", pytestconfig)
    assert board.evaluate("document.documentElement.scrollHeight <= innerHeight")

    # Be the cell, for three steps
    board.locator(".board-items").select_option("game J1")
    board.get_by_role("button", name="Open", exact=True).click()
    for step in (1, 2, 3):
        for phone in phones:
            expect(phone.locator(".phone-kind").first).to_have_text(f"You are the cell: step {step}")
            for cell in phone.locator(".one-cell").all():
                cell.locator(".choice").first.tap()
            kept(phone)
        board.keyboard.press("s")
        expect(board.locator(".board-verdict")).to_be_visible()
        shot(board, f"board-cells-{step}", pytestconfig)
        shot(phones[0], f"phone-cells-{step}", pytestconfig)
        if step < 3:
            board.keyboard.press("n")

    # A prediction, in words: of the last answer nothing is left to be seen
    board.keyboard.press("f")
    opens(board, "prediction: Step 3 is")
    for phone, text in zip(phones, ("bl ar bl ar ar", "<b>8</b> cells"), strict=True):
        expect(phone.locator(".phone-kind")).to_have_text("Prediction")
        expect(phone.locator(".tick[data-kept=true]")).to_have_count(0)
        phone.locator("input[type=text]").fill(text)
        phone.get_by_role("button", name="Send").tap()
        kept(phone)
    board.keyboard.press("s")
    board.locator(".board-word", has_text="bl ar bl ar ar").click()
    expect(board.locator(".board-word[aria-pressed=true]")).to_have_text(re.compile("✓ bl ar bl ar ar"))
    expect(board.locator(".board-words")).to_contain_text("<b>8</b> cells")
    shot(board, "board-words", pytestconfig)

    # On the pages of the course: a table, rules, a plant, an exercise
    phones[0].goto(f"{live.server.join}course/notebooks/01_all_at_once.html")
    sheet = phones[0].get_by_role("region", name="table to fill").first
    for number, text in enumerate(("2", "2", "3", "5")):
        sheet.locator("input").nth(number).fill(text)
    sheet.get_by_role("button", name="Check").tap()
    expect(phones[0].locator(".class-status")).to_contain_text("kept")
    panel = phones[0].locator(".part-beside .lsys-panel:not(.lsys-both, .lsys-both *)").first
    panel.get_by_role("button", name="rules", exact=True).tap()
    rules = panel.locator("textarea")
    rules.fill(rules.input_value().replace("br -> ar\n", ""))
    expect(panel.locator(".lsys-status")).to_contain_text("step 4: 6 cells", timeout=60_000)
    panel.get_by_role("button", name="more", exact=True).tap()
    panel.get_by_role("button", name="to the wall").tap()
    expect(panel.locator("output")).to_have_text("sent to the wall", timeout=60_000)
    opens(board, "table: How many cells")
    board.keyboard.press("s")
    expect(board.locator(".board-blank").first).to_have_text("1 / 1")
    shot(board, "board-table", pytestconfig)
    board.locator(".board-items").select_option("wall")
    board.get_by_role("button", name="Open", exact=True).click()
    expect(board.locator(".board-wall img")).to_have_count(1)
    board.wait_for_timeout(300)
    shot(board, "board-wall", pytestconfig)
    phones[1].goto(f"{live.server.join}course/exercises/01_all_at_once.html")
    exercise = phones[1].locator(".part-exercise").first
    exercise.locator("input").fill("al al br")
    exercise.get_by_role("button", name="Check").tap()
    expect(exercise.locator(".lsys-said")).to_contain_text("Almost", timeout=60_000)
    exercise.get_by_role("button", name="A hint").tap()
    expect(exercise.locator(".lsys-said")).to_contain_text("Hint 1 of 3", timeout=60_000)
    shot(phones[1], "phone-exercise", pytestconfig)
    board.get_by_role("button", name="Finish", exact=True).click()
    opens(board, "exercise: 1.1")
    board.keyboard.press("s")
    expect(board.locator(".board-replies")).to_contain_text("one step too early")
    shot(board, "board-exercise", pytestconfig)


def test_a_phone_whose_network_is_gone_for_a_while_loses_nothing(live: Class, pytestconfig: pytest.Config) -> None:
    """The network goes without a word: the phone finds out, and sends again when it is back. A thorough test waits until
    the server has given it up."""
    board, phone = live.board.page, live.phones[0].page
    network = Network(int(live.server.join.split(":")[2].split("/")[0]))
    join = f"http://127.0.0.1:{network.port}/{live.server.code}/"
    live.phones[0].own = join.removesuffix(f"/{live.server.code}/")
    try:
        phone.goto(join)
        expect(phone.locator("#link[data-there=true]")).to_be_visible()
        board.keyboard.press("PageDown")
        expect(phone.locator(".choice")).to_have_count(4)
        network.is_there(False)
        phone.locator(".choice").nth(2).tap()
        expect(phone.locator("#link[data-there=false]")).to_be_visible()
        expect(phone.locator(".choice").nth(2)).to_have_attribute("aria-pressed", "true")
        phone.wait_for_timeout(1_000 * (PING + PATIENCE + 5) if pytestconfig.getoption("--thorough") else 7_000)
        expect(phone.locator(".tick[data-kept=true]")).to_have_count(0)
        shot(phone, "phone-no-network", pytestconfig)
        network.is_there(True)
        kept(phone)
        expect(board.locator(".board-count strong")).to_have_text("1")
        expect(board.locator("#present")).to_have_text(re.compile("1 here"))
    finally:
        phone.goto("about:blank")
        network.close()


def test_one_practises_on_the_page_of_exercises(live: Class, pytestconfig: pytest.Config) -> None:
    phone = live.phones[0].page
    phone.goto(f"{live.server.join}course/exercises/01_all_at_once.html")
    place = phone.locator(".exercise-practice")
    place.scroll_into_view_if_needed()
    expect(place.locator("h3")).to_contain_text("level 1", timeout=60_000)
    for level in (1, 1, 2):
        expect(place.locator("h3")).to_contain_text(f"level {level}", timeout=60_000)
        word, rules, steps = asked_by(place)
        for _ in range(steps):
            word = " ".join(rules.get(each, each) for each in word.split())
        place.locator("input").fill(word)
        place.get_by_role("button", name="Check").tap()
        expect(place.locator(".lsys-said")).to_contain_text("Correct", timeout=60_000)
        before = place.locator("pre").inner_text()
        place.get_by_role("button", name="Another exercise").tap()
        expect(place.locator("pre")).not_to_have_text(before, timeout=60_000)
    place.locator("input").fill(asked_by(place)[0])
    place.get_by_role("button", name="Check").tap()
    place.get_by_role("button", name="A hint").tap()
    expect(place.locator(".lsys-said")).to_contain_text("Hint 1 of 3", timeout=60_000)
    shot(phone, "phone-practice", pytestconfig)
    place.locator("select").select_option("misprint")
    expect(place.locator("h3")).to_contain_text("misprint", timeout=60_000)
    assert serious(phone) == []


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_a_page_that_is_being_made_opens_by_itself(
    browser: Browser, tmp_path: Path, scheme: Any, pytestconfig: pytest.Config
) -> None:
    """The board tells how many pages are there; the phone is told to wait, and goes on when its page is."""
    course, go_on = write_lesson("ferns", tmp_path / "ferns"), tmp_path / "go_on"
    notebook = nbformat.read(course / "notebooks" / "ferns.ipynb", 4)
    waits = f"import pathlib, time\n\nwhile not pathlib.Path({str(go_on)!r}).exists():\n    time.sleep(0.1)"
    notebook.cells.append(nbformat.v4.new_code_cell(waits))
    nbformat.write(notebook, course / "notebooks" / "ferns.ipynb")
    server = started(tmp_path / "class", course=course)
    try:
        board, phone = (
            browser.new_context(viewport={"width": width, "height": 900}, color_scheme=scheme).new_page()
            for width in (1440, 400)
        )
        phone.goto(f"{server.join}course/index.html")
        expect(phone.get_by_role("heading", name="This page is being made.")).to_be_visible()
        assert serious(phone) == []
        board.goto(server.board)
        expect(board.locator("#present")).to_contain_text("pages of the course: 1 of 3", timeout=60_000)
        assert serious(board) == []
        shot(board, f"board-making-{scheme}", pytestconfig)
        expect(phone.locator("#progress")).to_contain_text("1 of 3.", timeout=60_000)
        shot(phone, f"phone-making-{scheme}", pytestconfig)
        go_on.touch()
        expect(phone.get_by_role("link", name="Ferns").first).to_be_visible(timeout=120_000)
        expect(board.locator("#present")).to_have_text(re.compile(rf"0 here · {server.code}$"))
        shot(phone, f"phone-made-{scheme}", pytestconfig)
        phone.goto(server.join)
        phone.get_by_role("link", name="The course").click()
        expect(phone.get_by_role("link", name="Ferns").first).to_be_visible()
    finally:
        server.kill()
        for page in (board, phone):
            page.context.close()


def asked_by(place: Locator) -> tuple[str, dict[str, str], int]:
    """The axiom, the rules and the number of steps of an exercise on words by hand."""
    lines = [line.strip() for line in place.locator("pre").inner_text().splitlines() if line.strip()]
    rules = dict(re.split(" +-> +", line, maxsplit=1) for line in lines[1:])
    steps = re.search(r"word of step (\d+)", place.inner_text())
    assert steps
    return lines[0].removeprefix("axiom:").strip(), rules, int(steps[1])


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_board_and_phone_have_no_finding_of_axe(live: Class, scheme: Any, pytestconfig: pytest.Config) -> None:
    board, phone = live.board.page, live.phones[0].page
    for page in (board, phone):
        page.emulate_media(color_scheme=scheme)
    phone.goto(live.server.join)
    expect(board.locator(".board-letters")).to_be_visible()
    assert serious(board) + serious(phone) == []
    for opened in ("0", "game K16", "wall"):
        board.locator(".board-items").select_option(opened) if opened != "0" else None
        board.get_by_role("button", name="Open", exact=True).click()
        expect(
            phone.locator("h2", has_text="The wall") if opened == "wall" else phone.locator(".choices").first
        ).to_be_visible()
        assert serious(board) + serious(phone) == []
        if opened != "wall":
            for cell in phone.locator(".choices").all():
                cell.locator(".choice").first.tap()
            kept(phone)
            board.get_by_role("button", name="Show", exact=True).click()
            expect(board.get_by_role("button", name="Hide", exact=True)).to_be_visible()
            assert serious(board) + serious(phone) == []
        shot(board, f"board-{opened.replace(' ', '-')}-{scheme}", pytestconfig)
        shot(phone, f"phone-{opened.replace(' ', '-')}-{scheme}", pytestconfig)
    phone.goto(live.server.join.rsplit("/", 2)[0] + "/")
    assert serious(phone) == []
    phone.locator("input").fill(live.server.code.lower())
    phone.get_by_role("button", name="Join").tap()
    expect(phone.locator("#link[data-there=true]")).to_be_visible()
