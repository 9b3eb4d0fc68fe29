"""The pages of the site: a lesson, its exercises, the gallery, a reference."""

from __future__ import annotations

import base64
import io
import re
from collections.abc import Iterator, Mapping, Sequence
from dataclasses import dataclass, field
from functools import partial
from pathlib import Path, PurePosixPath
from posixpath import normpath, relpath
from typing import TYPE_CHECKING
from urllib.parse import quote

from lsys_kit.classroom.course import is_lesson
from lsys_kit.classroom.exercises.kinds.choices import letters
from lsys_kit.classroom.exercises.practice.drafts import TOPICS
from lsys_kit.classroom.exercises.registry import exercise_of
from lsys_kit.classroom.exercises.replies import reply
from lsys_kit.classroom.handed_in import content_of
from lsys_kit.classroom.lessons.lesson import Lesson
from lsys_kit.classroom.lessons.widget import escaped_lines, html, prose_html, prose_text
from lsys_kit.classroom.panel.bundle import Data, compact, style, translated_words
from lsys_kit.classroom.panel.document import Program, deflated_text, document
from lsys_kit.classroom.panel.page import not_needed, unasked
from lsys_kit.classroom.places import TITLE
from lsys_kit.classroom.site.markdown import Links, Places, address_on_site, markdown_html, mathml
from lsys_kit.classroom.site.requests import notes
from lsys_kit.classroom.site.showing import PART
from lsys_kit.files import Entries, file_errors
from lsys_kit.pictures.formats.notebook import DARKENED
from lsys_kit.pictures.style.labels import escaped
from lsys_kit.translation import ENGLISH, gettext

if TYPE_CHECKING:
    from nbformat import NotebookNode

INDEX, LAB = "index.html", "lsys-kit lab"
_KEPT = """<p class="note">The cells of this page have been run, and its panels move; nothing has to be installed. To change
rules and code, open the lesson in Jupyter: <code>{command}</code>. Votes and tables are checked on the page itself: what is
right stands in it, and is no secret. What you type is kept by this browser alone.</p>
"""
_HOW = """<div class="note"><p><strong>How to answer.</strong> This page is for reading and for printing. Type
<code>{command}</code>, and open <code>{name}</code> in JupyterLab: there a cell below each question takes the answer, and
checks it when it is run, with hints after a try.</p></div>
"""
_ROOM = f'<div class="room" aria-hidden="true">{3 * "<i></i>"}</div>\n'
"""Lines for an answer on paper."""
_IN_JUPYTER = reply("notebook.how", id="\0").partition("\0")[0]
"""How a notebook begins to say how its cells are used."""
_ABOUT_ANSWERS = re.compile(r"check|progress\(|score\(")
"""What stands in cells of exercises that get ready for answers, ask for hints, or sum up."""


_PANELS = frozenset({"panel", "compare"})
"""The scripts that only a page with panels calls, and those that they call."""


@dataclass(frozen=True)
class Answering:
    """Who answers on pages on which rules can be changed and exercises answered: the script of such pages, what it has to know,
    and the files that lie beside them, by their names in the site; on pages of a class its server, which they come from.
    """

    script: str
    data: Data = field(default_factory=dict)
    files: Mapping[str, bytes] = field(default_factory=dict)

    @property
    def holds_kit(self) -> bool:
        """Whether pages hold the kit, so that nobody else is asked."""
        return bool(self.files)


def opening(script: str) -> str:
    """What opens a page by a script, after the script itself.

    >>> opening("kit_page")[-15:]
    'openKitPage();\\n'
    """
    return f'"use strict";\n{compact(script)}\nopen{script.title().replace("_", "")}();\n'


CLASS = Answering("class_page")


@dataclass(frozen=True)
class Entry:
    """A notebook on the site: its file, relative to the course, its title as a text, and what is declared of it if it is a
    lesson; the title of the course, the command that opens it, the files of its pictures, by their names in it, and the
    language of its text.
    """

    name: str
    title: str
    lesson: Lesson | None = None
    course: str = TITLE
    command: str = LAB
    pictures: Mapping[str, Path] = field(default_factory=dict, hash=False)
    language: str = ENGLISH

    @property
    def page(self) -> str:
        """The file of its page, relative to the site."""
        return f"{self.name.removesuffix('.ipynb')}.html"

    @property
    def folder(self) -> str:
        """Its folder in the course."""
        return str(PurePosixPath(self.name).parent)


