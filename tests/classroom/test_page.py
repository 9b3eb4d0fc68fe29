"""A page without a kernel: one file in which everything is, and in which nothing runs but the kit's own script."""

from __future__ import annotations

import base64
import hashlib
import json
import re
from fractions import Fraction
from html.parser import HTMLParser
from itertools import product
from pathlib import Path
from typing import Any

import pytest
from hypothesis import given
from hypothesis import strategies as st
from playwright.sync_api import Browser, Page, expect

import lsys_kit.classroom.panel.opened.systems as panel_page
from lsys_kit import (
    ModelFileError,
    ModelNameError,
    ModelValueError,
    derive,
    explore,
    limits,
    link,
    linked,
    read,
    system,
    systems,
)
from lsys_kit.classroom.panel.books.book import book
from lsys_kit.classroom.panel.bundle import tightened
from lsys_kit.classroom.panel.document import deflated_text, inflated_text
from lsys_kit.classroom.panel.opened.opened import Viewing
from lsys_kit.classroom.panel.opened.systems import OpenedSystem
from lsys_kit.classroom.panel.page import deflated, page, save_page, shared
from lsys_kit.notation.fragments import unpacked
from lsys_kit.notation.model.system import LSystem
from tests.classroom.front_end import joined
from tests.classroom.test_link import forged
from tests.test_hostile_names import HOSTILE, made, refused

TAGS = {"html", "head", "meta", "link", "title", "style", "body", "h1", "main", "noscript", "p", "script"}


class Parts(HTMLParser):
    """What a browser finds in a page: its elements, what they point to, its scripts, its text."""

    def __init__(self, text: str) -> None:
        super().__init__(convert_charrefs=True)
        self.tags: list[str] = []
        self.attributes: list[tuple[str, str | None]] = []
        self.inside: dict[str, list[str]] = {}
        self._open: list[str] = []
        self.feed(text)
        self.close()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        self.tags.append(tag)
        self.attributes += attrs
        if tag not in ("meta", "link", "img", "br", "hr"):
            self._open.append(tag)
            self.inside.setdefault(tag, []).append("")

    def handle_endtag(self, tag: str) -> None:
        assert self._open.pop() == tag

    def handle_data(self, data: str) -> None:
        if self._open:
            self.inside[self._open[-1]][-1] += data

    def handle_comment(self, data: str) -> None:
        self.tags.append("!--")


def page_data(
    system: LSystem,
    changes: dict[str, Any] | None = None,
    seed: int = 0,
    *,
    title: str = "",
    step: int | None = None,
    angle: object = None,
    asked: list[dict[str, Any]] | tuple[()] = (),
) -> dict[str, Any]:
    """What a page knows of a system."""
    what = OpenedSystem(system, title, changes)
    chosen = Viewing(what.steps if step is None else step, what.first, seed, what.turned(angle))
    return what.page_data(chosen, asked)


def books_of(data: dict[str, Any]) -> list[dict[str, Any]]:
    """The books of a page, as its script reads them."""
    found = json.loads(inflated_text(data["books"]))
    return [
        {name: part[number] for name, part, number in zip(found["names"], found["parts"], row, strict=True) if number >= 0}
        for row in found["rows"]
    ]


@pytest.fixture(scope="module")
def j4() -> str:
    return page("J4: Anabaena", page_data(system("J4"), title="J4", step=9), "Nine cells.")


# --- what stands in it ------------------------------------------------------------------------------------------------------


def hashed(script: str) -> str:
    return f"'sha256-{base64.b64encode(hashlib.sha256(script.encode()).digest()).decode()}'"


