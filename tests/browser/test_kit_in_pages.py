"""Pages that hold the kit, in a real browser and without a network: Python answers as in a notebook, and whatever happens to it
the page stays."""

from __future__ import annotations

import json
import re
import threading
import tomllib
from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass, field
from functools import partial
from http.server import SimpleHTTPRequestHandler, ThreadingHTTPServer
from pathlib import Path
from typing import Any

import pytest
from nbformat import writes
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook
from playwright.sync_api import Browser, Locator, Page, Route, expect

from lsys_kit import check, derive, explore, link, read, system
from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.exercises.collecting import answers_in, collect
from lsys_kit.classroom.exercises.progress import Try, _read
from lsys_kit.classroom.exercises.registry import exercise_of, kit_questions
from lsys_kit.classroom.site import answers
from lsys_kit.classroom.site.app import app_files
from lsys_kit.classroom.site.build import read_notebook
from lsys_kit.classroom.site.contents import index_page
from lsys_kit.classroom.site.pages import INDEX, Answering, Entry, notebook_page
from lsys_kit.classroom.site.python import answering, archive
from lsys_kit.notation.fragments import LinkContent, packed
from tests.browser.test_class import serious
from tests.classroom.test_site import ran
from tests.pyodide import pyodide_folder

pytestmark = [pytest.mark.slow, pytest.mark.browser]
LESSON, EXERCISES, FIRST = "notebooks/01_all_at_once", "exercises/01_all_at_once", "exercises/00_five_characters_one_plant"
LONG = 120_000
"""So many milliseconds Python may take to start on a busy machine."""
ANSWERS = Path(__file__).parents[1] / "classroom" / "data"
STUB = """
import json

def answered(asked):
    while json.loads(asked).get("answer") == "loop":
        pass
    return json.dumps({"said": "Not yet", "message": "It is no loop."})
"""
"""A kit that may never answer."""


def pages(live: Answering) -> dict[str, bytes]:
    """A first page, a lesson and two pages of exercises."""
    entries = [Entry(f"{name}.ipynb", name) for name in (LESSON, EXERCISES, FIRST)]
    shown = [
        new_markdown_cell("# Panels"),
        ran("explore('K5')", explore("K5", 3)),
        ran("explore('P3')", explore("P3", 5)),
        ran("explore('P8')", explore("P8")),
    ]
    notebooks = [shown, *(read_notebook(course_files()[f"{name}.ipynb"]).cells for name in (EXERCISES, FIRST))]
    made = {
        each.page: notebook_page(each, cells, entries, live).encode() for each, cells in zip(entries, notebooks, strict=True)
    }
    return {**made, INDEX: index_page(entries, {}, live).encode()}


@dataclass
class Served:
    """A site on a server of this machine, and what was asked of it."""

    address: str
    files: dict[str, bytes]
    asked: list[str] = field(default_factory=list)
    stop: Callable[[], None] = lambda: None

    def python(self) -> list[str]:
        return [each for each in self.asked if each.startswith("/python/")]


class Handler(SimpleHTTPRequestHandler):
    served: Served

    def do_GET(self) -> None:
        self.served.asked.append(self.path)
        path = self.path.partition("?")[0].removeprefix("/")
        content = self.served.files.get(path)
        self.send_response(404 if content is None else 200)
        self.send_header("Content-Type", self.guess_type(path))
        self.end_headers()
        self.wfile.write(content or b"")

    def log_message(self, *_: object) -> None:
        pass


@pytest.fixture(scope="module")
def live(pytestconfig: pytest.Config) -> Answering:
    return answering(pyodide_folder(pytestconfig))


@pytest.fixture(scope="module")
def site_files(live: Answering) -> dict[str, bytes]:
    made = pages(live)
    app = app_files("Panels", live, made)
    return {**made, **app, **live.files, "blank.html": b"<!doctype html><title>blank</title>"}


@pytest.fixture
def served(site_files: dict[str, bytes]) -> Iterator[Served]:
    handler = type("Own", (Handler,), {})
    server = ThreadingHTTPServer(("127.0.0.1", 0), partial(handler))
    handler.served = Served(f"http://127.0.0.1:{server.server_port}/", dict(site_files))  # type: ignore[attr-defined]
    thread = threading.Thread(target=server.serve_forever, daemon=True)
    thread.start()

    def stop() -> None:
        server.shutdown()
        server.server_close()
        thread.join()

    handler.served.stop = stop  # type: ignore[attr-defined]
    yield handler.served  # type: ignore[attr-defined]
    stop()