def notebook_page(entry: Entry, cells: Sequence[NotebookNode], entries: Sequence[Entry], live: Answering | None = None) -> str:
    """The page of a notebook; of exercises the questions, with room on paper for each answer.

    On a live page, which has somebody who answers, exercises can be answered and rules changed.
    """
    links, parts = (
        Places(partial(address_on_site, entry.name, {each.name for each in entries}), partial(_picture, entry)),
        Parts(),
    )
    if entry.folder == "exercises":
        head, *questions = re.split("(?=<h2)", "".join(_question_html(each, links, parts, live) for each in cells))
        title, end, rest = head.partition("</h1>\n")
        begin = title + end + ("" if live else gettext(_HOW, name=escaped(entry.name), command=escaped(entry.command))) + rest
        begin += "".join(f'<div class="question">\n{each}</div>\n' for each in questions)
        begin += _practice_html(entry, parts) if live else ""
    else:
        note = gettext(_KEPT, command=escaped(entry.command)) if is_lesson(entry.name) and not live else ""
        begin = cells_html(cells[:1], links, parts, live) + note + cells_html(cells[1:], links, parts, live)
        begin += _place_for_done(entry)
    row = _neighbours(entry, entries)
    body = (
        f'<a class="skip" href="#main">{gettext("Skip to the text")}</a>\n<header>{_above(entry)}</header>\n'
        f'<main id="main">\n{begin}</main>\n<footer><nav aria-label="{gettext("other pages")}">{row}</nav></footer>\n'
    )
    described = prose_text(entry.lesson.question) if entry.lesson else entry.title
    return document(entry.title, body, style("course"), described, _program(entry, parts, live), entry.language)


MOST_PICTURE = 2_000_000
"""The greatest size of a picture in a text."""
_KINDS = {".png": "png", ".jpg": "jpeg", ".jpeg": "jpeg", ".gif": "gif", ".svg": "svg+xml"}


def _picture(entry: Entry, address: str) -> str | None:
    """The address of a picture that a text shows, which holds all of it; None where the course has no such picture."""
    path = entry.pictures.get(normpath(f"{entry.folder}/{address}"))
    if path is None:
        return None
    with file_errors(f'"{path}" cannot be shown'):
        content = content_of(path, MOST_PICTURE)
    return f"data:image/{_KINDS[path.suffix]};base64,{base64.b64encode(content).decode()}"


def _question_html(cell: NotebookNode, links: Links, parts: Parts, live: Answering | None) -> str:
    """A cell of exercises: its text, but not what is there for marks alone; in the place of a cell for an answer room on paper,
    or on a live page what takes the answer."""
    if cell.cell_type == "markdown":
        return "" if cell.get("id") == "marks" else markdown_html(cell.source.partition(_IN_JUPYTER)[0], links)
    if live and (found := _ANSWER.fullmatch(cell.get("id", ""))):
        return _answer_html(found[1].replace("-", "."), parts)
    if any(line.startswith("check(") for line in cell.source.splitlines()):
        return _ROOM
    return "" if _ABOUT_ANSWERS.search(cell.source) or not cell.source.strip() else _code_html(cell, [])


_ANSWER = re.compile(r"exercise-([\w-]+)-answer")
"""The id of the cell in which an exercise is answered."""


def _answer_html(id: str, parts: Parts) -> str:
    """The place in which an exercise is answered on a live page."""
    found = exercise_of(id)
    data = {
        "id": found.id,
        "kind": found.kind,
        "title": found.title,
        "template": found.template,
        "hints": len(found.hints),
        "options": [*letters(found)] if found.kind == "choice" else [],
    }
    return _part_html({"kind": "exercise", "data": data}, "", parts)


def _practice_html(entry: Entry, parts: Parts) -> str:
    """Below the exercises of a lesson, on a live page: exercises without end on what it is about."""
    number = PurePosixPath(entry.name).name[:2]
    topics = [[name, gettext(said["title"])] for name, said in TOPICS.items() if f"{said['lesson']:02}" == number]
    if not topics:
        return ""
    return f"<h2>{gettext('Practice')}</h2>\n{_part_html({'kind': 'practice', 'data': {'topics': topics}}, '', parts)}"


