"""The course as static pages: what stands in them, where their links lead, and that nothing else of the user's is touched."""

from __future__ import annotations

import base64
import io
import itertools
import json
import re
import sys
from collections import Counter
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from html import escape
from pathlib import Path
from urllib.parse import unquote

import numpy as np
import pytest
from nbformat.v4 import new_code_cell, new_markdown_cell, new_notebook, new_output, writes
from PIL import Image
from playwright.sync_api import Browser

from lsys_kit import LSystemError, ModelFileError, compare, draw, explore, map_system, predict, system, vote, worksheet
from lsys_kit.classroom.course import course_files
from lsys_kit.classroom.exercises.registry import lessons
from lsys_kit.classroom.lessons.lesson import declared, names
from lsys_kit.classroom.lessons.slips import Known, slips_of
from lsys_kit.classroom.lessons.widget import prose_html
from lsys_kit.classroom.lessons.worksheet import checked
from lsys_kit.classroom.panel.document import inflated_text
from lsys_kit.classroom.scorm.package import manifest
from lsys_kit.classroom.site.build import build_site, read_notebook, run
from lsys_kit.classroom.site.contents import index_page
from lsys_kit.classroom.site.markdown import PLAIN_TAGS, address_on_site, markdown_html, mathml
from lsys_kit.classroom.site.pages import Entry, cells_html, data_html, headings, notebook_page, title_of
from lsys_kit.classroom.site.requests import notes
from lsys_kit.classroom.site.showing import PART, SMALL_WIDTH, THEMES, light_or_dark, part, small_picture
from lsys_kit.pictures.picture import Picture
from tests.classroom.front_end import joined
from tests.classroom.test_page import Parts
from tests.test_hostile_names import HOSTILE

LESSON, EXERCISES, OTHER = "notebooks/01_all_at_once.ipynb", "exercises/01_all_at_once.ipynb", "notebooks/02_more.ipynb"
ENTRIES = [Entry(LESSON, "All at once", declared("01_all_at_once")), Entry(OTHER, "More & more"), Entry(EXERCISES, "Exercises")]
PASSING = {
    "main",
    "p",
    "h1",
    "h2",
    "em",
    "strong",
    "code",
    "pre",
    "ul",
    "ol",
    "li",
    "table",
    "thead",
    "tbody",
    "tr",
    "th",
    "td",
    "div",
    "a",
    "br",
    "blockquote",
    "hr",
    *PLAIN_TAGS,
    "math",
    "mi",
    "mn",
    "mo",
    "mrow",
    "mfrac",
}
"""The elements that a text may become."""


def plain(text: str) -> str:
    return markdown_html(text, lambda address: address)


def ran(source: str, widget: object = None):
    """A code cell as it is after a run for the site."""
    data = part(widget) if widget is not None else {"text/plain": "1"}
    return new_code_cell(source, outputs=[new_output("execute_result", data)])


def ran_prediction(question: str, widget: object):
    """A prediction as it is after such a run: what answers it is a part, too."""
    data = part(predict(question, "..."))
    data[PART]["answer"] = part(widget)
    return new_code_cell("predict()", outputs=[new_output("execute_result", data)])


def lesson_page() -> str:
    cells = [
        new_markdown_cell("# All at once\n\n[try](../exercises/01_all_at_once.ipynb), [gone](99.ipynb)"),
        ran('vote("01")', vote("01")),
        ran("explore('J4')", explore("J4")),
        ran_prediction("Why?", explore("K5", 2)),
        ran("compare('P2', 'P3')", compare("P2", "P3")),
        ran("w", worksheet("01", "counts")),
        ran("b", worksheet("01", "counts", explore("J4", 5))),
        ran('vote("01", again=True)', vote("01", again=True)),
    ]
    return notebook_page(ENTRIES[0], cells, ENTRIES)


# --- Markdown ---------------------------------------------------------------------------------------------------------------


@pytest.mark.parametrize("text", HOSTILE, ids=ascii)
def test_no_text_of_a_notebook_becomes_markup(text: str) -> None:
    assert set(Parts(f"<main>{plain(f'A {text} B')}</main>").tags) <= PASSING


