"""Packages for learning platforms: the manifest is SCORM's, pages say what the kit says, platforms are told what is solved."""

from __future__ import annotations

import io
import json
import re
import zipfile
from collections.abc import Callable, Iterator
from fractions import Fraction
from functools import cache
from pathlib import Path
from typing import Any
from xml.etree import ElementTree

import axe_playwright_python
import pytest
from playwright.sync_api import Browser, Page, expect

from lsys_kit import ModelFileError, ModelNameError, ModelValueError, check
from lsys_kit.__main__ import main
from lsys_kit.classroom.exercises.exercise import Exercise, Lesson
from lsys_kit.classroom.exercises.registry import lessons
from lsys_kit.classroom.panel.document import inflated_text
from lsys_kit.classroom.scorm.package import ADL, CONTENT, MANIFEST, lessons_of, manifest, package, page_names, write_package
from lsys_kit.classroom.scorm.page import exercise_page, page_data, rounded_key
from tests.classroom.answers import EXERCISES, as_typed, of_each_kind_added, right_answers, wrong_answers_to
from tests.classroom.front_end import joined

AXE = Path(axe_playwright_python.__file__).parent / "axe.min.js"
IMS, ADLCP = f"{{{CONTENT}}}", f"{{{ADL}}}"
CHILDREN = {
    "manifest": ["metadata", "organizations", "resources"],
    "metadata": ["schema", "schemaversion"],
    "organization": ["title", "item"],
    "item": ["title"],
    "resource": ["file"],
}
"""What the schema imscp_rootv1p1p2.xsd wants in an element, in this order."""
ATTRIBUTES = {
    "manifest": {"identifier", "version"},
    "organizations": {"default"},
    "organization": {"identifier"},
    "item": {"identifier", "identifierref", "isvisible"},
    "file": {"href"},
    "resource": {"identifier", "type", "href", f"{ADLCP}scormtype"},
}


@cache
def checked_in_pages() -> dict[str, Any]:
    """What pages need for the exercises that they check, by their ids."""
    return {exercise.id: data for exercise in EXERCISES if (data := page_data(exercise))}


@pytest.fixture(autouse=True, scope="module")
def of_each_kind():
    with of_each_kind_added():
        yield


@pytest.fixture(scope="module")
def first() -> tuple[Lesson, str]:
    [lesson] = lessons_of("1")
    return lesson, exercise_page(lesson)


# The package


@pytest.mark.parametrize("what", [[lessons()[1]], lessons()[:5]], ids=["a lesson", "five lessons"])
def test_the_manifest_has_what_its_schema_wants(what):
    root = ElementTree.fromstring(manifest(what, page_names(what)))
    for element in root.iter():
        name = element.tag.removeprefix(IMS)
        assert element.tag == IMS + name
        assert list(dict.fromkeys(child.tag.removeprefix(IMS) for child in element)) == CHILDREN.get(
            name, {"organizations": ["organization"], "resources": ["resource"]}.get(name, [])
        )
        assert set(element.attrib) == ATTRIBUTES.get(name, set())
    identifiers = [element.get("identifier") for element in root.iter() if element.get("identifier")]
    assert len({*identifiers}) == len(identifiers)
    assert all(re.fullmatch(r"[A-Za-z_][\w.-]*", each) for each in identifiers)
    resources = [element for element in root.iter(f"{IMS}resource") if element.get(f"{ADLCP}scormtype") == "sco"]
    assert [each.get("identifierref") for each in root.iter(f"{IMS}item")] == [each.get("identifier") for each in resources]
    assert root.findtext(f"{IMS}metadata/{IMS}schemaversion") == "1.2"


def test_a_package_holds_the_manifest_and_the_pages_that_it_names(tmp_path):
    told, path = write_package("1", tmp_path / "one.zip")
    with zipfile.ZipFile(path) as archive:
        names = archive.namelist()
        root = ElementTree.fromstring(archive.read(MANIFEST))
    assert [lesson.name for lesson in told] == ["01_all_at_once"]
    assert names == [MANIFEST, "01_all_at_once.html"]
    assert {each.get("href") for each in root.iter(f"{IMS}file")} == {*names} - {MANIFEST}