def _above(entry: Entry) -> str:
    home = relpath(INDEX, entry.folder)
    return f'<nav aria-label="{gettext("the course")}"><a href="{home}">{escaped(entry.course)}</a></nav>'


def _place_for_done(entry: Entry) -> str:
    """Where the script of a lesson's page offers a box to be ticked when it is done."""
    name = escaped(PurePosixPath(entry.name).stem)
    return f'<p data-lesson="{name}"></p>\n' if is_lesson(entry.name) else ""


def _neighbours(entry: Entry, entries: Sequence[Entry]) -> str:
    return "\n".join(
        f'<a class="{kind}" href="{escaped(relpath(other.page, entry.folder))}"><span>{label}</span> {escaped(other.title)}</a>'
        for kind, label, other in _others(entry, entries)
    )


def _others(entry: Entry, entries: Sequence[Entry]) -> Iterator[tuple[str, str, Entry]]:
    alike = [each for each in entries if each.folder == entry.folder and is_lesson(each.name) == is_lesson(entry.name)]
    place = alike.index(entry)
    pairs = {"notebooks": ("exercises", gettext("Exercises")), "exercises": ("notebooks", gettext("Lesson"))}
    pair, label = pairs.get(entry.folder, ("", ""))
    yield from (("before", gettext("Before"), each) for each in alike[:place][-1:])
    yield from (("also", label, each) for each in entries if each.name == f"{pair}/{PurePosixPath(entry.name).name}")
    yield from (("after", gettext("Next"), each) for each in alike[place + 1 :][:1])


def _program(entry: Entry, parts: Parts, live: Answering | None) -> Program | None:
    if not parts and not live:
        return None
    if live:  # rules can be edited: a panel may draw anything
        script = opening(live.script)
    else:
        panels = [*_panels(parts)]
        left_out = (
            not_needed(*{each["mode"] for each in panels}) | unasked([each["model"] for each in panels]) if panels else _PANELS
        )
        script = f'"use strict";\n{compact("course", left_out)}\nopenCoursePage();\n'
    looks, known = style() + style("lessons"), _with_books_once(parts)
    if live is None:
        words = translated_words("course")
        return Program(script, looks, {**known, **({"words": words} if words else {})})
    known |= {"words": translated_words(live.script, "panel", "filling", "voting"), **live.data}
    if not live.holds_kit:
        return Program(script, looks + style(live.script), known, asks=True)
    home = f"{relpath('.', entry.folder)}/"
    return Program(script, looks + style(live.script), {**known, "home": home}, home=home)


def _panels(data: object) -> Iterator[Data]:
    """The data of panels, wherever they are."""
    if isinstance(data, list):
        for each in data:
            yield from _panels(each)
    elif isinstance(data, dict):
        yield from [data] if "mode" in data else (panel for each in data.values() for panel in _panels(each))


def _with_books_once(parts: Parts) -> Data:
    """The data of a page: panels of the same books have them in common, each names theirs by a number."""
    books: dict[str, int] = {}

    def numbered(data: object) -> object:
        if not isinstance(data, dict):
            return data
        return {
            name: books.setdefault(value, len(books)) if name == "books" else numbered(value) for name, value in data.items()
        }

    found = [numbered(part) for part in parts]
    return {"parts": found, "books": [*books]}


Parts = list[Data]
"""What the script of a page has to know of each of its panels, votes, predictions, tables and pictures, in their order."""
QUESTIONS = ("vote", "prediction", "worksheet", "beside")
"""Kinds of parts whose code would give away what they ask, and is folded."""
_PICTURE = re.compile(r'src="data:image/svg\+xml;base64,([A-Za-z0-9+/=]{4000,})"')
"""A picture that is worth being kept apart, and how large it is."""
_PHOTOGRAPH = re.compile(r'src="data:image/png;base64,([A-Za-z0-9+/=]{40000,})"')
"""Pixels that may be many colours, as of what stands in the sun."""
_SIZE = re.compile(r'<svg(?: (?!width)[\w:]+="[^"]*")*( width="[^"]*" height="[^"]*")')


def cells_html(cells: Sequence[NotebookNode], links: Links, parts: Parts, live: Answering | None = None) -> str:
    """Cells of a notebook as HTML; what the script of the page has to know is added to `parts`."""
    return "".join(
        markdown_html(cell.source, links, notes(bool(live))) if cell.cell_type == "markdown" else _code_html(cell, parts)
        for cell in cells
        if cell.cell_type in ("markdown", "code") and cell.source.strip()
    )