@pytest.fixture
def opened(browser: Browser, served: Served) -> Iterator[Callable[..., Page]]:
    """Opens a page in a context of its own; nothing is asked of any other address, and nothing is complained of. Where the
    browser keeps pages, the server hears of all that is asked, and no other address is to be had."""
    faults: list[str] = []
    used = []

    def only_here(route: Route) -> None:
        if route.request.url.startswith((served.address, "blob:")):
            route.continue_()
        else:
            faults.append(route.request.url)
            route.abort()

    def open_one(name: str, width: int = 1200, keeps: bool = False) -> Page:
        context = browser.new_context(
            viewport={"width": width, "height": 800}, has_touch=width < 600, service_workers="allow" if keeps else "block"
        )
        used.append(context)
        if not keeps:
            context.route("**/*", only_here)
        page = context.new_page()
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto(f"{served.address}{name}.html")
        return page

    yield open_one
    for context in used:
        context.close()
    assert faults == []


def bar(page: Page, state: str) -> Locator:
    return page.locator(f".kit-bar[data-state={state}]")


def answer(page: Page, text: str, exercise: str = "1.1") -> Locator:
    """Type an answer and have it checked; where the reply stands."""
    place = page.locator(f'section[aria-label="Exercise {exercise}"]')
    place.locator("input, textarea").fill(text)
    place.get_by_role("button", name="Check").click()
    return place.locator("p.lsys-said")


def said(text: object) -> str:
    """A reply as it is read, on one line."""
    return " ".join(str(text).split())


def test_nothing_of_python_is_fetched_before_it_is_needed(opened: Callable[..., Page], served: Served) -> None:
    page = opened(LESSON)
    expect(page.locator("[data-part]:not([data-open])")).to_have_count(0)
    page.locator(".lsys-panel input[type=range]").first.press("ArrowLeft")
    page.goto(f"{served.address}{EXERCISES}.html")
    expect(page.locator("form.exercise-answer")).to_have_count(4)
    assert served.python() == []
    expect(bar(page, "idle")).to_be_visible()


@pytest.mark.parametrize("width", [1200, 400])
def test_an_exercise_is_answered_on_its_page_as_in_a_notebook(
    opened: Callable[..., Page], tmp_path: Path, width: int, pytestconfig: pytest.Config
) -> None:
    """With hints and the solution; it is there when the page is opened again, and tries are saved as the course keeps them."""
    page = opened(EXERCISES, width)
    reply = answer(page, "al al br")
    expect(reply).to_have_text(f"≈ {said(check('1.1', 'al al br'))}", timeout=LONG)
    expect(bar(page, "ready")).to_have_count(1)
    page.get_by_role("button", name="A hint").first.click()
    expect(reply).to_contain_text("Hint 1 of", timeout=LONG)
    page.get_by_role("button", name="The solution").first.click()
    expect(reply).to_contain_text("bl ar bl ar ar")
    mirrored = answer(page, exercise_of("1.3").solution, "1.3")
    expect(mirrored).to_contain_text("Correct", timeout=LONG)
    answer(page, "bl ar bl ar ar")
    expect(reply).to_have_text(f"✓ {said(check('1.1', 'bl ar bl ar ar'))}")
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / f"kit-exercises-{width}.png", full_page=True)
    with page.expect_download() as saved:
        page.get_by_role("button", name="progress.csv").click()
    saved.value.save_as(tmp_path / "progress.csv")
    assert _read(tmp_path / "progress.csv") == ((Try("1.1", False), Try("1.3", True), Try("1.1", True)), 0)
    page.get_by_role("button", name="Another exercise").click()
    expect(page.locator(".exercise-practice h3")).to_contain_text("level 1", timeout=LONG)
    page.reload()
    expect(page.locator("form.exercise-answer input").first).to_have_value("bl ar bl ar ar")
    expect(page.locator("p.lsys-said").first).to_contain_text("Correct")