@pytest.mark.slow
def test_the_same_exercises_give_the_same_package(tmp_path):
    contents = [write_package("1", tmp_path / name)[1].read_bytes() for name in ("one.zip", "two.zip")]
    assert contents[0] == contents[1]


@pytest.mark.slow
def test_a_folder_of_ones_own_has_a_page_for_each_file(tmp_path):
    told, _ = write_package(str(Path(__file__).parent / "questions"), tmp_path / "own.zip")
    assert [lesson.name for lesson in told] == ["anabaena", "kinds"]


HOSTILE = ['"><script>alert(1)</script>', "../../up", "a&b<c>]]>", "\x00\x1b\u202e", "con", "A" * 500, "ä é", "=1+1"]


@pytest.mark.parametrize("text", HOSTILE)
def test_whatever_a_lesson_is_called_is_text(text):
    exercise = Exercise(text, text, "choice", text, "A", text, (text,), otherwise=text)
    number = Exercise(text, text, "number", text, "3", text, (text,), otherwise=text)
    lesson = Lesson(text, text, (), text, text, (number, exercise))
    page = exercise_page(lesson)
    assert "<script>alert" not in page
    names = page_names([lesson, lesson])
    assert all(re.fullmatch(r"[A-Za-z0-9_]+\.html", name) for name in names)
    assert names[0] != names[1]
    root = ElementTree.fromstring(manifest([lesson], names[:1]))
    assert len(list(root.iter(f"{IMS}item"))) == 1
    assert zipfile.ZipFile(io.BytesIO(package([lesson], [page]))).testzip() is None


@pytest.mark.parametrize(
    ("what", "path", "error", "message"),
    [
        ("99", "a.zip", ModelNameError, "is no folder and no lesson"),
        ("01_all_at_onse", "a.zip", ModelNameError, "Did you mean"),
        ("1", "a.html", ModelValueError, r"A package is a \.zip file"),
        ("1", "no/folder/a.zip", ModelFileError, "cannot be written"),
        ("1", "mine.zip", ModelFileError, "not made by the kit"),
    ],
)
def test_what_cannot_be_packed_is_refused_in_words(what, path, error, message, tmp_path):
    (tmp_path / "mine.zip").write_text("mine")
    with pytest.raises(error, match=message):
        write_package(what, tmp_path / path)
    assert [each.name for each in tmp_path.iterdir()] == ["mine.zip"]


def test_a_folder_without_an_exercise_that_a_page_can_check_is_refused(tmp_path):
    (tmp_path / "own").mkdir()
    empty = 'title = "x"\nobjectives = ["x"]\nintroduction = ""\nsummary = ""\nexercise = []\n'
    (tmp_path / "own" / "my.toml").write_text(empty)
    with pytest.raises(ModelFileError, match="None of these exercises can be checked in a page"):
        write_package(str(tmp_path / "own"), tmp_path / "a.zip")


def test_the_shell_writes_a_package(tmp_path, capsys):
    assert main(["exercises", "scorm", "1", "-o", str(tmp_path / "a.zip")]) == 0
    assert "1 page, SCORM 1.2.\nThis is practice, not an examination" in capsys.readouterr().out
    assert main(["exercises", "scorm", "x", "-o", str(tmp_path / "b.zip")]) == 2


# What a page gives away


@pytest.mark.slow
def test_all_exercises_of_five_kinds_are_checked_in_a_page():
    kinds = {exercise.kind for exercise in EXERCISES if exercise.id in checked_in_pages()}
    assert kinds == {"choice", "line", "number", "table", "word"}
    assert all(exercise.id in checked_in_pages() for exercise in EXERCISES if exercise.kind in kinds)


def test_neither_solutions_nor_explanations_can_be_read_in_a_page(first):
    lesson, page = first
    packed = json.loads(re.search(r'id="lsys-data">(.*?)</script>', page)[1])
    scripts = "".join(inflated_text(packed[name]) for name in ("style", "script"))
    for exercise in lesson.exercises:
        assert exercise.explanation[:30] not in page + scripts
    assert "bl ar bl ar ar" not in page + scripts + json.dumps(packed["exercises"])
    assert "That is what comes out if you" not in page + json.dumps(packed["exercises"])