@pytest.mark.slow
@pytest.mark.parametrize("id", ["J4", "K5", "K19"])
def test_it_points_to_nothing_outside_and_runs_the_scripts_of_the_kit_alone(id: str) -> None:
    text = page(id, page_data(system(id), title=id, step=3), "")
    parts = Parts(text)
    assert set(parts.tags) == TAGS
    assert [value for name, value in parts.attributes if name in ("src", "href", "action", "data")] == ["data:,"]
    assert not [name for name, _ in parts.attributes if name.startswith("on") or name == "style"]
    data, first = json.loads(parts.inside["script"][0]), parts.inside["script"][1]
    assert data["model"]["step"] == 3
    script, style = inflated_text(data["script"]), inflated_text(data["style"])
    policy = next(value for _, value in parts.attributes if value and value.startswith("default-src"))
    assert policy.split("; ")[:2] == ["default-src 'none'", f"script-src {hashed(first)} {hashed(script)}"]
    assert "unsafe-eval" not in policy
    whole = text + script + style
    assert set(re.findall(r"[a-z]+://[^\s\"'`)]*", whole)) <= {"http://www.w3.org/2000/svg"}  # a name, which nobody opens
    for word in ("@import", "url(", "fetch(", "XMLHttpRequest", "WebSocket", "innerHTML", "eval(", "new Function"):
        assert word not in whole, word


@pytest.mark.slow
def test_all_settings_of_the_life_spans_are_in_few_bytes(j4: str) -> None:
    data = json.loads(Parts(j4).inside["script"][0])
    found = books_of(data)
    spans = [*product(range(1, 7), repeat=2)]
    assert len(found) == len(spans) == 36
    for (a, b), made_book in zip(spans, found, strict=True):
        assert made_book == json.loads(json.dumps(book(system("J4"), {"lifeTimeA": a, "lifeTimeB": b}, 0, title="J4", least=9)))
    assert len(data["books"]) < 15_000


@pytest.mark.parametrize(("id", "most"), [("J4", 59_000), ("K5", 60_000)])
def test_a_page_is_light(tmp_path: Path, id: str, most: int) -> None:
    explore(id).save(tmp_path / "a.html")
    assert (tmp_path / "a.html").stat().st_size < most


ENTRIES = st.one_of(st.integers(), st.text(), st.lists(st.integers()))


@given(st.lists(st.dictionaries(st.sampled_from("abcd"), ENTRIES), max_size=6))
def test_books_that_share_their_parts_are_the_same_books(books: list[dict[str, Any]]) -> None:
    assert books_of({"books": deflated(shared(books))}) == books


@pytest.mark.slow
@pytest.mark.parametrize("setting", ["MOST_BOOKS", "MOST_CHARACTERS", "seconds"])
def test_a_page_has_room_for_few_books_and_time_for_one_task(monkeypatch, setting: str) -> None:
    found = read("n = 3 in 1 .. 9\nm = 1 in 1 .. 9\naxiom: A(n)\nA(t) -> A(t+m)")
    monkeypatch.setattr(panel_page, "processor_time", iter(range(10_000)).__next__)  # a second a book
    few = [{}, {"n": 1}, {"n": 9}, {"m": 9}]
    unit = len(deflated(shared([book(found, {"n": 3, "m": 1, **each}, 0, least=5) for each in few]))) / len(few)
    for room, least in ((81.5, 81), (30, 17), (12, 8), (4, 4)):
        if setting != "seconds":
            monkeypatch.setattr(panel_page, setting, room * (unit if setting == "MOST_CHARACTERS" else 1))
        with limits(seconds=room if setting == "seconds" else 3_600):
            data = page_data(found)
        assert least <= len(books_of(data)) <= room
        assert [each["name"] for each in data["model"]["constants"]] == ["n", "m"]


def test_a_slider_stays_where_it_is_if_its_fewest_values_have_no_room(monkeypatch) -> None:
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 2)
    data = page_data(read("n = 3 in 1 .. 9\nm = 1 in 1 .. 9\naxiom: A(n)\nA(t) -> A(t+m)"))
    assert [(each["name"], each["texts"]) for each in data["model"]["constants"]] == [("m", ["1", "9"])]
    assert data["model"]["fixed"] == "Fixed on this page: n = 3. It holds 2 of the 9 values of m."
    assert data["fixed"] == {"n": "3"}