def test_typed_rules_are_drawn_and_constants_have_all_their_values(
    opened: Callable[..., Page], pytestconfig: pytest.Config
) -> None:
    page = opened(LESSON)
    panels = page.locator(".lsys-panel")
    expect(panels).to_have_count(3)
    held = panels.nth(2).inner_text()
    assert "Fixed on this page" in held or "It holds" in held or "This page holds" in held
    first = panels.first
    first.get_by_role("button", name="rules").click()
    text = "axiom: F\nF -> F[+F]F\nangle: 30\nsteps: 3"
    first.locator("textarea").first.fill(text)
    counted = len(derive(read(text), 3)[3])
    expect(first).to_contain_text(f"{counted} characters", timeout=LONG)
    expect(panels.nth(2)).not_to_contain_text("It holds", timeout=LONG)
    expect(panels.nth(2)).not_to_contain_text("This page holds", timeout=LONG)
    first.locator("textarea").first.fill("axiom: F\nF -> F[+F F")
    expect(first.locator(".lsys-mistake")).to_contain_text("[")
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / "kit-panels.png", full_page=True)


def test_only_the_first_rules_have_the_name_of_the_system(opened: Callable[..., Page]) -> None:
    panel = opened(LESSON).locator(".lsys-panel").first
    panel.get_by_role("button", name="rules", exact=True).click()
    area, code = panel.locator("textarea").first, panel.locator(".lsys-keep input")
    own = read("axiom: F\nF -> F[+F]F\nangle: 30\nsteps: 3")
    panel.get_by_role("button", name="more", exact=True).click()
    for model, told in ((own, "read("), (own, "read("), (system("K5"), 'explore("K5"')):
        area.fill("axiom: F\nF -> [")
        expect(panel.locator(".lsys-mistake").first).to_contain_text("never closed", timeout=LONG)
        area.fill(str(model))
        expect(panel.locator(".lsys-mistake").first).to_have_text("")
        expect(panel).to_contain_text(f"{len(derive(model, 3)[3])} characters")
        panel.get_by_role("button", name="code", exact=True).click()
        expect(code).to_have_value(re.compile(re.escape(told)))


def asked_questions() -> list[dict[str, Any]]:
    """Answers to the exercises of the kit, right and wrong, as students give them."""
    wrong = tomllib.loads((ANSWERS / "wrong_answers.toml").read_text("utf-8"))
    found = []
    for _, _, exercise in kit_questions().exercises:
        typed = [each for group in wrong.get(exercise.id, {}).values() for each in group if isinstance(each, str)]
        for text in (exercise.solution, *typed[:1]):
            found.append({"kind": "check", "id": exercise.id, "answer": text})
        found.append({"kind": "check", "id": exercise.id, "answer": (typed or ["1"])[-1], "hint": 1, "solution": True})
    return found


ASK_ALL = """async ([data, questions]) => {
    const worker = new Worker(data.worker, { type: "module" }), home = location.href.replace("blank.html", "");
    const next = () => new Promise((done) => { worker.onmessage = ({ data: said }) => said.part ?? done(said); });
    let heard = next();
    worker.postMessage({ ...data, home });
    const found = [await heard];
    for (const question of questions) {
        heard = next();
        worker.postMessage({ ask: JSON.stringify(question) });
        found.push(await heard);
    }
    worker.terminate();
    return found;
}"""


def test_python_in_a_page_replies_to_answers_as_this_one(opened: Callable[..., Page], live: Answering) -> None:
    page, asked = opened("blank"), asked_questions()
    page.set_default_timeout(10 * LONG)
    begun, *there = page.evaluate(ASK_ALL, [live.data["python"], asked])
    assert begun == {"ready": True}
    assert len(asked) > 200
    for question, found in zip(asked, there, strict=True):
        assert found["answer"] == json.loads(answers.answered(json.dumps(question))), question


def test_what_needs_arrays_is_left_to_jupyter_in_plain_words(opened: Callable[..., Page]) -> None:
    panel = opened(LESSON).locator(".lsys-panel").first
    panel.get_by_role("button", name="rules").click()
    panel.locator("textarea").first.fill(str(system("K23")))
    expect(panel.locator(".lsys-mistake")).to_contain_text("numpy", timeout=LONG)
    expect(panel.locator(".lsys-mistake")).to_contain_text("JupyterLab")


def test_drawings_are_judged_as_in_a_notebook(opened: Callable[..., Page]) -> None:
    page = opened(FIRST)
    for answered_with in ("F[+F]F[-F]F", exercise_of("0.3").solution):
        expect(answer(page, answered_with, "0.3")).to_contain_text(said(check("0.3", answered_with)), timeout=LONG)