def test_a_page_asks_nothing_of_other_addresses_and_says_that_it_is_practice(first):
    _, page = first
    assert not re.findall(r"(?:src|action)=", page)
    assert set(re.findall(r'href="([^"]*)"', page)) == {"#main", "data:,"}
    assert "https:" not in page
    assert "This is practice, not an examination." in page


def test_exercises_that_only_the_kit_can_check_are_named(first):
    _, page = first
    listed = page[page.index("In the notebook") :]
    assert "<li>1.3 The filament in a mirror</li>" in listed
    assert 'data-exercise="1.3"' not in page


# What a page says


SAYING = f"""async cases => {{ {joined("controls", "numbers", "packed", "typed")}
return Promise.all(cases.map(async ([data, text]) => {{
  const {{ key, unreadable }} = read(data, text);
  if (unreadable) return {{ said: "Not readable yet", message: unreadable }};
  const [said, message, picture = ""] = JSON.parse(await unpacked(data.replies))[key] ?? [];
  return said ? {{ said, message, ...(picture && {{ picture }}) }} : null;
}})); }}"""


@pytest.fixture
def said(browser: Browser) -> Iterator[Callable[[list[Any]], list[Any]]]:
    """What a page says to answers: None to those of which it knows nothing."""
    tab = browser.new_page()
    yield lambda cases: tab.evaluate(SAYING, cases)
    tab.close()


def test_right_answers_are_right_in_a_page_in_every_form_that_can_be_typed(said):
    typed = [
        (exercise, form)
        for exercise in EXERCISES
        if exercise.id in checked_in_pages()
        for form in right_answers(exercise)
        if isinstance(form, str) and not _of_buttons(exercise, form)
    ]
    replies = said([[checked_in_pages()[exercise.id], form] for exercise, form in typed])
    wrong = [
        (exercise.id, form, reply)
        for (exercise, form), reply in zip(typed, replies, strict=True)
        if not reply or (reply["said"], reply["message"]) != ("Correct", exercise.explanation)
    ]
    assert wrong == []


def test_a_right_answer_comes_with_its_picture(said):
    right, wrong = said([[checked_in_pages()["15.4"], answer] for answer in ("13", "17")])
    assert ">13<" in right["picture"]
    assert "picture" not in wrong


def _of_buttons(exercise: Exercise, form: str) -> bool:
    return exercise.kind in ("choice", "line") and form != exercise.solution


def test_to_a_wrong_answer_that_is_understood_a_page_says_what_the_kit_says(said):
    understood = [
        (exercise, wrong) for exercise in EXERCISES if exercise.id in checked_in_pages() for wrong in wrong_answers_to(exercise)
    ]
    typed = [(exercise, _text(as_typed(exercise, wrong.answer))) for exercise, wrong in understood]
    replies = said([[checked_in_pages()[exercise.id], text] for exercise, text in typed])
    for (exercise, text), reply in zip(typed, replies, strict=True):
        if reply and reply["said"] == "Not readable yet" and exercise.kind == "word":
            continue
        verdict = check(exercise.id, int(text) if exercise.kind == "line" else text)
        assert reply == {"said": verdict.said, "message": verdict.message}, (exercise.id, text)


def _text(answer: Any) -> str:
    if isinstance(answer, tuple | list):
        return " ".join(map(str, answer))
    return str(answer)


NUMBERS = ["0", "22", "-21", "21.5", "1,021", "2100%", "21 degrees", "x", "", "21/0", "1/2/3", "--2", "21 21", "٢١", "9" * 60]


def test_no_other_number_is_right_in_a_page(said):
    replies = said([[checked_in_pages()["1.2"], text] for text in NUMBERS])
    assert all(reply is None or reply["said"] != "Correct" for reply in replies)
    right = said([[checked_in_pages()["1.2"], text] for text in ("21.0", "42/2", "N(6) = 21", "21 cells")])
    assert [reply["said"] for reply in right] == ["Correct"] * 4