def test_what_is_asked_for_is_on_the_page_before_all_else(monkeypatch) -> None:
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 8)
    found = read("n = 3 in 1 .. 9\nm = 1 in 1 .. 9\naxiom: A(n)\nA(t) -> A(t+m)")
    for asked, texts in (
        ([{"n": 7}, {"n": 99}, {"x": 2, "m": 4}], [["1", "3", "7", "9"], ["1", "4", "9"]]),
        ([{"n": 7, "m": 4}], [["1", "3", "7", "9"], ["1", "4", "9"]]),
    ):
        data = page_data(found, asked=asked)
        assert [each["texts"] for each in data["model"]["constants"]] == texts
        assert data["model"]["together"] == (("n", "m") if len(asked) == 1 else ())


@pytest.mark.slow
def test_a_page_has_the_nine_seeds_and_all_that_have_room(monkeypatch) -> None:
    found = read("p = 0.5 in 0 .. 1 by 1/2\naxiom: A\nA -> A B : p\nA -> A : 1-p\nA < B > A -> B")
    data = page_data(found, seed=12)
    books, constants = books_of(data), [Fraction(0), Fraction(1, 2), 1]
    assert data["model"]["seeds"] == [*map(str, range(9, 45))]
    for each, (p, seed) in zip(books, product(constants, range(9, 45)), strict=True):
        assert each == json.loads(json.dumps(book(found, {"p": p}, seed, least=5)))
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 11)
    few = page_data(found, seed=12, asked=[{"seed": 10}])["model"]
    assert few["seeds"] == [*map(str, range(9, 18))]
    assert few["fixed"].startswith("This page holds the seeds 9 to 17. p and seed move one at a time: ")
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 3)
    assert page_data(found, seed=12)["model"]["fixed"] == "Fixed on this page: seed = 12."


@pytest.mark.slow
def test_where_chance_alone_has_a_say_a_page_holds_all_seeds_in_one_book() -> None:
    found = read("p = 0.5 in 0 .. 1 by 1/2\naxiom: A\nA -> A B : p\nA -> A : 1-p")
    data = page_data(found, seed=12)
    model = data["model"]
    assert (model["chance"], model["thrown"], model["seeds"], model["seed"], model["fixed"]) == (True, True, [], 12, "")
    assert [each["choices"][0][:2] for each in books_of(data)] == [[[], 1.0], [[0.5], 1.0], [[1.0], 1.0]] or len(
        books_of(data)
    ) == 3


@pytest.mark.slow
def test_what_is_fixed_is_said() -> None:
    data = page_data(read("n = 3 in 1 .. 1000000\nk = 2\naxiom: A(n)\nA(t) -> A(t+n) B(k)"), {"k": "5/2"}, 7)
    assert data["model"]["fixed"].startswith("Fixed on this page: k = 2.5. It holds ")
    assert data["fixed"] == {"k": "2.5"}


def test_settings_that_cannot_be_are_mistakes_in_the_page() -> None:
    found = books_of(page_data(read("n = 1 in 0 .. 2\naxiom: A(1/n)\nA(t) -> A(t+1)")))
    assert ["mistake" in each for each in found] == [False, True, False]  # the first value comes first
    assert "zero" in found[1]["mistake"]["message"]


@pytest.mark.parametrize("choices", [{"changes": {"lifetimeA": 3}}, {"changes": {"lifeTimeA": 99}}, {"angle": "x"}])
def test_first_settings_that_make_no_sense_are_refused(choices: dict[str, Any]) -> None:
    with pytest.raises((ModelNameError, ModelValueError)):
        page_data(system("J4"), **choices)


@pytest.mark.parametrize("language", ["", "english please", '"><script>', "de_AT", 3])
def test_a_language_has_a_name(language: object) -> None:
    with pytest.raises(ModelValueError, match="language"):
        page("A", {"mode": "plane"}, "", language)
    assert '<html lang="de-AT">' in page("A", {"mode": "plane"}, "", "de-AT")


@pytest.mark.slow
@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_no_text_becomes_markup(text: str) -> None:
    said = f"{text} and {text}"
    plain = {"mode": "plane"}
    for data in (plain | {text: [text]}, refused(lambda: page_data(made(text))) or plain):
        whole = page(said, data, said)
        parts = Parts(whole)
        whole.encode()
        assert parts.tags == Parts(page("A", plain, "A")).tags
        assert json.loads(parts.inside["script"][0]).items() >= data.items()
        assert parts.inside["title"] == parts.inside["h1"]