def test_the_picture_beside_a_reply_is_shown_and_stays(opened: Callable[..., Page]) -> None:
    page, wrong = opened(FIRST), "F[+F]F[-FF]"
    place = page.locator('section[aria-label="Exercise 0.3"]')
    expect(answer(page, wrong, "0.3")).to_contain_text("Almost", timeout=LONG)
    for _ in range(2):
        expect(place.get_by_role("img", name=check("0.3", wrong).described)).to_be_visible()
        expect(place.get_by_role("button", name="A hint")).to_be_visible()
        page.reload()


def test_a_bomb_ends_with_the_words_of_the_kit(opened: Callable[..., Page]) -> None:
    page = opened(EXERCISES)
    bomb = f"axiom: a\na -> {200 * 'a '}"
    reply = answer(page, bomb, "1.3")
    expect(reply).to_contain_text(said(check("1.3", bomb)), timeout=LONG)
    expect(bar(page, "ready")).to_have_count(1)
    expect(answer(page, "al al br")).to_contain_text("Almost")


@pytest.mark.parametrize("missing", ["/worker.js", "kit.zip", "wasm"])
def test_where_python_is_missing_that_is_said_and_tried_again(
    opened: Callable[..., Page], served: Served, site_files: dict[str, bytes], missing: str
) -> None:
    name = next(each for each in served.files if each.endswith(missing))
    del served.files[name]
    page = opened(EXERCISES)
    reply = answer(page, "al al br")
    expect(reply).to_contain_text("Python cannot start in this page", timeout=LONG)
    expect(bar(page, "absent")).to_contain_text(name.rpartition("/")[2])
    expect(page.locator("form.exercise-answer input").first).to_have_value("al al br")
    served.files[name] = site_files[name]
    page.get_by_role("button", name="Try it again").click()
    expect(bar(page, "ready")).to_have_count(1, timeout=LONG)
    expect(answer(page, "al al br")).to_contain_text("Almost", timeout=LONG)


def put_stub(served: Served, live: Answering) -> None:
    """Put another kit in the place of the kit, which says of all that it is not yet right."""
    home = "lsys_kit/classroom/site"
    places = ["lsys_kit", "lsys_kit/classroom", home]
    stub = archive({**{f"{each}/__init__.py": b"" for each in places}, f"{home}/answers.py": STUB.encode()})
    told = {**live.data["python"], "patience": 2}
    told["kit"] = {**told["kit"], "bytes": len(stub)}
    impatient = Answering(live.script, {"python": told}, live.files)
    served.files.update({**pages(impatient), "python/kit.zip": stub})


def test_python_that_does_not_answer_is_ended_and_started_anew(
    opened: Callable[..., Page], served: Served, live: Answering
) -> None:
    put_stub(served, live)
    page = opened(EXERCISES)
    expect(answer(page, "al")).to_contain_text("It is no loop", timeout=LONG)
    reply = answer(page, "loop")
    expect(reply).to_contain_text("This takes too long, and Python was ended", timeout=LONG)
    expect(page.locator(".kit-bar:is([data-state=ended], [data-state=ready])")).to_have_count(1)
    expect(bar(page, "ready")).to_have_count(1, timeout=LONG)
    expect(answer(page, "al")).to_contain_text("It is no loop", timeout=LONG)
    expect(page.locator("form.exercise-answer input").first).to_have_value("al")


def test_a_page_that_is_a_file_says_that_python_needs_a_web_server(
    browser: Browser, site_files: dict[str, bytes], tmp_path: Path
) -> None:
    for name, content in site_files.items():
        (tmp_path / name).parent.mkdir(parents=True, exist_ok=True)
        (tmp_path / name).write_bytes(content)
    page = browser.new_page()
    page.goto((tmp_path / f"{EXERCISES}.html").as_uri())
    expect(bar(page, "idle")).to_contain_text("This page is a file: panels move")
    expect(answer(page, "al al br")).to_contain_text("web server", timeout=LONG)
    with page.expect_download():
        page.get_by_role("button", name="Save my answers").click()
    page.close()


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("name", [LESSON, EXERCISES])
def test_nobody_is_shut_out(opened: Callable[..., Page], name: str, scheme: Any) -> None:
    page = opened(name, 400)
    page.emulate_media(color_scheme=scheme)
    expect(page.locator("[data-part]:not([data-open])")).to_have_count(0)
    assert serious(page) == []
    assert page.evaluate("document.documentElement.scrollWidth <= innerWidth")