def test_a_number_that_need_not_be_exact_is_right_within_its_tolerance_and_not_far_beyond(said):
    inexact = [exercise for exercise in EXERCISES if exercise.kind == "number" and exercise.tolerance]
    assert len(inexact) >= 5
    for exercise in inexact:
        solution, tolerance = float(Fraction(exercise.solution)), float(exercise.tolerance)
        near = [solution + factor * tolerance for factor in (-0.99, -0.3, 0.5, 0.99, -1.2, 1.2)]
        replies = said([[checked_in_pages()[exercise.id], f"{number:.12f}"] for number in near])
        right = [reply is not None and reply["said"] == "Correct" for reply in replies]
        assert right == [True] * 4 + [False] * 2, exercise.id


def test_numbers_are_rounded_in_a_page_as_in_the_kit(browser: Browser):
    tab, part = browser.new_page(), Fraction(3, 50)
    numbers = [Fraction(above, below) for above in range(-30, 31, 3) for below in (7, 25, 50, 100)]
    given = [[str(number.numerator * sign), str(number.denominator * sign)] for number in numbers for sign in (1, -1)]
    found = tab.evaluate(
        f"""given => {{ {joined("controls", "typed")}
return given.map(([above, below]) => rounded({{ above: BigInt(above), below: BigInt(below) }}, [3n, 50n])); }}""",
        given,
    )
    assert found == [rounded_key(number, part) for number in numbers for _ in (1, -1)]
    tab.close()


# What a platform is told


PLATFORM = """<!doctype html><script>
const values = { "cmi.core.lesson_status": "not attempted", ...START }, calls = [];
window.API = {};
for (const name of ["Initialize", "Finish", "GetValue", "SetValue", "Commit"]) {
  window.API[`LMS${name}`] = (...given) => {
    calls.push([name, ...given]);
    if (name === "SetValue") values[given[0]] = given[1];
    return name === "GetValue" ? values[given[0]] ?? "" : "ANSWER";
  };
}
</script><iframe src="/first.html" style="width:100%;height:800px"></iframe>"""


@pytest.fixture
def platform(browser: Browser, first, tmp_path: Path) -> Iterator[Callable[..., Page]]:
    """A learning platform, at an address that is not secure, with the page of the first lesson in a frame."""
    contexts, faults = [], []

    def opened(start: dict[str, str] | None = None, answer: str = "true", shell: str = PLATFORM) -> Page:
        contexts.append(browser.new_context(viewport={"width": 1440, "height": 900}))
        pages = {"/": shell.replace("START", json.dumps(start or {})).replace("ANSWER", answer), "/first.html": first[1]}

        def serve(route):
            path = re.sub(r"https?://[^/]*", "", route.request.url)
            route.fulfill(body=pages[path], content_type="text/html") if path in pages else route.abort()

        contexts[-1].route("**/*", serve)
        page = contexts[-1].new_page()
        page.on("pageerror", lambda error: faults.append(str(error)))
        page.goto("http://platform.test/")
        return page

    yield opened
    for context in contexts:
        context.close()
    assert faults == []


def typed(frame: Any, exercise: str, answer: str) -> Any:
    place = frame.locator(f'[data-exercise="{exercise}"]')
    place.locator("input").fill(answer)
    place.get_by_role("button", name="Check").click()
    return place.get_by_role("status")


def test_a_platform_is_told_score_and_status_after_a_wrong_and_a_right_answer(platform):
    page = platform()
    frame = page.frame_locator("iframe")
    expect(frame.locator("#told")).to_have_text("0 of 3 solved. The learning platform knows: score 0 of 100, incomplete.")
    expect(typed(frame, "1.1", "al al br")).to_contain_text("Almost. That is what comes out if you stop one step too early")
    assert told(page) == (None, "not attempted")
    expect(typed(frame, "1.1", "bl ar bl ar ar")).to_contain_text("Correct. Step by step")
    assert told(page) == ("33", "incomplete")
    expect(typed(frame, "1.2", "21 letters")).to_contain_text("Correct.")
    for letter in "AC":
        frame.locator(f'[data-exercise="1.5"] [data-key="{letter}"]').click()
    expect(frame.locator("#told")).to_have_text("3 of 3 solved. The learning platform knows: score 100 of 100, completed.")
    assert told(page) == ("100", "completed")
    assert page.evaluate("[values['cmi.core.score.min'], values['cmi.core.score.max']]") == ["0", "100"]