@pytest.mark.parametrize(
    "text",
    [
        "<script>x</script>",
        "<img src=x onerror=y>",
        "<sup onclick=x>a</sup>",
        "<details open>",
        "![a picture](https://example.org/a.png)",
    ],
)
def test_of_html_only_plain_tags_pass(text: str) -> None:
    for written in (text, f"Look: {text}"):
        assert not re.search(r"<(script|img|sup|details)", plain(written))


def test_a_folded_answer_stays_folded_and_its_markdown_is_read() -> None:
    found = plain("<details><summary>Answer</summary>\n\nIt has **3** cells, x<sup>2</sup>.\n\n</details>")
    assert "<details><summary>Answer</summary>" in found
    assert "<p>It has <strong>3</strong> cells, x<sup>2</sup>.</p>" in found


def test_formulas_are_mathml_without_an_address() -> None:
    found = plain("so $N(t) = x^{t-A}$, and\n\n$$1 = x^{-A} + x^{-B}.$$")
    assert found.count("<math") == 2
    assert 'display="block"' in found
    assert "$" not in found
    assert "://" not in found


def test_a_formula_that_cannot_be_read_stays_as_it_is_written() -> None:
    assert mathml(r"\frac{") == r"<code>\frac{</code>"


def test_an_empty_cell_above_a_table_heads_no_column() -> None:
    assert re.findall(r"<t[hd]\b.*?>", plain("| | b |\n|---|---|\n| c | |")) == ["<td>", '<th scope="col">', "<td>", "<td>"]


def test_a_bar_in_a_table_is_a_bar() -> None:
    assert "<code>|</code>" in plain("| a | b |\n|---|---|\n| `\\|` | c |")


@pytest.mark.parametrize(
    ("address", "leads"),
    [
        ("#Summary", "#Summary"),
        ("02_more.ipynb", "02_more.html"),
        ("../exercises/01_all_at_once.ipynb", "../exercises/01_all_at_once.html"),
        ("02_more.ipynb#A-place", "02_more.html#A-place"),
        ("03_not_there.ipynb", None),
        ("https://example.org", None),
        ("javascript:alert(1)", None),
        ("teacher/01_all_at_once.md", None),
        ("../../../etc/passwd", None),
    ],
)
def test_links_lead_to_pages_of_the_site_or_nowhere(address: str, leads: str | None) -> None:
    assert address_on_site(LESSON, {each.name for each in ENTRIES}, address) == leads


# --- pages ------------------------------------------------------------------------------------------------------------------


@pytest.mark.slow
@pytest.mark.parametrize("made", [lesson_page, partial(index_page, ENTRIES, {})], ids=["lesson", "index"])
def test_a_page_has_no_address_outside_and_runs_nothing_but_the_kits_script(made: Callable[[], str]) -> None:
    text = made()
    parts = Parts(text)
    policy = next(value for _, value in parts.attributes if value and value.startswith("default-src 'none'"))
    assert "unsafe-eval" not in policy
    assert ("script-src 'sha256-" in policy) == ("<script" in text)
    assert not [name for name, _ in parts.attributes if name.startswith("on")]
    links = [value for name, value in parts.attributes if name in ("href", "src", "action")]
    assert all(re.match(r"data:|#|[\w./]+\.html$", link or "") for link in links), links
    assert "teacher" not in text
    assert text.encode().find(b"lsys-kit") < 4_096


@pytest.mark.slow
def test_each_part_has_its_place_and_its_data() -> None:
    text = lesson_page()
    places = re.findall(r'data-part="(\d+)"', text)
    kinds = [each["kind"] for each in json.loads(Parts(text).inside["script"][0])["parts"]]
    assert sorted(map(int, places)) == list(range(len(kinds)))
    assert kinds == ["vote", "panel", "prediction", "panel", "comparison", "worksheet", "beside", "vote"]


def test_code_that_gives_an_answer_away_is_folded() -> None:
    shown = cells_html([ran("predict('Why?', 'Because.')", predict("Why?", "Because."))], lambda each: each, [])
    assert shown.index("Code of this cell") < shown.index("Because.&#x27;")
    assert shown.index("<summary>Why?") < shown.index("Because.")