def test_nothing_of_a_panel_lies_over_what_is_said_of_python(opened: Callable[..., Page]) -> None:
    page = opened(LESSON, 400)
    expect(page.locator("[data-part]:not([data-open])")).to_have_count(0)
    under = """(tabs) => {
        const bar = document.querySelector(".kit-bar"), { left, top, width } = bar.getBoundingClientRect();
        scrollBy({ top: tabs.getBoundingClientRect().top - top, behavior: "instant" });
        return [1, 3, 5, 7].every((part) => bar.contains(document.elementFromPoint(left + (width * part) / 8, top + 12))); }"""
    assert page.locator(".lsys-tabs:visible").last.evaluate(under)


# Links


def test_a_link_opens_its_model_on_a_page_and_what_was_typed_there_is_sent_home_and_opened(
    opened: Callable[..., Page], served: Served, pytestconfig: pytest.Config
) -> None:
    """Of another model than those of the page, with its settings; it can be edited there, and so on."""
    own = read("axiom: F\nF -> F[+F]F\nangle: 30")
    page = opened(LESSON)
    page.goto(link(own, {"step": 2, "angle": 45}, f"{served.address}{LESSON}.html"))  # the same page with a link
    panel = page.locator(".kit-linked .lsys-panel")
    expect(panel).to_contain_text(f"{len(derive(own, 2)[2])} characters", timeout=LONG)
    expect(page.locator(".kit-linked")).to_contain_text("This model came with the link")
    expect(panel.get_by_role("slider", name="Angle")).to_have_attribute("aria-valuetext", "45")
    expect(page.locator(".lsys-panel")).to_have_count(4)
    panel.get_by_role("button", name="rules").click()
    typed = read("axiom: F\nF -> F[+F]F[-F]\nangle: 30\nsteps: 3")
    panel.locator("textarea").first.fill(str(typed))
    expect(panel).to_contain_text(f"{len(derive(typed, 2)[2])} characters", timeout=LONG)
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / "kit-linked.png")
    address = link(typed, {"step": 1}, f"{served.address}{LESSON}.html")
    page.goto("about:blank")
    page.goto(address)
    expect(panel).to_contain_text(f"{len(derive(typed, 1)[1])} characters", timeout=LONG)
    page.goto(f"{address[:-3]}")
    expect(page.locator("p.lsys-message").first).to_contain_text("broken")
    expect(page.locator(".kit-linked")).to_have_count(0)


def test_a_link_to_a_model_of_the_page_or_one_that_cannot_be_opened_is_no_panel(
    opened: Callable[..., Page], served: Served
) -> None:
    page = opened(LESSON)
    page.goto("about:blank")
    page.goto(link(system("P3"), {}, f"{served.address}{LESSON}.html"))
    expect(page.locator(".lsys-panel")).to_have_count(3)
    expect(page.locator(".kit-linked")).to_have_count(0)
    page.goto("about:blank")
    page.goto(f"{served.address}{LESSON}.html{packed(LinkContent('abop', {}, 'axiom: F -> ['))}")
    expect(page.locator(".kit-linked .lsys-message")).to_contain_text("I did not expect", timeout=LONG)


# Without a network


KEPT = """async ([name, wanted, end]) => {
    for (const begun = Date.now(); Date.now() < begun + end; await new Promise((done) => setTimeout(done, 50))) {
        const stores = await Promise.all((await caches.keys()).map(each => caches.open(each)));
        const addresses = (await Promise.all(stores.map(each => each.keys()))).flat().map(({ url }) => url);
        if (addresses.some(each => each.includes(name)) === wanted) return;
    }
    throw new Error(name);
}"""
THESE_PAGES, ALL = "This browser keeps these pages", "This browser keeps the course and Python"


def wait_until_kept(page: Page, name: str, wanted: bool = True) -> None:
    """Wait until the browser keeps a file of the site, or keeps it no longer."""
    page.evaluate(KEPT, [name, wanted, LONG])


def without_network(page: Page, served: Served) -> None:
    served.stop()
    page.context.set_offline(True)