def told(page: Page) -> tuple[str, str]:
    return tuple(page.evaluate("[values['cmi.core.score.raw'], values['cmi.core.lesson_status']]"))


def test_a_platform_hears_of_the_beginning_and_the_end_once(platform):
    page = platform()
    typed(page.frame_locator("iframe"), "1.2", "21")
    page.evaluate("document.querySelector('iframe').src = 'about:blank'")
    page.wait_for_function("calls.some(([name]) => name === 'Finish')")
    calls = page.evaluate("calls")
    assert calls[0] == ["Initialize", ""]
    assert calls[-1] == ["Finish", ""]
    assert calls[-2] == ["Commit", ""]
    assert [name for name, *_ in calls].count("Initialize") == [name for name, *_ in calls].count("Finish") == 1
    assert re.fullmatch(r"\d{4}:\d\d:\d\d", page.evaluate("values['cmi.core.session_time']"))


def test_what_was_solved_on_another_day_is_solved_still(platform):
    page = platform({"cmi.suspend_data": '["1.1", "gone", 3]', "cmi.core.lesson_status": "incomplete"})
    frame = page.frame_locator("iframe")
    expect(frame.locator('[data-exercise="1.1"] [role=status]')).to_contain_text("You solved this before.")
    assert told(page) == (None, "incomplete")
    expect(typed(frame, "1.2", "21")).to_contain_text("Correct.")
    assert told(page) == ("67", "incomplete")


@pytest.mark.parametrize("kept", ["", "{", "null", '{"1.1": true}', "<script>", '{"solved": 3, "typed": [4]}'])
def test_what_a_platform_kept_wrongly_does_no_harm(platform, kept):
    stored = {"cmi.suspend_data": kept, "cmi.core.score.raw": "100", "cmi.core.lesson_status": "completed"}
    page = platform(stored)
    frame = page.frame_locator("iframe")
    expect(frame.locator("#told")).to_have_text("0 of 3 solved. The learning platform knows: score 100 of 100, completed.")
    assert {name: page.evaluate("name => values[name]", name) for name in stored} == stored
    expect(typed(frame, "1.2", "21")).to_contain_text("Correct.")
    assert told(page) == ("100", "completed")


@pytest.mark.parametrize(
    "fault",
    [
        'window.API.LMSGetValue = () => ""; window.API.LMSGetLastError = () => "101";',
        'window.API.LMSGetValue = () => { throw new Error("gone"); };',
        "delete window.API.LMSGetValue;",
    ],
)
def test_a_platform_that_cannot_be_read_loses_nothing(platform, fault):
    stored = {"cmi.suspend_data": '["1.1"]', "cmi.core.score.raw": "33", "cmi.core.lesson_status": "incomplete"}
    page = platform(stored, shell=PLATFORM.replace("</script>", f"{fault}</script>"))
    frame = page.frame_locator("iframe")
    expect(typed(frame, "1.2", "21")).to_contain_text("Correct.")
    expect(frame.locator("#told")).to_have_text(
        "1 of 3 solved. The learning platform cannot be read, so that nothing is written there."
    )
    assert {name: page.evaluate("name => values[name]", name) for name in stored} == stored


def test_a_platform_that_throws_is_named(platform):
    throws = 'for (const name in window.API) window.API[name] = () => { throw new Error("no"); };'
    frame = platform(shell=PLATFORM.replace("</script>", f"{throws}</script>")).frame_locator("iframe")
    expect(typed(frame, "1.2", "21")).to_contain_text("Correct.")
    expect(frame.locator("#told")).to_have_text("1 of 3 solved. The learning platform did not take the score.")