def test_a_picture_is_kept_deflated_and_its_place_has_its_size() -> None:
    data, parts = draw(system("K5"), 4)._repr_mimebundle_(), []
    shown, svg = data_html(data, parts), data["image/svg+xml"]
    assert inflated_text(parts[0]["data"]["drawing"]) == svg
    place = Parts(shown).attributes
    assert ("data-part", "0") in place
    empty = unquote(next(value for name, value in place if name == "src"))
    assert empty.startswith("data:image/svg+xml,")
    assert re.search(r' width="\d+" height="\d+"', empty)[0] in svg


def test_exercises_are_shown_without_the_cells_that_check_them() -> None:
    cells = [
        new_markdown_cell("# Exercises\n\nAll of them."),
        ran("from lsys_kit import check"),
        new_markdown_cell("## 1.1 By hand"),
        ran('answer = ...\ncheck("1.1", answer)'),
        ran("draw(system('K5'))"),
        new_markdown_cell("## For a class", id="marks"),
        ran('from lsys_kit import score\n\nscore("1.1")'),
    ]
    text = notebook_page(ENTRIES[2], cells, ENTRIES)
    assert [each for each in ("check(", "score(", "For a class") if each in text] == []
    assert text.index("</h1>") < text.index("lsys-kit lab") < text.index("All of them.")
    assert text.count('<div class="room"') == 1
    assert "draw(" in text
    assert '<a class="also" href="../notebooks/01_all_at_once.html">' in text


@pytest.mark.slow
def test_a_picture_in_the_sun_is_small_and_looks_the_same() -> None:
    cell = ran("draw(...)")
    png = draw(system("ABOP-1.25"), light=True).png
    for mode, kept in (("RGB", False), ("RGBA", True)):
        file = io.BytesIO()
        Image.open(io.BytesIO(png)).convert(mode).save(file, "PNG")
        cell.outputs[0].data = {"image/png": base64.b64encode(file.getvalue()).decode(), "text/plain": "a bush"}
        found = re.search(r'src="data:image/(\w+);base64,([^"]+)"', cells_html([cell], lambda each: each, []))
        assert found
        shown = base64.b64decode(found[2])
        assert (found[1], shown == file.getvalue()) == (("png", True) if kept else ("webp", False))
        there, here = (np.asarray(Image.open(io.BytesIO(each)).convert("RGB"), float) for each in (png, shown))
        assert np.abs(there - here).mean() < 3
        assert kept or len(shown) < len(png) / 3


@pytest.mark.slow
def test_pages_lead_on_and_back() -> None:
    text = lesson_page()
    for link in (
        'href="../index.html"',
        'class="after" href="02_more.html"',
        'class="also" href="../exercises/01_all_at_once.html"',
        '<a href="../exercises/01_all_at_once.html">try</a>',
        ", gone",
    ):
        assert link in text
    assert 'class="before"' not in text


def test_the_first_page_has_each_lesson_with_what_it_asks_and_what_one_can_do_then() -> None:
    lesson = declared("01_all_at_once")
    text = index_page(ENTRIES, {LESSON: "<svg/>"})
    objectives = [prose_html(each) for each in lesson.objectives]
    for said in (
        "All at once",
        "who is right?",
        "50 minutes",
        "More &amp; more",
        'href="exercises/01_all_at_once.html"',
        *objectives,
    ):
        assert said in text
    assert [part["kind"] for part in json.loads(Parts(text).inside["script"][0])["parts"]] == ["picture"]
    assert text.count("<img") == 1


@pytest.mark.parametrize(
    "picture",
    [
        pytest.param(lambda: draw(system("K5"), 3), id="plant"),
        pytest.param(lambda: draw(system("J4"), 5), id="filament"),
        pytest.param(lambda: draw(map_system("K29"), 2), id="map"),
    ],
)
def test_a_small_picture_has_the_colours_of_the_dark_where_it_is_dark(browser: Browser, picture) -> None:
    drawn, tab = picture(), browser.new_page(color_scheme="dark")
    tab.set_content(small_picture(drawn))
    seen = "(all) => all.map((each) => getComputedStyle(each).fill + getComputedStyle(each).stroke)"
    found = tab.locator("svg *:not(style)").evaluate_all(seen)
    bare = replace(drawn, labels=False, current=None) if isinstance(drawn, Picture) else drawn
    tab.set_content(replace(bare, pixels=(SMALL_WIDTH, None), theme=THEMES[1]).svg)
    assert found == tab.locator("svg *").evaluate_all(seen)
    tab.emulate_media(color_scheme="light")
    tab.set_content(small_picture(drawn))
    assert tab.locator("svg *:not(style)").evaluate_all(seen) != found
    tab.close()