def _code_html(cell: NotebookNode, parts: Parts) -> str:
    """A code cell: its code, and below it what it shows; where it asks something, its code is folded and comes last."""
    shown = "".join(output_html(output, parts) for output in cell.outputs)
    code = f'<pre class="code"><code>{escaped_lines(cell.source.strip())}</code></pre>\n'
    asks = any(output.get("data", {}).get(PART, {}).get("kind") in QUESTIONS for output in cell.outputs)
    if asks:
        return f'{shown}<details class="folded"><summary>{gettext("Code of this cell")}</summary>\n{code}</details>\n'
    return code + shown


def output_html(output: Entries, parts: Parts) -> str:
    """What a cell has put out, as HTML.

    >>> output_html({"output_type": "stream", "text": "a < b\\n"}, [])
    '<div class="output" tabindex="0"><pre>a &lt; b</pre></div>\\n'
    """
    if output["output_type"] == "stream":
        return _block(_lines(output["text"]))
    if output["output_type"] == "error":
        return _block(_lines(f"{output['ename']}: {output['evalue']}"))
    return data_html(output["data"], parts)


def data_html(data: Entries, parts: Parts) -> str:
    """What is shown of an object, by media types, as HTML.

    >>> data_html({"text/latex": "$x$", "text/plain": "x"}, [])
    '<div class="output" tabindex="0"><math display="block"><mrow><mi>x</mi></mrow></math></div>\\n'
    """
    if PART in data:
        return _part_html(data[PART], data["text/plain"], parts)
    if "text/latex" in data and "text/html" not in data:
        return _block(mathml(data["text/latex"], "block"))
    drawing = _PHOTOGRAPH.sub(_compressed, html(data).replace(DARKENED, ""))
    return _block(_PICTURE.sub(lambda found: kept_picture(base64.b64decode(found[1]).decode(), parts), drawing))


def _compressed(found: re.Match[str]) -> str:
    """The attribute of a picture of pixels in WebP, a fifth as long; a film and what is transparent stay as they are."""
    from PIL import Image

    with Image.open(io.BytesIO(base64.b64decode(found[1]))) as image:
        if image.mode != "RGB" or getattr(image, "is_animated", False):
            return found[0]
        content = io.BytesIO()
        image.save(content, "WEBP", quality=75, method=6)
    return f'src="data:image/webp;base64,{base64.b64encode(content.getvalue()).decode()}"'


def kept_picture(drawing: str, parts: Parts) -> str:
    """The attributes of a picture in SVG: an empty one of its size, which the script of the page fills before it comes into
    view.
    """
    size = _SIZE.search(drawing)
    empty = f'<svg xmlns="http://www.w3.org/2000/svg"{size[1] if size else ""}/>'
    number = len(parts)
    parts.append({"kind": "picture", "data": {"drawing": deflated_text(drawing)}})
    return f'data-part="{number}" src="data:image/svg+xml,{quote(empty)}"'


def _part_html(part: Mapping[str, object], words: str, parts: Parts) -> str:
    kind, number = part["kind"], len(parts)
    parts.append({"kind": kind, "data": part["data"]})
    inside = _prediction_html(part, parts) if kind == "prediction" else _lines(words)
    return f'<div class="part part-{kind}" data-part="{number}">{inside}</div>\n'


def _prediction_html(part: Entries, parts: Parts) -> str:
    answer = data_html(part["answer"], parts)
    question = prose_html(part["data"]["question"])
    return f"<details><summary>{question}</summary>\n<div data-answer>\n{answer}</div>\n</details>"


def _lines(text: str) -> str:
    return f"<pre>{escaped_lines(text.rstrip())}</pre>"


def _block(inside: str) -> str:
    return f'<div class="output" tabindex="0">{inside}</div>\n'


def headings(cells: list[NotebookNode]) -> Iterator[str]:
    """The headings of a notebook, from the greatest on, each as it is written."""
    for cell in cells:
        if cell.cell_type == "markdown":
            yield from (line for line in cell.source.splitlines() if line.startswith("#"))


def title_of(cells: list[NotebookNode], name: str) -> str:
    """The title of a notebook: its first heading."""
    first = next((line for line in headings(cells) if line.startswith("# ")), f"# {name}")
    return escaped(first[2:].strip()).replace("`", "").replace("*", "")