def test_what_was_typed_is_there_again(platform):
    page = platform()
    frame = page.frame_locator("iframe")
    typed(frame, "1.1", "al al br")
    frame.locator('[data-exercise="1.5"] [data-key="B"]').click()
    kept = page.evaluate("values['cmi.suspend_data']")
    assert json.loads(kept) == {"solved": [], "typed": {"1.1": "al al br", "1.5": "B"}}
    again = platform({"cmi.suspend_data": kept}).frame_locator("iframe")
    expect(again.locator('[data-exercise="1.1"] input')).to_have_value("al al br")
    expect(again.locator('[data-exercise="1.5"] [data-key="B"]')).to_have_attribute("aria-pressed", "true")


def test_what_is_kept_has_room(platform):
    page = platform()
    for exercise, text in (("1.1", "a" * 1_900), ("1.2", "7" * 1_900), ("1.1", "b" * 1_900)):
        typed(page.frame_locator("iframe"), exercise, text)
    assert len(page.evaluate("values['cmi.suspend_data']")) <= 4_096


def test_each_package_has_an_identifier_of_its_own():
    names = {
        re.search('identifier="(lsys-kit-[^"]*)"', manifest(told, page_names(told)))[1]
        for told in (lessons()[:1], lessons()[1:2], lessons())
    }
    assert len(names) == 3


def test_a_platform_that_takes_nothing_is_named_and_stops_no_answer(platform):
    frame = platform(answer="false").frame_locator("iframe")
    expect(typed(frame, "1.2", "21")).to_contain_text("Correct.")
    expect(frame.locator("#told")).to_have_text("1 of 3 solved. The learning platform did not take the score.")


def test_the_platform_may_be_in_the_window_that_opened_the_page(platform):
    page = platform(shell=PLATFORM.partition("<iframe")[0])
    with page.expect_popup() as popup:
        page.evaluate("void window.open('/first.html')")
    expect(popup.value.locator("#told")).to_contain_text("The learning platform knows: score 0 of 100")


# The page by itself


@pytest.fixture
def by_itself(browser: Browser, first, tmp_path: Path) -> Iterator[Callable[..., Page]]:
    """The page, opened from a file."""
    (tmp_path / "first.html").write_text(first[1])
    contexts, asked = [], []

    def opened(**choices: Any) -> Page:
        contexts.append(browser.new_context(**choices))
        page = contexts[-1].new_page()
        page.on("request", lambda request: asked.append(request.url))
        page.on("console", lambda message: asked.append(message.text))
        page.goto((tmp_path / "first.html").as_uri())
        return page

    yield opened
    for context in contexts:
        context.close()
    assert {*asked} == {(tmp_path / "first.html").as_uri()}


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize("width", [1440, 400])
def test_a_page_works_from_a_file_by_keyboard_at_every_width(by_itself, pytestconfig, scheme, width):
    page = by_itself(viewport={"width": width, "height": 900}, color_scheme=scheme)
    expect(page.locator("#told")).to_contain_text("0 of 3 solved. No learning platform")
    place = page.locator('[data-exercise="1.1"]')
    replies = {"...": "Not answered yet.", "al bx": 'no symbol "bx"', "al al br": "Almost.", "bl": "Not yet."}
    for answer, reply in replies.items():
        place.locator("input").fill(answer)
        place.locator("input").press("Enter")
        expect(place.get_by_role("status")).to_contain_text(reply)
    place.get_by_role("button", name="Hint 1 of 3").press("Enter")
    expect(place.get_by_role("listitem")).to_have_count(1)
    typed(page, "1.2", "21")
    page.locator('[data-key="A"]').click()
    assert page.evaluate("document.documentElement.scrollWidth") == width
    page.evaluate(AXE.read_text())
    assert page.evaluate("async () => (await axe.run()).violations.map((each) => each.id + each.nodes[0].html)") == []
    if folder := pytestconfig.getoption("screenshots"):
        page.screenshot(path=Path(folder) / f"scorm-{scheme}-{width}.png")