def test_a_page_is_saved_over_a_page_and_over_nothing_else(tmp_path: Path, j4: str) -> None:
    save_page(tmp_path / "a.html", j4)
    save_page(tmp_path / "a.html", j4)
    assert (tmp_path / "a.html").read_text("utf-8") == j4
    (tmp_path / "mine.html").write_text("mine")
    for name, words in (("mine.html", "not made by the kit"), ("a.txt", "end in .html"), ("no/where.html", "be written")):
        with pytest.raises(ModelFileError, match=words):
            save_page(tmp_path / name, j4)
    assert (tmp_path / "mine.html").read_text() == "mine"


# --- in a browser -------------------------------------------------------------------------------------------------------------

FAULTS: list[str] = []
ASKED: list[str] = []
"""What the pages of a test complain of, and what they ask for."""


def offline_tab(browser: Browser, **context: Any) -> Page:
    found = browser.new_context(offline=True, **context).new_page()
    found.on("pageerror", lambda error: FAULTS.append(str(error)))
    found.on("console", lambda message: FAULTS.append(message.text))
    found.on("request", lambda request: ASKED.append(request.url))
    return found


@pytest.fixture(scope="module")
def tab(browser: Browser) -> Page:
    """A tab in which one page after another is opened; pages keep nothing in the browser."""
    return offline_tab(browser)


@pytest.fixture
def opened(browser: Browser, tab: Page, tmp_path: Path):
    """Opens a page from a file, with no network; whatever it asks for, or complains of, is a fault."""
    own = []

    def open_one(text: str, fragment: str = "", **context: Any) -> Page:
        (tmp_path / "page.html").write_text(text, "utf-8")
        if context:
            own.append(offline_tab(browser, **context))
        found = own[-1] if context else tab
        if found.url != "about:blank":
            found.goto("about:blank")
        found.mouse.move(0, 0)
        found.goto((tmp_path / "page.html").as_uri() + fragment)
        return found

    FAULTS.clear()
    ASKED.clear()
    yield open_one
    tab.goto("about:blank")
    for each in own:
        each.context.close()
    assert FAULTS == []
    assert {url.partition("#")[0] for url in ASKED} <= {"about:blank", (tmp_path / "page.html").as_uri()}


def status(shown: Page) -> Any:
    return expect(shown.locator(".lsys-status"))


def press(shown: Page, control: str, key: str) -> None:
    shown.get_by_role("slider", name=f"{control}, slider", exact=True).press(key)


def test_steps_and_constants_are_moved_without_a_kernel(opened, j4: str) -> None:
    shown = opened(j4)
    status(shown).to_contain_text("step 9: 9 cells; 5 of 5 stages occupied")
    expect(shown.locator(".lsys-word")).to_have_text("Al(1)Br(1)Bl(2)Ar(2)Al(3)Bl(1)Ar(1)Bl(2)Ar(2)")
    press(shown, "step", "ArrowRight")
    status(shown).to_contain_text("step 10: 12 cells")
    for moved, a, b in (("lifeTimeA", 4, 2), ("lifeTimeB", 4, 3), ("lifeTimeA", 5, 3)):
        press(shown, moved, "ArrowRight")
        word = str(derive(system("J4"), 10, lifeTimeA=a, lifeTimeB=b)[-1])
        expect(shown.locator(".lsys-word")).to_have_text(word.replace(" ", ""))