def test_the_course_works_without_a_network_once_it_was_there(opened: Callable[..., Page], served: Served) -> None:
    page = opened("index", keeps=True)
    expect(page.locator(".kit-offline")).to_contain_text(THESE_PAGES, timeout=LONG)
    assert served.python() == [], "it was not asked for"
    page.get_by_role("button", name="Keep Python").click()
    expect(page.locator(".kit-offline")).to_contain_text(ALL, timeout=LONG)
    assert {each.partition("?")[0].removeprefix("/") for each in served.asked} <= {*served.files, ""}
    without_network(page, served)
    for name in (EXERCISES, FIRST):
        page.goto(f"{served.address}{name}.html")
        expect(page.locator("form.exercise-answer").first).to_be_visible()
    page.goto(f"{served.address}{EXERCISES}.html")
    expect(answer(page, "al al br")).to_contain_text("Almost", timeout=LONG)
    page.goto(f"{served.address}{LESSON}.html")
    expect(page.locator(".lsys-panel")).to_have_count(3)
    page.goto(served.address)
    expect(page.locator(".kit-offline")).to_contain_text(ALL, timeout=LONG)


def test_python_that_has_answered_answers_without_a_network(opened: Callable[..., Page], served: Served) -> None:
    page = opened(EXERCISES, keeps=True)
    expect(answer(page, "al al br")).to_contain_text("Almost", timeout=LONG)
    for name in (".wasm", "pyodide-lock.json", "sympy.zip"):
        wait_until_kept(page, name)
    without_network(page, served)
    page.reload()
    expect(page.locator("form.exercise-answer input").first).to_have_value("al al br")
    expect(answer(page, "bl ar bl ar ar")).to_contain_text("Correct", timeout=LONG)


def test_of_a_site_that_was_written_again_what_is_new_is_kept(
    opened: Callable[..., Page], served: Served, live: Answering, site_files: dict[str, bytes]
) -> None:
    page = opened("index", keeps=True)
    page.get_by_role("button", name="Keep Python").click(timeout=LONG)
    expect(page.locator(".kit-offline")).to_contain_text(ALL, timeout=LONG)
    told = {**live.data["python"], "kit": {**live.data["python"]["kit"], "address": "python/kit.zip?another"}}
    newer = Answering(live.script, {"python": told}, live.files)
    made = {name: content.replace(b"Panels", b"More panels") for name, content in pages(newer).items()}
    served.files.update({**made, **app_files("Panels", newer, made)})
    served.asked.clear()
    page.reload()
    wait_until_kept(page, "kit.zip?another")
    wait_until_kept(page, live.data["python"]["kit"]["address"], False)
    assert f"/{FIRST}.html" in served.asked
    assert not [each for each in served.asked if each.endswith((".wasm", "sympy.zip"))], "what is the same is not fetched again"
    without_network(page, served)
    page.goto(f"{served.address}{LESSON}.html")
    expect(page.locator("h1")).to_have_text("More panels")
    page.goto(f"{served.address}{EXERCISES}.html")
    expect(answer(page, "al al br")).to_contain_text("Almost", timeout=LONG)


def test_browsers_offer_to_install_the_site(opened: Callable[..., Page]) -> None:
    page = opened("index", keeps=True)
    expect(page.locator(".kit-offline")).to_contain_text(THESE_PAGES, timeout=LONG)
    session = page.context.new_cdp_session(page)
    assert session.send("Page.getAppManifest")["errors"] == []
    faults = [each["errorId"] for each in session.send("Page.getInstallabilityErrors")["installabilityErrors"]]
    assert {*faults} <= {"in-incognito"}


def test_a_browser_that_keeps_no_pages_shows_them_all_the_same(opened: Callable[..., Page], served: Served) -> None:
    del served.files["service_worker.js"]
    page = opened("index", keeps=True)
    expect(page.get_by_role("heading", name="Lessons")).to_be_visible()
    page.goto(f"{served.address}{EXERCISES}.html")
    expect(answer(page, "al al br")).to_contain_text("Almost", timeout=LONG)
    expect(page.locator(".kit-offline")).to_have_count(0)


# Handing in


TYPED = {
    "1.1": "al al br",
    "1.2": 'a "quoted" \\n \u2028 \U0001f331 text',
    "1.3": exercise_of("1.3").solution.replace("\n", "\n\n"),
    "1.4": '"""\nanswer = 1',
}
"""Right, wrong and odd answers, in one line and in several."""