def test_a_picture_in_which_a_colour_would_have_to_be_two_stays_light() -> None:
    light = '<svg><a fill="#111111"/><b fill="#111111"/></svg>'
    assert light_or_dark(light, light.replace("#111111", "#eeeeee", 1)) == light


@pytest.mark.parametrize("name", names())
def test_exercises_are_called_as_their_lesson_is(name: str) -> None:
    files, title = course_files(), declared(name).title
    readme = (Path(__file__).parents[2] / "README.md").read_text("utf-8")
    assert next(lesson.title for lesson in lessons() if lesson.name == name) == title
    for file, heading in ((f"notebooks/{name}.ipynb", f"# {title}"), (f"exercises/{name}.ipynb", f"# Exercises: {title}")):
        assert next(headings(read_notebook(files[file]).cells)) == heading
    assert f"[{title}](notebooks/{name}.ipynb)" in readme
    assert f"<title>{escape(title)}</title>" in manifest([lesson for lesson in lessons() if lesson.name == name], ["a.html"])


# --- what a page cannot do ----------------------------------------------------------------------------------------------------


def asked_for(text: str, live: bool = False) -> list[str]:
    """The kinds of requests below which a page says that it cannot do it."""
    return re.findall(r'data-cannot="(\w+)"', markdown_html(text, lambda address: address, notes(live)))


@pytest.mark.parametrize(
    ("text", "kinds"),
    [
        ("Press *rules*, change a character, and watch.", ["rules"]),
        ("Press **rules** in the panel and delete the line `br -> ar`.\n\nPress *rules* again.", ["rules"]),
        ("1. Look.\n2. Let a cell that points right stay for ever: `B -> B`.", ["rules"]),
        ("In the last line write `1+t` in place of `a^t`.", ["rules"]),
        ("Then change one line in the panel.", ["rules"]),
        ("Write 10000 in place of 1000 and run the cell again, if you like.", ["cells"]),
        ("Change the two numbers in the next cell, run it again with **Shift+Enter**.", ["cells"]),
        ("In the rule that begins with `copies`, write `T(s/3)` for `T(s/2)`, and run it and the next.", ["cells"]),
        ("Try it in a new cell.", ["cells"]),
        ("Run the next cell and vote.", []),
        ("Look at the four division rules once more.", []),
        ("Now grow the filament with a pencil. For each step, write the word in a row.", []),
        ("- change a rule, and say beforehand what will become of the filament", []),
        ("Let *p* be the life span of A.", []),
        ("<details><summary>Answer</summary>\n\nPress rules.\n\n</details>\n\nRun it again.", ["cells"]),
    ],
)
def test_a_page_says_below_a_request_that_it_cannot_be_done_there(text: str, kinds: list[str]) -> None:
    assert asked_for(text) == kinds
    assert asked_for(text, live=True) == [each for each in kinds if each == "cells"]


@pytest.mark.slow
def test_in_every_lesson_what_asks_for_other_rules_or_another_run_is_found() -> None:
    found = Counter[str]()
    for name in names():
        for cell in read_notebook(course_files()[f"notebooks/{name}.ipynb"]).cells:
            if cell.cell_type != "markdown":
                continue
            kinds, text = asked_for(cell.source), re.sub(r"[*`]", "", cell.source)
            assert "rules" in kinds or not re.search(r"\b[Pp]ress\s+rules\b", text), cell.source
            assert "cells" in kinds or not re.search(r"\brun\s+(it|the\s+cell)\b[^.]*\bagain\b", text), cell.source
            found.update(kinds)
    assert found["rules"] >= 30
    assert found["cells"] >= 8


def test_the_gallery_is_on_the_first_page_and_is_no_lesson() -> None:
    gallery = Entry("notebooks/gallery.ipynb", "Gallery")
    lessons, others = index_page([*ENTRIES, gallery], {}).split('<h2 id="reference">')
    assert 'href="notebooks/gallery.html"' in others
    assert "gallery" not in lessons
    page = notebook_page(gallery, [new_markdown_cell("# Gallery")], [*ENTRIES, gallery])
    assert "Votes and tables" not in page
    assert 'class="before"' not in page
    assert "gallery" not in notebook_page(ENTRIES[1], [new_markdown_cell("# More")], [*ENTRIES, gallery])