def test_a_slider_without_its_book_takes_the_others_back_to_their_first_values(monkeypatch, opened) -> None:
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 30)
    found = read("n = 1 in 1 .. 9\nm = 1 in 1 .. 9\naxiom: A(n)\nA(t) -> A(t+m)")
    shown = opened(page("A", page_data(found, step=1), ""))
    word, text = shown.locator(".lsys-word"), shown.locator(".lsys-message")
    press(shown, "n", "ArrowRight")
    expect(word).to_have_text("A(3)")
    expect(text).to_be_hidden()
    press(shown, "m", "ArrowRight")
    expect(word).to_have_text("A(3)")
    expect(shown.get_by_role("slider", name="n, slider")).to_have_attribute("aria-valuetext", "1")
    expect(text).to_contain_text("Back at n = 1. This page does not hold all settings together")
    press(shown, "m", "ArrowRight")
    expect(word).to_have_text("A(4)")
    expect(text).to_be_hidden()
    said = "n and m move one at a time: the other sliders then go back to their first values."
    expect(shown.get_by_text(said)).to_be_visible()


def test_seeds_are_sown_without_a_kernel_and_stand_in_the_address(opened) -> None:
    shown = opened(page("K8", page_data(system("K8"), title="K8", step=9), ""))
    shown.get_by_role("button", name="seed: the next value").click()
    status(shown).to_contain_text(f"{len(derive(system('K8'), 9, seed=1)[-1])} modules")
    shown.get_by_role("button", name="nine seeds").click()
    shown.get_by_role("button", name="seed 2: ").click()
    status(shown).to_contain_text(f"{len(derive(system('K8'), 9, seed=2)[-1])} modules")
    shown.wait_for_url(lambda url: "#lsys=" in url and linked(url).settings.get("seed") == 2)
    shown.reload()
    expect(shown.get_by_label("seed", exact=True)).to_have_value("2")
    for _ in range(5):
        shown.get_by_role("button", name="another seed").click()
        expect(shown.locator(".lsys-message")).to_be_hidden()


@pytest.mark.parametrize("id", ["J4", "K5", "K19", "K7", "P5", "K28"])
def test_texts_and_counts_of_a_page_are_those_of_the_kernel(opened, tmp_path: Path, id: str) -> None:
    panel = explore(id)
    panel.save(tmp_path / "saved.html")
    shown, steps = opened((tmp_path / "saved.html").read_text("utf-8")), panel.model["book"]["steps"]
    made = derive(panel.system, min(steps, 8)) if id == "K28" else derive(panel.system, min(steps, 8), seed=0)
    for step, word in enumerate(made):
        shown.get_by_label("step", exact=True).fill(str(step))
        shown.get_by_label("step", exact=True).press("Enter")
        texts = [wall.label for wall in word.walls] if id == "K28" else [*map(str, word)]
        status(shown).to_contain_text(f"step {step}: ")
        many = f"{len(texts):,} {'wall' if id == 'K28' else panel.model['book']['noun']}{'s' * (len(texts) != 1)}"
        status(shown).to_contain_text(many)
        if len(texts) <= 240:
            chips = shown.locator(".lsys-word [data-position]").all_inner_texts()
            assert [chip.replace("\n", "") for chip in chips] == texts


@pytest.mark.slow
@pytest.mark.parametrize("id", systems())
def test_a_page_of_every_system_opens(monkeypatch, opened, id: str) -> None:
    monkeypatch.setattr(panel_page, "MOST_BOOKS", 1)
    data = page_data(system(id), title=id)
    shown = opened(page(id, data, ""))
    status(shown).to_contain_text(f"step {data['model']['step']}: ")
    expect(shown.locator("canvas[data-drawn]").first).to_be_visible()
    press(shown, "step", "ArrowLeft")
    status(shown).to_contain_text(f"step {data['model']['step'] - 1}: ")


def test_the_address_keeps_what_is_seen_and_gives_it_back(opened, j4: str) -> None:
    shown = opened(j4)
    press(shown, "lifeTimeA", "ArrowRight")
    press(shown, "step", "ArrowLeft")
    shown.wait_for_url(re.compile("#lsys="))
    there = linked(shown.url)
    assert there.system == system("J4")
    assert there.settings == {"step": 8, "lifeTimeA": 4, "lifeTimeB": 2}
    shown.reload()
    status(shown).to_contain_text("step 8: 5 cells")
    expect(shown.get_by_role("slider", name="lifeTimeA, slider")).to_have_attribute("aria-valuetext", "4")