def fill(page: Page, typed: Mapping[str, str]) -> None:
    for exercise, text in typed.items():
        page.locator(f'section[aria-label="Exercise {exercise}"]').locator("input, textarea").fill(text)


def handed_in(page: Page, folder: Path, name: str = "ada") -> Path:
    """The notebook that a page saves."""
    with page.expect_download() as saved:
        page.get_by_role("button", name="Save my answers").click()
    assert saved.value.suggested_filename == f"{Path(EXERCISES).name}.ipynb"
    saved.value.save_as(folder / f"{name}.ipynb")
    return folder / f"{name}.ipynb"


def test_answers_are_handed_in_from_a_page_and_marked_as_a_notebook(
    opened: Callable[..., Page], served: Served, tmp_path: Path
) -> None:
    """Also where Python never came; the notebook is one, and says what was typed, letter for letter where a line has it."""
    page = opened(EXERCISES)
    expect(page.locator("form.exercise-answer")).to_have_count(4)
    fill(page, TYPED)
    notebook = handed_in(page, tmp_path)
    assert served.python() == []
    read_notebook(notebook)
    found = answers_in(notebook.read_text("utf-8"))
    assert {each: answer for each, answer in found.found.items() if answer is not ...} == {
        each: page.locator(f'section[aria-label="Exercise {each}"]').locator("input, textarea").input_value() for each in TYPED
    }
    assert found.problems == []
    typed = [new_code_cell(f"answer = {text!r}\ncheck({each!r}, answer)") for each, text in TYPED.items()]
    (tmp_path / "bob.ipynb").write_text(writes(new_notebook(cells=typed)))
    ada, bob = collect(tmp_path)
    assert (ada.student, ada.scores, ada.remarks) == ("ada", bob.scores, bob.remarks)
    assert ada.scores["1.3"] == 1 > ada.scores["1.1"]


def test_two_tabs_show_the_same_answers_and_lose_no_try(
    opened: Callable[..., Page], served: Served, live: Answering, tmp_path: Path
) -> None:
    put_stub(served, live)
    first = opened(EXERCISES)
    second = first.context.new_page()
    second.goto(first.url)
    for page, exercise, text in ((first, "1.1", "al"), (second, "1.3", "br"), (first, "1.1", "ar"), (second, "1.1", "bl")):
        expect(answer(page, text, exercise)).to_contain_text("It is no loop", timeout=LONG)
        other = (second if page is first else first).locator(f'section[aria-label="Exercise {exercise}"]')
        expect(other.locator("input, textarea")).to_have_value(text)
        expect(other.locator("p.lsys-said")).to_contain_text("It is no loop")
    for page in (first, second):
        with page.expect_download() as saved:
            page.get_by_role("button", name="progress.csv").click()
        saved.value.save_as(tmp_path / "progress.csv")
        assert _read(tmp_path / "progress.csv")[0] == tuple(Try(each, False) for each in ("1.1", "1.3", "1.1", "1.1"))


FULL = """for (let many = 2 ** 22; many >= 1; many /= 2) {
    try { for (let i = 0; ; i += 1) localStorage.setItem(`${many} ${i}`, "-".repeat(many)); } catch { }
}"""
FORBIDDEN = "Object.defineProperty(window, 'localStorage', { get() { throw new DOMException('no', 'SecurityError'); } })"


@pytest.mark.parametrize("why", [FULL, FORBIDDEN], ids=["full", "forbidden"])
def test_a_browser_without_room_says_so_and_the_answers_can_be_saved(
    opened: Callable[..., Page], served: Served, live: Answering, tmp_path: Path, why: str
) -> None:
    put_stub(served, live)
    page = opened("blank")
    page.context.add_init_script(why)
    page.goto(f"{served.address}{EXERCISES}.html")
    expect(page.locator(".kit-saving")).to_contain_text("no room for what you type")
    reply = answer(page, "al al br")
    expect(reply).to_contain_text("It is no loop", timeout=LONG)
    answers = answers_in(handed_in(page, tmp_path).read_text("utf-8"))
    assert answers.found["1.1"] == "al al br"
    asked: list[str] = []
    page.once("dialog", lambda dialog: (asked.append(dialog.type), dialog.dismiss()))
    page.close(run_before_unload=True)
    page.wait_for_timeout(0)
    expect(reply).to_contain_text("It is no loop")
    assert asked == ["beforeunload"]