def test_the_title_is_the_first_heading() -> None:
    assert title_of([new_markdown_cell("text\n\n# The *K5* `plant`\n\n# Not this")], "x") == "The K5 plant"


# --- tables without a kernel --------------------------------------------------------------------------------------------------

TYPED = [
    "",
    " ",
    "2",
    " 2 ",
    "4/2",
    "2.0",
    "02",
    "+2",
    "-2",
    "−2",
    "2,0",
    "200%",
    "200 %",
    "1,000",
    "2/0",
    "al br",
    "AL  Br",
    "1.5",
    "1.618",
    "1.62",
    "x" * 201,
    "1e3",
    "٢",
    "5*5",
    "5 * 5",
    "no",
    "½",
    "1,5",
    "12,345.5",
    "2.500",
    "2'500",
    "2.500,5",
    ".5",
    ",5",
    "2,5 %",
    "5^2",
    "5·5",
    "2 × 500",
    "N = 2",
    "≈2",
    "about 2",
    "2 cells",
    "1000 Walls",
    "25°",
    "1½",
    "n",
    "Nein",
    "l",
    "constructor",
    "5^99*9^99",
]
CELLS = [
    (["2"], "0"),
    (["-2", "two"], "0"),
    (["25", "5*5"], "0"),
    (["1.618"], "0.001"),
    (["al br"], "0"),
    (["1000"], "0"),
    (["12345.5"], "1/2"),
    (["1/2"], "1%"),
    (["no", "none"], "0"),
    (["left"], "0"),
    (["2500", "2000.5"], "0"),
]


def test_a_page_finds_right_what_the_kernel_finds_right(browser: Browser) -> None:
    from lsys_kit.classroom.lessons.entries import is_right

    tab = browser.new_page()
    cases = [[typed, *cell, ["cell", "wall", "°"]] for typed, cell in itertools.product(TYPED, CELLS) if typed != "٢"]
    found = tab.evaluate(
        f"cases => {{ {joined('constants', 'asking', 'checking')}\nreturn cases.map((each) => isRight(...each)); }}", cases
    )
    assert found == [is_right(*case) for case in cases]
    assert len(set(found)) == 2
    tab.close()


@pytest.mark.parametrize("name", names())
def test_a_page_says_of_a_table_what_the_kernel_says(browser: Browser, name: str) -> None:
    tab, code = (
        browser.new_page(),
        f"([data, entries]) => {{ {joined('constants', 'asking', 'checking')}\nreturn checked(data, entries); }}",
    )
    for table in declared(name).tables:
        right = [blank.right[0] for _, _, blank in table.blanks]
        data = worksheet(name[:2], table.id).page_data
        slipped = [each.answer for number in range(len(right)) for each in slips_of(table, number)[:1] or [Known("7", "")]]
        for entries in (
            right,
            right[:1],
            [],
            ["?", *right[1:]],
            [*right[:-1], "?"],
            ["?"] * len(right),
            slipped,
            ["7"] * len(right),
        ):
            found = tab.evaluate(code, [data, entries])
            padded = [*entries, *[""] * (len(right) - len(entries))]
            assert found == checked(table, padded)
    tab.close()


# --- files --------------------------------------------------------------------------------------------------------------------


@pytest.fixture
def course(tmp_path: Path) -> Path:
    """A course of one lesson, one exercise and one reference."""
    home = tmp_path / "kit"
    for name, source in (
        (LESSON, "from lsys_kit import *\n\nexplore('J1', 3)"),
        (EXERCISES, "check(1)"),
        ("notebooks/reference/notation.ipynb", "print('read')"),
    ):
        (home / name).parent.mkdir(parents=True, exist_ok=True)
        (home / name).write_text(writes(new_notebook(cells=[new_markdown_cell("# Title"), new_code_cell(source)])))
    return home