@pytest.mark.parametrize(
    ("settings", "seen"),
    [
        ({"step": 7, "lifeTimeA": 5, "lifeTimeB": 1}, "step 7: 4 cells"),
        ({"step": 10**8}, "step 20: 200 cells"),
        ({"step": 3, "lifeTimeA": 77}, "step 3: 2 cells"),
        ({"angle": "77/3", "seed": 5}, "step 9: 9 cells"),
    ],
)
def test_a_link_of_the_model_opens_its_settings(opened, j4: str, settings: dict[str, Any], seen: str) -> None:
    status(opened(j4, link(system("J4"), settings))).to_contain_text(seen)


@pytest.mark.parametrize(
    "fragment",
    [
        link(system("J5"), {"step": 2}),
        link(system("J4"), {"step": 2})[:-3],
        "#lsys=",
        "#lsys=a",
        "#lsys=b12",
        "#top",
        "#" + forged(b"abop?step=2\naxiom: " + b"A" * 50_000_000).partition("#")[2],
        "#lsys=a<script>",
    ],
)
def test_another_link_changes_nothing(opened, j4: str, fragment: str) -> None:
    status(opened(j4, fragment)).to_contain_text("step 9: 9 cells")


@pytest.mark.parametrize(
    ("fragment", "said"),
    [
        ("", ""),
        ("#top", ""),
        (link(system("J4"), {"step": 7, "lifeTimeA": 5}), ""),
        (link(system("J4"), {"seed": 5}), ""),
        (link(system("J5"), {"step": 2}), "The link in the address leads to another model"),
        (link(system("J4"), {"step": 2})[:-3], "The link in the address is broken"),
        ("#lsys=", "is broken"),
        (link(system("J4"), {"step": 3, "lifeTimeA": 77}), "This page does not hold all that the link in its address says"),
        (link(system("J4"), {"step": 10**8}), "does not hold all"),
    ],
)
def test_a_page_says_what_it_cannot_show_of_a_link(opened, j4: str, fragment: str, said: str) -> None:
    shown = opened(j4, fragment)
    status(shown).to_contain_text("step ")
    expect(shown.locator(".lsys-message")).to_contain_text(said) if said else expect(
        shown.locator(".lsys-message")
    ).to_be_hidden()
    press(shown, "lifeTimeB", "ArrowRight")
    expect(shown.locator(".lsys-message")).to_be_hidden()


@given(st.text())
def test_what_is_deflated_has_no_markup_and_is_the_same_text(text: str) -> None:
    packed = deflated_text(text)
    assert inflated_text(packed) == text
    assert not set(packed) & set('<"\\')


def test_a_browser_unpacks_what_was_packed(browser: Browser) -> None:
    texts = [*("x" * many for many in range(12)), "ü€🌱" * 99, "".join(map(chr, range(256))) * 9]
    shown = browser.new_page()
    code = f"given => {{ {joined('packed')}\nreturn Promise.all(given.map(unpacked)); }}"
    assert shown.evaluate(code, [*map(deflated_text, texts)]) == texts
    shown.close()


@pytest.mark.parametrize(
    ("line", "tight"),
    [
        ("  const a = b + c; // a reason", "const a=b+c;"),
        ("// a reason", ""),
        ('say("a // b", \'c  d\'); // e "f"', "say(\"a // b\",'c  d');"),
        ("x = y + +z - -w + v++ + 1;", "x=y+ +z- -w+v++ +1;"),
        ("return /[ /] x/.test(a) ? `b ${c} d` : null;", "return /[ /] x/.test(a)?`b ${c} d`:null;"),
        ("a = b / c / d;", "a=b/c/d;"),
        ("t = `a ${b ? `c  d` : 1}`; // kept as it is", "t = `a ${b ? `c  d` : 1}`; // kept as it is"),
        ('export default "://";', 'export default"://";'),
        ("for (const each of of) yield * each;", "for(const each of of)yield*each;"),
    ],
)
def test_a_script_is_written_without_what_says_nothing(line: str, tight: str) -> None:
    assert tightened(line) == tight


def test_a_plant_keeps_its_angle_in_its_link(opened) -> None:
    shown = opened(page("K5", page_data(system("K5"), title="K5", angle=40), ""))
    status(shown).to_contain_text("step 4: 625 strokes, 1,561 characters")
    press(shown, "angle", "Shift+ArrowRight")
    shown.wait_for_url(re.compile("#lsys="))
    assert float(linked(shown.url).settings["angle"]) == 40.1


def test_python_and_the_page_write_links_that_the_other_reads(browser: Browser) -> None:
    shown = browser.new_page()
    chosen = {id: link(system(id), {"step": 4, "angle": "77/3"}) for id in systems()}
    code = f"""given => {{ {joined("constants", "numbers", "link")}
        return Promise.all(given.map(unpackedLink).map(async (each) => [await each, await packedLink(await each)])); }}"""
    for address, (content, again) in zip(chosen.values(), shown.evaluate(code, [*chosen.values()]), strict=True):
        assert content == {**unpacked(address)._asdict(), "settings": dict(unpacked(address).settings)}
        assert unpacked(again) == unpacked(address)
    shown.close()


def test_the_page_reads_no_broken_link_and_no_bomb(browser: Browser) -> None:
    whole, shown = link(system("J4"), {"step": 4}), browser.new_page()
    changed = [whole[:at] + ("A" if whole[at] != "A" else "B") + whole[at + 1 :] for at in (10, 60, len(whole) - 1)]
    broken = [
        *changed,
        whole[:-1],
        whole + "A",
        whole + "=",
        whole.replace("=a", "=b"),
        "#lsys=a",
        forged(b"abop\naxiom: " + b"A" * 5_000_000),
        forged(b"abop\n\xff"),
    ]
    code = f"given => {{ {joined('constants', 'numbers', 'link')}\nreturn Promise.all(given.map(unpackedLink)); }}"
    assert shown.evaluate(code, broken) == [None] * len(broken)
    assert shown.evaluate(code, [whole]) == [unpacked(whole)._asdict() | {"settings": {"step": "4"}}]
    shown.close()


def test_a_phone_needs_no_sideways_scrolling_and_the_page_is_dark_in_the_dark(opened, j4: str) -> None:
    shown = opened(j4, viewport={"width": 390, "height": 800}, color_scheme="dark")
    status(shown).to_contain_text("step 9")
    assert shown.evaluate("document.documentElement.scrollWidth") <= 390
    assert shown.evaluate("getComputedStyle(document.body).backgroundColor") == "rgb(22, 27, 32)"


def test_rules_of_a_page_are_shown_and_no_box_to_be_filled(opened, j4: str) -> None:
    shown = opened(j4)
    shown.get_by_role("button", name="rules", exact=True).click()
    expect(shown.get_by_text("This page only shows the rules; they can be changed in Jupyter.")).to_be_visible()
    rules = shown.get_by_label("rules of the model")
    rules.click()
    expect(shown.get_by_role("button", name="back to the first rules")).to_be_hidden()
    looks = rules.evaluate(
        "area => (({ borderTopWidth, resize, outlineStyle }) => [borderTopWidth, resize, outlineStyle])(getComputedStyle(area))"
    )
    assert looks == ["0px", "none", "none"]
    assert rules.evaluate("area => area.scrollHeight <= area.clientHeight + 1")


def test_without_scripts_the_page_says_what_it_would_show(opened, j4: str) -> None:
    assert "It shows: Nine cells." in opened(j4, java_script_enabled=False).inner_text("body")


def test_the_policy_stops_what_is_put_into_the_page(browser: Browser, tmp_path: Path, j4: str) -> None:
    put_in = '<img src="x" onerror="window.run = 1"><script>window.run = 1</script>'
    (tmp_path / "page.html").write_text(j4.replace("<main", f"{put_in}<main"))
    shown = browser.new_page()
    shown.goto((tmp_path / "page.html").as_uri())
    status(shown).to_contain_text("step 9")
    assert shown.evaluate("window.run === undefined")
    with pytest.raises(Exception, match="TrustedHTML"):
        shown.evaluate("document.body.innerHTML = '<b>'")
    shown.close()