@pytest.mark.slow
def test_a_site_is_built_twice_and_each_page_is_the_same(course: Path, tmp_path: Path) -> None:
    (tmp_path / "site").mkdir()
    (tmp_path / "site" / "mine.txt").write_text("mine")
    pages = build_site(tmp_path / "site", course)
    assert [str(page.relative_to(tmp_path / "site")) for page in pages] == [
        "index.html",
        "notebooks/01_all_at_once.html",
        "exercises/01_all_at_once.html",
        "notebooks/reference/notation.html",
    ]
    texts = [page.read_text("utf-8") for page in pages]
    assert '"kind":"panel"' in texts[1]
    assert "<pre>read</pre>" in texts[3]
    assert [page.read_text("utf-8") for page in build_site(tmp_path / "site", course)] == texts
    assert (tmp_path / "site" / "mine.txt").read_text() == "mine"


def test_nothing_is_run_where_a_page_would_replace_what_is_not_the_kits(course: Path, tmp_path: Path) -> None:
    mine = tmp_path / "site" / "notebooks" / "01_all_at_once.html"
    mine.parent.mkdir(parents=True)
    mine.write_text("mine")
    with pytest.raises(ModelFileError, match="not made by the kit"):
        build_site(tmp_path / "site", course)
    assert mine.read_text() == "mine"
    assert not (tmp_path / "site" / "index.html").exists()


def test_a_folder_that_is_a_file_is_no_folder(course: Path, tmp_path: Path) -> None:
    (tmp_path / "site").write_text("mine")
    with pytest.raises(ModelFileError, match="cannot be written"):
        build_site(tmp_path / "site", course)


@pytest.mark.slow
def test_a_cell_that_fails_is_said_with_its_lesson(course: Path, tmp_path: Path) -> None:
    (course / OTHER).write_text(writes(new_notebook(cells=[new_markdown_cell("# Title"), new_code_cell("1 / 0")])))
    with pytest.raises(LSystemError, match=r"A cell of notebooks/02_more\.ipynb fails: ZeroDivisionError"):
        build_site(tmp_path / "site", course)


@pytest.mark.slow
@pytest.mark.parametrize(
    "shown",
    ["panel", "predict('How many?', panel)", "worksheet('01', 'counts', panel)", "display(panel)"],
    ids=lambda shown: shown[:9],
)
def test_a_panel_that_cannot_be_put_on_its_page_ends_the_site(course: Path, tmp_path: Path, shown: str) -> None:
    """A notebook passes over what fails only when it is shown."""
    source = f"from lsys_kit import *\n\npanel = explore('J1', 3)\npanel.page_data = lambda asked: 1 / 0\n{shown}"
    (course / LESSON).write_text(writes(new_notebook(cells=[new_markdown_cell("# Title"), new_code_cell(source)])))
    with pytest.raises(LSystemError, match=r"notebooks/01_all_at_once\.ipynb cannot have .* shows: ZeroDivisionError"):
        build_site(tmp_path / "site", course)
    assert not (tmp_path / "site" / LESSON.replace("ipynb", "html")).exists()


@pytest.mark.slow
def test_a_kernel_whose_port_is_taken_is_started_again(course: Path, tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    spec = tmp_path / "jupyter" / "kernels" / "python3" / "kernel.json"
    spec.parent.mkdir(parents=True)
    once = (
        "import pathlib, runpy, sys; tried = pathlib.Path(sys.argv.pop(1)); "
        "tried.exists() or (tried.touch(), sys.exit(1)); runpy.run_module('ipykernel_launcher', run_name='__main__')"
    )
    spec.write_text(
        json.dumps(
            {
                "display_name": "Python 3",
                "language": "python",
                "argv": [sys.executable, "-c", once, str(tmp_path / "tried"), "-f", "{connection_file}"],
            }
        )
    )
    monkeypatch.setenv("JUPYTER_PATH", str(tmp_path / "jupyter"))
    notebook = run(LESSON, course / LESSON)
    assert (tmp_path / "tried").exists()
    assert notebook.cells[1].outputs


def test_the_teachers_pages_are_not_on_the_site(course: Path) -> None:
    from lsys_kit.classroom.course import course_files

    (course / "notebooks" / "teacher").mkdir()
    (course / "notebooks" / "teacher" / "01_all_at_once.ipynb").write_text("{}")
    assert not [name for name in course_files(course) if "teacher" in name]
